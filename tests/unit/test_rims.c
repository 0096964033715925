// Cylinders and cones: support, bounds, nearest points, rays, distances, depths, sweeps and contacts.
//
// A convex form lies below each of its supporting planes: a plane that separates a point or a form by as much as the
// answer says proves that nothing is nearer, and a point of the form proves that nothing is farther.
#include "fe_test.h"

#include "collision/cast/cast_kinds.h"
#include "collision/cast/sweep.h"
#include "collision/form/gjk.h"
#include "collision/form/form.h"

#include "collision_cases.h"

#include <float.h>

enum { CASES = 20000, DIRECTIONS = 400 };

static fe__form cylinder(float half_height, float radius)
{
    return (fe__form){.type = FE__FORM_CYLINDER, .half = {radius, half_height, radius}};
}

static fe__form cone(float half_height, float radius)
{
    return (fe__form){.type = FE__FORM_CONE, .half = {radius, half_height, radius}};
}

// 2 cm to 2 m, up to 100 to 1
static fe__form random_rim(void)
{
    float h = (float)(0.02 * pow(100.0, uniform(0.0, 1.0)));
    float r = (float)(0.02 * pow(100.0, uniform(0.0, 1.0)));
    return uniform(0.0, 1.0) < 0.5 ? cylinder(h, r) : cone(h, r);
}

static double height_along(const fe__form *form, fe_dvec3 n) { return fe__ddot(n, fe__form_support(form, n)); }

// Is p in the form, but for `slack`? By its definition.
static int32_t is_in(const fe__form *form, fe_dvec3 p, double slack)
{
    double r = (double)form->half.x, h = (double)form->half.y, out = sqrt(p.x * p.x + p.z * p.z);
    if (fe__absd(p.y) > h + slack) return 0;
    if (form->type == FE__FORM_CYLINDER) return out <= r + slack;
    return (out - r * (h - p.y) / (2.0 * h)) * 2.0 * h / sqrt(r * r + 4.0 * h * h) <= slack;
}

static void supports_and_bounds_are_tight(void **state)
{
    (void)state;
    for (int32_t i = 0; i < CASES; ++i) {
        fe__form form = random_rim();
        fe_dvec3 n = random_direction(), p = fe__form_support(&form, n);
        FE_TRUE(is_in(&form, p, 1e-12));
        double most = 0.0;
        for (int32_t k = 0; k < 64; ++k) { // points of both rims, and the tip
            double angle = 6.283185307179586 * k / 64, r = (double)form.half.x, h = (double)form.half.y;
            fe_dvec3 low = {r * cos(angle), -h, r * sin(angle)}, high = {low.x, h, low.z};
            if (form.type == FE__FORM_CONE) high.x = high.z = 0.0;
            double along = fe__maxd(fe__ddot(n, low), fe__ddot(n, high));
            most = k ? fe__maxd(most, along) : along;
        }
        FE_WITHIN(fe__ddot(n, p) - most, -1e-12, (double)form.half.x * (1.0 - cos(3.15 / 64)) + 1e-12);

        fe__pose pose = {{1.0, 2.0, 3.0}, random_rotation()};
        fe__bounds b = fe__form_bounds(&form, &pose);
        const fe_dvec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const double low[3] = {b.low.x, b.low.y, b.low.z}, high[3] = {b.high.x, b.high.y, b.high.z};
        for (int32_t k = 0; k < 3; ++k) {
            fe_dvec3 in = fe__drotate_back(pose.rotation, axes[k]);
            FE_NEAR(high[k], k + 1.0 + height_along(&form, in), 1e-6);
            FE_NEAR(low[k], k + 1.0 - height_along(&form, fe__dscale(-1.0, in)), 1e-6);
        }
        fe_vec3 centre = random_vector(1.0);
        double reach = (double)fe__form_reach(&form, centre);
        fe_dvec3 way = fe__dsub(p, fe__widen(centre));
        FE_WITHIN(sqrt(fe__ddot(way, way)), 0.0, reach * (1.0 + 1e-6));
        // without a layer: below every plane by so much
        float by = 0.5f * fe__form_thickness(&form);
        fe__form thin = fe__form_shrunk(&form, by);
        FE_WITHIN(height_along(&form, n) - height_along(&thin, n), (double)by * (1.0 - 1e-5), 10.0);
    }
}

