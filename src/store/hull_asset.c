// hull_asset.c - see hull_asset.h. Called by the API layer with checked arguments, from any thread.
#include "store/hull_asset.h"

#include "store/making.h"

static fe_result build(fe_store *store, const fe__hull_points *points, fe__hull_builder *room,
                       fe__hull_refusal *out_refusal, fe_asset *out_handle)
{
    if (!fe__hull_build(room, points, out_refusal)) return FE_ERROR_DEGENERATE;
    fe__asset asset = {.kind = FE__ASSET_HULL};
    void *block = fe__making_block(store, &asset, fe__hull_block_size(room));
    if (!block) return FE_ERROR_MEMORY;
    fe__hull_write(room, block, &asset.hull);
    return fe__making_put(store, &asset, out_handle);
}

fe_result fe__hull_create(fe_store *store, const fe__hull_points *points, fe__hull_refusal *out_refusal,
                          fe_asset *out_handle)
{
    int64_t size = fe__hull_builder_size(points->count);
    fe__hull_builder *room = fe__making_scratch(store, size);
    if (!room) return FE_ERROR_MEMORY;
    fe_result result = build(store, points, room, out_refusal, out_handle);
    fe__making_release(store, room, size);
    return result;
}
