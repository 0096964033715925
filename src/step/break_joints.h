// break_joints.h - the stage that removes joints which bore too much.
#ifndef FE_STEP_BREAK_JOINTS_H
#define FE_STEP_BREAK_JOINTS_H
#include "world/step_scratch.h"

void fe__break_joints(fe__step *step);

#endif
