// finalize.c - stages after the solver: poses and boxes from what the bodies did, then islands fall asleep.
//
// Each body is its own; the trees are written by the stepping thread, from a list of the shapes that left their boxes.
#define FE_W 4
#include "step/stages.h"

#include "collision/form/hull.h"
#include "core/simd.h"
#include "solver/graph/graph.h"
#include "solver/motion_check.h"
#include "world/joint.h"
#include "world/joint_creation.h"
#include "world/contact_creation.h"
#include "world/contact.h"
#include "world/body.h"
#include "world/proxies.h"
#include "world/sleep.h"

#include <float.h>
#include <string.h>

enum { BODIES_IN_BLOCK = 64, BOXES_IN_BLOCK = 64, KEPT_LINES = 256 };

// ---- poses ---------------------------------------------------------------------------------------------------------
// x y z of a quad, whose fourth lane is something else
static int32_t any_xyz(wide_mask m) { return (w_bits(m) & 7) != 0; }
static int32_t is_zero(const float *v) { return !any_xyz(*(const quad *)v != w_set(0.0f)); }

// dq q, each lane as fe__product sums it
static wide product(const float *dq, wide q)
{
    const wide x = {1.0f, -1.0f, 1.0f, -1.0f}, y = {1.0f, 1.0f, -1.0f, -1.0f}, z = {-1.0f, 1.0f, 1.0f, -1.0f};
    wide wzyx = __builtin_shufflevector(q, q, 3, 2, 1, 0), zwxy = __builtin_shufflevector(q, q, 2, 3, 0, 1);
    wide yxwz = __builtin_shufflevector(q, q, 1, 0, 3, 2);
    return dq[3] * q + dq[0] * (x * wzyx) + dq[1] * (y * zwxy) + dq[2] * (z * yxwz);
}

// q = dq q. A body that did not turn keeps its quaternion: no rounding of what stood still.
static int32_t turn(fe__body *body, const float *dq)
{
    if (is_zero(dq)) return 0;
    quad *q = (quad *)body->rotation;
    wide p = product(dq, *q);
    fe_quat unit = fe__normalized((fe_quat){p[0], p[1], p[2], p[3]});
    *q = w_flush((wide){unit.x, unit.y, unit.z, unit.w}, w_set(FE__LEAST_SPEED));
    return 1;
}

static int32_t shift(fe__body *body, const float *dp)
{
    if (is_zero(dp)) return 0;
    _Pragma("GCC unroll 3") for (int k = 0; k < 3; ++k)
    {
        double centre = body->centre[k] + (double)dp[k];
        float high = (float)centre;
        body->centre[k] = centre, body->centre_high[k] = high, body->centre_low[k] = (float)(centre - (double)high);
    }
    return 1;
}

static void place_origin(fe__body *body)
{
    if (is_zero(body->local_centre)) {
        memcpy(body->origin, body->centre, sizeof body->origin);
        return;
    }
    fe_dvec3 arm = fe__drotate(fe__rotation_of(body), fe__widen(fe__quad_vector(body->local_centre)));
    body->origin[0] = body->centre[0] - arm.x, body->origin[1] = body->centre[1] - arm.y,
    body->origin[2] = body->centre[2] - arm.z;
}

