// Hulls and meshes under a scale: a hull is that of the scaled points, by number; a mesh is that of the scaled
// vertices, for rays, walks and the nearest point, and no ray slips through it.
#include "fe_test.h"
#include "support/hull_make.h"
#include "support/mesh_make.h"

#include "collision/cast/cast_kinds.h"
#include "collision/hull_build/hull_builder.h"
#include "support/hull_judge.h"

#ifdef FE_SANITIZED
enum { RAYS = 3000 };
#else
enum { RAYS = 60000 };
#endif

static double length(fe_dvec3 a) { return sqrt(fe__ddot(a, a)); }

static fe_dvec3 times(fe_vec3 s, fe_dvec3 p)
{
    return (fe_dvec3){(double)s.x * p.x, (double)s.y * p.y, (double)s.z * p.z};
}

static int32_t is_mirror(fe_vec3 s) { return s.x * s.y * s.z < 0.0f; }

static const fe_vec3 scales[] = {{-1.0f, 1.0f, 1.0f},   {1.0f, -1.0f, 1.0f},  {1.0f, 1.0f, -1.0f},
                                 {-1.0f, -1.0f, -1.0f}, {2.0f, 2.0f, 2.0f},   {-0.75f, 1.0f, 1.0f},
                                 {1.2f, 1.0f, -0.9f},   {0.9f, 0.9f, 0.9f},   {3.0f, 0.4f, 1.1f},
                                 {-0.3f, -2.0f, 0.7f},  {0.1f, 1.0f, 1.0f},   {-100.0f, 300.0f, 70.0f},
                                 {10.0f, 1.0f, -5.0f},  {0.03f, 0.05f, 0.02f}};
enum { SCALES = sizeof scales / sizeof *scales };

// ---- hulls ---------------------------------------------------------------------------------------------------------
static int32_t scale_hull(const fe__hull *hull, fe_vec3 scale, made_hull *out)
{
    memset(out, 0, sizeof *out);
    void *block = made_memory(fe__hull_scaled_size(hull, scale));
    int32_t is_made = fe__hull_write_scaled(hull, scale, block, &out->hull, &out->refusal);
    if (!is_made) fe__aligned_free(block);
    return is_made;
}

enum { MOST_POINTS = 64 };
static int32_t sphere_cloud(float (*points)[3], int32_t count, double away)
{
    for (int32_t i = 0; i < count; ++i) {
        fe_dvec3 d;
        do d = random_point(1.0);
        while (length(d) < 0.2);
        d = fe__dscale(1.0 / length(d), d);
        points[i][0] = (float)(away + d.x), points[i][1] = (float)(d.y - away),
        points[i][2] = (float)(2.0 * away + d.z);
    }
    return count;
}

static int32_t prism_cloud(float (*points)[3], int32_t sides)
{
    for (int32_t i = 0; i < 2 * sides; ++i) {
        double angle = 6.283185307179586 * (double)(i / 2) / (double)sides;
        points[i][0] = (float)cos(angle), points[i][1] = i % 2 ? 0.5f : -0.5f, points[i][2] = (float)sin(angle);
    }
    return 2 * sides;
}

static void scale_points(float (*points)[3], int32_t count, fe_vec3 s)
{
    for (int32_t i = 0; i < count; ++i) points[i][0] *= s.x, points[i][1] *= s.y, points[i][2] *= s.z;
}

static void has_same_faces(const fe__hull *a, const fe__hull *b)
{
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->face_count, b->face_count);
    for (int32_t f = 0; f < a->face_count; ++f) {
        uint8_t has[FE__HULL_VERTICES] = {0};
        assert_int_equal(a->faces[f].count, b->faces[f].count);
        for (int32_t k = 0; k < a->faces[f].count; ++k) has[a->corners[a->faces[f].first + k]] = 1;
        for (int32_t k = 0; k < b->faces[f].count; ++k) FE_TRUE(has[b->corners[b->faces[f].first + k]]);
    }
}

static void vertices_are_scaled(const fe__hull *a, const fe__hull *b, fe_vec3 s)
{
    for (int32_t i = 0; i < a->vertex_count; ++i) {
        fe_dvec3 p = times(s, fe__dadd(fe__widen(a->origin), fe__widen(fe__hull_vertex(a, i)))),
                 q = fe__dadd(fe__widen(b->origin), fe__widen(fe__hull_vertex(b, i)));
        FE_NEAR(q.x, p.x, 1e-7 * fe__absd(p.x)), FE_NEAR(q.y, p.y, 1e-7 * fe__absd(p.y));
        FE_NEAR(q.z, p.z, 1e-7 * fe__absd(p.z));
    }
}

