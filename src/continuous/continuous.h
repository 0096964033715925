// continuous.h - the stage between solver and finalize: motions end where something stood in the way.
#ifndef FE_CONTINUOUS_CONTINUOUS_H
#define FE_CONTINUOUS_CONTINUOUS_H
#include "world/world_memory.h"

// ---- continuous -----------------------------------------------------------------------------------------------------

void fe__stop_fast_bodies(fe__step *step);

// ---- chase ----------------------------------------------------------------------------------------------------------
// One body that outran its thickness: where it ends.

// Follows a body on its motion path until something of that sort (FE__AGAINST_*) stands there. On any thread: writes
// *chase only
void fe__sweep_body(const fe__step *step, int32_t body, int32_t against, fe__sweep_end *chase);
void fe__apply_sweep(fe_world *world, int32_t body, const fe__sweep_end *chase); // to its line
// Against what is static or kinematic, both at once. 1: it was stopped
int32_t fe__stop_body(const fe__step *step, int32_t body);

#endif
