// graph.h - which contacts are solved together: islands, batches, colours, rows.
//
// Input: the awake bodies and the linked contacts. Output: batches of lines, groups of lanes in fe__solver. The graph lives on while
// nothing links, unlinks, wakes or sleeps.
#ifndef FE_SOLVER_GRAPH_H
#define FE_SOLVER_GRAPH_H
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
void fe__graph_build(fe__solver *s, const fe__kernels *kernels, const fe__graph_input *input);
void fe__solver_destroy(fe__solver *s, fe__memory *memory);

// All substeps of all batches. The lines then hold what the step did; contacts and joints their impulses.
// `constants`: of each pace.
void fe__solve(fe__solver *s, const fe__kernels *kernels, const fe__workers *workers, fe__body *bodies, fe__contact *contacts,
               fe__extra *extras, const fe__joints *joints, const fe__step_constants constants[FE__PACES]);
// Of an island, by the flags of all its bodies
int32_t fe__pace_of(uint32_t flags, int32_t has_joints);
fe__softness fe__make_softness(float hertz, float damping_ratio, float h);

#endif
