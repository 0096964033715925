// reserve.h - all memory that a step can need.
#ifndef FE_STEP_RESERVE_H
#define FE_STEP_RESERVE_H
#include "world/step_scratch.h"

int32_t fe__reserve_step(fe__step *step); // 0: no memory, nothing changed

#endif
