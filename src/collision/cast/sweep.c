// sweep.c - when a moving form meets a standing one; see sweep.h.
//
// The distance f(t) of two convex cores, one of them moving straight, is a convex function of t. So its tangent stays
// below it, and the step to where the tangent reaches the sum of the radii never goes too far: Newton's method from
// outside is conservative advancement with the best possible bound. It converges quadratically, and by halves where the
// forms graze. Two boxes have a closed form (sweep_boxes.c), so has a plane.
#include "collision/cast/sweep.h"

#include "collision/cast/approach.h"
#include "collision/cast/kinds.h"
#include "collision/form/hull_form.h"
#include "collision/form/support.h"

#include <string.h>

// Halving 10 km comes down to 1e-11 m; bodies that are met squarely need 3 to 6.
enum { MAX_STEPS = 64 };
#define ROUNDING 2e-15     // of the lengths involved: how well f is known
#define GAP_TOLERANCE 0.1f // of the gap: a stop within that of it is one

fe__axes fe__axes_of(fe_quat q)
{
    double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w,
           k = 2.0 / (x * x + y * y + z * z + w * w);
    double xx = k * x * x, yy = k * y * y, zz = k * z * z, xy = k * x * y, xz = k * x * z, yz = k * y * z;
    double wx = k * w * x, wy = k * w * y, wz = k * w * z;
    return (fe__axes){
        {1.0 - yy - zz, xy + wz, xz - wy},
        {xy - wz, 1.0 - xx - zz, yz + wx},
        {xz + wy, yz - wx, 1.0 - xx - yy},
    };
}

int32_t fe__core_kind_of(const fe__form *form) { return fe__casts[form->type].core; }

void fe__core_half(const fe__form *form, double half[3])
{
    half[0] = (double)form->half.x, half[1] = (double)form->half.y + (double)form->half_height,
    half[2] = (double)form->half.z;
}

// What keeps the bodies apart is never below what rounding may take.
static double size(fe_dvec3 a) { return fe__absd(a.x) + fe__absd(a.y) + fe__absd(a.z); }
double fe__stop_gap(const fe__mover *mover)
{
    return FE_SWEEP_GAP + ROUNDING * (size(mover->position) + size(mover->translation));
}
double fe__touch_of(const fe__mover *mover) { return FE_SWEEP_TOUCH + ROUNDING * size(mover->position); }

// 1: the mover gives the frame
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
    double half[3], length = sqrt(fe__ddot(n, n)); // 1 up to the rounding of floats
    fe__core_half(mover->form, half);
    fe_dvec3 down = fe__dscale(-1.0, fe__turn_back(&mover->axes, n));
    double e = fe__core_kind_of(mover->form) == FE_CORE_CURVED
                   ? fe__ddot(down, fe__form_support(mover->form, down))
                   : half[0] * fe__absd(fe__ddot(n, mover->axes.x)) + half[1] * fe__absd(fe__ddot(n, mover->axes.y)) +
                         half[2] * fe__absd(fe__ddot(n, mover->axes.z));
    return (fe__ddot(n, mover->position) - (double)plane->distance - e) / length - (double)mover->form->radius;
}

