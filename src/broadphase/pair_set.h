// pair_set.h - the pairs of shapes that have a contact record: (a, b) -> contact index.
//
// Open addressing, linear probing, load at most 2/3: 2 entries are read for a pair that is there and 5 for one that is
// not (Knuth 6.4). Never iterated, so its layout cannot show in a result.
#ifndef FE_BROADPHASE_PAIR_SET_H
#define FE_BROADPHASE_PAIR_SET_H
#include "core/memory.h"

typedef struct fe__pair_entry {
    int32_t low, high; // high > low >= 0; 0, 0: empty
    int32_t value;
} fe__pair_entry;

typedef struct fe__pair_set {
    fe__pair_entry *entries;
    int32_t capacity;
    int32_t count;
} fe__pair_set;

// The hash is Fibonacci's: low << 32 | high, times 2^64 over the golden ratio, of which the upper half says where in
// the table, from 0 to 1. Shape indices of neighbours are close to each other, which this spreads well.
static inline uint32_t fe__pair_home(const fe__pair_set *set, int32_t low, int32_t high)
{
    uint64_t key = (uint64_t)low << 32 | (uint64_t)high;
    return (uint32_t)((key * UINT64_C(0x9E3779B97F4A7C15) >> 32) * (uint32_t)set->capacity >> 32);
}

// Asks memory for what fe__pair_set_find will read first
FE_FETCHES fe__pair_set_fetch(const fe__pair_set *set, int32_t a, int32_t b)
{
    if (set->count) __builtin_prefetch(set->entries + fe__pair_home(set, a < b ? a : b, a < b ? b : a));
}

void fe__pair_set_destroy(fe__pair_set *set, fe__memory *memory);
int32_t fe__pair_set_reserve(fe__pair_set *set, fe__memory *memory,
                             int32_t extra); // 0: no memory; the `extra` insertions that follow cannot fail
void fe__pair_set_insert(fe__pair_set *set, int32_t a, int32_t b, int32_t value); // a != b, in any order; not there yet
int32_t fe__pair_set_add(fe__pair_set *set, int32_t a, int32_t b, int32_t value); // as that; 0: it is there
int32_t fe__pair_set_find(const fe__pair_set *set, int32_t a, int32_t b);         // value, -1: not there
void fe__pair_set_remove(fe__pair_set *set, int32_t a, int32_t b);                // nothing when not there

#endif
