// rows.h - which records of a world are rows of which table.
#ifndef FE_SNAPSHOT_ROWS_H
#define FE_SNAPSHOT_ROWS_H
#include "snapshot/format.h"

// ---- rows that are numbers of slots ---------------------------------------------------------------------------------
static inline const void *fe__slot_in(void *room, int32_t slot)
{
    *(fe__slot_row *)room = (fe__slot_row){slot};
    return room;
}

// The next slot in use behind that one, with a handle, or hidden
static inline int32_t fe__next_slot(const fe__id_pool *pool, int32_t slot, int32_t with_hidden)
{
    for (++slot; slot < pool->slot_count; ++slot)
        if (pool->slots[slot].next == FE_ID_ALIVE || (with_hidden && pool->slots[slot].next == FE_ID_HIDDEN)) break;
    return slot;
}

static inline int32_t fe__live_records(const fe__record_pool *pool) { return pool->limit - 1 - pool->free_count; }

// A tree with so many nodes is written, and taken, with no more room than this: no snapshot asks for more memory than
// its size lets expect
static inline int64_t fe__most_promised(const fe__tree *tree)
{
    enum { FREE_NODES = 4096, PER_NODE = 4 };
    return (int64_t)PER_NODE * tree->node_count + FREE_NODES;
}

static inline int64_t fe__most_nodes(const fe__tree *tree) { return fe__most_promised(tree) + tree->promised; }

// ---- tables ---------------------------------------------------------------------------------------------------------
#define FE__DECLARE_ROWS(rows)                                                                             \
    int32_t fe__count_##rows(const fe_world *world);                                                       \
    int32_t fe__gather_##rows(const fe_world *world, int32_t place, int32_t count, fe__rows_block *block); \
    void fe__find_##rows(const fe_world *world, int32_t count, fe__rows_block *block);

// Of functions `next_` and `_at` of the same file
#define FE__GATHER(rows)                                                                                             \
    void fe__find_##rows(const fe_world *world, int32_t count, fe__rows_block *block)                                \
    {                                                                                                                \
        for (int32_t i = 0; i < count; ++i) block->records[i] = rows##_at(world, block->places[i], block->rooms[i]); \
    }                                                                                                                \
    int32_t fe__gather_##rows(const fe_world *world, int32_t place, int32_t count, fe__rows_block *block)            \
    {                                                                                                                \
        for (int32_t i = 0; i < count; ++i) block->places[i] = place = next_##rows(world, place);                    \
        fe__find_##rows(world, count, block);                                                                        \
        return place;                                                                                                \
    }

FE__DECLARE_ROWS(world)
FE__DECLARE_ROWS(body_slots)
FE__DECLARE_ROWS(shape_slots)
FE__DECLARE_ROWS(joint_slots)
FE__DECLARE_ROWS(bodies)
FE__DECLARE_ROWS(drifts)
FE__DECLARE_ROWS(shapes)
FE__DECLARE_ROWS(forms)
FE__DECLARE_ROWS(assets)
FE__DECLARE_ROWS(joints)
FE__DECLARE_ROWS(distance_joints)
FE__DECLARE_ROWS(ball_joints)
FE__DECLARE_ROWS(hinge_joints)
FE__DECLARE_ROWS(fixed_joints)
FE__DECLARE_ROWS(configurable_joints)
FE__DECLARE_ROWS(joint_anchors)
FE__DECLARE_ROWS(joint_frames)
FE__DECLARE_ROWS(joint_reactions)
FE__DECLARE_ROWS(joint_axes)
FE__DECLARE_ROWS(pairs)
FE__DECLARE_ROWS(found)
FE__DECLARE_ROWS(patches)
FE__DECLARE_ROWS(touching)
FE__DECLARE_ROWS(points)
FE__DECLARE_ROWS(features)
FE__DECLARE_ROWS(extras)
FE__DECLARE_ROWS(free_pairs)
FE__DECLARE_ROWS(owed)
FE__DECLARE_ROWS(awake_bodies)
FE__DECLARE_ROWS(awake_pairs)
FE__DECLARE_ROWS(deferrals)
FE__DECLARE_ROWS(awake_joints)
FE__DECLARE_ROWS(planes)
FE__DECLARE_ROWS(ignores)
FE__DECLARE_ROWS(free_ignores)
FE__DECLARE_ROWS(encounters)
FE__DECLARE_ROWS(free_encounters)
FE__DECLARE_ROWS(pair_events)
FE__DECLARE_ROWS(body_events)
FE__DECLARE_ROWS(hit_events)
FE__DECLARE_ROWS(joint_events)
FE__DECLARE_ROWS(trees)
FE__DECLARE_ROWS(static_nodes)
FE__DECLARE_ROWS(moving_nodes)

int32_t fe__next_asset_user(const fe_world *world, int32_t shape); // the first user of the next asset

#endif
