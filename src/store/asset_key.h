// asset_key.h - what an asset is known by beyond its store: a fingerprint of its content, of 128 bits, the same on
// every machine.
//
// The numbers that its cooked bytes hold go in, and no other: two assets of one content have one key. An edited
// heightfield, or a mesh of other materials, is another content.
#ifndef FE_STORE_ASSET_KEY_H
#define FE_STORE_ASSET_KEY_H
#include "store/store.h"

typedef struct fe__asset_key {
    uint64_t words[2];
} fe__asset_key;

static inline int32_t fe__keys_are_same(fe__asset_key a, fe__asset_key b)
{
    return a.words[0] == b.words[0] && a.words[1] == b.words[1];
}

// ---- under the lock ------------------------------------------------------------------------------------------------
// Of an asset, or of the one that a scaled record is made of. Computed when it is first asked for after a change
fe__asset_key fe__asset_key_of(const fe_store *store, int32_t index);
// The record with that key, no scaled one; of several that with the handle (of a store with any number), else the first
// that is not destroyed, else the first. -1: none
int32_t fe__store_find_key(const fe_store *store, fe__asset_key key, fe_asset handle);

#endif
