// island_bound.h - how large the largest island of a step may be, at most.
#ifndef FE_STEP_ISLAND_BOUND_H
#define FE_STEP_ISLAND_BOUND_H
#include "solver/graph/graph_input.h"
#include "world/step_scratch.h"

int32_t fe__bound_islands(fe__step *step, fe__graph_bound *bound); // sets bound->largest. 0: no memory

#endif
