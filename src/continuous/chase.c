// chase.c - see chase.h.
#include "continuous/chase.h"

#include "continuous/energy.h"
#include "continuous/obstacle.h"
#include "world/pose.h"

enum { MOST_STOPS = 4, SLIDE_SWEEPS = 8 };

typedef struct slide {
    fe_dvec3 normal[MOST_STOPS];
    double room[MOST_STOPS]; // along it: what the obstacle gives way until the end of the step, m
    int32_t count, carried;  // carried: an obstacle moves
} slide;

// How far the obstacle's point goes along the normal from now to the end of the step
static double room_of(const fe__step *step, const fe__obstacle *o)
{
    const fe__body *body = step->world->bodies + o->body;
    if (body->type == FE_BODY_STATIC) return 0.0;
    fe_dvec3 base = fe__centre_of(body);
    fe__motion m = fe__path_motion(step, o->body, o->time, 1.0, base);
    fe__pose end = fe__motion_at(&m, 1.0);
    fe_dvec3 arm = fe__dsub(fe__dsub(o->point, base), m.centre);
    fe_dvec3 turned = fe__drotate(end.rotation, fe__drotate_back(m.rotation, arm));
    return fe__ddot(o->normal, fe__dadd(m.translation, fe__dsub(turned, arm)));
}

// The part of a displacement that no obstacle forbids: projected on one after the other until all agree, or nearly
static fe_dvec3 allowed(const slide *s, fe_dvec3 shift)
{
    for (int32_t sweep = 0; sweep < SLIDE_SWEEPS; ++sweep) {
        for (int32_t i = 0; i < s->count; ++i) {
            double over = fe__ddot(s->normal[i], shift) - s->room[i];
            if (over > 0.0) shift = fe__dsub(shift, fe__dscale(over, s->normal[i]));
        }
    }
    return shift;
}

// The part of a normal along which the body can move at all
static fe_dvec3 free_part(const fe__body *b, fe_dvec3 normal)
{
    const uint32_t locks = (uint32_t)b->lock_bits;
    return (fe_dvec3){locks & FE_AXIS_X ? 0.0 : normal.x, locks & FE_AXIS_Y ? 0.0 : normal.y,
                      locks & FE_AXIS_Z ? 0.0 : normal.z};
}

// At an obstacle: the body goes on along it, and at the first one on turning too, unless that presses the touched point
// in.
static void deflect(const fe__step *step, int32_t body, slide *s, const fe__obstacle *o, const fe__shift *at,
                    fe__shift *end)
{
    const fe__body *b = step->world->bodies + body;
    fe_dvec3 normal = free_part(b, o->normal);
    double length = sqrt(fe__ddot(normal, normal)); // 0: it cannot move off, nor against it
    s->normal[s->count] = length > 0.0 ? fe__dscale(1.0 / length, normal) : normal;
    s->room[s->count++] = length > 0.0 ? room_of(step, o) / length : 0.0;
    s->carried |= step->world->bodies[o->body].type != FE_BODY_STATIC;
    end->centre = fe__dadd(at->centre, allowed(s, fe__dsub(end->centre, at->centre)));
    fe_dvec3 base = fe__centre_of(b);
    fe__motion rest = fe__motion_of_shifts(b, at, end, base);
    fe_dvec3 axis = {(double)rest.angular_displacement.x, (double)rest.angular_displacement.y,
                     (double)rest.angular_displacement.z};
    fe_dvec3 arm = fe__dsub(o->point, fe__dadd(base, at->centre));
    if (s->count > 1 || fe__ddot(o->normal, fe__dcross(axis, arm)) > 0.0) end->rotation = at->rotation;
}

// From `at` (time `now`) towards `end`; returns where it came to.
static fe__shift go_on(const fe__step *step, int32_t body, int32_t against, fe__obstacle o, fe__shift at, fe__shift end,
                       int32_t *carried)
{
    slide s = {.count = 0};
    for (;;) {
        deflect(step, body, &s, &o, &at, &end);
        double now = o.time;
        o = fe__first_obstacle(step, body, against, &at, &end, now, 1.0);
        *carried = s.carried;
        if (o.body < 0) return end;
        fe__shift stop = fe__shift_between(&at, &end, (o.time - now) / (1.0 - now));
        if (s.count == MOST_STOPS || fe__ddot(o.normal, o.normal) == 0.0) return stop;
        at = stop;
    }
}

// A rotation not made leaves the spin as the body has it in its own frame: turned with the world's, it would be another
// energy
static void turn_spin(const fe__motion_line *motion, const fe__shift *end, float *spin)
{
    fe_quat missing = fe__product(fe__quat_of(motion->rotation), fe__conjugate(end->rotation));
    fe_vec3 w = fe__rotate_back(fe__normalized(missing), fe__quad_vector(spin));
    spin[0] = w.x, spin[1] = w.y, spin[2] = w.z;
}

static void write_chase(const fe__step *step, const fe__body *body, const fe__shift *end, int32_t carried,
                        fe__chase *chase)
{
    const fe__solver *s = &step->world->solver;
    chase->motion = s->motion[body->line];
    chase->velocity = s->velocity[body->line];
    if (!body->locked) turn_spin(&chase->motion, end, chase->velocity.w);
    fe_vec3 p = fe__narrow(end->centre);
    if (!carried) fe__give_back(step->world, body, fe__sub(p, fe__quad_vector(chase->motion.shift)), chase->velocity.v);
    chase->motion = (fe__motion_line){{p.x, p.y, p.z},
                                      chase->motion.gyroscopic,
                                      {end->rotation.x, end->rotation.y, end->rotation.z, end->rotation.w}};
    chase->stopped = 1;
}

// Follows a body on its legs until something stands there
void fe__chase_body(const fe__step *step, int32_t body, int32_t against, fe__chase *chase)
{
    chase->stopped = 0;
    if (!fe__path_is_blocked(step, body, against)) return;
    int32_t legs = fe__path_legs(step, body);
    for (int32_t leg = 0; leg < legs; ++leg) {
        double begin = fe__path_time(step, body, leg), end = fe__path_time(step, body, leg + 1);
        fe__shift from = fe__path_at(step, body, begin), to = fe__path_at(step, body, end);
        fe__obstacle o = fe__first_obstacle(step, body, against, &from, &to, begin, end);
        if (o.body < 0) continue;
        int32_t carried = step->world->bodies[o.body].type != FE_BODY_STATIC;
        fe__shift stop = fe__shift_between(&from, &to, (o.time - begin) / (end - begin)),
                  last = fe__path_at(step, body, 1.0);
        if (fe__ddot(o.normal, o.normal) > 0.0 && o.time < 1.0)
            stop = go_on(step, body, against, o, stop, last, &carried);
        write_chase(step, step->world->bodies + body, &stop, carried, chase);
        return;
    }
}

// Its motion path is now the straight one.
void fe__apply_chase(fe_world *w, int32_t body, const fe__chase *chase)
{
    if (!chase->stopped) return;
    int32_t line = w->bodies[body].line;
    w->solver.motion[line] = chase->motion;
    w->solver.velocity[line] = chase->velocity;
    w->solver.trail_count[line] = FE__NO_TRAIL;
}

int32_t fe__stop_body(const fe__step *step, int32_t body)
{
    fe__chase chase;
    fe__chase_body(step, body, FE__AGAINST_FIXED, &chase);
    fe__apply_chase(step->world, body, &chase);
    if (chase.stopped && step->world->bodies[body].first_joint) step->world->bodies[body].flags |= FE__BODY_HELD;
    return chase.stopped;
}
