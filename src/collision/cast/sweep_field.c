// sweep_field.c - a moving form against a heightfield or a mesh: its triangles, piece by piece along the way.
//
// The queries give the mover in the surface's frame. The tree of a mesh offers triangles along the way. On a
// heightfield the way is cut into pieces of about the form's size or a cell, so that few triangles lie under each
// piece; a hit within a piece comes before all later ones. Vertices are doubles: a stop is as exact as before a box.
#include "collision/cast/sweep_field.h"

#include "collision/cast/mesh_ray.h"
#include "collision/cast/sweep.h"
#include "collision/form/form.h"

// ---- the search -----------------------------------------------------------------------------------------------------
// A normal that leans below a triangle by more than a rounding comes from under it.
#define FROM_BELOW (-1e-9)
// A point that is so near to a side of a triangle is on it, m.
#define ON_SIDE 1e-6

// The half width, about the mover's origin, along an axis of the surface's frame, which is given in the mover's.
static double half_width_along(const fe__form *form, fe_dvec3 axis)
{
    fe_dvec3 back = fe__dscale(-1.0, axis);
    return fe__maxd(fe__ddot(axis, fe__form_support(form, axis)), fe__ddot(back, fe__form_support(form, back)));
}

static fe_dvec3 bounds_of(const fe__mover *mover)
{
    if (fe__form_is_hull(mover->form)) {
        const fe__axes *a = &mover->axes;
        return (fe_dvec3){half_width_along(mover->form, (fe_dvec3){a->x.x, a->y.x, a->z.x}),
                          half_width_along(mover->form, (fe_dvec3){a->x.y, a->y.y, a->z.y}),
                          half_width_along(mover->form, (fe_dvec3){a->x.z, a->y.z, a->z.z})};
    }
    double half[3], r = (double)mover->form->radius;
    fe__core_half(mover->form, half);
    const fe__axes *m = &mover->axes;
    return (fe_dvec3){half[0] * fe__absd(m->x.x) + half[1] * fe__absd(m->y.x) + half[2] * fe__absd(m->z.x) + r,
                      half[0] * fe__absd(m->x.y) + half[1] * fe__absd(m->y.y) + half[2] * fe__absd(m->z.y) + r,
                      half[0] * fe__absd(m->x.z) + half[1] * fe__absd(m->y.z) + half[2] * fe__absd(m->z.z) + r};
}

fe__field_search fe__field_search_of(const fe__ground *surface, const fe__mover *mover)
{
    fe__field_search s = {.surface = surface, .mover = mover, .half = bounds_of(mover)};
    fe__approach *p = &s.pair;
    p->frame_kind = FE_CORE_TRIANGLE, p->other_kind = fe__core_kind_of(mover->form), p->other_form = mover->form;
    fe__core_half(mover->form, p->other_half);
    p->axes = mover->axes, p->position = mover->position, p->translation = mover->translation;
    p->radius = (double)mover->form->radius;
    p->gap = fe__stop_gap(mover), p->touch = fe__touch_of(mover);
    return s;
}

void fe__field_take(fe__field_search *s, int32_t triangle)
{
    fe_dvec3 *v = s->pair.vertex;
    fe__ground_corners(s->surface, triangle, v);
    s->pair.normal = fe__ground_normal(s->surface, triangle);
    if (!fe__ground_is_two_sided(s->surface) || fe__ddot(s->pair.normal, fe__dsub(s->pair.position, v[0])) >= 0.0)
        return;
    fe_dvec3 second = v[1];
    v[1] = v[2], v[2] = second;
    s->pair.normal = fe__dscale(-1.0, s->pair.normal);
}

fe__bounds fe__field_covered(const fe__field_search *s, double t0, double t1)
{
    double spare = 2.0 * s->pair.gap;
    fe_dvec3 a = fe__dadd(s->mover->position, fe__dscale(t0, s->mover->translation));
    fe_dvec3 b = fe__dadd(s->mover->position, fe__dscale(t1, s->mover->translation));
    fe_dvec3 h = {s->half.x + spare, s->half.y + spare, s->half.z + spare};
    fe_dvec3 low = {fe__mind(a.x, b.x), fe__mind(a.y, b.y), fe__mind(a.z, b.z)};
    fe_dvec3 high = {fe__maxd(a.x, b.x), fe__maxd(a.y, b.y), fe__maxd(a.z, b.z)};
    return (fe__bounds){fe__dsub(low, h), fe__dadd(high, h)};
}