static float length_of(const float *v) { return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

// In which window of sleep_time a sleep timer is
static int32_t window_of(float timer, float window) { return (int32_t)(timer / window); }

// Slow is what has a small velocity when the step ends, and went no further in half a second, net, than at that speed.
// What is pushed out of another body moves without a velocity. What is wedged may wobble by more than that in a step,
// for ever: it comes back to where it was.
static void tick_sleep_timer(const fe_world *w, fe__body *body, fe__drift *drift, const fe__motion_line *motion,
                             float dt)
{
    const float least = 1e-5f; // s: sleep_time and dt may be 0
    float before = body->sleep_timer, threshold = body->sleep_threshold;
    body->sleep_timer = 0.0f;
    if (!(body->flags & FE__BODY_SLEEP_ALLOWED && body->speed < threshold)) return;
    float timer = before + dt, window = fe__maxf(fe__maxf(w->tuning.sleep_time, dt), least);
    if (before == 0.0f || window_of(timer, window) != window_of(before, window))
        *drift = (fe__drift){{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
    // dq = (n sin(a/2), cos(a/2)): a small turn a is twice the length of its vector
    _Pragma("GCC unroll 3") for (int k = 0; k < 3; ++k) drift->shift[k] += motion->shift[k],
        drift->turn[k] += 2.0f * motion->rotation[k];
    if (length_of(drift->shift) + length_of(drift->turn) * body->reach < threshold * window) body->sleep_timer = timer;
}

static void follow_body(fe__step *step, int32_t index)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    fe__body_place(w, index);
    for (int32_t i = w->bodies[index].first_shape; i >= 0; i = w->shapes[i].next) {
        if (!(w->shapes[i].flags & FE__SHAPE_IN_TREE)) continue;
        if (!fe__shape_is_held(w, i)) s->left[atomic_fetch_add_explicit(&s->left_count, 1, memory_order_relaxed)] = i;
    }
}

// A body that overflowed stops where it stood, and its contacts forget their impulses.
static void stop_lost(fe__step *step, fe__body *body)
{
    for (int k = 0; k < 3; ++k)
        body->velocity[k] = body->spin[k] = body->force[k] = body->torque[k] = body->relaxed[k] = 0.0f;
    body->flags |= FE__BODY_LOST;
    fe__body_note_speed(step->world, body);
    body->sleep_timer = 0.0f;
    atomic_fetch_add_explicit(&step->scratch->lost_count, 1, memory_order_relaxed);
}

static void forget_lost(fe_world *w)
{
    for (int32_t i = 0; i < w->awake_body_count; ++i) {
        fe__body *body = w->bodies + w->awake_bodies[i];
        if (!(body->flags & FE__BODY_LOST)) continue;
        body->flags &= ~(uint32_t)FE__BODY_LOST;
        for (int32_t pair = body->first_contact; pair >= 0; pair = fe__next_pair(w, pair, w->awake_bodies[i]))
            fe__pair_forget_impulses(w, pair);
        fe__body_forget_joints(w, w->awake_bodies[i]);
    }
}

// Bodies and shapes stream from memory; only its slot says where in the tree a shape is
FE_FETCHES fetch_box(const fe_world *w, int32_t i)
{
    if (i >= w->awake_body_count) return;
    int32_t shape = w->bodies[w->awake_bodies[i]].first_shape;
    if (shape >= 0) fe__tree_fetch(&w->moving_tree, shape);
}

static int32_t first_shape_of(const fe_world *w, int32_t i)
{
    return i < w->awake_body_count ? w->bodies[w->awake_bodies[i]].first_shape : -1;
}

// A hull is somewhere else: what of its shape names it, then its record, then its vertices
FE_FETCHES fetch_hulls(const fe_world *w, int32_t i)
{
    enum { SHAPES_AHEAD = 8, HULLS_AHEAD = 4, VERTICES_AHEAD = 2 };
    int32_t soon = first_shape_of(w, i + SHAPES_AHEAD), next = first_shape_of(w, i + HULLS_AHEAD),
            now = first_shape_of(w, i + VERTICES_AHEAD);
    if (soon >= 0) fe__fetch(w->shapes + soon, (unsigned)offsetof(fe__shape, local_position));
    if (next >= 0) fe__hull_form_fetch(&w->shapes[next].form);
    if (now >= 0) fe__hull_form_fetch_vertices(&w->shapes[now].form);
}

// three numbers of a quad, whose fourth is the body's own
static void take_flushed(float *out, const float *in)
{
    wide a = w_flush(*(const quad *)in, w_set(FE__LEAST_SPEED));
    a[3] = out[3];
    *(quad *)out = a;
}

// Constraints change velocities after the last substep's limit: this is the limit at the end of the step. The speed
// that is noted is no less than |v|, but for roundings.
static void limit_speed(fe__body *body, fe__odometer *odometer, float most)
{
    const float roundings = 1e-6f;
    float *v = body->velocity;
    if (body->speed < (1.0f - roundings) * most) return;
    if (!(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] > most * most)) return;
    double x = (double)v[0], y = (double)v[1], z = (double)v[2], k = (double)most / sqrt(x * x + y * y + z * z);
    v[0] = (float)(k * x), v[1] = (float)(k * y), v[2] = (float)(k * z);
    fe__note_speed(body, odometer);
}

// of joined bodies on which a gyroscopic torque acts
static void note_relaxed(const fe__solver *s, const fe__motion_line *motion, fe__body *body)
{
    if (motion->gyroscopic != (float)FE__GYROSCOPIC_JOINED) return;
    for (int k = 0; k < 3; ++k) body->relaxed[k] = body->spin[k] - s->moved_spin[body->line][k];
}

// Odometers tell nothing of who went all the way round
static void end_deferrals(fe_world *w)
{
    for (int32_t i = 0; i < w->awake_pair_count; ++i) w->awake_pairs[i] = fe__pair_of(w->awake_pairs[i]);
}

static void move_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    fe__step *step = argument;
    fe_world *w = step->world;
    float swiftest = 0.0f;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        enum { AHEAD = 4 };
        fetch_box(w, i + AHEAD);
        fetch_hulls(w, i);
        int32_t index = w->awake_bodies[i];
        fe__body *body = w->bodies + index;
        fe__odometer *odometer = w->odometers + index;
        const fe__velocity_line *velocity = w->solver.velocity + body->line;
        const fe__motion_line *motion = w->solver.motion + body->line;
        if (!fe__motion_makes_sense(&w->solver, body->line)) {
            stop_lost(step, body);
            continue;
        }
        take_flushed(body->velocity, velocity->v);
        take_flushed(body->spin, velocity->w);
        for (int k = 0; k < 3; ++k) body->force[k] = body->torque[k] = 0.0f;
        note_relaxed(&w->solver, motion, body);
        int32_t shifted = shift(body, motion->shift), turned = turn(body, motion->rotation);
        fe__note_speed(body, odometer);
        limit_speed(body, odometer, w->tuning.max_linear_speed);
        swiftest = fe__maxf(swiftest, fe__swiftness_of(body));
        tick_sleep_timer(w, body, w->drifts + index, motion, step->dt);
        if (turned) fe__odometer_turn(odometer, length_of(motion->rotation));
        if (!(shifted | turned)) continue;
        fe__odometer_place(odometer, body->centre);
        if (any_xyz(w_not(w_greater(w_set(FE__MOST_TRAVEL), w_abs(*(const quad *)motion->shift)))))
            atomic_store_explicit(&step->scratch->some_leapt, 1, memory_order_relaxed);
        body->moved_step = w->step_number + 1;
        place_origin(body);
        follow_body(step, index);
    }
    fe__note_swiftness(w, swiftest);
}

