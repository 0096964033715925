// memory.c - see memory.h. Called from the world's own thread by the API and by the step's stages before they fan out;
// never by workers. A store calls it under its lock.
#include "core/memory.h"

#include "core/mutex.h"

#include <assert.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// ---- memory ---------------------------------------------------------------------------------------------------------

enum {
    BLOCK_ALIGNMENT = 64, // a cache line, and the widest SIMD load
    FIRST = 4,            // records: an array that has fewer grows to so many
    DOUBLE_BELOW = 1024,  // records: a larger array grows by an eighth
    GROWTH = 8,
    ROOM = 16, // a part of what is asked for at once is left over, so that a little more does not move the array again
};

static void *default_allocate(void *user, uint64_t size, uint64_t alignment)
{
    (void)user;
    return size > SIZE_MAX ? NULL : fe__aligned_allocate((size_t)size, (size_t)alignment);
}

static void default_release(void *user, void *block, uint64_t size)
{
    (void)user, (void)size;
    fe__aligned_free(block);
}

void fe__memory_init(fe__memory *memory, const fe_allocator *allocator)
{
    *memory = (fe__memory){
        .allocator = {.struct_size = sizeof(fe_allocator), .allocate = default_allocate, .release = default_release}};
    if (allocator) memory->allocator = *allocator;
}

// counted, and whatever was there before still in it
static void *take(fe__memory *memory, size_t size)
{
    if (size == 0 || size > PTRDIFF_MAX) return NULL;
    if (memory->guard) fe__mutex_lock(memory->guard);
    void *block = memory->allocator.allocate(memory->allocator.user, size, BLOCK_ALIGNMENT);
    if (memory->guard) fe__mutex_unlock(memory->guard);
    if (!block) return NULL;
    memory->bytes += (int64_t)size;
    memory->allocations += 1;
    return block;
}

void *fe__allocate(fe__memory *memory, size_t size)
{
    void *block = take(memory, size);
    if (block) memset(block, 0, size);
    return block;
}

void *fe__allocate_scratch(fe__memory *memory, size_t size) { return take(memory, size); }

void fe__release(fe__memory *memory, void *block, size_t size)
{
    if (!block) return;
    if (memory->guard) fe__mutex_lock(memory->guard);
    memory->allocator.release(memory->allocator.user, block, size);
    if (memory->guard) fe__mutex_unlock(memory->guard);
    memory->bytes -= (int64_t)size;
}

// `array` is the address of a pointer of any type. It is read and written as bytes, because a T* may not be accessed as
// a void*.
static void *load_pointer(const void *array)
{
    void *pointer;
    memcpy(&pointer, array, sizeof pointer);
    return pointer;
}

static void store_pointer(void *array, void *pointer) { memcpy(array, &pointer, sizeof pointer); }

// As much as is asked for, then in half octaves (4, 6, 8, 12, 16: a world of a batch is small, and there are
// thousands), and by an eighth once an array is large: O(log n) times, and little room is left over. 0: more than there
// can be
static int32_t grown_capacity(int32_t capacity, int64_t need, size_t size)
{
    if (need > INT32_MAX) return 0;
    int64_t grown = capacity ? capacity : need < DOUBLE_BELOW ? need : DOUBLE_BELOW;
    if (grown < need && grown < FIRST) grown = FIRST;
    while (grown < need && grown < DOUBLE_BELOW) grown += (grown & (grown - 1)) == 0 ? grown / 2 : (grown + 2) / 3;
    if (grown < need) grown = grown + grown / GROWTH > need + need / ROOM ? grown + grown / GROWTH : need + need / ROOM;
    if (grown > INT32_MAX) grown = INT32_MAX;
    return (uint64_t)grown > PTRDIFF_MAX / size ? 0 : (int32_t)grown;
}

int32_t fe__reserve(fe__memory *memory, void *array, int32_t *capacity, int64_t need, size_t size)
{
    if (need <= *capacity) return 1;
    int32_t grown = grown_capacity(*capacity, need, size);
    size_t new_size = (size_t)grown * size, old_size = (size_t)*capacity * size;
    char *block = take(memory, new_size);
    if (!block) return 0;
    void *old = load_pointer(array);
    if (old) memcpy(block, old, old_size);
    memset(block + old_size, 0, new_size - old_size);
    fe__release(memory, old, old_size);
    store_pointer(array, block);
    *capacity = grown;
    return 1;
}

