// A ray meets a form where its surface is. The reference knows no closed form: along a line the distance to a convex
// body is a convex function, whose minimum and first zero are searched for in long double.
#include "fe_test.h"

#include "collision/cast/cast_kinds.h"

#include <float.h>
#include <math.h>
#include <string.h>

typedef long double real;
enum { CASES = 100000, INSIDE_CASES = 20000 };

// Every quantity passes through a few roundings of lengths up to `scale`.
static const double roundings = 16.0 * DBL_EPSILON;

// ---- random cases --------------------------------------------------------------------------------------------------
static uint64_t noise = 1;

static double uniform(double low, double high)
{
    noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (double)(noise >> 11) * 0x1p-53;
}

static int32_t one_in(int32_t n) { return uniform(0.0, (double)n) < 1.0; }
static double any_size(double low, double high) { return low * pow(high / low, uniform(0.0, 1.0)); }

static fe_dvec3 any_direction(void)
{
    fe_dvec3 v;
    double square;
    do {
        v = (fe_dvec3){uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)};
        square = fe__ddot(v, v);
    } while (square < 1e-2 || square > 1.0);
    double axes[3] = {v.x, v.y, v.z};
    if (one_in(4)) axes[(int32_t)uniform(0.0, 3.0)] = 0.0; // in a coordinate plane
    if (one_in(4)) {
        int32_t axis = (int32_t)uniform(0.0, 3.0); // parallel to an axis
        for (int32_t k = 0; k < 3; ++k) axes[k] = k == axis ? (v.x < 0.0 ? -1.0 : 1.0) : 0.0;
    }
    if (one_in(4)) axes[(int32_t)uniform(0.0, 3.0)] *= any_size(1e-18, 1e-3); // nearly so
    v = (fe_dvec3){axes[0], axes[1], axes[2]};
    return fe__dscale(1.0 / sqrt(fe__ddot(v, v)), v);
}

// 1 cm to 1 km
static float any_length(void) { return (float)any_size(0.01, 1000.0); }

static fe__form any_form(int32_t type)
{
    fe_dvec3 n = any_direction();
    switch (type) {
    case FE__FORM_SPHERE:
        return (fe__form){.type = type, .radius = any_length()};
    case FE__FORM_CAPSULE:
        return (fe__form){.type = type, .radius = any_length(), .half_height = any_length()};
    case FE__FORM_BOX:
        return (fe__form){.type = type, .half = {any_length(), any_length(), any_length()}};
    default:
        return (fe__form){.type = type, .normal = fe__narrow(n), .distance = (one_in(2) ? 1.0f : -1.0f) * any_length()};
    }
}

static double size_of(const fe__form *f)
{
    fe_dvec3 h = fe__widen(f->half);
    return (double)f->radius + (double)f->half_height + sqrt(fe__ddot(h, h)) + fe__absd((double)f->distance);
}

// ---- the reference -------------------------------------------------------------------------------------------------
typedef struct real3 {
    real x, y, z;
} real3;

static real3 at(fe_dvec3 o, fe_dvec3 d, real t) { return (real3){o.x + t * d.x, o.y + t * d.y, o.z + t * d.z}; }
static real length_of(real3 a) { return sqrtl(a.x * a.x + a.y * a.y + a.z * a.z); }
static real clamp(real a, real limit) { return a > limit ? limit : a < -limit ? -limit : a; }

// signed distance; below 0 inside
static real distance_to(const fe__form *f, real3 p)
{
    real hx = f->half.x, hy = f->half.y, hz = f->half.z;
    if (f->type == FE__FORM_PLANE) {
        real nx = f->normal.x, ny = f->normal.y, nz = f->normal.z;
        return (nx * p.x + ny * p.y + nz * p.z - (real)f->distance) / length_of((real3){nx, ny, nz});
    }
    if (f->type == FE__FORM_BOX) {
        real x = fabsl(p.x) - hx, y = fabsl(p.y) - hy, z = fabsl(p.z) - hz,
             most = x > y ? (x > z ? x : z) : (y > z ? y : z);
        return most <= 0 ? most : length_of((real3){x > 0 ? x : 0, y > 0 ? y : 0, z > 0 ? z : 0});
    }
    return length_of((real3){p.x, p.y - clamp(p.y, f->half_height), p.z}) - (real)f->radius;
}

