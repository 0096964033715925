// group.h - a group of a batch.
#ifndef FE_SOLVER_GRAPH_GROUP_H
#define FE_SOLVER_GRAPH_GROUP_H
#include "solver/graph/builder.h"

// With a dummy in each lane. `like` says all but the place
fe__group *fe__open_group(fe__builder *b, fe__batch *batch, fe__group like, int32_t lanes, int32_t row_size);
// Of a body in the batch at hand
int32_t fe__line_of(const fe__builder *b, int32_t body);

#endif
