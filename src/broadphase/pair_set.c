// pair_set.c - see pair_set.h.
//
// A removal closes the gap (Knuth 6.4, algorithm R), so there are no tombstones and a search ends at the first empty
// entry.
#include "broadphase/pair_set.h"

enum { FIRST_CAPACITY = 64, LARGEST_CAPACITY = 1 << 30 };

// The entry of the key, or the empty one where it would be.
static uint32_t find_entry(const fe__pair_set *set, uint64_t key)
{
    uint32_t mask = (uint32_t)(set->capacity - 1), i = fe__pair_home(set, key);
    while (set->entries[i].key != 0 && set->entries[i].key != key) i = (i + 1) & mask;
    return i;
}

void fe__pair_set_destroy(fe__pair_set *set, fe__memory *memory)
{
    FE_FREE(memory, set->entries, set->capacity);
    *set = (fe__pair_set){0};
}

int32_t fe__pair_set_reserve(fe__pair_set *set, fe__memory *memory, int32_t extra)
{
    int64_t need = 2 * ((int64_t)set->count + extra), capacity = set->capacity > 0 ? set->capacity : FIRST_CAPACITY;
    if (need <= set->capacity) return 1;
    while (capacity < need) capacity *= 2;
    if (capacity > LARGEST_CAPACITY) return 0;

    fe__pair_set grown = {fe__allocate(memory, (size_t)capacity * sizeof *grown.entries), (int32_t)capacity,
                          set->count};
    if (!grown.entries) return 0;
    for (int32_t i = 0; i < set->capacity; ++i)
        if (set->entries[i].key != 0) grown.entries[find_entry(&grown, set->entries[i].key)] = set->entries[i];
    FE_FREE(memory, set->entries, set->capacity);
    *set = grown;
    return 1;
}

void fe__pair_set_insert(fe__pair_set *set, int32_t a, int32_t b, int32_t value)
{
    uint64_t key = fe__pair_key(a, b);
    set->entries[find_entry(set, key)] = (fe__pair_entry){.key = key, .value = value};
    set->count += 1;
}

int32_t fe__pair_set_find(const fe__pair_set *set, int32_t a, int32_t b)
{
    if (set->count == 0) return -1;
    const fe__pair_entry *entry = &set->entries[find_entry(set, fe__pair_key(a, b))];
    return entry->key != 0 ? entry->value : -1;
}

void fe__pair_set_remove(fe__pair_set *set, int32_t a, int32_t b)
{
    if (set->count == 0) return;
    uint32_t mask = (uint32_t)(set->capacity - 1), gap = find_entry(set, fe__pair_key(a, b));
    if (set->entries[gap].key == 0) return;
    set->count -= 1;
    // An entry after the gap moves into it unless its home lies behind the gap: a search for it would then start too
    // late to see it.
    for (uint32_t i = (gap + 1) & mask; set->entries[i].key != 0; i = (i + 1) & mask) {
        uint32_t home = fe__pair_home(set, set->entries[i].key);
        if (((i - home) & mask) < ((i - gap) & mask)) continue;
        set->entries[gap] = set->entries[i];
        gap = i;
    }
    set->entries[gap] = (fe__pair_entry){0};
}
