// approach.c - nearest points and sweeps of two cores, in double, in the frame of one of them; see approach.h.
//
// Points, segments, boxes and triangles have closed forms. Hulls and forms with a rim are known by their support
// functions alone: GJK finds their distance and EPA their depth.
#include "collision/cast/approach.h"

#include "collision/form/gjk.h"

#include <string.h>

// ---- boxes and segments ---------------------------------------------------------------------------------------------
static double clamp(double x, double half) { return fe__mind(fe__maxd(x, -half), half); }
static double excess(double x, double half) { return x > half ? x - half : x < -half ? x + half : 0.0; }

// Below this squared sine two segments are parallel to the last digit.
#define PARALLEL 1e-30

// The u at which the segment  p + u a, |u| <= h,  a (unit) and p in the frame, is nearest to the frame's segment  v y,
// |v| <= k  (Ericson, Real-Time Collision Detection, 2005, 5.1.9):
//   d/du: u + a.p - v a.y = 0,   d/dv: v = p.y + u a.y
static double nearest_on_segments(const fe__approach *s, fe_dvec3 p)
{
    fe_dvec3 a = s->axes.y;
    double half = s->other_half[1], along = fe__ddot(a, p), square = a.x * a.x + a.z * a.z; // squared sine of the two
    double u = square > PARALLEL ? clamp((a.y * p.y - along) / square, half) : 0.0;
    double v = clamp(p.y + u * a.y, s->frame_half[1]);
    return clamp(v * a.y - along, half);
}

// The line  centre + u way  and a box about the origin.
typedef struct line {
    double centre[3], way[3];
    const double *half; // half widths of the box
} line;

// Half the slope of the line's squared distance from the box at u.
static double slope(const line *l, double u)
{
    double sum = 0.0;
    for (int32_t k = 0; k < 3; ++k) sum += l->way[k] * excess(l->centre[k] + u * l->way[k], l->half[k]);
    return sum;
}

// The u, |u| <= half, at which the line is nearest to the box. The squared distance is convex and made of parabolas
// that meet where a coordinate crosses a side: the zero of its slope is bracketed between these.
static double nearest_on_line(const line *l, double half)
{
    double low = -half, high = half, at_low = slope(l, low), at_high = slope(l, high);
    if (at_low >= 0.0) return low;
    if (at_high <= 0.0) return high;
    for (int32_t k = 0; k < 3; ++k) {
        if (l->way[k] == 0.0) continue;
        for (int32_t side = 0; side < 2; ++side) {
            double u = ((side ? l->half[k] : -l->half[k]) - l->centre[k]) / l->way[k];
            if (!(u > low && u < high)) continue;
            double at_u = slope(l, u);
            if (at_u == 0.0) return u;
            if (at_u < 0.0)
                low = u, at_low = at_u;
            else
                high = u, at_high = at_u;
        }
    }
    return low - at_low * ((high - low) / (at_high - at_low));
}

void fe__core_gap_of(const fe__approach *s, fe_dvec3 position, fe__core_gap *gap)
{
    if (s->frame_kind == FE_CORE_TRIANGLE) {
        fe__triangle_gap_of(s, position, gap);
        return;
    }
    double u = 0.0;
    if (s->other_kind != FE_CORE_POINT && s->frame_kind == FE_CORE_SEGMENT) {
        u = nearest_on_segments(s, position);
    } else if (s->other_kind != FE_CORE_POINT) {
        line l = {{position.x, position.y, position.z}, {s->axes.y.x, s->axes.y.y, s->axes.y.z}, s->frame_half};
        u = nearest_on_line(&l, s->other_half[1]);
    }
    fe_dvec3 q = fe__dadd(position, fe__dscale(u, s->axes.y));
    gap->on_frame =
        (fe_dvec3){clamp(q.x, s->frame_half[0]), clamp(q.y, s->frame_half[1]), clamp(q.z, s->frame_half[2])};
    gap->away = (fe_dvec3){excess(q.x, s->frame_half[0]), excess(q.y, s->frame_half[1]), excess(q.z, s->frame_half[2])};
    gap->distance = sqrt(fe__ddot(gap->away, gap->away));
}

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

