// warm_start.h - heavy trees that turn fast begin a substep without the impulses of the last.
#ifndef FE_SOLVER_TREE_WARM_START_H
#define FE_SOLVER_TREE_WARM_START_H
#include "solver/tree/node.h"

// After relax, whose rows are those of the pose that it left
void fe__tree_forget_locks(const fe__tree_job *t);

#endif
