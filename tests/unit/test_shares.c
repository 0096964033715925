// Shares of blocks: each block once, neighbours to one worker, the same in each pass.
#include "fe_test.h"

#include "core/memory.h"

enum { MOST_BLOCKS = 300, BLOCKS_OF_CREW = 7400 };

static void each_block_once(void **state)
{
    (void)state;
    fe__shares shares;
    for (int32_t workers = 1; workers <= FE_MAX_WORKERS; ++workers) {
        fe__shares_begin(&shares, workers);
        for (int32_t i = 0; i < workers; ++i) fe__shares_join(&shares); // who has come is not helped
        for (int32_t pass = 1; pass < MOST_BLOCKS; ++pass) {
            int32_t blocks = pass, next = 0;
            for (int32_t worker = 0; worker < workers; ++worker) {
                fe__claims claims = fe__claims_of(worker);
                int32_t own = 0;
                for (int32_t b; (b = fe__shares_claim(&shares, &claims, FE__OWN_SHARES, (uint32_t)pass, blocks)) >= 0;
                     ++own)
                    assert_int_equal(b, next++); // neighbours
                assert_true(own == blocks / workers || own == blocks / workers + 1);
            }
            assert_int_equal(next, blocks);
        }
    }
}

static void helpers_take_what_is_left(void **state)
{
    (void)state;
    enum { WORKERS = 5, BLOCKS = 23, HELPER = 3 };
    fe__shares shares;
    uint8_t seen[BLOCKS] = {0};
    fe__shares_begin(&shares, WORKERS);
    for (int32_t i = 0; i < WORKERS; ++i) fe__shares_join(&shares);
    fe__claims slow = fe__claims_of(1), helper = fe__claims_of(HELPER);
    ++seen[fe__shares_claim(&shares, &slow, FE__OWN_SHARES, 1, BLOCKS)];
    for (int32_t b; (b = fe__shares_claim(&shares, &helper, FE__ALL_SHARES, 1, BLOCKS)) >= 0;) ++seen[b];
    for (int32_t b = 0; b < BLOCKS; ++b) assert_int_equal(seen[b], 1);
    assert_int_equal(fe__shares_claim(&shares, &slow, FE__ALL_SHARES, 1, BLOCKS), -1);
    // the next pass begins anew, and the last one is over for who comes late
    helper = fe__claims_of(HELPER), slow = fe__claims_of(HELPER);
    assert_true(fe__shares_claim(&shares, &helper, FE__OWN_SHARES, 2, BLOCKS) >= 0);
    assert_int_equal(fe__shares_claim(&shares, &slow, FE__OWN_SHARES, 1, BLOCKS), -1);
}

static void who_has_not_come_is_helped_at_once(void **state)
{
    (void)state;
    enum { WORKERS = 4, BLOCKS = 12, OWN = 3 };
    fe__shares shares;
    fe__shares_begin(&shares, WORKERS);
    int32_t first = fe__shares_join(&shares), second = fe__shares_join(&shares), claimed = 0;
    fe__claims claims = fe__claims_of(first);
    while (fe__shares_claim(&shares, &claims, FE__OWN_SHARES, 1, BLOCKS) >= 0) ++claimed;
    assert_int_equal(claimed, 3 * OWN);
    claims = fe__claims_of(second);
    for (claimed = 0; fe__shares_claim(&shares, &claims, FE__OWN_SHARES, 1, BLOCKS) >= 0;) ++claimed;
    assert_int_equal(claimed, OWN);
}

static void every_worker_is_somebody(void **state)
{
    (void)state;
    fe__shares shares;
    fe__shares_begin(&shares, FE_MAX_WORKERS);
    uint64_t seen = 0;
    for (int32_t i = 0; i < FE_MAX_WORKERS; ++i) seen |= (uint64_t)1 << fe__shares_join(&shares);
    assert_true(seen == UINT64_MAX);
}

typedef struct crew {
    fe__shares shares;
    _Atomic int32_t done[FE_MAX_WORKERS];
} crew;

static void claim_all(void *argument, int32_t index)
{
    crew *c = argument;
    int32_t worker = fe__shares_join(&c->shares);
    (void)index;
    fe__claims claims = fe__claims_of(worker);
    while (fe__shares_claim(&c->shares, &claims, FE__ALL_SHARES, 1, BLOCKS_OF_CREW) >= 0)
        atomic_fetch_add(&c->done[worker], 1);
}

static void threads_share_all(void **state)
{
    (void)state;
    enum { WORKERS = 8 };
    static crew c;
    fe__workers workers;
    assert_int_equal(fe__workers_hire(&workers, NULL, NULL, WORKERS), FE_OK);
    fe__shares_begin(&c.shares, WORKERS);
    fe__run(&workers, claim_all, &c, WORKERS);
    int32_t sum = 0;
    for (int32_t i = 0; i < WORKERS; ++i) sum += atomic_load(&c.done[i]);
    assert_int_equal(sum, BLOCKS_OF_CREW);
    fe__workers_dismiss(&workers);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_block_once),
        cmocka_unit_test(helpers_take_what_is_left),
        cmocka_unit_test(who_has_not_come_is_helped_at_once),
        cmocka_unit_test(every_worker_is_somebody),
        cmocka_unit_test(threads_share_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
