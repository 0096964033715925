// Rays against meshes: no ray slips between triangles, and each is the nearest of all triangles, asked one by one in
// double.
//
//     build/tests/unit/test_mesh_rays 1000000             that many rays of a sort
#include "fe_test.h"
#include "support/mesh_make.h"

#ifdef FE_SANITIZED
enum { RAYS = 5000 };
#else
enum { RAYS = 100000 };
#endif
static int32_t rays = RAYS;

static made_mesh mesh_of_soup(int32_t is_two_sided)
{
    made_mesh m;
    fe__mesh_source source = soup_source(&made);
    source.is_two_sided = is_two_sided;
    FE_TRUE(make_mesh_of(&source, &m));
    return m;
}

static double length(fe_dvec3 a) { return sqrt(fe__ddot(a, a)); }

// A point of a mesh: a vertex, on an edge, inside of a triangle, or `away` beside a vertex
static fe_dvec3 target_on(const fe__mesh *m, int32_t kind, double away)
{
    double part = 0.5 * (soup_random(&dice) + 1.0);
    int32_t slot = fe__mini((int32_t)(part * m->triangle_count), m->triangle_count - 1), k = (int32_t)(dice >> 40) % 3;
    fe_dvec3 v[3];
    fe__mesh_corners(m, slot, v);
    double s = 0.5 * (soup_random(&dice) + 1.0), t = 0.5 * (soup_random(&dice) + 1.0) * (1.0 - s);
    if (kind == 0) return v[k];
    if (kind == 1) return fe__dadd(v[k], fe__dscale(s, fe__dsub(v[(k + 1) % 3], v[k])));
    if (kind == 2)
        return fe__dadd(v[0], fe__dadd(fe__dscale(s, fe__dsub(v[1], v[0])), fe__dscale(t, fe__dsub(v[2], v[0]))));
    return fe__dadd(v[k], random_point(away));
}

// ---- watertight ----------------------------------------------------------------------------------------------------
// Both ends lie beyond all heights: on different sides, whatever is aimed at
static void no_ray_slips_through_a_terrain(void **state)
{
    (void)state;
    soup_terrain(&made, 60, 1.0, 0.5, &dice);
    made_mesh m = mesh_of_soup(0);
    int32_t missed = 0;
    for (int32_t i = 0; i < rays; ++i) {
        static const double beside[4] = {1e-9, 1e-7, 1e-5, 1e-3};
        fe_dvec3 aim = target_on(&m.mesh, i % 4, beside[i / 4 % 4]), side = random_point(2.0);
        if (fe__absd(aim.x) > 25.0 || fe__absd(aim.z) > 25.0) continue;
        side.y = 1.0 + fe__absd(side.y);
        if (i % 8 < 4) side.x = 0.0, side.z = i % 16 < 8 ? 0.0 : side.z; // along axes too
        double up = (0.6 - aim.y) / side.y + 1.0, down = (aim.y + 0.6) / side.y + 1.0;
        fe_dvec3 from = fe__dadd(aim, fe__dscale(up, side)), to = fe__dsub(aim, fe__dscale(down, side));
        fe__mesh_hit hit;
        if (!mesh_ray(&m.mesh, from, fe__dsub(to, from), 1.0, &hit)) {
            if (!missed++) print_error("ray %d at (%.17g %.17g %.17g)\n", (int)i, aim.x, aim.y, aim.z);
            continue;
        }
        FE_TRUE(hit.hit.normal.y > 0.0);
        if (side.x == 0.0 && side.z == 0.0) // a slanted one may come out and in again
            FE_TRUE(!mesh_ray(&m.mesh, to, fe__dsub(from, to), 1.0, &hit));
    }
    assert_int_equal(missed, 0);
    free_mesh(&m);
}

