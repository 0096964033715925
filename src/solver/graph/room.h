// room.h - memory for a graph, reserved before it is built.
#ifndef FE_SOLVER_GRAPH_ROOM_H
#define FE_SOLVER_GRAPH_ROOM_H
#include "solver/solver.h"

// What a graph of so many bodies and contacts may need at most
typedef struct fe__graph_bound {
    int32_t bodies, contacts;
    int32_t most_contacts;        // of one body, linked or not
    int32_t crowded;              // contacts of bodies with more than fit the colours
    int32_t largest;              // contacts and parts of joints of the largest island
    int32_t fast, fast_kinematic; // bodies that leave a trail; 1: kinematic ones do
    uint32_t kinds;               // of rows in use: 1 << FE__ROW_*
    int32_t special;              // 1: special rows are among them
    const fe__joints *joint_set;  // NULL: none
    int32_t joints;               // of them, awake or about to wake, at most
} fe__graph_bound;

// 1: there are rows already for any such graph, whatever its islands
int32_t fe__graph_has_rows(const fe__solver *s, const fe__kernels *kernels, const fe__graph_bound *bound, int32_t workers);
// Room for every graph within the bound. 0: no memory, nothing changed but capacities.
int32_t fe__graph_reserve(fe__solver *s, fe__memory *memory, const fe__kernels *kernels, const fe__graph_bound *bound, int32_t workers);
void fe__solver_destroy(fe__solver *s, fe__memory *memory);

#endif
