// id_pool.c - see id_pool.h.
#include "core/id_pool.h"

#include <stdatomic.h>

_Static_assert(FE_ID_KIND_SHIFT + FE_ID_KIND_BITS <= 53, "a handle must survive a double");

void fe__id_pool_init(fe__id_pool *pool, fe__kind kind, int32_t number)
{
    *pool = (fe__id_pool){.free_head = FE_ID_NONE, .kind = (int32_t)kind, .number = number};
}

int32_t fe__id_draw_number(void)
{
    static _Atomic uint32_t drawn;
    uint32_t before = atomic_fetch_add_explicit(&drawn, 1, memory_order_relaxed);
    return 1 + (int32_t)(before % FE_ID_LAST_NUMBER);
}

void fe__id_pool_free(fe__id_pool *pool, fe__memory *memory)
{
    FE_FREE(memory, pool->slots, pool->capacity);
    fe__id_pool_init(pool, (fe__kind)pool->kind, pool->number);
}

fe_result fe__id_pool_reserve(fe__id_pool *pool, fe__memory *memory, int32_t extra)
{
    if (extra <= pool->free_count) return FE_OK;
    int64_t need = (int64_t)pool->slot_count + extra - pool->free_count;
    if (need > FE_ID_MAX_SLOTS) return FE_ERROR_LIMIT;
    return FE_RESERVE(memory, pool->slots, pool->capacity, need) ? FE_OK : FE_ERROR_MEMORY;
}

fe_handle fe__id_pool_allocate(fe__id_pool *pool)
{
    int32_t slot = pool->free_head;
    if (slot != FE_ID_NONE) {
        pool->free_head = pool->slots[slot].next;
        pool->free_count -= 1;
    } else {
        slot = pool->slot_count++;
        pool->slots[slot].generation = 1;
    }
    pool->slots[slot].next = FE_ID_ALIVE;
    pool->alive_count += 1;
    return fe__id_pool_handle(pool, slot);
}

void fe__id_pool_hide(fe__id_pool *pool, int32_t slot)
{
    pool->slots[slot].next = FE_ID_HIDDEN;
    pool->alive_count -= 1;
}

void fe__id_pool_show(fe__id_pool *pool, int32_t slot)
{
    pool->slots[slot].next = FE_ID_ALIVE;
    pool->alive_count += 1;
}

void fe__id_pool_release(fe__id_pool *pool, int32_t slot)
{
    fe__id_slot *released = &pool->slots[slot];
    pool->alive_count -= 1;
    if (released->generation == FE_ID_LAST_GENERATION) {
        released->next = FE_ID_RETIRED;
        return;
    }
    released->generation += 1;
    released->next = pool->free_head;
    pool->free_head = slot;
    pool->free_count += 1;
}