static void closed_meshes_let_nothing_out(void **state)
{
    (void)state;
    static const double scales[3] = {1.0, 1e-4, 3e4};
    for (int32_t round = 0; round < 3; ++round) {
        free_soup(&made);
        soup_ball(&made, 4);
        for (int32_t i = 0; i < made.vertex_count; ++i)
            for (int32_t k = 0; k < 3; ++k) made.vertices[i][k] *= (float)scales[round];
        made_mesh one = mesh_of_soup(0), two = mesh_of_soup(1);
        assert_int_equal(one.mesh.open_count, 0);
        for (int32_t i = 0; i < rays / 3; ++i) {
            fe_dvec3 from = random_point(0.5 * scales[round]);
            fe_dvec3 way = fe__dsub(target_on(&two.mesh, i % 4, 1e-7 * scales[round]), from);
            fe__mesh_hit hit;
            FE_TRUE(mesh_ray(&two.mesh, from, way, 5.0, &hit));
            FE_TRUE(hit.is_back && fe__ddot(hit.hit.normal, way) < 0.0);
            FE_WITHIN(hit.hit.t, 0.98, 1.001);
            FE_TRUE(!mesh_ray(&one.mesh, from, way, 5.0, &hit));
            fe_dvec3 outside = fe__dadd(from, fe__dscale(5.0, way)); // and from outside
            FE_TRUE(mesh_ray(&one.mesh, outside, fe__dscale(-1.0, way), 5.0, &hit));
            FE_TRUE(!hit.is_back && fe__ddot(hit.hit.normal, way) > 0.0);
        }
        free_mesh(&one);
        free_mesh(&two);
    }
}

// A start at 1e9 m is known to 1e-7 m: no ray at the inside of the ball's shadow misses, and points are as exact
static void far_starts_lose_nothing(void **state)
{
    (void)state;
    soup_ball(&made, 4);
    made_mesh m = mesh_of_soup(0);
    for (int32_t i = 0; i < rays / 10; ++i) {
        double far = i % 2 ? 1e9 : 1e6;
        fe_dvec3 out = random_point(1.0), aim = random_point(0.5);
        if (length(out) < 0.1) continue;
        fe_dvec3 from = fe__dadd(aim, fe__dscale(far / length(out), out)), way = fe__dscale(2.0, fe__dsub(aim, from));
        fe__mesh_hit hit;
        FE_TRUE(mesh_ray(&m.mesh, from, way, 1.0, &hit));
        double r = length(fe__dadd(from, fe__dscale(hit.hit.t, way)));
        FE_WITHIN(r, 0.985 - 1e-15 * far, 1.0 + 1e-15 * far);
    }
    free_mesh(&m);
}

// ---- against all triangles -----------------------------------------------------------------------------------------
// Moeller and Trumbore in double: another formula than the one in use. -1: no hit; out_edge: how near to its rim
static double ray_triangle(const fe_dvec3 v[3], fe_dvec3 o, fe_dvec3 d, int32_t is_two_sided, double *out_edge)
{
    fe_dvec3 e = fe__dsub(v[1], v[0]), f = fe__dsub(v[2], v[0]), p = fe__dcross(d, f), s = fe__dsub(o, v[0]);
    double det = fe__ddot(e, p);
    *out_edge = 1.0;
    if (det == 0.0 || (!is_two_sided && det < 0.0)) return -1.0;
    fe_dvec3 q = fe__dcross(s, e);
    double a = fe__ddot(s, p) / det, b = fe__ddot(d, q) / det, t = fe__ddot(f, q) / det;
    *out_edge = fe__mind(fe__mind(fe__absd(a), fe__absd(b)), fe__absd(1.0 - a - b));
    *out_edge = fe__mind(*out_edge, fe__mind(fe__absd(t), fe__absd(1.0 - t)));
    return a < 0.0 || b < 0.0 || a + b > 1.0 || t < 0.0 || t > 1.0 ? -1.0 : t;
}

