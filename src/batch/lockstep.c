// lockstep.c - see lockstep.h.
#include "batch/lockstep.h"

#include "core/clock.h"
#include "solver/solve.h"

#include <string.h>

// Lanes from which on a world fills its rows by itself: of hundreds, few groups are smaller than a row
enum { FILLED = 1024 };

void fe__lockstep_init(fe__lockstep *l, const fe_allocator *allocator)
{
    fe__memory_init(&l->memory, allocator);
    for (int32_t i = 0; i < FE__MERGE_MOST; ++i) l->places[i].room.memory = &l->memory;
}

void fe__lockstep_free(fe__lockstep *l)
{
    for (int32_t i = 0; i < FE__MERGE_MOST; ++i) fe__workroom_free(&l->places[i].room);
    fe__graph_free_merge(&l->merge, &l->memory);
    FE_FREE(&l->memory, l->rows, l->row_capacity);
}

void fe__lockstep_enter(fe__lockstep *l, int32_t place, fe_world *world)
{
    fe__lockstep_place *p = l->places + place;
    p->world = world, p->is_open = 0;
    fe__workroom_lend(&p->room, world);
}

void fe__lockstep_leave(fe__lockstep *l, int32_t place)
{
    fe__lockstep_place *p = l->places + place;
    fe__workroom_take_back(&p->room, p->world);
    p->world = NULL;
}

// ---- rows ----------------------------------------------------------------------------------------------------------
static void take_rows(fe__lockstep *l, fe__lockstep_place *p)
{
    fe__solver *s = &p->world->solver;
    s->rows = l->rows, s->row_capacity = l->row_capacity;
    s->trail = s->rows ? (fe__motion_line(*)[FE__TRAIL])(void *)(s->rows + p->trail) : NULL;
}

static void give_rows(fe__lockstep *l, fe__lockstep_place *p)
{
    fe__solver *s = &p->world->solver;
    p->trail = s->rows ? (fe__row_block *)(void *)s->trail - s->rows : 0;
    l->rows = s->rows, l->row_capacity = s->row_capacity;
    s->rows = NULL, s->row_capacity = 0, s->trail = NULL;
}

// ---- a step --------------------------------------------------------------------------------------------------------
fe_result fe__lockstep_begin(fe__lockstep *l, int32_t place, float dt)
{
    fe__lockstep_place *p = l->places + place;
    take_rows(l, p);
    fe_result result = fe__step_begin(&p->open, p->world, dt);
    give_rows(l, p);
    p->is_open = result == FE_OK;
    p->part = FE__ALONE;
    return result;
}

static int32_t can_join(const fe__lockstep *l, const fe__lockstep_place *p)
{
    const fe__solver *s = &p->world->solver;
    if (s->lane_count > FILLED || !fe__graph_can_merge(s)) return 0;
    // worlds have their own gravity and tuning, and may have had another step before
    const fe__lockstep_place *first = NULL;
    for (const fe__lockstep_place *q = l->places; q < p && !first; ++q)
        if (q->world && q->is_open && q->part != FE__ALONE) first = q;
    return !first || !memcmp(first->input.paces, p->input.paces, sizeof p->input.paces);
}

static void join(fe__lockstep *l, fe__lockstep_place *p)
{
    fe__merge *m = &l->merge;
    fe__begin_solve(&p->open.step, &p->input);
    if (!can_join(l, p)) return;
    p->part = m->count++;
    m->part[p->part] = &p->world->solver;
    m->of[p->part] = p->input.of;
    atomic_store(&p->world->solver.engaged, 0);
}

static void separate(fe__lockstep *l)
{
    for (int32_t i = 0; i < FE__MERGE_MOST; ++i) l->places[i].part = FE__ALONE;
}

void fe__lockstep_solve(fe__lockstep *l)
{
    fe__merge *m = &l->merge;
    const fe__lockstep_place *first = NULL;
    double start = fe__clock();
    m->count = 0;
    for (fe__lockstep_place *p = l->places; p < l->places + FE__MERGE_MOST; ++p) {
        if (!p->world || !p->is_open || p->open.step.dt == 0.0f) continue;
        join(l, p);
        if (!first && p->part != FE__ALONE) first = p;
    }
    if (m->count < 2 || !fe__graph_merge(m, &l->memory, first->world->kernels)) {
        separate(l);
        return;
    }
    fe__solve(&m->solver, first->world->kernels, &first->world->workers, m->of, first->input.paces);
    l->solving = (fe__clock() - start) / m->count;
}

void fe__lockstep_end(fe__lockstep *l, int32_t place)
{
    fe__lockstep_place *p = l->places + place;
    take_rows(l, p);
    if (p->part != FE__ALONE) {
        fe__graph_return(&l->merge, p->part);
        fe__end_solve(&p->open.step);
        fe__step_resume(&p->open, l->solving);
    }
    fe__step_end(&p->open);
    give_rows(l, p);
    p->is_open = 0;
}
