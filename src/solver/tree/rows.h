// rows.h - rows and masses of a tree, where its bodies are now.
#ifndef FE_SOLVER_TREE_ROWS_H
#define FE_SOLVER_TREE_ROWS_H
#include "solver/tree/node.h"

// B's velocity along u and its spin along mb, less A's along u and ma
void fe__tree_add_row(fe__tree_rows *rows, int32_t holds_b, fe_dvec3 u, fe_dvec3 ma, fe_dvec3 mb, double error);
// Rows from `from` on say nothing of what is locked: bits of the bodies below and above, linear | angular << 3
void fe__tree_hide_locked(fe__tree_rows *rows, int32_t from, int32_t below, int32_t above);
// Of all links, from the locks that the sweep holds
void fe__tree_read(const fe__tree_job *t);

#endif
