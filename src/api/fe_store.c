// fe_store.c - see fe_store.h.
#include "api/fe_store.h"

#include "core/fp_state.h"
#include "store/asset.h"
#include "store/asset_bytes.h"

// ---- asset form -----------------------------------------------------------------------------------------------------

// ---- the scale -----------------------------------------------------------------------------------------------------
static int32_t is_each(fe_vec3 s, float x) { return s.x == x && s.y == x && s.z == x; }
static int32_t is_one(fe_vec3 s) { return is_each(s, 0.0f) || is_each(s, 1.0f); }

fe_result fe__check_has_scale(const char *function, const fe_geometry *geometry)
{
    int32_t kind = fe__form_of_geometry(geometry->type);
    fe_vec3 s = geometry->scale;
    if (kind < 0 || fe__forms[kind].has_scale || is_one(s)) return FE_OK;
    int32_t has_asset = fe__forms[kind].has_asset;
    return fe__fail(function, has_asset ? FE_ERROR_UNSUPPORTED : FE_ERROR_ARGUMENT,
                    "geometry->scale is (%.9g, %.9g, %.9g), of a %s it must be 0 or 1 on each axis; %s", (double)s.x,
                    (double)s.y, (double)s.z, fe__forms[kind].name,
                    has_asset ? "scale what it is made of" : "hulls and meshes have a scale");
}

static fe_result read_scale(const char *function, const fe_geometry *geometry, fe_vec3 *out_scale)
{
    const fe_vec3 one = {1.0f, 1.0f, 1.0f}, s = is_one(geometry->scale) ? one : geometry->scale;
    const float numbers[3] = {s.x, s.y, s.z};
    for (int32_t k = 0; k < 3; ++k) {
        float size = fe__absf(numbers[k]);
        if (size >= FE_LEAST_SCALE && size <= FE_MAX_SCALE) continue;
        return fe__fail(function, FE_ERROR_ARGUMENT,
                        "geometry->scale.%c is %.9g, its magnitude must be in [%.9g, %.9g]", "xyz"[k],
                        (double)numbers[k], (double)FE_LEAST_SCALE, (double)FE_MAX_SCALE);
    }
    *out_scale = s;
    return FE_OK;
}

static fe_result check_lengths(const char *function, const fe__asset *a, fe_vec3 scale)
{
    double most = fe__asset_farthest(a, scale);
    if (most <= (double)FE_MAX_LENGTH) return FE_OK;
    return fe__fail(function, FE_ERROR_ARGUMENT,
                    "geometry->scale takes a point to a coordinate of %.9g m, must be at most %.9g m", most,
                    (double)FE_MAX_LENGTH);
}

static fe_result tell_refusal(const char *function, int32_t kind, const fe__scale_refusal *r)
{
    if (kind == FE__ASSET_HULL)
        return fe__fail(function, FE_ERROR_DEGENERATE,
                        "geometry->scale makes the hull %.6f m thick, must be at least %.6f m", r->hull.thickness,
                        r->hull.least);
    return fe__fail(function, FE_ERROR_DEGENERATE, "geometry->scale leaves triangle %d of the mesh without height",
                    (int)r->triangle);
}

// The record of an asset that is found, under its lock
static fe_result find_scaled(const char *function, fe_store *store, fe_vec3 scale, int32_t *index)
{
    const fe__asset *a = fe__store_asset(store, *index);
    FE_TRY(check_lengths(function, a, scale));
    fe__scale_refusal refusal;
    fe_result result = fe__asset_scaled(store, *index, scale, index, &refusal);
    if (result == FE_ERROR_DEGENERATE) return tell_refusal(function, a->kind, &refusal);
    return fe__report(function, result);
}

// ---- the form ------------------------------------------------------------------------------------------------------
static fe_result find_record(const char *function, fe_store *store, const fe_geometry *geometry, int32_t kind,
                             fe_vec3 scale, int32_t *out_index)
{
    FE_TRY(fe__find_asset_of(function, "geometry->asset", store, kind, geometry->asset, out_index));
    return is_one(scale) ? FE_OK : find_scaled(function, store, scale, out_index);
}

fe_result fe__read_asset_form(const char *function, fe_store *store, const fe_geometry *geometry, int32_t kind,
                              fe__form *out_form)
{
    fe_vec3 scale = {1.0f, 1.0f, 1.0f};
    if (fe__forms[fe__form_of_geometry(geometry->type)].has_scale) FE_TRY(read_scale(function, geometry, &scale));
    int32_t index;
    fe__fp_state fp = fe__fp_enter();
    fe__store_lock(store);
    fe_result result = find_record(function, store, geometry, kind, scale, &index);
    if (result == FE_OK) {
        fe__asset_retain(store, index);
        *out_form = fe__asset_form(store, index);
    }
    fe__store_unlock(store);
    fe__fp_leave(fp);
    return result;
}

void fe__let_go_of_asset(fe_store *store, const fe__form *form)
{
    if (!fe__form_has_asset(form)) return;
    fe__store_lock(store);
    fe__asset_release(store, form->field);
    fe__store_unlock(store);
}

fe_vec3 fe__scale_of(const fe_store *store, const fe__form *form)
{
    if (!fe__form_has_asset(form)) return fe__vec3(0.0f, 0.0f, 0.0f);
    return fe__store_asset(store, form->field)->scale;
}

