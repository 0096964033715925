// stages.h - the step: its stages in order, and what one stage asks of another.
//
// A stage reads and writes fe__step.world and its scratch (world/world_memory.h). step.c runs them.
#ifndef FE_STEP_STAGES_H
#define FE_STEP_STAGES_H
#include "collision/manifold/manifold.h"
#include "world/world.h"
#include "world/world_memory.h"

// ---- step -----------------------------------------------------------------------------------------------------------

// FE_ERROR_MEMORY: nothing happened.
fe_result fe__world_step(fe_world *world, float dt);

// The same in two halves, for worlds that are solved together: the second half begins with the stage that solves.
typedef struct fe__open_step {
    fe__step step;
    fe_profile profile;
    int32_t is_timed; // 1: each stage; 0: none
    double mark;      // when the last stage ended, s
    int32_t next;     // stage
} fe__open_step;

// FE_ERROR_MEMORY: nothing happened, and there is no second half.
fe_result fe__step_begin(fe__open_step *open, fe_world *world, float dt, int32_t is_timed);
void fe__step_resume(fe__open_step *open); // leaves out the stage that solves: it was done with others
void fe__step_end(fe__open_step *open);

// ---- stages ---------------------------------------------------------------------------------------------------------

void fe__find_new_pairs(fe__step *step);       // find_pairs.c: trees -> new pairs; reserves all memory
void fe__update_contacts(fe__step *step);      // update_contacts.c: narrow phase or recycling -> manifolds; wakes
void fe__build_islands(fe__step *step);        // update_contacts.c: the constraint graph, when it changed
void fe__solve_islands(fe__step *step);        // solve_stage.c: all substeps -> velocities, motion, impulses
void fe__move_bodies(fe__step *step);          // finalize.c: poses, bounds, trees
void fe__break_joints(fe__step *step);         // events.c: removes joints whose reactions exceeded their limits
void fe__collect_events(fe__step *step);       // events.c: touching begun, kept, ended; impacts
void fe__put_islands_to_sleep(fe__step *step); // finalize.c: islands that were slow for long enough
void fe__collect_body_events(fe__step *step);  // events.c: bodies that woke or fell asleep
void fe__give_back_rows(fe__step *step); // finalize.c: a sleeping world keeps no rows; last, as others sort in them

// ---- reserve.c: memory, and the skip test of deferred pairs ---------------------------------------------------------

// Lists the deferred pairs that meet in this step in fe__step_scratch.active, and counts them and those that stay
// deferred. 0: no memory
int32_t fe__find_expired(fe__step *step);
// Reserves all memory that the step can need. 0: no memory, nothing changed
int32_t fe__reserve_step(fe__step *step);
// Renews the deferrals of the others, or undoes what is noted of them when the step failed.
void fe__apply_skip_notes(fe__step *step);

// ---- update_contacts.c ----------------------------------------------------------------------------------------------

// A pair without points may move by `slack`, m, before it is looked at again.
void fe__defer_pair(const fe__step *step, int32_t pair, float slack);
void fe__sort_pairs(fe__step *step, int32_t *pairs, int32_t count); // by the creation of their shapes
// Awake pairs that are not deferred, valid until one of them is.
const int32_t *fe__active_pairs(fe__step *step, int32_t *out_count);

// ---- solve_stage.c: its parts, for worlds that are solved together --------------------------------------------------

// The constants of a step of dt seconds whose substeps are divided into `division` each.
fe__step_constants fe__constants_of(const fe_world *world, float dt, int32_t division);
// 1: both are solved by the same constants, in steps of one length
int32_t fe__solves_alike(const fe_world *world, const fe_world *other);
fe__records fe__begin_solve(const fe__step *step); // returns what is solved of this world
// Solves the records of several worlds in one solver, by the constants of this one.
void fe__solve_with(const fe__step *step, fe__solver *solver, const fe__records *of);
void fe__end_solve(const fe__step *step);

// ---- pair view ------------------------------------------------------------------------------------------------------
// A pair as the narrow phase sees it: one shape in the frame of the other, the bodies at some time of the step.

typedef struct fe__view {
    const fe__shape *a, *b; // fe__collide's A and B
    fe__form form_a;        // form of A; a plane's is moved next to B
    fe__relative relative;  // B in the frame of A
    fe_dvec3 origin;        // A's frame, world
    fe__mat3 rotation;      // A's frame, world
} fe__view;

// Poses of the two bodies for which a manifold is looked for: the solver's A and B.
typedef struct fe__places {
    fe_dvec3 centre_a, centre_b; // centres of mass
    fe_quat rotation_a, rotation_b;
} fe__places;

// ---- sleepers.c -----------------------------------------------------------------------------------------------------
// A touch wakes a sleeping body, and what merely passes close by does not.

// 1: the pair, which has points, leaves one of its two bodies asleep, because they cannot touch within the step. Asked
// when the manifolds of all pairs are known.
int32_t fe__pair_lets_sleep(const fe__step *step, int32_t pair);

// ---- prediction.c ---------------------------------------------------------------------------------------------------
// The first touch of a pair in the step to come, if each body moves as it does now and nothing else were there. Called
// by the narrow phase on any thread, for pairs that may outrun their thickness within the step. Nothing is written.

// 1: they touch within the step, first in these poses. 0: they pass each other by; or one of them meets something fixed
// before, which turns it away; or one has turned so far by then that its contact must wait for the next step
// (continuous.c stops it). Not for heightfields.
int32_t fe__predict_touch(const fe_world *world, int32_t pair, float dt, fe__places *out_touch);
// 1: they meet within the step. Not for heightfields and meshes, which are not convex.
int32_t fe__predicts_meeting(const fe_world *world, int32_t pair, float dt);
// The same for a pair with a heightfield or mesh, against each of its triangles. What lies under the surface meets
// none.
int32_t fe__predicts_field_meeting(const fe_world *world, int32_t pair, float dt);

#endif
