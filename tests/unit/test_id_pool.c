// Handles: never 0, below 2^53, never a second meaning, the same in every run.
#include "fe_test.h"

#include "core/id_pool.h"

enum { NUMBER = 7 }; // of the world

static fe__memory memory;
static fe__id_pool pool;

static int begin(void **state)
{
    (void)state;
    fe__memory_init(&memory, NULL);
    fe__id_pool_init(&pool, FE_KIND_BODY, NUMBER);
    return fe__id_pool_reserve(&pool, &memory, 100) == FE_OK ? 0 : -1;
}

static int finish(void **state)
{
    (void)state;
    fe__id_pool_free(&pool, &memory);
    return memory.bytes == 0 ? 0 : -1;
}

static void handles_are_not_0_and_survive_a_double(void **state)
{
    (void)state;
    fe_handle least = fe__id_make(FE_KIND_BODY, 1, 1, 0),
              most = fe__id_make(FE_KIND_ASSET, FE_ID_LAST_NUMBER, FE_ID_LAST_GENERATION, FE_ID_MAX_SLOTS - 1);
    assert_true(least > 0);
    assert_true(most < UINT64_C(1) << 53);
    assert_true((fe_handle)(double)most == most);
    assert_int_equal(fe__id_slot_of(most), FE_ID_MAX_SLOTS - 1);
    assert_int_equal(fe__id_generation_of(most), FE_ID_LAST_GENERATION);
    assert_int_equal(fe__id_number_of(most), FE_ID_LAST_NUMBER);
    assert_int_equal(fe__id_kind_of(most), FE_KIND_ASSET);
}

static void a_handle_finds_its_slot_until_it_is_released(void **state)
{
    (void)state;
    int32_t slot = -7;
    fe_handle a = fe__id_pool_allocate(&pool), b = fe__id_pool_allocate(&pool);
    assert_int_equal(fe__id_pool_find(&pool, a, &slot), FE_OK);
    assert_int_equal(slot, 0);
    assert_int_equal(fe__id_pool_find(&pool, b, &slot), FE_OK);
    assert_int_equal(slot, 1);
    assert_true(fe__id_pool_handle(&pool, 1) == b);
    assert_int_equal(pool.alive_count, 2);

    fe__id_pool_release(&pool, 0);
    slot = -7;
    assert_int_equal(fe__id_pool_find(&pool, a, &slot), FE_ERROR_STALE);
    assert_int_equal(slot, -7);
    assert_int_equal(pool.alive_count, 1);
    fe_handle c = fe__id_pool_allocate(&pool);
    assert_int_equal(fe__id_slot_of(c), 0);
    assert_int_equal(fe__id_pool_find(&pool, a, &slot), FE_ERROR_STALE);
    assert_int_equal(fe__id_pool_find(&pool, c, &slot), FE_OK);
}

// "slot 0 is at generation 3, the handle has 1"
static void the_generations_of_an_error_sentence_are_at_hand(void **state)
{
    (void)state;
    fe_handle first = fe__id_pool_allocate(&pool);
    fe__id_pool_release(&pool, 0);
    (void)fe__id_pool_allocate(&pool);
    fe__id_pool_release(&pool, 0);
    assert_int_equal(fe__id_generation_of(first), 1);
    assert_int_equal(fe__id_pool_generation(&pool, fe__id_slot_of(first)), 3);
    assert_int_equal(fe__id_pool_generation(&pool, 1), 0); // never opened
    assert_int_equal(fe__id_pool_generation(&pool, -1), 0);
    assert_int_equal(fe__id_pool_generation(&pool, INT32_MAX), 0);
}

static void another_kind_is_told_from_a_stale_handle(void **state)
{
    (void)state;
    int32_t slot = 0;
    fe_handle body = fe__id_pool_allocate(&pool);
    fe_handle shape = fe__id_make(FE_KIND_SHAPE, NUMBER, 1, 0);
    assert_int_equal(fe__id_pool_find(&pool, shape, &slot), FE_ERROR_KIND);
    assert_int_equal(fe__id_pool_find(&pool, 0, &slot), FE_ERROR_STALE);
    assert_int_equal(fe__id_pool_find(&pool, fe__id_make(7, NUMBER, 1, 0), &slot), FE_ERROR_STALE);
    assert_int_equal(fe__id_pool_find(&pool, body | UINT64_C(1) << 53, &slot), FE_ERROR_STALE);
    assert_int_equal(fe__id_pool_find(&pool, body | UINT64_C(1) << 63, &slot), FE_ERROR_STALE);
    assert_int_equal(fe__id_pool_find(&pool, ~UINT64_C(0), &slot), FE_ERROR_STALE);
}

// Of all numbers, only the handles that are out are accepted: tried with every slot and generation near those in use,
// and with noise.
static void a_made_up_number_is_never_accepted(void **state)
{
    (void)state;
    int32_t slot, accepted = 0;
    for (int i = 0; i < 20; ++i) (void)fe__id_pool_allocate(&pool);
    for (int32_t i = 0; i < 20; i += 3) fe__id_pool_release(&pool, i);
    for (int32_t s = -1; s < 200; ++s) {
        for (int32_t generation = 0; generation < 10; ++generation) {
            accepted += fe__id_pool_find(&pool, fe__id_make(FE_KIND_BODY, NUMBER, generation, s), &slot) == FE_OK;
        }
    }
    assert_int_equal(accepted, pool.alive_count);
    assert_int_equal(accepted, 13);
    uint64_t noise = 1;
    for (int i = 0; i < 100000; ++i) {
        noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        fe_result result = fe__id_pool_find(&pool, noise, &slot);
        assert_true(result == FE_ERROR_STALE || result == FE_ERROR_KIND);
    }
}

