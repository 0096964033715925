// Stars: a small hub that carries many balls far out, each on a joint of its own. The hub's inertia is nothing beside
// what the arms put on it, so that each joint counts with a stiffness that all of them together exceed many times.
// In free fall nothing may move against anything; thrown and hung, no energy may come from nowhere.
#include "scenes/joint_scene.h"

#include <string.h>

typedef struct star {
    scene s;
    fe_body hub, arms[640];
    int count;
    double arm; // m
} star;

// evenly over a sphere: a spiral by the golden angle
static vec direction(int i, int count)
{
    double y = 1 - 2 * (i + 0.5) / count, r = sqrt(1 - y * y), angle = 2.399963 * i;
    return v3(r * cos(angle), y, r * sin(angle));
}

static star star_begin(void **state, int count, double hub_radius, double arm, int boxes)
{
    star t = {.s = scene_begin(state), .count = count, .arm = arm};
    t.hub = add_plain(&t.s, sphere(hub_radius), v3(0, 0, 0));
    touch_nothing(&t.s, t.hub);
    MUST(fe_body_set_sleep_allowed(t.s.world, t.hub, 0));
    for (int i = 0; i < count; ++i) {
        vec at = times(arm, direction(i, count));
        t.arms[i] = add_plain(&t.s, boxes ? box(0.1, 0.1, 0.1) : sphere(0.1), at);
        touch_nothing(&t.s, t.arms[i]);
        add_ball(&t.s, ball_def(), t.hub, t.arms[i], at, v3(1, 0, 0));
    }
    return t;
}

// m/s, against the hub
static double fastest(const star *t)
{
    double most = 0;
    for (int i = 0; i < t->count; ++i)
        most = fmax(most, length(minus(velocity(&t->s, t->arms[i]), velocity(&t->s, t->hub))));
    return most;
}

// A velocity that has grown to g t is a float: one rounding of it in each substep, as a random walk, out on the lever
// of what the smallest inertia makes of it. 60 s end at 590 m/s.
#define DRIFT 1e-3 // m/s

static void what_falls_freely_stays_as_it_is(void **state)
{
    static const struct {
        int count;
        double hub, arm;
        int boxes, seconds;
    } cases[] = {
        {8, 0.3, 3, 0, 60},  {8, 0.3, 3, 1, 60},   {16, 0.3, 1, 0, 60}, {31, 0.3, 3, 0, 10}, {64, 0.3, 0.5, 0, 10},
        {64, 0.3, 3, 1, 10}, {64, 0.3, 30, 0, 10}, {640, 1, 3, 0, 1},   {640, 1, 3, 1, 1},
    };
    for (unsigned k = 0; k < sizeof cases / sizeof *cases; ++k) {
        star t = star_begin(state, cases[k].count, cases[k].hub, cases[k].arm, cases[k].boxes);
        for (int i = 0; i < (SLOW_BUILD ? 1 : cases[k].seconds); ++i) {
            run(&t.s, SLOW_BUILD ? 10 : 60);
            FE_WITHIN(fastest(&t), 0, DRIFT);
        }
        scene_end(&t.s);
    }
}

static double energy_of(const star *t)
{
    fe_energy e;
    fe_energy_init(&e, sizeof e);
    MUST(fe_world_get_energy(t->s.world, &e));
    return e.kinetic + e.potential;
}

// of the energy of the swing: what no step may have gained since the start
#define SWING_GAIN 1e-3

static void the_energy_of_a_swing_does_not_rise(void **state)
{
    static const int counts[] = {8, 64};
    static const double arms[] = {0.5, 3, 30};
    for (int k = 0; k < 12; ++k) {
        int hung = k / 6;
        star t = star_begin(state, counts[k % 2], 0.3, arms[k / 2 % 3], k % 3 == 0);
        const double whirl = 1; // rad/s
        for (int i = -1; i < t.count; ++i) {
            fe_body body = i < 0 ? t.hub : t.arms[i];
            vec w = v3(0, 0, whirl);
            set_velocity(&t.s, body, cross(w, position(&t.s, body)), w);
        }
        // as a pendulum of an arm's length, or whirling while it flies
        if (hung) add_ball(&t.s, ball_def(), add_anchor(&t.s, v3(0, 0, 0)), t.hub, v3(-t.arm, 0, 0), v3(1, 0, 0));
        set_gravity(&t.s, v3(0, hung ? -G : 0, 0));
        double start = energy_of(&t), swing = fabs(start);
        for (int i = -1; hung && i < t.count; ++i) swing += mass_of(&t.s, i < 0 ? t.hub : t.arms[i]) * G * t.arm;
        for (int i = 0; i < (SLOW_BUILD ? 10 : 120); ++i) {
            run(&t.s, 1);
            FE_WITHIN((energy_of(&t) - start) / swing, -1, SWING_GAIN);
        }
        scene_end(&t.s);
    }
}

