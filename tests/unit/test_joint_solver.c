// test_joint_solver.c - the rows of joints, straight on the solver (joint_rig.h): energy, stretch, and the same bits at
// every width and with any number of workers. Scenes through the API are in tests/scenes.
#include "joint_rig.h"

#ifdef FE_SANITIZED
#define SHORTER(steps, seldom) (seldom)
#else
#define SHORTER(steps, seldom) (steps)
#endif

static void add_chain(rig *r, int32_t links, double angle, double ball_ratio)
{
    double c = cos(angle), s = sin(angle);
    int32_t before = 0;
    for (int32_t i = 0; i < links; ++i) {
        int32_t b = rig_capsule(r, i * c, i * s, (i + 1) * c, (i + 1) * s, 0.125, 1000.0);
        rig_ball(r, before, b, i * c, i * s, 0.0);
        before = b;
    }
    if (ball_ratio == 0.0) return;
    float m = (float)(ball_ratio * r->bodies[before].mass), inertia = 0.4f * m * 4.0f;
    int32_t b = rig_body(r, (links + 2) * c, (links + 2) * s, 0.0, m, inertia, inertia, inertia);
    rig_ball(r, before, b, links * c, links * s, 0.0);
}

// a trunk with four limbs of three capsules each, turning about an axis between y and z
static void add_tree(rig *r)
{
    int32_t trunk = rig_capsule(r, 0.0, -0.4, 0.0, 0.4, 0.2, 1000.0);
    for (int32_t limb = 0; limb < 4; ++limb) {
        double sign = limb & 1 ? 1.0 : -1.0, y = limb & 2 ? 0.4 : -0.4;
        int32_t before = trunk;
        for (int32_t k = 0; k < 3; ++k) {
            double x = sign * (0.2 + 0.5 * k);
            int32_t b = rig_capsule(r, x, y, x + sign * 0.5, y, 0.08, 1000.0);
            rig_ball(r, before, b, x, y, 0.0);
            before = b;
        }
    }
    const fe_dvec3 w = {0.0, 8.0, 1.0};
    for (int32_t i = 1; i < r->body_count; ++i) {
        fe__body *b = r->bodies + i;
        fe_vec3 v = fe__narrow(fe__dcross(w, (fe_dvec3){b->centre[0], b->centre[1], b->centre[2]}));
        b->velocity[0] = v.x, b->velocity[1] = v.y, b->velocity[2] = v.z;
        b->spin[1] = (float)w.y, b->spin[2] = (float)w.z;
    }
}

// spheres of radius 0.4 and density 1000, a metre apart, hanging from their first row
static void add_cloth(rig *r, int32_t n)
{
    const float m = 1000.0f * 4.0f / 3.0f * FE_PI * 0.064f, inertia = 0.4f * m * 0.16f;
    int32_t above, left[128];
    for (int32_t k = 0; k < n; ++k) {
        above = 0;
        for (int32_t i = 1; i < n; ++i) {
            int32_t b = rig_body(r, k, -i, 0.0, m, inertia, inertia, inertia);
            rig_ball(r, above, b, k, 0.5 - i, 0.0);
            if (k > 0) rig_ball(r, left[i], b, k - 0.5, -i, 0.0);
            above = left[i] = b;
        }
    }
}

// A pendulum of one capsule let go horizontally: its 10 s cost less than 0.3 % of the drop m g L/2, and give nothing.
static void pendulum_keeps_its_energy(void **state)
{
    (void)state;
    rig r = rig_make(FE_SIMD_AUTO, NULL, 1, 4);
    add_chain(&r, 1, 0.0, 0.0);
    double scale = (double)r.bodies[1].mass * 10.0 * 0.5;
    for (int32_t i = 0; i < 600; ++i) rig_step(&r);
    FE_WITHIN(rig_energy(&r) / scale, -0.003, 1e-5);
    rig_free(&r);
}

// Limbs that whirl in free flight: damping of the soft joints is all that happens to their energy. At every step,
// because arms that turn without their correction of the warm start gain within a second.
static void tree_in_free_flight_never_gains_energy(void **state)
{
    (void)state;
    rig r = rig_make(FE_SIMD_AUTO, NULL, 1, 4);
    r.gravity = 0.0f;
    add_tree(&r);
    double start = rig_energy(&r);
    for (int32_t i = 0; i < SHORTER(600, 200); ++i) {
        rig_step(&r);
        FE_WITHIN(rig_energy(&r), 0.5 * start, start * (1.0 + 1e-5));
    }
    FE_WITHIN(rig_largest_gap(&r), 0.0, 0.005);
    rig_free(&r);
}

