// tree_solver.h - all locks of trees of joints, met at once; trees of one form side by side, in lanes.
//
// Runs after the sweep over the joints, whose rows hold arms, errors and impulses, and ends what the sweep began. Ropes
// (FE__TREE_ROPE) have no rows: they are read from the records of their joints, and stored there.
//
// A substep is RATTLE's (Andersen 1983): first velocities that bring the points together at its end, then positions,
// put right by what is left, then velocities along the locks as they now are. So no spring is in it and none is needed:
// a chain under a load of a thousand links is as long as its links, and the energy that this kind of integrator keeps
// is kept.
#ifndef FE_SOLVER_TREE_TREE_SOLVER_H
#define FE_SOLVER_TREE_TREE_SOLVER_H
#include "solver/solver_body.h"
#include "solver/solver.h"

// A rotation within a substep that is no small correction any more, rad
#define FE__SLOW_TURN 0.05

// `count` trees of one form, at most as many as the kernels have lanes
typedef struct fe__tree_job {
    fe__solver *solver;
    const fe__records *of;
    const fe__tree_name *trees;
    int32_t count;
    unsigned char *rows;  // of the batch
    unsigned char *nodes; // fe__forest_bytes of them, whole blocks
    double h;             // of the substep, s
    double rate;          // share of a gap that a soft lock closes in a substep
    double mean;          // from the sum of a step's impulses to the mean force, 1/s
    double warm_scale;    // from stored impulses to those of a substep
    double stored;        // from those of a substep to stored ones
    double open;          // square of a gap from which on the island is stretched, m2
} fe__tree_job;

#endif
