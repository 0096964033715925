// crowd.h - bodies that were put into one place: which of their pairs are left out.
#ifndef FE_STEP_CROWD_H
#define FE_STEP_CROWD_H
#include "world/step_scratch.h"

// Moves candidates that are left out behind the others, and counts them in fe__step_scratch.left_out. 0: no memory
int32_t fe__thin_crowds(fe__step *step);
// Those look for each other again in the next step
void fe__keep_looking(fe__step *step);

#endif