// of joints of 60 Hz, of which four substeps allow 0.225 of their rate
static const double omega_squared = 4.0 * 3.14159265 * 3.14159265 * 54.0 * 54.0;

static void damp(rig *r, float damping)
{
    for (int32_t i = 1; i < r->body_count; ++i) r->bodies[i].linear_damping = r->bodies[i].angular_damping = damping;
}

// 30 capsules carry a ball of 585 times their mass, and of 1000. P2: a link of mass m between two joints stretches its
// joints by (M/m) 2 g / w^2 at most; 3.3 times that while it swings.
static void chains_carry_a_ball_of_585_and_of_1000_links(void **state)
{
    static const double ratios[] = {585.0, 1000.0};
    (void)state;
    for (int32_t k = 0; k < 2; ++k) {
        rig r = rig_make(FE_SIMD_AUTO, NULL, 1, 4);
        add_chain(&r, 30, k ? 0.0 : -1.5, ratios[k]);
        if (k) damp(&r, 0.1f);
        double p2 = ratios[k] * 2.0 * 10.0 / omega_squared, start = rig_energy(&r),
               scale = r.bodies[31].mass * 10.0 * 30.0;
        for (int32_t i = 0; i < SHORTER(1800, 300); ++i) {
            rig_step(&r);
            FE_WITHIN(rig_largest_gap(&r), 0.0, 3.3 * p2);
            FE_WITHIN(rig_energy(&r), start - 2.0 * scale, start + 1e-6 * scale);
        }
        rig_free(&r);
    }
}

// a rod or a rope between points of two bodies
static int32_t add_rod(rig *r, int32_t a, int32_t b, fe_dvec3 point_a, fe_dvec3 point_b, float low, float high)
{
    int32_t j = rig_joint(r, a, b, point_a, fe__identity(), 1u << FE__PART_DISTANCE);
    rig_to_local(r->bodies + b, point_b, r->joints.joints[j].arm_b);
    r->joints.frames[j].axes = j;
    r->joints.axes[j].axis[FE__AXIS_LINEAR].limit.low = low, r->joints.axes[j].axis[FE__AXIS_LINEAR].limit.high = high;
    fe__joint_link(&r->joints, r->bodies, j);
    return j;
}

static double length_of(const rig *r, int32_t joint)
{
    fe__joint_pose pose;
    fe__joint_pose_of(&r->joints, r->bodies, joint, &pose);
    return (double)pose.length;
}

// A crane: a boom of 4 m on a hinge, held by a stay of 5 m from 3 m above, carries 1000 times its mass on a rope. Each
// gives by load / (m_eff w^2): the boom's tip answers by 4 / m upwards, by (1 + (2 x 0.6)^2 m / I) / m along the stay,
// which bears 5/3 of the load.
static void crane_carries_a_thousand_times_its_boom(void **state)
{
    (void)state;
    rig r = rig_make(FE_SIMD_AUTO, NULL, 1, 4);
    const float half = sqrtf(0.5f);
    int32_t boom = rig_capsule(&r, 0.0, 0.0, 4.0, 0.0, 0.1, 1000.0);
    double m = r.bodies[boom].mass, inertia = r.bodies[boom].inertia[2], give = 1000.0 * 10.0 / omega_squared;
    float load_mass = (float)(1000.0 * m), moment = 0.1f * load_mass;
    int32_t hinge = rig_joint(&r, 0, boom, (fe_dvec3){0, 0, 0}, (fe_quat){0.0f, -half, 0.0f, half},
                              1u << FE__PART_HINGE | 1u << FE__PART_POINT);
    fe__joint_link(&r.joints, r.bodies, hinge);
    int32_t load = rig_body(&r, 4.0, -2.5, 0.0, load_mass, moment, moment, moment);
    int32_t stay = add_rod(&r, 0, boom, (fe_dvec3){0, 3, 0}, (fe_dvec3){4, 0, 0}, 5.0f, 5.0f);
    int32_t rope = add_rod(&r, boom, load, (fe_dvec3){4, 0, 0}, (fe_dvec3){4, -2, 0}, 0.0f, 2.0f);
    double rope_give = give * (1.0 + 4.0 * m / inertia), stay_give = give * 5.0 / 3.0 * (1.0 + 1.44 * m / inertia);
    damp(&r, 0.5f);
    for (int32_t i = 0; i < SHORTER(1800, 200); ++i) {
        rig_step(&r);
        FE_WITHIN(length_of(&r, stay) - 5.0, -0.01, 3.3 * stay_give);
        FE_WITHIN(length_of(&r, rope) - 2.0, -0.01, 3.3 * rope_give);
    }
    FE_NEAR(length_of(&r, stay) - 5.0, stay_give,
            SHORTER(0.1, 1.0) * stay_give); // it sags: the angles are not quite those it began with
    FE_NEAR(length_of(&r, rope) - 2.0, rope_give, SHORTER(0.1, 1.0) * rope_give);
    rig_free(&r);
}

