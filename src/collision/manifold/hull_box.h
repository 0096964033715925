// hull_box.h - a box as a hull, in memory of the caller's: faces, edges and corners are those of any box, only lengths
// are its own.
#ifndef FE_COLLISION_MANIFOLD_HULL_BOX_H
#define FE_COLLISION_MANIFOLD_HULL_BOX_H
#include "collision/form/hull.h"

typedef struct fe__box_hull {
    fe__hull hull;
    _Alignas(16) float vertices[3][FE__HULL_LANES];
    float distances[FE__HULL_LANES], tails[3][FE__HULL_LANES], vectors[3][FE__HULL_LANES];
} fe__box_hull;

// The box of half widths 1: its edges and its faces' normals alone
extern const fe__hull fe__unit_box;
// Enough of a hull for hull_axis.h and hull_hull.c: it has no half-edges, spokes and directions.
void fe__box_as_hull(const fe__form *box, fe__box_hull *out);

#endif