// Floats of both are rounded: by 6e-8 of the distance from the origin
static void weighs_the_same(const fe__hull *a, const fe__hull *b, double away)
{
    double near = 1e-6 * (1.0 + away), volume = a->mass.volume, extent = (double)a->extent;
    FE_NEAR(b->mass.volume, volume, near * volume);
    FE_NEAR(b->mass.area, a->mass.area, near * a->mass.area);
    fe_dvec3 p = fe__dadd(fe__widen(a->origin), a->mass.centre), q = fe__dadd(fe__widen(b->origin), b->mass.centre);
    FE_NEAR(length(fe__dsub(p, q)), 0.0, near * extent);
    const float from[3] = {a->mass.inertia.x, a->mass.inertia.y, a->mass.inertia.z},
                to[3] = {b->mass.inertia.x, b->mass.inertia.y, b->mass.inertia.z};
    for (int32_t k = 0; k < 3; ++k) { // in any order
        double best = 1e300;
        for (int32_t i = 0; i < 3; ++i) best = fe__mind(best, fe__absd((double)to[i] - (double)from[k]));
        FE_NEAR(best, 0.0, near * (double)from[k]);
    }
}

static void is_hull_of_scaled_points(float (*points)[3], int32_t count, double away)
{
    made_hull own, other, copy;
    FE_TRUE(make_hull(points[0], count, FE__HULL_VERTICES, 0.0, &own));
    for (int32_t i = 0; i < SCALES; ++i) {
        float scaled[MOST_POINTS][3];
        memcpy(scaled, points, sizeof *scaled * (size_t)count);
        scale_points(scaled, count, scales[i]);
        FE_TRUE(make_hull(scaled[0], count, FE__HULL_VERTICES, 0.0, &other));
        FE_TRUE(scale_hull(&own.hull, scales[i], &copy));
        FE_TRUE(judge_topology(&copy.hull) && judge_lanes(&copy.hull));
        // flat to the tolerance, and to the rounding of a float
        FE_TRUE(judge_convexity(&copy.hull, (double)copy.hull.tolerance + 2e-7 * (double)copy.hull.extent));
        FE_WITHIN(copy.hull.flatness, 0.0, (double)copy.hull.tolerance + 2e-7 * (double)copy.hull.extent);
        has_same_faces(&own.hull, &copy.hull);
        vertices_are_scaled(&own.hull, &copy.hull, scales[i]);
        weighs_the_same(&other.hull, &copy.hull, away);
        FE_NEAR(copy.hull.thickness, other.hull.thickness, 1e-5 * (1.0 + away) * (double)other.hull.extent);
        FE_NEAR(copy.hull.inner_radius, other.hull.inner_radius, 1e-5 * (1.0 + away) * (double)other.hull.extent);
        free_hull(&other), free_hull(&copy);
    }
    free_hull(&own);
}

static void a_scaled_hull_is_that_of_scaled_points(void **state)
{
    (void)state;
    float points[MOST_POINTS][3];
    is_hull_of_scaled_points(points, prism_cloud(points, 4), 0.0);
    is_hull_of_scaled_points(points, prism_cloud(points, 16), 0.0);
    for (int32_t i = 0; i < 40; ++i) is_hull_of_scaled_points(points, sphere_cloud(points, 4 + i, 0.0), 0.0);
    for (int32_t i = 0; i < 10; ++i) is_hull_of_scaled_points(points, sphere_cloud(points, 12, 20.0), 20.0);
}