int32_t fe__ground_overlap(const fe__ground *surface, const fe__mover *mover)
{
    fe__field_search s = fe__field_search_of(surface, mover);
    fe__bounds box = fe__field_covered(&s, 0.0, 0.0);
    fe__ground_walk walk;
    fe__ground_begin(&walk, surface, &box, mover->position);
    for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) {
        fe__field_take(&s, i);
        fe__core_overlap overlap = fe__approach_overlap(&s.pair);
        if (fe__is_inside(&s.pair, &overlap)) return 1;
    }
    return 0;
}

// ---- one triangle --------------------------------------------------------------------------------------------------
// How far the mover reaches from its origin along the triangle's normal (side 1), or against it (-1), m.
static double reach_across(const fe__approach *p, double side)
{
    fe_dvec3 m = fe__turn_back(&p->axes, p->normal), way = fe__dscale(side, m);
    if (p->other_kind == FE_CORE_CURVED) return fe__ddot(way, fe__form_support(p->other_form, way)) + p->radius;
    return p->other_half[0] * fe__absd(m.x) + p->other_half[1] * fe__absd(m.y) + p->other_half[2] * fe__absd(m.z) +
           p->radius;
}

// The height of the mover's origin at t over the triangle's plane, m.
static double height_at(const fe__approach *p, double t)
{
    return fe__ddot(p->normal, fe__dsub(fe__approach_at(p, t), p->vertex[0]));
}

double fe__field_depth(const fe__field_search *s)
{
    return fe__maxd(reach_across(&s->pair, -1.0) - height_at(&s->pair, 0.0), 0.0);
}

// Is the point on a side that is a rim?
static int32_t is_on_rim(const fe__field_search *s, int32_t triangle, fe_dvec3 point)
{
    fe_dvec3 v[3];
    fe__ground_corners(s->surface, triangle, v);
    for (int32_t i = 0; i < 3; ++i) {
        if (!fe__ground_is_rim(s->surface, triangle, i)) continue;
        fe_dvec3 side = fe__dsub(v[(i + 1) % 3], v[i]), across = fe__dcross(side, fe__dsub(point, v[i]));
        if (fe__ddot(across, across) <= ON_SIDE * ON_SIDE * fe__ddot(side, side)) return 1;
    }
    return 0;
}

int32_t fe__field_is_met(const fe__field_search *s, int32_t triangle, const fe__approach_hit *hit)
{
    if (fe__ddot(hit->normal, s->pair.normal) >= FROM_BELOW) return 1;
    return height_at(&s->pair, hit->t) + reach_across(&s->pair, 1.0) > 0.0 && is_on_rim(s, triangle, hit->point);
}

static double size(fe_dvec3 a) { return fe__absd(a.x) + fe__absd(a.y) + fe__absd(a.z); }

// How far the core reaches along m (surface's frame), times m's length.
static double core_along(const fe__approach *p, fe_dvec3 m)
{
    if (p->other_kind == FE_CORE_POINT) return 0.0;
    fe_dvec3 way = fe__turn_back(&p->axes, m);
    if (p->other_kind == FE_CORE_CURVED) return fe__ddot(way, fe__form_support(p->other_form, way));
    return p->other_half[0] * fe__absd(way.x) + p->other_half[1] * fe__absd(way.y) + p->other_half[2] * fe__absd(way.z);
}

// 1: up to `limit` the mover is above the triangle's plane or touches it, or it is below it by more than any stop.
static int32_t stays_on_one_side(const fe__approach *p, double limit)
{
    const fe_dvec3 *v = p->vertex, n = p->normal;
    double b = fe__ddot(n, fe__dsub(v[1], v[0])), c = fe__ddot(n, fe__dsub(v[2], v[0])),
           spare = p->radius + 2.0 * p->gap;
    double start = height_at(p, 0.0), end = height_at(p, limit), lowest = fe__mind(start, end) - spare,
           highest = fe__maxd(start, end) + spare;
    // The whole way counts: a mover that comes below the plane behind the limit may touch it now, and may be met.
    if (fe__mind(start, height_at(p, 1.0)) - reach_across(p, -1.0) >= -p->touch) return 1;
    if (lowest > 0.0) return lowest - core_along(p, fe__dscale(-1.0, n)) > fe__maxd(fe__maxd(b, c), 0.0);
    if (highest < 0.0) return highest + core_along(p, n) < fe__mind(fe__mind(b, c), 0.0);
    return 0;
}

