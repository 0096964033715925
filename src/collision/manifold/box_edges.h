// box_edges.h - two boxes that touch along edges which run side by side. Part of box_box.c.
#ifndef FE_COLLISION_MANIFOLD_BOX_EDGES_H
#define FE_COLLISION_MANIFOLD_BOX_EDGES_H
#include "collision/manifold/manifold.h"

// axes of box against box: 6 of faces, 9 of crossing edges, 9 of edges side by side
enum { FE__FACING_EDGES = 15 };

// Of boxes that have one axis in common but for 5 degrees and no other: the points of the two edges along it that are
// nearest to each other. Returns 0 and adds nothing when something else is. `separation`: along the best axis of
// others.
int32_t fe__touch_facing_edges(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float separation,
                               float margin, fe__manifold *manifold);

#endif
