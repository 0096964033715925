// continuous.c - the stage between solver and finalize: bodies that outran their thickness end at what they met on the
// way.
//
// Most impacts are the solver's: contacts are found ahead of time (narrowphase.c). Impacts that it misses, of a body
// that turned or was deflected within the step and has no contact where it came to, are found here on the body's motion
// path. Its motion in the solver's lines then goes up to the touch, and on along the surface. Velocities stay, so that
// the next step has a contact with the speed of the impact: it bounces, slides and reports its events as any other.
// Only the work of gravity on the path not gone is given back. Against static and kinematic bodies each body is swept
// by itself. Bullets come after, against where the dynamic bodies now go; all see the same.
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

// ---- search for obstacles -------------------------------------------------------------------------------------------
// A body meets an obstacle where one of its shapes would dip into it by more than a share of its thickness: what the
// solver lets overlap, rests or slides is never met. On any thread: nothing of the world is written.

enum against { AGAINST_FIXED, AGAINST_DYNAMIC }; // static and kinematic bodies; dynamic ones

// Share of its thickness by which a shape may dip into another as it moves. A body whose middle stays out of the other
// by more than three quarters of its half width is pushed out on the side it came from.
#define DIP 0.25f
// A search goes on so much beyond the first impact found, as a share of its time: of two at once the shape created
// first counts.
#define BEYOND 1e-9
// More than the distance at which two forms count as touching, and than the roundings of a plane, m
#define FAR 0.001

typedef struct obstacle {
    double time;     // time of the step when the whole shape touches
    fe_dvec3 normal; // unit, from the body to the obstacle; 0: not known
    fe_dvec3 point;  // the point that is touched
    int32_t body;    // -1: nothing is met
} obstacle;

// A leg of a body's path, as it is carried through the trees
typedef struct search {
    const fe__step *step;
    int32_t body, against;
    fe_dvec3 base;
    double begin, end;
    fe__motion motion;
    int32_t has_motion; // 0: it is computed when the first obstacle needs it
    double s;           // time of the first impact so far, in parts of the leg; 1 and more: none
    uint64_t serial;    // serial of the shape there
    obstacle first;
    int32_t blocked; // -1: looks for the first impact; else whether anything may be met at all
} search;

static fe__form dipped(const fe__form *form) { return fe__form_shrunk(form, DIP * fe__form_thickness(form)); }

// The dipped form decides whether there is an impact, the whole one when.
static void find_impact(search *s, const fe__shape *own, const fe__shape *met, const fe__mobile *other)
{
    fe__form thin = dipped(&own->form);
    fe__mobile mover = fe__mobile_of_shape(s->step, own, &s->motion);
    fe__impact deep, touch;
    mover.form = &thin;
    double limit = fe__mind(1.0, s->s * (1.0 + BEYOND));
    if (fe__time_of_impact(&mover, other, limit, &deep) != FE_MEET_LATER) return;
    if (deep.s > s->s || (deep.s == s->s && s->serial < met->serial)) return;
    mover.form = &own->form;
    if (fe__time_of_impact(&mover, other, deep.s, &touch) == FE_MEET_NEVER) touch = deep;
    if (touch.overlap) { // boxes that overlapped a little when the leg began
        fe__gap gap;
        fe__pose a = fe__mobile_at(&mover, 0.0), b = fe__mobile_at(other, 0.0);
        fe__form_gap(&thin, &a, other->form, &b, &gap);
        touch.normal = gap.normal, touch.on_b = gap.on_b;
    }
    s->s = deep.s;
    s->serial = met->serial;
    s->first =
        (obstacle){s->begin + touch.s * (s->end - s->begin), touch.normal, fe__dadd(s->base, touch.on_b), met->body};
}

// 1: some leg closes the gap at its start. If none does, the plane across the shortest distance separates them for the
// whole step.
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

