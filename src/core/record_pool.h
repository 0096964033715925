// record_pool.h - records of one size, given out by index and taken back.
//
// Index 0 is never given: it is a record of zeros that means "none". A record given out is all zeros. Which index is
// next depends on the order of calls alone.
#ifndef FE_CORE_RECORD_POOL_H
#define FE_CORE_RECORD_POOL_H
#include "core/memory.h"

typedef struct fe__record_pool {
    unsigned char *records;
    int32_t size;       // of a record, bytes, at least that of an int32_t
    int32_t capacity;   // bytes
    int32_t limit;      // indices below were given
    int32_t first_free; // 0: none. A free record begins with the index of the next one
    int32_t free_count;
} fe__record_pool;

void fe__record_pool_init(fe__record_pool *pool, int32_t size);
void fe__record_pool_free(fe__record_pool *pool, fe__memory *memory);
// The next `extra` takes are certain. FE_ERROR_MEMORY, FE_ERROR_LIMIT (2 GB): nothing changed.
fe_result fe__record_pool_reserve(fe__record_pool *pool, fe__memory *memory, int32_t extra);
int32_t fe__record_pool_take(fe__record_pool *pool);
void fe__record_pool_return(fe__record_pool *pool, int32_t index);
static inline void *fe__record(const fe__record_pool *pool, int32_t index)
{
    return pool->records + (size_t)pool->size * (size_t)index;
}

#endif
