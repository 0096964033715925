// Solver2D's samples far from the origin (E. Catto, Solver2D, 2024, samples/sample_far.cpp): what a game with a large
// map needs. With double positions they must behave as at the origin. See solver2d_stack.c for what all share.
#include "cases.h"

#include <math.h>

static void move_scene(bench_scene *s, double x, double y)
{
    for (int32_t i = 0; i < s->body_count; i++)
        s->bodies[i].start.position[0] += x, s->bodies[i].start.position[1] += y;
    for (int32_t i = 0; i < s->joint_count; i++) s->joints[i].anchor[0] += x, s->joints[i].anchor[1] += y;
}

// ---- pyramid of loosely set boxes ----------------------------------------------------------------------------------

enum { BASE = 10 };

static void add_loose_pyramid(bench_scene *s)
{
    const int32_t box = bench_box(s, 0.5, 0.5, 0.5, 1.0, 0.6);
    const double half_pitch = 0.625;
    bench_add_ground(s, 100.0, 0.6);
    for (int32_t i = 0; i < BASE; i++) {
        for (int32_t j = i; j < BASE; j++) {
            bench_add_dynamic(s, box, (i + 1) * half_pitch + 2.0 * (j - i) * half_pitch - 0.5 * BASE,
                              (2 * i + 1) * half_pitch + 0.5, 0.0);
        }
    }
}

static void build_far_pyramid(bench_scene *s)
{
    add_loose_pyramid(s);
    move_scene(s, 100000.0, -80000.0);
}

static void build_very_far_pyramid(bench_scene *s)
{
    add_loose_pyramid(s);
    move_scene(s, 900000.0, -800000.0);
}

static void judge_far_pyramid(bench_trial *t)
{
    double drop = 0.0;
    for (int32_t i = 1; i < t->scene.body_count; i++) {
        const double row =
            floor((t->scene.bodies[i].start.position[1] - t->scene.bodies[0].start.position[1] - 2.125) / 1.25 + 0.5);
        const double height = t->poses[i].position[1] - t->poses[0].position[1] - 1.0;
        drop = fmax(drop, fabs(height - row - 0.5));
    }
    bench_expect(t, "farthest from its row, m", drop, 0.0, 0.5);
    bench_expect(t, BENCH_TILT, bench_largest_tilt(t), 0.0, 2.0 * BENCH_PI / 180.0);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.01);
}

// ---- a plank on two supports with two boxes on it ------------------------------------------------------------------

enum { PLANK = 3 };

static void build_far_stack(bench_scene *s)
{
    bench_add_ground(s, 10.0, 0.6);
    bench_add_dynamic(s, bench_sphere(s, 0.1, 1.0, 0.6), 1.875, 0.125, 0.0);
    bench_add_dynamic(s, bench_box(s, 0.1, 0.125, 0.5, 1.0, 0.6), -1.875, 0.15, 0.0);
    bench_add_dynamic(s, bench_box(s, 2.0, 0.05, 0.5, 1.0, 0.6), 0.0, 0.325, 0.0);
    bench_add_dynamic(s, bench_box(s, 0.25, 0.25, 0.25, 1.0, 0.6), -0.5, 0.9, 0.0);
    bench_add_dynamic(s, bench_box(s, 0.5, 0.5, 0.5, 1.0, 0.6), -0.55, 1.7, 0.0);
    for (int32_t i = 1; i < s->body_count; i++)
        s->bodies[i].linear_locks = 4, s->bodies[i].angular_locks = 3; // a plank on one ball rolls off it
    move_scene(s, 40000.0, -25000.0);
}

static void judge_far_stack(bench_trial *t)
{
    const double ground = t->poses[0].position[1] + 1.0;
    bench_expect(t, "tilt of the plank, rad", bench_tilt(t, PLANK), 0.0,
                 3.0 * BENCH_PI / 180.0); // supports of 0.2 and 0.25 m: 0.76 degrees
    bench_expect(t, "height of the plank, m", t->poses[PLANK].position[1] - ground, 0.225, 0.325);
    bench_expect(t, "height of the topmost box, m", t->poses[5].position[1] - ground, 1.2, 1.4);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.01);
}

