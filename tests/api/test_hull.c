// The API of convex hulls: definitions, errors, what is read back, handles of other kinds and stores, failing
// allocations, threads.
#include "asset_test.h"
#include "support/hull_clouds.h"

#include <pthread.h>

static const float cube[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};

static fe_hull_def cube_def(void)
{
    fe_hull_def d;
    fe_hull_def_init(&d, sizeof d);
    d.points = &cube[0][0], d.point_count = 8;
    return d;
}

static fe_asset new_hull(fe_store *store, const fe_hull_def *def)
{
    fe_asset hull = 0;
    OK(fe_hull_create(store, def, &hull));
    assert_true(hull != 0);
    return hull;
}

static fe_hull_info info_of(const fe_store *store, fe_asset hull)
{
    fe_hull_info info;
    fe_hull_info_init(NULL, sizeof info);
    fe_hull_info_init(&info, sizeof info);
    OK(fe_hull_get_info(store, hull, &info));
    return info;
}

static fe_asset new_field(fe_store *store)
{
    static const float flat[4];
    fe_heightfield_def d;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = d.columns = 2, d.heights = flat;
    fe_asset field = 0;
    OK(fe_heightfield_create(store, &d, &field));
    return field;
}

static void defaults_are_complete_but_for_the_points(void **state)
{
    (void)state;
    fe_hull_def d;
    fe_hull_def_init(NULL, sizeof d);
    memset(&d, 0xEE, sizeof d);
    fe_hull_def_init(&d, sizeof d);
    FE_TRUE(d.struct_size == sizeof d && d.max_vertices == 64 && d.point_count == 0 && d.point_stride == 0);
    FE_TRUE(d.tolerance == 0.0f && !d.points && d.reserved == 0);
}

// A unit cube: everything that is told of it is known
static void a_cube_is_read_back(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    fe_hull_def d = cube_def();
    fe_asset hull = new_hull(store, &d);
    FE_TRUE(fe_asset_is_valid(store, hull));
    fe_hull_info i = info_of(store, hull);
    assert_int_equal(i.struct_size, sizeof i);
    assert_int_equal(i.vertex_count, 8);
    assert_int_equal(i.edge_count, 12);
    assert_int_equal(i.face_count, 6);
    FE_NEAR(i.volume, 1.0, 1e-6), FE_NEAR(i.area, 6.0, 1e-6);
    FE_NEAR(i.centre.x, 0.5, 1e-6), FE_NEAR(i.centre.y, 0.5, 1e-6), FE_NEAR(i.centre.z, 0.5, 1e-6);
    FE_NEAR(i.inertia.x, 1.0 / 6.0, 1e-6), FE_NEAR(i.inertia.y, 1.0 / 6.0, 1e-6), FE_NEAR(i.inertia.z, 1.0 / 6.0, 1e-6);
    FE_NEAR(i.inertia_rotation.w, 1.0, 1e-6);
    FE_TRUE(i.lower.x == 0.0f && i.lower.y == 0.0f && i.lower.z == 0.0f);
    FE_TRUE(i.upper.x == 1.0f && i.upper.y == 1.0f && i.upper.z == 1.0f);
    FE_NEAR(i.thickness, 1.0, 1e-6), FE_NEAR(i.inner_radius, 0.5, 1e-6);
    FE_NEAR(i.tolerance, 1e-5, 1e-11), FE_NEAR(i.error, 0.0, 0.0);
    FE_WITHIN(i.bytes, 1000, 10000);

    fe_vec3 v[8];
    assert_int_equal(fe_hull_get_vertices(store, hull, NULL, 0, 0), 8);
    assert_int_equal(fe_hull_get_vertices(store, hull, v, 0, 8), 8);
    assert_memory_equal(v, cube, sizeof v);
    fe_hull_face f[6];
    int32_t corners[24];
    assert_int_equal(fe_hull_get_faces(store, hull, NULL, 0, 0), 6);
    assert_int_equal(fe_hull_get_faces(store, hull, f, sizeof f[0], 6), 6);
    assert_int_equal(fe_hull_get_corners(store, hull, NULL, 0, 0), 24);
    assert_int_equal(fe_hull_get_corners(store, hull, corners, 0, 24), 24);
    for (int32_t k = 0; k < 6; ++k) {
        assert_int_equal(f[k].first, 4 * k);
        assert_int_equal(f[k].count, 4);
        FE_TRUE(f[k].reserved[0] == 0 && f[k].reserved[1] == 0);
        const fe_vec3 *a = &v[corners[4 * k]], *b = &v[corners[4 * k + 1]], *c = &v[corners[4 * k + 2]];
        fe_vec3 s = {b->x - a->x, b->y - a->y, b->z - a->z}, t = {c->x - b->x, c->y - b->y, c->z - b->z};
        FE_NEAR(s.y * t.z - s.z * t.y, f[k].normal.x, 0.0); // counterclockwise seen from outside
        FE_NEAR(s.z * t.x - s.x * t.z, f[k].normal.y, 0.0);
        FE_NEAR(s.x * t.y - s.y * t.x, f[k].normal.z, 0.0);
        FE_NEAR(f[k].distance, f[k].normal.x * a->x + f[k].normal.y * a->y + f[k].normal.z * a->z, 0.0);
    }
    OK(fe_store_destroy(store));
}

