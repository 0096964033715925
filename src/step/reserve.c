// reserve.c - all memory that a step can need, before it changes anything.
//
// The bounds follow from what is awake, what may wake, and the candidates just found. When one allocation fails, the
// step fails with the world as it was; later stages cannot fail, so that no contact and no event is ever dropped.
#include "step/stages.h"

#include "solver/graph/graph.h"
#include "step/narrowphase.h"
#include "world/contact.h"
#include "world/contact_creation.h"
#include "world/joint.h"
#include "world/joint_creation.h"
#include "world/proxies.h"
#include "world/world_memory.h"

#include <string.h>

// ---- island bound ---------------------------------------------------------------------------------------------------
// How large the largest island of a step may be, at most, and how much of what sleeps may wake in it.

// Before the other two: clusters that are not stale know the candidates
void fe__count_candidates(fe__step *step);
// Waking spreads by pairs and joints: contacts and joints' rows of all clusters with a sleeping body that a candidate,
// or a pair that does not touch yet, has in common with one that is awake. 0: no memory
int32_t fe__bound_waking(fe__step *step, int32_t *out_lanes, int32_t *out_clusters);
int32_t fe__bound_islands(fe__step *step, fe__graph_bound *bound); // sets bound->largest

// ---- reserve --------------------------------------------------------------------------------------------------------

// ---- contacts to come ----------------------------------------------------------------------------------------------
// Bodies of the n-th contact that may be linked: candidates first, then pairs that just ceased to wait
static int32_t is_field_candidate(const fe__step *step, int32_t n)
{
    const fe__candidate *c = step->scratch->candidates + n;
    return n < step->scratch->candidate_count && fe__is_field_pair(step->world, c->shape_a, c->shape_b);
}

static void bodies_of(const fe__step *step, int32_t n, fe__body *out[2])
{
    const fe_world *w = step->world;
    const fe__step_scratch *s = step->scratch;
    if (n < s->candidate_count) {
        out[0] = w->bodies + w->shapes[s->candidates[n].shape_a].body;
        out[1] = w->bodies + w->shapes[s->candidates[n].shape_b].body;
        return;
    }
    // the pair's record would say the same, but only the contact was read of late
    const fe__contact *m = w->contacts + s->busy[n - s->candidate_count];
    out[0] = w->bodies + m->body_a, out[1] = w->bodies + m->body_b;
}

// What is counted of the bodies comes from memory while those before them are counted
FE_FETCHES fetch_bodies(const fe__step *step, int32_t n)
{
    enum { AHEAD = 12 };
    const fe__step_scratch *s = step->scratch;
    int32_t due = n + AHEAD - s->candidate_count;
    if (due < 0 || due >= atomic_load_explicit(&s->due_count, memory_order_relaxed)) return;
    const fe__contact *m = step->world->contacts + s->busy[due];
    __builtin_prefetch(&step->world->bodies[m->body_a].coming_contacts);
    __builtin_prefetch(&step->world->bodies[m->body_b].coming_contacts);
}

static int32_t to_come(const fe__step *step)
{
    return step->scratch->candidate_count + atomic_load(&step->scratch->due_count);
}

// Counts the awake pairs with triggers that do not wait; 0 where they are few, which is not worth a walk.
static int32_t count_sensors(const fe_world *w)
{
    enum { FEW = 16 };
    int32_t count = 0, many = w->trigger_pair_count > w->awake_pair_count / FEW;
    for (int32_t i = 0; i < w->awake_pair_count && many; ++i)
        count += w->awake_pairs[i] >= 0 && w->pairs[w->awake_pairs[i]].flags & FE__PAIR_SENSOR;
    return count;
}

static int32_t is_sensor(const fe_world *w, const fe__candidate *c)
{
    return ((w->shapes[c->shape_a].flags | w->shapes[c->shape_b].flags) & FE__SHAPE_TRIGGER) != 0;
}

