// sweep_boxes.c - two boxes, or a box and a triangle, one of them moving: a ray against their difference, which slabs
// bound.
//
// The points by which box B's centre can be off A's while they overlap make a polytope whose faces lie across the axes
// of A, those of B and the products of an axis of each (Gottschalk, Lin, Manocha 1996). Across a unit axis n,
//   |n . (p + t d)| <= e = sum_k a_k |n . A_k| + sum_k b_k |n . B_k|
// so a sweep is the last entry and the first exit of 15 slabs: exact, without iteration. Boxes without size (segments,
// points) do as well. A triangle has one face and three edges, 13 axes in all, and its slabs are not centred.
#include "collision/cast/approach.h"

enum { BOX_AXES = 15, TRIANGLE_AXES = 13 };
// Below this sine two edges are parallel and their product is no axis: what it would add is that small a part of their
// length.
#define PARALLEL 1e-12

// m, a direction's part along an axis that is none: edges and faces that lie across the normal
#define LIES_ACROSS 1e-9

static fe_dvec3 axis_of(const fe__axes *m, int32_t k) { return k == 0 ? m->x : k == 1 ? m->y : m->z; }
static double part(fe_dvec3 a, int32_t k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }
static fe_dvec3 unit(int32_t k) { return (fe_dvec3){k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0}; }
static int32_t axis_count(const fe__approach *s)
{
    return s->frame_kind == FE_CORE_TRIANGLE ? TRIANGLE_AXES : BOX_AXES;
}

static int32_t make_unit(fe_dvec3 *n)
{
    double length = sqrt(fe__ddot(*n, *n));
    if (length < PARALLEL) return 0;
    *n = fe__dscale(1.0 / length, *n);
    return 1;
}

// A side of the triangle times an axis of the box. Near parallel ones leave a product of rounding: what of it lies
// along them is taken off.
static int32_t side_axis(const fe__approach *s, int32_t side, fe_dvec3 a, fe_dvec3 *n)
{
    fe_dvec3 e = fe__dsub(s->vertex[(side + 1) % 3], s->vertex[side]);
    if (!make_unit(&e)) return 0;
    *n = fe__dcross(e, a);
    if (!make_unit(n)) return 0;
    *n = fe__dsub(*n, fe__dscale(fe__ddot(*n, a), a));
    *n = fe__dsub(*n, fe__dscale(fe__ddot(*n, e), e));
    return make_unit(n);
}

// Axis `index`: faces of the frame, faces of the other, then edges. The product of an axis of the frame with another's
// has no cancellation: it is exactly across both. 0: parallel edges.
static int32_t separating_axis(const fe__approach *s, int32_t index, fe_dvec3 *n)
{
    int32_t triangle = s->frame_kind == FE_CORE_TRIANGLE, faces = triangle ? 1 : 3;
    if (index < faces) {
        *n = triangle ? s->normal : unit(index);
        return 1;
    }
    index -= faces;
    if (index < 3) {
        *n = axis_of(&s->axes, index);
        return 1;
    }
    fe_dvec3 a = axis_of(&s->axes, index % 3);
    int32_t k = index / 3 - 1;
    if (triangle) return side_axis(s, k, a, n);
    *n = k == 0 ? (fe_dvec3){0.0, -a.z, a.y} : k == 1 ? (fe_dvec3){a.z, 0.0, -a.x} : (fe_dvec3){-a.y, a.x, 0.0};
    return make_unit(n);
}

// Across n: half the width of both, and the middle of the frame's core.
static double extent(const fe__approach *s, fe_dvec3 n, double *middle)
{
    fe_dvec3 m = fe__turn_back(&s->axes, n);
    double other =
        s->other_half[0] * fe__absd(m.x) + s->other_half[1] * fe__absd(m.y) + s->other_half[2] * fe__absd(m.z);
    if (s->frame_kind == FE_CORE_TRIANGLE) {
        double a = fe__ddot(n, s->vertex[0]), b = fe__ddot(n, s->vertex[1]), c = fe__ddot(n, s->vertex[2]);
        double low = fe__mind(fe__mind(a, b), c), high = fe__maxd(fe__maxd(a, b), c);
        *middle = 0.5 * (low + high);
        return 0.5 * (high - low) + other;
    }
    *middle = 0.0;
    return s->frame_half[0] * fe__absd(n.x) + s->frame_half[1] * fe__absd(n.y) + s->frame_half[2] * fe__absd(n.z) +
           other;
}

