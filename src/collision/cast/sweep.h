// sweep.h - a form that moves without turning, against a form that stands.
//
// The queries call it with both forms in the frame of the standing one, in double. It works on the exact forms: no
// skin, no shrinking. A sweep stops FE_SWEEP_GAP before the other form, so that rounding never carries it in. An
// overlap of more than a touch at the start is a hit at t = 0. A form that starts within the gap and comes nearer stops
// at once. A form that does not come nearer never hits, however close it passes.
#ifndef FE_COLLISION_CAST_SWEEP_H
#define FE_COLLISION_CAST_SWEEP_H
#include "collision/cast/approach.h"

// Finds the first t in [0, limit] at which the forms meet. 1: hit
int32_t fe__form_sweep(const fe__form *still, const fe__mover *mover, double limit, fe__sweep_hit *hit);
// 1: a sweep from there would start inside.
int32_t fe__form_overlap(const fe__form *still, const fe__mover *mover);

// The same for a heightfield or a mesh, in its frame. Holes let everything through, and a triangle is met from the side
// that counts: a form that comes from the other side passes. A form that cuts the surface overlaps it.
int32_t fe__ground_sweep(const fe__ground *surface, const fe__mover *mover, double limit, fe__sweep_hit *hit);
int32_t fe__ground_overlap(const fe__ground *surface, const fe__mover *mover);

#endif
