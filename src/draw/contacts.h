// contacts.h - where bodies touch, and what passes there.
#ifndef FE_DRAW_CONTACTS_H
#define FE_DRAW_CONTACTS_H
#include "draw/drawing.h"

// m/s2: what weights are told in; standard gravity where there is none
double fe__drawn_gravity(const fe_world *world);
// N: of the lighter dynamic one of two bodies
double fe__lighter_weight(const fe_world *world, int32_t body_a, int32_t body_b);

void fe__draw_contact_lines(const fe__drawing *drawing, fe__pen *pen); // normals, forces
void fe__draw_contact_points(const fe__drawing *drawing, fe__pen *pen);

#endif