// A cloth of n rows: a joint that carries k spheres opens by 2 k g / w^2 (P2). The cloth is a spring that is let go: it
// swings to twice its rest.
static void cloth_hangs_as_predicted(void **state)
{
    enum { N = 12 };
    (void)state;
    rig r = rig_make(FE_SIMD_AUTO, NULL, 1, 4);
    add_cloth(&r, N);
    double sink = 0.0;
    for (int32_t k = 1; k < N - 1; ++k) sink += 2.0 * k * 10.0 / omega_squared;
    sink += (N - 1) * 10.0 / omega_squared; // the topmost joint's other end is static
    for (int32_t i = 0; i < SHORTER(1200, 400); ++i) rig_step(&r);
    for (int32_t i = 1; i < r.body_count; ++i) FE_NEAR(r.bodies[i].centre[2], 0.0, 0.0);
    FE_NEAR(-(N - 1) - r.bodies[N - 1].centre[1], sink, 0.05 * sink);
    rig_free(&r);
}

// more joints than colours: a wheel of 70 spokes about a hub, in order of creation whatever runs it
static void add_wheel(rig *r)
{
    int32_t hub = rig_body(r, 0.0, 0.0, 0.0, 50.0f, 5.0f, 5.0f, 5.0f);
    rig_ball(r, 0, hub, 0.0, 0.0, 0.0);
    for (int32_t i = 0; i < 70; ++i) {
        double angle = 0.09 * i;
        int32_t b = rig_capsule(r, cos(angle), sin(angle), 2.0 * cos(angle), 2.0 * sin(angle), 0.02, 1000.0);
        rig_ball(r, hub, b, cos(angle), sin(angle), 0.0);
    }
}

// ---- every kind ----------------------------------------------------------------------------------------------------
#define PART(name) (1u << FE__PART_##name)

typedef struct kind {
    const char *name;
    uint32_t parts, locked;
} kind;

