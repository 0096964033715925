// tree_check.h - trees that come from bytes.
#ifndef FE_BROADPHASE_TREE_CHECK_H
#define FE_BROADPHASE_TREE_CHECK_H
#include "broadphase/tree.h"

// Does it hang together? Each node that is not dead is met once, links lead both ways, boxes hold what is below them,
// as many proxies and nodes as are counted, no deeper than told. `takes` says whether a proxy may be there: it is below
// the capacity of `slot`, whose entries are -1 and are set here. *out_node: where it does not.
int32_t fe__tree_check(fe__tree *tree, int32_t (*takes)(void *context, int32_t proxy), void *context,
                       int32_t *out_node);

#endif
