// Solver2D's samples of joints (E. Catto, Solver2D, 2024, samples/sample_joints.cpp): bridges, chains and grids that
// stretch in every solver of soft constraints: a joint rests at a gap of force / (effective mass w2). See
// solver2d_stack.c for what all share.
#include "cases.h"

#include <math.h>

static const double GRAVITY = 10.0; // m/s2

static void damp(bench_scene *s, int32_t body)
{
    s->bodies[body].linear_damping = s->bodies[body].angular_damping = 0.1f;
    s->bodies[body].collides = 0;
}

// ---- bridge: 160 planks without any slack --------------------------------------------------------------------------

enum { PLANKS = 160 };

static void build_bridge(bench_scene *s)
{
    const int32_t plank = bench_box(s, 0.5, 0.125, 0.5, 20.0, 0.6);
    int32_t last = bench_add_anchor(s, -80.0, 20.0);
    for (int32_t i = 0; i < PLANKS; i++) {
        const int32_t body = bench_add_dynamic(s, plank, -79.5 + i, 20.0, 0.0);
        damp(s, body);
        bench_add_hinge_z(s, last, body, -80.0 + i, 20.0);
        last = body;
    }
    bench_add_hinge_z(s, last, bench_add_anchor(s, 80.0, 20.0), 80.0, 20.0);
}

// Rigid joints would need an infinite tension: what sags is the sum of the gaps, sag = sqrt(3/8 length x gaps). A
// tension T = weight x length / (8 sag) opens each joint by T / (half a plank's mass x w2); solved for the sag: sag^3 =
// 3/8 length^2 weight / (8 x half plank x w2) x joints / length.
static void judge_bridge(bench_trial *t)
{
    const double length = PLANKS, mass = 5.0, weight = PLANKS * mass * GRAVITY, joints = PLANKS + 1;
    const double sag = cbrt(0.375 * length * joints * weight * length / (8.0 * 0.5 * mass * bench_joint_stiffness(t)));
    const double tension = weight * length / (8.0 * sag), gap = tension / (0.5 * mass * bench_joint_stiffness(t));
    double lowest = HUGE_VAL;
    for (int32_t i = 1; i < t->scene.body_count; i++) lowest = fmin(lowest, t->poses[i].position[1]);
    const int32_t five = bench_step_at(t, 5.0), ten = bench_step_at(t, 10.0), fifteen = bench_step_at(t, 15.0);
    bench_expect_own(t, "sag, m", 20.0 - lowest, 0.8 * sag, 1.2 * sag);
    bench_expect_own_open(t, "joint gap at the end, m", t->gap[t->step], 1.2 * gap + BENCH_LINEAR_SLOP);
    // the planks' damping c = 0.1 alone takes exp(-c t / 2) of a swing in 10 s
    bench_expect(t, "speed late / early (rms)",
                 bench_rms(t->fastest, fifteen, t->step) / bench_rms(t->fastest, five, ten), 0.0, exp(-0.5));
}

// ---- ball and chain: 672:1 -----------------------------------------------------------------------------------------

enum { LINKS = 40 };

static void build_ball_and_chain(bench_scene *s)
{
    const int32_t link = bench_capsule(s, 0.5, 0.125, 20.0, 0.6);
    int32_t last = bench_add_anchor(s, 0.0, 20.0);
    for (int32_t i = 0; i < LINKS; i++) {
        const int32_t body = bench_add_dynamic(s, link, 0.5 + i, 20.0, 0.0);
        bench_turn_z(&s->bodies[body], 0.5 * BENCH_PI);
        damp(s, body);
        bench_add_hinge_z(s, last, body, i, 20.0);
        last = body;
    }
    const int32_t ball = bench_add_dynamic(s, bench_sphere(s, 8.0, 20.0, 0.6), 48.0, 20.0, 0.0);
    damp(s, ball);
    bench_add_hinge_z(s, last, ball, 40.0, 20.0);
}

// The links stretch by 3.3 times what the resting load opens them, at most. An open joint between two links holds k
// gap2 / 2, k = half a link's mass x w2.
static void judge_ball_and_chain(bench_trial *t)
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

