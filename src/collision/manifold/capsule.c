// capsule.c - capsule against sphere and capsule: the nearest points of the cores, and the ends of the stretch where
// they run side by side.
//
// Kernels of collide.c's table; A is a capsule, its core the segment |y| <= half height. Source of the nearest points:
// Ericson, Real-Time Collision Detection, 5.1.9, simplified because one segment lies on an axis.
#include "collision/manifold/kernels.h"

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