static const kind kinds[] = {
    {"ball", PART(POINT), 0},
    {"hinge", PART(HINGE) | PART(POINT), 0},
    {"hinge with limits", PART(TWIST) | PART(HINGE) | PART(POINT), 0},
    {"fixed", PART(FIXED) | PART(POINT), 0},
    {"slider", PART(FIXED) | PART(SLIDE), FE__LOCK_Y | FE__LOCK_Z},
    {"slider with limits", PART(X) | PART(FIXED) | PART(SLIDE), FE__LOCK_Y | FE__LOCK_Z},
    {"cylinder", PART(HINGE) | PART(SLIDE), FE__LOCK_Y | FE__LOCK_Z},
    {"plane", PART(HINGE) | PART(SLIDE), FE__LOCK_X},
    {"universal", PART(TWIST) | PART(POINT), 0},
    {"cone and twist", PART(TWIST) | PART(CONE) | PART(POINT), 0},
    {"swings", PART(SWING_Y) | PART(SWING_Z) | PART(POINT), 0},
    {"rod", PART(DISTANCE), 0},
    {"box of ways", PART(X) | PART(Y) | PART(Z), 0},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

// limits that a tumbling tree runs into: 0.3 rad, 0.2 m
static void set_limits(fe__joint_axes *axes, uint32_t parts)
{
    for (int k = 0; k < FE__AXES; ++k) {
        float most = k < FE__AXIS_TWIST ? 0.2f : 0.3f;
        axes->axis[k].limit.low = -most, axes->axis[k].limit.high = most;
    }
    if (parts & PART(CONE)) axes->axis[FE__AXIS_SWING].limit.low = 0.2f, axes->axis[FE__AXIS_SWING].limit.high = 0.4f;
    if (parts & PART(DISTANCE)) axes->axis[FE__AXIS_LINEAR].limit.low = axes->axis[FE__AXIS_LINEAR].limit.high = 0.25f;
    if (!(parts & (PART(CONE) | PART(HINGE))) && parts & PART(TWIST))
        axes->axis[FE__AXIS_TWIST].limit.low = axes->axis[FE__AXIS_TWIST].limit.high = 0.0f;
    axes->rotation.target[3] = 1.0f;
}

// between neighbours of a tree, along a skew axis
static int32_t add_kind(rig *r, const kind *k, int32_t a, int32_t b, fe_dvec3 point)
{
    const fe_quat skew = fe__normalized((fe_quat){0.2f, -0.5f, 0.3f, 0.8f});
    int32_t j = rig_joint(r, a, b, point, skew, k->parts);
    r->joints.frames[j].locked = (uint16_t)k->locked;
    r->joints.frames[j].axes = j;
    if (k->parts == PART(DISTANCE)) r->joints.joints[j].arm_b[0] += 0.25f;
    set_limits(r->joints.axes + j, k->parts);
    fe__joint_link(&r->joints, r->bodies, j);
    return j;
}

static void add_bough(rig *r, const kind *k, int32_t root, double y)
{
    int32_t before = root;
    for (int32_t i = 0; i < 4; ++i) {
        int32_t b = rig_capsule(r, 0.5 * i, y, 0.5 * (i + 1), y, 0.08 + 0.02 * i, 1000.0);
        add_kind(r, k, before, b, (fe_dvec3){0.5 * i, y, 0.0});
        before = b;
    }
}

static void whirl(rig *r, fe_dvec3 w)
{
    for (int32_t i = 1; i < r->body_count; ++i) {
        fe__body *b = r->bodies + i;
        if (b->type != FE_BODY_DYNAMIC) continue;
        fe_vec3 v = fe__narrow(fe__dcross(w, (fe_dvec3){b->centre[0], b->centre[1], b->centre[2]}));
        b->velocity[0] = v.x, b->velocity[1] = v.y, b->velocity[2] = v.z;
        b->spin[0] = (float)w.x + 0.5f * (float)(i % 3), b->spin[1] = (float)w.y - 0.4f * (float)(i % 2),
        b->spin[2] = (float)w.z;
    }
}

// Boughs of five bodies that whirl freely, a bough for each kind of joint: no kind gives energy, none loses what it
// holds together.
static void no_kind_of_joint_adds_energy(void **state)
{
    (void)state;
    for (int32_t k = 0; k < KINDS; ++k) {
        rig r = rig_make(FE_SIMD_AUTO, NULL, 1, 8);
        r.gravity = 0.0f;
        int32_t root = rig_capsule(&r, -0.5, 0.0, 0.0, 0.0, 0.15, 1000.0);
        add_bough(&r, kinds + k, root, 0.0);
        whirl(&r, (fe_dvec3){1.0, 2.0, 4.0});
        double start = rig_energy(&r);
        for (int32_t i = 0; i < SHORTER(600, 100); ++i) {
            rig_step(&r);
            double energy = rig_energy(&r);
            if (!(energy <= start * (1.0 + 1e-4))) print_error("%s, step %d\n", kinds[k].name, i);
            FE_WITHIN(energy, 0.0, start * (1.0 + 1e-4));
        }
        rig_free(&r);
    }
}

// a bough of each kind, on bodies of each type, some of them locked; drives, motors and a turn drive too
static void add_everything(rig *r)
{
    for (int32_t k = 0; k < KINDS; ++k) {
        int32_t root = 0;
        if (k % 3) root = rig_capsule(r, -0.5, k, 0.0, k, 0.15, 1000.0);
        if (k % 3 == 2) rig_kinematic(r, root, (fe_vec3){0.1f, 0.0f, 0.2f}, (fe_vec3){0.3f, 1.0f, 0.0f});
        add_bough(r, kinds + k, root, k);
        if (k % 4 == 3) rig_lock(r, r->body_count - 2, 1 + k);
    }
    for (int32_t j = 1; j <= r->joint_count; ++j) {
        fe__joint_axis *axis = r->joints.axes[j].axis;
        for (int k = 0; k < FE__AXES && j % 2; ++k)
            axis[k].drive.target = 0.1f, axis[k].drive.stiffness = 2.0f, axis[k].drive.damping = 0.5f,
            axis[k].drive.cap = 50.0f;
        for (int k = 0; k < FE__AXES && j % 3; ++k) axis[k].motor.speed = 0.5f, axis[k].motor.cap = 5.0f;
    }
    const fe__joint_rotation turn = {.target = {0.1f, 0.2f, 0.0f, 0.97f},
                                     .drive = {20.0f, 2.0f, 30.0f, FE__DRIVE_STIFFNESS},
                                     .motor = {{0.0f, 0.1f, 0.0f}, 1.0f}};
    int32_t b = rig_capsule(r, 0.0, -2.0, 1.0, -2.0, 0.1, 1000.0);
    int32_t j = rig_joint(r, 0, b, (fe_dvec3){0.0, -2.0, 0.0}, fe__identity(), PART(POINT) | PART(ROTATION));
    r->joints.frames[j].axes = j;
    r->joints.axes[j].rotation = turn;
    fe__joint_link(&r->joints, r->bodies, j);
}

// What is locked keeps its coordinate bit for bit, whatever joint pulls at it.
static void locks_hold_exactly_against_every_kind(void **state)
{
    (void)state;
    for (int32_t k = 0; k < KINDS; ++k)
        for (int32_t locks = 1; locks < 64; locks += SHORTER(1, 5)) {
            rig r = rig_make(FE_SIMD_AUTO, NULL, 1, 4);
            add_bough(&r, kinds + k, 0, 0.0);
            rig_lock(&r, 2, locks);
            const fe__body before = r.bodies[2];
            for (int32_t i = 0; i < 20; ++i) rig_step(&r);
            const fe__body *b = r.bodies + 2;
            for (int n = 0; n < 3; ++n) {
                if (locks >> n & 1) FE_TRUE(b->centre[n] == before.centre[n] && b->velocity[n] == 0.0f);
                if (locks >> (3 + n) & 1) FE_TRUE(b->spin[n] == 0.0f);
            }
            if (locks >> 3 == 7) FE_TRUE(!memcmp(b->rotation, before.rotation, sizeof before.rotation));
            FE_WITHIN(rig_energy(&r), -1e9, 1e9); // no NaN
            rig_free(&r);
        }
}

// Hubs that lost the joints that have colours keep those that overflowed: room for a row for each of them
static void hubs_keep_their_overflow_when_joints_go(void **state)
{
    enum { HUBS = 20, SPOKES = 50, LEFT = 12 };
    (void)state;
    rig r = rig_make(FE_SIMD_AUTO, NULL, 1, 2);
    for (int32_t h = 0; h < HUBS; ++h) {
        int32_t hub = rig_body(&r, 10.0 * h, 0.0, 0.0, 50.0f, 5.0f, 5.0f, 5.0f);
        for (int32_t i = 0; i < SPOKES; ++i) {
            int32_t b = rig_capsule(&r, 10.0 * h, 1.0, 10.0 * h, 2.0, 0.02, 1000.0);
            int32_t j = rig_ball(&r, hub, b, 10.0 * h, 1.0, 0.0);
            FE_TRUE((r.joints.joints[j].colour == FE__JOINT_OVERFLOW) == (i >= FE__JOINT_COLOURS));
        }
    }
    for (int32_t j = 1; j <= r.joint_count; ++j)
        if ((j - 1) % SPOKES < SPOKES - LEFT) fe__joint_unlink(&r.joints, r.bodies, j);
    for (int32_t i = 0; i < 3; ++i) rig_step(&r);
    for (int32_t j = 1; j <= r.joint_count; ++j)
        if (r.joints.joints[j].colour >= 0) FE_WITHIN(rig_gap(&r, j), 0.0, 0.005);
    FE_TRUE(r.joints.overflowing == HUBS * LEFT && r.joints.linked == HUBS * LEFT && r.joints.rows == HUBS * LEFT);
    rig_free(&r);
}

static uint64_t play(int32_t simd, fe_pool *pool, int32_t workers)
{
    rig r = rig_make(simd, pool, workers, 4);
    add_everything(&r);
    add_cloth(&r, 30); // 1653 joints: a large island
    add_tree(&r);
    add_wheel(&r);
    for (int32_t i = 0; i < SHORTER(60, 20); ++i) rig_step(&r);
    FE_TRUE(r.solver.large_count == 1);
    uint64_t hash = rig_hash(&r);
    rig_free(&r);
    return hash;
}

static void results_do_not_depend_on_width_or_workers(void **state)
{
    static const int32_t sets[] = {FE_SIMD_SSE2, FE_SIMD_AVX2, FE_SIMD_AVX512, FE_SIMD_NEON}, workers[] = {3, 2, 8, 16};
    (void)state;
    uint64_t expected = play(FE_SIMD_PLAIN, NULL, 1);
    for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i)
        if (fe__kernels_of(sets[i])) FE_TRUE(play(sets[i], NULL, 1) == expected);
    for (size_t i = 0; i < SHORTER(sizeof workers / sizeof *workers, 1); ++i) {
        fe_pool *pool = fe__pool_create(workers[i]);
        fe__pool_assume_cores(pool, workers[i]);
        FE_TRUE(play(FE_SIMD_AUTO, pool, workers[i]) == expected);
        fe__pool_destroy(pool);
    }
}

