// counting_allocator.h - an allocator that counts, checks what it is given back and what was written behind it, and
// fails when it is told to.
#ifndef FE_TESTS_COUNTING_ALLOCATOR_H
#define FE_TESTS_COUNTING_ALLOCATOR_H
#include "core/memory.h"
#include "fe_test.h"
#include "feather.h"

#include <stdlib.h>
#include <string.h>

typedef struct counting {
    int64_t calls;         // of allocate
    int64_t blocks, bytes; // out now
    int64_t most_bytes;
    int64_t fail_from, fail_count; // the call with this number fails, and so many from there; 0: none
    int32_t is_unlucky;            // 1: every second call fails, by chance
    uint64_t chance;               // state of these draws, not 0
    int64_t failures;
    int64_t wrong; // releases of another size than the allocation's, or of what was written over its end
} counting;

static int32_t counting_fails(counting *c)
{
    if (c->calls >= c->fail_from && c->calls < c->fail_from + c->fail_count) return 1;
    if (!c->is_unlucky) return 0;
    c->chance ^= c->chance << 13, c->chance ^= c->chance >> 7, c->chance ^= c->chance << 17;
    return (int32_t)(c->chance >> 63);
}

enum { COUNTING_GUARD = 64, COUNTING_MARK = 0x5A }; // bytes behind a block, and what stands in them

// the size stands before the block, which keeps its alignment
static void *counting_allocate(void *user, uint64_t size, uint64_t alignment)
{
    counting *c = user;
    c->calls += 1;
    if (counting_fails(c)) {
        c->failures += 1;
        return NULL;
    }
    unsigned char *memory = fe__aligned_allocate((size_t)(size + COUNTING_GUARD + alignment), (size_t)alignment);
    if (!memory) return NULL;
    memcpy(memory, &size, sizeof size);
    memset(memory + alignment, 0xA5, (size_t)size); // nobody may count on zeros
    memset(memory + alignment + size, COUNTING_MARK, COUNTING_GUARD);
    c->blocks += 1;
    c->bytes += (int64_t)size;
    if (c->bytes > c->most_bytes) c->most_bytes = c->bytes;
    return memory + alignment;
}

enum { COUNTING_ALIGNMENT = 64 }; // of all blocks that a world asks for

static void counting_release(void *user, void *block, uint64_t size)
{
    counting *c = user;
    uint64_t given;
    unsigned char *memory = (unsigned char *)block - COUNTING_ALIGNMENT;
    memcpy(&given, memory, sizeof given);
    const unsigned char *guard = memory + COUNTING_ALIGNMENT + given;
    int32_t whole = given == size;
    for (int32_t i = 0; i < COUNTING_GUARD; ++i) whole &= guard[i] == COUNTING_MARK;
    if (!whole) c->wrong += 1;
    c->blocks -= 1;
    c->bytes -= (int64_t)size;
    fe__aligned_free(memory);
}

static inline fe_allocator counting_allocator(counting *c)
{
    return (fe_allocator){sizeof(fe_allocator), 0, counting_allocate, counting_release, c};
}

static inline fe_world *counting_world(counting *c)
{
    fe_world_def def;
    fe_world *world = NULL;
    fe_allocator allocator = counting_allocator(c);
    fe_world_def_init(&def, sizeof def);
    def.allocator = &allocator;
    fe_result result;
    do result = fe_world_create(&def, &world);
    while (result == FE_ERROR_MEMORY && c->fail_count); // it was told to fail
    FE_TRUE(result == FE_OK);
    return world;
}

#endif
