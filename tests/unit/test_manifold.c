// Manifolds that decide whether things stand: resting forms, forms in one place, forms of 1 mm and of 500 m, the axis
// kept between steps.
#include "fe_test.h"

#include "collision/manifold/collide.h"
#include "collision/manifold/pair_kernels.h"

#include "collision_cases.h"

#include <stdlib.h>
#include <string.h>

enum { POSES = 20000 };
#define MARGIN 0.02f

static fe__manifold collide(const fe__form *a, const fe__form *b, const fe__relative *r, float margin)
{
    fe__manifold m = {.axis = -1};
    fe__collide(a, b, r, margin, &m);
    return m;
}

// ---- sphere against box --------------------------------------------------------------------------------------------
static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static fe_dvec3 exact_normal(const fe__form *a, fe_dvec3 c)
{
    const double h[3] = {(double)a->half.x, (double)a->half.y, (double)a->half.z}, x[3] = {c.x, c.y, c.z};
    double d[3], square = 0.0, depth[3];
    int32_t k = 0;
    for (int32_t i = 0; i < 3; ++i) {
        d[i] = x[i] - fe__mind(fe__maxd(x[i], -h[i]), h[i]);
        square += d[i] * d[i];
        depth[i] = h[i] - fe__absd(x[i]);
        if (depth[i] < depth[k]) k = i;
    }
    if (square > 0.0) return fe__dscale(1.0 / sqrt(square), (fe_dvec3){d[0], d[1], d[2]});
    double side = x[k] < 0.0 ? -1.0 : 1.0;
    return (fe_dvec3){k == 0 ? side : 0.0, k == 1 ? side : 0.0, k == 2 ? side : 0.0};
}

// Centres from far outside over 1 micrometre above the surface to deep inside: the normal is that of exact arithmetic
// on the same input. The law asks 0.001 degree of 99 %; here even the worst of them keeps it.
static void the_normal_of_a_sphere_on_a_box_is_exact(void **state)
{
    (void)state;
    static double error[POSES];
    for (int32_t i = 0; i < POSES; ++i) {
        fe__form a = random_form(FE__FORM_BOX), b = sphere(1.0f);
        fe_vec3 c = random_vector(1.0);
        const float h[3] = {a.half.x, a.half.y, a.half.z};
        float *x[3] = {&c.x, &c.y, &c.z};
        for (int32_t k = 0; k < 3; ++k) {
            double over = (uniform(0.0, 1.0) < 0.5 ? 1.0 : -1.0) * pow(10.0, uniform(-6.0, 0.0));
            if (uniform(0.0, 1.0) < 0.6) *x[k] = (float)(((double)h[k] + over) * (*x[k] < 0.0f ? -1.0 : 1.0));
        }
        fe__relative r = relative(c, random_rotation());
        fe__manifold m = collide(&a, &b, &r, MARGIN);
        fe_dvec3 n = exact_normal(&a, fe__widen(c));
        error[i] = m.count == 1 ? degrees_between(fe__widen(m.normal), n) : 0.0;
        if (m.count == 0)
            FE_WITHIN(surface_distance(&a, fe__widen(c)), 1.0 + (double)MARGIN - 1e-6, INFINITY);
        else
            FE_NEAR(m.points[0].separation, surface_distance(&a, fe__widen(c)) - 1.0, 1e-6);
    }
    qsort(error, POSES, sizeof error[0], by_size);
    FE_WITHIN(error[POSES * 99 / 100], 0.0, 0.001);
    FE_WITHIN(error[POSES - 1], 0.0, 0.001);
}

