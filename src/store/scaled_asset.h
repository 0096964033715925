// scaled_asset.h - hulls and meshes under the scales of shapes.
//
// One record for each asset and scale, which all shapes of that scale share. It has no name outside: handles are the
// asset's. It keeps its asset alive and goes with its last user. A hull's holds a copy, a mesh's the arrays and the
// materials of the asset.
//
// An asset's records hang in a tree by the bits of their scales (a digital search tree: Coffman and Eve, File
// structures using hashing functions, 1970): a way down it has as many bits as three floats at most, and nothing but
// the numbers tells what is found.
#ifndef FE_STORE_SCALED_ASSET_H
#define FE_STORE_SCALED_ASSET_H
#include "collision/hull_build/build.h"
#include "store/store.h"

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

#endif