double fe__core_depth(const fe__approach *s, fe_dvec3 *way_out)
{
    double depth = (double)INFINITY;
    for (int32_t i = 0; i < axis_count(s); ++i) {
        fe_dvec3 n;
        double middle;
        if (!separating_axis(s, i, &n)) continue;
        double e = extent(s, n, &middle), centre = fe__ddot(n, s->position) - middle, below = e - fe__absd(centre);
        if (below < -s->touch) return below;
        if (!(below < depth)) continue;
        depth = below;
        *way_out = centre < 0.0 ? fe__dscale(-1.0, n) : n;
    }
    return depth;
}

// ---- where they touch -----------------------------------------------------------------------------------------------
// What of a box lies farthest along a direction: a corner, an edge or a face, as a box with up to two free half widths.
typedef struct feature {
    fe_dvec3 centre;
    double free[3]; // half widths along the box's axes, 0: fixed
    int32_t free_count, free_axis;
} feature;

static feature feature_along(const double half[3], fe_dvec3 along)
{
    double c[3];
    feature f = {.free_count = 0};
    for (int32_t k = 0; k < 3; ++k) {
        double x = part(along, k);
        int32_t across = fe__absd(x) <= LIES_ACROSS;
        c[k] = across ? 0.0 : x > 0.0 ? half[k] : -half[k];
        f.free[k] = across ? half[k] : 0.0;
        f.free_count += across;
        if (across) f.free_axis = k;
    }
    f.centre = (fe_dvec3){c[0], c[1], c[2]};
    return f;
}

static fe_dvec3 clamp_to(const feature *f, fe_dvec3 p)
{
    fe_dvec3 d = fe__dsub(p, f->centre);
    return fe__dadd(f->centre, (fe_dvec3){fe__mind(fe__maxd(d.x, -f->free[0]), f->free[0]),
                                          fe__mind(fe__maxd(d.y, -f->free[1]), f->free[1]),
                                          fe__mind(fe__maxd(d.z, -f->free[2]), f->free[2])});
}

// Two edges: the nearest point on the frame's.
static fe_dvec3 cross_edges(const fe__approach *s, const feature *of_frame, const feature *of_other, fe_dvec3 position)
{
    fe_dvec3 e = unit(of_frame->free_axis), a = axis_of(&s->axes, of_other->free_axis);
    fe_dvec3 p = fe__dsub(fe__dadd(position, fe__turn(&s->axes, of_other->centre)), of_frame->centre);
    double cosine = fe__ddot(e, a), sine = 1.0 - cosine * cosine;
    double v = sine > LIES_ACROSS ? (fe__ddot(e, p) - cosine * fe__ddot(a, p)) / sine : fe__ddot(e, p);
    return clamp_to(of_frame, fe__dadd(of_frame->centre, fe__dscale(v, e)));
}

// The corners of a triangle that lie farthest along the normal, the first of them first.
static int32_t corners_along(const fe__approach *s, fe_dvec3 normal, fe_dvec3 corner[3])
{
    double along[3], most = -(double)INFINITY;
    for (int32_t i = 0; i < 3; ++i) along[i] = fe__ddot(normal, s->vertex[i]), most = fe__maxd(most, along[i]);
    int32_t count = 0;
    for (int32_t i = 0; i < 3; ++i) {
        if (along[i] >= most - LIES_ACROSS) corner[count++] = s->vertex[i];
    }
    return count;
}

static fe_dvec3 clamp_to_corners(const fe__approach *s, const fe_dvec3 corner[3], int32_t count, fe_dvec3 p)
{
    if (count == 3) return fe__nearest_on_triangle(s->vertex, s->normal, p);
    if (count == 1) return corner[0];
    fe_dvec3 side = fe__dsub(corner[1], corner[0]);
    double t = fe__ddot(fe__dsub(p, corner[0]), side) / fe__ddot(side, side);
    return fe__dadd(corner[0], fe__dscale(fe__mind(fe__maxd(t, 0.0), 1.0), side));
}

static const int32_t clampings = 16;