// On the surface: the face's normal. Amid a cube all faces are as near, and the lowest axis is taken.
static void a_centre_on_or_in_the_box_leaves_by_the_nearest_face(void **state)
{
    (void)state;
    const fe__form cube = box(0.5f, 0.5f, 0.5f), ball = sphere(0.25f);
    const struct {
        fe_vec3 centre, normal;
        float separation;
    } cases[] = {
        {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, -0.75f},    {{0.0f, 0.5f, 0.0f}, {0.0f, 1.0f, 0.0f}, -0.25f},
        {{0.0f, -0.5f, 0.0f}, {0.0f, -1.0f, 0.0f}, -0.25f},  {{0.5f, 0.5f, 0.5f}, {1.0f, 0.0f, 0.0f}, -0.25f},
        {{0.0f, -0.25f, 0.25f}, {0.0f, -1.0f, 0.0f}, -0.5f}, {{0.25f, 0.0f, -0.375f}, {0.0f, 0.0f, -1.0f}, -0.375f},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        fe__relative r = relative(cases[i].centre, fe__identity());
        fe__manifold m = collide(&cube, &ball, &r, MARGIN);
        FE_TRUE(m.count == 1);
        FE_TRUE(m.normal.x == cases[i].normal.x && m.normal.y == cases[i].normal.y && m.normal.z == cases[i].normal.z);
        FE_TRUE(m.points[0].separation == cases[i].separation);
    }
}

// ---- planes --------------------------------------------------------------------------------------------------------
// Against the corners of B's core in double: the deepest is found, every point is such a corner, and the general path
// says the same.
static void a_plane_finds_the_deepest_corners(void **state)
{
    (void)state;
    const double rounding = 3e-6; // 4 m and ten roundings of 2.4e-7
    for (int32_t i = 0; i < 3 * POSES; ++i) {
        fe__form a = random_form(FE__FORM_PLANE), b = random_form(i % 3);
        fe_vec3 position = random_vector(1.0);
        fe__relative r = relative(position, random_rotation());
        r.position =
            fe__add_scaled(r.position, a.distance - fe__dot(a.normal, r.position) + (float)uniform(0.0, 1.5), a.normal);
        frame f = frame_of(&r);
        fe_dvec3 corner[8];
        corners_in_a(&b, &f, corner);
        double low = INFINITY;
        for (int32_t k = 0; k < 8; ++k) low = fe__mind(low, surface_distance(&a, corner[k]) - (double)b.radius);
        fe__manifold m = collide(&a, &b, &r, MARGIN), general = {.axis = -1};
        fe__collide_convex(&a, &b, &r, MARGIN, &general);
        if (low > (double)MARGIN + rounding) FE_TRUE(m.count == 0 && general.count == 0);
        if (low > (double)MARGIN - rounding) continue;
        if (m.count == 0 || fe__absd((double)deepest(&m) - low) > rounding) print_case(&a, &b, &r);
        FE_NEAR(deepest(&m), low, rounding);
        FE_NEAR(deepest(&general), low, rounding);
        for (int32_t k = 0; k < m.count; ++k) {
            fe_dvec3 on_b =
                fe__dadd(fe__widen(m.points[k].point),
                         fe__dscale(0.5 * (double)m.points[k].separation + (double)b.radius, fe__widen(a.normal)));
            double nearest = INFINITY;
            for (int32_t c = 0; c < 8; ++c) {
                fe_dvec3 d = fe__dsub(on_b, corner[c]);
                nearest = fe__mind(nearest, sqrt(fe__ddot(d, d)));
            }
            FE_NEAR(nearest, 0.0, rounding);
        }
    }
}

static void forms_lying_on_a_plane_have_all_their_points(void **state)
{
    (void)state;
    const fe__form ground = plane(fe__vec3(0.0f, 1.0f, 0.0f), 1.0f), b = box(0.5f, 0.25f, 0.75f),
                   c = capsule(0.5f, 0.25f);
    fe__relative flat = relative(fe__vec3(300.0f, 1.249f, -200.0f), fe__identity());
    fe__manifold m = collide(&ground, &b, &flat, MARGIN);
    FE_TRUE(m.count == 4);
    for (int32_t k = 0; k < 4; ++k) FE_NEAR(m.points[k].separation, -0.001, 1e-6);
    fe__relative lying =
        relative(fe__vec3(300.0f, 1.249f, -200.0f), turn_about((fe_dvec3){0.0, 0.0, 1.0}, 1.57079632679489662));
    m = collide(&ground, &c, &lying, MARGIN);
    FE_TRUE(m.count == 2);
    for (int32_t k = 0; k < 2; ++k) FE_NEAR(m.points[k].separation, -0.001, 1e-6);
    FE_NEAR(fe__absf(m.points[0].point.x - m.points[1].point.x), 1.0, 1e-4); // float at 300 m
}

