// id_pool.h - handles: numbers that name a slot of a table and notice when the slot was given to somebody else.
//
// From the low bits: 21 of slot + 1, 17 of generation, 12 of the number of the world or store, 3 of kind. So a handle
// is never 0, stays below 2^53, and is refused by worlds of another number. A slot's generation starts at 1 and grows
// at each release. A slot that has used its last one retires for good: no handle ever means a second thing. Free slots
// form a stack: the slot released last is given next, and new slots are opened in rising order when the stack is empty.
// Hence the handles depend on the number and the order of calls alone. The pool is plain arrays: copying them copies
// its future. The API layer is the only one that checks handles; all below it uses slots.
#ifndef FE_CORE_ID_POOL_H
#define FE_CORE_ID_POOL_H
#include "core/memory.h"

typedef enum fe__kind {
    FE_KIND_BODY = 1,
    FE_KIND_SHAPE = 2,
    FE_KIND_JOINT = 3,
    FE_KIND_ASSET = 4,
} fe__kind;

enum {
    FE_ID_SLOT_BITS = 21,
    FE_ID_GENERATION_BITS = 17,
    FE_ID_NUMBER_BITS = 12,
    FE_ID_KIND_BITS = 3,
    FE_ID_NUMBER_SHIFT = FE_ID_SLOT_BITS + FE_ID_GENERATION_BITS,
    FE_ID_KIND_SHIFT = FE_ID_NUMBER_SHIFT + FE_ID_NUMBER_BITS,
    FE_ID_LAST_NUMBER = (1 << FE_ID_NUMBER_BITS) - 1, // 0 is no number
    FE_ID_MAX_SLOTS = (1 << FE_ID_SLOT_BITS) - 1,     // slot + 1 must fit
    FE_ID_LAST_GENERATION = (1 << FE_ID_GENERATION_BITS) - 1,
    FE_ID_ALIVE = -1,   // fe__id_slot.next of a slot in use
    FE_ID_NONE = -2,    // ... of the last free one
    FE_ID_RETIRED = -3, // ... of one without generations left
    FE_ID_HIDDEN = -4,  // ... of one in use whose handle is refused
};

typedef struct fe__id_slot {
    int32_t generation; // of the handle that is out, or will be given next
    int32_t next;       // the free slot below on the stack, or one of the three values above
} fe__id_slot;

typedef struct fe__id_pool {
    fe__id_slot *slots;
    int32_t capacity;
    int32_t slot_count; // ever opened: every slot in use is below
    int32_t alive_count;
    int32_t free_count;
    int32_t free_head; // FE_ID_NONE: the stack is empty
    int32_t kind;      // fe__kind
    int32_t number;    // of the world or the store, 1..FE_ID_LAST_NUMBER
} fe__id_pool;

void fe__id_pool_init(fe__id_pool *pool, fe__kind kind, int32_t number);
// The next number of a counter of this process, for who gave none. From any thread.
int32_t fe__id_draw_number(void);
void fe__id_pool_free(fe__id_pool *pool, fe__memory *memory);
// Makes the next `extra` allocations certain. FE_ERROR_MEMORY, or FE_ERROR_LIMIT when there are not that many slots;
// nothing changed then.
fe_result fe__id_pool_reserve(fe__id_pool *pool, fe__memory *memory, int32_t extra);
// Only after a reserve that covers it.
fe_handle fe__id_pool_allocate(fe__id_pool *pool);
// A slot in use that no handle names, until it is shown again.
void fe__id_pool_hide(fe__id_pool *pool, int32_t slot);
void fe__id_pool_show(fe__id_pool *pool, int32_t slot);
// The slot must be in use.
void fe__id_pool_release(fe__id_pool *pool, int32_t slot);

static inline int32_t fe__id_slot_of(fe_handle handle) { return (int32_t)(handle & ((1u << FE_ID_SLOT_BITS) - 1)) - 1; }
static inline int32_t fe__id_generation_of(fe_handle handle)
{
    return (int32_t)(handle >> FE_ID_SLOT_BITS & ((1u << FE_ID_GENERATION_BITS) - 1));
}
static inline int32_t fe__id_number_of(fe_handle handle)
{
    return (int32_t)(handle >> FE_ID_NUMBER_SHIFT & FE_ID_LAST_NUMBER);
}
// bits beyond the kind make it a kind that does not exist
static inline int32_t fe__id_kind_of(fe_handle handle)
{
    fe_handle kind = handle >> FE_ID_KIND_SHIFT;
    return kind >= FE_KIND_BODY && kind <= FE_KIND_ASSET ? (int32_t)kind : 0;
}
static inline fe_handle fe__id_make(int32_t kind, int32_t number, int32_t generation, int32_t slot)
{
    return (fe_handle)kind << FE_ID_KIND_SHIFT | (fe_handle)number << FE_ID_NUMBER_SHIFT |
           (fe_handle)generation << FE_ID_SLOT_BITS | (fe_handle)(slot + 1);
}

static inline int32_t fe__id_pool_is_alive(const fe__id_pool *pool, int32_t slot)
{
    return slot >= 0 && slot < pool->slot_count && pool->slots[slot].next == FE_ID_ALIVE;
}
// What the slot has reached, for the sentence of an error; 0 when there never was such a slot.
static inline int32_t fe__id_pool_generation(const fe__id_pool *pool, int32_t slot)
{
    return slot >= 0 && slot < pool->slot_count ? pool->slots[slot].generation : 0;
}
// The handle of a slot in use.
static inline fe_handle fe__id_pool_handle(const fe__id_pool *pool, int32_t slot)
{
    return fe__id_make(pool->kind, pool->number, pool->slots[slot].generation, slot);
}
// FE_OK; FE_ERROR_KIND when the handle is of another kind; FE_ERROR_STALE when it names nothing now, or nothing here.
// *out_slot is written on FE_OK only.
static inline fe_result fe__id_pool_find(const fe__id_pool *pool, fe_handle handle, int32_t *out_slot)
{
    int32_t slot = fe__id_slot_of(handle), kind = fe__id_kind_of(handle);
    if (kind == 0) return FE_ERROR_STALE;
    if (kind != pool->kind) return FE_ERROR_KIND;
    if (fe__id_number_of(handle) != pool->number) return FE_ERROR_STALE;
    if (!fe__id_pool_is_alive(pool, slot)) return FE_ERROR_STALE;
    if (pool->slots[slot].generation != fe__id_generation_of(handle)) return FE_ERROR_STALE;
    *out_slot = slot;
    return FE_OK;
}

#endif
