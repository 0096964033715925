// surface.c - the triangles and the edges of each kind of form; see surface.h.
#include "collision/surface/surface.h"

#include "collision/form/form_kinds.h"
#include "collision/form/hull.h"
#include "core/math.h"

// ---- circles, frames, boxes -----------------------------------------------------------------------------------------
void fe__circle_make(fe__circle *c, int32_t segments)
{
    const double whole = 6.283185307179586, quarter = 0.25 * whole;
    c->segments = segments, c->steps = fe__maxi(1, segments / 4);
    for (int32_t i = 0; i < segments; ++i) fe__sincos(whole * (double)i / (double)segments, c->sine + i, c->cosine + i);
    c->sine[segments] = c->sine[0], c->cosine[segments] = c->cosine[0];
    for (int32_t i = 0; i <= c->steps; ++i)
        fe__sincos(quarter * (double)i / (double)c->steps, c->arc_sine + i, c->arc_cosine + i);
    c->arc_cosine[c->steps] = 0.0; // Poles are points.
}

void fe__surface_place(fe__drawn *s)
{
    s->at = fe__dsub(s->pose.position, s->origin);
    s->x = fe__drotate(s->pose.rotation, (fe_dvec3){1.0, 0.0, 0.0});
    s->y = fe__drotate(s->pose.rotation, (fe_dvec3){0.0, 1.0, 0.0});
    s->z = fe__drotate(s->pose.rotation, (fe_dvec3){0.0, 0.0, 1.0});
}

void fe__pen_box(fe__pen *pen, fe_vec3 low, fe_vec3 high)
{
    enum { EDGES = 12 };
    if (fe__pen_skips(pen, 2 * EDGES)) return;
    const float x[2] = {low.x, high.x}, y[2] = {low.y, high.y}, z[2] = {low.z, high.z};
    for (int32_t i = 0; i < 4; ++i) {
        int32_t a = i & 1, b = i >> 1;
        fe__pen_line(pen, fe__vec3(x[0], y[a], z[b]), fe__vec3(x[1], y[a], z[b]));
        fe__pen_line(pen, fe__vec3(x[a], y[0], z[b]), fe__vec3(x[a], y[1], z[b]));
        fe__pen_line(pen, fe__vec3(x[a], y[b], z[0]), fe__vec3(x[a], y[b], z[1]));
    }
}

fe_vec3 fe__surface_half_extents(const fe__form *form)
{
    switch (form->type) {
    case FE__FORM_SPHERE:
        return fe__vec3(form->radius, form->radius, form->radius);
    case FE__FORM_CAPSULE:
        return fe__vec3(form->radius, form->half_height, form->radius);
    case FE__FORM_BOX:
    case FE__FORM_CYLINDER:
    case FE__FORM_CONE:
        return form->half;
    default:
        return fe__vec3(1.0f, 1.0f, 1.0f);
    }
}

// ---- boxes ---------------------------------------------------------------------------------------------------------
// Bit 0 of a corner's number is the side along x, bit 1 along y, bit 2 along z.
static void box_corners(const fe__drawn *s, fe_vec3 corner[8])
{
    fe_dvec3 half = fe__widen(s->form->half);
    for (int32_t i = 0; i < 8; ++i)
        corner[i] = fe__surface_point(s, (fe_dvec3){i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y,
                                                    i & 4 ? half.z : -half.z});
}

static void draw_box(const fe__drawn *s, fe__pen *pen)
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

static void draw_box_lines(const fe__drawn *s, fe__pen *pen)
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

// A face is a fan around its first corner. With V - E + F = 2, all fans together have 2 E - 2 F triangles.
static void draw_hull(const fe__drawn *s, fe__pen *pen)
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

static void draw_hull_lines(const fe__drawn *s, fe__pen *pen)
{
    const fe__hull *hull = s->form->hull;
    if (fe__pen_skips(pen, 2 * (int64_t)hull->edge_count)) return;
    for (int32_t i = 0; i < hull->edge_count; ++i)
        fe__pen_line(pen, vertex_of(s, hull->edges[2 * i].origin), vertex_of(s, hull->edges[2 * i + 1].origin));
}

// ---- surfaces of revolution ----------------------------------------------------------------------------------------
// Spheres, capsules, cylinders and cones are surfaces of revolution about the y axis. A profile of points (radius, y),
// from the bottom to the top, turns around the axis. Between two of its points lies a band; if one of them is on the
// axis, the band is a fan.

enum { PROFILE = 2 * FE__ARC_STEPS + 2 };

typedef struct profile {
    int32_t count;
    double radius[PROFILE], y[PROFILE];
    int32_t rings[2]; // The circles of these points are edges.
} profile;

static void add(profile *p, double radius, double y)
{
    p->radius[p->count] = radius, p->y[p->count] = y;
    ++p->count;
}

