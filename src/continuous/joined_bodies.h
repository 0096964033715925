// joined_bodies.h - re-projection of joints: bodies joined to one that continuous collision stopped are held back too.
#ifndef FE_CONTINUOUS_JOINED_BODIES_H
#define FE_CONTINUOUS_JOINED_BODIES_H
#include "world/world_memory.h"

// In each tree of joints with stopped bodies (FE__BODY_HELD, which it clears) moves the others until the joints are
// closed again; the stopped ones stay. On one thread.
void fe__rejoin_trees(fe__step *step);

#endif
