// Scenes of Jolt (J. Rouwe, Jolt Physics, performance test and samples) and of SimBenchmark (D. Kang, J. Hwangbo,
// 2018), as data.
#include "cases.h"

#include "../random.h"

#include <math.h>

static const double EARTH = 9.81; // m/s2

static void set_earth(bench_scene *s) { s->gravity[1] = -EARTH; }

// ---- Jolt: a square pyramid of boxes, each half a metre above the one below ----------------------------------------

enum { LEVELS = 15 };

static void build_jolt_pyramid(bench_scene *s)
{
    const int32_t box = bench_box(s, 1.0, 1.0, 1.0, 1000.0, 0.5);
    set_earth(s);
    bench_add_ground(s, 50.0, 0.5);
    for (int32_t i = 0; i < LEVELS; i++) {
        for (int32_t j = i / 2; j < LEVELS - (i + 1) / 2; j++) {
            for (int32_t k = i / 2; k < LEVELS - (i + 1) / 2; k++)
                bench_add_dynamic(s, box, -LEVELS + 2.0 * j + i % 2, 1.0 + 2.5 * i, -LEVELS + 2.0 * k + i % 2);
        }
    }
}

// It falls together by half a metre a level: 7 m at the top, 11.7 m/s.
static void judge_jolt_pyramid(bench_trial *t)
{
    const int32_t top = t->scene.body_count - 1;
    bench_expect(t, "height of the top / nominal", t->poses[top].position[1] / (2.0 * LEVELS - 1.0), 0.97, 1.01);
    bench_expect_stray(t, "sideways way of the top, m", bench_drift(t, top), 1.0); // more, and it would have fallen off
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.05);
}

// ---- Jolt: high speed ----------------------------------------------------------------------------------------------

enum { FAST = 48 };
static const double ROOM = 10.0, THIN = 0.1; // m: half the room, half its walls' thickness

static void build_high_speed(bench_scene *s)
{
    uint64_t state = 0x9e3779b97f4a7c15u;
    const int32_t forms[3] = {bench_sphere(s, 0.2, 1000.0, 0.2), bench_box(s, 0.2, 0.2, 0.2, 1000.0, 0.2),
                              bench_capsule(s, 0.2, 0.1, 1000.0, 0.2)};
    for (int axis = 0; axis < 3; axis++) {
        double half[3] = {ROOM + 2.0 * THIN, ROOM + 2.0 * THIN, ROOM + 2.0 * THIN}, at[3] = {0.0, 0.0, 0.0};
        half[axis] = THIN;
        const int32_t wall = bench_box(s, half[0], half[1], half[2], 1.0, 0.2);
        for (int side = -1; side <= 1; side += 2) {
            at[axis] = side * (ROOM + THIN);
            bench_add_static(s, wall, at[0], at[1], at[2]);
        }
    }
    for (int32_t i = 0; i < FAST; i++) {
        const int32_t added =
            bench_add_dynamic(s, forms[i % 3], 3.0 * (i % 4) - 4.5, 3.0 * (i / 16) - 3.0, 3.0 * (i / 4 % 4) - 4.5);
        bench_body *body = &s->bodies[added];
        double way[3], square = 0.0;
        for (int k = 0; k < 3; k++) way[k] = 2.0 * bench_random(&state) - 1.0, square += way[k] * way[k];
        for (int k = 0; k < 3; k++) body->linear_velocity[k] = (float)(250.0 * way[k] / sqrt(square));
    }
}

// notes[0]: outside, bodies times steps
static void watch_high_speed(bench_trial *t)
{
    for (int32_t i = 6; i < t->scene.body_count; i++) {
        const double *p = t->poses[i].position;
        t->notes[0] += fmax(fabs(p[0]), fmax(fabs(p[1]), fabs(p[2]))) > ROOM + THIN;
    }
}

static void judge_high_speed(bench_trial *t)
{
    bench_expect(t, "share of their time outside", t->notes[0] / (FAST * t->step), 0.0, 0.0);
    bench_expect(t, "largest rise of the energy, share", bench_rise(t->energy, 0, t->step) / t->energy[0], 0.0, 1e-3);
}

// ---- SimBenchmark: rolling -----------------------------------------------------------------------------------------

enum { BALLS = 25, PLATE = 1 };
static const double PUSH = 150.0, A_PLATE = 0.7385,
                    A_BALL = 0.2110; // N; m/s2, of the plate and, 2/7 of it, of what rolls on it

