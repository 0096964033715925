// build.c - see build.h: the order of the parts, the members of the world, slots.
#include "state/build.h"

#include "core/array_sort.h"
#include "solver/solver.h"
#include "world/encounter.h"
#include "world/ignore.h"
#include "world/joints.h"

#include <string.h>

int32_t fe__lack_memory(const fe__build *b) { return fe__snapshot_fail(b->snapshot, FE_ERROR_MEMORY); }

// ---- slots ---------------------------------------------------------------------------------------------------------
// The stack of free slots holds each of them once, and nothing else
static int32_t follow_free(fe__build *b, fe__id_pool *pool, const char *name)
{
    int32_t slot = pool->free_head, seen = 0;
    for (; slot != FE_ID_NONE; ++seen) {
        if (slot < 0 || slot >= pool->slot_count || seen == pool->free_count)
            return fe__snapshot_refuse(b->snapshot, "%s: the stack of free slots leads astray", name);
        slot = pool->slots[slot].next;
    }
    return seen == pool->free_count || fe__snapshot_refuse(b->snapshot, "%s: a free slot is lost", name);
}

static int32_t build_pool_of_slots(fe__build *b, fe__id_pool *pool, fe__table_number table, int32_t free_head)
{
    const char *name = fe__tables[table].name;
    int32_t count = fe__rows_of(b->snapshot, table);
    if (count > FE_ID_MAX_SLOTS) return fe__snapshot_refuse(b->snapshot, "%s: %d are too many", name, (int)count);
    if (!FE_RESERVE(fe__memory_of(b), pool->slots, pool->capacity, count)) return fe__lack_memory(b);
    pool->slot_count = count;
    pool->free_head = free_head;
    for (int32_t i = 0; i < count; ++i) {
        fe__take_row(b->snapshot, table, i, pool->slots + i);
        int32_t next = pool->slots[i].next;
        if (next >= count) return fe__snapshot_refuse(b->snapshot, "%s: slot %d follows %d", name, (int)next, (int)i);
        pool->alive_count += next == FE_ID_ALIVE;
        pool->free_count += next >= 0 || next == FE_ID_NONE;
        if (next == FE_ID_HIDDEN && table == FE__TABLE_JOINT_SLOTS)
            return fe__snapshot_refuse(b->snapshot, "%s: slot %d is hidden", name, (int)i);
    }
    return follow_free(b, pool, name);
}

int32_t fe__build_slots(fe__build *b, const fe__world_row *row)
{
    fe_world *w = b->world;
    fe__id_pool_init(&w->body_ids, FE_KIND_BODY, w->number);
    fe__id_pool_init(&w->shape_ids, FE_KIND_SHAPE, w->number);
    fe__joints_init(w);
    return build_pool_of_slots(b, &w->body_ids, FE__TABLE_BODY_SLOTS, row->free_slots[0]) &&
           build_pool_of_slots(b, &w->shape_ids, FE__TABLE_SHAPE_SLOTS, row->free_slots[1]) &&
           build_pool_of_slots(b, &w->joint_ids, FE__TABLE_JOINT_SLOTS, row->free_slots[2]);
}

// ---- records of pools ----------------------------------------------------------------------------------------------
int32_t fe__build_pool(fe__build *b, fe__record_pool *pool, int32_t limit, fe__table_number free,
                       fe__table_number used)
{
    int64_t free_count = fe__rows_of(b->snapshot, free), used_count = fe__rows_of(b->snapshot, used);
    const char *name = fe__tables[used].name;
    if (limit != 1 + free_count + used_count || (int64_t)limit * pool->size > INT32_MAX)
        return fe__snapshot_refuse(b->snapshot, "%s: %d records are not those in use and those that are free", name,
                                   (int)limit);
    if (!FE_RESERVE(fe__memory_of(b), pool->records, pool->capacity, limit * pool->size)) return fe__lack_memory(b);
    pool->limit = limit;
    pool->free_count = (int32_t)free_count;
    // from the last: each record holds the next one, and -1 until it is known to be free
    const int32_t unknown = -1;
    for (int32_t i = 1; i < limit; ++i) memcpy(fe__record(pool, i), &unknown, sizeof unknown);
    for (int32_t i = (int32_t)free_count - 1; i >= 0; --i) {
        int32_t slot = fe__listed_slot(b->snapshot, free, i), known;
        if (slot < 1 || slot >= limit) return fe__snapshot_refuse(b->snapshot, "%s: there is no record %d", name, (int)slot);
        memcpy(&known, fe__record(pool, slot), sizeof known);
        if (known != unknown) return fe__snapshot_refuse(b->snapshot, "%s: record %d is free twice", name, (int)slot);
        memcpy(fe__record(pool, slot), &pool->first_free, sizeof pool->first_free);
        pool->first_free = slot;
    }
    return 1;
}