// outward normal of the round forms at a point of the surface
static real3 round_normal(const fe__form *f, real3 p)
{
    real3 a = {p.x, p.y - clamp(p.y, f->half_height), p.z};
    real l = length_of(a);
    return (real3){a.x / l, a.y / l, a.z / l};
}

// Where on [0, 1] the ray is nearest, or deepest: golden section.
static real nearest_time(const fe__form *f, fe_dvec3 o, fe_dvec3 d)
{
    const real golden = 0.61803398874989484820458683436563811772L;
    real low = 0, high = 1, a = high - golden, b = low + golden;
    real fa = distance_to(f, at(o, d, a)), fb = distance_to(f, at(o, d, b));
    for (int32_t i = 0; i < 95; ++i) { // 0.618^95 is 2^-66
        if (fa < fb) {
            high = b, b = a, fb = fa;
            a = high - golden * (high - low);
            fa = distance_to(f, at(o, d, a));
        } else {
            low = a, a = b, fa = fb;
            b = low + golden * (high - low);
            fb = distance_to(f, at(o, d, b));
        }
    }
    real ends[2] = {0, 1}, best = (low + high) / 2;
    for (int32_t i = 0; i < 2; ++i)
        if (distance_to(f, at(o, d, ends[i])) < distance_to(f, at(o, d, best))) best = ends[i];
    return best;
}

static real first_time(const fe__form *f, fe_dvec3 o, fe_dvec3 d, real inside)
{
    real outside = 0;
    for (int32_t i = 0; i < 66; ++i) {
        real middle = (outside + inside) / 2;
        if (distance_to(f, at(o, d, middle)) > 0)
            outside = middle;
        else
            inside = middle;
    }
    return inside;
}

// ---- random rays ---------------------------------------------------------------------------------------------------
typedef struct tally {
    int32_t hits, misses, inside, grazing;
} tally;

static void check_normal(const fe__form *f, const fe__ray_hit *hit, real3 p, double tolerance)
{
    fe_dvec3 n = hit->normal;
    if (f->type == FE__FORM_BOX) {
        double axes[3] = {n.x, n.y, n.z}, points[3] = {(double)p.x, (double)p.y, (double)p.z};
        double halves[3] = {(double)f->half.x, (double)f->half.y, (double)f->half.z};
        int32_t axis = axes[0] != 0.0 ? 0 : axes[1] != 0.0 ? 1 : 2;
        FE_TRUE(fe__absd(axes[axis]) == 1.0 && axes[(axis + 1) % 3] == 0.0 && axes[(axis + 2) % 3] == 0.0);
        FE_NEAR(points[axis], axes[axis] * halves[axis], tolerance); // on this face, which may end here
        return;
    }
    fe_dvec3 plane = fe__widen(f->normal);
    real3 plane_normal = {plane.x, plane.y, plane.z};
    real l = length_of(plane_normal);
    real3 e = f->type == FE__FORM_PLANE ? (real3){plane.x / l, plane.y / l, plane.z / l} : round_normal(f, p);
    double allowed = f->type == FE__FORM_PLANE ? roundings : roundings + tolerance / (double)f->radius;
    FE_NEAR(n.x - (double)e.x, 0.0, allowed);
    FE_NEAR(n.y - (double)e.y, 0.0, allowed);
    FE_NEAR(n.z - (double)e.z, 0.0, allowed);
}

