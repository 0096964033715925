// approach.c - nearest points of two cores: closed forms in double, in the frame of one of them.
//
// Input: the sweeps' pairs (sweep.c). Segments: Ericson, Real-Time Collision Detection, 5.1.9. Segment and box: the
// squared distance from a box along a line is convex and made of parabolas that meet where a coordinate crosses a side;
// bracket the zero of its slope between these.
#include "collision/cast/approach.h"

#include "collision/form/gjk.h"

#include <string.h>

// ---- approach -------------------------------------------------------------------------------------------------------

static double clamp(double x, double half) { return fe__mind(fe__maxd(x, -half), half); }
static double excess(double x, double half) { return x > half ? x - half : x < -half ? x + half : 0.0; }

// Below this squared sine two segments are parallel to the last digit.
#define PARALLEL 1e-30

// Where on the segment  p + u a, |u| <= h,  a (unit) and p in the frame, it is nearest to the frame's segment  v y, |v|
// <= k:
//   d/du: u + a.p - v a.y = 0,   d/dv: v = p.y + u a.y
static double nearest_on_segments(const fe__approach *s, fe_dvec3 p)
{
    fe_dvec3 a = s->axes.y;
    double half = s->other_half[1], along = fe__ddot(a, p), square = a.x * a.x + a.z * a.z; // of the sine between them
    double u = square > PARALLEL ? clamp((a.y * p.y - along) / square, half) : 0.0;
    double v = clamp(p.y + u * a.y, s->frame_half[1]);
    return clamp(v * a.y - along, half);
}

typedef struct line {
    double centre[3], reach[3]; // c + u e
    const double *half;         // of the box
} line;

// half the slope of the squared distance
static double slope(const line *l, double u)
{
    double sum = 0.0;
    for (int32_t k = 0; k < 3; ++k) sum += l->reach[k] * excess(l->centre[k] + u * l->reach[k], l->half[k]);
    return sum;
}

static double nearest_on_line(const line *l, double half)
{
    double low = -half, high = half, at_low = slope(l, low), at_high = slope(l, high);
    if (at_low >= 0.0) return low;
    if (at_high <= 0.0) return high;
    for (int32_t k = 0; k < 3; ++k) {
        if (l->reach[k] == 0.0) continue;
        for (int32_t side = 0; side < 2; ++side) {
            double u = ((side ? l->half[k] : -l->half[k]) - l->centre[k]) / l->reach[k];
            if (!(u > low && u < high)) continue;
            double at = slope(l, u);
            if (at == 0.0) return u;
            if (at < 0.0)
                low = u, at_low = at;
            else
                high = u, at_high = at;
        }
    }
    return low - at_low * ((high - low) / (at_high - at_low));
}

static double nearest_on_other(const fe__approach *s, fe_dvec3 p)
{
    if (s->other_kind == FE_CORE_POINT) return 0.0;
    if (s->frame_kind == FE_CORE_SEGMENT) return nearest_on_segments(s, p);
    line l = {{p.x, p.y, p.z}, {s->axes.y.x, s->axes.y.y, s->axes.y.z}, s->frame_half};
    return nearest_on_line(&l, s->other_half[1]);
}

