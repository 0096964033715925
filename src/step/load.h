// load.h - the load that one body of a pair puts on the other, and whether what was chosen of their faces still holds
// it.
//
// Called by the narrow phase before it looks for points, and by the events stage after the solver.
#ifndef FE_STEP_LOAD_H
#define FE_STEP_LOAD_H
#include "step/stages.h"

// The line of the forces on the body above, as far as they are known: gravity, and those that were called for. In the
// frame of v's A. What others do to the body shows in the pressure of the last step alone; but a body that rocks has
// that now here, now there, and an edge chosen by it turns with it.
fe__load fe__load_on_corners(const fe_world *world, int32_t pair, const fe__places *at, const fe__view *v);

// Does a face of it have more corners than a manifold has points?
static inline int32_t fe__has_many_corners(const fe__form *form)
{
    return fe__form_is_curved(form) || fe__form_is_hull(form);
}

// Of forms whose faces have few corners the load chooses nothing.
static inline int32_t fe__load_chooses(const fe__view *v)
{
    return fe__has_many_corners(&v->a->form) || fe__has_many_corners(&v->b->form);
}

// The load on a pair, for the kernel that asks. What it points to stays as long as it does.
typedef struct fe__pair_load {
    fe__load_asked asked;
    const fe_world *world;
    int32_t pair;
    const fe__places *at;
    const fe__view *v;
} fe__pair_load;

fe__load fe__tell_pair_load(const fe__load_asked *asked); // of a fe__pair_load

// Of a pair whose points were chosen by the load: 1: the load is near the edge of what they span, and others may hold
// it better
int32_t fe__load_outgrows(const fe_world *world, int32_t pair);

#endif
