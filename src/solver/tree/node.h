// node.h - a link of a tree as its solver sees it: rows, masses, and the matrices of the elimination.
//
// With M the masses, J the rows of all locks, v the velocities that the sweep left, the change l of all impulses and
// the change u of all velocities follow from
//     M u = J^T l,   J (v + u) = -d
// On a tree that matrix is eliminated from the leaves upwards without a new entry (Baraff, "Linear-Time Dynamics using
// Lagrange Multipliers", SIGGRAPH 1996; its masses are Featherstone's articulated inertias). With Jc, Jp a joint's rows
// for the body below and above, P the mass matrix of the body below with all that hangs on it, f the load that hangs on
// it, G a compliance:
//     up     P = L L^T,  Y = L^-1 Jc^T,  Y^T Y + G = C C^T,  H = C^-1 Jp,  P_parent += H^T H
//            e = C^-1 (request - Y^T L^-1 f),                              f_parent += H^T e
//     down   l = C^-T (e - H u_parent),                                    u = L^-T (L^-1 f + Y l)
// Positions decide P, Y, C and H: they are found once a substep, in double, as a chain may bear a million times its own
// mass.
#ifndef FE_SOLVER_TREE_NODE_H
#define FE_SOLVER_TREE_NODE_H
#include "solver/solver.h"

// A rotation within a substep that is no small correction any more, rad
#define FE__SLOW_TURN 0.05

enum { FE__TREE_LOCKS = 6, FE__TREE_ROWS = FE__TREE_LOCKS + 3 }; // three more damp a joint, see damping.c

// What the locks of a joint say of the velocities (v, w) of the body below it and of the one above
typedef struct fe__tree_rows {
    double below[FE__TREE_ROWS][6], above[FE__TREE_ROWS][6]; // J
    double error[FE__TREE_ROWS];                             // m, rad
    // from the centres of the body below, above to the joint's point, m
    fe_dvec3 arm[2];
    fe_dvec3 pull; // impulse on the body below at that point, N s
    int32_t count;
    int32_t points; // bits of the rows that hold points
    double rod;     // length of a distance joint, m; else 0
} fe__tree_rows;

// A light tree is solved from the substep on in which it opens, but left to the sweep where it was open before
typedef enum fe__tree_state { FE__TREE_READY, FE__TREE_SOLVED, FE__TREE_SWEPT } fe__tree_state;

typedef struct fe__tree_node {
    _Alignas(64) fe__tree_rows rows;          // locks, then damping
    int32_t locks;                            // rows of locks
    int32_t weighed;                          // 1: masses are there
    fe__tree_state state;                     // of the first node
    double mass[6][6];                        // P, then L below the diagonal and 1 / L_kk on it
    double inverse_inertia[6];                // xx xy xz yy yz zz
    double inertia;                           // about the heaviest of the world's axes that are not locked, kg m2
    double tension, expected, damping;        // see damping.c
    double least[FE__TREE_ROWS];              // of a row's response that counts
    double reach[FE__TREE_ROWS][6];           // columns of Y
    double own[FE__TREE_ROWS][FE__TREE_ROWS]; // C, as L
    double hold[FE__TREE_ROWS][6];            // H
    double request[FE__TREE_ROWS], load[6];   // what a row lacks, then e; f, then L^-1 f
    double impulse[FE__TREE_ROWS], change[6]; // l, u
} fe__tree_node;

typedef struct fe__tree_job {
    fe__solver *solver;
    const fe__lock_lanes *lanes;
    const fe__tree_link *links;
    const fe__tree_place *places;
    int32_t count; // links
    int32_t heavy;
    unsigned char *rows; // of the batch
    fe__tree_node *nodes;
    double h;    // of the substep, s
    double rate; // share of a gap that a soft lock closes in a substep
} fe__tree_job;

static inline fe__tree_node *fe__tree_parent(const fe__tree_job *t, int32_t i)
{
    return t->links[i].parent < 0 ? NULL : t->nodes + t->links[i].parent;
}
static inline const fe__velocity_line *fe__tree_below(const fe__tree_job *t, int32_t i)
{
    return t->solver->velocity + t->places[i].line;
}
static inline const fe__velocity_line *fe__tree_above(const fe__tree_job *t, int32_t i)
{
    return t->solver->velocity + t->places[i].parent_line;
}

static inline fe_dvec3 fe__tree_vector(const double *a) { return (fe_dvec3){a[0], a[1], a[2]}; }
static inline fe_dvec3 fe__tree_unit(int k) { return (fe_dvec3){k == 0, k == 1, k == 2}; }

// w += I^-1 l
static inline void fe__tree_add_spin(float w[3], const double i[6], fe_dvec3 l)
{
    w[0] = (float)((double)w[0] + (i[0] * l.x + i[1] * l.y + i[2] * l.z));
    w[1] = (float)((double)w[1] + (i[1] * l.x + i[3] * l.y + i[4] * l.z));
    w[2] = (float)((double)w[2] + (i[2] * l.x + i[4] * l.y + i[5] * l.z));
}

#endif
