// collide.h - two forms, one manifold.
//
// Called by the world's narrow phase for every pair that cannot be recycled, on any thread; reads nothing but its arguments. All is float
// in the frame of form A: the caller subtracts the double positions first, so that the distance from the world's origin never costs
// precision.
//
// Order: A's type is never below B's (plane > box > capsule > sphere); of two boxes A is the one with the larger half extents, so that a
// wide ground keeps its small coordinates across the contact.
#ifndef FE_COLLISION_MANIFOLD_COLLIDE_H
#define FE_COLLISION_MANIFOLD_COLLIDE_H
#include "collision/form/form.h"

enum { FE_MAX_POINTS = 4 };

typedef struct fe__manifold_point {
    fe_vec3 point;    // midway between the surfaces, A's frame
    float separation; // m, below 0 when they overlap
    uint32_t id;      // of the two features; the same next step while the same features meet
} fe__manifold_point;

// Of one pair. The caller keeps `axis` and `axis_separation` from step to step and passes them in: a kernel may try them first. Without
// points, axis_separation comes out as a distance that the forms are not closer than, so that the caller need not ask again before they
// moved as far.
typedef struct fe__manifold {
    fe_vec3 normal; // unit, from A to B, A's frame; (0, 0, 0) without points
    int32_t count;  // 0..4
    int32_t axis;   // kernel's own, -1: none yet
    float axis_separation;
    fe__manifold_point points[FE_MAX_POINTS];
} fe__manifold;

// B's pose in A's frame
typedef struct fe__relative {
    fe_vec3 position;
    fe__mat3 rotation;
} fe__relative;

// Fills the manifold with the points closer than `margin` (m, > 0). Special kernels where there is one, the general convex path otherwise.
void fe__collide(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin, fe__manifold *manifold);
// The general convex path alone: GJK on the cores, EPA when the cores overlap, faces clipped. Any pair but plane against plane; for tests.
void fe__collide_convex(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin, fe__manifold *manifold);

#endif
