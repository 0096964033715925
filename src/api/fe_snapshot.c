// fe_snapshot.c - the API of states in memory, and of clones.
#include "api/check.h"
#include "api/fe_joint_def.h"
#include "api/fe_store.h"
#include "api/fe_world.h"
#include "core/fp_state.h"
#include "snapshot/compare.h"
#include "snapshot/delta.h"
#include "snapshot/history.h"
#include "snapshot/restore.h"
#include "snapshot/state.h"
#include "snapshot/write.h"
#include "store/asset.h"
#include "store/asset_bytes.h"
#include "world/joint.h"
#include "world/joint_creation.h"
#include "world/shape.h"
#include "world/world_memory.h"

#include <string.h>

// ---- state ----------------------------------------------------------------------------------------------------------

fe_result fe_state_create(const fe_world *world, const fe_allocator *allocator, fe_state **out_state)
{
    FE_READ(world);
    FE_CHECK_POINTER(out_state);
    fe_allocator copy = {.struct_size = sizeof copy};
    if (allocator) FE_TRY(fe__read_allocator(function, allocator, &copy));
    return fe__report(function, fe__state_create(world, allocator ? &copy : NULL, out_state));
}

static fe_result check_state(const char *function, const fe_state *state)
{
    FE_CHECK_POINTER(state);
    return fe__state_lives(state) ? FE_OK : fe__fail(function, FE_ERROR_STALE, "the state is gone");
}

fe_result fe_state_destroy(fe_state *state)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_TRY(check_state(function, state));
    fe__state_destroy(state);
    return FE_OK;
}

fe_result fe_world_set_state(fe_world *world, const fe_state *state)
{
    FE_WRITE_ALONE(world);
    FE_TRY(check_state(function, state));
    if (state->store != world->store)
        return fe__fail(function, FE_ERROR_STATE, "the state is of a world that uses another store than this one");
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__held_return(state->held, world);
    fe__fp_leave(fp);
    if (result == FE_OK && world->recorder) fe__record_jump(world->recorder);
    return fe__report_return(function, result);
}

fe_result fe_world_clone(const fe_world *source, const fe_world_def *def, fe_world **out_world)
{
    const char *function = __func__;
    FE_CHECK_POINTER(source);
    FE_READ_AS(function, source);
    FE_CHECK_POINTER(out_world);
    fe__whole_def whole;
    FE_TRY(fe__read_world_def(function, def, &whole));
    if (whole.def.store && whole.def.store != source->store)
        return fe__fail(function, FE_ERROR_ARGUMENT, "store is another one than the source's, which a clone shares");
    fe_world *world;
    FE_TRY(fe__report_creation(function, &whole.def, fe__world_clone(source, &whole.def, &world)));
    *out_world = world;
    fe__owner_leave(&world->owner);
    return FE_OK;
}

// ---- history --------------------------------------------------------------------------------------------------------
// The API of histories: frames of a world to go back to.

enum { MOST_FRAMES = 1 << 16 }; // 18 minutes at 60 Hz
enum { LEAST_RECORD = 8 };      // bytes of a record that a caller may ask for

static fe_history_def default_history(void)
{
    return (fe_history_def){.struct_size = sizeof(fe_history_def), .frames = 16};
}

