// memory.h - one allocator per world or store, counted, and arrays that grow.
//
// Only the thread that uses the world allocates, or who holds the store's lock. A world and its own store share the
// host's allocator: a guard lets one call at a time in. Growing never loses: a failed fe__reserve leaves the array as
// it was. All blocks are aligned to 64 bytes and new memory is zeroed, so that padding lanes and spare fields hold
// zeros; but for scratch (fe__renew, fe__allocate_scratch): pages that nobody writes cost no time.
#ifndef FE_CORE_MEMORY_H
#define FE_CORE_MEMORY_H
#include "core/threads.h"
#include "feather.h"

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

// ---- memory ---------------------------------------------------------------------------------------------------------

typedef struct fe__memory {
    fe_allocator allocator;
    struct fe__mutex *guard; // held around each call of the allocator; NULL: not needed
    int64_t bytes;           // now
    int64_t allocations;     // ever
} fe__memory;

// Asks memory for a record ahead of its use. Always inlined, as must be whoever does only this: gcc takes a call
// without any effect that it knows for none, and drops it.
#define FE_FETCHES static inline __attribute__((always_inline)) void
FE_FETCHES fe__fetch(const void *record, unsigned bytes)
{
    for (unsigned k = 0; k < bytes; k += 64) __builtin_prefetch((const char *)record + k);
}

void fe__memory_init(fe__memory *memory, const fe_allocator *allocator); // NULL: malloc
void *fe__allocate(fe__memory *memory, size_t size);                     // zeroed, 64-byte aligned, NULL on failure
void *fe__allocate_scratch(fe__memory *memory, size_t size);             // not zeroed
void fe__release(fe__memory *memory, void *block, size_t size);          // NULL is fine

// Makes room for `need` records of `size` bytes in *array (of *capacity records), by growing geometrically. 0 on
// failure, with nothing changed.
int32_t fe__reserve(fe__memory *memory, void *array, int32_t *capacity, int64_t need, size_t size);
// The same for scratch: what was in the array is lost when it grows, and nothing is zeroed.
int32_t fe__renew(fe__memory *memory, void *array, int32_t *capacity, int64_t need, size_t size);
// Gives the array back and sets pointer and capacity to 0.
void fe__free_array(fe__memory *memory, void *array, int32_t *capacity, size_t size);

// An array that has nothing yet, for `need` elements that the caller writes, whole; zeros behind them. 0: no memory
int32_t fe__open_array(fe__memory *memory, void *array, int32_t *capacity, int64_t need, size_t size);

// FE_RESERVE(memory, world->bodies, world->body_capacity, n): typed wrapper of fe__reserve
#define FE_RESERVE(memory, array, capacity, need) \
    fe__reserve((memory), &(array), &(capacity), (int64_t)(need), sizeof *(array))
#define FE_OPEN(memory, array, capacity, need) \
    fe__open_array((memory), &(array), &(capacity), (int64_t)(need), sizeof *(array))
#define FE_RENEW(memory, array, capacity, need) \
    fe__renew((memory), &(array), &(capacity), (int64_t)(need), sizeof *(array))
#define FE_FREE(memory, array, capacity) fe__free_array((memory), &(array), &(capacity), sizeof *(array))

// ---- aligned --------------------------------------------------------------------------------------------------------
// The C library's aligned memory, which Windows names otherwise.

// `alignment`: a power of two, at least that of a pointer. NULL: there is no such memory.
void *fe__aligned_allocate(size_t size, size_t alignment);
void fe__aligned_free(void *block); // NULL is fine

// ---- record pool ----------------------------------------------------------------------------------------------------
// Records of one size, given out by index and taken back.
//
// Index 0 is never given: it is a record of zeros that means "none". A record given out is all zeros. Which index is
// next depends on the order of calls alone.

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

// ---- shares ---------------------------------------------------------------------------------------------------------
// Blocks of work, dealt out to workers so that each finds again what it had.
//
// A pass has blocks that can be done in any order by anyone. Each worker has a share of them: neighbours, and the same
// part of every pass. So what it reads and writes stays in the caches of its core from pass to pass, and from step to
// step. Who has done its own may help with the shares after it. The idea of a worker's own first block is Box2D v3's
// (Erin Catto, "SIMD Matters", 2024).

typedef struct fe__shares {
    int32_t count;                                  // workers
    _Alignas(FE_CACHE_LINE) _Atomic uint64_t taken; // bit w: worker w is somebody
    struct {
        _Alignas(FE_CACHE_LINE) _Atomic uint64_t next; // pass << 32 | blocks of the share that are claimed
    } of[FE_MAX_WORKERS];
} fe__shares;

// Where a worker claims in a pass
typedef struct fe__claims {
    int32_t worker;
    int32_t offset; // shares that it has looked at, from its own on
} fe__claims;

typedef enum fe__reach {
    FE__OWN_SHARES, // its own, and those of workers who have not come
    FE__ALL_SHARES
} fe__reach;

// Before workers come, at most `count` of them: 1..FE_MAX_WORKERS.
void fe__shares_begin(fe__shares *shares, int32_t count);
// A worker's number, that of nobody else in these shares: the thread's own, see fe__thread_number, unless it is taken.
int32_t fe__shares_join(fe__shares *shares);
// Where claims of a pass begin, and again where the reach is another
static inline fe__claims fe__claims_of(int32_t worker) { return (fe__claims){worker, 0}; }
// A block in [0, block_count) that nobody else gets, or -1: none is left within reach. Passes go up from 1, and all
// blocks of one are claimed before the first of the next. Orders nothing in memory.
int32_t fe__shares_claim(fe__shares *shares, fe__claims *claims, fe__reach reach, uint32_t pass, int32_t block_count);

#endif