// Whatever the scale: no vertex is above a plane, and each plane touches one
static void extreme_scales_keep_planes_outside(void **state)
{
    (void)state;
    static const float numbers[4] = {1e-3f, -1.0f, 30.0f, 1e3f};
    float points[MOST_POINTS][3];
    made_hull own, copy;
    int32_t thin = 0;
    for (int32_t round = 0; round < 64; ++round) {
        FE_TRUE(make_hull(points[0], sphere_cloud(points, 60, 0.0), FE__HULL_VERTICES, 0.0, &own));
        fe_vec3 scale = {numbers[round % 4], numbers[round / 4 % 4], numbers[round / 16]};
        if (!scale_hull(&own.hull, scale, &copy)) {
            FE_TRUE(copy.refusal.thickness < copy.refusal.least);
            thin += 1;
        } else {
            FE_TRUE(judge_topology(&copy.hull) && judge_lanes(&copy.hull));
            for (int32_t f = 0; f < copy.hull.face_count; ++f) {
                double highest = -1e300;
                for (int32_t v = 0; v < copy.hull.vertex_count; ++v)
                    highest = fe__maxd(highest, judge_height(&copy.hull, f, judge_vertex(&copy.hull, v)));
                FE_WITHIN(highest, -2.4e-7 * (double)copy.hull.extent, 0.0);
            }
            free_hull(&copy);
        }
        free_hull(&own);
    }
    FE_WITHIN(thin, 1, 40); // 1e-3 beside 30 or 1000 is thinner than a ten thousandth
}

// ---- meshes --------------------------------------------------------------------------------------------------------
static made_mesh mesh_of_soup(int32_t is_two_sided)
{
    made_mesh m;
    fe__mesh_source source = soup_source(&made);
    source.is_two_sided = is_two_sided;
    FE_TRUE(make_mesh_of(&source, &m));
    return m;
}

// The soup under the scale, its outside outside
static void scale_soup(fe_vec3 s)
{
    scale_points(made.vertices, made.vertex_count, s);
    for (int32_t i = 0; is_mirror(s) && i < made.triangle_count; ++i) {
        uint32_t kept = made.triangles[i][1];
        made.triangles[i][1] = made.triangles[i][2], made.triangles[i][2] = kept;
    }
}

static void is_same_hit(const fe__mesh_hit *a, const fe__mesh_hit *b, int32_t is_mirrored, double near)
{
    FE_NEAR(b->hit.t, a->hit.t, near);
    assert_int_equal(b->is_back, a->is_back);
    assert_int_equal(b->hit.triangle, a->hit.triangle);
    FE_NEAR(length(fe__dsub(a->hit.normal, b->hit.normal)), 0.0, near);
    for (int32_t k = 0; k < 3; ++k)
        FE_NEAR(b->weights[is_mirrored && k ? 3 - k : k], a->weights[k], 1e-6); // of the asset's corners
}

// Scales that are powers of two, so that the scaled soup is the same to the bit: the trees differ, the answers do not
static void rays_meet_what_the_scaled_mesh_has(void **state)
{
    (void)state;
    static const fe_vec3 exact[4] = {{-1.0f, 1.0f, 1.0f},
                                     {2.0f, 0.5f, -4.0f},
                                     {0.25f, 2.0f, 1.0f},
                                     {-2.0f, -8.0f, -0.5f}};
    for (int32_t round = 0; round < 8; ++round) {
        fe_vec3 scale = exact[round / 2];
        free_soup(&made);
        soup_scatter(&made, 400, 0.3, &dice);
        made_mesh own = mesh_of_soup(round % 2);
        fe__mesh scaled;
        assert_int_equal(fe__mesh_scale(&own.mesh, scale, &scaled), -1);
        scale_soup(scale);
        made_mesh other = mesh_of_soup(round % 2);
        FE_NEAR(scaled.area, other.mesh.area, 1e-9 * other.mesh.area);
        int32_t hits = 0;
        for (int32_t i = 0; i < RAYS / 8; ++i) {
            fe_dvec3 from = times(scale, random_point(1.5)), way = fe__dsub(times(scale, random_point(1.5)), from);
            if (i % 5 == 0) way.x = 0.0;
            if (i % 7 == 0) way.z = 0.0;
            fe__mesh_hit a, b;
            int32_t is_hit = mesh_ray(&other.mesh, from, way, 1.5, &a);
            assert_int_equal(mesh_ray(&scaled, from, way, 1.5, &b), is_hit);
            if (is_hit) is_same_hit(&a, &b, is_mirror(scale), 1e-12);
            hits += is_hit;
        }
        FE_WITHIN(hits, RAYS / 40, RAYS / 8);
        free_mesh(&own), free_mesh(&other);
    }
}

static fe_dvec3 target_on(const fe__mesh *m, int32_t kind)
{
    int32_t slot = (int32_t)(fe__absd(soup_random(&dice)) * m->triangle_count), k = (int32_t)(dice >> 40) % 3;
    fe_dvec3 v[3];
    fe__mesh_corners(m, slot, v);
    double s = 0.5 * (soup_random(&dice) + 1.0);
    if (kind == 0) return v[k];
    fe_dvec3 on = fe__dadd(v[k], fe__dscale(s, fe__dsub(v[(k + 1) % 3], v[k])));
    return kind == 1 ? on : fe__dadd(on, fe__dscale(0.3, fe__dsub(v[(k + 2) % 3], on)));
}

