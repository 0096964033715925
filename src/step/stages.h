// stages.h - the step: all its stages, in order.
#ifndef FE_STEP_STAGES_H
#define FE_STEP_STAGES_H
#include "collision/manifold/manifold.h"
#include "world/world.h"
#include "world/world_memory.h"

// FE_ERROR_MEMORY: nothing happened.
fe_result fe__world_step(fe_world *world, float dt);

// The same in two halves, for worlds that are solved together: the second begins with the stage that solves
typedef struct fe__open_step {
    fe__step step;
    fe_profile profile;
    int32_t is_timed; // 1: each stage; 0: none
    double mark;      // when the last stage ended, s
    int32_t next;     // stage
} fe__open_step;

// FE_ERROR_MEMORY: nothing happened, and there is no second half
fe_result fe__step_begin(fe__open_step *open, fe_world *world, float dt, int32_t is_timed);
void fe__step_resume(fe__open_step *open); // it is solved already
void fe__step_end(fe__open_step *open);

// ---- finalize -------------------------------------------------------------------------------------------------------
// The stages after the solver.

void fe__move_bodies(fe__step *step);          // poses, bounds, trees
void fe__put_islands_to_sleep(fe__step *step); // those slow for long enough
void fe__give_back_rows(fe__step *step);       // a sleeping world keeps none; last, as they are what is sorted in

// ---- find pairs -----------------------------------------------------------------------------------------------------
// The stage that finds new pairs.

void fe__find_new_pairs(fe__step *step); // queries of moved proxies -> candidates; reserves all; new pairs

// ---- reserve --------------------------------------------------------------------------------------------------------
// All memory that a step can need.

// ---- reserve --------------------------------------------------------------------------------------------------------

int32_t fe__reserve_step(fe__step *step); // 0: no memory, nothing changed

// ---- due ------------------------------------------------------------------------------------------------------------
// Which of the deferred pairs get points in this step.

// Lists the deferred pairs that meet in this step in fe__step_scratch.busy, and counts them and those that wait on.
// The collide stage ends their deferral. 0: no memory
int32_t fe__find_due(fe__step *step);
// What was found of those that wait on becomes the world's, or is forgotten when the step failed.
void fe__keep_waiting(fe__step *step);

// ---- solve stage ----------------------------------------------------------------------------------------------------
// The stage that solves.

// of a step of dt seconds with each substep divided into so many
fe__step_constants fe__constants_of(const fe_world *world, float dt, int32_t division);
void fe__solve_islands(fe__step *step); // all substeps -> velocities, motion, impulses

// Its parts, for worlds that are solved together
int32_t fe__solves_alike(const fe_world *world,
                         const fe_world *other);   // 1: by the same constants, in steps of one length
fe__records fe__begin_solve(const fe__step *step); // what is solved of this one
// ... with others' records, by the constants of this one
void fe__solve_with(const fe__step *step, fe__solver *solver, const fe__records *of);
void fe__end_solve(const fe__step *step);

// ---- update contacts ------------------------------------------------------------------------------------------------
// The stages of contacts and of the constraint graph.

void fe__update_contacts(fe__step *step); // narrow phase or recycling -> manifolds, begin and end, wakes
void fe__build_islands(fe__step *step);   // the graph, when it changed
// A pair without points may move by `slack`, m, before it is looked at again
void fe__defer_pair(const fe__step *step, int32_t pair, float slack);
void fe__sort_pairs(fe__step *step, int32_t *pairs, int32_t count); // by the creation of their shapes
// Awake pairs that do not wait, good until one of them does
const int32_t *fe__busy_pairs(fe__step *step, int32_t *out_count);

// ---- events ---------------------------------------------------------------------------------------------------------
// The stages that report.

// ---- events ---------------------------------------------------------------------------------------------------------

void fe__collect_events(fe__step *step);      // touching begun, kept, ended; impacts
void fe__collect_body_events(fe__step *step); // who woke, who fell asleep

// Of a pair: sum of the impulses, fastest approach; point and normal where the impulse is largest.
typedef struct fe__hit_impact {
    float impulse, largest, approach;
    int32_t pair, point; // the pair or a patch of it
} fe__hit_impact;
fe__hit_impact fe__impact_of(const fe_world *world, int32_t pair);
void fe__add_hit(fe_world *world, int32_t pair, const fe__hit_impact *sum); // if it is fast enough
// A pair that was looked at begins or ceases to touch. What it has to report: fe_event_kind, 0: nothing
int32_t fe__settle_pair(fe__step *step, int32_t pair);

// ---- break joints ---------------------------------------------------------------------------------------------------
// The stage that removes joints which bore too much.

void fe__break_joints(fe__step *step);

// ---- view -----------------------------------------------------------------------------------------------------------
// A pair as the narrow phase sees it: one shape in the frame of the other, the bodies at some time of the
// step.

typedef struct fe__view {
    const fe__shape *a, *b; // fe__collide's
    fe__form form_a;        // a plane's is moved next to B
    fe__relative relative;
    fe_dvec3 origin; // of the frame of A, world
    fe__mat3 rotation;
} fe__view;

// where the two bodies are when the manifold is looked for: the solver's A and B
typedef struct fe__places {
    fe_dvec3 centre_a, centre_b;
    fe_quat rotation_a, rotation_b;
} fe__places;

// ---- sleepers -------------------------------------------------------------------------------------------------------
// Whom a contact wakes: what sleeps wakes by a touch, and not because something passes close by.

// Does the pair, which has points, leave one of its two asleep, because they cannot touch within the step? Asked when
// the manifolds of all pairs are known
int32_t fe__pair_lets_sleep(const fe__step *step, int32_t pair);

// ---- prediction -----------------------------------------------------------------------------------------------------
// The first touch of a pair in the step to come, as if nothing else were there.
//
// For the narrow phase (narrowphase.c), on any thread, of pairs that may outrun their thickness within the step.
// Nothing is written.

// 1: they touch within the step, first there; 0: they pass each other by, or one of them meets something fixed before,
// which turns it away, or has turned so far by then that its contact must wait for the next step (continuous.c stops
// it). Not for heightfields.
int32_t fe__pair_touches_ahead(const fe_world *world, int32_t pair, float dt, fe__places *out_touch);

// Do they meet within the step, if each moves as it does now? Not for heightfields and meshes: they are not convex.
int32_t fe__pair_meets_ahead(const fe_world *world, int32_t pair, float dt);
// The same for a pair with one, of whose triangles each is. What lies under the surface meets none of them.
int32_t fe__field_meets_ahead(const fe_world *world, int32_t pair, float dt);

#endif
