// events.h - the stages that report.
#ifndef FE_STEP_EVENTS_H
#define FE_STEP_EVENTS_H
#include "world/step_scratch.h"

void fe__collect_events(fe__step *step);      // touching begun, kept, ended; impacts
void fe__collect_body_events(fe__step *step); // who woke, who fell asleep

// Of a pair: sum of the impulses, fastest approach; point and normal where the impulse is largest.
typedef struct fe__hit_impact {
    float impulse, largest, approach;
    int32_t pair, point; // the pair or a patch of it
} fe__hit_impact;
fe__hit_impact fe__impact_of(const fe_world *world, int32_t pair);
void fe__add_hit(fe_world *world, int32_t pair, const fe__hit_impact *sum); // if it is fast enough
// A pair that was looked at begins or ceases to touch. What it has to report: fe_event_kind, 0: nothing
int32_t fe__settle_pair(fe__step *step, int32_t pair);

#endif
