// sweep.c - the sweep of a moving form against a standing one; see sweep.h.
//
// The distance f(t) of two convex cores, one of them moving straight, is a convex function of t. So its tangent stays
// below it, and the step to the place where the tangent reaches the sum of the radii never goes too far: Newton's
// method from outside is conservative advancement with the best possible bound. It converges quadratically, and by
// halves if the forms graze. Two boxes, a box and a triangle, and a plane have closed forms.
#include "collision/cast/sweep.h"

#include "collision/cast/approach.h"
#include "collision/cast/cast_kinds.h"
#include "collision/form/form.h"
#include "collision/form/hull.h"

#include <string.h>

// ---- the approach ---------------------------------------------------------------------------------------------------
// Halving 10 km so often comes down to 1e-11 m; a body that is met squarely needs 3 to 6 steps.
enum { MAX_STEPS = 64 };
// f is known to this share of the lengths involved.
#define ROUNDING 2e-15
// A stop is accepted if it misses the gap by no more than this share of it.
#define GAP_TOLERANCE 0.1f

int32_t fe__core_kind_of(const fe__form *form) { return fe__casts[form->type].core; }

void fe__core_half(const fe__form *form, double half[3])
{
    half[0] = (double)form->half.x, half[1] = (double)form->half.y + (double)form->half_height,
    half[2] = (double)form->half.z;
}

// The gap and the touch are never less than the rounding of the lengths.
static double size(fe_dvec3 a) { return fe__absd(a.x) + fe__absd(a.y) + fe__absd(a.z); }
double fe__stop_gap(const fe__mover *mover)
{
    return FE_SWEEP_GAP + ROUNDING * (size(mover->position) + size(mover->translation));
}
double fe__touch_of(const fe__mover *mover) { return FE_SWEEP_TOUCH + ROUNDING * size(mover->position); }

// Fills the approach. 1: the mover gives the frame
static int32_t set_up(const fe__form *still, const fe__mover *mover, fe__approach *s)
{
    int32_t still_kind = fe__core_kind_of(still), mover_kind = fe__core_kind_of(mover->form),
            swapped = mover_kind > still_kind;
    const fe__axes *m = &mover->axes;
    s->radius = (double)still->radius + (double)mover->form->radius;
    if (swapped) {
        s->frame_kind = mover_kind, s->other_kind = still_kind;
        s->frame_form = mover->form, s->other_form = still;
        fe__core_half(mover->form, s->frame_half), fe__core_half(still, s->other_half);
        s->axes = (fe__axes){{m->x.x, m->y.x, m->z.x}, {m->x.y, m->y.y, m->z.y}, {m->x.z, m->y.z, m->z.z}};
        s->position = fe__dscale(-1.0, fe__turn_back(m, mover->position));
        s->translation = fe__dscale(-1.0, fe__turn_back(m, mover->translation));
    } else {
        s->frame_kind = still_kind, s->other_kind = mover_kind;
        s->frame_form = still, s->other_form = mover->form;
        fe__core_half(still, s->frame_half), fe__core_half(mover->form, s->other_half);
        s->axes = *m, s->position = mover->position, s->translation = mover->translation;
    }
    s->gap = fe__stop_gap(mover), s->touch = fe__touch_of(mover);
    return swapped;
}

// ---- overlap -------------------------------------------------------------------------------------------------------
double fe__height_over_plane(const fe__form *plane, const fe__mover *mover)
{
    fe_dvec3 n = fe__widen(plane->normal);
    double half[3], length = sqrt(fe__ddot(n, n)); // The length is 1 up to the rounding of floats.
    fe__core_half(mover->form, half);
    fe_dvec3 down = fe__dscale(-1.0, fe__turn_back(&mover->axes, n));
    double e = fe__core_kind_of(mover->form) == FE_CORE_CURVED
                   ? fe__ddot(down, fe__form_support(mover->form, down))
                   : half[0] * fe__absd(fe__ddot(n, mover->axes.x)) + half[1] * fe__absd(fe__ddot(n, mover->axes.y)) +
                         half[2] * fe__absd(fe__ddot(n, mover->axes.z));
    return (fe__ddot(n, mover->position) - (double)plane->distance - e) / length - (double)mover->form->radius;
}

