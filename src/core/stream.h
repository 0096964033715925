// stream.h - copies of what nobody reads soon, past the caches: the lines that are written need not be read first, and
// what the next step reads stays.
#ifndef FE_CORE_STREAM_H
#define FE_CORE_STREAM_H
#include <stddef.h>

// To an address that is a multiple of 16. Where the CPU has no such stores it is a memcpy
void fe__stream(void *to, const void *from, size_t size);

#endif