void fe_history_def_init(fe_history_def *def, uint32_t struct_size)
{
    fe_history_def defaults = default_history();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

// Declares `world`, which is entered. It is no harm to ask a history that is gone: nothing behind the pointer is read
#define FE_ENTER_HISTORY(history)                                                                  \
    const char *function = __func__;                                                               \
    FE_CHECK_POINTER(history);                                                                     \
    fe_world *world = fe__world_of_history(history);                                               \
    if (!world) return fe__fail(function, FE_ERROR_STALE, "the history is gone, or its world is"); \
    FE_WRITE_AS(function, world)

fe_result fe_history_create(fe_world *world, const fe_history_def *def, fe_history **out_history)
{
    FE_WRITE(world);
    FE_CHECK_POINTER(out_history);
    fe_history_def full = default_history();
    if (def) FE_READ_STRUCT(def, &full);
    FE_CHECK_INT(full.frames, 1, MOST_FRAMES);
    FE_CHECK_INT(full.bytes, 0, INT64_MAX);
    return fe__report(function, fe__history_create(world, full.frames, full.bytes, out_history));
}

fe_result fe_history_destroy(fe_history *history)
{
    FE_ENTER_HISTORY(history);
    fe__history_destroy(history);
    return FE_OK;
}

fe_result fe_history_keep(fe_history *history, int64_t frame)
{
    FE_ENTER_HISTORY(history);
    if (history->count) {
        int64_t last = fe__history_frame(history, history->count - 1)->number;
        if (frame <= last)
            return fe__fail(function, FE_ERROR_ARGUMENT, "frame is %lld, must be above %lld, the last one kept",
                            (long long)frame, (long long)last);
    }
    fe_result result = fe__history_keep(history, frame);
    if (result == FE_ERROR_LIMIT)
        return fe__fail(function, result, "the frame alone needs more than the %lld bytes of the history",
                        (long long)history->most_bytes);
    return fe__report(function, result);
}

fe_result fe__report_return(const char *function, fe_result result)
{
    if (result == FE_ERROR_STEPPING || result == FE_ERROR_BUSY) {
        const char *why = result == FE_ERROR_STEPPING ? "is in a step" : "has another thread inside";
        return fe__fail(function, result, "a world that uses an asset edited since %s; nothing was changed", why);
    }
    return fe__report(function, result);
}

fe_result fe_history_restore(fe_history *history, int64_t frame)
{
    FE_ENTER_HISTORY(history);
    if (!fe__owner_be_alone(inside, FE__WRITER)) return fe__refuse_writer(function);
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__history_restore(history, frame);
    fe__fp_leave(fp);
    if (result == FE_OK && world->recorder) fe__record_jump(world->recorder);
    if (result == FE_ERROR_STALE)
        return fe__fail(function, result, "frame %lld is not kept, or no longer", (long long)frame);
    return fe__report_return(function, result);
}

int32_t fe_history_get_frames(const fe_history *history, fe_history_frame *out_frames, uint32_t stride,
                              int32_t capacity)
{
    FE_ENTER_HISTORY(history);
    --inside->entries; // it writes nothing
    FE_CHECK_ARRAY(out_frames, capacity);
    FE_CHECK_RECORD_STRIDE(stride, LEAST_RECORD, capacity);
    for (int32_t i = 0; i < fe__mini(history->count, capacity); ++i) {
        fe_history_frame frame = {fe__history_frame(history, i)->number, fe__history_bytes(history, i)};
        memcpy(fe__at(out_frames, stride, i), &frame, sizeof frame < stride ? sizeof frame : stride);
    }
    return history->count;
}

// ---- snapshot -------------------------------------------------------------------------------------------------------
// The API of snapshots: a world as bytes, and back.

FE_DEFINE_EMPTY_INIT(fe_save_options_init, fe_save_options, options)
FE_DEFINE_EMPTY_INIT(fe_restore_options_init, fe_restore_options, options)
FE_DEFINE_EMPTY_INIT(fe_snapshot_info_init, fe_snapshot_info, info)
FE_DEFINE_EMPTY_INIT(fe_difference_init, fe_difference, difference)

// ---- assets --------------------------------------------------------------------------------------------------------

fe_result fe_asset_get_key(const fe_store *store, fe_asset asset, fe_asset_key *out_key)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_POINTER(out_key);
    int32_t index;
    fe__store_lock(store);
    fe_result result = fe__find_asset(function, "asset", store, asset, &index);
    if (result == FE_OK) {
        fe__asset_key key = fe__asset_key_of(store, index);
        *out_key = (fe_asset_key){{key.words[0], key.words[1]}};
    }
    fe__store_unlock(store);
    return result;
}

// ---- saving --------------------------------------------------------------------------------------------------------

