// test_stream.c - copies past the caches: every byte, and none beside.
#include "core/stream.h"
#include "fe_test.h"

enum { MOST = 2300, GUARD = 64 };

static void every_byte_is_copied_and_none_beside(void **state)
{
    (void)state;
    static _Alignas(64) unsigned char from[MOST + GUARD], to[MOST + 2 * GUARD];
    for (int32_t i = 0; i < MOST + GUARD; ++i) from[i] = (unsigned char)(1 + i % 251);
    for (int32_t size = 0; size <= MOST; size += size < 200 ? 1 : 37) {
        for (int32_t off = 0; off < GUARD; off += 13) { // the source stands anywhere
            for (int32_t i = 0; i < MOST + 2 * GUARD; ++i) to[i] = 0;
            fe__stream(to + GUARD, from + off, (size_t)size);
            for (int32_t i = 0; i < MOST + GUARD; ++i) {
                int32_t at = i - GUARD;
                FE_TRUE(to[i] == (at >= 0 && at < size ? from[off + at] : 0));
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_byte_is_copied_and_none_beside)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
