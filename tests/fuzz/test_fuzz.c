// test_fuzz.c - the fuzzer's harness on streams of random bytes: bounded, the same at every run. Each stream is run in
// two settings, which must tell the same.
#include "fe_test.h"
#include "feather.h"
#include "support/fuzz.h"

#include <stdlib.h>

#ifdef FE_SANITIZED
enum { STREAMS = 60 };
#else
enum { STREAMS = 300 };
#endif
enum { STREAM_BYTES = 3000 };

static void fill(uint8_t *bytes, uint32_t seed)
{
    uint64_t x = UINT64_C(0x9E3779B97F4A7C15) * (seed + 1);
    for (int32_t i = 0; i < STREAM_BYTES; ++i) {
        x ^= x << 13, x ^= x >> 7, x ^= x << 17;
        bytes[i] = (uint8_t)(x >> 56);
    }
}

static void no_stream_of_calls_breaks_a_world(void **state)
{
    (void)state;
    static uint8_t bytes[STREAM_BYTES];
    const fuzz_setting alone = {.workers = 1, .simd = FE_SIMD_PLAIN};
    const fuzz_setting together = {.workers = 4, .simd = FE_SIMD_AUTO};
    for (uint32_t seed = 0; seed < STREAMS; ++seed) {
        fill(bytes, seed);
        if (fuzz_run(bytes, STREAM_BYTES, &alone) != fuzz_run(bytes, STREAM_BYTES, &together))
            fail_msg("stream %u ends otherwise with more workers", seed);
    }
}

// sane values and wild ones: a step that found no memory and is repeated at once is the step that found some
static void failed_steps_leave_no_trace(void **state)
{
    (void)state;
    static uint8_t bytes[STREAM_BYTES];
    for (uint32_t seed = 0; seed < STREAMS; ++seed) {
        fill(bytes, 2 * STREAMS + seed);
        const int32_t is_wild = (int32_t)(seed % 2);
        const fuzz_setting calm = {.workers = 1, .simd = FE_SIMD_AUTO, .is_wild = is_wild, .failures = 1};
        const fuzz_setting unlucky = {.workers = 1, .simd = FE_SIMD_AUTO, .is_wild = is_wild, .failures = 2 + seed};
        if (fuzz_run(bytes, STREAM_BYTES, &calm) != fuzz_run(bytes, STREAM_BYTES, &unlucky))
            fail_msg("stream %u ends otherwise when steps are repeated", seed);
    }
}

// values up to the limits of the API, which no result needs to survive: nothing crashes, and errors change nothing
static void no_stream_of_wild_values_crashes(void **state)
{
    (void)state;
    static uint8_t bytes[STREAM_BYTES];
    const fuzz_setting wild = {.workers = 4, .simd = FE_SIMD_AUTO, .is_wild = 1};
    for (uint32_t seed = 0; seed < STREAMS; ++seed) {
        fill(bytes, STREAMS + seed);
        fuzz_run(bytes, STREAM_BYTES, &wild);
    }
}

static int64_t refusals = 3000; // the first argument

// Every value that a call may refuse: streams go on until so many calls were refused, each of which left the snapshot
// as it was
static void refused_calls_leave_every_byte(void **state)
{
    (void)state;
    static uint8_t bytes[STREAM_BYTES];
    int64_t refused = 0;
    for (uint32_t seed = 0; refused < refusals; ++seed) {
        fill(bytes, 4 * STREAMS + seed);
        const fuzz_setting setting = {.workers = 1 + (int32_t)seed % 3,
                                      .simd = FE_SIMD_AUTO,
                                      .is_wild = (int32_t)(seed % 2),
                                      .refused = &refused};
        fuzz_run(bytes, STREAM_BYTES, &setting);
    }
    print_message("%lld calls refused\n", (long long)refused);
}

int main(int argc, char **argv)
{
    if (argc > 1) refusals = strtoll(argv[1], NULL, 10);
    print_message("seeds from 0\n");
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_stream_of_calls_breaks_a_world),
                                       cmocka_unit_test(failed_steps_leave_no_trace),
                                       cmocka_unit_test(refused_calls_leave_every_byte),
                                       cmocka_unit_test(no_stream_of_wild_values_crashes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