// ---- a triangle and a point or a segment ----------------------------------------------------------------------------
void fe__nearest_on_segments(fe_dvec3 p, fe_dvec3 a, double half, fe_dvec3 q, fe_dvec3 b, double length, double *u,
                             double *w)
{
    fe_dvec3 r = fe__dsub(p, q), cross = fe__dcross(a, b);
    double cosine = fe__ddot(a, b), along_a = fe__ddot(a, r), along_b = fe__ddot(b, r), square = fe__ddot(cross, cross);
    double on_a = square > PARALLEL ? (cosine * along_b - along_a) / square : 0.0;
    on_a = fe__mind(fe__maxd(on_a, -half), half);
    *w = fe__mind(fe__maxd(along_b + on_a * cosine, 0.0), length);
    *u = fe__mind(fe__maxd(*w * cosine - along_a, -half), half);
}

// Is the point on the left of a side, seen from the tip of the normal? `from` leads from the side's start to the point.
static inline int32_t is_left(fe_dvec3 n, fe_dvec3 side, fe_dvec3 from)
{
    return !(fe__ddot(fe__dcross(n, side), from) < 0.0);
}

// Is the point on the left of all sides?
static int32_t is_over(const fe_dvec3 v[3], fe_dvec3 n, fe_dvec3 p)
{
    return is_left(n, fe__dsub(v[1], v[0]), fe__dsub(p, v[0])) && is_left(n, fe__dsub(v[2], v[1]), fe__dsub(p, v[1])) &&
           is_left(n, fe__dsub(v[0], v[2]), fe__dsub(p, v[2]));
}

typedef struct nearest {
    fe_dvec3 point;
    double square; // squared distance
} nearest;

static inline void ask_side(fe_dvec3 start, fe_dvec3 side, fe_dvec3 from, fe_dvec3 p, nearest *best)
{
    double t = fe__ddot(from, side) / fe__ddot(side, side);
    fe_dvec3 q = fe__dadd(start, fe__dscale(fe__mind(fe__maxd(t, 0.0), 1.0), side)), d = fe__dsub(p, q);
    double square = fe__ddot(d, d);
    if (square < best->square) *best = (nearest){q, square};
}

fe_dvec3 fe__nearest_on_triangle(const fe_dvec3 v[3], fe_dvec3 n, fe_dvec3 p)
{
    fe_dvec3 ab = fe__dsub(v[1], v[0]), bc = fe__dsub(v[2], v[1]), ca = fe__dsub(v[0], v[2]);
    fe_dvec3 a = fe__dsub(p, v[0]), b = fe__dsub(p, v[1]), c = fe__dsub(p, v[2]);
    if (is_left(n, ab, a) && is_left(n, bc, b) && is_left(n, ca, c)) return fe__dsub(p, fe__dscale(fe__ddot(n, a), n));
    nearest best = {v[0], (double)INFINITY};
    ask_side(v[0], ab, a, p, &best);
    ask_side(v[1], bc, b, p, &best);
    ask_side(v[2], ca, c, p, &best);
    return best.point;
}

static void keep_nearer(fe__core_gap *gap, fe_dvec3 on_triangle, fe_dvec3 on_other)
{
    fe_dvec3 away = fe__dsub(on_other, on_triangle);
    double distance = sqrt(fe__ddot(away, away));
    if (distance < gap->distance) *gap = (fe__core_gap){.distance = distance, .on_frame = on_triangle, .away = away};
}

