// solve_stage.h - the stage that solves.
#ifndef FE_STEP_SOLVE_STAGE_H
#define FE_STEP_SOLVE_STAGE_H
#include "world/step_scratch.h"

// of a step of dt seconds with each substep divided into so many
fe__step_constants fe__constants_of(const fe_world *world, float dt, int32_t division);
void fe__solve_islands(fe__step *step); // all substeps -> velocities, motion, impulses

// Its parts, for worlds that are solved together: what is solved of this one, by which constants; what follows
typedef struct fe__solve_input {
    fe__records of;
    fe__step_constants paces[FE__PACES];
} fe__solve_input;
void fe__begin_solve(const fe__step *step, fe__solve_input *out_input);
void fe__end_solve(const fe__step *step);

#endif
