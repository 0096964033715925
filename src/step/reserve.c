// reserve.c - all memory that a step can need, before it changes anything.
//
// The bounds follow from what is awake, from what may wake, and from the candidates that find_pairs.c just found. When
// an allocation fails, the step fails with the world as it was. Later stages cannot fail, so that no contact and no
// event is ever dropped.
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

// ---- skip test ------------------------------------------------------------------------------------------------------
// Which deferred pairs may get points in this step. Where the bound of skip_test.h does not decide, the exact test of
// recycle.simd.c does, and where that does not, the narrow phase. Most pairs that it looks at are still apart: they are
// deferred anew, from where they are now, and no row and no points are reserved for them. Pairs that meet are listed;
// the narrow phase runs for them once more in its own stage, where there is memory for what it finds.
//
// A deferral is renewed only when all memory is there, so that a step without memory changes nothing. Until then a note
// of it stands in members of the deferral that are copies of the contact's (arm_a, arm_b, normal), with spare[0] = 1
// when the contact is to be written too. The deferral's place is listed from the end of fe__step_scratch.active
// downwards; no pair is in both lists, so that an element for each awake pair is enough.

enum { PAIRS_IN_BLOCK = 256 };

static void note_deferral(const fe__step *step, int32_t place, const fe__apart *found, int32_t writes_contact)
{
    fe__step_scratch *scratch = step->scratch;
    fe__deferral *deferral = step->world->deferrals + place;
    deferral->arm_a = found->slack;
    deferral->spare[0] = writes_contact;
    if (writes_contact) fe__copy3(deferral->normal, found->normal), deferral->arm_b = found->axis_separation;
    int32_t note = atomic_fetch_add_explicit(&scratch->noted_count, 1, memory_order_relaxed);
    scratch->active[scratch->active_end - 1 - note] = place;
}

static void renew_deferrals(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    const fe__step_scratch *scratch = step->scratch;
    fe_world *world = step->world;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        int32_t place = scratch->active[scratch->active_end - 1 - i], pair = fe__pair_of(world->awake_pairs[place]);
        fe__deferral *deferral = world->deferrals + place;
        const fe__apart found = {deferral->arm_b, deferral->arm_a, fe__quad_vector(deferral->normal)};
        if (deferral->spare[0]) fe__write_apart(world, pair, &found);
        fe__defer(deferral, world->odometers, world->bodies, world->contacts + pair, found.slack);
    }
}

void fe__apply_skip_notes(fe__step *step)
{
    fe__step_scratch *scratch = step->scratch;
    fe_world *world = step->world;
    int32_t count = atomic_load(&scratch->noted_count);
    if (!step->failed) fe__parallel_for(&world->workers, count, PAIRS_IN_BLOCK, renew_deferrals, step);
    for (int32_t i = 0; i < count && step->failed; ++i) {
        int32_t place = scratch->active[scratch->active_end - 1 - i], pair = fe__pair_of(world->awake_pairs[place]);
        fe__deferral_aim(world->deferrals + place, world->contacts + pair);
    }
}

// The exact test. Of places in the list of awake pairs it keeps those whose bodies may have closed the gap, puts their
// pairs there instead, and returns their number.
static int32_t keep_moved(const fe__step *step, int32_t *places, int32_t count)
{
    fe_world *world = step->world;
    int32_t pairs[PAIRS_IN_BLOCK], kept = 0;
    uint8_t verdicts[PAIRS_IN_BLOCK];
    float slack[PAIRS_IN_BLOCK];
    for (int32_t i = 0; i < count; ++i) pairs[i] = fe__pair_of(world->awake_pairs[places[i]]);
    world->kernels->recycle(world->contacts, world->points, world->bodies, pairs, count, step->dt, step->fall, verdicts,
                            slack);
    for (int32_t i = 0; i < count; ++i) {
        if (verdicts[i] == FE__STAYS_APART)
            note_deferral(step, places[i], &(fe__apart){.slack = slack[i]}, 0);
        else
            places[kept++] = pairs[i];
    }
    return kept;
}

