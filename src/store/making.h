// making.h - what the makers of assets share: memory and a place in the store, each under its lock, which is free while
// an asset is built.
#ifndef FE_STORE_MAKING_H
#define FE_STORE_MAKING_H
#include "store/store.h"

void *fe__making_room(fe_store *store, int64_t size);    // zeroed, aligned to 64 bytes; NULL: no memory
void *fe__making_scratch(fe_store *store, int64_t size); // the same, not zeroed
void fe__making_release(fe_store *store, void *room, int64_t size);
// A block of the asset; NULL: no memory
void *fe__making_block(fe_store *store, fe__asset *asset, int64_t size);
// The store owns the asset's blocks and a compound's parts then, or lets go of them: FE_ERROR_MEMORY, FE_ERROR_LIMIT.
fe_result fe__making_put(fe_store *store, fe__asset *asset, fe_asset *out_handle);
void fe__making_drop(fe_store *store, fe__asset *asset);      // lets go of them
int32_t fe__material_is_special(const fe_material *material); // it needs special rows

#endif
