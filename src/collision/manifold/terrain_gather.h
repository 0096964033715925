// terrain_gather.h - where the points of the kernels of terrain.c go: into patches.
#ifndef FE_COLLISION_MANIFOLD_TERRAIN_GATHER_H
#define FE_COLLISION_MANIFOLD_TERRAIN_GATHER_H
#include "collision/manifold/terrain_surface.h"

enum { FE__RAW_POINTS = 16 };

typedef struct fe__raw_patch {
    fe_vec3 normal;
    int32_t count, triangle, material, left_out;
    int32_t is_of_face; // the normal is that of the triangle
    fe_vec3 face;       // as fe__patch.face
    float deepest;
    fe__manifold_point points[FE__RAW_POINTS];
} fe__raw_patch;

typedef struct fe__gathering {
    const fe__terrain *terrain;
    const fe__form *form; // of the body
    const fe__mat3 *rotation;
    float margin;
    float felt;       // m, see fe__tile_feels
    float tie;        // m, points as deep as each other
    float same_place; // m, points of two triangles at their seam
    int32_t single;   // one point a patch
    int32_t rims;     // 1 << FE_RIM_* of those whose points were cut
    fe_vec3 away;     // of the form's centre in the frame of terrain->load
    int32_t has_load;
    fe__load load; // see fe__gathering_load
    int32_t count;
    fe__raw_patch patches[FE__PATCHES + 1];
} fe__gathering;

// The load in the frame of the points, asked for once
const fe__load *fe__gathering_load(fe__gathering *g);

// A surface has no inside: what is far below a triangle is not felt by it, unless the body's centre is above it, or
// under the ground.
static inline int32_t fe__tile_feels(const fe__gathering *g, const fe__tile *tile, float separation)
{
    return separation >= -g->felt || fe__dot(tile->normal, tile->form.vertex[0]) <= 0.0f;
}

// May the body touch the tile along m, with that separation? As fe__tile_allows, and not where it is carried over to
// the tile from across a gap. `rim`: where they touch, or NULL: not known
int32_t fe__tile_feels_along(const fe__gathering *g, const fe__tile *tile, fe_vec3 m, const fe_vec3 *rim,
                             float separation);
void fe__gather(fe__gathering *g, const fe__tile *tile, fe_vec3 normal, fe_vec3 point, float separation, uint32_t id);
// Leaves out points at an edge of a mesh that bends down there, as the boxes of a closed one do, where the body is
// carried over to the face beyond the edge by what it touches along that face's normal.
void fe__leave_carried(fe__gathering *g);
// Of a line that touches from one of two points to the other, these carry all: what lies between, where seams cut it,
// comes and goes as the line rolls. Points deeper than the two by more than `tie` stay.
void fe__keep_line_ends(fe__raw_patch *patch, int32_t from, int32_t to, float tie);
// Leaves at most FE_MAX_POINTS. `is_aimed`: see fe__foot
void fe__reduce_patch(fe__gathering *g, fe__raw_patch *patch, int32_t is_aimed);

#endif
