// continuous.c - the stage between solver and finalize: bodies that outran their thickness end where something stood in
// the way.
//
// Most impacts are the solver's: contacts are found ahead of time (narrowphase.c). What it misses - a body that turned
// or was deflected within the step, that has no contact where it came to - is found here, on the body's motion path,
// and changes its motion in the solver's lines: up to the touch, then along the surface. Velocities stay, so that the
// next step has a contact with the speed of the impact: it bounces, slides and reports its events as any other. Only
// the work of gravity on the path not gone is given back.
//
// Against static and kinematic bodies each body is its own. Bullets come after, against where the dynamic bodies now
// go; all see the same.
#define FE_W 4
#include "continuous/continuous.h"

#include "collision/cast/cast_kinds.h"
#include "continuous/joined_bodies.h"
#include "continuous/motion_path.h"
#include "solver/motion_check.h"
#include "world/body.h"
#include "world/contact.h"
#include "world/contact_creation.h"
#include "world/filter.h"

// ---- obstacle -------------------------------------------------------------------------------------------------------
// What stands in the path of a body.
//
// Read by the continuous stage, on any thread: nothing of the world is written.

// What a body meets on one leg. Its shapes count as met where they would be deeper than a share of their thickness:
// what the solver lets overlap, rests or slides is never met.
typedef struct fe__obstacle {
    double time;     // of the step: where the whole shape touches
    fe_dvec3 normal; // unit, from the body to it; 0: not known
    fe_dvec3 point;  // of it
    int32_t body;    // -1: nothing
} fe__obstacle;

enum { FE__AGAINST_FIXED, FE__AGAINST_DYNAMIC }; // static and kinematic bodies; dynamic ones

// Could it meet anything at all? Cheap; may say yes too often.
int32_t fe__path_is_blocked(const fe__step *step, int32_t body, int32_t against);
// The first on its motion from `from` to `to`, between two times of the step.
fe__obstacle fe__first_obstacle(const fe__step *step, int32_t body, int32_t against, const fe__shift *from,
                                const fe__shift *to, double begin, double end);
// Do two shapes, neither a heightfield, touch on their bodies' motion paths?
int32_t fe__paths_cross(const fe__step *step, int32_t shape_a, int32_t shape_b);

// ---- continuous -----------------------------------------------------------------------------------------------------

enum { BODIES_IN_BLOCK = 256, CHASES_IN_BLOCK = 4 };

// ---- who is fast ---------------------------------------------------------------------------------------------------
static void add_chased(fe__step_scratch *s, fe__body *body, int32_t index)
{
    body->flags |= FE__BODY_CHASED;
    s->swept[atomic_fetch_add_explicit(&s->swept_count, 1, memory_order_relaxed)] = index;
}

static void select_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    fe__step *step = argument;
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        int32_t index = w->awake_bodies[i];
        fe__body *body = w->bodies + index;
        if (body->type == FE_BODY_DYNAMIC) {
            int32_t fast =
                w->solver.trail_count[body->line] != FE__NO_TRAIL || fe__path_length(step, index) > body->thickness;
            if (fast && fe__motion_makes_sense(&w->solver, body->line)) add_chased(s, body, index);
        } else if (body->contact_count && fe__path_length(step, index) > 0.0f) {
            s->swept[s->first_kinematic + atomic_fetch_add_explicit(&s->kinematic_count, 1, memory_order_relaxed)] =
                index;
        }
    }
}

static float thinner(const fe__body *a, const fe__body *b) { return fe__minf(a->thickness, b->thickness); }

// Slow bodies that a kinematic one may have passed through
static void add_partners(fe__step *step, int32_t kinematic)
{
    fe_world *w = step->world;
    float length = fe__path_length(step, kinematic);
    for (int32_t pair = w->bodies[kinematic].first_contact; pair >= 0; pair = fe__next_pair(w, pair, kinematic)) {
        const fe__pair *p = w->pairs + pair;
        int32_t other = p->body_a == kinematic ? p->body_b : p->body_a;
        fe__body *body = w->bodies + other;
        if (p->flags & (FE__PAIR_SENSOR | FE__PAIR_DENIED | FE__PAIR_PASSING) || body->type != FE_BODY_DYNAMIC ||
            body->awake_index < 0 || body->flags & FE__BODY_CHASED)
            continue;
        if (length + fe__path_length(step, other) <= body->thickness) continue;
        if (fe__motion_makes_sense(&w->solver, body->line)) add_chased(step->scratch, body, other);
    }
}

