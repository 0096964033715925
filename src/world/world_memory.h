// world_memory.h - creation and destruction of a world, its arrays, and the scratch that the stages of a step share.
#ifndef FE_WORLD_WORLD_MEMORY_H
#define FE_WORLD_WORLD_MEMORY_H
#include "core/sort.h"
#include "world/world.h"

// ---- lifetime -------------------------------------------------------------------------------------------------------

// An empty world, all its memory from the definition's allocator. FE_ERROR_MEMORY; FE_ERROR_UNSUPPORTED: no such SIMD
// set here; FE_ERROR_STALE: the pool or the store is gone; FE_ERROR_ARGUMENT: the store is another world's own.
// source: NULL, or a world whose store the new one shares; the caller is inside it.
// The caller is inside the new world as its writer, and leaves it (fe__owner_leave) when it is whole: its store knows
// it already, and another thread may edit what it begins to use.
fe_result fe__world_create(const fe_world_def *def, const fe_world *source, fe_world **out_world);
void fe__world_destroy(fe_world *world);
void fe__world_free_state(fe_world *world); // all arrays but the solver's and the scratch
fe_world_tuning fe__default_tuning(void);

// ---- arrays ---------------------------------------------------------------------------------------------------------
// The state of a world as two tables: its arrays, and the members beside them. Calls that free, exchange or keep worlds
// walk over these.
//
// They leave out what follows from the state (clusters, forest, graph) and what is no state: memory, workers, owner,
// the host's filter, kernels, the store, scratch, measures.

// An array of fe_world, by offsets of its members
typedef struct fe__array {
    size_t pointer, capacity; // the capacity counts elements
    size_t size;              // bytes of an element
    size_t used;              // an int32_t: so many elements may hold something
    size_t each;              // the int32_t that it is multiplied by, 0: by nothing
    int32_t more;             // elements beside
} fe__array;
typedef struct fe__members {
    size_t first, end; // offsets
} fe__members;

enum { FE__ARRAYS = 45, FE__MEMBERS = 9 };
extern const fe__array fe__arrays[FE__ARRAYS];
// The arrays' addresses and capacities are in these members. Each step changes the last one.
extern const fe__members fe__state_members[FE__MEMBERS];

static inline int32_t fe__int_at(const fe_world *world, size_t offset)
{
    return *(const int32_t *)(const void *)((const unsigned char *)world + offset);
}
void *fe__array_get(const fe_world *world, const fe__array *array);
void fe__array_set(fe_world *world, const fe__array *array, void *elements);
int64_t fe__array_capacity(const fe_world *world, const fe__array *array); // bytes
int64_t fe__array_used(const fe_world *world, const fe__array *array);     // bytes; all behind them are as new
void fe__arrays_free(fe_world *world);

// ---- step scratch ---------------------------------------------------------------------------------------------------
// What the stages of a step share. It lives from step to step, so that a settled scene's step allocates nothing.
// Everything is reserved before the world changes (step/reserve.c); from there on nothing allocates.

// Two shapes whose boxes meet and that have no record yet. Once sorted, A was created first.
typedef struct fe__candidate {
    int32_t shape_a, shape_b;
} fe__candidate;

// A worker's chunk of fe__step_scratch.candidates. A chunk may lie beyond their capacity: then it is only counted.
typedef struct fe__candidate_chunk {
    _Alignas(FE_CACHE_LINE) int32_t at;
    int32_t end;
} fe__candidate_chunk;

// A crowded body's heap of the pairs that it keeps (step/find_pairs.c)
typedef struct fe__pair_heap {
    int32_t shape; // the shape of the body whose box was computed last, -1: none
    int32_t capacity, count;
} fe__pair_heap;

typedef struct fe__ranked_pair {
    uint64_t rank; // the largest are kept
    int32_t candidate;
} fe__ranked_pair;

// The end of a sweep: what a body that met an obstacle does instead of what the solver said (continuous/continuous.c)
typedef struct fe__sweep_end {
    fe__motion_line motion;
    fe__velocity_line velocity;
    int32_t stopped; // 0: it met nothing
} fe__sweep_end;

