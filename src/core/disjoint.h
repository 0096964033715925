// disjoint.h - disjoint sets as a forest: parent[i] is another member of i's set, itself at the root.
#ifndef FE_CORE_DISJOINT_H
#define FE_CORE_DISJOINT_H
#include <stdint.h>

static inline int32_t fe__root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]]; // path halving
    return i;
}

#endif
