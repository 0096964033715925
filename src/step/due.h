// due.h - which of the deferred pairs the narrow phase looks at in this step.
#ifndef FE_STEP_DUE_H
#define FE_STEP_DUE_H
#include "world/step_scratch.h"

// Ends the deferral of pairs that may meet in this step, and lists them in fe__step_scratch.busy. 0: no memory
int32_t fe__find_due(fe__step *step);
void fe__put_due_back(fe__step *step); // the step failed

#endif
