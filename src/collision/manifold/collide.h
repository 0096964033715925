// collide.h - two forms, one manifold.
//
// Called by the world's narrow phase for every pair that cannot be recycled, on any thread; reads nothing but its
// arguments. All is float in the frame of form A: the caller subtracts the double positions first, so that the distance
// from the world's origin never costs precision.
//
// Order: A's type is never below B's (plane > hull > cone > cylinder > box > capsule > sphere), but of boxes and hulls
// A is the one with the larger half extents, so that a wide ground keeps its small coordinates across the contact.
#ifndef FE_COLLISION_MANIFOLD_COLLIDE_H
#define FE_COLLISION_MANIFOLD_COLLIDE_H
#include "collision/manifold/manifold.h"

// Fills the manifold with the points closer than `margin` (m, > 0). Special kernels where there is one, the general
// convex path otherwise.
void fe__collide(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                 fe__manifold *manifold);

// 1: of these two B is to be given as A
int32_t fe__collide_swaps(const fe__form *a, const fe__form *b);

#endif