static void expect(const fe__step *step, fe__graph_bound *b)
{
    fe__step_scratch *s = step->scratch;
    s->candidate_patches = 0;
    s->sensors = count_sensors(step->world);
    for (int32_t n = 0; n < to_come(step); ++n) {
        fe__body *body[2];
        fetch_bodies(step, n);
        bodies_of(step, n, body);
        int32_t patches = is_field_candidate(step, n) ? FE__PATCHES : 1;
        body[0]->coming_contacts += patches, body[1]->coming_contacts += patches;
        s->candidate_patches += patches - 1;
        if (n >= s->candidate_count) continue;
        s->sensors += is_sensor(step->world, s->candidates + n);
        b->kinds |= 1u << fe__pair_kind(step->world, s->candidates[n].shape_a, s->candidates[n].shape_b);
    }
}

static void forget_expected(const fe__step *step)
{
    for (int32_t n = 0; n < to_come(step); ++n) {
        fe__body *body[2];
        bodies_of(step, n, body);
        body[0]->coming_contacts = body[1]->coming_contacts = 0;
    }
}

// Of the dynamic bodies that a step may move: the most pairs of one, and those of all that may run out of colours
typedef struct neighbours {
    int32_t most, crowded;
} neighbours;

static void count_neighbours(const fe__body *body, neighbours *n)
{
    enum { COLOURS_FOR_ALL = FE__STATIC_COLOURS < FE__PAIR_COLOURS / 2 ? FE__STATIC_COLOURS : FE__PAIR_COLOURS / 2 };
    int32_t pairs = body->contact_count + body->coming_contacts;
    if (body->type != FE_BODY_DYNAMIC) return;
    n->most = fe__maxi(n->most, pairs);
    if (pairs > COLOURS_FOR_ALL) n->crowded += pairs;
}

static neighbours find_neighbours(const fe_world *w, int32_t all)
{
    neighbours n = {0, 0};
    for (int32_t i = all ? w->first_body : -1; i >= 0; i = w->bodies[i].order_next) count_neighbours(w->bodies + i, &n);
    for (int32_t i = 0; i < w->awake_body_count && !all; ++i) count_neighbours(w->bodies + w->awake_bodies[i], &n);
    return n;
}

// Colours of a body when `others` have come to those it has, at most
static int32_t colours_then(const fe__body *body, int32_t others)
{
    int32_t pairs = body->contact_count;
    return others >= pairs ? pairs : fe__mini(fe__colours_of(body) + others, pairs);
}

// Colours that the contacts to come may find, `others` among them that are in no list of those to come. The first free
// colour of two bodies comes after no more than theirs and those of all that may come to them, but for the contact
// itself, which is counted once for each of its dynamic bodies; it or its mate is taken. A body has no more than pairs
static void bound_colours(const fe__step *step, int32_t others, int32_t all, fe__graph_bound *b)
{
    enum { MOST_OF_PAIR = FE__PAIR_COLOURS + 1, MOST_OF_STATIC = FE__STATIC_COLOURS };
    const fe_world *w = step->world;
    neighbours of_all = others ? find_neighbours(w, all) : (neighbours){0, 0};
    int32_t pairs = 2 * of_all.most, statics = of_all.most;
    for (int32_t n = 0; n < to_come(step); ++n) {
        fe__body *body[2];
        bodies_of(step, n, body);
        int32_t found = 0, of_pair = 1;
        for (int k = 0; k < 2; ++k) {
            if (body[k]->type == FE_BODY_DYNAMIC)
                found += body[k]->coming_contacts + colours_then(body[k], others);
            else
                of_pair = 0;
        }
        if (of_pair) pairs = fe__maxi(pairs, found);
        if (!of_pair) statics = fe__maxi(statics, found);
        b->crowded +=
            (found > (of_pair ? MOST_OF_PAIR : MOST_OF_STATIC)) * (is_field_candidate(step, n) ? FE__PATCHES : 1);
    }
    if (pairs > MOST_OF_PAIR || statics > MOST_OF_STATIC) b->crowded += fe__mini(others, of_all.crowded);
    b->pair_colours = fe__mini(fe__maxi(pairs, w->pair_colours), FE__PAIR_COLOURS);
    b->static_colours = fe__mini(fe__maxi(statics, w->static_colours), FE__STATIC_COLOURS);
}

// Patches count with their heads, linked ones by themselves: those of all heads are to be added, and may make up for it
static int32_t unlinked_sleepers(const fe_world *w)
{
    return w->pair_count - w->awake_pair_count - (w->linked_count - w->awake_linked_count);
}