static void the_nearest_point_is_proved_by_its_plane(void **state)
{
    (void)state;
    for (int32_t i = 0; i < CASES; ++i) {
        fe__form form = random_rim();
        fe_dvec3 p = fe__widen(random_vector(uniform(0.0, 1.0) < 0.5 ? 0.2 : 3.0));
        if (i % 16 == 0) p.x = p.z = 0.0;
        fe__nearest found = fe__form_nearest(&form, p);
        fe_dvec3 n = found.normal;
        FE_NEAR(fe__ddot(n, n), 1.0, 1e-12);
        FE_TRUE(is_in(&form, found.point, 1e-9));
        FE_NEAR(height_along(&form, n), fe__ddot(n, found.point), 1e-9);
        FE_NEAR(fe__ddot(n, fe__dsub(p, found.point)), found.distance, 1e-9);
        FE_TRUE((found.distance <= 0.0) == is_in(&form, p, 0.0) || fe__absd(found.distance) < 1e-9);
        if (found.distance < 0.0) // no other plane is nearer
            for (int32_t k = 0; k < DIRECTIONS / 10; ++k) {
                fe_dvec3 m = random_direction();
                FE_WITHIN(height_along(&form, m) - fe__ddot(m, p), -found.distance - 1e-9, 100.0);
            }
    }
}

// A ray meets the form where it comes in: on the surface, not before, and where it goes on it is in it.
static void rays_meet_the_surface(void **state)
{
    (void)state;
    int32_t hits = 0;
    for (int32_t i = 0; i < 5 * CASES; ++i) {
        fe__form form = random_rim();
        fe_dvec3 from = fe__widen(random_vector(4.0)), aim = fe__widen(random_vector(0.5));
        if (i % 8 == 0) aim = fe__form_support(&form, random_direction()); // the rim, the tip
        if (i % 8 == 1) aim.x = from.x, aim.z = from.z;                    // along the axis
        if (i % 8 == 2) aim.y = from.y;                                    // across it
        if (i % 8 == 3) {                                                  // along the side
            fe__face face;
            fe__form_face(&form, fe__vec3(1.0f, 0.01f, 0.2f), &face);
            aim = fe__dadd(from, fe__widen(fe__sub(face.vertex[1], face.vertex[0])));
        }
        if (i % 8 == 4) aim = (fe_dvec3){0.0, (double)form.half.y * uniform(-1.0, 1.0), 0.0};
        fe_dvec3 way = fe__dscale(2.0, fe__dsub(aim, from));
        fe__ray_hit hit;
        if (!fe__form_ray(&form, from, way, 1.0, &hit)) {
            if (i % 8 == 4) print_form("missed", &form);
            FE_TRUE(i % 8 != 4); // through its middle
            for (int32_t k = 0; k <= 100; ++k) FE_TRUE(!is_in(&form, fe__dadd(from, fe__dscale(0.01 * k, way)), -1e-9));
            continue;
        }
        ++hits;
        fe_dvec3 p = fe__dadd(from, fe__dscale(hit.t, way));
        if (hit.inside) {
            FE_TRUE(is_in(&form, from, 1e-9));
            continue;
        }
        FE_NEAR(fe__form_nearest(&form, p).distance, 0.0, 1e-7); // a tangent: the root of a rounding
        FE_NEAR(fe__ddot(hit.normal, hit.normal), 1.0, 1e-12);
        FE_NEAR(height_along(&form, hit.normal), fe__ddot(hit.normal, p), 1e-6);
        FE_WITHIN(fe__ddot(hit.normal, way), -100.0, 1e-6);
        for (int32_t k = 0; k < 50; ++k)
            FE_TRUE(!is_in(&form, fe__dadd(from, fe__dscale(hit.t * k / 50.0, way)), -1e-8));
    }
    FE_WITHIN(hits, CASES, 5 * CASES);
}

static void extreme_rays_give_numbers(void **state)
{
    (void)state;
    const double lengths[] = {0.0, 5e-324, 1e-200, 1e-9, 1.0, 1e9, 1e150, 1.7e308};
    for (int32_t i = 0; i < CASES; ++i) {
        fe__form form = random_rim();
        double a = lengths[(int32_t)uniform(0.0, 8.0)], b = lengths[(int32_t)uniform(0.0, 8.0)];
        fe_dvec3 from = fe__dscale(a, random_direction()), way = fe__dscale(b, random_direction());
        fe__ray_hit hit;
        if (!fe__form_ray(&form, from, way, 1.0, &hit)) continue;
        FE_WITHIN(hit.t, 0.0, 1.0);
        FE_NEAR(fe__ddot(hit.normal, hit.normal), 1.0, 1e-9);
        FE_WITHIN(hit.depth, 0.0, 10.0);
    }
}

