// joint_groups.h - groups of lanes for the joints of a batch.
#ifndef FE_SOLVER_GRAPH_JOINT_GROUPS_H
#define FE_SOLVER_GRAPH_JOINT_GROUPS_H
#include "solver/graph/builder.h"

// Of batch k, and its trees
void fe__graph_joint_groups(fe__builder *b, int32_t k, const fe__kernels *kernels);

#endif