static void the_slot_released_last_is_given_next(void **state)
{
    (void)state;
    for (int i = 0; i < 5; ++i) (void)fe__id_pool_allocate(&pool);
    fe__id_pool_release(&pool, 3);
    fe__id_pool_release(&pool, 0);
    fe__id_pool_release(&pool, 4);
    assert_int_equal(fe__id_slot_of(fe__id_pool_allocate(&pool)), 4);
    assert_int_equal(fe__id_slot_of(fe__id_pool_allocate(&pool)), 0);
    assert_int_equal(fe__id_slot_of(fe__id_pool_allocate(&pool)), 3);
    assert_int_equal(fe__id_slot_of(fe__id_pool_allocate(&pool)), 5);
}

static void a_slot_without_generations_retires(void **state)
{
    (void)state;
    int32_t slot;
    (void)fe__id_pool_allocate(&pool);
    pool.slots[0].generation = FE_ID_LAST_GENERATION;
    fe_handle last = fe__id_pool_handle(&pool, 0);
    assert_int_equal(fe__id_pool_find(&pool, last, &slot), FE_OK);
    fe__id_pool_release(&pool, 0);
    assert_int_equal(fe__id_pool_find(&pool, last, &slot), FE_ERROR_STALE);
    assert_int_equal(pool.free_count, 0);
    assert_int_equal(fe__id_slot_of(fe__id_pool_allocate(&pool)), 1);
    assert_int_equal(fe__id_pool_find(&pool, last, &slot), FE_ERROR_STALE);
}

static void a_million_rounds_keep_the_memory_flat(void **state)
{
    (void)state;
    int64_t bytes = memory.bytes;
    for (int i = 0; i < 1000000; ++i) {
        assert_int_equal(fe__id_pool_reserve(&pool, &memory, 1), FE_OK);
        fe__id_pool_release(&pool, fe__id_slot_of(fe__id_pool_allocate(&pool)));
    }
    assert_int_equal(memory.bytes, bytes);
    const int32_t retired = 1000000 / FE_ID_LAST_GENERATION; // a slot without generations is not given again
    assert_int_equal(pool.slot_count, retired + 1);
    assert_int_equal(pool.slots[retired].generation, 1000000 % FE_ID_LAST_GENERATION + 1);
}

static void *no_memory(void *user, uint64_t size, uint64_t alignment)
{
    (void)user, (void)size, (void)alignment;
    return NULL;
}

static void release_nothing(void *user, void *block, uint64_t size) { (void)user, (void)block, (void)size; }

static void after_a_reserve_no_allocation_fails(void **state)
{
    (void)state;
    fe_allocator empty = {.struct_size = sizeof empty, .allocate = no_memory, .release = release_nothing};
    fe__memory without;
    fe__memory_init(&without, &empty);
    int32_t slot, room = pool.capacity;
    for (int32_t i = 0; i < 10; ++i) (void)fe__id_pool_allocate(&pool);
    fe__id_pool_release(&pool, 5);
    assert_int_equal(fe__id_pool_reserve(&pool, &without, room - 9), FE_OK); // one free slot, room - 10 unopened ones
    assert_int_equal(fe__id_pool_reserve(&pool, &without, room - 8), FE_ERROR_MEMORY);
    assert_int_equal(fe__id_pool_reserve(&pool, &without, FE_ID_MAX_SLOTS - 9), FE_ERROR_MEMORY);
    assert_int_equal(fe__id_pool_reserve(&pool, &without, FE_ID_MAX_SLOTS - 8), FE_ERROR_LIMIT);
    assert_int_equal(fe__id_pool_reserve(&pool, &without, INT32_MAX), FE_ERROR_LIMIT);
    for (int32_t i = 0; i < room - 9; ++i)
        assert_int_equal(fe__id_pool_find(&pool, fe__id_pool_allocate(&pool), &slot), FE_OK);
    assert_int_equal(pool.alive_count, room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(handles_are_not_0_and_survive_a_double, begin, finish),
        cmocka_unit_test_setup_teardown(a_handle_finds_its_slot_until_it_is_released, begin, finish),
        cmocka_unit_test_setup_teardown(the_generations_of_an_error_sentence_are_at_hand, begin, finish),
        cmocka_unit_test_setup_teardown(another_kind_is_told_from_a_stale_handle, begin, finish),
        cmocka_unit_test_setup_teardown(a_made_up_number_is_never_accepted, begin, finish),
        cmocka_unit_test_setup_teardown(the_slot_released_last_is_given_next, begin, finish),
        cmocka_unit_test_setup_teardown(a_slot_without_generations_retires, begin, finish),
        cmocka_unit_test_setup_teardown(a_million_rounds_keep_the_memory_flat, begin, finish),
        cmocka_unit_test_setup_teardown(after_a_reserve_no_allocation_fails, begin, finish),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
