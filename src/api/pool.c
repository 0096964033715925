// pool.c - the API of pools: workers that worlds share.
#include "api/check.h"

fe_result fe_pool_create(int32_t worker_count, fe_pool **out_pool)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(out_pool);
    FE_CHECK_INT(worker_count, 1, FE_MAX_WORKERS);
    fe_pool *pool = fe__pool_create(worker_count);
    if (!pool) return fe__fail(function, FE_ERROR_MEMORY, "no memory or no threads for %d workers", (int)worker_count);
    *out_pool = pool;
    return FE_OK;
}

fe_result fe_pool_destroy(fe_pool *pool)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(pool);
    int32_t users;
    fe_result result = fe__pool_try_destroy(pool, &users);
    if (result == FE_ERROR_STATE)
        return fe__fail(function, result, "the pool still serves %d worlds, destroy them first", (int)users);
    if (result == FE_ERROR_STALE) return fe__fail(function, result, "the pool is gone already");
    return FE_OK;
}
