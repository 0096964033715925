// update_contacts.c - stages 2 and 3: manifolds of the awake pairs, what begins and ends to touch, who wakes; then the
// constraint graph.
//
// A pair that moved little keeps its manifold (recycling, wide); the others go through the narrow phase one by one.
// Workers only write their pairs' own records and a list of results; the results are applied afterwards, sorted by
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
    int32_t first; // of this round, in the list of awake pairs
} collide_job;

// ---- one pair ------------------------------------------------------------------------------------------------------
static int32_t judge(const fe_world *w, int32_t pair, int32_t changes_sides)
{
    const fe__pair *p = w->pairs + pair;
    int32_t has_points = w->contacts[pair].point_count > 0.0f, linked = (p->flags & FE__PAIR_LINKED) != 0;
    if (has_points) return linked || p->flags & FE__PAIR_SENSOR ? FE__RESULT_NONE : FE__RESULT_BEGIN;
    if (!(p->flags & FE__PAIR_PATCH) && fe__boxes_part(w, p)) return FE__RESULT_APART;
    if (linked) return FE__RESULT_END;
    return changes_sides ? FE__RESULT_PASSES : FE__RESULT_NONE;
}

// A pair without points may move by `slack` before it is looked at again. One with a heightfield is asked for more than
// its gap
void fe__defer_pair(const fe__step *step, int32_t pair, float slack)
{
    const fe_world *w = step->world;
    const fe__pair *p = w->pairs + pair;
    if (p->flags & (FE__PAIR_PATCH | FE__PAIR_MAY_REPORT) || p->next_patch >= 0 || p->awake_index < 0) return;
    fe__defer(w->deferrals + p->awake_index, w->odometers, w->bodies, w->contacts + pair, slack);
    w->awake_pairs[p->awake_index] = ~pair;
    atomic_store_explicit(&step->scratch->some_deferred, 1, memory_order_relaxed);
}

static void note_result(fe__step *step, int32_t pair, int32_t changes_sides)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    w->pairs[pair].result = (int16_t)judge(w, pair, changes_sides);
    if (!(w->contacts[pair].point_count > 0.0f)) fe__defer_pair(step, pair, w->contacts[pair].surface.tolerance);
    if (w->pairs[pair].result != FE__RESULT_NONE)
        s->results[atomic_fetch_add_explicit(&s->result_count, 1, memory_order_relaxed)] = pair;
}

// A heightfield's and a mesh's patches follow their heads, on the head's thread
static void collide_pair(fe__step *step, int32_t head)
{
    const fe_world *w = step->world;
    if (w->pairs[head].next_patch < 0) {
        note_result(step, head, fe__collide_pair(step, head));
        return;
    }
    fe__collide_field_pair(step, head);
    for (int32_t pair = head; pair >= 0; pair = w->pairs[pair].next_patch) note_result(step, pair, 0);
}

static void collide_each(fe__step *step, const int32_t *pairs, int32_t count)
{
    enum { OWN_AHEAD = 8, NAMED_AHEAD = 3, HULLS_AHEAD = 2, OF_HULLS_AHEAD = 1 };
    const fe_world *w = step->world;
    for (int32_t i = -OWN_AHEAD; i < count; ++i) {
        if (i + OWN_AHEAD < count) fe__fetch_own(w, pairs[i + OWN_AHEAD]);
        if (i >= -NAMED_AHEAD && i + NAMED_AHEAD < count) fe__fetch_named(w, pairs[i + NAMED_AHEAD]);
        if (i >= -HULLS_AHEAD && i + HULLS_AHEAD < count) fe__fetch_hulls(w, pairs[i + HULLS_AHEAD]);
        if (i >= -OF_HULLS_AHEAD && i + OF_HULLS_AHEAD < count) fe__fetch_of_hulls(w, pairs[i + OF_HULLS_AHEAD]);
        if (i >= 0) collide_pair(step, pairs[i]);
    }
}