// A residual e of the surface equation is an error e / cos along a ray that meets the surface at that angle from its
// normal. Where the ray all but grazes a round surface (e is no longer small beside size * cos^2), only the residual
// says something.
static void check_hit(const fe__form *f, fe_dvec3 o, fe_dvec3 d, real inside, const fe__ray_hit *hit, double error,
                      tally *count)
{
    double length = sqrt(fe__ddot(d, d)), cosine = -fe__ddot(hit->normal, d) / length;
    FE_WITHIN(hit->t, 0.0, 1.0);
    FE_NEAR(fe__ddot(hit->normal, hit->normal), 1.0, roundings);
    FE_TRUE(cosine >= -1e-9 && hit->inside == 0 && hit->depth == 0.0);
    double smallest = f->type == FE__FORM_SPHERE || f->type == FE__FORM_CAPSULE ? (double)f->radius : 1e30;
    count->hits += 1;
    if (cosine <= 0.0 || error > 0.01 * smallest * cosine * cosine) {
        FE_NEAR(distance_to(f, at(o, d, hit->t)), 0.0, error + length * roundings);
        count->grazing += 1;
        return;
    }
    real t = first_time(f, o, d, inside);
    FE_NEAR((hit->t - (double)t) * length, 0.0, error / cosine);
    check_normal(f, hit, at(o, d, t), 2.0 * error / cosine);
}

static void check_ray(const fe__form *f, fe_dvec3 o, fe_dvec3 d, tally *count)
{
    fe__ray_hit hit;
    memset(&hit, 0xff, sizeof hit); // NaN
    int32_t found = fe__form_ray(f, o, d, 1.0, &hit);
    double error = roundings * (size_of(f) + sqrt(fe__ddot(o, o)) + sqrt(fe__ddot(d, d)));
    double start = (double)distance_to(f, at(o, d, 0));
    if (fe__absd(start) <= error) return; // on the surface: both answers are right
    if (start < 0.0) {
        FE_TRUE(found && hit.inside == 1 && hit.t == 0.0);
        FE_NEAR(hit.depth, -start, error);
        count->inside += 1;
        return;
    }
    real nearest = nearest_time(f, o, d);
    double least = (double)distance_to(f, at(o, d, nearest));
    if (least > error) {
        FE_TRUE(!found);
        count->misses += 1;
    } else if (least < -error) {
        FE_TRUE(found);
        check_hit(f, o, d, nearest, &hit, error, count);
    }
}

// Translations of 1 mm to 10 km that lead to, through, past or away from the form.
static void rays_meet(int32_t type)
{
    tally count = {0, 0, 0, 0};
    noise = 11 + (uint64_t)type;
    for (int32_t i = 0; i < CASES; ++i) {
        fe__form f = any_form(type);
        double length = any_size(0.001, 10000.0), s = size_of(&f);
        fe_dvec3 d = fe__dscale(length, any_direction());
        fe_dvec3 target = fe__dscale(one_in(3) ? 0.1 * s : 1.2 * s, any_direction());
        if (type == FE__FORM_PLANE) target = fe__dadd(target, fe__dscale((double)f.distance, fe__widen(f.normal)));
        if (one_in(3))
            target = (fe_dvec3){(double)f.half.x, (double)f.half_height + (double)f.radius,
                                (double)f.half.z}; // rims and poles
        fe_dvec3 o = fe__dsub(target, fe__dscale(uniform(-0.2, 1.2), d));
        check_ray(&f, o, d, &count);
    }
    // each kind of answer was tried
    FE_TRUE(count.hits > CASES / 20 && count.misses > CASES / 20 && count.inside > CASES / 20);
    FE_TRUE(count.grazing < CASES / 50);
}

static void rays_meet_spheres(void **state) { (void)state, rays_meet(FE__FORM_SPHERE); }
static void rays_meet_capsules(void **state) { (void)state, rays_meet(FE__FORM_CAPSULE); }
static void rays_meet_boxes(void **state) { (void)state, rays_meet(FE__FORM_BOX); }
static void rays_meet_planes(void **state) { (void)state, rays_meet(FE__FORM_PLANE); }