// ---- capsules ------------------------------------------------------------------------------------------------------
// Side by side, whichever way each of them points, and shifted along each other: two points at the ends of the stretch
// they share.
static void parallel_capsules_touch_along_their_common_stretch(void **state)
{
    (void)state;
    const fe__form a = capsule(1.0f, 0.25f), b = capsule(0.75f, 0.5f);
    for (int32_t i = 0; i < 1000; ++i) {
        double angle = uniform(-3.0, 3.0), shift = uniform(-1.2, 1.2), gap = uniform(-0.1, 0.01);
        fe_dvec3 side = {cos(angle), 0.0, sin(angle)};
        // a tenth of a degree of tilt: rounding and resting jitter
        fe_dvec3 axis = random_direction();
        fe_quat q = turn_about(axis, uniform(0.0, 0.0017));
        if (i & 1) q = fe__normalized(fe__product(q, turn_about((fe_dvec3){1.0, 0.0, 0.0}, 3.14159265358979)));
        fe_vec3 position = fe__narrow(fe__dscale(0.75 + gap, side));
        position.y = (float)shift;
        fe__relative r = relative(position, q);
        fe__manifold m = collide(&a, &b, &r, MARGIN);
        FE_TRUE(m.count == 2);
        double low = fe__maxd(-1.0, shift - 0.75), high = fe__mind(1.0, shift + 0.75);
        float y0 = fe__minf(m.points[0].point.y, m.points[1].point.y),
              y1 = fe__maxf(m.points[0].point.y, m.points[1].point.y);
        // the tilt of 1.7 mrad moves the ends by that of 0.75 m, and by the square of it along
        FE_NEAR(y0, low, 0.002);
        FE_NEAR(y1, high, 0.002);
        for (int32_t k = 0; k < 2; ++k) FE_NEAR(m.points[k].separation, gap, 0.0017 * 1.2 + 1e-5);
        FE_TRUE(m.points[0].id != m.points[1].id);
    }
}

static void crossed_capsules_touch_at_one_point(void **state)
{
    (void)state;
    const fe__form a = capsule(1.0f, 0.25f);
    for (int32_t i = 0; i < 100; ++i) {
        double angle = uniform(0.53, 2.61); // beyond 30 degrees
        fe__relative r = relative(fe__vec3(0.0f, 0.2f, 0.49f), turn_about((fe_dvec3){0.0, 0.0, 1.0}, angle));
        fe__manifold m = collide(&a, &a, &r, MARGIN);
        FE_TRUE(m.count == 1);
        FE_NEAR(m.normal.z, 1.0, 1e-6);
        FE_NEAR(m.points[0].separation, -0.01, 1e-6);
        FE_NEAR(m.points[0].point.x, 0.0, 1e-6);
        FE_NEAR(m.points[0].point.y, 0.2, 1e-6);
    }
}

// A few degrees apart: the nearest points, and the ends of the common stretch at their own clearance, |d| less the
// radii.
static void capsules_askew_are_held_at_three_points(void **state)
{
    (void)state;
    const fe__form a = capsule(0.3f, 0.3f);
    for (int32_t i = 0; i < 100; ++i) {
        double angle = uniform(0.09, 0.2), aside = 0.3 * sin(angle); // 5 to 11 degrees
        fe__relative r = relative(fe__vec3(0.0f, 0.0f, 0.59f), turn_about((fe_dvec3){0.0, 0.0, 1.0}, angle));
        fe__manifold m = collide(&a, &a, &r, MARGIN);
        FE_TRUE(m.count == 3);
        for (int32_t k = 0; k < 3; ++k) {
            double at_end = sqrt(0.59 * 0.59 + aside * aside) - 0.6, middle = m.points[k].id == 0 ? 1.0 : 0.0;
            FE_NEAR(m.points[k].separation, middle > 0.0 ? -0.01 : at_end, 1e-5);
            FE_NEAR(fe__absf(m.points[k].point.y), middle > 0.0 ? 0.0 : 0.3 * cos(angle), 1e-4);
        }
    }
}

