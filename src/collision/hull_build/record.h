// record.h - the arrays of a hull in its block, and what of them follows from the rest: from a builder's facets
// (layout.c) as from bytes (collision/cooked).
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

// Then the half-edges: `half` is that from each corner to the next of its face
void fe__hull_connect(fe__hull *hull, const uint16_t *half);
// Then the rest but the measures: bounds, distances and flatness of the planes, what stands by edges, lanes past counts
void fe__hull_complete(fe__hull *hull);

// The least float that is not below x
float fe__float_above(double x);

#endif
