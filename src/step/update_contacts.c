// update_contacts.c - stages 2 and 3: manifolds of the awake pairs, what begins and ends to touch, who wakes; then the
// constraint graph.
//
// A pair that moved little keeps its manifold (recycling, wide); the others go through the narrow phase one by one.
// Workers write the records of their pairs and a list of results. The results are applied afterwards, sorted by
// creation, so that colours and wake-ups follow no thread.
#include "step/stages.h"

#include "solver/graph/graph.h"
#include "step/narrowphase.h"
#include "world/contact.h"
#include "world/encounter.h"
#include "world/contact_creation.h"
#include "world/proxies.h"
#include "world/sleep.h"

enum { PAIRS_IN_BLOCK = 64, PAIRS_IN_CACHE = 256, FETCHED_AHEAD = 24 };

typedef struct collide_job {
    fe__step *step;
    int32_t first; // place in the list of awake pairs where this round begins
} collide_job;

// ---- narrow phase of some pairs -------------------------------------------------------------------------------------

void fe__defer_pair(const fe__step *step, int32_t pair, float slack)
{
    const fe_world *world = step->world;
    const fe__pair *p = world->pairs + pair;
    // a heightfield's pair is asked for more than its gap
    if (p->flags & (FE__PAIR_PATCH | FE__PAIR_MAY_REPORT) || p->next_patch >= 0 || p->awake_index < 0) return;
    fe__defer(world->deferrals + p->awake_index, world->odometers, world->bodies, world->contacts + pair, slack);
    world->awake_pairs[p->awake_index] = ~pair;
    atomic_store_explicit(&step->scratch->some_deferred, 1, memory_order_relaxed);
}

// Says what comes of a pair that was looked at, and lists it if anything does.
static void note_result(fe__step *step, int32_t pair, int32_t changes_sides)
{
    const fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    fe__pair *p = world->pairs + pair;
    int32_t has_points = world->contacts[pair].point_count > 0.0f, result = FE__RESULT_NONE;
    if (has_points) {
        if (!(p->flags & (FE__PAIR_LINKED | FE__PAIR_SENSOR))) result = FE__RESULT_BEGIN;
    } else if (!(p->flags & FE__PAIR_PATCH) && fe__boxes_part(world, p)) {
        result = FE__RESULT_APART;
    } else if (p->flags & FE__PAIR_LINKED) {
        result = FE__RESULT_END;
    } else if (changes_sides) {
        result = FE__RESULT_PASSES;
    }
    p->result = (int16_t)result;
    if (!has_points) fe__defer_pair(step, pair, world->contacts[pair].surface.tolerance);
    if (result != FE__RESULT_NONE)
        scratch->results[atomic_fetch_add_explicit(&scratch->result_count, 1, memory_order_relaxed)] = pair;
}

static void collide_each(fe__step *step, const int32_t *pairs, int32_t count)
{
    enum { OWN_AHEAD = 8, NAMED_AHEAD = 3, HULLS_AHEAD = 2, OF_HULLS_AHEAD = 1 };
    const fe_world *world = step->world;
    for (int32_t i = -OWN_AHEAD; i < count; ++i) {
        if (i + OWN_AHEAD < count) fe__fetch_own(world, pairs[i + OWN_AHEAD]);
        if (i >= -NAMED_AHEAD && i + NAMED_AHEAD < count) fe__fetch_named(world, pairs[i + NAMED_AHEAD]);
        if (i >= -HULLS_AHEAD && i + HULLS_AHEAD < count) fe__fetch_hulls(world, pairs[i + HULLS_AHEAD]);
        if (i >= -OF_HULLS_AHEAD && i + OF_HULLS_AHEAD < count) fe__fetch_of_hulls(world, pairs[i + OF_HULLS_AHEAD]);
        if (i < 0) continue;
        if (world->pairs[pairs[i]].next_patch < 0) {
            note_result(step, pairs[i], fe__collide_pair(step, pairs[i]));
        } else { // the patches of a heightfield or mesh follow their head, on its thread
            fe__collide_field_pair(step, pairs[i]);
            for (int32_t pair = pairs[i]; pair >= 0; pair = world->pairs[pair].next_patch) note_result(step, pair, 0);
        }
    }
}

