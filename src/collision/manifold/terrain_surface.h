// terrain_surface.h - a triangle with its place in the ground, and the directions that its surroundings allow.
#ifndef FE_COLLISION_MANIFOLD_TERRAIN_SURFACE_H
#define FE_COLLISION_MANIFOLD_TERRAIN_SURFACE_H
#include "collision/manifold/patch.h"

// A triangle of the walk in the common frame. Side k runs from vertex k to the next.
typedef struct fe__tile {
    fe__form form;
    int32_t index, material;
    int32_t row, column, half; // of a heightfield
    uint8_t felt[3];           // of a mesh: may the surface bend down, or end, beyond side k?
    fe_vec3 normal;
    float size; // longest side, m
} fe__tile;

void fe__tile_place(const fe__terrain *terrain, int32_t index, fe__tile *tile); // whose form is there
// Does the surface bend down, or end, beyond side k?
int32_t fe__tile_is_convex(const fe__terrain *terrain, const fe__tile *tile, int32_t side);
// The triangle of a heightfield beyond side k, -1: a hole or the border. A mesh does not tell: -1.
int32_t fe__tile_beyond(const fe__terrain *terrain, const fe__tile *tile, int32_t side);

// What is so near to a point of a triangle goes on from it: a share of its size, and m
#define FE__GOES_ON_SHARE 1e-4f
#define FE__GOES_ON 1e-3f
static inline float fe__tile_goes_on(const fe__tile *tile)
{
    return fe__minf(FE__GOES_ON_SHARE * tile->size, FE__GOES_ON);
}

// Is the tile one of a face that is known (fe__terrain.known), and all that it could show beside that its neighbours'
// to show? Who lies on a triangle beyond whose sides nothing goes on may be about to leave it.
int32_t fe__tile_is_known(const fe__terrain *terrain, const fe__tile *tile);

// May the surface be touched along m (unit, out of it) at the vertices of the tile that lie farthest along m? Exactly
// when nothing of the surface around them rises along m. `m` need not be perpendicular to what is touched beyond a
// tolerance of a thousandth.
int32_t fe__tile_allows(const fe__terrain *terrain, const fe__tile *tile, fe_vec3 m);

// 1 and the height of the surface at x and z of p, all in the field's frame; 0 beside it and in holes.
int32_t fe__heightfield_height(const fe__heightfield *field, fe_dvec3 p, double *height);

// Ids. A feature of the body keeps its name on whatever triangle it lies; one of a triangle is named after it.
static inline uint32_t fe__tile_id(const fe__tile *tile, uint32_t feature)
{
    return UINT32_C(0x80000000) | ((uint32_t)tile->index * UINT32_C(2654435761) ^ feature);
}

#endif
