// solve_stage.c - the stage that solves: the constants of each pace of substeps, and the speeds of impacts before the
// solver.
//
// Input: the world's records and settings. The solver (solver/solve.h) writes velocities, motions and impulses.
#include "step/stages.h"

#include "solver/solve.h"
#include "world/contact.h"

#include <float.h>
#include <string.h>

// Impulses of rest grow with the substep, impulses of an impact do not: after a much shorter substep they are too large
// a guess.
#define MOST_WARM_SCALE 16.0f

// An island is strained by a load that lasts and could accelerate a body by so many times gravity (a stack of 40 equal
// boxes), until the load is less than half of that. Without gravity the earth's counts.
#define STRAIN 80.0f
#define STAYS_STRAINED 0.5f // share of STRAIN
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

// Into how many parts a substep of h seconds is divided, so that there are `rate` of them in a second.
static int32_t division_of(float h, float rate)
{
    int32_t division = 1;
    while (division < MOST_DIVISION && (float)division < 0.99f * rate * h) ++division;
    return division;
}

// Hertz are limited to what the world's substeps can follow: contacts' to an eighth of the substep rate, against static
// bodies to a quarter. Joints' to 0.225 of it: a pass corrects only a small share of a mode of many rows. The mode
// swings at sqrt(2 share) / h, the pushes of the soft pass add up in its impulses, and its amplitude grows by 1 + (x^2
// - 2) fade / 4 a substep, x = 2 pi hertz h, less what the passes take; so x^2 < 2. Contacts against static bodies are
// stiffer than that, but end modes of softer ones.

fe__step_constants fe__constants_of(const fe_world *world, float dt, int32_t division)
{
    const fe_world_tuning *t = &world->tuning;
    float whole = dt / (float)world->substeps, rate = whole > 0.0f ? 1.0f / whole : 0.0f,
          hertz = fe__minf(t->contact_hertz, FE__MOST_CONTACT_HERTZ * rate);
    float h = whole / (float)division, square = fe__dot(world->gravity, world->gravity);
    fe__step_constants c = {.h = h,
                            .inverse_h = h > 0.0f ? 1.0f / h : 0.0f,
                            .bias_speed = t->contact_push_speed,
                            .threshold = t->restitution_threshold,
                            .warm_scale = world->last_h > 0.0f
                                              ? fe__minf(whole / world->last_h, MOST_WARM_SCALE) / (float)division
                                              : 0.0f,
                            .max_speed = t->max_linear_speed,
                            .speculative = t->speculative_distance,
                            .strain = STRAIN * dt * (square > 0.0f ? __builtin_sqrtf(square) : 9.81f),
                            .substeps = world->substeps * division,
                            .division = division,
                            .sweeps = 1,
                            .gravity = world->gravity};
    c.impact = fe__maxf(IMPACT_SPEED, IMPACT_WEIGHT * h * __builtin_sqrtf(square));
    c.contact_warm_scale = t->warm_start_enabled ? c.warm_scale : 0.0f;
    c.joint_hertz = FE__MOST_JOINT_HERTZ * rate;
    c.joint = fe__make_softness(fe__minf(t->joint_hertz, c.joint_hertz), t->joint_damping_ratio, h);
    c.between_dynamic = fe__make_softness(hertz, t->contact_damping_ratio, h);
    c.against_static = fe__make_softness(fe__minf(2.0f * t->contact_hertz, 0.25f * rate), t->contact_damping_ratio, h);
    return c;
}

static void set_constants_of_paces(const fe_world *world, float dt, fe__step_constants paces[FE__PACES])
{
    float whole = dt / (float)world->substeps;
    int32_t division = division_of(whole, STRETCHED_RATE);
    fe__step_constants *usual = paces + FE__USUAL, *strained = paces + FE__STRAINED, *stretched = paces + FE__STRETCHED;
    *usual = fe__constants_of(world, dt, 1);
    usual->open = division > 1 ? STRETCHED_GAP * STRETCHED_GAP : FLT_MAX;
    *strained = fe__constants_of(world, dt, division_of(whole, FINE_RATE));
    strained->strain *= STAYS_STRAINED;
    strained->sweeps = FINE_SWEEPS;
    *stretched = fe__constants_of(world, dt, division);
    stretched->open = 0.25f * usual->open;
}

// The speed at which the points of a contact close, m/s
static float approach_of(const fe_world *world, int32_t pair)
{
    const fe__contact *contact = world->contacts + pair;
    const fe__points *points = fe__points_of(world, contact);
    const fe__body *a = world->bodies + contact->body_a, *b = world->bodies + contact->body_b;
    fe_vec3 n = fe__quad_vector(contact->normal), span = fe__quad_vector(contact->span);
    fe_vec3 va = fe__quad_vector(a->velocity), wa = fe__quad_vector(a->spin);
    fe_vec3 vb = fe__quad_vector(b->velocity), wb = fe__quad_vector(b->spin);
    float most = 0.0f;
    for (int32_t i = 0; i < (int32_t)contact->point_count; ++i) {
        fe_vec3 r = fe__quad_vector(points->point[i].arm);
        fe_vec3 slip = fe__sub(fe__add(vb, fe__cross(wb, fe__add(r, span))), fe__add(va, fe__cross(wa, r)));
        most = fe__maxf(most, -fe__dot(n, slip));
    }
    return most;
}

int32_t fe__solves_alike(const fe_world *world, const fe_world *other)
{
    return world->substeps == other->substeps && world->last_h == other->last_h &&
           !memcmp(&world->gravity, &other->gravity, sizeof world->gravity) &&
           !memcmp(&world->tuning, &other->tuning, sizeof world->tuning);
}

static fe__records records_of(fe_world *world)
{
    return (fe__records){.contacts = world->contacts,
                         .points = world->points,
                         .extras = world->extras,
                         .serials = world->point_serials,
                         .bodies = world->bodies,
                         .joints = world->joints,
                         .engaged = &world->solver.engaged};
}

fe__records fe__begin_solve(const fe__step *step)
{
    fe_world *world = step->world;
    for (int32_t i = 0; i < world->awake_pair_count && world->wants_hits; ++i) {
        int32_t pair = fe__pair_of(world->awake_pairs[i]);
        if (world->pairs[pair].events & FE_SHAPE_EVENTS_HIT && world->contacts[pair].points)
            world->features[world->contacts[pair].points].approach = approach_of(world, pair);
    }
    return records_of(world);
}

void fe__solve_with(const fe__step *step, fe__solver *solver, const fe__records *of)
{
    const fe_world *world = step->world;
    fe__step_constants paces[FE__PACES];
    set_constants_of_paces(world, step->dt, paces);
    fe__solve(solver, world->kernels, &world->workers, of, paces);
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
    if (s->batch_count) { // else all bodies sleep, and there may be no lines at all
        const fe__records of = fe__begin_solve(step);
        fe__solve_with(step, s, &of);
    }
    fe__end_solve(step);
}
