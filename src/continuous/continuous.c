// continuous.c - the stage between solver and finalize: bodies that outran their thickness end where something stood in
// the way.
//
// Most impacts are the solver's: contacts are found ahead of time (narrow.c). What it misses - a body that turned or
// was deflected within the step, that has no contact where it came to - is found here, on the body's motion path, and
// changes its motion in the solver's lines: up to the touch, then along the surface. Velocities stay, so that the next
// step has a contact with the speed of the impact: it bounces, slides and reports its events as any other. Only the
// work of gravity on the path not gone is given back.
//
// Against static and kinematic bodies each body is its own. Bullets come after, against where the dynamic bodies now
// go; all see the same.
#define FE_W 4
#include "continuous/continuous.h"

#include "continuous/chase.h"
#include "continuous/energy.h"
#include "continuous/obstacle.h"
#include "continuous/rejoin.h"
#include "solver/motion_check.h"
#include "world/pair_list.h"
#include "world/pairs.h"

enum { BODIES_IN_BLOCK = 256, CHASES_IN_BLOCK = 4 };

// ---- who is fast ---------------------------------------------------------------------------------------------------
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
            int32_t fast =
                w->solver.trail_count[body->line] != FE__NO_TRAIL || fe__path_length(step, index) > body->thickness;
            if (fast && fe__motion_makes_sense(&w->solver, body->line)) add_chased(s, body, index);
        } else if (body->contact_count && fe__path_length(step, index) > 0.0f) {
            s->chased[s->kinematic_room + atomic_fetch_add_explicit(&s->kinematic_count, 1, memory_order_relaxed)] =
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
        if (is_bullet(step->world, body)) fe__chase_body(step, body, FE__AGAINST_DYNAMIC, step->scratch->chases + i);
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
        if (is_bullet(w, s->chased[i])) fe__apply_chase(w, s->chased[i], s->chases + i);
    }
    if (!w->trigger_pair_count) return;
    for (int32_t i = 0; i < count; ++i) cross_triggers(step, s->chased[i]);
    for (int32_t i = 0; i < kinematic; ++i) cross_triggers(step, s->chased[s->kinematic_room + i]);
}
