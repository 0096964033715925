// Solver2D's samples of joints (E. Catto, Solver2D, 2024, samples/sample_joints.cpp): bridges, chains and grids that stretch in every
// solver of soft constraints: a joint rests at a gap of force / (effective mass w2). See solver2d_stack.c for what all share.
#include "cases.h"

#include <math.h>

static const double GRAVITY = 10.0; // m/s2

// A static body that touches nothing, for joints to hold on to
static int32_t add_anchor(bench_scene *s, double x, double y)
{
    const int32_t body = bench_add_static(s, bench_box(s, 0.1, 0.1, 0.1, 1.0, 0.6), x, y, 0.0);
    s->bodies[body].collides = 0;
    return body;
}

static void damp(bench_scene *s, int32_t body)
{
    s->bodies[body].linear_damping = s->bodies[body].angular_damping = 0.1f;
    s->bodies[body].collides = 0;
}

// ---- bridge: 160 planks without any slack
// ------------------------------------------------------------------------------------------------

enum { PLANKS = 160 };

static void build_bridge(bench_scene *s)
{
    const int32_t plank = bench_box(s, 0.5, 0.125, 0.5, 20.0, 0.6);
    int32_t last = add_anchor(s, -80.0, 20.0);
    for (int32_t i = 0; i < PLANKS; i++) {
        const int32_t body = bench_add_dynamic(s, plank, -79.5 + i, 20.0, 0.0);
        damp(s, body);
        bench_add_hinge_z(s, last, body, -80.0 + i, 20.0);
        last = body;
    }
    bench_add_hinge_z(s, last, add_anchor(s, 80.0, 20.0), 80.0, 20.0);
}

// Rigid joints would need an infinite tension: what sags is the sum of the gaps, sag = sqrt(3/8 length x gaps). A tension T = weight x
// length / (8 sag) opens each joint by T / (half a plank's mass x w2); solved for the sag: sag^3 = 3/8 length^2 weight / (8 x half plank x
// w2) x joints / length.
static void judge_bridge(bench_trial *t)
{
    const double length = PLANKS, mass = 5.0, weight = PLANKS * mass * GRAVITY, joints = PLANKS + 1;
    const double sag = cbrt(0.375 * length * joints * weight * length / (8.0 * 0.5 * mass * bench_joint_stiffness(t)));
    const double tension = weight * length / (8.0 * sag), gap = tension / (0.5 * mass * bench_joint_stiffness(t));
    double lowest = HUGE_VAL;
    for (int32_t i = 1; i < t->scene.body_count; i++) lowest = fmin(lowest, t->poses[i].position[1]);
    const int32_t five = bench_step_at(t, 5.0), ten = bench_step_at(t, 10.0), fifteen = bench_step_at(t, 15.0);
    bench_expect_own(t, "sag, m", 20.0 - lowest, 0.8 * sag, 1.2 * sag);
    bench_expect_own(t, "joint gap at the end, m", t->gap[t->step], 0.0, 1.2 * gap + BENCH_LINEAR_SLOP);
    bench_expect(t, "speed late / early (rms)", bench_rms(t->fastest, fifteen, t->step) / bench_rms(t->fastest, five, ten), 0.0, 0.5);
}

// ---- ball and chain: 672:1
// -----------------------------------------------------------------------------------------------------------------

enum { LINKS = 40 };

static void build_ball_and_chain(bench_scene *s)
{
    const int32_t link = bench_capsule(s, 0.5, 0.125, 20.0, 0.6);
    int32_t last = add_anchor(s, 0.0, 20.0);
    for (int32_t i = 0; i < LINKS; i++) {
        const int32_t body = bench_add_dynamic(s, link, 0.5 + i, 20.0, 0.0);
        bench_turn_z(&s->bodies[body], 0.5 * BENCH_PI);
        damp(s, body);
        bench_add_hinge_z(s, last, body, i, 20.0);
        last = body;
    }
    const int32_t ball =
        bench_add_dynamic(s, bench_sphere(s, 8.0, 20.0 * 0.09375, 0.6), 48.0, 20.0, 0.0); // the mass of a disc of density 20
    damp(s, ball);
    bench_add_hinge_z(s, last, ball, 40.0, 20.0);
}

