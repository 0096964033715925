// Arrays that are there or end the program (memory.h).
#include "memory.h"

#include <stdio.h>
#include <stdlib.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

static void *present_or_exit(void *memory)
{
    if (memory == NULL) {
        fprintf(stderr, "feather-bench: out of memory\n");
        exit(1);
    }
    return memory;
}

// calloc and realloc may give NULL for no bytes at all, hence at least one item.
void *bench_allocate(size_t count, size_t size) { return present_or_exit(calloc(count > 0 ? count : 1, size)); }

void *bench_resize(void *items, size_t count, size_t size)
{
    return present_or_exit(realloc(items, (count > 0 ? count : 1) * size));
}

double bench_heap_bytes(void)
{
#ifdef __GLIBC__
    const struct mallinfo2 heap = mallinfo2();
    return (double)(heap.uordblks + heap.hblkhd);
#else
    return 0;
#endif
}