// ---- with heightfields and meshes ----------------------------------------------------------------------------------
// up to PAIRS_IN_BLOCK of the awake pairs
static void collide_chunk(fe__step *step, int32_t *entries, int32_t count)
{
    fe_world *w = step->world;
    int32_t heads[PAIRS_IN_BLOCK], patches[PAIRS_IN_BLOCK * (FE__PATCHES - 1)], head_count = 0, patch_count = 0,
                                                                                again = 0;
    uint8_t verdicts[PAIRS_IN_BLOCK * (FE__PATCHES - 1)];
    float slack[PAIRS_IN_BLOCK * (FE__PATCHES - 1)];
    for (int32_t i = 0; i < count; ++i) {
        entries[i] = fe__pair_of(entries[i]); // here none waits
        if (!(w->pairs[entries[i]].flags & FE__PAIR_PATCH)) heads[head_count++] = entries[i];
    }
    if (head_count == 0) return;
    w->kernels->recycle(w->contacts, w->points, w->bodies, heads, head_count, step->dt, step->fall, verdicts, slack);
    for (int32_t i = 0; i < head_count; ++i) {
        if (verdicts[i] == FE__MOVED) {
            heads[again++] = heads[i];
            continue;
        }
        for (int32_t patch = w->pairs[heads[i]].next_patch; patch >= 0; patch = w->pairs[patch].next_patch)
            if (w->contacts[patch].point_count > 0.0f) patches[patch_count++] = patch;
    }
    if (patch_count)
        w->kernels->recycle(w->contacts, w->points, w->bodies, patches, patch_count, step->dt, step->fall, verdicts,
                            slack);
    collide_each(step, heads, again);
    atomic_fetch_add_explicit(&step->scratch->recycled, head_count - again, memory_order_relaxed);
}

static void collide_chunks(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const collide_job *job = argument;
    (void)worker;
    for (int32_t i = first; i < end; i += PAIRS_IN_BLOCK)
        collide_chunk(job->step, job->step->world->awake_pairs + job->first + i, fe__mini(end - i, PAIRS_IN_BLOCK));
}

