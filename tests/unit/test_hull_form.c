// Where hulls end: support, facing, reach, bounds and rays, by walks over everything, on hulls of random clouds.
#include "collision/cast/cast_kinds.h"
#include "fe_test.h"
#include "support/hull_clouds.h"
#include "support/hull_make.h"

enum { HULLS = 300, TRIES = 20 };

static double height_over(const fe__hull *h, int32_t face, fe_dvec3 p)
{
    return fe__ddot(fe__widen(fe__hull_normal(h, face)), p) - (double)h->distances[face];
}
static double highest_over(const fe__hull *h, fe_dvec3 p)
{
    double highest = -1e300;
    for (int32_t i = 0; i < h->face_count; ++i) highest = fe__maxd(highest, height_over(h, i, p));
    return highest;
}

typedef void (*asker)(const fe__hull *hull, uint64_t *random);

static void ask_hulls(asker ask)
{
    int32_t asked = 0;
    for (uint64_t seed = 1; asked < HULLS; ++seed) {
        cloud c;
        made_hull made;
        uint64_t random = seed;
        cloud_make(&c, seed);
        if (!make_hull(&c.points[0][0], c.count, 64, 0.0, &made)) continue;
        for (int32_t i = 0; i < TRIES; ++i) ask(&made.hull, &random);
        free_hull(&made);
        asked += 1;
    }
}

static void ask_along(const fe__hull *h, fe_dvec3 d)
{
    int32_t vertex = fe__hull_support(h, d), face = fe__hull_facing(h, d);
    for (int32_t i = 0; i < h->vertex_count; ++i) {
        double ahead =
            fe__ddot(d, fe__widen(fe__hull_vertex(h, i))) - fe__ddot(d, fe__widen(fe__hull_vertex(h, vertex)));
        FE_TRUE(i < vertex ? ahead < 0.0 : ahead <= 0.0);
    }
    for (int32_t i = 0; i < h->face_count; ++i) {
        double ahead = fe__ddot(d, fe__widen(fe__hull_normal(h, i))) - fe__ddot(d, fe__widen(fe__hull_normal(h, face)));
        FE_TRUE(i < face ? ahead < 0.0 : ahead <= 0.0);
    }
}

// Directions of any length, those that are no floats too
static void ask_support(const fe__hull *h, uint64_t *random)
{
    const double lengths[] = {1e-42, 1e3, 1e60};
    for (int32_t i = 0; i < 3; ++i) ask_along(h, fe__dscale(lengths[i], cloud_vector(random)));
}

static void the_support_is_the_lowest_of_the_farthest(void **state)
{
    (void)state;
    ask_hulls(ask_support);
}

// No corner is outside of the bounds, and each side has one. A double resolves 2e-16 of the coordinates: 1e-14 of 1e6 m
static void ask_bounds(const fe__hull *h, uint64_t *random)
{
    fe_dvec3 axis = cloud_direction(random), at = fe__dscale(1e6, cloud_vector(random));
    fe__pose pose = {at, fe__normalized((fe_quat){(float)axis.x, (float)axis.y, (float)axis.z, 0.7f})};
    fe__bounds b = fe__hull_bounds(h, &pose);
    fe_vec3 centre = fe__narrow(cloud_vector(random));
    double least[6] = {1e300, 1e300, 1e300, 1e300, 1e300, 1e300}, slack = 1e-9, reach = 0.0;
    for (int32_t i = 0; i < h->vertex_count; ++i) {
        fe_dvec3 local = fe__widen(fe__hull_vertex(h, i)), p = fe__dadd(at, fe__drotate(pose.rotation, local)),
                 d = fe__dsub(local, fe__widen(centre));
        const double inside[6] = {p.x - b.low.x,  p.y - b.low.y,  p.z - b.low.z,
                                  b.high.x - p.x, b.high.y - p.y, b.high.z - p.z};
        for (int32_t k = 0; k < 6; ++k) least[k] = fe__mind(least[k], inside[k]);
        reach = fe__maxd(reach, sqrt(fe__ddot(d, d)));
    }
    for (int32_t k = 0; k < 6; ++k) FE_NEAR(least[k], 0.0, slack);
    FE_NEAR(fe__hull_reach(h, centre), reach, 1e-7 * reach);
}

static void bounds_are_tight(void **state)
{
    (void)state;
    ask_hulls(ask_bounds);
}

// Both ends along a direction are the supports along and against it.
static void ask_ends(const fe__hull *h, uint64_t *random)
{
    fe_dvec3 direction = cloud_direction(random);
    fe__hull_ends ends = fe__hull_ends_along(h, direction);
    assert_int_equal(ends.along, fe__hull_support(h, direction));
    assert_int_equal(ends.against, fe__hull_support(h, fe__dscale(-1.0, direction)));
}

static void both_ends_are_supports(void **state)
{
    (void)state;
    ask_hulls(ask_ends);
}

