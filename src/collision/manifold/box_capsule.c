// box_capsule.c - box against capsule: the nearest points of box and core; two points where the core lies along a face
// or an edge.
//
// A kernel of collide.c's table; A is the box. A core that cuts the box has no nearest point and goes the general way
// (convex.c).
//
// The core is c + t e, |t| <= 1. Half the slope of its squared distance from the box,
//   f(t) = sum_k e_k over(c_k + t e_k, h_k),   over(x, h) = what x exceeds +-h by,
// never falls and is linear between the at most six t where a coordinate crosses +-h_k: bracket its zero between these,
// then one division.
#include "collision/manifold/kernels.h"

typedef struct core {
    float half[3];   // of the box
    float centre[3]; // c
    float reach[3];  // e
    float radius;
} core;

static inline float over(float x, float h) { return x > h ? x - h : x < -h ? x + h : 0.0f; }

static inline float slope(const core *q, float t)
{
    float f = q->reach[0] * over(q->centre[0] + t * q->reach[0], q->half[0]);
    f += q->reach[1] * over(q->centre[1] + t * q->reach[1], q->half[1]);
    return f + q->reach[2] * over(q->centre[2] + t * q->reach[2], q->half[2]);
}

// The nearest t. Where a whole stretch is nearest, either end of it may come; lay_on_face and lay_on_edge then find
// both.
static float nearest_on_core(const core *q)
{
    float low = -1.0f, high = 1.0f, at_low = slope(q, low), at_high = slope(q, high);
    if (at_low >= 0.0f) return low;
    if (at_high <= 0.0f) return high;
    for (int32_t k = 0; k < 3; ++k) {
        if (q->reach[k] == 0.0f) continue;
        float inverse = 1.0f / q->reach[k];
        for (int32_t side = 0; side < 2; ++side) {
            float t = ((side ? q->half[k] : -q->half[k]) - q->centre[k]) * inverse;
            if (!(t > low && t < high)) continue;
            float f = slope(q, t);
            if (f < 0.0f)
                low = t, at_low = f;
            else
                high = t, at_high = f;
        }
    }
    return at_high > at_low ? low - at_low * (high - low) / (at_high - at_low) : low;
}

// Two points on face k, where the core enters and leaves the space before it. Nothing when a deeper part of the core
// hangs over the rim.
static int32_t lay_on_face(const core *q, int32_t k, float side, float separation, float margin, fe__manifold *manifold)
{
    float t[2] = {-1.0f, 1.0f};
    for (int32_t i = 0; i < 3; ++i) {
        if (i == k || q->reach[i] == 0.0f) continue;
        float inverse = 1.0f / q->reach[i], p = (-q->half[i] - q->centre[i]) * inverse,
              r = (q->half[i] - q->centre[i]) * inverse;
        t[0] = fe__maxf(t[0], fe__minf(p, r));
        t[1] = fe__minf(t[1], fe__maxf(p, r));
    }
    // where the core stands upright both ends are over one place, but only the lower is within the margin
    if (t[0] > t[1]) return 0;
    float end[2];
    for (int32_t i = 0; i < 2; ++i) end[i] = side * (q->centre[k] + t[i] * q->reach[k]) - q->half[k] - q->radius;
    if (fe__minf(end[0], end[1]) > fe__minf(separation + fe__tie(q->radius), margin)) return 0;
    float normal[3] = {0.0f, 0.0f, 0.0f};
    normal[k] = side;
    manifold->normal = fe__vec3(normal[0], normal[1], normal[2]);
    for (int32_t i = 0; i < 2; ++i) {
        if (end[i] > margin) continue;
        float p[3] = {q->centre[0] + t[i] * q->reach[0], q->centre[1] + t[i] * q->reach[1],
                      q->centre[2] + t[i] * q->reach[2]};
        p[k] = side * (q->half[k] + 0.5f * end[i]);
        fe__add_point(manifold, fe__vec3(p[0], p[1], p[2]), end[i], (uint32_t)(k << 2 | (side > 0.0f) << 1 | i));
    }
    return manifold->count;
}