// ---- determinism ----------------------------------------------------------------------------------------------------
// Stars on the ground. Of a kind of joint and a colour, a group of four or fewer has rows of four lanes, others have
// the set's: locks of one tree lie in both.
typedef struct sky {
    int stars, arms;
    int tails; // 1: a further ball at each arm's end, on a hinge: those joints have one colour, but at the first arm
    int loss;  // one of so many stars has lost a joint: its others have other colours than those of its like
} sky;
static const sky skies[] = {
    {1, 64, 0, 2}, // more joints at one body than there are colours
    {1, 64, 1, 2},
    {10, 3, 0, 3}, // solved side by side
};

// whirls about its hub
static void add_star(star *t, vec hub, const sky *how, int lost)
{
    fe_joint joint = 0;
    t->hub = add_plain(&t->s, sphere(0.3), hub);
    if (lost) joint = add_ball(&t->s, ball_def(), add_anchor(&t->s, hub), t->hub, hub, v3(1, 0, 0));
    for (int i = 0; i < how->arms; ++i) {
        vec arm = times(t->arm, direction(i, how->arms)), at = plus(hub, arm), end = plus(hub, times(1.2, arm));
        t->arms[i] = add_plain(&t->s, sphere(0.1), at);
        add_ball(&t->s, ball_def(), t->hub, t->arms[i], at, v3(1, 0, 0));
        set_velocity(&t->s, t->arms[i], cross(v3(0, 0, 2), arm), v3(0, 0, 2));
        if (how->tails) add_hinge(&t->s, hinge_def(), t->arms[i], add_plain(&t->s, sphere(0.1), end), at, v3(0, 0, 1));
    }
    if (lost) MUST(fe_joint_destroy(t->s.world, joint));
}

static void hash_of_throw(fe_simd simd, int workers, const sky *how, uint32_t out_hash[4])
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = workers, def.simd = (int32_t)simd, def.gravity = fe_make_vec3(0, -(float)G, 0);
    star t = {.s = {NULL, UNTURNED, 8, STEP / 8}, .arm = 3};
    memset(out_hash, 0, 4 * sizeof *out_hash);
    if (fe_world_create(&def, &t.s.world) < 0) return; // not on this processor
    (void)add_static(&t.s, box(200, 0.5, 200), v3(0, -4, 0), UNTURNED, friction(0.6));
    for (int i = 0; i < how->stars; ++i) add_star(&t, v3(10 * i, 0, 0), how, i % how->loss == 1);
    run(&t.s, SLOW_BUILD ? 10 : 40);
    fe_counters counters = {.struct_size = sizeof counters};
    MUST(fe_world_get_counters(t.s.world, &counters));
    assert_int_equal(counters.trees, how->stars);
    MUST(fe_world_hash(t.s.world, out_hash));
    scene_end(&t.s);
}

static void stars_are_the_same_for_all_workers_and_sets(void **state)
{
    static const fe_simd sets[] = {FE_SIMD_PLAIN, FE_SIMD_SSE2, FE_SIMD_AVX2, FE_SIMD_AVX512, FE_SIMD_NEON};
    static const int workers[] = {2, 3, 8};
    uint32_t first[4], other[4];
    (void)state;
    for (const sky *how = skies; how < skies + sizeof skies / sizeof *skies; ++how) {
        hash_of_throw(FE_SIMD_AUTO, 1, how, first);
        for (int i = 0; i < 3; ++i) {
            hash_of_throw(FE_SIMD_AUTO, workers[i], how, other);
            assert_memory_equal(first, other, sizeof first);
        }
        for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i) {
            hash_of_throw(sets[i], 1, how, other);
            if (other[0] | other[1] | other[2] | other[3]) assert_memory_equal(first, other, sizeof first);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(what_falls_freely_stays_as_it_is),
        WITH_4_SUBSTEPS(what_falls_freely_stays_as_it_is),
        TEST(the_energy_of_a_swing_does_not_rise),
        WITH_4_SUBSTEPS(the_energy_of_a_swing_does_not_rise),
        TEST(stars_are_the_same_for_all_workers_and_sets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
