// patch.h - points of one normal and one material: what a form and a heightfield or a mesh have instead of a manifold;
// and what such a kernel is given.
#ifndef FE_COLLISION_MANIFOLD_PATCH_H
#define FE_COLLISION_MANIFOLD_PATCH_H
#include "collision/form/ground.h"
#include "collision/manifold/manifold.h"

enum {
    FE__PATCHES = 6, // at most, of one pair. What has more directions than that is merged with the most similar ones:
                     // no contact is lost
    FE__NEIGHBOURS = 4, // other surfaces under the same body
};

// Points with one normal and one material.
typedef struct fe__patch {
    fe_vec3 normal;   // unit, from the surface to B
    int32_t count;    // 1..4
    int32_t triangle; // under the deepest point, its number
    fe__manifold_point points[FE_MAX_POINTS];
} fe__patch;

// Another surface: p in the common frame is  axes^T p + position  in its own.
typedef struct fe__neighbour {
    fe__ground ground;
    fe_dvec3 position;
    fe__mat3 axes;
} fe__neighbour;

typedef struct fe__terrain {
    fe__ground ground;
    fe_dvec3 origin; // of the common frame, in the surface's
    int32_t neighbour_count;
    fe__neighbour neighbours[FE__NEIGHBOURS];
} fe__terrain;

#endif
