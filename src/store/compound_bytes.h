// compound_bytes.h - the parts of a compound as bytes, and the assets that they have.
//
//   parts, assets (counts) | parts | the bytes of each asset (asset_bytes.h)
//   a part   geometry | number of its asset, -1: none | radius, half height | half extents | scale | position |
//            rotation | density | 1: a material of its own | 0 | the material | user data
//
// Assets stand in the order in which parts first have them, each once, so that what is read is written again as it was.
// What a part does not have is 0 in all bits.
#ifndef FE_STORE_COMPOUND_BYTES_H
#define FE_STORE_COMPOUND_BYTES_H
#include "collision/cooked/cooked.h"
#include "store/store.h"

int64_t fe__compound_bytes(const fe_store *store, const fe__compound *compound);
// Under the lock. Returns the end
unsigned char *fe__compound_write(const fe_store *store, const fe__compound *compound, unsigned char *out);

// The compound and its block become the asset's, its assets live as long as it does. 0: refused, or no memory: the
// caller drops the asset with the parts that it has. The lock is free.
int32_t fe__compound_read(fe_store *store, fe__cooked *cooked, const unsigned char *end, fe__asset *asset);

#endif
