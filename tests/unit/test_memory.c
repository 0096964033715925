// The allocator is counted, hands out zeroed aligned blocks, and loses nothing when it fails.
#include "fe_test.h"

#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

// A host's allocator that hands out dirty memory, counts, and refuses on command.
typedef struct host {
    int64_t live_bytes;
    int32_t allocations;
    int32_t refuses;
    uint64_t last_size, last_alignment;
} host;

static void *host_allocate(void *user, uint64_t size, uint64_t alignment)
{
    host *h = user;
    h->last_size = size, h->last_alignment = alignment;
    if (h->refuses) return NULL;
    void *block = fe__aligned_allocate((size_t)size, (size_t)alignment);
    assert_non_null(block);
    memset(block, 0xA5, (size_t)size);
    h->live_bytes += (int64_t)size;
    h->allocations += 1;
    return block;
}

static void host_release(void *user, void *block, uint64_t size)
{
    host *h = user;
    h->live_bytes -= (int64_t)size;
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

static int all_zero(const void *block, size_t size)
{
    const unsigned char *bytes = block;
    for (size_t i = 0; i < size; ++i) {
        if (bytes[i]) return 0;
    }
    return 1;
}

static void blocks_are_zeroed_and_aligned(void **state)
{
    (void)state;
    host h = {0};
    fe__memory own, of_host = memory_of(&h);
    fe__memory_init(&own, NULL);
    for (size_t size = 1; size < 3000; size = size * 2 + 1) {
        void *a = fe__allocate(&own, size), *b = fe__allocate(&of_host, size);
        assert_int_equal((uintptr_t)a % 64, 0);
        assert_int_equal((uintptr_t)b % 64, 0);
        FE_TRUE(all_zero(a, size) && all_zero(b, size));
        fe__release(&own, a, size);
        fe__release(&of_host, b, size);
    }
    assert_int_equal(h.last_alignment, 64);
}

static void the_counters_tell_what_the_host_sees(void **state)
{
    (void)state;
    host h = {0};
    fe__memory memory = memory_of(&h);
    void *a = fe__allocate(&memory, 100), *b = fe__allocate(&memory, 1000);
    assert_int_equal(memory.bytes, 1100);
    assert_int_equal(memory.bytes, h.live_bytes);
    fe__release(&memory, a, 100);
    assert_int_equal(memory.bytes, 1000);
    fe__release(&memory, b, 1000);
    assert_int_equal(memory.bytes, 0);
    assert_int_equal(h.live_bytes, 0);
    assert_int_equal(memory.allocations, 2);
}

static void nothing_and_too_much_are_refused(void **state)
{
    (void)state;
    host h = {0};
    fe__memory memory = memory_of(&h);
    assert_null(fe__allocate(&memory, 0));
    assert_null(fe__allocate(&memory, SIZE_MAX));
    fe__release(&memory, NULL, 0);
    assert_int_equal(h.allocations, 0);
    assert_int_equal(memory.bytes, 0);

    fe__memory own;
    fe__memory_init(&own, NULL);
    assert_null(fe__allocate(&own, SIZE_MAX));
    assert_null(fe__allocate(&own, SIZE_MAX - 63));
    assert_int_equal(own.allocations, 0);
}

static void arrays_grow_from_one_and_keep_their_records(void **state)
{
    (void)state;
    host h = {0};
    fe__memory memory = memory_of(&h);
    int32_t *numbers = NULL, capacity = 0;
    assert_true(FE_RESERVE(&memory, numbers, capacity, 1));
    assert_int_equal(capacity, 1);
    assert_true(FE_RESERVE(&memory, numbers, capacity, 2));
    assert_int_equal(capacity, 4);
    const int32_t octaves[] = {6, 8, 12, 16};
    for (int32_t i = 0; i < 4; ++i) {
        assert_true(FE_RESERVE(&memory, numbers, capacity, capacity + 1));
        assert_int_equal(capacity, octaves[i]);
    }
    for (int32_t i = 0; i < 16; ++i) numbers[i] = i + 1;
    assert_true(FE_RESERVE(&memory, numbers, capacity, 16));
    assert_int_equal(h.allocations, 6);
    assert_true(FE_RESERVE(&memory, numbers, capacity, 17));
    assert_int_equal(capacity, 24);
    assert_true(FE_RESERVE(&memory, numbers, capacity, 1000));
    assert_int_equal(capacity, 1024);
    for (int32_t i = 0; i < 16; ++i) assert_int_equal(numbers[i], i + 1);
    FE_TRUE(all_zero(numbers + 16, (1024 - 16) * sizeof *numbers));
    assert_int_equal(memory.bytes, 1024 * (int64_t)sizeof *numbers);
    FE_FREE(&memory, numbers, capacity);
    assert_null(numbers);
    assert_int_equal(capacity, 0);
    assert_int_equal(h.live_bytes, 0);
    FE_FREE(&memory, numbers, capacity); // twice is fine
}

static void a_failed_reserve_changes_nothing(void **state)
{
    (void)state;
    host h = {0};
    fe__memory memory = memory_of(&h);
    double *numbers = NULL;
    int32_t capacity = 0;
    assert_true(FE_RESERVE(&memory, numbers, capacity, 20));
    numbers[19] = 7.0;
    double *before = numbers;
    int64_t bytes = memory.bytes, allocations = memory.allocations;

    h.refuses = 1;
    assert_false(FE_RESERVE(&memory, numbers, capacity, 33));
    assert_false(FE_RESERVE(&memory, numbers, capacity, (int64_t)INT32_MAX + 1));
    assert_false(FE_RESERVE(&memory, numbers, capacity, INT64_MAX));
    assert_ptr_equal(numbers, before);
    assert_int_equal(capacity, 20);
    assert_int_equal(memory.bytes, bytes);
    assert_int_equal(memory.allocations, allocations);
    FE_NEAR(numbers[19], 7.0, 0.0);
    h.refuses = 0;
    FE_FREE(&memory, numbers, capacity);
}

// Doubling beyond 2^30 records stops at what an int32_t can count; a size that overflows is refused before the host is
// asked.
static void capacities_stay_below_2_to_the_31(void **state)
{
    (void)state;
    host h = {.refuses = 1};
    fe__memory memory = memory_of(&h);
    char *bytes = NULL;
    int32_t capacity = 0;
    assert_false(fe__reserve(&memory, &bytes, &capacity, INT32_MAX - INT64_C(1), 1));
    assert_int_equal(h.last_size, INT32_MAX);
    h.last_size = 0;
    assert_false(fe__reserve(&memory, &bytes, &capacity, INT32_MAX, SIZE_MAX / 1024));
    assert_int_equal(h.last_size, 0);
    assert_null(bytes);
    assert_int_equal(capacity, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_are_zeroed_and_aligned),
        cmocka_unit_test(the_counters_tell_what_the_host_sees),
        cmocka_unit_test(nothing_and_too_much_are_refused),
        cmocka_unit_test(arrays_grow_from_one_and_keep_their_records),
        cmocka_unit_test(a_failed_reserve_changes_nothing),
        cmocka_unit_test(capacities_stay_below_2_to_the_31),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
