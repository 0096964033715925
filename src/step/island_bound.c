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
    for (int32_t i = 1; i < w->pair_limit; ++i) {
        const fe__pair *p = w->pairs + i;
        if (p->flags & FE__PAIR_FREE) continue;
        join(w, p->body_a, p->body_b, 1); // patches are records too
    }
    join_joints(w);
    join_candidates(step);
    c->made = c->all;
}

// What parts stays together in them. So they are made anew, once somebody asks, when an eighth as many as there are
// records of pairs has been joined since: a step that joins n pairs walks 8 n records on average.
static int32_t may_have_parted(const fe_world *w) { return w->clusters.all - w->clusters.made > w->pair_limit / 8; }

void fe__count_candidates(fe__step *step)
{
    fe__clusters *c = &step->world->clusters;
    if (c->body_count < step->world->body_capacity || may_have_parted(step->world)) c->is_stale = 1;
    if (!c->is_stale) join_candidates(step);
}

// 0: no memory
static int32_t renew(fe__step *step)
{
    fe_world *w = step->world;
    if (!w->clusters.is_stale) return 1;
    if (!fe__clusters_reserve(&w->clusters, &w->memory, w->body_capacity)) return 0;
    make_anew(step);
    return 1;
}

// ---- what may wake -------------------------------------------------------------------------------------------------
static int32_t is_asleep(const fe__body *body) { return body->awake_index < 0 && body->type == FE_BODY_DYNAMIC; }

// The sleeping body of the n-th pair by which something may wake: candidates first. -1: none
static int32_t sleeper_of(const fe__step *step, int32_t n)
{
    const fe_world *w = step->world;
    const fe__step_scratch *s = step->scratch;
    int32_t a, b;
    if (n < s->candidate_count) {
        a = w->shapes[s->candidates[n].shape_a].body, b = w->shapes[s->candidates[n].shape_b].body;
    } else {
        const fe__contact *m = w->contacts + fe__pair_of(w->awake_pairs[n - s->candidate_count]);
        if (m->colour >= 0) return -1;
        a = m->body_a, b = m->body_b;
    }
    return is_asleep(w->bodies + a) ? a : is_asleep(w->bodies + b) ? b : -1;
}

static int32_t waking_pairs(const fe__step *step)
{
    return step->scratch->candidate_count + step->world->awake_pair_count;
}

int32_t fe__bound_waking(fe__step *step, int32_t *out_lanes, int32_t *out_clusters)
{
    fe_world *w = step->world;
    fe__clusters *c = &w->clusters;
    *out_lanes = *out_clusters = 0;
    if (w->awake_body_count == w->body_count - w->static_count) return 1;
    int32_t n = 0, end = waking_pairs(step);
    while (n < end && sleeper_of(step, n) < 0) ++n;
    if (n == end) return 1;
    if (!renew(step)) return 0;
    fe__clusters_ask(c);
    for (; n < end; ++n) {
        int32_t body = sleeper_of(step, n);
        if (body >= 0) *out_clusters += fe__clusters_add(c, body, out_lanes);
    }
    return 1;
}

int32_t fe__bound_islands(fe__step *step, fe__graph_bound *bound)
{
    fe_world *w = step->world;
    if (fe__graph_has_rows(&w->solver, w->kernels, bound, w->workers.count)) return 1;
    if (!renew(step)) return 0;
    bound->largest = w->clusters.most;
    return 1;
}
