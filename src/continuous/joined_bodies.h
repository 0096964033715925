// joined_bodies.h - what continuous collision holds back holds back what is joined to it.
#ifndef FE_CONTINUOUS_JOINED_BODIES_H
#define FE_CONTINUOUS_JOINED_BODIES_H
#include "world/world_memory.h"

// Of each tree of joints with bodies that were stopped (FE__BODY_HELD, which it clears): moves the others until their
// joints meet again, the stopped ones stay. One thread.
void fe__rejoin_trees(fe__step *step);

#endif