// ---- in blocks ---------------------------------------------------------------------------------------------------
static void stop_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        fe__limit_energy(step, step->scratch->swept[i]);
        fe__stop_body(step, step->scratch->swept[i]);
    }
}

static int32_t is_bullet(const fe_world *w, int32_t body) { return (w->bodies[body].flags & FE__BODY_BULLET) != 0; }

static void bullet_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        int32_t body = step->scratch->swept[i];
        if (is_bullet(step->world, body))
            fe__sweep_body(step, body, FE__AGAINST_DYNAMIC, step->scratch->sweep_ends + i);
    }
}

// ---- triggers ------------------------------------------------------------------------------------------------------
// What was passed between two steps was touched: its enter comes in this step, its exit in the next.
static void cross_triggers(const fe__step *step, int32_t body)
{
    fe_world *w = step->world;
    float length = fe__path_length(step, body);
    for (int32_t pair = w->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(w, pair, body)) {
        fe__pair *p = w->pairs + pair;
        const fe__body *a = w->bodies + p->body_a, *b = w->bodies + p->body_b;
        if (!(p->flags & FE__PAIR_SENSOR) || p->flags & (FE__PAIR_CROSSED | FE__PAIR_PATCH)) continue;
        if (length + fe__path_length(step, p->body_a == body ? p->body_b : p->body_a) <= thinner(a, b)) continue;
        if (fe__is_field_pair(w, p->shape_a, p->shape_b)) continue;
        if (fe__paths_cross(step, p->shape_a, p->shape_b)) p->flags |= FE__PAIR_CROSSED;
    }
}

void fe__stop_fast_bodies(fe__step *step)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    if (!w->tuning.continuous_enabled) return;
    atomic_store(&s->swept_count, 0);
    atomic_store(&s->kinematic_count, 0);
    s->first_kinematic = w->awake_body_count;
    fe__parallel_for(&w->workers, w->awake_body_count, BODIES_IN_BLOCK, select_block, step);
    int32_t kinematic = atomic_load(&s->kinematic_count);
    for (int32_t i = 0; i < kinematic; ++i) add_partners(step, s->swept[s->first_kinematic + i]);
    int32_t count = atomic_load(&s->swept_count), bullets = 0;
    if (count + kinematic == 0) return;
    fe__parallel_for(&w->workers, count, CHASES_IN_BLOCK, stop_block, step);
    fe__rejoin_trees(step);
    for (int32_t i = 0; i < count; ++i) bullets += is_bullet(w, s->swept[i]);
    if (bullets) fe__parallel_for(&w->workers, count, CHASES_IN_BLOCK, bullet_block, step);
    for (int32_t i = 0; i < count; ++i) {
        w->bodies[s->swept[i]].flags &= ~(uint32_t)FE__BODY_CHASED;
        if (is_bullet(w, s->swept[i])) fe__apply_sweep(w, s->swept[i], s->sweep_ends + i);
    }
    if (!w->trigger_pair_count) return;
    for (int32_t i = 0; i < count; ++i) cross_triggers(step, s->swept[i]);
    for (int32_t i = 0; i < kinematic; ++i) cross_triggers(step, s->swept[s->first_kinematic + i]);
}

// ---- chase ----------------------------------------------------------------------------------------------------------

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
                        fe__sweep_end *chase)
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
void fe__sweep_body(const fe__step *step, int32_t body, int32_t against, fe__sweep_end *chase)
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
void fe__apply_sweep(fe_world *w, int32_t body, const fe__sweep_end *chase)
{
    if (!chase->stopped) return;
    int32_t line = w->bodies[body].line;
    w->solver.motion[line] = chase->motion;
    w->solver.velocity[line] = chase->velocity;
    w->solver.trail_count[line] = FE__NO_TRAIL;
}

int32_t fe__stop_body(const fe__step *step, int32_t body)
{
    fe__sweep_end chase;
    fe__sweep_body(step, body, FE__AGAINST_FIXED, &chase);
    fe__apply_sweep(step->world, body, &chase);
    if (chase.stopped && step->world->bodies[body].first_joint) step->world->bodies[body].flags |= FE__BODY_HELD;
    return chase.stopped;
}

// ---- obstacle -------------------------------------------------------------------------------------------------------

// Share of its thickness by which a shape may dip into another as it moves. What stays out of the other by more than
// three quarters of its half width is pushed out on the side it came from.
#define DIP 0.25f
// A search for impacts goes on so much beyond the first one found, as a share of it: of two at once the one created
// first counts.
#define BEYOND 1e-9
// More than the distance at which two forms count as touching, and than the roundings of a plane, m
#define FAR 0.001

