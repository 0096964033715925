// pair_link.h - pairs with points enter the constraint graph, and leave it.
#ifndef FE_WORLD_PAIR_LINK_H
#define FE_WORLD_PAIR_LINK_H
#include "world/world.h"

// with a colour of its own for each dynamic body; dt: of the step
void fe__pair_link(fe_world *world, int32_t pair, float dt);
void fe__pair_note_colour(fe_world *world, const fe__contact *contact); // if it has one
void fe__pair_unlink(fe_world *world, int32_t pair);                    // its points are released
void fe__pair_forget_impulses(fe_world *world, int32_t pair);           // the contact's, and those of rolling
void fe__patch_leave(fe_world *world, int32_t patch);                   // an unlinked patch leaves the lists

#endif
