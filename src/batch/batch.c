// batch.c - see batch.h: birth, death, who is inside, what is bound. What happens in a step is in batch_step.c.
#include "batch/batch.h"

#include "snapshot/history.h"
#include "world/world_memory.h"

#include <string.h>

static fe__registry batches = {.lock = FE_MUTEX_INITIAL};

int32_t fe__batch_lives(const fe_batch *batch) { return fe__registry_has(&batches, &batch->entry); }

// ---- birth and death -----------------------------------------------------------------------------------------------
// A few blocks for each worker, so that one that falls behind is helped; no more than that, as each is claimed. Worlds
// of a block share rows: fewer than fill one would be too few, unless a worker had none
static int32_t choose_block(int32_t worlds, int32_t workers)
{
    enum { BLOCKS = 16, MOST = 64 };
    int32_t block = fe__mini(worlds / (workers * BLOCKS), MOST), each = worlds / workers;
    return fe__maxi(1, fe__maxi(block / FE__MERGE_MOST * FE__MERGE_MOST, fe__mini(each, FE__MERGE_MOST)));
}

static fe_result make_locksteps(fe_batch *b)
{
    b->locksteps = fe__allocate(&b->memory, (size_t)b->workers.count * sizeof *b->locksteps);
    for (int32_t i = 0; b->locksteps && i < b->workers.count; ++i)
        fe__lockstep_init(b->locksteps + i, &b->memory.allocator);
    return b->locksteps ? FE_OK : FE_ERROR_MEMORY;
}

static fe_result make_worlds(fe_batch *b, const fe_world *source, const fe__batch_plan *plan)
{
    fe__memory *m = &b->memory;
    b->worlds = fe__allocate(m, (size_t)plan->count * sizeof *b->worlds);
    b->faults = fe__allocate(m, (size_t)plan->count * sizeof *b->faults);
    if (!b->worlds || !b->faults) return FE_ERROR_MEMORY;
    for (; b->count < plan->count; ++b->count) {
        fe_result result = fe__world_create_as(b->start->held, source, plan->def, b->worlds + b->count);
        if (result != FE_OK) return result;
        b->worlds[b->count]->batch = b;
    }
    return FE_OK;
}

static size_t bytes_kept(const fe_batch *b, const fe__bound *bound)
{
    return (size_t)b->workers.count * FE__MERGE_MOST * (size_t)bound->kept_of_world * sizeof *bound->kept;
}

static void free_bound(fe_batch *b, fe__bound *bound)
{
    fe__release(&b->memory, bound->kept, bytes_kept(b, bound));
    fe__release(&b->memory, bound->arrays, (size_t)bound->bytes);
}

static void free_batch(fe_batch *b, int32_t limit)
{
    for (int32_t i = 0; i < b->count; ++i) {
        fe__histories_end(b->worlds[i]);
        fe__world_destroy(b->worlds[i]);
    }
    for (int32_t i = 0; b->locksteps && i < b->workers.count; ++i) fe__lockstep_free(b->locksteps + i);
    fe__release(&b->memory, b->locksteps, (size_t)b->workers.count * sizeof *b->locksteps);
    free_bound(b, &b->bound);
    fe__release(&b->memory, b->worlds, (size_t)limit * sizeof *b->worlds);
    fe__release(&b->memory, b->faults, (size_t)limit * sizeof *b->faults);
    if (b->start) fe__state_destroy(b->start);
    fe__workers_dismiss(&b->workers);
    fe__memory memory = b->memory;
    fe__release(&memory, b, sizeof *b);
}

fe_result fe__batch_create(const fe_world *source, const fe__batch_plan *plan, fe_batch **out_batch)
{
    fe__memory memory;
    fe__memory_init(&memory, plan->def->allocator);
    fe_batch *b = fe__allocate(&memory, sizeof *b);
    if (!b) return FE_ERROR_MEMORY;
    b->memory = memory;
    fe_result result = fe__workers_hire(&b->workers, plan->tasks, plan->pool, plan->worker_count);
    if (result == FE_OK) result = make_locksteps(b);
    if (result == FE_OK) result = fe__state_create(source, plan->def->allocator, &b->start);
    if (result == FE_OK) result = make_worlds(b, source, plan);
    if (result != FE_OK) {
        free_batch(b, plan->count);
        return result;
    }
    b->block = plan->block ? plan->block : choose_block(plan->count, b->workers.count);
    fe__registry_add(&batches, &b->entry);
    fe__batch_leave(b, NULL);
    *out_batch = b;
    return FE_OK;
}

void fe__batch_destroy(fe_batch *b)
{
    fe__registry_remove(&batches, &b->entry);
    free_batch(b, b->count);
}

// ---- who is inside -------------------------------------------------------------------------------------------------
static void leave_first(fe_batch *b, const uint8_t *mask, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
        if (!mask || mask[i]) fe__owner_leave(&b->worlds[i]->owner);
}

int32_t fe__batch_enter(fe_batch *b, const uint8_t *mask, fe__occupation as)
{
    for (int32_t i = 0; i < b->count; ++i) {
        if (mask && !mask[i]) continue;
        fe__owner *owner = &b->worlds[i]->owner;
        int32_t is_inside = fe__owner_enter(owner);
        if (is_inside && fe__owner_be_alone(owner, as)) continue;
        if (is_inside) fe__owner_leave(owner);
        leave_first(b, mask, i);
        return 0;
    }
    return 1;
}

void fe__batch_leave(fe_batch *b, const uint8_t *mask) { leave_first(b, mask, b->count); }

// ---- what is bound -------------------------------------------------------------------------------------------------
// One block: the arrays, then the items of each
static void copy_arrays(fe__bound *bound, const fe__batch_array *arrays, int32_t count)
{
    fe_handle *items = (fe_handle *)(void *)(bound->arrays + count);
    for (int32_t i = 0; i < count; items += arrays[i].item_count, ++i) {
        bound->arrays[i] = arrays[i];
        if (arrays[i].items) memcpy(items, arrays[i].items, (size_t)arrays[i].item_count * sizeof *items);
        bound->arrays[i].items = items; // zeros: of the world itself
    }
}

fe_result fe__batch_bind(fe_batch *b, const fe__batch_array *arrays, int32_t input_count, int32_t output_count)
{
    fe__bound made = {.input_count = input_count, .output_count = output_count};
    int32_t count = input_count + output_count;
    made.bytes = count * (int64_t)sizeof *arrays;
    for (int32_t i = 0; i < count; ++i) made.bytes += arrays[i].item_count * (int64_t)sizeof *arrays->items;
    for (int32_t i = 0; i < input_count; ++i)
        if (arrays[i].field->is_of_a_step)
            made.kept_of_world += arrays[i].item_count * fe__field_pushed(arrays[i].field);
    if (made.bytes) made.arrays = fe__allocate(&b->memory, (size_t)made.bytes);
    if (made.kept_of_world) made.kept = fe__allocate(&b->memory, bytes_kept(b, &made));
    if ((made.bytes && !made.arrays) || (made.kept_of_world && !made.kept)) {
        free_bound(b, &made);
        return FE_ERROR_MEMORY;
    }
    if (made.bytes) copy_arrays(&made, arrays, count);
    free_bound(b, &b->bound);
    b->bound = made;
    return FE_OK;
}
