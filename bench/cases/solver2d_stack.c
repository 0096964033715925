// Solver2D's samples that stack and pile (E. Catto, Solver2D, 2024, samples/sample_contact.cpp), laid out in the plane
// z = 0: boxes become cubes or bars of depth 1 m, circles spheres. 60 Hz, gravity 10 m/s2, friction 0.6, density 1
// unless told.
#include "cases.h"

#include <math.h>

static const double GRAVITY = 10.0; // m/s2

// ---- single box: falls 3 m and stays -------------------------------------------------------------------------------

static void build_single_box(bench_scene *s)
{
    bench_add_ground(s, 66.0, 0.5);
    bench_add_dynamic(s, bench_box(s, 1.0, 1.0, 1.0, 1.0, 0.5), 0.0, 4.0, 0.0);
}

// note 0: it has landed
static void watch_single_box(bench_trial *t)
{
    if (t->notes[0] == 0.0 && t->poses[1].position[1] < 1.0 + 2.0 * BENCH_LINEAR_SLOP) {
        t->notes[0] = 1.0;
        bench_trial_forget(t);
    }
}

static void judge_single_box(bench_trial *t)
{
    const double sink = bench_face_factor(t) * GRAVITY / bench_contact_stiffness(t, 1);
    bench_expect_own(t, "top of the rebound, m", t->tracks[1].highest, 0.0, 1.0 + 2.0 * BENCH_LINEAR_SLOP);
    bench_expect_own(t, "height at rest - 1, m", t->poses[1].position[1] - 1.0, -sink - BENCH_LINEAR_SLOP,
                     BENCH_LINEAR_SLOP);
    bench_expect_stray(t, BENCH_DRIFT, bench_largest_drift(t), 0.01 * BENCH_LINEAR_SLOP);
    bench_expect(t, BENCH_TILT, bench_largest_tilt(t), 0.0, 1e-5);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 1e-3);
}

// ---- warm start energy: a heavy ball is taken off two light ones ---------------------------------------------------

enum { HEAVY = 3, REMOVED_AT = 119, A_SECOND = 60 };

static void build_warm_start_energy(bench_scene *s)
{
    const int32_t light = bench_sphere(s, 0.5, 1.0, 0.6), heavy = bench_sphere(s, 0.5, 100.0, 0.6);
    bench_add_ground(s, 10.0, 0.6);
    bench_add_dynamic(s, light, 0.0, 0.5, 0.0);
    bench_add_dynamic(s, light, 0.0, 1.5, 0.0);
    bench_add_dynamic(s, heavy, 0.0, 2.5, 0.0);
}

// note 0: overlap of the two upper balls before the removal
static void act_warm_start_energy(bench_trial *t)
{
    if (t->step != REMOVED_AT) return;
    t->notes[0] = 1.0 - (t->poses[HEAVY].position[1] - t->poses[2].position[1]);
    bench_trial_take_away(t, HEAVY);
    bench_trial_forget(t);
}

static void judge_warm_start_energy(bench_trial *t)
{
    const double light = 4.0 / 3.0 * BENCH_PI * 0.125, heavy = 100.0 * light, load = heavy * GRAVITY;
    const double effective = 1.0 / (1.0 / light + 1.0 / heavy);
    const double overlap = load / (effective * bench_contact_stiffness(t, 0));
    bench_expect_own(t, "overlap under the heavy ball, m", t->notes[0], 0.8 * overlap,
                     1.25 * overlap + BENCH_LINEAR_SLOP);
    bench_expect(t, "highest middle ball afterwards, m", t->tracks[2].highest, 0.0, 1.5 + BENCH_LINEAR_SLOP);
    bench_expect(t, "highest bottom ball afterwards, m", t->tracks[1].highest, 0.0, 0.5 + BENCH_LINEAR_SLOP);
    bench_expect(t, "kinetic energy a second later, J", t->kinetic[REMOVED_AT + 1 + A_SECOND], 0.0, 1e-4);
}

// ---- high mass ratio 1: a box 100 to 300 times as heavy falls on a pyramid -----------------------------------------

enum { ROWS = 10, PYRAMIDS = 3, IN_PYRAMID = 55 };

static void build_high_mass_ratio_1(bench_scene *s)
{
    const int32_t light = bench_box(s, 1.0, 1.0, 1.0, 1.0, 0.5);
    bench_add_ground(s, 66.0, 0.5);
    for (int32_t j = 0; j < PYRAMIDS; j++) {
        const int32_t heavy = bench_box(s, 1.0, 1.0, 1.0, 100.0 * (j + 1), 0.5);
        double y = 1.0;
        for (int32_t count = ROWS; count > 0; count--, y += 2.0) {
            for (int32_t i = 0; i < count; i++) {
                const double x = 2.0 * (i - 0.5 * count) - 20.0 + 22.0 * j;
                bench_add_dynamic(s, count > 1 ? light : heavy, x, count > 1 ? y : y + 2.0, 0.0);
            }
        }
    }
}