static fe_result read_save_options(const char *function, const fe_save_options *options, fe_save_options *full)
{
    *full = (fe_save_options){.struct_size = sizeof *full};
    if (options) FE_READ_STRUCT(options, full);
    FE_CHECK_BITS(full->flags, FE_SAVE_ASSETS | FE_SAVE_DIFF);
    if (!(full->flags & FE_SAVE_DIFF)) return FE_OK;
    FE_CHECK_POINTER(full->base);
    FE_CHECK_INT(full->base_size, 0, INT64_MAX);
    return FE_OK;
}

// Under the store's lock; base: NULL, or of what to write the difference. A whole snapshot may be smaller
static int64_t save(const fe_world *world, int32_t with_assets, const fe__snapshot *base, unsigned char *out,
                    int64_t capacity)
{
    int64_t size = fe__snapshot_size(world, with_assets), room = base ? fe__delta_room(size) : size;
    if (room > capacity) return room;
    fe__snapshot_write(world, with_assets, out + (room - size));
    if (!base) return size;
    int64_t written = fe__delta_write(out, size, base);
    if (written && written < size) return written;
    fe__snapshot_write(world, with_assets, out);
    return size;
}

int64_t fe_world_save(const fe_world *world, const fe_save_options *options, void *out, int64_t capacity)
{
    FE_READ(world);
    fe_save_options full;
    fe__snapshot base;
    FE_CHECK_INT(capacity, 0, INT64_MAX);
    if (capacity > 0) FE_CHECK_POINTER(out);
    FE_TRY(read_save_options(function, options, &full));
    int32_t with_assets = (full.flags & FE_SAVE_ASSETS) != 0, is_diff = (full.flags & FE_SAVE_DIFF) != 0;
    if (is_diff && !fe__snapshot_outline(&base, full.base, full.base_size))
        return fe__fail(function, base.result, "base: %s", base.sentence);
    fe__store_lock(world->store);
    int64_t size = save(world, with_assets, is_diff ? &base : NULL, out, capacity);
    fe__store_unlock(world->store);
    return size;
}

// ---- assets of a snapshot ------------------------------------------------------------------------------------------

// Where they are: what the caller says, and what was in the bytes. Each has a use of ours, so that no other thread's
// call ends it
typedef struct known_assets {
    fe__asset_key *keys;
    int32_t *assets;
    fe_asset *made; // of the store, from the bytes
    int32_t count, made_count, capacity;
    int32_t has_stand_ins; // 1: the caller gives one that holds something else than its key says
} known_assets;

static size_t known_size(const known_assets *k)
{
    return (size_t)k->capacity * (sizeof *k->keys + sizeof *k->assets + sizeof *k->made);
}

static fe_result open_known(const char *function, fe_world *world, int64_t capacity, known_assets *k)
{
    *k = (known_assets){.capacity = (int32_t)capacity};
    if (capacity == 0) return FE_OK;
    if (capacity > FE_ID_MAX_SLOTS) return fe__report(function, FE_ERROR_LIMIT);
    k->keys = fe__allocate(&world->memory, known_size(k));
    if (!k->keys) return fe__report(function, FE_ERROR_MEMORY);
    k->made = (fe_asset *)(void *)(k->keys + capacity);
    k->assets = (int32_t *)(void *)(k->made + capacity);
    return FE_OK;
}

static fe_result take_given(const char *function, fe_store *store, const fe_restore_options *options, known_assets *k)
{
    for (int32_t i = 0; i < options->asset_count; ++i, ++k->count) {
        FE_TRY(fe__find_asset(function, "assets", store, options->assets[i], k->assets + i));
        fe__asset_retain(store, k->assets[i]);
        memcpy(k->keys + i, options->keys + i, sizeof *k->keys);
        k->has_stand_ins |= !fe__keys_are_same(k->keys[i], fe__asset_key_of(store, k->assets[i]));
    }
    return FE_OK;
}

