// array_sort.h - sorts 64-bit keys with a 32-bit payload, the same way everywhere.
//
// Stable: items of equal keys keep their order, so that the result depends on the input alone. Used for pairs (by
// serials), events and batches.
#ifndef FE_CORE_ARRAY_SORT_H
#define FE_CORE_ARRAY_SORT_H
#include <stdint.h>

typedef struct fe__sort_item {
    uint64_t key;
    int32_t value;
    int32_t spare; // carried along
} fe__sort_item;

// Sorts by rising key. `scratch` has room for `count` items and is left with rubbish.
void fe__sort_keys(fe__sort_item *items, int32_t count, fe__sort_item *scratch);

#endif
