// motion_path.h - the swept motion of a body: where it is at any time of the step, between solver and finalize.
//
// A path has straight pieces, the legs: one, or for a body that left a trail in the solver as many as the trail has.
// The continuous stage reads it on any thread: nothing of the world is written.
#ifndef FE_CONTINUOUS_MOTION_PATH_H
#define FE_CONTINUOUS_MOTION_PATH_H
#include "collision/cast/toi.h"
#include "world/world_memory.h"

// ---- motion path ----------------------------------------------------------------------------------------------------

// A body's motion since the step began: the shift of its centre, and its rotation, w >= 0.
typedef struct fe__shift {
    fe_dvec3 centre; // m
    fe_quat rotation;
} fe__shift;

int32_t fe__path_legs(const fe__step *step, int32_t body);                 // straight pieces
double fe__path_time(const fe__step *step, int32_t body, int32_t leg);     // when a leg begins: 0..1 of the step
fe__shift fe__path_place(const fe__step *step, int32_t body, int32_t leg); // motion until a leg begins
fe__shift fe__shift_between(const fe__shift *a, const fe__shift *b, double t);
fe__shift fe__path_at(const fe__step *step, int32_t body, double time);
// The motion from one time to another, in a frame at `base`, m
fe__motion fe__path_motion(const fe__step *step, int32_t body, double from, double until, fe_dvec3 base);
fe__motion fe__motion_of_shifts(const fe__body *body, const fe__shift *from, const fe__shift *to, fe_dvec3 base);
fe__mobile fe__mobile_of_shape(const fe__step *step, const fe__shape *shape, const fe__motion *motion);
float fe__path_length(const fe__step *step, int32_t body); // no point of the body went farther, m

// ---- energy ---------------------------------------------------------------------------------------------------------
// A body that stands does no work. But a contact that threw a body into a fast spin holds it for the rest of the step
// by the arms of its beginning, and may give it energy that nothing has. A body that was pushed by static ones only
// ends with no more than it had and gravity gave. Called by the continuous stage for the fast bodies, between solver
// and finalize, on any thread; writes the body's line of velocities.

void fe__limit_energy(const fe__step *step, int32_t body);

// Scales the velocity of a body that was put `change` (m) away from where gravity took it, so that v^2 / 2 - g . x
// stays.
void fe__give_back(const fe_world *world, const fe__body *body, fe_vec3 change, float *velocity);

#endif
