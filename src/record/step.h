// step.h - steps in a recording. In one of them the recorder listens to the pair filter, in its place.
#ifndef FE_RECORD_STEP_H
#define FE_RECORD_STEP_H
#include "record/recorder.h"

void fe__record_step_begin(fe_recorder *recorder);
void fe__record_step_end(fe_recorder *recorder, float dt, fe_result result);
void fe__record_filter(fe_recorder *recorder); // another one, or none

#endif
