// draw.h - the world as vertices and instances, for whoever draws.
//
// Reads only, allocates nothing. api/draw.c fills a fe__drawing with checked options and hands it a pen. What comes
// first: shapes in the order of their bodies' creation (shapes.c), then contacts (contacts.c), joints (joints.c), and
// what is of single bodies and of the trees (bodies.c).
#ifndef FE_DRAW_DRAW_H
#define FE_DRAW_DRAW_H
#include "draw/drawing.h"

void fe__draw_lines(fe__drawing *drawing, fe__pen *pen);
void fe__draw_triangles(fe__drawing *drawing, fe__pen *pen);
void fe__draw_points(fe__drawing *drawing, fe__pen *pen);

#endif
