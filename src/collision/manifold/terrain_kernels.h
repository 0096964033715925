// terrain_kernels.h - a form on one triangle of a heightfield (terrain_round.c, terrain_box.c, terrain_curved.c). It is
// centred at the origin.
#ifndef FE_COLLISION_MANIFOLD_TERRAIN_KERNELS_H
#define FE_COLLISION_MANIFOLD_TERRAIN_KERNELS_H
#include "collision/form/clip.h"
#include "collision/manifold/terrain_gather.h"

// `ends`: of the core, a sphere's twice the same
void fe__tile_touch_round(fe__gathering *g, const fe__tile *tile, const fe_vec3 ends[2], float radius);
// fe__keep_line_ends of a capsule's core, which lies along `axis`, and of a line on a form's side
void fe__keep_core_ends(fe__raw_patch *patch, fe_vec3 axis, float tie);
void fe__keep_side_ends(fe__raw_patch *patch, float tie);
void fe__tile_touch_curved(fe__gathering *g, const fe__tile *tile, const fe__form *form, const fe__mat3 *rotation);

// Cuts the incident polygon or segment by the reference's; `out` is the reference's normal. What is near goes along
// `normal`, out of the surface. body_id: of the incident face when it is the body's, else 0.
typedef struct fe__cut {
    const fe_vec3 *reference, *incident;
    int32_t reference_count, incident_count;
    fe_vec3 out, normal;
    uint32_t body_id;
    float tie;
} fe__cut;
struct fe__face;
// The body's face that looks along the direction, in the common frame. `vertex`: of a hull, the farthest along it; -1:
// not known. `foot`: where the load presses, or NULL
void fe__tile_body_face(const fe__form *form, const fe__mat3 *rotation, fe_vec3 direction, int32_t vertex,
                        const fe_vec3 *foot, struct fe__face *face);
// What is left of the incident one: heights over the reference's plane
typedef struct fe__cut_piece {
    fe_vec3 origin;
    fe__mat3 frame;
    int32_t count;
    fe__clip_vertex vertex[FE_CLIP_VERTICES];
} fe__cut_piece;
void fe__tile_cut_piece(const fe__tile *tile, const fe__cut *cut, fe__cut_piece *piece);
void fe__tile_gather_piece(fe__gathering *g, const fe__tile *tile, const fe__cut *cut, const fe__cut_piece *piece);
void fe__tile_cut_faces(fe__gathering *g, const fe__tile *tile, const fe__cut *cut); // both
// Is a piece of the body's face, cut by the triangle, as low as its lowest point, which is hardly under the plane?
// Along a unit m a point over the triangle is no farther from it than its height, or 0: no other direction is better
// than the normal by more than a tie
int32_t fe__tile_settles(const fe__cut *cut, const fe__cut_piece *piece, float lowest);
void fe__tile_touch_box(fe__gathering *g, const fe__tile *tile, const fe__form *box, const fe__mat3 *rotation);

#endif
