// forest.h - which joints the tree solver takes: a spanning forest of the bodies that they hold.
#ifndef FE_WORLD_FOREST_H
#define FE_WORLD_FOREST_H
#include "world/world.h"

int32_t fe__find_joint_trees(fe_world *world); // where they are stale. 0: no memory, nothing changed
void fe__forest_free(fe__forest *forest, fe__memory *memory);

#endif