static void judge_high_mass_ratio_1(bench_trial *t)
{
    double drop = 0.0, heavy_sink = 0.0;
    for (int32_t i = 1; i <= PYRAMIDS * IN_PYRAMID; i++) {
        const int32_t is_heavy = i % IN_PYRAMID == 0;
        const double down = t->scene.bodies[i].start.position[1] - t->poses[i].position[1] - (is_heavy ? 2.0 : 0.0);
        drop = fmax(drop, down);
        if (is_heavy) heavy_sink = fmax(heavy_sink, down);
    }
    // the load spreads on its way down: nine interfaces, each no deeper than the first
    const double load = PYRAMIDS * 100.0 * 8.0 * GRAVITY, first = load / (8.0 * bench_contact_stiffness(t, 0));
    bench_expect(t, "largest drop below its row, m", drop, -0.5, 0.5);
    bench_expect_own(t, "sink of the heavy boxes, m", heavy_sink, 0.0, 9.0 * first + BENCH_LINEAR_SLOP);
    bench_expect_stray(t, BENCH_DRIFT, bench_largest_drift(t), 0.1);
    bench_expect(t, BENCH_TILT, bench_largest_tilt(t), 0.0, 2.0 * BENCH_PI / 180.0);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.05);
}

// ---- high mass ratio 2 and 3: a block of 400 kg falls on two small boxes of 1 kg -----------------------------------

static void add_big_on_small(bench_scene *s)
{
    const int32_t small = bench_box(s, 0.5, 0.5, 0.5, 1.0, 0.6);
    bench_add_dynamic(s, small, -9.0, 0.5, 0.0);
    bench_add_dynamic(s, small, 9.0, 0.5, 0.0);
    bench_add_dynamic(s, bench_box(s, 10.0, 10.0, 0.5, 1.0, 0.6), 0.0, 26.0,
                      0.0); // a slab: a cube of 20 m would weigh 8000 kg
}

static void build_high_mass_ratio_2(bench_scene *s)
{
    bench_add_ground(s, 20.0, 0.6);
    add_big_on_small(s);
}

static void build_high_mass_ratio_3(bench_scene *s)
{
    const int32_t thick = bench_box(s, 40.0, 2.0, 40.0, 1.0, 0.6);
    bench_add_static(s, thick, 0.0, -2.0, 0.0);
    add_big_on_small(s);
}

// Four points under each side carry half of the load; effective masses by scenes in the plane: 1/m + x2/I for each
// side.
static void judge_big_on_small(bench_trial *t)
{
    const double per_point = 400.0 * GRAVITY / 8.0,
                 turns = t->scene.planar ? 2.5 : 4.0; // 1 / (effective mass of a small box's corner x its mass)
    const double between = per_point * turns / bench_contact_stiffness(t, 0),
                 below = per_point * turns / bench_contact_stiffness(t, 1);
    const double sink = between + below;
    bench_expect_own(t, "sink of the block, m", 11.0 - t->poses[3].position[1], 0.5 * sink,
                     1.25 * sink + BENCH_LINEAR_SLOP);
    bench_expect(t, "lowest underside of the block, m", t->tracks[3].lowest - 10.0, 0.0,
                 16.0); // it never crushes the boxes to nothing
    bench_expect(t, "tilt of the block, rad", bench_tilt(t, 3), 0.0, 0.5 * BENCH_PI / 180.0);
    bench_expect_stray(t, "drift of the small boxes, m", fmax(bench_drift(t, 1), bench_drift(t, 2)), 0.05);
}

// ---- vertical stack, pyramid ---------------------------------------------------------------------------------------

enum { STACKED = 15, BASE = 20 };

static void build_vertical_stack(bench_scene *s)
{
    const int32_t box = bench_box(s, 0.5, 0.5, 0.5, 1.0, 0.3);
    bench_add_ground(s, 100.0, 0.6);
    for (int32_t i = 0; i < STACKED; i++) bench_add_dynamic(s, box, i % 2 == 0 ? -0.01 : 0.01, 0.55 + 1.1 * i, 0.0);
}

static void judge_vertical_stack(bench_trial *t)
{
    const double n = STACKED, factor = bench_face_factor(t);
    const double sink =
        factor * GRAVITY * (n * (n - 1.0) / bench_contact_stiffness(t, 0) + n / bench_contact_stiffness(t, 1));
    bench_expect_own(t, "sink of the top, m", STACKED - 0.5 - t->poses[STACKED].position[1],
                     0.8 * sink - BENCH_LINEAR_SLOP, 1.25 * sink + BENCH_LINEAR_SLOP);
    bench_expect(t, "height of the top, m", t->poses[STACKED].position[1], STACKED - 0.5 - 0.3, STACKED - 0.5 + 0.3);
    bench_expect_stray(t, BENCH_DRIFT, bench_largest_drift(t), 0.02);
    bench_expect(t, BENCH_TILT, bench_largest_tilt(t), 0.0, 0.5 * BENCH_PI / 180.0);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.01);
}

