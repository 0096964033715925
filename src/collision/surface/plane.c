// plane.c - the piece of a plane that a drawing shows: a grid, or a polygon.
//
// A plane has no end. What is drawn of it lies in the drawing's box, and not farther than FE__PLANE_REACH from the
// point of it that is nearest to the drawing's origin.
#include "collision/surface/kinds.h"
#include "core/tensor.h"

enum { CORNERS = 12 }; // a square, cut by six planes, has at most ten

typedef struct polygon {
    int32_t count;
    fe_dvec3 corner[CORNERS];
} polygon;

typedef struct piece {
    fe_dvec3 normal, u, v; // unit, u x v is the normal
    fe_dvec3 nearest;      // point of the plane to the drawing's origin, relative to it
    fe_dvec3 low, high;    // of the box in which it is drawn, relative to the origin
    polygon edge;          // turns left about the normal; no corner: nothing of it is drawn
} piece;

// ---- the polygon ---------------------------------------------------------------------------------------------------
static double part(fe_dvec3 a, int32_t axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

// What of it lies where sign (p - limit) <= 0 along the axis (Sutherland and Hodgman, Reentrant polygon clipping, 1974)
static polygon cut(const polygon *p, int32_t axis, double sign, double limit)
{
    polygon out = {.count = 0};
    for (int32_t i = 0; i < p->count; ++i) {
        fe_dvec3 a = p->corner[i], b = p->corner[i + 1 < p->count ? i + 1 : 0];
        double over_a = sign * (part(a, axis) - limit), over_b = sign * (part(b, axis) - limit);
        if (over_a <= 0.0) out.corner[out.count++] = a;
        if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0))
            out.corner[out.count++] = fe__dadd(a, fe__dscale(over_a / (over_a - over_b), fe__dsub(b, a)));
    }
    return out;
}

static fe_dvec3 clamped(fe_dvec3 p, fe_dvec3 low, fe_dvec3 high)
{
    return (fe_dvec3){fe__clampd(p.x, low.x, high.x), fe__clampd(p.y, low.y, high.y), fe__clampd(p.z, low.z, high.z)};
}

// Along the world's axes where the plane is: u is the axis that is most across the normal, as far as it is
static void choose_axes(piece *p)
{
    fe_dvec3 n = p->normal, axis = {0.0, 0.0, 1.0};
    double x = fe__absd(n.x), y = fe__absd(n.y), z = fe__absd(n.z);
    if (x <= y && x <= z)
        axis = (fe_dvec3){1.0, 0.0, 0.0};
    else if (y <= z)
        axis = (fe_dvec3){0.0, 1.0, 0.0};
    fe_dvec3 u = fe__dsub(axis, fe__dscale(fe__ddot(axis, n), n));
    p->u = fe__dscale(1.0 / sqrt(fe__ddot(u, u)), u);
    p->v = fe__dcross(n, p->u);
}

static piece piece_of(const fe__drawn *s)
{
    piece p = {.normal = fe__drotate(s->pose.rotation, fe__widen(s->form->normal))};
    const fe_dvec3 reach = {FE__PLANE_REACH, FE__PLANE_REACH, FE__PLANE_REACH};
    p.normal = fe__dscale(1.0 / sqrt(fe__ddot(p.normal, p.normal)), p.normal);
    p.nearest = fe__dscale(fe__ddot(p.normal, s->at) + (double)s->form->distance, p.normal);
    choose_axes(&p);
    p.low = fe__dsub(s->box->low, s->origin), p.high = fe__dsub(s->box->high, s->origin);
    fe_dvec3 middle = clamped(p.nearest, p.low, p.high);
    p.low = clamped(fe__dsub(middle, reach), p.low, p.high);
    p.high = clamped(fe__dadd(middle, reach), p.low, p.high);
    // a square that reaches beyond the box on all sides
    fe_dvec3 foot = fe__dsub(middle, fe__dscale(fe__ddot(p.normal, fe__dsub(middle, p.nearest)), p.normal));
    double width = 4.0 * FE__PLANE_REACH;
    fe_dvec3 u = fe__dscale(width, p.u), v = fe__dscale(width, p.v);
    p.edge = (polygon){4,
                       {fe__dsub(fe__dsub(foot, u), v), fe__dsub(fe__dadd(foot, u), v), fe__dadd(fe__dadd(foot, u), v),
                        fe__dadd(fe__dsub(foot, u), v)}};
    for (int32_t axis = 0; axis < 3; ++axis) {
        p.edge = cut(&p.edge, axis, 1.0, part(p.high, axis));
        p.edge = cut(&p.edge, axis, -1.0, part(p.low, axis));
    }
    if (p.edge.count < 3) p.edge.count = 0;
    return p;
}