// The nearest point lies on the edge along axis k, at the signs of d across it: on that edge or beyond it by no more
// than a rounding.
static int32_t lay_on_edge(const core *q, int32_t k, const float d[3], fe_vec3 n, fe_vec3 nearest, float separation,
                           float margin, fe__manifold *manifold)
{
    float centre[3], half[3] = {0.0f, 0.0f, 0.0f};
    for (int32_t i = 0; i < 3; ++i) centre[i] = i == k ? 0.0f : d[i] > 0.0f ? q->half[i] : -q->half[i];
    half[k] = q->half[k];
    fe__segment edge = {{centre[0], centre[1], centre[2]}, {half[0], half[1], half[2]}, 0.0f};
    fe__segment core = {{q->centre[0], q->centre[1], q->centre[2]}, {q->reach[0], q->reach[1], q->reach[2]}, q->radius};
    return fe__lay_segments(&edge, &core, n, nearest, separation, margin, manifold);
}

// The ids: 0..11 on faces (axis, side, end); 16 the nearest point, 17, 18 ends along an edge, from fe__lay_segments.
enum { NEAREST_ID = 16 };

static void touch_outside(const core *q, float t, const float d[3], float distance, float margin,
                          fe__manifold *manifold)
{
    float separation = distance - q->radius;
    int32_t most = 0, least = 0;
    for (int32_t i = 1; i < 3; ++i) {
        if (fe__absf(d[i]) > fe__absf(d[most])) most = i;
        if (fe__absf(d[i]) < fe__absf(d[least])) least = i;
    }
    if (fe__absf(d[most]) > FE_FACE_COS * distance &&
        lay_on_face(q, most, d[most] > 0.0f ? 1.0f : -1.0f, separation, margin, manifold))
        return;
    fe_vec3 n = fe__direction(fe__vec3(d[0], d[1], d[2]), distance);
    fe_vec3 p = {q->centre[0] + t * q->reach[0], q->centre[1] + t * q->reach[1], q->centre[2] + t * q->reach[2]};
    p = fe__add_scaled(p, -(q->radius + 0.5f * separation), n);
    const float beyond_edge =
        0.01f; // of the distance: where the core leaves the edge's end, rounding may call it beyond
    if (fe__absf(d[least]) < beyond_edge * distance && lay_on_edge(q, least, d, n, p, separation, margin, manifold)) {
        for (int32_t i = 0; i < manifold->count; ++i) manifold->points[i].id += NEAREST_ID;
        return;
    }
    manifold->normal = n;
    fe__add_point(manifold, p, separation, NEAREST_ID);
}

void fe__collide_box_capsule(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                             fe__manifold *manifold)
{
    fe_vec3 c = b_in_a->position, e = fe__scale(b->half_height, b_in_a->rotation.y);
    core q = {{a->half.x, a->half.y, a->half.z}, {c.x, c.y, c.z}, {e.x, e.y, e.z}, b->radius};
    float t = nearest_on_core(&q), d[3], square = 0.0f, limit = b->radius + margin;
    for (int32_t i = 0; i < 3; ++i) {
        d[i] = over(q.centre[i] + t * q.reach[i], q.half[i]);
        square += d[i] * d[i];
    }
    if (square > limit * limit) {
        float distance = sqrtf(square);
        fe__stay_apart(manifold, distance - b->radius, fe__direction(fe__vec3(d[0], d[1], d[2]), distance));
        return;
    }
    // Nearer than 1/100 of the radius, rounding (of c, against large boxes) starts to turn d: the general way computes
    // in double.
    float clear = 0.01f * b->radius;
    if (square > clear * clear)
        touch_outside(&q, t, d, sqrtf(square), margin, manifold);
    else
        fe__collide_convex(a, b, b_in_a, margin, manifold);
}