// ---- joint grid: a heavy net on seven anchors ----------------------------------------------------------------------

enum { GRID = 100 };

static void build_joint_grid(bench_scene *s)
{
    const int32_t ball = bench_sphere(s, 0.4, 1.0, 0.6);
    for (int32_t k = 0; k < GRID; k++) {
        for (int32_t i = 0; i < GRID; i++) {
            const int32_t is_static = i == 0 && k >= GRID / 2 - 3 && k <= GRID / 2 + 3;
            const int32_t body =
                is_static ? bench_add_static(s, ball, k, -i, 0.0) : bench_add_dynamic(s, ball, k, -i, 0.0);
            s->bodies[body].collides = 0;
            s->bodies[body].gravity_scale = 2.0f;
            if (i > 0) bench_add_hinge_z(s, body - 1, body, k, 0.5 - i);
            if (k > 0) bench_add_hinge_z(s, body - GRID, body, k - 0.5, -i);
        }
    }
}

// Seven anchors carry 9993 balls: a seventh of the weight in the joints below an anchor, of which that between two
// balls opens the most.
static void judge_joint_grid(bench_trial *t)
{
    const double ball = t->masses[0], load = (GRID * GRID - 7) * ball * 2.0 * GRAVITY / 7.0;
    const double gap = load / (0.5 * ball * bench_joint_stiffness(t));
    const int32_t ten = bench_step_at(t, 10.0);
    bench_expect_own_open(t, BENCH_GAP, bench_highest(t->gap, 0, t->step), 3.3 * gap);
    bench_expect(t, "kinetic energy after 10 s / its largest", t->kinetic[ten] / bench_highest(t->kinetic, 0, ten), 0.0,
                 0.9);
}

// ---- stretched chain: every joint starts a metre open --------------------------------------------------------------

static void build_stretched_chain(bench_scene *s)
{
    const int32_t ball = bench_sphere(s, 0.2, 1.0, 0.6);
    int32_t last = bench_add_anchor(s, 0.0, 40.0);
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
    const double released =
        0.5 * bench_joint_stiffness(t) * t->masses[1] * LINKS; // of LINKS springs of a link's mass, open by 1 m
    bench_expect_own_open(t, "joint gap at the end, m", t->gap[t->step], gap + BENCH_LINEAR_SLOP);
    bench_expect_own(t, "kinetic energy / what the open joints hold", bench_highest(t->kinetic, 0, t->step) / released,
                     0.0, 1.0);
    bench_expect(t, "height of the last ball, m", t->poses[LINKS].position[1], -LINKS * gap, 0.5 + LINKS * gap);
}

// ---- ragdolls ------------------------------------------------------------------------------------------------------

// A bone: a capsule along y from `low` to `high` about `y`; its hinge to the parent at `joint`; range in half turns;
// friction in T = 0.025 scale N m.
static const struct bone {
    int32_t parent;
    double y, low, high, radius, joint, range[2], friction;
} bones[] = {
    {-1, 0.95, -0.02, 0.025, 0.095, 0.0, {0.0, 0.0}, 0.0},    // hip
    {0, 1.2, -0.135, 0.135, 0.09, 1.025, {-0.25, 0.0}, 0.5},  // torso
    {1, 1.5, -0.0325, 0.0325, 0.08, 1.4, {-0.3, 0.1}, 0.25},  // head
    {0, 0.775, -0.125, 0.125, 0.055, 0.9, {-0.05, 0.4}, 1.0}, // upper legs
    {3, 0.475, -0.14, 0.125, 0.045, 0.625, {-0.5, -0.02}, 0.5},
    {0, 0.775, -0.125, 0.125, 0.055, 0.9, {-0.05, 0.4}, 1.0},
    {5, 0.475, -0.14, 0.125, 0.045, 0.625, {-0.5, -0.02}, 0.5},
    {1, 1.225, -0.125, 0.125, 0.035, 1.35, {-0.05, 0.8}, 0.25}, // upper arms
    {7, 0.975, -0.125, 0.125, 0.03, 1.1, {0.01, 0.5}, 0.1},
    {1, 1.225, -0.125, 0.125, 0.035, 1.35, {-0.05, 0.8}, 0.25},
    {9, 0.975, -0.125, 0.125, 0.03, 1.1, {0.01, 0.5}, 0.1},
};
enum { BONES = (int)(sizeof bones / sizeof bones[0]) };