static void try_obstacle(search *s, const fe__shape *own, const fe__shape *met, const fe__mobile *other)
{
    if (s->blocked < 0)
        find_impact(s, own, met, other);
    else
        s->blocked |= s->step->world->bodies[met->body].type != FE_BODY_STATIC || may_close(s, own, other);
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

// 1: on its way by `travel` the body's centre stays farther than `reach` over the triangle's plane, with the normal
// `up` of any length, through v in the frame of that centre. Nothing of the body meets a triangle that far off.
static int32_t stays_off(fe_dvec3 up, fe_dvec3 v, fe_dvec3 travel, double reach)
{
    double length = sqrt(fe__ddot(up, up)), height = -fe__ddot(up, v), after = height + fe__ddot(up, travel);
    return fe__mind(fe__absd(height), fe__absd(after)) > (reach + FAR) * length && height * after > 0.0;
}

static void add_place(fe__bounds *box, fe_dvec3 p, double reach)
{
    box->low = (fe_dvec3){fe__mind(box->low.x, p.x - reach), fe__mind(box->low.y, p.y - reach),
                          fe__mind(box->low.z, p.z - reach)};
    box->high = (fe_dvec3){fe__maxd(box->high.x, p.x + reach), fe__maxd(box->high.y, p.y + reach),
                           fe__maxd(box->high.z, p.z + reach)};
}

// Tries the triangles under the leg that look at the body's centre: the other side does not count.
static void try_field(search *s, const fe__shape *own, const fe__shape *field, const fe__mobile *other)
{
    const fe_world *world = s->step->world;
    fe__ground surface = fe__store_ground(world->store, &field->form);
    fe__pose pose = fe__mobile_at(other, 0.0);
    fe_dvec3 travel = fe__dsub(s->motion.translation, other->motion.translation);
    fe_dvec3 from = fe__drotate_back(pose.rotation, fe__dsub(s->motion.centre, pose.position));
    fe_dvec3 to = fe__dadd(from, fe__drotate_back(pose.rotation, travel)), way = fe__dsub(to, from);
    double reach = (double)world->bodies[s->body].reach + turning_past(&s->motion, other);
    fe__bounds box = {from, from};
    add_place(&box, from, reach);
    add_place(&box, to, reach);
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
        if (fe__dot(up, v[0]) < 0.0f || fe__ground_is_two_sided(&surface)) // the centre is at the walk's origin
            try_obstacle(s, own, field, &part);
    }
}

// 1: the pair filter refused the two, or one is on its way through the other.
static int32_t lets_pass(const fe_world *world, int32_t shape_a, int32_t shape_b)
{
    uint32_t flags = world->shapes[shape_a].flags | world->shapes[shape_b].flags;
    if (!(flags & (FE__SHAPE_JUDGED | FE__SHAPE_ONE_WAY))) return 0;
    int32_t pair = fe__pair_set_find(&world->pair_set, shape_a, shape_b);
    return pair >= 0 && world->pairs[pair].flags & (FE__PAIR_DENIED | FE__PAIR_PASSING);
}

static int32_t visit(void *context, int32_t shape)
{
    search *s = context;
    const fe_world *world = s->step->world;
    const fe__shape *met = world->shapes + shape;
    int32_t is_dynamic = world->bodies[met->body].type == FE_BODY_DYNAMIC;
    if (is_dynamic != (s->against == AGAINST_DYNAMIC) || met->body == s->body || met->flags & FE__SHAPE_TRIGGER)
        return 1;
    if (!s->has_motion) s->motion = fe__path_motion(s->step, s->body, s->begin, s->end, s->base), s->has_motion = 1;
    fe__motion motion = fe__path_motion(s->step, met->body, s->begin, s->end, s->base);
    fe__mobile other = fe__mobile_of_shape(s->step, met, &motion);
    for (int32_t i = world->bodies[s->body].first_shape; i >= 0; i = world->shapes[i].next) {
        const fe__shape *own = world->shapes + i;
        // meshes that a kinematic body carries are not swept, and of a compound its parts are
        if (own->flags & FE__SHAPE_TRIGGER || fe__form_is_static_only(&own->form) || fe__form_is_of_parts(&own->form) ||
            !fe__may_collide(world, i, shape) || lets_pass(world, i, shape))
            continue;
        if (fe__form_is_field(&met->form))
            try_field(s, own, met, &other);
        else
            try_obstacle(s, own, met, &other);
    }
    return s->blocked <= 0;
}

static void search_trees(search *s, const fe__bounds *box)
{
    const fe_world *world = s->step->world;
    int32_t is_fixed = s->against == AGAINST_FIXED; // in the moving tree, kinematic bodies alone are
    if (!is_fixed || world->kinematic_count) fe__tree_query(&world->moving_tree, box, visit, s);
    if (!is_fixed || s->blocked > 0) return;
    fe__tree_query(&world->static_tree, box, visit, s);
    for (int32_t i = 0; i < world->plane_count && s->blocked <= 0; ++i) visit(s, world->planes[i]);
}

static search begin_search(const fe__step *step, int32_t body, int32_t against)
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

