// Scenes of Box3D on wide ground and in a turning drum, as data (E. Catto, Box3D, 2025, shared/benchmarks.c and
// samples): terrain, rain of humans, washer, large world.
#include "cases.h"

#include "../random.h"

#include <math.h>

static const double GRAVITY = 10.0; // m/s2
static const double DEGREE = BENCH_PI / 180.0;

// ---- thin boxes on a heightfield -----------------------------------------------------------------------------------

enum { THIN_SIDE = 32, WAVE_SAMPLES = 41, SCATTERED = 2 };

static void add_waves(bench_scene *s, float cell, int32_t samples)
{
    bench_shape waves = bench_make_terrain(samples, cell);
    waves.relief = BENCH_WAVES, waves.rolling = 0.2f;
    bench_add_static(s, bench_add_shape(s, waves), 0.0, 0.0, 0.0);
}

static void build_needles(bench_scene *s)
{
    uint64_t state = 0x2545f4914f6cdd1du;
    const int32_t thin = bench_box(s, 0.02, 0.2, 0.04, 1000.0, 0.6);
    s->shapes[thin].rolling = 0.2f;
    add_waves(s, 1.0f, WAVE_SAMPLES);
    for (int32_t i = 0; i < THIN_SIDE * THIN_SIDE; i++) {
        const double x = 0.5 * (i % THIN_SIDE - 0.5 * THIN_SIDE), z = 0.5 * (i / THIN_SIDE - 0.5 * THIN_SIDE);
        const int32_t added = bench_add_dynamic(s, thin, x, 5.0, z);
        bench_body *body = &s->bodies[added];
        for (int k = 0; k < 3; k++) body->linear_velocity[k] = (float)(2.0 * bench_random(&state) - 1.0);
        for (int k = 0; k < 3; k++) body->angular_velocity[k] = (float)(10.0 * bench_random(&state) - 5.0);
    }
}

static int32_t count_below(const bench_trial *t, double height)
{
    int32_t count = 0;
    for (int32_t i = 0; i < t->scene.body_count; i++)
        count += t->scene.bodies[i].dynamic && t->poses[i].position[1] < height;
    return count;
}

static int32_t count_faster(const bench_trial *t, double speed)
{
    int32_t count = 0;
    for (int32_t i = 0; i < t->scene.body_count; i++) count += t->scene.bodies[i].dynamic && bench_speed(t, i) > speed;
    return count;
}

static void judge_needles(bench_trial *t)
{
    bench_expect(t, "boxes below the ground", count_below(t, -2.0), 0.0, 0.0);
    bench_expect(t, "boxes faster than 5 cm/s after 5 s", count_faster(t, 0.05), 0.0, 0.0);
}

// ---- rain of humans ------------------------------------------------------------------------------------------------

