// finalize.c - stages after the solver: poses and boxes from what the solver did with the bodies, then islands fall
// asleep.
//
// Workers each move their own bodies. The trees are written by the stepping thread, from a list of the shapes that left
// their boxes.
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

// ---- poses ----------------------------------------------------------------------------------------------------------
// Vectors of three are the x y z of a quad, whose fourth lane is something else.

static int32_t any_xyz(wide_mask m) { return (w_bits(m) & 7) != 0; }
static int32_t is_zero(const float *v) { return !any_xyz(*(const quad *)v != w_set(0.0f)); }
static float length_of(const float *v) { return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

// q = dq q, each lane as fe__product sums it. A body that did not turn keeps its quaternion: no rounding of a body that
// stood still.
static int32_t turn(fe__body *body, const float *dq)
{
    if (is_zero(dq)) return 0;
    const wide x = {1.0f, -1.0f, 1.0f, -1.0f}, y = {1.0f, 1.0f, -1.0f, -1.0f}, z = {-1.0f, 1.0f, 1.0f, -1.0f};
    wide q = *(const quad *)body->rotation;
    wide wzyx = __builtin_shufflevector(q, q, 3, 2, 1, 0), zwxy = __builtin_shufflevector(q, q, 2, 3, 0, 1);
    wide yxwz = __builtin_shufflevector(q, q, 1, 0, 3, 2);
    wide p = dq[3] * q + dq[0] * (x * wzyx) + dq[1] * (y * zwxy) + dq[2] * (z * yxwz);
    fe_quat unit = fe__normalized((fe_quat){p[0], p[1], p[2], p[3]});
    *(quad *)body->rotation = w_flush((wide){unit.x, unit.y, unit.z, unit.w}, w_set(FE__LEAST_SPEED));
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

// origin = centre - R(q) local centre
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

// Copies a velocity to a body without its smallest components; the fourth lane is the body's own.
static void copy_flushed(float *out, const float *in)
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

// A body is slow when its velocity is small as the step ends, and it went no further within sleep_time, net, than at
// that speed. What is pushed out of another body moves without a velocity. What is wedged may wobble by more than that
// in each step, for ever: it comes back to where it was.
static void tick_sleep_timer(const fe_world *world, fe__body *body, fe__drift *drift, const fe__motion_line *motion,
                             float dt)
{
    const float least = 1e-5f; // s: sleep_time and dt may be 0
    float before = body->sleep_timer, threshold = body->sleep_threshold;
    body->sleep_timer = 0.0f;
    if (!(body->flags & FE__BODY_SLEEP_ALLOWED && body->speed < threshold)) return;
    float timer = before + dt, window = fe__maxf(fe__maxf(world->tuning.sleep_time, dt), least);
    if (before == 0.0f || (int32_t)(timer / window) != (int32_t)(before / window))
        *drift = (fe__drift){{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
    // dq = (n sin(a/2), cos(a/2)): a small turn a is twice the length of its vector
    _Pragma("GCC unroll 3") for (int k = 0; k < 3; ++k) drift->shift[k] += motion->shift[k],
        drift->turn[k] += 2.0f * motion->rotation[k];
    if (length_of(drift->shift) + length_of(drift->turn) * body->reach < threshold * window) body->sleep_timer = timer;
}

static int32_t first_shape_of(const fe_world *world, int32_t i)
{
    return i < world->awake_body_count ? world->bodies[world->awake_bodies[i]].first_shape : -1;
}

// Bodies and shapes stream from memory, but only a slot says where in the tree a shape is, and a hull lies elsewhere:
// first the part of its shape that names it, then its record, then its vertices.
FE_FETCHES fetch_ahead(const fe_world *world, int32_t i)
{
    enum { SHAPES_AHEAD = 8, HULLS_AHEAD = 4, VERTICES_AHEAD = 2 };
    int32_t eighth = first_shape_of(world, i + SHAPES_AHEAD), fourth = first_shape_of(world, i + HULLS_AHEAD),
            second = first_shape_of(world, i + VERTICES_AHEAD);
    if (fourth >= 0) fe__tree_fetch(&world->moving_tree, fourth);
    if (eighth >= 0) fe__fetch(world->shapes + eighth, (unsigned)offsetof(fe__shape, local_position));
    if (fourth >= 0) fe__hull_form_fetch(&world->shapes[fourth].form);
    if (second >= 0) fe__hull_form_fetch_vertices(&world->shapes[second].form);
}

// A body whose motion overflowed stops where it stood; its contacts and joints forget their impulses afterwards.
static void stop_lost(fe__step *step, fe__body *body)
{
    for (int k = 0; k < 3; ++k)
        body->velocity[k] = body->spin[k] = body->force[k] = body->torque[k] = body->relaxed[k] = 0.0f;
    body->flags |= FE__BODY_LOST;
    fe__body_note_speed(step->world, body);
    body->sleep_timer = 0.0f;
    atomic_fetch_add_explicit(&step->scratch->lost_count, 1, memory_order_relaxed);
}

static void move_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    fe__step *step = argument;
    fe_world *world = step->world;
    const fe__solver *solver = &world->solver;
    fe__step_scratch *scratch = step->scratch;
    float swiftest = 0.0f;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        fetch_ahead(world, i);
        int32_t index = world->awake_bodies[i];
        fe__body *body = world->bodies + index;
        fe__odometer *odometer = world->odometers + index;
        const fe__velocity_line *velocity = solver->velocity + body->line;
        const fe__motion_line *motion = solver->motion + body->line;
        if (!fe__motion_makes_sense(solver, body->line)) {
            stop_lost(step, body);
            continue;
        }
        copy_flushed(body->velocity, velocity->v);
        copy_flushed(body->spin, velocity->w);
        for (int k = 0; k < 3; ++k) body->force[k] = body->torque[k] = 0.0f;
        if (motion->gyroscopic == (float)FE__GYROSCOPIC_JOINED)
            for (int k = 0; k < 3; ++k) body->relaxed[k] = body->spin[k] - solver->moved_spin[body->line][k];
        int32_t shifted = shift(body, motion->shift), turned = turn(body, motion->rotation);
        fe__note_speed(body, odometer);
        limit_speed(body, odometer, world->tuning.max_linear_speed);
        swiftest = fe__maxf(swiftest, fe__swiftness_of(body));
        tick_sleep_timer(world, body, world->drifts + index, motion, step->dt);
        if (turned) fe__odometer_turn(odometer, length_of(motion->rotation));
        if (!(shifted | turned)) continue;
        fe__odometer_place(odometer, body->centre);
        if (any_xyz(w_not(w_greater(w_set(FE__MOST_TRAVEL), w_abs(*(const quad *)motion->shift)))))
            atomic_store_explicit(&scratch->some_leapt, 1, memory_order_relaxed);
        body->moved_step = world->step_number + 1;
        place_origin(body);
        fe__body_place(world, index);
        for (int32_t k = body->first_shape; k >= 0; k = world->shapes[k].next)
            if (world->shapes[k].flags & FE__SHAPE_IN_TREE && !fe__shape_is_held(world, k))
                scratch->left[atomic_fetch_add_explicit(&scratch->left_count, 1, memory_order_relaxed)] = k;
    }
    fe__note_swiftness(world, swiftest);
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
    fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    atomic_store(&scratch->left_count, 0);
    atomic_store(&scratch->lost_count, 0);
    atomic_store(&scratch->some_leapt, 0);
    atomic_store(&world->swiftest, 0);
    fe__parallel_for(&world->workers, world->awake_body_count, BODIES_IN_BLOCK, move_block, step);
    int32_t some_lost = atomic_load(&scratch->lost_count) > 0;
    for (int32_t i = 0; i < world->awake_body_count && some_lost; ++i) {
        int32_t index = world->awake_bodies[i];
        fe__body *body = world->bodies + index;
        if (!(body->flags & FE__BODY_LOST)) continue;
        body->flags &= ~(uint32_t)FE__BODY_LOST;
        for (int32_t pair = body->first_contact; pair >= 0; pair = fe__next_pair(world, pair, index))
            fe__pair_forget_impulses(world, pair);
        fe__body_forget_joints(world, index);
    }
    // the odometer of a body that leapt may have gone all the way round: no deferral knows
    if (atomic_load(&scratch->some_leapt))
        for (int32_t i = 0; i < world->awake_pair_count; ++i)
            world->awake_pairs[i] = fe__pair_of(world->awake_pairs[i]);
    int32_t left = atomic_load(&scratch->left_count);
    fe__parallel_for(&world->workers, left, BOXES_IN_BLOCK, box_block, step);
    if (left) fe__tree_move(&world->moving_tree, scratch->left, fe__box_scratch(step), left);
    for (int32_t i = 0; i < left; ++i) fe__shape_mark_moved(world, scratch->left[i]);
}

// ---- sleep ----------------------------------------------------------------------------------------------------------

static int32_t stands_still(const fe__body *body) { return is_zero(body->velocity) && is_zero(body->spin); }

// The islands that a moving kinematic body touches or is joined to stay awake, however slow.
static void keep_awake(const fe_world *world, int32_t kinematic, float *timers)
{
    for (int32_t pair = world->bodies[kinematic].first_contact; pair >= 0;
         pair = fe__next_pair(world, pair, kinematic)) {
        const fe__pair *p = world->pairs + pair;
        const fe__body *other = world->bodies + (p->body_a == kinematic ? p->body_b : p->body_a);
        if (p->flags & FE__PAIR_LINKED && other->island >= 0) timers[other->island] = 0.0f;
    }
    for (int32_t joint = world->bodies[kinematic].first_joint; joint; joint = fe__next_joint(world, joint, kinematic)) {
        const fe__body *other = world->bodies + fe__joint_other(world, joint, kinematic);
        if (world->joints.joints[joint].colour >= 0 && other->island >= 0) timers[other->island] = 0.0f;
    }
}

// A timer of 0 is that of a body which is not slow, also where sleep_time is 0.
static int32_t may_sleep(const fe_world *world, float timer)
{
    return timer > 0.0f && timer >= world->tuning.sleep_time;
}

// An island sleeps when all its bodies have been slow for long enough; a kinematic body when it stands still.
void fe__put_islands_to_sleep(fe__step *step)
{
    fe_world *world = step->world;
    float *timers = step->scratch->island_timers;
    int32_t any = 0;
    if (!world->tuning.sleep_enabled) return;
    for (int32_t i = 0; i < world->solver.island_count; ++i) timers[i] = FLT_MAX;
    for (int32_t i = 0; i < world->awake_body_count; ++i) {
        const fe__body *body = world->bodies + world->awake_bodies[i];
        if (body->island >= 0) timers[body->island] = fe__minf(timers[body->island], body->sleep_timer);
        if (body->type != FE_BODY_KINEMATIC) continue;
        if (stands_still(body))
            any = 1;
        else
            keep_awake(world, world->awake_bodies[i], timers);
    }
    for (int32_t i = 0; i < world->solver.island_count; ++i) any |= may_sleep(world, timers[i]);
    for (int32_t i = world->awake_body_count - 1; i >= 0 && any; --i) {
        int32_t index = world->awake_bodies[i];
        const fe__body *body = world->bodies + index;
        if (body->type == FE_BODY_DYNAMIC ? may_sleep(world, timers[body->island]) : stands_still(body))
            fe__body_fall_asleep(world, index);
    }
}

void fe__give_back_rows(fe__step *step)
{
    fe_world *world = step->world;
    if (world->step_memory != &world->memory) return; // borrowed: other worlds need them
    if (!world->awake_body_count && world->solver.line_capacity[0] > KEPT_LINES)
        fe__solver_destroy(&world->solver, world->step_memory);
}