// A leg of a body, as it is carried through the trees
typedef struct search {
    const fe__step *step;
    int32_t body, against;
    fe_dvec3 base;
    double begin, end;
    fe__motion motion;
    int32_t has_motion; // 0: it is found when the first obstacle needs it
    // the first so far
    double s; // of the leg, 1 and more: none
    uint64_t serial;
    fe__obstacle first;
    int32_t blocked; // fe__path_is_blocked
} search;

static fe__form dipped(const fe__form *form) { return fe__form_shrunk(form, DIP * fe__form_thickness(form)); }

static void note(search *s, const fe__impact *deep, const fe__impact *touch, const fe__shape *obstacle, fe_dvec3 normal)
{
    s->s = deep->s;
    s->serial = obstacle->serial;
    s->first = (fe__obstacle){s->begin + touch->s * (s->end - s->begin), normal, fe__dadd(s->base, touch->on_b),
                              obstacle->body};
}

// The dipped form decides whether there is an impact, the whole one when.
static void try_form(search *s, const fe__shape *own, const fe__shape *obstacle, const fe__mobile *other)
{
    fe__form thin = dipped(&own->form);
    fe__mobile mover = fe__mobile_of_shape(s->step, own, &s->motion);
    fe__impact deep, touch;
    mover.form = &thin;
    double limit = fe__mind(1.0, s->s * (1.0 + BEYOND));
    if (fe__time_of_impact(&mover, other, limit, &deep) != FE_MEET_LATER) return;
    if (deep.s > s->s || (deep.s == s->s && s->serial < obstacle->serial)) return;
    mover.form = &own->form;
    fe__meeting meeting = fe__time_of_impact(&mover, other, deep.s, &touch);
    if (meeting == FE_MEET_NEVER) touch = deep;
    if (touch.overlap) { // boxes that overlapped a little when the leg began
        fe__gap gap;
        fe__pose a = fe__mobile_at(&mover, 0.0), b = fe__mobile_at(other, 0.0);
        fe__form_gap(&thin, &a, other->form, &b, &gap);
        touch.normal = gap.normal, touch.on_b = gap.on_b;
    }
    note(s, &deep, &touch, obstacle, touch.normal);
}

// Does any leg close the gap at its start? If not, the plane across the shortest distance separates them for the whole
// step.
static int32_t may_close(const search *s, const fe__shape *own, const fe__mobile *other)
{
    const fe__step *step = s->step;
    const fe__body *body = step->world->bodies + s->body;
    fe__form thin = dipped(&own->form);
    fe__mobile mover = fe__mobile_of_shape(step, own, &s->motion);
    mover.form = &thin;
    fe__gap gap;
    fe__pose a = fe__mobile_at(&mover, 0.0), b = fe__mobile_at(other, 0.0);
    fe__form_gap(&thin, &a, other->form, &b, &gap);
    if (gap.overlap || gap.distance <= FE_TOUCH) return 0;
    int32_t legs = fe__path_legs(step, s->body);
    for (int32_t leg = 1; leg <= legs; ++leg) {
        fe__shift at = fe__path_place(step, s->body, leg);
        fe_dvec3 axis = {(double)at.rotation.x, (double)at.rotation.y, (double)at.rotation.z},
                 across = fe__dcross(gap.normal, axis);
        double turning = (double)FE_PI * sqrt(fe__ddot(across, across)) * (double)body->reach;
        if (fe__ddot(gap.normal, at.centre) + turning + 2.0 * FE_TOUCH > gap.distance) return 1;
    }
    return 0;
}

static void try_obstacle(search *s, const fe__shape *own, const fe__shape *obstacle, const fe__mobile *other)
{
    if (s->blocked < 0) {
        try_form(s, own, obstacle, other);
        return;
    }
    int32_t stands = s->step->world->bodies[obstacle->body].type == FE_BODY_STATIC;
    s->blocked |= !stands || may_close(s, own, other);
}

// How far a surface that turns moves past the body beside its own translation, m: the angle, twice its half's sine and
// more, times the distance of the two centres at most.
static double turning_past(const fe__motion *own, const fe__mobile *surface)
{
    fe_quat q = surface->motion.angular_displacement;
    fe_dvec3 axis = {(double)q.x, (double)q.y, (double)q.z};
    double sine = sqrt(fe__ddot(axis, axis));
    if (!(sine > 0.0)) return 0.0;
    fe_dvec3 apart = fe__dsub(own->centre, surface->motion.centre);
    return (double)FE_PI * sine *
           (sqrt(fe__ddot(apart, apart)) + sqrt(fe__ddot(own->translation, own->translation)) +
            sqrt(fe__ddot(surface->motion.translation, surface->motion.translation)));
}

