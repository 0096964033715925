// store.c - see store.h. A new store holds nothing but itself: its table of chunks grows with what it is given.
#include "store/store.h"

#include "store/asset.h"

static fe__registry stores = {FE_MUTEX_INITIAL, NULL};

// ---- numbers -------------------------------------------------------------------------------------------------------
static fe__mutex numbers_lock = FE_MUTEX_INITIAL;
static int32_t living[FE_ID_LAST_NUMBER + 1]; // stores with that number

// The next of the counter that no living store has; when each is in use, the next of the counter.
static int32_t take_number(int32_t number)
{
    fe__mutex_lock(&numbers_lock);
    for (int32_t i = 0; !number; ++i) {
        int32_t drawn = fe__id_draw_number();
        if (!living[drawn] || i == FE_ID_LAST_NUMBER) number = drawn;
    }
    living[number] += 1;
    fe__mutex_unlock(&numbers_lock);
    return number;
}

static void give_number(int32_t number)
{
    fe__mutex_lock(&numbers_lock);
    living[number] -= 1;
    fe__mutex_unlock(&numbers_lock);
}

// ---- life ----------------------------------------------------------------------------------------------------------
fe_result fe__store_create(const fe_allocator *allocator, int32_t number, fe_store **out_store)
{
    fe__memory memory;
    fe__memory_init(&memory, allocator);
    fe_store *store = fe__allocate(&memory, sizeof *store);
    if (!store) return FE_ERROR_MEMORY;
    fe__mutex_init(&store->lock);
    fe__mutex_init(&store->allocator_guard);
    store->memory = memory;
    fe__id_pool_init(&store->ids, FE_KIND_ASSET, take_number(number));
    fe__registry_add(&stores, &store->entry);
    *out_store = store;
    return FE_OK;
}

static size_t chunk_size(int32_t chunk) { return sizeof(fe__asset) << (chunk + FE__FIRST_CHUNK_BITS); }

static void free_store(fe_store *store)
{
    for (int32_t i = 0; i < store->ids.slot_count; ++i)
        if (fe__id_pool_is_alive(&store->ids, i)) fe__asset_free(store, fe__store_asset(store, i));
    for (int32_t k = 0; k < FE__CHUNKS; ++k) fe__release(&store->memory, store->chunks[k], chunk_size(k));
    give_number(store->ids.number);
    fe__id_pool_free(&store->ids, &store->memory);
    fe__mutex_free(&store->allocator_guard);
    fe__mutex_free(&store->lock);
    fe__memory memory = store->memory;
    memory.guard = NULL;
    fe__release(&memory, store, sizeof *store);
}

fe_result fe__store_try_destroy(fe_store *store, int32_t *out_users)
{
    fe_result result = fe__registry_withdraw(&stores, &store->entry, out_users);
    if (result == FE_OK) free_store(store);
    return result;
}

// ---- worlds --------------------------------------------------------------------------------------------------------
static void list_member(fe_store *store, fe__store_member *member)
{
    fe__store_lock(store);
    member->previous = NULL;
    member->next = store->first_member;
    if (member->next) member->next->previous = member;
    store->first_member = member;
    fe__store_unlock(store);
}

fe_result fe__store_join(fe_store *store, fe__store_member *member)
{
    fe_result result = fe__registry_retain(&stores, &store->entry);
    if (result == FE_OK) list_member(store, member);
    return result;
}

void fe__store_join_beside(fe_store *store, fe__store_member *member)
{
    fe__store_retain(store);
    list_member(store, member);
}

void fe__store_retain(fe_store *store) { fe__registry_share(&stores, &store->entry); }

void fe__store_release(fe_store *store)
{
    int32_t owned = store->entry.owned; // never changes
    if (fe__registry_release(&stores, &store->entry) == 0 && owned) free_store(store);
}

fe_result fe__store_create_own(const fe_allocator *allocator, int32_t number, fe__store_member *member,
                               fe_store **out_store)
{
    fe_store *store;
    fe_result result = fe__store_create(allocator, number, &store);
    if (result != FE_OK) return result;
    if (allocator) store->memory.guard = &store->allocator_guard; // malloc needs none
    fe__store_join(store, member);
    store->entry.owned = 1;
    *out_store = store;
    return FE_OK;
}