// What the store has already is not made again
static fe_result make_asset(const char *function, fe_store *store, const unsigned char *bytes, int64_t size,
                            known_assets *k)
{
    fe__cooked cooked;
    fe_asset made;
    fe_result result = fe__asset_read(store, bytes, size, &cooked, &made);
    if (result == FE_ERROR_DATA || result == FE_ERROR_VERSION)
        return fe__fail(function, result, "an asset inside: %s", cooked.sentence);
    FE_TRY(fe__report(function, result));
    fe__store_lock(store);
    int32_t index = fe__id_slot_of(made);
    fe__asset_key key = fe__asset_key_of(store, index);
    int32_t first = fe__store_find_key(store, key, 0), is_new = first == index;
    fe__asset_retain(store, first);
    if (is_new)
        k->made[k->made_count++] = made;
    else
        fe__asset_destroy(store, index);
    k->keys[k->count] = key;
    k->assets[k->count++] = first;
    fe__store_unlock(store);
    return FE_OK;
}

static fe_result make_assets(const char *function, fe_store *store, const fe__snapshot *snapshot, known_assets *k)
{
    int64_t at = snapshot->assets_at, size;
    for (const unsigned char *bytes; (bytes = fe__next_asset_bytes(snapshot, &at, &size));)
        FE_TRY(make_asset(function, store, bytes, size, k));
    return FE_OK;
}

// Where a compound that was just made has a part with the content of an asset beside it, the two are one: an edit is
// felt by both, as it was where they were saved. The compound is nobody's yet
static fe_result share_part(fe_store *store, const known_assets *k, fe__compound_part *part)
{
    const fe__asset_key key = fe__asset_key_of(store, part->form.field);
    const fe_vec3 scale = fe__store_asset(store, part->form.field)->scale;
    for (int32_t i = 0; i < k->count; ++i) {
        int32_t index = k->assets[i];
        fe__scale_refusal refusal;
        if (!fe__keys_are_same(k->keys[i], key) || index == fe__store_parent(store, part->form.field)->index) continue;
        if (scale.x != 1.0f || scale.y != 1.0f || scale.z != 1.0f) {
            fe_result made = fe__asset_scaled(store, index, scale, &index, &refusal);
            if (made != FE_OK) return made;
        }
        fe__asset_retain(store, index);
        fe__asset_release(store, part->form.field);
        part->form = fe__asset_form(store, index);
        return FE_OK;
    }
    return FE_OK;
}

static fe_result share_parts(const char *function, fe_store *store, const known_assets *k)
{
    fe_result result = FE_OK;
    fe__store_lock(store);
    for (int32_t i = 0; i < k->made_count; ++i) {
        const fe__asset *a = fe__store_asset(store, fe__id_slot_of(k->made[i]));
        for (int32_t p = 0; a->kind == FE__ASSET_COMPOUND && p < a->compound.count && result == FE_OK; ++p)
            if (fe__form_has_asset(&a->compound.parts[p].form)) result = share_part(store, k, a->compound.parts + p);
    }
    fe__store_unlock(store);
    return fe__report(function, result);
}

static void close_known(fe_world *world, known_assets *k, fe_result result)
{
    fe__store_lock(world->store);
    for (int32_t i = 0; i < k->made_count && result < 0; ++i)
        fe__asset_destroy(world->store, fe__id_slot_of(k->made[i]));
    for (int32_t i = 0; i < k->count; ++i) fe__asset_release(world->store, k->assets[i]);
    fe__store_unlock(world->store);
    if (k->keys) fe__release(&world->memory, k->keys, known_size(k));
}

// ---- restoring -----------------------------------------------------------------------------------------------------

static fe_result report_refusal(const char *function, const fe__build *build)
{
    const fe__snapshot *s = build->snapshot;
    switch ((int)s->result) {
    case FE_ERROR_DATA:
    case FE_ERROR_VERSION:
        return fe__fail(function, s->result, "%s", s->sentence);
    case FE_ERROR_STATE:
        return fe__fail(function, s->result, "the asset with the key %016llx %016llx is nowhere",
                        (unsigned long long)build->missing.words[0], (unsigned long long)build->missing.words[1]);
    default:
        return fe__report(function, s->result);
    }
}