static void check_against_all(const fe__mesh *m, fe_dvec3 from, fe_dvec3 way, int32_t *out_hits)
{
    double best = 2.0, doubt = 1.0;
    int32_t number = -1;
    for (int32_t slot = 0; slot < m->triangle_count; ++slot) {
        fe_dvec3 v[3];
        double edge;
        fe__mesh_corners(m, slot, v);
        double t = ray_triangle(v, from, way, m->is_two_sided, &edge);
        doubt = fe__mind(doubt, edge);
        if (t >= 0.0 && t < best) best = t, number = fe__mesh_number(m, slot);
    }
    if (doubt < 1e-9) return; // a rim: either answer may be right
    fe__mesh_hit hit;
    int32_t is_hit = mesh_ray(m, from, way, 1.0, &hit);
    assert_int_equal(is_hit, number >= 0);
    if (!is_hit) return;
    *out_hits += 1;
    FE_NEAR(hit.hit.t, best, 1e-9);
    if (hit.hit.triangle == number) {
        fe_dvec3 v[3], at = {0.0, 0.0, 0.0};
        fe__mesh_corners(m, hit.hit.index, v);
        for (int32_t k = 0; k < 3; ++k) at = fe__dadd(at, fe__dscale(hit.weights[k], v[k]));
        FE_WITHIN(length(fe__dsub(at, fe__dadd(from, fe__dscale(hit.hit.t, way)))), 0.0, 1e-9);
        return;
    }
    print_error("triangle %d, not %d\n", (int)hit.hit.triangle, (int)number);
    FE_TRUE(hit.hit.triangle == number);
}

static void rays_are_those_of_all_triangles(void **state)
{
    (void)state;
    int32_t hits = 0;
    for (int32_t round = 0; round < 12; ++round) {
        free_soup(&made);
        static const double sizes[3] = {0.1, 0.5, 0.02};
        soup_scatter(&made, 1000, sizes[round % 3], &dice);
        made_mesh m = mesh_of_soup(round & 1);
        for (int32_t i = 0; i < rays / 400; ++i) {
            fe_dvec3 from = random_point(1.5), way = random_point(3.0);
            if (i % 5 == 0) way.x = 0.0;
            if (i % 7 == 0) way.y = way.z = 0.0;
            check_against_all(&m.mesh, from, way, &hits);
        }
        free_mesh(&m);
    }
    FE_TRUE(hits > rays / 400);
}

// Slivers of 1:1000 side by side, hung on a T: those in the plane of the ray or its rim aside, as all triangles
static void slivers_are_met(void **state)
{
    (void)state;
    int32_t hits = 0;
    for (int32_t i = 0; i < 500; ++i) {
        uint32_t a = soup_vertex(&made, i * 1e-3, 0, 0), b = soup_vertex(&made, (i + 1) * 1e-3, 0, 0),
                 c = soup_vertex(&made, i * 1e-3, 0, 1), d = soup_vertex(&made, (i + 1) * 1e-3, 0, 1);
        soup_triangle(&made, b, a, c), soup_triangle(&made, b, c, d);
    }
    uint32_t a = soup_vertex(&made, 0, 0, 0), b = soup_vertex(&made, 0.5, 0, 0), c = soup_vertex(&made, 0.25, 0, -1);
    soup_triangle(&made, a, b, c);
    made_mesh m = mesh_of_soup(0);
    for (int32_t i = 0; i < rays / 100; ++i) {
        fe_dvec3 aim = {0.25 + 0.3 * soup_random(&dice), 0.0, soup_random(&dice)}, up = random_point(1.0);
        up.y = 0.1 + fe__absd(up.y);
        check_against_all(&m.mesh, fe__dadd(aim, up), fe__dscale(-2.0, up), &hits);
    }
    FE_TRUE(hits > rays / 300);
    free_mesh(&m);
}

// ---- boxes that move -----------------------------------------------------------------------------------------------
typedef struct offers {
    int32_t times[1200]; // by slot
} offers;

static double count_offer(void *context, int32_t slot)
{
    offers *o = context;
    o->times[slot] += 1;
    return 1.0;
}

