// sweep_field.c - a moving form against a heightfield: its triangles, piece by piece along the way.
//
// Input: queries, with the mover in the field's frame. The way is cut where the form has moved by about its own size or
// a cell, so that few triangles lie under each piece; what is met within a piece is met first of all. Vertices are
// doubles: a stop is as exact as before a box.
#include "collision/cast/approach.h"
#include "collision/cast/sweep.h"
#include "collision/form/support.h"

// A normal that leans below a triangle by more than a rounding comes from under it.
#define FROM_BELOW (-1e-9)
#define ON_SIDE 1e-6 // m, a point that near to a side of a triangle is on it

typedef struct search {
    const fe__heightfield *field;
    const fe__mover *mover;
    fe_dvec3 half;     // of the mover's bounds, m
    fe__approach pair; // with each triangle in turn
} search;

static fe_dvec3 bounds_of(const fe__mover *mover)
{
    double half[3], r = (double)mover->form->radius;
    fe__core_half(mover->form, half);
    const fe__axes *m = &mover->axes;
    return (fe_dvec3){half[0] * fe__absd(m->x.x) + half[1] * fe__absd(m->y.x) + half[2] * fe__absd(m->z.x) + r,
                      half[0] * fe__absd(m->x.y) + half[1] * fe__absd(m->y.y) + half[2] * fe__absd(m->z.y) + r,
                      half[0] * fe__absd(m->x.z) + half[1] * fe__absd(m->y.z) + half[2] * fe__absd(m->z.z) + r};
}

static search search_of(const fe__heightfield *field, const fe__mover *mover)
{
    search s = {.field = field, .mover = mover, .half = bounds_of(mover)};
    fe__approach *p = &s.pair;
    p->frame_kind = FE_CORE_TRIANGLE, p->other_kind = fe__core_kind_of(mover->form), p->other_form = mover->form;
    fe__core_half(mover->form, p->other_half);
    p->axes = mover->axes, p->position = mover->position, p->translation = mover->translation;
    p->radius = (double)mover->form->radius;
    p->gap = fe__stop_gap(mover);
    return s;
}

static void take_triangle(search *s, int32_t triangle)
{
    fe__heightfield_corners(s->field, triangle, s->pair.vertex);
    s->pair.normal = fe__heightfield_normal(s->field, triangle);
}

// What the mover's bounds cover from t0 to t1.
static fe__bounds covered(const search *s, double t0, double t1)
{
    double spare = 2.0 * s->pair.gap;
    fe_dvec3 a = fe__dadd(s->mover->position, fe__dscale(t0, s->mover->translation));
    fe_dvec3 b = fe__dadd(s->mover->position, fe__dscale(t1, s->mover->translation));
    fe_dvec3 h = {s->half.x + spare, s->half.y + spare, s->half.z + spare};
    fe_dvec3 low = {fe__mind(a.x, b.x), fe__mind(a.y, b.y), fe__mind(a.z, b.z)};
    fe_dvec3 high = {fe__maxd(a.x, b.x), fe__maxd(a.y, b.y), fe__maxd(a.z, b.z)};
    return (fe__bounds){fe__dsub(low, h), fe__dadd(high, h)};
}

int32_t fe__heightfield_overlap(const fe__heightfield *field, const fe__mover *mover)
{
    search s = search_of(field, mover);
    fe__bounds box = covered(&s, 0.0, 0.0);
    fe__form unused;
    fe__triangle_walk walk = fe__heightfield_walk(field, &box, mover->position);
    for (int32_t i; (i = fe__next_triangle(&walk, &unused)) >= 0;) {
        take_triangle(&s, i);
        if (fe__approach_overlap(&s.pair).depth >= 0.0) return 1;
    }
    return 0;
}

// ---- one triangle --------------------------------------------------------------------------------------------------
// The mover's half width along the triangle's normal, m, and its height at t over the triangle's plane.
static double thickness_across(const fe__approach *p)
{
    fe_dvec3 m = fe__turn_back(&p->axes, p->normal), down = fe__dscale(-1.0, m);
    if (p->other_kind == FE_CORE_CURVED) return fe__ddot(down, fe__form_support(p->other_form, down)) + p->radius;
    return p->other_half[0] * fe__absd(m.x) + p->other_half[1] * fe__absd(m.y) + p->other_half[2] * fe__absd(m.z) +
           p->radius;
}

static double height_at(const fe__approach *p, double t)
{
    fe_dvec3 at = fe__dadd(p->position, fe__dscale(t, p->translation));
    return fe__ddot(p->normal, fe__dsub(at, p->vertex[0]));
}

static int32_t is_open(const fe__heightfield *f, int32_t row, int32_t column)
{
    if (row < 0 || row >= f->rows - 1 || column < 0 || column >= f->columns - 1) return 1;
    return fe__heightfield_is_hole(f, row * (f->columns - 1) + column);
}