// A segment that does not pierce the triangle is nearest to it at one of its ends or at one of the triangle's sides.
void fe__triangle_gap_of(const fe__approach *s, fe_dvec3 p, fe__core_gap *gap)
{
    const fe_dvec3 *v = s->vertex;
    fe_dvec3 n = s->normal, a = s->axes.y;
    if (s->other_kind != FE_CORE_SEGMENT) {
        gap->on_frame = fe__nearest_on_triangle(v, n, p);
        gap->away = fe__dsub(p, gap->on_frame);
        gap->distance = sqrt(fe__ddot(gap->away, gap->away));
        return;
    }
    double half = s->other_half[1], height = fe__ddot(n, fe__dsub(p, v[0])), slope = fe__ddot(n, a);
    if (fe__absd(height) <= half * fe__absd(slope) && slope != 0.0) {
        fe_dvec3 q = fe__dsub(p, fe__dscale(height / slope, a));
        if (is_over(v, n, q)) {
            *gap = (fe__core_gap){.on_frame = q};
            return;
        }
    }
    gap->distance = (double)INFINITY;
    for (int32_t end = -1; end <= 1; end += 2) {
        fe_dvec3 q = fe__dadd(p, fe__dscale((double)end * half, a));
        if (is_over(v, n, q)) keep_nearer(gap, fe__dsub(q, fe__dscale(fe__ddot(n, fe__dsub(q, v[0])), n)), q);
    }
    for (int32_t i = 0; i < 3; ++i) {
        fe_dvec3 side = fe__dsub(v[(i + 1) % 3], v[i]);
        double length = sqrt(fe__ddot(side, side)), u, w;
        fe_dvec3 b = fe__dscale(1.0 / length, side);
        fe__nearest_on_segments(p, a, half, v[i], b, length, &u, &w);
        keep_nearer(gap, fe__dadd(v[i], fe__dscale(w, b)), fe__dadd(p, fe__dscale(u, a)));
    }
}

// ---- curved cores: distances ----------------------------------------------------------------------------------------
// The nearest points are known to this share of the cores' size.
#define ROUNDINGS 1e-14
#define NEARLY_ALONG 0.9999 // cosine of a degree

static const fe__axes frame_axes = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

static fe__cores cores_at(const fe__approach *s, fe_dvec3 position)
{
    return (fe__cores){s->frame_form,
                       s->other_form,
                       position,
                       s->axes.x,
                       s->axes.y,
                       s->axes.z,
                       s->frame_kind == FE_CORE_TRIANGLE ? s->vertex : NULL};
}

static fe__core_gap gap_found(const fe__gjk *g)
{
    return (fe__core_gap){g->distance, g->on_a, g->way, g->size, g->apart_by};
}

static void gap_of(const fe__cores *cores, fe__core_gap *gap)
{
    fe__gjk gjk;
    fe__gjk_distance_closely(cores, &gjk);
    *gap = gap_found(&gjk);
}

void fe__curved_gap_of(const fe__approach *s, fe_dvec3 position, fe__core_gap *gap)
{
    fe__cores cores = cores_at(s, position);
    gap_of(&cores, gap);
}

// The cores are no nearer to each other than the planes across `n` (unit, from the frame to the other) that hold them.
// This is sure, whatever rounding made of the nearest points of a large form.
static double sure_distance(const fe__cores *cores, fe_dvec3 n)
{
    return -fe__ddot(n, fe__cores_support(cores, n).difference);
}

// Takes the axis, or its opposite, if it looks more along n than the best so far.
static void keep_nearest_axis(fe_dvec3 axis, fe_dvec3 n, fe_dvec3 *best)
{
    double cosine = fe__ddot(axis, n);
    if (fe__absd(cosine) > fe__absd(fe__ddot(*best, n))) *best = cosine < 0.0 ? fe__dscale(-1.0, axis) : axis;
}

// Caps, and faces of boxes, are flat sides that are known without rounding. Takes the one that looks most along n.
static void keep_nearest_side(int32_t type, const fe__axes *axes, fe_dvec3 n, fe_dvec3 *best)
{
    if (type == FE__FORM_BOX) {
        keep_nearest_axis(axes->x, n, best);
        keep_nearest_axis(axes->z, n, best);
    }
    if (type == FE__FORM_BOX || type == FE__FORM_CYLINDER || type == FE__FORM_CONE) keep_nearest_axis(axes->y, n, best);
}

