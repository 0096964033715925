// sort.c - see sort.h. Few items: by insertion. Many: radix sort, lowest byte first (Knuth, The Art of
// Computer Programming 3, 5.2.5), which is stable and looks at no two keys together; bytes that all keys share, as the
// high ones of small serials, cost no pass.
#include "core/sort.h"

#include <string.h>

enum {
    FEW = 48, // items; above, one pass over the digits is cheaper than count^2 / 4 moves
    DIGIT_BITS = 8,
    DIGITS = 64 / DIGIT_BITS,
    VALUES = 1 << DIGIT_BITS,
};

static void sort_few(fe__sort_item *items, int32_t count)
{
    for (int32_t i = 1; i < count; ++i) {
        fe__sort_item item = items[i];
        int32_t place = i;
        for (; place > 0 && items[place - 1].key > item.key; --place) items[place] = items[place - 1];
        items[place] = item;
    }
}

static uint32_t digit_of(uint64_t key, int digit) { return (uint32_t)(key >> (DIGIT_BITS * digit)) & (VALUES - 1); }

// bits that not all keys share
static uint64_t different_bits(const fe__sort_item *items, int32_t count)
{
    uint64_t different = 0;
    for (int32_t i = 1; i < count; ++i) different |= items[i].key ^ items[0].key;
    return different;
}

// where the first item of each value of a digit goes
static void find_places(const fe__sort_item *items, int32_t count, int digit, int32_t counts[VALUES])
{
    int32_t place = 0;
    memset(counts, 0, sizeof(int32_t) * VALUES);
    for (int32_t i = 0; i < count; ++i) counts[digit_of(items[i].key, digit)] += 1;
    for (int value = 0; value < VALUES; ++value) {
        int32_t n = counts[value];
        counts[value] = place;
        place += n;
    }
}

void fe__sort_keys(fe__sort_item *items, int32_t count, fe__sort_item *scratch)
{
    if (count <= FEW) {
        sort_few(items, count);
        return;
    }
    int32_t places[VALUES];
    uint64_t different = different_bits(items, count);
    fe__sort_item *from = items, *to = scratch;
    for (int digit = 0; digit < DIGITS; ++digit) {
        if (!digit_of(different, digit)) continue;
        find_places(from, count, digit, places);
        for (int32_t i = 0; i < count; ++i) to[places[digit_of(from[i].key, digit)]++] = from[i];
        fe__sort_item *swap = from;
        from = to;
        to = swap;
    }
    if (from != items) memcpy(items, from, sizeof *items * (size_t)count);
}