// The narrow phase. Keeps the pairs that meet in this step, and those whose boxes have parted: the collide stage ends
// them. Returns their number.
static int32_t keep_meeting(const fe__step *step, int32_t *pairs, int32_t count)
{
    enum { OWN_AHEAD = 8, NAMED_AHEAD = 3 };
    const fe_world *world = step->world;
    int32_t kept = 0;
    for (int32_t i = -OWN_AHEAD; i < count; ++i) {
        if (i + OWN_AHEAD < count) fe__fetch_own(world, pairs[i + OWN_AHEAD]);
        if (i >= -NAMED_AHEAD && i + NAMED_AHEAD < count) fe__fetch_named(world, pairs[i + NAMED_AHEAD]);
        if (i < 0) continue;
        const fe__pair *pair = world->pairs + pairs[i];
        fe__apart found;
        if (!fe__boxes_part(world, pair) && fe__collide_apart(step, pairs[i], &found))
            note_deferral(step, pair->awake_index, &found, 1);
        else
            pairs[kept++] = pairs[i];
    }
    return kept;
}

static void test_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    const fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    (void)worker;
    int32_t block[PAIRS_IN_BLOCK], deferred = 0;
    for (int32_t start = first; start < end; start += PAIRS_IN_BLOCK) {
        int32_t stop = fe__mini(end, start + PAIRS_IN_BLOCK), count = 0;
        for (int32_t i = start; i < stop; ++i) {
            block[count] = i;
            count += world->awake_pairs[i] < 0;
        }
        deferred += count;
        if (count) count = world->kernels->keep_due(world->deferrals, world->odometers, block, count, step->dt);
        if (count) count = keep_moved(step, block, count);
        int32_t collided = count;
        if (count) count = keep_meeting(step, block, count);
        atomic_fetch_add_explicit(&scratch->apart_count, collided - count, memory_order_relaxed);
        if (!count) continue;
        int32_t at = atomic_fetch_add_explicit(&scratch->expired_count, count, memory_order_relaxed);
        for (int32_t i = 0; i < count; ++i) scratch->active[at + i] = block[i];
        deferred -= count;
    }
    atomic_fetch_add_explicit(&scratch->deferred_count, deferred, memory_order_relaxed);
}

int32_t fe__find_expired(fe__step *step)
{
    fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    atomic_store(&scratch->expired_count, 0);
    atomic_store(&scratch->deferred_count, 0);
    atomic_store(&scratch->apart_count, 0);
    atomic_store(&scratch->noted_count, 0);
    // beside heightfields no pair is deferred, see update_contacts.c
    if (world->field_pair_count || !atomic_load(&scratch->some_deferred)) return 1;
    if (!FE_RESERVE(world->step_memory, scratch->active, scratch->active_capacity, world->awake_pair_count)) return 0;
    scratch->active_end = world->awake_pair_count;
    fe__parallel_for(&world->workers, world->awake_pair_count, PAIRS_IN_BLOCK, test_block, step);
    return 1;
}

// ---- waking and islands ---------------------------------------------------------------------------------------------
// How much of what sleeps may wake in a step, and how large its largest island may be: clusters (clusters.h) of bodies
// that pairs, candidates and joints join.

// Joins two bodies, of which at least one is dynamic, by so many lanes.
static void join_bodies(fe_world *world, int32_t a, int32_t b, int32_t lanes)
{
    int32_t a_is_dynamic = world->bodies[a].type == FE_BODY_DYNAMIC;
    int32_t b_is_dynamic = world->bodies[b].type == FE_BODY_DYNAMIC;
    fe__clusters_join(&world->clusters, a_is_dynamic ? a : b, b_is_dynamic ? b : a, lanes);
}

static void join_candidates(const fe__step *step)
{
    fe_world *world = step->world;
    for (int32_t i = 0; i < step->scratch->candidate_count; ++i) {
        int32_t a = step->scratch->candidates[i].shape_a, b = step->scratch->candidates[i].shape_b;
        int32_t lanes = fe__is_field_pair(world, a, b) ? FE__PATCHES : 1;
        join_bodies(world, world->shapes[a].body, world->shapes[b].body, lanes);
    }
}

