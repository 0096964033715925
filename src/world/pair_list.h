// pair_list.h - the lists that a pair is in: of both bodies, and of the pairs that are awake, where some are deferred
// (deferral.h).
#ifndef FE_WORLD_PAIR_LIST_H
#define FE_WORLD_PAIR_LIST_H
#include "world/world.h"

// in the list of `body`
static inline int32_t fe__next_pair(const fe_world *world, int32_t pair, int32_t body)
{
    return world->pairs[pair].links[world->pairs[pair].body_a == body ? 0 : 1].next;
}
void fe__pair_add_to_list(fe_world *world, int32_t pair, int32_t body);
void fe__pair_remove_from_list(fe_world *world, int32_t pair, int32_t body);

void fe__pair_awaken(fe_world *world, int32_t pair);
void fe__pair_retire(fe_world *world, int32_t pair);
void fe__pair_look_once(fe_world *world, int32_t pair);     // in the next step, whoever sleeps
void fe__body_end_deferrals(fe_world *world, int32_t body); // its pose or centre changed, and not by a step

#endif