// ---- starts inside -------------------------------------------------------------------------------------------------
static void a_start_inside_faces_the_ray_and_without_one_the_nearest_way_out(void **state)
{
    (void)state;
    int32_t inside = 0;
    for (int32_t i = 0; i < INSIDE_CASES; ++i) {
        fe__form f = any_form(i % 4);
        fe_dvec3 o = fe__dscale(uniform(0.0, 1.0) * size_of(&f), any_direction()),
                 d = fe__dscale(any_size(1e-3, 1e4), any_direction());
        fe_dvec3 zero = {0.0, 0.0, 0.0};
        double error = roundings * 2.0 * size_of(&f), start = (double)distance_to(&f, at(o, zero, 0));
        fe__ray_hit hit;
        if (start > error) {
            FE_TRUE(!fe__form_ray(&f, o, zero, 1.0, &hit));
            continue;
        }
        if (start > -error) continue;
        inside += 1;
        FE_TRUE(fe__form_ray(&f, o, d, 1.0, &hit) && hit.t == 0.0 && hit.inside == 1);
        FE_NEAR(fe__ddot(hit.normal, d), -sqrt(fe__ddot(d, d)), 1e-11); // 1e4 m, a few roundings
        FE_NEAR(hit.depth, -start, error);
        FE_TRUE(fe__form_ray(&f, o, zero, 1.0, &hit) && hit.t == 0.0 && hit.inside == 1);
        FE_NEAR(hit.depth, -start, error);
        FE_NEAR(fe__ddot(hit.normal, hit.normal), 1.0, roundings);
        FE_NEAR(distance_to(&f, at(o, hit.normal, hit.depth)), 0.0,
                error); // the way out of this length ends on the surface
    }
    FE_TRUE(inside > INSIDE_CASES / 4);
}

// The centre has no nearest way out; any of the shortest will do.
static void the_centre_has_a_way_out(void **state)
{
    (void)state;
    fe__form forms[3] = {{.type = FE__FORM_SPHERE, .radius = 2.0f},
                         {.type = FE__FORM_CAPSULE, .radius = 2.0f, .half_height = 3.0f},
                         {.type = FE__FORM_BOX, .half = {4.0f, 2.0f, 3.0f}}};
    fe_dvec3 zero = {0.0, 0.0, 0.0};
    for (int32_t i = 0; i < 3; ++i) {
        fe__ray_hit hit;
        FE_TRUE(fe__form_ray(&forms[i], zero, zero, 1.0, &hit));
        FE_TRUE(hit.depth == 2.0 && distance_to(&forms[i], at(zero, hit.normal, 2)) == 0);
    }
}

// ---- exact cases ----------------------------------------------------------------------------------------------------
// A form is closed: what touches it from outside meets it, what passes by one unit in the last place does not.
static void touching_is_meeting_and_one_ulp_aside_is_not(void **state)
{
    (void)state;
    fe__form forms[3] = {{.type = FE__FORM_SPHERE, .radius = 2.0f},
                         {.type = FE__FORM_CAPSULE, .radius = 2.0f, .half_height = 3.0f},
                         {.type = FE__FORM_BOX, .half = {2.0f, 2.0f, 2.0f}}};
    double t[3] = {0.5, 0.5, 0.4}; // sphere and capsule are met at x = 0, the box at its side
    for (int32_t i = 0; i < 3; ++i) {
        fe__ray_hit hit;
        fe_dvec3 d = {20.0, 0.0, 0.0};
        FE_TRUE(fe__form_ray(&forms[i], (fe_dvec3){-10.0, 0.0, 2.0}, d, 1.0, &hit));
        FE_TRUE(hit.t == t[i] && !hit.inside && (i == 2 ? hit.normal.x == -1.0 : hit.normal.z == 1.0));
        FE_TRUE(!fe__form_ray(&forms[i], (fe_dvec3){-10.0, 0.0, 2.0 + 4.0 * DBL_EPSILON}, d, 1.0, &hit));
        FE_TRUE(fe__form_ray(&forms[i], (fe_dvec3){-10.0, 0.0, 2.0 - 4.0 * DBL_EPSILON}, d, 1.0, &hit));
    }
}