static void reach_along_x(const fe__manifold *m, double half)
{
    double least = 1.0, most = -1.0;
    for (int32_t k = 0; k < m->count; ++k)
        least = fe__mind(least, (double)m->points[k].point.x), most = fe__maxd(most, (double)m->points[k].point.x);
    FE_NEAR(least, -half, 1e-3);
    FE_NEAR(most, half, 1e-3);
}

// A bar on its edge across a bar of 8 cm, 5 cm deep: its tip hangs lower beyond the rim, yet it is the two rims that
// carry it.
static void an_edge_across_a_face_has_points_at_both_rims(void **state)
{
    (void)state;
    const fe__form a = box(0.04f, 0.1f, 0.2f), b = box(0.2f, 0.04f, 0.04f);
    for (int32_t i = 0; i < 100; ++i) {
        double angle = uniform(-0.06, 0.06), deep = uniform(0.0, 0.05); // 3.5 degrees
        fe_quat q = fe__normalized(fe__product(turn_about((fe_dvec3){0.0, 0.0, 1.0}, angle),
                                               turn_about((fe_dvec3){1.0, 0.0, 0.0}, 0.78539816339744831)));
        fe__relative r = relative(fe__vec3(0.0f, (float)(0.1 + 0.04 * sqrt(2.0) / cos(angle) - deep), 0.0f), q);
        fe__manifold m = collide(&a, &b, &r, MARGIN);
        reach_along_x(&m, 0.04);
    }
}

// The same of a round bar across a drum: as long as both rims are under it
static void a_side_across_a_cap_has_points_at_both_rims(void **state)
{
    (void)state;
    const fe__form drum = {.type = FE__FORM_CYLINDER, .half = {0.04f, 0.1f, 0.04f}},
                   b = {.type = FE__FORM_CYLINDER, .half = {0.04f, 0.2f, 0.04f}};
    const double right = 1.57079632679489662;
    for (int32_t i = 0; i < 200; ++i) {
        double angle = uniform(-0.06, 0.06), deep = 0.0401 * tan(fabs(angle)) + uniform(0.0, 0.02);
        fe_quat q = fe__normalized(fe__product(turn_about((fe_dvec3){0.0, 0.0, 1.0}, right + angle),
                                               turn_about((fe_dvec3){0.0, 1.0, 0.0}, uniform(-3.1, 3.1))));
        fe__relative r = relative(fe__vec3(0.0f, (float)(0.1 + 0.04 / cos(angle) - deep), 0.0f), q);
        fe__manifold m = collide(&drum, &b, &r, MARGIN);
        reach_along_x(&m, 0.04);
    }
}

// ---- edges side by side --------------------------------------------------------------------------------------------
// B, turned by twice `lean` about z and by `askew` about the normal half way between two faces, with the middle of its
// edge at (-1/2, 1/2) `gap` away from A's at (1/2, 1/2), `aside` along it, `off` across: the boards of an A-frame.
static fe__relative leaning(fe_dvec3 n, double lean, double askew, double gap, double aside, double off)
{
    fe_quat turn = turn_about((fe_dvec3){0.0, 0.0, 1.0}, 2.0 * lean);
    fe__relative r = relative(fe__vec3(0.0f, 0.0f, 0.0f), fe__normalized(fe__product(turn_about(n, askew), turn)));
    fe_dvec3 middle = fe__widen(fe__mul(&r.rotation, fe__vec3(-0.5f, 0.5f, 0.0f)));
    fe_dvec3 at = {0.5 + gap * n.x - off * n.y, 0.5 + gap * n.y + off * n.x, aside};
    r.position = fe__narrow(fe__dsub(at, middle));
    return r;
}

