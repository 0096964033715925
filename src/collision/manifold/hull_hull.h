// hull_hull.h - the axis along which two convex hulls are farthest apart, or overlap least.
//
// The separating axis test: of all directions only the normals of the faces of A, of B, and those normal to an edge of
// each can be it. Of pairs of edges only those make a face of the Minkowski difference whose arcs on the Gauss map
// cross (Gregorius, The separating axis test between convex polyhedra, GDC 2013).
#ifndef FE_COLLISION_MANIFOLD_HULL_HULL_H
#define FE_COLLISION_MANIFOLD_HULL_HULL_H
#include "collision/form/hull.h"
#include "collision/manifold/manifold.h"

// ---- hull axis ------------------------------------------------------------------------------------------------------

typedef enum fe__hull_axis_kind { FE__AXIS_OF_FACE_A, FE__AXIS_OF_FACE_B, FE__AXIS_OF_EDGES } fe__hull_axis_kind;

typedef struct fe__hull_axis {
    float separation; // m, below 0 when they overlap
    fe_vec3 normal;   // unit, from A to B, A's frame
    int32_t kind;     // fe__hull_axis_kind
    int32_t a, b;     // the face of A and the vertex of B; the vertex of A and the face of B; an edge of each
} fe__hull_axis;

// Each looks for the greatest separation of its kind; of equals the lowest feature. The pose is that of B's hull in the
// frame of A's.
fe__hull_axis fe__hull_axis_of_faces_a(const fe__hull *a, const fe__hull *b, const fe__relative *b_in_a);
fe__hull_axis fe__hull_axis_of_faces_b(const fe__hull *a, const fe__hull *b, const fe__relative *b_in_a);
// separation: -FLT_MAX when no arcs cross, or only those of edges that are nearly parallel. Edges along which the hulls
// are not farther apart than `least`, m, may be left out: a vertex of each, best one near the other hull, tells which.
fe__hull_axis fe__hull_axis_of_edges(const fe__hull *a, const fe__hull *b, const fe__relative *b_in_a, float least,
                                     int32_t vertex_a, int32_t vertex_b);

// ---- hull box -------------------------------------------------------------------------------------------------------
// A box as a hull, in memory of the caller's: faces, edges and corners are those of any box, only lengths
// are its own.

typedef struct fe__box_hull {
    fe__hull hull;
    _Alignas(16) float vertices[3][FE__HULL_LANES];
    float distances[FE__HULL_LANES], tails[3][FE__HULL_LANES], vectors[3][FE__HULL_LANES];
} fe__box_hull;

// The box of half widths 1: its edges and its faces' normals alone
extern const fe__hull fe__unit_box;
// Enough of a hull for hull_hull.h and hull_hull.c: it has no half-edges, spokes and directions.
void fe__box_as_hull(const fe__form *box, fe__box_hull *out);

#endif
