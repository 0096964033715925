// build.c - see build.h: slots, records of pools, the order of creation.
#include "state/build.h"

#include "core/array_sort.h"
#include "state/rows.h"
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
int32_t fe__build_pool(fe__build *b, fe__record_pool *pool, int32_t limit, fe__table_number free, fe__table_number used)
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
        if (slot < 1 || slot >= limit)
            return fe__snapshot_refuse(b->snapshot, "%s: there is no record %d", name, (int)slot);
        memcpy(&known, fe__record(pool, slot), sizeof known);
        if (known != unknown) return fe__snapshot_refuse(b->snapshot, "%s: record %d is free twice", name, (int)slot);
        memcpy(fe__record(pool, slot), &pool->first_free, sizeof pool->first_free);
        pool->first_free = slot;
    }
    return 1;
}

// ---- order ---------------------------------------------------------------------------------------------------------
// Room for 2 count items; the serials of the first half are written
static int32_t sort_by_serial(fe__build *b, const char *what, fe__sort_item *items, int32_t count)
{
    fe__sort_keys(items, count, items + count);
    for (int32_t i = 1; i < count; ++i)
        if (items[i].key == items[i - 1].key)
            return fe__snapshot_refuse(b->snapshot, "%s: two have the serial %llu", what,
                                       (unsigned long long)items[i].key);
    return 1;
}

int32_t fe__build_order(fe__build *b, const fe__ordered *what, int32_t count)
{
    if (count == 0) return 1;
    size_t size = 2 * sizeof(fe__sort_item) * (size_t)count;
    fe__sort_item *items = fe__allocate_scratch(fe__memory_of(b), size);
    if (!items) return fe__lack_memory(b);
    for (int32_t i = 0, slot = -1; i < count; ++i) {
        slot = fe__next_slot(what->pool, slot, what->with_hidden);
        items[i] = (fe__sort_item){what->serial_of(b->world, slot), slot, 0};
    }
    int32_t sound = sort_by_serial(b, what->name, items, count);
    for (int32_t i = 0; i < count && sound; ++i) sound = what->list(b, items[i].value);
    fe__release(fe__memory_of(b), items, size);
    return sound;
}
