// hull_builder.h - the record of a hull (form/hull.h), from the facets of its builder.
#ifndef FE_COLLISION_HULL_BUILD_HULL_BUILDER_H
#define FE_COLLISION_HULL_BUILD_HULL_BUILDER_H
#include "collision/form/hull.h"
#include "collision/hull_build/facets.h"

// ---- builder --------------------------------------------------------------------------------------------------------
// The work room of one hull: what the steps of hull_builder.h hand on.

typedef struct fe__hull_builder {
    fe__cloud cloud;
    fe__hull_surface surface;
    fe__facets facets;
    double tolerance, thickness; // m
    int32_t vertex_count, direction_count;
    int32_t number[FE__SURFACE_VERTICES];     // in the hull, of a vertex of the surface; -1: none
    int32_t vertex[FE__SURFACE_VERTICES];     // the reverse
    uint16_t half[3 * FE__SURFACE_TRIANGLES]; // half-edge of a corner of the facets
    fe_dvec3 direction[FE__HULL_DIRECTIONS];
    uint16_t edge_end; // half-edges so far
} fe__hull_builder;

// ---- record ---------------------------------------------------------------------------------------------------------
// The arrays of a hull in its block, and what of them follows from the rest: from a builder's facets
// (hull_builder.c), from another hull (hull_scale.c), from bytes (collision/cooked).

// Points the arrays into a block of so many bytes, which is returned, aligned to 64 and zeroed. The counts are set.
// NULL: only the size.
int64_t fe__hull_share(fe__hull *hull, void *block);

// Whoever makes the hull writes: vertices, normals and directions; for each face its count, in `faces`, and its
// `corners`, the lowest vertex first.
static inline float *fe__hull_writable(const float *array) { return (float *)(uintptr_t)array; }
static inline void fe__hull_set_lane(const fe__hull_lanes *lanes, int32_t i, fe_vec3 a)
{
    fe__hull_writable(lanes->x)[i] = a.x, fe__hull_writable(lanes->y)[i] = a.y, fe__hull_writable(lanes->z)[i] = a.z;
}
static inline fe__hull_face *fe__hull_own_faces(const fe__hull *hull)
{
    return (fe__hull_face *)(uintptr_t)hull->faces;
}
static inline uint8_t *fe__hull_own_corners(const fe__hull *hull) { return (uint8_t *)(uintptr_t)hull->corners; }

void fe__hull_set_vertex(fe__hull *hull, int32_t vertex, fe_vec3 position); // in their order: the bounds grow

// Then the half-edges: `half` is that from each corner to the next of its face
void fe__hull_connect(fe__hull *hull, const uint16_t *half);
// Then the planes, which touch the hull. Of one: returns how far the face's corners lie below it, m
double fe__hull_set_plane(const fe__hull *hull, int32_t face, fe_vec3 normal);
void fe__hull_place_planes(fe__hull *hull); // of all, along the normals that are written; and their flatness
// Then the rest but the measures: what edges repeat of vertices and planes, lanes past the counts
void fe__hull_finish(const fe__hull *hull);

// ---- layout ---------------------------------------------------------------------------------------------------------

int64_t fe__hull_block_size(fe__hull_builder *builder);
void fe__hull_lay_out(fe__hull_builder *builder, void *block, fe__hull *out_hull); // all but the measures

// Is a unit vector parallel to one of those that are known?
int32_t fe__hull_is_known_direction(const fe_dvec3 *known, int32_t count, fe_dvec3 direction);

// ---- measure --------------------------------------------------------------------------------------------------------
// What a hull weighs, and how far points that were left out lie outside.

void fe__hull_weigh(fe__hull *hull); // mass, inner radius
void fe__hull_measure_error(const fe__hull_builder *builder, fe__hull *hull);

// ---- build ----------------------------------------------------------------------------------------------------------
// A convex hull from any points: from the caller's array to the record of form/hull.h.
//
// Three steps, so that its memory can be had in two calls: the work room, whose size depends on the number of points;
// then the hull's own block, whose size depends on the hull.
//
//   cloud      points on a grid of integers                        cloud.c
//   surface    quickhull, the farthest points first                quickhull.c, quickhull.c
//   facets     coplanar triangles merged, needless corners gone    facets.c, corners.c
//   layout     half-edges, planes, lanes                           hull_builder.c
//   measures   mass, inertia, inner radius, error                  hull_builder.c
//   scale      a copy that is larger, smaller, or in a mirror       hull_scale.c

// The least thickness: a share of the extent, and so many metres. Thinner hulls have no mass and no inertia to speak of
#define FE__HULL_LEAST_THICKNESS 5e-4
#define FE__HULL_LEAST_THICKNESS_SHARE 1e-4
// The tolerance that is counted when none is given, and the least, as shares of the extent: faces that bend within less
// have normals that floats do not tell apart
#define FE__HULL_TOLERANCE_SHARE 1e-5
#define FE__HULL_LEAST_TOLERANCE_SHARE 5e-6

typedef struct fe__hull_points {
    const float *points; // finite
    uint32_t stride;
    int32_t count;        // >= 1
    int32_t max_vertices; // 4..255
    double tolerance;     // m; 0: that of the extent
} fe__hull_points;

// Why there is no hull
typedef struct fe__hull_refusal {
    double thickness, least; // m
    fe_dvec3 normal;         // unit, along which it is so thin; 0: along more than one
} fe__hull_refusal;

// m, of a hull of that extent
static inline double fe__hull_least_thickness(double extent)
{
    return fe__maxd(FE__HULL_LEAST_THICKNESS, FE__HULL_LEAST_THICKNESS_SHARE * extent);
}

int64_t fe__hull_builder_size(int32_t point_count);
// `room`: so many bytes, aligned to 8. 0: the points are thinner than they may be.
int32_t fe__hull_build(fe__hull_builder *room, const fe__hull_points *points, fe__hull_refusal *out_refusal);
// Then fe__hull_block_size tells what block it needs.
// `block`: so many bytes, aligned to 64, zeroed.
void fe__hull_write(fe__hull_builder *builder, void *block, fe__hull *out_hull);

// ---- hull scale -----------------------------------------------------------------------------------------------------
// A hull under a scale of its asset: a copy with the same vertices, edges and faces, by number.
//
// The scale is along the axes of the asset's frame, from its origin. An odd number of negative ones turns the windings.

int64_t fe__hull_scaled_size(const fe__hull *hull, fe_vec3 scale);
// `block`: so many bytes, aligned to 64, zeroed. 0: the copy is thinner than a hull may be.
int32_t fe__hull_write_scaled(const fe__hull *hull, fe_vec3 scale, void *block, fe__hull *out_hull,
                              fe__hull_refusal *out_refusal);

#endif
