// lockstep.c - see lockstep.h.
#include "batch/lockstep.h"

#include "core/clock.h"
#include "solver/graph/graph.h"

// Lanes or lines from which on a world fills its rows by itself: of hundreds, few groups are smaller than a row, and
// those of 16 worlds would leave the cache
enum { FILLED = 256 };

void fe__lockstep_init(fe__lockstep *l, const fe_allocator *allocator)
{
    fe__memory_init(&l->memory, allocator);
    for (int32_t i = 0; i < FE__MERGE_MOST; ++i) l->places[i].room.memory = &l->memory;
}

void fe__lockstep_free(fe__lockstep *l)
{
    for (int32_t i = 0; i < FE__MERGE_MOST; ++i) fe__workroom_free(&l->places[i].room);
    fe__graph_free_merge(&l->merge, &l->memory);
    fe__solver_destroy(&l->lines, &l->memory);
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

// ---- lines and rows ------------------------------------------------------------------------------------------------
static void take_lines(fe__lockstep *l, const fe__lockstep_place *p)
{
    fe__solver_trade_lines(&p->world->solver, &l->lines);
}

static void give_lines(fe__lockstep *l, const fe__lockstep_place *p)
{
    fe__solver *s = &p->world->solver;
    s->trail = NULL;
    fe__solver_trade_lines(s, &l->lines);
}

// ---- a step --------------------------------------------------------------------------------------------------------
static void end_step(fe__lockstep *l, fe__lockstep_place *p)
{
    fe__solver *s = &p->world->solver;
    take_lines(l, p);
    s->trail = (fe__motion_line(*)[FE__TRAIL])(void *)(s->rows + p->trail);
    if (p->part >= 0) {
        fe__graph_return(&l->merge, p->part);
        fe__end_solve(&p->open.step);
        fe__step_resume(&p->open);
    }
    fe__step_end(&p->open);
    give_lines(l, p);
    p->part = FE__OVER;
}

static int32_t may_join(const fe__lockstep_place *p)
{
    const fe__solver *s = &p->world->solver;
    return p->open.step.dt > 0.0f && s->lane_count <= FILLED && s->line_count <= FILLED && fe__graph_can_merge(s);
}

fe_result fe__lockstep_begin(fe__lockstep *l, int32_t place, float dt)
{
    fe__lockstep_place *p = l->places + place;
    const fe__solver *s = &p->world->solver;
    if (!l->open) l->began = fe__clock();
    take_lines(l, p);
    fe_result result = fe__step_begin(&p->open, p->world, dt, 0);
    p->trail = s->trail ? (fe__row_block *)(void *)s->trail - s->rows : 0; // none where nobody is awake
    give_lines(l, p);
    p->is_open = result == FE_OK;
    l->open += p->is_open;
    p->part = FE__ALONE;
    if (p->is_open && !may_join(p)) end_step(l, p); // while it lies in the cache
    return result;
}

static int32_t waits(const fe__lockstep_place *p) { return p->is_open && p->part != FE__OVER; }

// Worlds have their own gravity and tuning, and may have had another step before. Where more than half of them agree:
// one of those (R. Boyer, J. Moore, "MJRTY", 1991)
static const fe__lockstep_place *choose_leader(const fe__lockstep *l)
{
    const fe__lockstep_place *leader = NULL;
    int32_t votes = 0;
    for (const fe__lockstep_place *p = l->places; p < l->places + FE__MERGE_MOST; ++p) {
        if (!waits(p)) continue;
        if (votes == 0) leader = p;
        votes += fe__solves_alike(leader->world, p->world) ? 1 : -1;
    }
    return leader;
}

static void join(fe__lockstep *l, fe__lockstep_place *p)
{
    fe__merge *m = &l->merge;
    if (!waits(p) || !fe__solves_alike(l->leader->world, p->world)) return;
    p->part = m->count++;
    m->part[p->part] = &p->world->solver;
    m->of[p->part] = fe__begin_solve(&p->open.step);
    atomic_store(&p->world->solver.engaged, 0);
}

static void separate(fe__lockstep *l)
{
    for (fe__lockstep_place *p = l->places; p < l->places + FE__MERGE_MOST; ++p)
        if (p->part != FE__OVER) p->part = FE__ALONE;
}

static void solve_together(fe__lockstep *l)
{
    fe__merge *m = &l->merge;
    l->leader = choose_leader(l), m->count = 0;
    for (fe__lockstep_place *p = l->places; p < l->places + FE__MERGE_MOST; ++p) join(l, p);
    if (m->count < 2 || !fe__graph_merge(m, &l->memory, l->leader->world->kernels)) {
        separate(l);
        return;
    }
    fe__solve_with(&l->leader->open.step, &m->solver, m->of);
}

void fe__lockstep_finish(fe__lockstep *l)
{
    enum { MILLISECONDS = 1000 };
    if (!l->open) return;
    solve_together(l);
    for (fe__lockstep_place *p = l->places; p < l->places + FE__MERGE_MOST; ++p)
        if (waits(p)) end_step(l, p);
    double each = (fe__clock() - l->began) / l->open;
    for (fe__lockstep_place *p = l->places; p < l->places + FE__MERGE_MOST; ++p) {
        if (p->is_open) p->world->profile.step = (float)(each * MILLISECONDS);
        p->is_open = 0;
    }
    l->open = 0;
}
