// collide.h - two forms, one manifold.
//
// Called by the world's narrow phase for every pair that cannot be recycled, on any thread; reads nothing but its
// arguments. All is float in the frame of form A: the caller subtracts the double positions first, so that the distance
// from the world's origin never costs precision.
//
// Order: A's type is never below B's (plane > hull > cone > cylinder > box > capsule > sphere), but of boxes and hulls
// A is the one with the larger half extents, so that a wide ground keeps its small coordinates across the contact.
#ifndef FE_COLLISION_MANIFOLD_COLLIDE_H
#define FE_COLLISION_MANIFOLD_COLLIDE_H
#include "collision/manifold/manifold.h"
#include "collision/manifold/patch.h"

// Fills the manifold with the points closer than `margin` (m, > 0). Special kernels where there is one, the general
// convex path otherwise.
void fe__collide(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                 fe__manifold *manifold);

// 1: of these two B is to be given as A
int32_t fe__collide_swaps(const fe__form *a, const fe__form *b);

// ---- terrain --------------------------------------------------------------------------------------------------------
// A form on a heightfield or a mesh: manifolds by triangle, gathered into patches.
//
// Called by the world's narrow phase (step/narrowphase_mesh.c). Everything is given in a frame with the surface's axes
// and its origin at form B, so that floats are small. A direction of contact counts only where the surface has it:
// within the normal cone of the face, edge or vertex that is touched. Flat and concave edges have none but the faces'
// own normals, so that nothing is ever caught by an inner edge.

// The triangles closer than `margin` or a little more: for several looks from near there (fe__ground.near). A
// heightfield needs none: 0, and nothing is written.
int32_t fe__find_near_triangles(const fe__terrain *terrain, const fe__form *b, const fe__mat3 *rotation, float margin,
                                fe__mesh_near *near);
// Patches of points closer than `margin`. Without any, *gap is a distance that the two are not closer than; NULL: who
// asks does not need it.
int32_t fe__collide_terrain(const fe__terrain *terrain, const fe__form *b, const fe__mat3 *rotation, float margin,
                            fe__patch patches[FE__PATCHES], float *gap);

#endif
