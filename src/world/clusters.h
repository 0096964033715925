// clusters.h - which bodies may be in one island in the next step: so many rows are reserved, not as many as if all
// were one.
//
// Disjoint sets of bodies, joined by every pair there is, touching or not, by candidates and joints. They only grow
// together; made anew from what is left when room would run out.
#ifndef FE_WORLD_CLUSTERS_H
#define FE_WORLD_CLUSTERS_H
#include "core/memory.h"

typedef struct fe__clusters {
    int32_t *parent; // by body: another of its cluster, itself at the root
    int32_t *lanes;  // by root: contacts and parts of joints
    int32_t capacity[2], body_count; // of both arrays; how many bodies have a place in both
    int32_t most;      // lanes of one cluster
    int32_t is_stale;  // 1: something was joined that is not in them
    int32_t has_grown; // 1: candidates came since they were made
} fe__clusters;

int32_t fe__clusters_reserve(fe__clusters *clusters, fe__memory *memory, int32_t bodies); // 0: no memory
void fe__clusters_part(fe__clusters *clusters); // each body is one, without lanes
void fe__clusters_join(fe__clusters *clusters, int32_t body_a, int32_t body_b,
                       int32_t lanes); // which come with what joins them
void fe__clusters_free(fe__clusters *clusters, fe__memory *memory);

#endif
