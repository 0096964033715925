// buried.h - shapes with so many neighbours at once that not all of them are found: of thousands born in one point each
// would meet all others.
//
// A shape of a dynamic body is buried when it meets more than FE__BURIED_BY others, all of them new to it. A shape that
// is not buried finds all that it meets, buried or not. A pair of two buried shapes is found when they are near each
// other in the order of fe__find_beside. So n shapes in a point are searched in n log n, and the memory for what is
// found is linear in n. The result does not depend on the form of the trees, on slots or on workers.
#ifndef FE_STEP_BURIED_H
#define FE_STEP_BURIED_H
#include "world/world_memory.h"

enum { FE__BURIED_BY = 256, FE__BESIDE = 24 };

// 1: a shape of a dynamic body that is no trigger
static inline int32_t fe__may_be_buried(const fe_world *world, int32_t shape)
{
    const fe__shape *s = world->shapes + shape;
    return world->bodies[s->body].type == FE_BODY_DYNAMIC && !(s->flags & FE__SHAPE_TRIGGER);
}

// Finds fe__step_scratch.buried. 0: no memory
int32_t fe__find_buried(fe__step *step);
// Appends the pairs of two buried shapes to the candidates, whose capacity holds FE__BESIDE for each. 0: no memory
int32_t fe__find_beside(fe__step *step);
// Buried shapes of bodies that are awake look again in the next step.
void fe__buried_keep_looking(fe__step *step);

// How many pairs of two buried shapes were not looked at, at least: each shape meets many, and looks at those beside
// it.
static inline int64_t fe__buried_left_out(const fe__step_scratch *scratch)
{
    return fe__maxl(atomic_load(&scratch->buried_meetings) / 2 - (int64_t)scratch->buried_count * FE__BESIDE, 0);
}

#endif
