// layout.h - the record of a hull (form/hull.h), from the facets of its builder.
#ifndef FE_COLLISION_HULL_BUILD_LAYOUT_H
#define FE_COLLISION_HULL_BUILD_LAYOUT_H
#include "collision/hull_build/builder.h"
#include "collision/hull_build/record.h"

int64_t fe__hull_block_size(fe__hull_builder *builder);
void fe__hull_lay_out(fe__hull_builder *builder, void *block, fe__hull *out_hull); // all but the measures

// Is a unit vector parallel to one of those that are known?
int32_t fe__hull_is_known_direction(const fe_dvec3 *known, int32_t count, fe_dvec3 direction);

#endif
