// memory.h - one allocator per world or store, counted, and arrays that grow.
//
// Only the thread that uses the world allocates, or who holds the store's lock. A world and its own store share the
// host's allocator: a guard lets one call at a time in. Growing never loses: a failed fe__reserve leaves the array as
// it was. All blocks are aligned to 64 bytes and new memory is zeroed, so that padding lanes and spare fields hold
// zeros; but for scratch (fe__renew, fe__allocate_scratch): pages that nobody writes cost no time.
#ifndef FE_CORE_MEMORY_H
#define FE_CORE_MEMORY_H
#include "feather.h"

#include <stddef.h>
#include <stdint.h>

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

#endif
