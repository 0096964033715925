// ignore.h - pairs of bodies that ignore each other.
#ifndef FE_WORLD_IGNORE_H
#define FE_WORLD_IGNORE_H
#include "world/world.h"

// Their pairs end with it; without it the next step finds them. FE_ERROR_MEMORY: nothing changed.
fe_result fe__ignore_collision(fe_world *world, int32_t body_a, int32_t body_b, int32_t ignore);

#endif
