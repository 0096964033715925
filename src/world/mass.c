// mass.c - mass, centre and inertia of bodies: from their shapes and densities, or as given. Sums over a world's
// bodies.
//
// Called when shapes, type or locks change; the solver reads inverse_mass, inertia, inertia_axes and local_centre. Only
// dynamic bodies have mass; the centre of the others is their origin, so that a kinematic body turns about the point
// its owner placed. Computed in double: the parts of a large body far from its centre would cancel in float.
#include "world/mass.h"

#include "core/math.h"
#include "world/body.h"
#include "world/body_motion.h"
#include "world/contact.h"
#include "world/joint_creation.h"
#include "world/proxies.h"
#include "world/sleep.h"

#include <float.h>

// A body lighter than this, kg, would have an inverse mass or inertia that floats cannot hold: it counts as weightless.
// (A sphere of the smallest radius, 1 mm, of water weighs 4e-6 kg.)
#define LEAST_MASS 1e-9
// A weightless dynamic body gets 1 kg, and the inertia of a sphere of 1 m, 2/5 m r^2.
#define DEFAULT_MASS 1.0f
#define DEFAULT_INERTIA 0.4f
// Principal moments that differ by less are equal: the gyroscopic torque of the difference is below the solver's
// rounding
#define ISOTROPY 1e-6f

typedef struct mass_properties {
    float mass;
    fe_vec3 centre, inertia;
    fe_quat axes;
} mass_properties;

// A body's velocity is that of its centre of mass. When the centre becomes another material point, its velocity there
// is v + w x (R delta): no point of the body changes its motion.
static void set_local_centre(fe_world *world, fe__body *body, fe_vec3 centre)
{
    fe_vec3 old = fe__quad_vector(body->local_centre), w = fe__quad_vector(body->spin);
    fe_dvec3 delta = fe__drotate(fe__rotation_of(body), fe__dsub(fe__widen(centre), fe__widen(old)));
    fe_vec3 change = fe__narrow(fe__dcross(fe__widen(w), delta));
    body->velocity[0] += change.x, body->velocity[1] += change.y, body->velocity[2] += change.z;
    fe__body_stop_locked(world, body);

    body->local_centre[0] = centre.x, body->local_centre[1] = centre.y, body->local_centre[2] = centre.z;
    fe__body_place_centre(body);
    fe__odometer_place(world->odometers + (body - world->bodies), body->centre);
    fe__body_end_deferrals(world, (int32_t)(body - world->bodies));
}

// The largest reach and the least thickness: the same whatever the order of the shapes
static void add_sizes(fe__body *body, fe__shape *shape)
{
    fe_vec3 centre = fe__quad_vector(body->local_centre);
    fe_vec3 in_form = fe__rotate_back(shape->local_rotation, fe__sub(centre, shape->local_position));
    float reach = fe__form_reach(&shape->form, in_form);
    shape->arm = reach - shape->form.radius;
    body->thickness = fe__minf(body->thickness, fe__form_thickness(&shape->form));
    body->reach = fe__maxf(body->reach, reach);
}

static void set_sizes(fe_world *world, fe__body *body)
{
    body->thickness = FLT_MAX;
    body->reach = 0.0f;
    for (int32_t i = body->first_shape; i >= 0; i = world->shapes[i].next) add_sizes(body, &world->shapes[i]);
    body->flags &= ~(uint32_t)FE__BODY_SIZES_STALE;
    fe__body_note_swiftness(world, body);
}

static void apply(fe_world *world, fe__body *body, const mass_properties *p)
{
    int32_t dynamic = body->type == FE_BODY_DYNAMIC;
    fe_vec3 inertia = p->inertia;
    body->inverse_mass = dynamic ? 1.0f / p->mass : 0.0f;
    body->inertia[0] = inertia.x, body->inertia[1] = inertia.y, body->inertia[2] = inertia.z, body->mass = p->mass;
    body->inertia_axes[0] = p->axes.x, body->inertia_axes[1] = p->axes.y, body->inertia_axes[2] = p->axes.z,
    body->inertia_axes[3] = p->axes.w;
    if (p->centre.x != body->local_centre[0] || p->centre.y != body->local_centre[1] ||
        p->centre.z != body->local_centre[2]) {
        set_local_centre(world, body, p->centre);
    }
    set_sizes(world, body);
    if (body->joint_count)
        world->joints.forest.changed = world->solver.graph_changed = 1; // other trees may bear much now

    float largest = fe__maxf(fe__maxf(inertia.x, inertia.y), inertia.z),
          least = fe__minf(fe__minf(inertia.x, inertia.y), inertia.z);
    int32_t turns_locked = (uint32_t)body->lock_bits >> 3 != 0;
    body->flags &= ~(uint32_t)FE__BODY_ISOTROPIC;
    if (turns_locked || largest - least <= ISOTROPY * largest) body->flags |= FE__BODY_ISOTROPIC;
}