void fe__draw_plane(const fe__drawn *s, fe__pen *pen)
{
    piece p = piece_of(s);
    const fe_dvec3 *c = p.edge.corner;
    for (int32_t i = 2; i < p.edge.count; ++i)
        fe__pen_triangle(pen, fe__narrow(c[0]), fe__narrow(c[i - 1]), fe__narrow(c[i]));
}

// ---- the grid ------------------------------------------------------------------------------------------------------
// Least and greatest coordinate along a unit vector
static void span(const polygon *p, fe_dvec3 along, double *out_low, double *out_high)
{
    *out_low = *out_high = fe__ddot(along, p->corner[0]);
    for (int32_t i = 1; i < p->count; ++i) {
        double x = fe__ddot(along, p->corner[i]);
        *out_low = fe__mind(*out_low, x), *out_high = fe__maxd(*out_high, x);
    }
}

// A power of ten, m: 6 to 60 lines
static double spacing_of(double width)
{
    double s = 1.0;
    while (width > 60.0 * s) s *= 10.0;
    while (width < 6.0 * s && s > 1e-3) s *= 0.1;
    return s;
}

// The chord of the polygon, which is convex, where the coordinate along `across` is x
static void draw_chord(const polygon *p, fe_dvec3 across, double x, fe__pen *pen)
{
    fe_dvec3 end[2];
    int32_t count = 0;
    for (int32_t i = 0; i < p->count && count < 2; ++i) {
        fe_dvec3 a = p->corner[i], b = p->corner[i + 1 < p->count ? i + 1 : 0];
        double from = fe__ddot(across, a) - x, to = fe__ddot(across, b) - x;
        if ((from < 0.0) != (to < 0.0)) end[count++] = fe__dadd(a, fe__dscale(from / (from - to), fe__dsub(b, a)));
    }
    if (count == 2) fe__pen_line(pen, fe__narrow(end[0]), fe__narrow(end[1]));
}

// Where the world's coordinate along `across` is a multiple of the spacing
static void draw_rulings(const piece *p, fe_dvec3 across, fe_dvec3 origin, double spacing, fe__pen *pen)
{
    double low, high, zero = fe__ddot(across, origin);
    span(&p->edge, across, &low, &high);
    int64_t first = (int64_t)((low + zero) / spacing) - 1, last = (int64_t)((high + zero) / spacing) + 1;
    for (int64_t i = first; i <= last; ++i) draw_chord(&p->edge, across, (double)i * spacing - zero, pen);
}

void fe__draw_plane_lines(const fe__drawn *s, fe__pen *pen)
{
    piece p = piece_of(s);
    if (!p.edge.count) return;
    for (int32_t i = 0; i < p.edge.count; ++i)
        fe__pen_line(pen, fe__narrow(p.edge.corner[i]), fe__narrow(p.edge.corner[i + 1 < p.edge.count ? i + 1 : 0]));
    double low[2], high[2];
    span(&p.edge, p.u, low, high), span(&p.edge, p.v, low + 1, high + 1);
    double spacing = spacing_of(fe__maxd(high[0] - low[0], high[1] - low[1]));
    draw_rulings(&p, p.u, s->origin, spacing, pen);
    draw_rulings(&p, p.v, s->origin, spacing, pen);
}

// ---- as an instance ------------------------------------------------------------------------------------------------
// The rectangle around the polygon, with x along u, y along the normal, z = x cross y
int32_t fe__plane_stance(const fe__drawn *s, fe__stance *out)
{
    piece p = piece_of(s);
    if (!p.edge.count) return 0;
    fe_dvec3 z = fe__dcross(p.u, p.normal);
    double low[2], high[2];
    span(&p.edge, p.u, low, high), span(&p.edge, z, low + 1, high + 1);
    fe_dvec3 middle = fe__dadd(p.nearest, fe__dadd(fe__dscale(0.5 * (low[0] + high[0]), p.u),
                                                   fe__dscale(0.5 * (low[1] + high[1]), z)));
    fe__tensor axes = {{{p.u.x, p.normal.x, z.x}, {p.u.y, p.normal.y, z.y}, {p.u.z, p.normal.z, z.z}}};
    out->position = fe__narrow(middle);
    out->rotation = fe__tensor_rotation(&axes);
    out->half_extents = fe__vec3((float)(0.5 * (high[0] - low[0])), 0.0f, (float)(0.5 * (high[1] - low[1])));
    return 1;
}
