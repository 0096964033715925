// filter.h - who may touch whom.
#ifndef FE_WORLD_FILTER_H
#define FE_WORLD_FILTER_H
#include "world/contact.h"
#include "world/world.h"

// May these two shapes have a pair? Kinds of bodies, layers, ignored pairs, joints.
int32_t fe__may_collide(const fe_world *world, int32_t shape_a, int32_t shape_b);

// ---- ignored pairs --------------------------------------------------------------------------------------------------
// Pairs of bodies that ignore each other.
//
// Each has a record in fe_world.ignores, found by its bodies through fe_world.ignored, and threaded into the lists of
// both: a body that goes takes its own pairs along, however many others there are.

typedef struct fe__ignore {
    int32_t body[2];
    fe__link links[2]; // in the list of body[0] and of body[1]; 0: none
} fe__ignore;

// Their pairs end with it; without it the next step finds them. FE_ERROR_MEMORY, FE_ERROR_LIMIT: nothing changed.
fe_result fe__ignore_collision(fe_world *world, int32_t body_a, int32_t body_b, int32_t ignore);
// Of a body that goes: the slot's next body must not inherit whom it ignored.
void fe__body_ignore_none(fe_world *world, int32_t body);

#endif