static void build_rolling(bench_scene *s)
{
    // pair friction 0.4 between ground and plate, 0.8 between plate and balls
    const int32_t plate = bench_box(s, 10.0, 0.5, 10.0, 10.0 / 400.0, 0.8);
    const int32_t ball = bench_sphere(s, 0.5, 1.0 / (4.0 / 3.0 * BENCH_PI * 0.125), 0.8);
    set_earth(s);
    bench_add_ground(s, 100.0, 0.2);
    bench_add_dynamic(s, plate, 0.0, 0.5, 0.0);
    for (int32_t i = 0; i < BALLS; i++) bench_add_dynamic(s, ball, 2.0 * (i % 5) - 4.0, 1.5, 2.0 * (i / 5) - 4.0);
}

static void push(bench_trial *t, double x, double z)
{
    const double force[3] = {PUSH * x, 0.0, PUSH * z};
    bench_trial_push(t, PLATE, force);
}

static void act_rolling(bench_trial *t) { push(t, 1.0, 0.0); }

static void act_rolling_60(bench_trial *t) { push(t, 0.5, 0.5 * sqrt(3.0)); }

// notes[0], [1]: sums of the squared errors of velocity
static void note_errors(bench_trial *t, double x, double z)
{
    for (int32_t i = PLATE; i < t->scene.body_count; i++) {
        const double speed = t->time * (i == PLATE ? A_PLATE : A_BALL), *v = t->motions[i].linear;
        const double square =
            (v[0] - speed * x) * (v[0] - speed * x) + v[1] * v[1] + (v[2] - speed * z) * (v[2] - speed * z);
        t->notes[i == PLATE ? 0 : 1] += square / (i == PLATE ? 1.0 : BALLS) / t->step_count;
    }
}

static void watch_rolling(bench_trial *t) { note_errors(t, 1.0, 0.0); }

static void watch_rolling_60(bench_trial *t) { note_errors(t, 0.5, 0.5 * sqrt(3.0)); }

static void expect_rolling(bench_trial *t, double heading)
{
    const double *v = t->motions[PLATE].linear, degree = BENCH_PI / 180.0;
    bench_expect(t, "mean squared error of velocity, m2/s2", t->notes[0] + t->notes[1], 0.0, 1e-3);
    bench_expect(t, "heading off the force, rad", fabs(atan2(v[2], v[0]) - heading), 0.0, 0.5 * degree);
}

static void judge_rolling(bench_trial *t) { expect_rolling(t, 0.0); }

static void judge_rolling_60(bench_trial *t) { expect_rolling(t, BENCH_PI / 3.0); }

// ---- SimBenchmark: bouncing ----------------------------------------------------------------------------------------

enum { BOUNCING = 7 };

static void build_bouncing(bench_scene *s)
{
    const int32_t ball = bench_sphere(s, 0.1, 10.0 / (4.0 / 3.0 * BENCH_PI * 0.001), 0.0),
                  ground = bench_box(s, 50.0, 1.0, 50.0, 1.0, 0.0);
    s->shapes[ball].restitution = s->shapes[ground].restitution = 1.0f;
    set_earth(s);
    bench_add_static(s, ground, 0.0, -1.0, 0.0);
    for (int32_t i = 0; i < BOUNCING * BOUNCING; i++)
        bench_add_dynamic(s, ball, 2.0 * (i % BOUNCING) - 6.0, 5.0, 2.0 * (i / BOUNCING) - 6.0);
}

// The scheme's energy swings by m g h v/2 within each flight (P3): at 10 m/s and h = 1/240, 0.4 % of the start.
static void judge_bouncing(bench_trial *t)
{
    double sum = 0.0;
    for (int32_t i = 0; i <= t->step; i++) sum += pow(t->energy[i] / t->energy[0] - 1.0, 2.0);
    bench_expect(t, "rms error of the energy, share", sqrt(sum / (t->step + 1)), 0.0, 0.03);
    bench_expect(t, "largest energy / start", bench_highest(t->energy, 0, t->step) / t->energy[0], 0.0, 1.004);
}

// ---- SimBenchmark: elastic 666 -------------------------------------------------------------------------------------

enum { DROPPED = 6 };

