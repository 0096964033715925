// pair_mix.h - what two materials make together: friction, restitution, resistances, and the kind of rows that takes.
#ifndef FE_WORLD_PAIR_MIX_H
#define FE_WORLD_PAIR_MIX_H
#include "world/world.h"

int32_t fe__pair_kind(const fe_world *world, int32_t shape_a, int32_t shape_b); // FE__ROW_* of their contact
void fe__pair_mix(fe_world *world, int32_t pair);                               // materials, events, row kind
void fe__pair_mix_surface(fe_world *world, int32_t pair); // frictions and the like; writes the pair's records only

#endif
