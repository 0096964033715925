// terrain_course.h - which triangles of a mesh a form may touch on its way through a step, found once for all looks at
// the pair.
//
// Most triangles near a body are only next to what it touches. Axes part them from it, at the start and at the end of
// its way; in between it is no nearer than a bend, because a point that goes straight is nearest to a plane at an end.
#ifndef FE_COLLISION_MANIFOLD_TERRAIN_COURSE_H
#define FE_COLLISION_MANIFOLD_TERRAIN_COURSE_H
#include "collision/manifold/patch.h"

// Where B goes past a ground that stands still, in the common frame (collide.h). Its origin starts at 0.
typedef struct fe__course {
    fe__mat3 rotation[2]; // at the start and at the end
    fe_vec3 end;          // where its origin ends
    fe_vec3 centre;       // about which it turns, at the start
    float reach;          // from there to a point of B, m, at most
    float angle;          // by which it turns, rad
    float bend;           // how far the centre comes off its straight way, m, at most
} fe__course;

// Beyond this angle, rad, bends say little
#define FE__MOST_COURSE_ANGLE 1.0f

// How far a point of B comes off its straight way, m, at most: by an arc, which is no farther from its chord than
// reach angle^2 / 8, and by how unevenly it is passed along
static inline float fe__course_bend(const fe__course *way)
{
    return way->bend + 0.25f * way->angle * way->angle * way->reach;
}

// ---- the kernel (terrain_course.simd.c) ----------------------------------------------------------------------------
typedef struct fe__course_probe {
    const fe__form *b;
    const fe__course *way;
    fe_vec3 at[2];  // of B's origin, at the start and at the end
    fe_vec3 middle; // of B, half way
    float near;     // m, what is parted by more is left out
} fe__course_probe;

enum { FE__COURSE_LANES = 16 }; // the widest SIMD set

// Of triangles, one beside the other; up to a multiple of FE__COURSE_LANES they are numbers
typedef struct fe__course_corners {
    _Alignas(64) float x[3][FE__MESH_NEAR], y[3][FE__MESH_NEAR], z[3][FE__MESH_NEAR];
} fe__course_corners;

// A bit for each that B may touch: anywhere on its way, and at the end of it. Bits beyond the count mean nothing
typedef struct fe__met_on_course {
    uint64_t on_way, at_end;
} fe__met_on_course;
typedef fe__met_on_course fe__course_kernel(const fe__course_probe *probe, const fe__course_corners *corners,
                                            int32_t count);

// ---- all -----------------------------------------------------------------------------------------------------------
// The triangles of the mesh that B may come nearer to than `margin`, and others near them. Of more than the list holds
// the count is -1
void fe__find_triangles_on_course(const fe__terrain *terrain, const fe__form *b, const fe__course *course, float margin,
                                  fe__course_kernel *kernel, fe__mesh_near *near);

#endif
