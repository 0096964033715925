// pair_set.c - see pair_set.h.
//
// A removal closes the gap (Knuth 6.4, algorithm R), so there are no tombstones and a search ends at the first empty
// entry.
#include "broadphase/pair_set.h"

#include "core/math.h"

// entries; a larger table grows by a part
enum { FIRST_CAPACITY = 64, LARGEST_CAPACITY = 1 << 30, DOUBLE_BELOW = 4096, GROWTH = 4 };

static int32_t is_taken(const fe__pair_entry *e) { return e->high != 0; }

static uint32_t after(const fe__pair_set *set, uint32_t i) { return i + 1 < (uint32_t)set->capacity ? i + 1 : 0; }

// The entry of the pair, or the empty one where it would be.
static uint32_t find_entry(const fe__pair_set *set, int32_t a, int32_t b)
{
    int32_t low = a < b ? a : b, high = a < b ? b : a;
    uint32_t i = fe__pair_home(set, low, high);
    const fe__pair_entry *e = set->entries;
    while (is_taken(e + i) && (e[i].low != low || e[i].high != high)) i = after(set, i);
    return i;
}

void fe__pair_set_destroy(fe__pair_set *set, fe__memory *memory)
{
    FE_FREE(memory, set->entries, set->capacity);
    *set = (fe__pair_set){0};
}

int32_t fe__pair_set_reserve(fe__pair_set *set, fe__memory *memory, int32_t extra)
{
    int64_t need = 3 * ((int64_t)set->count + extra) / 2 + 1,
            capacity = set->capacity > 0 ? set->capacity : FIRST_CAPACITY;
    if (need <= set->capacity) return 1;
    while (capacity < need) capacity += capacity < DOUBLE_BELOW ? capacity : capacity / GROWTH;
    if (capacity > LARGEST_CAPACITY) return 0;

    fe__pair_set grown = {fe__allocate(memory, (size_t)capacity * sizeof *grown.entries), (int32_t)capacity,
                          set->count};
    if (!grown.entries) return 0;
    for (int32_t i = 0; i < set->capacity; ++i)
        if (is_taken(set->entries + i))
            grown.entries[find_entry(&grown, set->entries[i].low, set->entries[i].high)] = set->entries[i];
    FE_FREE(memory, set->entries, set->capacity);
    *set = grown;
    return 1;
}

void fe__pair_set_insert(fe__pair_set *set, int32_t a, int32_t b, int32_t value)
{
    set->entries[find_entry(set, a, b)] = (fe__pair_entry){fe__mini(a, b), fe__maxi(a, b), value};
    set->count += 1;
}

int32_t fe__pair_set_add(fe__pair_set *set, int32_t a, int32_t b, int32_t value)
{
    fe__pair_entry *entry = set->entries + find_entry(set, a, b);
    if (is_taken(entry)) return 0;
    *entry = (fe__pair_entry){fe__mini(a, b), fe__maxi(a, b), value};
    set->count += 1;
    return 1;
}

// from one entry on to another
static uint32_t distance(const fe__pair_set *set, uint32_t from, uint32_t to)
{
    return to >= from ? to - from : to + (uint32_t)set->capacity - from;
}

int32_t fe__pair_set_find(const fe__pair_set *set, int32_t a, int32_t b)
{
    if (set->count == 0) return -1;
    const fe__pair_entry *entry = set->entries + find_entry(set, a, b);
    return is_taken(entry) ? entry->value : -1;
}

void fe__pair_set_remove(fe__pair_set *set, int32_t a, int32_t b)
{
    if (set->count == 0) return;
    uint32_t gap = find_entry(set, a, b);
    if (!is_taken(set->entries + gap)) return;
    set->count -= 1;
    // An entry after the gap moves into it unless its home lies behind the gap: a search for it would then start too
    // late to see it.
    for (uint32_t i = after(set, gap); is_taken(set->entries + i); i = after(set, i)) {
        uint32_t home = fe__pair_home(set, set->entries[i].low, set->entries[i].high);
        if (distance(set, home, i) < distance(set, gap, i)) continue;
        set->entries[gap] = set->entries[i];
        gap = i;
    }
    set->entries[gap] = (fe__pair_entry){0};
}
