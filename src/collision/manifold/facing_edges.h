// facing_edges.h - two hulls, or boxes, that touch along edges which run side by side. Part of hull_hull.c and
// box_box.c.
#ifndef FE_COLLISION_MANIFOLD_FACING_EDGES_H
#define FE_COLLISION_MANIFOLD_FACING_EDGES_H
#include "collision/form/hull.h"
#include "collision/manifold/manifold.h"

// Edges that touch are no farther from each other than this times the overlap, or times FE__FACING_DEPTH, m
#define FE__FACING_REACH 14.0f
#define FE__FACING_DEPTH 0.0005f

// The axis along which two hulls were found to overlap least: unit, from A to B, A's frame; the separation along it is
// at most `margin`
typedef struct fe__least_overlap {
    fe_vec3 normal;
    float separation; // m
} fe__least_overlap;

// A hull whose frame is stretched along its axes: a box is one of half widths 1. Its faces' normals are those of the
// hull
typedef struct fe__scaled_hull {
    const fe__hull *hull;
    fe_vec3 scale;
    float inner_radius; // of the hull as it is stretched, m
} fe__scaled_hull;

// Gives the points of two edges that run side by side but for 5 degrees, where no two faces meet and these edges are
// nearest to each other of all that the hulls have. Returns 0 and adds nothing when something else is. `name`: of the
// pair of edges, for an axis of the caller's; ids have the highest bit.
int32_t fe__touch_facing_edges(const fe__scaled_hull *a, const fe__scaled_hull *b, const fe__relative *b_in_a,
                               const fe__least_overlap *least, float margin, fe__manifold *manifold, int32_t *name);

#endif