// The triangle's plane, with its normal `up` of any length, through v in the frame of the body's centre: does the
// centre stay farther than `reach` over it, on its way by `travel`? What is that far off is met by nothing of the body.
static int32_t stays_off(fe_dvec3 up, fe_dvec3 v, fe_dvec3 travel, double reach)
{
    double length = sqrt(fe__ddot(up, up)), height = -fe__ddot(up, v), after = height + fe__ddot(up, travel);
    return fe__mind(fe__absd(height), fe__absd(after)) > (reach + FAR) * length && height * after > 0.0;
}

// The triangles under the leg that look at the body's centre: the other side does not count.
static void try_field(search *s, const fe__shape *own, const fe__shape *obstacle, const fe__mobile *other)
{
    const fe_world *w = s->step->world;
    fe__ground surface = fe__store_ground(w->store, &obstacle->form);
    fe__pose pose = fe__mobile_at(other, 0.0);
    fe_dvec3 travel = fe__dsub(s->motion.translation, other->motion.translation);
    fe_dvec3 from = fe__drotate_back(pose.rotation, fe__dsub(s->motion.centre, pose.position));
    fe_dvec3 to = fe__dadd(from, fe__drotate_back(pose.rotation, travel));
    double reach = (double)w->bodies[s->body].reach + turning_past(&s->motion, other);
    fe_dvec3 low = {fe__mind(from.x, to.x) - reach, fe__mind(from.y, to.y) - reach, fe__mind(from.z, to.z) - reach};
    fe_dvec3 high = {fe__maxd(from.x, to.x) + reach, fe__maxd(from.y, to.y) + reach, fe__maxd(from.z, to.z) + reach};
    fe__bounds box = {low, high};
    fe_dvec3 way = fe__dsub(to, from);
    fe__form triangle;
    fe__mobile part = *other;
    part.form = &triangle;
    part.arm = fe__dadd(other->arm, fe__drotate(other->rotation, from));
    fe__ground_walk walk;
    fe__ground_begin(&walk, &surface, &box, from);
    while (fe__ground_next(&walk, &triangle) >= 0 && s->blocked <= 0) {
        const fe_vec3 *v = triangle.vertex;
        fe_vec3 up = fe__cross(fe__sub(v[1], v[0]), fe__sub(v[2], v[0]));
        if (s->blocked < 0 && stays_off(fe__widen(up), fe__widen(v[0]), way, reach)) continue;
        if (fe__dot(up, v[0]) < 0.0f || fe__ground_is_two_sided(&surface))
            try_obstacle(s, own, obstacle, &part); // the centre is at the walk's origin
    }
}

// The pair filter refused the two, or one is on its way through the other
static int32_t lets_pass(const fe_world *w, int32_t shape_a, int32_t shape_b)
{
    if (!((w->shapes[shape_a].flags | w->shapes[shape_b].flags) & (FE__SHAPE_JUDGED | FE__SHAPE_ONE_WAY))) return 0;
    int32_t pair = fe__pair_set_find(&w->pair_set, shape_a, shape_b);
    return pair >= 0 && w->pairs[pair].flags & (FE__PAIR_DENIED | FE__PAIR_PASSING);
}

// Meshes that a kinematic body carries are not, and of a compound its parts are
static int32_t is_swept(const fe__form *form) { return !fe__form_is_static_only(form) && !fe__form_is_of_parts(form); }

static void try_shape(search *s, int32_t shape)
{
    const fe_world *w = s->step->world;
    const fe__shape *obstacle = w->shapes + shape;
    fe__motion motion = fe__path_motion(s->step, obstacle->body, s->begin, s->end, s->base);
    fe__mobile other = fe__mobile_of_shape(s->step, obstacle, &motion);
    for (int32_t i = w->bodies[s->body].first_shape; i >= 0; i = w->shapes[i].next) {
        const fe__shape *own = w->shapes + i;
        if (own->flags & FE__SHAPE_TRIGGER || !is_swept(&own->form) || !fe__may_collide(w, i, shape) ||
            lets_pass(w, i, shape))
            continue;
        if (fe__form_is_field(&obstacle->form))
            try_field(s, own, obstacle, &other);
        else
            try_obstacle(s, own, obstacle, &other);
    }
}