// Joins the clusters anew where they are stale. 0: no memory
static int32_t renew_clusters(fe__step *step)
{
    fe_world *world = step->world;
    fe__clusters *clusters = &world->clusters;
    if (!clusters->is_stale) return 1;
    if (!fe__clusters_reserve(clusters, &world->memory, world->body_capacity)) return 0;
    fe__clusters_reset(clusters);
    for (int32_t i = 1; i < world->pair_limit; ++i) {
        const fe__pair *p = world->pairs + i;
        if (!(p->flags & FE__PAIR_FREE)) join_bodies(world, p->body_a, p->body_b, 1); // patches are records too
    }
    for (int32_t i = world->first_joint; i; i = world->joint_records[i].order_next) {
        const fe__joint *joint = world->joints.joints + i;
        int32_t parts = __builtin_popcount(joint->rows & ((1u << FE__PARTS) - 1u));
        if (joint->colour >= 0) join_bodies(world, joint->body_a, joint->body_b, parts);
    }
    join_candidates(step);
    clusters->lanes_when_reset = clusters->lane_count;
    return 1;
}

static int32_t is_asleep(const fe__body *body) { return body->awake_index < 0 && body->type == FE_BODY_DYNAMIC; }

// Returns the sleeping body of the n-th pair by which something may wake, candidates first. -1: none
static int32_t sleeping_body(const fe__step *step, int32_t n)
{
    const fe_world *world = step->world;
    const fe__step_scratch *scratch = step->scratch;
    int32_t a, b;
    if (n < scratch->candidate_count) {
        a = world->shapes[scratch->candidates[n].shape_a].body, b = world->shapes[scratch->candidates[n].shape_b].body;
    } else {
        const fe__contact *contact = world->contacts + fe__pair_of(world->awake_pairs[n - scratch->candidate_count]);
        if (contact->colour >= 0) return -1;
        a = contact->body_a, b = contact->body_b;
    }
    return is_asleep(world->bodies + a) ? a : is_asleep(world->bodies + b) ? b : -1;
}

// Waking spreads by pairs and joints: bounds the lanes and the number of all clusters with a sleeping body that a
// candidate, or an awake pair without points, has in common with an awake body. 0: no memory
static int32_t bound_waking(fe__step *step, int32_t *out_lanes, int32_t *out_clusters)
{
    fe_world *world = step->world;
    fe__clusters *clusters = &world->clusters;
    *out_lanes = *out_clusters = 0;
    if (world->awake_body_count == world->body_count - world->static_count) return 1;
    int32_t n = 0, end = step->scratch->candidate_count + world->awake_pair_count;
    while (n < end && sleeping_body(step, n) < 0) ++n;
    if (n == end) return 1;
    if (!renew_clusters(step)) return 0;
    ++clusters->sum;
    for (; n < end; ++n) {
        int32_t body = sleeping_body(step, n);
        if (body >= 0) *out_clusters += fe__clusters_add(clusters, body, out_lanes);
    }
    return 1;
}

// ---- contacts to come -----------------------------------------------------------------------------------------------
// The n-th contact that may be linked in this step: candidates first, then pairs whose deferral ends.

static int32_t count_to_come(const fe__step *step)
{
    return step->scratch->candidate_count + atomic_load(&step->scratch->expired_count);
}

static int32_t is_field_candidate(const fe__step *step, int32_t n)
{
    const fe__candidate *c = step->scratch->candidates + n;
    return n < step->scratch->candidate_count && fe__is_field_pair(step->world, c->shape_a, c->shape_b);
}

static void get_bodies(const fe__step *step, int32_t n, fe__body *out[2])
{
    const fe_world *world = step->world;
    const fe__step_scratch *scratch = step->scratch;
    if (n < scratch->candidate_count) {
        out[0] = world->bodies + world->shapes[scratch->candidates[n].shape_a].body;
        out[1] = world->bodies + world->shapes[scratch->candidates[n].shape_b].body;
        return;
    }
    // the pair's record would say the same, but only the contact was read of late
    const fe__contact *contact = world->contacts + scratch->active[n - scratch->candidate_count];
    out[0] = world->bodies + contact->body_a, out[1] = world->bodies + contact->body_b;
}

