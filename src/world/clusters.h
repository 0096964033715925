// clusters.h - which bodies may be in one island in the next step, and may wake together: so many rows are reserved,
// not as many as if all bodies were one.
//
// Disjoint sets of bodies, joined by every pair there is, touching or not, by candidates and joints. They only grow
// together; made anew from what is left.
#ifndef FE_WORLD_CLUSTERS_H
#define FE_WORLD_CLUSTERS_H
#include "core/memory.h"

typedef struct fe__clusters {
    int32_t *parent;                 // by body: another of its cluster, itself at the root
    int32_t *lanes;                  // by root: contacts and parts of joints
    int64_t *asked;                  // by root: the sum that it was in last
    int32_t capacity[3], body_count; // of the arrays; how many bodies have a place in all
    int32_t most;                    // lanes of one cluster
    int32_t all;                     // lanes of all
    int32_t made;                    // `all` when they were made
    int64_t sum;                     // number of the sum that is asked for
    int32_t is_stale;                // 1: something was joined that is not in them, or too much may have parted
} fe__clusters;

int32_t fe__clusters_reserve(fe__clusters *clusters, fe__memory *memory, int32_t bodies); // 0: no memory
void fe__clusters_part(fe__clusters *clusters); // each body is one, without lanes
void fe__clusters_join(fe__clusters *clusters, int32_t body_a, int32_t body_b,
                       int32_t lanes);         // which come with what joins them
void fe__clusters_ask(fe__clusters *clusters); // begins a sum
// adds the lanes of a body's cluster, unless this sum has them. 1: added
int32_t fe__clusters_add(fe__clusters *clusters, int32_t body, int32_t *sum);
void fe__clusters_free(fe__clusters *clusters, fe__memory *memory);

#endif