// What the setters would refuse. The sentence is theirs
static fe_result check_values(const char *function, const fe_world *w)
{
    if (fe__check_tuning(function, &w->tuning) != FE_OK) return FE_ERROR_DATA;
    if (fe__check_vec3(function, "gravity", &w->gravity, FE_MAX_SPEED) != FE_OK) return FE_ERROR_DATA;
    for (int32_t joint = w->first_joint; joint; joint = w->joint_records[joint].order_next) {
        fe__joint_any def;
        memset(&def, 0, sizeof def);
        fe__joint_describe(w, joint, &def);
        if (fe__check_joint_def(function, w->joint_records[joint].type, &def) != FE_OK) return FE_ERROR_DATA;
    }
    return FE_OK;
}

static fe_result exchange(const char *function, fe_world *world, fe__build *build, int32_t number)
{
    fe_world *beside = fe__allocate(&world->memory, sizeof *beside);
    if (!beside) return fe__report(function, FE_ERROR_MEMORY);
    fe_result result = FE_OK;
    if (!fe__snapshot_prepare(build, world, beside, number)) result = report_refusal(function, build);
    if (result == FE_OK) result = check_values(function, beside);
    if (result == FE_OK) fe__snapshot_adopt(world, beside, build);
    fe__snapshot_drop(world, beside);
    fe__release(&world->memory, beside, sizeof *beside);
    return result;
}

static fe_result read_options(const char *function, const fe_restore_options *options, fe_restore_options *full)
{
    *full = (fe_restore_options){.struct_size = sizeof *full};
    if (!options) return FE_OK;
    FE_READ_STRUCT(options, full);
    FE_CHECK_BOOL(full->new_number);
    FE_CHECK_ARRAY(full->keys, full->asset_count);
    FE_CHECK_ARRAY(full->assets, full->asset_count);
    FE_CHECK_INT(full->reserved, 0, 0);
    FE_CHECK_INT(full->base_size, 0, INT64_MAX);
    return FE_OK;
}

static int32_t had_filter(const fe__snapshot *snapshot)
{
    fe__world_row row;
    fe__take_row(snapshot, FE__TABLE_WORLD, 0, &row);
    return row.has_filter;
}

static fe_result restore_opened(const char *function, fe_world *world, const fe_restore_options *options,
                                fe__snapshot *snapshot)
{
    if (fe__rows_of(snapshot, FE__TABLE_WORLD) == 1 && had_filter(snapshot) && !world->pair_filter)
        return fe__fail(function, FE_ERROR_STATE,
                        "the saved world had a pair filter: set one, then restore the snapshot in that world");
    known_assets known;
    FE_TRY(open_known(function, world, (int64_t)options->asset_count + snapshot->asset_count, &known));
    fe__store_lock(world->store);
    fe_result result = take_given(function, world->store, options, &known);
    fe__store_unlock(world->store);
    if (result == FE_OK) result = make_assets(function, world->store, snapshot, &known);
    if (result == FE_OK) result = share_parts(function, world->store, &known);
    fe__build build = {.snapshot = snapshot,
                       .keys = known.keys,
                       .assets = known.assets,
                       .asset_count = known.count,
                       .has_stand_ins = known.has_stand_ins};
    int32_t number = options->new_number ? world->number : snapshot->number;
    if (result == FE_OK) result = exchange(function, world, &build, number);
    close_known(world, &known, result);
    return result != FE_OK || snapshot->results == FE__RESULTS ? result : FE_FOREIGN;
}

static fe_result open_bytes(const char *function, const void *bytes, int64_t size, fe__snapshot *snapshot)
{
    FE_CHECK_POINTER(bytes);
    FE_CHECK_INT(size, 0, INT64_MAX);
    if (fe__snapshot_open(snapshot, bytes, size)) return FE_OK;
    return fe__fail(function, snapshot->result, "%s", snapshot->sentence);
}

