// memory.c - see memory.h. Called from the world's own thread by the API and by the step's stages before they fan out;
// never by workers. A store calls it under its lock.
#include "core/memory.h"

#include "core/aligned.h"
#include "core/mutex.h"

#include <string.h>

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
