// The builder of convex hulls: known forms, their mass, thin clouds, and a storm of random clouds that are judged by
// walks over everything (support/hull_judge.h).
//
//     build/tests/unit/test_hull_build 1000000            that many clouds
#include "core/bytes.h"
#include "core/math.h"
#include "fe_test.h"
#include "support/hull_clouds.h"
#include "support/hull_judge.h"
#include "support/hull_make.h"

#ifdef FE_SANITIZED
enum { CLOUDS = 2000 };
#else
enum { CLOUDS = 20000 };
#endif
enum { MOST = FE__HULL_VERTICES, MOST_POINTS = 4096 };
static int32_t clouds = CLOUDS;

static float points[MOST_POINTS][3];
static int32_t count;

static void add(double x, double y, double z)
{
    points[count][0] = (float)x, points[count][1] = (float)y, points[count][2] = (float)z;
    count += 1;
}

static void add_box(double x, double y, double z)
{
    for (int32_t i = 0; i < 8; ++i) add(i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z);
}

static void add_prism(int32_t sides, double radius, double half_height)
{
    for (int32_t i = 0; i < sides; ++i) {
        double sine, cosine;
        fe__sincos(6.283185307179586 * (double)i / (double)sides, &sine, &cosine);
        add(radius * cosine, half_height, radius * sine);
        add(radius * cosine, -half_height, radius * sine);
    }
}

static const fe_dvec3 some_axis = {2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0};

static void turn_and_move(double angle, double away)
{
    for (int32_t i = 0; i < count; ++i) {
        fe_dvec3 v = {(double)points[i][0], (double)points[i][1], (double)points[i][2]};
        v = cloud_turn(v, some_axis, angle);
        points[i][0] = (float)(v.x + away), points[i][1] = (float)(v.y - away), points[i][2] = (float)(v.z + away);
    }
}

static made_hull hull_of_points(int32_t most, double tolerance)
{
    made_hull made;
    FE_TRUE(make_hull(&points[0][0], count, most, tolerance, &made));
    FE_TRUE(judge_hull(&made.hull, &points[0][0], count, most));
    FE_TRUE(made.is_capped || (double)made.hull.error <= (double)made.hull.tolerance * (1.0 + 1e-6));
    return made;
}

static void check_counts(const fe__hull *h, int32_t vertices, int32_t faces)
{
    assert_int_equal(h->vertex_count, vertices);
    assert_int_equal(h->face_count, faces);
    assert_int_equal(h->edge_count, vertices + faces - 2);
}

// ---- forms ---------------------------------------------------------------------------------------------------------

static void a_box_is_a_box_whatever_lies_in_it(void **state)
{
    (void)state;
    uint64_t s = 7;
    count = 0;
    for (int32_t i = 0; i < 1000; ++i) add(0.5 * cloud_unit(&s), 0.25 * cloud_unit(&s), cloud_unit(&s));
    for (int32_t i = 0; i <= 8; ++i)
        for (int32_t k = 0; k <= 8; ++k) add(0.125 * i - 0.5, 0.25, 0.25 * k - 1.0);
    add_box(0.5, 0.25, 1.0);
    add_box(0.5, 0.25, 1.0);
    made_hull made = hull_of_points(64, 0.0);
    const fe__hull *h = &made.hull;
    check_counts(h, 8, 6);
    assert_int_equal(h->direction_count, 3);
    for (int32_t i = 0; i < 6; ++i) {
        assert_int_equal(h->faces[i].count, 4);
        fe_vec3 n = fe__hull_normal(h, i);
        FE_NEAR(fe__absf(n.x) + fe__absf(n.y) + fe__absf(n.z), 1.0, 0.0); // an axis, exactly
        FE_NEAR(h->distances[i], fe__absf(n.x) * 0.5f + fe__absf(n.y) * 0.25f + fe__absf(n.z), 0.0);
    }
    FE_NEAR(h->error, 0.0, 0.0);
    FE_NEAR(h->flatness, 0.0, 0.0);
    FE_NEAR(h->thickness, 0.5, 1e-6);
    FE_NEAR(h->inner_radius, 0.25, 1e-6);
    FE_NEAR(h->mass.volume, 1.0, 1e-12);
    FE_NEAR(h->mass.area, 7.0, 1e-12);
    free_hull(&made);
}

