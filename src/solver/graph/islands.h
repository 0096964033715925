// islands.h - islands of bodies, batches of islands.
#ifndef FE_SOLVER_GRAPH_ISLANDS_H
#define FE_SOLVER_GRAPH_ISLANDS_H
#include "solver/graph/builder.h"

// Bodies, contacts and joints in the order of their batches
void fe__graph_find_batches(fe__builder *b);

#endif
