// reserve.c - all memory that a step can need, before it changes anything.
//
// The bounds follow from what is awake, what may wake, and the candidates just found. When one allocation fails, the
// step fails with the world as it was; later stages cannot fail, so that no contact and no event is ever dropped.
#include "step/reserve.h"

#include "solver/graph/graph.h"
#include "step/island_bound.h"
#include "world/forest.h"
#include "world/pair_mix.h"
#include "world/pairs.h"

#include <string.h>

// with no more contacts each, two bodies have colours enough for a contact between them
enum { CROWD = FE__STATIC_COLOURS < FE__PAIR_COLOURS / 2 ? FE__STATIC_COLOURS : FE__PAIR_COLOURS / 2 };

// Can anything asleep be touched in this step? Then all of it may wake.
static int32_t may_wake(const fe__step *step)
{
    const fe_world *w = step->world;
    const fe__step_scratch *s = step->scratch;
    if (w->awake_body_count == w->body_count - w->static_count) return 0;
    for (int32_t i = 0; i < s->candidate_count; ++i) {
        const fe__body *a = w->bodies + w->shapes[s->candidates[i].shape_a].body,
                       *b = w->bodies + w->shapes[s->candidates[i].shape_b].body;
        if ((a->awake_index < 0 && a->type == FE_BODY_DYNAMIC) || (b->awake_index < 0 && b->type == FE_BODY_DYNAMIC))
            return 1;
    }
    for (int32_t i = 0; i < w->awake_pair_count; ++i) {
        const fe__contact *m = w->contacts + fe__pair_of(w->awake_pairs[i]);
        const fe__body *a = w->bodies + m->body_a, *b = w->bodies + m->body_b;
        if (m->colour < 0 &&
            ((a->awake_index < 0 && a->type == FE_BODY_DYNAMIC) || (b->awake_index < 0 && b->type == FE_BODY_DYNAMIC)))
            return 1;
    }
    return 0;
}

// contacts of bodies that may run out of colours
static int32_t crowded_contacts(const fe_world *w, int32_t most)
{
    int64_t crowded = 0;
    if (most <= CROWD) return 0;
    for (int32_t i = w->first_body; i >= 0; i = w->bodies[i].order_next) {
        int32_t contacts = w->bodies[i].contact_count + w->bodies[i].coming_contacts;
        if (w->bodies[i].type == FE_BODY_DYNAMIC && contacts > CROWD) crowded += contacts;
    }
    return crowded < INT32_MAX ? (int32_t)crowded : INT32_MAX;
}

// what the candidates add: contacts of one body, kinds of rows
static void add_candidates(const fe__step *step, fe__graph_bound *b)
{
    step->scratch->candidate_patches = 0;
    const fe_world *w = step->world;
    const fe__step_scratch *s = step->scratch;
    for (int32_t i = 0; i < s->candidate_count; ++i) {
        const fe__candidate *c = s->candidates + i;
        const int32_t shapes[2] = {c->shape_a, c->shape_b};
        b->kinds |= 1u << fe__pair_kind(w, c->shape_a, c->shape_b);
        int32_t patches = fe__is_field_pair(w, c->shape_a, c->shape_b) ? FE__PATCHES : 1;
        b->contacts += patches - 1;
        step->scratch->candidate_patches += patches - 1;
        for (int k = 0; k < 2; ++k) {
            fe__body *body = w->bodies + w->shapes[shapes[k]].body;
            body->coming_contacts += patches;
            if (body->type == FE_BODY_DYNAMIC)
                b->most_contacts = fe__maxi(b->most_contacts, body->contact_count + body->coming_contacts);
        }
    }
}

static void forget_candidates(const fe__step *step)
{
    const fe_world *w = step->world;
    for (int32_t i = 0; i < step->scratch->candidate_count; ++i) {
        const fe__candidate *c = step->scratch->candidates + i;
        w->bodies[w->shapes[c->shape_a].body].coming_contacts = w->bodies[w->shapes[c->shape_b].body].coming_contacts =
            0;
    }
}

