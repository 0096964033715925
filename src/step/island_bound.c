// island_bound.c - see island_bound.h. Input: pairs, joints and candidates of the step; output: the clusters that they
// join (clusters.h).
#include "step/island_bound.h"

#include "solver/graph/graph.h"
#include "world/pairs.h"

// Two bodies, of which at least one is dynamic, get so many lanes in common
static void join(fe_world *w, int32_t a, int32_t b, int32_t lanes)
{
    int32_t dynamic_a = w->bodies[a].type == FE_BODY_DYNAMIC, dynamic_b = w->bodies[b].type == FE_BODY_DYNAMIC;
    fe__clusters_join(&w->clusters, dynamic_a ? a : b, dynamic_b ? b : a, lanes);
}

static void join_shapes(fe_world *w, int32_t shape_a, int32_t shape_b)
{
    join(w, w->shapes[shape_a].body, w->shapes[shape_b].body, fe__is_field_pair(w, shape_a, shape_b) ? FE__PATCHES : 1);
}

static void join_candidates(const fe__step *step)
{
    const fe__step_scratch *s = step->scratch;
    for (int32_t i = 0; i < s->candidate_count; ++i)
        join_shapes(step->world, s->candidates[i].shape_a, s->candidates[i].shape_b);
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
    fe__clusters_part(c);
    for (int32_t i = 0; i < w->pair_set.capacity; ++i) {
        if (w->pair_set.entries[i].key == 0) continue;
        const fe__pair *p = w->pairs + w->pair_set.entries[i].value;
        join_shapes(w, p->shape_a, p->shape_b);
    }
    join_joints(w);
    join_candidates(step);
    c->has_grown = 0;
}

int32_t fe__bound_islands(fe__step *step, fe__graph_bound *bound)
{
    fe_world *w = step->world;
    fe__clusters *c = &w->clusters;
    if (fe__graph_has_rows(&w->solver, w->kernels, bound, w->workers.count)) {
        c->is_stale |= step->scratch->candidate_count > 0; // nobody asks, nobody counts
        return 1;
    }
    if (c->body_count < w->body_capacity) c->is_stale = 1;
    if (!fe__clusters_reserve(c, &w->memory, w->body_capacity)) return 0;
    if (!c->is_stale) join_candidates(step);
    bound->largest = c->most;
    if (c->is_stale || (c->has_grown && !fe__graph_has_rows(&w->solver, w->kernels, bound, w->workers.count)))
        make_anew(step);
    bound->largest = c->most;
    return 1;
}