static void add_pyramid(bench_scene *s, int32_t base)
{
    const int32_t box = bench_box(s, 0.5, 0.5, 0.5, 1.0, 0.6);
    bench_add_ground(s, 100.0, 0.6);
    for (int32_t i = 0; i < base; i++) {
        for (int32_t j = i; j < base; j++)
            bench_add_dynamic(s, box, (i + 1) * 0.5 + (j - i) - 0.5 * base, i + 0.5, 0.0);
    }
}

static void build_pyramid(bench_scene *s) { add_pyramid(s, BASE); }

static void build_large_pyramid(bench_scene *s) { add_pyramid(s, 5 * BASE); }

// Two half faces under each cube: 0.40625 of the mean load of a row (0.4375 in the plane, whose cubes turn about one
// axis only)
static void judge_pyramid(bench_trial *t)
{
    const int32_t top = t->scene.body_count - 1;
    const double rows = t->scene.bodies[top].start.position[1] + 0.5, share = t->scene.planar ? 0.4375 : 0.40625;
    const double sink = GRAVITY * (share * (rows * (rows + 1.0) / 2.0 - 1.0) / bench_contact_stiffness(t, 0) +
                                   (rows + 1.0) / 2.0 / bench_contact_stiffness(t, 1));
    double drop = 0.0;
    for (int32_t i = 1; i <= top; i++)
        drop = fmax(drop, t->scene.bodies[i].start.position[1] - t->poses[i].position[1]);
    bench_expect_own(t, "sink of the top, m", rows - 0.5 - t->poses[top].position[1], 0.5 * sink,
                     1.25 * sink + BENCH_LINEAR_SLOP);
    bench_expect_stray(t, "sideways way of the top, m", bench_drift(t, top), rows > BASE ? 0.5 : 0.05);
    bench_expect(t, "largest drop, m (a row is 1)", drop, -0.5, 0.5 + (rows > BASE ? sink : 0.0));
}

// ---- circle stack: kept upright by exact symmetry ------------------------------------------------------------------

enum { CIRCLES = 10 };

static void build_circle_stack(bench_scene *s)
{
    const int32_t sphere = bench_sphere(s, 1.0, 1.0, 0.6);
    bench_add_ground(s, 40.0, 0.6);
    for (int32_t i = 0; i < CIRCLES; i++) bench_add_dynamic(s, sphere, 0.0, 4.0 + 3.0 * i, 0.0);
}

static void judge_circle_stack(bench_trial *t)
{
    const double n = CIRCLES; // equal spheres: effective mass m/2 between two, m on the ground
    const double sink = GRAVITY * (n * (n - 1.0) / bench_contact_stiffness(t, 0) + n / bench_contact_stiffness(t, 1));
    const double height = 2.0 * n - 1.0;
    bench_expect_stray(t, BENCH_DRIFT, bench_largest_drift(t), 0.0);
    bench_expect_own(t, "sink of the top, m", height - t->poses[CIRCLES].position[1], 0.8 * sink - BENCH_LINEAR_SLOP,
                     1.25 * sink + BENCH_LINEAR_SLOP);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.01);
}

const bench_case bench_solver2d_stack[] = {
    {"single-box", "Solver2D", "a box falls 3 m and lies still", 3.0, 1, build_single_box, NULL, watch_single_box,
     judge_single_box, BENCH_CALM},
    {"warm-start-energy", "Solver2D", "a heavy ball is taken off two light ones", 5.0, 1, build_warm_start_energy,
     act_warm_start_energy, NULL, judge_warm_start_energy, BENCH_CALM},
    {"high-mass-ratio-1", "Solver2D", "boxes of 100 to 300 times the mass fall on pyramids", 20.0, 1,
     build_high_mass_ratio_1, NULL, NULL, judge_high_mass_ratio_1, BENCH_CHAOTIC},
    {"high-mass-ratio-2", "Solver2D", "a block of 400 kg falls on two boxes of 1 kg", 5.0, 1, build_high_mass_ratio_2,
     NULL, NULL, judge_big_on_small, BENCH_CALM},
    {"high-mass-ratio-3", "Solver2D", "the same on a thick ground", 5.0, 1, build_high_mass_ratio_3, NULL, NULL,
     judge_big_on_small, BENCH_CALM},
    {"vertical-stack", "Solver2D", "15 boxes with gaps fall onto each other", 20.0, 1, build_vertical_stack, NULL, NULL,
     judge_vertical_stack, BENCH_CALM},
    {"pyramid", "Solver2D", "20 rows stand", 60.0, 1, build_pyramid, NULL, NULL, judge_pyramid, BENCH_CALM},
    {"large-pyramid", "Solver2D, release", "100 rows stand for 10 s", 10.0, 1, build_large_pyramid, NULL, NULL,
     judge_pyramid, BENCH_CALM},
    {"circle-stack", "Solver2D", "ten balls on one another", 10.0, 1, build_circle_stack, NULL, NULL,
     judge_circle_stack, BENCH_CALM},
};
const int32_t bench_solver2d_stack_count = (int32_t)(sizeof bench_solver2d_stack / sizeof bench_solver2d_stack[0]);