static fe_dvec3 touching_point_of_triangle(const fe__approach *s, fe_dvec3 position, fe_dvec3 normal)
{
    fe_dvec3 corner[3];
    int32_t count = corners_along(s, normal, corner);
    feature of_other = feature_along(s->other_half, fe__dscale(-1.0, fe__turn_back(&s->axes, normal)));
    fe_dvec3 centre = fe__dadd(position, fe__turn(&s->axes, of_other.centre));
    if (count == 2 && of_other.free_count == 1) {
        fe_dvec3 side = fe__dsub(corner[1], corner[0]);
        double length = sqrt(fe__ddot(side, side)), u, w;
        fe_dvec3 b = fe__dscale(1.0 / length, side);
        fe__nearest_on_segments(centre, axis_of(&s->axes, of_other.free_axis), of_other.free[of_other.free_axis],
                                corner[0], b, length, &u, &w);
        return fe__dadd(corner[0], fe__dscale(w, b));
    }
    fe_dvec3 p = clamp_to_corners(s, corner, count, centre);
    for (int32_t i = 0; i < clampings; ++i) {
        fe_dvec3 q = clamp_to(&of_other, fe__turn_back(&s->axes, fe__dsub(p, position)));
        p = clamp_to_corners(s, corner, count, fe__dadd(position, fe__turn(&s->axes, q)));
    }
    return p;
}

// A point of both features, on the frame's. They lie in one plane across the normal: clamping to each in turn ends in
// both (von Neumann).
static fe_dvec3 touching_point(const fe__approach *s, fe_dvec3 position, fe_dvec3 normal)
{
    if (s->frame_kind == FE_CORE_TRIANGLE) return touching_point_of_triangle(s, position, normal);
    feature of_frame = feature_along(s->frame_half, normal);
    feature of_other = feature_along(s->other_half, fe__dscale(-1.0, fe__turn_back(&s->axes, normal)));
    if (of_frame.free_count == 1 && of_other.free_count == 1) return cross_edges(s, &of_frame, &of_other, position);
    fe_dvec3 p = of_frame.centre;
    for (int32_t i = 0; i < clampings; ++i) {
        fe_dvec3 q = clamp_to(&of_other, fe__turn_back(&s->axes, fe__dsub(p, position)));
        p = clamp_to(&of_frame, fe__dadd(position, fe__turn(&s->axes, q)));
    }
    return p;
}

// ---- the sweep -----------------------------------------------------------------------------------------------------
typedef struct passage {
    double enter, leave; // of the polytope itself: they decide
    double stop;         // entry of the polytope with all its faces moved out by the gap
    fe_dvec3 normal;     // of the face entered
} passage;

// 0: outside of this slab for good, or after leaving another. What comes in by no more than a touch is outside.
static int32_t clip_to_slab(const fe__approach *s, fe_dvec3 n, passage *p)
{
    double middle, e = extent(s, n, &middle), centre = fe__ddot(n, s->position) - middle,
                   rate = fe__ddot(n, s->translation);
    if (rate > 0.0) n = fe__dscale(-1.0, n), centre = -centre, rate = -rate; // n against the motion
    double within = fe__maxd(e - s->touch, 0.0);
    if (rate == 0.0) return fe__absd(centre) <= within;
    double enter = (centre - within) / -rate, leave = (centre + within) / -rate;
    if (enter > p->enter) p->enter = enter, p->normal = n;
    p->stop = fe__maxd(p->stop, (centre - e - s->gap) / -rate);
    p->leave = fe__mind(p->leave, leave);
    return p->enter <= p->leave && p->leave >= 0.0;
}

int32_t fe__boxes_sweep(const fe__approach *s, double limit, fe__approach_hit *hit)
{
    passage p = {-(double)INFINITY, (double)INFINITY, -(double)INFINITY, {0.0, 0.0, 0.0}};
    for (int32_t i = 0; i < axis_count(s); ++i) {
        fe_dvec3 n;
        if (separating_axis(s, i, &n) && !clip_to_slab(s, n, &p)) return 0;
    }
    if (!(p.enter > -(double)INFINITY && p.enter <= 1.0)) return 0;
    hit->t = fe__maxd(p.stop, 0.0);
    if (!(hit->t <= limit)) return 0;
    hit->normal = p.normal;
    hit->point = touching_point(s, fe__dadd(s->position, fe__dscale(hit->t, s->translation)), p.normal);
    return 1;
}

fe_dvec3 fe__boxes_touching_point(const fe__approach *s, fe_dvec3 normal)
{
    return touching_point(s, s->position, normal);
}