typedef struct fe__step_scratch {
    // find_pairs.c
    fe__candidate *candidates;
    int32_t candidate_capacity, candidate_count;
    int32_t dropped_count; // candidates that were left out: they stand behind the others
    uint32_t *moved_bits;  // by shape: 1 while it is in fe_world.moved and the search for candidates runs, else 0
    int32_t moved_words;
    fe__candidate_chunk chunks[FE_MAX_WORKERS];
    _Atomic int32_t chunks_end;    // end of the last chunk that a worker took
    fe__pair_heap *heaps;          // by crowded body
    fe__ranked_pair *ranked_pairs; // by heap, one after the other
    fe__bounds *boxes;             // by shape, those of crowded bodies
    int32_t heap_capacity, ranked_capacity, box_capacity;

    // buried.h
    _Atomic int32_t is_crowd; // 1: the search met a shape with very many neighbours
    uint8_t *is_buried;       // by shape
    int32_t *buried;          // indices of the buried shapes
    int32_t is_buried_capacity, buried_capacity, buried_count;
    _Atomic int32_t buried_meetings; // new pairs of two buried shapes, at least so many, each counted twice

    // reserve.c
    int32_t candidate_patches; // further records that the candidates with heightfields need
    int32_t sensors;           // pairs with triggers that may meet in this step: they get no row
    int32_t points_to_come;    // records that pairs without points may take in this step
    // Awake pairs that are not deferred. While a step reserves: pairs whose deferral ends, and from active_end
    // downwards places in the list of awake pairs whose deferral is to be renewed.
    int32_t *active;
    int32_t active_capacity, active_end;
    _Atomic int32_t expired_count, noted_count; // how many of either
    _Atomic int32_t deferred_count;             // pairs that stay deferred
    _Atomic int32_t apart_count;                // how many of these the narrow phase found apart
    _Atomic int32_t some_deferred;              // 0: no awake pair is

    // update_contacts.c
    int32_t *results; // pairs that begin, end or part in this step
    int32_t result_capacity;
    _Atomic int32_t result_count;
    _Atomic int32_t recycled;

    // finalize.c
    int32_t *left; // shapes that left their box in this step
    int32_t left_capacity;
    _Atomic int32_t left_count;
    _Atomic int32_t lost_count; // bodies that overflowed in this step
    _Atomic int32_t some_leapt; // 1: a body went too far in this step for its odometer
    float *island_timers;
    int32_t island_capacity;

    // continuous.c
    int32_t *swept;            // bodies to sweep: dynamic ones, and kinematic ones from first_kinematic on
    fe__sweep_end *sweep_ends; // by place in that list, for bullets
    int32_t swept_capacity, sweep_end_capacity;
    int32_t first_kinematic;
    _Atomic int32_t swept_count, kinematic_count;
} fe__step_scratch;

typedef struct fe__step {
    fe_world *world;
    fe__step_scratch *scratch;
    float dt;                     // s
    float fall;                   // how far gravity may bring a body towards another one in the step, m
    fe__step_constants constants; // the constants of islands that are neither strained nor stretched
    int32_t failed;               // 1: no memory, and nothing was changed
} fe__step;

// Outside of the stages that build the graph and solve it the solver's rows are unused memory. It serves for sorting
// (twice as many items as are sorted), or for the new boxes of shapes that left theirs.
static inline fe__sort_item *fe__sort_scratch(const fe__step *step)
{
    return (fe__sort_item *)(void *)step->world->solver.rows;
}
static inline fe__bounds *fe__box_scratch(const fe__step *step)
{
    return (fe__bounds *)(void *)step->world->solver.rows;
}

int32_t fe__open_step_scratch(fe_world *world);                            // unless it is there; 0: no memory
void fe__step_scratch_free(fe__step_scratch *scratch, fe__memory *memory); // NULL is fine

// ---- shared scratch -------------------------------------------------------------------------------------------------
// Solver and scratch for worlds that step one after the other, so that a thousand worlds do not keep them a thousand
// times. A world borrows them for the time of its steps. The constraint graph goes with them: a world that comes back
// has it built anew, as after a snapshot.

typedef struct fe__workroom {
    fe__memory *memory;
    fe__solver solver;                // all but `burdened`, which is state of each world
    struct fe__step_scratch *scratch; // NULL: none yet, or a world has it
} fe__workroom;

void fe__workroom_lend(fe__workroom *room, fe_world *world);      // frees what the world has of its own
void fe__workroom_take_back(fe__workroom *room, fe_world *world); // the world's step may have failed
void fe__workroom_free(fe__workroom *room);

#endif
