// record.h - the arrays of a hull in its block, and what of them follows from the rest: from a builder's facets
// (layout.c), from another hull (scale.c), from bytes (collision/cooked).
#ifndef FE_COLLISION_HULL_BUILD_RECORD_H
#define FE_COLLISION_HULL_BUILD_RECORD_H
#include "collision/form/hull.h"

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

#endif
