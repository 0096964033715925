// Sorting keys: in order, nothing lost, ties as they came.
#include "fe_test.h"

#include "core/sort.h"

#include <stdlib.h>

enum { MOST = 5000 };

static fe__sort_item items[MOST], scratch[MOST];
static uint64_t noise;

static uint64_t random_bits(void)
{
    noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return noise >> 32 ^ noise << 29;
}

// `value` is the item's place before, `spare` a copy of the key's low bits: both tell afterwards whether the item is
// whole.
static void fill(int32_t count, uint64_t mask)
{
    for (int32_t i = 0; i < count; ++i) {
        uint64_t key = random_bits() & mask;
        items[i] = (fe__sort_item){key, i, (int32_t)(key & 0xFFFF)};
    }
}

// Sorted and stable: (key, place before) rises strictly, so no item is there twice; n places within [0, n) are then all
// of them.
static void assert_sorted(int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        assert_in_range(items[i].value, 0, count - 1);
        assert_int_equal(items[i].spare, (int32_t)(items[i].key & 0xFFFF));
        if (i == 0) continue;
        assert_true(items[i - 1].key < items[i].key ||
                    (items[i - 1].key == items[i].key && items[i - 1].value < items[i].value));
    }
}

static void assert_permutation(int32_t count)
{
    char *seen = calloc((size_t)count + 1, 1);
    assert_non_null(seen);
    for (int32_t i = 0; i < count; ++i) seen[items[i].value] = 1;
    for (int32_t i = 0; i < count; ++i) assert_int_equal(seen[i], 1);
    free(seen);
}

// Around the sizes where the method changes, with keys of few and many bits: low ones, high ones, all.
static void any_count_and_any_keys_are_sorted_stably(void **state)
{
    (void)state;
    const int32_t counts[] = {0, 1, 2, 3, 15, 47, 48, 49, 50, 255, 256, 257, 1000, MOST};
    const uint64_t masks[] = {
        0, 1, 0xFF, 0x3FF, 0xFFFFFFFF, UINT64_C(0xFF00000000000000), UINT64_C(0x00FF00FF0000FF00), ~UINT64_C(0)};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; ++c) {
        for (size_t m = 0; m < sizeof masks / sizeof *masks; ++m) {
            noise = c * 100 + m + 1;
            fill(counts[c], masks[m]);
            fe__sort_keys(items, counts[c], scratch);
            assert_sorted(counts[c]);
            assert_permutation(counts[c]);
        }
    }
}

static void sorted_and_reversed_input_is_sorted(void **state)
{
    (void)state;
    for (int32_t count = 40; count < 400; count += 40) {
        for (int32_t i = 0; i < count; ++i) items[i] = (fe__sort_item){(uint64_t)i, i, i};
        fe__sort_keys(items, count, scratch);
        for (int32_t i = 0; i < count; ++i) assert_int_equal(items[i].value, i);
        for (int32_t i = 0; i < count; ++i) items[i] = (fe__sort_item){(uint64_t)(count - i), i, 0};
        fe__sort_keys(items, count, scratch);
        for (int32_t i = 0; i < count; ++i) assert_int_equal(items[i].value, count - 1 - i);
    }
}

static void the_largest_and_smallest_keys_have_their_places(void **state)
{
    (void)state;
    noise = 5;
    fill(300, ~UINT64_C(0));
    items[100].key = 0;
    items[200].key = UINT64_MAX;
    fe__sort_keys(items, 300, scratch);
    assert_int_equal(items[0].value, 100);
    assert_int_equal(items[299].value, 200);
}

static void nothing_beyond_the_count_is_touched(void **state)
{
    (void)state;
    for (int32_t count = 10; count <= 100; count += 90) {
        noise = 9;
        fill(count, 0xFFFF);
        items[count] = scratch[count] = (fe__sort_item){0, -5, -6};
        fe__sort_keys(items, count, scratch);
        assert_true(items[count].key == 0 && items[count].value == -5 && items[count].spare == -6);
        assert_true(scratch[count].key == 0 && scratch[count].value == -5 && scratch[count].spare == -6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_count_and_any_keys_are_sorted_stably),
        cmocka_unit_test(sorted_and_reversed_input_is_sorted),
        cmocka_unit_test(the_largest_and_smallest_keys_have_their_places),
        cmocka_unit_test(nothing_beyond_the_count_is_touched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