static fe_result restore_whole(const char *function, fe_world *world, const fe_restore_options *options,
                               const void *bytes, int64_t size)
{
    fe__snapshot snapshot;
    fe__fp_state fp = fe__fp_enter();
    fe_result result = open_bytes(function, bytes, size, &snapshot);
    if (result == FE_OK) result = restore_opened(function, world, options, &snapshot);
    fe__fp_leave(fp);
    return result;
}

static fe_result restore_diff(const char *function, fe_world *world, const fe_restore_options *options,
                              const void *bytes, int64_t size)
{
    fe__snapshot refusal = {.result = FE_OK};
    int64_t whole_size = fe__delta_open(&refusal, bytes, size, options->base, options->base_size);
    if (!whole_size) return fe__fail(function, refusal.result, "%s", refusal.sentence);
    unsigned char *whole = fe__allocate_scratch(&world->memory, (size_t)whole_size);
    if (!whole) return fe__report(function, FE_ERROR_MEMORY);
    fe_result result = fe__delta_apply(&refusal, bytes, size, options->base, options->base_size, whole, whole_size)
                           ? restore_whole(function, world, options, whole, whole_size)
                           : fe__fail(function, refusal.result, "%s", refusal.sentence);
    fe__release(&world->memory, whole, (size_t)whole_size);
    return result;
}

static fe_result restore(const char *function, fe_world *world, const fe_restore_options *options, const void *bytes,
                         int64_t size)
{
    fe_restore_options full;
    FE_TRY(read_options(function, options, &full));
    if (bytes && fe__is_delta(bytes, size)) return restore_diff(function, world, &full, bytes, size);
    return restore_whole(function, world, &full, bytes, size);
}

fe_result fe_world_restore(fe_world *world, const fe_restore_options *options, const void *bytes, int64_t size)
{
    FE_WRITE_ALONE(world);
    fe_result result = restore(function, world, options, bytes, size);
    if (result >= 0 && world->recorder) fe__record_jump(world->recorder);
    return result;
}

fe_result fe_world_load(const fe_world_def *def, const fe_restore_options *options, const void *bytes, int64_t size,
                        fe_world **out_world)
{
    FE_BEGIN_WITHOUT_WORLD();
    fe_world *world;
    FE_CHECK_POINTER(out_world);
    FE_TRY(fe__create_world(function, def, &world));
    fe_result result = restore(function, world, options, bytes, size);
    if (result < 0) {
        fe__world_destroy(world);
        return result;
    }
    *out_world = world;
    fe__owner_leave(&world->owner);
    return result;
}

// ---- without a world -----------------------------------------------------------------------------------------------

static int32_t handled_slots(const fe__snapshot *snapshot, fe__table_number table)
{
    int32_t count = 0;
    for (int32_t i = 0; i < fe__rows_of(snapshot, table); ++i) {
        fe__id_slot slot;
        fe__take_row(snapshot, table, i, &slot);
        count += slot.next == FE_ID_ALIVE;
    }
    return count;
}

static void tell(const fe__snapshot *snapshot, fe_snapshot_info *out_info)
{
    fe__world_row row;
    fe__take_row(snapshot, FE__TABLE_WORLD, 0, &row);
    fe_snapshot_info info = {.library = snapshot->version,
                             .foreign = snapshot->results != FE__RESULTS,
                             .number = (uint32_t)snapshot->number,
                             .step = row.step_number,
                             .bodies = fe__rows_of(snapshot, FE__TABLE_BODIES),
                             .shapes = handled_slots(snapshot, FE__TABLE_SHAPE_SLOTS),
                             .joints = fe__rows_of(snapshot, FE__TABLE_JOINTS),
                             .assets = fe__rows_of(snapshot, FE__TABLE_ASSETS),
                             .inside = snapshot->asset_count,
                             .filter = row.has_filter};
    fe__write_struct(out_info, &info, sizeof info);
}

