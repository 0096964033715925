// keyframe.c - see recorder.h. The store's lock is taken before the recorder's, here as by those who edit assets.
#include "recording/recorder.h"

#include "core/bytes.h"
#include "recording/op_write.h"
#include "snapshot/write.h"
#include "store/asset_bytes.h"
#include "world/asset_users.h"

#include <string.h>

// ---- contents of assets --------------------------------------------------------------------------------------------
// 1: it is in the file. As it is named now, it will be the last to be forgotten.
static int32_t name_content(fe_recorder *r, fe__asset_key key)
{
    for (int32_t i = r->content_count - 1; i >= 0; --i) {
        if (!fe__keys_are_same(r->contents[i].key, key)) continue;
        int32_t after = r->content_count - 1 - i;
        memmove(r->contents + i, r->contents + i + 1, (size_t)after * sizeof *r->contents);
        r->contents[r->content_count - 1] = (fe__known_content){key, r->step};
        return 1;
    }
    return 0;
}

// Where chunks are read and given away, assets may come and go for ever. So of many contents the half that was named
// longest ago is forgotten; one that is named again is written once more.
static int32_t reserve_content(fe_recorder *r)
{
    enum { MANY = 256 };
    int32_t half = r->content_count / 2;
    if (!(r->flags & FE_RECORD_LAST) && r->content_count >= fe__maxi(MANY, 4 * r->world->use_count)) {
        r->content_count -= half;
        memmove(r->contents, r->contents + half, (size_t)r->content_count * sizeof *r->contents);
    }
    return FE_RESERVE(&r->memory, r->contents, r->content_capacity, r->content_count + 1);
}

static unsigned char *put_key(unsigned char *at, fe__asset_key key)
{
    return fe__put_u64(fe__put_u64(at, key.words[0]), key.words[1]);
}

static void record_content(fe_recorder *r, const fe_store *store, const fe__asset *asset, fe__asset_key key)
{
    if (r->end != FE_OK || !(r->flags & FE_RECORD_ASSETS) || name_content(r, key)) return;
    if (!reserve_content(r)) {
        fe__recording_fails(r, FE_ERROR_MEMORY);
        return;
    }
    int64_t bytes = fe__asset_bytes(store, asset), size = FE__ASSET_KEY + bytes;
    fe__close_open_chunk(r);
    fe__chunk *chunk = fe__chunk_begin(r, FE__CHUNK_ASSET, size);
    if (!chunk) return;
    unsigned char *at = put_key(fe__chunk_content(chunk), key);
    fe__asset_write(store, asset, at);
    fe__asset_seal(at, bytes);
    fe__chunk_close(r, chunk, size, 0, r->step);
    r->contents[r->content_count++] = (fe__known_content){key, r->step};
}

// ---- assets that calls name ----------------------------------------------------------------------------------------
static int32_t is_known(const fe_recorder *r, fe_asset handle, fe__asset_key key)
{
    for (int32_t i = 0; i < r->asset_count; ++i)
        if (r->assets[i].handle == handle) return fe__keys_are_same(r->assets[i].key, key);
    return 0;
}

static void forget_asset(fe_recorder *r, fe_asset handle)
{
    for (int32_t i = 0; i < r->asset_count; ++i)
        if (r->assets[i].handle == handle) r->assets[i] = r->assets[--r->asset_count];
}

// Forgets the assets that no call can name any more.
static void forget_dead(fe_recorder *r, const fe_store *store)
{
    int32_t slot, count = 0;
    for (int32_t i = 0; i < r->asset_count; ++i)
        if (fe__store_find(store, r->assets[i].handle, &slot) == FE_OK) r->assets[count++] = r->assets[i];
    r->asset_count = count;
}

static void record_name(fe_recorder *r, const fe_store *store, fe_asset handle, fe__asset_key key)
{
    if (r->asset_count == r->asset_capacity) forget_dead(r, store);
    if (!FE_RESERVE(&r->memory, r->assets, r->asset_capacity, r->asset_count + 1)) {
        fe__mutex_lock(&r->lock);
        fe__recording_fails(r, FE_ERROR_MEMORY);
        fe__mutex_unlock(&r->lock);
        return;
    }
    unsigned char *at = fe__op_begin(r, FE__OP_ASSET, FE__ASSET_ENTRY);
    if (!at) return;
    fe__op_end(r, put_key(fe__put_u64(at, handle), key));
    forget_asset(r, handle);
    r->assets[r->asset_count++] = (fe__known_asset){handle, key};
}

void fe__record_form(fe_recorder *r, const fe__form *form)
{
    if (!fe__form_has_asset(form)) return;
    const fe_store *store = r->world->store;
    fe__store_lock(store);
    const fe__asset *asset = fe__store_parent(store, form->field);
    fe__asset_key key = fe__asset_key_of(store, asset->index);
    if (!is_known(r, asset->handle, key)) {
        fe__mutex_lock(&r->lock);
        record_content(r, store, asset, key);
        fe__mutex_unlock(&r->lock);
        record_name(r, store, asset->handle, key);
    }
    fe__store_unlock(store);
}

// ---- keyframes -----------------------------------------------------------------------------------------------------
// In a step the recorder listens in its place
static uint32_t has_filter(const fe_recorder *r) { return r->world->pair_filter != NULL; }

