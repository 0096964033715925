// continuous.h - one body of the continuous stage, for rejoin.c.
#ifndef FE_WORLD_CONTINUOUS_H
#define FE_WORLD_CONTINUOUS_H
#include "step/step.h"

// Follows a body on its way to where something static or kinematic stands in it, and ends its motion there. 1: it was stopped
int32_t fe__stop_body(const fe__step *step, int32_t body);

#endif
