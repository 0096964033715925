// Distance (GJK) and depth (EPA) of cores, against brute force in double: corners and edges one by one, all separating
// axes.
#include "fe_test.h"

#include "collision/form/gjk.h"

#include "collision_cases.h"

enum { POSES = 20000 };
#define NO_LIMIT 1e30
// of the cores' size: double rounding is 1e-16, some tens of operations, and EPA's faces are one within 1e-11
#define PRECISION 1e-10

static fe__cores cores_of(const fe__form *a, const fe__form *b, const frame *r)
{
    return (fe__cores){a, b, r->position, r->x, r->y, r->z, NULL};
}

// Nearest points of the segments p, p + d and q, q + e: the pair of lines, then every end against the other segment.
static double point_to_segment(fe_dvec3 x, fe_dvec3 p, fe_dvec3 d)
{
    double square = fe__ddot(d, d), t = square > 0.0 ? fe__ddot(fe__dsub(x, p), d) / square : 0.0;
    fe_dvec3 off = fe__dsub(x, fe__dadd(p, fe__dscale(fe__mind(fe__maxd(t, 0.0), 1.0), d)));
    return sqrt(fe__ddot(off, off));
}

static double segment_to_segment(fe_dvec3 p, fe_dvec3 d, fe_dvec3 q, fe_dvec3 e)
{
    double best = fe__mind(fe__mind(point_to_segment(p, q, e), point_to_segment(fe__dadd(p, d), q, e)),
                           fe__mind(point_to_segment(q, p, d), point_to_segment(fe__dadd(q, e), p, d)));
    fe_dvec3 n = fe__dcross(d, e), pq = fe__dsub(q, p);
    double square = fe__ddot(n, n);
    if (square < 1e-12 * fe__ddot(d, d) * fe__ddot(e, e) || square == 0.0) return best;
    double s = fe__ddot(fe__dcross(pq, e), n) / square, t = fe__ddot(fe__dcross(pq, d), n) / square;
    if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return best;
    return fe__mind(best, fe__absd(fe__ddot(pq, n)) / sqrt(square));
}

