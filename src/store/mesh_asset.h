// mesh_asset.h - meshes of triangles in a store.
#ifndef FE_STORE_MESH_ASSET_H
#define FE_STORE_MESH_ASSET_H
#include "collision/mesh_build/build.h"
#include "store/store.h"

// The mesh of a checked definition, with copies of its materials. The store's lock is free while it is built.
// FE_ERROR_DEGENERATE: as out_refusal tells; FE_ERROR_MEMORY, FE_ERROR_LIMIT. Then nothing changed.
fe_result fe__mesh_create(fe_store *store, const fe__mesh_source *source, const void *materials,
                          uint32_t material_stride, int32_t material_count, fe__mesh_refusal *out_refusal,
                          fe_asset *out_handle);

// Under the lock; every world that uses the asset was entered. As many as there are.
void fe__mesh_write_materials(fe__asset *asset, const void *materials, uint32_t stride);

#endif
