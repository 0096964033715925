// approach.c - nearest points of two cores: closed forms in double, in the frame of one of them.
//
// Input: the sweeps' pairs (sweep.c). Segments: Ericson, Real-Time Collision Detection, 5.1.9. Segment and box: the
// squared distance from a box along a line is convex and made of parabolas that meet where a coordinate crosses a side;
// bracket the zero of its slope between these.
#include "collision/cast/approach.h"

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