// The human of Box3D, 14 capsules: pose of the capsule's middle relative to the spawn point, joint to the parent there
// (point and axis; ranges in degrees about the pose at the start; friction in units of 5 N m). Its springs are left
// out, which Bullet and ODE have not.
static const struct bone {
    const char *name;
    int32_t parent;
    double middle[3], rotation[4]; // x y z w, takes y to the capsule's axis
    double half_height, radius;
    bench_joint_kind kind;
    double joint[3], axis[3];
    double twist[2], cone, friction;
} bones[] = {
    {"pelvis",
     -1,
     {0, 1.0117, -0.044289},
     {0, 0, 0.70711, 0.70711},
     0.07,
     0.13,
     BENCH_BALL,
     {0, 0, 0},
     {0, 0, 0},
     {0.0, 0.0},
     0.0,
     1.0},
    {"spine_01",
     0,
     {0, 1.1655, -0.029839},
     {0, 0, 0.70711, 0.70711},
     0.06,
     0.12,
     BENCH_BALL,
     {0, 1.1135, -0.03481},
     {0, 0.99547, 0.09512},
     {-15.0, 15.0},
     25.0,
     1.0},
    {"spine_02",
     1,
     {0, 1.286, -0.043125},
     {0, 0, 0.70711, 0.70711},
     0.08,
     0.1,
     BENCH_BALL,
     {0, 1.202, -0.02635},
     {0, 0.99995, -0.0098657},
     {-15.0, 15.0},
     25.0,
     1.0},
    {"spine_03",
     2,
     {-1.3118e-07, 1.4357, -0.081111},
     {1.9974e-06, 0, 0.70711, 0.70711},
     0.11,
     0.145,
     BENCH_BALL,
     {0, 1.3186, -0.028313},
     {1.905e-06, 0.99472, -0.10259},
     {-10.0, 10.0},
     15.0,
     1.0},
    {"neck",
     3,
     {-5e-07, 1.6188, -0.030501},
     {0.24617, 0, -8.5682e-06, 0.96923},
     0.030104,
     0.07,
     BENCH_BALL,
     {9.6054e-07, 1.5756, -0.055837},
     {1.0007e-06, 0.83613, 0.54853},
     {-15.0, 15.0},
     45.0,
     0.8},
    {"head",
     4,
     {-5e-07, 1.7387, 0.014273},
     {-0.1112, 0, -8.3853e-06, 0.9938},
     0.03,
     0.0975,
     BENCH_BALL,
     {0, 1.6533, -0.0032407},
     {0, 0.99205, 0.12586},
     {-15.0, 15.0},
     15.0,
     0.4},
    {"thigh_l",
     0,
     {0.11107, 0.75424, -0.03643},
     {-0.010433, 0, -0.024491, 0.99965},
     0.19788,
     0.09,
     BENCH_BALL,
     {0.05, 0.9861, -0.03509},
     {0.99971, 0.023711, -0.0049722},
     {-60.0, 40.0},
     10.0,
     1.0},
    {"calf_l",
     6,
     {0.099553, 0.32235, -0.073625},
     {0.086725, 0, -0.0038061, 0.99623},
     0.21786,
     0.075,
     BENCH_HINGE,
     {0.1012, 0.52703, -0.037373},
     {0.99023, 0.018738, -0.13821},
     {-5.0, 45.0},
     0.0,
     1.0},
    {"thigh_r",
     0,
     {-0.11107, 0.75424, -0.03643},
     {-0.010433, 0, 0.024492, 0.99965},
     0.19788,
     0.09,
     BENCH_BALL,
     {-0.05, 0.9861, -0.03509},
     {-0.99971, 0.023478, -0.0049704},
     {-30.0, 60.0},
     10.0,
     1.0},
    {"calf_r",
     8,
     {-0.099885, 0.32259, -0.073651},
     {0.086862, 0, 0.0030432, 0.99622},
     0.21786,
     0.075,
     BENCH_HINGE,
     {-0.1012, 0.52703, -0.037373},
     {-0.99022, 0.018738, -0.1382},
     {-45.0, 5.0},
     0.0,
     1.0},
    {"upper_arm_l",
     3,
     {0.25237, 1.3691, -0.11671},
     {0.0033132, 0, 0.1983, 0.98014},
     0.125,
     0.075,
     BENCH_BALL,
     {0.20378, 1.4843, -0.1159},
     {0.80734, -0.40598, 0.42824},
     {-5.0, 5.0},
     60.0,
     1.0},
    {"lower_arm_l",
     10,
     {0.35997, 1.1128, -0.066465},
     {-0.17639, 0, 0.1875, 0.9663},
     0.15,
     0.05,
     BENCH_HINGE,
     {0.30561, 1.2429, -0.1176},
     {-0.91348, -0.40317, -0.054919},
     {-5.0, 60.0},
     0.0,
     1.0},
    {"upper_arm_r",
     3,
     {-0.25237, 1.3691, -0.11671},
     {0.0033109, 0, -0.1983, 0.98014},
     0.125,
     0.075,
     BENCH_BALL,
     {-0.20378, 1.4843, -0.1159},
     {-0.77381, -0.48836, 0.4034},
     {-5.0, 5.0},
     60.0,
     1.0},
    {"lower_arm_r",
     12,
     {-0.35997, 1.1128, -0.066465},
     {-0.17639, 0, -0.1875, 0.9663},
     0.15,
     0.05,
     BENCH_HINGE,
     {-0.30561, 1.2429, -0.1176},
     {0.91348, -0.40317, -0.054918},
     {-60.0, 5.0},
     0.0,
     1.0},
};
enum { BONES = (int)(sizeof bones / sizeof bones[0]), RAIN_SIDE = 4, IN_CELL = 3, LAYERS = 2 };