// A box of 1 m turned, at 10 km, where floats resolve 1 mm: still six faces. A face's corners, and so its plane, are
// each off by half a digit: 0.5 mm x sqrt 3
static void a_box_far_away_keeps_its_faces(void **state)
{
    (void)state;
    count = 0;
    add_box(0.5, 0.5, 0.5);
    turn_and_move(0.7, 1e4);
    made_hull made = hull_of_points(64, 4e-3);
    check_counts(&made.hull, 8, 6);
    FE_NEAR(made.hull.mass.volume, 1.0, 3.0 * 2.0 * 0.5e-3 * 1.7320508);
    FE_TRUE(made.hull.origin.x > 9999.0f && made.hull.origin.y < -9999.0f);
    free_hull(&made);
}

static void prisms_have_two_caps_and_their_sides(void **state)
{
    (void)state;
    for (int32_t sides = 3; sides <= 127; ++sides) {
        count = 0;
        add_prism(sides, 1.0, 0.5);
        turn_and_move(0.01 * sides, 0.0);
        made_hull made = hull_of_points(MOST, 0.0);
        check_counts(&made.hull, 2 * sides, sides + 2);
        free_hull(&made);
    }
}

// The sharp edges of two wedges that cross: the builder of another engine fails on it
static void an_axe_with_two_heads(void **state)
{
    (void)state;
    count = 0;
    for (int32_t i = 0; i < 64; ++i) {
        double sine, cosine;
        fe__sincos(3.14159265 * (double)i / 63.0 - 1.5707963, &sine, &cosine);
        for (int32_t side = -1; side <= 1; side += 2) {
            add(side * (0.3 + 0.2 * cosine), 0.3 * sine, 1e-3 * (i % 2 ? 1.0 : -1.0));
            add(side * 0.05, 0.3 * sine, i % 2 ? 0.03 : -0.03);
        }
    }
    made_hull made = hull_of_points(64, 0.0);
    FE_TRUE(made.hull.vertex_count > 40);
    free_hull(&made);
}

static void as_few_vertices_as_asked_for(void **state)
{
    (void)state;
    uint64_t s = 3;
    count = 0;
    while (count < 1000) {
        fe_dvec3 v = cloud_direction(&s);
        add(v.x, v.y, v.z);
    }
    double volume = 0.0, error = 3.0;
    for (int32_t most = 4; most <= MOST; ++most) {
        made_hull made = hull_of_points(most, 0.0);
        assert_int_equal(made.hull.vertex_count, most);
        if (most % 50 == 0) { // more vertices, a better hull
            FE_TRUE(made.hull.mass.volume > volume && (double)made.hull.error < error);
            volume = made.hull.mass.volume, error = (double)made.hull.error;
        }
        free_hull(&made);
    }
    // A cap of height d over each of 2 V - 4 triangles of the unit sphere has the area 2 pi d: d = 2 / (2 V - 4) if
    // they were caps. Farthest points are no best choice: four times that
    FE_WITHIN(error, 0.0, 4.0 * 2.0 / (2.0 * 250.0 - 4.0));
}

// Of points in one plane, or on one line, corners come first: eight are enough for any lattice
static void the_corners_of_a_lattice_are_found_first(void **state)
{
    (void)state;
    for (int32_t cells = 2; cells <= 12; ++cells) {
        count = 0;
        for (int32_t i = 0; i < cells * cells * cells; ++i) // 997 is a prime: a walk in a mixed order
            add(i * 997 % cells, i * 997 / cells % cells, i * 997 / cells / cells % cells);
        made_hull made = hull_of_points(8, 0.0);
        check_counts(&made.hull, 8, 6);
        FE_NEAR(made.hull.error, 0.0, 0.0);
        free_hull(&made);
    }
}

static void a_coarse_tolerance_drops_what_it_may(void **state)
{
    (void)state;
    uint64_t s = 11;
    count = 0;
    while (count < 1000) { // a box with 5 mm of noise, outwards and inwards
        fe_dvec3 v = cloud_on_box(&s);
        add(v.x + 0.005 * cloud_unit(&s), v.y + 0.005 * cloud_unit(&s), v.z + 0.005 * cloud_unit(&s));
    }
    made_hull fine = hull_of_points(MOST, 0.0), coarse = hull_of_points(MOST, 0.08);
    FE_TRUE(coarse.hull.vertex_count < 24 && fine.hull.vertex_count > 40);
    FE_WITHIN(coarse.hull.error, 0.0, 0.08);
    FE_NEAR(coarse.hull.tolerance, 0.08, 1e-8);
    free_hull(&fine);
    free_hull(&coarse);
}