// If the cores only just touch, EPA's polytope may have no face at that place: the flat sides are asked too, both ways.
// The point is the farthest along the side's normal on the form without the side.
static void try_sides(int32_t type, const fe__axes *axes, int32_t is_of_frame, const fe__cores *cores,
                      fe__penetration *found)
{
    const fe_dvec3 side[3] = {axes->y, axes->x, axes->z};
    int32_t count = type == FE__FORM_BOX ? 3 : type == FE__FORM_CYLINDER || type == FE__FORM_CONE ? 1 : 0;
    for (int32_t i = 0; i < 2 * count; ++i) {
        fe_dvec3 n = i & 1 ? fe__dscale(-1.0, side[i / 2]) : side[i / 2];
        fe__vertex w = fe__cores_support(cores, n);
        double depth = fe__ddot(n, w.difference);
        fe_dvec3 point = is_of_frame ? fe__dadd(fe__dsub(w.on_a, w.difference), fe__dscale(depth, n)) : w.on_a;
        if (depth < found->depth) *found = (fe__penetration){n, fe__maxd(depth, 0.0), point, point};
    }
}

double fe__curved_depth(const fe__approach *s, fe_dvec3 *way_out, fe__core_gap *gap)
{
    fe__cores cores = cores_at(s, s->position);
    fe__gjk gjk;
    fe__gjk_distance_closely(&cores, &gjk);
    fe__penetration p = fe__epa_depth(&cores, &gjk);
    if (s->frame_kind != FE_CORE_TRIANGLE) try_sides(s->frame_form->type, &frame_axes, 1, &cores, &p);
    try_sides(s->other_form->type, &s->axes, 0, &cores, &p);
    *way_out = p.normal, gap->on_frame = p.on_a;
    return p.depth;
}

// A rounding e of the nearest points turns a way d between them by e / d, far more than it turns a side of one of the
// two. So if a side near to it holds the cores apart by more, the side gives the direction. It also does if the nearest
// points are wrong: that is so if the distance exceeds its lower bound by more than such a turn takes of the size.
// Returns the distance if it is sound, else its lower bound.
static double make_sure(const fe__approach *s, const fe__cores *cores, fe__core_gap *gap)
{
    double size = gap->size, least = gap->distance - ROUNDINGS * size * (size / gap->distance);
    fe_dvec3 n = fe__dscale(1.0 / gap->distance, gap->away), side = {0.0, 0.0, 0.0};
    if (s->frame_kind == FE_CORE_TRIANGLE)
        keep_nearest_axis(s->normal, n, &side);
    else
        keep_nearest_side(s->frame_form->type, &frame_axes, n, &side);
    keep_nearest_side(s->other_form->type, &s->axes, n, &side);
    int32_t is_along = fe__ddot(side, n) > NEARLY_ALONG;
    if (!is_along && gap->apart_by >= least) return gap->distance; // GJK has met a plane that shows the distance.
    double sure = sure_distance(cores, n);
    if ((sure < least && fe__ddot(side, side) > 0.0) || is_along) { // Two hulls have no side that is known.
        double by_side = sure_distance(cores, side);
        if (by_side > sure) sure = by_side, gap->away = fe__dscale(gap->distance, side);
    }
    return sure >= least ? gap->distance : sure;
}

double fe__sure_gap_of(const fe__approach *s, fe_dvec3 position, fe__core_gap *gap)
{
    fe__cores cores = cores_at(s, position);
    gap_of(&cores, gap);
    return gap->distance > 0.0 ? make_sure(s, &cores, gap) : 0.0;
}

double fe__separation_of(const fe__approach *s, fe_dvec3 position, fe_dvec3 n)
{
    fe__cores cores = cores_at(s, position);
    return sure_distance(&cores, n);
}

// ---- curved cores: sweeps -------------------------------------------------------------------------------------------
// Conservative advancement. As for the other cores, the distance is a convex function of the way, and its tangent never
// goes too far.
enum { MAX_STEPS = 64 };
// A stop is accepted if it misses the gap by no more than this share of it.
#define TOLERANCE 0.1

typedef struct sure_gap {
    fe__core_gap gap;
    double sure; // lower bound of the distance
} sure_gap;

// The nearest points on the way of a sweep. Between forms with corners alone, a hull among them, each search begins
// with the points that were nearest before: mostly they still are. A rim's supports come so near to each other that the
// last ones say little.
typedef struct gap_tracker {
    const fe__approach *pair;
    int32_t has_corners; // The forms have corners alone.
    int32_t is_known;    // `gjk` is the result at `position`.
    fe_dvec3 position;
    fe__gjk gjk;
} gap_tracker;

