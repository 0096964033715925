// Samples of Box3D and Box2D v3 that the other files have no place for, as data (E. Catto, Box3D, 2025, samples and
// determinism tests): leaning towers, capsules that do not like to roll, a heap on waves, columns of hinged squares.
#include "cases.h"

#include "../random.h"

#include <math.h>

static const double DEGREE = BENCH_PI / 180.0;

// ---- leaning towers ------------------------------------------------------------------------------------------------

// Each box sticks out by 0.2 m over the one below. Of n boxes above one the middle is 0.2 (n + 1) / 2 aside: three stay
// over its face of half a metre, five do not.
enum { STANDING = 4, FALLING = 6, TOWERS = 5 };

static void build_towers(bench_scene *s)
{
    const int32_t box = bench_box(s, 0.5, 0.5, 0.5, 1000.0, 0.3);
    bench_add_ground(s, 40.0, 0.6);
    for (int32_t j = 0; j < 2 * TOWERS; j++) {
        for (int32_t i = 0; i < (j < TOWERS ? STANDING : FALLING); i++)
            bench_add_dynamic(s, box, -22.5 + 5.0 * j + 0.2 * i, 0.5 + i, 0.0);
    }
}

static void judge_towers(bench_trial *t)
{
    double astray = 0.0, top = 0.0;
    for (int32_t i = 1; i <= STANDING * TOWERS; i++) astray = fmax(astray, bench_drift(t, i));
    for (int32_t j = 1; j <= TOWERS; j++) top = fmax(top, t->poses[STANDING * TOWERS + FALLING * j].position[1]);
    bench_expect_stray(t, "way of a box of the towers of four, m", astray, 0.05);
    bench_expect(t, "height of the highest top of the towers of six, m", top, 0.0, FALLING - 1.5);
}

// ---- capsules with much resistance to rolling ----------------------------------------------------------------------

enum { RESISTING = 10 };

static void build_resisting(bench_scene *s)
{
    bench_add_ground(s, 40.0, 0.6);
    for (int32_t i = 0; i < RESISTING; i++) {
        const int32_t capsule = bench_capsule(s, 1.0, 0.5, 1000.0, 0.6);
        s->shapes[capsule].rolling = 0.2f * (float)i;
        const int32_t body = bench_add_dynamic(s, capsule, -22.0 + 5.0 * i, 1.5, 0.0);
        bench_turn_z(&s->bodies[body], 30.0 * DEGREE + 0.5 * BENCH_PI);
    }
}

// On one end a capsule falls over by its weight times cos 30 x 1 m, which a resistance of c x 0.5 m x weight holds for
// c = 1.8 alone, the last one's.
static void judge_resisting(bench_trial *t)
{
    double highest = 0.0;
    for (int32_t i = 1; i < RESISTING; i++) highest = fmax(highest, t->poses[i].position[1]);
    bench_expect(t, "largest energy / start", bench_highest(t->energy, 0, t->step) / t->energy[0], 0.0, 1.0 + 1e-5);
    bench_expect(t, "height of the highest that must lie down, m", highest, 0.0, 0.5 + BENCH_LINEAR_SLOP);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.05);
}

// ---- a heap on waves -----------------------------------------------------------------------------------------------

enum { HEAP = 100, HEAP_SIDE = 5, REST_STEPS = 400 };

static void build_wave_pile(bench_scene *s)
{
    uint64_t state = 52977;
    bench_shape waves = bench_make_terrain(21, 1.0f);
    const int32_t forms[3] = {bench_sphere(s, 0.4, 1000.0, 0.6), bench_box(s, 0.4, 0.3, 0.5, 1000.0, 0.6),
                              bench_capsule(s, 0.3, 0.3, 1000.0, 0.6)};
    for (int32_t i = 0; i < 3; i++) s->shapes[forms[i]].rolling = 0.3f;
    waves.relief = BENCH_WAVES;
    bench_add_static(s, bench_add_shape(s, waves), 0.0, 0.0, 0.0);
    for (int32_t i = 0; i < HEAP; i++) {
        const double x = 1.7 * (i % HEAP_SIDE - 2), z = 1.7 * (i / HEAP_SIDE % HEAP_SIDE - 2),
                     y = 2.0 + 1.6 * (i / (HEAP_SIDE * HEAP_SIDE));
        const int32_t body = bench_add_dynamic(s, forms[i % 3], x, y, z);
        const double axis[3] = {bench_random(&state) - 0.5, bench_random(&state) - 0.5, bench_random(&state) - 0.5};
        bench_turn(&s->bodies[body], axis[0], axis[1], axis[2], BENCH_PI * bench_random(&state));
    }
}