static void box_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    (void)worker;
    for (int32_t i = first; i < end; ++i)
        fe__box_scratch(step)[i] = fe__shape_fat_bounds(step->world, step->scratch->left[i]);
}

void fe__move_bodies(fe__step *step)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    atomic_store(&s->left_count, 0);
    atomic_store(&s->lost_count, 0);
    atomic_store(&s->some_leapt, 0);
    atomic_store(&w->swiftest, 0);
    fe__parallel_for(&w->workers, w->awake_body_count, BODIES_IN_BLOCK, move_block, step);
    if (atomic_load(&s->lost_count)) forget_lost(w);
    if (atomic_load(&s->some_leapt)) end_deferrals(w);
    int32_t left = atomic_load(&s->left_count);
    fe__parallel_for(&w->workers, left, BOXES_IN_BLOCK, box_block, step);
    if (left) fe__tree_move(&w->moving_tree, s->left, fe__box_scratch(step), left);
    for (int32_t i = 0; i < left; ++i) fe__shape_mark_moved(w, s->left[i]);
}

// ---- sleep ---------------------------------------------------------------------------------------------------------
static int32_t stands_still(const fe__body *body)
{
    const float *v = body->velocity, *w = body->spin;
    return v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f && w[0] == 0.0f && w[1] == 0.0f && w[2] == 0.0f;
}

// What a moving kinematic body touches or holds stays awake, however slow.
static void keep_awake(fe_world *w, int32_t kinematic, float *timers)
{
    for (int32_t pair = w->bodies[kinematic].first_contact; pair >= 0; pair = fe__next_pair(w, pair, kinematic)) {
        const fe__pair *p = w->pairs + pair;
        const fe__body *other = w->bodies + (p->body_a == kinematic ? p->body_b : p->body_a);
        if (p->flags & FE__PAIR_LINKED && other->island >= 0) timers[other->island] = 0.0f;
    }
    for (int32_t joint = w->bodies[kinematic].first_joint; joint; joint = fe__next_joint(w, joint, kinematic)) {
        const fe__body *other = w->bodies + fe__joint_other(w, joint, kinematic);
        if (w->joints.joints[joint].colour >= 0 && other->island >= 0) timers[other->island] = 0.0f;
    }
}

// A timer of 0 is one of a body that is not slow, also when none need be slow for long
static int32_t may_sleep(const fe_world *w, float timer) { return timer > 0.0f && timer >= w->tuning.sleep_time; }

// An island sleeps when all its bodies have been slow for long enough; a kinematic body when it stands still
void fe__put_islands_to_sleep(fe__step *step)
{
    fe_world *w = step->world;
    float *timers = step->scratch->island_timers;
    int32_t some = 0;
    if (!w->tuning.sleep_enabled) return;
    for (int32_t i = 0; i < w->solver.island_count; ++i) timers[i] = FLT_MAX;
    for (int32_t i = 0; i < w->awake_body_count; ++i) {
        const fe__body *body = w->bodies + w->awake_bodies[i];
        if (body->island >= 0) timers[body->island] = fe__minf(timers[body->island], body->sleep_timer);
        if (body->type != FE_BODY_KINEMATIC) continue;
        if (stands_still(body))
            some = 1;
        else
            keep_awake(w, w->awake_bodies[i], timers);
    }
    for (int32_t i = 0; i < w->solver.island_count; ++i) some |= may_sleep(w, timers[i]);
    for (int32_t i = w->awake_body_count - 1; i >= 0 && some; --i) {
        int32_t index = w->awake_bodies[i];
        const fe__body *body = w->bodies + index;
        if (body->type == FE_BODY_DYNAMIC ? may_sleep(w, timers[body->island]) : stands_still(body))
            fe__body_fall_asleep(w, index);
    }
}

void fe__give_back_rows(fe__step *step)
{
    fe_world *w = step->world;
    if (w->step_memory != &w->memory) return; // lent: others need them
    if (!w->awake_body_count && w->solver.line_capacity[0] > KEPT_LINES) fe__solver_destroy(&w->solver, w->step_memory);
}