// Is the point on a side behind which there is nothing, a hole or the field's end? Sides as fe__heightfield_corners
// gives them; the diagonal never is one.
static int32_t is_on_rim(const search *s, int32_t triangle, fe_dvec3 point)
{
    static const int32_t step_row[2][3] = {{0, 1, 0}, {0, 0, -1}}, step_column[2][3] = {{-1, 0, 0}, {0, 1, 0}};
    int32_t cell = triangle >> 1, half = triangle & 1, columns = s->field->columns - 1, diagonal = half ? 0 : 2;
    const fe_dvec3 *v = s->pair.vertex;
    for (int32_t i = 0; i < 3; ++i) {
        if (i == diagonal ||
            !is_open(s->field, cell / columns + step_row[half][i], cell % columns + step_column[half][i]))
            continue;
        fe_dvec3 side = fe__dsub(v[(i + 1) % 3], v[i]), across = fe__dcross(side, fe__dsub(point, v[i]));
        if (fe__ddot(across, across) <= ON_SIDE * ON_SIDE * fe__ddot(side, side)) return 1;
    }
    return 0;
}

// From below nothing is met, but for a rim, which stops from aside whatever has a part above the triangle's plane.
static int32_t is_met(const search *s, int32_t triangle, const fe__approach_hit *hit)
{
    if (fe__ddot(hit->normal, s->pair.normal) >= FROM_BELOW) return 1;
    return height_at(&s->pair, hit->t) + thickness_across(&s->pair) > 0.0 && is_on_rim(s, triangle, hit->point);
}

// Of a start inside the deepest triangle tells; of hits the first. Equal ones: the triangle with the lowest number,
// which comes first.
static void meet_triangle(search *s, int32_t triangle, fe__sweep_hit *best)
{
    take_triangle(s, triangle);
    if (fe__approach_overlap(&s->pair).depth >= 0.0) {
        double depth =
            fe__maxd(thickness_across(&s->pair) - height_at(&s->pair, 0.0), 0.0); // until it is over the plane
        if (best->inside && !(depth > best->depth)) return;
        *best = (fe__sweep_hit){
            .normal = s->pair.normal, .point = s->mover->position, .depth = depth, .inside = 1, .triangle = triangle};
        return;
    }
    fe__approach_hit hit;
    if (best->inside || !fe__approach_sweep(&s->pair, best->t, &hit)) return;
    if (best->triangle >= 0 && hit.t == best->t) return;
    if (!is_met(s, triangle, &hit)) return;
    *best = (fe__sweep_hit){.t = hit.t, .normal = hit.normal, .point = hit.point, .triangle = triangle};
}

// ---- the way -------------------------------------------------------------------------------------------------------
// The part of [0, limit] on which the mover's bounds meet those of the field.
static int32_t clip(const search *s, double limit, double *from, double *to)
{
    const fe__heightfield *f = s->field;
    double spare = 2.0 * s->pair.gap;
    fe_dvec3 o = s->mover->position, d = s->mover->translation;
    const double origin[3] = {o.x, o.y, o.z}, way[3] = {d.x, d.y, d.z}, half[3] = {s->half.x, s->half.y, s->half.z};
    const double low[3] = {0.0, (double)f->low, 0.0};
    const double high[3] = {(double)(f->columns - 1) * f->cell_x, (double)f->high, (double)(f->rows - 1) * f->cell_z};
    *from = 0.0, *to = limit;
    for (int32_t k = 0; k < 3; ++k) {
        double a = low[k] - half[k] - spare - origin[k], b = high[k] + half[k] + spare - origin[k];
        if (way[k] == 0.0) {
            if (a > 0.0 || b < 0.0) return 0;
            continue;
        }
        *from = fe__maxd(*from, fe__mind(a / way[k], b / way[k]));
        *to = fe__mind(*to, fe__maxd(a / way[k], b / way[k]));
    }
    return *from <= *to;
}

int32_t fe__heightfield_sweep(const fe__heightfield *field, const fe__mover *mover, double limit, fe__sweep_hit *hit)
{
    search s = search_of(field, mover);
    double t, end;
    if (!clip(&s, limit, &t, &end)) return 0;
    double cells_x = fe__absd(mover->translation.x) / (field->cell_x + s.half.x),
           cells_z = fe__absd(mover->translation.z) / (field->cell_z + s.half.z);
    double cells = fe__maxd(cells_x, cells_z), piece = cells > 0.0 ? 1.0 / cells : (double)INFINITY;
    *hit = (fe__sweep_hit){.t = limit, .triangle = -1};
    for (;;) {
        double to = fe__mind(t + piece, end);
        if (!(to > t)) to = end; // a piece below the rounding of t
        fe__bounds box = covered(&s, t, to);
        fe__form unused;
        fe__triangle_walk walk = fe__heightfield_walk(field, &box, mover->position);
        for (int32_t i; (i = fe__next_triangle(&walk, &unused)) >= 0;) meet_triangle(&s, i, hit);
        if (hit->triangle >= 0 && hit->t <= to) return 1;
        if (to >= end) return hit->triangle >= 0;
        t = to;
    }
}