// ---- mass ----------------------------------------------------------------------------------------------------------

// Principal moments in rising order
static void sorted_moments(const fe__hull *h, double moment[3])
{
    fe_vec3 i = h->mass.inertia;
    double a = (double)i.x, b = (double)i.y, c = (double)i.z;
    moment[0] = fe__mind(a, fe__mind(b, c)), moment[2] = fe__maxd(a, fe__maxd(b, c));
    moment[1] = a + b + c - moment[0] - moment[2];
}

// Points that are rounded to floats by d move what is measured of them by some d: 1e-6 relative
static void check_mass(double volume, double least, double middle, double most)
{
    double moment[3];
    for (int32_t turn = 0; turn < 4; ++turn) {
        if (turn) turn_and_move(0.9, 0.0);
        made_hull made = hull_of_points(MOST, 0.0);
        sorted_moments(&made.hull, moment);
        FE_NEAR(made.hull.mass.volume, volume, 1e-6 * volume);
        FE_NEAR(moment[0], volume * least, 1e-6 * volume * most);
        FE_NEAR(moment[1], volume * middle, 1e-6 * volume * most);
        FE_NEAR(moment[2], volume * most, 1e-6 * volume * most);
        free_hull(&made);
    }
}

static void masses_have_their_closed_forms(void **state)
{
    (void)state;
    count = 0; // a box: (b2 + c2) / 12
    add_box(0.5, 1.0, 1.5);
    check_mass(6.0, (1.0 + 4.0) / 12.0, (1.0 + 9.0) / 12.0, (4.0 + 9.0) / 12.0);
    count = 0; // a regular tetrahedron of edge a = 2 sqrt 2: volume a3 / (6 sqrt 2), a2 / 20
    add(1, 1, 1), add(1, -1, -1), add(-1, 1, -1), add(-1, -1, 1);
    check_mass(8.0 / 3.0, 8.0 / 20.0, 8.0 / 20.0, 8.0 / 20.0);
    count = 0; // a regular octahedron of edge a = sqrt 2: volume sqrt 2 / 3 a3, a2 / 10
    for (int32_t i = -1; i <= 1; i += 2) add(i, 0, 0), add(0, i, 0), add(0, 0, i);
    check_mass(4.0 / 3.0, 2.0 / 10.0, 2.0 / 10.0, 2.0 / 10.0);
    // A regular prism of n sides, radius 1, height 2 h: area A = n/2 sin(2 pi/n), about its axis
    // (1 + 2 cos2(pi/n)) / 6, across it half of that and h2 / 3
    count = 0;
    add_prism(64, 1.0, 0.5);
    double sine, cosine, s2, c2;
    fe__sincos(6.283185307179586 / 64.0, &sine, &cosine);
    fe__sincos(6.283185307179586 / 128.0, &s2, &c2);
    double axial = (1.0 + 2.0 * c2 * c2) / 6.0, across = 0.5 * axial + 0.25 / 3.0;
    check_mass(32.0 * sine, across, across, axial);
}

// The principal axes turn with the points: R diag(I) R^T is that of the box turned, to 1e-6 of its largest entry
static void principal_axes_turn_with_the_points(void **state)
{
    (void)state;
    count = 0;
    add_box(0.5, 1.0, 1.5);
    turn_and_move(0.6, 3.0);
    made_hull made = hull_of_points(64, 0.0);
    const fe__hull_mass *m = &made.hull.mass;
    for (int32_t k = 0; k < 3; ++k) {
        fe_dvec3 own = {k == 0, k == 1, k == 2}, world = fe__drotate(m->axes, own);
        double along = k == 0 ? (double)m->inertia.x : k == 1 ? (double)m->inertia.y : (double)m->inertia.z;
        fe_dvec3 back = cloud_turn(world, some_axis, -0.6); // in the box's axes
        double expected = 6.0 * (back.x * back.x * 13.0 + back.y * back.y * 10.0 + back.z * back.z * 5.0) / 12.0;
        FE_NEAR(along, expected, 1e-6 * 6.5);
    }
    FE_NEAR(m->centre.x + (double)made.hull.origin.x, 3.0, 1e-6);
    FE_NEAR(m->centre.y + (double)made.hull.origin.y, -3.0, 1e-6);
    free_hull(&made);
}