// A world that nobody sees. An asset that is missing is no fault of the bytes: what rests on it stays unchecked
static fe_result check_all(const char *function, fe__snapshot *snapshot)
{
    const fe_restore_options options = {.struct_size = sizeof options};
    fe_world *world;
    const fe_world_def def = {
        .struct_size = sizeof def, .worker_count = 1, .substeps = 1, .simd = FE_SIMD_AUTO, .number = 1};
    FE_TRY(fe__create_world(function, &def, &world));
    world->pair_filter = fe__accept_pair;
    fe_result result = restore_opened(function, world, &options, snapshot);
    fe__world_destroy(world);
    return result == FE_ERROR_STATE ? FE_OK : result;
}

fe_result fe_snapshot_check(const void *bytes, int64_t size, fe_snapshot_info *out_info)
{
    FE_BEGIN_WITHOUT_WORLD();
    fe__snapshot snapshot;
    if (out_info) FE_CHECK_STRUCT_SIZE(out_info);
    fe__fp_state fp = fe__fp_enter();
    fe_result result = open_bytes(function, bytes, size, &snapshot);
    int32_t number = result == FE_OK ? snapshot.number : 0;
    if (result == FE_OK) result = check_all(function, &snapshot);
    fe__fp_leave(fp);
    if (result < 0) return result;
    snapshot.number = number;
    if (out_info) tell(&snapshot, out_info);
    return snapshot.results == FE__RESULTS ? FE_OK : FE_FOREIGN;
}

int32_t fe_snapshot_get_assets(const void *bytes, int64_t size, fe_asset_key *out_keys, uint32_t stride,
                               int32_t capacity)
{
    FE_BEGIN_WITHOUT_WORLD();
    fe__snapshot snapshot;
    FE_CHECK_ARRAY(out_keys, capacity);
    FE_CHECK_RECORD_STRIDE(stride, sizeof(fe_asset_key), capacity);
    FE_TRY(open_bytes(function, bytes, size, &snapshot));
    int32_t count = fe__rows_of(&snapshot, FE__TABLE_ASSETS);
    for (int32_t i = 0; i < fe__mini(count, capacity); ++i) {
        fe__asset_row row;
        fe__take_row(&snapshot, FE__TABLE_ASSETS, i, &row);
        fe_asset_key key = {{row.key[0], row.key[1]}};
        memcpy(fe__at(out_keys, stride, i), &key, sizeof key);
    }
    return count;
}

// ---- comparing -----------------------------------------------------------------------------------------------------

static fe_result open_one(const char *function, const char *name, const void *bytes, int64_t size,
                          fe__snapshot *snapshot)
{
    if (!bytes) return fe__fail(function, FE_ERROR_ARGUMENT, "%s is NULL", name);
    if (size < 0) return fe__fail(function, FE_ERROR_ARGUMENT, "%s_size is %lld", name, (long long)size);
    if (!fe__snapshot_open(snapshot, bytes, size))
        return fe__fail(function, snapshot->result, "%s: %s", name, snapshot->sentence);
    if (fe__rows_of(snapshot, FE__TABLE_WORLD) == 1) return FE_OK;
    return fe__fail(function, FE_ERROR_DATA, "%s: there is not one world", name);
}

int32_t fe_snapshot_compare(const void *a, int64_t a_size, const void *b, int64_t b_size, fe_difference *out_difference)
{
    FE_BEGIN_WITHOUT_WORLD();
    fe__snapshot first, second;
    fe__memory memory;
    fe_difference difference;
    if (out_difference) FE_CHECK_STRUCT_SIZE(out_difference);
    FE_TRY(open_one(function, "a", a, a_size, &first));
    FE_TRY(open_one(function, "b", b, b_size, &second));
    second.number = first.number;
    fe__memory_init(&memory, NULL);
    int32_t found = fe__snapshot_compare(&first, &second, &memory, &difference);
    if (found < 0) return fe__report(function, (fe_result)found);
    if (found && out_difference) fe__write_struct(out_difference, &difference, sizeof difference);
    return found;
}