// In the approach's frame.
fe__core_overlap fe__approach_overlap(const fe__approach *s)
{
    fe__core_overlap o = {.gap = {0}};
    if (fe__is_curved_pair(s)) {
        fe__curved_gap_of(s, s->position, &o.gap);
        if (!(o.gap.distance > s->touch)) { // rounding alone gives the direction between nearer points
            o.depth = fe__curved_depth(s, &o.way_out, &o.gap) + s->radius;
            return o;
        }
    } else if (s->other_kind != FE_CORE_BOX)
        fe__core_gap_of(s, s->position, &o.gap);
    if (o.gap.distance > 0.0) {
        o.depth = s->radius - o.gap.distance;
        o.way_out = fe__dscale(1.0 / o.gap.distance, o.gap.away);
    } else {
        o.depth = fe__core_depth(s, &o.way_out) + s->radius;
        if (s->other_kind != FE_CORE_BOX) o.depth = fe__maxd(o.depth, s->radius); // cores that touch
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

// ---- sweeps --------------------------------------------------------------------------------------------------------
// Newton's method from `t` to where the distance is `goal`, to the left of it by at most `tolerance`. 0: it never comes
// so near until `limit`. `gap` is that at t, before and after.
static int32_t advance(const fe__approach *s, double goal, double tolerance, double limit, double *t, fe__core_gap *gap)
{
    for (int32_t i = 0;; ++i) {
        if (i > 0) fe__core_gap_of(s, fe__approach_at(s, *t), gap);
        double rate = fe__ddot(gap->away, s->translation) / gap->distance; // of the distance, m per t
        if (!(rate < 0.0)) return 0;
        if (gap->distance <= goal + tolerance || i == MAX_STEPS) return 1;
        *t += (gap->distance - goal) / -rate;
        if (!(*t <= limit)) return 0;
    }
}

// It stops where the gap begins, or at once within it; and only when it would come through half of that, for what
// slides along a surface must not stick to it by a rounding.
static int32_t sweep_round(const fe__approach *s, const fe__core_gap *start, double limit, fe__approach_hit *hit)
{
    double tolerance = (double)GAP_TOLERANCE * s->gap, t = 0.0, clearance;
    fe__core_gap gap = *start;
    fe_dvec3 first = fe__approach_at(s, 0.0);
    if (memcmp(&first, &s->position, sizeof first) != 0) fe__core_gap_of(s, first, &gap); // -0 became 0
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

// Forms that touch at the start meet at once or never. Being convex, they overlap from the start on if they overlap
// anywhere on the way, and what slides along or leaves overlaps nowhere. The overlap may end soon, so the way is asked
// at its end and at ever shorter parts of it.
static int32_t sweep_from_touch(const fe__approach *s, const fe__core_overlap *start, fe__approach_hit *hit)
{
    enum { PARTS = 24 };
    const double shorter = 0.25, deeper = 2.0; // in touches: the start may overlap by one
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

fe_dvec3 fe__point_of_plane(const fe__form *plane, fe_dvec3 unit, const fe__mover *mover)
{
    const fe__axes *m = &mover->axes;
    double half[3];
    fe__core_half(mover->form, half);
    fe_dvec3 low = fe__turn_back(m, unit), along = {low.x > 0.0   ? -half[0]
                                                    : low.x < 0.0 ? half[0]
                                                                  : 0.0,
                                                    low.y > 0.0   ? -half[1]
                                                    : low.y < 0.0 ? half[1]
                                                                  : 0.0,
                                                    low.z > 0.0   ? -half[2]
                                                    : low.z < 0.0 ? half[2]
                                                                  : 0.0};
    if (fe__core_kind_of(mover->form) == FE_CORE_CURVED) along = fe__form_support(mover->form, fe__dscale(-1.0, low));
    fe_dvec3 p = fe__dadd(mover->position, fe__turn(m, along)), n = fe__widen(plane->normal);
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

// From the approach's frame to the standing form's.
static void report(const fe__form *still, const fe__mover *mover, int32_t swapped, const fe__approach_hit *h,
                   fe__sweep_hit *hit)
{
    fe_dvec3 normal = h->normal, point = h->point;
    hit->t = h->t;
    if (swapped) {
        // the nearest point of the still core is beyond the gap from the mover's; both lie on one line along the normal
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

// Half widths of a box around the origin of a form that holds its core, m
static fe_dvec3 box_of_core(const fe__form *form)
{
    if (!fe__form_is_hull(form)) {
        double half[3];
        fe__core_half(form, half);
        return (fe_dvec3){half[0], half[1], half[2]};
    }
    const fe__hull *hull = form->hull;
    fe_dvec3 a = fe__from_hull(form, fe__widen(hull->low)), b = fe__from_hull(form, fe__widen(hull->high));
    return (fe_dvec3){fe__maxd(fe__absd(a.x), fe__absd(b.x)), fe__maxd(fe__absd(a.y), fe__absd(b.y)),
                      fe__maxd(fe__absd(a.z), fe__absd(b.z))};
}

// Of a hull, without asking for any distance
static int32_t passes_hull(const fe__form *still, const fe__mover *mover, double limit, double *out_from)
{
    const double per_scale = 1.0 / (double)still->scale,
                 clear = (double)mover->form->radius + 2.0 * fe__stop_gap(mover);
    fe_dvec3 half = box_of_core(mover->form);
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