static void arrays_are_cut_and_strided(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    float spread[8][5];
    for (int32_t i = 0; i < 8; ++i)
        for (int32_t k = 0; k < 5; ++k) spread[i][k] = k < 3 ? cube[i][k] : NOT_A_NUMBER;
    fe_hull_def d = cube_def();
    d.points = &spread[0][0], d.point_stride = sizeof spread[0];
    fe_asset hull = new_hull(store, &d);
    struct {
        fe_vec3 v;
        float mark;
    } v[3] = {{{0, 0, 0}, 7}, {{0, 0, 0}, 7}, {{0, 0, 0}, 7}};
    assert_int_equal(fe_hull_get_vertices(store, hull, &v[0].v, sizeof v[0], 2), 8);
    FE_TRUE(v[1].v.x == 1.0f && v[0].mark == 7.0f && v[1].mark == 7.0f && v[2].v.x == 0.0f);
    struct {
        int32_t first, count;
    } f[6];
    assert_int_equal(fe_hull_get_faces(store, hull, (fe_hull_face *)(void *)f, sizeof f[0], 6), 6);
    FE_TRUE(f[5].first == 20 && f[5].count == 4);
    int32_t corner[4] = {-1, -1, -1, -1};
    assert_int_equal(fe_hull_get_corners(store, hull, corner, 8, 2), 24);
    FE_TRUE(corner[0] >= 0 && corner[1] == -1 && corner[2] >= 0 && corner[3] == -1);
    // a shorter struct of an older client
    fe_hull_info info = {.struct_size = 16, .volume = 7.0f};
    OK(fe_hull_get_info(store, hull, &info));
    FE_TRUE(info.struct_size == 16 && info.vertex_count == 8 && info.volume == 7.0f);
    OK(fe_store_destroy(store));
}

static void what_is_wrong_is_refused_and_named(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    fe_asset hull = 77;
    fe_hull_def d = cube_def();
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_create(NULL, &d, &hull));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_create(store, NULL, &hull));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_create(store, &d, NULL));
    d.points = NULL;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_create(store, &d, &hull));
    assert_true(hull == 0);