// ---- two forms -----------------------------------------------------------------------------------------------------
static fe__form random_partner(void)
{
    double kind = uniform(0.0, 5.0);
    return kind < 1.0   ? random_form(FE__FORM_SPHERE)
           : kind < 2.0 ? random_form(FE__FORM_CAPSULE)
           : kind < 3.0 ? random_form(FE__FORM_BOX)
                        : random_rim();
}

static void distance_of(const fe__cores *c, fe__gjk *g) { fe__gjk_distance(c, 1e30, g); }

static double gap_on(const fe__cores *c, fe_dvec3 n) { return -fe__ddot(n, fe__cores_support(c, n).difference); }

// The largest gap along any direction, or a little less: from `n` on uphill.
static double best_gap(const fe__cores *c, fe_dvec3 n)
{
    double best = gap_on(c, n), step = 0.3;
    for (int32_t k = 0; k < DIRECTIONS; ++k, step *= 0.97) {
        fe_dvec3 m = fe__dadd(n, fe__dscale(step, random_direction()));
        m = fe__dscale(1.0 / sqrt(fe__ddot(m, m)), m);
        double gap = gap_on(c, m);
        if (gap > best) best = gap, n = m;
    }
    return best;
}

static void distances_and_depths_are_proved_by_their_planes(void **state)
{
    (void)state;
    for (int32_t i = 0; i < CASES; ++i) {
        fe__form a = random_rim(), b = random_partner();
        fe__relative at = relative(random_vector(1.5), random_rotation());
        frame f = frame_of(&at);
        fe__cores c = {&a, &b, f.position, f.x, f.y, f.z, NULL};
        fe__gjk g;
        fe__gjk_distance(&c, 1e30, &g);
        if (!g.overlap) {
            fe_dvec3 d = fe__dsub(g.on_b, g.on_a);
            FE_TRUE(is_in(&a, g.on_a, 1e-9));
            FE_NEAR(sqrt(fe__ddot(d, d)), g.distance, 1e-9);
            FE_NEAR(gap_on(&c, fe__dscale(1.0 / g.distance, d)), g.distance, 1e-6);
            continue;
        }
        fe__penetration p = fe__epa_depth(&c, &g);
        if (fe__absd(gap_on(&c, p.normal) + p.depth) > 1e-4) print_case(&a, &b, &at);
        FE_NEAR(gap_on(&c, p.normal), -p.depth, 1e-4);
        double best = best_gap(&c, p.normal);
        FE_WITHIN(best, -10.0, -p.depth + 1e-4); // as many corners as EPA has, of forms of 2 m
    }
}

// Rims, caps and faces side by side, 0.1 um to 1 mm apart: the supports of a round side come so near to each other that
// they span slivers. Of one of height h the areas give weights good to rounding / h, and a side is no farther off than
// h: the better is within the root of a rounding, of the size. A foot is taken while rounding turns its triangle's
// normal by less than distance / |corner|.
static void near_points_lie_on_their_forms(void **state)
{
    (void)state;
    const fe_dvec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const double root = sqrt(DBL_EPSILON);
    int32_t near = 0;
    for (int32_t i = 0; i < 5 * CASES; ++i) {
        fe__form a = random_rim(), b = uniform(0.0, 3.0) < 1.0 ? random_form(FE__FORM_BOX) : random_rim();
        int32_t x = (int32_t)uniform(0.0, 6.0), y = (x / 2 * 2 + 2 + (int32_t)uniform(0.0, 4.0)) % 6;
        frame f = {fe__widen(random_vector(2.0)), axes[x], axes[y], fe__dcross(axes[x], axes[y])};
        fe__cores c = {&a, &b, f.position, f.x, f.y, f.z, NULL};
        fe__gjk g;
        fe__gjk_distance(&c, 1e30, &g);
        double gap = pow(10.0, uniform(-7.0, -3.0));
        if (g.overlap || g.distance < gap) continue;
        c.position = fe__dsub(c.position, fe__dscale(1.0 - gap / g.distance, g.way)), f.position = c.position;
        void (*const distances[2])(const fe__cores *, fe__gjk *) = {fe__gjk_distance_closely, distance_of};
        for (int32_t k = 0; k < 2; ++k) {
            distances[k](&c, &g);
            fe_dvec3 corner = g.vertex[0].difference, on_b = into_b(&f, g.on_b);
            double slack = root * g.size + g.distance * g.distance / sqrt(fe__ddot(corner, corner));
            FE_TRUE(!g.overlap && is_in(&a, g.on_a, slack));
            FE_TRUE(b.type == FE__FORM_BOX ? surface_distance(&b, on_b) <= slack : is_in(&b, on_b, slack));
        }
        ++near;
    }
    FE_WITHIN(near, CASES, 5 * CASES);
}