// Contacts that may be linked or woken in this step
static void bound_fresh(const fe__step *step, int32_t asleep, fe__graph_bound *b)
{
    const fe_world *w = step->world;
    const fe__step_scratch *s = step->scratch;
    expect(step, b);
    // beside a heightfield none waits, the first step with one included
    int32_t waiting = w->field_pair_count || s->candidate_patches ? 0 : atomic_load(&s->waiting_count);
    int32_t coming = s->candidate_count + s->candidate_patches, busy = w->awake_pair_count - waiting,
            unlinked = busy - w->awake_linked_count, patches = w->field_pair_count * (FE__PATCHES - 1),
            woken = w->solver.unbuilt;
    int32_t others = unlinked - atomic_load(&s->due_count) + asleep + patches;
    b->contacts = busy + asleep + patches + coming - s->sensors;
    step->scratch->points_to_come =
        unlinked + fe__mini(asleep, unlinked_sleepers(w)) + patches + coming; // pairs that may have none yet
    b->fresh = fe__mini(b->contacts, unlinked + asleep + patches + coming + woken - s->sensors);
    bound_colours(step, fe__maxi(others, 0), asleep > 0, b);
    if (w->pair_colours == FE__PAIR_COLOURS || w->static_colours == FE__STATIC_COLOURS) b->crowded += woken + asleep;
    b->crowded = fe__mini(b->crowded, b->fresh);
    forget_expected(step);
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

// Clusters of n lanes in all have n more bodies than clusters, at most, but for joints without rows
static fe__graph_bound bound_of(const fe__step *step, int32_t waking_lanes, int32_t waking_clusters)
{
    const fe_world *w = step->world;
    // patches are no pairs until they are linked and awake
    int32_t all = w->pair_count + w->field_pair_count * (FE__PATCHES - 1),
            asleep = fe__mini(waking_lanes, all - w->awake_pair_count),
            joints = waking_clusters ? w->joint_count : w->awake_joint_count;
    fe__graph_bound b = {0};
    b.bodies = fe__mini(w->body_count, w->awake_body_count + waking_lanes + waking_clusters + joints);
    b.kinematic = w->kinematic_count;
    b.kinds = w->row_kinds;
    bound_fresh(step, asleep, &b);
    b.special = b.kinds >> FE__ROW_SPECIAL != 0;
    b.joint_set = &w->joints;
    b.joints = joints;
    b.largest = INT32_MAX;
    count_fast(step, &b);
    return b;
}

// The contacts of the bound, and the pairs that get no row
static int32_t pairs_of(const fe__step *step, const fe__graph_bound *b) { return b->contacts + step->scratch->sensors; }

// What is sorted, or left its box, lies where the rows do
static int32_t reserve_rooms(const fe__step *step, const fe__graph_bound *b)
{
    fe_world *w = step->world;
    int64_t sorted = fe__maxi(fe__maxi(pairs_of(step, b), step->scratch->candidate_count), w->body_count);
    sorted += w->owed_count + w->joint_count + w->encounter_count;
    int64_t bytes = fe__maxl(2 * sorted * (int64_t)sizeof(fe__sort_item), w->shape_count * (int64_t)sizeof(fe__bounds));
    // at least one, so that an empty stretch has an address too
    return FE_RENEW(w->step_memory, w->solver.rows, w->solver.row_capacity, 1 + bytes / (int64_t)sizeof(fe__row_block));
}

static int32_t reserve_scratch(fe__step *step, const fe__graph_bound *b)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    fe__memory *memory = w->step_memory, *kept = &w->memory;
    const int64_t pairs = pairs_of(step, b);
    return FE_RENEW(memory, s->results, s->result_capacity, pairs + 1) &&
           // a body that leaps ends all waiting within the step
           FE_RESERVE(memory, s->busy, s->busy_capacity, pairs + atomic_load(&s->waiting_count) + 1) &&
           FE_RENEW(memory, s->left, s->left_capacity, w->shape_count) &&
           FE_RENEW(memory, s->chased, s->chased_capacity, (int64_t)2 * b->bodies) &&
           FE_RENEW(memory, s->chases, s->chase_capacity, w->has_bullets ? b->bodies : 0) &&
           FE_RENEW(memory, s->island_timers, s->island_capacity, b->bodies) &&
           FE_RESERVE(kept, w->pair_events, w->pair_event_capacity, pairs + w->owed_count + w->encounter_count) &&
           FE_RESERVE(kept, w->body_events, w->body_event_capacity, w->body_count) &&
           FE_RESERVE(kept, w->hit_events, w->hit_event_capacity, w->wants_hits ? b->contacts : 0) &&
           FE_RESERVE(kept, w->joint_events, w->joint_event_capacity, w->breakable_count);
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

static int32_t reserve_all(fe__step *step)
{
    fe_world *w = step->world;
    if (!fe__find_joint_trees(w)) return 0;
    int32_t lanes, clusters;
    fe__count_candidates(step);
    if (!fe__bound_waking(step, &lanes, &clusters)) return 0;
    fe__graph_bound bound = bound_of(step, lanes, clusters);
    if (!fe__reserve_pairs(w, step->scratch->candidate_count + step->scratch->candidate_patches) ||
        !fe__points_reserve(w, step->scratch->points_to_come, bound.special) || !reserve_rooms(step, &bound) ||
        !reserve_scratch(step, &bound))
        return 0;
    return (bound.bodies == 0 ||
            (fe__bound_islands(step, &bound) &&
             fe__graph_reserve(&w->solver, w->step_memory, w->kernels, &bound, w->workers.count))) &&
           renew_trees(w);
}

// Whether a world has extras is part of its state: the first ones go again with a step that fails
int32_t fe__reserve_step(fe__step *step)
{
    fe_world *w = step->world;
    int32_t had_extras = w->extra_capacity > 0, is_done = reserve_all(step);
    if (!is_done && !had_extras) FE_FREE(&w->memory, w->extras, w->extra_capacity);
    return is_done;
}

// ---- island bound ---------------------------------------------------------------------------------------------------
// See stages.h. Input: pairs, joints and candidates of the step; output: the clusters that they
// join (clusters.h).

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

// ---- due ------------------------------------------------------------------------------------------------------------
// See stages.h. Where the bound of skip_test.h does not decide, the exact test of recycle.simd.c does, and where
// that does not, the narrow phase. Most pairs that it looks at are still apart: they wait on, from where they are now,
// and no row and no points are reserved for them. What was found of them is noted until all memory is there: a step
// that finds none for the others changes nothing. The narrow phase of those that meet comes in its own stage, where
// there is room for what it finds.

enum { PAIRS_IN_BLOCK = 256 };

// ---- what was found, until the step is sure -------------------------------------------------------------------------
// It stands in the members of the deferral that are the contact's, and its place at the end of the busy list, which
// has room for every awake pair: no pair is there twice. `spare` tells whether the contact changes.
static void note(const fe__step *step, int32_t place, const fe__apart *found, int32_t is_anew)
{
    fe__step_scratch *s = step->scratch;
    fe__deferral *d = step->world->deferrals + place;
    d->arm_a = found->slack;
    d->spare[0] = is_anew;
    if (is_anew) fe__copy3(d->normal, found->normal), d->arm_b = found->axis_separation;
    s->busy[s->busy_end - 1 - atomic_fetch_add_explicit(&s->noted_count, 1, memory_order_relaxed)] = place;
}

static void take_note(fe_world *w, int32_t place)
{
    fe__deferral *d = w->deferrals + place;
    const int32_t pair = fe__pair_of(w->awake_pairs[place]);
    const fe__apart found = {d->arm_b, d->arm_a, fe__quad_vector(d->normal)};
    if (d->spare[0]) fe__write_apart(w, pair, &found);
    fe__defer(d, w->odometers, w->bodies, w->contacts + pair, found.slack);
}

static void take_notes_of_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    const fe__step_scratch *s = step->scratch;
    (void)worker;
    for (int32_t i = first; i < end; ++i) take_note(step->world, s->busy[s->busy_end - 1 - i]);
}

