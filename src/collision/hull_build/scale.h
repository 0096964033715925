// scale.h - a hull under a scale of its asset: a copy with the same vertices, edges and faces, by number.
//
// The scale is along the axes of the asset's frame, from its origin. An odd number of negative ones turns the windings.
#ifndef FE_COLLISION_HULL_BUILD_SCALE_H
#define FE_COLLISION_HULL_BUILD_SCALE_H
#include "collision/hull_build/build.h"

int64_t fe__hull_scaled_size(const fe__hull *hull, fe_vec3 scale);
// `block`: so many bytes, aligned to 64, zeroed. 0: the copy is thinner than a hull may be.
int32_t fe__hull_write_scaled(const fe__hull *hull, fe_vec3 scale, void *block, fe__hull *out_hull,
                              fe__hull_refusal *out_refusal);

#endif
