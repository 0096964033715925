// heightfield_asset.c - see heightfield_asset.h. Called by the API layer with checked arguments, from any thread.
#include "store/heightfield_asset.h"

#include "store/making.h"

#include <string.h>

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
