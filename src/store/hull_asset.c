// hull_asset.c - see hull_asset.h. Called by the API layer with checked arguments, from any thread.
#include "store/hull_asset.h"

// Scratch, which nobody zeroes: a small hull touches little of it
typedef struct work_room {
    double *block;
    int32_t capacity;
} work_room;

static int32_t reserve_room(fe_store *store, work_room *room, int64_t size)
{
    fe__store_lock(store);
    int32_t reserved = FE_RENEW(&store->memory, room->block, room->capacity, size / (int64_t)sizeof(double) + 1);
    fe__store_unlock(store);
    return reserved;
}

static void release_room(fe_store *store, work_room *room)
{
    fe__store_lock(store);
    FE_FREE(&store->memory, room->block, room->capacity);
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
    work_room room = {NULL, 0};
    if (!reserve_room(store, &room, fe__hull_builder_size(points->count))) return FE_ERROR_MEMORY;
    fe_result result = build(store, points, (fe__hull_builder *)(void *)room.block, out_refusal, out_handle);
    release_room(store, &room);
    return result;
}