// The points lie along what the edges have in common, and where they cross.
static void leaning_boxes_touch_along_their_edges(void **state)
{
    (void)state;
    const fe__form a = box(0.5f, 0.5f, 0.5f);
    for (int32_t i = 0; i < POSES; ++i) {
        double lean = uniform(8.0, 40.0) * 0.017453292519943295, askew = i & 1 ? uniform(-0.052, 0.052) : 0.0;
        double gap = uniform(-0.001, 0.001), aside = uniform(-0.45, 0.45);
        fe_dvec3 n = {cos(lean), sin(lean), 0.0};
        fe__relative r = leaning(n, lean, askew, gap, aside, 0.0);
        fe__manifold m = collide(&a, &a, &r, MARGIN);
        FE_TRUE(m.count > 0 && m.count <= 2);
        FE_NEAR(fe__ddot(fe__widen(m.normal), n), 1.0, 1e-5);
        double least = 1.0, most = -1.0;
        for (int32_t k = 0; k < m.count; ++k) {
            FE_NEAR(m.points[k].separation, gap, 1e-5);
            least = fe__mind(least, (double)m.points[k].point.z), most = fe__maxd(most, (double)m.points[k].point.z);
        }
        FE_TRUE(least <= aside + 1e-3 && most >= aside - 1e-3);
        if (askew != 0.0) continue;
        FE_NEAR(least, fe__maxd(-0.5, aside - 0.5), 1e-5);
        FE_NEAR(most, fe__mind(0.5, aside + 0.5), 1e-5);
    }
}

// An edge that passes another by: from step to step the normal turns by no more than the way over the depth, from one
// face's to the other's.
static void the_normal_turns_with_edges_that_pass_each_other(void **state)
{
    (void)state;
    const fe__form a = box(0.5f, 0.5f, 0.5f);
    for (int32_t i = 0; i < 200; ++i) {
        double lean = uniform(8.0, 40.0) * 0.017453292519943295, deep = uniform(0.0005, 0.002), step = 1e-5;
        fe_dvec3 n = {cos(lean), sin(lean), 0.0};
        fe__manifold m = {.axis = -1};
        fe_vec3 before = {0.0f, 0.0f, 0.0f};
        for (double off = -0.01; off < 0.01; off += step) {
            fe__relative r = leaning(n, lean, 0.0, -deep, 0.0, off);
            fe__collide(&a, &a, &r, MARGIN, &m);
            FE_TRUE(m.count > 0);
            fe_vec3 turn = fe__sub(m.normal, before);
            if (off > -0.01) FE_WITHIN(sqrtf(fe__dot(turn, turn)), 0, 5.0 * step / deep + 1e-4);
            before = m.normal;
        }
    }
}

// On a face, over its rim, along an edge: two points where the box carries the capsule.
static void a_capsule_lies_on_faces_and_edges(void **state)
{
    (void)state;
    const fe__form table = box(1.0f, 0.5f, 1.0f), c = capsule(0.5f, 0.25f);
    const fe_quat along_x = turn_about((fe_dvec3){0.0, 0.0, 1.0}, 1.57079632679489662);
    for (int32_t i = 0; i < 1000; ++i) {
        double x = uniform(-1.3, 1.3);
        fe_dvec3 axis = random_direction();
        fe_quat jitter = turn_about(axis, uniform(0.0, 1e-3));
        fe__relative r = relative(fe__vec3((float)x, 0.748f, 0.1f), fe__normalized(fe__product(jitter, along_x)));
        fe__manifold m = collide(&table, &c, &r, MARGIN);
        FE_TRUE(m.count == 2);
        FE_TRUE(m.normal.y == 1.0f);
        FE_NEAR(fe__minf(m.points[0].point.x, m.points[1].point.x), fe__maxd(x - 0.5, -1.0), 0.001);
        FE_NEAR(fe__maxf(m.points[0].point.x, m.points[1].point.x), fe__mind(x + 0.5, 1.0), 0.001);
        for (int32_t k = 0; k < 2; ++k) FE_NEAR(m.points[k].separation, -0.002, 0.0012);
        // rolled over the rim by 45 degrees
        const float s = 0.70710678f;
        r.position = fe__vec3((float)x, 0.5f + 0.248f * s, 1.0f + 0.248f * s);
        m = collide(&table, &c, &r, MARGIN);
        FE_TRUE(m.count == 2);
        FE_NEAR(fe__minf(m.points[0].point.x, m.points[1].point.x), fe__maxd(x - 0.5, -1.0), 0.001);
        FE_NEAR(fe__maxf(m.points[0].point.x, m.points[1].point.x), fe__mind(x + 0.5, 1.0), 0.001);
        for (int32_t k = 0; k < 2; ++k) FE_NEAR(m.points[k].separation, -0.002, 0.0012);
    }
}

