// player.c - see player.h.
#include "replay/player.h"

#include "api/check.h"
#include "core/bytes.h"
#include "recording/recorder.h"
#include "snapshot/format.h"
#include "store/asset_key.h"

#include <stdarg.h>
#include <stdio.h>

// ---- play -----------------------------------------------------------------------------------------------------------

static const fe__fed_chunk *chunk_at(const fe_player *p, int32_t i)
{
    return i >= 0 && i < p->file.chunk_count ? p->file.chunks + i : NULL;
}

static void go_to_chunk(fe_player *p, int32_t chunk)
{
    p->chunk = chunk;
    p->offset = p->idle = 0;
    p->last = (fe__last_step){0};
}

static fe_result fail_unrecorded(const char *function, const fe_player *p)
{
    return fe__fail(function, FE_ERROR_DATA, "after step %lld, at byte %lld of a chunk: a call that nobody recorded so",
                    (long long)p->step, (long long)p->offset);
}

// ---- calls ---------------------------------------------------------------------------------------------------------
static fe_result tell_call(const char *function, fe_player *p, const char *name)
{
    fe_divergence what = {.type = FE_DIVERGENCE_CALL, .field = name, .component = -1, .body = p->in.handle};
    if (p->in.failed < 0)
        return fe__player_differs(function, p, &what, "after step %lld: %s fails with %s", (long long)p->step, name,
                                  fe_result_name(p->in.failed));
    return fe__player_differs(function, p, &what, "after step %lld: %s returns 0x%llx, another handle than recorded",
                              (long long)p->step, name, p->in.handle);
}

static fe_result play_name(const char *function, fe_player *p)
{
    fe_asset recorded = fe__in_u64(&p->in);
    uint64_t key[2];
    for (int k = 0; k < 2; ++k) key[k] = fe__in_u64(&p->in);
    return p->in.result != FE_OK ? p->in.result : fe__player_name(function, p, recorded, key);
}

static fe_result play_filter(fe_player *p)
{
    uint8_t is_set = fe__in_u8(&p->in);
    if (p->in.result != FE_OK) return p->in.result;
    fe_result result = fe_world_set_pair_filter(p->world, is_set ? fe__player_answer : NULL, p);
    return fe__in_compare(&p->in, result, NULL, NULL, 0);
}

static const fe__words heights_words[] = {{4, 1}, {0, 0}};
static const fe__words material_words[] = {{4, 10}, {8, 1}, {0, 0}};

