// colour.h - the colours of contacts: those of one colour share no dynamic body, so that they are solved side by side.
#ifndef FE_SOLVER_GRAPH_COLOUR_H
#define FE_SOLVER_GRAPH_COLOUR_H
#include "solver/solver.h"

void fe__colour_contact(fe__body *bodies, fe__contact *contact);
int32_t fe__colours_of(const fe__body *body); // that its contacts have: how many
// Of a contact that has its colour already, from a snapshot: its bodies take it. 0: one of them has, or it is of the
// other kind; it is of no use then
int32_t fe__recolour_contact(fe__body *bodies, const fe__contact *contact);
void fe__uncolour_contact(fe__body *bodies, fe__contact *contact);

#endif
