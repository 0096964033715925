// terrain.h - a form on a heightfield or a mesh: manifolds by triangle, gathered into patches.
//
// Called by the world's narrow phase (step/narrow_field.c). Everything is given in a frame with the surface's axes and
// its origin at form B, so that floats are small. A direction of contact counts only where the surface has it:
// within the normal cone of the face, edge or vertex that is touched. Flat and concave edges have none but the faces'
// own normals, so that nothing is ever caught by an inner edge.
#ifndef FE_COLLISION_MANIFOLD_TERRAIN_H
#define FE_COLLISION_MANIFOLD_TERRAIN_H
#include "collision/manifold/patch.h"

// The triangles closer than `margin` or a little more: for several looks from near there (fe__ground.near). A
// heightfield needs none: 0, and nothing is written.
int32_t fe__find_near_triangles(const fe__terrain *terrain, const fe__form *b, const fe__mat3 *rotation, float margin,
                                fe__mesh_near *near);
// Patches of points closer than `margin`. Without any, *gap is a distance that the two are not closer than; NULL: who
// asks does not need it.
int32_t fe__collide_terrain(const fe__terrain *terrain, const fe__form *b, const fe__mat3 *rotation, float margin,
                            fe__patch patches[FE__PATCHES], float *gap);

#endif
