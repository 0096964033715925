// state.h - a state of a world that belongs to no world: held once, given to any world of the same store as often as
// wanted, by any number of threads at once.
#ifndef FE_SNAPSHOT_STATE_H
#define FE_SNAPSHOT_STATE_H
#include "core/registry.h"
#include "snapshot/history.h"

struct fe_state {
    fe__entry entry; // in the registry
    fe__memory memory;
    fe_store *store; // of its assets; it is kept
    fe__held *held;
};

// The caller is inside the world. FE_ERROR_MEMORY
fe_result fe__state_create(const fe_world *world, const fe_allocator *allocator, fe_state **out_state);
void fe__state_destroy(fe_state *state);
int32_t fe__state_lives(const fe_state *state); // from any thread

// A world like another one, in which the caller is. The definition's workers, pool, tasks, allocator and SIMD set
// count. Results: those of fe__world_create, and as there the caller is inside the new one
fe_result fe__world_clone(const fe_world *source, const fe_world_def *def, fe_world **out_world);
// One that is what the state holds; source: a world of the state's store
fe_result fe__world_create_as(const fe__held *held, const fe_world *source, const fe_world_def *def,
                              fe_world **out_world);

#endif
