// batch.h - many worlds, made from one, that step together: a few by one worker at a time, from their inputs to their
// outputs, while they lie in that worker's cache.
//
// Each is a whole world, and steps as it would alone: which worker takes it, and when, shows nowhere.
#ifndef FE_BATCH_BATCH_H
#define FE_BATCH_BATCH_H
#include "batch/field.h"
#include "batch/lockstep.h"
#include "core/registry.h"
#include "snapshot/state.h"

// A caller's array: (world, item, component), packed
typedef struct fe__batch_array {
    const fe__batch_field *field;
    const fe_handle *items; // of the field's kind; NULL: the world itself, which is one
    int32_t item_count;
    int32_t is_double; // else floats
    fe_body relative_to;
    fe_dvec3 origin;
    unsigned char *data;
} fe__batch_array;

// What each step reads, then what it fills
typedef struct fe__bound {
    fe__batch_array *arrays; // with a copy of their items behind them
    int32_t input_count, output_count;
    int64_t bytes;
    fe__kept_force *kept; // of each worker's worlds: what was on the bodies that the inputs of a step push
    int64_t kept_of_world;
} fe__bound;

enum { FE__IN_A_STEP = -1, FE__IN_A_RESET = -2 }; // where a world failed, when not in an array

// What became of a world
typedef struct fe__fault {
    int32_t result; // FE_OK: nothing
    int32_t array;  // among the inputs, then the outputs; or FE__IN_A_STEP, FE__IN_A_RESET
    int32_t item;
} fe__fault;

struct fe_batch {
    fe__entry entry; // in the registry
    fe__owner owner;
    fe__memory memory;
    fe__workers workers;
    fe_state *start; // what the template was
    fe_world **worlds;
    fe__fault *faults; // of the last call, by world
    int32_t count;
    int32_t block;           // worlds that a worker takes at once
    fe__lockstep *locksteps; // of each worker
    fe__bound bound;
};

typedef struct fe__batch_plan {
    int32_t count, block;    // block 0: chosen
    const fe_world_def *def; // of each world: allocator and SIMD set; one worker
    const fe_task_system *tasks;
    fe_pool *pool;
    int32_t worker_count;
} fe__batch_plan;

// The caller is inside the template. Results: those of fe__world_create
fe_result fe__batch_create(const fe_world *source, const fe__batch_plan *plan, fe_batch **out_batch);
// The caller is alone in all of its worlds.
void fe__batch_destroy(fe_batch *batch);
int32_t fe__batch_lives(const fe_batch *batch); // from any thread

// Those with a byte in the mask, or all. 0: one has somebody inside, and nothing is entered
int32_t fe__batch_enter(fe_batch *batch, const uint8_t *mask, fe__occupation as);
void fe__batch_leave(fe_batch *batch, const uint8_t *mask);

// The worlds are entered. Each leaves a fault
void fe__batch_step(fe_batch *batch, float dt, int32_t steps, const uint8_t *mask);
// states: one a world, NULL: the start
void fe__batch_reset(fe_batch *batch, const uint8_t *mask, const fe_state *const *states);
void fe__batch_write(fe_batch *batch, const fe__batch_array *array, const uint8_t *mask);
void fe__batch_read(fe_batch *batch, const fe__batch_array *array);
void fe__batch_hash(fe_batch *batch, uint32_t *out_words); // two a world

// Copies of the arrays replace those that were bound. FE_ERROR_MEMORY: they stay
fe_result fe__batch_bind(fe_batch *batch, const fe__batch_array *arrays, int32_t input_count, int32_t output_count);

#endif
