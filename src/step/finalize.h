// finalize.h - the stages after the solver.
#ifndef FE_STEP_FINALIZE_H
#define FE_STEP_FINALIZE_H
#include "world/step_scratch.h"

void fe__move_bodies(fe__step *step);          // poses, bounds, trees
void fe__put_islands_to_sleep(fe__step *step); // those slow for long enough
void fe__give_back_rows(fe__step *step);       // a sleeping world keeps none; last, as they are what is sorted in

#endif
