/// @file memory.h
/// Arrays of a program that cannot go on without memory: it says so and ends.
#ifndef BENCH_MEMORY_H
#define BENCH_MEMORY_H

#include <stddef.h>

/// `count` zeroed items of `size` bytes. Free with free().
void *bench_allocate(size_t count, size_t size);
/// Makes `items` hold `count` items of `size` bytes; what was in it stays.
void *bench_resize(void *items, size_t count, size_t size);
/// Bytes that the whole program holds on its heap. 0 where the C library cannot tell (it can in glibc).
double bench_heap_bytes(void);

#endif
