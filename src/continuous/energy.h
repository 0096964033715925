// energy.h - what stands does no work.
//
// A contact that threw a body into a fast spin holds it for the rest of the step by the arms of its beginning, and may
// give it energy that nothing has. A body that was pushed by static ones only ends with no more than it had and gravity
// gave. Called by the continuous stage for the fast bodies, between solver and finalize, on any thread; writes the
// body's line of velocities.
#ifndef FE_CONTINUOUS_ENERGY_H
#define FE_CONTINUOUS_ENERGY_H
#include "world/step_scratch.h"

void fe__limit_energy(const fe__step *step, int32_t body);

// v' so that v'^2 / 2 - g . x stays where a body is put `change` (m) away from where gravity took it
void fe__give_back(const fe_world *world, const fe__body *body, fe_vec3 change, float *velocity);

#endif
