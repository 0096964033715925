// continuous.c - the stage between solver and finalize: bodies that outran their thickness end where something stood in the way.
//
// Most impacts are the solver's: contacts are found ahead of time (narrow.c). What it misses - a body that turned or was deflected within
// the step, that has no contact where it came to - is found here, on the way that the body really took, and changes its motion in the
// solver's lines: up to the touch, then along the surface. Velocities stay, so that the next step has a contact with the speed of the
// impact: it bounces, slides and tells its events as any other. Only the work of gravity on the way not gone is given back.
//
// Against static and kinematic bodies each body is its own. Bullets come after, against where the dynamic bodies now go; all see the same.
#include "continuous/continuous.h"
#include "continuous/energy.h"
#include "continuous/rejoin.h"
#include "continuous/motion_path.h"

enum { BODIES_IN_BLOCK = 256, CHASES_IN_BLOCK = 4, MOST_STOPS = 4, SLIDE_SWEEPS = 8 };

// ---- who is fast ------------------------------------------------------------------------------------------------------------------
static void add_chased(fe__step_scratch *s, fe__body *body, int32_t index)
{
    body->flags |= FE__BODY_CHASED;
    s->chased[atomic_fetch_add_explicit(&s->chased_count, 1, memory_order_relaxed)] = index;
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
            int32_t fast = w->solver.trail_count[body->line] != FE__NO_TRAIL || fe__way_length(step, index) > body->thickness;
            if (fast && fe__motion_makes_sense(&w->solver, body->line)) add_chased(s, body, index);
        } else if (body->contact_count && fe__way_length(step, index) > 0.0f) {
            s->chased[s->kinematic_room + atomic_fetch_add_explicit(&s->kinematic_count, 1, memory_order_relaxed)] = index;
        }
    }
}

static float thinner(const fe__body *a, const fe__body *b) { return fe__minf(a->thickness, b->thickness); }

// Slow bodies that a kinematic one may have passed through
static void add_partners(fe__step *step, int32_t kinematic)
{
    fe_world *w = step->world;
    float length = fe__way_length(step, kinematic);
    for (int32_t pair = w->bodies[kinematic].first_contact; pair >= 0; pair = fe__next_pair(w, pair, kinematic)) {
        const fe__pair *p = w->pairs + pair;
        int32_t other = p->body_a == kinematic ? p->body_b : p->body_a;
        fe__body *body = w->bodies + other;
        if (p->flags & FE__PAIR_SENSOR || body->type != FE_BODY_DYNAMIC || body->awake_index < 0 || body->flags & FE__BODY_CHASED) continue;
        if (length + fe__way_length(step, other) <= body->thickness) continue;
        if (fe__motion_makes_sense(&w->solver, body->line)) add_chased(step->scratch, body, other);
    }
}

// ---- one body ---------------------------------------------------------------------------------------------------------------------
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
    fe_dvec3 base = {body->centre[0], body->centre[1], body->centre[2]};
    fe__motion m = fe__way_between(step, o->body, o->time, 1.0, base);
    fe__pose end = fe__motion_at(&m, 1.0);
    fe_dvec3 arm = fe__dsub(fe__dsub(o->point, base), m.centre);
    fe_dvec3 turned = fe__drotate(end.rotation, fe__drotate_back(m.rotation, arm));
    return fe__ddot(o->normal, fe__dadd(m.translation, fe__dsub(turned, arm)));
}

// The part of a way that no obstacle forbids: projected on one after the other until all agree, or nearly
static fe_dvec3 allowed(const slide *s, fe_dvec3 way)
{
    for (int32_t sweep = 0; sweep < SLIDE_SWEEPS; ++sweep) {
        for (int32_t i = 0; i < s->count; ++i) {
            double over = fe__ddot(s->normal[i], way) - s->room[i];
            if (over > 0.0) way = fe__dsub(way, fe__dscale(over, s->normal[i]));
        }
    }
    return way;
}

