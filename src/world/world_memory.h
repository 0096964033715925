// world_memory.h - birth and death of a world.
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
// What of a world is state, as two tables: its arrays, and the members beside them. Whoever frees a world,
// exchanges two or keeps one walks over these.
//
// Not in them is what follows from the state (clusters, forest, graph) and what is no state: memory, workers, who is
// inside, the host's filter, kernels, the store, scratch, measures.

// Where things are in fe_world
typedef struct fe__array {
    size_t pointer, capacity; // offsets; the capacity counts elements
    size_t size;              // of an element, bytes
    size_t used;              // offset of an int32_t: so many elements may hold something
    size_t each;              // offset of the int32_t that it is multiplied by, 0: by nothing
    int32_t more;             // elements beside
} fe__array;
typedef struct fe__members {
    size_t first, end; // offsets
} fe__members;

enum { FE__ARRAYS = 45, FE__MEMBERS = 9 };
extern const fe__array fe__arrays[FE__ARRAYS];
// The arrays' addresses and capacities are in these. The last one is what each step moves on
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
// What the stages of a step share.
//
// The scratch lives from step to step, so that a settled scene's step allocates nothing. Everything is reserved before
// the world changes (step/reserve.c); from there on nothing allocates.

// A pair of shapes that the trees found and that has no record yet; A was created first
typedef struct fe__candidate {
    int32_t shape_a, shape_b;
} fe__candidate;

// Where a worker writes: a chunk of fe__step_scratch.candidates. What lies beyond the capacity is not written
typedef struct fe__candidate_chunk {
    _Alignas(FE_CACHE_LINE) int32_t at;
    int32_t end;
} fe__candidate_chunk;

// Where a body ends that something stood in the way of
typedef struct fe__chase {
    fe__motion_line motion;
    fe__velocity_line velocity;
    int32_t stopped;
} fe__chase;

// A body in a crowd (step/find_pairs.c): a shape of it, how many pairs it may yet have with others of the crowd, and
// how many it chose
typedef struct fe__crowded {
    int32_t shape, room, count;
} fe__crowded;

typedef struct fe__favourite {
    uint64_t rank; // the larger, the dearer
    int32_t candidate;
} fe__favourite;

typedef struct fe__step_scratch {
    fe__candidate *candidates;
    int32_t candidate_capacity, candidate_count;
    int32_t candidate_patches; // further records that the candidates with heightfields need
    int32_t sensors;           // pairs with triggers among those that may meet in this step: they get no row
    int32_t points_to_come;    // records of points that pairs without may take in this step
    uint32_t *moved_bits;      // by shape: 1 while it is in fe_world.moved and the search for candidates runs, else 0
    int32_t moved_words;
    fe__candidate_chunk chunks[FE_MAX_WORKERS];
    _Atomic int32_t chunks_end; // of those that the workers took
    fe__crowded *crowd;
    fe__favourite *favourites; // of each body of the crowd
    fe__bounds *boxes;         // by shape
    int32_t crowd_capacity, favourite_capacity, box_capacity;
    int32_t left_out; // candidates behind those that count

    _Atomic int32_t is_crowd; // 1: the search met a shape with very many neighbours
    uint8_t *is_buried;       // by shape, see step/buried.h
    int32_t *buried;          // those shapes
    int32_t is_buried_capacity, buried_capacity, buried_count;
    _Atomic int32_t buried_meetings; // new pairs of two buried shapes, at least so many, each counted twice

    int32_t *busy; // awake pairs that do not wait; while a step reserves: those that just ceased to
    _Atomic int32_t due_count, waiting_count; // see step/reserve.c
    _Atomic int32_t apart_count;              // that the narrow phase found apart there
    _Atomic int32_t noted_count;              // of those that wait on, at the end of the list: downwards from busy_end
    _Atomic int32_t some_deferred;            // 0: no awake pair does
    int32_t busy_capacity, busy_end;
    int32_t *results; // pairs that begin, end or part in this step
    int32_t result_capacity;
    _Atomic int32_t result_count;
    _Atomic int32_t recycled;

    int32_t *left; // shapes that left their box in this step
    int32_t left_capacity;
    _Atomic int32_t left_count;
    _Atomic int32_t lost_count; // bodies that overflowed in this step
    _Atomic int32_t some_leapt; // 1: a body went too far in this step for its odometer

    int32_t
        *chased; // bodies that continuous collision looks at: dynamic ones, and kinematic ones from kinematic_room on
    fe__chase *chases; // what became of bullets, by place in that list
    int32_t chased_capacity, chase_capacity;
    int32_t kinematic_room;
    _Atomic int32_t chased_count, kinematic_count;

    float *island_timers;
    int32_t island_capacity;
} fe__step_scratch;

typedef struct fe__step {
    fe_world *world;
    fe__step_scratch *scratch;
    float dt;                     // s
    float fall;                   // m, how far gravity may bring a body towards another one in the step
    fe__step_constants constants; // of most islands
    int32_t failed;               // no memory; nothing was changed
} fe__step;

// Outside of the stages that build the graph and solve it the solver's rows are nobody's: what is sorted, two stretches
// of it, or the new boxes of the shapes that left theirs
static inline fe__sort_item *fe__sort_room(const fe__step *step)
{
    return (fe__sort_item *)(void *)step->world->solver.rows;
}
static inline fe__bounds *fe__box_room(const fe__step *step) { return (fe__bounds *)(void *)step->world->solver.rows; }

int32_t fe__open_step_scratch(fe_world *world);                            // unless it is there; 0: no memory
void fe__step_scratch_free(fe__step_scratch *scratch, fe__memory *memory); // NULL is fine

// ---- workroom -------------------------------------------------------------------------------------------------------
// What a step needs and no state is, for worlds that step one after the other: each has it for the time of
// its steps, so that a thousand worlds do not keep it a thousand times.
//
// The constraint graph goes with it: a world that comes back has it built anew, as after a snapshot.

typedef struct fe__workroom {
    fe__memory *memory;
    fe__solver solver;                // but for what of it is state: `burdened`
    struct fe__step_scratch *scratch; // NULL: none yet, or a world has it
} fe__workroom;

void fe__workroom_lend(fe__workroom *room, fe_world *world);      // which gives up what it has of its own
void fe__workroom_take_back(fe__workroom *room, fe_world *world); // whose step may have failed
void fe__workroom_free(fe__workroom *room);

#endif