static void contacts_have_the_deepest_point(void **state)
{
    (void)state;
    int32_t touching = 0;
    for (int32_t i = 0; i < CASES; ++i) {
        fe__form x = random_rim(), y = random_partner();
        int32_t swap = fe__collide_swaps(&x, &y);
        const fe__form *a = swap ? &y : &x, *b = swap ? &x : &y;
        fe__relative at = relative(random_vector(1.0), random_rotation());
        if (i % 4 == 0)
            at.rotation = fe__matrix(turn_about((fe_dvec3){1.0, 0.0, 0.0}, 1.57079632679 * (double)(i / 4 % 4)));
        fe__manifold m = {.axis = -1};
        const float margin = 0.02f;
        fe__collide(a, b, &at, margin, &m);
        frame f = frame_of(&at);
        fe__cores c = {a, b, f.position, f.x, f.y, f.z, NULL};
        fe__gjk g;
        fe__gjk_distance(&c, 1e30, &g);
        double radii = (double)a->radius + (double)b->radius, tie = 0.0011;
        double separation = g.overlap ? -fe__epa_depth(&c, &g).depth - radii : g.distance - radii;
        if (separation > (double)margin + tie) FE_TRUE(m.count == 0);
        if (separation < (double)margin - tie) {
            if (m.count < 1 || fe__absd((double)deepest(&m) - separation) > tie) print_case(a, b, &at);
            FE_WITHIN(m.count, 1, 4);
            FE_NEAR(deepest(&m), separation, tie);
            FE_NEAR(fe__dot(m.normal, m.normal), 1.0, 1e-5);
            ++touching;
        }
    }
    FE_WITHIN(touching, CASES / 10, CASES);
}

// Of forms that are apart the plane between them shows half the distance of their cores, or more (gjk.h), and no more
// than there is.
static void what_is_apart_says_by_how_much(void **state)
{
    (void)state;
    int32_t apart = 0;
    for (int32_t i = 0; i < CASES; ++i) {
        fe__form x = random_rim(), y = random_partner();
        int32_t swap = fe__collide_swaps(&x, &y);
        const fe__form *a = swap ? &y : &x, *b = swap ? &x : &y;
        fe__relative at = relative(random_vector(4.0), random_rotation());
        fe__manifold m = {.axis = -1};
        fe__collide(a, b, &at, 0.02f, &m);
        if (m.count) continue;
        frame f = frame_of(&at);
        fe__cores c = {a, b, f.position, f.x, f.y, f.z, NULL};
        fe__gjk g;
        fe__gjk_distance(&c, 1e30, &g);
        double radii = (double)a->radius + (double)b->radius;
        FE_WITHIN(m.axis_separation, 0.499 * g.distance - radii, g.distance - radii + 1e-5);
        FE_NEAR(gap_on(&c, fe__widen(m.normal)) - radii, m.axis_separation, 1e-5);
        ++apart;
    }
    FE_WITHIN(apart, CASES / 4, CASES);
}

