// patch.h - points of one normal and one material: what a form and a heightfield or a mesh have instead of a manifold;
// and what such a kernel is given.
#ifndef FE_COLLISION_MANIFOLD_PATCH_H
#define FE_COLLISION_MANIFOLD_PATCH_H
#include "collision/form/ground.h"
#include "collision/form/flat.h"
#include "collision/manifold/manifold.h"

enum {
    FE__PATCHES = 6, // at most, of one pair. What has more directions than that is merged with the most similar ones:
                     // no contact is lost
    FE__NEIGHBOURS = 8,   // other surfaces near the same body
    FE__NEAR_SOLIDS = 16, // other static boxes and hulls near it
};

// cos 1.8 degrees: of normals of one patch
#define FE__SAME_NORMAL 0.9995f

// Points with one normal and one material.
typedef struct fe__patch {
    fe_vec3 normal; // unit, from the surface to B
    fe_vec3 face;   // unit, of the triangle at whose edge it is touched, where that looks the same way; else the normal
    int32_t count;  // 1..4
    int32_t triangle; // under the deepest point, its number
    int32_t left_out; // as fe__manifold's
    fe__manifold_point points[FE_MAX_POINTS];
} fe__patch;

// Another surface: p in the common frame is  axes^T p + position  in its own.
typedef struct fe__neighbour {
    fe__ground ground;
    fe_dvec3 position;
    fe__mat3 axes;
} fe__neighbour;

// What else lies near the body, in the common frame: it may go on where a surface ends.
typedef struct fe__surroundings {
    int32_t ground_count, solid_count;
    fe__neighbour grounds[FE__NEIGHBOURS];
    fe__solid solids[FE__NEAR_SOLIDS];
} fe__surroundings;

typedef struct fe__terrain {
    fe__ground ground;
    fe_dvec3 origin; // of the common frame, in the surface's
    const fe__surroundings *around;
    // Faces whose normals are among these need not be looked at: they are touched already. Points of others may still
    // have such a normal
    const fe_vec3 *known;
    const fe_vec3 *known_face; // fe__patch.face of each
    const fe_dvec3 *known_at;  // a point of each, in the surface's frame
    int32_t known_count;
    int32_t is_last;            // the look is one at the end of B's way (ground.near)
    float fall;                 // m, how far B may have fallen, at the look's pose, below what carries it
    const fe__load_asked *load; // in the common frame of fe__collide_terrain; NULL: nobody knows
} fe__terrain;

#endif
