// aligned.h - the C library's aligned memory, which Windows names otherwise.
#ifndef FE_CORE_ALIGNED_H
#define FE_CORE_ALIGNED_H
#include <stddef.h>

// `alignment`: a power of two, at least that of a pointer. NULL: there is no such memory.
void *fe__aligned_allocate(size_t size, size_t alignment);
void fe__aligned_free(void *block); // NULL is fine

#endif