// The overlap is in the approach's frame.
fe__core_overlap fe__approach_overlap(const fe__approach *s)
{
    fe__core_overlap o = {.gap = {0}};
    if (fe__is_curved_pair(s)) {
        fe__curved_gap_of(s, s->position, &o.gap);
        if (!(o.gap.distance > s->touch)) { // Between nearer points rounding makes the direction.
            o.depth = fe__curved_depth(s, &o.way_out, &o.gap) + s->radius;
            return o;
        }
    } else if (s->other_kind != FE_CORE_BOX) {
        fe__core_gap_of(s, s->position, &o.gap);
    }
    if (o.gap.distance > 0.0) {
        o.depth = s->radius - o.gap.distance;
        o.way_out = fe__dscale(1.0 / o.gap.distance, o.gap.away);
    } else {
        o.depth = fe__core_depth(s, &o.way_out) + s->radius;
        if (s->other_kind != FE_CORE_BOX) o.depth = fe__maxd(o.depth, s->radius); // The cores touch.
    }
    return o;
}

int32_t fe__form_overlap(const fe__form *still, const fe__mover *mover)
{
    if (fe__form_is_unbounded(still)) return fe__height_over_plane(still, mover) < -fe__touch_of(mover);
    fe__approach s;
    (void)set_up(still, mover, &s);
    fe__core_overlap o = fe__approach_overlap(&s);
    return fe__is_inside(&s, &o);
}

// ---- round cores ---------------------------------------------------------------------------------------------------
// Goes by Newton's method from `t` to the place where the distance is `goal`, or more by at most `tolerance`. 0: it is
// not so near up to `limit`. `gap` is the gap at t, before and after.
static int32_t advance(const fe__approach *s, double goal, double tolerance, double limit, double *t, fe__core_gap *gap)
{
    for (int32_t i = 0;; ++i) {
        if (i > 0) fe__core_gap_of(s, fe__approach_at(s, *t), gap);
        double rate = fe__ddot(gap->away, s->translation) / gap->distance; // m per t
        if (!(rate < 0.0)) return 0;
        if (gap->distance <= goal + tolerance || i == MAX_STEPS) return 1;
        *t += (gap->distance - goal) / -rate;
        if (!(*t <= limit)) return 0;
    }
}

// The form stops at the beginning of the gap, or at once if it is within. It stops only if it would come through half
// of the gap: a form that slides along a surface must not stick to it by a rounding.
static int32_t sweep_round(const fe__approach *s, const fe__core_gap *start, double limit, fe__approach_hit *hit)
{
    double tolerance = (double)GAP_TOLERANCE * s->gap, t = 0.0, clearance;
    fe__core_gap gap = *start;
    fe_dvec3 first = fe__approach_at(s, 0.0);
    if (memcmp(&first, &s->position, sizeof first) != 0) fe__core_gap_of(s, first, &gap); // A -0 has become 0.
    if (!advance(s, s->radius + s->gap, tolerance, fe__mind(limit, 1.0), &t, &gap) || !(t <= limit)) return 0;
    *hit = (fe__approach_hit){t, fe__dscale(1.0 / gap.distance, gap.away), gap.on_frame};
    clearance = fe__mind(gap.distance - s->radius, s->gap);
    return advance(s, s->radius + 0.5 * clearance, (double)GAP_TOLERANCE * clearance, 1.0, &t, &gap);
}

fe_dvec3 fe__touching_point(const fe__approach *s, const fe__core_overlap *touch)
{
    int32_t are_boxes = s->other_kind == FE_CORE_BOX && !fe__is_curved_pair(s);
    return are_boxes ? fe__boxes_touching_point(s, touch->way_out) : touch->gap.on_frame;
}