// A direction that is kept may show a deeper overlap than the best, but by no more than ten ties (5 mm), the depth to
// which it is kept. Where nothing overlaps there is but one that holds. `last`: A stands still, so that it is the
// normal that was found.
static void a_kept_direction_is_nearly_the_best(void **state)
{
    (void)state;
    int32_t named = 0, kept = 0;
    for (int32_t i = 0; i < CASES; ++i) {
        fe__form x = random_rim(), y = random_partner();
        int32_t swap = fe__collide_swaps(&x, &y);
        const fe__form *a = swap ? &y : &x, *b = swap ? &x : &y;
        fe__relative first = relative(random_vector(1.0), random_rotation());
        frame start = frame_of(&first);
        fe__cores cores = {a, b, start.position, start.x, start.y, start.z, NULL};
        fe__gjk gap;
        fe__gjk_distance(&cores, 1e30, &gap);
        if (gap.overlap) continue;
        double closer = gap.distance - (double)a->radius - (double)b->radius + uniform(-0.015, 0.001);
        fe_vec3 towards = fe__narrow(fe__dscale(-closer / gap.distance, fe__dsub(gap.on_b, gap.on_a)));
        first.position = fe__add(first.position, towards);
        fe__manifold m = {.axis = -1};
        fe__collide(a, b, &first, 0.02f, &m);
        if (!m.count || m.axis < 0) continue;
        ++named;
        fe__relative second = first;
        fe_vec3 slide = random_vector(0.1), shift = random_vector(0.0005);
        slide = fe__sub(slide, fe__scale(fe__dot(slide, m.normal), m.normal));
        second.position = fe__add(first.position, fe__add(i % 2 ? slide : fe__vec3(0.0f, 0.0f, 0.0f), shift));
        m.last = m.normal;
        float found = m.axis_separation;
        fe__collide(a, b, &second, 0.02f, &m);
        if (!m.count) continue;
        kept += i % 2 == 0 && m.axis_separation == found;
        frame f = frame_of(&second);
        fe__cores c = {a, b, f.position, f.x, f.y, f.z, NULL};
        fe__gjk g;
        fe__gjk_distance(&c, 1e30, &g);
        double radii = (double)a->radius + (double)b->radius, tie = 0.0011;
        double separation = g.overlap ? -fe__epa_depth(&c, &g).depth - radii : g.distance - radii;
        if (fe__absd((double)deepest(&m) - separation) > tie) print_case(a, b, &second);
        FE_WITHIN(deepest(&m) - separation, g.overlap ? -0.001 - tie : -tie, tie);
    }
    FE_WITHIN(named, CASES / 4, CASES);
    FE_WITHIN(kept, named / 5, named); // of the half that did not slide; a cone's side is always searched for
}

static void sweeps_stop_before_the_form(void **state)
{
    (void)state;
    int32_t hits = 0;
    for (int32_t i = 0; i < CASES / 4; ++i) {
        fe__form x = random_rim(), y = random_partner();
        const fe__form *still = i & 1 ? &x : &y, *moving = i & 1 ? &y : &x;
        fe_dvec3 from = fe__widen(random_vector(4.0));
        fe__mover mover = {.form = moving, .axes = fe__axes_of(random_rotation()), .position = from};
        mover.translation = fe__dadd(fe__dscale(-2.0, from), fe__widen(random_vector(1.0)));
        fe__sweep_hit hit;
        double radii = (double)still->radius + (double)moving->radius;
        int32_t met = fe__form_sweep(still, &mover, 1.0, &hit);
        FE_TRUE((met && hit.inside) == fe__form_overlap(still, &mover));
        if (met && hit.inside) continue;
        hits += met;
        for (int32_t k = 0; k <= 40; ++k) {
            double t = (met ? hit.t : 1.0) * k / 40.0;
            fe__cores c = {still,        moving,       fe__dadd(from, fe__dscale(t, mover.translation)),
                           mover.axes.x, mover.axes.y, mover.axes.z,
                           NULL};
            fe__gjk g;
            fe__gjk_distance(&c, 1e30, &g);
            FE_WITHIN(g.distance - radii, met || k < 40 ? 0.5e-8 : -1e-6, 100.0);
            if (met && k == 40) {
                FE_WITHIN(g.distance - radii, 0.5e-8, 2.0 * FE_SWEEP_GAP);
                FE_WITHIN(fe__ddot(hit.normal, mover.translation), -100.0, 0.0);
                FE_NEAR(height_along(still, hit.normal) + (double)still->radius, fe__ddot(hit.normal, hit.point), 1e-4);
            }
        }
    }
    FE_WITHIN(hits, CASES / 16, CASES / 4);
}

