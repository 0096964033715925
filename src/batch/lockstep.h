// lockstep.h - some worlds that step side by side, whose lanes share the solver's rows.
//
// Small worlds fill few lanes. So a worker takes several, brings each to where it would be solved, solves all of them
// as one, and ends the step of each. Every world does what it does alone, bit for bit.
//
// Between the halves of a step each world has a workroom. Lines and rows are needed within a half only, so one set of
// them goes round.
#ifndef FE_BATCH_LOCKSTEP_H
#define FE_BATCH_LOCKSTEP_H
#include "solver/graph/graph_merge.h"
#include "step/stages.h"
#include "world/world_memory.h"

enum { FE__ALONE = -1, FE__OVER = -2 };

// A world's place
typedef struct fe__lockstep_place {
    fe_world *world; // NULL: nobody is here
    fe__workroom room;
    fe__open_step open;
    int64_t trail;   // blocks of rows before its trails
    int32_t is_open; // 1: its step has begun, and fe__lockstep_finish is to come
    int32_t part;    // of the merged graph that solved it; FE__ALONE: it solves itself; FE__OVER: its step has ended
} fe__lockstep_place;

// Of one worker
typedef struct fe__lockstep {
    fe__memory memory;
    fe__lockstep_place places[FE__MERGE_MOST];
    int32_t open;                     // places between the halves
    double began;                     // when the first of them did, s
    const fe__lockstep_place *leader; // whose constants the merged graph is solved with
    fe__merge merge;
    fe__solver lines; // holds them and the rows while no world does
} fe__lockstep;

void fe__lockstep_init(fe__lockstep *l, const fe_allocator *allocator);
void fe__lockstep_free(fe__lockstep *l);

void fe__lockstep_enter(fe__lockstep *l, int32_t place, fe_world *world);
void fe__lockstep_leave(fe__lockstep *l, int32_t place); // whose step may have failed

fe_result fe__lockstep_begin(fe__lockstep *l, int32_t place, float dt); // of FE_ERROR_MEMORY nothing happened
void fe__lockstep_finish(fe__lockstep *l);                              // the steps of all that began

#endif
