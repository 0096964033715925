// history.c - see history.h: the ring of frames. What a frame holds is in history.c.
#include "snapshot/history.h"

#include "snapshot/restore.h"
#include "world/asset_users.h"
#include "world/sleep.h"
#include "world/world_memory.h"

#include <string.h>

// ---- history --------------------------------------------------------------------------------------------------------

static fe__registry histories = {.lock = FE_MUTEX_INITIAL};

// ---- birth and death -----------------------------------------------------------------------------------------------
fe_result fe__history_create(fe_world *world, int32_t frames, int64_t most_bytes, fe_history **out_history)
{
    fe_history *h = fe__allocate(&world->memory, sizeof *h);
    if (!h) return FE_ERROR_MEMORY;
    *h = (fe_history){.world = world, .limit = frames, .most_bytes = most_bytes, .next = world->first_history};
    h->frames = fe__allocate(&world->memory, (size_t)frames * sizeof *h->frames);
    if (!h->frames) {
        fe__release(&world->memory, h, sizeof *h);
        return FE_ERROR_MEMORY;
    }
    world->first_history = h;
    fe__registry_add(&histories, &h->entry);
    *out_history = h;
    return FE_OK;
}

static void give_up(fe_history *h, fe__frame *frame)
{
    if (--frame->held->users > 0) return;
    fe__held_forget_assets(frame->held, h->world->store, &h->world->memory);
    frame->held->next = h->spare;
    h->spare = frame->held;
}

static fe__frame *frame_at(fe_history *h, int32_t i) { return h->frames + (h->first + i) % h->limit; }

static void drop_oldest(fe_history *h)
{
    give_up(h, frame_at(h, 0));
    h->first = (h->first + 1) % h->limit;
    --h->count;
}

static void drop_after(fe_history *h, int32_t last)
{
    for (; h->count > last + 1; --h->count) give_up(h, frame_at(h, h->count - 1));
}

static void free_spare(fe_history *h)
{
    fe__held *held = h->spare;
    h->spare = held->next;
    fe__release(&h->world->memory, held, (size_t)held->size);
}

void fe__history_destroy(fe_history *h)
{
    fe_world *world = h->world;
    fe_history **at = &world->first_history;
    while (*at != h) at = &(*at)->next;
    *at = h->next;
    fe__registry_remove(&histories, &h->entry);
    drop_after(h, -1);
    while (h->spare) free_spare(h);
    fe__release(&world->memory, h->frames, (size_t)h->limit * sizeof *h->frames);
    fe__release(&world->memory, h, sizeof *h);
}

void fe__histories_end(fe_world *world)
{
    while (world->first_history) fe__history_destroy(world->first_history);
}

fe_world *fe__world_of_history(const fe_history *h)
{
    return fe__registry_has(&histories, &h->entry) ? h->world : NULL;
}

// ---- memory --------------------------------------------------------------------------------------------------------
int64_t fe__history_bytes(const fe_history *h, int32_t i)
{
    const fe__held *held = fe__history_frame(h, i)->held, *before = i > 0 ? fe__history_frame(h, i - 1)->held : NULL;
    return (int64_t)sizeof(fe__frame) + (held == before ? 0 : fe__held_bytes(held, before));
}

static int64_t all_bytes(const fe_history *h)
{
    int64_t bytes = 0;
    for (int32_t i = 0; i < h->count; ++i) bytes += fe__history_bytes(h, i);
    return bytes;
}

// A block of at least that size, a spare one if one is near it. NULL: no memory
static fe__held *find_block(fe_history *h, int64_t size)
{
    enum { ROOM = 8, WASTE = 2 }; // an eighth, for a world that grows; at most as much again for one that shrank
    while (h->spare && (h->spare->size < size || h->spare->size / WASTE > size)) free_spare(h);
    fe__held *found = h->spare;
    if (found) {
        h->spare = found->next;
        return found;
    }
    const int64_t room = size + size / ROOM;
    found = fe__allocate_scratch(&h->world->memory, (size_t)room);
    if (found) found->size = room;
    return found;
}

