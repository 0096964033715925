// mesh_asset.c - see mesh_asset.h. Called by the API layer with checked arguments, from any thread.
#include "store/mesh_asset.h"

#include "store/making.h"

void fe__mesh_write_materials(fe__asset *a, const void *materials, uint32_t stride)
{
    a->special = a->is_keyed = 0;
    for (int32_t i = 0; i < a->material_count; ++i) {
        memcpy(a->materials + i, (const unsigned char *)materials + (size_t)stride * (size_t)i, sizeof *a->materials);
        a->special |= fe__material_is_special(a->materials + i);
    }
}

static int32_t sort_triangles(fe_store *store, const fe__mesh_source *source, fe__mesh_builder *room,
                              fe__mesh_refusal *out_refusal, fe_result *result)
{
    int64_t size = fe__mesh_scratch_size(source);
    void *scratch = fe__making_scratch(store, size);
    if (!scratch) {
        *result = FE_ERROR_MEMORY;
        return 0;
    }
    int32_t is_built = fe__mesh_build(room, scratch, source);
    fe__making_release(store, scratch, size);
    *out_refusal = room->refusal;
    *result = is_built ? FE_OK : FE_ERROR_DEGENERATE;
    return is_built;
}

static fe_result write_mesh(fe_store *store, fe__mesh_builder *room, fe__asset *asset, const void *materials,
                            uint32_t stride)
{
    void *block = fe__making_block(store, asset, fe__mesh_block_size(room));
    if (block && asset->material_count)
        asset->materials = fe__making_block(store, asset, (int64_t)sizeof *asset->materials * asset->material_count);
    if (!block || (asset->material_count && !asset->materials)) {
        fe__making_drop(store, asset);
        return FE_ERROR_MEMORY;
    }
    fe__mesh_write(room, block, &asset->mesh);
    fe__mesh_write_materials(asset, materials, stride);
    return FE_OK;
}

fe_result fe__mesh_create(fe_store *store, const fe__mesh_source *source, const void *materials,
                          uint32_t material_stride, int32_t material_count, fe__mesh_refusal *out_refusal,
                          fe_asset *out_handle)
{
    int64_t size = fe__mesh_room_size(source);
    fe__mesh_builder *room = fe__making_room(store, size);
    if (!room) return FE_ERROR_MEMORY;
    fe__asset asset = {.kind = FE__ASSET_MESH, .material_count = material_count};
    fe_result result;
    if (sort_triangles(store, source, room, out_refusal, &result))
        result = write_mesh(store, room, &asset, materials, material_stride);
    fe__making_release(store, room, size);
    return result == FE_OK ? fe__making_put(store, &asset, out_handle) : result;
}