// ---- in one place, tiny, huge --------------------------------------------------------------------------------------
static void assert_sound(const fe__form *a, const fe__form *b, const fe__relative *r, const fe__manifold *m)
{
    fe_dvec3 n = fe__widen(m->normal);
    if (!(fe__absd(fe__ddot(n, n) - 1.0) <= 2e-6)) print_case(a, b, r);
    FE_NEAR(fe__ddot(n, n), 1.0, 2e-6);
    FE_WITHIN(m->count, 1, 4);
    for (int32_t k = 0; k < m->count; ++k) {
        FE_WITHIN(m->points[k].separation, -1e6, MARGIN);
        FE_WITHIN(fe__length(m->points[k].point), 0.0, 1e6);
    }
}

// Every pair, centres in one place or a rounding apart, turned by quarters: a unit normal that leads out, and no NaN.
static void forms_in_one_place_have_a_way_out(void **state)
{
    (void)state;
    const float offsets[5] = {0.0f, 1e-30f, -1e-20f, 1e-10f, -1e-6f};
    const fe__form forms[4] = {sphere(0.5f), capsule(0.5f, 0.25f), box(0.5f, 0.5f, 0.5f), box(0.25f, 0.5f, 1.0f)};
    const fe_vec3 axes[3] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
    for (int32_t pair = 0; pair < 16; ++pair) {
        const fe__form *a = &forms[pair / 4], *b = &forms[pair % 4];
        if (a->type < b->type) continue;
        for (int32_t place = 0; place < 125 * 4; ++place) {
            fe_vec3 p = {offsets[place % 5], offsets[place / 5 % 5], offsets[place / 25 % 5]};
            fe_vec3 x = axes[place / 125 % 3], y = axes[(place / 125 + 1) % 3];
            fe__relative r = {p, {x, y, fe__cross(x, y)}};
            fe__manifold m = collide(a, b, &r, MARGIN);
            assert_sound(a, b, &r, &m);
            frame f = frame_of(&r);
            double gap = gap_along(a, b, &f, fe__widen(m.normal));
            FE_NEAR(deepest(&m), gap, 0.0005 + 1e-5);
            fe__collide_convex(a, b, &r, MARGIN, &m);
            assert_sound(a, b, &r, &m);
        }
    }
}

// 1 mm: every tolerance has shrunk with the size. The depth is exact within two ties, 2 % of the smallest width each;
// edges side by side are as deep as facing_edges.c says.
static void boxes_of_a_millimetre_are_as_exact_for_their_size(void **state)
{
    (void)state;
    for (int32_t i = 0; i < POSES; ++i) {
        fe__form a = box(0.001f, 0.001f, 0.001f), b = box(0.001f, 0.002f, 0.003f);
        fe_vec3 position = random_vector(0.003);
        fe__relative r = relative(position, random_rotation());
        frame f = frame_of(&r);
        double gap = brute_gap(&a, &b, &f), tie = 0.02 * 0.001;
        if (gap > 0.0) continue;
        fe__manifold m = collide(&a, &b, &r, MARGIN);
        FE_TRUE(m.count > 0);
        double least = m.round ? 1.83 * gap - 0.83 * 0.25 * 0.001 : gap - 2.0 * tie;
        FE_WITHIN(deepest(&m), least - 1e-8, gap + 2.0 * tie + 1e-8);
    }
}