// ---- frames --------------------------------------------------------------------------------------------------------
// The caller's own entry changes nothing yet
static int32_t is_last_frame(const fe_history *h)
{
    const fe_world *w = h->world;
    if (h->count == 0 || w->owner.entries - 1 != h->entries) return 0;
    return fe__held_is_state(fe__history_frame(h, h->count - 1)->held, w);
}

static fe__held *hold(fe_history *h, fe_result *result)
{
    fe_world *w = h->world;
    const fe__held *before = h->count ? fe__history_frame(h, h->count - 1)->held : NULL;
    fe__held *held = find_block(h, fe__held_size(w));
    *result = FE_ERROR_MEMORY;
    if (!held) return NULL;
    if (fe__held_fill(held, w, &w->memory, before)) {
        *result = h->most_bytes && (int64_t)sizeof(fe__frame) + fe__held_bytes(held, NULL) > h->most_bytes
                      ? FE_ERROR_LIMIT
                      : FE_OK;
        if (*result == FE_OK) return held;
        fe__held_forget_assets(held, w->store, &w->memory);
    }
    held->next = h->spare;
    h->spare = held;
    return NULL;
}

fe_result fe__history_keep(fe_history *h, int64_t number)
{
    fe_world *w = h->world;
    fe_result result = FE_OK;
    fe__held *held = is_last_frame(h) ? fe__history_frame(h, h->count - 1)->held : hold(h, &result);
    if (!held) return result;
    ++held->users;
    if (h->count == h->limit) drop_oldest(h);
    *frame_at(h, h->count++) = (fe__frame){number, w->step_number, w->last_h, w->last_dt, held};
    h->entries = --w->owner.entries; // keeping changes nothing
    while (h->most_bytes && all_bytes(h) > h->most_bytes) drop_oldest(h);
    return FE_OK;
}

