// test_determinism.c - the same calls give the same bits: with every number of workers, every SIMD set, every compiler
// (the same golden.txt serves all builds), whatever else is in the world.
//
//   test_determinism           all; a part of it where the code is slow, without optimization or with sanitizers
//   test_determinism update    writes golden.txt: after a change that was meant to change results
#include "determinism/golden.h"

// ---- every number of workers, every SIMD set -----------------------------------------------------------------------

static void gives_the_golden_hashes(void **state)
{
    const condition *c = *state;
#if defined(FE_SANITIZED)
    static const int32_t workers[] = {3};
#if defined(__SANITIZE_THREAD__)
    const int32_t count = 1, steps = PLAY_CHECK_STEPS;
#else
    const int32_t count = 1, steps = 2 * PLAY_CHECK_STEPS;
#endif
#elif !defined(__OPTIMIZE__)
    static const int32_t workers[] = {2};
    const int32_t count = 1, steps = c->script->steps / 2;
#elif defined(FE_FEW_WORKERS)
    static const int32_t workers[] = {1, 3};
    const int32_t count = 2, steps = c->script->steps;
#else
    static const int32_t workers[] = {1, 2, 3, 8, 16};
    const int32_t count = 5, steps = c->script->steps;
#endif
    need_simd(c->simd);
    for (int32_t i = 0; i < count; ++i) run(c->script, c->simd, workers[i], steps);
}

// The script is worth its name only while its net is spread over workers, its chains are trees, and its weak strings
// break
static void joints_have_an_island_that_is_spread_trees_and_strings_that_break(void **state)
{
    (void)state;
    play p;
    fe_counters counters = {.struct_size = sizeof counters};
    play_begin(&p, new_world(FE_SIMD_AUTO, 1));
    play_until(&p, &script_joints, 10);
    FE_TRUE(fe_world_get_counters(p.world, &counters) == FE_OK);
    assert_in_range(counters.rows - counters.rows_whole, 1, 100000);
    assert_in_range(counters.trees, 6, 100);
    play_until(&p, &script_joints, 30);
    int32_t broken = 0;
    for (int32_t i = 0; i < p.joint_count; ++i) broken += !fe_joint_is_valid(p.world, p.joints[i]);
    assert_int_equal(broken, 8 + 1); // of twelve strings, and one that was destroyed
    fe_world_destroy(p.world);
}

// The scene is worth its name only while it has the contacts that spread an island over workers
static void crowd_has_more_than_1000_contacts(void **state)
{
    (void)state;
    play p;
    fe_counters counters = {.struct_size = sizeof counters};
    int32_t most = 0, most_rows = 0;
    play_begin(&p, new_world(FE_SIMD_AUTO, 1));
    while (p.step < script_crowd.steps / 2) {
        play_until(&p, &script_crowd, p.step + PLAY_CHECK_STEPS);
        fe_world_get_counters(p.world, &counters);
        if (counters.contacts > most) most = counters.contacts;
        if (counters.rows - counters.rows_whole > most_rows) most_rows = counters.rows - counters.rows_whole;
    }
    assert_in_range(most, 1000, 100000);
    assert_in_range(most_rows, 1, 100000); // an island was spread
    fe_world_destroy(p.world);
}

// The script is worth its name only while most queries find a place
static void every_kind_of_query_spawns(void **state)
{
    (void)state;
    play p;
    play_begin(&p, new_world(FE_SIMD_AUTO, 1));
    play_until(&p, &script_spawn, 100);
    assert_in_range(p.actor_count, 9 + 35, 9 + 50);
    fe_world_destroy(p.world);
}

// ---- other bodies --------------------------------------------------------------------------------------------------

typedef struct motion {
    fe_transform transform;
    fe_vec3 velocity, spin;
} motion;

static motion motion_of(const play *p, int32_t actor)
{
    motion m;
    memset(&m, 0, sizeof m);
    fe_body body = p->actors[actor];
    if (!body) return m;
    FE_TRUE(fe_body_get_transform(p->world, body, &m.transform) == FE_OK);
    FE_TRUE(fe_body_get_linear_velocity(p->world, body, &m.velocity) == FE_OK);
    FE_TRUE(fe_body_get_angular_velocity(p->world, body, &m.spin) == FE_OK);
    return m;
}

// Bit for bit, so that -0 is not +0
static void same_motions(const play *a, const play *b)
{
    assert_int_equal(a->actor_count, b->actor_count);
    for (int32_t i = 0; i < a->actor_count; ++i) {
        motion x = motion_of(a, i), y = motion_of(b, i);
        if (memcmp(&x, &y, sizeof x) != 0) fail_msg("actor %d moves otherwise at step %d", (int)i, (int)a->step);
    }
}

// heaps of their own on a ground of their own, 500 m away
static void add_strangers(play *p)
{
    part ground = part_static_box(20.0f, 1.0f, 20.0f, 500.0, 2.0, 0.0);
    fe_body body;
    fe_shape shape;
    PLAY(p, fe_body_create(p->world, &ground.body, &body));
    PLAY(p, fe_shape_create(p->world, body, &ground.shape, &ground.geometry, &shape));
    for (int32_t i = 0; i < 100; ++i) {
        part a = i % 2 ? part_box(0.3f, 0.2f, 0.4f, 500.0 + 0.1 * (i % 7), 3.5 + 0.4 * i, 0.2 * (i % 3))
                       : part_sphere(0.3f, 500.0, 3.5 + 0.4 * i, 0.1 * (i % 5));
        PLAY(p, fe_body_create(p->world, &a.body, &body));
        PLAY(p, fe_shape_create(p->world, body, &a.shape, &a.geometry, &shape));
    }
}