// Box3D's own heap sleeps after 273 steps: a body that may sleep is slower than 5 cm/s.
static void judge_wave_pile(bench_trial *t)
{
    double low = HUGE_VAL;
    for (int32_t i = 1; i <= HEAP; i++) low = fmin(low, t->poses[i].position[1]);
    bench_expect(t, "lowest centre, m (valleys: -0.5)", low, -0.5, 10.0);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.05);
}

// ---- columns of squares, hinged by pairs ---------------------------------------------------------------------------

enum { HINGED_COLUMNS = 4, HINGED_ROWS = 20 };
static const double SQUARE = 0.25; // m, half a side

static void build_falling_hinges(bench_scene *s)
{
    const int32_t square = bench_box(s, SQUARE, SQUARE, SQUARE, 1.0, 0.6);
    bench_add_ground(s, 20.0, 0.6);
    for (int32_t j = 0; j < HINGED_COLUMNS; j++) {
        for (int32_t i = 0; i < HINGED_ROWS; i++) {
            const double x = 2.5 * (j - 0.5 * HINGED_COLUMNS) + 0.1 * i, y = 2.0 * SQUARE * (i + 1);
            const int32_t body = bench_add_dynamic(s, square, x, y, 0.0);
            bench_turn_z(&s->bodies[body], i % 2 == 0 ? 0.1 : -0.1);
            if (i % 2 == 0) continue;
            bench_joint *hinge = bench_add_hinge_z(s, body - 1, body, x - SQUARE, y - SQUARE);
            hinge->has_limits = 1;
            hinge->limits[0] = -0.1 * BENCH_PI, hinge->limits[1] = 0.2 * BENCH_PI;
            hinge->hertz = 1.0, hinge->damping = 1.0;
            hinge->motor_max = 0.25;
        }
    }
}

static double turn_about_z(const bench_trial *t, int32_t body)
{
    const double *q = t->poses[body].rotation, *start = t->scene.bodies[body].start.rotation;
    return 2.0 * atan2(q[2] * start[3] - q[3] * start[2], q[3] * start[3] + q[2] * start[2]);
}

static void judge_falling_hinges(bench_trial *t)
{
    double beyond = 0.0;
    for (int32_t i = 0; i < t->scene.joint_count && t->scene.planar; i++) {
        const bench_joint *j = &t->scene.joints[i];
        const double angle = remainder(turn_about_z(t, j->body_b) - turn_about_z(t, j->body_a), 2.0 * BENCH_PI);
        beyond = fmax(beyond, fmax(j->limits[0] - angle, angle - j->limits[1]));
    }
    bench_expect_open(t, "joint gap in the last second, m", bench_highest(t->gap, t->step - 60, t->step),
                      BENCH_LINEAR_SLOP);
    if (t->scene.planar) bench_expect(t, "beyond the limits at the end, rad", beyond, 0.0, 3.0 * DEGREE);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.05);
}

const bench_case bench_box3d_more[] = {
    {"leaning-towers", "Box3D, tilted stack", "towers of four stand, of six fall", 10.0, 0, build_towers, NULL, NULL,
     judge_towers, BENCH_CALM},
    {"high-resistance", "Box3D", "ten capsules that resist rolling", 10.0, 0, build_resisting, NULL, NULL,
     judge_resisting, BENCH_CALM},
    {"wave-pile", "Box3D, determinism", "100 bodies on waves are at rest after 400 steps", REST_STEPS / 60.0, 0,
     build_wave_pile, NULL, NULL, judge_wave_pile, BENCH_CALM},
    {"falling-hinges", "Box2D v3, determinism", "columns of 20 squares hinged by pairs", 15.0, 1, build_falling_hinges,
     NULL, NULL, judge_falling_hinges, BENCH_CALM},
};
const int32_t bench_box3d_more_count = (int32_t)(sizeof bench_box3d_more / sizeof bench_box3d_more[0]);
