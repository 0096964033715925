// restore.c - see restore.h.
#include "state/restore.h"

#include "solver/graph/graph.h"
#include "state/assemble.h"
#include "world/arrays.h"
#include "world/asset_users.h"
#include "world/lifetime.h"
#include "world/step_scratch.h"

#include <string.h>

int32_t fe__snapshot_prepare(fe__build *b, fe_world *world, fe_world *beside, int32_t number)
{
    beside->memory = world->memory; // counted on from here, and back when it is dropped
    beside->store = world->store;
    beside->number = number;
    beside->static_tree.kernels = world->static_tree.kernels;
    beside->moving_tree.kernels = world->moving_tree.kernels;
    b->world = beside;
    b->snapshot->number = number; // in the handles of its events
    return fe__build_world(b);
}

// ---- the exchange --------------------------------------------------------------------------------------------------
static void swap_bytes(unsigned char *a, unsigned char *b, size_t size)
{
    enum { PIECE = 256 };
    unsigned char held[PIECE];
    for (size_t at = 0; at < size; at += PIECE) {
        size_t piece = size - at < PIECE ? size - at : PIECE;
        memcpy(held, a + at, piece);
        memcpy(a + at, b + at, piece);
        memcpy(b + at, held, piece);
    }
}

void fe__world_follow_state(fe_world *world, int32_t burdened)
{
    world->solver.burdened = burdened;
    world->solver.unbuilt = world->awake_linked_count;
    fe__graph_forget(&world->solver);
    world->clusters.is_stale = world->joints.forest.changed = 1;
    if (world->scratch) atomic_store(&world->scratch->some_deferred, 1);
}

// Does the asset hold what the shapes had when the world was saved? The caller may have given another one for its key,
// and another thread may have edited it since the forms were taken: it could not enter the new state.
static int32_t is_as_saved(const fe__build *b, const fe_store *store, const fe__asset *asset)
{
    if (asset->kind != FE__ASSET_HEIGHTFIELD && asset->kind != FE__ASSET_MESH) return 1;
    if (asset->edition == 0 && !b->has_stand_ins) return 1;
    const fe__asset_key now = fe__asset_key_of(store, asset->index);
    for (int32_t i = 0; i < fe__rows_of(b->snapshot, FE__TABLE_ASSETS); ++i) {
        fe__asset_row row;
        fe__take_row(b->snapshot, FE__TABLE_ASSETS, i, &row);
        if (row.key[0] == now.words[0] && row.key[1] == now.words[1]) return 1;
    }
    return 0;
}

// The boxes and pairs are those of the saved world. Where an asset holds something else they are found anew.
void fe__snapshot_adopt(fe_world *world, fe_world *beside, const fe__build *build)
{
    fe__store_lock(world->store);
    for (int32_t i = 0; i < FE__MEMBERS; ++i) {
        const fe__members *members = fe__state_members + i;
        swap_bytes((unsigned char *)world + members->first, (unsigned char *)beside + members->first,
                   members->end - members->first);
    }
    fe__world_follow_state(world, beside->solver.burdened);
    for (int32_t i = 0; i < world->use_count; ++i)
        if (!is_as_saved(build, world->store, fe__store_parent(world->store, world->uses[i].asset)))
            fe__asset_renew(world, world->uses + i);
    fe__store_unlock(world->store);
}

void fe__snapshot_drop(fe_world *world, fe_world *beside)
{
    fe__store_lock(world->store);
    fe__world_release_assets(beside);
    fe__store_unlock(world->store);
    fe__world_free_state(beside);
    world->memory.bytes = beside->memory.bytes;
    world->memory.allocations = beside->memory.allocations;
}