static void add_and_take_away(play *p)
{
    fe_body bodies[40];
    fe_shape shape;
    for (int32_t i = 0; i < 40; ++i) {
        part a = part_sphere(0.3f, 0.25 * i, 1.0, 0.0);
        PLAY(p, fe_body_create(p->world, &a.body, bodies + i));
        PLAY(p, fe_shape_create(p->world, bodies[i], &a.shape, &a.geometry, &shape));
    }
    for (int32_t i = 0; i < 5; ++i) PLAY(p, fe_world_step(p->world, p->dt));
    for (int32_t i = 0; i < 40; ++i) PLAY(p, fe_body_destroy(p->world, bodies[(i * 7) % 40]));
    PLAY(p, fe_world_step(p->world, p->dt));
}

static void compare_with_strangers(const script *s, int32_t steps, void (*before)(play *p), void (*later)(play *p))
{
    play alone, crowded;
    play_begin(&alone, new_world(FE_SIMD_AUTO, 1));
    play_begin(&crowded, new_world(FE_SIMD_AUTO, 2));
    if (before) before(&crowded);
    while (alone.step < steps) {
        play_until(&alone, s, alone.step + PLAY_CHECK_STEPS / 2);
        play_until(&crowded, s, alone.step);
        same_motions(&alone, &crowded);
        if (later && alone.step == PLAY_CHECK_STEPS) later(&crowded);
    }
    assert_int_equal(alone.errors + crowded.errors, 0);
    fe_world_destroy(alone.world);
    fe_world_destroy(crowded.world);
}

#if defined(FE_SANITIZED) || !defined(__OPTIMIZE__)
enum { STRANGER_STEPS = 100 };
#else
enum { STRANGER_STEPS = 300 };
#endif

static void bodies_far_away_change_no_trajectory(void **state)
{
    (void)state;
    compare_with_strangers(&script_mixed, STRANGER_STEPS, add_strangers, NULL);
    compare_with_strangers(&script_mixed, STRANGER_STEPS, NULL, add_strangers);
}

static void bodies_far_away_change_no_trajectory_in_a_crowd(void **state)
{
    (void)state;
    compare_with_strangers(&script_crowd, STRANGER_STEPS, add_strangers, NULL);
}

static void bodies_far_away_change_no_trajectory_on_terrain(void **state)
{
    (void)state;
    compare_with_strangers(&script_terrain, STRANGER_STEPS, add_strangers, NULL);
    compare_with_strangers(&script_terrain, STRANGER_STEPS, NULL, add_strangers);
}

static void bodies_that_came_and_went_change_no_trajectory(void **state)
{
    (void)state;
    compare_with_strangers(&script_mixed, STRANGER_STEPS, add_and_take_away, NULL);
    compare_with_strangers(&script_crowd, STRANGER_STEPS, add_and_take_away, NULL);
}

// ---- main ----------------------------------------------------------------------------------------------------------

static int update(void)
{
    FILE *file = fopen(GOLDEN, "w");
    if (!file) return 1;
    const script *const scripts[] = {&script_crowd, &script_mixed,     &script_terrain, &script_fast,   &script_joints,
                                     &script_spawn, &script_solids,    &script_meshes,  &script_cooked, &script_scales,
                                     &script_turns, &script_compounds, &script_people,  &script_cloth};
    for (size_t i = 0; i < sizeof scripts / sizeof *scripts; ++i) {
        fe_world *world = new_world(FE_SIMD_PLAIN, 1);
        play_print(file, scripts[i], world, scripts[i]->steps);
        fe_world_destroy(world);
    }
    return fclose(file) != 0;
}

int main(int count, char **arguments)
{
    if (count > 1 && strcmp(arguments[1], "update") == 0) return update();
    read_golden();
    const struct CMUnitTest tests[] = {
        GOLDEN_TEST(crowd, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(mixed, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(terrain, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(fast, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(joints, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(spawn, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(solids, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(meshes, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(cooked, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(scales, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(turns, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(compounds, "plain", FE_SIMD_PLAIN),
#if defined(__x86_64__)
        GOLDEN_TEST(crowd, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(crowd, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(crowd, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(terrain, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(terrain, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(terrain, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(fast, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(joints, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(fast, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(joints, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(fast, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(joints, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(spawn, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(solids, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(meshes, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(cooked, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(scales, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(turns, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(compounds, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(spawn, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(solids, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(meshes, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(cooked, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(scales, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(turns, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(compounds, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(spawn, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(solids, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(meshes, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(cooked, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(scales, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(turns, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(compounds, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(mixed, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(mixed, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(mixed, "avx512", FE_SIMD_AVX512),
#elif defined(__aarch64__)
        GOLDEN_TEST(crowd, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(mixed, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(terrain, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(fast, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(joints, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(spawn, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(solids, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(meshes, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(cooked, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(scales, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(turns, "neon", FE_SIMD_NEON),
        GOLDEN_TEST(compounds, "neon", FE_SIMD_NEON),
#endif
        cmocka_unit_test(crowd_has_more_than_1000_contacts),
        cmocka_unit_test(every_kind_of_query_spawns),
        cmocka_unit_test(joints_have_an_island_that_is_spread_trees_and_strings_that_break),
        cmocka_unit_test(bodies_far_away_change_no_trajectory),
        cmocka_unit_test(bodies_far_away_change_no_trajectory_in_a_crowd),
        cmocka_unit_test(bodies_far_away_change_no_trajectory_on_terrain),
        cmocka_unit_test(bodies_that_came_and_went_change_no_trajectory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
