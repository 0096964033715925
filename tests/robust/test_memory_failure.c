// test_memory_failure.c - an allocation that fails, whichever it is: the call says FE_ERROR_MEMORY, the world is as
// before, the call can be repeated, and the run goes on to the end that it would have had.
#include "fe_test.h"
#include "robust/counting_allocator.h"
#include "support/play.h"

typedef struct witness {
    counting memory;
    uint64_t hash; // before the call at hand
    int32_t memory_errors;
    int32_t other_errors;
    int32_t changes; // failed calls that left another world behind
} witness;

static void look_before(play *p)
{
    witness *w = p->user;
    if (w->memory.failures < w->memory.fail_count) w->hash = play_hash(p);
}

static int32_t look_after(play *p, fe_result result)
{
    witness *w = p->user;
    if (result >= 0) return 0;
    if (result != FE_ERROR_MEMORY) {
        print_error("step %d: %s\n", (int)p->step, fe_last_error());
        w->other_errors += 1;
        return 0;
    }
    w->memory_errors += 1;
    if (play_hash(p) != w->hash) w->changes += 1;
    return 1;
}

typedef struct outcome {
    uint64_t hash, told;
    int64_t calls;
} outcome;

// The whole script, in which `count` allocations fail from the `first` on
static outcome run(int64_t first, int64_t count)
{
    witness w = {.memory = {.fail_from = first, .fail_count = count}};
    play p;
    play_begin(&p, counting_world(&w.memory));
    p.user = &w;
    p.before = look_before;
    p.after = look_after;
    play_until(&p, &script_brief, script_brief.steps);
    outcome o = {play_hash(&p), play_told(&p), w.memory.calls};
    assert_int_equal(w.memory.failures, count);
    assert_int_equal(w.other_errors, 0);
    assert_int_equal(w.changes, 0);
    fe_world_destroy(p.world);
    assert_int_equal(w.memory.blocks, 0);
    assert_int_equal(w.memory.bytes, 0);
    assert_int_equal(w.memory.wrong, 0);
    return o;
}

#ifdef FE_SANITIZED
enum { STRIDE = 5 };
#else
enum { STRIDE = 1 };
#endif

static void fails_and_goes_on(int64_t count)
{
    outcome whole = run(0, 0);
    assert_in_range(whole.calls, 50, 2000);
    for (int64_t first = 1; first + count <= whole.calls; first += STRIDE) {
        outcome o = run(first, count);
        if (o.hash != whole.hash || o.told != whole.told)
            fail_msg("allocation %d fails, and the run ends otherwise", (int)first);
    }
}

static void each_allocation_may_fail_once(void **state)
{
    (void)state;
    fails_and_goes_on(1);
}

static void three_allocations_in_a_row_may_fail(void **state)
{
    (void)state;
    fails_and_goes_on(3);
}

// nothing more is given at all: the world lives on with what it has, and can be destroyed
static void a_world_without_memory_can_be_read_and_destroyed(void **state)
{
    (void)state;
    witness w = {0};
    play p;
    fe_body body = 0;
    play_begin(&p, counting_world(&w.memory));
    play_until(&p, &script_brief, 90);
    w.memory.fail_from = w.memory.calls + 1;
    w.memory.fail_count = INT32_MAX;
    uint64_t hash = play_hash(&p);
    fe_result result = FE_OK;
    int32_t bodies = fe_world_get_bodies(p.world, NULL, 0), created = 0;
    for (; created < 100 && result == FE_OK; ++created) result = fe_body_create(p.world, NULL, &body);
    assert_int_equal(result, FE_ERROR_MEMORY);
    assert_int_equal(fe_world_get_bodies(p.world, NULL, 0), bodies + created - 1);
    if (created == 1) FE_TRUE(play_hash(&p) == hash);
    FE_TRUE(fe_body_destroy(p.world, p.actors[5]) == FE_OK);
    fe_world_destroy(p.world);
    assert_int_equal(w.memory.blocks, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_allocation_may_fail_once),
        cmocka_unit_test(three_allocations_in_a_row_may_fail),
        cmocka_unit_test(a_world_without_memory_can_be_read_and_destroyed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
