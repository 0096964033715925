// approach_triangle.c - nearest points of a triangle and a point or a segment, in double.
//
// Input: the triangles of heightfields near a moving form (sweep_field.c). A segment that does not pierce the triangle
// is nearest to it at one of its ends or at one of the triangle's sides.
#include "collision/cast/approach.h"

// Below this squared sine two segments are parallel to the last digit.
#define PARALLEL 1e-30

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