// 1: the body's path may meet something. Cheap, and too often 1.
static int32_t is_path_blocked(const fe__step *step, int32_t body, int32_t against)
{
    const fe_world *world = step->world;
    int32_t any_fixed = world->static_tree.proxy_count || world->plane_count || world->kinematic_count;
    if (against == AGAINST_FIXED && !any_fixed) return 0;
    search s = begin_search(step, body, against);
    int32_t legs = fe__path_legs(step, body);
    fe__bounds box = {s.base, s.base};
    for (int32_t leg = 0; leg <= legs; ++leg)
        add_place(&box, fe__dadd(s.base, fe__path_place(step, body, leg).centre), (double)world->bodies[body].reach);
    s.blocked = 0;
    search_trees(&s, &box);
    return s.blocked;
}

// Finds the first obstacle on the body's motion from `from` to `to`, between two times of the step.
static obstacle find_first_obstacle(const fe__step *step, int32_t body, int32_t against, const fe__shift *from,
                                    const fe__shift *to, double begin, double end)
{
    const fe__body *b = step->world->bodies + body;
    search s = begin_search(step, body, against);
    s.motion = fe__motion_of_shifts(b, from, to, s.base);
    s.has_motion = 1;
    s.begin = begin, s.end = end;
    fe_dvec3 at = fe__dadd(s.base, from->centre);
    fe__bounds box = {at, at};
    add_place(&box, at, (double)b->reach);
    add_place(&box, fe__dadd(s.base, to->centre), (double)b->reach);
    search_trees(&s, &box);
    return s.first;
}

// ---- sweep of a body ------------------------------------------------------------------------------------------------

enum { MOST_STOPS = 4, SLIDE_SWEEPS = 8 };

// The obstacles that a body met so far
typedef struct slide {
    fe_dvec3 normal[MOST_STOPS];
    double gives_way[MOST_STOPS]; // along the normal, how far the obstacle goes until the end of the step, m
    int32_t count, is_carried;    // is_carried: 1: an obstacle moves
} slide;

// How far the obstacle's point goes along the normal from now to the end of the step
static double way_of_obstacle(const fe__step *step, const obstacle *o)
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
static fe_dvec3 project_on_obstacles(const slide *s, fe_dvec3 shift)
{
    for (int32_t sweep = 0; sweep < SLIDE_SWEEPS; ++sweep) {
        for (int32_t i = 0; i < s->count; ++i) {
            double over = fe__ddot(s->normal[i], shift) - s->gives_way[i];
            if (over > 0.0) shift = fe__dsub(shift, fe__dscale(over, s->normal[i]));
        }
    }
    return shift;
}

// Turns the rest of the motion, from `at` to *end, along the obstacle. At the first one the body goes on turning too,
// unless that presses the touched point in.
static void deflect(const fe__step *step, int32_t body, slide *s, const obstacle *o, const fe__shift *at,
                    fe__shift *end)
{
    const fe__body *b = step->world->bodies + body;
    const uint32_t locks = (uint32_t)b->lock_bits;
    // the part of the normal along which the body can move at all
    fe_dvec3 normal = {locks & FE_AXIS_X ? 0.0 : o->normal.x, locks & FE_AXIS_Y ? 0.0 : o->normal.y,
                       locks & FE_AXIS_Z ? 0.0 : o->normal.z};
    double length = sqrt(fe__ddot(normal, normal)); // 0: it cannot move off, nor against it
    s->normal[s->count] = length > 0.0 ? fe__dscale(1.0 / length, normal) : normal;
    s->gives_way[s->count++] = length > 0.0 ? way_of_obstacle(step, o) / length : 0.0;
    s->is_carried |= step->world->bodies[o->body].type != FE_BODY_STATIC;
    end->centre = fe__dadd(at->centre, project_on_obstacles(s, fe__dsub(end->centre, at->centre)));
    fe_dvec3 base = fe__centre_of(b);
    fe__motion rest = fe__motion_of_shifts(b, at, end, base);
    fe_dvec3 axis = {(double)rest.angular_displacement.x, (double)rest.angular_displacement.y,
                     (double)rest.angular_displacement.z};
    fe_dvec3 arm = fe__dsub(o->point, fe__dadd(base, at->centre));
    if (s->count > 1 || fe__ddot(o->normal, fe__dcross(axis, arm)) > 0.0) end->rotation = at->rotation;
}

// Goes on from an obstacle at `at` towards `end`, along what it meets. Returns where the body comes to.
static fe__shift slide_on(const fe__step *step, int32_t body, int32_t against, obstacle o, fe__shift at, fe__shift end,
                          int32_t *is_carried)
{
    slide s = {.count = 0};
    for (;;) {
        deflect(step, body, &s, &o, &at, &end);
        double now = o.time;
        o = find_first_obstacle(step, body, against, &at, &end, now, 1.0);
        *is_carried = s.is_carried;
        if (o.body < 0) return end;
        fe__shift stop = fe__shift_between(&at, &end, (o.time - now) / (1.0 - now));
        if (s.count == MOST_STOPS || fe__ddot(o.normal, o.normal) == 0.0) return stop;
        at = stop;
    }
}

