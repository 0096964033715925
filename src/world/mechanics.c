// mechanics.c - see mechanics.h.
#include "world/mechanics.h"

#include "world/motion.h"
#include "world/proxies.h"

static int32_t counts(const fe__body *body) { return body->type == FE_BODY_DYNAMIC && body->flags & FE__BODY_ENABLED; }

// I w, kg m2/s, world axes
static fe_dvec3 spin_momentum(const fe__body *body)
{
    double m[3][3];
    fe__body_world_inertia(body, m);
    fe_dvec3 w = fe__widen(fe__quad_vector(body->spin));
    return (fe_dvec3){m[0][0] * w.x + m[0][1] * w.y + m[0][2] * w.z, m[1][0] * w.x + m[1][1] * w.y + m[1][2] * w.z,
                      m[2][0] * w.x + m[2][1] * w.y + m[2][2] * w.z};
}

// T = (m v.v + w.I w) / 2,  V = -m g.(x - h v / 2): symplectic Euler keeps T(v) + V(x - h v / 2) in a uniform field, as
// v' = v + h g and x' = x + h v' give T' - T = h m g.(v + h g / 2) = -(V' - V)
void fe__world_energy(const fe_world *world, double *out_kinetic, double *out_potential)
{
    const fe_dvec3 gravity = fe__widen(world->gravity);
    double kinetic = 0.0, potential = 0.0, half = 0.5 * (double)world->last_h;
    for (int32_t i = world->first_body; i >= 0; i = world->bodies[i].order_next) {
        const fe__body *b = world->bodies + i;
        if (!counts(b)) continue;
        fe_dvec3 v = fe__widen(fe__quad_vector(b->velocity)), w = fe__widen(fe__quad_vector(b->spin));
        fe_dvec3 x = fe__dsub((fe_dvec3){b->centre[0], b->centre[1], b->centre[2]}, fe__dscale(half, v));
        kinetic += 0.5 * ((double)b->mass * fe__ddot(v, v) + fe__ddot(w, spin_momentum(b)));
        potential -= (double)b->mass * (double)b->gravity_scale * fe__ddot(gravity, x);
    }
    *out_kinetic = kinetic;
    *out_potential = potential;
}

void fe__world_momentum(const fe_world *world, fe_dvec3 about, fe_dvec3 *out_linear, fe_dvec3 *out_angular)
{
    fe_dvec3 linear = {0.0, 0.0, 0.0}, angular = {0.0, 0.0, 0.0};
    for (int32_t i = world->first_body; i >= 0; i = world->bodies[i].order_next) {
        const fe__body *b = world->bodies + i;
        if (!counts(b)) continue;
        fe_dvec3 p = fe__dscale((double)b->mass, fe__widen(fe__quad_vector(b->velocity)));
        fe_dvec3 arm = fe__dsub((fe_dvec3){b->centre[0], b->centre[1], b->centre[2]}, about);
        linear = fe__dadd(linear, p);
        angular = fe__dadd(angular, fe__dadd(fe__dcross(arm, p), spin_momentum(b)));
    }
    *out_linear = linear;
    *out_angular = angular;
}

static int32_t add_shape(const fe_world *world, int32_t shape, int32_t found, fe__bounds *all)
{
    const fe__form *form = &world->shapes[shape].form;
    if (fe__form_is_unbounded(form) || fe__form_is_of_parts(form)) return found;
    fe__bounds b = fe__shape_bounds(world, shape, 0.0f);
    if (found)
        fe__bounds_add(all, &b);
    else
        *all = b;
    return 1;
}

static int32_t add_body(const fe_world *world, int32_t body, int32_t found, fe__bounds *all)
{
    for (int32_t shape = world->bodies[body].first_shape; shape >= 0; shape = world->shapes[shape].next)
        found = add_shape(world, shape, found, all);
    return found;
}

fe__bounds fe__whole_bounds(const fe_world *world, int32_t shape)
{
    fe__bounds bounds = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    int32_t found = 0;
    for (int32_t i = shape; i >= 0; i = fe__next_of_whole(world, shape, i)) found = add_shape(world, i, found, &bounds);
    return bounds;
}

int32_t fe__body_bounds(const fe_world *world, int32_t body, fe__bounds *out_bounds)
{
    if (body >= 0) return add_body(world, body, 0, out_bounds);
    int32_t found = 0;
    for (int32_t i = world->first_body; i >= 0; i = world->bodies[i].order_next)
        found = add_body(world, i, found, out_bounds);
    return found;
}