static profile profile_of(const fe__drawn *s)
{
    profile p = {.count = 0};
    const fe__circle *c = s->circle;
    double r = (double)s->form->half.x, h = (double)s->form->half.y;
    if (s->form->type == FE__FORM_CYLINDER) return (profile){4, {0.0, r, r, 0.0}, {-h, -h, h, h}, {1, 2}};
    if (s->form->type == FE__FORM_CONE) return (profile){3, {0.0, r, 0.0}, {-h, -h, h}, {1, 1}};
    // A capsule has two half circles around the ends of its axis; those of a sphere, and their edges, are one.
    r = (double)s->form->radius, h = (double)s->form->half_height;
    for (int32_t i = c->steps; i >= 0; --i) add(&p, r * c->arc_cosine[i], -r * c->arc_sine[i] - h);
    p.rings[0] = p.rings[1] = c->steps;
    if (h > 0.0) p.rings[1] = c->steps + 1;
    for (int32_t i = h > 0.0 ? 0 : 1; i <= c->steps; ++i) add(&p, r * c->arc_cosine[i], r * c->arc_sine[i] + h);
    return p;
}

static fe_vec3 point_of(const fe__drawn *s, const profile *p, int32_t i, double cosine, double sine)
{
    return fe__surface_point(s, (fe_dvec3){p->radius[i] * cosine, p->y[i], p->radius[i] * sine});
}

// A quarter turn from x leads to z, which is clockwise about y: seen from outside, a triangle that turns left goes up
// before it goes on.
static void draw_round(const fe__drawn *s, fe__pen *pen)
{
    const fe__circle *c = s->circle;
    const profile p = profile_of(s);
    // Both ends are on the axis: all bands but two have two triangles a segment.
    if (fe__pen_skips(pen, 3 * (int64_t)c->segments * (2 * (p.count - 1) - 2))) return;
    for (int32_t i = 0; i + 1 < p.count; ++i) {
        int32_t below = p.radius[i] > 0.0, above = p.radius[i + 1] > 0.0;
        fe_vec3 a = point_of(s, &p, i, 1.0, 0.0), b = point_of(s, &p, i + 1, 1.0, 0.0);
        for (int32_t k = 1; k <= c->segments; ++k) {
            fe_vec3 next_a = below ? point_of(s, &p, i, c->cosine[k], c->sine[k]) : a;
            fe_vec3 next_b = above ? point_of(s, &p, i + 1, c->cosine[k], c->sine[k]) : b;
            if (above) fe__pen_triangle(pen, a, b, next_b);
            if (below) fe__pen_triangle(pen, a, next_b, next_a);
            a = next_a, b = next_b;
        }
    }
}

// The lines are the circles, and the profile on four sides.
static void draw_round_lines(const fe__drawn *s, fe__pen *pen)
{
    static const double cosine[4] = {1.0, 0.0, -1.0, 0.0}, sine[4] = {0.0, 1.0, 0.0, -1.0};
    const fe__circle *c = s->circle;
    const profile p = profile_of(s);
    int32_t rings = p.rings[1] == p.rings[0] ? 1 : 2;
    if (fe__pen_skips(pen, 2 * ((int64_t)c->segments * rings + 4 * (p.count - 1)))) return;
    for (int32_t ring = 0; ring < rings; ++ring)
        for (int32_t k = 0; k < c->segments; ++k)
            fe__pen_line(pen, point_of(s, &p, p.rings[ring], c->cosine[k], c->sine[k]),
                         point_of(s, &p, p.rings[ring], c->cosine[k + 1], c->sine[k + 1]));
    for (int32_t side = 0; side < 4; ++side)
        for (int32_t i = 0; i + 1 < p.count; ++i)
            fe__pen_line(pen, point_of(s, &p, i, cosine[side], sine[side]),
                         point_of(s, &p, i + 1, cosine[side], sine[side]));
}

// ---- planes --------------------------------------------------------------------------------------------------------
// A plane has no end. A drawing shows a piece of it, as a polygon or a grid: the piece that lies in the drawing's box,
// and not farther than FE__PLANE_REACH from the plane's point nearest to the drawing's origin.

enum { CORNERS = 12 }; // A square that is cut by six planes has at most ten.

typedef struct polygon {
    int32_t count;
    fe_dvec3 corner[CORNERS];
} polygon;

typedef struct piece {
    fe_dvec3 normal, u, v; // unit, u x v is the normal
    fe_dvec3 nearest;      // the plane's point nearest to the drawing's origin, relative to the origin
    fe_dvec3 low, high;    // the box in which the plane is drawn, relative to the origin
    polygon edge;          // turns left about the normal; no corners: nothing is drawn
} piece;

