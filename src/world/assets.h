// assets.h - the life of what shapes share: heightfields.
#ifndef FE_WORLD_ASSETS_H
#define FE_WORLD_ASSETS_H
#include "world/world.h"

int32_t fe__heightfield_create(fe_world *world, const fe_heightfield_def *def); // index, or negative: fe_result
void fe__heightfield_set_heights(fe_world *world, int32_t index, int32_t row, int32_t column, int32_t rows, int32_t columns,
                                 const float *heights);
void fe__asset_destroy(fe_world *world, int32_t index);       // now, or with its last shape
void fe__shape_take_asset(fe_world *world, int32_t shape);    // becomes a user of its form's, if it has one
void fe__shape_release_asset(fe_world *world, int32_t shape); // the last user of a destroyed one frees it
void fe__assets_free(fe_world *world);

#endif
