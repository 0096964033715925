// fe_batch.c - the API of batches.
#include "batch/batch.h"
#include "api/check.h"
#include "api/fe_world.h"

#include <string.h>

enum { MOST_WORLDS = 1 << 20, MOST_STEPS = 1000, MOST_ARRAYS = 1024, MOST_ITEMS = 1 << 20 };

// ---- creation ------------------------------------------------------------------------------------------------------
static fe_batch_def default_batch(void)
{
    return (fe_batch_def){.struct_size = sizeof(fe_batch_def), .world_count = 1, .worker_count = 1};
}

void fe_batch_def_init(fe_batch_def *def, uint32_t struct_size)
{
    fe_batch_def defaults = default_batch();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

FE_DEFINE_EMPTY_INIT(fe_array_init, fe_array, array)

static fe_result read_batch_def(const char *function, const fe_batch_def *def, fe_batch_def *full)
{
    *full = default_batch();
    if (!def) return FE_OK;
    FE_READ_STRUCT(def, full);
    FE_CHECK_INT(full->world_count, 1, MOST_WORLDS);
    FE_CHECK_INT(full->worker_count, 1, FE_MAX_WORKERS);
    FE_CHECK_INT(full->block, 0, MOST_WORLDS);
    FE_CHECK_INT(full->reserved, 0, 0);
    return FE_OK;
}

fe_result fe_batch_create(const fe_world *source, const fe_batch_def *def, fe_batch **out_batch)
{
    const char *function = __func__;
    FE_CHECK_POINTER(source);
    FE_READ_AS(function, source);
    FE_CHECK_POINTER(out_batch);
    fe_batch_def full;
    fe__whole_def world;
    fe_task_system tasks = {.struct_size = sizeof tasks};
    FE_TRY(read_batch_def(function, def, &full));
    fe_world_def of_world;
    fe_world_def_init(&of_world, sizeof of_world);
    of_world.simd = full.simd, of_world.allocator = full.allocator;
    FE_TRY(fe__read_world_def(function, &of_world, &world));
    if (full.tasks) FE_TRY(fe__read_tasks(function, full.tasks, &tasks));
    const fe__batch_plan plan = {full.world_count,           full.block, &world.def,
                                 full.tasks ? &tasks : NULL, full.pool,  full.worker_count};
    fe_result result = fe__batch_create(source, &plan, out_batch);
    if (result == FE_ERROR_STALE) return fe__fail(function, result, "pool was destroyed before the batch was created");
    return fe__report_creation(function, &world.def, result);
}

// ---- who is inside -------------------------------------------------------------------------------------------------
static fe_result refuse(const char *function, const fe_batch *batch)
{
    if (!fe__reader_of_thread()) return fe__report(function, FE_ERROR_MEMORY);
    if (atomic_load_explicit(&batch->owner.occupation, memory_order_acquire) == FE__STEP)
        return fe__fail(function, FE_ERROR_STEPPING, "the batch is in a step; call it when fe_batch_step has returned");
    return fe__fail(function, FE_ERROR_BUSY, "another call has this batch now; one batch needs one caller at a time");
}

static fe_result refuse_worlds(const char *function)
{
    return fe__fail(function, FE_ERROR_BUSY, "a world of the batch is in another call; nothing was changed");
}

static fe_batch *writable(const fe_batch *batch) { return (fe_batch *)(uintptr_t)batch; }

// It is no harm to ask a batch that is gone: nothing behind the pointer is read
#define FE_ENTER_BATCH(batch)                                                                      \
    const char *function = __func__;                                                               \
    FE_CHECK_POINTER(batch);                                                                       \
    if (!fe__batch_lives(batch)) return fe__fail(function, FE_ERROR_STALE, "the batch is gone");   \
    FE_CLEANUP(fe__end_write)                                                                      \
    fe__owner *inside = fe__owner_enter(&writable(batch)->owner) ? &writable(batch)->owner : NULL; \
    if (!inside) return refuse(function, batch)

fe_result fe_batch_destroy(fe_batch *batch)
{
    FE_ENTER_BATCH(batch);
    if (!fe__batch_enter(batch, NULL, FE__CLOSING)) return refuse_worlds(function);
    inside = NULL; // its word goes with it
    fe__batch_destroy(batch);
    return FE_OK;
}

fe_result fe_batch_get_world(const fe_batch *batch, int32_t index, fe_world **out_world)
{
    FE_ENTER_BATCH(batch);
    FE_CHECK_POINTER(out_world);
    FE_CHECK_INT(index, 0, batch->count - 1);
    *out_world = batch->worlds[index];
    return FE_OK;
}

// ---- what became of the worlds -------------------------------------------------------------------------------------
static const char *reason_of(fe_result result)
{
    switch ((int)result) {
    case FE_ERROR_ARGUMENT:
        return "a number that is out of range or not finite";
    case FE_ERROR_STATE:
        return "an item that takes no such number";
    case FE_ERROR_STALE:
        return "an item that is gone";
    case FE_ERROR_KIND:
        return "an item of another kind";
    case FE_ERROR_MEMORY:
        return "no memory";
    case FE_ERROR_BUSY:
    case FE_ERROR_STEPPING:
        return "an asset that was edited since, which another world uses";
    default:
        return "what fe_world_step would report";
    }
}

static void tell_first(const char *function, const fe_batch *b)
{
    int32_t world = 0;
    while (b->faults[world].result == FE_OK) ++world;
    const fe__fault *f = b->faults + world;
    if (f->array == FE__IN_A_STEP)
        fe__fail(function, f->result, "world %d failed in a step: %s", (int)world, reason_of(f->result));
    else if (f->array == FE__IN_A_RESET)
        fe__fail(function, f->result, "world %d stays as it was: %s", (int)world, reason_of(f->result));
    else
        fe__fail(function, f->result, "world %d, array %d, item %d: %s", (int)world, (int)f->array, (int)f->item,
                 reason_of(f->result));
}

static int32_t tell_faults(const char *function, const fe_batch *b, int32_t *out_results)
{
    int32_t failed = 0;
    for (int32_t i = 0; i < b->count; ++i) {
        if (out_results) out_results[i] = b->faults[i].result;
        failed += b->faults[i].result != FE_OK;
    }
    if (failed) tell_first(function, b);
    return failed;
}

// ---- arrays --------------------------------------------------------------------------------------------------------
static fe_result check_items(const char *function, const fe__batch_field *field, const fe_array *given)
{
    if (field->kind) FE_CHECK_ARRAY(given->items, given->item_count);
    if (!field->kind && (given->items || given->item_count != 1))
        return fe__fail(function, FE_ERROR_ARGUMENT, "the field is the world's: items must be NULL, item_count 1");
    return FE_OK;
}

static fe_result check_frame(const char *function, const fe_array *given, int32_t is_written)
{
    FE_CHECK_DVEC3(&given->origin, FE_MAX_POSITION);
    int32_t has_origin = given->origin.x != 0.0 || given->origin.y != 0.0 || given->origin.z != 0.0;
    if (is_written && (given->relative_to || has_origin))
        return fe__fail(function, FE_ERROR_ARGUMENT, "what is written has no frame but the world's");
    return FE_OK;
}

// An item may be gone in some worlds, which is a fault of theirs; one that none of them has is a mistake of the call's.
// The worlds of the mask are entered
static fe_result find_item(const char *function, const char *name, const fe_batch *b, const uint8_t *mask,
                           fe_handle item, int32_t kind)
{
    int32_t index, first = -1;
    for (int32_t i = 0; i < b->count; ++i) {
        if (mask && !mask[i]) continue;
        if (fe__id_pool_find(fe__field_ids(b->worlds[i], kind), item, &index) == FE_OK) return FE_OK;
        if (first < 0) first = i;
    }
    if (first < 0) return FE_OK; // no world is asked
    if (kind == FE_KIND_SHAPE) return fe__find_shape(function, name, b->worlds[first], item, &index);
    return kind == FE_KIND_BODY ? fe__find_body(function, name, b->worlds[first], item, &index)
                                : fe__find_joint(function, name, b->worlds[first], item, &index);
}

static fe_result find_items(const char *function, const fe_batch *b, const uint8_t *mask, const fe__batch_array *array)
{
    for (int32_t i = 0; array->field->kind && i < array->item_count; ++i)
        FE_TRY(find_item(function, "items", b, mask, array->items[i], array->field->kind));
    if (!array->relative_to) return FE_OK;
    return find_item(function, "relative_to", b, mask, array->relative_to, FE_KIND_BODY);
}

static fe_result read_array(const char *function, const fe_batch *b, const fe_array *array, int32_t is_written,
                            fe__batch_array *out)
{
    fe_array full = {.struct_size = sizeof full};
    FE_READ_STRUCT(array, &full);
    FE_CHECK_INT(full.item_count, 1, MOST_ITEMS);
    FE_CHECK_BOOL(full.is_double);
    const fe__batch_field *field = fe__field_of(full.field);
    if (!field) return fe__fail(function, FE_ERROR_ARGUMENT, "field is %d, of which there is none", (int)full.field);
    if (is_written ? !field->write : !field->read)
        return fe__fail(function, FE_ERROR_ARGUMENT, "field %d is not %s", (int)full.field,
                        is_written ? "written" : "read");
    FE_TRY(check_items(function, field, &full));
    FE_TRY(check_frame(function, &full, is_written));
    FE_CHECK_POINTER(full.data);
    int64_t number = full.is_double ? (int64_t)sizeof(double) : (int64_t)sizeof(float);
    int64_t bytes = number * field->components * full.item_count * b->count;
    if (full.bytes != bytes)
        return fe__fail(function, FE_ERROR_ARGUMENT,
                        "bytes is %lld, of %d worlds, %d items and %d numbers a row it is %lld", (long long)full.bytes,
                        (int)b->count, (int)full.item_count, (int)field->components, (long long)bytes);
    *out =
        (fe__batch_array){field, full.items, full.item_count, full.is_double, full.relative_to, full.origin, full.data};
    return FE_OK;
}

static fe_result read_arrays(const char *function, const fe_batch *b, const fe_array *given, int32_t count,
                             int32_t is_written, fe__batch_array *out)
{
    // an older caller's records are as long as its struct_size says
    const unsigned char *at = (const unsigned char *)given;
    for (int32_t i = 0; i < count; ++i) {
        uint32_t size;
        memcpy(&size, at, sizeof size);
        FE_TRY(read_array(function, b, (const fe_array *)(const void *)at, is_written, out + i));
        at += size;
    }
    return FE_OK;
}

static fe_result find_items_of_all(const char *function, fe_batch *b, const fe__batch_array *arrays, int32_t count)
{
    fe_result result = FE_OK;
    if (!fe__batch_enter(b, NULL, FE__WRITER)) return refuse_worlds(function);
    for (int32_t i = 0; i < count && result == FE_OK; ++i) result = find_items(function, b, NULL, arrays + i);
    fe__batch_leave(b, NULL);
    return result;
}

fe_result fe_batch_bind(fe_batch *batch, const fe_array *inputs, int32_t input_count, const fe_array *outputs,
                        int32_t output_count)
{
    FE_ENTER_BATCH(batch);
    FE_CHECK_INT(input_count, 0, MOST_ARRAYS);
    FE_CHECK_INT(output_count, 0, MOST_ARRAYS);
    FE_CHECK_ARRAY(inputs, input_count);
    FE_CHECK_ARRAY(outputs, output_count);
    int32_t count = input_count + output_count;
    size_t size = (size_t)count * sizeof(fe__batch_array);
    fe__batch_array *arrays = size ? fe__allocate_scratch(&batch->memory, size) : NULL;
    if (size && !arrays) return fe__report(function, FE_ERROR_MEMORY);
    fe_result result = read_arrays(function, batch, inputs, input_count, 1, arrays);
    if (result == FE_OK) result = read_arrays(function, batch, outputs, output_count, 0, arrays + input_count);
    if (result == FE_OK) result = find_items_of_all(function, batch, arrays, count);
    if (result == FE_OK) result = fe__report(function, fe__batch_bind(batch, arrays, input_count, output_count));
    fe__release(&batch->memory, arrays, size);
    return result;
}

// ---- calls of all worlds -------------------------------------------------------------------------------------------
int32_t fe_batch_step(fe_batch *batch, float dt, int32_t steps, const uint8_t *mask, int32_t *out_results)
{
    FE_ENTER_BATCH(batch);
    FE_CHECK_FLOAT(dt, 0.0f, FE_MAX_DT);
    FE_CHECK_INT(steps, 1, MOST_STEPS);
    if (!fe__owner_be_alone(inside, FE__STEP)) return refuse(function, batch);
    if (!fe__batch_enter(batch, mask, FE__STEP)) return refuse_worlds(function);
    fe__batch_step(batch, fe__counted_dt(dt), steps, mask);
    fe__batch_leave(batch, mask);
    return tell_faults(function, batch, out_results);
}

static fe_result check_states(const char *function, const fe_batch *b, const uint8_t *mask,
                              const fe_state *const *states)
{
    for (int32_t i = 0; states && i < b->count; ++i) {
        if ((mask && !mask[i]) || !states[i]) continue;
        if (!fe__state_lives(states[i])) return fe__fail(function, FE_ERROR_STALE, "states[%d] is gone", (int)i);
        if (states[i]->store != b->start->store)
            return fe__fail(function, FE_ERROR_STATE, "states[%d] is of a world that uses another store", (int)i);
    }
    return FE_OK;
}

int32_t fe_batch_reset(fe_batch *batch, const uint8_t *mask, const fe_state *const *states, int32_t *out_results)
{
    FE_ENTER_BATCH(batch);
    FE_TRY(check_states(function, batch, mask, states));
    if (!fe__batch_enter(batch, mask, FE__WRITER)) return refuse_worlds(function);
    fe__batch_reset(batch, mask, states);
    fe__batch_leave(batch, mask);
    return tell_faults(function, batch, out_results);
}

int32_t fe_batch_read(fe_batch *batch, const fe_array *array, int32_t *out_results)
{
    FE_ENTER_BATCH(batch);
    fe__batch_array read;
    FE_TRY(read_array(function, batch, array, 0, &read));
    if (!fe__batch_enter(batch, NULL, FE__WRITER)) return refuse_worlds(function);
    fe_result result = find_items(function, batch, NULL, &read);
    if (result == FE_OK) fe__batch_read(batch, &read);
    fe__batch_leave(batch, NULL);
    return result == FE_OK ? tell_faults(function, batch, out_results) : (int32_t)result;
}

int32_t fe_batch_write(fe_batch *batch, const fe_array *array, const uint8_t *mask, int32_t *out_results)
{
    FE_ENTER_BATCH(batch);
    fe__batch_array written;
    FE_TRY(read_array(function, batch, array, 1, &written));
    if (!fe__batch_enter(batch, mask, FE__WRITER)) return refuse_worlds(function);
    fe_result result = find_items(function, batch, mask, &written);
    if (result == FE_OK) fe__batch_write(batch, &written, mask);
    fe__batch_leave(batch, mask);
    return result == FE_OK ? tell_faults(function, batch, out_results) : (int32_t)result;
}

fe_result fe_batch_hash(fe_batch *batch, uint32_t *out_words)
{
    FE_ENTER_BATCH(batch);
    FE_CHECK_POINTER(out_words);
    if (!fe__batch_enter(batch, NULL, FE__WRITER)) return refuse_worlds(function);
    fe__batch_hash(batch, out_words);
    fe__batch_leave(batch, NULL);
    return FE_OK;
}