// ---- lanes of a row are written by several workers ------------------------------------------------------------------
// Trees of one island, each solved by some worker, may have locks in one row: nobody's write is lost
typedef struct shared_row {
    const fe__lock_lanes *locks;
    int32_t part;
    _Atomic int32_t lost;
    _Alignas(64) unsigned char bytes[8192];
} shared_row;

static void add_and_take(void *argument, int32_t lane)
{
    enum { ROUNDS = SHORTER(200, 40), ADDS = 500 };
    shared_row *row = argument;
    for (int32_t round = 0; round < ROUNDS; ++round) {
        const double one[3] = {1.0, 1.0, 1.0};
        double sum[3] = {0.0, 0.0, 0.0};
        for (int32_t i = 0; i < ADDS; ++i) (void)row->locks->add(row->part, row->bytes, lane, one, 1);
        int32_t count = row->locks->take(row->part, row->bytes, lane, sum);
        for (int32_t k = 0; k < count; ++k)
            if (sum[k] != (double)ADDS) atomic_fetch_add(&row->lost, 1);
    }
}

static void no_worker_overwrites_the_lanes_of_others(void **state)
{
    static const int32_t parts[] = {FE__PART_POINT, FE__PART_FIXED, FE__PART_HINGE, FE__PART_DISTANCE};
    static shared_row row;
    (void)state;
    fe_pool *pool = fe__pool_create(4);
    fe__pool_assume_cores(pool, 4);
    for (int32_t simd = FE_SIMD_PLAIN; simd <= FE_SIMD_WASM; ++simd) {
        const fe__kernels *kernels = fe__kernels_of(simd);
        for (size_t i = 0; kernels && i < sizeof parts / sizeof *parts; ++i) {
            assert_in_range(kernels->joint->of[parts[i]].row_size, 1, sizeof row.bytes);
            row.locks = &kernels->joint->locks, row.part = parts[i];
            memset(row.bytes, 0, sizeof row.bytes);
            fe__pool_run(pool, add_and_take, &row, 4);
            assert_int_equal(row.lost, 0);
        }
    }
    fe__pool_destroy(pool);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pendulum_keeps_its_energy),
        cmocka_unit_test(tree_in_free_flight_never_gains_energy),
        cmocka_unit_test(chains_carry_a_ball_of_585_and_of_1000_links),
        cmocka_unit_test(crane_carries_a_thousand_times_its_boom),
        cmocka_unit_test(cloth_hangs_as_predicted),
        cmocka_unit_test(no_kind_of_joint_adds_energy),
        cmocka_unit_test(hubs_keep_their_overflow_when_joints_go),
        cmocka_unit_test(locks_hold_exactly_against_every_kind),
        cmocka_unit_test(results_do_not_depend_on_width_or_workers),
        cmocka_unit_test(no_worker_overwrites_the_lanes_of_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
