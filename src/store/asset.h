// asset.h - heightfields in a store.
#ifndef FE_STORE_ASSET_H
#define FE_STORE_ASSET_H
#include "collision/hull_build/hull_builder.h"
#include "collision/mesh_build/mesh_build.h"
#include "store/store.h"

// ---- heightfield asset ----------------------------------------------------------------------------------------------

// A copy of what a checked definition holds. The store's lock is free while samples are copied. FE_ERROR_MEMORY,
// FE_ERROR_LIMIT: nothing changed.
fe_result fe__heightfield_create(fe_store *store, const fe_heightfield_def *def, fe_asset *out_handle);

// The arrays of a heightfield that is being made: its rows and columns are set. 0: no memory; the asset has what there
// was.
int32_t fe__heightfield_allocate(fe_store *store, fe__asset *asset, int32_t has_cells);

// A rectangle of samples. Under the lock; to write them, every world that uses the asset was entered.
typedef struct fe__samples {
    int32_t row, column, rows, columns;
} fe__samples;
void fe__heightfield_write(fe__heightfield *field, const fe__samples *part, const float *heights);
void fe__heightfield_read(const fe__heightfield *field, const fe__samples *part, float *heights);
// What new samples change, in the field's frame: a cell beyond them on each side, at any height.
fe__bounds fe__samples_bounds(const fe__heightfield *field, const fe__samples *part);

// ---- hull asset -----------------------------------------------------------------------------------------------------
// Convex hulls in a store.

// The hull of checked points. The store's lock is free while it is built. FE_ERROR_DEGENERATE: they are too thin, as
// out_refusal tells; FE_ERROR_MEMORY, FE_ERROR_LIMIT. Then nothing changed.
fe_result fe__hull_create(fe_store *store, const fe__hull_points *points, fe__hull_refusal *out_refusal,
                          fe_asset *out_handle);

// ---- mesh asset -----------------------------------------------------------------------------------------------------
// Meshes of triangles in a store.

// The mesh of a checked definition, with copies of its materials. The store's lock is free while it is built.
// FE_ERROR_DEGENERATE: as out_refusal tells; FE_ERROR_MEMORY, FE_ERROR_LIMIT. Then nothing changed.
fe_result fe__mesh_create(fe_store *store, const fe__mesh_source *source, const void *materials,
                          uint32_t material_stride, int32_t material_count, fe__mesh_refusal *out_refusal,
                          fe_asset *out_handle);

// Under the lock; every world that uses the asset was entered. As many as there are.
void fe__mesh_write_materials(fe__asset *asset, const void *materials, uint32_t stride);

// ---- scaled asset ---------------------------------------------------------------------------------------------------
// Hulls and meshes under the scales of shapes.
//
// One record for each asset and scale, which all shapes of that scale share. It has no name outside: handles are the
// asset's. It keeps its asset alive and goes with its last user. A hull's holds a copy, a mesh's the arrays and the
// materials of the asset.
//
// An asset's records hang in a tree by the bits of their scales (a digital search tree: Coffman and Eve, File
// structures using hashing functions, 1970): a way down it has as many bits as three floats at most, and nothing but
// the numbers tells what is found.

// Why a form has no such scale
typedef struct fe__scale_refusal {
    fe__hull_refusal hull;
    int32_t triangle; // of a mesh, which would be too flat
} fe__scale_refusal;

// The largest coordinate of an asset, a hull or a mesh, under the scale, m
double fe__asset_farthest(const fe__asset *asset, fe_vec3 scale);
// Is it of a kind that has scales, and the scale none that nobody may give it?
int32_t fe__asset_takes_scale(const fe__asset *asset, fe_vec3 scale);

// ---- under the lock ------------------------------------------------------------------------------------------------
// The record of an asset, a hull or a mesh, under a scale: made unless it is there. The caller retains it; nobody has
// it before. FE_ERROR_DEGENERATE: as out_refusal tells; FE_ERROR_MEMORY, FE_ERROR_LIMIT. Then nothing changed.
fe_result fe__asset_scaled(fe_store *store, int32_t index, fe_vec3 scale, int32_t *out_index,
                           fe__scale_refusal *out_refusal);
void fe__scaled_remove(fe__asset *scaled); // out of the tree, as it goes

// ---- making ---------------------------------------------------------------------------------------------------------
// What the makers of assets share: memory and a place in the store, each under its lock, which is free while
// an asset is built.

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