void fe__keep_waiting(fe__step *step)
{
    fe__step_scratch *s = step->scratch;
    fe_world *w = step->world;
    int32_t count = atomic_load(&s->noted_count);
    if (!step->failed) fe__parallel_for(&w->workers, count, PAIRS_IN_BLOCK, take_notes_of_block, step);
    for (int32_t i = 0; i < count && step->failed; ++i) {
        const int32_t place = s->busy[s->busy_end - 1 - i];
        fe__deferral_aim(w->deferrals + place, w->contacts + fe__pair_of(w->awake_pairs[place]));
    }
}

// ---- the search -----------------------------------------------------------------------------------------------------
// What left its partner's box is for the collide stage, which ends it
static int32_t waits_on(const fe__step *step, int32_t pair)
{
    const fe_world *w = step->world;
    fe__apart found;
    if (fe__boxes_part(w, w->pairs + pair) || !fe__collide_apart(step, pair, &found)) return 0;
    note(step, w->pairs[pair].awake_index, &found, 1);
    return 1;
}

// Of so many pairs, those that meet in this step, or end: brings them to the front, and returns how many
static int32_t keep_meeting(const fe__step *step, int32_t *pairs, int32_t count)
{
    enum { OWN_AHEAD = 8, NAMED_AHEAD = 3 };
    const fe_world *w = step->world;
    int32_t left = 0;
    for (int32_t i = -OWN_AHEAD; i < count; ++i) {
        if (i + OWN_AHEAD < count) fe__fetch_own(w, pairs[i + OWN_AHEAD]);
        if (i >= -NAMED_AHEAD && i + NAMED_AHEAD < count) fe__fetch_named(w, pairs[i + NAMED_AHEAD]);
        if (i >= 0 && !waits_on(step, pairs[i])) pairs[left++] = pairs[i];
    }
    return left;
}