#define WRONG(field, value, words)                                          \
    do {                                                                    \
        d = cube_def();                                                     \
        d.field = value;                                                    \
        REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_create(store, &d, &hull)); \
        SAYS(words);                                                        \
    } while (0)
    WRONG(struct_size, 0, "struct_size");
    WRONG(struct_size, 6, "struct_size");
    WRONG(point_count, 3, "point_count is 3");
    WRONG(point_count, 1000001, "1000001");
    WRONG(point_count, -1, "-1");
    WRONG(max_vertices, 3, "max_vertices is 3");
    WRONG(max_vertices, 256, "256");
    WRONG(point_stride, 8, "point_stride");
    WRONG(tolerance, -1.0f, "tolerance");
    WRONG(tolerance, NOT_A_NUMBER, "tolerance");
    WRONG(tolerance, INFINITE, "tolerance");
    WRONG(reserved, 1, "reserved");
    float bad[8][3];
    memcpy(bad, cube, sizeof bad);
    const float values[4] = {NOT_A_NUMBER, INFINITE, -INFINITE, 1.01e5f};
    for (int32_t i = 0; i < 4; ++i) {
        bad[5][1] = values[i];
        WRONG(points, &bad[0][0], "points[5].y");
    }
    int64_t before, after;
    OK(fe_store_get_bytes(store, &before));
    for (int32_t i = 0; i < 8; ++i) bad[i][0] = cube[i][0], bad[i][1] = 3.0f, bad[i][2] = cube[i][2];
    d = cube_def();
    d.points = &bad[0][0];
    REFUSES(NULL, FE_ERROR_DEGENERATE, fe_hull_create(store, &d, &hull));
    SAYS("flat: 0.000000 m thick along (0.0000, ");
    SAYS("1.0000, 0.0000), must be at least 0.000500 m");
    for (int32_t i = 0; i < 8; ++i) bad[i][0] = (float)i, bad[i][2] = 0.0f;
    REFUSES(NULL, FE_ERROR_DEGENERATE, fe_hull_create(store, &d, &hull));
    SAYS("on a line");
    for (int32_t i = 0; i < 8; ++i) bad[i][0] = 1.0f;
    REFUSES(NULL, FE_ERROR_DEGENERATE, fe_hull_create(store, &d, &hull));
    SAYS("in one place");
    OK(fe_store_get_bytes(store, &after));
    FE_TRUE(before == after && hull == 0);
    OK(fe_store_destroy(store));
}

static void handles_of_others_are_refused(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL), *other = new_store(NULL);
    fe_hull_def d = cube_def();
    fe_asset hull = new_hull(store, &d), field = new_field(store), strange = new_hull(other, &d);
    fe_hull_info info = {.struct_size = sizeof info};
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_get_info(NULL, hull, &info));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_get_info(store, hull, NULL));
    REFUSES(NULL, FE_ERROR_STALE, fe_hull_get_info(store, 0, &info));
    REFUSES(NULL, FE_ERROR_STALE, fe_hull_get_info(store, strange, &info));
    REFUSES(NULL, FE_ERROR_KIND, fe_hull_get_info(store, field, &info));
    SAYS("is a heightfield, not a hull");
    REFUSES(NULL, FE_ERROR_KIND, fe_hull_get_vertices(store, field, NULL, 0, 0));
    REFUSES(NULL, FE_ERROR_KIND, fe_hull_get_faces(store, field, NULL, 0, 0));
    REFUSES(NULL, FE_ERROR_KIND, fe_hull_get_corners(store, field, NULL, 0, 0));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_get_vertices(store, hull, NULL, 0, 8));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_get_vertices(store, hull, NULL, 0, -1));
    fe_hull_face faces[6];
    fe_vec3 vertices[8];
    int32_t corners[24];
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_get_faces(store, hull, faces, 0, 6));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_get_vertices(store, hull, vertices, 8, 8));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_get_corners(store, hull, corners, 2, 24));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_get_corners(NULL, hull, corners, 0, 24));
    float height = 0.0f;
    REFUSES(NULL, FE_ERROR_KIND, fe_heightfield_set_heights(store, hull, 0, 0, 1, 1, &height));
    SAYS("is a hull, not a heightfield");
    REFUSES(NULL, FE_ERROR_KIND, fe_heightfield_get_heights(store, hull, 0, 0, 1, 1, &height));

    fe_world *world = new_world();
    fe_store *own = NULL;
    OK(fe_world_get_store(world, &own));
    fe_asset mine = new_hull(own, &d);
    fe_geometry g;
    fe_shape shape;
    fe_geometry_heightfield(&g, mine);
    fe_body body = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    REFUSES(world, FE_ERROR_KIND, fe_shape_create(world, body, NULL, &g, &shape));
    REFUSES(world, FE_ERROR_KIND, fe_hull_get_info(own, body, &info));
    OK(fe_world_destroy(world));

    OK(fe_asset_destroy(store, hull));
    FE_TRUE(!fe_asset_is_valid(store, hull));
    REFUSES(NULL, FE_ERROR_STALE, fe_hull_get_info(store, hull, &info));
    REFUSES(NULL, FE_ERROR_STALE, fe_hull_get_corners(store, hull, corners, 0, 24));
    REFUSES(NULL, FE_ERROR_STALE, fe_asset_destroy(store, hull));
    OK(fe_store_destroy(store));
    OK(fe_store_destroy(other));
}