static fe_result play_heights(fe_player *p)
{
    fe__op_in *in = &p->in;
    fe_asset asset = fe__player_asset(p, fe__in_u64(in));
    int32_t row = fe__in_i32(in), column = fe__in_i32(in), rows = fe__in_count(in), columns = fe__in_count(in);
    if (in->result == FE_OK && (int64_t)rows * columns > (in->end - in->at) / 4) in->result = FE_ERROR_DATA;
    float *heights = fe__in_array(in, 0, rows * (in->result == FE_OK ? columns : 0), sizeof *heights, heights_words);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_heightfield_set_heights(p->world->store, asset, row, column, rows, columns, heights);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_materials(fe_player *p)
{
    fe__op_in *in = &p->in;
    fe_asset asset = fe__player_asset(p, fe__in_u64(in));
    int32_t count = fe__in_count(in);
    fe_material *materials = fe__in_array(in, 0, count, sizeof *materials, material_words);
    if (in->result != FE_OK) return in->result;
    return fe__in_compare(in, fe_mesh_set_materials(p->world->store, asset, materials, 0, count), NULL, NULL, 0);
}

static fe_result play_call(const char *function, fe_player *p, int32_t number, const char **out_name)
{
    switch (number) {
    case FE__OP_ASSET:
        return play_name(function, p);
    case FE__OP_FILTER:
        *out_name = "fe_world_set_pair_filter";
        return play_filter(p);
    case FE__OP_HEIGHTS:
        *out_name = "fe_heightfield_set_heights";
        return play_heights(p);
    case FE__OP_MATERIALS:
        *out_name = "fe_mesh_set_materials";
        return play_materials(p);
    default: {
        const fe__op_call *call = fe__op_call_of(number);
        if (!call) return FE_ERROR_DATA;
        *out_name = call->name;
        return call->play(&p->in);
    }
    }
}

// ---- steps ---------------------------------------------------------------------------------------------------------
// Answers stand behind the hashes: the numbers before them are passed over
static void find_answers(fe_player *p, int32_t flags)
{
    fe__op_in ahead = p->in;
    p->answer_count = p->answered = 0;
    if (!(flags & FE__STEP_HAS_ANSWERS)) return;
    fe__in_u64(&ahead);
    for (int i = 0; i < 3; ++i) fe__in_signed(&ahead);
    if (flags & FE__STEP_IS_DEEP) fe__in_u64(&ahead);
    uint64_t count = fe__in_varint(&ahead);
    if (count > INT32_MAX || !fe__in_bytes(&ahead, (int64_t)(count + 7) / 8)) {
        p->in.result = FE_ERROR_DATA;
        return;
    }
    p->answers = ahead.at - (count + 7) / 8;
    p->answer_count = (int64_t)count;
}

static fe_result make_step(const char *function, fe_player *p, float dt)
{
    fe_result result = fe_world_step(p->world, dt);
    if (result == FE_ERROR_MEMORY) return result;
    p->in.failed = result;
    p->step += 1;
    if (result == FE_OK) return FE_OK;
    fe_result told = tell_call(function, p, "fe_world_step");
    return told == FE_OK ? FE_END : told; // nothing to compare
}

static fe_result play_step(const char *function, fe_player *p)
{
    fe__op_in *in = &p->in;
    int32_t flags = fe__in_u8(in);
    float dt = flags & FE__STEP_HAS_DT ? fe__in_float(in) : p->last.dt;
    find_answers(p, flags);
    if (in->result != FE_OK) return in->result;
    fe_result result = make_step(function, p, dt);
    if (result == FE_ERROR_MEMORY) return result;
    p->last.dt = dt;
    fe_result compared = fe__player_compare_step(function, p, flags);
    return result == FE_OK || compared == FE_ERROR_DATA ? compared : result == FE_END ? FE_OK : result;
}

static fe_result play_idle(const char *function, fe_player *p)
{
    p->answer_count = p->answered = 0;
    fe_result result = make_step(function, p, p->last.dt);
    if (result == FE_ERROR_MEMORY) return result;
    p->idle -= 1;
    const fe_world *w = p->world;
    if (result != FE_OK) return result == FE_END ? FE_OK : result;
    if (w->awake_body_count == 0 && w->pair_count == p->last.pairs && w->linked_count == p->last.linked) return FE_OK;
    fe_divergence what = {.type = FE_DIVERGENCE_STEP, .field = "awake bodies", .component = -1};
    return fe__player_differs(function, p, &what, "step %lld: %d bodies are awake, nobody was when it was recorded",
                              (long long)p->step, (int)w->awake_body_count);
}

// ---- from call to call ---------------------------------------------------------------------------------------------
// One call of a chunk. *out_stepped: it was a step
static fe_result play_one(const char *function, fe_player *p, const fe__fed_chunk *c, int32_t *out_stepped)
{
    fe__op_in *in = &p->in;
    in->at = c->content + p->offset, in->end = c->content + c->size;
    in->world = p->world, in->result = FE_OK, in->failed = FE_OK, in->handle = 0;
    in->assets = p->assets, in->asset_count = p->asset_count;
    const char *name = "";
    int32_t number = fe__in_u8(in);
    fe_result result;
    if (number == FE__OP_IDLE) {
        uint64_t count = fe__in_varint(in);
        result = count > 0 && count <= INT32_MAX ? in->result : FE_ERROR_DATA;
        if (result == FE_OK) p->idle = (int64_t)count;
    } else if (number == FE__OP_STEP) {
        *out_stepped = 1;
        result = play_step(function, p);
    } else {
        result = play_call(function, p, number, &name);
        if (result == FE_ERROR_DIVERGED) result = tell_call(function, p, name);
    }
    if (result == FE_ERROR_DATA) return fail_unrecorded(function, p);
    if (result == FE_OK || result == FE_ERROR_DIVERGED) {
        p->calls += number != FE__OP_IDLE && number != FE__OP_ASSET;
        p->offset = in->at - c->content;
    }
    return result;
}

// The end of an idle run counts as a call of its own, each step of it
static fe_result play_chunk(const char *function, fe_player *p, const fe__fed_chunk *c, int32_t *out_stepped)
{
    if (p->idle > 0) {
        *out_stepped = 1;
        fe_result result = play_idle(function, p);
        p->calls += result != FE_ERROR_MEMORY;
        return result;
    }
    if (p->offset < c->size) return play_one(function, p, c, out_stepped);
    go_to_chunk(p, p->chunk + 1);
    return FE_OK;
}

static fe_result play_keyframe(const char *function, fe_player *p, const fe__fed_chunk *c)
{
    fe_result result =
        c->flags & FE__CHUNK_JUMP ? fe__player_restore(function, p, c) : fe__player_compare_keyframe(function, p, c);
    if (result == FE_OK && c->flags & FE__CHUNK_JUMP) p->step = c->step;
    if (result == FE_OK || result == FE_ERROR_DIVERGED) go_to_chunk(p, p->chunk + 1);
    return result;
}

static fe_result begin_at(const char *function, fe_player *p, int32_t keyframe)
{
    const fe__fed_chunk *c = chunk_at(p, keyframe);
    FE_TRY(fe__player_restore(function, p, c));
    go_to_chunk(p, keyframe + 1);
    p->step = c->step;
    return FE_OK;
}

static int32_t first_keyframe(const fe_player *p)
{
    for (int32_t i = 0; i < p->file.chunk_count; ++i)
        if (p->file.chunks[i].type == FE__CHUNK_KEYFRAME) return i;
    return -1;
}

fe_result fe__player_step(const char *function, fe_player *p)
{
    if (!p->is_open) {
        int32_t first = first_keyframe(p);
        if (first < 0) return FE_END;
        FE_TRY(begin_at(function, p, first));
        p->is_open = 1;
    }
    if (!p->world) return fe__fail(function, FE_ERROR_STATE, "the world was handed over: seek to make another one");
    for (int32_t stepped = 0; !stepped;) {
        const fe__fed_chunk *c = chunk_at(p, p->chunk);
        if (!c) return FE_END;
        if (c->type == FE__CHUNK_OPS)
            FE_TRY(play_chunk(function, p, c, &stepped));
        else if (c->type == FE__CHUNK_KEYFRAME)
            FE_TRY(play_keyframe(function, p, c));
        else
            go_to_chunk(p, p->chunk + 1);
    }
    return FE_OK;
}

// ---- to a step -----------------------------------------------------------------------------------------------------
// The last keyframe from which the end of that step can be reached: a jump at it comes after that
static int32_t keyframe_before(const fe_player *p, int64_t step)
{
    int32_t first = first_keyframe(p), found = -1;
    for (int32_t i = first; i >= 0 && i < p->file.chunk_count; ++i) {
        const fe__fed_chunk *c = p->file.chunks + i;
        if (c->type != FE__CHUNK_KEYFRAME) continue;
        if (c->step > step) break;
        if (c->step < step || !(c->flags & FE__CHUNK_JUMP) || i == first) found = i;
    }
    return found;
}

fe_result fe__player_seek(const char *function, fe_player *p, int64_t step)
{
    int32_t keyframe = keyframe_before(p, step);
    if (keyframe < 0) {
        int32_t first = first_keyframe(p);
        if (first < 0) return FE_END;
        return fe__fail(function, FE_ERROR_ARGUMENT, "step is %lld, the recording begins at %lld", (long long)step,
                        (long long)chunk_at(p, first)->step);
    }
    int32_t is_ahead = p->is_open && p->world && p->step <= step && p->chunk > keyframe;
    if (!is_ahead) {
        FE_TRY(begin_at(function, p, keyframe));
        p->is_open = 1;
    }
    fe_result result = FE_OK;
    while (p->step < step && (result == FE_OK || result == FE_ERROR_DIVERGED)) {
        fe_result stepped = fe__player_step(function, p);
        result = stepped == FE_OK ? result : stepped;
    }
    return result;
}

// ---- player world ---------------------------------------------------------------------------------------------------

// ---- assets --------------------------------------------------------------------------------------------------------
static fe__replay_asset *find(const fe_player *p, fe_asset recorded)
{
    for (int32_t i = 0; i < p->asset_count; ++i)
        if (p->assets[i].recorded == recorded) return p->assets + i;
    return NULL;
}

fe_asset fe__player_asset(const fe_player *p, fe_asset recorded)
{
    const fe__replay_asset *a = find(p, recorded);
    return a ? a->own : 0;
}

static int32_t is_of(const fe_player *p, fe_asset own, const uint64_t *key)
{
    fe_asset_key now;
    return fe_asset_get_key(p->world->store, own, &now) == FE_OK && now.words[0] == key[0] && now.words[1] == key[1];
}

static fe_result load(const char *function, fe_player *p, const unsigned char *bytes, int64_t size, const uint64_t *key,
                      fe_asset *out_asset)
{
    fe_store *store = p->world->store;
    FE_TRY(fe_asset_load(store, bytes, size, out_asset));
    if (is_of(p, *out_asset, key)) return FE_OK;
    fe_asset_destroy(store, *out_asset);
    return fe__fail(function, FE_ERROR_DATA, "an asset in the recording is not what its key says");
}

// A copy: replayed edits are none of the host's business
static fe_result copy_of_known(const char *function, fe_player *p, const uint64_t *key, fe_asset *out_asset)
{
    fe_store *store = p->world->store;
    fe__store_lock(store);
    int32_t index = fe__store_find_key(store, (fe__asset_key){{key[0], key[1]}}, 0);
    fe_asset known = index >= 0 ? fe__store_asset(store, index)->handle : 0;
    fe__store_unlock(store);
    int64_t size = known ? fe_asset_save(store, known, NULL, 0) : -1;
    if (size < 0)
        return fe__fail(function, FE_ERROR_STATE, "the asset with the key %016llx %016llx is nowhere",
                        (unsigned long long)key[0], (unsigned long long)key[1]);
    unsigned char *bytes = fe__allocate_scratch(&p->memory, (size_t)size);
    if (!bytes) return fe__report(function, FE_ERROR_MEMORY);
    fe_result result = fe_asset_save(store, known, bytes, size) == size ? load(function, p, bytes, size, key, out_asset)
                                                                        : FE_ERROR_STATE;
    fe__release(&p->memory, bytes, (size_t)size);
    return result;
}

fe_result fe__player_name(const char *function, fe_player *p, fe_asset recorded, const uint64_t *key)
{
    fe__replay_asset *a = find(p, recorded);
    if (a && is_of(p, a->own, key)) return FE_OK;
    if (!FE_RESERVE(&p->memory, p->assets, p->asset_capacity, p->asset_count + 1))
        return fe__report(function, FE_ERROR_MEMORY);
    int64_t size;
    const unsigned char *bytes = fe__file_find_asset(&p->file, key, &size);
    fe_asset made;
    FE_TRY(bytes ? load(function, p, bytes, size, key, &made) : copy_of_known(function, p, key, &made));
    a = find(p, recorded);
    if (a)
        fe_asset_destroy(p->world->store, a->own);
    else
        a = p->assets + p->asset_count++;
    *a = (fe__replay_asset){recorded, made};
    return FE_OK;
}

// ---- the filter ----------------------------------------------------------------------------------------------------
int32_t fe__player_answer(void *user, const fe_filter_pair *pair)
{
    (void)pair;
    fe_player *p = user;
    int64_t i = p->answered++;
    return i >= p->answer_count || (p->answers[i / 8] >> i % 8 & 1);
}

// ---- the world -----------------------------------------------------------------------------------------------------
static fe_result open_world(fe_player *p)
{
    if (p->world) return FE_OK;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = p->def.worker_count;
    def.simd = p->def.simd;
    def.pool = p->def.pool;
    def.store = p->def.store;
    def.allocator = p->def.allocator;
    return fe_world_create(&def, &p->world);
}

void fe__player_close_world(fe_player *p)
{
    if (!p->world) return;
    for (int32_t i = 0; i < p->asset_count; ++i) fe_asset_destroy(p->world->store, p->assets[i].own);
    p->asset_count = 0;
    fe_world_destroy(p->world);
    p->world = NULL;
}

typedef struct named {
    fe_asset_key *keys;
    fe_asset *assets;
    int32_t count;
    size_t size;
} named;

static fe_result name_assets(const char *function, fe_player *p, const unsigned char *at, named *n)
{
    for (int32_t i = 0; i < n->count; ++i) {
        fe_asset recorded = fe__take_u64(&at);
        n->keys[i].words[0] = fe__take_u64(&at);
        n->keys[i].words[1] = fe__take_u64(&at);
        FE_TRY(fe__player_name(function, p, recorded, n->keys[i].words));
        n->assets[i] = fe__player_asset(p, recorded);
    }
    return FE_OK;
}

// ---- compounds -----------------------------------------------------------------------------------------------------
// Of the keyframe's assets, the one with the content of a part's, whose handle may be dead
static fe_asset same_content(const fe_player *p, const named *n, fe_asset asset)
{
    const fe_store *store = p->world->store;
    fe__store_lock(store);
    fe__asset_key key = fe__asset_key_of(store, fe__id_slot_of(asset));
    fe__store_unlock(store);
    for (int32_t i = 0; i < n->count; ++i)
        if (n->keys[i].words[0] == key.words[0] && n->keys[i].words[1] == key.words[1]) return n->assets[i];
    return asset;
}

// 1: a part has another asset now
static int32_t take_parts(const fe_player *p, const named *n, fe_asset compound, fe_compound_part *parts, int32_t count)
{
    int32_t changed = 0;
    for (int32_t i = 0; i < count; ++i) {
        parts[i].struct_size = sizeof *parts;
        fe_compound_get_part(p->world->store, compound, i, parts + i);
        fe_asset *asset = &parts[i].geometry.asset, same = *asset ? same_content(p, n, *asset) : 0;
        changed |= same != *asset;
        *asset = same;
    }
    return changed;
}

// A compound that was loaded has parts of its own; in the keyframe others share them
static fe_result share_parts(const char *function, fe_player *p, const named *n, fe_asset *compound)
{
    fe_store *store = p->world->store;
    fe_compound_info info;
    fe_compound_info_init(&info, sizeof info);
    if (fe_asset_get_type(store, *compound) != FE_GEOMETRY_COMPOUND) return FE_OK;
    FE_TRY(fe_compound_get_info(store, *compound, &info));
    size_t size = (size_t)info.part_count * sizeof(fe_compound_part);
    fe_compound_part *parts = fe__allocate(&p->memory, size);
    if (!parts) return fe__report(function, FE_ERROR_MEMORY);
    fe_asset made = 0;
    fe_result result = FE_OK;
    if (take_parts(p, n, *compound, parts, info.part_count))
        result = fe_compound_create(store, parts, sizeof *parts, info.part_count, &made);
    fe__release(&p->memory, parts, size);
    if (made) {
        fe_asset_destroy(store, *compound);
        *compound = made;
    }
    return result;
}

static fe_result share_all_parts(const char *function, fe_player *p, const unsigned char *at, named *n)
{
    for (int32_t i = 0; i < n->count; ++i, at += FE__ASSET_ENTRY) {
        const unsigned char *handle = at;
        fe__replay_asset *a = find(p, fe__take_u64(&handle));
        FE_TRY(share_parts(function, p, n, &a->own));
        n->assets[i] = a->own;
    }
    return FE_OK;
}

static fe_result restore_with(const char *function, fe_player *p, const fe__fed_chunk *keyframe, named *n)
{
    int64_t front = FE__KEYFRAME_FRONT + (int64_t)FE__ASSET_ENTRY * n->count;
    const unsigned char *has_filter = keyframe->content + 4;
    FE_TRY(name_assets(function, p, keyframe->content + FE__KEYFRAME_FRONT, n));
    FE_TRY(share_all_parts(function, p, keyframe->content + FE__KEYFRAME_FRONT, n));
    fe_restore_options options;
    fe_restore_options_init(&options, sizeof options);
    options.asset_count = n->count, options.keys = n->keys, options.assets = n->assets;
    p->world->pair_filter = fe__player_answer, p->world->pair_filter_user = p;
    fe_result result = fe_world_restore(p->world, &options, keyframe->content + front, keyframe->size - front);
    if (result >= 0 && !fe__take_u32(&has_filter)) p->world->pair_filter = NULL;
    return result < 0 ? result : FE_OK; // of other results: the player says so
}

fe_result fe__player_restore(const char *function, fe_player *p, const fe__fed_chunk *keyframe)
{
    const unsigned char *at = keyframe->content;
    int64_t count = fe__take_u32(&at);
    if (count > (keyframe->size - FE__KEYFRAME_FRONT) / FE__ASSET_ENTRY)
        return fe__fail(function, FE_ERROR_DATA, "a keyframe has fewer assets than it says");
    FE_TRY(open_world(p));
    named n = {.count = (int32_t)count};
    n.size = (size_t)(count + 1) * (sizeof *n.keys + sizeof *n.assets);
    n.keys = fe__allocate(&p->memory, n.size);
    if (!n.keys) return fe__report(function, FE_ERROR_MEMORY);
    n.assets = (fe_asset *)(void *)(n.keys + count + 1);
    fe_result result = restore_with(function, p, keyframe, &n);
    fe__release(&p->memory, n.keys, n.size);
    return result;
}

// ---- file -----------------------------------------------------------------------------------------------------------
// See player.h. Memory is asked for as bytes come, whatever a header promises.

static fe_result refuse(fe__file *f, fe_result why, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(f->sentence, sizeof f->sentence, format, arguments);
    va_end(arguments);
    return f->refused = why;
}

// ---- the header of the file ----------------------------------------------------------------------------------------
static fe_result open_header(fe__file *f)
{
    const unsigned char *at = f->header, *sum = f->header + FE__RECORDING_SUM_AT;
    if (memcmp(at, fe__recording_magic, sizeof fe__recording_magic) != 0)
        return refuse(f, FE_ERROR_DATA, "these bytes are no recording");
    at += sizeof fe__recording_magic;
    uint32_t major = fe__take_u16(&at);
    fe__take_u16(&at); // what a minor version adds is passed over
    if (fe__take_u64(&sum) != fe__recording_sum(f->header))
        return refuse(f, FE_ERROR_DATA, "the header was altered: its sum is another");
    if (major != FE__RECORDING_MAJOR)
        return refuse(f, FE_ERROR_VERSION, "the recording has format %u, this library reads %d", (unsigned)major,
                      FE__RECORDING_MAJOR);
    f->results = fe__take_u32(&at);
    f->library = fe__take_u32(&at);
    f->flags = fe__take_u32(&at);
    f->bytes = FE__RECORDING_HEADER;
    f->header_size = 0;
    return FE_OK;
}

// ---- chunks --------------------------------------------------------------------------------------------------------
static int64_t promised_size(const fe__file *f)
{
    const unsigned char *at = f->header + 8;
    return (int64_t)fe__take_u64(&at);
}

static fe_result check_front(fe__file *f)
{
    int64_t size = promised_size(f);
    if (size < 0 || size >= INT32_MAX)
        return refuse(f, FE_ERROR_DATA, "the chunk at byte %lld has a size that none has", (long long)f->bytes);
    const unsigned char *at = f->header + 4;
    if (fe__take_u32(&at) & FE__CHUNK_DEFLATED)
        return refuse(f, FE_ERROR_UNSUPPORTED, "the chunk at byte %lld is packed: tools/feather-rec unpacks it",
                      (long long)f->bytes);
    return FE_OK;
}

static int32_t is_too_short(const fe__fed_chunk *c)
{
    switch (c->type) {
    case FE__CHUNK_KEYFRAME:
        return c->size < FE__KEYFRAME_FRONT;
    case FE__CHUNK_ASSET:
        return c->size < FE__ASSET_KEY;
    case FE__CHUNK_NOTE:
        return c->size < FE__NOTE_FRONT;
    default:
        return 0;
    }
}

// A text ends with 0: padding may be none
static fe_result end_text(fe__file *f, fe__fed_chunk *c)
{
    int32_t capacity = (int32_t)c->capacity;
    if (!fe__reserve(f->memory, &c->content, &capacity, c->size + 1, 1)) return FE_ERROR_MEMORY;
    c->capacity = capacity;
    c->content[c->size] = 0;
    return FE_OK;
}

static int32_t is_known(uint32_t type)
{
    return type == FE__CHUNK_KEYFRAME || type == FE__CHUNK_ASSET || type == FE__CHUNK_OPS || type == FE__CHUNK_NOTE;
}

static fe_result close_chunk(fe__file *f)
{
    const unsigned char *at = f->header;
    fe__fed_chunk c = {.type = fe__take_u32(&at), .flags = fe__take_u32(&at)};
    c.size = promised_size(f);
    at = f->header + 16;
    uint64_t sum = fe__take_u64(&at);
    c.step = (int64_t)fe__take_u64(&at);
    if (sum != fe__chunk_sum(f->header, f->content))
        return refuse(f, FE_ERROR_DATA, "the chunk at byte %lld was altered: its sum is another", (long long)f->bytes);
    if (is_too_short(&c) || c.step < 0)
        return refuse(f, FE_ERROR_DATA, "the chunk at byte %lld is no such chunk", (long long)f->bytes);
    if (!FE_RESERVE(f->memory, f->chunks, f->chunk_capacity, f->chunk_count + 1)) return FE_ERROR_MEMORY;
    c.content = f->content, c.capacity = f->content_capacity;
    if (c.type == FE__CHUNK_NOTE && end_text(f, &c) != FE_OK) return FE_ERROR_MEMORY;
    f->bytes += FE__CHUNK_HEADER + fe__padded(c.size);
    f->header_size = 0;
    f->content_size = 0;
    if (!is_known(c.type)) return FE_OK; // its room serves the next one
    f->content = NULL, f->content_capacity = 0;
    f->chunks[f->chunk_count++] = c;
    f->keyframes += c.type == FE__CHUNK_KEYFRAME;
    f->notes += c.type == FE__CHUNK_NOTE;
    return FE_OK;
}

// ---- bytes ---------------------------------------------------------------------------------------------------------
static int64_t fill_header(fe__file *f, const unsigned char *bytes, int64_t size)
{
    int64_t whole = f->library ? FE__CHUNK_HEADER : FE__RECORDING_HEADER, lacks = whole - f->header_size;
    int64_t taken = size < lacks ? size : lacks;
    memcpy(f->header + f->header_size, bytes, (size_t)taken);
    f->header_size += (int32_t)taken;
    return taken;
}

// -1: no memory
static int64_t fill_content(fe__file *f, const unsigned char *bytes, int64_t size)
{
    int64_t lacks = fe__padded(promised_size(f)) - f->content_size, taken = size < lacks ? size : lacks;
    if (f->content_size == 0 && taken == lacks)
        FE_FREE(f->memory, f->content, f->content_capacity); // it is all here: room for just that
    if (!FE_RESERVE(f->memory, f->content, f->content_capacity, f->content_size + taken + 8)) return -1;
    if (taken) memcpy(f->content + f->content_size, bytes, (size_t)taken);
    f->content_size += taken;
    return taken;
}

static fe_result feed_some(fe__file *f, const unsigned char *bytes, int64_t size, int64_t *out_taken)
{
    int32_t whole = f->library ? FE__CHUNK_HEADER : FE__RECORDING_HEADER;
    *out_taken = 0;
    if (f->header_size < whole) {
        *out_taken = fill_header(f, bytes, size);
        if (f->header_size < whole) return FE_OK;
        return f->library ? check_front(f) : open_header(f);
    }
    int64_t taken = fill_content(f, bytes, size);
    if (taken < 0) return FE_ERROR_MEMORY;
    *out_taken = taken;
    return f->content_size == fe__padded(promised_size(f)) ? close_chunk(f) : FE_OK;
}

// A chunk without content is, with its header
static int32_t is_whole(const fe__file *f)
{
    return f->library && f->header_size == FE__CHUNK_HEADER && f->content_size == fe__padded(promised_size(f));
}

fe_result fe__file_feed(fe__file *f, const unsigned char *bytes, int64_t size)
{
    int64_t at = f->owed;
    f->owed = 0;
    while (f->refused == FE_OK && (at < size || is_whole(f))) {
        int64_t taken;
        fe_result result = feed_some(f, bytes + at, size - at, &taken);
        at += taken;
        if (result == FE_ERROR_MEMORY) f->owed = at;
        if (result != FE_OK) return result;
    }
    return f->refused;
}

void fe__file_free(fe__file *f)
{
    for (int32_t i = 0; i < f->chunk_count; ++i)
        fe__release(f->memory, f->chunks[i].content, (size_t)f->chunks[i].capacity);
    FE_FREE(f->memory, f->chunks, f->chunk_capacity);
    FE_FREE(f->memory, f->content, f->content_capacity);
}

// The last one: an asset's content does not change with its key
const unsigned char *fe__file_find_asset(const fe__file *f, const uint64_t *key, int64_t *out_size)
{
    for (int32_t i = f->chunk_count - 1; i >= 0; --i) {
        const fe__fed_chunk *c = f->chunks + i;
        const unsigned char *at = c->content;
        if (c->type != FE__CHUNK_ASSET) continue;
        if (fe__take_u64(&at) != key[0] || fe__take_u64(&at) != key[1]) continue;
        *out_size = c->size - FE__ASSET_KEY;
        return at;
    }
    return NULL;
}
