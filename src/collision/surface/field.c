// field.c - heightfields and meshes, triangle by triangle: of those that are cut, what is near the drawing's box.
#include "collision/form/kinds.h"
#include "collision/surface/kinds.h"

// The drawing's box in the form's frame: the box around it, whose axes are the form's
static fe__bounds box_of(const fe__drawn *s)
{
    const double far = 1e12; // m, beyond every form
    if (!s->is_cut) return (fe__bounds){{-far, -far, -far}, {far, far, far}};
    fe_dvec3 half = fe__dscale(0.5, fe__dsub(s->box->high, s->box->low)),
             middle = fe__dscale(0.5, fe__dadd(s->box->high, s->box->low));
    fe_quat back = fe__conjugate(s->pose.rotation);
    middle = fe__drotate(back, fe__dsub(middle, s->pose.position)), half = fe__rotated_widths(back, half);
    return (fe__bounds){fe__dsub(middle, half), fe__dadd(middle, half)};
}

// How many there are, unless some are left out
static int64_t whole_count(const fe__drawn *s)
{
    const fe__heightfield *f = s->ground.field;
    if (s->is_cut) return -1;
    if (!f) return s->ground.mesh->triangle_count;
    return f->cells ? -1 : 2 * (int64_t)(f->rows - 1) * (f->columns - 1);
}

void fe__draw_field(const fe__drawn *s, fe__pen *pen)
{
    int64_t whole = whole_count(s);
    if (whole >= 0 && fe__pen_skips(pen, 3 * whole)) return;
    fe__bounds box = box_of(s);
    fe__ground_walk walk;
    fe__form triangle;
    fe__ground_begin(&walk, &s->ground, &box, (fe_dvec3){0.0, 0.0, 0.0});
    for (int32_t i; (i = fe__ground_next(&walk, &triangle)) >= 0;) {
        fe_dvec3 c[3];
        if (fe__pen_skips(pen, 3)) continue;
        fe__ground_corners(&s->ground, i, c);
        fe__pen_triangle(pen, fe__surface_point(s, c[0]), fe__surface_point(s, c[1]), fe__surface_point(s, c[2]));
    }
}

// ---- edges: of what is whole each between two triangles once --------------------------------------------------------
// Of a mesh the neighbour has it the other way round: one of the two goes up, by x, then y, then z. Edges that are
// open, crowded or wound against each other are drawn by each triangle that has them.
static int32_t draws_mesh_edge(const fe__mesh *mesh, int32_t slot, int32_t side, const fe_dvec3 *a, const fe_dvec3 *b)
{
    fe__mesh_edge edge = fe__mesh_edge_of(mesh, slot, side);
    if (edge == FE__MESH_EDGE_OPEN || edge == FE__MESH_EDGE_ODD) return 1;
    return a->x != b->x ? a->x < b->x : a->y != b->y ? a->y < b->y : a->z < b->z;
}

// Of a heightfield a cell has its diagonal and its sides towards row 0 and column 0, and at a rim the others too
static int32_t draws_cell_edge(const fe__ground *ground, int32_t triangle, int32_t side)
{
    int32_t half = triangle & 1, own = half ? side == 2 : side != 1;
    return own || fe__ground_is_rim(ground, triangle, side);
}

// Of what is cut all: the triangle whose edge it would be may be left out
static int32_t draws_edge(const fe__drawn *s, int32_t triangle, int32_t side, const fe_dvec3 *a, const fe_dvec3 *b)
{
    if (s->is_cut) return 1;
    if (s->ground.mesh) return draws_mesh_edge(s->ground.mesh, triangle, side, a, b);
    return draws_cell_edge(&s->ground, triangle, side);
}

void fe__draw_field_lines(const fe__drawn *s, fe__pen *pen)
{
    fe__bounds box = box_of(s);
    fe__ground_walk walk;
    fe__form triangle;
    fe__ground_begin(&walk, &s->ground, &box, (fe_dvec3){0.0, 0.0, 0.0});
    for (int32_t i; (i = fe__ground_next(&walk, &triangle)) >= 0;) {
        fe_dvec3 c[3];
        fe__ground_corners(&s->ground, i, c);
        for (int32_t side = 0; side < 3; ++side) {
            const fe_dvec3 *a = c + side, *b = c + (side + 1) % 3;
            if (draws_edge(s, i, side, a, b) && !fe__pen_skips(pen, 2))
                fe__pen_line(pen, fe__surface_point(s, *a), fe__surface_point(s, *b));
        }
    }
}