// From the smallest to the largest length there is, in any order: numbers, unit normals.
static void extreme_sizes_give_numbers(void **state)
{
    (void)state;
    for (int32_t i = 0; i < CASES; ++i) {
        fe__form forms[2];
        for (int32_t k = 0; k < 2; ++k) {
            float h = (float)(1e-3 * pow(1e8, uniform(0.0, 1.0)));
            float r = (float)(1e-3 * pow(1e8, uniform(0.0, 1.0)));
            double kind = uniform(0.0, 4.0);
            forms[k] = kind < 1.0 || k == 0 ? cylinder(h, r)
                       : kind < 2.0         ? cone(h, r)
                       : kind < 3.0         ? box(h, r, h)
                                            : capsule(h, r);
        }
        int32_t swap = fe__collide_swaps(&forms[0], &forms[1]);
        const fe__form *a = &forms[swap], *b = &forms[1 - swap];
        double size = 1e-3 * pow(1e8, uniform(0.0, 1.0));
        fe__relative at = relative(random_vector(size), random_rotation());
        if (i % 4 == 0) at.position = fe__vec3(0.0f, 0.0f, 0.0f);
        if (i % 8 < 2) at.rotation = fe__matrix(fe__identity());
        fe__manifold m = {.axis = -1};
        fe__collide(a, b, &at, 0.02f, &m);
        FE_WITHIN(m.count, 0, 4);
        for (int32_t k = 0; k < m.count; ++k) {
            FE_WITHIN(m.points[k].separation, -4e5, 0.021);
            FE_WITHIN(fe__length(m.points[k].point), 0.0, 1e6);
        }
        if (m.count) FE_NEAR(fe__dot(m.normal, m.normal), 1.0, 1e-4);
        fe__mover mover = {.form = b, .axes = fe__axes_of(random_rotation()), .position = fe__widen(at.position)};
        mover.translation = fe__widen(random_vector(size));
        fe__sweep_hit hit;
        if (!fe__form_sweep(a, &mover, 1.0, &hit)) continue;
        FE_WITHIN(hit.t, 0.0, 1.0);
        FE_NEAR(fe__ddot(hit.normal, hit.normal), 1.0, 1e-4);
    }
}

// One upon the other about one axis, turned by any angle, their faces as near as rounding: they touch by these faces,
// although where a search for their distance begins they touch already. A float of 4 m is 0.24 micrometres fine.
static void what_is_flush_about_one_axis_touches_by_its_faces(void **state)
{
    (void)state;
    for (int32_t i = 0; i < CASES; ++i) {
        fe__form lower = random_rim(), upper = random_rim();
        if (i % 3 == 0) upper = box(upper.half.x, upper.half.y, lower.half.x);
        if (i % 5 == 0) lower = box(lower.half.z, lower.half.y, upper.half.x);
        if (lower.type == FE__FORM_CONE) lower = cylinder(lower.half.y, lower.half.x);
        double off = i & 1 ? 0.0 : uniform(-3e-7, 3e-7);
        float up = (float)((double)lower.half.y + (double)upper.half.y + off);
        int32_t swap = fe__collide_swaps(&lower, &upper);
        fe__relative at =
            relative(fe__vec3(0.0f, swap ? -up : up, 0.0f), turn_about((fe_dvec3){0.0, 1.0, 0.0}, uniform(-3.2, 3.2)));
        fe__manifold m = {.axis = -1};
        fe__collide(swap ? &upper : &lower, swap ? &lower : &upper, &at, 0.02f, &m);
        FE_WITHIN(m.count, 3, 4);
        FE_NEAR((double)m.normal.y, swap ? -1.0 : 1.0, 1e-6);
        double gap = (double)up - (double)lower.half.y - (double)upper.half.y;
        for (int32_t k = 0; k < m.count; ++k) FE_NEAR((double)m.points[k].separation, gap, 2e-6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(supports_and_bounds_are_tight),
        cmocka_unit_test(the_nearest_point_is_proved_by_its_plane),
        cmocka_unit_test(rays_meet_the_surface),
        cmocka_unit_test(extreme_rays_give_numbers),
        cmocka_unit_test(distances_and_depths_are_proved_by_their_planes),
        cmocka_unit_test(near_points_lie_on_their_forms),
        cmocka_unit_test(contacts_have_the_deepest_point),
        cmocka_unit_test(what_is_flush_about_one_axis_touches_by_its_faces),
        cmocka_unit_test(what_is_apart_says_by_how_much),
        cmocka_unit_test(a_kept_direction_is_nearly_the_best),
        cmocka_unit_test(sweeps_stop_before_the_form),
        cmocka_unit_test(extreme_sizes_give_numbers),
    };
    return cmocka_run_group_tests_name("rims", tests, NULL, NULL);
}
