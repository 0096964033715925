// manifold.h - the points in which two forms touch.
#ifndef FE_COLLISION_MANIFOLD_MANIFOLD_H
#define FE_COLLISION_MANIFOLD_MANIFOLD_H
#include "collision/form/form.h"
#include "collision/form/load_line.h"

enum { FE_MAX_POINTS = 4 };

typedef struct fe__manifold_point {
    fe_vec3 point;    // midway between the surfaces, A's frame
    float separation; // m, below 0 when they overlap
    uint32_t id;      // of the two features; the same next step while the same features meet
} fe__manifold_point;

// Of one pair. The caller keeps `axis` and `axis_separation` from step to step and passes them in: a kernel may try
// them first. Without points, axis_separation comes out as a distance that the forms are not closer than, so that the
// caller need not ask again before they moved as far; with a normal they are so far apart along it.
typedef struct fe__manifold {
    fe_vec3 normal; // unit, from A to B, A's frame; (0, 0, 0) where none is known
    int32_t count;  // 0..4
    int32_t axis;   // kernel's own, -1: none yet
    float axis_separation;
    fe_vec3 last;               // with an axis: the normal that was found last, A's frame
    int32_t round;              // 1: the normal turns when the forms shift by little, as between round forms
    const fe__load_asked *load; // given: in A's frame; NULL: nobody knows
    int32_t left_out;           // FE_LEFT_*: more of the faces touches than the points
    fe__manifold_point points[FE_MAX_POINTS];
} fe__manifold;

// B's pose in A's frame
typedef struct fe__relative {
    fe_vec3 position;
    fe__mat3 rotation;
} fe__relative;

#endif
