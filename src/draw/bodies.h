// bodies.h - what is drawn of single bodies, and of the boxes around them.
#ifndef FE_DRAW_BODIES_H
#define FE_DRAW_BODIES_H
#include "draw/drawing.h"

void fe__draw_added_forces(const fe__drawing *drawing, fe__pen *pen); // for the next step, at the centres
void fe__draw_centre_lines(const fe__drawing *drawing, fe__pen *pen); // principal axes
void fe__draw_centre_points(const fe__drawing *drawing, fe__pen *pen);
void fe__draw_shape_boxes(fe__drawing *drawing, fe__pen *pen);
void fe__draw_trees(const fe__drawing *drawing, fe__pen *pen);

#endif
