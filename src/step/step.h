// step.h - the step: all its stages, in order.
#ifndef FE_STEP_STEP_H
#define FE_STEP_STEP_H
#include "world/world.h"

// FE_ERROR_MEMORY: nothing happened.
fe_result fe__world_step(fe_world *world, float dt);

#endif