// 1: the mover is beyond a plane through a side and along the way, by more than any stop, and meets nothing.
static int32_t passes_beside(const fe__approach *p)
{
    const double rounding = 1e-14; // share of the lengths involved
    const fe_dvec3 *v = p->vertex;
    double clear = p->radius + 2.0 * p->gap;
    for (int32_t i = 0; i < 3; ++i) {
        fe_dvec3 side = fe__dsub(v[(i + 1) % 3], v[i]), other = fe__dsub(v[(i + 2) % 3], v[i]);
        fe_dvec3 from = fe__dsub(p->position, v[i]), m = fe__dcross(p->translation, side);
        if (fe__ddot(m, other) > 0.0) m = fe__dscale(-1.0, m);
        double rest = fe__ddot(m, from);
        if (!(rest > 0.0)) continue;
        rest -= core_along(p, fe__dscale(-1.0, m)) +
                rounding * size(p->translation) * size(side) * (size(from) + size(other) + size(p->translation));
        if (rest > 0.0 && rest * rest > clear * clear * fe__ddot(m, m)) return 1;
    }
    return 0;
}

// Takes a triangle into the result. If the mover starts inside, the result is the deepest triangle, else the first hit;
// of equal ones it is the triangle with the lowest number.
static void meet_triangle(fe__field_search *s, int32_t triangle, fe__sweep_hit *best)
{
    int32_t number = fe__ground_number(s->surface, triangle);
    fe__field_take(s, triangle);
    if (stays_on_one_side(&s->pair, best->t) || passes_beside(&s->pair)) return;
    fe__core_overlap overlap = fe__approach_overlap(&s->pair);
    if (fe__is_inside(&s->pair, &overlap)) {
        double depth = fe__field_depth(s);
        if (best->inside && (depth < best->depth || (depth == best->depth && number > best->triangle))) return;
        *best = (fe__sweep_hit){.normal = s->pair.normal,
                                .point = s->mover->position,
                                .depth = depth,
                                .inside = 1,
                                .triangle = number,
                                .index = triangle};
        return;
    }
    fe__approach_hit hit;
    if (best->inside || !fe__approach_sweep(&s->pair, &overlap, best->t, &hit)) return;
    if (best->triangle >= 0 && hit.t == best->t && number > best->triangle) return;
    if (!fe__field_is_met(s, triangle, &hit)) return;
    *best =
        (fe__sweep_hit){.t = hit.t, .normal = hit.normal, .point = hit.point, .triangle = number, .index = triangle};
}

// ---- the way -------------------------------------------------------------------------------------------------------
int32_t fe__field_clip(const fe__field_search *s, double limit, double *from, double *to)
{
    fe__bounds bounds = fe__ground_bounds(s->surface);
    double spare = 2.0 * s->pair.gap;
    fe_dvec3 o = s->mover->position, d = s->mover->translation;
    const double origin[3] = {o.x, o.y, o.z}, way[3] = {d.x, d.y, d.z}, half[3] = {s->half.x, s->half.y, s->half.z};
    const double low[3] = {bounds.low.x, bounds.low.y, bounds.low.z};
    const double high[3] = {bounds.high.x, bounds.high.y, bounds.high.z};
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

typedef struct field_sweep {
    fe__field_search *search;
    fe__sweep_hit *hit;
} field_sweep;

static double visit_triangle(void *context, int32_t triangle)
{
    field_sweep *f = context;
    meet_triangle(f->search, triangle, f->hit);
    return f->hit->t;
}

// Walks the triangles under one piece of the way after the other.
static void sweep_pieces(fe__field_search *s, double t, double end, fe__sweep_hit *hit)
{
    const fe__mover *mover = s->mover;
    fe_dvec3 cell = fe__ground_cell(s->surface);
    double cells_x = fe__absd(mover->translation.x) / (cell.x + s->half.x),
           cells_y = fe__absd(mover->translation.y) / (cell.y + s->half.y),
           cells_z = fe__absd(mover->translation.z) / (cell.z + s->half.z);
    double cells = fe__maxd(fe__maxd(cells_x, cells_y), cells_z), piece = cells > 0.0 ? 1.0 / cells : (double)INFINITY;
    for (;;) {
        double to = fe__mind(t + piece, end);
        if (!(to > t)) to = end; // The piece is below the rounding of t.
        fe__bounds box = fe__field_covered(s, t, to);
        fe__ground_walk walk;
        fe__ground_begin(&walk, s->surface, &box, mover->position);
        for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) meet_triangle(s, i, hit);
        if (to >= end || (hit->triangle >= 0 && hit->t <= to)) return;
        t = to;
    }
}

