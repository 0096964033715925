// clusters.c - see clusters.h. Input: pairs, joints and candidates of the step; output: a bound for the largest island (reserve.c).
#include "solver/graph/graph.h"
#include "step/step.h"

void fe__clusters_free(fe__clusters *clusters, fe__memory *memory)
{
    FE_FREE(memory, clusters->parent, clusters->capacity[0]);
    FE_FREE(memory, clusters->lanes, clusters->capacity[1]);
}

static int32_t root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]]; // path halving
    return i;
}

// Two bodies, of which at least one is dynamic, get so many lanes in common
static void join(fe_world *w, int32_t a, int32_t b, int32_t lanes)
{
    fe__clusters *c = &w->clusters;
    int32_t dynamic_a = w->bodies[a].type == FE_BODY_DYNAMIC, dynamic_b = w->bodies[b].type == FE_BODY_DYNAMIC;
    int32_t x = root_of(c->parent, dynamic_a ? a : b), y = root_of(c->parent, dynamic_b ? b : a);
    if (c->lanes[x] < c->lanes[y]) {
        int32_t larger = y;
        y = x, x = larger;
    }
    c->parent[y] = x;
    c->lanes[x] += (x == y ? 0 : c->lanes[y]) + lanes;
    c->most = fe__maxi(c->most, c->lanes[x]);
}

static void join_shapes(fe_world *w, int32_t shape_a, int32_t shape_b)
{
    join(w, w->shapes[shape_a].body, w->shapes[shape_b].body, fe__is_field_pair(w, shape_a, shape_b) ? FE__PATCHES : 1);
}

static void join_candidates(const fe__step *step)
{
    const fe__step_scratch *s = step->scratch;
    for (int32_t i = 0; i < s->candidate_count; ++i) join_shapes(step->world, s->candidates[i].shape_a, s->candidates[i].shape_b);
    step->world->clusters.has_grown |= s->candidate_count > 0;
}

static void join_joints(fe_world *w)
{
    for (int32_t joint = w->first_joint; joint; joint = w->joint_records[joint].order_next) {
        const fe__joint *j = w->joints.joints + joint;
        if (j->colour >= 0) join(w, j->body_a, j->body_b, __builtin_popcount(j->rows & ((1u << FE__PARTS) - 1u)));
    }
}

static void make_anew(fe__step *step)
{
    fe_world *w = step->world;
    fe__clusters *c = &w->clusters;
    for (int32_t i = 0; i < c->capacity[0]; ++i) c->parent[i] = i, c->lanes[i] = 0;
    c->most = c->is_stale = c->has_grown = 0;
    for (int32_t i = 0; i < w->pair_set.capacity; ++i) {
        if (w->pair_set.entries[i].key == 0) continue;
        const fe__pair *p = w->pairs + w->pair_set.entries[i].value;
        join_shapes(w, p->shape_a, p->shape_b);
    }
    join_joints(w);
    join_candidates(step);
    c->has_grown = 0;
}

int32_t fe__find_clusters(fe__step *step, fe__graph_bound *bound)
{
    fe_world *w = step->world;
    fe__clusters *c = &w->clusters;
    if (fe__graph_has_rows(&w->solver, w->kernels, bound, w->workers.count)) {
        c->is_stale |= step->scratch->candidate_count > 0; // nobody asks, nobody counts
        return 1;
    }
    if (c->capacity[0] < w->body_capacity) c->is_stale = 1;
    if (!FE_RESERVE(&w->memory, c->parent, c->capacity[0], w->body_capacity) ||
        !FE_RESERVE(&w->memory, c->lanes, c->capacity[1], w->body_capacity))
        return 0;
    if (!c->is_stale) join_candidates(step);
    bound->largest = c->most;
    if (c->is_stale || (c->has_grown && !fe__graph_has_rows(&w->solver, w->kernels, bound, w->workers.count))) make_anew(step);
    bound->largest = c->most;
    return 1;
}