static const int8_t edges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                    {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

// Of cores that do not overlap: some corner and the other core, or two edges, are nearest.
static double brute_distance(const fe__form *a, const fe__form *b, const frame *r)
{
    fe__form core_a = *a, core_b = *b;
    core_a.radius = core_b.radius = 0.0f;
    fe_dvec3 ca[8], cb[8];
    core_corners(a, ca);
    corners_in_a(b, r, cb);
    double best = 1e300;
    for (int32_t i = 0; i < 8; ++i) {
        best = fe__mind(best, surface_distance(&core_a, cb[i]));
        best = fe__mind(best, surface_distance(&core_b, into_b(r, ca[i])));
    }
    for (int32_t i = 0; i < 12; ++i) {
        for (int32_t j = 0; j < 12; ++j) {
            fe_dvec3 p = ca[edges[i][0]], q = cb[edges[j][0]];
            best = fe__mind(best, segment_to_segment(p, fe__dsub(ca[edges[i][1]], p), q, fe__dsub(cb[edges[j][1]], q)));
        }
    }
    return best;
}

static void assert_distance(const fe__form *a, const fe__form *b, const fe__relative *r, double size)
{
    frame f = frame_of(r);
    fe__cores cores = cores_of(a, b, &f);
    fe__gjk g;
    fe__gjk_distance(&cores, NO_LIMIT, &g);
    double gap = brute_gap(a, b, &f);
    if (gap > PRECISION * size) {
        double expected = brute_distance(a, b, &f);
        if (!(fe__absd(g.distance - expected) <= PRECISION * size) || g.overlap) print_case(a, b, r);
        FE_TRUE(!g.overlap);
        FE_NEAR(g.distance, expected, PRECISION * size);
        // the points are points of the cores, and as far apart as that
        fe__form core_a = *a, core_b = *b;
        core_a.radius = core_b.radius = 0.0f;
        fe_dvec3 d = fe__dsub(g.on_b, g.on_a);
        FE_WITHIN(surface_distance(&core_a, g.on_a), -INFINITY, PRECISION * size);
        FE_WITHIN(surface_distance(&core_b, into_b(&f, g.on_b)), -INFINITY, PRECISION * size);
        FE_NEAR(sqrt(fe__ddot(d, d)), expected, PRECISION * size);
        return;
    }
    if (gap > -PRECISION * size) return; // touching: either answer
    if (!g.overlap) print_case(a, b, r);
    FE_TRUE(g.overlap);
    fe__penetration p = fe__epa_depth(&cores, &g);
    if (!(fe__absd(p.depth + gap) <= PRECISION * size)) print_case(a, b, r);
    FE_NEAR(p.depth, -gap, PRECISION * size);
    FE_NEAR(fe__ddot(p.normal, p.normal), 1.0, 1e-12);
    fe_dvec3 d = fe__dsub(p.on_a, p.on_b);
    FE_NEAR(fe__ddot(d, p.normal), p.depth, PRECISION * size);
}

static void agree_with_brute_force(int32_t type_a, int32_t type_b)
{
    for (int32_t i = 0; i < POSES; ++i) {
        fe__form a = random_form(type_a), b = random_form(type_b);
        fe__relative r = relative(random_vector(1.6), random_rotation());
        assert_distance(&a, &b, &r, 4.0);
    }
}

static void boxes_and_segments_agree_with_brute_force(void **state)
{
    (void)state;
    agree_with_brute_force(FE__FORM_BOX, FE__FORM_BOX);
    agree_with_brute_force(FE__FORM_BOX, FE__FORM_CAPSULE);
    agree_with_brute_force(FE__FORM_CAPSULE, FE__FORM_CAPSULE);
}

// All 24 rotations of a cube onto itself, and positions at which faces, edges and corners fall together.
static void aligned_boxes_and_segments_agree_with_brute_force(void **state)
{
    (void)state;
    const fe_vec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const fe__form forms[3] = {box(0.5f, 0.25f, 0.75f), capsule(0.5f, 0.125f), box(0.5f, 0.5f, 0.5f)};
    for (int32_t pair = 0; pair < 9; ++pair) {
        const fe__form *a = &forms[pair / 3], *b = &forms[pair % 3];
        for (int32_t turn = 0; turn < 36; ++turn) {
            fe_vec3 x = axes[turn / 6], y = axes[turn % 6];
            if (fe__dot(x, y) != 0.0f) continue;
            for (int32_t place = 0; place < 7 * 7 * 7; ++place) {
                fe_vec3 p = {0.25f * (float)(place % 7 - 3), 0.25f * (float)(place / 7 % 7 - 3),
                             0.25f * (float)(place / 49 - 3)};
                fe__relative r = {p, {x, y, fe__cross(x, y)}};
                if (a->type == FE__FORM_CAPSULE && b->type == FE__FORM_CAPSULE) continue; // flat: below
                assert_distance(a, b, &r, 2.0);
            }
        }
    }
}

// The law does not know a scale: 1 mm to 100 km.
static void precision_is_relative_to_the_size(void **state)
{
    (void)state;
    const float scales[4] = {0.001f, 0.02f, 500.0f, 100000.0f};
    for (int32_t i = 0; i < POSES; ++i) {
        float s = scales[i & 3];
        fe__form a = random_form(FE__FORM_BOX), b = random_form(i & 4 ? FE__FORM_BOX : FE__FORM_CAPSULE);
        a.half = fe__scale(s, a.half), b.half = fe__scale(s, b.half), b.half_height *= s;
        fe__relative r = relative(fe__scale(s, random_vector(1.6)), random_rotation());
        assert_distance(&a, &b, &r, 4.0 * (double)s);
    }
}

static fe__penetration depth_of(const fe__form *a, const fe__form *b, const fe__relative *r)
{
    frame f = frame_of(r);
    fe__cores cores = cores_of(a, b, &f);
    fe__gjk g;
    fe__gjk_distance(&cores, NO_LIMIT, &g);
    FE_TRUE(g.overlap);
    return fe__epa_depth(&cores, &g);
}

// Two segments that cross have no depth: out along their common perpendicular, to B's side.
static void crossing_segments_part_across_both(void **state)
{
    (void)state;
    fe__form a = capsule(1.0f, 0.1f), b = capsule(0.5f, 0.1f);
    for (int32_t i = 0; i < 1000; ++i) {
        // both in the plane z = const after a turn about z: exactly flat; B's centre within A's length
        double angle = uniform(0.1, 3.0);
        fe__relative r =
            relative(fe__vec3(0.0f, (float)uniform(-0.9, 0.9), 0.0f), turn_about((fe_dvec3){0.0, 0.0, 1.0}, angle));
        fe__penetration p = depth_of(&a, &b, &r);
        FE_NEAR(p.depth, 0.0, PRECISION);
        FE_NEAR(fe__absd(p.normal.z), 1.0, 1e-12);
    }
}

static void points_and_segments_in_one_place_part_somewhere(void **state)
{
    (void)state;
    fe__form s = sphere(0.1f), c = capsule(0.5f, 0.1f);
    fe__relative r = relative(fe__vec3(0.0f, 0.0f, 0.0f), fe__identity());
    fe__penetration p = depth_of(&s, &s, &r);
    FE_NEAR(p.depth, 0.0, 0.0);
    FE_NEAR(fe__ddot(p.normal, p.normal), 1.0, 1e-12);
    for (int32_t i = -4; i <= 4; ++i) {
        r.position.y = 0.1f * (float)i;
        const fe__form *other[2] = {&s, &c};
        for (int32_t k = 0; k < 2; ++k) { // across the segment
            p = depth_of(&c, other[k], &r);
            FE_NEAR(p.depth, 0.0, PRECISION);
            FE_NEAR(p.normal.y, 0.0, 1e-12);
            FE_NEAR(fe__ddot(p.normal, p.normal), 1.0, 1e-12);
        }
    }
}

// Beyond the limit it may stop early, but never says nearer than the limit.
static void a_limit_only_cuts_what_is_farther(void **state)
{
    (void)state;
    for (int32_t i = 0; i < POSES; ++i) {
        fe__form a = random_form(FE__FORM_BOX), b = random_form(FE__FORM_BOX);
        fe__relative r = relative(random_vector(2.5), random_rotation());
        frame f = frame_of(&r);
        fe__cores cores = cores_of(&a, &b, &f);
        fe__gjk all, cut;
        double limit = uniform(0.0, 1.0);
        fe__gjk_distance(&cores, NO_LIMIT, &all);
        fe__gjk_distance(&cores, limit, &cut);
        FE_TRUE((all.distance > limit) == (cut.distance > limit));
        if (all.distance <= limit) FE_NEAR(cut.distance, all.distance, 0.0);
    }
}

// Whatever points of the difference it begins with
static void a_guess_changes_no_distance(void **state)
{
    (void)state;
    for (int32_t i = 0; i < POSES; ++i) {
        fe__form a = random_form(FE__FORM_BOX), b = random_form(FE__FORM_BOX);
        fe__relative r = relative(random_vector(2.5), random_rotation());
        frame f = frame_of(&r);
        fe__cores cores = cores_of(&a, &b, &f);
        fe__gjk known, found;
        fe__gjk_distance(&cores, NO_LIMIT, &known);
        found.count = 1 + i % 3;
        for (int32_t k = 0; k < found.count; ++k)
            found.vertex[k] = fe__cores_support(&cores, fe__widen(random_vector(1.0)));
        fe_dvec3 p = found.vertex[0].difference;
        if (found.count == 3) {
            fe_dvec3 n = fe__dcross(fe__dsub(found.vertex[1].difference, p), fe__dsub(found.vertex[2].difference, p));
            if (fe__ddot(n, n) < 1e-4) found.count = 2; // no triangle
        }
        fe__gjk_distance_from(&cores, NO_LIMIT, &found);
        FE_NEAR(found.distance, known.distance, PRECISION * 4.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_and_segments_agree_with_brute_force),
        cmocka_unit_test(aligned_boxes_and_segments_agree_with_brute_force),
        cmocka_unit_test(precision_is_relative_to_the_size),
        cmocka_unit_test(crossing_segments_part_across_both),
        cmocka_unit_test(points_and_segments_in_one_place_part_somewhere),
        cmocka_unit_test(a_limit_only_cuts_what_is_farther),
        cmocka_unit_test(a_guess_changes_no_distance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
