// store.c - the API of stores and of assets of any kind. From any thread: what a store holds is read and changed under
// its lock.
#include "api/store.h"
#include "core/fp_state.h"
#include "store/asset_bytes.h"

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
