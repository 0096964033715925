// draw.c - which parts of a drawing are lines, triangles, points; see drawing.h.
#include "draw/drawing.h"


void fe__draw_lines(fe__drawing *d, fe__pen *pen)
{
    if (d->parts & FE_DRAW_SHAPES) fe__draw_shapes(d, pen, fe__surface_lines);
    fe__draw_contact_lines(d, pen);
    if (d->parts & FE_DRAW_FORCES) {
        fe__draw_joint_forces(d, pen);
        fe__draw_added_forces(d, pen);
    }
    if (d->parts & FE_DRAW_JOINTS) fe__draw_joint_lines(d, pen);
    if (d->parts & FE_DRAW_LIMITS) fe__draw_joint_limits(d, pen);
    if (d->parts & FE_DRAW_BOUNDS) fe__draw_shape_boxes(d, pen);
    if (d->parts & FE_DRAW_CENTRES) fe__draw_centre_lines(d, pen);
    if (d->parts & FE_DRAW_TREES) fe__draw_trees(d, pen);
}

void fe__draw_triangles(fe__drawing *d, fe__pen *pen)
{
    if (d->parts & FE_DRAW_SHAPES) fe__draw_shapes(d, pen, fe__surface_triangles);
}

void fe__draw_points(fe__drawing *d, fe__pen *pen)
{
    fe__draw_contact_points(d, pen);
    if (d->parts & FE_DRAW_JOINTS) fe__draw_joint_points(d, pen);
    if (d->parts & FE_DRAW_CENTRES) fe__draw_centre_points(d, pen);
}
