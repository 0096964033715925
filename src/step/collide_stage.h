// collide_stage.h - the stages of contacts and of the constraint graph.
#ifndef FE_STEP_COLLIDE_STAGE_H
#define FE_STEP_COLLIDE_STAGE_H
#include "world/step_scratch.h"

void fe__update_contacts(fe__step *step); // narrow phase or recycling -> manifolds, begin and end, wakes
void fe__build_islands(fe__step *step);   // the graph, when it changed
// A pair without points may move by `slack`, m, before it is looked at again
void fe__defer_pair(const fe__step *step, int32_t pair, float slack);
void fe__sort_pairs(fe__step *step, int32_t *pairs, int32_t count); // by the creation of their shapes
// Awake pairs that do not wait, good until one of them does
const int32_t *fe__busy_pairs(fe__step *step, int32_t *out_count);

#endif
