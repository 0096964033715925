// hull_asset.c - see hull_asset.h. Called by the API layer with checked arguments, from any thread.
#include "store/hull_asset.h"

static void *allocate_room(fe_store *store, size_t size)
{
    fe__store_lock(store);
    void *room = fe__allocate(&store->memory, size);
    fe__store_unlock(store);
    return room;
}

static void release_room(fe_store *store, void *room, size_t size)
{
    fe__store_lock(store);
    fe__release(&store->memory, room, size);
    fe__store_unlock(store);
}

static int32_t allocate_block(fe_store *store, fe__asset *asset, size_t size)
{
    fe__store_lock(store);
    void *block = fe__asset_allocate(store, asset, size);
    fe__store_unlock(store);
    return block != NULL;
}

static fe_result put(fe_store *store, fe__asset *asset, fe_asset *out_handle)
{
    fe__store_lock(store);
    fe_result result = fe__store_put(store, asset, out_handle);
    if (result != FE_OK) fe__asset_free(store, asset);
    fe__store_unlock(store);
    return result;
}

static fe_result build(fe_store *store, const fe__hull_points *points, fe__hull_builder *room,
                       fe__hull_refusal *out_refusal, fe_asset *out_handle)
{
    if (!fe__hull_build(room, points, out_refusal)) return FE_ERROR_DEGENERATE;
    fe__asset asset = {.kind = FE__ASSET_HULL};
    if (!allocate_block(store, &asset, (size_t)fe__hull_block_size(room))) return FE_ERROR_MEMORY;
    fe__hull_write(room, asset.blocks[0].memory, &asset.hull);
    return put(store, &asset, out_handle);
}

fe_result fe__hull_create(fe_store *store, const fe__hull_points *points, fe__hull_refusal *out_refusal,
                          fe_asset *out_handle)
{
    size_t size = (size_t)fe__hull_builder_size(points->count);
    fe__hull_builder *room = allocate_room(store, size);
    if (!room) return FE_ERROR_MEMORY;
    fe_result result = build(store, points, room, out_refusal, out_handle);
    release_room(store, room, size);
    return result;
}