static gap_tracker track(const fe__approach *s)
{
    int32_t has_rim =
        (s->frame_kind != FE_CORE_TRIANGLE && fe__form_is_curved(s->frame_form)) || fe__form_is_curved(s->other_form);
    return (gap_tracker){.pair = s, .has_corners = !has_rim};
}

static sure_gap gap_at(gap_tracker *tracker, double t)
{
    fe_dvec3 position = fe__approach_at(tracker->pair, t);
    fe__cores cores = cores_at(tracker->pair, position);
    if (tracker->is_known)
        fe__gjk_distance_closely_after(&cores, fe__dsub(position, tracker->position), &tracker->gjk);
    else
        fe__gjk_distance_closely(&cores, &tracker->gjk);
    tracker->is_known = tracker->has_corners, tracker->position = position;
    sure_gap found = {.gap = gap_found(&tracker->gjk)};
    found.sure = found.gap.distance > 0.0 ? make_sure(tracker->pair, &cores, &found.gap) : 0.0;
    return found;
}

// Goes from `t` to the place where the distance is `goal`, or a little more. 0: the cores never come so near. `gap` is
// the gap at t, before and after. If GJK finds a distance too long, the step goes too far: then the way from the last
// place where the cores were apart is halved.
static int32_t advance(gap_tracker *tracker, double goal, double tolerance, double *t, sure_gap *gap)
{
    const fe__approach *s = tracker->pair;
    double apart = *t, inside = (double)INFINITY;
    sure_gap here = *gap;
    for (int32_t i = 0;; ++i) {
        if (i > 0) here = gap_at(tracker, *t);
        if (i == 0 && !(here.gap.distance > 0.0)) return 1;
        if (i > 0 && !(here.gap.distance > s->radius)) {
            inside = *t;
        } else {
            double way = here.sure - goal;
            *gap = here;
            double rate = fe__ddot(here.gap.away, s->translation) / here.gap.distance; // m per t
            if (!(rate < 0.0)) return inside <= 1.0; // They do meet if a later place was inside.
            if (here.gap.distance <= goal + tolerance || !(way > 0.0)) return 1;
            apart = *t;
            *t += way / -rate;
        }
        if (i >= MAX_STEPS) {
            *t = apart;
            return 1;
        }
        if (!(*t < inside)) *t = 0.5 * (apart + inside);
        if (!(*t <= 1.0)) return 0;
    }
}

// The stop is a gap before the other form. It counts only if the cores come nearer still: by half of what is left.
static int32_t sweep_on(gap_tracker *tracker, double t, sure_gap *gap, double limit, fe__approach_hit *hit)
{
    const fe__approach *s = tracker->pair;
    if (!advance(tracker, s->radius + s->gap, TOLERANCE * s->gap, &t, gap) || !(t <= limit)) return 0;
    double distance = gap->gap.distance, clearance = fe__mind(distance - s->radius, s->gap);
    *hit = (fe__approach_hit){t, fe__dscale(1.0 / distance, gap->gap.away), gap->gap.on_frame};
    return advance(tracker, s->radius + 0.5 * clearance, TOLERANCE * clearance, &t, gap);
}

int32_t fe__curved_sweep(const fe__approach *s, const fe__core_gap *start, double limit, fe__approach_hit *hit)
{
    gap_tracker tracker = track(s);
    // GJK would find the same gap again if  position + 0 translation  has the position's bits.
    fe_dvec3 position = fe__approach_at(s, 0.0);
    if (memcmp(&position, &s->position, sizeof position) != 0) {
        sure_gap gap = gap_at(&tracker, 0.0);
        return sweep_on(&tracker, 0.0, &gap, limit, hit);
    }
    fe__cores cores = cores_at(s, position);
    sure_gap gap = {.gap = *start};
    gap.sure = make_sure(s, &cores, &gap.gap);
    return sweep_on(&tracker, 0.0, &gap, limit, hit);
}

int32_t fe__curved_sweep_from(const fe__approach *s, double from, double limit, fe__approach_hit *hit)
{
    gap_tracker tracker = track(s);
    sure_gap gap = gap_at(&tracker, from);
    if (!(gap.sure > s->radius + s->gap)) return -1;
    return sweep_on(&tracker, from, &gap, limit, hit);
}