// ---- any cores -----------------------------------------------------------------------------------------------------
// Forms that touch at the start meet at once or never. Being convex, they overlap from the start on if they overlap
// anywhere on the way; a form that slides along or leaves overlaps nowhere. The overlap may end soon, so the test is
// made at the end of the way and at ever shorter parts of it.
static int32_t sweep_from_touch(const fe__approach *s, const fe__core_overlap *start, fe__approach_hit *hit)
{
    enum { PARTS = 24 };
    const double shorter = 0.25, deeper = 2.0; // `deeper` counts touches: the start may overlap by one.
    fe__approach later = *s;
    double t = 1.0;
    for (int32_t i = 0; i < PARTS; ++i, t *= shorter) {
        later.position = fe__approach_at(s, t);
        if (!(fe__approach_overlap(&later).depth > deeper * s->touch)) continue;
        *hit = (fe__approach_hit){0.0, start->way_out, fe__touching_point(s, start)};
        return 1;
    }
    return 0;
}

int32_t fe__approach_sweep(const fe__approach *s, const fe__core_overlap *overlap, double limit, fe__approach_hit *hit)
{
    if (overlap->depth >= -s->touch) return sweep_from_touch(s, overlap, hit);
    if (fe__is_curved_pair(s)) return fe__curved_sweep(s, &overlap->gap, limit, hit);
    return s->other_kind == FE_CORE_BOX ? fe__boxes_sweep(s, limit, hit) : sweep_round(s, &overlap->gap, limit, hit);
}

// ---- planes --------------------------------------------------------------------------------------------------------
fe_dvec3 fe__point_of_plane(const fe__form *plane, fe_dvec3 unit, const fe__mover *mover)
{
    const fe__axes *m = &mover->axes;
    fe_dvec3 up = fe__turn_back(m, unit), lowest;
    if (fe__core_kind_of(mover->form) == FE_CORE_CURVED) {
        lowest = fe__form_support(mover->form, fe__dscale(-1.0, up));
    } else {
        // A core that lies across the normal on an axis has its middle there.
        double half[3];
        fe__core_half(mover->form, half);
        lowest.x = up.x > 0.0 ? -half[0] : up.x < 0.0 ? half[0] : 0.0;
        lowest.y = up.y > 0.0 ? -half[1] : up.y < 0.0 ? half[1] : 0.0;
        lowest.z = up.z > 0.0 ? -half[2] : up.z < 0.0 ? half[2] : 0.0;
    }
    fe_dvec3 p = fe__dadd(mover->position, fe__turn(m, lowest)), n = fe__widen(plane->normal);
    double above = fe__ddot(unit, p) - (double)plane->distance / sqrt(fe__ddot(n, n));
    return fe__dsub(p, fe__dscale(above, unit));
}

static int32_t sweep_plane(const fe__form *plane, const fe__mover *mover, double limit, fe__sweep_hit *hit)
{
    fe_dvec3 n = fe__widen(plane->normal), unit = fe__dscale(1.0 / sqrt(fe__ddot(n, n)), n);
    double height = fe__height_over_plane(plane, mover), rate = fe__ddot(unit, mover->translation),
           touch = fe__touch_of(mover);
    *hit = (fe__sweep_hit){.normal = unit, .point = mover->position, .triangle = -1};
    if (height < -touch) {
        hit->inside = 1, hit->depth = -height;
        return 1;
    }
    if (!(rate < 0.0) || height > -rate || (height <= touch && !(-rate > 2.0 * touch))) return 0;
    hit->t = fe__maxd((height - fe__stop_gap(mover)) / -rate, 0.0);
    if (!(hit->t <= limit)) return 0;
    fe__mover stopped = *mover;
    stopped.position = fe__dadd(mover->position, fe__dscale(hit->t, mover->translation));
    hit->point = fe__point_of_plane(plane, unit, &stopped);
    return 1;
}

// ---- the sweep of a form -------------------------------------------------------------------------------------------
// Turns a hit from the approach's frame into the standing form's.
static void report(const fe__form *still, const fe__mover *mover, int32_t swapped, const fe__approach_hit *h,
                   fe__sweep_hit *hit)
{
    fe_dvec3 normal = h->normal, point = h->point;
    hit->t = h->t;
    if (swapped) {
        // The nearest points of both cores lie on one line along the normal, with the gap between the forms.
        normal = fe__turn(&mover->axes, fe__dscale(-1.0, normal));
        point =
            fe__dadd(fe__dadd(mover->position, fe__dscale(h->t, mover->translation)), fe__turn(&mover->axes, point));
        point = fe__dsub(point, fe__dscale((double)mover->form->radius, normal));
    } else {
        point = fe__dadd(point, fe__dscale((double)still->radius, normal));
    }
    hit->normal = normal;
    hit->point = point;
    if (fe__form_is_hull(still)) hit->triangle = fe__hull_face_at(still, point, normal);
}

