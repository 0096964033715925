// due.c - see due.h. Where the bound of deferral.h does not decide, the exact test of recycle.simd.c does, and where
// that does not, the narrow phase. Most pairs that it looks at are still apart: they wait on, from where they are now,
// and no row and no points are reserved for them. What was found of them is noted until all memory is there: a step
// that finds none for the others changes nothing. The narrow phase of those that meet comes in its own stage, where
// there is room for what it finds.
#include "step/due.h"

#include "step/narrow.h"
#include "world/proxies.h"

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
    // with heightfields none waits, see collide_stage.c
    if (w->field_pair_count || !atomic_load(&s->some_deferred)) return 1;
    if (!FE_RESERVE(w->step_memory, s->busy, s->busy_capacity, w->awake_pair_count)) return 0;
    s->busy_end = w->awake_pair_count;
    fe__parallel_for(&w->workers, w->awake_pair_count, PAIRS_IN_BLOCK, find_in_block, step);
    return 1;
}