static void no_ray_slips_through_a_scaled_mesh(void **state)
{
    (void)state;
    for (int32_t i = 0; i < SCALES; ++i) {
        free_soup(&made);
        soup_ball(&made, 4);
        made_mesh own = mesh_of_soup(0);
        fe__mesh scaled;
        assert_int_equal(fe__mesh_scale(&own.mesh, scales[i], &scaled), -1);
        for (int32_t k = 0; k < RAYS / SCALES; ++k) {
            fe_dvec3 from = times(scales[i], random_point(0.5)), way = fe__dsub(target_on(&scaled, k % 3), from);
            fe__mesh_hit hit;
            FE_TRUE(!mesh_ray(&scaled, from, way, 5.0, &hit)); // from inside
            fe_dvec3 outside = fe__dadd(from, fe__dscale(5.0, way));
            FE_TRUE(mesh_ray(&scaled, outside, fe__dscale(-1.0, way), 5.0, &hit));
            FE_TRUE(!hit.is_back && fe__ddot(hit.hit.normal, way) > 0.0);
            FE_WITHIN(hit.hit.t, 3.99, 4.05);
        }
        free_mesh(&own);
    }
}

// A walk finds each triangle whose bounds meet the box, and hands out its corners, turning left around the outside
static void walks_find_every_triangle(void **state)
{
    (void)state;
    soup_ball(&made, 3);
    made_mesh own = mesh_of_soup(0);
    for (int32_t i = 0; i < SCALES; ++i) {
        fe__mesh scaled;
        assert_int_equal(fe__mesh_scale(&own.mesh, scales[i], &scaled), -1);
        fe__ground ground = {.mesh = &scaled};
        for (int32_t round = 0; round < 40; ++round) {
            fe_dvec3 at = times(scales[i], random_point(1.2)), half = times(scales[i], random_point(0.4));
            half = (fe_dvec3){fe__absd(half.x), fe__absd(half.y), fe__absd(half.z)};
            fe__bounds box = {fe__dsub(at, half), fe__dadd(at, half)};
            if (round == 0) box = (fe__bounds){{-1e300, -1e300, -(double)INFINITY}, {1e300, 1e300, (double)INFINITY}};
            fe__bounds wide = {fe__dsub(box.low, half), fe__dadd(box.high, half)};
            fe__mesh_near near;
            fe__mesh_find_near(&scaled, &wide, &near); // and the same from what was found for a wider one
            ground.near = round % 2 ? &near : NULL;
            uint8_t seen[8 * 64] = {0};
            fe__ground_walk walk;
            fe__form triangle;
            fe__ground_begin(&walk, &ground, &box, at);
            for (int32_t slot; (slot = fe__ground_next(&walk, &triangle)) >= 0;) {
                FE_TRUE(!seen[slot]++);
                fe_dvec3 v[3];
                fe__ground_corners(&ground, slot, v);
                FE_TRUE(fe__ddot(fe__ground_normal(&ground, slot), v[0]) > 0.0);
                for (int32_t k = 0; k < 3; ++k) {
                    fe_vec3 corner = fe__narrow(fe__dsub(v[k], at));
                    assert_memory_equal(&corner, &triangle.vertex[k], sizeof corner);
                }
            }
            for (int32_t slot = 0; slot < scaled.triangle_count; ++slot) {
                fe_dvec3 v[3];
                fe__mesh_corners(&scaled, slot, v);
                double low[3], high[3];
                for (int32_t k = 0; k < 3; ++k) {
                    double c[3];
                    for (int32_t j = 0; j < 3; ++j) c[j] = k == 0 ? v[j].x : k == 1 ? v[j].y : v[j].z;
                    low[k] = fe__mind(c[0], fe__mind(c[1], c[2])), high[k] = fe__maxd(c[0], fe__maxd(c[1], c[2]));
                }
                int32_t meets = low[0] <= box.high.x && high[0] >= box.low.x && low[1] <= box.high.y &&
                                high[1] >= box.low.y && low[2] <= box.high.z && high[2] >= box.low.z;
                FE_TRUE(seen[slot] || !meets);
            }
        }
    }
    free_mesh(&own);
}

