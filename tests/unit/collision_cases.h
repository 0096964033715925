// collision_cases.h - random forms and poses, and plain double geometry, for the tests of src/collision.
#ifndef COLLISION_CASES_H
#define COLLISION_CASES_H
#include "collision/manifold/collide.h"
#include "collision/manifold/pair_kernels.h"

#include <math.h>
#include <stdio.h>

static uint64_t noise = 1;

static inline double uniform(double low, double high)
{
    noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (double)(noise >> 11) * 0x1p-53;
}

// One number a statement, in these functions: the order in which a compiler evaluates arguments is its own.
static inline fe_vec3 random_vector(double size)
{
    float x = (float)uniform(-size, size);
    float y = (float)uniform(-size, size);
    float z = (float)uniform(-size, size);
    return fe__vec3(x, y, z);
}

static inline fe_dvec3 random_direction(void)
{
    for (;;) {
        fe_dvec3 v = fe__widen(random_vector(1.0));
        double square = fe__ddot(v, v);
        if (square > 1e-4 && square <= 1.0) return fe__dscale(1.0 / sqrt(square), v);
    }
}

static inline fe_quat random_rotation(void)
{
    for (;;) {
        fe_vec3 v = random_vector(1.0);
        fe_quat q = {v.x, v.y, v.z, (float)uniform(-1.0, 1.0)};
        float square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
        if (square > 0.01f && square <= 1.0f) return fe__normalized(q);
    }
}

static inline fe_quat turn_about(fe_dvec3 axis, double angle)
{
    double s = sin(0.5 * angle);
    return fe__normalized(
        (fe_quat){(float)(s * axis.x), (float)(s * axis.y), (float)(s * axis.z), (float)cos(0.5 * angle)});
}

static inline fe__form sphere(float radius) { return (fe__form){.type = FE__FORM_SPHERE, .radius = radius}; }
static inline fe__form capsule(float half_height, float radius)
{
    return (fe__form){.type = FE__FORM_CAPSULE, .radius = radius, .half_height = half_height};
}
static inline fe__form box(float x, float y, float z) { return (fe__form){.type = FE__FORM_BOX, .half = {x, y, z}}; }
static inline fe__form plane(fe_vec3 normal, float distance)
{
    return (
        fe__form){.type = FE__FORM_PLANE, .normal = fe__scale(1.0f / fe__length(normal), normal), .distance = distance};
}

// Sizes of 5 cm to 1 m.
static inline fe__form random_form(int32_t type)
{
    float p = (float)uniform(0.05, 1.0);
    float q = (float)uniform(0.05, 1.0);
    float r = (float)uniform(0.05, 1.0);
    fe_vec3 normal = fe__narrow(random_direction());
    switch (type) {
    case FE__FORM_SPHERE:
        return sphere(p);
    case FE__FORM_CAPSULE:
        return capsule(p, 0.5f * q);
    case FE__FORM_BOX:
        return box(p, q, r);
    default:
        return plane(normal, 2.0f * p - 1.0f);
    }
}

// A pose in double with axes that are exactly perpendicular, which those of an fe__relative, rounded to float, are not.
typedef struct frame {
    fe_dvec3 position, x, y, z;
} frame;

static inline frame frame_of(const fe__relative *r)
{
    fe_dvec3 x = fe__widen(r->rotation.x), y = fe__widen(r->rotation.y);
    x = fe__dscale(1.0 / sqrt(fe__ddot(x, x)), x);
    y = fe__dsub(y, fe__dscale(fe__ddot(x, y), x));
    y = fe__dscale(1.0 / sqrt(fe__ddot(y, y)), y);
    return (frame){fe__widen(r->position), x, y, fe__dcross(x, y)};
}

static inline fe__relative relative(fe_vec3 position, fe_quat rotation)
{
    return (fe__relative){position, fe__matrix(rotation)};
}

// ---- the cores: points +-x +-y +-z of the half widths --------------------------------------------------------------
static inline fe_dvec3 core_widths(const fe__form *form)
{
    return (fe_dvec3){(double)form->half.x, (double)form->half.y + (double)form->half_height, (double)form->half.z};
}

static inline fe_dvec3 into_a(const frame *b, fe_dvec3 p)
{
    fe_dvec3 sum = fe__dadd(fe__dadd(fe__dscale(p.x, b->x), fe__dscale(p.y, b->y)), fe__dscale(p.z, b->z));
    return fe__dadd(b->position, sum);
}

static inline fe_dvec3 into_b(const frame *b, fe_dvec3 p)
{
    fe_dvec3 d = fe__dsub(p, b->position);
    return (fe_dvec3){fe__ddot(d, b->x), fe__ddot(d, b->y), fe__ddot(d, b->z)};
}