static void add_bone_joint(bench_scene *s, const struct bone *b, int32_t hip, int32_t body, const double *at)
{
    bench_joint *joint =
        bench_add_ball(s, hip + b->parent, body, at[0] + b->joint[0], at[1] + b->joint[1], at[2] + b->joint[2]);
    joint->kind = b->kind;
    for (int k = 0; k < 3; k++) joint->axis[k] = b->axis[k];
    joint->has_limits = 1;
    for (int k = 0; k < 2; k++) joint->limits[k] = b->twist[k] * DEGREE;
    joint->cone = b->cone * DEGREE;
    joint->motor_max = 5.0 * b->friction;
}

static void add_human(bench_scene *s, const int32_t *shapes, const double *at, int32_t group)
{
    const int32_t hip = s->body_count;
    for (int32_t i = 0; i < BONES; i++) {
        const struct bone *b = &bones[i];
        const int32_t body =
            bench_add_dynamic(s, shapes[i], at[0] + b->middle[0], at[1] + b->middle[1], at[2] + b->middle[2]);
        for (int k = 0; k < 4; k++) s->bodies[body].start.rotation[k] = b->rotation[k];
        s->bodies[body].group = group;
        if (b->parent >= 0) add_bone_joint(s, b, hip, body, at);
    }
}

static void build_rain(bench_scene *s)
{
    int32_t shapes[BONES], group = 0;
    for (int32_t i = 0; i < BONES; i++) {
        shapes[i] = bench_capsule(s, bones[i].half_height, bones[i].radius, 1000.0, 0.6);
        s->shapes[shapes[i]].rolling = 0.2f;
    }
    add_waves(s, 1.875f, 8 * RAIN_SIDE + 1);
    for (int32_t i = 0; i < RAIN_SIDE * RAIN_SIDE * IN_CELL * LAYERS; i++) {
        const int32_t cell = i / IN_CELL % (RAIN_SIDE * RAIN_SIDE), layer = i / (RAIN_SIDE * RAIN_SIDE * IN_CELL);
        const double at[3] = {15.0 * (cell % RAIN_SIDE - 1.5) + 0.75 * (i % IN_CELL), 6.0 + 3.0 * layer,
                              15.0 * (cell / RAIN_SIDE - 1.5)};
        add_human(s, shapes, at, ++group);
    }
}

// After the fall: P2 of a limb's weight and the others on it, at the stiffness of joints, is less than the slop.
static void judge_rain(bench_trial *t)
{
    bench_expect(t, "bones below the ground", count_below(t, -1.5), 0.0, 0.0);
    bench_expect_open(t, "largest joint gap in the last second, m",
                      bench_highest(t->gap, bench_step_at(t, t->time - 1.0), t->step), 2.0 * BENCH_LINEAR_SLOP);
    bench_expect(t, "bones faster than 5 cm/s at the end", count_faster(t, 0.05), 0.0, 0.0);
}

// ---- washer --------------------------------------------------------------------------------------------------------

// In the drum's own frame: it stands, gravity turns, once in 14.4 s. (What the turning frame adds, 3 m/s2 at the wall,
// is left out.) Cubes of twice the size and an eighth in number.
enum { WALLS = 36, BLADES = 4, CUBES = 10 };
static const double TURNING = 25.0 * BENCH_PI / 180.0; // rad/s

static void add_slab(bench_scene *s, int32_t slab, double radius, double angle)
{
    const int32_t body = bench_add_static(s, slab, radius * cos(angle), radius * sin(angle), 0.0);
    bench_turn_z(&s->bodies[body], angle);
}

static void build_washer(bench_scene *s)
{
    const double half_wall = 17.0 * tan(6.0 * DEGREE), half_blade = 15.0 * tan(5.0 * DEGREE);
    const int32_t wall = bench_box(s, 1.0, half_wall, 10.0, 1.0, 0.6),
                  blade = bench_box(s, 1.0, half_blade, 10.0, 1.0, 0.6);
    const int32_t end = bench_box(s, 20.0, 20.0, 1.0, 1.0, 0.6), cube = bench_box(s, 0.4, 0.4, 0.4, 1000.0, 0.6);
    for (int32_t i = 0; i < WALLS; i++) {
        const double angle = (10.0 * i + 5.0) * DEGREE;
        add_slab(s, wall, 17.0, angle);
        if (i % (WALLS / BLADES) == 0) add_slab(s, blade, 15.0, angle);
    }
    for (int side = -1; side <= 1; side += 2) bench_add_static(s, end, 0.0, 0.0, 11.0 * side);
    for (int32_t i = 0; i < CUBES * CUBES * CUBES; i++)
        bench_add_dynamic(s, cube, 1.6 * (i % CUBES) - 7.2, 1.6 * (i / CUBES % CUBES) - 7.2,
                          1.6 * (i / (CUBES * CUBES)) - 7.2);
}