int32_t fe__ground_sweep(const fe__ground *surface, const fe__mover *mover, double limit, fe__sweep_hit *hit)
{
    fe__field_search s = fe__field_search_of(surface, mover);
    double t, end;
    if (!fe__field_clip(&s, limit, &t, &end)) return 0;
    *hit = (fe__sweep_hit){.t = limit, .triangle = -1};
    fe_dvec3 way = mover->translation;
    if (surface->mesh && fe__maxd(fe__maxd(fe__absd(way.x), fe__absd(way.y)), fe__absd(way.z)) > FE__MESH_STILL) {
        // The tree of a mesh offers its triangles along the way, the nearest first.
        const fe__mesh_casts *casts = surface->casts ? surface->casts : &FE_BASE_SET(fe__mesh_casts);
        double spare = 2.0 * s.pair.gap;
        fe__mesh_way box = {mover->position, way, {s.half.x + spare, s.half.y + spare, s.half.z + spare}};
        field_sweep context = {&s, hit};
        casts->sweep(surface->mesh, &box, limit, visit_triangle, &context);
    } else {
        sweep_pieces(&s, t, end, hit);
    }
    if (hit->triangle < 0) return 0;
    if (hit->inside) fe__field_depenetrate(&s, hit);
    return 1;
}

// ---- depenetration: the candidates ----------------------------------------------------------------------------------
// A surface of triangles has no inside from which a way out would follow: candidates are tried. A candidate is a
// direction. Its length is found by coming back along it, from a place where the form is free, to the first touch,
// which must be from the side that counts. Candidates are the normals of the triangles that are overlapped, the ways
// out of each of them alone, and the least translation that satisfies all of either kind at once, as in a corner
// (Hildreth, A quadratic programming procedure, 1957).

enum {
    MOST_WAYS = 16,  // Each kind has at most so many candidates; alike ones are one.
    LEAST_TRIES = 3, // So many are tried, however many triangles there are.
    WORK = 2048,     // All tries together look at about so many triangles.
    PASSES = 64,     // The least translation takes so many passes.
    DOUBLINGS = 4    // The greatest depth is doubled so often, until a way parts the two.
};
#define SAME_WAY 0.9998 // cosine of a degree

typedef struct way {
    fe_dvec3 direction; // unit
    double length;      // least length, m
} way;

typedef struct ways {
    way way[MOST_WAYS];
    int32_t count;
} ways;

static void add_way(ways *w, fe_dvec3 direction, double length)
{
    for (int32_t i = 0; i < w->count; ++i) {
        if (fe__ddot(w->way[i].direction, direction) < SAME_WAY) continue;
        w->way[i].length = fe__maxd(w->way[i].length, length);
        return;
    }
    if (w->count < MOST_WAYS) w->way[w->count++] = (way){direction, length};
}

typedef struct overlaps {
    ways planes, alone; // ways over the planes of triangles; ways out of each triangle alone
    int32_t count;      // number of triangles in the mover's bounds
    double least;       // longest way out of one triangle, m: no translation that parts all is shorter
} overlaps;

static void gather(fe__field_search *s, overlaps *all)
{
    int32_t is_two_sided = fe__ground_is_two_sided(s->surface);
    fe__bounds box = fe__field_covered(s, 0.0, 0.0);
    fe__ground_walk walk;
    fe__ground_begin(&walk, s->surface, &box, s->mover->position);
    for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) {
        all->count += 1;
        fe__field_take(s, i);
        fe__core_overlap o = fe__approach_overlap(&s->pair);
        if (!fe__is_inside(&s->pair, &o)) continue;
        all->least = fe__maxd(all->least, o.depth);
        add_way(&all->planes, s->pair.normal, fe__field_depth(s));
        const double rounding = 1e-9; // share of a way's length; cores that just touch have no way out
        if (fe__absd(fe__ddot(o.way_out, o.way_out) - 1.0) < rounding &&
            (is_two_sided || fe__ddot(o.way_out, s->pair.normal) >= 0.0))
            add_way(&all->alone, o.way_out, o.depth);
        else
            add_way(&all->alone, s->pair.normal, fe__field_depth(s));
    }
}