// The part of a normal along which the body can move at all
static fe_dvec3 free_part(const fe__body *b, fe_dvec3 normal)
{
    const uint32_t locks = (uint32_t)b->lock_bits;
    return (fe_dvec3){locks & FE_AXIS_X ? 0.0 : normal.x, locks & FE_AXIS_Y ? 0.0 : normal.y, locks & FE_AXIS_Z ? 0.0 : normal.z};
}

// At an obstacle: the body goes on along it, and at the first one on turning too, unless that presses the touched point in.
static void deflect(const fe__step *step, int32_t body, slide *s, const fe__obstacle *o, const fe__shift *at, fe__shift *end)
{
    const fe__body *b = step->world->bodies + body;
    fe_dvec3 normal = free_part(b, o->normal);
    double length = sqrt(fe__ddot(normal, normal)); // 0: it cannot move off, nor against it
    s->normal[s->count] = length > 0.0 ? fe__dscale(1.0 / length, normal) : normal;
    s->room[s->count++] = length > 0.0 ? room_of(step, o) / length : 0.0;
    s->carried |= step->world->bodies[o->body].type != FE_BODY_STATIC;
    end->centre = fe__dadd(at->centre, allowed(s, fe__dsub(end->centre, at->centre)));
    fe_dvec3 base = {b->centre[0], b->centre[1], b->centre[2]};
    fe__motion rest = fe__way_from(b, at, end, base);
    fe_dvec3 axis = {(double)rest.turn.x, (double)rest.turn.y, (double)rest.turn.z};
    fe_dvec3 arm = fe__dsub(o->point, fe__dadd(base, at->centre));
    if (s->count > 1 || fe__ddot(o->normal, fe__dcross(axis, arm)) > 0.0) end->turn = at->turn;
}

// From `at` (time `now`) towards `end`; returns where it came to.
static fe__shift go_on(const fe__step *step, int32_t body, int32_t against, fe__obstacle o, fe__shift at, fe__shift end, int32_t *carried)
{
    slide s = {.count = 0};
    for (;;) {
        deflect(step, body, &s, &o, &at, &end);
        double now = o.time;
        o = fe__way_meets(step, body, against, &at, &end, now, 1.0);
        *carried = s.carried;
        if (o.body < 0) return end;
        fe__shift stop = fe__shift_between(&at, &end, (o.time - now) / (1.0 - now));
        if (s.count == MOST_STOPS || fe__ddot(o.normal, o.normal) == 0.0) return stop;
        at = stop;
    }
}

// A turn not made leaves the spin as the body has it in its own frame: turned with the world's, it would be another energy
static void turn_spin(const fe__motion_line *motion, const fe__shift *end, float *spin)
{
    fe_quat missing = fe__product(fe__quat_of(motion->rotation), fe__conjugate(end->turn));
    fe_vec3 w = fe__rotate_back(fe__normalized(missing), fe__vec3(spin[0], spin[1], spin[2]));
    spin[0] = w.x, spin[1] = w.y, spin[2] = w.z;
}

static void write_chase(const fe__step *step, const fe__body *body, const fe__shift *end, int32_t carried, fe__chase *chase)
{
    const fe__solver *s = &step->world->solver;
    chase->motion = s->motion[body->line];
    chase->velocity = s->velocity[body->line];
    if (!body->locked) turn_spin(&chase->motion, end, chase->velocity.w);
    fe_vec3 p = fe__narrow(end->centre);
    if (!carried) fe__give_back(step->world, body, fe__sub(p, fe__quad_vector(chase->motion.shift)), chase->velocity.v);
    chase->motion = (fe__motion_line){{p.x, p.y, p.z}, chase->motion.gyroscopic, {end->turn.x, end->turn.y, end->turn.z, end->turn.w}};
    chase->stopped = 1;
}

