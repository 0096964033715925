// eliminate.h - the elimination of a tree, see node.h.
#ifndef FE_SOLVER_TREE_ELIMINATE_H
#define FE_SOLVER_TREE_ELIMINATE_H
#include "solver/tree/node.h"

void fe__tree_eliminate(const fe__tree_job *t);  // from rows and masses to Y, C, H
void fe__tree_substitute(const fe__tree_job *t); // from requests to impulses and changes

#endif
