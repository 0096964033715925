// solve_stage.c - see stages.h. The constants of each pace of substeps, and the speeds of impacts before the
// solver.
#include "step/stages.h"

#include "solver/solve.h"
#include "world/contact.h"

#include <float.h>
#include <string.h>

// Impulses of rest grow with the substep, those of an impact do not: after a much shorter substep they are too large a
// guess
#define MOST_WARM_SCALE 16.0f

// An island is strained by a load that lasts and could accelerate a body by so many times gravity (a stack of 40 equal
// boxes), until it is less than half of that. Without gravity that of the earth counts.
#define STRAIN 80.0f
#define STAYS_STRAINED 0.5f // of it
// Impulses pass on by a body or so in a rigid pass, and the impact of a body hundreds of times as heavy needs hundreds:
// it arrives late, with the bodies between deep in each other. In a strained island substeps are about a thousandth of
// a second, of three passes.
#define FINE_RATE 960.0f
enum { MOST_DIVISION = 16, FINE_SWEEPS = 3 };
// A net of joints that bears more than its substeps can pass on opens. From ten times the linear slop on it is
// stretched, and has substeps as short as by default, until no joint is open by half as much.
#define STRETCHED_RATE 480.0f
#define STRETCHED_GAP 0.05f // m

// An impact stops more than this within a substep, m/s, and more than so many times what gravity gives in one. What is
// set down, or gets new points of contact, takes up its weight at once too; its friction is no impact's, and without it
// the body would begin to slide.
#define IMPACT_SPEED 0.05f
#define IMPACT_WEIGHT 1.5f

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

// Hertz are limited to what the world's substeps can follow: contacts' to an eighth of their rate, against static
// bodies to a quarter. Joints': of a mode of many rows a pass puts right only a small share. It swings at sqrt(2 share)
// / h, the pushes of the soft pass add up in its impulses, and its amplitude grows by 1 + (x^2 - 2) fade / 4 a substep,
// x = 2 pi hertz h, less what the passes take. So x^2 < 2, 0.225 of the rate. Contacts against static bodies are
// stiffer than that, but end modes of softer ones.

fe__step_constants fe__constants_of(const fe_world *w, float dt, int32_t division)
{
    const fe_world_tuning *t = &w->tuning;
    float whole = dt / (float)w->substeps, rate = whole > 0.0f ? 1.0f / whole : 0.0f,
          hertz = fe__minf(t->contact_hertz, FE__MOST_CONTACT_HERTZ * rate);
    float h = whole / (float)division;
    fe__step_constants c = {.h = h,
                            .inverse_h = h > 0.0f ? 1.0f / h : 0.0f,
                            .bias_speed = t->contact_push_speed,
                            .threshold = t->restitution_threshold,
                            .warm_scale = w->last_h > 0.0f
                                              ? fe__minf(whole / w->last_h, MOST_WARM_SCALE) / (float)division
                                              : 0.0f,
                            .max_speed = t->max_linear_speed,
                            .speculative = t->speculative_distance,
                            .strain = strain_of(w, dt),
                            .substeps = w->substeps * division,
                            .division = division,
                            .sweeps = 1,
                            .gravity = w->gravity};
    c.impact = fe__maxf(IMPACT_SPEED, IMPACT_WEIGHT * h * __builtin_sqrtf(fe__dot(w->gravity, w->gravity)));
    c.contact_warm_scale = t->warm_start_enabled ? c.warm_scale : 0.0f;
    c.joint_hertz = FE__MOST_JOINT_HERTZ * rate;
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
    *usual = fe__constants_of(w, dt, 1);
    usual->open = division > 1 ? STRETCHED_GAP * STRETCHED_GAP : FLT_MAX;
    *strained = fe__constants_of(w, dt, division_of(whole, FINE_RATE));
    strained->strain *= STAYS_STRAINED;
    strained->sweeps = FINE_SWEEPS;
    *stretched = fe__constants_of(w, dt, division);
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
        fe_vec3 r = fe__quad_vector(fe__points_of(w, m)->point[i].arm);
        fe_vec3 slip = fe__sub(fe__add(vb, fe__cross(wb, fe__add(r, span))), fe__add(va, fe__cross(wa, r)));
        most = fe__maxf(most, -fe__dot(n, slip));
    }
    return most;
}

static void note_approaches(fe_world *w)
{
    for (int32_t i = 0; i < w->awake_pair_count && w->wants_hits; ++i) {
        int32_t pair = fe__pair_of(w->awake_pairs[i]);
        if (w->pairs[pair].events & FE_SHAPE_EVENTS_HIT && w->contacts[pair].points)
            w->features[w->contacts[pair].points].approach = approach_of(w, pair);
    }
}

int32_t fe__solves_alike(const fe_world *w, const fe_world *other)
{
    return w->substeps == other->substeps && w->last_h == other->last_h &&
           !memcmp(&w->gravity, &other->gravity, sizeof w->gravity) &&
           !memcmp(&w->tuning, &other->tuning, sizeof w->tuning);
}

static fe__records records_of(fe_world *w)
{
    return (fe__records){.contacts = w->contacts,
                         .points = w->points,
                         .extras = w->extras,
                         .serials = w->point_serials,
                         .bodies = w->bodies,
                         .joints = w->joints,
                         .engaged = &w->solver.engaged};
}

fe__records fe__begin_solve(const fe__step *step)
{
    note_approaches(step->world);
    return records_of(step->world);
}

void fe__solve_with(const fe__step *step, fe__solver *solver, const fe__records *of)
{
    const fe_world *w = step->world;
    fe__step_constants paces[FE__PACES];
    constants_of_paces(w, step->dt, paces);
    fe__solve(solver, w->kernels, &w->workers, of, paces);
}

void fe__end_solve(const fe__step *step)
{
    const fe__records of = records_of(step->world);
    fe__note_solved(&step->world->solver, step->world->kernels, &of);
    step->world->last_h = step->constants.h;
    step->world->last_dt = step->dt;
}

void fe__solve_islands(fe__step *step)
{
    fe__solver *s = &step->world->solver;
    atomic_store(&s->engaged, 0);
    if (s->batch_count) { // else all sleep; there may be no lines at all
        const fe__records of = fe__begin_solve(step);
        fe__solve_with(step, s, &of);
    }
    fe__end_solve(step);
}