void fe__core_gap_of(const fe__approach *s, fe_dvec3 position, fe__core_gap *gap)
{
    if (s->frame_kind == FE_CORE_TRIANGLE) {
        fe__triangle_gap_of(s, position, gap);
        return;
    }
    double u = nearest_on_other(s, position);
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

// ---- approach triangle ----------------------------------------------------------------------------------------------
// Nearest points of a triangle and a point or a segment, in double.
//
// Input: the triangles of heightfields near a moving form (sweep_field.c). A segment that does not pierce the triangle
// is nearest to it at one of its ends or at one of the triangle's sides.

// Below this squared sine two segments are parallel to the last digit.

void fe__nearest_on_segments(fe_dvec3 p, fe_dvec3 a, double half, fe_dvec3 q, fe_dvec3 b, double length, double *u,
                             double *w)
{
    fe_dvec3 r = fe__dsub(p, q), cross = fe__dcross(a, b);
    double cosine = fe__ddot(a, b), along_a = fe__ddot(a, r), along_b = fe__ddot(b, r), square = fe__ddot(cross, cross);
    double at = square > PARALLEL ? (cosine * along_b - along_a) / square : 0.0;
    at = fe__mind(fe__maxd(at, -half), half);
    *w = fe__mind(fe__maxd(along_b + at * cosine, 0.0), length);
    *u = fe__mind(fe__maxd(*w * cosine - along_a, -half), half);
}

// Left of a side, seen from where the normal points; `from`: from the side's start to the point
static inline int32_t is_left(fe_dvec3 n, fe_dvec3 side, fe_dvec3 from)
{
    return !(fe__ddot(fe__dcross(n, side), from) < 0.0);
}

// Left of all sides
static int32_t is_over(const fe_dvec3 v[3], fe_dvec3 n, fe_dvec3 p)
{
    return is_left(n, fe__dsub(v[1], v[0]), fe__dsub(p, v[0])) && is_left(n, fe__dsub(v[2], v[1]), fe__dsub(p, v[1])) &&
           is_left(n, fe__dsub(v[0], v[2]), fe__dsub(p, v[2]));
}

typedef struct nearest {
    fe_dvec3 point;
    double square; // of the distance
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

// The ends where they are over the triangle, the piercing point, the three sides.
static void segment_gap(const fe__approach *s, fe_dvec3 p, fe__core_gap *gap)
{
    const fe_dvec3 *v = s->vertex;
    fe_dvec3 n = s->normal, a = s->axes.y;
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

void fe__triangle_gap_of(const fe__approach *s, fe_dvec3 position, fe__core_gap *gap)
{
    if (s->other_kind == FE_CORE_SEGMENT) {
        segment_gap(s, position, gap);
        return;
    }
    gap->on_frame = fe__nearest_on_triangle(s->vertex, s->normal, position);
    gap->away = fe__dsub(position, gap->on_frame);
    gap->distance = sqrt(fe__ddot(gap->away, gap->away));
}

// ---- approach curved ------------------------------------------------------------------------------------------------
// Sweeps and overlaps of what its support function alone describes, a cylinder, a cone or a hull,
// with anything that has a core.
//
// Nearest points by GJK and depths by EPA, in the frame of the approach. As for the other forms the distance is a
// convex function of the way, and its tangent never goes too far.

enum { MAX_STEPS = 64 };
#define TOLERANCE 0.1       // of the gap: a stop within that of it is one
#define ROUNDINGS 1e-14     // of the cores' size: how well the nearest points are known
#define NEARLY_ALONG 0.9999 // a direction within a degree

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

// ---- planes that hold the two apart ---------------------------------------------------------------------------------
// The cores are no nearer than the planes across `n` (unit, from the frame to the other) that hold them: what is sure
// of a distance, whatever rounding made of the nearest points of a large form.
static double sure_distance(const fe__cores *cores, fe_dvec3 n)
{
    return -fe__ddot(n, fe__cores_support(cores, n).difference);
}

static void keep_nearest_axis(fe_dvec3 axis, fe_dvec3 n, fe_dvec3 *best)
{
    double cosine = fe__ddot(axis, n);
    if (fe__absd(cosine) > fe__absd(fe__ddot(*best, n))) *best = cosine < 0.0 ? fe__dscale(-1.0, axis) : axis;
}

// Of the flat sides that are known without rounding the one that looks most along n: caps, and faces of boxes
static void keep_nearest_side(int32_t type, const fe__axes *axes, fe_dvec3 n, fe_dvec3 *best)
{
    if (type == FE__FORM_BOX) {
        keep_nearest_axis(axes->x, n, best);
        keep_nearest_axis(axes->z, n, best);
    }
    if (type == FE__FORM_BOX || type == FE__FORM_CYLINDER || type == FE__FORM_CONE) keep_nearest_axis(axes->y, n, best);
}

// Where the cores only just touch, the polytope around their difference may have no face there: the flat sides are
// asked too, both ways. The point is that which the one without the side has farthest along it.
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
    static const fe__axes own = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    fe__cores cores = cores_at(s, s->position);
    fe__gjk gjk;
    fe__gjk_distance_closely(&cores, &gjk);
    fe__penetration p = fe__epa_depth(&cores, &gjk);
    if (s->frame_kind != FE_CORE_TRIANGLE) try_sides(s->frame_form->type, &own, 1, &cores, &p);
    try_sides(s->other_form->type, &s->axes, 0, &cores, &p);
    *way_out = p.normal, gap->on_frame = p.on_a;
    return p.depth;
}

static fe_dvec3 nearest_side(const fe__approach *s, fe_dvec3 n)
{
    static const fe__axes own = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    fe_dvec3 best = {0.0, 0.0, 0.0};
    if (s->frame_kind == FE_CORE_TRIANGLE)
        keep_nearest_axis(s->normal, n, &best);
    else
        keep_nearest_side(s->frame_form->type, &own, n, &best);
    keep_nearest_side(s->other_form->type, &s->axes, n, &best);
    return best;
}

// A rounding e of the nearest points turns a way d between them by e / d, far more than it turns a side of one of the
// two. So where a side near it holds them apart by more, it gives the direction; and it does where the nearest points
// are none, because more than that turn takes of the size is between their distance and what is sure of it. Returns the
// distance, then what is sure of it.
static double make_sure(const fe__approach *s, const fe__cores *cores, fe__core_gap *gap)
{
    double size = gap->size, least = gap->distance - ROUNDINGS * size * (size / gap->distance);
    fe_dvec3 n = fe__dscale(1.0 / gap->distance, gap->away), side = nearest_side(s, n);
    int32_t is_along = fe__ddot(side, n) > NEARLY_ALONG;
    if (!is_along && gap->apart_by >= least) return gap->distance; // GJK has met a plane that shows it
    double sure = sure_distance(cores, n);
    if ((sure < least && fe__ddot(side, side) > 0.0) || is_along) { // two hulls have no side that is known
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

typedef struct sure_gap {
    fe__core_gap gap;
    double sure; // of its distance
} sure_gap;

// A sweep's looks at the two, one after the other. Forms with corners alone, a hull among them, are looked at from what
// was nearest before: mostly it still is. A rim's supports come so near to each other that the last ones say little.
typedef struct looks {
    const fe__approach *pair;
    int32_t follows, is_known;
    fe_dvec3 position; // of the last look
    fe__gjk gjk;
} looks;

static looks looks_of(const fe__approach *s)
{
    int32_t has_rim =
        (s->frame_kind != FE_CORE_TRIANGLE && fe__form_is_curved(s->frame_form)) || fe__form_is_curved(s->other_form);
    return (looks){.pair = s, .follows = !has_rim};
}

static sure_gap look_at(looks *l, double t)
{
    fe_dvec3 position = fe__approach_at(l->pair, t);
    fe__cores cores = cores_at(l->pair, position);
    if (l->is_known)
        fe__gjk_distance_closely_after(&cores, fe__dsub(position, l->position), &l->gjk);
    else
        fe__gjk_distance_closely(&cores, &l->gjk);
    l->is_known = l->follows, l->position = position;
    sure_gap here = {.gap = gap_found(&l->gjk)};
    here.sure = here.gap.distance > 0.0 ? make_sure(l->pair, &cores, &here.gap) : 0.0;
    return here;
}

// What GJK found at the start is what it would find again, where position + 0 translation has the position's bits.
static sure_gap look_at_start(looks *l, const fe__core_gap *known)
{
    fe_dvec3 start = fe__approach_at(l->pair, 0.0);
    if (memcmp(&start, &l->pair->position, sizeof start) != 0) return look_at(l, 0.0);
    fe__cores cores = cores_at(l->pair, start);
    sure_gap here = {.gap = *known};
    here.sure = make_sure(l->pair, &cores, &here.gap);
    return here;
}

// From `t` to where the distance is `goal`, or a little more. 0: it never comes so near. A distance that GJK finds too
// long takes a step too far: then the way from where they were apart is halved. `at` is the gap at t, before and after.
static int32_t advance(looks *l, double goal, double tolerance, double *t, sure_gap *at)
{
    const fe__approach *s = l->pair;
    double apart = *t, inside = (double)INFINITY;
    sure_gap here = *at;
    for (int32_t i = 0;; ++i) {
        if (i > 0) here = look_at(l, *t);
        if (i == 0 && !(here.gap.distance > 0.0)) return 1;
        if (i > 0 && !(here.gap.distance > s->radius)) {
            inside = *t;
        } else {
            double way = here.sure - goal;
            *at = here;
            double rate = fe__ddot(here.gap.away, s->translation) / here.gap.distance; // of the distance, m per t
            if (!(rate < 0.0)) return inside <= 1.0;                                   // then they do meet
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

static int32_t sweep_on(looks *l, double t, sure_gap *at, double limit, fe__approach_hit *hit)
{
    const fe__approach *s = l->pair;
    if (!advance(l, s->radius + s->gap, TOLERANCE * s->gap, &t, at) || !(t <= limit)) return 0;
    double distance = at->gap.distance, clearance = fe__mind(distance - s->radius, s->gap);
    *hit = (fe__approach_hit){t, fe__dscale(1.0 / distance, at->gap.away), at->gap.on_frame};
    return advance(l, s->radius + 0.5 * clearance, TOLERANCE * clearance, &t, at);
}

int32_t fe__curved_sweep(const fe__approach *s, const fe__core_gap *start, double limit, fe__approach_hit *hit)
{
    looks l = looks_of(s);
    sure_gap at = look_at_start(&l, start);
    return sweep_on(&l, 0.0, &at, limit, hit);
}

int32_t fe__curved_sweep_from(const fe__approach *s, double from, double limit, fe__approach_hit *hit)
{
    looks l = looks_of(s);
    sure_gap at = look_at(&l, from);
    if (!(at.sure > s->radius + s->gap)) return -1;
    return sweep_on(&l, from, &at, limit, hit);
}
