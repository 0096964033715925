// finalize.h - the stages after the solver.
#ifndef FE_STEP_FINALIZE_H
#define FE_STEP_FINALIZE_H
#include "world/step_scratch.h"

void fe__move_bodies(fe__step *step);          // poses, bounds, trees
void fe__put_islands_to_sleep(fe__step *step); // those slow for long enough

#endif