// Does the box, `wider` on each side, meet the bounds of a triangle on its way?
static int32_t meets_bounds(const fe__mesh *m, int32_t slot, const fe__mesh_way *way, double wider)
{
    fe_dvec3 v[3];
    fe__mesh_corners(m, slot, v);
    const double o[3] = {way->origin.x, way->origin.y, way->origin.z},
                 half[3] = {way->half.x, way->half.y, way->half.z},
                 d[3] = {way->translation.x, way->translation.y, way->translation.z};
    const double a[3] = {v[0].x, v[0].y, v[0].z}, b[3] = {v[1].x, v[1].y, v[1].z}, c[3] = {v[2].x, v[2].y, v[2].z};
    double enter = 0.0, leave = 1.0;
    for (int32_t k = 0; k < 3; ++k) {
        double least = fe__mind(fe__mind(a[k], b[k]), c[k]) - half[k] - wider - o[k],
               most = fe__maxd(fe__maxd(a[k], b[k]), c[k]) + half[k] + wider - o[k];
        if (d[k] == 0.0) {
            if (least > 0.0 || most < 0.0) return 0;
            continue;
        }
        enter = fe__maxd(enter, fe__mind(least / d[k], most / d[k]));
        leave = fe__mind(leave, fe__maxd(least / d[k], most / d[k]));
    }
    return enter <= leave;
}

static int32_t check_offers(const fe__mesh *m, const fe__mesh_way *way, int32_t simd)
{
    const double doubt = 1e-9;
    offers o = {{0}};
    int32_t met = 0;
    fe__mesh_casts_of(simd)->sweep(m, way, 1.0, count_offer, &o);
    for (int32_t slot = 0; slot < m->triangle_count; ++slot) {
        int32_t must = meets_bounds(m, slot, way, -doubt), may = meets_bounds(m, slot, way, doubt);
        FE_WITHIN(o.times[slot], must, may);
        met += must;
    }
    return met;
}

// Each triangle whose bounds the box meets is offered, once, and no other
static void boxes_are_offered_what_lies_on_their_way(void **state)
{
    (void)state;
    int32_t met = 0;
    for (int32_t round = 0; round < 6; ++round) {
        free_soup(&made);
        soup_scatter(&made, 1000, round % 2 ? 0.1 : 0.4, &dice);
        made_mesh m = mesh_of_soup(0);
        fe__mesh scaled;
        assert_int_equal(fe__mesh_scale(&m.mesh, (fe_vec3){-1.5f, 0.5f, 2.0f}, &scaled), -1);
        for (int32_t i = 1; i < 20; ++i) {
            fe_dvec3 half = random_point(0.2);
            fe__mesh_way way = {random_point(1.5), random_point(2.0), {fe__absd(half.x), fe__absd(half.y), half.z}};
            way.half.z = i % 3 ? fe__absd(half.z) : 0.0;
            if (i % 5 == 0) way.translation.x = 0.0;
            if (i % 7 == 0) way.translation.y = way.translation.z = 0.0;
            for (int32_t simd = FE_SIMD_PLAIN; simd <= FE_SIMD_NEON; ++simd)
                if (fe__kernels_of(simd)) met += check_offers(i % 2 ? &scaled : &m.mesh, &way, simd);
        }
        free_mesh(&m);
    }
    FE_TRUE(met > 1000);
}

// ---- laws ----------------------------------------------------------------------------------------------------------
// The same triangle twice from other corners is dropped; here its vertices differ by what the ray does not see: z
static void of_equal_distances_the_lowest_number_is_hit(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 100; ++i) { // all in y = 0 over the origin
        double s = 1.0 + 0.5 * soup_random(&dice);
        uint32_t a = soup_vertex(&made, s, 0, s), b = soup_vertex(&made, 0, 0, -s), c = soup_vertex(&made, -s, 0, s);
        soup_triangle(&made, a, b, c);
    }
    made_mesh m = mesh_of_soup(0);
    fe__mesh_hit hit;
    fe_dvec3 from = {0.0625, 2.0, 0.125}, way = {0.0, -4.0, 0.0};
    FE_TRUE(mesh_ray(&m.mesh, from, way, 1.0, &hit));
    assert_int_equal(hit.hit.triangle, 0);
    FE_NEAR(hit.hit.t, 0.5, 0.0);
    free_mesh(&m);
}

