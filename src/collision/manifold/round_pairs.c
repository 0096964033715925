// round_pairs.c - box against sphere: the nearest point of the box to the centre, exact but for rounding.
//
// A kernel of collide.c's table; A is the box. Each difference below is of neighbouring floats, hence without error
// (Sterbenz), whenever the centre is near the surface: the normal is as good from 1 micrometre as from 1 metre.
#include "collision/manifold/pair_kernels.h"

// ---- box sphere -----------------------------------------------------------------------------------------------------

// The centre is inside: out through the nearest face, of equal ones that of the lowest axis.
static void leave_box(const fe__form *box, fe_vec3 c, float radius, fe__manifold *manifold)
{
    const float depth[3] = {box->half.x - fe__absf(c.x), box->half.y - fe__absf(c.y), box->half.z - fe__absf(c.z)};
    const fe_vec3 out[3] = {{c.x < 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f},
                            {0.0f, c.y < 0.0f ? -1.0f : 1.0f, 0.0f},
                            {0.0f, 0.0f, c.z < 0.0f ? -1.0f : 1.0f}};
    int32_t k = 0;
    for (int32_t i = 1; i < 3; ++i) {
        if (depth[i] < depth[k]) k = i;
    }
    manifold->normal = out[k];
    fe__add_point(manifold, fe__add_scaled(c, 0.5f * (depth[k] - radius), out[k]), -depth[k] - radius, 0);
}

void fe__collide_box_sphere(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                            fe__manifold *manifold)
{
    fe_vec3 c = b_in_a->position, h = a->half;
    fe_vec3 nearest = {fe__clampf(c.x, -h.x, h.x), fe__clampf(c.y, -h.y, h.y), fe__clampf(c.z, -h.z, h.z)},
            d = fe__sub(c, nearest);
    float square = fe__dot(d, d), limit = b->radius + margin;
    if (square > limit * limit) {
        float distance = sqrtf(square);
        fe__stay_apart(manifold, distance - b->radius, fe__direction(d, distance));
        return;
    }
    if (!(square > 0.0f)) {
        leave_box(a, c, b->radius, manifold);
        return;
    }
    float distance = sqrtf(square), separation = distance - b->radius;
    manifold->normal = fe__direction(d, distance);
    fe__add_point(manifold, fe__add_scaled(nearest, 0.5f * separation, manifold->normal), separation, 0);
}

// ---- box capsule ----------------------------------------------------------------------------------------------------
// Box against capsule: the nearest points of box and core; two points where the core lies along a face
// or an edge.
//
// A kernel of collide.c's table; A is the box. A core that cuts the box has no nearest point and goes the general way
// (convex.c).
//
// The core is c + t e, |t| <= 1. Half the slope of its squared distance from the box,
//   f(t) = sum_k e_k over(c_k + t e_k, h_k),   over(x, h) = what x exceeds +-h by,
// never falls and is linear between the at most six t where a coordinate crosses +-h_k: bracket its zero between these,
// then one division.

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

// ---- capsule --------------------------------------------------------------------------------------------------------
// Capsule against sphere and capsule: the nearest points of the cores, and the ends of the stretch where
// they run side by side.
//
// Kernels of collide.c's table; A is a capsule, its core the segment |y| <= half height. Source of the nearest points:
// Ericson, Real-Time Collision Detection, 5.1.9, simplified because one segment lies on an axis.

void fe__collide_capsule_sphere(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                                fe__manifold *manifold)
{
    float y = fe__clampf(b_in_a->position.y, -a->half_height, a->half_height);
    fe_vec3 d = {b_in_a->position.x, b_in_a->position.y - y, b_in_a->position.z};
    float distance = fe__length(d), separation = distance - a->radius - b->radius;
    if (separation > margin) {
        fe__stay_apart(manifold, separation, fe__direction(d, distance));
        return;
    }
    manifold->normal = fe__direction(d, distance);
    fe__add_point(manifold, fe__add_scaled(fe__vec3(0.0f, y, 0.0f), a->radius + 0.5f * separation, manifold->normal),
                  separation, 0);
}

