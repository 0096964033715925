// build.h - a convex hull from any points: from the caller's array to the record of form/hull.h.
//
// Three steps, so that its memory can be had in two calls: the work room, whose size depends on the number of points;
// then the hull's own block, whose size depends on the hull.
//
//   cloud      points on a grid of integers                        cloud.c
//   surface    quickhull, the farthest points first                simplex.c, quickhull.c
//   facets     coplanar triangles merged, needless corners gone    facets.c, corners.c
//   layout     half-edges, planes, lanes                           layout.c
//   measures   mass, inertia, inner radius, error                  measure.c
//   scale      a copy that is larger, smaller, or in a mirror       scale.c
#ifndef FE_COLLISION_HULL_BUILD_BUILD_H
#define FE_COLLISION_HULL_BUILD_BUILD_H
#include "collision/hull_build/builder.h"
#include "collision/hull_build/layout.h"

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

#endif
