// The fingerprint depends on every bit, on the order, and on nothing of the machine.
#include "fe_test.h"

#include "core/bytes.h"

static uint64_t hash_of(const uint64_t *words, int count)
{
    fe__hash hash = fe__hash_begin();
    for (int i = 0; i < count; ++i) fe__hash_u64(&hash, words[i]);
    return fe__hash_end(&hash);
}

// The formula of the header, written out a second time.
static void the_step_is_the_documented_one(void **state)
{
    (void)state;
    uint64_t s = 0,
             words[] = {UINT64_C(0x0123456789ABCDEF), 0, ~UINT64_C(0), 1, 5, 0, 0}; // 4 words, then what the end feeds
    words[4] = 4;
    for (int i = 0; i < 7; ++i) {
        s = (s ^ words[i]) * UINT64_C(0x9E3779B97F4A7C15);
        s ^= s >> 32;
    }
    assert_true(hash_of(words, 4) == s);
}

static void minus_zero_is_another_value(void **state)
{
    (void)state;
    fe__hash a = fe__hash_begin(), b = fe__hash_begin(), c = fe__hash_begin(), d = fe__hash_begin();
    fe__hash_float(&a, 0.0f), fe__hash_float(&b, -0.0f);
    fe__hash_double(&c, 0.0), fe__hash_double(&d, -0.0);
    assert_true(fe__hash_end(&a) != fe__hash_end(&b));
    assert_true(fe__hash_end(&c) != fe__hash_end(&d));
}

static void length_and_order_count(void **state)
{
    (void)state;
    const uint64_t zeros[3] = {0}, ab[2] = {1, 2}, ba[2] = {2, 1};
    assert_true(hash_of(zeros, 0) != hash_of(zeros, 1));
    assert_true(hash_of(zeros, 1) != hash_of(zeros, 2));
    assert_true(hash_of(zeros, 2) != hash_of(zeros, 3));
    assert_true(hash_of(ab, 2) != hash_of(ba, 2));
}

static void structs_go_in_as_pairs_of_words(void **state)
{
    (void)state;
    const struct {
        uint32_t low, high;
        float last;
    } fields = {0x89ABCDEF, 0x01234567, 1.0f};
    const uint64_t words[3] = {12, UINT64_C(0x0123456789ABCDEF), 0x3F800000};
    fe__hash hash = fe__hash_begin();
    fe__hash_struct(&hash, &fields, sizeof fields);
    assert_true(fe__hash_end(&hash) == hash_of(words, 3));

    const uint32_t with_zero[2] = {7, 0};
    fe__hash shorter = fe__hash_begin(); // a zero at the end counts
    fe__hash_struct(&shorter, with_zero, 4);
    fe__hash longer = fe__hash_begin();
    fe__hash_struct(&longer, with_zero, 8);
    assert_true(fe__hash_end(&shorter) != fe__hash_end(&longer));
}

static void arrays_of_32_bits_go_in_as_pairs(void **state)
{
    (void)state;
    const uint32_t halves[3] = {0x89ABCDEF, 0x01234567, 0xFFFFFFFF};
    const uint64_t words[3] = {3, UINT64_C(0x0123456789ABCDEF), 0xFFFFFFFF};
    fe__hash hash = fe__hash_begin();
    fe__hash_u32_array(&hash, halves, 3);
    assert_true(fe__hash_end(&hash) == hash_of(words, 3));
    fe__hash wide = fe__hash_begin();
    fe__hash_u64_array(&wide, words + 1, 2);
    const uint64_t same[3] = {2, words[1], words[2]};
    assert_true(fe__hash_end(&wide) == hash_of(same, 3));
}

static void vectors_go_in_by_their_bits(void **state)
{
    (void)state;
    const uint64_t words[5] = {UINT64_C(0x400000003F800000), 0xBF800000, UINT64_C(0x3FF0000000000000),
                               UINT64_C(0xC000000000000000), 0};
    fe__hash hash = fe__hash_begin();
    fe__hash_vec3(&hash, (fe_vec3){1.0f, 2.0f, -1.0f});
    fe__hash_dvec3(&hash, (fe_dvec3){1.0, -2.0, 0.0});
    assert_true(fe__hash_end(&hash) == hash_of(words, 5));
}

// One bit turned in any of 8 words turns half of the 64 result bits: 32 +- 4 each (the standard deviation of one fair
// try), and 32 +- 1 on average over 512 tries, which fair coins miss once in 10^7.
static void one_bit_turns_half_of_the_result(void **state)
{
    (void)state;
    uint64_t words[8], total = 0;
    for (uint64_t i = 0; i < 8; ++i) words[i] = i * UINT64_C(0x123456789);
    uint64_t before = hash_of(words, 8);
    for (int bit = 0; bit < 512; ++bit) {
        words[bit / 64] ^= UINT64_C(1) << bit % 64;
        int turned = __builtin_popcountll(hash_of(words, 8) ^ before);
        words[bit / 64] ^= UINT64_C(1) << bit % 64;
        FE_WITHIN(turned, 32 - 6 * 4, 32 + 6 * 4);
        total += (uint64_t)turned;
    }
    FE_NEAR((double)total / 512.0, 32.0, 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_step_is_the_documented_one),   cmocka_unit_test(minus_zero_is_another_value),
        cmocka_unit_test(length_and_order_count),           cmocka_unit_test(structs_go_in_as_pairs_of_words),
        cmocka_unit_test(arrays_of_32_bits_go_in_as_pairs), cmocka_unit_test(vectors_go_in_by_their_bits),
        cmocka_unit_test(one_bit_turns_half_of_the_result),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