int32_t fe__open_array(fe__memory *memory, void *array, int32_t *capacity, int64_t need, size_t size)
{
    if (need <= 0) return 1;
    int32_t grown = grown_capacity(0, need, size);
    char *block = take(memory, (size_t)grown * size);
    if (!block) return 0;
    memset(block + (size_t)need * size, 0, (size_t)(grown - need) * size);
    store_pointer(array, block);
    *capacity = grown;
    return 1;
}

int32_t fe__renew(fe__memory *memory, void *array, int32_t *capacity, int64_t need, size_t size)
{
    if (need <= *capacity) return 1;
    int32_t grown = grown_capacity(*capacity, need, size);
    void *block = take(memory, (size_t)grown * size);
    if (!block) return 0;
    fe__release(memory, load_pointer(array), (size_t)*capacity * size);
    store_pointer(array, block);
    *capacity = grown;
    return 1;
}

void fe__free_array(fe__memory *memory, void *array, int32_t *capacity, size_t size)
{
    fe__release(memory, load_pointer(array), (size_t)*capacity * size);
    store_pointer(array, NULL);
    *capacity = 0;
}

// ---- aligned --------------------------------------------------------------------------------------------------------

#if defined(_WIN32)
#include <malloc.h>

void *fe__aligned_allocate(size_t size, size_t alignment) { return _aligned_malloc(size, alignment); }
void fe__aligned_free(void *block) { _aligned_free(block); }
#else

// Where the C library has no threads, its malloc has no lock. Workers call it for the worlds of a batch.
#if defined(FE_HOST_THREADS)
static fe__mutex lock = FE_MUTEX_INITIAL;
static void enter(void) { fe__mutex_lock(&lock); }
static void leave(void) { fe__mutex_unlock(&lock); }
#else
static void enter(void) {}
static void leave(void) {}
#endif

// aligned_alloc wants a multiple of the alignment
void *fe__aligned_allocate(size_t size, size_t alignment)
{
    if (size > SIZE_MAX - alignment) return NULL;
    enter();
    void *block = aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    leave();
    return block;
}

void fe__aligned_free(void *block)
{
    enter();
    free(block);
    leave();
}
#endif

// ---- record pool ----------------------------------------------------------------------------------------------------

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

// ---- shares ---------------------------------------------------------------------------------------------------------

void fe__shares_begin(fe__shares *shares, int32_t count)
{
    assert(count >= 1 && count <= FE_MAX_WORKERS);
    shares->count = count;
    atomic_init(&shares->taken, 0);
    for (int32_t i = 0; i < count; ++i) atomic_init(&shares->of[i].next, 0);
}

int32_t fe__shares_join(fe__shares *shares)
{
    int32_t worker = fe__thread_number() % shares->count;
    for (;; worker = (worker + 1) % shares->count) {
        uint64_t bit = (uint64_t)1 << worker;
        if (!(atomic_fetch_or_explicit(&shares->taken, bit, memory_order_relaxed) & bit)) return worker;
    }
}

// The first block of a worker's share; of the one after the last: all blocks
static int32_t first_of(const fe__shares *shares, int32_t worker, int32_t block_count)
{
    return (int32_t)(((int64_t)block_count * worker + shares->count - 1) / shares->count);
}

// -1: all of the share are claimed
static int32_t claim_of(_Atomic uint64_t *next, uint32_t pass, int32_t block_count)
{
    uint64_t seen = atomic_load_explicit(next, memory_order_relaxed);
    for (;;) {
        uint32_t at = (uint32_t)(seen >> 32);
        int32_t block = at == pass ? (int32_t)(seen & UINT32_MAX) : 0;
        if (at > pass || block >= block_count) return -1;
        uint64_t after = (uint64_t)pass << 32 | (uint32_t)(block + 1);
        if (atomic_compare_exchange_weak_explicit(next, &seen, after, memory_order_relaxed, memory_order_relaxed))
            return block;
    }
}

int32_t fe__shares_claim(fe__shares *shares, fe__claims *claims, fe__reach reach, uint32_t pass, int32_t block_count)
{
    uint64_t taken = atomic_load_explicit(&shares->taken, memory_order_relaxed);
    for (; claims->offset < shares->count; ++claims->offset) {
        int32_t owner = (claims->worker + claims->offset) % shares->count;
        if (reach == FE__OWN_SHARES && claims->offset > 0 && taken >> owner & 1) continue;
        int32_t first = first_of(shares, owner, block_count), end = first_of(shares, owner + 1, block_count);
        int32_t block = claim_of(&shares->of[owner].next, pass, end - first);
        if (block >= 0) return first + block;
    }
    return -1;
}
