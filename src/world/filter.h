// filter.h - who may touch whom.
#ifndef FE_WORLD_FILTER_H
#define FE_WORLD_FILTER_H
#include "world/world.h"

// May these two shapes have a pair? Kinds of bodies, layers, ignored pairs, joints.
int32_t fe__may_collide(const fe_world *world, int32_t shape_a, int32_t shape_b);

#endif