// ---- without -------------------------------------------------------------------------------------------------------
// Of a stretch of the list of awake pairs, those that do not wait. May write an entry behind them, of `count` at most
static int32_t list_busy(const int32_t *entries, int32_t count, int32_t *out_pairs)
{
    enum { FOUR = 4 };
    int32_t listed = 0, i = 0;
    for (; i + FOUR <= count; i += FOUR) {
        const int32_t *e = entries + i;
        if ((e[0] & e[1] & e[2] & e[3]) < 0) continue; // all wait, as most do
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

// The next awake pairs that do not wait, PAIRS_IN_CACHE at most. Moves *at behind them
static int32_t list_next(const fe__step *step, int32_t *at, int32_t end, int32_t out_pairs[PAIRS_IN_CACHE])
{
    int32_t count = 0;
    for (int32_t stretch; *at < end && count <= PAIRS_IN_CACHE - PAIRS_IN_BLOCK; *at += stretch) {
        stretch = fe__mini(end - *at, PAIRS_IN_BLOCK);
        count += list_busy(step->world->awake_pairs + *at, stretch, out_pairs + count);
    }
    return count;
}

// Pairs whose deferral ends: recycling has had its say when they were found, and most of them meet, see reserve.c
static void collide_due(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const collide_job *job = argument;
    fe_world *w = job->step->world;
    (void)worker;
    for (int32_t i = first; i < end; i += PAIRS_IN_CACHE) {
        const int32_t *pairs = job->step->scratch->busy + i;
        int32_t count = fe__mini(end - i, PAIRS_IN_CACHE);
        for (int32_t k = 0; k < count; ++k) {
            fe__fetch(w->pairs + pairs[fe__mini(k + FETCHED_AHEAD, count - 1)], sizeof *w->pairs);
            w->awake_pairs[w->pairs[pairs[k]].awake_index] = pairs[k];
        }
        collide_each(job->step, pairs, count);
    }
    atomic_fetch_sub_explicit(&job->step->scratch->recycled, end - first, memory_order_relaxed);
}

// Recycles pairs, and looks at those that moved while their records are still in the cache. Returns how many those are
static int32_t collide_some(fe__step *step, const int32_t *pairs, int32_t count)
{
    fe_world *w = step->world;
    int32_t again[PAIRS_IN_CACHE], left = 0;
    uint8_t verdicts[PAIRS_IN_CACHE];
    float slack[PAIRS_IN_CACHE];
    w->kernels->recycle(w->contacts, w->points, w->bodies, pairs, count, step->dt, step->fall, verdicts, slack);
    for (int32_t i = 0; i < count; ++i) {
        int32_t pair = pairs[i], next = fe__mini(i + FETCHED_AHEAD, count - 1);
        if (verdicts[next] != FE__STAYS) fe__fetch(w->pairs + pairs[next], sizeof *w->pairs);
        if (verdicts[i] == FE__STAYS) continue;
        if (verdicts[i] == FE__STAYS_APART) {
            fe__defer_pair(step, pair, slack[i]);
            continue;
        }
        again[left++] = pair;
    }
    collide_each(step, again, left);
    return left;
}

static void collide_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const collide_job *job = argument;
    const fe__step_scratch *s = job->step->scratch;
    int32_t list[PAIRS_IN_CACHE], again = 0,
                                  some_deferred = atomic_load_explicit(&s->some_deferred, memory_order_relaxed);
    (void)worker;
    for (int32_t i = job->first + first, stop = job->first + end; i < stop;) {
        const int32_t *pairs = job->step->world->awake_pairs + i;
        int32_t count = fe__mini(PAIRS_IN_CACHE, stop - i);
        if (some_deferred)
            count = list_next(job->step, &i, stop, list), pairs = list;
        else
            i += count;
        again += collide_some(job->step, pairs, count);
    }
    atomic_fetch_add_explicit(&job->step->scratch->recycled, end - first - again, memory_order_relaxed);
}

// ---- results -------------------------------------------------------------------------------------------------------
void fe__sort_pairs(fe__step *step, int32_t *pairs, int32_t count)
{
    const fe_world *w = step->world;
    fe__sort_item *items = fe__sort_room(step);
    for (int32_t i = 0; i < count; ++i) items[i] = (fe__sort_item){fe__pair_serial(w, pairs[i], 1), pairs[i], 0};
    fe__sort_keys(items, count, items + count);
    for (int32_t i = 0; i < count; ++i) items[i].key = fe__pair_serial(w, items[i].value, 0);
    fe__sort_keys(items, count, items + count);
    for (int32_t i = 0; i < count; ++i) pairs[i] = items[i].value;
}

static void wake_sleeping(fe_world *w, int32_t body)
{
    if (w->bodies[body].type == FE_BODY_DYNAMIC && w->bodies[body].awake_index < 0) fe__wake(w, body);
}

// It waits for no longer than until the next step looks how far apart they are
static void end_contact(fe__step *step, int32_t pair)
{
    fe__pair_unlink(step->world, pair);
    fe__defer_pair(step, pair, 0.0f);
}

static void change_sides(fe_world *w, int32_t pair)
{
    fe__pair *p = w->pairs + pair;
    p->flags ^= FE__PAIR_PASSING;
    if (p->flags & FE__PAIR_OF_PARTS) fe__encounter_pass(w, pair, (p->flags & FE__PAIR_PASSING) != 0);
}

// ends before beginnings, so that a colour given back can be taken in the same step
static void apply_results(fe__step *step, int32_t first)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    int32_t *results = s->results + first, count = atomic_load(&s->result_count) - first;
    fe__sort_pairs(step, results, count);
    for (int32_t i = 0; i < count; ++i)
        if (w->pairs[results[i]].result == FE__RESULT_END || w->pairs[results[i]].result == FE__RESULT_APART)
            end_contact(step, results[i]);
    for (int32_t i = 0; i < count; ++i) {
        const fe__pair *p = w->pairs + results[i];
        if (p->result == FE__RESULT_PASSES) change_sides(w, results[i]);
        if (p->result != FE__RESULT_BEGIN || fe__pair_lets_sleep(step, results[i])) continue;
        fe__pair_link(w, results[i], step->dt);
        wake_sleeping(w, p->body_a);
        wake_sleeping(w, p->body_b);
    }
}

