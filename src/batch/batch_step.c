// batch_step.c - see batch.h: what is done to many worlds, by whichever worker is free.
//
// Called by the API layer, which has entered the worlds. A worker writes its own worlds' faults and rows alone.
#include "batch/batch.h"

#include "core/fp_state.h"
#include "step/stages.h"
#include "world/hash.h"

#include <stdatomic.h>
#include <string.h>

// ---- rows ----------------------------------------------------------------------------------------------------------
static int64_t row_at(const fe__batch_array *a, int32_t world, int32_t item)
{
    return ((int64_t)world * a->item_count + item) * a->field->components;
}

static void get_row(const fe__batch_array *a, int32_t world, int32_t item, double *row)
{
    int64_t at = row_at(a, world, item);
    if (a->is_double) {
        memcpy(row, a->data + at * (int64_t)sizeof *row, (size_t)a->field->components * sizeof *row);
        return;
    }
    float floats[FE__MOST_COMPONENTS];
    memcpy(floats, a->data + at * (int64_t)sizeof *floats, (size_t)a->field->components * sizeof *floats);
    for (int32_t k = 0; k < a->field->components; ++k) row[k] = (double)floats[k];
}

static void put_row(const fe__batch_array *a, int32_t world, int32_t item, const double *row)
{
    int64_t at = row_at(a, world, item);
    if (a->is_double) {
        memcpy(a->data + at * (int64_t)sizeof *row, row, (size_t)a->field->components * sizeof *row);
        return;
    }
    float floats[FE__MOST_COMPONENTS];
    for (int32_t k = 0; k < a->field->components; ++k) floats[k] = (float)row[k];
    memcpy(a->data + at * (int64_t)sizeof *floats, floats, (size_t)a->field->components * sizeof *floats);
}

static fe_handle item_of(const fe__batch_array *a, int32_t i) { return a->items ? a->items[i] : 0; }

// 0: the body that it is relative to is gone
static int32_t frame_of(const fe_world *w, const fe__batch_array *a, fe__field_frame *frame)
{
    int32_t body;
    *frame = (fe__field_frame){a->origin, {0.0f, 0.0f, 0.0f, 1.0f}};
    if (!a->relative_to) return 1;
    if (fe__id_pool_find(&w->body_ids, a->relative_to, &body) != FE_OK) return 0;
    const double *origin = w->bodies[body].origin;
    frame->origin = (fe_dvec3){origin[0], origin[1], origin[2]};
    const float *q = w->bodies[body].rotation;
    frame->rotation = (fe_quat){q[0], q[1], q[2], q[3]};
    return 1;
}

static int32_t fail(fe__fault *fault, fe_result result, int32_t array, int32_t item)
{
    *fault = (fe__fault){result, array, item};
    return 0;
}

// Nothing is written unless all rows may be
static int32_t check_rows(fe_batch *b, int32_t world, const fe__batch_array *a, int32_t array)
{
    const fe_world *w = b->worlds[world];
    for (int32_t i = 0; i < a->item_count; ++i) {
        double row[FE__MOST_COMPONENTS];
        int32_t index;
        fe_result result = fe__field_find(w, a->field, item_of(a, i), &index);
        get_row(a, world, i, row);
        if (result == FE_OK) result = a->field->takes(w, index, row);
        if (result != FE_OK) return fail(b->faults + world, result, array, i);
    }
    return 1;
}

// What was on bodies before they were pushed, in this order
typedef struct kept_forces {
    fe__kept_force *first;
    int64_t count;
} kept_forces;

static void put_back(fe_world *w, const kept_forces *kept)
{
    for (int64_t i = kept->count - 1; i >= 0; --i) fe__field_put_back(w, kept->first + i);
}

// Rows that may be written. kept: NULL: a force stays
static int32_t write_rows(fe_batch *b, int32_t world, const fe__batch_array *a, int32_t array, kept_forces *kept)
{
    fe_world *w = b->worlds[world];
    for (int32_t i = 0; i < a->item_count; ++i) {
        double row[FE__MOST_COMPONENTS];
        int32_t index;
        (void)fe__field_find(w, a->field, item_of(a, i), &index);
        get_row(a, world, i, row);
        if (kept && a->field->is_of_a_step)
            kept->count += fe__field_keep_forces(w, a->field, index, kept->first + kept->count);
        fe_result result = a->field->write(w, index, row);
        if (result != FE_OK) return fail(b->faults + world, result, array, i);
    }
    return 1;
}