static fe_result make_one(fe_store *store, fe_asset *out_asset)
{
    fe_hull_def d = cube_def();
    return fe_hull_create(store, &d, out_asset);
}

static void each_allocation_may_fail(void **state)
{
    (void)state;
    FE_WITHIN(fail_each_asset_allocation(make_one), 13, 40);
}

// ---- threads -------------------------------------------------------------------------------------------------------

enum { THREADS = 4, HULLS = 30 };

typedef struct maker {
    fe_store *store;
    int32_t first;
    fe_asset hulls[HULLS];
    int32_t wrong;
} maker;

static void make_cloud_hull(maker *m, int32_t i)
{
    cloud c;
    cloud_make(&c, (uint64_t)(m->first + i));
    fe_hull_def d;
    fe_hull_def_init(&d, sizeof d);
    d.points = &c.points[0][0], d.point_count = c.count;
    fe_result result = fe_hull_create(m->store, &d, &m->hulls[i]);
    if (result != FE_OK && result != FE_ERROR_DEGENERATE) m->wrong += 1;
}

static void *make_hulls(void *argument)
{
    maker *m = argument;
    for (int32_t i = 0; i < HULLS; ++i) {
        make_cloud_hull(m, i);
        fe_hull_info info = {.struct_size = sizeof info};
        if (m->hulls[i] && fe_hull_get_info(m->store, m->hulls[i], &info) != FE_OK) m->wrong += 1;
        if (i % 3 == 1 && m->hulls[i - 1]) {
            if (fe_asset_destroy(m->store, m->hulls[i - 1]) != FE_OK) m->wrong += 1;
            m->hulls[i - 1] = 0;
        }
    }
    return NULL;
}

// Threads that build in one store make the hulls that one thread makes
static void threads_build_side_by_side(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL), *alone = new_store(NULL);
    static maker makers[THREADS];
    pthread_t threads[THREADS];
    for (int32_t t = 0; t < THREADS; ++t) {
        makers[t] = (maker){.store = store, .first = 1000 * t};
        assert_int_equal(pthread_create(&threads[t], NULL, make_hulls, &makers[t]), 0);
    }
    for (int32_t t = 0; t < THREADS; ++t) pthread_join(threads[t], NULL);
    for (int32_t t = 0; t < THREADS; ++t) {
        maker one = {.store = alone, .first = 1000 * t};
        make_hulls(&one);
        FE_TRUE(makers[t].wrong == 0 && one.wrong == 0);
        for (int32_t i = 0; i < HULLS; ++i) {
            FE_TRUE(!one.hulls[i] == !makers[t].hulls[i]);
            if (!one.hulls[i]) continue;
            fe_hull_info a = info_of(store, makers[t].hulls[i]), b = info_of(alone, one.hulls[i]);
            assert_memory_equal(&a, &b, sizeof a);
        }
    }
    OK(fe_store_destroy(store));
    OK(fe_store_destroy(alone));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_complete_but_for_the_points),
        cmocka_unit_test(a_cube_is_read_back),
        cmocka_unit_test(arrays_are_cut_and_strided),
        cmocka_unit_test(what_is_wrong_is_refused_and_named),
        cmocka_unit_test(handles_of_others_are_refused),
        cmocka_unit_test(each_allocation_may_fail),
        cmocka_unit_test(threads_build_side_by_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
