// clusters.h - which bodies may be in one island in the next step, and may wake together. So a step reserves rows for
// its clusters, and not as if all bodies were one island.
//
// Disjoint sets of bodies, joined by every pair there is, touching or not, by candidates and by joints. They only grow
// together; now and then they are reset and joined by what is left (step/reserve.c).
#ifndef FE_WORLD_CLUSTERS_H
#define FE_WORLD_CLUSTERS_H
#include "core/memory.h"

typedef struct fe__clusters {
    int32_t *parent;                 // by body: another of its cluster, itself at the root
    int32_t *lanes;                  // by root: contacts and parts of joints
    int64_t *last_sum;               // by root: number of the sum that the cluster was added to last
    int32_t capacity[3], body_count; // capacities of the arrays; how many bodies have a place in all three
    int32_t largest;                 // lanes of the largest cluster
    int32_t lane_count;              // lanes of all clusters
    int32_t lanes_when_reset;        // lane_count when they were last joined anew
    int64_t sum;                     // number of the sum under way: a caller begins one by ++sum
    int32_t is_stale;                // 1: something was joined that is not in them, or too much may have parted
} fe__clusters;

int32_t fe__clusters_reserve(fe__clusters *clusters, fe__memory *memory, int32_t bodies); // 0: no memory
void fe__clusters_reset(fe__clusters *clusters); // each body is a cluster without lanes
// Makes one cluster of two; `lanes` belong to what joins them.
void fe__clusters_join(fe__clusters *clusters, int32_t body_a, int32_t body_b, int32_t lanes);
// Adds the lanes of a body's cluster to *sum, unless the sum under way has them. 1: added
int32_t fe__clusters_add(fe__clusters *clusters, int32_t body, int32_t *sum);
void fe__clusters_free(fe__clusters *clusters, fe__memory *memory);

#endif
