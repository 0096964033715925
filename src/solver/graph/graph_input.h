// graph_input.h - what a graph is built of, and what it may need at most.
#ifndef FE_SOLVER_GRAPH_GRAPH_INPUT_H
#define FE_SOLVER_GRAPH_GRAPH_INPUT_H
#include "solver/solver.h"

typedef struct fe__graph_input {
    fe__body *bodies;
    const fe__contact *contacts;
    const fe__points *points;
    const uint64_t *serials;     // of the pairs, two for each record of points: orders overflowing contacts
    const int32_t *awake_bodies; // dynamic and kinematic; bodies[awake_bodies[i]].awake_index == i
    int32_t body_count;
    const int32_t *awake_contacts; // linked or not: colour -1 is not
    int32_t contact_count;
    const fe__joints *joints;    // NULL: none
    const int32_t *awake_joints; // a dynamic end is awake; linked or not
    int32_t joint_count;
} fe__graph_input;

// What a graph of so many bodies and contacts may need at most
typedef struct fe__graph_bound {
    int32_t bodies, contacts;
    int32_t kinematic;                    // of the bodies, at most
    int32_t fresh;                        // of them, those that the last graph does not have
    int32_t pair_colours, static_colours; // the colours of these are among the first so many
    int32_t crowded;                      // of these, contacts of bodies that may run out of colours
    int32_t largest;                      // contacts and parts of joints of the largest island
    int32_t fast, fast_kinematic;         // bodies that leave a trail; 1: kinematic ones do
    uint32_t kinds;                       // of rows in use: 1 << FE__ROW_*
    int32_t special;                      // 1: special rows are among them
    const fe__joints *joint_set;          // NULL: none
    int32_t joints;                       // of them, awake or about to wake, at most
} fe__graph_bound;

#endif