// Nearest points (0, s, 0), |s| <= half, and c + t e, |t| <= reach, e of length 1. Seen along y the lines are nearest
// where (c + t e) . (ex, 0, ez) = 0; no difference of large terms, however near to parallel. Parallel ones meet amid
// their common stretch.
static float nearest_segments(float half, fe_vec3 c, fe_vec3 e, float reach, float *t)
{
    const float parallel = 1e-12f; // sin^2: below it float cannot tell the direction across
    float across = e.x * e.x + e.z * e.z;
    if (across > parallel) {
        *t = fe__clampf(-(c.x * e.x + c.z * e.z) / across, -reach, reach);
    } else {
        float low = fe__maxf(c.y - reach, -half), high = fe__minf(c.y + reach, half);
        *t = fe__clampf((0.5f * (low + high) - c.y) * e.y, -reach, reach);
    }
    float s = c.y + *t * e.y;
    if (s > half || s < -half) {
        s = fe__clampf(s, -half, half);
        *t = fe__clampf(s * e.y - fe__dot(c, e), -reach, reach);
        s = fe__clampf(c.y + *t * e.y, -half, half);
    }
    return s;
}

// The cores cross: out along the common perpendicular, to the side where B's centre is. Parallel ones: x.
static fe_vec3 crossing_normal(fe_vec3 c, fe_vec3 e)
{
    float across = e.x * e.x + e.z * e.z;
    if (!(across > 1e-12f)) return fe__vec3(1.0f, 0.0f, 0.0f);
    fe_vec3 n = fe__scale(1.0f / sqrtf(across), fe__vec3(e.z, 0.0f, -e.x));
    return fe__dot(n, c) < 0.0f ? fe__neg(n) : n;
}

void fe__collide_capsule_capsule(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                                 fe__manifold *manifold)
{
    fe_vec3 c = b_in_a->position, e = b_in_a->rotation.y;
    float t, s = nearest_segments(a->half_height, c, e, b->half_height, &t);
    fe_vec3 on_a = {0.0f, s, 0.0f}, d = fe__sub(fe__add_scaled(c, t, e), on_a);
    float distance = fe__length(d), radii = a->radius + b->radius, separation = distance - radii;
    if (separation > margin) {
        fe__stay_apart(manifold, separation, fe__direction(d, distance));
        return;
    }
    const float clear = 1e-6f; // of the radii: nearer cores have a direction of rounding errors
    fe_vec3 n = distance > clear * radii ? fe__direction(d, distance) : crossing_normal(c, e);
    fe__segment core_a = {{0.0f, 0.0f, 0.0f}, {0.0f, a->half_height, 0.0f}, a->radius};
    fe__segment core_b = {c, fe__scale(b->half_height, e), b->radius};
    fe_vec3 nearest = fe__add_scaled(on_a, a->radius + 0.5f * separation, n);
    if (fe__lay_segments(&core_a, &core_b, n, nearest, separation, margin, manifold) > 0) return;
    manifold->normal = n;
    fe__add_point(manifold, nearest, separation, 0);
}

#define SHORT_STRETCH 0.01f // of the radii: two points nearer than that hold no better than one

// The part t0..t1 of b = centre + t half, |t| <= 1, that lies between the two planes through the ends of a; 0 when
// there is none worth two points.
static int32_t common_stretch(const fe__segment *a, const fe__segment *b, float *t0, float *t1)
{
    float aa = fe__dot(a->half, a->half), slope = fe__dot(a->half, b->half), bb = fe__dot(b->half, b->half);
    // cos^2 < 1/4: more than 60 degrees apart is not side by side; and no length, no direction
    if (!(4.0f * slope * slope > aa * bb)) return 0;
    float start = fe__dot(a->half, fe__sub(b->centre, a->centre)), inverse = 1.0f / slope;
    float p = (-aa - start) * inverse, q = (aa - start) * inverse;
    *t0 = fe__maxf(fe__minf(p, q), -1.0f);
    *t1 = fe__minf(fe__maxf(p, q), 1.0f);
    float radii = a->radius + b->radius, length = *t1 - *t0;
    return length > 0.0f && length * length * bb > SHORT_STRETCH * SHORT_STRETCH * radii * radii;
}

// manifold->axis: three points share a load otherwise than two, so what was askew stays so down to half a tie
enum { ASKEW = 1 };

// A place along the stretch: on_a + d on b's line, on_a on a's, |d| their distance there
typedef struct place {
    fe_vec3 on_a, d;
    float distance;
} place;

static place place_at(const fe__segment *a, const fe__segment *b, float t)
{
    fe_vec3 on_b = fe__add_scaled(b->centre, t, b->half), offset = fe__sub(on_b, a->centre);
    float along_a = fe__dot(a->half, offset) / fe__dot(a->half, a->half);
    fe_vec3 on_a = fe__add_scaled(a->centre, along_a, a->half), d = fe__sub(on_b, on_a);
    return (place){on_a, d, fe__length(d)};
}