static double part(fe_dvec3 a, int32_t axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

// The part of the polygon with  sign (p - limit) <= 0  along the axis (Sutherland and Hodgman, Reentrant polygon
// clipping, 1974).
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

static piece piece_of(const fe__drawn *s)
{
    fe_dvec3 n = fe__drotate(s->pose.rotation, fe__widen(s->form->normal)), axis = {0.0, 0.0, 1.0};
    const fe_dvec3 reach = {FE__PLANE_REACH, FE__PLANE_REACH, FE__PLANE_REACH};
    n = fe__dscale(1.0 / sqrt(fe__ddot(n, n)), n);
    piece p = {.normal = n, .nearest = fe__dscale(fe__ddot(n, s->at) + (double)s->form->distance, n)};
    // u is the part across the normal of the world's axis that is most across it.
    double x = fe__absd(n.x), y = fe__absd(n.y), z = fe__absd(n.z);
    if (x <= y && x <= z)
        axis = (fe_dvec3){1.0, 0.0, 0.0};
    else if (y <= z)
        axis = (fe_dvec3){0.0, 1.0, 0.0};
    p.u = fe__dsub(axis, fe__dscale(fe__ddot(axis, n), n));
    p.u = fe__dscale(1.0 / sqrt(fe__ddot(p.u, p.u)), p.u);
    p.v = fe__dcross(n, p.u);

    p.low = fe__dsub(s->box->low, s->origin), p.high = fe__dsub(s->box->high, s->origin);
    fe_dvec3 middle = clamped(p.nearest, p.low, p.high);
    p.low = clamped(fe__dsub(middle, reach), p.low, p.high);
    p.high = clamped(fe__dadd(middle, reach), p.low, p.high);
    // The box cuts a square that reaches beyond it on all sides.
    fe_dvec3 foot = fe__dsub(middle, fe__dscale(fe__ddot(p.normal, fe__dsub(middle, p.nearest)), p.normal));
    double width = 4.0 * FE__PLANE_REACH;
    fe_dvec3 u = fe__dscale(width, p.u), v = fe__dscale(width, p.v);
    p.edge = (polygon){4,
                       {fe__dsub(fe__dsub(foot, u), v), fe__dsub(fe__dadd(foot, u), v), fe__dadd(fe__dadd(foot, u), v),
                        fe__dadd(fe__dsub(foot, u), v)}};
    for (int32_t k = 0; k < 3; ++k) {
        p.edge = cut(&p.edge, k, 1.0, part(p.high, k));
        p.edge = cut(&p.edge, k, -1.0, part(p.low, k));
    }
    if (p.edge.count < 3) p.edge.count = 0;
    return p;
}

static void draw_plane(const fe__drawn *s, fe__pen *pen)
{
    piece p = piece_of(s);
    const fe_dvec3 *c = p.edge.corner;
    for (int32_t i = 2; i < p.edge.count; ++i)
        fe__pen_triangle(pen, fe__narrow(c[0]), fe__narrow(c[i - 1]), fe__narrow(c[i]));
}

// The least and the greatest coordinate along a unit vector.
static void span(const polygon *p, fe_dvec3 along, double *out_low, double *out_high)
{
    *out_low = *out_high = fe__ddot(along, p->corner[0]);
    for (int32_t i = 1; i < p->count; ++i) {
        double x = fe__ddot(along, p->corner[i]);
        *out_low = fe__mind(*out_low, x), *out_high = fe__maxd(*out_high, x);
    }
}

// Draws the chords of the polygon, which is convex, on which the world's coordinate along `across` is a multiple of the
// spacing.
static void draw_rulings(const polygon *p, fe_dvec3 across, fe_dvec3 origin, double spacing, fe__pen *pen)
{
    double low, high, zero = fe__ddot(across, origin);
    span(p, across, &low, &high);
    int64_t first = (int64_t)((low + zero) / spacing) - 1, last = (int64_t)((high + zero) / spacing) + 1;
    for (int64_t line = first; line <= last; ++line) {
        double x = (double)line * spacing - zero;
        fe_dvec3 end[2];
        int32_t count = 0;
        for (int32_t i = 0; i < p->count && count < 2; ++i) {
            fe_dvec3 a = p->corner[i], b = p->corner[i + 1 < p->count ? i + 1 : 0];
            double from = fe__ddot(across, a) - x, to = fe__ddot(across, b) - x;
            if ((from < 0.0) != (to < 0.0)) end[count++] = fe__dadd(a, fe__dscale(from / (from - to), fe__dsub(b, a)));
        }
        if (count == 2) fe__pen_line(pen, fe__narrow(end[0]), fe__narrow(end[1]));
    }
}

static void draw_plane_lines(const fe__drawn *s, fe__pen *pen)
{
    piece p = piece_of(s);
    if (!p.edge.count) return;
    for (int32_t i = 0; i < p.edge.count; ++i)
        fe__pen_line(pen, fe__narrow(p.edge.corner[i]), fe__narrow(p.edge.corner[i + 1 < p.edge.count ? i + 1 : 0]));
    double low[2], high[2];
    span(&p.edge, p.u, low, high), span(&p.edge, p.v, low + 1, high + 1);
    // The spacing is a power of ten, m, so that 6 to 60 lines are drawn.
    double width = fe__maxd(high[0] - low[0], high[1] - low[1]), spacing = 1.0;
    while (width > 60.0 * spacing) spacing *= 10.0;
    while (width < 6.0 * spacing && spacing > 1e-3) spacing *= 0.1;
    draw_rulings(&p.edge, p.u, s->origin, spacing, pen);
    draw_rulings(&p.edge, p.v, s->origin, spacing, pen);
}

// The instance is the rectangle around the polygon, with x along u, y along the normal, z = x cross y.
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

// ---- heightfields and meshes ---------------------------------------------------------------------------------------
// They are drawn triangle by triangle. If the form does not lie in the drawing's box, only the triangles near the box
// are drawn.

// The box in the form's frame, with the form's axes, around the drawing's box.
static fe__bounds box_of(const fe__drawn *s)
{
    const double far = 1e12; // m; every form ends before
    if (!s->is_cut) return (fe__bounds){{-far, -far, -far}, {far, far, far}};
    fe_dvec3 half = fe__dscale(0.5, fe__dsub(s->box->high, s->box->low)),
             middle = fe__dscale(0.5, fe__dadd(s->box->high, s->box->low));
    fe_quat back = fe__conjugate(s->pose.rotation);
    middle = fe__drotate(back, fe__dsub(middle, s->pose.position)), half = fe__rotated_widths(back, half);
    return (fe__bounds){fe__dsub(middle, half), fe__dadd(middle, half)};
}

static void draw_field(const fe__drawn *s, fe__pen *pen)
{
    const fe__heightfield *f = s->ground.field;
    if (!s->is_cut && !(f && f->cells)) { // No triangle is left out: their number is known.
        int64_t count = f ? 2 * (int64_t)(f->rows - 1) * (f->columns - 1) : s->ground.mesh->triangle_count;
        if (fe__pen_skips(pen, 3 * count)) return;
    }
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

// An edge between two triangles is drawn once. If the form is cut, each triangle draws all its edges: the other one may
// be left out.
static int32_t draws_edge(const fe__drawn *s, int32_t triangle, int32_t side, const fe_dvec3 *a, const fe_dvec3 *b)
{
    if (s->is_cut) return 1;
    if (s->ground.mesh) {
        // Two triangles have the edge in opposite directions: the one in which it goes up, by x, then y, then z, draws
        // it. Edges that are open, crowded or wound against each other are drawn by each triangle that has them.
        fe__mesh_edge edge = fe__mesh_edge_of(s->ground.mesh, triangle, side);
        if (edge == FE__MESH_EDGE_OPEN || edge == FE__MESH_EDGE_ODD) return 1;
        return a->x != b->x ? a->x < b->x : a->y != b->y ? a->y < b->y : a->z < b->z;
    }
    // A cell draws its diagonal and its sides towards row 0 and column 0, and the others if they are a rim.
    int32_t half = triangle & 1, is_first = half ? side == 2 : side != 1;
    return is_first || fe__ground_is_rim(&s->ground, triangle, side);
}

static void draw_field_lines(const fe__drawn *s, fe__pen *pen)
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

// ---- the table of kinds --------------------------------------------------------------------------------------------
typedef struct draw_traits {
    void (*triangles)(const fe__drawn *s, fe__pen *pen);
    void (*lines)(const fe__drawn *s, fe__pen *pen);
} draw_traits;

static const draw_traits traits[FE__FORM_TYPES] = {
    [FE__FORM_SPHERE] = {draw_round, draw_round_lines}, [FE__FORM_CAPSULE] = {draw_round, draw_round_lines},
    [FE__FORM_BOX] = {draw_box, draw_box_lines},        [FE__FORM_CYLINDER] = {draw_round, draw_round_lines},
    [FE__FORM_CONE] = {draw_round, draw_round_lines},   [FE__FORM_HULL] = {draw_hull, draw_hull_lines},
    [FE__FORM_PLANE] = {draw_plane, draw_plane_lines},  [FE__FORM_HEIGHTFIELD] = {draw_field, draw_field_lines},
    [FE__FORM_MESH] = {draw_field, draw_field_lines},
};

void fe__surface_triangles(const fe__drawn *s, fe__pen *pen) { traits[s->form->type].triangles(s, pen); }
void fe__surface_lines(const fe__drawn *s, fe__pen *pen) { traits[s->form->type].lines(s, pen); }