// ---- mass of the shapes ---------------------------------------------------------------------------------------------

static fe__mass shape_mass(const fe__shape *shape) { return fe__form_mass(&shape->form, shape->density); }

// The shape's centre of mass, body's frame
static fe_dvec3 centre_of(const fe__shape *shape, const fe__mass *mass)
{
    return fe__dadd(fe__widen(shape->local_position), fe__drotate(shape->local_rotation, fe__widen(mass->centre)));
}

// The shape's principal axes, body's frame
static fe_quat axes_of(const fe__shape *shape, const fe__mass *mass)
{
    return mass->is_turned ? fe__unit_rotation(fe__product(shape->local_rotation, mass->axes)) : shape->local_rotation;
}

// Adds the inertia of a shape about the body's centre: R diag(I) R^T + m (d^2 1 - d d^T), d from the body's centre to
// the shape's
static void add_shape(fe__tensor *sum, const fe__shape *shape, const fe__mass *mass, fe_dvec3 centre)
{
    fe_dvec3 d = fe__dsub(centre_of(shape, mass), centre);
    double offset[3] = {d.x, d.y, d.z}, square = fe__ddot(d, d),
           principal[3] = {(double)mass->inertia.x, (double)mass->inertia.y, (double)mass->inertia.z};
    double axis[3][3];
    fe_quat axes = axes_of(shape, mass);
    for (int k = 0; k < 3; ++k) {
        fe_dvec3 a = fe__drotate(axes, (fe_dvec3){k == 0, k == 1, k == 2});
        axis[k][0] = a.x, axis[k][1] = a.y, axis[k][2] = a.z;
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            for (int k = 0; k < 3; ++k) sum->m[i][j] += principal[k] * axis[k][i] * axis[k][j];
            sum->m[i][j] += (double)mass->mass * ((i == j ? square : 0.0) - offset[i] * offset[j]);
        }
    }
}

static mass_properties combine(const fe_world *world, const fe__body *body, double total, fe_dvec3 moment)
{
    fe_vec3 centre = fe__narrow(fe__dscale(1.0 / total, moment));
    fe__tensor sum = {{{0}}};
    for (int32_t i = body->first_shape; i >= 0; i = world->shapes[i].next) {
        fe__mass mass = shape_mass(&world->shapes[i]);
        add_shape(&sum, &world->shapes[i], &mass, fe__widen(centre));
    }
    fe__tensor axes = fe__tensor_diagonalise(&sum);
    return (mass_properties){(float)total,
                             centre,
                             {(float)sum.m[0][0], (float)sum.m[1][1], (float)sum.m[2][2]},
                             fe__unit_rotation(fe__tensor_rotation(&axes))};
}

static mass_properties from_shapes(const fe_world *world, const fe__body *body)
{
    double total = 0.0;
    fe_dvec3 moment = {0, 0, 0};
    int32_t heavy = 0;
    const fe__shape *only = NULL;
    for (int32_t i = body->first_shape; i >= 0; i = world->shapes[i].next) {
        const fe__shape *shape = &world->shapes[i];
        fe__mass mass = shape_mass(shape);
        if (mass.mass == 0.0f) continue;
        total += (double)mass.mass;
        moment = fe__dadd(moment, fe__dscale((double)mass.mass, centre_of(shape, &mass)));
        heavy += 1;
        only = shape;
    }
    if (total < LEAST_MASS)
        return (mass_properties){DEFAULT_MASS,
                                 {0, 0, 0},
                                 {DEFAULT_INERTIA, DEFAULT_INERTIA, DEFAULT_INERTIA},
                                 fe__identity()};
    if (heavy > 1) return combine(world, body, total, moment);
    fe__mass mass = shape_mass(only); // exactly the form's
    return (mass_properties){mass.mass, fe__narrow(centre_of(only, &mass)), mass.inertia, axes_of(only, &mass)};
}

// ---- changes --------------------------------------------------------------------------------------------------------

void fe__body_update_mass(fe_world *world, int32_t index)
{
    fe__body *body = &world->bodies[index];
    mass_properties p = {.axes = fe__identity()};
    if (body->flags & FE__BODY_MASS_GIVEN) {
        p.mass = body->mass;
        p.centre = fe__quad_vector(body->local_centre);
        p.inertia = fe__quad_vector(body->inertia);
        p.axes = fe__quat_of(body->inertia_axes);
    } else if (body->type == FE_BODY_DYNAMIC) {
        p = from_shapes(world, body);
    }
    apply(world, body, &p);
    fe__body_place_anchors(world, index);
}