static int32_t find_frame(const fe_history *h, int64_t number)
{
    int32_t low = 0, high = h->count;
    while (low < high) {
        int32_t middle = (low + high) / 2;
        if (fe__history_frame(h, middle)->number < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low < h->count && fe__history_frame(h, low)->number == number ? low : -1;
}

fe_result fe__history_restore(fe_history *h, int64_t number)
{
    fe_world *w = h->world;
    int32_t i = find_frame(h, number);
    if (i < 0) return FE_ERROR_STALE;
    const fe__frame *frame = fe__history_frame(h, i);
    if (!is_last_frame(h) || frame->held != fe__history_frame(h, h->count - 1)->held) {
        fe_result result = fe__held_return(frame->held, w);
        if (result != FE_OK) return result;
    }
    w->step_number = frame->step_number;
    w->last_h = frame->last_h, w->last_dt = frame->last_dt;
    drop_after(h, i);
    h->entries = w->owner.entries;
    return FE_OK;
}

// ---- held -----------------------------------------------------------------------------------------------------------

enum { LINE = 64 }; // where arrays begin, bytes: copies go by whole cache lines
static int64_t whole_lines(int64_t bytes) { return (bytes + LINE - 1) / LINE * LINE; }

static int64_t range_size(int32_t i) { return (int64_t)(fe__state_members[i].end - fe__state_members[i].first); }
static int64_t members_size(void)
{
    int64_t size = 0;
    for (int32_t i = 0; i < FE__MEMBERS; ++i) size += range_size(i);
    return size;
}
static int64_t head_size(const fe_world *w)
{
    return whole_lines((int64_t)sizeof(fe__held)) + whole_lines(members_size()) +
           whole_lines(w->use_count * (int64_t)(sizeof(fe__held_asset) + sizeof(int32_t)));
}

int64_t fe__held_size(const fe_world *w)
{
    int64_t size = head_size(w);
    for (int32_t i = 0; i < FE__ARRAYS; ++i) size += whole_lines(fe__array_used(w, fe__arrays + i));
    return size;
}

// ---- editions ------------------------------------------------------------------------------------------------------
// What can be edited of an asset
static unsigned char *content_of(const fe__asset *a, int64_t *out_size)
{
    const fe__heightfield *f = &a->field;
    *out_size = 0;
    if (a->kind == FE__ASSET_HEIGHTFIELD) {
        *out_size = (int64_t)f->rows * f->columns * (int64_t)sizeof *f->heights;
        return (unsigned char *)f->heights;
    }
    if (a->kind == FE__ASSET_MESH) *out_size = a->material_count * (int64_t)sizeof *a->materials;
    return (unsigned char *)a->materials;
}

static fe__edition *take_edition(fe__memory *memory, const fe__asset *a)
{
    int64_t size;
    const unsigned char *content = content_of(a, &size);
    fe__edition *edition = fe__allocate_scratch(memory, sizeof *edition + (size_t)size);
    if (!edition) return NULL;
    *edition = (fe__edition){.number = a->edition, .size = size};
    memcpy(edition->content, content, (size_t)size);
    return edition;
}

static fe__edition *known_edition(const fe__held *before, const fe__asset *a)
{
    for (int32_t i = 0; before && i < before->asset_count; ++i) {
        const fe__held_asset *known = before->assets + i;
        if (known->owner == a->index && known->edition && known->edition->number == a->edition) return known->edition;
    }
    return NULL;
}

static int32_t hold_asset(fe__held *held, const fe_world *w, fe__memory *memory, const fe__held *before, int32_t record)
{
    const fe__asset *a = fe__store_parent(w->store, record);
    fe__held_asset taken = {record, a->index, NULL};
    int64_t size;
    content_of(a, &size);
    if (size > 0 && memory) {
        taken.edition = known_edition(held, a);
        if (!taken.edition) taken.edition = known_edition(before, a);
        if (!taken.edition) taken.edition = take_edition(memory, a);
        if (!taken.edition) return 0;
        ++taken.edition->users;
    }
    fe__asset_retain(w->store, record);
    held->assets[held->asset_count++] = taken;
    return 1;
}

static void forget_assets(fe__held *held, fe_store *store, fe__memory *memory)
{
    for (int32_t i = 0; i < held->asset_count; ++i) {
        fe__edition *edition = held->assets[i].edition;
        fe__asset_release(store, held->assets[i].record);
        if (edition && --edition->users == 0) fe__release(memory, edition, sizeof *edition + (size_t)edition->size);
    }
    held->asset_count = 0;
}

void fe__held_forget_assets(fe__held *held, fe_store *store, fe__memory *memory)
{
    if (!held->asset_count) return;
    fe__store_lock(store);
    forget_assets(held, store, memory);
    fe__store_unlock(store);
}

static int32_t hold_assets(fe__held *held, const fe_world *w, fe__memory *memory, const fe__held *before)
{
    int32_t whole = 1;
    if (!w->use_count) return 1;
    fe__store_lock(w->store);
    for (int32_t i = 0; i < w->use_count && whole; ++i) whole = hold_asset(held, w, memory, before, w->uses[i].asset);
    if (!whole) forget_assets(held, w->store, memory);
    fe__store_unlock(w->store);
    return whole;
}

int64_t fe__held_bytes(const fe__held *held, const fe__held *before)
{
    int64_t bytes = held->bytes;
    for (int32_t i = 0; i < held->asset_count; ++i) {
        const fe__edition *edition = held->assets[i].edition;
        int32_t known = !edition;
        for (int32_t k = 0; k < i && !known; ++k) known = held->assets[k].edition == edition;
        for (int32_t k = 0; before && k < before->asset_count && !known; ++k)
            known = before->assets[k].edition == edition;
        if (!known) bytes += (int64_t)sizeof *edition + edition->size;
    }
    return bytes;
}

// ---- taken ---------------------------------------------------------------------------------------------------------
static void lay_out(fe__held *held, const fe_world *w)
{
    unsigned char *at = (unsigned char *)held + whole_lines((int64_t)sizeof *held);
    held->members = at;
    held->assets = (fe__held_asset *)(void *)(at + whole_lines(members_size()));
    held->edited = (int32_t *)(void *)(held->assets + w->use_count);
    at = (unsigned char *)held + head_size(w);
    for (int32_t i = 0; i < FE__ARRAYS; ++i) {
        held->arrays[i] = at;
        held->used[i] = fe__array_used(w, fe__arrays + i);
        at += whole_lines(held->used[i]);
    }
}

static void copy_array(const fe__held *held, int32_t i, const void *elements)
{
    if (held->used[i]) memcpy(held->arrays[i], elements, (size_t)held->used[i]);
}

int32_t fe__held_fill(fe__held *held, const fe_world *w, fe__memory *memory, const fe__held *before)
{
    *held = (fe__held){.size = held->size,
                       .bytes = fe__held_size(w),
                       .rests = fe__world_rests(w),
                       .burdened = w->solver.burdened};
    lay_out(held, w);
    if (!hold_assets(held, w, memory, before)) return 0;
    unsigned char *at = held->members;
    for (int32_t i = 0; i < FE__MEMBERS; at += range_size(i), ++i)
        memcpy(at, (const unsigned char *)w + fe__state_members[i].first, (size_t)range_size(i));
    for (int32_t i = 0; i < FE__ARRAYS; ++i) copy_array(held, i, fe__array_get(w, fe__arrays + i));
    return 1;
}

// A step that finds nothing to do moves on its own numbers, the last range; but it may build a tree anew
int32_t fe__held_is_state(const fe__held *held, const fe_world *w)
{
    const unsigned char *at = held->members;
    int32_t same = held->rests && fe__world_rests(w) && held->burdened == w->solver.burdened;
    for (int32_t i = 0; i < FE__MEMBERS - 1 && same; at += range_size(i), ++i)
        same = memcmp(at, (const unsigned char *)w + fe__state_members[i].first, (size_t)range_size(i)) == 0;
    return same;
}

// ---- given back ----------------------------------------------------------------------------------------------------
typedef struct returning {
    const fe__held *held;
    fe_world *world;
    void *elements[FE__ARRAYS]; // where the state goes
    int64_t sizes[FE__ARRAYS];  // of those, bytes
} returning;

// An offset in fe_world, in the held members
static int32_t held_int(const fe__held *held, size_t offset)
{
    const unsigned char *at = held->members;
    int32_t value = 0;
    for (int32_t i = 0; i < FE__MEMBERS; at += range_size(i), ++i)
        if (offset >= fe__state_members[i].first && offset < fe__state_members[i].end)
            memcpy(&value, at + (offset - fe__state_members[i].first), sizeof value);
    return value;
}

static void release_new(returning *r, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
        if (r->elements[i] != fe__array_get(r->world, fe__arrays + i))
            fe__release(&r->world->memory, r->elements[i], (size_t)r->sizes[i]);
}

// An array whose capacity was another one is made anew: what the world does without memory depends on it, and what was
// reserved is to be there
static int32_t make_room(returning *r)
{
    fe_world *w = r->world;
    for (int32_t i = 0; i < FE__ARRAYS; ++i) {
        const fe__array *array = fe__arrays + i;
        r->sizes[i] = held_int(r->held, array->capacity) * (int64_t)array->size;
        r->elements[i] = fe__array_get(w, array);
        if (r->sizes[i] == fe__array_capacity(w, array)) continue;
        r->elements[i] = r->sizes[i] ? fe__allocate(&w->memory, (size_t)r->sizes[i]) : NULL;
        if (r->elements[i] || !r->sizes[i]) continue;
        r->elements[i] = fe__array_get(w, array);
        release_new(r, i);
        return 0;
    }
    return 1;
}

// Under the store's lock. Other worlds see an edit; what it does to this one is overwritten
static fe_result return_editions(const returning *r)
{
    fe_store *store = r->world->store;
    fe__assets_entered entered = {r->held->edited, 0, r->world};
    for (int32_t i = 0; i < r->held->asset_count; ++i) {
        const fe__held_asset *a = r->held->assets + i;
        if (a->edition && fe__store_asset(store, a->owner)->edition != a->edition->number)
            r->held->edited[entered.count++] = a->owner;
    }
    if (!entered.count) return FE_OK;
    fe_result result = fe__assets_enter_worlds(store, &entered);
    if (result != FE_OK) return result;
    for (int32_t i = 0; i < r->held->asset_count; ++i) {
        const fe__held_asset *a = r->held->assets + i;
        fe__asset *asset = fe__store_asset(store, a->owner);
        if (!a->edition || asset->edition == a->edition->number) continue;
        const void *content = a->edition->content;
        if (asset->kind == FE__ASSET_HEIGHTFIELD)
            fe__heightfield_edit(store, a->owner, &(fe__samples){0, 0, asset->field.rows, asset->field.columns},
                                 content);
        else
            fe__mesh_edit_materials(store, a->owner, content, sizeof(fe_material));
        asset->edition = a->edition->number; // the same content
    }
    fe__assets_leave_worlds(store, &entered);
    return FE_OK;
}

static void return_uses(const returning *r)
{
    fe_world *w = r->world;
    for (int32_t i = 0; i < r->held->asset_count; ++i) fe__asset_retain(w->store, r->held->assets[i].record);
    for (int32_t i = 0; i < w->use_count; ++i) fe__asset_release(w->store, w->uses[i].asset);
}

// What lies behind the state's elements is as new
static void return_arrays(returning *r)
{
    fe_world *w = r->world;
    for (int32_t i = 0; i < FE__ARRAYS; ++i) {
        const fe__array *array = fe__arrays + i;
        unsigned char *to = r->elements[i];
        void *old = fe__array_get(w, array);
        int64_t used = r->held->used[i], stale = to == old ? fe__array_used(w, array) - used : 0;
        if (used) memcpy(to, r->held->arrays[i], (size_t)used);
        if (stale > 0) memset(to + used, 0, (size_t)stale);
        if (to != old) fe__release(&w->memory, old, (size_t)fe__array_capacity(w, array));
    }
}

// The number of uses is read under the store's lock by who edits an asset. Without assets the lock is not held, and the
// number, which is 0 and stays so, is not written
static void return_members(const returning *r, int32_t with_assets)
{
    fe_world *w = r->world;
    const unsigned char *at = r->held->members;
    const fe__tree_kernels *kernels = w->static_tree.kernels; // of this world's SIMD set
    for (int32_t i = 0; i < FE__MEMBERS; at += range_size(i), ++i)
        if (with_assets || fe__state_members[i].first != offsetof(fe_world, uses))
            memcpy((unsigned char *)w + fe__state_members[i].first, at, (size_t)range_size(i));
    w->use_capacity = held_int(r->held, offsetof(fe_world, use_capacity));
    for (int32_t i = 0; i < FE__ARRAYS; ++i) fe__array_set(w, fe__arrays + i, r->elements[i]);
    w->joints.axes = (fe__joint_axes *)(void *)w->joint_axes.records;
    w->static_tree.kernels = w->moving_tree.kernels = kernels;
}

fe_result fe__held_return(const fe__held *held, fe_world *w)
{
    returning r = {.held = held, .world = w};
    if (!make_room(&r)) return FE_ERROR_MEMORY;
    int32_t with_assets = held->asset_count || w->use_count; // without any nobody else writes to this world
    if (with_assets) fe__store_lock(w->store);
    fe_result result = return_editions(&r);
    if (result == FE_OK) {
        return_uses(&r);
        return_arrays(&r);
        return_members(&r, with_assets);
        fe__world_follow_state(w, held->burdened);
    } else {
        release_new(&r, FE__ARRAYS);
    }
    if (with_assets) fe__store_unlock(w->store);
    return result;
}
