// asset_test.h - what the tests of assets share: a store, and makers whose allocations fail.
#ifndef FE_TESTS_ASSET_TEST_H
#define FE_TESTS_ASSET_TEST_H
#include "api_test.h"
#include "robust/counting_allocator.h"

static inline fe_store *new_store(const fe_allocator *allocator)
{
    fe_store_def def;
    fe_store_def_init(&def, sizeof def);
    def.allocator = allocator;
    fe_store *store = NULL;
    OK(fe_store_create(&def, &store));
    return store;
}

typedef fe_result asset_maker(fe_store *store, fe_asset *out_asset);

// Six assets: their room, their blocks, two chunks of records and the table of handles. Of one that fails nothing is
// left, and the call can be repeated.
static inline int64_t make_six_assets(counting *c, fe_store *store, asset_maker *make, int64_t most_left)
{
    int64_t failed = 0;
    for (int32_t i = 0; i < 6; ++i) {
        fe_asset asset = 77;
        int64_t bytes = c->bytes;
        fe_result result = make(store, &asset);
        if (result == FE_OK) continue;
        assert_int_equal(result, FE_ERROR_MEMORY);
        SAYS("no memory");
        FE_TRUE(asset == 0 && c->bytes - bytes <= most_left); // a chunk or table may have been made, and is used next
        failed += 1;
        i -= 1;
    }
    return failed;
}

// Fails each allocation in turn; how many there are when none fails. `most_left`: bytes of chunks and tables that a
// call which fails may have made
static inline int64_t fail_each_allocation_of(asset_maker *make, int64_t most_left)
{
    int64_t calls = 0;
    for (int64_t first = 0; first <= calls; ++first) {
        counting c = {0};
        fe_allocator allocator = counting_allocator(&c);
        fe_store *store = new_store(&allocator);
        int64_t before = c.calls;
        if (first) c.fail_from = before + first, c.fail_count = 1;
        assert_int_equal(make_six_assets(&c, store, make, most_left), first != 0);
        if (!first) calls = c.calls - before;
        OK(fe_store_destroy(store));
        assert_int_equal(c.blocks, 0);
        assert_int_equal(c.bytes, 0);
        assert_int_equal(c.wrong, 0);
    }
    return calls;
}
static inline int64_t fail_each_asset_allocation(asset_maker *make) { return fail_each_allocation_of(make, 4096); }

#endif