// 1: the centre of mass is that of the shapes. For other bodies a change of shapes is no change of mass, so that a
// level of n shapes on one body is made, changed and taken apart in a time that grows with n, not with its square.
static int32_t weighs_its_shapes(const fe__body *body)
{
    return body->type == FE_BODY_DYNAMIC && !(body->flags & FE__BODY_MASS_GIVEN);
}

void fe__body_gain_shape(fe_world *world, int32_t index, int32_t shape)
{
    fe__body *body = &world->bodies[index];
    if (weighs_its_shapes(body)) {
        fe__body_update_mass(world, index);
        return;
    }
    for (int32_t i = shape; i >= 0; i = fe__next_of_whole(world, shape, i)) add_sizes(body, &world->shapes[i]);
    fe__body_note_swiftness(world, body);
}

void fe__body_sizes_changed(fe_world *world, int32_t index)
{
    enum { FEW_SHAPES = 16 }; // so few are summed at once
    fe__body *body = &world->bodies[index];
    if (body->type != FE_BODY_STATIC || body->shape_count <= FEW_SHAPES) {
        fe__body_update_mass(world, index);
        return;
    }
    body->flags |= FE__BODY_SIZES_STALE;
    world->has_stale_sizes = 1;
}

void fe__body_densities_changed(fe_world *world, int32_t index)
{
    if (weighs_its_shapes(&world->bodies[index])) fe__body_update_mass(world, index);
}

void fe__settle_sizes(fe_world *world)
{
    if (!world->has_stale_sizes) return;
    for (int32_t i = world->first_body; i >= 0; i = world->bodies[i].order_next)
        if (world->bodies[i].flags & FE__BODY_SIZES_STALE) set_sizes(world, &world->bodies[i]);
    world->has_stale_sizes = 0;
}

void fe__body_set_mass(fe_world *world, int32_t index, const fe_mass_data *data)
{
    fe__body *body = &world->bodies[index];
    mass_properties p = {data->mass, data->centre, data->inertia, fe__unit_rotation(data->inertia_rotation)};
    fe__body_disturb(world, index);
    body->flags |= FE__BODY_MASS_GIVEN;
    apply(world, body, &p);
    fe__body_place_anchors(world, index);
}

void fe__body_mass_data(const fe_world *world, int32_t index, fe_mass_data *out_data)
{
    const fe__body *body = &world->bodies[index];
    out_data->mass = body->mass;
    out_data->centre = fe__quad_vector(body->local_centre);
    out_data->inertia = fe__quad_vector(body->inertia);
    out_data->inertia_rotation = fe__quat_of(body->inertia_axes);
}

fe_mass_data fe__body_scaled_mass(const fe_world *world, int32_t body, float mass)
{
    fe_mass_data data = {.struct_size = sizeof data};
    fe__body_mass_data(world, body, &data);
    double scale = (double)mass / (double)data.mass;
    data.mass = mass;
    data.inertia = fe__narrow(fe__dscale(scale, fe__widen(data.inertia)));
    return data;
}

// ---- mechanics ------------------------------------------------------------------------------------------------------

static int32_t has_motion(const fe__body *body)
{
    return body->type == FE_BODY_DYNAMIC && body->flags & FE__BODY_ENABLED;
}

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
        if (!has_motion(b)) continue;
        fe_dvec3 v = fe__widen(fe__quad_vector(b->velocity)), w = fe__widen(fe__quad_vector(b->spin));
        fe_dvec3 x = fe__dsub(fe__centre_of(b), fe__dscale(half, v));
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
        if (!has_motion(b)) continue;
        fe_dvec3 p = fe__dscale((double)b->mass, fe__widen(fe__quad_vector(b->velocity)));
        fe_dvec3 arm = fe__dsub(fe__centre_of(b), about);
        linear = fe__dadd(linear, p);
        angular = fe__dadd(angular, fe__dadd(fe__dcross(arm, p), spin_momentum(b)));
    }
    *out_linear = linear;
    *out_angular = angular;
}

// Extends the box by a shape's. found: 0: it is empty yet. Returns whether it holds any
static int32_t add_bounds(const fe_world *world, int32_t shape, int32_t found, fe__bounds *all)
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
        found = add_bounds(world, shape, found, all);
    return found;
}

fe__bounds fe__whole_bounds(const fe_world *world, int32_t shape)
{
    fe__bounds bounds = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    int32_t found = 0;
    for (int32_t i = shape; i >= 0; i = fe__next_of_whole(world, shape, i))
        found = add_bounds(world, i, found, &bounds);
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
