// cloud.h - the points that a hull is built from, on a grid of integers.
//
// The builder decides by integers. The points are shifted to the middle of their bounds and rounded to a grid of
// 2^-25 to 2^-26 of the extent, which is what floats of the extent's size resolve. Then every difference of two points
// fits 26 bits and a sign, every normal 53 bits, which a double holds exactly, and a point's height over a plane has a
// sign that 64-bit integers find without rounding. So the surface is convex exactly, whatever the points: no cluster,
// needle or plane of points can twist it. (Doubles with a tolerance, as in Barber, Dobkin and Huhdanpaa, The quickhull
// algorithm, 1996, must mend what rounding broke.)
//
// Coordinates on the grid are integers held in doubles.
#ifndef FE_COLLISION_HULL_BUILD_CLOUD_H
#define FE_COLLISION_HULL_BUILD_CLOUD_H
#include "core/math.h"

#include <string.h>

typedef struct fe__cloud {
    const float *points; // the caller's: x y z each
    uint32_t stride;     // bytes from one to the next
    int32_t count;
    fe_dvec3 low, high, middle; // of the points, m
    double extent;              // longest side of the bounds, m
    double step;                // of the grid, m: a power of two
    fe_dvec3 *grid;             // count
} fe__cloud;

static inline fe_dvec3 fe__cloud_point(const fe__cloud *cloud, int32_t i)
{
    float p[3]; // at any alignment
    memcpy(p, (const char *)cloud->points + (size_t)cloud->stride * (size_t)i, sizeof p);
    return (fe_dvec3){(double)p[0], (double)p[1], (double)p[2]};
}
void fe__cloud_measure(fe__cloud *cloud); // low, high, middle, extent, step; needs extent > 0 for the step
void fe__cloud_snap(fe__cloud *cloud);    // grid

// A plane through three points of the grid, which turn left around its normal.
typedef struct fe__grid_plane {
    fe_dvec3 base;     // one of them
    fe_dvec3 normal;   // integers below 2^54
    double per_length; // 1 / |normal|
    fe_dvec3 unit;     // the normal of length 1, rounded
    double offset;     // unit . base
} fe__grid_plane;

// 0: the points are on a line
int32_t fe__grid_plane_through(fe_dvec3 a, fe_dvec3 b, fe_dvec3 c, fe__grid_plane *out_plane);
// (p - base) . normal, rounded: steps of the grid times |normal|
static inline double fe__grid_rise(const fe__grid_plane *plane, fe_dvec3 p)
{
    return fe__ddot(fe__dsub(p, plane->base), plane->normal);
}
// Height over the plane in steps of the grid: of numbers below 2^27, so that rounding is below 1e-7 steps
static inline double fe__grid_height(const fe__grid_plane *plane, fe_dvec3 p)
{
    return fe__ddot(plane->unit, p) - plane->offset;
}
// 1 above the plane, 0 on it, -1 below: exact
int32_t fe__grid_side(const fe__grid_plane *plane, fe_dvec3 p);

#endif