static void act_washer(bench_trial *t)
{
    const double angle = -TURNING * t->time, gravity[3] = {GRAVITY * sin(angle), -GRAVITY * cos(angle), 0.0};
    bench_trial_set_gravity(t, gravity);
}

// notes[0]: out of the drum, bodies times steps
static void watch_washer(bench_trial *t)
{
    for (int32_t i = 0; i < t->scene.body_count; i++) {
        const double *p = t->poses[i].position;
        t->notes[0] += t->scene.bodies[i].dynamic && (hypot(p[0], p[1]) > 16.3 || fabs(p[2]) > 10.0);
    }
}

static void judge_washer(bench_trial *t)
{
    // a cube that rides down a blade has the drop of the drum's 32 m
    bench_expect(t, "cubes out of the drum x steps", t->notes[0], 0.0, 0.0);
    bench_expect(t, "fastest cube, m/s", bench_highest(t->fastest, 0, t->step), 0.0, sqrt(2.0 * GRAVITY * 32.0));
    bench_expect(t, BENCH_DEEPEST, bench_deepest(t), 0.0,
                 8.0 * BENCH_LINEAR_SLOP); // 10 layers on a cube's corner, P1: 4 x 10 g/w2 = 11 mm
}

// ---- large world ---------------------------------------------------------------------------------------------------

enum { TILES = 100, DROPPED = 10 };

static void build_large_world(bench_scene *s)
{
    const int32_t tile = bench_box(s, 5.0, 0.25, 5.0, 1.0, 0.6), ball = bench_sphere(s, 0.5, 1000.0, 0.6);
    for (int32_t i = 0; i < TILES * TILES; i++)
        bench_add_static(s, tile, 10.0 * (i % TILES) - 495.0, 0.0, 10.0 * (i / TILES) - 495.0);
    for (int32_t i = 0; i < DROPPED * DROPPED; i++)
        bench_add_dynamic(s, ball, 80.0 * (i % DROPPED) - 360.0, 1.5 + 0.1 * i, 80.0 * (i / DROPPED) - 360.0);
}

static void judge_large_world(bench_trial *t)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int32_t i = TILES * TILES; i < t->scene.body_count; i++)
        low = fmin(low, t->poses[i].position[1]), high = fmax(high, t->poses[i].position[1]);
    bench_expect(t, "lowest ball, m", low, 0.75 - BENCH_LINEAR_SLOP, 0.75 + BENCH_LINEAR_SLOP);
    bench_expect(t, "highest ball, m", high, 0.75 - BENCH_LINEAR_SLOP, 0.75 + BENCH_LINEAR_SLOP);
    bench_expect_stray(t, BENCH_DRIFT, bench_largest_drift(t), BENCH_LINEAR_SLOP);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.05);
}

const bench_case bench_box3d_world[] = {
    {"needle-drop", "Box3D", "1024 thin boxes fall on waves", 5.0, 0, build_needles, NULL, NULL, judge_needles,
     BENCH_CHAOTIC_LONG},
    {"rain", "Box3D", "96 humans of 14 bones fall on waves", 10.0, 0, build_rain, NULL, NULL, judge_rain,
     BENCH_CHAOTIC_LONG},
    {"washer", "Box3D", "1000 cubes in a drum, gravity turns", 10.0, 0, build_washer, act_washer, watch_washer,
     judge_washer, BENCH_CHAOTIC_LONG},
    {"large-world", "Box3D", "100 balls on 10 000 tiles", 8.0, 0, build_large_world, NULL, NULL, judge_large_world,
     BENCH_CALM},
};
const int32_t bench_box3d_world_count = (int32_t)(sizeof bench_box3d_world / sizeof bench_box3d_world[0]);
