// solve_stage.h - the stage that solves.
#ifndef FE_STEP_SOLVE_STAGE_H
#define FE_STEP_SOLVE_STAGE_H
#include "world/step_scratch.h"

// of a step of dt seconds with each substep divided into so many
fe__step_constants fe__constants_of(const fe_world *world, float dt, int32_t division);
void fe__solve_islands(fe__step *step); // all substeps -> velocities, motion, impulses

// Its parts, for worlds that are solved together
int32_t fe__solves_alike(const fe_world *world,
                         const fe_world *other);   // 1: by the same constants, in steps of one length
fe__records fe__begin_solve(const fe__step *step); // what is solved of this one
// ... with others' records, by the constants of this one
void fe__solve_with(const fe__step *step, fe__solver *solver, const fe__records *of);
void fe__end_solve(const fe__step *step);

#endif