// Follows a body on its legs until something stands there
static void follow(const fe__step *step, int32_t body, int32_t against, fe__chase *chase)
{
    chase->stopped = 0;
    if (!fe__way_is_barred(step, body, against)) return;
    int32_t legs = fe__way_legs(step, body);
    for (int32_t leg = 0; leg < legs; ++leg) {
        double begin = fe__way_time(step, body, leg), end = fe__way_time(step, body, leg + 1);
        fe__shift from = fe__way_at(step, body, begin), to = fe__way_at(step, body, end);
        fe__obstacle o = fe__way_meets(step, body, against, &from, &to, begin, end);
        if (o.body < 0) continue;
        int32_t carried = step->world->bodies[o.body].type != FE_BODY_STATIC;
        fe__shift stop = fe__shift_between(&from, &to, (o.time - begin) / (end - begin)), last = fe__way_at(step, body, 1.0);
        if (fe__ddot(o.normal, o.normal) > 0.0 && o.time < 1.0) stop = go_on(step, body, against, o, stop, last, &carried);
        write_chase(step, step->world->bodies + body, &stop, carried, chase);
        return;
    }
}

// Its way is now the straight one.
static void apply_chase(fe_world *w, int32_t body, const fe__chase *chase)
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
    follow(step, body, FE__AGAINST_FIXED, &chase);
    apply_chase(step->world, body, &chase);
    if (chase.stopped && step->world->bodies[body].first_joint) step->world->bodies[body].flags |= FE__BODY_HELD;
    return chase.stopped;
}

static void stop_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        fe__limit_energy(step, step->scratch->chased[i]);
        fe__stop_body(step, step->scratch->chased[i]);
    }
}

static int32_t is_bullet(const fe_world *w, int32_t body) { return (w->bodies[body].flags & FE__BODY_BULLET) != 0; }

static void bullet_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        int32_t body = step->scratch->chased[i];
        if (is_bullet(step->world, body)) follow(step, body, FE__AGAINST_DYNAMIC, step->scratch->chases + i);
    }
}

// ---- triggers ---------------------------------------------------------------------------------------------------------------------
// What was passed between two steps was touched: its enter comes in this step, its exit in the next.
static void cross_triggers(const fe__step *step, int32_t body)
{
    fe_world *w = step->world;
    float length = fe__way_length(step, body);
    for (int32_t pair = w->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(w, pair, body)) {
        fe__pair *p = w->pairs + pair;
        const fe__body *a = w->bodies + p->body_a, *b = w->bodies + p->body_b;
        if (!(p->flags & FE__PAIR_SENSOR) || p->flags & (FE__PAIR_CROSSED | FE__PAIR_PATCH)) continue;
        if (length + fe__way_length(step, p->body_a == body ? p->body_b : p->body_a) <= thinner(a, b)) continue;
        int32_t field = FE_GEOMETRY_HEIGHTFIELD;
        if (w->shapes[p->shape_a].form.type == field || w->shapes[p->shape_b].form.type == field) continue;
        if (fe__ways_cross(step, p->shape_a, p->shape_b)) p->flags |= FE__PAIR_CROSSED;
    }
}

void fe__stop_fast_bodies(fe__step *step)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    atomic_store(&s->chased_count, 0);
    atomic_store(&s->kinematic_count, 0);
    s->kinematic_room = w->awake_body_count;
    fe__parallel_for(&w->workers, w->awake_body_count, BODIES_IN_BLOCK, select_block, step);
    int32_t kinematic = atomic_load(&s->kinematic_count);
    for (int32_t i = 0; i < kinematic; ++i) add_partners(step, s->chased[s->kinematic_room + i]);
    int32_t count = atomic_load(&s->chased_count), bullets = 0;
    if (count + kinematic == 0) return;
    fe__parallel_for(&w->workers, count, CHASES_IN_BLOCK, stop_block, step);
    fe__rejoin_trees(step);
    for (int32_t i = 0; i < count; ++i) bullets += is_bullet(w, s->chased[i]);
    if (bullets) fe__parallel_for(&w->workers, count, CHASES_IN_BLOCK, bullet_block, step);
    for (int32_t i = 0; i < count; ++i) {
        w->bodies[s->chased[i]].flags &= ~(uint32_t)FE__BODY_CHASED;
        if (is_bullet(w, s->chased[i])) apply_chase(w, s->chased[i], s->chases + i);
    }
    for (int32_t i = 0; i < count; ++i) cross_triggers(step, s->chased[i]);
    for (int32_t i = 0; i < kinematic; ++i) cross_triggers(step, s->chased[s->kinematic_room + i]);
}
