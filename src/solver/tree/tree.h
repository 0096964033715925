// tree.h - all locks of a tree of joints, met at once.
//
// Runs after the sweep over the joints, whose rows hold arms, errors and impulses, and ends what the sweep began.
//
// A substep is RATTLE's (Andersen 1983): first velocities that bring the points together at its end, then positions,
// put right by what is left, then velocities along the locks as they now are. So no spring is in it and none is needed:
// a chain under a load of a thousand links is as long as its links, and the energy that this kind of integrator keeps
// is kept.
#ifndef FE_SOLVER_TREE_TREE_H
#define FE_SOLVER_TREE_TREE_H
#include "solver/tree/node.h"

// Bytes of the nodes of so many links; they begin with a whole block
int64_t fe__tree_bytes(int32_t links);
// `rows`: the batch's row memory; `nodes`: where the tree has its own, bytes into it
fe__tree_job fe__tree_job_of(fe__solver *s, const fe__lock_lanes *lanes, const fe__joints *joints, int32_t tree,
                             unsigned char *rows, int64_t nodes, const fe__step_constants *c);

// Each after the same pass over the rows of the joints
void fe__tree_prepare(const fe__tree_job *t);
void fe__tree_solve(const fe__tree_job *t);
void fe__tree_relax(const fe__tree_job *t);
// After the contacts of a soft pass, which know nothing of the joints: what was struck or pinched would fly off.
void fe__tree_follow(const fe__tree_job *t);

#endif