// fe__hull_is_passed for the box that holds the mover's core: it needs no distance.
static int32_t passes_hull(const fe__form *still, const fe__mover *mover, double limit, double *out_from)
{
    const double per_scale = 1.0 / (double)still->scale,
                 clear = (double)mover->form->radius + 2.0 * fe__stop_gap(mover);
    fe_dvec3 half; // half widths of the box around the mover's origin, m
    if (fe__form_is_hull(mover->form)) {
        const fe__hull *hull = mover->form->hull;
        fe_dvec3 a = fe__from_hull(mover->form, fe__widen(hull->low)),
                 b = fe__from_hull(mover->form, fe__widen(hull->high));
        half = (fe_dvec3){fe__maxd(fe__absd(a.x), fe__absd(b.x)), fe__maxd(fe__absd(a.y), fe__absd(b.y)),
                          fe__maxd(fe__absd(a.z), fe__absd(b.z))};
    } else {
        double core[3];
        fe__core_half(mover->form, core);
        half = (fe_dvec3){core[0], core[1], core[2]};
    }
    fe__hull_passer p = {fe__in_hull(still, mover->position),
                         fe__dscale(per_scale, mover->translation),
                         {fe__dscale(per_scale * half.x, mover->axes.x), fe__dscale(per_scale * half.y, mover->axes.y),
                          fe__dscale(per_scale * half.z, mover->axes.z)},
                         per_scale * clear};
    return fe__hull_is_passed(still->hull, &p, limit, out_from);
}

int32_t fe__form_sweep(const fe__form *still, const fe__mover *mover, double limit, fe__sweep_hit *hit)
{
    if (fe__form_is_unbounded(still)) return sweep_plane(still, mover, limit, hit);
    double from = 0.0;
    if (fe__form_is_hull(still) && passes_hull(still, mover, limit, &from)) return 0;
    fe__approach s;
    fe__approach_hit h;
    int32_t swapped = set_up(still, mover, &s), met = from > 0.0 ? fe__curved_sweep_from(&s, from, limit, &h) : -1;
    *hit = (fe__sweep_hit){.triangle = -1};
    if (met >= 0) {
        if (met) report(still, mover, swapped, &h, hit);
        return met;
    }
    fe__core_overlap o = fe__approach_overlap(&s);
    if (fe__is_inside(&s, &o)) {
        fe_dvec3 out = swapped ? fe__turn(&mover->axes, fe__dscale(-1.0, o.way_out)) : o.way_out;
        *hit = (fe__sweep_hit){.normal = out, .point = mover->position, .depth = o.depth, .inside = 1, .triangle = -1};
        if (fe__form_is_hull(still)) hit->triangle = fe__hull_facing(still->hull, out);
        return 1;
    }
    if (!fe__approach_sweep(&s, &o, limit, &h)) return 0;
    report(still, mover, swapped, &h, hit);
    return 1;
}

// ---- boxes and triangles: separating axes ---------------------------------------------------------------------------
// Two boxes, or a box and a triangle, one of them moving, are a ray against their difference, which slabs bound.
//
// The points by which box B's centre can be off A's while they overlap make a polytope whose faces lie across the axes
// of A, those of B and the products of an axis of each (Gottschalk, Lin, Manocha 1996). Across a unit axis n,
//   |n . (p + t d)| <= e = sum_k a_k |n . A_k| + sum_k b_k |n . B_k|
// so a sweep is the last entry and the first exit of 15 slabs: exact, without iteration. Boxes without size (segments,
// points) do as well. A triangle has one face and three edges, 13 axes in all, and its slabs are not centred.

enum { BOX_AXES = 15, TRIANGLE_AXES = 13 };
// Below this sine two edges are parallel and their product is no axis: it would add only so small a part of their
// length.
#define PARALLEL 1e-12

// An edge or a face lies across the normal if no more of the normal is along it, m.
#define LIES_ACROSS 1e-9

