// narrow_field.h - the narrow phase of one pair with a heightfield. Only the pair and its patches are written.
#ifndef FE_STEP_NARROW_FIELD_H
#define FE_STEP_NARROW_FIELD_H
#include "world/world.h"

void fe__collide_field_pair(fe_world *world, int32_t head, float dt); // for a step of dt seconds

#endif
