/// @file solid.h
/// Convex solids as the bench itself sees them: in double, by brute force, independent of the engines that it judges.
/// The scenes cook them, the adapters build their hulls from them, overlaps.c measures how deep two of them overlap.
#ifndef BENCH_SOLID_H
#define BENCH_SOLID_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Its frame's origin is the centre of mass.
typedef struct bench_solid {
    int32_t point_count, face_count, edge_count;
    double (*points)[3];  ///< the corners, m
    double (*normals)[3]; ///< of the faces, unit, outward
    double *offsets;      ///< of the faces' planes: normal . point, m
    int32_t *loops;       ///< face by face: how many corners, then these, counterclockwise seen from outside
    double (*edges)[3];   ///< directions of edges, unit, no two parallel
    double volume;        ///< m3
    double inertia[6];    ///< about the origin at 1 kg/m3, entries xx yy zz xy yz zx of the tensor, kg m2
    double radius;        ///< of the ball about the origin that holds it, m
} bench_solid;

/// The convex hull of points that no plane holds, moved to its centre of mass. O(n^4): for some dozens of points.
bench_solid *bench_solid_hull(double (*points)[3], int32_t count);
bench_solid *bench_solid_box(const float half[3]);
/// A prism of BENCH_ROUND sides inside of a cylinder along y.
bench_solid *bench_solid_cylinder(double half_height, double radius);
void bench_solid_free(bench_solid *solid); ///< NULL is allowed

enum { BENCH_ROUND = 32 };

#ifdef __cplusplus
}
#endif
#endif
