// The pair set holds what was put in and not taken out, whatever the order, and fails without a trace.
#include "fe_test.h"

#include "broadphase/pair_set.h"
#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

enum { SHAPES = 60, STEPS = 200000 };

static uint64_t noise = 1;

static int32_t any_below(int32_t n)
{
    noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (int32_t)((noise >> 33) % (uint64_t)n);
}

typedef struct host {
    int32_t refuses;
} host;

static void *host_allocate(void *user, uint64_t size, uint64_t alignment)
{
    FE_TRUE(size <= (UINT64_C(1) << 30) * sizeof(fe__pair_entry)); // what an int32_t counts
    if (((host *)user)->refuses) return NULL;
    return fe__aligned_allocate((size_t)size, (size_t)alignment);
}

static void host_release(void *user, void *block, uint64_t size)
{
    (void)user, (void)size;
    fe__aligned_free(block);
}

static fe__memory memory_of(host *h)
{
    fe_allocator allocator = {.struct_size = sizeof allocator,
                              .allocate = host_allocate,
                              .release = host_release,
                              .user = h};
    fe__memory memory;
    fe__memory_init(&memory, &allocator);
    return memory;
}

// 1770 pairs of 60 shapes, each held two thirds of the time: the table fills and has runs, also around its end.
static void it_holds_what_was_put_in_and_not_taken_out(void **state)
{
    (void)state;
    host h = {0};
    fe__memory memory = memory_of(&h);
    fe__pair_set set = {0};
    static int32_t value[SHAPES][SHAPES];
    memset(value, -1, sizeof value);
    int32_t count = 0;
    for (int32_t i = 0; i < STEPS; ++i) {
        int32_t a = any_below(SHAPES), b = any_below(SHAPES);
        if (a == b) continue;
        int32_t low = a < b ? a : b, high = a < b ? b : a;
        assert_int_equal(fe__pair_set_find(&set, a, b), value[low][high]);
        assert_int_equal(fe__pair_set_find(&set, b, a), value[low][high]);
        if (value[low][high] < 0) {
            assert_int_equal(fe__pair_set_reserve(&set, &memory, 1), 1);
            fe__pair_set_insert(&set, a, b, i);
            value[low][high] = i;
            count += 1;
        } else if (any_below(2)) {
            fe__pair_set_remove(&set, a, b);
            value[low][high] = -1;
            count -= 1;
        }
        assert_int_equal(set.count, count);
        FE_TRUE(3 * set.count <= 2 * set.capacity);
        if (i % 1000) continue;
        for (int32_t x = 0; x < SHAPES; ++x)
            for (int32_t y = x + 1; y < SHAPES; ++y) assert_int_equal(fe__pair_set_find(&set, y, x), value[x][y]);
    }
    fe__pair_set_destroy(&set, &memory);
    assert_int_equal(memory.bytes, 0);
}

static void any_two_indices_are_a_pair_of_their_own(void **state)
{
    (void)state;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe__pair_set set = {0};
    const int32_t ends[5] = {0, 1, 65536, INT32_MAX - 1, INT32_MAX};
    assert_int_equal(fe__pair_set_find(&set, 0, 1), -1);
    fe__pair_set_remove(&set, 0, 1);
    assert_int_equal(fe__pair_set_reserve(&set, &memory, 10), 1);
    for (int32_t i = 0; i < 5; ++i)
        for (int32_t k = 0; k < i; ++k) fe__pair_set_insert(&set, ends[i], ends[k], 10 * i + k);
    for (int32_t i = 0; i < 5; ++i)
        for (int32_t k = 0; k < i; ++k) assert_int_equal(fe__pair_set_find(&set, ends[k], ends[i]), 10 * i + k);
    fe__pair_set_remove(&set, 2, 3); // not there
    assert_int_equal(set.count, 10);
    fe__pair_set_destroy(&set, &memory);
}

static void what_is_reserved_needs_no_memory(void **state)
{
    (void)state;
    host h = {0};
    fe__memory memory = memory_of(&h);
    fe__pair_set set = {0};
    for (int32_t n = 1; n < 5000; n = 3 * n + 1) {
        assert_int_equal(fe__pair_set_reserve(&set, &memory, n), 1);
        int64_t allocations = memory.allocations;
        for (int32_t i = 0; i < n; ++i) fe__pair_set_insert(&set, n, n + 1 + i, i);
        assert_int_equal(memory.allocations, allocations);
        FE_TRUE(3 * set.count <= 2 * set.capacity);
    }
    fe__pair_set_destroy(&set, &memory);
}

static void a_refusal_changes_nothing(void **state)
{
    (void)state;
    host h = {.refuses = 1};
    fe__memory memory = memory_of(&h);
    fe__pair_set set = {0};
    assert_int_equal(fe__pair_set_reserve(&set, &memory, 1), 0);
    FE_TRUE(set.entries == NULL && set.capacity == 0 && set.count == 0);
    h.refuses = 0;
    assert_int_equal(fe__pair_set_reserve(&set, &memory, 20), 1);
    for (int32_t i = 0; i < 20; ++i) fe__pair_set_insert(&set, i, 100 - i, i);
    h.refuses = 1;
    fe__pair_set before = set;
    assert_int_equal(fe__pair_set_reserve(&set, &memory, 1000), 0);
    assert_int_equal(fe__pair_set_reserve(&set, &memory, INT32_MAX), 0);
    assert_memory_equal(&set, &before, sizeof set);
    for (int32_t i = 0; i < 20; ++i) assert_int_equal(fe__pair_set_find(&set, 100 - i, i), i);
    fe__pair_set_destroy(&set, &memory);
    assert_int_equal(memory.bytes, 0);
}

static void pairs_that_come_and_go_take_no_more_room(void **state)
{
    (void)state;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe__pair_set set = {0};
    for (int32_t i = 0; i < STEPS; ++i) {
        assert_int_equal(fe__pair_set_reserve(&set, &memory, 1), 1);
        fe__pair_set_insert(&set, i, i + 1, i);
        if (i >= 10) fe__pair_set_remove(&set, i - 10, i - 9);
    }
    assert_int_equal(memory.allocations, 1);
    fe__pair_set_destroy(&set, &memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_holds_what_was_put_in_and_not_taken_out),
        cmocka_unit_test(any_two_indices_are_a_pair_of_their_own),
        cmocka_unit_test(what_is_reserved_needs_no_memory),
        cmocka_unit_test(a_refusal_changes_nothing),
        cmocka_unit_test(pairs_that_come_and_go_take_no_more_room),
    };
    return cmocka_run_group_tests_name("pair_set", tests, NULL, NULL);
}
