// due.h - which of the deferred pairs get points in this step.
#ifndef FE_STEP_DUE_H
#define FE_STEP_DUE_H
#include "world/step_scratch.h"

// Lists the deferred pairs that meet in this step in fe__step_scratch.busy, and counts them and those that wait on.
// The collide stage ends their deferral. 0: no memory
int32_t fe__find_due(fe__step *step);
// What was found of those that wait on becomes the world's, or is forgotten when the step failed.
void fe__keep_waiting(fe__step *step);

#endif