// Pairs that let one of the two sleep: another may have woken it since
static void settle_sleepers(fe__step *step)
{
    fe_world *w = step->world;
    const fe__step_scratch *s = step->scratch;
    int32_t count = atomic_load(&s->result_count);
    for (int32_t i = 0; i < count; ++i) {
        int32_t pair = s->results[i];
        const fe__pair *p = w->pairs + pair;
        if (p->result != FE__RESULT_BEGIN || p->flags & FE__PAIR_LINKED) continue;
        if (!fe__pair_lets_sleep(step, pair)) {
            fe__pair_link(w, pair, step->dt);
            continue;
        }
        fe__drop_points(w, pair);
        fe__defer_pair(step, pair, 0.0f);
    }
}

void fe__update_contacts(fe__step *step)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    atomic_store(&s->result_count, 0);
    atomic_store(&s->recycled, -atomic_load(&s->apart_count));
    // what wakes brings its pairs: they are looked at in another round
    int32_t due = w->field_pair_count ? 0 : atomic_load(&s->due_count); // with heightfields all are recycled
    for (int32_t first = 0; first < w->awake_pair_count; due = 0) {
        int32_t end = w->awake_pair_count, results = atomic_load(&s->result_count);
        collide_job job = {step, first};
        fe__parallel_for(&w->workers, end - first, PAIRS_IN_BLOCK, w->field_pair_count ? collide_chunks : collide_block,
                         &job);
        fe__parallel_for(&w->workers, due, PAIRS_IN_BLOCK, collide_due, &job);
        apply_results(step, results);
        first = end;
    }
    settle_sleepers(step);
    int32_t count = atomic_load(&s->result_count);
    for (int32_t i = 0; i < count; ++i)
        if (w->pairs[s->results[i]].result == FE__RESULT_END && w->pairs[s->results[i]].flags & FE__PAIR_PATCH)
            fe__patch_leave(w, s->results[i]);
    for (int32_t i = 0; i < count; ++i)
        if (w->pairs[s->results[i]].result == FE__RESULT_APART) fe__pair_destroy(w, s->results[i]);
}

const int32_t *fe__busy_pairs(fe__step *step, int32_t *out_count)
{
    const fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    *out_count = w->awake_pair_count;
    if (!atomic_load(&s->some_deferred)) return w->awake_pairs;
    int32_t count = list_busy(w->awake_pairs, w->awake_pair_count, s->busy);
    atomic_store(&s->some_deferred, count < w->awake_pair_count);
    *out_count = count;
    return s->busy;
}

void fe__build_islands(fe__step *step)
{
    fe_world *w = step->world;
    fe__solver *s = &w->solver;
    if (!s->graph_changed) return;
    if (!w->awake_body_count) { // built when somebody wakes
        s->batch_count = s->large_count = s->group_count = s->lane_count = s->line_count = s->island_count = 0;
        s->built = (fe__built){.overflow = 0};
        return;
    }
    int32_t contact_count;
    const int32_t *contacts = fe__busy_pairs(step, &contact_count);
    const fe__graph_input in = {.bodies = w->bodies,
                                .contacts = w->contacts,
                                .points = w->points,
                                .serials = w->point_serials,
                                .awake_bodies = w->awake_bodies,
                                .body_count = w->awake_body_count,
                                .awake_contacts = contacts,
                                .contact_count = contact_count,
                                .joints = &w->joints,
                                .awake_joints = w->awake_joints,
                                .joint_count = w->awake_joint_count};
    fe__graph_build(&w->solver, w->kernels, &in);
}