// At a vertex six triangles meet, or eight: the first of those that hold it
static void at_a_vertex_the_lowest_number_is_hit(void **state)
{
    (void)state;
    soup_terrain(&made, 12, 1.0, 0.4, &dice);
    made_mesh m = mesh_of_soup(0);
    for (uint32_t i = 0; i < 11 * 11; ++i) {
        uint32_t vertex = (i / 11 + 1) * 13 + i % 11 + 1;
        int32_t first = 0;
        const uint32_t(*t)[3] = (const uint32_t(*)[3])made.triangles;
        while (t[first][0] != vertex && t[first][1] != vertex && t[first][2] != vertex) ++first;
        const float *v = made.vertices[vertex];
        fe__mesh_hit hit;
        FE_TRUE(mesh_ray(&m.mesh, (fe_dvec3){v[0], 2.0, v[2]}, (fe_dvec3){0.0, -4.0, 0.0}, 1.0, &hit));
        assert_int_equal(hit.hit.triangle, first);
        FE_NEAR(2.0 - 4.0 * hit.hit.t, v[1], 1e-15);
    }
    free_mesh(&m);
}

static void odd_rays(void **state)
{
    (void)state;
    soup_terrain(&made, 10, 1.0, 0.0, &dice);
    made_mesh m = mesh_of_soup(0);
    fe__mesh_hit hit;
    const fe_dvec3 above = {0.3, 1.0, 0.2}, down = {0.0, -1.0, 0.0}, still = {0.0, 0.0, 0.0}, on = {0.3, 0.0, 0.2};
    FE_TRUE(!mesh_ray(&m.mesh, above, still, 1.0, &hit));
    FE_TRUE(!mesh_ray(&m.mesh, on, (fe_dvec3){1.0, 0.0, 0.0}, 1.0, &hit)); // in the plane
    FE_TRUE(mesh_ray(&m.mesh, on, down, 1.0, &hit));                       // begins on it
    FE_NEAR(hit.hit.t, 0.0, 0.0);
    FE_TRUE(mesh_ray(&m.mesh, above, down, 1.0, &hit)); // ends on it
    FE_NEAR(hit.hit.t, 1.0, 0.0);
    FE_TRUE(!mesh_ray(&m.mesh, above, down, 0.999999, &hit));
    FE_TRUE(!mesh_ray(&m.mesh, above, fe__dscale(-1.0, down), 1.0, &hit));
    static const double sizes[] = {5e-324, 1e-300, 1e-150, 1e-30, 1e150, 1e308};
    for (int32_t i = 0; i < 6; ++i) {
        int32_t is_hit = mesh_ray(&m.mesh, above, fe__dscale(sizes[i], down), 1.0, &hit);
        assert_int_equal(is_hit, sizes[i] > 1.0);
        if (is_hit) FE_NEAR(hit.hit.t * sizes[i], 1.0, 1e-12);
        is_hit = mesh_ray(&m.mesh, fe__dscale(sizes[i], above), down, 1.0, &hit);
        assert_int_equal(is_hit, sizes[i] < 1.0);
    }
    fe_dvec3 slow = {1e-308, -2.0, 1e-200};
    FE_TRUE(mesh_ray(&m.mesh, above, slow, 1.0, &hit));
    FE_NEAR(hit.hit.t, 0.5, 1e-12);
    free_mesh(&m);
}

int main(int argc, char **argv)
{
    if (argc > 1) rays = atoi(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(no_ray_slips_through_a_terrain, reset),
        cmocka_unit_test_setup(closed_meshes_let_nothing_out, reset),
        cmocka_unit_test_setup(far_starts_lose_nothing, reset),
        cmocka_unit_test_setup(rays_are_those_of_all_triangles, reset),
        cmocka_unit_test_setup(slivers_are_met, reset),
        cmocka_unit_test_setup(boxes_are_offered_what_lies_on_their_way, reset),
        cmocka_unit_test_setup(of_equal_distances_the_lowest_number_is_hit, reset),
        cmocka_unit_test_setup(at_a_vertex_the_lowest_number_is_hit, reset),
        cmocka_unit_test_setup(odd_rays, reset),
    };
    return cmocka_run_group_tests_name("rays of meshes", tests, NULL, reset);
}