// ---- thin clouds ---------------------------------------------------------------------------------------------------

static void check_refused(double thickness, double least)
{
    made_hull made;
    FE_TRUE(!make_hull(&points[0][0], count, 64, 0.0, &made));
    FE_NEAR(made.refusal.thickness, thickness, 1e-6 * (1.0 + least));
    FE_NEAR(made.refusal.least, least, 1e-6 * least);
}

static void thin_clouds_are_refused(void **state)
{
    (void)state;
    made_hull made;
    count = 0;
    for (int32_t i = 0; i < 10; ++i) add(1.0, 2.0, 3.0);
    check_refused(0.0, 5e-4);
    count = 0;
    for (int32_t i = 0; i < 10; ++i) add(i, 2.0 * i, 3.0 * i);
    check_refused(0.0, 27e-4);
    count = 0;
    add_box(0.5, 0.0, 0.5);
    check_refused(0.0, 5e-4);
    // 0.5 mm, and 1e-4 of the extent
    static const double sizes[2] = {0.5, 50.0}, least[2] = {5e-4, 1e-2};
    for (int32_t i = 0; i < 2; ++i) {
        count = 0;
        add_box(sizes[i], 0.49 * least[i], sizes[i]);
        check_refused(0.98 * least[i], least[i]);
        turn_and_move(0.5, 0.0);
        FE_TRUE(!make_hull(&points[0][0], count, 64, 0.0, &made));
        count = 0;
        add_box(sizes[i], 0.51 * least[i], sizes[i]);
        made = hull_of_points(64, 0.0);
        check_counts(&made.hull, 8, 6);
        free_hull(&made);
    }
}

// Few vertices may make a thin hull of a cloud that is not: no refusal
static void a_thick_cloud_is_not_refused_for_its_few_vertices(void **state)
{
    (void)state;
    count = 0;
    add_box(1.0, 3e-4, 1.0);
    made_hull made = hull_of_points(4, 0.0);
    assert_int_equal(made.hull.vertex_count, 4);
    free_hull(&made);
}

// ---- the storm -----------------------------------------------------------------------------------------------------

// Is the cloud as thin as the refusal says? Along its normal; without one, within a radius of the line between its
// farthest ends
static int32_t is_thin(const cloud *c, const fe__hull_refusal *r)
{
    fe_dvec3 n = r->normal;
    if (fe__ddot(n, n) == 0.0) return r->thickness < r->least;
    double low = 1e300, high = -1e300, largest = 0.0;
    for (int32_t i = 0; i < c->count; ++i) {
        fe_dvec3 p = {(double)c->points[i][0], (double)c->points[i][1], (double)c->points[i][2]};
        low = fe__mind(low, fe__ddot(n, p)), high = fe__maxd(high, fe__ddot(n, p));
        largest = fe__maxd(largest, fe__absd(p.x) + fe__absd(p.y) + fe__absd(p.z));
    }
    // rounded to the grid, 1e-3 of what is refused at most
    return high - low <= r->least * 1.001 + 1e-14 * largest;
}

static const int32_t most_of[4] = {MOST, 64, 16, 5};
static const double tolerances[8] = {0.0, 0.0, 0.0, 0.0, 1e-6, 1e-3, 0.02, 0.5};

