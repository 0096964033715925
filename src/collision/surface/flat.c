// flat.c - boxes and convex hulls.
#include "collision/form/hull_form.h"
#include "collision/surface/kinds.h"

// ---- boxes ---------------------------------------------------------------------------------------------------------
// Corner i: bit 0 is the side along x, bit 1 along y, bit 2 along z
static void box_corners(const fe__drawn *s, fe_vec3 corner[8])
{
    fe_dvec3 half = fe__widen(s->form->half);
    for (int32_t i = 0; i < 8; ++i)
        corner[i] = fe__surface_point(s, (fe_dvec3){i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y,
                                                    i & 4 ? half.z : -half.z});
}

void fe__draw_box(const fe__drawn *s, fe__pen *pen)
{
    static const uint8_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    if (fe__pen_skips(pen, 36)) return;
    fe_vec3 c[8];
    box_corners(s, c);
    for (int32_t i = 0; i < 6; ++i) {
        const uint8_t *f = faces[i];
        fe__pen_triangle(pen, c[f[0]], c[f[1]], c[f[2]]);
        fe__pen_triangle(pen, c[f[0]], c[f[2]], c[f[3]]);
    }
}

void fe__draw_box_lines(const fe__drawn *s, fe__pen *pen)
{
    if (fe__pen_skips(pen, 24)) return;
    fe_vec3 c[8];
    box_corners(s, c);
    for (int32_t axis = 1; axis <= 4; axis <<= 1)
        for (int32_t i = 0; i < 8; ++i)
            if (!(i & axis)) fe__pen_line(pen, c[i], c[i | axis]);
}

// ---- hulls ---------------------------------------------------------------------------------------------------------
static fe_vec3 vertex_of(const fe__drawn *s, int32_t vertex)
{
    return fe__surface_point(s, fe__from_hull(s->form, fe__widen(fe__hull_vertex(s->form->hull, vertex))));
}

// A face is a fan around its first corner. V - E + F = 2: all fans together have 2 V - 4 triangles
void fe__draw_hull(const fe__drawn *s, fe__pen *pen)
{
    const fe__hull *hull = s->form->hull;
    if (fe__pen_skips(pen, 3 * (2 * (int64_t)hull->edge_count - 2 * hull->face_count))) return;
    for (int32_t i = 0; i < hull->face_count; ++i) {
        const uint8_t *corner = hull->corners + hull->faces[i].first;
        fe_vec3 first = vertex_of(s, corner[0]), last = vertex_of(s, corner[1]);
        for (int32_t k = 2; k < hull->faces[i].count; ++k) {
            fe_vec3 next = vertex_of(s, corner[k]);
            fe__pen_triangle(pen, first, last, next);
            last = next;
        }
    }
}

void fe__draw_hull_lines(const fe__drawn *s, fe__pen *pen)
{
    const fe__hull *hull = s->form->hull;
    if (fe__pen_skips(pen, 2 * (int64_t)hull->edge_count)) return;
    for (int32_t i = 0; i < hull->edge_count; ++i)
        fe__pen_line(pen, vertex_of(s, hull->edges[2 * i].origin), vertex_of(s, hull->edges[2 * i + 1].origin));
}
