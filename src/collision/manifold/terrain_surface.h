// terrain_surface.h - what the kernels of terrain.c share: a triangle with its place in the grid, the directions its surroundings allow,
// and where points of contact go.
#ifndef FE_COLLISION_MANIFOLD_TERRAIN_SURFACE_H
#define FE_COLLISION_MANIFOLD_TERRAIN_SURFACE_H
#include "collision/manifold/terrain.h"

// A triangle of the walk in the common frame. Side k runs from vertex k to the next.
typedef struct fe__tile {
    fe__form form;
    int32_t index, row, column, half;
    fe_vec3 normal;
    float size; // longest side, m
} fe__tile;

fe__tile fe__tile_of(const fe__terrain *terrain, const fe__form *triangle, int32_t index);
// Does the surface bend down, or end, beyond side k?
int32_t fe__tile_is_convex(const fe__terrain *terrain, const fe__tile *tile, int32_t side);
// The triangle beyond side k, -1: a hole or the border.
int32_t fe__tile_beyond(const fe__terrain *terrain, const fe__tile *tile, int32_t side);

// May the surface be touched along m (unit, out of it) at the vertices of the tile that lie farthest along m? Exactly when nothing of the
// surface around them rises along m. `m` need not be perpendicular to what is touched beyond a tolerance of a thousandth.
int32_t fe__tile_allows(const fe__terrain *terrain, const fe__tile *tile, fe_vec3 m);

// ---- gathering ------------------------------------------------------------------------------------------------------------------------
enum { FE__RAW_POINTS = 16 };

typedef struct fe__raw_patch {
    fe_vec3 normal;
    int32_t count, triangle, material;
    float deepest;
    fe__manifold_point points[FE__RAW_POINTS];
} fe__raw_patch;

typedef struct fe__gathering {
    const fe__terrain *terrain;
    float margin;
    float felt;       // m, see fe__tile_feels
    float tie;        // m, points as deep as each other
    float same_place; // m, points of two triangles at their seam
    int32_t single;   // one point a patch
    int32_t count;
    fe__raw_patch patches[FE__PATCHES + 1];
} fe__gathering;

// A surface has no inside: what is far below a triangle is not felt by it, unless the body's centre is above it, or under the ground.
static inline int32_t fe__tile_feels(const fe__gathering *g, const fe__tile *tile, float separation)
{
    return separation >= -g->felt || fe__dot(tile->normal, tile->form.vertex[0]) <= 0.0f;
}

// 1 and the height of the surface at x and z of p, all in the field's frame; 0 beside it and in holes.
int32_t fe__heightfield_height(const fe__heightfield *field, fe_dvec3 p, double *height);

void fe__gather(fe__gathering *g, const fe__tile *tile, fe_vec3 normal, fe_vec3 point, float separation, uint32_t id);

// ---- kernels (terrain_round.c, terrain_box.c) -----------------------------------------------------------------------------------------
// `ends`: of the core, a sphere's twice the same
void fe__tile_touch_round(fe__gathering *g, const fe__tile *tile, const fe_vec3 ends[2], float radius);
void fe__tile_touch_box(fe__gathering *g, const fe__tile *tile, const fe__form *box, const fe__mat3 *rotation);

// Ids. A feature of the body keeps its name on whatever triangle it lies; one of a triangle is named after it.
static inline uint32_t fe__tile_id(const fe__tile *tile, uint32_t feature)
{
    return UINT32_C(0x80000000) | ((uint32_t)tile->index * UINT32_C(2654435761) ^ feature);
}

#endif
