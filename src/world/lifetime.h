// lifetime.h - birth and death of a world.
#ifndef FE_WORLD_LIFETIME_H
#define FE_WORLD_LIFETIME_H
#include "world/world.h"

// An empty world, all its memory from the definition's allocator. FE_ERROR_MEMORY; FE_ERROR_UNSUPPORTED: no such SIMD
// set here; FE_ERROR_STALE: the pool or the store is gone; FE_ERROR_ARGUMENT: the store is another world's own.
// source: NULL, or a world whose store the new one shares; the caller is inside it.
// The caller is inside the new world as its writer, and leaves it (fe__owner_leave) when it is whole: its store knows
// it already, and another thread may edit what it begins to use.
fe_result fe__world_create(const fe_world_def *def, const fe_world *source, fe_world **out_world);
void fe__world_destroy(fe_world *world);
void fe__world_free_state(fe_world *world); // all arrays but the solver's and the scratch
fe_world_tuning fe__default_tuning(void);

#endif
