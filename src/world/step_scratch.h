// step_scratch.h - what the stages of a step share.
//
// The scratch lives from step to step, so that a settled scene's step allocates nothing. Everything is reserved before
// the world changes (step/reserve.c); from there on nothing allocates.
#ifndef FE_WORLD_STEP_SCRATCH_H
#define FE_WORLD_STEP_SCRATCH_H
#include "core/array_sort.h"
#include "world/world.h"

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

// A body in a crowd (step/crowd.c): a shape of it, how many pairs it may yet have with others of the crowd, and how
// many it chose
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
    _Atomic int32_t due_count, waiting_count; // see step/due.c
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

#endif