static inline void core_corners(const fe__form *form, fe_dvec3 corner[8])
{
    fe_dvec3 w = core_widths(form);
    for (int32_t i = 0; i < 8; ++i) corner[i] = (fe_dvec3){i & 1 ? w.x : -w.x, i & 2 ? w.y : -w.y, i & 4 ? w.z : -w.z};
}

static inline void corners_in_a(const fe__form *b, const frame *b_in_a, fe_dvec3 corner[8])
{
    core_corners(b, corner);
    for (int32_t i = 0; i < 8; ++i) corner[i] = into_a(b_in_a, corner[i]);
}

// How far B's surface is beyond A's along the unit vector n (below 0: they overlap along it), by projecting corners.
static inline double gap_along(const fe__form *a, const fe__form *b, const frame *b_in_a, fe_dvec3 n)
{
    fe_dvec3 ca[8], cb[8];
    core_corners(a, ca);
    corners_in_a(b, b_in_a, cb);
    double high = -1e300, low = 1e300;
    for (int32_t i = 0; i < 8; ++i) {
        high = fe__maxd(high, fe__ddot(ca[i], n));
        low = fe__mind(low, fe__ddot(cb[i], n));
    }
    return low - high - (double)a->radius - (double)b->radius;
}

// Of cores: the largest gap along any face normal or pair of edges: below 0, the depth (Gottschalk); above, a lower
// bound of the distance.
static inline double brute_gap(const fe__form *a, const fe__form *b, const frame *r)
{
    fe_dvec3 of_a[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    fe_dvec3 of_b[3] = {r->x, r->y, r->z}, axis[15];
    for (int32_t i = 0; i < 3; ++i) {
        axis[i] = of_a[i], axis[3 + i] = of_b[i];
        for (int32_t j = 0; j < 3; ++j) axis[6 + 3 * i + j] = fe__dcross(of_a[i], of_b[j]);
    }
    fe__form core_a = *a, core_b = *b;
    core_a.radius = core_b.radius = 0.0f;
    double best = -1e300;
    for (int32_t i = 0; i < 15; ++i) {
        double length = sqrt(fe__ddot(axis[i], axis[i]));
        if (length < 1e-6) continue;
        for (int32_t sign = -1; sign <= 1; sign += 2)
            best = fe__maxd(best, gap_along(&core_a, &core_b, r, fe__dscale(sign / length, axis[i])));
    }
    return best;
}

// Signed distance from the surface of a form, below 0 inside; form's frame.
static inline double surface_distance(const fe__form *form, fe_dvec3 p)
{
    if (form->type == FE__FORM_PLANE) return fe__ddot(fe__widen(form->normal), p) - (double)form->distance;
    fe_dvec3 w = core_widths(form), d = {fe__absd(p.x) - w.x, fe__absd(p.y) - w.y, fe__absd(p.z) - w.z};
    fe_dvec3 out = {fe__maxd(d.x, 0.0), fe__maxd(d.y, 0.0), fe__maxd(d.z, 0.0)};
    return sqrt(fe__ddot(out, out)) + fe__mind(fe__maxd(d.x, fe__maxd(d.y, d.z)), 0.0) - (double)form->radius;
}

static inline float deepest(const fe__manifold *m)
{
    float low = INFINITY;
    for (int32_t i = 0; i < m->count; ++i) low = fe__minf(low, m->points[i].separation);
    return low;
}

static inline double degrees_between(fe_dvec3 a, fe_dvec3 b)
{
    fe_dvec3 c = fe__dcross(a, b);
    return atan2(sqrt(fe__ddot(c, c)), fe__ddot(a, b)) * (180.0 / 3.14159265358979323846);
}

static inline void print_form(const char *name, const fe__form *f)
{
    printf("  %s: type %d radius %.9g half_height %.9g half %.9g %.9g %.9g normal %.9g %.9g %.9g distance %.9g\n", name,
           f->type, (double)f->radius, (double)f->half_height, (double)f->half.x, (double)f->half.y, (double)f->half.z,
           (double)f->normal.x, (double)f->normal.y, (double)f->normal.z, (double)f->distance);
}

static inline void print_case(const fe__form *a, const fe__form *b, const fe__relative *b_in_a)
{
    print_form("A", a);
    print_form("B", b);
    const fe_vec3 v[4] = {b_in_a->position, b_in_a->rotation.x, b_in_a->rotation.y, b_in_a->rotation.z};
    for (int32_t i = 0; i < 4; ++i) {
        printf("  %s %.9g %.9g %.9g\n", i ? "axis" : "position", (double)v[i].x, (double)v[i].y, (double)v[i].z);
    }
}

#endif
