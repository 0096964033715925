// Samples of Box3D that stack, as data (E. Catto, Box3D, 2025, samples): 60 Hz, gravity 10 m/s2, friction 0.6, density
// 1000 unless told.
#include "cases.h"

#include <math.h>

static const double GRAVITY = 10.0; // m/s2

static void add_rolling(bench_scene *s, int32_t shape, double rolling) { s->shapes[shape].rolling = (float)rolling; }

// ---- sphere stack, capsule stack, box stack ------------------------------------------------------------------------

enum { SPHERES = 30, CAPSULES = 20, BOXES = 40 };

static void build_sphere_stack(bench_scene *s)
{
    const int32_t sphere = bench_sphere(s, 0.5, 1000.0, 0.6);
    add_rolling(s, sphere, 0.1);
    bench_add_ground(s, 15.0, 0.6);
    for (int32_t i = 0; i < SPHERES; i++) bench_add_dynamic(s, sphere, 0.0, 0.75 + 1.5 * i, 0.0);
}

// Two equal bodies on one point: effective mass m/2, m on the ground
static double column_sink(const bench_trial *t, double n)
{
    return GRAVITY * (n * (n - 1.0) / bench_contact_stiffness(t, 0) + n / bench_contact_stiffness(t, 1));
}

static void judge_column(bench_trial *t, double nominal, double sink)
{
    const int32_t top = t->scene.body_count - 1;
    bench_expect_own(t, "sink of the top, m", nominal - t->poses[top].position[1], 0.8 * sink - BENCH_LINEAR_SLOP,
                     1.25 * sink + BENCH_LINEAR_SLOP);
    bench_expect(t, "height of the top / nominal", t->poses[top].position[1] / nominal, 0.9, 1.05);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.05);
}

static void judge_sphere_stack(bench_trial *t)
{
    judge_column(t, SPHERES - 0.5, column_sink(t, SPHERES));
    bench_expect_stray(t, BENCH_DRIFT, bench_largest_drift(t), 0.0);
}

static void build_capsule_stack(bench_scene *s)
{
    const int32_t capsule = bench_capsule(s, 1.0, 0.5, 1000.0, 0.6);
    bench_add_ground(s, 15.0, 0.6);
    for (int32_t i = 0; i < CAPSULES; i++) {
        const int32_t body = bench_add_dynamic(s, capsule, 0.0, 0.75 + i, 0.0);
        bench_turn_z(&s->bodies[body], 0.5 * BENCH_PI);
        s->bodies[body].linear_locks = 4, s->bodies[body].angular_locks = 7;
    }
}

// Change of its rotation's components. (A sum: gcc 12 for AArch64 fails on the maximum of a vector.)
static double turned_by(const bench_trial *t, int32_t i)
{
    double sum = 0.0;
    for (int k = 0; k < 4; k++)
        sum += fabs(t->poses[i].rotation[k] - (double)(float)t->scene.bodies[i].start.rotation[k]);
    return sum;
}

// Two points share the load but none turns: effective mass of each is that of the bodies
static void judge_capsule_stack(bench_trial *t)
{
    double off = 0.0;
    for (int32_t i = 1; i <= CAPSULES; i++) off = fmax(off, fmax(fabs(t->poses[i].position[2]), turned_by(t, i)));
    judge_column(t, CAPSULES - 0.5, 0.5 * column_sink(t, CAPSULES));
    bench_expect(t, "change of what is locked", off, 0.0, 1e-7);
}

static void build_box_stack(bench_scene *s)
{
    const int32_t box = bench_box(s, 0.5, 0.5, 0.5, 1000.0, 0.6);
    add_rolling(s, box, 0.1);
    bench_add_ground(s, 40.0, 0.6);
    for (int32_t i = 0; i < BOXES; i++) bench_add_dynamic(s, box, 0.0, 0.75 + 1.25 * i, 0.0);
}

static void judge_box_stack(bench_trial *t)
{
    judge_column(t, BOXES - 0.5, bench_face_factor(t) * column_sink(t, BOXES));
    bench_expect_stray(t, BENCH_DRIFT, bench_largest_drift(t), 0.2);
}

// ---- domino rings --------------------------------------------------------------------------------------------------

enum { RINGS = 30, IN_RING = 181 };

static void build_domino_rings(bench_scene *s)
{
    const int32_t domino = bench_box(s, 0.2, 0.8, 0.05, 1000.0, 0.6);
    bench_add_ground(s, 60.0, 0.6);
    for (int32_t ring = 0; ring < RINGS; ring++) {
        const double radius = 7.0 + 1.1 * ring;
        for (int32_t i = 0; i < IN_RING; i++) {
            const double alpha = 2.0 * i, angle = alpha * BENCH_PI / 180.0;
            const double x = radius * cos(angle) - alpha / 630.0 * cos(angle),
                         z = radius * sin(angle) - alpha / 630.0 * sin(angle);
            const int32_t body = bench_add_dynamic(s, domino, x, 0.8, z);
            bench_turn(&s->bodies[body], 0.0, 1.0, 0.0, -angle);
        }
    }
}

