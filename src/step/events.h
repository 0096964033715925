// events.h - the stages that report.
#ifndef FE_STEP_EVENTS_H
#define FE_STEP_EVENTS_H
#include "world/step_scratch.h"

void fe__collect_events(fe__step *step);      // touching begun, kept, ended; impacts
void fe__collect_body_events(fe__step *step); // who woke, who fell asleep

#endif
