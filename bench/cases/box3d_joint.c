// Samples of Box3D with joints, as data (E. Catto, Box3D, 2025, samples).
#include "cases.h"

#include <math.h>

static const double GRAVITY = 10.0; // m/s2

// ---- ball and chain: 585:1 -----------------------------------------------------------------------------------------

enum { LINKS = 32 };

static void build_heavy_chain(bench_scene *s)
{
    const int32_t link = bench_capsule(s, 0.5, 0.125, 1000.0, 0.6);
    int32_t last = bench_add_anchor(s, 0.0, 0.0);
    for (int32_t i = 0; i < LINKS; i++) {
        const int32_t body = bench_add_dynamic(s, link, 0.5 + i, 0.0, 0.0);
        bench_turn_z(&s->bodies[body], 0.5 * BENCH_PI);
        s->bodies[body].collides = 0;
        bench_joint *joint = bench_add_ball(s, last, body, i, 0.0, 0.0);
        joint->motor_max = 10.0;
        last = body;
    }
    const int32_t ball = bench_add_dynamic(s, bench_sphere(s, 2.0, 1000.0, 0.6), LINKS + 2.0, 0.0, 0.0);
    s->bodies[ball].collides = 0;
    bench_add_joint(s, last, ball, LINKS, 0.0, 0.0);
}

// The links stretch by 3.3 times what the resting load opens them, at most (S22). An open joint between two links holds
// k gap2 / 2, k = half a link's mass x w2.
static void judge_heavy_chain(bench_trial *t)
{
    const double link = t->masses[1], ball = t->masses[LINKS + 1], stiffness = 0.5 * link * bench_joint_stiffness(t);
    const double gap = (ball + LINKS * link) * GRAVITY / stiffness, most = bench_highest(t->gap, 0, t->step);
    const double held = 0.5 * stiffness * most * most * (LINKS + 1);
    // speed and height are half a substep apart: m g v h / 2, rising and falling
    const double apart =
        (ball + LINKS * link) * GRAVITY * sqrt(2.0 * GRAVITY * LINKS) * (double)t->scene.dt / t->substeps;
    const int32_t half = t->step / 2;
    bench_expect_own_open(t, "largest sum of joint gaps, m", bench_highest(t->gaps, 0, t->step), 3.3 * gap * LINKS);
    bench_expect_own(t, "rise of the energy / what the joints can hold",
                     bench_rise(t->energy, 1, t->step) / (held + apart), 0.0, 1.0);
    bench_expect(t, "kinetic energy late / early",
                 bench_highest(t->kinetic, half, t->step) / bench_highest(t->kinetic, 0, half), 0.0, 1.0);
}

// ---- door: two hinges, a heavy blow at the free edge ---------------------------------------------------------------

static void build_door(bench_scene *s)
{
    const int32_t frame = bench_add_anchor(s, -0.75, 1.5);
    const int32_t door = bench_add_dynamic(s, bench_box(s, 0.75, 1.5, 0.1, 1000.0, 0.6), 0.0, 1.5, 0.0);
    s->bodies[door].gravity_scale = 2.0f;
    for (int32_t i = 0; i < 2; i++) {
        bench_joint *hinge = bench_add_hinge_z(s, frame, door, -0.75, 3.0 * i);
        hinge->axis[1] = 1.0, hinge->axis[2] = 0.0;
        hinge->has_limits = 1;
        hinge->limits[0] = -0.5 * BENCH_PI, hinge->limits[1] = 0.5 * BENCH_PI;
        hinge->stiffness_hertz = 120.0;
    }
}

static void act_door(bench_trial *t)
{
    const double impulse[3] = {0.0, 0.0, 50000.0}, point[3] = {0.75, 1.5, 0.0};
    if (t->step == 60) bench_trial_hit(t, 1, impulse, point);
}

// note 0: largest angle
static void watch_door(bench_trial *t)
{
    const double *q = t->poses[1].rotation;
    t->notes[0] = fmax(t->notes[0], fabs(2.0 * atan2(q[1], q[3])));
}

static void judge_door(bench_trial *t)
{
    bench_expect_open(t, BENCH_GAP, bench_highest(t->gap, 0, t->step), 0.05);
    bench_expect_open(t, "joint gap a second after the blow, m", bench_highest(t->gap, 120, t->step),
                      BENCH_LINEAR_SLOP);
    bench_expect(t, "largest angle, rad", t->notes[0], 0.0, 0.5 * BENCH_PI + 10.0 * BENCH_PI / 180.0);
}

// ---- ball joint with a cone and a twist range ----------------------------------------------------------------------

