// record_pool.c - see record_pool.h.
#include "core/record_pool.h"

#include <string.h>

void fe__record_pool_init(fe__record_pool *pool, int32_t size) { *pool = (fe__record_pool){.size = size, .limit = 1}; }

void fe__record_pool_free(fe__record_pool *pool, fe__memory *memory)
{
    FE_FREE(memory, pool->records, pool->capacity);
    fe__record_pool_init(pool, pool->size);
}

fe_result fe__record_pool_reserve(fe__record_pool *pool, fe__memory *memory, int32_t extra)
{
    if (extra <= pool->free_count) return FE_OK;
    int64_t bytes = ((int64_t)pool->limit + extra - pool->free_count) * pool->size;
    if (bytes > INT32_MAX) return FE_ERROR_LIMIT;
    return FE_RESERVE(memory, pool->records, pool->capacity, bytes) ? FE_OK : FE_ERROR_MEMORY;
}

int32_t fe__record_pool_take(fe__record_pool *pool)
{
    int32_t index = pool->first_free;
    if (!index) return pool->limit++; // new memory is zeros
    memcpy(&pool->first_free, fe__record(pool, index), sizeof pool->first_free);
    pool->free_count -= 1;
    memset(fe__record(pool, index), 0, (size_t)pool->size);
    return index;
}

void fe__record_pool_return(fe__record_pool *pool, int32_t index)
{
    memcpy(fe__record(pool, index), &pool->first_free, sizeof pool->first_free);
    pool->first_free = index;
    pool->free_count += 1;
}
