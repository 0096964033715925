// step.c - the step: its table of contents, its clock, its counters.
#include "step/stages.h"

#include "continuous/continuous.h"
#include "core/clock.h"
#include "step/buried.h"

#include <assert.h>
#include <stddef.h>

typedef struct stage {
    void (*run)(fe__step *step);
    size_t time;   // of fe_profile, offset of its milliseconds
    int32_t moves; // 1: left out when dt is 0
} stage;

static void count(fe__step *step);

static const stage stages[] = {
    {fe__find_new_pairs, offsetof(fe_profile, pairs), 0}, // queries of moved proxies -> new pairs; all memory reserved
    {fe__update_contacts, offsetof(fe_profile, collide),
     0}, // narrow phase or recycling -> manifolds, begin and end, wakes
    {fe__build_islands, offsetof(fe_profile, islands), 0},       // small ones into batches, large ones into colours
    {fe__solve_islands, offsetof(fe_profile, solve), 1},         // all substeps -> velocities, motion, impulses
    {fe__stop_fast_bodies, offsetof(fe_profile, continuous), 1}, // continuous collision of what outran its thickness
    {fe__move_bodies, offsetof(fe_profile, finalize), 1},        // poses, bounds, trees
    {fe__break_joints, offsetof(fe_profile, events), 0},         // joints that bore too much
    {fe__collect_events, offsetof(fe_profile, events), 0},       // touching begun, kept, ended; impacts
    {fe__put_islands_to_sleep, offsetof(fe_profile, sleep), 1},  // islands slow for long enough
    {fe__collect_body_events, offsetof(fe_profile, sleep), 0},   // who woke, who fell asleep
    {count, offsetof(fe_profile, sleep), 0},                     // what the step did, for who asks
    {fe__give_back_rows, offsetof(fe_profile, sleep), 1},        // of a world that sleeps
};

enum { STAGES = sizeof stages / sizeof *stages, SOLVES = 3 }; // the stage that solves

static void count(fe__step *step)
{
    fe_world *w = step->world;
    const fe__solver *s = &w->solver;
    fe_counters *c = &w->counters;
    c->recycled = atomic_load(&step->scratch->recycled);
    c->contacts_left_out += step->scratch->left_out + fe__buried_left_out(step->scratch);
    c->islands = s->island_count;
    c->rows = c->rows_whole = c->lanes = c->colours = 0;
    c->trees = step->dt > 0.0f ? atomic_load(&s->engaged) : 0;
    for (int32_t i = 0; i < s->batch_count; ++i) {
        const fe__batch *b = s->batches + i;
        int32_t rows = 0, colours = 0;
        for (int32_t g = b->first_group; g < b->first_group + b->group_count; ++g) {
            if (s->groups[g].kind != FE__TREE_KIND)
                rows += s->groups[g].rows;
            else if (w->joints.forest.trees[s->trees[s->groups[g].lane].tree].kind != FE__TREE_LIGHT)
                c->trees += s->groups[g].trees;
            colours += g == b->first_group || s->groups[g].colour != s->groups[g - 1].colour;
        }
        c->rows += rows;
        c->rows_whole += i >= s->large_count ? rows : 0;
        c->lanes += b->lane_count;
        c->colours = fe__maxi(c->colours, colours);
    }
}

// Up to `end`
static void run_stages(fe__open_step *o, int32_t end)
{
    enum { MILLISECONDS = 1000 };
    for (; o->next < end && !o->step.failed; ++o->next) {
        const stage *s = stages + o->next;
        if (s->moves && o->step.dt == 0.0f) continue;
        s->run(&o->step);
        if (!o->is_timed) continue;
        double now = fe__clock();
        *(float *)(void *)((char *)&o->profile + s->time) += (float)((now - o->mark) * MILLISECONDS);
        o->profile.step += (float)((now - o->mark) * MILLISECONDS);
        o->mark = now;
    }
}

fe_result fe__step_begin(fe__open_step *o, fe_world *w, float dt, int32_t is_timed)
{
    if (!fe__open_step_scratch(w)) return FE_ERROR_MEMORY;
    *o = (fe__open_step){.step = {.world = w,
                                  .scratch = w->scratch,
                                  .dt = dt,
                                  .fall = fe__length(w->gravity) * dt * dt,
                                  .constants = fe__constants_of(w, dt, 1)},
                         .profile = {.struct_size = sizeof o->profile},
                         .is_timed = is_timed};
    if (is_timed) o->mark = fe__clock();
    assert(stages[SOLVES].run == fe__solve_islands);
    fe__pool_begin(w->workers.pool);
    run_stages(o, SOLVES);
    if (!o->step.failed) return FE_OK;
    fe__pool_end(w->workers.pool);
    return FE_ERROR_MEMORY;
}

void fe__step_resume(fe__open_step *o) { o->next = SOLVES + 1; }

void fe__step_end(fe__open_step *o)
{
    fe_world *w = o->step.world;
    run_stages(o, STAGES);
    fe__pool_end(w->workers.pool);
    w->profile = o->profile;
    w->step_number += 1;
}

fe_result fe__world_step(fe_world *w, float dt)
{
    fe__open_step o;
    fe_result result = fe__step_begin(&o, w, dt, 1);
    if (result == FE_OK) fe__step_end(&o);
    return result;
}