// The least x with direction . x >= length for all ways: x = sum_i pull_i direction_i, pull_i >= 0. Hildreth's method
// changes one pull after the other.
static fe_dvec3 least_translation(const ways *w)
{
    double pull[MOST_WAYS] = {0.0};
    fe_dvec3 x = {0.0, 0.0, 0.0};
    for (int32_t pass = 0; pass < PASSES; ++pass) {
        for (int32_t i = 0; i < w->count; ++i) {
            fe_dvec3 d = w->way[i].direction;
            double more = fe__maxd(w->way[i].length - fe__ddot(d, x), -pull[i]);
            pull[i] += more;
            x = fe__dadd(x, fe__dscale(more, d));
        }
    }
    return x;
}

// ---- depenetration: the trials -------------------------------------------------------------------------------------
// The distance along `direction` at which the mover is free, found by coming back from `length`. It is infinite if the
// mover is not free there, or was on the wrong side.
static double way_along(const fe__field_search *from, fe_dvec3 direction, double length)
{
    fe__mover mover = *from->mover;
    mover.position = fe__dadd(mover.position, fe__dscale(length, direction));
    mover.translation = fe__dscale(-length, direction);
    fe__field_search s = fe__field_search_of(from->surface, &mover);
    fe__approach_hit first = {.t = 1.0}, hit;
    int32_t is_right = 0;
    fe__bounds box = fe__field_covered(&s, 0.0, 1.0);
    fe__ground_walk walk;
    fe__ground_begin(&walk, s.surface, &box, mover.position);
    for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) {
        fe__field_take(&s, i);
        fe__core_overlap overlap = fe__approach_overlap(&s.pair);
        if (fe__is_inside(&s.pair, &overlap)) return (double)INFINITY;
        if (!fe__approach_sweep(&s.pair, &overlap, first.t, &hit) || !(hit.t < first.t)) continue;
        first = hit;
        is_right = fe__ground_is_two_sided(s.surface) || fe__field_is_met(&s, i, &hit);
    }
    return is_right ? (1.0 - first.t) * length : (double)INFINITY;
}

typedef struct trial {
    const fe__field_search *search;
    fe__sweep_hit *best;
    double least;  // A way that is no longer ends the search, m.
    int32_t parts; // The best way parts the two.
    int32_t tries; // So many trials may follow then.
} trial;

// The way begins a little farther out than needed, so that the mover is free there.
static void try_way(trial *t, fe_dvec3 direction, double length)
{
    const double spare = 1e-6, share = 1e-6; // m; share of the length
    if (t->parts && t->tries <= 0) return;
    t->tries -= 1;
    double from = t->parts ? fe__mind(length, t->best->depth) : length;
    double depth = way_along(t->search, direction, from + spare + share * from + 4.0 * t->search->pair.gap);
    if (t->parts ? !(depth < t->best->depth) : depth == (double)INFINITY) return;
    t->best->normal = direction, t->best->depth = depth;
    t->parts = 1;
    if (depth <= t->least) t->tries = 0;
}

static void try_translation(trial *t, fe_dvec3 x)
{
    double length = sqrt(fe__ddot(x, x));
    if (length > 0.0) try_way(t, fe__dscale(1.0 / length, x), length);
}

void fe__field_depenetrate(const fe__field_search *search, fe__sweep_hit *hit)
{
    fe__field_search s = *search;
    overlaps all = {0};
    gather(&s, &all);
    const double alike = 1.001, rounding = 1e-5; // m
    trial t = {search, hit, alike * all.least + rounding, 0, fe__maxi(WORK / fe__maxi(all.count, 1), LEAST_TRIES)};
    try_way(&t, hit->normal, hit->depth);
    try_translation(&t, least_translation(&all.alone));
    try_translation(&t, least_translation(&all.planes));
    double length = fe__maxd(hit->depth, all.least);
    for (int32_t i = 0; i < DOUBLINGS && !(i && t.parts); ++i, length += length) {
        for (int32_t k = 0; k < all.alone.count; ++k) try_way(&t, all.alone.way[k].direction, length);
        for (int32_t k = 0; k < all.planes.count; ++k) try_way(&t, all.planes.way[k].direction, length);
    }
}