// Rows of what is gone are zeros, and that is a fault, unless there is another
static void read_rows(fe_batch *b, int32_t world, const fe__batch_array *a, int32_t array)
{
    const fe_world *w = b->worlds[world];
    fe__field_frame frame;
    int32_t has_frame = frame_of(w, a, &frame);
    for (int32_t i = 0; i < a->item_count; ++i) {
        double row[FE__MOST_COMPONENTS] = {0.0};
        int32_t index, is_there = has_frame && fe__field_find(w, a->field, item_of(a, i), &index) == FE_OK;
        if (is_there)
            a->field->read(w, index, &frame, row);
        else if (b->faults[world].result == FE_OK)
            fail(b->faults + world, FE_ERROR_STALE, array, i);
        put_row(a, world, i, row);
    }
}

// ---- all worlds ----------------------------------------------------------------------------------------------------
typedef struct job {
    fe_batch *batch;
    const uint8_t *mask;
    void (*act)(const struct job *job, int32_t world, int32_t worker);
    float dt;
    int32_t steps;
    int32_t filtered;               // of a step: 1: only worlds with a pair filter; 0: only the others
    _Atomic int32_t *some_filtered; // 1 when a world was left for the caller's thread
    const fe_state *const *states;
    const fe__batch_array *array;
    uint32_t *words;
} job;

static void act_on_range(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const job *j = argument;
    for (int32_t i = first; i < end; ++i)
        if (!j->mask || j->mask[i]) j->act(j, i, worker);
}

static void run_on_all(job *j, void (*range)(void *argument, int32_t first, int32_t end, int32_t worker))
{
    fe_batch *b = j->batch;
    for (int32_t i = 0; i < b->count; ++i) b->faults[i] = (fe__fault){.result = FE_OK};
    fe__fp_state fp = fe__fp_enter();
    fe__parallel_for(&b->workers, b->count, b->block, range, j);
    fe__fp_leave(fp);
}

static void act_on_all(job *j) { run_on_all(j, act_on_range); }

// Inputs hold in all steps. In each but the first: what acts for one step alone. 0: the world cannot take them, or no
// longer, as a joint may break in a step
static int32_t write_inputs(fe_batch *b, int32_t world, int32_t is_first, kept_forces *kept)
{
    const fe__bound *bound = &b->bound;
    int32_t takes = 1;
    kept->count = 0;
    for (int32_t i = 0; i < bound->input_count && takes; ++i)
        if (is_first || bound->arrays[i].field->is_of_a_step) takes = check_rows(b, world, bound->arrays + i, i);
    for (int32_t i = 0; i < bound->input_count && takes; ++i)
        if (is_first || bound->arrays[i].field->is_of_a_step) takes = write_rows(b, world, bound->arrays + i, i, kept);
    return takes;
}

// Worlds that a worker steps side by side
typedef struct crew {
    const job *job;
    fe__lockstep *lockstep;
    int32_t world[FE__MERGE_MOST];
    kept_forces kept[FE__MERGE_MOST];
    int32_t goes_on[FE__MERGE_MOST]; // 1: it has not failed
    int32_t count;
} crew;

// Of a step that fails none of the forces stay: the next call would add them again
static void begin_step(crew *c, int32_t i, int32_t is_first)
{
    fe_batch *b = c->job->batch;
    int32_t world = c->world[i];
    c->goes_on[i] = write_inputs(b, world, is_first, c->kept + i);
    fe_result result = c->goes_on[i] ? fe__lockstep_begin(c->lockstep, i, c->job->dt) : FE_OK;
    if (result != FE_OK) c->goes_on[i] = fail(b->faults + world, result, FE__IN_A_STEP, 0);
    if (!c->goes_on[i]) put_back(b->worlds[world], c->kept + i);
}

static void make_step(crew *c, int32_t is_first)
{
    for (int32_t i = 0; i < c->count; ++i)
        if (c->goes_on[i]) begin_step(c, i, is_first);
    fe__lockstep_finish(c->lockstep);
}

