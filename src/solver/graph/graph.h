// graph.h - which contacts are solved together: islands, batches, colours, rows.
//
// Input: the awake bodies and the linked contacts and joints. Output: batches of lines and groups of lanes in fe__solver.
// The graph lives on while nothing links, unlinks, wakes or sleeps.
#ifndef FE_SOLVER_GRAPH_H
#define FE_SOLVER_GRAPH_H
#include "solver/graph/input.h"

// There is room for it, see room.h
void fe__graph_build(fe__solver *s, const fe__kernels *kernels, const fe__graph_input *input);

#endif