// Solver2D's human in the plane, without its feet and neck (a body has one form here). Returns the index of its hip.
static int32_t add_human(bench_scene *s, double x, double y, double scale, int32_t group)
{
    const int32_t first = s->body_count;
    for (int32_t i = 0; i < BONES; i++) {
        const struct bone *b = &bones[i];
        const int32_t form = bench_capsule(s, 0.5 * scale * (b->high - b->low), scale * b->radius, 1.0, 0.4);
        const int32_t body = bench_add_dynamic(s, form, x, y + scale * (b->y + 0.5 * (b->low + b->high)), 0.0);
        s->bodies[body].group = group;
        if (b->parent < 0) continue;
        bench_joint *joint = bench_add_hinge_z(s, first + b->parent, first + i, x, y + scale * b->joint);
        joint->has_limits = 1;
        for (int k = 0; k < 2; k++) joint->limits[k] = b->range[k] * BENCH_PI;
        joint->motor_max = 0.025 * scale * b->friction;
    }
    return first;
}

static double turn_about_z(const bench_trial *t, int32_t body)
{
    const double *q = t->poses[body].rotation;
    return 2.0 * atan2(q[2], q[3]);
}

// How far the worst hinge is beyond its range, rad
static double beyond_limits(const bench_trial *t)
{
    double worst = 0.0;
    for (int32_t i = 0; i < t->scene.joint_count; i++) {
        const bench_joint *j = &t->scene.joints[i];
        if (!j->has_limits || t->away[j->body_b]) continue;
        const double angle = remainder(turn_about_z(t, j->body_b) - turn_about_z(t, j->body_a), 2.0 * BENCH_PI);
        worst = fmax(worst, fmax(j->limits[0] - angle, angle - j->limits[1]));
    }
    return worst;
}

static void keep_in_plane(bench_scene *s)
{
    for (int32_t i = 0; i < s->body_count; i++) s->bodies[i].linear_locks = 4, s->bodies[i].angular_locks = 3;
}

static void build_ragdoll(bench_scene *s)
{
    bench_add_ground(s, 20.0, 0.6);
    add_human(s, 0.0, 4.0, 1.0, 1);
    keep_in_plane(s);
}

static void judge_ragdoll(bench_trial *t)
{
    bench_expect_open(t, "joint gap in the last second, m", bench_highest(t->gap, t->step - 60, t->step),
                      BENCH_LINEAR_SLOP);
    bench_expect(t, "beyond the limits at the end, rad", beyond_limits(t), 0.0, 3.0 * BENCH_PI / 180.0);
    bench_expect(t, BENCH_SPEED, bench_largest_speed(t), 0.0, 0.05);
}

static void build_far_ragdolls(bench_scene *s)
{
    static const double places[6][2] = {{0.0, 0.5}, {-0.2, 1.0}, {0.2, 1.0}, {-0.4, 1.5}, {0.4, 1.5}, {0.0, 2.0}};
    const int32_t slab = bench_box(s, 10.0, 0.5, 10.0, 1.0, 0.6);
    for (int32_t side = -1; side <= 1; side += 2) {
        const int32_t body = bench_add_static(s, slab, 5.0 * side, 1.0, 0.0);
        bench_turn_z(&s->bodies[body], 0.15 * BENCH_PI * side);
    }
    for (int32_t i = 0; i < 6; i++) add_human(s, places[i][0], places[i][1], 1.0, i + 1);
    keep_in_plane(s);
    for (int32_t i = 0; i < s->body_count; i++)
        s->bodies[i].start.position[0] += 6000.0, s->bodies[i].start.position[1] -= 1500.0;
    for (int32_t i = 0; i < s->joint_count; i++) s->joints[i].anchor[0] += 6000.0, s->joints[i].anchor[1] -= 1500.0;
}