// A cube of 6 x 6 x 6 balls without friction, 1 cm apart and off their places by up to 1 mm, falls from 1.1 m and
// becomes a gas.
static void build_elastic(bench_scene *s)
{
    uint64_t state = 0x2545f4914f6cdd1du;
    s->always_bounce = 1;
    const int32_t ball = bench_sphere(s, 0.1, 10.0 / (4.0 / 3.0 * BENCH_PI * 0.001), 0.0),
                  ground = bench_box(s, 250.0, 1.0, 250.0, 1.0, 0.0);
    s->shapes[ball].restitution = s->shapes[ground].restitution = 1.0f;
    set_earth(s);
    bench_add_static(s, ground, 0.0, -1.0, 0.0);
    for (int32_t i = 0; i < DROPPED * DROPPED * DROPPED; i++) {
        const double at[3] = {0.21 * (i % DROPPED), 1.101 + 0.21 * (i / (DROPPED * DROPPED)),
                              0.21 * (i / DROPPED % DROPPED)};
        double off[3];
        for (int k = 0; k < 3; k++) off[k] = 0.001 * bench_random(&state);
        bench_add_dynamic(s, ball, at[0] + off[0], at[1] + off[1], at[2] + off[2]);
    }
}

// The scheme's energy swings by h v / (2 height) of itself within a flight (P3): 0.7 % at 5.6 m/s, 1.6 m and h = 1/240.
// Published mean squared errors with steps of 10 ms: RaiSim 5.2e6, ODE 8.6e6, Bullet 9.9e6, DART 1.3e10 J2.
static void judge_elastic(bench_trial *t)
{
    double sum = 0.0;
    for (int32_t i = 0; i <= t->step; i++) sum += pow(t->energy[i] - t->energy[0], 2.0);
    bench_expect(t, "mean squared error of the energy, J2", sum / (t->step + 1), 0.0, 5.2e6);
    bench_expect(t, "largest energy / start", bench_highest(t->energy, 0, t->step) / t->energy[0], 0.0, 1.007);
}

// ---- Painleve's rods: slide on a tip where rigid bodies with friction have no consistent force ---------------------

static const double LEANING = 63.0 * BENCH_PI / 180.0, ROD = 0.5,
                    TIP = 0.02; // rad off the floor; m: half the axis, radius

static void build_painleve(bench_scene *s)
{
    const int32_t rod = bench_capsule(s, ROD, TIP, 1000.0, 2.0);
    set_earth(s);
    bench_add_ground(s, 100.0, 2.0);
    for (int side = -1; side <= 1; side += 2) {
        const int32_t body = bench_add_dynamic(s, rod, 0.0, ROD * sin(LEANING) + TIP, 2.0 * side);
        bench_turn_z(&s->bodies[body], LEANING - 0.5 * BENCH_PI);
        s->bodies[body].linear_velocity[0] = (float)(5.0 * side);
    }
}

// It jams or hops: neither gives it more energy than it has
static void judge_painleve(bench_trial *t)
{
    bench_expect(t, "largest energy / start", bench_highest(t->energy, 0, t->step) / t->energy[0], 0.0, 1.001);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 5.0);
}

const bench_case bench_others[] = {
    {"jolt-pyramid", "Jolt", "1240 boxes fall together into a pyramid", 10.0, 0, build_jolt_pyramid, NULL, NULL,
     judge_jolt_pyramid, BENCH_CALM},
    {"high-speed", "Jolt", "48 bodies at 250 m/s in a room of thin walls", 3.0, 0, build_high_speed, NULL,
     watch_high_speed, judge_high_speed, BENCH_CALM},
    {"rolling", "SimBenchmark", "25 balls on a plate that is pushed", 4.0, 0, build_rolling, act_rolling, watch_rolling,
     judge_rolling, BENCH_CALM},
    {"rolling-60", "SimBenchmark", "pushed at 60 degrees", 4.0, 0, build_rolling, act_rolling_60, watch_rolling_60,
     judge_rolling_60, BENCH_CALM},
    {"painleve", "P. Painleve, 1895", "two rods slide on a tip with friction 2", 4.0, 0, build_painleve, NULL, NULL,
     judge_painleve, BENCH_CALM},
    {"elastic-666", "SimBenchmark", "a cube of 216 balls falls and becomes a gas", 10.0, 0, build_elastic, NULL, NULL,
     judge_elastic, BENCH_CALM},
    {"bouncing", "SimBenchmark", "49 balls bounce without loss", 20.0, 0, build_bouncing, NULL, NULL, judge_bouncing,
     BENCH_CALM},
};
const int32_t bench_others_count = (int32_t)(sizeof bench_others / sizeof bench_others[0]);
