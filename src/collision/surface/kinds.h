// kinds.h - what draws each kind of form (table.c).
#ifndef FE_COLLISION_SURFACE_KINDS_H
#define FE_COLLISION_SURFACE_KINDS_H
#include "collision/surface/surface.h"

// round.c: surfaces of revolution, that is spheres, capsules, cylinders and cones
void fe__draw_round(const fe__drawn *s, fe__pen *pen);
void fe__draw_round_lines(const fe__drawn *s, fe__pen *pen);

// flat.c
void fe__draw_box(const fe__drawn *s, fe__pen *pen);
void fe__draw_box_lines(const fe__drawn *s, fe__pen *pen);
void fe__draw_hull(const fe__drawn *s, fe__pen *pen);
void fe__draw_hull_lines(const fe__drawn *s, fe__pen *pen);

// plane.c
void fe__draw_plane(const fe__drawn *s, fe__pen *pen);
void fe__draw_plane_lines(const fe__drawn *s, fe__pen *pen);

// field.c: heightfields and meshes
void fe__draw_field(const fe__drawn *s, fe__pen *pen);
void fe__draw_field_lines(const fe__drawn *s, fe__pen *pen);

#endif
