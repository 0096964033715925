// solve_stage.h - the stage that solves.
#ifndef FE_STEP_SOLVE_STAGE_H
#define FE_STEP_SOLVE_STAGE_H
#include "world/step_scratch.h"

// of a step of dt seconds with each substep divided into so many
fe__step_constants fe__constants_of(const fe_world *world, float dt, int32_t division);
void fe__solve_islands(fe__step *step); // all substeps -> velocities, motion, impulses

#endif
