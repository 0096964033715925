// fe_heightfield.c - the API of heightfields: assets of a store. From any thread.
#include "api/fe_store.h"
#include "api/check.h"
#include "core/fp_state.h"
#include "world/asset_users.h"

// ---- birth and death -----------------------------------------------------------------------------------------------

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
    FE_CHECK_INT(def->rows, 2, FE__FIELD_LINES);
    FE_CHECK_INT(def->columns, 2, FE__FIELD_LINES);
    FE_CHECK_INT((int64_t)def->rows * def->columns, 4, FE__FIELD_SAMPLES);
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
        return fe__fail(function, FE_ERROR_ARGUMENT, "heights[%lld] is %.9g, must be in [%.9g, %.9g]", (long long)i,
                        (double)heights[i], (double)-FE_MAX_LOCAL, (double)FE_MAX_LOCAL);
    }
    return FE_OK;
}

static fe_result check_cells(const char *function, const char *name, const uint8_t *cells, int64_t count, int32_t most)
{
    for (int64_t i = 0; cells && i < count; ++i) {
        if (cells[i] <= most) continue;
        return fe__fail(function, FE_ERROR_ARGUMENT, "%s[%lld] is %d, must be in [0, %d]", name, (long long)i, cells[i],
                        most);
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
    FE_CHECK_INT(full->material_count, 1, FE__FIELD_MATERIALS);
    FE_CHECK_ARRAY(full->materials, full->material_count);
    FE_CHECK_STRIDE(full->material_stride, sizeof *full->materials, sizeof *full->materials);
    FE_TRY(check_cells(function, "cell_materials", full->cell_materials, cells, full->material_count - 1));
    return fe__check_materials(function, full->materials, full->material_stride, full->material_count);
}

fe_result fe_heightfield_create(fe_store *store, const fe_heightfield_def *def, fe_asset *out_asset)
{
    if (out_asset) *out_asset = 0;
    FE_BEGIN_STORE(store);
    FE_CHECK_POINTER(out_asset);
    fe_heightfield_def full;
    FE_TRY(read_heightfield(function, def, &full));
    fe_asset asset;
    fe_result result = fe__heightfield_create(store, &full, &asset);
    if (result != FE_OK) return fe__report(function, result);
    *out_asset = asset;
    return FE_OK;
}

// ---- heights -------------------------------------------------------------------------------------------------------

static fe_result check_part(const char *function, const fe__heightfield *field, const fe__samples *part)
{
    int32_t row = part->row, column = part->column, rows = part->rows, columns = part->columns;
    FE_CHECK_INT(row, 0, field->rows - 1);
    FE_CHECK_INT(column, 0, field->columns - 1);
    FE_CHECK_INT(rows, 1, field->rows - row);
    FE_CHECK_INT(columns, 1, field->columns - column);
    return FE_OK;
}

// Under the store's lock, as all that follows
static fe_result find_part(const char *function, const fe_store *store, fe_asset asset, const fe__samples *part,
                           int32_t *out_index)
{
    FE_TRY(fe__find_asset_of(function, "asset", store, FE__ASSET_HEIGHTFIELD, asset, out_index));
    return check_part(function, fe__store_field(store, *out_index), part);
}

static fe_result set_heights(const char *function, fe_store *store, fe_asset asset, const fe__samples *part,
                             const float *heights)
{
    int32_t index;
    FE_TRY(find_part(function, store, asset, part, &index));
    FE_CHECK_POINTER(heights);
    FE_TRY(check_heights(function, heights, (int64_t)part->rows * part->columns));
    const fe__assets_entered users = {&index, 1, NULL};
    fe_result entered = fe__assets_enter_worlds(store, &users);
    if (entered != FE_OK) {
        const char *why = entered == FE_ERROR_STEPPING ? "is in a step" : "has another thread inside, or a player";
        return fe__fail(function, entered, "a world that uses asset 0x%llx %s; nothing was changed", asset, why);
    }
    fe__heightfield_edit(store, index, part, heights);
    fe__record_heights(store, index, part->row, part->column, part->rows, part->columns, heights);
    fe__assets_leave_worlds(store, &users);
    return FE_OK;
}

fe_result fe_heightfield_set_heights(fe_store *store, fe_asset asset, int32_t row, int32_t column, int32_t rows,
                                     int32_t columns, const float *heights)
{
    FE_BEGIN_STORE(store);
    fe__fp_state fp = fe__fp_enter();
    fe__store_lock(store);
    fe_result result = set_heights(function, store, asset, &(fe__samples){row, column, rows, columns}, heights);
    fe__store_unlock(store);
    fe__fp_leave(fp);
    return result;
}

static fe_result get_heights(const char *function, const fe_store *store, fe_asset asset, const fe__samples *part,
                             float *out_heights)
{
    int32_t index;
    FE_TRY(find_part(function, store, asset, part, &index));
    FE_CHECK_POINTER(out_heights);
    fe__heightfield_read(fe__store_field(store, index), part, out_heights);
    return FE_OK;
}

fe_result fe_heightfield_get_heights(const fe_store *store, fe_asset asset, int32_t row, int32_t column, int32_t rows,
                                     int32_t columns, float *out_heights)
{
    FE_BEGIN_STORE(store);
    fe__store_lock(store);
    fe_result result = get_heights(function, store, asset, &(fe__samples){row, column, rows, columns}, out_heights);
    fe__store_unlock(store);
    return result;
}