static void act_domino_rings(bench_trial *t)
{
    if (t->step != 0) return;
    for (int32_t ring = 0; ring < RINGS; ring++) {
        const int32_t first = 1 + ring * IN_RING;
        const double *p = t->poses[first].position, impulse[3] = {0.0, 0.0, 25.0}, point[3] = {p[0], p[1] + 0.8, p[2]};
        bench_trial_hit(t, first, impulse, point);
    }
}

static void judge_domino_rings(bench_trial *t)
{
    int32_t fallen = 0;
    for (int32_t i = 1; i < t->scene.body_count; i++) fallen += t->tracks[i].tilt > 0.25 * BENCH_PI;
    bench_expect(t, "dominoes that stand", t->scene.body_count - 1 - fallen, 0.0, 0.0);
    bench_expect(t, "largest rise of the energy, share", bench_rise(t->energy, 1, t->step) / t->energy[1], 0.0, 1e-4);
}

// ---- pyramid in a plane of locks -----------------------------------------------------------------------------------

enum { LOCKED_ROWS = 12 };

static void build_locked_pyramid(bench_scene *s)
{
    const int32_t box = bench_box(s, 1.0, 1.0, 1.0, 1000.0, 0.6);
    bench_add_ground(s, 60.0, 0.6);
    for (int32_t r = 0; r < LOCKED_ROWS; r++) {
        for (int32_t c = 0; c < LOCKED_ROWS - r; c++) {
            const int32_t body = bench_add_dynamic(s, box, -10.0 + 2.0 * c + r, 1.5 + 2.5 * r, 0.0);
            s->bodies[body].linear_locks = 4, s->bodies[body].angular_locks = 3;
        }
    }
}

static void judge_locked_pyramid(bench_trial *t)
{
    const int32_t top = t->scene.body_count - 1;
    const double n = LOCKED_ROWS, nominal = 2.0 * n - 1.0;
    const double sink = GRAVITY * (0.4375 * (n * (n + 1.0) / 2.0 - 1.0) / bench_contact_stiffness(t, 0) +
                                   (n + 1.0) / 2.0 / bench_contact_stiffness(t, 1));
    double off = 0.0;
    for (int32_t i = 1; i <= top; i++) off = fmax(off, fabs(t->poses[i].position[2]));
    bench_expect_stray(t, "way out of the plane, m", off, 0.0);
    bench_expect_own(t, "sink of the top, m", nominal - t->poses[top].position[1], 0.5 * sink - BENCH_LINEAR_SLOP,
                     1.25 * sink + BENCH_LINEAR_SLOP);
    bench_expect_stray(t, "sideways way of the top, m", bench_drift(t, top), 0.1);
}

// ---- hello world: Box3D's own unit test ----------------------------------------------------------------------------

static void build_hello(bench_scene *s)
{
    bench_add_ground(s, 50.0, 0.6);
    bench_add_dynamic(s, bench_box(s, 1.0, 1.0, 1.0, 1.0, 0.3), 0.0, 4.0, 0.0);
}

static void judge_hello(bench_trial *t)
{
    bench_expect(t, "height - 1, m", t->poses[1].position[1] - 1.0, -0.01, 0.01);
    bench_expect(t, "turn about x", t->poses[1].rotation[0], -0.01, 0.01);
    bench_expect(t, "turn about z", t->poses[1].rotation[2], -0.01, 0.01);
}

const bench_case bench_box3d_stack[] = {
    {"sphere-stack", "Box3D", "30 spheres on one another", 10.0, 0, build_sphere_stack, NULL, NULL, judge_sphere_stack,
     BENCH_CALM},
    {"capsule-stack", "Box3D", "20 locked capsules", 10.0, 0, build_capsule_stack, NULL, NULL, judge_capsule_stack,
     BENCH_CALM},
    {"box-stack-40", "Box3D", "40 boxes with gaps fall onto each other", 20.0, 0, build_box_stack, NULL, NULL,
     judge_box_stack, BENCH_CALM},
    {"domino-rings", "Box3D", "30 rings of 181 dominoes", 75.0, 0, build_domino_rings, act_domino_rings, NULL,
     judge_domino_rings, BENCH_CALM},
    {"locked-pyramid", "Box3D", "12 rows kept in a plane", 60.0, 0, build_locked_pyramid, NULL, NULL,
     judge_locked_pyramid, BENCH_CALM},
    {"hello", "Box3D, unit test", "a cube falls", 1.5, 1, build_hello, NULL, NULL, judge_hello, BENCH_CALM},
};
const int32_t bench_box3d_stack_count = (int32_t)(sizeof bench_box3d_stack / sizeof bench_box3d_stack[0]);
