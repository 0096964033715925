// hash.h - the fingerprint of a world.
#ifndef FE_WORLD_HASH_H
#define FE_WORLD_HASH_H
#include "core/bytes.h"
#include "world/joint.h"
#include "world/world.h"

uint64_t fe__world_hash(const fe_world *world);
// Parts of it
uint64_t fe__hash_of_contact(const fe_world *world, int32_t pair); // a linked one
uint64_t fe__hash_of_impulses(const fe_world *world, int32_t joint);
uint64_t fe__hash_of_events(const fe_world *world); // events of the last step, but for joints
// Adds a definition, in words whose order never changes.
void fe__hash_joint_settings(fe__hash *h, int32_t type, const fe__joint_any *def);

#endif
