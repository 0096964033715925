// continuous.h - the stage between solver and finalize: motions end where something stood in the way.
#ifndef FE_CONTINUOUS_CONTINUOUS_H
#define FE_CONTINUOUS_CONTINUOUS_H
#include "world/step_scratch.h"

void fe__stop_fast_bodies(fe__step *step);

#endif