// A box of 5 cm on a ground of 500 m, 300 m off its centre, and a capsule and a sphere: heights as near the origin,
// four corners, one axis.
static void a_wide_ground_carries_small_things(void **state)
{
    (void)state;
    const fe__form ground = box(250.0f, 0.5f, 250.0f), small = box(0.025f, 0.025f, 0.025f),
                   pill = capsule(0.025f, 0.025f), ball = sphere(0.025f);
    const fe_quat along_x = turn_about((fe_dvec3){0.0, 0.0, 1.0}, 1.57079632679489662);
    for (int32_t i = 0; i < 5000; ++i) {
        fe_vec3 position = random_vector(220.0);
        position.y = 0.5249f;
        fe_dvec3 axis = random_direction();
        fe_quat yaw = turn_about((fe_dvec3){0.0, 1.0, 0.0}, uniform(-3.0, 3.0)),
                tilt = turn_about(axis, uniform(0.0, 1e-3));
        fe__relative r = relative(position, fe__normalized(fe__product(tilt, yaw)));
        fe__manifold m = collide(&ground, &small, &r, MARGIN);
        FE_TRUE(m.count == 4 && m.axis == 1);
        FE_TRUE(m.normal.x == 0.0f && m.normal.y == 1.0f && m.normal.z == 0.0f);
        for (int32_t k = 0; k < 4; ++k) {
            // 0.1 mm deep, and the tilt of 1 mrad at the corner 43 mm out; float of 0.5 m
            FE_NEAR(m.points[k].separation, -0.0001, 0.001 * 0.0434 + 3e-7);
            fe_vec3 arm = fe__sub(m.points[k].point, position);
            FE_NEAR(sqrtf(arm.x * arm.x + arm.z * arm.z), 0.0353553, 1e-4); // float at 300 m is 3e-5
        }
        r = relative(position, fe__normalized(fe__product(yaw, along_x)));
        m = collide(&ground, &pill, &r, MARGIN);
        FE_TRUE(m.count == 2 && m.normal.y == 1.0f);
        for (int32_t k = 0; k < 2; ++k) FE_NEAR(m.points[k].separation, -0.0001, 3e-7);
        m = collide(&ground, &ball, &r, MARGIN);
        FE_TRUE(m.count == 1 && m.normal.y == 1.0f);
        FE_NEAR(m.points[0].separation, -0.0001, 3e-7);
    }
}

// ---- margin and kept axis ------------------------------------------------------------------------------------------
static void the_margin_is_the_callers(void **state)
{
    (void)state;
    const float margins[3] = {0.001f, 0.02f, 0.1f};
    const fe__form forms[4] = {sphere(0.5f), capsule(0.5f, 0.5f), box(0.5f, 0.5f, 0.5f),
                               plane(fe__vec3(1.0f, 0.0f, 0.0f), 0.5f)};
    for (int32_t pair = 0; pair < 12; ++pair) {
        const fe__form *a = &forms[pair / 3], *b = &forms[pair % 3];
        if (a->type < b->type) continue;
        for (int32_t k = 0; k < 3; ++k) {
            fe__relative inside = relative(fe__vec3(1.0f + 0.9f * margins[k], 0.0f, 0.0f), fe__identity());
            fe__relative outside = relative(fe__vec3(1.0f + 1.1f * margins[k], 0.0f, 0.0f), fe__identity());
            fe__manifold m = collide(a, b, &inside, margins[k]);
            FE_TRUE(m.count > 0);
            FE_NEAR(deepest(&m), 0.9f * margins[k], 1e-6);
            FE_TRUE(m.normal.x == 1.0f);
            FE_TRUE(collide(a, b, &outside, margins[k]).count == 0);
        }
    }
}

