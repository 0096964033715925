// filter.h - whether two shapes may collide.
#ifndef FE_WORLD_FILTER_H
#define FE_WORLD_FILTER_H
#include "world/contact.h"
#include "world/world.h"

// 1: the two shapes may have a pair, by the types of their bodies, layers, ignored pairs and joints.
int32_t fe__may_collide(const fe_world *world, int32_t shape_a, int32_t shape_b);

// ---- ignored pairs --------------------------------------------------------------------------------------------------
// A pair of bodies that ignore each other has a record in fe_world.ignores, found by its bodies through
// fe_world.ignored, and threaded into the lists of both: so a body that goes finds its pairs, however many others there
// are.

typedef struct fe__ignore {
    int32_t body[2];
    fe__link links[2]; // in the lists of body[0] and body[1]; 0: none
} fe__ignore;

// ignore: 1: the pairs of the bodies end; 0: the next step finds them. FE_ERROR_MEMORY, FE_ERROR_LIMIT: nothing
// changed.
fe_result fe__ignore_collision(fe_world *world, int32_t body_a, int32_t body_b, int32_t ignore);
// Removes all records of a body that goes: the slot's next body must not inherit them.
void fe__body_ignore_none(fe_world *world, int32_t body);

#endif