// on_a and on_b, each a radius out along the normal: midway
static fe_vec3 between_surfaces(const fe__segment *a, const fe__segment *b, const place *at, fe_vec3 normal)
{
    return fe__add_scaled(fe__add_scaled(at->on_a, 0.5f, at->d), 0.5f * (a->radius - b->radius), normal);
}

// Segments askew: their nearest points run along them with the least turn, and a contact there alone swings for ever.
// So the ends of the stretch hold them, at their true clearance, |d| less the radii, or where d has turned from the
// normal by 10 degrees; the nearest points are the third.
static int32_t lay_askew(const fe__segment *a, const fe__segment *b, const float t[2], fe_vec3 nearest, fe_vec3 normal,
                         float separation, float margin, fe__manifold *manifold)
{
    const float aside = 0.176f, another_way = 0.98f; // tan 10 degrees; cos 11.5: round an end of a core
    float radii = a->radius + b->radius, slope = fe__dot(a->half, b->half) / fe__dot(a->half, a->half),
          bb = fe__dot(b->half, b->half);
    fe_vec3 drift = fe__sub(b->half, fe__scale(slope, a->half));
    // sin^2 > 1/4: more than 30 degrees apart the nearest points hardly run
    if (4.0f * fe__dot(drift, drift) > bb) return 0;
    float middle = fe__clampf(fe__dot(b->half, fe__sub(nearest, b->centre)) / bb, t[0], t[1]);
    float reach = aside * (separation + radii) / fe__length(drift);
    float part[2] = {fe__maxf(t[0], middle - reach), fe__minf(t[1], middle + reach)};
    for (int32_t i = 0; i < 2; ++i) {
        place end = place_at(a, b, part[i]);
        float clearance = end.distance - radii;
        if (fe__dot(normal, end.d) >= another_way * end.distance && clearance <= margin)
            fe__add_point(manifold, between_surfaces(a, b, &end, normal), clearance, 1u + (uint32_t)i);
    }
    if (manifold->count == 0) return 0;
    manifold->normal = normal;
    fe__add_point(manifold, nearest, separation, 0);
    return manifold->count;
}

// At each end of the stretch b is d away from a's line. Its separation along the normal, n . d less the radii, is short
// of the true one, |d| less the radii, where b has drifted aside: beyond a tie the segments are askew.
int32_t fe__lay_segments(const fe__segment *a, const fe__segment *b, fe_vec3 normal, fe_vec3 nearest, float separation,
                         float margin, fe__manifold *manifold)
{
    float t[2], radii = a->radius + b->radius, tie = fe__tie(0.5f * radii);
    if (!common_stretch(a, b, &t[0], &t[1])) return 0;
    place end[2] = {place_at(a, b, t[0]), place_at(a, b, t[1])};
    float along[2] = {fe__dot(normal, end[0].d), fe__dot(normal, end[1].d)};
    float drift = fe__maxf(end[0].distance - along[0], end[1].distance - along[1]);
    int32_t askew = drift > (manifold->axis == ASKEW ? 0.5f * tie : tie);
    manifold->axis = askew ? ASKEW : -1;
    if (askew) return lay_askew(a, b, t, nearest, normal, separation, margin, manifold);
    if (fe__minf(along[0], along[1]) - radii > fe__minf(separation + tie, margin)) return 0;
    manifold->normal = normal;
    for (int32_t i = 0; i < 2; ++i) {
        if (along[i] - radii <= margin)
            fe__add_point(manifold, between_surfaces(a, b, &end[i], normal), along[i] - radii, 1u + (uint32_t)i);
    }
    return manifold->count;
}

// ---- sphere ---------------------------------------------------------------------------------------------------------
// Sphere against sphere.
//
// A kernel of collide.c's table; pair_kernels.h says what comes in and goes out.

void fe__collide_sphere_sphere(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                               fe__manifold *manifold)
{
    fe_vec3 d = b_in_a->position;
    float radii = a->radius + b->radius, distance = fe__length(d), separation = distance - radii;
    if (separation > margin) {
        fe__stay_apart(manifold, separation, fe__direction(d, distance));
        return;
    }
    manifold->normal = fe__direction(d, distance);
    fe__add_point(manifold, fe__scale(a->radius + 0.5f * separation, manifold->normal), separation, 0);
}
