// island_bound.h - how large the largest island of a step may be, at most, and how much of what sleeps may wake in it.
#ifndef FE_STEP_ISLAND_BOUND_H
#define FE_STEP_ISLAND_BOUND_H
#include "solver/graph/graph_input.h"
#include "world/step_scratch.h"

// Before the other two: clusters that are not stale know the candidates
void fe__count_candidates(fe__step *step);
// Waking spreads by pairs and joints: contacts and joints' rows of all clusters with a sleeping body that a candidate,
// or a pair that does not touch yet, has in common with one that is awake. 0: no memory
int32_t fe__bound_waking(fe__step *step, int32_t *out_lanes, int32_t *out_clusters);
int32_t fe__bound_islands(fe__step *step, fe__graph_bound *bound); // sets bound->largest

#endif