// Rough bounds hold the tight ones, and are wider by no more than a millionth of the hull's distance from its origin,
// a few times: floats hold coordinates to 6e-8 of it, and 2e-6 of their sum are added.
static void ask_rough_bounds(const fe__hull *h, uint64_t *random)
{
    fe_dvec3 axis = cloud_direction(random), at = fe__dscale(1e3, cloud_vector(random)), zero = {0.0, 0.0, 0.0};
    fe__pose pose = {at, fe__normalized((fe_quat){(float)axis.x, (float)axis.y, (float)axis.z, 0.7f})};
    fe__bounds tight = fe__hull_bounds(h, &pose), rough = fe__hull_rough_bounds(h, &pose);
    double most = 1e-5 * (double)fe__hull_reach(h, fe__narrow(zero));
    const double wider[6] = {tight.low.x - rough.low.x,   tight.low.y - rough.low.y,   tight.low.z - rough.low.z,
                             rough.high.x - tight.high.x, rough.high.y - tight.high.y, rough.high.z - tight.high.z};
    for (int32_t k = 0; k < 6; ++k) FE_WITHIN(wider[k], 0.0, most);
}

static void rough_bounds_hold_the_tight_ones(void **state)
{
    (void)state;
    ask_hulls(ask_rough_bounds);
}

// A triangle over a plane of the hull is beside it by its lowest corner, and one that has a point of the hull is not.
static void ask_beside(const fe__hull *h, uint64_t *random)
{
    int32_t face = cloud_int(random, h->face_count);
    fe_dvec3 n = fe__hull_unit_normal(h, face);
    double size = (double)h->extent, gap = 0.1 * size, rounding = 1e-4 * size;
    fe_dvec3 high[3], through[3], on = fe__widen(fe__hull_vertex(h, cloud_int(random, h->vertex_count)));
    fe_vec3 corner[3];
    for (int32_t k = 0; k < 3; ++k) {
        high[k] = fe__dadd(on, fe__dscale(size, cloud_vector(random)));
        double over = k == 0 ? gap : gap * (double)(1 + cloud_int(random, 3));
        high[k] = fe__dadd(high[k], fe__dscale(over - height_over(h, face, high[k]), n));
        corner[k] = fe__narrow(high[k]);
    }
    assert_int_equal(fe__hull_is_beside(h, corner, (float)(gap - rounding)), 1);
    fe_dvec3 side = cloud_vector(random), other = cloud_vector(random);
    through[0] = fe__dadd(on, fe__dscale(size, side)), through[1] = fe__dadd(on, fe__dscale(size, other));
    through[2] = fe__dsub(on, fe__dscale(size, fe__dadd(side, other)));
    for (int32_t k = 0; k < 3; ++k) corner[k] = fe__narrow(through[k]);
    assert_int_equal(fe__hull_is_beside(h, corner, (float)rounding), 0);
}

static void a_triangle_over_a_plane_is_beside(void **state)
{
    (void)state;
    ask_hulls(ask_beside);
}

// A ray through a point inside: from outside it ends on the surface, on the face that it names, and no earlier point of
// it is inside. One that starts inside hits at once. What is aimed past the farthest vertex misses.
static void ask_ray(const fe__hull *h, uint64_t *random)
{
    double size = (double)h->extent, slack = 1e-9 * size;
    fe_dvec3 inner = fe__dadd(h->mass.centre, fe__dscale(0.5 * (double)h->inner_radius, cloud_direction(random))),
             out = cloud_direction(random), from = fe__dadd(inner, fe__dscale(4.0 * size, out)),
             way = fe__dscale(-8.0 * size, out);
    fe__ray_hit hit = {0};
    assert_int_equal(fe__hull_ray(h, from, way, 1.0, &hit), 1);
    FE_TRUE(!hit.inside && hit.t > 0.0 && hit.t < 0.5 && fe__ddot(hit.normal, way) < 0.0);
    fe_dvec3 on = fe__dadd(from, fe__dscale(hit.t, way));
    FE_NEAR(highest_over(h, on), 0.0, slack);
    FE_NEAR(height_over(h, hit.triangle, on), 0.0, slack);
    assert_int_equal(fe__hull_ray(h, from, way, 0.999 * hit.t, &hit), 0);
    assert_int_equal(fe__hull_ray(h, from, out, 1e9, &hit), 0); // away from it

    assert_int_equal(fe__hull_ray(h, inner, way, 1.0, &hit), 1);
    FE_TRUE(hit.inside && hit.t == 0.0);
    FE_NEAR(hit.depth, -highest_over(h, inner), slack);
    FE_NEAR(fe__ddot(hit.normal, out), 1.0, 1e-12);
    assert_int_equal(fe__hull_ray(h, inner, (fe_dvec3){0.0, 0.0, 0.0}, 1.0, &hit), 1);
    FE_NEAR(fe__ddot(hit.normal, fe__widen(fe__hull_normal(h, hit.triangle))), 1.0, 1e-6);
    assert_int_equal(fe__hull_ray(h, from, (fe_dvec3){0.0, 0.0, 0.0}, 1.0, &hit), 0);

    // across `out`, just above the farthest vertex and just below it
    fe_dvec3 top = fe__widen(fe__hull_vertex(h, fe__hull_support(h, out))),
             side = fe__dcross(out, cloud_direction(random));
    side = fe__dscale(2.0 * size / sqrt(fe__ddot(side, side)), side);
    fe_dvec3 above = fe__dadd(fe__dsub(top, side), fe__dscale(1e-5 * size + (double)h->flatness, out));
    int32_t grazes = fe__hull_ray(h, above, fe__dscale(2.0, side), 1.0, &hit);
    if (grazes) FE_TRUE(highest_over(h, fe__dadd(above, fe__dscale(2.0 * hit.t, side))) <= slack);
}

