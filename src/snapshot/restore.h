// restore.h - a world becomes what a snapshot says, all of it or nothing.
#ifndef FE_SNAPSHOT_RESTORE_H
#define FE_SNAPSHOT_RESTORE_H
#include "snapshot/read.h"
#include "store/asset_key.h"

// ---- build ----------------------------------------------------------------------------------------------------------
// From a snapshot to the arrays of a world: beside the world that is to become it, so that nothing changes
// before everything is checked.
//
// What follows from the rest is made, not read: lists in the order of creation, sets, masks, counts, poses, the parts
// of joints. What is read is compared with the invariants that the stages of a step rest on. So what is accepted can be
// stepped, whoever wrote it.

typedef struct fe__build {
    fe__snapshot *snapshot;
    fe_world *world;           // zeros, but for memory, store, number, kernels of its trees
    const fe__asset_key *keys; // assets that are known by these, beside the store's
    const int32_t *assets;     // their records
    int32_t asset_count;
    int32_t has_stand_ins; // 1: one of them holds something else than its key says
    fe__asset_key missing; // with FE_ERROR_STATE: of the first that is not there
} fe__build;

// ---- the parts of a world, in this order: 0: refused, see snapshot->result ------------------------------------------
int32_t fe__build_slots(fe__build *build, const fe__world_row *row);
int32_t fe__build_bodies(fe__build *build);
int32_t fe__build_shapes(fe__build *build);
int32_t fe__build_assets(fe__build *build); // under the store's lock
int32_t fe__build_parts(fe__build *build);  // poses, and what compounds say of their parts
int32_t fe__build_joints(fe__build *build);
int32_t fe__build_trees(fe__build *build);
int32_t fe__build_ignores(fe__build *build, const fe__world_row *row);
int32_t fe__build_pairs(fe__build *build, const fe__world_row *row);
int32_t fe__build_encounters(fe__build *build, const fe__world_row *row);
int32_t fe__build_awake(fe__build *build);
int32_t fe__build_events(fe__build *build);

// ---- what they share ------------------------------------------------------------------------------------------------
// What is listed in the order of creation
typedef struct fe__ordered {
    const char *name;
    const fe__id_pool *pool;
    int32_t with_hidden; // slots that have no handle too
    uint64_t (*serial_of)(const fe_world *world, int32_t slot);
    int32_t (*list)(fe__build *build, int32_t slot); // 0: refused
} fe__ordered;

// Lists all of the pool, `count` of them. 0: refused, as two have the same serial, or no memory
int32_t fe__build_order(fe__build *build, const fe__ordered *what, int32_t count);
static inline fe__memory *fe__memory_of(const fe__build *build) { return &build->world->memory; }
int32_t fe__lack_memory(const fe__build *build); // returns 0
// A pool with so many records given ever, of which those of the table wait to be given again
int32_t fe__build_pool(fe__build *build, fe__record_pool *pool, int32_t limit, fe__table_number free,
                       fe__table_number used);

// ---- restore --------------------------------------------------------------------------------------------------------

// Builds beside the world, with its memory and its store. 0: refused, nothing of the world changed; the caller frees
// `beside` by fe__snapshot_drop in any case. build->world is `beside`
int32_t fe__snapshot_prepare(fe__build *build, fe_world *world, fe_world *beside, int32_t number);
// Exchanges the states: `beside` has the old one then. Nothing can fail.
void fe__snapshot_adopt(fe_world *world, fe_world *beside, const fe__build *build);
// What follows from the state and is no part of it is to be found anew. Nothing can fail: the scratch is open
void fe__world_follow_state(fe_world *world, int32_t burdened);
void fe__snapshot_drop(fe_world *world, fe_world *beside); // and counts its memory

#endif