// ---- store ----------------------------------------------------------------------------------------------------------
// The API of stores and of assets of any kind. Any thread may call it: a store is read and changed under its lock.

// ---- stores --------------------------------------------------------------------------------------------------------

void fe_store_def_init(fe_store_def *def, uint32_t struct_size)
{
    fe_store_def defaults = {.struct_size = sizeof defaults};
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

fe_result fe_store_create(const fe_store_def *def, fe_store **out_store)
{
    const char *function = __func__;
    FE_CHECK_POINTER(out_store);
    fe_store_def full = {.struct_size = sizeof full};
    fe_allocator allocator = {.struct_size = sizeof allocator};
    if (def) {
        FE_READ_STRUCT(def, &full);
        FE_CHECK_INT(full.number, 0, FE_ID_LAST_NUMBER);
        if (full.allocator) FE_TRY(fe__read_allocator(function, full.allocator, &allocator));
    }
    return fe__report(function, fe__store_create(full.allocator ? &allocator : NULL, (int32_t)full.number, out_store));
}

fe_result fe_store_destroy(fe_store *store)
{
    FE_BEGIN_STORE(store);
    int32_t users;
    fe_result result = fe__store_try_destroy(store, &users);
    if (result == FE_OK) return FE_OK;
    if (result == FE_ERROR_STALE) return fe__fail(function, result, "the store is gone already");
    if (users == 0) return fe__fail(function, result, "the store is a world's own: it goes with the world");
    return fe__fail(function, result, "the store still serves %d worlds, destroy them first", (int)users);
}

fe_result fe_store_get_bytes(const fe_store *store, int64_t *out_bytes)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_POINTER(out_bytes);
    fe__store_lock(store);
    *out_bytes = store->memory.bytes;
    fe__store_unlock(store);
    return FE_OK;
}

// ---- assets --------------------------------------------------------------------------------------------------------

fe_result fe_asset_destroy(fe_store *store, fe_asset asset)
{
    FE_BEGIN_STORE(store);
    int32_t index;
    fe__store_lock(store);
    fe_result result = fe__find_asset(function, "asset", store, asset, &index);
    if (result == FE_OK) fe__asset_destroy(store, index);
    fe__store_unlock(store);
    return result;
}

int32_t fe_asset_is_valid(const fe_store *store, fe_asset asset)
{
    if (!store) return 0;
    int32_t index;
    fe__store_lock(store);
    fe_result result = fe__store_find(store, asset, &index);
    fe__store_unlock(store);
    return result == FE_OK;
}

static fe_result find_type(const char *function, const fe_store *store, fe_asset asset, int32_t *out_type)
{
    static const int32_t types[] = {[FE__ASSET_HEIGHTFIELD] = FE_GEOMETRY_HEIGHTFIELD,
                                    [FE__ASSET_HULL] = FE_GEOMETRY_HULL,
                                    [FE__ASSET_MESH] = FE_GEOMETRY_MESH,
                                    [FE__ASSET_COMPOUND] = FE_GEOMETRY_COMPOUND};
    int32_t index;
    FE_TRY(fe__find_asset(function, "asset", store, asset, &index));
    *out_type = types[fe__store_asset(store, index)->kind];
    return FE_OK;
}

int32_t fe_asset_get_type(const fe_store *store, fe_asset asset)
{
    FE_BEGIN_STORE(store);
    int32_t type;
    fe__store_lock(store);
    fe_result result = find_type(function, store, asset, &type);
    fe__store_unlock(store);
    return result == FE_OK ? type : (int32_t)result;
}

// ---- bytes ---------------------------------------------------------------------------------------------------------

static fe_result write_asset(const char *function, const fe_store *store, fe_asset asset, void *out, int64_t capacity,
                             int64_t *out_size)
{
    int32_t index;
    FE_TRY(fe__find_asset(function, "asset", store, asset, &index));
    const fe__asset *a = fe__store_asset(store, index);
    *out_size = fe__asset_bytes(store, a);
    if (*out_size <= capacity) fe__asset_write(store, a, out);
    return FE_OK;
}

int64_t fe_asset_save(const fe_store *store, fe_asset asset, void *out, int64_t capacity)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_INT(capacity, 0, INT64_MAX);
    if (capacity > 0) FE_CHECK_POINTER(out);
    int64_t size = 0;
    fe__store_lock(store);
    fe_result result = write_asset(function, store, asset, out, capacity, &size);
    fe__store_unlock(store);
    if (result != FE_OK) return result;
    if (size <= capacity) fe__asset_seal(out, size);
    return size;
}

fe_result fe_asset_load(fe_store *store, const void *bytes, int64_t size, fe_asset *out_asset)
{
    if (out_asset) *out_asset = 0;
    FE_BEGIN_STORE(store);
    FE_CHECK_POINTER(out_asset);
    FE_CHECK_POINTER(bytes);
    FE_CHECK_INT(size, 0, INT64_MAX);
    fe__cooked cooked;
    fe_asset asset;
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__asset_read(store, bytes, size, &cooked, &asset);
    fe__fp_leave(fp);
    if (result == FE_ERROR_DATA || result == FE_ERROR_VERSION) return fe__fail(function, result, "%s", cooked.sentence);
    if (result != FE_OK) return fe__report(function, result);
    *out_asset = asset;
    return FE_OK;
}