// ---- worlds with heightfields or meshes -----------------------------------------------------------------------------

// No pair is deferred here. Heads are recycled first; the patches of those that keep their manifold are refreshed.
static void collide_block_with_patches(void *argument, int32_t first, int32_t end, int32_t worker)
{
    enum { PATCHES_IN_BLOCK = PAIRS_IN_BLOCK * (FE__PATCHES - 1) };
    const collide_job *job = argument;
    const fe__step *step = job->step;
    fe_world *world = step->world;
    (void)worker;
    for (int32_t start = first; start < end; start += PAIRS_IN_BLOCK) {
        int32_t heads[PAIRS_IN_BLOCK], patches[PATCHES_IN_BLOCK], head_count = 0, patch_count = 0, moved = 0;
        uint8_t verdicts[PATCHES_IN_BLOCK];
        float slack[PATCHES_IN_BLOCK];
        for (int32_t i = start, stop = fe__mini(end, start + PAIRS_IN_BLOCK); i < stop; ++i) {
            int32_t *entry = world->awake_pairs + job->first + i;
            *entry = fe__pair_of(*entry);
            if (!(world->pairs[*entry].flags & FE__PAIR_PATCH)) heads[head_count++] = *entry;
        }
        if (head_count == 0) continue;
        world->kernels->recycle(world->contacts, world->points, world->bodies, heads, head_count, step->dt, step->fall,
                                verdicts, slack);
        for (int32_t i = 0; i < head_count; ++i) {
            if (verdicts[i] == FE__MOVED) {
                heads[moved++] = heads[i];
                continue;
            }
            for (int32_t patch = world->pairs[heads[i]].next_patch; patch >= 0; patch = world->pairs[patch].next_patch)
                if (world->contacts[patch].point_count > 0.0f) patches[patch_count++] = patch;
        }
        if (patch_count)
            world->kernels->recycle(world->contacts, world->points, world->bodies, patches, patch_count, step->dt,
                                    step->fall, verdicts, slack);
        collide_each(job->step, heads, moved);
        atomic_fetch_add_explicit(&step->scratch->recycled, head_count - moved, memory_order_relaxed);
    }
}

// ---- worlds without -------------------------------------------------------------------------------------------------

// Lists the pairs that are not deferred, of a stretch of the list of awake pairs. May write one element behind them, of
// `count` at most.
static int32_t list_active(const int32_t *entries, int32_t count, int32_t *out_pairs)
{
    enum { FOUR = 4 };
    int32_t listed = 0, i = 0;
    for (; i + FOUR <= count; i += FOUR) {
        const int32_t *e = entries + i;
        if ((e[0] & e[1] & e[2] & e[3]) < 0) continue; // all are deferred, as most are
        for (int32_t k = 0; k < FOUR; ++k) {
            out_pairs[listed] = e[k];
            listed += e[k] >= 0;
        }
    }
    for (; i < count; ++i) {
        out_pairs[listed] = entries[i];
        listed += entries[i] >= 0;
    }
    return listed;
}

// Collides pairs whose deferral ends. Recycling was tried when they were found, and most of them meet, see reserve.c.
static void collide_expired(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const collide_job *job = argument;
    fe_world *world = job->step->world;
    (void)worker;
    for (int32_t i = first; i < end; i += PAIRS_IN_CACHE) {
        const int32_t *pairs = job->step->scratch->active + i;
        int32_t count = fe__mini(end - i, PAIRS_IN_CACHE);
        for (int32_t k = 0; k < count; ++k) {
            fe__fetch(world->pairs + pairs[fe__mini(k + FETCHED_AHEAD, count - 1)], sizeof *world->pairs);
            world->awake_pairs[world->pairs[pairs[k]].awake_index] = pairs[k];
        }
        collide_each(job->step, pairs, count);
    }
    atomic_fetch_sub_explicit(&job->step->scratch->recycled, end - first, memory_order_relaxed);
}