// Of each side the edge that the asset has there, by its corners
static void edges_follow_their_sides(void **state)
{
    (void)state;
    soup_terrain(&made, 6, 1.0, 0.4, &dice);
    made_mesh own = mesh_of_soup(0);
    fe__mesh scaled;
    assert_int_equal(fe__mesh_scale(&own.mesh, (fe_vec3){-1.5f, 1.0f, 1.0f}, &scaled), -1);
    for (int32_t slot = 0; slot < scaled.triangle_count; ++slot) {
        fe_dvec3 v[3], w[3];
        fe__mesh_corners(&own.mesh, slot, v), fe__mesh_corners(&scaled, slot, w);
        for (int32_t k = 0; k < 3; ++k) {
            fe_dvec3 middle = times((fe_vec3){-1.5f, 1.0f, 1.0f}, fe__dadd(v[k], v[(k + 1) % 3]));
            int32_t found = 0;
            for (int32_t j = 0; j < 3; ++j) {
                if (length(fe__dsub(middle, fe__dadd(w[j], w[(j + 1) % 3]))) > 1e-9) continue;
                assert_int_equal(fe__mesh_edge_of(&scaled, slot, j), fe__mesh_edge_of(&own.mesh, slot, k));
                found += 1;
            }
            assert_int_equal(found, 1);
        }
    }
    free_mesh(&own);
}

static void the_nearest_point_is_that_of_the_scaled_mesh(void **state)
{
    (void)state;
    const fe_vec3 scale = {2.0f, 0.5f, -4.0f};
    soup_scatter(&made, 200, 0.3, &dice);
    made_mesh own = mesh_of_soup(0);
    fe__mesh scaled;
    assert_int_equal(fe__mesh_scale(&own.mesh, scale, &scaled), -1);
    scale_soup(scale);
    made_mesh other = mesh_of_soup(0);
    fe__ground a = {.mesh = &other.mesh}, b = {.mesh = &scaled};
    for (int32_t i = 0; i < 2000; ++i) {
        fe_dvec3 p = times(scale, random_point(1.5));
        fe__nearest x, y;
        int32_t found = fe__ground_nearest(&a, p, 2.0, &x);
        assert_int_equal(fe__ground_nearest(&b, p, 2.0, &y), found);
        if (!found) continue;
        FE_NEAR(y.distance, x.distance, 1e-12);
        assert_int_equal(y.triangle, x.triangle);
        float u[2], v[2];
        fe__ground_weights(&a, x.index, x.point, u), fe__ground_weights(&b, y.index, y.point, v);
        FE_NEAR(v[0], u[1], 1e-6), FE_NEAR(v[1], u[0], 1e-6);
    }
    free_mesh(&own), free_mesh(&other);
}

// A sliver that lies along the axis which grows
static void what_becomes_too_flat_is_told(void **state)
{
    (void)state;
    uint32_t a = soup_vertex(&made, 0.0, 0.0, 0.0), b = soup_vertex(&made, 1.0, 0.0, 0.0),
             c = soup_vertex(&made, 0.0, 0.0, -1.0), d = soup_vertex(&made, 1.0, 0.0, -1e-6);
    soup_triangle(&made, a, b, c);
    soup_triangle(&made, a, d, b);
    made_mesh own = mesh_of_soup(0);
    assert_int_equal(own.mesh.triangle_count, 2);
    fe__mesh scaled;
    assert_int_equal(fe__mesh_scale(&own.mesh, (fe_vec3){1e3f, 1e3f, 1e3f}, &scaled), -1);
    assert_int_equal(fe__mesh_scale(&own.mesh, (fe_vec3){1e3f, 1.0f, 1e-3f}, &scaled), 1);
    free_mesh(&own);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_scaled_hull_is_that_of_scaled_points, reset),
        cmocka_unit_test_setup(extreme_scales_keep_planes_outside, reset),
        cmocka_unit_test_setup(rays_meet_what_the_scaled_mesh_has, reset),
        cmocka_unit_test_setup(no_ray_slips_through_a_scaled_mesh, reset),
        cmocka_unit_test_setup(walks_find_every_triangle, reset),
        cmocka_unit_test_setup(edges_follow_their_sides, reset),
        cmocka_unit_test_setup(the_nearest_point_is_that_of_the_scaled_mesh, reset),
        cmocka_unit_test_setup(what_becomes_too_flat_is_told, reset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
