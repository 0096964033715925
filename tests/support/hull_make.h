// hull_make.h - hulls without a store.
#ifndef FE_TESTS_HULL_MAKE_H
#define FE_TESTS_HULL_MAKE_H
#include "collision/hull_build/hull_builder.h"
#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

typedef struct made_hull {
    fe__hull hull;
    fe__hull_refusal refusal;
    int32_t is_capped; // it has as many vertices as it may
} made_hull;

static inline void *made_memory(int64_t size)
{
    size_t whole = (size_t)(size + 63) / 64 * 64;
    void *memory = fe__aligned_allocate(whole, 64);
    if (!memory) abort();
    memset(memory, 0, whole);
    return memory;
}

// 0: refused
static inline int32_t make_hull(const float *points, int32_t count, int32_t most_vertices, double tolerance,
                                made_hull *out)
{
    fe__hull_builder *room = made_memory(fe__hull_builder_size(count));
    fe__hull_points given = {points, 12, count, most_vertices, tolerance};
    memset(out, 0, sizeof *out);
    int32_t is_made = fe__hull_build(room, &given, &out->refusal);
    if (is_made) {
        fe__hull_write(room, made_memory(fe__hull_block_size(room)), &out->hull);
        out->is_capped = room->surface.vertex_count >= most_vertices;
    }
    fe__aligned_free(room);
    return is_made;
}

static inline void free_hull(made_hull *made)
{
    fe__aligned_free(made->hull.block);
    made->hull.block = NULL;
}

#endif