static void build_cone(bench_scene *s)
{
    const int32_t anchor = bench_add_anchor(s, 0.0, 5.5);
    const int32_t box = bench_add_dynamic(s, bench_box(s, 0.5, 1.5, 0.25, 100.0, 0.6), 0.0, 4.0, 0.0);
    bench_joint *joint = bench_add_ball(s, anchor, box, 0.0, 5.5, 0.0);
    joint->axis[1] = -1.0;
    joint->cone = 30.0 * BENCH_PI / 180.0;
    joint->has_limits = 1;
    joint->limits[0] = -35.0 * BENCH_PI / 180.0, joint->limits[1] = 35.0 * BENCH_PI / 180.0;
    s->bodies[box].linear_velocity[0] = 8.0f, s->bodies[box].linear_velocity[2] = 4.0f;
    s->bodies[box].angular_velocity[1] = 6.0f;
}

// note 0: largest swing beyond the cone; note 1: largest twist beyond the range
static void watch_cone(bench_trial *t)
{
    const double *q = t->poses[1].rotation, degree = BENCH_PI / 180.0;
    const double twist = 2.0 * atan2(fabs(q[1]), fabs(q[3]));
    t->notes[0] = fmax(t->notes[0], bench_tilt(t, 1) - 30.0 * degree);
    t->notes[1] = fmax(t->notes[1], twist - 35.0 * degree);
}

static void judge_cone(bench_trial *t)
{
    const double degree = BENCH_PI / 180.0;
    bench_expect(t, "swing beyond 30 degrees, rad", t->notes[0], -1.0, 3.0 * degree);
    bench_expect(t, "twist beyond 35 degrees, rad", t->notes[1], -1.0, 3.0 * degree);
    bench_expect_open(t, BENCH_GAP, bench_highest(t->gap, 0, t->step), 4.0 * BENCH_LINEAR_SLOP);
    bench_expect(t, "largest rise of the energy, share", bench_rise(t->energy, 1, t->step) / t->energy[0], 0.0, 0.01);
}

// ---- six sliders in a row, torn at ---------------------------------------------------------------------------------

enum { SLIDERS = 6 };

static void build_sliders(bench_scene *s)
{
    const int32_t cube = bench_box(s, 0.5, 0.5, 0.5, 1000.0, 0.6);
    int32_t last = bench_add_anchor(s, 0.0, 0.0);
    for (int32_t i = 0; i < SLIDERS; i++) {
        const int32_t body = bench_add_dynamic(s, cube, 0.0, 0.6 + 1.2 * i, 0.0);
        s->bodies[body].collides = 0;
        bench_joint *slider = bench_add_ball(s, last, body, 0.0, 1.2 * i, 0.0);
        slider->kind = BENCH_SLIDER;
        slider->axis[0] = 1.0;
        slider->has_limits = 1;
        slider->limits[0] = -6.0, slider->limits[1] = 6.0;
        slider->stiffness_hertz = 240.0;
        last = body;
    }
    s->gravity[1] = 0.0;
}

static void act_sliders(bench_trial *t)
{
    const double force[3] = {1e5, 5e4, 5e4};
    if (t->time < 2.0) bench_trial_push(t, SLIDERS, force);
}

static void judge_sliders(bench_trial *t)
{
    double off = 0.0;
    for (int32_t i = 1; i <= SLIDERS; i++) {
        const double *p = t->poses[i].position, *start = t->scene.bodies[i].start.position;
        off = fmax(off, hypot(p[1] - start[1], p[2] - start[2]));
    }
    bench_expect(t, "off the line 2 s after the pull, m", off, 0.0, BENCH_LINEAR_SLOP);
    bench_expect(t, "way of the last, m", bench_drift(t, SLIDERS), 0.0, 6.0 * SLIDERS + 1.0);
}

const bench_case bench_box3d_joint[] = {
    {"heavy-chain", "Box3D", "32 links and a ball of 585 times their mass", 30.0, 0, build_heavy_chain, NULL, NULL,
     judge_heavy_chain, BENCH_CALM},
    {"door", "Box3D", "a door on two hinges is struck", 5.0, 0, build_door, act_door, watch_door, judge_door,
     BENCH_CALM},
    {"cone", "Box3D", "a box swings and twists in its limits", 10.0, 0, build_cone, NULL, watch_cone, judge_cone,
     BENCH_CALM},
    {"sliders", "Box3D", "six sliders in a row, torn at", 4.0, 0, build_sliders, act_sliders, NULL, judge_sliders,
     BENCH_CALM},
};
const int32_t bench_box3d_joint_count = (int32_t)(sizeof bench_box3d_joint / sizeof bench_box3d_joint[0]);
