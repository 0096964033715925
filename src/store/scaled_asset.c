// scaled_asset.c - see scaled_asset.h.
#include "store/scaled_asset.h"

#include "collision/hull_build/scale.h"
#include "collision/mesh_build/build.h"
#include "core/ranges.h"

#include <string.h>

// ---- which scales --------------------------------------------------------------------------------------------------
static double farthest(float low, float high, float scale)
{
    return fe__maxd(fe__absd((double)low), fe__absd((double)high)) * fe__absd((double)scale);
}

double fe__asset_farthest(const fe__asset *a, fe_vec3 scale)
{
    int32_t is_hull = a->kind == FE__ASSET_HULL;
    fe_vec3 low = is_hull ? fe__add(a->hull.origin, a->hull.low) : a->mesh.low,
            high = is_hull ? fe__add(a->hull.origin, a->hull.high) : a->mesh.high;
    return fe__maxd(farthest(low.x, high.x, scale.x),
                    fe__maxd(farthest(low.y, high.y, scale.y), farthest(low.z, high.z, scale.z)));
}

int32_t fe__asset_takes_scale(const fe__asset *a, fe_vec3 scale)
{
    const float s[3] = {fe__absf(scale.x), fe__absf(scale.y), fe__absf(scale.z)};
    if (a->kind != FE__ASSET_HULL && a->kind != FE__ASSET_MESH) return 0;
    for (int32_t k = 0; k < 3; ++k)
        if (!(s[k] >= FE_LEAST_SCALE && s[k] <= FE_MAX_SCALE)) return 0;
    return fe__asset_farthest(a, scale) <= (double)FE_MAX_LENGTH;
}

// ---- the tree ------------------------------------------------------------------------------------------------------
static int32_t is_same(fe_vec3 a, fe_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

// Bit `depth`: the highest of x first, the lowest of z last
static int32_t bit_of(fe_vec3 scale, int32_t depth)
{
    const float numbers[3] = {scale.x, scale.y, scale.z};
    uint32_t bits;
    memcpy(&bits, numbers + depth / 32, sizeof bits);
    return (int32_t)(bits >> (31 - depth % 32) & 1u);
}

// The link to the record with that scale, or the one where it belongs
static fe__asset **find_link(fe__asset *parent, fe_vec3 scale)
{
    fe__asset **link = &parent->scaled;
    for (int32_t depth = 0; *link && !is_same((*link)->scale, scale); ++depth)
        link = &(*link)->branch[bit_of(scale, depth)];
    return link;
}

// Any leaf below it may take its place: the bits above are the same.
void fe__scaled_remove(fe__asset *scaled)
{
    fe__asset **link = find_link(scaled->parent, scaled->scale), **leaf = link;
    while ((*leaf)->branch[0] || (*leaf)->branch[1]) leaf = &(*leaf)->branch[(*leaf)->branch[0] == NULL];
    fe__asset *heir = *leaf;
    *leaf = NULL;
    if (heir == scaled) return;
    heir->branch[0] = scaled->branch[0], heir->branch[1] = scaled->branch[1];
    *link = heir;
}

// ---- making --------------------------------------------------------------------------------------------------------
static fe_result scale_hull(fe_store *store, const fe__asset *parent, fe__asset *scaled, fe__scale_refusal *refusal)
{
    int64_t size = fe__hull_scaled_size(&parent->hull, scaled->scale);
    void *block = fe__asset_allocate(store, scaled, (size_t)size);
    if (!block) return FE_ERROR_MEMORY;
    int32_t is_made = fe__hull_write_scaled(&parent->hull, scaled->scale, block, &scaled->hull, &refusal->hull);
    return is_made ? FE_OK : FE_ERROR_DEGENERATE;
}

static fe_result scale_mesh(const fe__asset *parent, fe__asset *scaled, fe__scale_refusal *refusal)
{
    scaled->materials = parent->materials, scaled->material_count = parent->material_count;
    refusal->triangle = fe__mesh_scale(&parent->mesh, scaled->scale, &scaled->mesh);
    return refusal->triangle < 0 ? FE_OK : FE_ERROR_DEGENERATE;
}

// A destroyed asset from the start: no handle finds it, and it goes with its last user.
static fe_result make(fe_store *store, fe__asset *parent, fe_vec3 scale, fe__asset **link, fe__scale_refusal *refusal)
{
    fe__asset scaled = {.kind = parent->kind, .destroyed = 1, .parent = parent, .scale = scale};
    fe_asset unused;
    fe_result result = parent->kind == FE__ASSET_HULL ? scale_hull(store, parent, &scaled, refusal)
                                                      : scale_mesh(parent, &scaled, refusal);
    if (result == FE_OK) result = fe__store_put(store, &scaled, &unused);
    if (result != FE_OK) {
        fe__asset_free(store, &scaled);
        return result;
    }
    *link = fe__store_asset(store, fe__id_slot_of(unused));
    fe__asset_retain(store, parent->index);
    return FE_OK;
}

fe_result fe__asset_scaled(fe_store *store, int32_t index, fe_vec3 scale, int32_t *out_index,
                           fe__scale_refusal *out_refusal)
{
    fe__asset *parent = fe__store_asset(store, index), **link = find_link(parent, scale);
    if (!*link) {
        fe_result result = make(store, parent, scale, link, out_refusal);
        if (result != FE_OK) return result;
    }
    *out_index = (*link)->index;
    return FE_OK;
}
