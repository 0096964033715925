// step.c - the step: its table of contents, its clock, its counters.
//
// Called by the API layer (fe_world_step), and in two halves by batches, which solve worlds together.
#include "step/stages.h"

#include "continuous/continuous.h"
#include "core/clock.h"
#include "step/buried.h"

#include <assert.h>
#include <stddef.h>

typedef struct stage {
    void (*run)(fe__step *step);
    size_t time;        // offset of the stage's milliseconds in fe_profile
    int32_t needs_time; // 1: left out when dt is 0
} stage;

static void update_counters(fe__step *step);

// clang-format off
#define TIME(member) offsetof(fe_profile, member)
static const stage stages[] = {
    {fe__find_new_pairs,       TIME(pairs),      0}, // trees ask for moved proxies -> new pairs; all memory reserved
    {fe__update_contacts,      TIME(collide),    0}, // narrow phase or recycling -> manifolds, begin and end, wakes
    {fe__build_islands,        TIME(islands),    0}, // small ones into batches, large ones into colours
    {fe__solve_islands,        TIME(solve),      1}, // all substeps -> velocities, motion, impulses
    {fe__stop_fast_bodies,     TIME(continuous), 1}, // continuous collision of bodies that outran their thickness
    {fe__move_bodies,          TIME(finalize),   1}, // poses, bounds, trees
    {fe__break_joints,         TIME(events),     0}, // joints whose reactions exceeded their limits
    {fe__collect_events,       TIME(events),     0}, // touching begun, kept, ended; impacts
    {fe__put_islands_to_sleep, TIME(sleep),      1}, // islands slow for long enough
    {fe__collect_body_events,  TIME(sleep),      0}, // bodies that woke or fell asleep
    {update_counters,          TIME(sleep),      0}, // fe_counters
    {fe__give_back_rows,       TIME(sleep),      1}, // memory of a world that sleeps
};
#undef TIME
// clang-format on

enum { STAGES = sizeof stages / sizeof *stages, SOLVE_STAGE = 3 };

static void update_counters(fe__step *step)
{
    fe_world *world = step->world;
    const fe__solver *solver = &world->solver;
    fe_counters *c = &world->counters;
    c->recycled = atomic_load(&step->scratch->recycled);
    c->contacts_left_out += step->scratch->dropped_count + fe__buried_left_out(step->scratch);
    c->islands = solver->island_count;
    c->rows = c->rows_whole = c->lanes = c->colours = 0;
    c->trees = step->dt > 0.0f ? atomic_load(&solver->engaged) : 0;
    for (int32_t i = 0; i < solver->batch_count; ++i) {
        const fe__batch *batch = solver->batches + i;
        int32_t rows = 0, colours = 0;
        for (int32_t g = batch->first_group; g < batch->first_group + batch->group_count; ++g) {
            const fe__group *group = solver->groups + g;
            if (group->kind != FE__TREE_KIND)
                rows += group->rows;
            else if (world->joints.forest.trees[solver->trees[group->lane].tree].kind != FE__TREE_LIGHT)
                c->trees += group->trees;
            colours += g == batch->first_group || group->colour != group[-1].colour;
        }
        c->rows += rows;
        c->rows_whole += i >= solver->large_count ? rows : 0;
        c->lanes += batch->lane_count;
        c->colours = fe__maxi(c->colours, colours);
    }
}

static void run_stages(fe__open_step *open, int32_t end)
{
    enum { MILLISECONDS = 1000 };
    for (; open->next < end && !open->step.failed; ++open->next) {
        const stage *s = stages + open->next;
        if (s->needs_time && open->step.dt == 0.0f) continue;
        s->run(&open->step);
        if (!open->is_timed) continue;
        double now = fe__clock();
        *(float *)(void *)((char *)&open->profile + s->time) += (float)((now - open->mark) * MILLISECONDS);
        open->profile.step += (float)((now - open->mark) * MILLISECONDS);
        open->mark = now;
    }
}

fe_result fe__step_begin(fe__open_step *open, fe_world *world, float dt, int32_t is_timed)
{
    if (!fe__open_step_scratch(world)) return FE_ERROR_MEMORY;
    *open = (fe__open_step){.step = {.world = world,
                                     .scratch = world->scratch,
                                     .dt = dt,
                                     .fall = fe__length(world->gravity) * dt * dt,
                                     .constants = fe__constants_of(world, dt, 1)},
                            .profile = {.struct_size = sizeof open->profile},
                            .is_timed = is_timed};
    if (is_timed) open->mark = fe__clock();
    assert(stages[SOLVE_STAGE].run == fe__solve_islands);
    fe__pool_begin(world->workers.pool);
    run_stages(open, SOLVE_STAGE);
    if (!open->step.failed) return FE_OK;
    fe__pool_end(world->workers.pool);
    return FE_ERROR_MEMORY;
}

void fe__step_resume(fe__open_step *open) { open->next = SOLVE_STAGE + 1; }

void fe__step_end(fe__open_step *open)
{
    fe_world *world = open->step.world;
    run_stages(open, STAGES);
    fe__pool_end(world->workers.pool);
    world->profile = open->profile;
    world->step_number += 1;
}

fe_result fe__world_step(fe_world *world, float dt)
{
    fe__open_step open;
    fe_result result = fe__step_begin(&open, world, dt, 1);
    if (result == FE_OK) fe__step_end(&open);
    return result;
}
