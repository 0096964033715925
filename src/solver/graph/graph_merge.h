// graph_merge.h - one graph of several worlds' graphs, so that their lanes fill the rows together.
//
// A small world fills few lanes: a person on the ground one of four. Worlds share no body, so that lanes of one group
// of each, of one colour and kind, may lie in one row: every lane does what it would do alone. Each world keeps the
// graph that it built; lanes, lines and trees are copied from there for the time of one solve.
#ifndef FE_SOLVER_GRAPH_GRAPH_MERGE_H
#define FE_SOLVER_GRAPH_GRAPH_MERGE_H
#include "solver/graph/graph.h"

enum {
    FE__MERGE_MOST = 16, // worlds: as many lanes as the widest rows have
    FE__MERGE_KEYS = FE__JOINT_GROUP_KEYS + FE__GROUP_KEYS
};

typedef struct fe__merge {
    fe__solver *part[FE__MERGE_MOST]; // with their graphs
    fe__records of[FE__MERGE_MOST];   // by part: the home of its lanes
    int32_t count;
    fe__solver solver;                  // of all of them
    int32_t *line;                      // of the parts' lines, one part's after another's: the line there
    int32_t first_line[FE__MERGE_MOST]; // of a part, among those
    int32_t line_capacity;
    int32_t lane_of_key[FE__MERGE_KEYS]; // lanes of the batch at hand; then the next free one
    int32_t group_of_key[FE__MERGE_KEYS];
} fe__merge;

// 1: each of its batches is small, and each of its groups may lie beside another's
int32_t fe__graph_can_merge(const fe__solver *part);
// The graph of all parts. Their first places are written. 0: no memory; the parts are as they were
int32_t fe__graph_merge(fe__merge *merge, fe__memory *memory, const fe__kernels *kernels);
// What was solved, to the lines of a part: motion, marks, trails
void fe__graph_return(const fe__merge *merge, int32_t part);
void fe__graph_free_merge(fe__merge *merge, fe__memory *memory);

#endif
