// sort.h - sorts 64-bit keys with a 32-bit payload, the same way everywhere.
//
// Stable: items of equal keys keep their order, so that the result depends on the input alone. Used for pairs (by
// serials), events and batches.
#ifndef FE_CORE_SORT_H
#define FE_CORE_SORT_H

#include <stdint.h>

// ---- array sort -----------------------------------------------------------------------------------------------------

typedef struct fe__sort_item {
    uint64_t key;
    int32_t value;
    int32_t spare; // carried along
} fe__sort_item;

// Sorts by rising key. `scratch` has room for `count` items and is left with rubbish.
void fe__sort_keys(fe__sort_item *items, int32_t count, fe__sort_item *scratch);

// ---- disjoint -------------------------------------------------------------------------------------------------------
// Disjoint sets as a forest: parent[i] is another member of i's set, itself at the root.

static inline int32_t fe__root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]]; // path halving
    return i;
}

#endif
