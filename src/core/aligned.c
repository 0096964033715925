// aligned.c - see aligned.h.
#include "core/aligned.h"

#include <stdint.h>
#include <stdlib.h>

#if defined(_WIN32)
#include <malloc.h>

void *fe__aligned_allocate(size_t size, size_t alignment) { return _aligned_malloc(size, alignment); }
void fe__aligned_free(void *block) { _aligned_free(block); }
#else
// aligned_alloc wants a multiple of the alignment
void *fe__aligned_allocate(size_t size, size_t alignment)
{
    if (size > SIZE_MAX - alignment) return NULL;
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void fe__aligned_free(void *block) { free(block); }
#endif