// ---- order ---------------------------------------------------------------------------------------------------------
fe__sort_item *fe__sort_by_serial(fe__build *b, const char *what, fe__sort_item *items, int32_t count)
{
    fe__sort_keys(items, count, items + count);
    for (int32_t i = 1; i < count; ++i) {
        if (items[i].key != items[i - 1].key) continue;
        fe__snapshot_refuse(b->snapshot, "%s: two have the serial %llu", what, (unsigned long long)items[i].key);
        return NULL;
    }
    return items;
}

// ---- the world -----------------------------------------------------------------------------------------------------
static int32_t take_world(fe__build *b, fe__world_row *row)
{
    fe_world *w = b->world;
    if (fe__rows_of(b->snapshot, FE__TABLE_WORLD) != 1) return fe__snapshot_refuse(b->snapshot, "there is not one world");
    fe__take_row(b->snapshot, FE__TABLE_WORLD, 0, row);
    row->tuning.struct_size = sizeof row->tuning;
    if (row->next_serial == 0 || row->next_serial >> (64 - FE__PART_BITS) != 0 || row->step_number < 0)
        return fe__snapshot_refuse(b->snapshot, "the next serial is %llu, the step %lld",
                                   (unsigned long long)row->next_serial, (long long)row->step_number);
    if (row->row_kinds >> FE__ROW_KINDS << FE__ROW_KINDS || row->joint_row_kinds >> FE__PARTS ||
        row->pair_colours > FE__PAIR_COLOURS || row->static_colours > FE__STATIC_COLOURS)
        return fe__snapshot_refuse(b->snapshot, "there are no such rows or colours");
    if (row->has_extras && !(row->row_kinds >> FE__ROW_SPECIAL))
        return fe__snapshot_refuse(b->snapshot, "there are extras, but no special rows");
    w->user_data = row->user_data;
    w->next_serial = row->next_serial;
    w->step_number = row->step_number;
    w->gravity = row->gravity;
    w->substeps = row->substeps;
    w->last_h = row->last_h, w->last_dt = row->last_dt;
    w->row_kinds = row->row_kinds;
    w->tuning = row->tuning;
    w->first_body = w->last_body = w->first_free_pair = -1;
    w->pair_limit = 1;
    atomic_store(&w->point_count, 1);
    w->pair_colours = row->pair_colours, w->static_colours = row->static_colours;
    w->joints.row_kinds = row->joint_row_kinds;
    w->joints.most = row->most_joints;
    w->joints.forest.changed = 1;
    fe__record_pool_init(&w->ignores, sizeof(fe__ignore));
    fe__record_pool_init(&w->encounters, sizeof(fe__encounter));
    return 1;
}

static int32_t build_with_assets(fe__build *b)
{
    if (!fe__rows_of(b->snapshot, FE__TABLE_ASSETS)) return 1;
    fe__store_lock(b->world->store);
    int32_t built = fe__build_assets(b);
    fe__store_unlock(b->world->store);
    return built;
}

int32_t fe__build_world(fe__build *b)
{
    fe__world_row row;
    memset(&row, 0, sizeof row);
    return take_world(b, &row) && fe__build_slots(b, &row) && fe__build_bodies(b) && fe__build_shapes(b) &&
           build_with_assets(b) && fe__build_parts(b) && fe__build_joints(b) && fe__build_trees(b) &&
           fe__build_ignores(b, &row) && fe__build_pairs(b, &row) && fe__build_encounters(b, &row) &&
           fe__build_awake(b) && fe__build_events(b);
}