static void storms_of_points_become_hulls(void **state)
{
    (void)state;
    int32_t refused = 0, bad = 0;
    for (int32_t i = 0; i < clouds; ++i) {
        cloud c;
        made_hull made;
        cloud_make(&c, (uint64_t)i);
        int32_t most = most_of[i % 4], fine;
        if (!make_hull(&c.points[0][0], c.count, most, tolerances[i / 4 % 8], &made)) {
            refused += 1;
            fine = is_thin(&c, &made.refusal);
        } else {
            const fe__hull *h = &made.hull;
            fine = judge_hull(h, &c.points[0][0], c.count, most) && h->mass.volume > 0.0 && h->inner_radius > 0.0f;
            fine &= made.is_capped || (double)h->error <= (double)h->tolerance + JUDGE_ROUNDING * (double)h->extent;
        }
        free_hull(&made);
        if (fine) continue;
        print_error("cloud %d of kind %d, %d points, at most %d vertices\n", (int)i, (int)c.kind, (int)c.count,
                    (int)most);
        bad += 1;
    }
    print_message("%d clouds, %d refused as thin\n", (int)clouds, (int)refused);
    assert_int_equal(bad, 0);
    FE_WITHIN(refused, 0, clouds / 4);
}

static void many_points_are_no_trouble(void **state)
{
    (void)state;
    enum { MANY = 100000 };
    float(*many)[3] = malloc(MANY * sizeof *many);
    assert_non_null(many);
    uint64_t s = 5;
    for (int32_t i = 0; i < MANY; ++i) {
        fe_dvec3 v = cloud_direction(&s);
        many[i][0] = (float)v.x, many[i][1] = (float)v.y, many[i][2] = (float)v.z;
    }
    made_hull made;
    FE_TRUE(make_hull(&many[0][0], MANY, 64, 0.0, &made));
    FE_TRUE(judge_hull(&made.hull, &many[0][0], MANY, 64));
    free_hull(&made);
    free(many);
}

// ---- the same bytes everywhere -------------------------------------------------------------------------------------

static uint64_t fingerprint_of_hulls(int32_t hulls)
{
    fe__hash hash = fe__hash_begin();
    for (int32_t i = 0; i < hulls; ++i) {
        cloud c;
        made_hull made;
        cloud_make(&c, (uint64_t)i);
        if (!make_hull(&c.points[0][0], c.count, most_of[i % 4], tolerances[i / 4 % 8], &made)) continue;
        const fe__hull *h = &made.hull;
        const float *floats = h->vertices.x;
        for (int32_t k = 0; k < (int32_t)(h->size / 4) && floats + k < (const float *)(const void *)h->edges; ++k)
            fe__hash_float(&hash, floats[k]);
        for (int32_t k = 0; k < 2 * h->edge_count; ++k) {
            fe__hash_i32(&hash, h->edges[k].next | h->edges[k].face << 16);
            fe__hash_i32(&hash, h->edges[k].origin | h->corners[k] << 16);
        }
        fe__hash_float(&hash, h->error), fe__hash_float(&hash, h->thickness), fe__hash_float(&hash, h->flatness);
        fe__hash_double(&hash, h->mass.volume), fe__hash_double(&hash, h->mass.area);
        fe__hash_dvec3(&hash, h->mass.centre), fe__hash_vec3(&hash, h->mass.inertia);
        free_hull(&made);
    }
    return fe__hash_end(&hash);
}

// Written by one machine, asked on all
#define FINGERPRINT UINT64_C(0x56366cfec34144df)

static void hulls_are_the_same_on_every_machine(void **state)
{
    (void)state;
    uint64_t found = fingerprint_of_hulls(1000);
    if (found != FINGERPRINT) print_error("0x%016llx\n", (unsigned long long)found);
    FE_TRUE(found == FINGERPRINT);
}

int main(int argc, char **argv)
{
    if (argc > 1) clouds = atoi(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_is_a_box_whatever_lies_in_it),
        cmocka_unit_test(a_box_far_away_keeps_its_faces),
        cmocka_unit_test(prisms_have_two_caps_and_their_sides),
        cmocka_unit_test(an_axe_with_two_heads),
        cmocka_unit_test(as_few_vertices_as_asked_for),
        cmocka_unit_test(the_corners_of_a_lattice_are_found_first),
        cmocka_unit_test(a_coarse_tolerance_drops_what_it_may),
        cmocka_unit_test(masses_have_their_closed_forms),
        cmocka_unit_test(principal_axes_turn_with_the_points),
        cmocka_unit_test(thin_clouds_are_refused),
        cmocka_unit_test(a_thick_cloud_is_not_refused_for_its_few_vertices),
        cmocka_unit_test(storms_of_points_become_hulls),
        cmocka_unit_test(many_points_are_no_trouble),
        cmocka_unit_test(hulls_are_the_same_on_every_machine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