// ---- ragdolls through a funnel with paddles ------------------------------------------------------------------------

// Every half second a human of twice the size comes in on top, on the left and on the right by turns; whose torso is
// below the funnel is taken away, and may come in again. Thirty-two at most at a time. (Solver2D lets them in 1.5 m
// higher, with their heads in the lid.)
enum { FUNNEL = 20, PADDLES = 3, HUMANS = 32, EVERY = 30, TORSO = 1, PANES = 2 };
static const double OUT_BELOW = -25.0; // m
static const double HALF_DEPTH = 2.0;  // m, of the funnel in space

static const double funnel[FUNNEL + 1][2] = {
    {-16.867, 31.089}, {16.867, 31.089},   {16.867, 17.198},  {8.268, 11.906},  {16.867, 11.906},  {16.867, -0.661},
    {8.268, -5.953},   {16.867, -5.953},   {16.867, -13.229}, {3.638, -23.151}, {3.638, -31.089},  {-3.638, -31.089},
    {-3.638, -23.151}, {-16.867, -13.229}, {-16.867, -5.953}, {-8.268, -5.953}, {-16.867, -0.661}, {-16.867, 11.906},
    {-8.268, 11.906},  {-16.867, 17.198},  {-16.867, 31.089},
};

// The walls, 1 m thick: capsules in the plane, boxes in space
static void add_funnel(bench_scene *s, int32_t of_boxes)
{
    for (int32_t i = 0; i < FUNNEL; i++) {
        const double x = funnel[i + 1][0] - funnel[i][0], y = funnel[i + 1][1] - funnel[i][1], half = 0.5 * hypot(x, y);
        const int32_t wall =
            of_boxes ? bench_box(s, 0.5, half + 0.5, HALF_DEPTH, 1.0, 0.2) : bench_capsule(s, half, 0.5, 1.0, 0.2);
        const int32_t body = bench_add_static(s, wall, funnel[i][0] + 0.5 * x, funnel[i][1] + 0.5 * y, 0.0);
        bench_turn_z(&s->bodies[body], atan2(-x, y));
    }
}

static void add_paddles(bench_scene *s, double half_depth)
{
    const int32_t paddle = bench_box(s, 6.0, 0.5, half_depth, 1.0, 0.1);
    for (int32_t i = 0; i < PADDLES; i++) {
        const double y = 14.0 - 14.0 * i;
        const int32_t body = bench_add_dynamic(s, paddle, 0.0, y, 0.0);
        bench_joint *motor = bench_add_hinge_z(s, 0, body, 0.0, y);
        motor->motor_speed = i == 1 ? -5.0 : 5.0;
        motor->motor_max = 200.0;
    }
}

static void add_humans(bench_scene *s)
{
    for (int32_t i = 0; i < HUMANS; i++) add_human(s, i % 2 ? 15.0 : -15.0, 26.5, 2.0, i + 1);
}

static void build_ragdoll_stress(bench_scene *s)
{
    add_funnel(s, 0);
    add_paddles(s, 0.5);
    add_humans(s);
}

// Between two panes
static void build_ragdoll_funnel(bench_scene *s)
{
    const int32_t pane = bench_box(s, 18.0, 33.0, 0.5, 1.0, 0.2);
    add_funnel(s, 1);
    add_paddles(s, HALF_DEPTH - 0.1);
    add_humans(s);
    for (int side = -1; side <= 1; side += 2) bench_add_static(s, pane, 0.0, 0.0, side * (HALF_DEPTH + 0.5));
}

static int32_t first_bone(int32_t human) { return FUNNEL + PADDLES + human * BONES; }

// Where the next to come in may stand: notes[2] is the human that came last
static void bring_next(bench_trial *t)
{
    for (int32_t k = 1; k <= HUMANS; k++) {
        const int32_t human = ((int32_t)t->notes[2] + k) % HUMANS, first = first_bone(human);
        if (!t->away[first]) continue;
        for (int32_t i = 0; i < BONES; i++) bench_trial_bring_back(t, first + i);
        t->notes[2] = human;
        return;
    }
}

