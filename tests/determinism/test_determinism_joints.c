// test_determinism_joints.c - test_determinism for scenes of the bench's size, by the same golden.txt: 300 people on
// rough ground, and a cloth of 10 000 balls that tears. Every number of workers runs with the widest set of kernels,
// every set with some number of workers.
#include "determinism/golden.h"

#if defined(FE_SANITIZED)
enum { RUNS_OF_ALL = 0, RUNS_OF_A_SET = 0 }; // a crowd and smaller nets run in test_determinism
#elif !defined(__OPTIMIZE__)
enum { RUNS_OF_ALL = 1, RUNS_OF_A_SET = 0 };
#else
enum { RUNS_OF_ALL = 5, RUNS_OF_A_SET = 1 };
#endif

static void gives_the_golden_hashes(void **state)
{
    static const int32_t workers[] = {2, 1, 3, 8, 16};
    const condition *c = *state;
    const int32_t count = c->simd == FE_SIMD_AUTO ? RUNS_OF_ALL : RUNS_OF_A_SET;
    need_simd(c->simd);
    if (count == 0) {
        print_message("*** NOT TESTED: too slow in this build ***\n");
        skip();
    }
    for (int32_t i = 0; i < count; ++i) run(c->script, c->simd, workers[i], c->script->steps);
}

// The scripts are worth their names only while people lie on the ground, and the cloth tears and is spread over the
// workers
static void people_touch_the_ground_and_the_cloth_tears(void **state)
{
    (void)state;
    if (RUNS_OF_ALL < 2) skip(); // says nothing of this build
    play p;
    fe_counters counters = {.struct_size = sizeof counters};
    play_begin(&p, new_world(FE_SIMD_AUTO, 2));
    play_until(&p, &script_people, script_people.steps);
    FE_TRUE(fe_world_get_counters(p.world, &counters) == FE_OK);
    assert_in_range(counters.contacts, 300, 100000);
    fe_world_destroy(p.world);
    play_begin(&p, new_world(FE_SIMD_AUTO, 2));
    play_until(&p, &script_cloth, 39);
    FE_TRUE(fe_world_get_counters(p.world, &counters) == FE_OK);
    assert_in_range(counters.rows - counters.rows_whole, 1, 100000);
    int32_t broken = 0;
    for (int32_t i = 0; i < p.joint_count; ++i) broken += !fe_joint_is_valid(p.world, p.joints[i]);
    assert_in_range(broken, 10, 100);
    fe_world_destroy(p.world);
}

int main(void)
{
    read_golden();
    const struct CMUnitTest tests[] = {
        GOLDEN_TEST(people, "every_number_of_workers", FE_SIMD_AUTO),
        GOLDEN_TEST(cloth, "every_number_of_workers", FE_SIMD_AUTO),
        GOLDEN_TEST(people, "plain", FE_SIMD_PLAIN),
        GOLDEN_TEST(cloth, "plain", FE_SIMD_PLAIN),
#if defined(__x86_64__)
        GOLDEN_TEST(people, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(cloth, "sse2", FE_SIMD_SSE2),
        GOLDEN_TEST(people, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(cloth, "avx2", FE_SIMD_AVX2),
        GOLDEN_TEST(people, "avx512", FE_SIMD_AVX512),
        GOLDEN_TEST(cloth, "avx512", FE_SIMD_AVX512),
#endif
        cmocka_unit_test(people_touch_the_ground_and_the_cloth_tears),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
