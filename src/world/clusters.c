// clusters.c - disjoint sets by union of the smaller with the larger, and path compression (fe__root_of).
#include "world/clusters.h"

#include "core/sort.h"
#include "core/math.h"

int32_t fe__clusters_reserve(fe__clusters *c, fe__memory *memory, int32_t bodies)
{
    if (!FE_RESERVE(memory, c->parent, c->capacity[0], bodies) ||
        !FE_RESERVE(memory, c->lanes, c->capacity[1], bodies) ||
        !FE_RESERVE(memory, c->last_sum, c->capacity[2], bodies))
        return 0;
    c->body_count = bodies;
    return 1;
}

void fe__clusters_reset(fe__clusters *c)
{
    for (int32_t i = 0; i < c->body_count; ++i) c->parent[i] = i, c->lanes[i] = 0;
    c->largest = c->lane_count = c->lanes_when_reset = c->is_stale = 0;
}

void fe__clusters_join(fe__clusters *c, int32_t a, int32_t b, int32_t lanes)
{
    int32_t x = fe__root_of(c->parent, a), y = fe__root_of(c->parent, b);
    if (c->lanes[x] < c->lanes[y]) {
        int32_t larger = y;
        y = x, x = larger;
    }
    c->parent[y] = x;
    c->lanes[x] += (x == y ? 0 : c->lanes[y]) + lanes;
    c->largest = fe__maxi(c->largest, c->lanes[x]);
    c->lane_count += lanes;
}

int32_t fe__clusters_add(fe__clusters *c, int32_t body, int32_t *sum)
{
    int32_t root = fe__root_of(c->parent, body);
    if (c->last_sum[root] == c->sum) return 0;
    c->last_sum[root] = c->sum;
    *sum += c->lanes[root];
    return 1;
}

void fe__clusters_free(fe__clusters *clusters, fe__memory *memory)
{
    FE_FREE(memory, clusters->parent, clusters->capacity[0]);
    FE_FREE(memory, clusters->lanes, clusters->capacity[1]);
    FE_FREE(memory, clusters->last_sum, clusters->capacity[2]);
}
