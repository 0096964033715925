// encounters.h - the events of compounds: what their parts' pairs found, told of the whole shapes.
#ifndef FE_STEP_ENCOUNTERS_H
#define FE_STEP_ENCOUNTERS_H
#include "world/step_scratch.h"

// Of pairs of parts that have something to report, in any order; and of encounters that lost pairs since the last step
void fe__report_encounters(fe__step *step, int32_t *pairs, int32_t count);

#endif
