// narrow_field.h - the narrow phase of one pair with a heightfield. Only the pair and its patches are written.
#ifndef FE_STEP_NARROW_FIELD_H
#define FE_STEP_NARROW_FIELD_H
#include "world/step_scratch.h"

void fe__collide_field_pair(const fe__step *step, int32_t head);

#endif