// x^2 = r^2 - y^2 for rays along x, however close they graze.
static void grazing_rays_meet_where_the_chord_begins(void **state)
{
    (void)state;
    for (int32_t type = FE__FORM_SPHERE; type <= FE__FORM_CAPSULE; ++type) {
        for (double below = 1e-1; below > 1e-15; below *= 0.1) {
            fe__form f = {.type = type, .radius = 0.5f, .half_height = type == FE__FORM_CAPSULE ? 0.75f : 0.0f};
            double z = 0.5 * (1.0 - below), length = 20000.0;
            real chord = sqrtl((real)0.25 - (real)z * z);
            double y = type == FE__FORM_CAPSULE ? 0.25 : 0.0;
            fe__ray_hit hit;
            FE_TRUE(fe__form_ray(&f, (fe_dvec3){-10000.0, y, z}, (fe_dvec3){length, 0.0, 0.0}, 1.0, &hit));
            // z^2 rounds by eps / 4 in r^2 - z^2, and t by eps / 2
            double allowed = DBL_EPSILON * (length + 0.25 / (double)chord);
            FE_NEAR(hit.t * length - 10000.0, -(double)chord, allowed);
            FE_NEAR(hit.normal.z, z / 0.5, 1e-12);
        }
    }
}

// On its surface one is in a closed set, at a depth of 0, also when leaving.
static void a_start_on_the_surface_is_a_start_inside(void **state)
{
    (void)state;
    fe__form forms[4] = {{.type = FE__FORM_SPHERE, .radius = 2.0f},
                         {.type = FE__FORM_CAPSULE, .radius = 2.0f, .half_height = 3.0f},
                         {.type = FE__FORM_BOX, .half = {2.0f, 2.0f, 2.0f}},
                         {.type = FE__FORM_PLANE, .normal = {1.0f, 0.0f, 0.0f}, .distance = 2.0f}};
    for (int32_t i = 0; i < 4; ++i) {
        for (double d = -1.0; d <= 1.0; d += 1.0) {
            fe__ray_hit hit;
            FE_TRUE(fe__form_ray(&forms[i], (fe_dvec3){2.0, 0.0, 0.0}, (fe_dvec3){d, 0.0, 0.0}, 1.0, &hit));
            FE_TRUE(hit.t == 0.0 && hit.inside == 1 && hit.depth == 0.0 && hit.normal.x == (d > 0.0 ? -1.0 : 1.0));
        }
    }
}

static void on_an_edge_the_lowest_axis_gives_the_normal(void **state)
{
    (void)state;
    fe__form box = {.type = FE__FORM_BOX, .half = {1.0f, 1.0f, 1.0f}};
    fe__ray_hit hit;
    FE_TRUE(fe__form_ray(&box, (fe_dvec3){2.0, 2.0, 2.0}, (fe_dvec3){-2.0, -2.0, -2.0}, 1.0, &hit) && hit.t == 0.5 &&
            hit.normal.x == 1.0);
    FE_TRUE(fe__form_ray(&box, (fe_dvec3){0.0, -2.0, 2.0}, (fe_dvec3){0.0, 2.0, -2.0}, 1.0, &hit) && hit.t == 0.5 &&
            hit.normal.y == -1.0);
}

static void the_limit_is_the_last_moment_that_counts(void **state)
{
    (void)state;
    int32_t hits = 0;
    for (int32_t i = 0; i < INSIDE_CASES; ++i) {
        fe__form f = any_form(i % 4);
        fe_dvec3 d = fe__dscale(-3.0 * size_of(&f), any_direction()), o = fe__dscale(-0.6, d);
        fe__ray_hit first, again;
        if (!fe__form_ray(&f, o, d, 1.0, &first) || first.t == 0.0) continue;
        hits += 1;
        FE_TRUE(fe__form_ray(&f, o, d, first.t, &again) && again.t == first.t);
        FE_TRUE(!fe__form_ray(&f, o, d, first.t * (1.0 - DBL_EPSILON), &again));
    }
    FE_TRUE(hits > INSIDE_CASES / 4);
}

// ---- the whole range of double -------------------------------------------------------------------------------------
static double any_finite(void)
{
    for (;;) {
        uint64_t bits = 0;
        for (int32_t i = 0; i < 4; ++i) bits = bits << 16 | (uint64_t)uniform(0.0, 65536.0);
        if (one_in(8)) bits &= UINT64_C(0x800fffffffffffff); // denormal
        if (one_in(8)) bits |= UINT64_C(0x7fe0000000000000); // the largest, or none
        double x;
        memcpy(&x, &bits, sizeof x);
        if (one_in(8)) return 0.0;
        if (x - x == 0.0) return one_in(4) ? uniform(-10.0, 10.0) : x;
    }
}

