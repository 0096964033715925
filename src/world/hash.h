// hash.h - the fingerprint of a world.
#ifndef FE_WORLD_HASH_H
#define FE_WORLD_HASH_H
#include "core/hash.h"
#include "world/world.h"

uint64_t fe__world_hash(const fe_world *world);
// joint_hash.c: the definition in words whose order never changes
void fe__hash_joint_settings(fe__hash *h, int32_t type, const fe__joint_any *def);

#endif