// The result depends on the input and on axis and axis_separation, on nothing else that the manifold held.
static void the_old_points_do_not_matter(void **state)
{
    (void)state;
    for (int32_t i = 0; i < POSES; ++i) {
        fe__form a = random_form(FE__FORM_BOX), b = random_form(i % 3);
        fe_vec3 position = random_vector(1.2);
        fe__relative r = relative(position, random_rotation());
        fe__manifold clean, dirty;
        memset(&clean, 0, sizeof clean);
        memset(&dirty, 0x5a, sizeof dirty);
        clean.load = dirty.load = NULL; // given
        clean.axis = dirty.axis = i % 16 - 1;
        clean.axis_separation = dirty.axis_separation = (float)uniform(-0.01, 0.01);
        fe__collide(&a, &b, &r, MARGIN, &clean);
        fe__collide(&a, &b, &r, MARGIN, &dirty);
        FE_TRUE(clean.count == dirty.count && clean.axis == dirty.axis &&
                clean.axis_separation == dirty.axis_separation);
        FE_TRUE(memcmp(&clean.normal, &dirty.normal, sizeof clean.normal) == 0);
        FE_TRUE(memcmp(clean.points, dirty.points, sizeof clean.points[0] * (size_t)clean.count) == 0);
    }
}

// A kept face may be deeper than the best axis, but by no more than ten ties (5 mm), the depth to which faces are kept.
static void a_kept_axis_is_nearly_the_best(void **state)
{
    (void)state;
    int32_t touching = 0;
    for (int32_t i = 0; i < POSES; ++i) {
        fe__form a = random_form(FE__FORM_BOX), b = random_form(FE__FORM_BOX);
        fe_vec3 position = random_vector(1.2), step = random_vector(0.004);
        fe_dvec3 axis = random_direction();
        fe_quat q = random_rotation(), turn = turn_about(axis, uniform(0.0, 0.004));
        fe__relative first = relative(position, q),
                     second = relative(fe__add(position, step), fe__normalized(fe__product(turn, q)));
        fe__manifold m = collide(&a, &b, &first, MARGIN);
        fe__collide(&a, &b, &second, MARGIN, &m);
        frame f = frame_of(&second);
        double gap = brute_gap(&a, &b, &f);
        if (gap > 0.0) continue;
        ++touching;
        FE_TRUE(m.count > 0);
        FE_NEAR(deepest(&m), gap, 10.0 * 0.0005 + 3e-6);
    }
    FE_TRUE(touching > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_normal_of_a_sphere_on_a_box_is_exact),
        cmocka_unit_test(a_centre_on_or_in_the_box_leaves_by_the_nearest_face),
        cmocka_unit_test(a_plane_finds_the_deepest_corners),
        cmocka_unit_test(forms_lying_on_a_plane_have_all_their_points),
        cmocka_unit_test(parallel_capsules_touch_along_their_common_stretch),
        cmocka_unit_test(crossed_capsules_touch_at_one_point),
        cmocka_unit_test(capsules_askew_are_held_at_three_points),
        cmocka_unit_test(an_edge_across_a_face_has_points_at_both_rims),
        cmocka_unit_test(a_side_across_a_cap_has_points_at_both_rims),
        cmocka_unit_test(leaning_boxes_touch_along_their_edges),
        cmocka_unit_test(the_normal_turns_with_edges_that_pass_each_other),
        cmocka_unit_test(a_capsule_lies_on_faces_and_edges),
        cmocka_unit_test(forms_in_one_place_have_a_way_out),
        cmocka_unit_test(boxes_of_a_millimetre_are_as_exact_for_their_size),
        cmocka_unit_test(a_wide_ground_carries_small_things),
        cmocka_unit_test(the_margin_is_the_callers),
        cmocka_unit_test(the_old_points_do_not_matter),
        cmocka_unit_test(a_kept_axis_is_nearly_the_best),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