static void every_finite_ray_gets_an_answer_without_nan(void **state)
{
    (void)state;
    int32_t hits = 0;
    for (int32_t i = 0; i < 4 * CASES; ++i) {
        fe__form f = any_form(i % 4);
        fe_dvec3 o = {any_finite(), any_finite(), any_finite()}, d = {any_finite(), any_finite(), any_finite()};
        if (one_in(4)) o = fe__dscale(size_of(&f), any_direction());
        fe__ray_hit hit;
        memset(&hit, 0xff, sizeof hit);
        if (!fe__form_ray(&f, o, d, 1.0, &hit)) continue;
        hits += 1;
        FE_WITHIN(hit.t, 0.0, 1.0);
        FE_NEAR(fe__ddot(hit.normal, hit.normal), 1.0, roundings);
        FE_TRUE(hit.depth >= 0.0);
    }
    FE_TRUE(hits > CASES / 20);
}

// n . o is a sum of three products that would overflow before it is compared.
static void a_plane_is_met_from_the_end_of_the_range(void **state)
{
    (void)state;
    float third = 0.57735027f;
    double far = 1.5e308;
    fe__form f = {.type = FE__FORM_PLANE, .normal = {third, third, third}, .distance = 1.0f};
    fe__ray_hit hit;
    FE_TRUE(fe__form_ray(&f, (fe_dvec3){far, far, far}, (fe_dvec3){-1.1 * far, -1.1 * far, -1.1 * far}, 1.0, &hit));
    FE_NEAR(hit.t, 1.0 / 1.1, 1e-15);
}

// Along an axis nothing is lost to rounding, from however far.
static void rays_along_an_axis_are_exact_at_any_length(void **state)
{
    (void)state;
    fe__form forms[4] = {{.type = FE__FORM_SPHERE, .radius = 1.0f},
                         {.type = FE__FORM_CAPSULE, .radius = 1.0f, .half_height = 1.0f},
                         {.type = FE__FORM_BOX, .half = {1.0f, 1.0f, 1.0f}},
                         {.type = FE__FORM_PLANE, .normal = {1.0f, 0.0f, 0.0f}, .distance = 1.0f}};
    for (double length = 8.0; length < 1e300; length *= 1024.0) {
        for (int32_t i = 0; i < 4; ++i) {
            fe__ray_hit hit;
            FE_TRUE(
                fe__form_ray(&forms[i], (fe_dvec3){length, 0.0, 0.0}, (fe_dvec3){-2.0 * length, 0.0, 0.0}, 1.0, &hit));
            FE_NEAR(hit.t, 0.5 - 0.5 / length, DBL_EPSILON);
            FE_TRUE(hit.normal.x == 1.0 && hit.normal.y == 0.0 && hit.normal.z == 0.0);
            FE_TRUE(
                !fe__form_ray(&forms[i], (fe_dvec3){length, 0.0, 0.0}, (fe_dvec3){2.0 * length, 0.0, 0.0}, 1.0, &hit));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_spheres),
        cmocka_unit_test(rays_meet_capsules),
        cmocka_unit_test(rays_meet_boxes),
        cmocka_unit_test(rays_meet_planes),
        cmocka_unit_test(a_start_inside_faces_the_ray_and_without_one_the_nearest_way_out),
        cmocka_unit_test(the_centre_has_a_way_out),
        cmocka_unit_test(touching_is_meeting_and_one_ulp_aside_is_not),
        cmocka_unit_test(grazing_rays_meet_where_the_chord_begins),
        cmocka_unit_test(a_start_on_the_surface_is_a_start_inside),
        cmocka_unit_test(on_an_edge_the_lowest_axis_gives_the_normal),
        cmocka_unit_test(a_plane_is_met_from_the_end_of_the_range),
        cmocka_unit_test(the_limit_is_the_last_moment_that_counts),
        cmocka_unit_test(every_finite_ray_gets_an_answer_without_nan),
        cmocka_unit_test(rays_along_an_axis_are_exact_at_any_length),
    };
    return cmocka_run_group_tests_name("ray", tests, NULL, NULL);
}
