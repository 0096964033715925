// graph.h - which contacts are solved together: islands, batches, colours, rows.
//
// Input: the awake bodies and the linked contacts. Output: batches of lines, groups of lanes in fe__solver. The graph
// lives on while nothing links, unlinks, wakes or sleeps.
#ifndef FE_SOLVER_GRAPH_GRAPH_H
#define FE_SOLVER_GRAPH_GRAPH_H
#include "solver/graph/graph_input.h"

// 1: there are rows already for any such graph, whatever its islands
int32_t fe__graph_has_rows(const fe__solver *s, const fe__kernels *kernels, const fe__graph_bound *bound,
                           int32_t workers);
// Room for every graph within the bound. 0: no memory, nothing changed but capacities.
int32_t fe__graph_reserve(fe__solver *s, fe__memory *memory, const fe__kernels *kernels, const fe__graph_bound *bound,
                          int32_t workers);
// Lines and rows change hands, the graph stays: a solver needs them from `fe__solve` on, to the end of the step
void fe__solver_trade_lines(fe__solver *one, fe__solver *other);
void fe__graph_build(fe__solver *s, const fe__kernels *kernels, const fe__graph_input *input);
void fe__graph_forget(fe__solver *s); // the next step builds it from nothing
void fe__solver_destroy(fe__solver *s, fe__memory *memory);

#endif
