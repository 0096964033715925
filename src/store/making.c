// making.c - see making.h.
#include "store/making.h"

void *fe__making_room(fe_store *store, int64_t size)
{
    if ((uint64_t)size > SIZE_MAX) return NULL;
    fe__store_lock(store);
    void *room = fe__allocate(&store->memory, (size_t)size);
    fe__store_unlock(store);
    return room;
}

// a small asset touches little of it
void *fe__making_scratch(fe_store *store, int64_t size)
{
    if ((uint64_t)size > SIZE_MAX) return NULL;
    fe__store_lock(store);
    void *room = fe__allocate_scratch(&store->memory, (size_t)size);
    fe__store_unlock(store);
    return room;
}

void fe__making_release(fe_store *store, void *room, int64_t size)
{
    fe__store_lock(store);
    fe__release(&store->memory, room, (size_t)size);
    fe__store_unlock(store);
}

void *fe__making_block(fe_store *store, fe__asset *asset, int64_t size)
{
    if ((uint64_t)size > SIZE_MAX) return NULL;
    fe__store_lock(store);
    void *block = fe__asset_allocate(store, asset, (size_t)size);
    fe__store_unlock(store);
    return block;
}

static void drop(fe_store *store, fe__asset *asset)
{
    if (asset->kind == FE__ASSET_COMPOUND) fe__compound_release_parts(store, &asset->compound);
    fe__asset_free(store, asset);
}

fe_result fe__making_put(fe_store *store, fe__asset *asset, fe_asset *out_handle)
{
    fe__store_lock(store);
    fe_result result = fe__store_put(store, asset, out_handle);
    if (result != FE_OK) drop(store, asset);
    fe__store_unlock(store);
    return result;
}

void fe__making_drop(fe_store *store, fe__asset *asset)
{
    fe__store_lock(store);
    drop(store, asset);
    fe__store_unlock(store);
}

int32_t fe__material_is_special(const fe_material *m)
{
    return m->restitution > 0.0f || m->rolling_resistance > 0.0f || m->spinning_resistance > 0.0f;
}
