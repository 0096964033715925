// top_k.c - a heap in the caller's array (Williams 1964); see top_k.h.
#include "query/top_k.h"

#include <string.h>

static unsigned char *at(const fe__keep *k, int32_t i)
{
    return (unsigned char *)k->records + (size_t)k->stride * (size_t)i;
}
static int32_t is_before(const fe__keep *k, const void *a, const void *b) { return k->before(k->context, a, b); }

// Puts the record into the hole at i, or what is later than it, down to where it belongs.
static void sink(fe__keep *k, int32_t i, int32_t count, const void *record)
{
    for (int32_t child; (child = 2 * i + 1) < count; i = child) {
        if (child + 1 < count && is_before(k, at(k, child), at(k, child + 1))) child += 1;
        if (!is_before(k, record, at(k, child))) break;
        memcpy(at(k, i), at(k, child), k->size);
    }
    memcpy(at(k, i), record, k->size);
}

void fe__keep_add(fe__keep *k, const void *record)
{
    k->found += 1;
    if (k->kept == k->capacity) {
        if (k->capacity > 0 && is_before(k, record, at(k, 0))) sink(k, 0, k->kept, record);
        return;
    }
    int32_t i = k->kept++;
    for (int32_t parent; i > 0 && is_before(k, at(k, parent = (i - 1) / 2), record); i = parent)
        memcpy(at(k, i), at(k, parent), k->size);
    memcpy(at(k, i), record, k->size);
}

void fe__keep_sort(fe__keep *k)
{
    unsigned char last[FE_KEEP_LARGEST];
    for (int32_t count = k->kept - 1; count > 0; --count) {
        memcpy(last, at(k, count), k->size);
        memcpy(at(k, count), at(k, 0), k->size);
        sink(k, 0, count, last);
    }
}