// Recycles pairs, and collides those that moved while their records are still in the cache. Returns how many moved.
static int32_t recycle_or_collide(fe__step *step, const int32_t *pairs, int32_t count)
{
    fe_world *world = step->world;
    int32_t moved[PAIRS_IN_CACHE], moved_count = 0;
    uint8_t verdicts[PAIRS_IN_CACHE];
    float slack[PAIRS_IN_CACHE];
    world->kernels->recycle(world->contacts, world->points, world->bodies, pairs, count, step->dt, step->fall, verdicts,
                            slack);
    for (int32_t i = 0; i < count; ++i) {
        int32_t next = fe__mini(i + FETCHED_AHEAD, count - 1);
        if (verdicts[next] != FE__STAYS) fe__fetch(world->pairs + pairs[next], sizeof *world->pairs);
        if (verdicts[i] == FE__STAYS) continue;
        if (verdicts[i] == FE__STAYS_APART)
            fe__defer_pair(step, pairs[i], slack[i]);
        else
            moved[moved_count++] = pairs[i];
    }
    collide_each(step, moved, moved_count);
    return moved_count;
}

static void collide_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const collide_job *job = argument;
    const fe__step_scratch *scratch = job->step->scratch;
    const int32_t *awake_pairs = job->step->world->awake_pairs;
    int32_t some_deferred = atomic_load_explicit(&scratch->some_deferred, memory_order_relaxed);
    int32_t list[PAIRS_IN_CACHE], moved = 0;
    (void)worker;
    for (int32_t i = job->first + first, stop = job->first + end; i < stop;) {
        const int32_t *pairs = awake_pairs + i;
        int32_t count = 0;
        if (some_deferred) {
            pairs = list;
            for (int32_t stretch; i < stop && count <= PAIRS_IN_CACHE - PAIRS_IN_BLOCK; i += stretch) {
                stretch = fe__mini(stop - i, PAIRS_IN_BLOCK);
                count += list_active(awake_pairs + i, stretch, list + count);
            }
        } else {
            count = fe__mini(PAIRS_IN_CACHE, stop - i);
            i += count;
        }
        moved += recycle_or_collide(job->step, pairs, count);
    }
    atomic_fetch_add_explicit(&job->step->scratch->recycled, end - first - moved, memory_order_relaxed);
}

// ---- results --------------------------------------------------------------------------------------------------------

void fe__sort_pairs(fe__step *step, int32_t *pairs, int32_t count)
{
    const fe_world *world = step->world;
    fe__sort_item *items = fe__sort_scratch(step);
    for (int32_t i = 0; i < count; ++i) items[i] = (fe__sort_item){fe__pair_serial(world, pairs[i], 1), pairs[i], 0};
    fe__sort_keys(items, count, items + count);
    for (int32_t i = 0; i < count; ++i) items[i].key = fe__pair_serial(world, items[i].value, 0);
    fe__sort_keys(items, count, items + count);
    for (int32_t i = 0; i < count; ++i) pairs[i] = items[i].value;
}

// Applies the results of a round: ends before beginnings, so that a colour given back can be taken in the same step.
static void apply_results(fe__step *step, int32_t first)
{
    fe_world *world = step->world;
    int32_t *results = step->scratch->results + first, count = atomic_load(&step->scratch->result_count) - first;
    fe__sort_pairs(step, results, count);
    for (int32_t i = 0; i < count; ++i) {
        int32_t result = world->pairs[results[i]].result;
        if (result != FE__RESULT_END && result != FE__RESULT_APART) continue;
        fe__pair_unlink(world, results[i]);
        fe__defer_pair(step, results[i], 0.0f); // until the next step's skip test measures its gap
    }
    for (int32_t i = 0; i < count; ++i) {
        fe__pair *p = world->pairs + results[i];
        if (p->result == FE__RESULT_PASSES) {
            p->flags ^= FE__PAIR_PASSING;
            if (p->flags & FE__PAIR_OF_PARTS) fe__encounter_pass(world, results[i], (p->flags & FE__PAIR_PASSING) != 0);
        }
        if (p->result != FE__RESULT_BEGIN || fe__pair_lets_sleep(step, results[i])) continue;
        fe__pair_link(world, results[i], step->dt);
        const int32_t bodies[2] = {p->body_a, p->body_b};
        for (int k = 0; k < 2; ++k) {
            const fe__body *body = world->bodies + bodies[k];
            if (body->type == FE_BODY_DYNAMIC && body->awake_index < 0) fe__wake(world, bodies[k]);
        }
    }
}

