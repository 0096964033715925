// layout.h - the record of a hull (form/hull.h), from the facets of its builder.
#ifndef FE_COLLISION_HULL_BUILD_LAYOUT_H
#define FE_COLLISION_HULL_BUILD_LAYOUT_H
#include "collision/hull_build/builder.h"

int64_t fe__hull_block_size(fe__hull_builder *builder);
void fe__hull_lay_out(fe__hull_builder *builder, void *block, fe__hull *out_hull); // all but the measures

// ---- of any hull in the making, whose counts are set ---------------------------------------------------------------
// Places its arrays in the block; returns how many bytes they take. NULL: only that
int64_t fe__hull_take_arrays(fe__hull *hull, void *block);
// Is a unit vector parallel to one of those that are known?
int32_t fe__hull_is_known_direction(const fe_dvec3 *known, int32_t count, fe_dvec3 direction);
void fe__hull_set_vertex(fe__hull *hull, int32_t vertex, fe_vec3 position); // in their order; the bounds grow
// After all vertices and the face's corners. The plane touches the hull; returns how far the corners lie below it, m
double fe__hull_set_plane(const fe__hull *hull, int32_t face, fe_vec3 normal);
// The rest: what edges repeat of vertices and planes, directions, the lanes past the counts
void fe__hull_finish(fe__hull *hull, const fe_dvec3 *directions);

#endif
