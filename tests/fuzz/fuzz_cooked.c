// fuzz_cooked.c - bytes of assets, broken and stamped anew, as a libFuzzer target: make fuzz. What is accepted must
// bear a world, and give the bytes again from which it came.
//
// The first byte chooses a small asset, whose bytes the others change: place (2 bytes), value (1). Or all others are
// what stands behind the magic.
#include "support/cooked.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

enum { ROOM = 1 << 14 };
static unsigned char seeds[COOKED_SEEDS][ROOM], given[ROOM], saved[ROOM];
static int64_t seed_size[COOKED_SEEDS];

static void must(int32_t holds, const char *what)
{
    if (holds) return;
    fprintf(stderr, "%s: %s\n", what, fe_last_error());
    abort();
}

static void save_seeds(void)
{
    fe_store *store;
    must(fe_store_create(NULL, &store) == FE_OK, "a store");
    for (int32_t i = 0; i < COOKED_SEEDS; ++i) {
        seed_size[i] = fe_asset_save(store, cooked_seed(store, i), seeds[i], ROOM);
        must(seed_size[i] > 0 && seed_size[i] <= ROOM, "a seed");
    }
    fe_store_destroy(store);
}

static int64_t break_seed(int32_t which, const uint8_t *edits, size_t size)
{
    memcpy(given, seeds[which], (size_t)seed_size[which]);
    for (; size >= 3; edits += 3, size -= 3) given[(edits[0] | edits[1] << 8) % seed_size[which]] = edits[2];
    return seed_size[which];
}

static int64_t copy_bytes(const uint8_t *bytes, size_t size)
{
    if (size > ROOM - 48) size = ROOM - 48;
    int64_t whole = (int64_t)(size + 7) / 8 * 8 + 8;
    memset(given, 0, (size_t)whole);
    memcpy(given + 8, bytes, size);
    return whole < 40 ? 40 : whole;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (!seed_size[0]) save_seeds();
    if (size == 0) return 0;
    int32_t which = bytes[0] % (COOKED_SEEDS + 1);
    memset(given, 0, 48);
    int64_t count = which < COOKED_SEEDS ? break_seed(which, bytes + 1, size - 1) : copy_bytes(bytes + 1, size - 1);
    cooked_stamp(given, count);

    fe_store *store;
    fe_asset asset;
    must(fe_store_create(NULL, &store) == FE_OK, "a store");
    fe_result result = fe_asset_load(store, given, count, &asset);
    must(result == FE_OK || result == FE_ERROR_DATA || result == FE_ERROR_VERSION, "neither loaded nor refused");
    if (result == FE_OK) {
        must(fe_asset_save(store, asset, saved, ROOM) == count && !memcmp(saved, given, (size_t)count), "other bytes");
        cooked_use(store, asset, 4);
    }
    fe_store_destroy(store);
    return 0;
}
