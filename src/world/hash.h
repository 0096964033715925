// hash.h - the fingerprint of a world.
#ifndef FE_WORLD_HASH_H
#define FE_WORLD_HASH_H
#include "world/world.h"

uint64_t fe__world_hash(const fe_world *world);

#endif