// Fetches the bodies of a later contact while earlier ones are counted.
FE_FETCHES fetch_bodies(const fe__step *step, int32_t n)
{
    enum { AHEAD = 12 };
    const fe__step_scratch *scratch = step->scratch;
    int32_t expired = n + AHEAD - scratch->candidate_count;
    if (expired < 0 || expired >= atomic_load_explicit(&scratch->expired_count, memory_order_relaxed)) return;
    const fe__contact *contact = step->world->contacts + scratch->active[expired];
    __builtin_prefetch(&step->world->bodies[contact->body_a].coming_contacts);
    __builtin_prefetch(&step->world->bodies[contact->body_b].coming_contacts);
}

// Counts them in fe__body.coming_contacts, and the awake pairs with triggers, which get no row, in fe__step_scratch.
static void count_coming_contacts(const fe__step *step, fe__graph_bound *bound)
{
    enum { FEW = 16 }; // fewer than one in so many pairs: it is not worth a walk to find which are not deferred
    const fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    scratch->candidate_patches = scratch->sensors = 0;
    int32_t many_sensors = world->trigger_pair_count > world->awake_pair_count / FEW;
    for (int32_t i = 0; i < world->awake_pair_count && many_sensors; ++i)
        scratch->sensors += world->awake_pairs[i] >= 0 && world->pairs[world->awake_pairs[i]].flags & FE__PAIR_SENSOR;
    for (int32_t n = 0; n < count_to_come(step); ++n) {
        fe__body *body[2];
        fetch_bodies(step, n);
        get_bodies(step, n, body);
        int32_t patches = is_field_candidate(step, n) ? FE__PATCHES : 1;
        body[0]->coming_contacts += patches, body[1]->coming_contacts += patches;
        scratch->candidate_patches += patches - 1;
        if (n >= scratch->candidate_count) continue;
        int32_t a = scratch->candidates[n].shape_a, b = scratch->candidates[n].shape_b;
        scratch->sensors += ((world->shapes[a].flags | world->shapes[b].flags) & FE__SHAPE_TRIGGER) != 0;
        bound->kinds |= 1u << fe__pair_kind(world, a, b);
    }
}

// The dynamic bodies that a step may move: the most pairs that one has, and the sum of the pairs of all bodies that may
// run out of colours.
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

// Bounds the colours that contacts to come may get. `others` of them are not known by their bodies: any body that may
// move (`all`, or the awake ones) may get them.
//
// A contact gets the first colour that neither of its dynamic bodies has. So the colours that it may need are no more
// than those of both, the contacts that may come to both, and one. Each body's coming contacts hold the contact
// itself, which is counted once too often between two dynamic bodies (hence MOST_OF_PAIR has one more).
static void bound_colours(const fe__step *step, int32_t others, int32_t all, fe__graph_bound *bound)
{
    enum { MOST_OF_PAIR = FE__PAIR_COLOURS + 1, MOST_OF_STATIC = FE__STATIC_COLOURS };
    const fe_world *world = step->world;
    neighbours n = {0, 0};
    if (others && all)
        for (int32_t i = world->first_body; i >= 0; i = world->bodies[i].order_next)
            count_neighbours(world->bodies + i, &n);
    if (others && !all)
        for (int32_t i = 0; i < world->awake_body_count; ++i)
            count_neighbours(world->bodies + world->awake_bodies[i], &n);
    int32_t pairs = 2 * n.most, statics = n.most;
    for (int32_t i = 0; i < count_to_come(step); ++i) {
        fe__body *body[2];
        get_bodies(step, i, body);
        int32_t needed = 0, is_pair = 1;
        for (int k = 0; k < 2; ++k) {
            int32_t contacts = body[k]->contact_count;
            if (body[k]->type != FE_BODY_DYNAMIC)
                is_pair = 0;
            else if (others >= contacts) // a body has no more colours than contacts, whatever the others take
                needed += body[k]->coming_contacts + contacts;
            else
                needed += body[k]->coming_contacts + fe__mini(fe__colours_of(body[k]) + others, contacts);
        }
        if (is_pair) pairs = fe__maxi(pairs, needed);
        if (!is_pair) statics = fe__maxi(statics, needed);
        if (needed > (is_pair ? MOST_OF_PAIR : MOST_OF_STATIC))
            bound->crowded += is_field_candidate(step, i) ? FE__PATCHES : 1;
    }
    if (pairs > MOST_OF_PAIR || statics > MOST_OF_STATIC) bound->crowded += fe__mini(others, n.crowded);
    bound->pair_colours = fe__mini(fe__maxi(pairs, world->pair_colours), FE__PAIR_COLOURS);
    bound->static_colours = fe__mini(fe__maxi(statics, world->static_colours), FE__STATIC_COLOURS);
}

