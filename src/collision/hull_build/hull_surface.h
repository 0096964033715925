// hull_surface.h - the hull while it grows: a closed surface of triangles around the cloud's middle, and the points
// that still lie outside.
//
// Quickhull (Barber, Dobkin, Huhdanpaa 1996): each point outside waits at one triangle that it is above. The point
// farthest above its triangle becomes a vertex; what it sees of the surface is replaced by a fan around it. So the
// points that change the form most come first, and when there are as many vertices as are allowed, the rest is left
// out: that is the simplification.
//
// Invariant: every triangle's plane supports the surface, exactly. Triangles may lie in one plane.
#ifndef FE_COLLISION_HULL_BUILD_HULL_SURFACE_H
#define FE_COLLISION_HULL_BUILD_HULL_SURFACE_H
#include "collision/form/hull.h"
#include "collision/hull_build/cloud.h"

enum {
    FE__SURFACE_VERTICES = FE__HULL_VERTICES + 1, // one more, until what it hides is gone
    // those of 256 vertices, and the fan while what it replaces is still there
    FE__SURFACE_TRIANGLES = 2 * FE__SURFACE_VERTICES + FE__SURFACE_VERTICES
};

// Edge 3 t + k of triangle t runs from corner k to corner k + 1; its twin is the same edge of the neighbour, reversed.
typedef struct fe__surface_triangle {
    fe__grid_plane plane;
    int32_t farthest;    // of the points that wait here; -1: none does
    int32_t first_point; // of those, -1
    int32_t corner[3];   // vertices
    int32_t twin[3];
    int32_t alive, seen; // seen: by the point that is being added
} fe__surface_triangle;

// Planes of triangles, to look at two side by side: height = unit . p - offset
typedef struct fe__surface_planes {
    _Alignas(16) double x[FE__SURFACE_TRIANGLES], y[FE__SURFACE_TRIANGLES], z[FE__SURFACE_TRIANGLES];
    double offset[FE__SURFACE_TRIANGLES];
} fe__surface_planes;

typedef struct fe__hull_surface {
    const fe__cloud *cloud;
    int32_t *next_point;   // count: in the list of a triangle
    int32_t most_vertices; // 4..255
    double tolerance;      // steps of the grid: points that are less high may be left out
    double error;          // of the farthest point left out, above a triangle
    int32_t vertex_count;  // in use
    int32_t triangle_end;  // all that were ever used stand before it
    int32_t free_count;    // of triangles before the end
    int32_t free_triangles[FE__SURFACE_TRIANGLES];
    int32_t point[FE__SURFACE_VERTICES];  // of a vertex; -1: not in use
    int32_t degree[FE__SURFACE_VERTICES]; // triangles around it
    fe__surface_triangle triangles[FE__SURFACE_TRIANGLES];
    double height[FE__SURFACE_TRIANGLES]; // of the farthest point that waits, steps of the grid; 0: none does
    // scratch of one addition
    int32_t seen[FE__SURFACE_TRIANGLES], seen_count;
    int32_t fan[FE__SURFACE_VERTICES], fan_count;
    fe__surface_planes planes;              // of those among which points choose
    int32_t fan_from[FE__SURFACE_VERTICES]; // the fan's triangle over the edge of the rim that starts at a vertex
} fe__hull_surface;

static inline int32_t fe__next_corner(int32_t edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }
static inline int32_t fe__edge_start(const fe__hull_surface *s, int32_t edge)
{
    return s->triangles[edge / 3].corner[edge % 3];
}
static inline int32_t fe__edge_end(const fe__hull_surface *s, int32_t edge)
{
    return fe__edge_start(s, fe__next_corner(edge));
}
static inline int32_t fe__edge_twin(const fe__hull_surface *s, int32_t edge)
{
    return s->triangles[edge / 3].twin[edge % 3];
}
static inline fe_dvec3 fe__vertex_on_grid(const fe__hull_surface *s, int32_t vertex)
{
    return s->cloud->grid[s->point[vertex]];
}

// The first tetrahedron (quickhull.c): of points that are far from each other, with all others given to its triangles.
// 0: the cloud is flat, `out_thickness` m thick at most along `out_normal` (of any length; 0 when it is straight too).
int32_t fe__surface_begin(fe__hull_surface *surface, double least_thickness, double *out_thickness,
                          fe_dvec3 *out_normal);
// Adds points until all are within the tolerance, or there are as many vertices as are allowed. Sets the error.
void fe__surface_grow(fe__hull_surface *surface);

// ---- of both files -------------------------------------------------------------------------------------------------
int32_t fe__surface_new_triangle(fe__hull_surface *surface, int32_t a, int32_t b, int32_t c);
void fe__surface_join(fe__hull_surface *surface, int32_t edge, int32_t twin);
// Names the triangles among which fe__surface_give chooses.
void fe__surface_choose_among(fe__hull_surface *surface, const int32_t *triangles, int32_t count);
// Gives a point to the triangle that it is highest above; one that is above none is inside.
void fe__surface_give(fe__hull_surface *surface, int32_t point, const int32_t *triangles, int32_t count);

#endif