void fe__store_leave(fe_store *store, fe__store_member *member)
{
    fe__store_lock(store);
    if (member->previous)
        member->previous->next = member->next;
    else
        store->first_member = member->next;
    if (member->next) member->next->previous = member->previous;
    fe__store_unlock(store);
    fe__store_release(store);
}

// ---- assets --------------------------------------------------------------------------------------------------------
// Locking changes nothing that a reader of the store sees.
static fe__mutex *lock_of(const fe_store *store) { return &((fe_store *)(uintptr_t)store)->lock; }
void fe__store_lock(const fe_store *store) { fe__mutex_lock(lock_of(store)); }
void fe__store_unlock(const fe_store *store) { fe__mutex_unlock(lock_of(store)); }

fe_result fe__store_find(const fe_store *store, fe_asset handle, int32_t *out_index)
{
    fe_result result = fe__id_pool_find(&store->ids, handle, out_index);
    return result == FE_OK && fe__store_asset(store, *out_index)->destroyed ? FE_ERROR_STALE : result;
}

void *fe__asset_allocate(fe_store *store, fe__asset *asset, size_t size)
{
    void *memory = fe__allocate(&store->memory, size);
    if (memory) asset->blocks[asset->block_count++] = (fe__block){memory, size};
    return memory;
}

void fe__asset_free(fe_store *store, fe__asset *asset)
{
    for (int32_t i = 0; i < asset->block_count; ++i)
        fe__release(&store->memory, asset->blocks[i].memory, asset->blocks[i].size);
    asset->block_count = 0;
}

static int32_t reserve_chunk(fe_store *store, int32_t index)
{
    int32_t chunk = 31 - __builtin_clz((uint32_t)index + (1u << FE__FIRST_CHUNK_BITS)) - FE__FIRST_CHUNK_BITS;
    if (!store->chunks[chunk]) store->chunks[chunk] = fe__allocate(&store->memory, chunk_size(chunk));
    return store->chunks[chunk] != NULL;
}

fe_result fe__store_put(fe_store *store, const fe__asset *asset, fe_asset *out_handle)
{
    fe_result ids = fe__id_pool_reserve(&store->ids, &store->memory, 1);
    if (ids != FE_OK) return ids;
    int32_t next = store->ids.free_count ? store->ids.free_head : store->ids.slot_count;
    if (!reserve_chunk(store, next)) return FE_ERROR_MEMORY;
    *out_handle = fe__id_pool_allocate(&store->ids);
    fe__asset *a = fe__store_asset(store, fe__id_slot_of(*out_handle));
    *a = *asset;
    if (!a->parent) a->scale = fe__vec3(1.0f, 1.0f, 1.0f);
    a->handle = *out_handle;
    a->index = fe__id_slot_of(*out_handle);
    return FE_OK;
}

// A compound's parts have no compound among them: they go one by one, before the array that names them.
void fe__compound_release_parts(fe_store *store, const fe__compound *compound)
{
    for (int32_t i = 0; i < compound->count; ++i)
        if (fe__form_has_asset(&compound->parts[i].form)) fe__asset_release(store, compound->parts[i].form.field);
}

static void free_unused(fe_store *store, int32_t index)
{
    fe__asset *a = fe__store_asset(store, index);
    if (!a->destroyed || a->users > 0) return;
    fe__asset *parent = a->parent;
    if (parent) fe__scaled_remove(a);
    if (a->kind == FE__ASSET_COMPOUND) fe__compound_release_parts(store, &a->compound);
    fe__asset_free(store, a);
    fe__id_pool_release(&store->ids, index);
    if (parent) fe__asset_release(store, parent->index);
}

void fe__asset_destroy(fe_store *store, int32_t index)
{
    fe__store_asset(store, index)->destroyed = 1;
    free_unused(store, index);
}

void fe__asset_retain(fe_store *store, int32_t index) { fe__store_asset(store, index)->users += 1; }

void fe__asset_release(fe_store *store, int32_t index)
{
    fe__store_asset(store, index)->users -= 1;
    free_unused(store, index);
}