// Bounds the contacts that may be linked or woken in this step; `asleep` pairs may wake.
static void bound_contacts(const fe__step *step, int32_t asleep, fe__graph_bound *bound)
{
    const fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    count_coming_contacts(step, bound);
    // beside a heightfield no pair is deferred, the first step with one included
    int32_t deferred =
        world->field_pair_count || scratch->candidate_patches ? 0 : atomic_load(&scratch->deferred_count);
    int32_t coming = scratch->candidate_count + scratch->candidate_patches, woken = world->solver.unbuilt;
    int32_t active = world->awake_pair_count - deferred, unlinked = active - world->awake_linked_count;
    int32_t patches = world->field_pair_count * (FE__PATCHES - 1);
    // A pair counts once with all its patches, a linked patch by itself. So this may be too few sleeping pairs without
    // points; `patches`, those of all pairs, make up for it.
    int32_t unlinked_asleep =
        world->pair_count - world->awake_pair_count - (world->linked_count - world->awake_linked_count);
    int32_t others = unlinked - atomic_load(&scratch->expired_count) + asleep + patches;
    scratch->points_to_come = unlinked + fe__mini(asleep, unlinked_asleep) + patches + coming;
    bound->contacts = active + asleep + patches + coming - scratch->sensors;
    bound->fresh = fe__mini(bound->contacts, unlinked + asleep + patches + coming + woken - scratch->sensors);
    bound_colours(step, fe__maxi(others, 0), asleep > 0, bound);
    if (world->pair_colours == FE__PAIR_COLOURS || world->static_colours == FE__STATIC_COLOURS)
        bound->crowded += woken + asleep;
    bound->crowded = fe__mini(bound->crowded, bound->fresh);
    for (int32_t n = 0; n < count_to_come(step); ++n) {
        fe__body *body[2];
        get_bodies(step, n, body);
        body[0]->coming_contacts = body[1]->coming_contacts = 0;
    }
}

// ---- reserve --------------------------------------------------------------------------------------------------------

// Bounds what the graph and the solver may need, when clusters of so many lanes may wake.
static fe__graph_bound bound_graph(const fe__step *step, int32_t waking_lanes, int32_t waking_clusters)
{
    const float nearly = 0.999f; // 1 but for rounding: to count too many does no harm
    const fe_world *world = step->world;
    int32_t joints = waking_clusters ? world->joint_count : world->awake_joint_count;
    fe__graph_bound bound = {
        // clusters of n lanes in all have at most n more bodies than there are clusters, but for joints without rows
        .bodies = fe__mini(world->body_count, world->awake_body_count + waking_lanes + waking_clusters + joints),
        .kinematic = world->kinematic_count,
        .kinds = world->row_kinds,
        .joint_set = &world->joints,
        .joints = joints,
        .largest = INT32_MAX};
    // patches are no pairs until they are linked and awake
    int32_t all = world->pair_count + world->field_pair_count * (FE__PATCHES - 1);
    bound_contacts(step, fe__mini(waking_lanes, all - world->awake_pair_count), &bound);
    bound.special = bound.kinds >> FE__ROW_SPECIAL != 0;
    // bodies that leave a trail for the continuous stage, see solve.c; what wakes stands still
    float swiftest;
    int32_t bits = atomic_load(&world->swiftest);
    memcpy(&swiftest, &bits, sizeof swiftest);
    if (swiftest * step->dt < nearly) return bound;
    for (int32_t i = 0; i < world->awake_body_count; ++i) {
        const fe__body *body = world->bodies + world->awake_bodies[i];
        if (body->speed * step->dt < nearly * body->thickness) continue;
        ++bound.fast;
        if (body->type == FE_BODY_KINEMATIC) bound.fast_kinematic = 1;
    }
    return bound;
}

