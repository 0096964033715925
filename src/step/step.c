// step.c - the step: its table of contents, its constants, its clock.
#include "step/step.h"

#include "solver/graph/graph.h"

#include <float.h>

typedef struct stage {
    void (*run)(fe__step *step);
    size_t time;   // of fe_profile, offset of its milliseconds
    int32_t moves; // 1: left out when dt is 0
} stage;

static const stage stages[] = {
    {fe__find_new_pairs, offsetof(fe_profile, pairs), 0},        // queries of moved proxies -> new pairs; all memory reserved
    {fe__update_contacts, offsetof(fe_profile, collide), 0},     // narrow phase or recycling -> manifolds, begin and end, wakes
    {fe__build_islands, offsetof(fe_profile, islands), 0},       // small ones into batches, large ones into colours
    {fe__solve_islands, offsetof(fe_profile, solve), 1},         // all substeps -> velocities, motion, impulses
    {fe__stop_fast_bodies, offsetof(fe_profile, continuous), 1}, // continuous collision of what outran its thickness
    {fe__move_bodies, offsetof(fe_profile, finalize), 1},        // poses, bounds, trees
    {fe__break_joints, offsetof(fe_profile, events), 0},         // joints that bore too much
    {fe__collect_events, offsetof(fe_profile, events), 0},       // touching begun, kept, ended; impacts
    {fe__put_islands_to_sleep, offsetof(fe_profile, sleep), 1},  // islands slow for long enough
    {fe__collect_body_events, offsetof(fe_profile, sleep), 0},   // who woke, who fell asleep
};

// Impulses of rest grow with the substep, those of an impact do not: after a much shorter substep they are too large a guess
#define MOST_WARM_SCALE 16.0f

// An island is strained by a load that lasts and could accelerate a body by so many times gravity (a stack of 40 equal boxes), until it is
// less than a quarter of that. Without gravity that of the earth counts.
#define STRAIN 80.0f
// Impulses pass on by a body or so in a rigid pass, and the impact of a body hundreds of times as heavy needs hundreds: it arrives late,
// with the bodies between deep in each other. In a strained island substeps are about a thousandth of a second, of three passes.
#define FINE_RATE 960.0f
enum { MOST_DIVISION = 16, FINE_SWEEPS = 3 };
// A net of joints that bears more than its substeps can pass on opens. From ten times the linear slop on it is stretched, and has substeps
// as short as by default, until no joint is open by half as much.
#define STRETCHED_RATE 480.0f
#define OPEN 0.05f // m

static int32_t division_of(float h, float rate)
{
    int32_t division = 1;
    while (division < MOST_DIVISION && (float)division < 0.99f * rate * h) ++division;
    return division;
}

static float strain_of(const fe_world *w, float dt)
{
    const fe_vec3 g = w->gravity;
    float square = fe__dot(g, g);
    return STRAIN * dt * (square > 0.0f ? __builtin_sqrtf(square) : 9.81f);
}

// Hertz are limited to what the world's substeps can follow: contacts' to an eighth of their rate, against static bodies to a quarter.
// Joints': of a mode of many rows a pass puts right only a small share. It swings at sqrt(2 share) / h, the pushes of the soft pass add up
// in its impulses, and its amplitude grows by 1 + (x^2 - 2) fade / 4 a substep, x = 2 pi hertz h, less what the passes take. So x^2 < 2,
// 0.225 of the rate. Contacts against static bodies are stiffer than that, but end modes of softer ones.
#define MOST_JOINT_HERTZ 0.225f

static fe__step_constants constants_of(const fe_world *w, float dt, int32_t division)
{
    const fe_world_tuning *t = &w->tuning;
    float whole = dt / (float)w->substeps, rate = whole > 0.0f ? 1.0f / whole : 0.0f, hertz = fe__minf(t->contact_hertz, 0.125f * rate);
    float h = whole / (float)division;
    fe__step_constants c = {.h = h,
                            .inverse_h = h > 0.0f ? 1.0f / h : 0.0f,
                            .push_speed = t->contact_push_speed,
                            .threshold = t->restitution_threshold,
                            .warm_scale = w->last_h > 0.0f ? fe__minf(whole / w->last_h, MOST_WARM_SCALE) / (float)division : 0.0f,
                            .max_speed = t->max_linear_speed,
                            .speculative = t->speculative_distance,
                            .strain = strain_of(w, dt),
                            .substeps = w->substeps * division,
                            .division = division,
                            .sweeps = 1,
                            .gravity = w->gravity};
    c.joint_hertz = MOST_JOINT_HERTZ * rate;
    c.joint = fe__make_softness(fe__minf(t->joint_hertz, c.joint_hertz), t->joint_damping_ratio, h);
    c.between_dynamic = fe__make_softness(hertz, t->contact_damping_ratio, h);
    c.against_static = fe__make_softness(fe__minf(2.0f * t->contact_hertz, 0.25f * rate), t->contact_damping_ratio, h);
    return c;
}

static void constants_of_paces(const fe_world *w, float dt, fe__step_constants paces[FE__PACES])
{
    float whole = dt / (float)w->substeps;
    int32_t division = division_of(whole, STRETCHED_RATE);
    fe__step_constants *usual = paces + FE__USUAL, *strained = paces + FE__STRAINED, *stretched = paces + FE__STRETCHED;
    *usual = constants_of(w, dt, 1);
    usual->open = division > 1 ? OPEN * OPEN : FLT_MAX;
    *strained = constants_of(w, dt, division_of(whole, FINE_RATE));
    strained->strain *= 0.25f;
    strained->forgets = FLT_MAX;
    strained->sweeps = FINE_SWEEPS;
    *stretched = constants_of(w, dt, division);
    stretched->open = 0.25f * usual->open;
}

