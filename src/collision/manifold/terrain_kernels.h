// terrain_kernels.h - a form on one triangle of a heightfield (terrain_round.c, terrain_box.c). It is centred at the
// origin.
#ifndef FE_COLLISION_MANIFOLD_TERRAIN_KERNELS_H
#define FE_COLLISION_MANIFOLD_TERRAIN_KERNELS_H
#include "collision/manifold/terrain_gather.h"

// `ends`: of the core, a sphere's twice the same
void fe__tile_touch_round(fe__gathering *g, const fe__tile *tile, const fe_vec3 ends[2], float radius);
void fe__tile_touch_box(fe__gathering *g, const fe__tile *tile, const fe__form *box, const fe__mat3 *rotation);

#endif