static int32_t reserve_scratch(fe__step *step, const fe__graph_bound *bound)
{
    fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    fe__memory *memory = world->step_memory, *kept = &world->memory;
    const int64_t pairs = bound->contacts + scratch->sensors; // sensors get no row
    // Items to sort, and the boxes of shapes that left theirs, lie where the rows do. At least one block, so that an
    // empty array has an address too.
    int64_t sorted = fe__maxl(fe__maxl(pairs, scratch->candidate_count), world->body_count);
    sorted += world->owed_count + world->joint_count + world->encounter_count;
    int64_t bytes =
        fe__maxl(2 * sorted * (int64_t)sizeof(fe__sort_item), world->shape_count * (int64_t)sizeof(fe__bounds));
    int64_t blocks = 1 + bytes / (int64_t)sizeof(fe__row_block);
    return FE_RENEW(memory, world->solver.rows, world->solver.row_capacity, blocks) &&
           FE_RENEW(memory, scratch->results, scratch->result_capacity, pairs + 1) &&
           // a body that leaps ends all deferrals within the step
           FE_RESERVE(memory, scratch->active, scratch->active_capacity,
                      pairs + atomic_load(&scratch->deferred_count) + 1) &&
           FE_RENEW(memory, scratch->left, scratch->left_capacity, world->shape_count) &&
           FE_RENEW(memory, scratch->swept, scratch->swept_capacity, (int64_t)2 * bound->bodies) &&
           FE_RENEW(memory, scratch->sweep_ends, scratch->sweep_end_capacity, world->has_bullets ? bound->bodies : 0) &&
           FE_RENEW(memory, scratch->island_timers, scratch->island_capacity, bound->bodies) &&
           FE_RESERVE(kept, world->pair_events, world->pair_event_capacity,
                      pairs + world->owed_count + world->encounter_count) &&
           FE_RESERVE(kept, world->body_events, world->body_event_capacity, world->body_count) &&
           FE_RESERVE(kept, world->hit_events, world->hit_event_capacity, world->wants_hits ? bound->contacts : 0) &&
           FE_RESERVE(kept, world->joint_events, world->joint_event_capacity, world->breakable_count);
}

static int32_t reserve_all(fe__step *step)
{
    enum { STEPS_BETWEEN_REBUILDS = 8 };
    fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    if (!fe__find_joint_trees(world)) return 0;
    // Bodies that part stay together in the clusters. So they are joined anew, once a bound needs them, when an eighth
    // as many lanes as there are records of pairs came since: a step that joins n pairs walks 8 n records on average.
    fe__clusters *clusters = &world->clusters;
    if (clusters->body_count < world->body_capacity ||
        clusters->lane_count - clusters->lanes_when_reset > world->pair_limit / 8)
        clusters->is_stale = 1;
    if (!clusters->is_stale) join_candidates(step);
    int32_t waking_lanes, waking_clusters;
    if (!bound_waking(step, &waking_lanes, &waking_clusters)) return 0;
    fe__graph_bound bound = bound_graph(step, waking_lanes, waking_clusters);
    if (!fe__reserve_pairs(world, scratch->candidate_count + scratch->candidate_patches) ||
        !fe__points_reserve(world, scratch->points_to_come, bound.special) || !reserve_scratch(step, &bound))
        return 0;
    if (bound.bodies) {
        if (!fe__graph_has_rows(&world->solver, world->kernels, &bound, world->workers.count)) {
            if (!renew_clusters(step)) return 0;
            bound.largest = clusters->largest;
        }
        if (!fe__graph_reserve(&world->solver, world->step_memory, world->kernels, &bound, world->workers.count))
            return 0;
    }
    // Trees that have degenerated are built anew here, where the step may still fail, and last: nothing of a step that
    // fails shows, nor do trees that could not be built.
    if (world->step_number == 0 || world->step_number % STEPS_BETWEEN_REBUILDS) return 1;
    fe__tree *trees[] = {&world->moving_tree, &world->static_tree};
    return fe__trees_rebuild(trees, 2, &world->memory, 0);
}

int32_t fe__reserve_step(fe__step *step)
{
    fe_world *world = step->world;
    // a snapshot shows whether a world has extras: the first ones go again with a step that fails
    int32_t had_extras = world->extra_capacity > 0, is_done = reserve_all(step);
    if (!is_done && !had_extras) FE_FREE(&world->memory, world->extras, world->extra_capacity);
    return is_done;
}
