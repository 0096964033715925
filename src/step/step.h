// step.h - the step: all its stages, in order.
#ifndef FE_STEP_STEP_H
#define FE_STEP_STEP_H
#include "world/step_scratch.h"

// FE_ERROR_MEMORY: nothing happened.
fe_result fe__world_step(fe_world *world, float dt);

// The same in two halves, for worlds that are solved together: the second begins with the stage that solves
typedef struct fe__open_step {
    fe__step step;
    fe_profile profile;
    int32_t is_timed; // 1: each stage; 0: none
    double mark;      // when the last stage ended, s
    int32_t next;     // stage
} fe__open_step;

// FE_ERROR_MEMORY: nothing happened, and there is no second half
fe_result fe__step_begin(fe__open_step *open, fe_world *world, float dt, int32_t is_timed);
void fe__step_resume(fe__open_step *open); // it is solved already
void fe__step_end(fe__open_step *open);

#endif