// speed at which the points of a contact close, before the solver; for hit events
static float approach_of(const fe_world *w, int32_t pair)
{
    const fe__contact *m = w->contacts + pair;
    const fe__body *a = w->bodies + m->body_a, *b = w->bodies + m->body_b;
    fe_vec3 n = {m->normal[0], m->normal[1], m->normal[2]}, span = {m->span[0], m->span[1], m->span[2]};
    fe_vec3 va = {a->velocity[0], a->velocity[1], a->velocity[2]}, wa = {a->spin[0], a->spin[1], a->spin[2]};
    fe_vec3 vb = {b->velocity[0], b->velocity[1], b->velocity[2]}, wb = {b->spin[0], b->spin[1], b->spin[2]};
    float most = 0.0f;
    for (int32_t i = 0; i < (int32_t)m->point_count; ++i) {
        fe_vec3 r = fe__quad_vector(m->point[i].arm);
        fe_vec3 slip = fe__sub(fe__add(vb, fe__cross(wb, fe__add(r, span))), fe__add(va, fe__cross(wa, r)));
        most = fe__maxf(most, -fe__dot(n, slip));
    }
    return most;
}

void fe__solve_islands(fe__step *step)
{
    fe_world *w = step->world;
    for (int32_t i = 0; i < w->awake_pair_count && w->wants_hits; ++i) {
        int32_t pair = fe__pair_of(w->awake_pairs[i]);
        if (w->pairs[pair].events & FE_EVENTS_HIT) w->pairs[pair].approach = approach_of(w, pair);
    }
    fe__step_constants paces[FE__PACES];
    constants_of_paces(w, step->dt, paces);
    fe__solve(&w->solver, w->kernels, &w->workers, w->bodies, w->contacts, w->extras, &w->joints, paces);
    w->last_h = step->constants.h;
    w->last_dt = step->dt;
}

static void count(const fe__step *step)
{
    fe_world *w = step->world;
    const fe__solver *s = &w->solver;
    fe_counters *c = &w->counters;
    c->recycled = atomic_load(&step->scratch->recycled);
    c->islands = s->island_count;
    c->rows = c->rows_whole = c->lanes = c->colours = 0;
    c->trees = step->dt > 0.0f ? atomic_load(&s->engaged) : 0;
    for (int32_t i = 0; i < s->batch_count; ++i) {
        const fe__batch *b = s->batches + i;
        int32_t rows = 0, colours = 0;
        for (int32_t g = b->first_group; g < b->first_group + b->group_count; ++g) {
            if (s->groups[g].kind == FE__TREE_KIND)
                c->trees += w->joints.forest.trees[s->groups[g].lane].heavy;
            else
                rows += s->groups[g].rows;
            colours += g == b->first_group || s->groups[g].colour != s->groups[g - 1].colour;
        }
        c->rows += rows;
        c->rows_whole += i >= s->large_count ? rows : 0;
        c->lanes += b->lane_count;
        c->colours = fe__maxi(c->colours, colours);
    }
}

static fe_result open_scratch(fe_world *w)
{
    if (!w->scratch) w->scratch = fe__allocate(&w->memory, sizeof *w->scratch);
    return w->scratch ? FE_OK : FE_ERROR_MEMORY;
}

fe_result fe__world_step(fe_world *w, float dt)
{
    enum { MILLISECONDS = 1000 };
    if (open_scratch(w) != FE_OK) return FE_ERROR_MEMORY;
    fe__step step = {.world = w, .scratch = w->scratch, .dt = dt, .constants = constants_of(w, dt, 1)};
    fe_profile profile = {.struct_size = sizeof profile};
    double start = fe__clock(), mark = start;
    fe__pool_begin(w->workers.pool);
    for (size_t i = 0; i < sizeof stages / sizeof *stages && !step.failed; ++i) {
        if (stages[i].moves && dt == 0.0f) continue;
        stages[i].run(&step);
        double now = fe__clock();
        *(float *)(void *)((char *)&profile + stages[i].time) += (float)((now - mark) * MILLISECONDS);
        mark = now;
    }
    fe__pool_end(w->workers.pool);
    if (step.failed) return FE_ERROR_MEMORY;
    profile.step = (float)((fe__clock() - start) * MILLISECONDS);
    w->profile = profile;
    w->step_number += 1;
    count(&step);
    return FE_OK;
}

void fe__step_scratch_destroy(fe_world *w)
{
    fe__step_scratch *s = w->scratch;
    fe__memory *memory = &w->memory;
    if (!s) return;
    FE_FREE(memory, s->candidates, s->candidate_capacity);
    FE_FREE(memory, s->results, s->result_capacity);
    FE_FREE(memory, s->busy, s->busy_capacity);
    FE_FREE(memory, s->left, s->left_capacity);
    FE_FREE(memory, s->boxes, s->box_capacity);
    FE_FREE(memory, s->chased, s->chased_capacity);
    FE_FREE(memory, s->chases, s->chase_capacity);
    FE_FREE(memory, s->island_timers, s->island_capacity);
    FE_FREE(memory, s->sort_items, s->sort_capacity);
    fe__release(memory, s, sizeof *s);
    w->scratch = NULL;
}
