// top_k.h - the first few of many records, in the caller's array.
//
// A query counts all it finds and keeps those that come first, without memory of its own: while records come in, the
// array is a heap with the last of the kept on top; at the end it is sorted. `before` is a total order, so that the
// order of arrival never shows.
#ifndef FE_QUERY_TOP_K_H
#define FE_QUERY_TOP_K_H
#include <stdint.h>

enum { FE_KEEP_LARGEST = 128 }; // bytes of a record

typedef struct fe__keep {
    void *records;
    uint32_t stride, size; // bytes from one record to the next; of a record that are ours
    int32_t capacity, kept;
    int64_t found;
    int32_t (*before)(const void *context, const void *a, const void *b); // records may be unaligned
    const void *context;
} fe__keep;

void fe__keep_add(fe__keep *keep, const void *record);
void fe__keep_sort(fe__keep *keep);

#endif
