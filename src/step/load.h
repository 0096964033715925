// load.h - the load that one body of a pair puts on the other, and whether the points that were chosen by it still hold
// it.
//
// The narrow phase's kernels ask for the load where they choose among many corners (fe__tell_pair_load); the events
// stage, after the solver, asks whether the choice still holds.
#ifndef FE_STEP_LOAD_H
#define FE_STEP_LOAD_H
#include "step/stages.h"

// A question about a pair, for the kernel to ask. The pointers are valid as long as it is.
typedef struct fe__pair_load {
    fe__load_asked asked;
    const fe_world *world;
    int32_t pair;
    const fe__places *at;
    const fe__view *v;
} fe__pair_load;

// Answers an fe__pair_load: the line of the known forces on the body above, gravity and those that were called for, in
// the frame of v's A; and the corners that were chosen last. What others do to the body shows in the pressure of the
// last step alone; but a body that rocks has that now here, now there, and an edge chosen by it turns with it.
fe__load fe__tell_pair_load(const fe__load_asked *asked);

// 1: the load chooses points, because a face of one of the forms has more corners than a manifold has points.
static inline int32_t fe__load_chooses(const fe__view *v)
{
    return fe__form_is_curved(&v->a->form) || fe__form_is_hull(&v->a->form) || fe__form_is_curved(&v->b->form) ||
           fe__form_is_hull(&v->b->form);
}

// For a pair whose points were chosen by the load. 1: the load is near the edge of what they span, and others may hold
// it better
int32_t fe__load_outgrows(const fe_world *world, int32_t pair);

#endif
