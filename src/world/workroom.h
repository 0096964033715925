// workroom.h - what a step needs and no state is, for worlds that step one after the other: each has it for the time of
// its steps, so that a thousand worlds do not keep it a thousand times.
//
// The constraint graph goes with it: a world that comes back has it built anew, as after a snapshot.
#ifndef FE_WORLD_WORKROOM_H
#define FE_WORLD_WORKROOM_H
#include "world/world.h"

typedef struct fe__workroom {
    fe__memory *memory;
    fe__solver solver;                // but for what of it is state: `burdened`
    struct fe__step_scratch *scratch; // NULL: none yet, or a world has it
} fe__workroom;

void fe__workroom_lend(fe__workroom *room, fe_world *world);      // which gives up what it has of its own
void fe__workroom_take_back(fe__workroom *room, fe_world *world); // whose step may have failed
void fe__workroom_free(fe__workroom *room);

#endif