// Of places in the list of awake pairs, those whose pair may get points in this step: puts the pairs there, and returns
// how many. The others wait until their bodies may have moved by what is left of the gap
static int32_t keep_due(const fe__step *step, int32_t *places, int32_t count)
{
    fe_world *w = step->world;
    int32_t pairs[PAIRS_IN_BLOCK], left = 0;
    uint8_t verdicts[PAIRS_IN_BLOCK];
    float slack[PAIRS_IN_BLOCK];
    for (int32_t i = 0; i < count; ++i) pairs[i] = fe__pair_of(w->awake_pairs[places[i]]);
    w->kernels->recycle(w->contacts, w->points, w->bodies, pairs, count, step->dt, step->fall, verdicts, slack);
    for (int32_t i = 0; i < count; ++i) {
        if (verdicts[i] == FE__STAYS_APART)
            note(step, places[i], &(fe__apart){.slack = slack[i]}, 0);
        else
            places[left++] = pairs[i];
    }
    return left;
}

static void find_in_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    const fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    (void)worker;
    int32_t due[PAIRS_IN_BLOCK], waiting = 0;
    for (int32_t start = first; start < end; start += PAIRS_IN_BLOCK) {
        int32_t stop = fe__mini(end, start + PAIRS_IN_BLOCK), count = 0, left = 0;
        for (int32_t i = start; i < stop; ++i) {
            due[count] = i;
            count += w->awake_pairs[i] < 0;
        }
        waiting += count;
        if (count) left = w->kernels->keep_due(w->deferrals, w->odometers, due, count, step->dt);
        if (left) left = keep_due(step, due, left);
        int32_t looked = left;
        if (left) left = keep_meeting(step, due, left);
        atomic_fetch_add_explicit(&s->apart_count, looked - left, memory_order_relaxed);
        if (!left) continue;
        int32_t at = atomic_fetch_add_explicit(&s->due_count, left, memory_order_relaxed);
        for (int32_t i = 0; i < left; ++i) s->busy[at + i] = due[i];
        waiting -= left;
    }
    atomic_fetch_add_explicit(&s->waiting_count, waiting, memory_order_relaxed);
}

int32_t fe__find_due(fe__step *step)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    atomic_store(&s->due_count, 0);
    atomic_store(&s->waiting_count, 0);
    atomic_store(&s->apart_count, 0);
    atomic_store(&s->noted_count, 0);
    // with heightfields none waits, see update_contacts.c
    if (w->field_pair_count || !atomic_load(&s->some_deferred)) return 1;
    if (!FE_RESERVE(w->step_memory, s->busy, s->busy_capacity, w->awake_pair_count)) return 0;
    s->busy_end = w->awake_pair_count;
    fe__parallel_for(&w->workers, w->awake_pair_count, PAIRS_IN_BLOCK, find_in_block, step);
    return 1;
}
