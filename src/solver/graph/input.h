// input.h - what a graph is built from: the awake bodies, the linked contacts and joints.
#ifndef FE_SOLVER_GRAPH_INPUT_H
#define FE_SOLVER_GRAPH_INPUT_H
#include "solver/solver.h"

typedef struct fe__graph_input {
    fe__body *bodies;
    const fe__contact *contacts;
    const uint64_t *serials;     // of the pairs, two a contact: orders overflowing contacts
    const int32_t *awake_bodies; // dynamic and kinematic; bodies[awake_bodies[i]].awake_index == i
    int32_t body_count;
    const int32_t *awake_contacts; // linked or not: colour -1 is not
    int32_t contact_count;
    const fe__joints *joints;    // NULL: none
    const int32_t *awake_joints; // a dynamic end is awake; linked or not
    int32_t joint_count;
} fe__graph_input;

#endif