static void write_sweep(const fe__step *step, const fe__body *body, const fe__shift *end, int32_t is_carried,
                        fe__sweep_end *out)
{
    const fe__solver *solver = &step->world->solver;
    fe__motion_line motion = solver->motion[body->line];
    out->velocity = solver->velocity[body->line];
    if (!body->locked) {
        // A rotation not made leaves the spin as the body has it in its own frame: turned with the world's, it would be
        // another energy.
        fe_quat missing = fe__product(fe__quat_of(motion.rotation), fe__conjugate(end->rotation));
        fe_vec3 w = fe__rotate_back(fe__normalized(missing), fe__quad_vector(out->velocity.w));
        out->velocity.w[0] = w.x, out->velocity.w[1] = w.y, out->velocity.w[2] = w.z;
    }
    fe_vec3 p = fe__narrow(end->centre);
    if (!is_carried) fe__give_back(step->world, body, fe__sub(p, fe__quad_vector(motion.shift)), out->velocity.v);
    out->motion = (fe__motion_line){{p.x, p.y, p.z},
                                    motion.gyroscopic,
                                    {end->rotation.x, end->rotation.y, end->rotation.z, end->rotation.w}};
    out->stopped = 1;
}

// Follows a body on its motion path until an obstacle of that sort. On any thread: writes *out only.
static void sweep_body(const fe__step *step, int32_t body, int32_t against, fe__sweep_end *out)
{
    out->stopped = 0;
    if (!is_path_blocked(step, body, against)) return;
    int32_t legs = fe__path_legs(step, body);
    for (int32_t leg = 0; leg < legs; ++leg) {
        double begin = fe__path_time(step, body, leg), end = fe__path_time(step, body, leg + 1);
        fe__shift from = fe__path_at(step, body, begin), to = fe__path_at(step, body, end);
        obstacle o = find_first_obstacle(step, body, against, &from, &to, begin, end);
        if (o.body < 0) continue;
        int32_t is_carried = step->world->bodies[o.body].type != FE_BODY_STATIC;
        fe__shift stop = fe__shift_between(&from, &to, (o.time - begin) / (end - begin)),
                  last = fe__path_at(step, body, 1.0);
        if (fe__ddot(o.normal, o.normal) > 0.0 && o.time < 1.0)
            stop = slide_on(step, body, against, o, stop, last, &is_carried);
        write_sweep(step, step->world->bodies + body, &stop, is_carried, out);
        return;
    }
}

// Writes a sweep's end to the solver's lines. The body's motion path is straight from now on.
static void apply_sweep(fe_world *world, int32_t body, const fe__sweep_end *end)
{
    if (!end->stopped) return;
    int32_t line = world->bodies[body].line;
    world->solver.motion[line] = end->motion;
    world->solver.velocity[line] = end->velocity;
    world->solver.trail_count[line] = FE__NO_TRAIL;
}

int32_t fe__stop_body(const fe__step *step, int32_t body)
{
    fe__sweep_end end;
    sweep_body(step, body, AGAINST_FIXED, &end);
    apply_sweep(step->world, body, &end);
    if (end.stopped && step->world->bodies[body].first_joint) step->world->bodies[body].flags |= FE__BODY_HELD;
    return end.stopped;
}

// ---- stage ----------------------------------------------------------------------------------------------------------

enum { BODIES_IN_BLOCK = 256, SWEEPS_IN_BLOCK = 4 };

static int32_t is_bullet(const fe_world *world, int32_t body)
{
    return (world->bodies[body].flags & FE__BODY_BULLET) != 0;
}

static void add_swept(fe__step_scratch *scratch, fe__body *body, int32_t index)
{
    body->flags |= FE__BODY_CHASED;
    scratch->swept[atomic_fetch_add_explicit(&scratch->swept_count, 1, memory_order_relaxed)] = index;
}