static fe_dvec3 axis_of(const fe__axes *m, int32_t k) { return k == 0 ? m->x : k == 1 ? m->y : m->z; }
static double part(fe_dvec3 a, int32_t k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }
static fe_dvec3 unit(int32_t k) { return (fe_dvec3){k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0}; }
static int32_t axis_count(const fe__approach *s)
{
    return s->frame_kind == FE_CORE_TRIANGLE ? TRIANGLE_AXES : BOX_AXES;
}

// 0: the vector has no direction
static int32_t make_unit(fe_dvec3 *n)
{
    double length = sqrt(fe__ddot(*n, *n));
    if (length < PARALLEL) return 0;
    *n = fe__dscale(1.0 / length, *n);
    return 1;
}

// Axis `index`: first faces of the frame, then faces of the other, then edges. 0: parallel edges
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
    if (triangle) {
        // The product of near parallel edges is rounding: its parts along them are taken off.
        fe_dvec3 e = fe__dsub(s->vertex[(k + 1) % 3], s->vertex[k]);
        if (!make_unit(&e)) return 0;
        *n = fe__dcross(e, a);
        if (!make_unit(n)) return 0;
        *n = fe__dsub(*n, fe__dscale(fe__ddot(*n, a), a));
        *n = fe__dsub(*n, fe__dscale(fe__ddot(*n, e), e));
        return make_unit(n);
    }
    // The product with an axis of the frame has no cancellation: it is exactly across both.
    *n = k == 0 ? (fe_dvec3){0.0, -a.z, a.y} : k == 1 ? (fe_dvec3){a.z, 0.0, -a.x} : (fe_dvec3){-a.y, a.x, 0.0};
    return make_unit(n);
}

// Half the width of both cores along n, together; and the middle of the frame's core.
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

// ---- boxes and triangles: the touching point ------------------------------------------------------------------------
// The part of a box that is farthest along a direction: a corner, an edge or a face, as a box with up to two free half
// widths.
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

// The point of the frame's edge nearest to the other one.
static fe_dvec3 cross_edges(const fe__approach *s, const feature *of_frame, const feature *of_other, fe_dvec3 position)
{
    fe_dvec3 e = unit(of_frame->free_axis), a = axis_of(&s->axes, of_other->free_axis);
    fe_dvec3 p = fe__dsub(fe__dadd(position, fe__turn(&s->axes, of_other->centre)), of_frame->centre);
    double cosine = fe__ddot(e, a), sine = 1.0 - cosine * cosine;
    double v = sine > LIES_ACROSS ? (fe__ddot(e, p) - cosine * fe__ddot(a, p)) / sine : fe__ddot(e, p);
    return clamp_to(of_frame, fe__dadd(of_frame->centre, fe__dscale(v, e)));
}

// The nearest point of the triangle, of one of its sides, or its corner.
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
    // The corners that lie farthest along the normal.
    fe_dvec3 corner[3];
    double along[3], most = -(double)INFINITY;
    int32_t count = 0;
    for (int32_t i = 0; i < 3; ++i) along[i] = fe__ddot(normal, s->vertex[i]), most = fe__maxd(most, along[i]);
    for (int32_t i = 0; i < 3; ++i)
        if (along[i] >= most - LIES_ACROSS) corner[count++] = s->vertex[i];
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
// both (von Neumann's alternating projections).
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

// ---- boxes and triangles: the sweep ---------------------------------------------------------------------------------
typedef struct passage {
    double enter, leave; // t at which the ray enters and leaves the polytope: they decide
    double stop;         // t at which it enters the polytope with all its faces moved out by the gap
    fe_dvec3 normal;     // normal of the face that is entered
} passage;

// 0: the ray is never in this slab, or only after it has left another. A ray that comes in by no more than a touch is
// outside.
static int32_t clip_to_slab(const fe__approach *s, fe_dvec3 n, passage *p)
{
    double middle, e = extent(s, n, &middle), centre = fe__ddot(n, s->position) - middle,
                   rate = fe__ddot(n, s->translation);
    if (rate > 0.0) n = fe__dscale(-1.0, n), centre = -centre, rate = -rate; // n is against the motion.
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