// Under both locks
static void write_keyframe(fe_recorder *r, uint32_t flags)
{
    const fe_world *w = r->world;
    int64_t front = FE__KEYFRAME_FRONT + (int64_t)FE__ASSET_ENTRY * w->use_count, state = fe__snapshot_size(w, 0);
    fe__close_open_chunk(r);
    for (int32_t i = 0; i < w->use_count; ++i) {
        const fe__asset *asset = fe__store_parent(w->store, w->uses[i].asset);
        record_content(r, w->store, asset, fe__asset_key_of(w->store, asset->index));
    }
    fe__chunk *chunk = r->end == FE_OK ? fe__chunk_begin(r, FE__CHUNK_KEYFRAME, front + state) : NULL;
    if (!chunk) return;
    unsigned char *at = fe__put_u32(fe__chunk_content(chunk), (uint32_t)w->use_count);
    at = fe__put_u32(at, has_filter(r));
    for (int32_t i = 0; i < w->use_count; ++i) {
        const fe__asset *asset = fe__store_parent(w->store, w->uses[i].asset);
        at = put_key(fe__put_u64(at, asset->handle), fe__asset_key_of(w->store, asset->index));
    }
    fe__snapshot_write(w, 0, at);
    fe__chunk_close(r, chunk, front + state, flags, r->step);
    r->busy_steps = r->has_called = r->has_gap = 0;
    r->since_keyframe = 0;
    r->asset_count = 0; // who begins here knows none
}

void fe__record_keyframe(fe_recorder *r, uint32_t flags)
{
    const fe_store *store = r->world->store;
    fe__store_lock(store);
    fe__mutex_lock(&r->lock);
    if (r->end == FE_OK) write_keyframe(r, flags);
    fe__mutex_unlock(&r->lock);
    fe__store_unlock(store);
}

void fe__record_jump(fe_recorder *r) { fe__record_keyframe(r, FE__CHUNK_JUMP); }

void fe__record_due_keyframe(fe_recorder *r)
{
    enum { SEGMENTS = 4 }; // at least so many keyframes are kept, where they are small
    int32_t fills = r->flags & FE_RECORD_LAST && r->since_keyframe > r->capacity / SEGMENTS;
    int32_t is_due = r->keyframe_steps > 0 && r->busy_steps >= r->keyframe_steps;
    if (r->has_gap)
        fe__record_keyframe(r, FE__CHUNK_JUMP);
    else if (fills || is_due)
        fe__record_keyframe(r, 0);
}

// ---- edits of assets -----------------------------------------------------------------------------------------------
// Only as such, never as a part of a compound: a replay's compounds have parts of their own
static int32_t is_whole(const fe_world *w, int32_t asset)
{
    for (int32_t i = 0; i < w->use_count; ++i) {
        if (fe__store_parent(w->store, w->uses[i].asset)->index != asset) continue;
        for (int32_t shape = w->uses[i].first_user; shape >= 0; shape = w->shapes[shape].next_user)
            if (w->shapes[shape].parent >= 0) return 0;
    }
    return 1;
}

typedef struct edit {
    int32_t number, count_count;
    int32_t counts[4];
    const void *records;
    int32_t record_count;
    size_t size; // bytes of one
    const fe__words *words;
} edit;

static void write_edit(fe_recorder *r, fe_asset handle, const edit *e)
{
    size_t most = sizeof handle + sizeof e->counts + e->size * (size_t)e->record_count;
    unsigned char *at = fe__op_begin(r, e->number, (int64_t)most);
    if (!at) return;
    at = fe__put_u64(at, handle);
    for (int32_t i = 0; i < e->count_count; ++i) at = fe__put_i32(at, e->counts[i]);
    fe__op_end(r, fe__put_array(at, e->records, 0, e->record_count, e->size, e->words));
}

// Under the store's lock: the calls above would take it again
static void record_edit(fe_store *store, int32_t asset, const edit *e)
{
    for (fe__store_member *m = store->first_member; m; m = m->next) {
        fe_recorder *r = fe__uses_asset(m->world, asset) ? m->world->recorder : NULL; // others are not entered
        if (!r) continue;
        if (is_whole(m->world, asset)) {
            write_edit(r, fe__store_asset(store, asset)->handle, e);
            continue;
        }
        fe__mutex_lock(&r->lock);
        if (r->end == FE_OK) write_keyframe(r, FE__CHUNK_JUMP);
        fe__mutex_unlock(&r->lock);
    }
}

static const fe__words height_words[] = {{4, 1}, {0, 0}};
static const fe__words material_words[] = {{4, 10}, {8, 1}, {0, 0}};

void fe__record_heights(fe_store *store, int32_t asset, int32_t row, int32_t column, int32_t rows, int32_t columns,
                        const float *heights)
{
    const edit e = {FE__OP_HEIGHTS,  4,           {row, column, rows, columns}, heights, rows * columns,
                    sizeof *heights, height_words};
    record_edit(store, asset, &e);
}

void fe__record_materials(fe_store *store, int32_t asset)
{
    const fe__asset *a = fe__store_asset(store, asset);
    const edit e = {FE__OP_MATERIALS, 1, {a->material_count}, a->materials, a->material_count, sizeof *a->materials,
                    material_words};
    record_edit(store, asset, &e);
}
