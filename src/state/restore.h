// restore.h - a world becomes what a snapshot says, all of it or nothing.
#ifndef FE_STATE_RESTORE_H
#define FE_STATE_RESTORE_H
#include "state/build.h"

// Builds beside the world, with its memory and its store. 0: refused, nothing of the world changed; the caller frees
// `beside` by fe__snapshot_drop in any case. build->world is `beside`
int32_t fe__snapshot_prepare(fe__build *build, fe_world *world, fe_world *beside, int32_t number);
// Exchanges the states: `beside` has the old one then. Nothing can fail.
void fe__snapshot_adopt(fe_world *world, fe_world *beside, const fe__build *build);
// What follows from the state and is no part of it is to be found anew. Nothing can fail: the scratch is open
void fe__world_follow_state(fe_world *world, int32_t burdened);
void fe__snapshot_drop(fe_world *world, fe_world *beside); // and counts its memory

#endif
