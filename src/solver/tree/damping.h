// damping.h - rows that damp light links under great tension.
#ifndef FE_SOLVER_TREE_DAMPING_H
#define FE_SOLVER_TREE_DAMPING_H
#include "solver/tree/node.h"

void fe__tree_add_damping(const fe__tree_job *t); // for the pulls that the locks bear
void fe__tree_add_pulls(const fe__tree_job *t);   // those of the solution at hand, on top of what the rows hold
// 1: some link bears much more than what its joints were damped for, as when a slack chain goes taut. Spoils the pulls.
int32_t fe__tree_is_jerked(const fe__tree_job *t);
// Damping leaves the warm start: `start` takes what the damping of link i gave
void fe__tree_forget_damping(const fe__tree_job *t, int32_t i);

#endif