// ---- overlap recovery ----------------------------------------------------------------------------------------------

static void build_far_recovery(bench_scene *s)
{
    const int32_t box = bench_box(s, 0.5, 0.5, 0.5, 1.0, 0.6);
    bench_add_ground(s, 40.0, 0.6);
    for (int32_t i = 0; i < 4; i++) {
        for (int32_t j = i; j < 4; j++)
            bench_add_dynamic(s, box, 0.375 * (i - 4) + 0.75 * (j - i), 0.5 + 0.75 * i, 0.0);
    }
    move_scene(s, 80000.0, -70000.0);
}

static void judge_far_recovery(bench_trial *t)
{
    double fastest = 0.0;
    for (int32_t i = 1; i < t->scene.body_count; i++) fastest = fmax(fastest, t->tracks[i].speed);
    bench_expect(t, BENCH_DEEPEST, bench_deepest(t), 0.0, 3.0 * BENCH_LINEAR_SLOP);
    bench_expect(t, "largest speed, m/s (push-out 3)", fastest, 0.0, 8.0);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.01);
}

// ---- chain ---------------------------------------------------------------------------------------------------------

enum { LINKS = 40 };

static void build_far_chain(bench_scene *s)
{
    const int32_t link = bench_capsule(s, 0.1, 0.025, 20.0, 0.6);
    int32_t last = bench_add_static(s, bench_box(s, 0.05, 0.05, 0.05, 1.0, 0.6), 0.0, 4.0, 0.0);
    s->bodies[last].collides = 0;
    for (int32_t i = 0; i < LINKS; i++) {
        const int32_t body = bench_add_dynamic(s, link, 0.1 + 0.2 * i, 4.0, 0.0);
        bench_turn_z(&s->bodies[body], 0.5 * BENCH_PI);
        s->bodies[body].linear_damping = s->bodies[body].angular_damping = 0.1f;
        s->bodies[body].collides = 0;
        bench_add_hinge_z(s, last, body, 0.2 * i, 4.0);
        last = body;
    }
    move_scene(s, 40000.0, -35000.0);
}

// The first joint carries the whole chain: a gap of weight / (half a link's mass x w2).
static void judge_far_chain(bench_trial *t)
{
    const double gap = 2.0 * LINKS * 10.0 / bench_joint_stiffness(t);
    const double *first = t->poses[0].position, *last = t->poses[LINKS].position;
    bench_expect_own_open(t, BENCH_GAP, bench_highest(t->gap, 0, t->step), 3.3 * gap);
    bench_expect(t, "anchor to last link, m", hypot(first[0] - last[0], first[1] - last[1]), 0.95 * 7.9, 1.05 * 7.9);
    bench_expect(t, "last link below the anchor, m", first[1] - last[1], 0.8 * 7.9, 1.05 * 7.9);
}

const bench_case bench_solver2d_far[] = {
    {"far-pyramid", "Solver2D", "a pyramid of loose boxes 128 km from the origin", 10.0, 1, build_far_pyramid, NULL,
     NULL, judge_far_pyramid, BENCH_CALM},
    {"very-far-pyramid", "Solver2D", "the same at 1200 km", 10.0, 1, build_very_far_pyramid, NULL, NULL,
     judge_far_pyramid, BENCH_CALM},
    {"far-stack", "Solver2D", "a plank on two supports, 47 km out", 10.0, 1, build_far_stack, NULL, NULL,
     judge_far_stack, BENCH_CALM},
    {"far-recovery", "Solver2D", "overlapping boxes, 106 km out", 5.0, 1, build_far_recovery, NULL, NULL,
     judge_far_recovery, BENCH_CALM},
    {"far-chain", "Solver2D", "a chain of 40 links, 53 km out", 30.0, 1, build_far_chain, NULL, NULL, judge_far_chain,
     BENCH_CALM},
};
const int32_t bench_solver2d_far_count = (int32_t)(sizeof bench_solver2d_far / sizeof bench_solver2d_far[0]);