static int32_t visit(void *context, int32_t shape)
{
    search *s = context;
    const fe_world *w = s->step->world;
    const fe__shape *obstacle = w->shapes + shape;
    int32_t dynamic = w->bodies[obstacle->body].type == FE_BODY_DYNAMIC, wanted = s->against == FE__AGAINST_DYNAMIC;
    if (dynamic != wanted || obstacle->body == s->body || obstacle->flags & FE__SHAPE_TRIGGER) return 1;
    if (!s->has_motion) s->motion = fe__path_motion(s->step, s->body, s->begin, s->end, s->base), s->has_motion = 1;
    try_shape(s, shape);
    return s->blocked <= 0;
}

static void add_place(fe__bounds *box, fe_dvec3 p, double reach)
{
    box->low = (fe_dvec3){fe__mind(box->low.x, p.x - reach), fe__mind(box->low.y, p.y - reach),
                          fe__mind(box->low.z, p.z - reach)};
    box->high = (fe_dvec3){fe__maxd(box->high.x, p.x + reach), fe__maxd(box->high.y, p.y + reach),
                           fe__maxd(box->high.z, p.z + reach)};
}

// In the tree of what moves, kinematic bodies alone are fixed
static void ask(search *s, const fe__bounds *box)
{
    const fe_world *w = s->step->world;
    int32_t fixed = s->against == FE__AGAINST_FIXED;
    if (!fixed || w->kinematic_count) fe__tree_query(&w->moving_tree, box, visit, s);
    if (!fixed || s->blocked > 0) return;
    fe__tree_query(&w->static_tree, box, visit, s);
    for (int32_t i = 0; i < w->plane_count && s->blocked <= 0; ++i) visit(s, w->planes[i]);
}

static search begin(const fe__step *step, int32_t body, int32_t against)
{
    return (search){.step = step,
                    .body = body,
                    .against = against,
                    .base = fe__centre_of(step->world->bodies + body),
                    .end = 1.0,
                    .s = 2.0,
                    .first = {.body = -1},
                    .blocked = -1};
}

static int32_t anything_fixed(const fe_world *w)
{
    return w->static_tree.proxy_count || w->plane_count || w->kinematic_count;
}

int32_t fe__path_is_blocked(const fe__step *step, int32_t body, int32_t against)
{
    if (against == FE__AGAINST_FIXED && !anything_fixed(step->world)) return 0;
    const fe__body *b = step->world->bodies + body;
    search s = begin(step, body, against);
    int32_t legs = fe__path_legs(step, body);
    double reach = (double)b->reach;
    fe__bounds box = {fe__centre_of(b), fe__centre_of(b)};
    for (int32_t leg = 0; leg <= legs; ++leg)
        add_place(&box, fe__dadd(s.base, fe__path_place(step, body, leg).centre), reach);
    s.blocked = 0;
    ask(&s, &box);
    return s.blocked;
}

fe__obstacle fe__first_obstacle(const fe__step *step, int32_t body, int32_t against, const fe__shift *from,
                                const fe__shift *to, double begins, double ends)
{
    const fe__body *b = step->world->bodies + body;
    search s = begin(step, body, against);
    double reach = (double)b->reach;
    s.motion = fe__motion_of_shifts(b, from, to, s.base);
    s.has_motion = 1;
    s.begin = begins, s.end = ends;
    fe_dvec3 at = fe__dadd(s.base, from->centre);
    fe__bounds box = {at, at};
    add_place(&box, at, reach);
    add_place(&box, fe__dadd(s.base, to->centre), reach);
    ask(&s, &box);
    return s.first;
}

int32_t fe__paths_cross(const fe__step *step, int32_t shape_a, int32_t shape_b)
{
    const fe_world *w = step->world;
    const fe__shape *a = w->shapes + shape_a, *b = w->shapes + shape_b;
    int32_t body = fe__path_legs(step, a->body) > fe__path_legs(step, b->body) ? a->body : b->body,
            legs = fe__path_legs(step, body);
    fe_dvec3 base = fe__centre_of(w->bodies + body);
    for (int32_t leg = 0; leg < legs; ++leg) {
        double begins = fe__path_time(step, body, leg), ends = fe__path_time(step, body, leg + 1);
        fe__motion motion_a = fe__path_motion(step, a->body, begins, ends, base),
                   motion_b = fe__path_motion(step, b->body, begins, ends, base);
        fe__mobile mobile_a = fe__mobile_of_shape(step, a, &motion_a),
                   mobile_b = fe__mobile_of_shape(step, b, &motion_b);
        fe__impact impact;
        if (fe__time_of_impact(&mobile_a, &mobile_b, 1.0, &impact) != FE_MEET_NEVER) return 1;
    }
    return 0;
}
