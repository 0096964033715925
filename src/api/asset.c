// asset.c - the API of what shapes share: heightfields.
#include "api/check.h"
#include "core/fp_state.h"
#include "world/assets.h"
#include "world/handles.h"

enum { MOST_LINES = 32768, MOST_SAMPLES = 1 << 28, MOST_MATERIALS = FE__CELL_HOLE };

#define FE_BEGIN_STORE(store)        \
    const char *function = __func__; \
    FE_CHECK_POINTER(store);         \
    fe_world *world = store->world;  \
    FE_WRITE_AS(function, world)

// ---- birth and death ------------------------------------------------------------------------------------------------------------

static fe_heightfield_def default_heightfield(void)
{
    return (fe_heightfield_def){.struct_size = sizeof(fe_heightfield_def), .cell_x = 1.0f, .cell_z = 1.0f};
}

void fe_heightfield_def_init(fe_heightfield_def *def, uint32_t struct_size)
{
    fe_heightfield_def defaults = default_heightfield();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

static fe_result check_size(const char *function, const fe_heightfield_def *def)
{
    FE_CHECK_INT(def->rows, 2, MOST_LINES);
    FE_CHECK_INT(def->columns, 2, MOST_LINES);
    FE_CHECK_INT((int64_t)def->rows * def->columns, 4, MOST_SAMPLES);
    FE_CHECK_FLOAT(def->cell_x, FE_LEAST_LENGTH, FE_MAX_LENGTH);
    FE_CHECK_FLOAT(def->cell_z, FE_LEAST_LENGTH, FE_MAX_LENGTH);
    FE_CHECK_FLOAT((float)(def->columns - 1) * def->cell_x, 0.0f, FE_MAX_LOCAL);
    FE_CHECK_FLOAT((float)(def->rows - 1) * def->cell_z, 0.0f, FE_MAX_LOCAL);
    return FE_OK;
}

static fe_result check_heights(const char *function, const float *heights, int64_t count)
{
    for (int64_t i = 0; i < count; ++i) {
        if (heights[i] >= -FE_MAX_LOCAL && heights[i] <= FE_MAX_LOCAL) continue;
        return fe__fail(function, FE_ERROR_ARGUMENT, "heights[%lld] is %.9g, must be in [%.9g, %.9g]", (long long)i, (double)heights[i],
                        (double)-FE_MAX_LOCAL, (double)FE_MAX_LOCAL);
    }
    return FE_OK;
}

static fe_result check_cells(const char *function, const char *name, const uint8_t *cells, int64_t count, int32_t most)
{
    for (int64_t i = 0; cells && i < count; ++i) {
        if (cells[i] <= most) continue;
        return fe__fail(function, FE_ERROR_ARGUMENT, "%s[%lld] is %d, must be in [0, %d]", name, (long long)i, cells[i], most);
    }
    return FE_OK;
}

static fe_result read_heightfield(const char *function, const fe_heightfield_def *def, fe_heightfield_def *full)
{
    *full = default_heightfield();
    FE_READ_STRUCT(def, full);
    FE_TRY(check_size(function, full));
    FE_CHECK_POINTER(full->heights);
    FE_TRY(check_heights(function, full->heights, (int64_t)full->rows * full->columns));
    int64_t cells = (int64_t)(full->rows - 1) * (full->columns - 1);
    FE_TRY(check_cells(function, "holes", full->holes, cells, 1));
    if (!full->cell_materials) return FE_OK;
    FE_CHECK_INT(full->material_count, 1, MOST_MATERIALS);
    FE_CHECK_ARRAY(full->materials, full->material_count);
    FE_CHECK_STRIDE(full->material_stride, sizeof *full->materials, sizeof *full->materials);
    FE_TRY(check_cells(function, "cell_materials", full->cell_materials, cells, full->material_count - 1));
    for (int32_t i = 0; i < full->material_count; ++i)
        FE_TRY(fe__check_material(function, fe__at_const(full->materials, full->material_stride, i)));
    return FE_OK;
}

fe_result fe_heightfield_create(fe_store *store, const fe_heightfield_def *def, fe_asset *out_asset)
{
    if (out_asset) *out_asset = 0;
    FE_BEGIN_STORE(store);
    FE_CHECK_POINTER(out_asset);
    fe_heightfield_def full;
    FE_TRY(read_heightfield(function, def, &full));
    int32_t index = fe__heightfield_create(world, &full);
    if (index < 0) return fe__report(function, (fe_result)index);
    *out_asset = fe__asset_handle(world, index);
    return FE_OK;
}

fe_result fe_asset_destroy(fe_store *store, fe_asset asset)
{
    FE_BEGIN_STORE(store);
    FE_FIND_ASSET(index, asset);
    fe__asset_destroy(world, index);
    return FE_OK;
}

int32_t fe_asset_is_valid(const fe_store *store, fe_asset asset)
{
    int32_t index;
    const fe_world *world = store ? store->world : NULL;
    return world && fe__id_pool_find(&world->asset_ids, asset, &index) == FE_OK && !world->assets[index].destroyed;
}

// ---- heights --------------------------------------------------------------------------------------------------------------------

static fe_result check_part(const char *function, const fe__heightfield *field, int32_t row, int32_t column, int32_t rows, int32_t columns)
{
    FE_CHECK_INT(row, 0, field->rows - 1);
    FE_CHECK_INT(column, 0, field->columns - 1);
    FE_CHECK_INT(rows, 1, field->rows - row);
    FE_CHECK_INT(columns, 1, field->columns - column);
    return FE_OK;
}

fe_result fe_heightfield_set_heights(fe_store *store, fe_asset asset, int32_t row, int32_t column, int32_t rows, int32_t columns,
                                     const float *heights)
{
    FE_BEGIN_STORE(store);
    FE_FIND_ASSET(index, asset);
    FE_TRY(check_part(function, world->fields + index, row, column, rows, columns));
    FE_CHECK_POINTER(heights);
    FE_TRY(check_heights(function, heights, (int64_t)rows * columns));
    fe__fp_state fp = fe__fp_enter();
    fe__heightfield_set_heights(world, index, row, column, rows, columns, heights);
    fe__fp_leave(fp);
    return FE_OK;
}

fe_result fe_heightfield_get_heights(const fe_store *store, fe_asset asset, int32_t row, int32_t column, int32_t rows, int32_t columns,
                                     float *out_heights)
{
    FE_BEGIN_STORE(store);
    FE_FIND_ASSET(index, asset);
    const fe__heightfield *field = world->fields + index;
    FE_TRY(check_part(function, field, row, column, rows, columns));
    FE_CHECK_POINTER(out_heights);
    for (int32_t r = 0; r < rows; ++r)
        for (int32_t c = 0; c < columns; ++c)
            out_heights[(int64_t)r * columns + c] = field->heights[(int64_t)(row + r) * field->columns + column + c];
    return FE_OK;
}
