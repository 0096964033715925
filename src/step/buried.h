// buried.h - shapes with so many neighbours at once that not all of them are found: of thousands born in one point each
// would meet all others.
//
// A shape of a dynamic body that meets more than FE__BURIED_BY others, all of them new to it, is buried. Who is not,
// finds all that it meets, buried or not. Of two that are both buried, a pair is found when they are near each other in
// the order of fe__find_beside. So n shapes in a point are searched in n log n, and the memory for what is found is
// linear in n. Who is buried, and what is found, does not hang on the trees' form, on slots or workers.
#ifndef FE_STEP_BURIED_H
#define FE_STEP_BURIED_H
#include "world/world_memory.h"

enum { FE__BURIED_BY = 256, FE__BESIDE = 24 };

// Only a shape of a dynamic body that is no trigger may be.
static inline int32_t fe__may_be_buried(const fe_world *w, int32_t shape)
{
    const fe__shape *s = w->shapes + shape;
    return w->bodies[s->body].type == FE_BODY_DYNAMIC && !(s->flags & FE__SHAPE_TRIGGER);
}

// Finds fe__step_scratch.buried. 0: no memory
int32_t fe__find_buried(fe__step *step);
// Appends to the candidates, which have room for FE__BESIDE with each. 0: no memory
int32_t fe__find_beside(fe__step *step);
// Those that are awake look again in the next step
void fe__buried_keep_looking(fe__step *step);

// Pairs of two buried shapes that were not looked at, at least: of those that meet, each looks at those beside it
static inline int64_t fe__buried_left_out(const fe__step_scratch *s)
{
    return fe__maxl(atomic_load(&s->buried_meetings) / 2 - (int64_t)s->buried_count * FE__BESIDE, 0);
}

#endif
