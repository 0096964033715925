// colour.h - the colours of contacts: those of one colour share no dynamic body, so that they are solved side by side.
#ifndef FE_SOLVER_GRAPH_COLOUR_H
#define FE_SOLVER_GRAPH_COLOUR_H
#include "solver/solver.h"

void fe__colour_contact(fe__body *bodies, fe__contact *contact);
int32_t fe__colours_of(const fe__body *body); // that its contacts have: how many
void fe__uncolour_contact(fe__body *bodies, fe__contact *contact);

#endif
