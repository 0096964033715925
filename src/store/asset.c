// asset.c - see asset.h. Called by the API layer with checked arguments, from any thread.
#include "store/asset.h"

#include "collision/hull_build/hull_builder.h"
#include "collision/mesh_build/mesh_build.h"
#include "core/bytes.h"

#include <string.h>

// ---- heightfield asset ----------------------------------------------------------------------------------------------

static int64_t sample_count(const fe__heightfield *f) { return (int64_t)f->rows * f->columns; }
static int64_t cell_count(const fe__heightfield *f) { return (int64_t)(f->rows - 1) * (f->columns - 1); }
static size_t heights_size(const fe__heightfield *f) { return (size_t)sample_count(f) * sizeof *f->heights; }
static size_t ranges_size(const fe__heightfield *f) { return (size_t)f->rows * sizeof *f->ranges; }
static size_t materials_size(const fe__asset *a) { return (size_t)a->material_count * sizeof *a->materials; }

// ---- birth ---------------------------------------------------------------------------------------------------------
int32_t fe__heightfield_allocate(fe_store *store, fe__asset *a, int32_t has_cells)
{
    fe__heightfield *f = &a->field;
    fe__store_lock(store);
    f->heights = fe__asset_allocate(store, a, heights_size(f));
    f->ranges = fe__asset_allocate(store, a, ranges_size(f));
    if (has_cells) f->cells = fe__asset_allocate(store, a, (size_t)cell_count(f));
    fe__store_unlock(store);
    return f->heights && f->ranges && (f->cells || !has_cells);
}

static int32_t allocate(fe_store *store, const fe_heightfield_def *def, fe__asset *a)
{
    int32_t is_whole = fe__heightfield_allocate(store, a, def->holes || def->cell_materials);
    if (a->material_count) a->materials = fe__making_block(store, a, (int64_t)materials_size(a));
    if (is_whole && (a->materials || !a->material_count)) return 1;
    fe__making_drop(store, a);
    return 0;
}

static void fill_cells(fe__heightfield *f, const fe_heightfield_def *def)
{
    for (int64_t i = 0; f->cells && i < cell_count(f); ++i) {
        int32_t hole = def->holes && def->holes[i];
        f->cells[i] = hole ? (uint8_t)FE__CELL_HOLE : def->cell_materials ? def->cell_materials[i] : (uint8_t)0;
    }
}

static void fill_materials(fe__asset *a, const fe_heightfield_def *def)
{
    uint32_t stride = def->material_stride ? def->material_stride : (uint32_t)sizeof(fe_material);
    for (int32_t i = 0; i < a->material_count; ++i) {
        memcpy(a->materials + i, (const unsigned char *)def->materials + (size_t)stride * (size_t)i,
               sizeof *a->materials);
        a->special |= fe__material_is_special(a->materials + i);
    }
}

fe_result fe__heightfield_create(fe_store *store, const fe_heightfield_def *def, fe_asset *out_handle)
{
    fe__asset a = {.kind = FE__ASSET_HEIGHTFIELD,
                   .field = {.rows = def->rows,
                             .columns = def->columns,
                             .cell_x = (double)def->cell_x,
                             .cell_z = (double)def->cell_z},
                   .material_count = def->cell_materials ? def->material_count : 0};
    if (!allocate(store, def, &a)) return FE_ERROR_MEMORY;

    memcpy(a.field.heights, def->heights, heights_size(&a.field));
    fe__heightfield_measure(&a.field, 0, a.field.rows);
    fill_cells(&a.field, def);
    fill_materials(&a, def);

    return fe__making_put(store, &a, out_handle);
}

// ---- samples -------------------------------------------------------------------------------------------------------
static float *row_of(const fe__heightfield *f, const fe__samples *part, int32_t row)
{
    return f->heights + (int64_t)(part->row + row) * f->columns + part->column;
}

void fe__heightfield_write(fe__heightfield *f, const fe__samples *part, const float *heights)
{
    size_t size = (size_t)part->columns * sizeof *heights;
    for (int32_t r = 0; r < part->rows; ++r) memcpy(row_of(f, part, r), heights + (int64_t)r * part->columns, size);
    fe__heightfield_measure(f, part->row, part->rows);
}

void fe__heightfield_read(const fe__heightfield *f, const fe__samples *part, float *heights)
{
    size_t size = (size_t)part->columns * sizeof *heights;
    for (int32_t r = 0; r < part->rows; ++r) memcpy(heights + (int64_t)r * part->columns, row_of(f, part, r), size);
}

fe__bounds fe__samples_bounds(const fe__heightfield *f, const fe__samples *part)
{
    double far = (double)INFINITY;
    return (fe__bounds){{(double)(part->column - 1) * f->cell_x, -far, (double)(part->row - 1) * f->cell_z},
                        {(double)(part->column + part->columns) * f->cell_x, far,
                         (double)(part->row + part->rows) * f->cell_z}};
}

// ---- hull asset -----------------------------------------------------------------------------------------------------
// See asset.h. Called by the API layer with checked arguments, from any thread.

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

// ---- mesh asset -----------------------------------------------------------------------------------------------------
// See asset.h. Called by the API layer with checked arguments, from any thread.

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

// ---- scaled asset ---------------------------------------------------------------------------------------------------

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

// ---- making ---------------------------------------------------------------------------------------------------------

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
