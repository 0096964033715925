// due.c - see due.h. Where the bound of deferral.h does not decide, the exact test of recycle.simd.c does. Only a pair
// that may get points is looked at: all others take no row, and no memory is reserved for it.
#include "step/due.h"

#include "step/narrow.h"

enum { PAIRS_IN_BLOCK = 256 };

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
            fe__defer(w->deferrals + places[i], w->odometers, w->bodies, w->contacts + pairs[i], slack[i]);
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
    // with heightfields none waits, see collide_stage.c
    if (w->field_pair_count || !atomic_load(&s->some_deferred)) return 1;
    if (!FE_RESERVE(&w->memory, s->busy, s->busy_capacity, w->awake_pair_count)) return 0;
    fe__parallel_for(&w->workers, w->awake_pair_count, PAIRS_IN_BLOCK, find_in_block, step);
    return 1;
}