static void read_outputs(fe_batch *b, int32_t world)
{
    const fe__bound *bound = &b->bound;
    for (int32_t i = bound->input_count; i < bound->input_count + bound->output_count; ++i)
        read_rows(b, world, bound->arrays + i, i);
}

// Each to its first step that fails
static void step_crew(crew *c)
{
    fe_batch *b = c->job->batch;
    for (int32_t i = 0; i < c->count; ++i) {
        fe__lockstep_enter(c->lockstep, i, b->worlds[c->world[i]]);
        c->goes_on[i] = 1;
    }
    for (int32_t step = 0; step < c->job->steps; ++step) make_step(c, step == 0);
    for (int32_t i = 0; i < c->count; ++i) {
        fe__lockstep_leave(c->lockstep, i);
        read_outputs(b, c->world[i]);
    }
    c->count = 0;
}

static crew crew_of(const job *j, int32_t worker)
{
    const fe__bound *bound = &j->batch->bound;
    crew c = {.job = j, .lockstep = j->batch->locksteps + worker, .count = 0};
    for (int32_t i = 0; i < FE__MERGE_MOST && bound->kept; ++i)
        c.kept[i].first = bound->kept + (worker * FE__MERGE_MOST + i) * bound->kept_of_world;
    return c;
}

// A pair filter is the host's code. It is called on the host's thread, in the order of the worlds, one world after
// another: what it remembers does not depend on workers, and a managed runtime meets no thread that it does not know.
static void step_range(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const job *j = argument;
    crew c = crew_of(j, worker);
    const int32_t most = j->filtered ? 1 : FE__MERGE_MOST;
    for (int32_t i = first; i < end; ++i) {
        if (j->mask && !j->mask[i]) continue;
        int32_t filtered = j->batch->worlds[i]->pair_filter != NULL;
        if (filtered && !j->filtered) atomic_store_explicit(j->some_filtered, 1, memory_order_relaxed);
        if (filtered != j->filtered) continue;
        c.world[c.count++] = i;
        if (c.count == most) step_crew(&c);
    }
    if (c.count) step_crew(&c);
}

void fe__batch_step(fe_batch *b, float dt, int32_t steps, const uint8_t *mask)
{
    _Atomic int32_t some_filtered = 0;
    job j = {.batch = b, .mask = mask, .dt = dt, .steps = steps, .some_filtered = &some_filtered};
    run_on_all(&j, step_range);
    if (!atomic_load_explicit(&some_filtered, memory_order_relaxed)) return;
    fe__fp_state fp = fe__fp_enter();
    j.filtered = 1;
    step_range(&j, 0, b->count, 0);
    fe__fp_leave(fp);
}

static void reset_world(const job *j, int32_t world, int32_t worker)
{
    (void)worker;
    const fe_state *state = j->states && j->states[world] ? j->states[world] : j->batch->start;
    fe_result result = fe__held_return(state->held, j->batch->worlds[world]);
    if (result != FE_OK) fail(j->batch->faults + world, result, FE__IN_A_RESET, 0);
}

void fe__batch_reset(fe_batch *b, const uint8_t *mask, const fe_state *const *states)
{
    act_on_all(&(job){.batch = b, .mask = mask, .act = reset_world, .states = states});
}

static void write_world(const job *j, int32_t world, int32_t worker)
{
    (void)worker;
    if (check_rows(j->batch, world, j->array, 0)) (void)write_rows(j->batch, world, j->array, 0, NULL);
}

void fe__batch_write(fe_batch *b, const fe__batch_array *array, const uint8_t *mask)
{
    act_on_all(&(job){.batch = b, .mask = mask, .act = write_world, .array = array});
}

static void read_world(const job *j, int32_t world, int32_t worker)
{
    (void)worker;
    read_rows(j->batch, world, j->array, 0);
}

void fe__batch_read(fe_batch *b, const fe__batch_array *array)
{
    act_on_all(&(job){.batch = b, .act = read_world, .array = array});
}

static void hash_world(const job *j, int32_t world, int32_t worker)
{
    (void)worker;
    uint64_t hash = fe__world_hash(j->batch->worlds[world]);
    j->words[2 * world] = (uint32_t)hash, j->words[2 * world + 1] = (uint32_t)(hash >> 32);
}

void fe__batch_hash(fe_batch *b, uint32_t *out_words)
{
    act_on_all(&(job){.batch = b, .act = hash_world, .words = out_words});
}
