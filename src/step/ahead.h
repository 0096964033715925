// ahead.h - the first touch of a pair in the step to come, as if nothing else were there.
//
// For the narrow phase (narrow.c), on any thread, of pairs that may outrun their thickness within the step. Nothing is
// written.
#ifndef FE_STEP_AHEAD_H
#define FE_STEP_AHEAD_H
#include "step/view.h"

// 1: they touch within the step, first there; 0: they pass each other by, or one of them meets something fixed before,
// which turns it away, or has turned so far by then that its contact must wait for the next step (continuous.c stops
// it). Not for heightfields.
int32_t fe__pair_touches_ahead(const fe_world *world, int32_t pair, float dt, fe__places *out_touch);

// Do they meet within the step, if each moves as it does now? Not for heightfields and meshes: they are not convex.
int32_t fe__pair_meets_ahead(const fe_world *world, int32_t pair, float dt);
// The same for a pair with one, of whose triangles each is. What lies under the surface meets none of them.
int32_t fe__field_meets_ahead(const fe_world *world, int32_t pair, float dt);

#endif
