/// @file overlaps.h
/// How well bodies keep apart, by the bench's own measure: the poses that an engine ends with, and exact solids.
#ifndef BENCH_OVERLAPS_H
#define BENCH_OVERLAPS_H

#include "scene.h"

typedef struct bench_overlaps {
    int32_t pairs;               ///< that overlap, of solids of two bodies
    double deepest, p99, median; ///< over these pairs, m
    double into_ground;          ///< of the point deepest in the floor, a wall or the mesh, m; negative: none touches
    int32_t lost;                ///< bodies beyond the walls or below the ground
} bench_overlaps;

/// Of a scene that tells its ground (bench_scene.ground). The overlap of two convex solids is the least over all axes
/// that can be the least (separating axes: normals of faces, products of edges); compounds are measured part by part,
/// cylinders as prisms of BENCH_ROUND sides inside of them. Pairs with a sphere or a capsule are not measured.
bench_overlaps bench_measure_overlaps(const bench_scene *scene, const bench_pose *poses);

#endif