static void rays_end_on_the_surface(void **state)
{
    (void)state;
    ask_hulls(ask_ray);
}

// The nearest point q of a convex body to p outside: no vertex v is ahead of it, (v - q) . (p - q) <= 0, and q is on
// the surface. Faces are flat up to the flatness, in both.
static void ask_nearest(const fe__hull *h, uint64_t *random)
{
    double size = (double)h->extent, slack = 2e-7 * size + 2.0 * (double)h->flatness;
    double away = cloud_int(random, 2) ? 2.0 * size : 0.02 * size;
    fe_dvec3 top = fe__widen(fe__hull_vertex(h, fe__hull_support(h, cloud_vector(random)))),
             p = fe__dadd(top, fe__dscale(away, cloud_vector(random)));
    fe__nearest near = fe__hull_nearest(h, p);
    FE_TRUE(near.triangle >= 0 && near.triangle < h->face_count);
    FE_NEAR(fe__ddot(near.normal, near.normal), 1.0, 1e-12);
    FE_NEAR(highest_over(h, near.point), 0.0, slack);
    fe_dvec3 back = fe__dadd(near.point, fe__dscale(near.distance, near.normal)), off = fe__dsub(back, p);
    FE_NEAR(fe__ddot(off, off), 0.0, 1e-12 * size * size);
    if (near.distance <= 0.0) {
        FE_NEAR(near.distance, highest_over(h, p), 2e-7 * size);
        return;
    }
    for (int32_t v = 0; v < h->vertex_count; ++v) {
        fe_dvec3 ahead = fe__dsub(fe__widen(fe__hull_vertex(h, v)), near.point);
        // turned by the flatness over the distance, at most: a vertex as far as the hull is long is ahead by that share
        double turned = slack * (1.0 + 2.0 * size / near.distance);
        FE_TRUE(fe__ddot(ahead, near.normal) <= turned);
    }
}

static void the_nearest_point_has_nothing_ahead(void **state)
{
    (void)state;
    ask_hulls(ask_nearest);
}

// A box with a ball around each of its points is put where it touches a point of the hull at some t: it does not pass.
// Beyond a face by a hundredth of the lengths, and along it, it does: that is far more than floats lose.
static void ask_passing(const fe__hull *h, uint64_t *random)
{
    double size = (double)h->extent, t = (double)cloud_int(random, 1001) / 1000.0;
    fe_dvec3 toward = cloud_direction(random), way = fe__dscale(size, cloud_vector(random));
    fe__hull_passer p = {.translation = way, .radius = 0.2 * size};
    fe_dvec3 on = fe__dscale(-p.radius, toward); // of the passer, from its middle: what lies farthest against `toward`
    for (int32_t k = 0; k < 3; ++k) {
        p.half[k] = fe__dscale(0.1 * size * (double)(k + 1), cloud_direction(random));
        on = fe__dadd(on, fe__dscale(fe__ddot(p.half[k], toward) > 0.0 ? -1.0 : 1.0, p.half[k]));
    }
    fe_dvec3 touched = fe__dsub(fe__widen(fe__hull_vertex(h, fe__hull_support(h, toward))), on);
    p.origin = fe__dsub(touched, fe__dscale(t, way));
    double from;
    assert_int_equal(fe__hull_is_passed(h, &p, 1.0, &from), 0);
    FE_WITHIN(from, 0.0, t); // it is outside until there
    assert_int_equal(fe__hull_is_passed(h, &p, t, &from), 0);

    int32_t face = cloud_int(random, h->face_count);
    fe_dvec3 n = fe__hull_unit_normal(h, face);
    double reach = p.radius + 0.01 * size;
    for (int32_t k = 0; k < 3; ++k) reach += fe__absd(fe__ddot(p.half[k], n));
    p.translation = fe__dsub(way, fe__dscale(fe__ddot(way, n), n));
    p.origin = fe__dadd(p.origin, fe__dscale(reach - height_over(h, face, p.origin), n));
    assert_int_equal(fe__hull_is_passed(h, &p, 1.0, &from), 1);
}

static void what_touches_does_not_pass(void **state)
{
    (void)state;
    ask_hulls(ask_passing);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_support_is_the_lowest_of_the_farthest),
        cmocka_unit_test(bounds_are_tight),
        cmocka_unit_test(both_ends_are_supports),
        cmocka_unit_test(rough_bounds_hold_the_tight_ones),
        cmocka_unit_test(a_triangle_over_a_plane_is_beside),
        cmocka_unit_test(rays_end_on_the_surface),
        cmocka_unit_test(the_nearest_point_has_nothing_ahead),
        cmocka_unit_test(what_touches_does_not_pass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
