// arrays.h - what of a world is state, as two tables: its arrays, and the members beside them. Whoever frees a world,
// exchanges two or keeps one walks over these.
//
// Not in them is what follows from the state (clusters, forest, graph) and what is no state: memory, workers, who is
// inside, the host's filter, kernels, the store, scratch, measures.
#ifndef FE_WORLD_ARRAYS_H
#define FE_WORLD_ARRAYS_H
#include "world/world.h"

// Where things are in fe_world
typedef struct fe__array {
    size_t pointer, capacity; // offsets; the capacity counts elements
    size_t size;              // of an element, bytes
    size_t used;              // offset of an int32_t: so many elements may hold something
    size_t each;              // offset of the int32_t that it is multiplied by, 0: by nothing
    int32_t more;             // elements beside
} fe__array;
typedef struct fe__members {
    size_t first, end; // offsets
} fe__members;

enum { FE__ARRAYS = 45, FE__MEMBERS = 9 };
extern const fe__array fe__arrays[FE__ARRAYS];
// The arrays' addresses and capacities are in these. The last one is what each step moves on
extern const fe__members fe__state_members[FE__MEMBERS];

static inline int32_t fe__int_at(const fe_world *world, size_t offset)
{
    return *(const int32_t *)(const void *)((const unsigned char *)world + offset);
}
void *fe__array_get(const fe_world *world, const fe__array *array);
void fe__array_set(fe_world *world, const fe__array *array, void *elements);
int64_t fe__array_capacity(const fe_world *world, const fe__array *array); // bytes
int64_t fe__array_used(const fe_world *world, const fe__array *array);     // bytes; all behind them are as new
void fe__arrays_free(fe_world *world);

#endif