static void judge_ball_and_chain(bench_trial *t)
{
    const double link = t->masses[1], ball = t->masses[LINKS + 1];
    const double gap = (ball + LINKS * link) / link * 2.0 * GRAVITY / bench_joint_stiffness(t);
    const int32_t half = t->step / 2;
    bench_expect_own(t, BENCH_GAP, bench_highest(t->gap, 0, t->step), 0.0, 3.3 * gap);
    bench_expect(t, "energy never rises, share", bench_rise(t->energy, 1, t->step) / fabs(t->energy[0]), 0.0, 0.02);
    bench_expect(t, "kinetic energy late / early", bench_highest(t->kinetic, half, t->step) / bench_highest(t->kinetic, 0, half), 0.0, 1.0);
}

// ---- joint grid: a heavy net on seven anchors
// -------------------------------------------------------------------------------------------------

enum { GRID = 100 };

static void build_joint_grid(bench_scene *s)
{
    const int32_t ball = bench_sphere(s, 0.4, 1.0, 0.6);
    for (int32_t k = 0; k < GRID; k++) {
        for (int32_t i = 0; i < GRID; i++) {
            const int32_t is_static = i == 0 && k >= GRID / 2 - 3 && k <= GRID / 2 + 3;
            const int32_t body = is_static ? bench_add_static(s, ball, k, -i, 0.0) : bench_add_dynamic(s, ball, k, -i, 0.0);
            s->bodies[body].collides = 0;
            s->bodies[body].gravity_scale = 2.0f;
            if (i > 0) bench_add_hinge_z(s, body - 1, body, k, 0.5 - i);
            if (k > 0) bench_add_hinge_z(s, body - GRID, body, k - 0.5, -i);
        }
    }
}

// Seven anchors carry 9993 balls: a seventh of the weight in a joint between an anchor and a ball.
static void judge_joint_grid(bench_trial *t)
{
    const double ball = t->masses[0], load = (GRID * GRID - 7) * ball * 2.0 * GRAVITY / 7.0;
    const double gap = load / (ball * bench_joint_stiffness(t));
    const int32_t ten = bench_step_at(t, 10.0);
    bench_expect_own(t, BENCH_GAP, bench_highest(t->gap, 0, t->step), 0.0, 3.3 * gap);
    bench_expect(t, "kinetic energy after 10 s / its largest", t->kinetic[ten] / bench_highest(t->kinetic, 0, ten), 0.0, 0.9);
}

// ---- stretched chain: every joint starts a metre open
// --------------------------------------------------------------------------------------------

static void build_stretched_chain(bench_scene *s)
{
    const int32_t ball = bench_sphere(s, 0.2, 1.0, 0.6);
    int32_t last = add_anchor(s, 0.0, 40.0);
    for (int32_t i = 0; i < LINKS; i++) {
        const int32_t body = bench_add_dynamic(s, ball, 0.0, 38.0 - 2.0 * i, 0.0);
        s->bodies[body].collides = 0;
        bench_joint *joint = bench_add_hinge_z(s, last, body, 0.0, i == 0 ? 39.5 : 39.5 - 2.0 * i);
        joint->is_open = 1;
        joint->anchor_b[1] = 38.5 - 2.0 * i;
        last = body;
    }
}

static void judge_stretched_chain(bench_trial *t)
{
    const double gap = 2.0 * LINKS * GRAVITY / bench_joint_stiffness(t);
    const double released = 0.5 * bench_joint_stiffness(t) * t->masses[1] * LINKS; // of LINKS springs of a link's mass, open by 1 m
    bench_expect_own(t, "joint gap at the end, m", t->gap[t->step], 0.0, gap + BENCH_LINEAR_SLOP);
    bench_expect_own(t, "kinetic energy / what the open joints hold", bench_highest(t->kinetic, 0, t->step) / released, 0.0, 1.0);
    bench_expect(t, "height of the last ball, m", t->poses[LINKS].position[1], -LINKS * gap, 0.5 + LINKS * gap);
}

const bench_case bench_solver2d_joint[] = {
    {"bridge", "Solver2D", "160 planks without slack", 20.0, 1, build_bridge, NULL, NULL, judge_bridge},
    {"ball-and-chain", "Solver2D", "40 links and a ball of 670 times their mass", 40.0, 1, build_ball_and_chain, NULL, NULL,
     judge_ball_and_chain},
    {"joint-grid", "Solver2D", "a net of 10000 balls on seven anchors", 12.0, 1, build_joint_grid, NULL, NULL, judge_joint_grid},
    {"stretched-chain", "Solver2D", "a chain whose joints start a metre open", 10.0, 1, build_stretched_chain, NULL, NULL,
     judge_stretched_chain},
};
const int32_t bench_solver2d_joint_count = (int32_t)(sizeof bench_solver2d_joint / sizeof bench_solver2d_joint[0]);