// Bodies that leave a trail, see solve.c. What wakes stands still
static void count_fast(const fe__step *step, fe__graph_bound *b)
{
    const fe_world *w = step->world;
    const float nearly = 0.999f; // 1 but for rounding: too many do no harm
    float swiftest;
    int32_t bits = atomic_load(&w->swiftest);
    memcpy(&swiftest, &bits, sizeof swiftest);
    if (swiftest * step->dt < nearly) return;
    for (int32_t i = 0; i < w->awake_body_count; ++i) {
        const fe__body *body = w->bodies + w->awake_bodies[i];
        if (body->speed * step->dt < nearly * body->thickness) continue;
        ++b->fast;
        if (body->type == FE_BODY_KINEMATIC) b->fast_kinematic = 1;
    }
}

static fe__graph_bound bound_of(const fe__step *step)
{
    const fe_world *w = step->world;
    int32_t all = may_wake(step);
    fe__graph_bound b = {0};
    b.bodies = all ? w->body_count : w->awake_body_count;
    b.contacts = (all ? w->pair_count : w->awake_pair_count) + step->scratch->candidate_count +
                 w->field_pair_count * (FE__PATCHES - 1);
    b.most_contacts = w->most_contacts;
    b.kinds = w->row_kinds;
    add_candidates(step, &b);
    b.crowded = crowded_contacts(w, b.most_contacts);
    b.special = b.kinds >> FE__ROW_SPECIAL != 0;
    b.joint_set = &w->joints;
    b.joints = all ? w->joint_count : w->awake_joint_count;
    b.largest = INT32_MAX;
    count_fast(step, &b);
    forget_candidates(step);
    return b;
}

static int32_t reserve_scratch(fe__step *step, const fe__graph_bound *b)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    fe__memory *memory = &w->memory;
    // at least one, so that an empty stretch has an address too
    int64_t sorted = 1 + fe__maxi(fe__maxi(b->contacts, step->scratch->candidate_count), w->body_count);
    sorted += w->owed_count + w->joint_count;
    return FE_RENEW(memory, s->results, s->result_capacity, (int64_t)b->contacts + 1) &&
           FE_RESERVE(memory, s->busy, s->busy_capacity, (int64_t)b->contacts + 1) &&
           FE_RENEW(memory, s->left, s->left_capacity, w->shape_count) &&
           FE_RENEW(memory, s->boxes, s->box_capacity, w->shape_count) &&
           FE_RENEW(memory, s->chased, s->chased_capacity, (int64_t)2 * b->bodies) &&
           FE_RENEW(memory, s->chases, s->chase_capacity, w->has_bullets ? b->bodies : 0) &&
           FE_RENEW(memory, s->island_timers, s->island_capacity, b->bodies) &&
           FE_RENEW(memory, s->sort_items, s->sort_capacity, 2 * sorted) &&
           FE_RESERVE(memory, w->pair_events, w->pair_event_capacity, (int64_t)b->contacts + w->owed_count) &&
           FE_RESERVE(memory, w->body_events, w->body_event_capacity, w->body_count) &&
           FE_RESERVE(memory, w->hit_events, w->hit_event_capacity, w->wants_hits ? b->contacts : 0) &&
           FE_RESERVE(memory, w->joint_events, w->joint_event_capacity, w->breakable_count);
}

// Trees that have degenerated are built anew here, where the step may still fail, and last: nothing of a step that
// fails shows, nor do trees that could not be built.
static int32_t renew_trees(fe_world *w)
{
    enum { STEPS_BETWEEN_LOOKS = 8 };
    fe__tree *trees[] = {&w->moving_tree, &w->static_tree};
    if (w->step_number == 0 || w->step_number % STEPS_BETWEEN_LOOKS) return 1;
    return fe__trees_rebuild(trees, 2, &w->memory, 0);
}

int32_t fe__reserve_step(fe__step *step)
{
    fe_world *w = step->world;
    if (!fe__find_joint_trees(w)) return 0;
    fe__graph_bound bound = bound_of(step);
    if (!fe__reserve_pairs(w, step->scratch->candidate_count + step->scratch->candidate_patches) ||
        !reserve_scratch(step, &bound))
        return 0;
    return (bound.bodies == 0 || (fe__bound_islands(step, &bound) &&
                                  fe__graph_reserve(&w->solver, &w->memory, w->kernels, &bound, w->workers.count))) &&
           renew_trees(w);
}
