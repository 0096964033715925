// capsule.c - capsule against sphere and capsule: the nearest points of the cores, and two points where capsules run side by side.
//
// Kernels of collide.c's table; A is a capsule, its core the segment |y| <= half height. Source of the nearest points: Ericson, Real-Time
// Collision Detection, 5.1.9, simplified because one segment lies on an axis.
#include "collision/kernels.h"

void fe__collide_capsule_sphere(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin, fe__manifold *manifold)
{
    float y = fe__clampf(b_in_a->position.y, -a->half_height, a->half_height);
    fe_vec3 d = {b_in_a->position.x, b_in_a->position.y - y, b_in_a->position.z};
    float distance = fe__length(d), separation = distance - a->radius - b->radius;
    if (separation > margin) {
        fe__stay_apart(manifold, separation);
        return;
    }
    manifold->normal = fe__direction(d, distance);
    fe__add_point(manifold, fe__add_scaled(fe__vec3(0.0f, y, 0.0f), a->radius + 0.5f * separation, manifold->normal), separation, 0);
}

// Nearest points (0, s, 0), |s| <= half, and c + t e, |t| <= reach, e of length 1. Seen along y the lines are nearest where
// (c + t e) . (ex, 0, ez) = 0; no difference of large terms, however near to parallel. Parallel ones meet amid their common stretch.
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

void fe__collide_capsule_capsule(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin, fe__manifold *manifold)
{
    fe_vec3 c = b_in_a->position, e = b_in_a->rotation.y;
    float t, s = nearest_segments(a->half_height, c, e, b->half_height, &t);
    fe_vec3 on_a = {0.0f, s, 0.0f}, d = fe__sub(fe__add_scaled(c, t, e), on_a);
    float distance = fe__length(d), radii = a->radius + b->radius, separation = distance - radii;
    if (separation > margin) {
        fe__stay_apart(manifold, separation);
        return;
    }
    const float clear = 1e-6f; // of the radii: nearer cores have a direction of rounding errors
    fe_vec3 n = distance > clear * radii ? fe__direction(d, distance) : crossing_normal(c, e);
    fe__segment core_a = {{0.0f, 0.0f, 0.0f}, {0.0f, a->half_height, 0.0f}, a->radius};
    fe__segment core_b = {c, fe__scale(b->half_height, e), b->radius};
    if (fe__lay_segments(&core_a, &core_b, n, separation, margin, manifold) > 0) return;
    manifold->normal = n;
    fe__add_point(manifold, fe__add_scaled(on_a, a->radius + 0.5f * separation, n), separation, 0);
}

// The part t0..t1 of b = centre + t half, |t| <= 1, that lies between the two planes through the ends of a; 0 when there is none worth two
// points.
static int32_t common_stretch(const fe__segment *a, const fe__segment *b, float *t0, float *t1)
{
    float aa = fe__dot(a->half, a->half), slope = fe__dot(a->half, b->half), bb = fe__dot(b->half, b->half);
    // cos^2 < 1/4: more than 60 degrees apart is not side by side; and no length, no direction
    if (!(4.0f * slope * slope > aa * bb)) return 0;
    float start = fe__dot(a->half, fe__sub(b->centre, a->centre)), inverse = 1.0f / slope;
    float p = (-aa - start) * inverse, q = (aa - start) * inverse;
    *t0 = fe__maxf(fe__minf(p, q), -1.0f);
    *t1 = fe__minf(fe__maxf(p, q), 1.0f);
    const float short_stretch = 0.01f; // of the radii: two points nearer than that hold no better than one
    float radii = a->radius + b->radius, length = *t1 - *t0;
    return length > 0.0f && length * length * bb > short_stretch * short_stretch * radii * radii;
}

// At each end of the stretch b is d away from a's line. Its separation along the normal, n . d less the radii, is short of the true one,
// |d| less the radii, where b has drifted aside: beyond a tie the segments do not run side by side, and one point says it better.
int32_t fe__lay_segments(const fe__segment *a, const fe__segment *b, fe_vec3 normal, float separation, float margin, fe__manifold *manifold)
{
    float t[2], aa = fe__dot(a->half, a->half), radii = a->radius + b->radius, tie = fe__tie(0.5f * radii);
    if (!common_stretch(a, b, &t[0], &t[1])) return 0;
    float end[2];
    fe_vec3 point[2];
    for (int32_t i = 0; i < 2; ++i) {
        fe_vec3 on_b = fe__add_scaled(b->centre, t[i], b->half), offset = fe__sub(on_b, a->centre);
        fe_vec3 on_a = fe__add_scaled(a->centre, fe__dot(a->half, offset) / aa, a->half), d = fe__sub(on_b, on_a);
        float along = fe__dot(normal, d);
        if (fe__length(d) - along > tie) return 0;
        end[i] = along - radii;
        point[i] = fe__scale(0.5f, fe__add(fe__add_scaled(on_a, a->radius, normal), fe__add_scaled(on_b, -b->radius, normal)));
    }
    if (fe__minf(end[0], end[1]) > fe__minf(separation + tie, margin)) return 0;
    manifold->normal = normal;
    for (int32_t i = 0; i < 2; ++i) {
        if (end[i] <= margin) fe__add_point(manifold, point[i], end[i], 1u + (uint32_t)i);
    }
    return manifold->count;
}
