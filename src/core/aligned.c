// aligned.c - see aligned.h.
#include "core/aligned.h"

#include <stdint.h>
#include <stdlib.h>

#if defined(_WIN32)
#include <malloc.h>

void *fe__aligned_allocate(size_t size, size_t alignment) { return _aligned_malloc(size, alignment); }
void fe__aligned_free(void *block) { _aligned_free(block); }
#else
#include "core/mutex.h"

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
