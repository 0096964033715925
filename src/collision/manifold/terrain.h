// terrain.h - a form on a heightfield: manifolds by triangle, gathered into patches.
//
// Called by the world's narrow phase (step/narrow_field.c). Everything is given in a frame with the heightfield's axes and its origin at
// form B, so that floats are small. A direction of contact counts only where the surface has it: within the normal cone of the face, edge
// or vertex that is touched. Flat and concave edges have none but the faces' own normals, so that nothing is ever caught by an inner edge.
#ifndef FE_COLLISION_MANIFOLD_TERRAIN_H
#define FE_COLLISION_MANIFOLD_TERRAIN_H
#include "collision/manifold/collide.h"
#include "collision/form/heightfield.h"

enum {
    FE__PATCHES = 6,    // at most, of one pair. What has more directions than that is merged with the most similar ones: no contact is lost
    FE__NEIGHBOURS = 4, // other heightfields under the same body
};

// Points with one normal and one material.
typedef struct fe__patch {
    fe_vec3 normal;   // unit, from the surface to B
    int32_t count;    // 1..4
    int32_t triangle; // under the deepest point
    fe__manifold_point points[FE_MAX_POINTS];
} fe__patch;

// Another heightfield: p in the common frame is  axes^T p + position  in its own.
typedef struct fe__neighbour {
    const fe__heightfield *field;
    fe_dvec3 position;
    fe__mat3 axes;
} fe__neighbour;

typedef struct fe__terrain {
    const fe__heightfield *field;
    fe_dvec3 origin; // of the common frame, in the field's
    int32_t neighbour_count;
    fe__neighbour neighbours[FE__NEIGHBOURS];
} fe__terrain;

// Patches of points closer than `margin`. Without any, *gap is a distance that the two are not closer than.
int32_t fe__collide_terrain(const fe__terrain *terrain, const fe__form *b, const fe__mat3 *rotation, float margin,
                            fe__patch patches[FE__PATCHES], float *gap);

#endif