// Links the pairs that were to let one of the two sleep, where another contact has woken it since; the others lose
// their points.
static void settle_sleepers(fe__step *step)
{
    fe_world *world = step->world;
    const fe__step_scratch *scratch = step->scratch;
    int32_t count = atomic_load(&scratch->result_count);
    for (int32_t i = 0; i < count; ++i) {
        int32_t pair = scratch->results[i];
        const fe__pair *p = world->pairs + pair;
        if (p->result != FE__RESULT_BEGIN || p->flags & FE__PAIR_LINKED) continue;
        if (!fe__pair_lets_sleep(step, pair)) {
            fe__pair_link(world, pair, step->dt);
            continue;
        }
        fe__drop_points(world, pair);
        fe__defer_pair(step, pair, 0.0f);
    }
}

// ---- stages ---------------------------------------------------------------------------------------------------------

void fe__update_contacts(fe__step *step)
{
    fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    atomic_store(&scratch->result_count, 0);
    atomic_store(&scratch->recycled, -atomic_load(&scratch->apart_count));
    int32_t has_fields = world->field_pair_count > 0;
    int32_t expired = has_fields ? 0 : atomic_load(&scratch->expired_count); // with heightfields all are recycled
    // a body that wakes brings its pairs: they are looked at in another round
    for (int32_t first = 0; first < world->awake_pair_count; expired = 0) {
        int32_t end = world->awake_pair_count, results = atomic_load(&scratch->result_count);
        collide_job job = {step, first};
        fe__parallel_for(&world->workers, end - first, PAIRS_IN_BLOCK,
                         has_fields ? collide_block_with_patches : collide_block, &job);
        fe__parallel_for(&world->workers, expired, PAIRS_IN_BLOCK, collide_expired, &job);
        apply_results(step, results);
        first = end;
    }
    settle_sleepers(step);
    const int32_t *results = scratch->results;
    int32_t count = atomic_load(&scratch->result_count);
    for (int32_t i = 0; i < count; ++i)
        if (world->pairs[results[i]].result == FE__RESULT_END && world->pairs[results[i]].flags & FE__PAIR_PATCH)
            fe__patch_leave(world, results[i]);
    for (int32_t i = 0; i < count; ++i)
        if (world->pairs[results[i]].result == FE__RESULT_APART) fe__pair_destroy(world, results[i]);
}

const int32_t *fe__active_pairs(fe__step *step, int32_t *out_count)
{
    const fe_world *world = step->world;
    fe__step_scratch *s = step->scratch;
    *out_count = world->awake_pair_count;
    if (!atomic_load(&s->some_deferred)) return world->awake_pairs;
    int32_t count = list_active(world->awake_pairs, world->awake_pair_count, s->active);
    atomic_store(&s->some_deferred, count < world->awake_pair_count);
    *out_count = count;
    return s->active;
}

void fe__build_islands(fe__step *step)
{
    fe_world *world = step->world;
    fe__solver *s = &world->solver;
    if (!s->graph_changed) return;
    if (!world->awake_body_count) { // built when somebody wakes
        s->batch_count = s->large_count = s->group_count = s->lane_count = s->line_count = s->island_count = 0;
        s->built = (fe__built){.overflow = 0};
        return;
    }
    int32_t contact_count;
    const int32_t *contacts = fe__active_pairs(step, &contact_count);
    const fe__graph_input in = {.bodies = world->bodies,
                                .contacts = world->contacts,
                                .points = world->points,
                                .serials = world->point_serials,
                                .awake_bodies = world->awake_bodies,
                                .body_count = world->awake_body_count,
                                .awake_contacts = contacts,
                                .contact_count = contact_count,
                                .joints = &world->joints,
                                .awake_joints = world->awake_joints,
                                .joint_count = world->awake_joint_count};
    fe__graph_build(&world->solver, world->kernels, &in);
}