static void act_ragdoll_stress(bench_trial *t)
{
    for (int32_t human = 0; human < HUMANS; human++) {
        const int32_t first = first_bone(human),
                      is_out = !t->away[first] && t->poses[first + TORSO].position[1] < OUT_BELOW;
        if (t->step > 0 && !is_out) continue;
        for (int32_t i = 0; i < BONES; i++) bench_trial_take_away(t, first + i);
    }
    if (t->step == 0) t->notes[2] = HUMANS - 1;
    if (t->step % EVERY == 0) bring_next(t);
}

static double distance_to_wall(int32_t wall, const double *p)
{
    const double *a = funnel[wall], x = funnel[wall + 1][0] - a[0], y = funnel[wall + 1][1] - a[1];
    const double along = fmin(1.0, fmax(0.0, ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y)));
    return hypot(p[0] - a[0] - along * x, p[1] - a[1] - along * y);
}

// notes[0]: bone steps outside of the funnel; notes[1]: bone steps with the middle in a wall; notes[3], [4]: humans in
// play, at most
static void watch_ragdoll_stress(bench_trial *t)
{
    t->notes[3] = 0.0;
    for (int32_t i = first_bone(0); i < first_bone(HUMANS); i++) {
        const double *p = t->poses[i].position;
        if (t->away[i]) continue;
        t->notes[3] += 1.0 / BONES;
        if (p[1] > -31.0 && (fabs(p[0]) > 17.4 || p[1] > 31.6)) t->notes[0] += 1.0;
        for (int32_t wall = 0; wall < FUNNEL; wall++) t->notes[1] += distance_to_wall(wall, p) < 0.5;
    }
    t->notes[4] = fmax(t->notes[4], t->notes[3]);
}

static void judge_ragdoll_stress(bench_trial *t)
{
    bench_expect_open(t, BENCH_GAP, bench_highest(t->gap, 0, t->step), 4.0 * BENCH_LINEAR_SLOP);
    bench_expect(t, "bone steps outside", t->notes[0], 0.0, 0.0);
    bench_expect(t, "bone steps in a wall", t->notes[1], 0.0, 0.0);
}

const bench_case bench_solver2d_joint[] = {
    {"bridge", "Solver2D", "160 planks without slack", 20.0, 1, build_bridge, NULL, NULL, judge_bridge, BENCH_CALM},
    {"ball-and-chain", "Solver2D", "40 links and a disc of 670 times their mass", 40.0, BENCH_PLANAR_ONLY,
     build_ball_and_chain, NULL, NULL, judge_ball_and_chain, BENCH_CALM},
    {"joint-grid", "Solver2D", "a net of 10000 balls on seven anchors", 12.0, 1, build_joint_grid, NULL, NULL,
     judge_joint_grid, BENCH_CALM},
    {"stretched-chain", "Solver2D", "a chain whose joints start a metre open", 10.0, 1, build_stretched_chain, NULL,
     NULL, judge_stretched_chain, BENCH_CALM},
    {"ragdoll", "Solver2D", "a human of 11 bones falls", 6.0, 1, build_ragdoll, NULL, NULL, judge_ragdoll, BENCH_CALM},
    {"far-ragdolls", "Solver2D", "six humans in a V, 6 km out", 10.0, 1, build_far_ragdolls, NULL, NULL, judge_ragdoll,
     BENCH_CALM},
    {"ragdoll-stress", "Solver2D", "32 humans at a time through a funnel with paddles", 60.0, BENCH_PLANAR_ONLY,
     build_ragdoll_stress, act_ragdoll_stress, watch_ragdoll_stress, judge_ragdoll_stress, BENCH_CHAOTIC_LONG},
    {"ragdoll-funnel", "Solver2D", "the same in space, between two panes", 60.0, 0, build_ragdoll_funnel,
     act_ragdoll_stress, watch_ragdoll_stress, judge_ragdoll_stress, BENCH_CHAOTIC_LONG},
};
const int32_t bench_solver2d_joint_count = (int32_t)(sizeof bench_solver2d_joint / sizeof bench_solver2d_joint[0]);