// Lists the dynamic bodies that are fast, and the kinematic ones that move.
static void select_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        int32_t index = world->awake_bodies[i];
        fe__body *body = world->bodies + index;
        if (body->type == FE_BODY_DYNAMIC) {
            int32_t is_fast =
                world->solver.trail_count[body->line] != FE__NO_TRAIL || fe__path_length(step, index) > body->thickness;
            if (is_fast && fe__motion_makes_sense(&world->solver, body->line)) add_swept(scratch, body, index);
        } else if (body->contact_count && fe__path_length(step, index) > 0.0f) {
            int32_t place = atomic_fetch_add_explicit(&scratch->kinematic_count, 1, memory_order_relaxed);
            scratch->swept[scratch->first_kinematic + place] = index;
        }
    }
}

// Lists slow bodies that a kinematic one may have passed through.
static void add_partners(const fe__step *step, int32_t kinematic)
{
    fe_world *world = step->world;
    float length = fe__path_length(step, kinematic);
    for (int32_t pair = world->bodies[kinematic].first_contact; pair >= 0;
         pair = fe__next_pair(world, pair, kinematic)) {
        const fe__pair *p = world->pairs + pair;
        int32_t other = p->body_a == kinematic ? p->body_b : p->body_a;
        fe__body *body = world->bodies + other;
        if (p->flags & (FE__PAIR_SENSOR | FE__PAIR_DENIED | FE__PAIR_PASSING) || body->type != FE_BODY_DYNAMIC ||
            body->awake_index < 0 || body->flags & FE__BODY_CHASED)
            continue;
        if (length + fe__path_length(step, other) <= body->thickness) continue;
        if (fe__motion_makes_sense(&world->solver, body->line)) add_swept(step->scratch, body, other);
    }
}

static void stop_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        fe__limit_energy(step, step->scratch->swept[i]);
        fe__stop_body(step, step->scratch->swept[i]);
    }
}

static void bullet_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        int32_t body = step->scratch->swept[i];
        if (is_bullet(step->world, body)) sweep_body(step, body, AGAINST_DYNAMIC, step->scratch->sweep_ends + i);
    }
}

// 1: two shapes, neither a heightfield, touch on their bodies' motion paths.
static int32_t paths_cross(const fe__step *step, int32_t shape_a, int32_t shape_b)
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

// A trigger that the body passed between two steps was touched: its enter comes in this step, its exit in the next.
static void cross_triggers(const fe__step *step, int32_t body)
{
    fe_world *world = step->world;
    float length = fe__path_length(step, body);
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) {
        fe__pair *p = world->pairs + pair;
        const fe__body *a = world->bodies + p->body_a, *b = world->bodies + p->body_b;
        if (!(p->flags & FE__PAIR_SENSOR) || p->flags & (FE__PAIR_CROSSED | FE__PAIR_PATCH)) continue;
        float lengths = length + fe__path_length(step, p->body_a == body ? p->body_b : p->body_a);
        if (lengths <= fe__minf(a->thickness, b->thickness)) continue;
        if (fe__is_field_pair(world, p->shape_a, p->shape_b)) continue;
        if (paths_cross(step, p->shape_a, p->shape_b)) p->flags |= FE__PAIR_CROSSED;
    }
}

void fe__stop_fast_bodies(fe__step *step)
{
    fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    if (!world->tuning.continuous_enabled) return;
    atomic_store(&scratch->swept_count, 0);
    atomic_store(&scratch->kinematic_count, 0);
    scratch->first_kinematic = world->awake_body_count;
    const int32_t *swept = scratch->swept, *kinematic = swept + scratch->first_kinematic;
    fe__parallel_for(&world->workers, world->awake_body_count, BODIES_IN_BLOCK, select_block, step);
    int32_t kinematic_count = atomic_load(&scratch->kinematic_count);
    for (int32_t i = 0; i < kinematic_count; ++i) add_partners(step, kinematic[i]);
    int32_t count = atomic_load(&scratch->swept_count), bullets = 0;
    if (count + kinematic_count == 0) return;
    fe__parallel_for(&world->workers, count, SWEEPS_IN_BLOCK, stop_block, step);
    fe__rejoin_trees(step);
    for (int32_t i = 0; i < count; ++i) bullets += is_bullet(world, swept[i]);
    if (bullets) fe__parallel_for(&world->workers, count, SWEEPS_IN_BLOCK, bullet_block, step);
    for (int32_t i = 0; i < count; ++i) {
        world->bodies[swept[i]].flags &= ~(uint32_t)FE__BODY_CHASED;
        if (is_bullet(world, swept[i])) apply_sweep(world, swept[i], scratch->sweep_ends + i);
    }
    if (!world->trigger_pair_count) return;
    for (int32_t i = 0; i < count; ++i) cross_triggers(step, swept[i]);
    for (int32_t i = 0; i < kinematic_count; ++i) cross_triggers(step, kinematic[i]);
}
