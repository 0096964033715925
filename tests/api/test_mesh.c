// The API of meshes: definitions, errors, what is read back, materials, shapes that have one, handles of other kinds
// and stores, failing allocations, threads.
#include "asset_test.h"

#include <pthread.h>

// A cube of 2 m: its triangles wind counterclockwise seen from outside
static const float corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
static const uint32_t sides[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
static const uint8_t kinds[12] = {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1};
static const uint32_t data[12] = {10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 0xffffffffu};
static const fe_material surfaces[2] = {{.static_friction = 0.5f, .user_id = 5},
                                        {.dynamic_friction = 0.1f, .user_id = 7}};

static fe_mesh_def cube_def(void)
{
    fe_mesh_def d;
    fe_mesh_def_init(&d, sizeof d);
    d.vertices = &corners[0][0], d.vertex_count = 8;
    d.indices = sides, d.triangle_count = 12;
    return d;
}

static fe_mesh_def painted_def(void)
{
    fe_mesh_def d = cube_def();
    d.triangle_materials = kinds, d.materials = surfaces, d.material_count = 2, d.triangle_data = data;
    return d;
}

static fe_asset new_mesh(fe_store *store, const fe_mesh_def *def)
{
    fe_asset mesh = 0;
    OK(fe_mesh_create(store, def, &mesh));
    assert_true(mesh != 0);
    return mesh;
}

static fe_mesh_info info_of(const fe_store *store, fe_asset mesh)
{
    fe_mesh_info info;
    fe_mesh_info_init(NULL, sizeof info);
    fe_mesh_info_init(&info, sizeof info);
    OK(fe_mesh_get_info(store, mesh, &info));
    return info;
}

static fe_mesh_triangle triangle_of(const fe_store *store, fe_asset mesh, int32_t number)
{
    fe_mesh_triangle t;
    fe_mesh_triangle_init(NULL, sizeof t);
    fe_mesh_triangle_init(&t, sizeof t);
    OK(fe_mesh_get_triangle(store, mesh, number, &t));
    return t;
}

static fe_asset new_hull(fe_store *store)
{
    fe_hull_def d;
    fe_hull_def_init(&d, sizeof d);
    d.points = &corners[0][0], d.point_count = 8;
    fe_asset hull = 0;
    OK(fe_hull_create(store, &d, &hull));
    return hull;
}

static void defaults_are_complete_but_for_the_arrays(void **state)
{
    (void)state;
    fe_mesh_def d;
    fe_mesh_def_init(NULL, sizeof d);
    memset(&d, 0xEE, sizeof d);
    fe_mesh_def_init(&d, sizeof d);
    FE_TRUE(d.struct_size == sizeof d && d.flags == 0 && d.vertex_count == 0 && d.triangle_count == 0);
    FE_TRUE(d.vertex_stride == 0 && d.index_stride == 0 && d.index_type == FE_INDEX_U32 && d.weld_distance == 0.0f);
    FE_TRUE(d.edge_angle == 0.035f && d.material_count == 0 && d.material_stride == 0 && d.reserved == 0);
    FE_TRUE(!d.vertices && !d.indices && !d.triangle_materials && !d.materials && !d.triangle_data);
}

// Everything that is told of a cube is known: 24 m2, 8 m3, no open edge; the diagonals are flat, the others are felt
static void a_cube_is_read_back(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    fe_mesh_def d = painted_def();
    fe_asset mesh = new_mesh(store, &d);
    FE_TRUE(fe_asset_is_valid(store, mesh));
    fe_mesh_info i = info_of(store, mesh);
    assert_int_equal(i.struct_size, sizeof i);
    assert_int_equal(i.triangle_count, 12);
    assert_int_equal(i.vertex_count, 8);
    FE_TRUE(i.degenerate_triangles == 0 && i.duplicate_triangles == 0);
    FE_TRUE(i.open_edges == 0 && i.crowded_edges == 0 && i.flipped_edges == 0);
    FE_TRUE(i.material_count == 2 && i.tree_height >= 1);
    FE_TRUE(i.lower.x == -1.0f && i.lower.y == -1.0f && i.lower.z == -1.0f);
    FE_TRUE(i.upper.x == 1.0f && i.upper.y == 1.0f && i.upper.z == 1.0f);
    FE_NEAR(i.area, 24.0, 1e-12), FE_NEAR(i.volume, 8.0, 1e-12);
    FE_WITHIN(i.bytes, 500, 5000);
    for (int32_t t = 0; t < 12; ++t) {
        fe_mesh_triangle told = triangle_of(store, mesh, t);
        FE_TRUE(told.struct_size == sizeof told && told.kept == 1);
        FE_TRUE(told.material == kinds[t] && told.data == data[t]);
        for (int32_t k = 0; k < 3; ++k) {
            assert_memory_equal(&told.corners[k], corners[sides[t][k]], sizeof told.corners[k]);
            int32_t is_diagonal = k == (t % 2 ? 0 : 2);
            assert_int_equal(told.edges[k], is_diagonal ? 0 : FE_MESH_EDGE_FELT | FE_MESH_EDGE_CONVEX);
        }
    }
    OK(fe_store_destroy(store));
}

// Shorts, strides, and structs of older clients
static void arrays_may_have_strides(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    unsigned char places[8 * 16], shorts[12 * 8];
    memset(places, 0xEE, sizeof places), memset(shorts, 0xEE, sizeof shorts);
    for (int32_t i = 0; i < 8; ++i) memcpy(places + 16 * i, corners[i], 12);
    for (int32_t i = 0; i < 36; ++i) {
        uint16_t index = (uint16_t)sides[i / 3][i % 3];
        memcpy(shorts + 8 * (i / 3) + 2 * (i % 3), &index, 2);
    }
    struct {
        fe_material material;
        float mark;
    } spread[2] = {{surfaces[0], NOT_A_NUMBER}, {surfaces[1], NOT_A_NUMBER}};
    fe_mesh_def d = painted_def();
    d.vertices = (const float *)(const void *)places, d.vertex_stride = 16;
    d.indices = shorts, d.index_stride = 8, d.index_type = FE_INDEX_U16;
    d.materials = &spread[0].material, d.material_stride = sizeof spread[0];
    fe_mesh_def packed = painted_def();
    fe_asset one = new_mesh(store, &d), other = new_mesh(store, &packed);
    fe_mesh_info a = info_of(store, one), b = info_of(store, other);
    assert_memory_equal(&a, &b, sizeof a);
    for (int32_t t = 0; t < 12; ++t) {
        fe_mesh_triangle x = triangle_of(store, one, t), y = triangle_of(store, other, t);
        assert_memory_equal(&x, &y, sizeof x);
    }
    fe_mesh_info brief = {.struct_size = 16, .vertex_count = 7};
    OK(fe_mesh_get_info(store, one, &brief));
    FE_TRUE(brief.struct_size == 16 && brief.triangle_count == 12 && brief.vertex_count == 7);
    OK(fe_store_destroy(store));
}

// What is dropped keeps its number; the others keep theirs
static void dropped_triangles_are_counted_and_told(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    uint32_t more[15][3];
    memcpy(more[1], sides, sizeof sides);
    memcpy(more[0], (uint32_t[3]){0, 0, 1}, sizeof more[0]);
    memcpy(more[13], (uint32_t[3]){3, 0, 2}, sizeof more[0]); // the first, turned
    memcpy(more[14], (uint32_t[3]){0, 3, 2}, sizeof more[0]); // the first, wound the other way
    fe_mesh_def d = cube_def();
    d.indices = more, d.triangle_count = 15;
    fe_asset mesh = new_mesh(store, &d);
    fe_mesh_info i = info_of(store, mesh);
    assert_int_equal(i.triangle_count, 13);
    assert_int_equal(i.degenerate_triangles, 1);
    assert_int_equal(i.duplicate_triangles, 1);
    FE_TRUE(i.crowded_edges == 3 && i.volume == 0.0);
    fe_mesh_triangle none = triangle_of(store, mesh, 0), first = triangle_of(store, mesh, 1);
    FE_TRUE(none.kept == 0 && first.kept == 1 && first.material == -1 && first.data == 0);
    assert_memory_equal(&first.corners[1], corners[2], sizeof first.corners[1]);
    for (int32_t k = 0; k < 3; ++k) assert_int_equal(first.edges[k], FE_MESH_EDGE_FELT); // each has three triangles
    assert_int_equal(triangle_of(store, mesh, 13).kept, 0);
    assert_int_equal(triangle_of(store, mesh, 14).kept, 1);

    fe_asset refused = 77;
    d.flags = FE_MESH_STRICT;
    REFUSES(NULL, FE_ERROR_DEGENERATE, fe_mesh_create(store, &d, &refused));
    SAYS("triangle 0 has no area");
    FE_TRUE(refused == 0);
    d.indices = more + 1, d.triangle_count = 14;
    REFUSES(NULL, FE_ERROR_DEGENERATE, fe_mesh_create(store, &d, &refused));
    SAYS("triangle 12 repeats an earlier one");
    d.indices = more, d.triangle_count = 1, d.flags = 0;
    REFUSES(NULL, FE_ERROR_DEGENERATE, fe_mesh_create(store, &d, &refused));
    SAYS("no triangle has an area");
    OK(fe_store_destroy(store));
}

static void what_is_wrong_is_refused_and_named(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    int64_t before, after;
    OK(fe_store_get_bytes(store, &before));
    fe_asset mesh = 77;
    fe_mesh_def d = cube_def();
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_create(NULL, &d, &mesh));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_create(store, NULL, &mesh));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_create(store, &d, NULL));
#define WRONG_AS(error, field, value, words)                    \
    do {                                                        \
        d = painted_def();                                      \
        d.field = value;                                        \
        REFUSES(NULL, error, fe_mesh_create(store, &d, &mesh)); \
        SAYS(words);                                            \
        FE_TRUE(mesh == 0);                                     \
    } while (0)
#define WRONG(field, value, words) WRONG_AS(FE_ERROR_ARGUMENT, field, value, words)
    WRONG(struct_size, 0, "struct_size");
    WRONG(struct_size, 6, "struct_size");
    WRONG(flags, 4, "flags");
    WRONG(vertex_count, 2, "vertex_count is 2");
    WRONG(triangle_count, 0, "triangle_count is 0");
    WRONG(triangle_count, -1, "-1");
    WRONG_AS(FE_ERROR_LIMIT, vertex_count, (1 << 28) + 1, "vertex_count is 268435457");
    WRONG_AS(FE_ERROR_LIMIT, triangle_count, (1 << 27) + 1, "triangle_count is 134217729");
    WRONG(vertex_stride, 8, "vertex_stride");
    WRONG(index_stride, 8, "index_stride");
    WRONG(index_type, 2, "index_type");
    WRONG(index_type, -1, "index_type");
    WRONG(weld_distance, -1.0f, "weld_distance");
    WRONG(weld_distance, 1e-7f, "weld_distance");
    WRONG(weld_distance, 1.5f, "weld_distance");
    WRONG(weld_distance, NOT_A_NUMBER, "weld_distance");
    WRONG(edge_angle, -0.1f, "edge_angle");
    WRONG(edge_angle, 1.6f, "edge_angle");
    WRONG(edge_angle, NOT_A_NUMBER, "edge_angle");
    WRONG(edge_angle, INFINITE, "edge_angle");
    WRONG(material_count, 0, "material_count is 0");
    WRONG(material_count, 256, "material_count is 256");
    WRONG(material_count, 1, "triangle_materials[2] is 1");
    WRONG(material_stride, 8, "material_stride");
    WRONG(materials, NULL, "materials");
    WRONG(reserved, 1, "reserved");
    WRONG(vertices, NULL, "vertices");
    WRONG(indices, NULL, "indices");
    WRONG(vertex_count, 7, "is 7, must be in [0, 6]");
    float bad[8][3];
    memcpy(bad, corners, sizeof bad);
    const float values[4] = {NOT_A_NUMBER, INFINITE, -INFINITE, 1.01e5f};
    for (int32_t i = 0; i < 4; ++i) {
        bad[5][2] = values[i];
        WRONG(vertices, &bad[0][0], "vertices[5].z");
    }
    uint32_t wild[12][3];
    memcpy(wild, sides, sizeof wild);
    wild[4][1] = 0xffffffffu;
    WRONG(indices, wild, "index 1 of triangle 4 is 4294967295, must be in [0, 7]");
    fe_material rough[2] = {surfaces[0], surfaces[1]};
    rough[1].restitution = NOT_A_NUMBER;
    WRONG(materials, rough, "restitution");
    OK(fe_store_get_bytes(store, &after));
    FE_TRUE(before == after);
    OK(fe_store_destroy(store));
}

static void handles_of_others_are_refused(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL), *other = new_store(NULL);
    fe_mesh_def d = painted_def();
    fe_asset mesh = new_mesh(store, &d), hull = new_hull(store), strange = new_mesh(other, &d);
    fe_mesh_info info = {.struct_size = sizeof info};
    fe_mesh_triangle t = {.struct_size = sizeof t};
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_get_info(NULL, mesh, &info));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_get_info(store, mesh, NULL));
    REFUSES(NULL, FE_ERROR_STALE, fe_mesh_get_info(store, 0, &info));
    REFUSES(NULL, FE_ERROR_STALE, fe_mesh_get_info(store, strange, &info));
    REFUSES(NULL, FE_ERROR_KIND, fe_mesh_get_info(store, hull, &info));
    SAYS("is a hull, not a mesh");
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_get_triangle(NULL, mesh, 0, &t));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_get_triangle(store, mesh, 0, NULL));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_get_triangle(store, mesh, -1, &t));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_get_triangle(store, mesh, 12, &t));
    SAYS("triangle is 12");
    REFUSES(NULL, FE_ERROR_KIND, fe_mesh_get_triangle(store, hull, 0, &t));
    REFUSES(NULL, FE_ERROR_STALE, fe_mesh_get_triangle(store, strange, 0, &t));
    t.struct_size = 3;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_get_triangle(store, mesh, 0, &t));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_set_materials(NULL, mesh, surfaces, 0, 2));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_set_materials(store, mesh, NULL, 0, 2));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_set_materials(store, mesh, surfaces, 8, 2));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_set_materials(store, mesh, surfaces, 0, 1));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_set_materials(store, mesh, surfaces, 0, -1));
    REFUSES(NULL, FE_ERROR_KIND, fe_mesh_set_materials(store, hull, surfaces, 0, 2));
    REFUSES(NULL, FE_ERROR_STALE, fe_mesh_set_materials(store, strange, surfaces, 0, 2));
    fe_material rough[2] = {surfaces[0], {.static_friction = NOT_A_NUMBER}};
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_mesh_set_materials(store, mesh, rough, 0, 2));
    fe_hull_info hull_info = {.struct_size = sizeof hull_info};
    REFUSES(NULL, FE_ERROR_KIND, fe_hull_get_info(store, mesh, &hull_info));
    SAYS("is a mesh, not a hull");

    OK(fe_asset_destroy(store, mesh));
    FE_TRUE(!fe_asset_is_valid(store, mesh));
    REFUSES(NULL, FE_ERROR_STALE, fe_mesh_get_info(store, mesh, &info));
    REFUSES(NULL, FE_ERROR_STALE, fe_mesh_set_materials(store, mesh, surfaces, 0, 2));
    REFUSES(NULL, FE_ERROR_STALE, fe_asset_destroy(store, mesh));
    OK(fe_store_destroy(store));
    OK(fe_store_destroy(other));
}

// ---- shapes --------------------------------------------------------------------------------------------------------

static void static_and_kinematic_bodies_have_meshes(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *store = world_store(world), *other = new_store(NULL);
    fe_mesh_def d = cube_def();
    fe_asset mesh = new_mesh(store, &d), hull = new_hull(store), strange = new_mesh(other, &d);
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0), cart = new_body(world, FE_BODY_KINEMATIC, 5, 0, 0);
    fe_body stone = new_body(world, FE_BODY_DYNAMIC, 0, 9, 0);
    fe_geometry g, got = {.struct_size = sizeof got};
    fe_shape shape = 0, on_cart = 0;
    fe_geometry_mesh(&g, hull);
    REFUSES(world, FE_ERROR_KIND, fe_shape_create(world, ground, NULL, &g, &shape));
    fe_geometry_hull(&g, mesh);
    REFUSES(world, FE_ERROR_KIND, fe_shape_create(world, ground, NULL, &g, &shape));
    fe_geometry_mesh(&g, strange);
    REFUSES(world, FE_ERROR_STALE, fe_shape_create(world, ground, NULL, &g, &shape));
    fe_geometry_mesh(&g, mesh);
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_create(world, stone, NULL, &g, &shape));
    SAYS("convex shapes");
    OK(fe_shape_create(world, ground, NULL, &g, &shape));
    OK(fe_shape_create(world, cart, NULL, &g, &on_cart));
    OK(fe_shape_get_geometry(world, shape, &got));
    FE_TRUE(got.type == FE_GEOMETRY_MESH && got.asset == mesh);
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_body_set_type(world, cart, FE_BODY_DYNAMIC));
    SAYS("mesh");
    OK(fe_body_set_type(world, cart, FE_BODY_STATIC));
    OK(fe_body_set_type(world, cart, FE_BODY_KINEMATIC));

    // a mesh lives as long as its shapes do, though nobody can name it
    OK(fe_asset_destroy(store, mesh));
    OK(fe_shape_get_geometry(world, shape, &got));
    FE_TRUE(got.type == FE_GEOMETRY_MESH);
    REFUSES(world, FE_ERROR_STALE, fe_shape_create(world, ground, NULL, &g, &shape));
    fe_hit hit;
    fe_dvec3 from = {0.3, 5.0, 0.2}, way = {0.0, -10.0, 0.0};
    HIT(fe_world_raycast(world, &from, &way, NULL, &hit));
    FE_NEAR(hit.fraction, 0.4, 1e-12);
    FE_TRUE(hit.triangle == 6 || hit.triangle == 7);
    fe_geometry_hull(&g, hull);
    OK(fe_shape_set_geometry(world, on_cart, &g));
    OK(fe_body_set_type(world, cart, FE_BODY_DYNAMIC));
    OK(fe_world_destroy(world));
    OK(fe_store_destroy(other));
}

static void forms_that_move_are_no_meshes(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_mesh_def d = cube_def();
    fe_geometry g;
    fe_geometry_mesh(&g, new_mesh(world_store(world), &d));
    fe_transform start = fe_make_transform(0, 5, 0);
    fe_dvec3 way = {0, -10, 0};
    fe_hit hit;
    fe_body bodies[4];
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_world_sweep(world, &g, &start, &way, NULL, &hit));
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_world_overlap(world, &g, &start, NULL, bodies, 4));
    OK(fe_world_destroy(world));
}

// What is set reaches hits, and bodies that rest on it wake
static void materials_change_under_bodies(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *store = world_store(world);
    fe_mesh_def d = painted_def();
    fe_asset mesh = new_mesh(store, &d);
    fe_geometry g;
    fe_shape shape = 0;
    fe_geometry_mesh(&g, mesh);
    OK(fe_shape_create(world, new_body(world, FE_BODY_STATIC, 0, 0, 0), NULL, &g, &shape));
    fe_body box = new_body(world, FE_BODY_DYNAMIC, 0, 1.2, 0);
    fe_geometry_box(&g, 0.2f, 0.2f, 0.2f);
    OK(fe_shape_create(world, box, NULL, &g, &shape));
    for (int32_t i = 0; i < 120; ++i) OK(fe_world_step(world, 1.0f / 60.0f));
    int32_t awake = 1;
    OK(fe_body_get_awake(world, box, &awake));
    assert_int_equal(awake, 0);
    const fe_dvec3 from = {0.6, 5.0, 0.6}, way = {0.0, -10.0, 0.0};
    fe_hit hit;
    HIT(fe_world_raycast(world, &from, &way, NULL, &hit));
    FE_TRUE(hit.material == 7);
    const fe_material others[2] = {{.user_id = 1}, {.user_id = 2}};
    OK(fe_mesh_set_materials(store, mesh, others, sizeof others[0], 2));
    HIT(fe_world_raycast(world, &from, &way, NULL, &hit));
    FE_TRUE(hit.material == 2);
    OK(fe_body_get_awake(world, box, &awake));
    assert_int_equal(awake, 1);
    OK(fe_world_destroy(world));
}

// ---- memory, threads -----------------------------------------------------------------------------------------------

static fe_result make_one(fe_store *store, fe_asset *out_asset)
{
    fe_mesh_def d = painted_def();
    return fe_mesh_create(store, &d, out_asset);
}

static void each_allocation_may_fail(void **state)
{
    (void)state;
    FE_WITHIN(fail_each_asset_allocation(make_one), 6 * 3, 60); // each: room, scratch, block
}

enum { THREADS = 4, MESHES = 30 };

typedef struct maker {
    fe_store *store;
    fe_asset meshes[MESHES];
    int32_t wrong;
} maker;

static void *make_meshes(void *argument)
{
    maker *m = argument;
    for (int32_t i = 0; i < MESHES; ++i) {
        fe_mesh_def d = i % 2 ? painted_def() : cube_def();
        d.triangle_count = 1 + i % 12;
        fe_mesh_info info = {.struct_size = sizeof info};
        if (fe_mesh_create(m->store, &d, &m->meshes[i]) != FE_OK) m->wrong += 1;
        if (fe_mesh_get_info(m->store, m->meshes[i], &info) != FE_OK || info.triangle_count != d.triangle_count)
            m->wrong += 1;
        if (i % 3 == 1 && fe_asset_destroy(m->store, m->meshes[i - 1]) != FE_OK) m->wrong += 1;
    }
    return NULL;
}

static void threads_build_side_by_side(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    static maker makers[THREADS];
    pthread_t threads[THREADS];
    for (int32_t t = 0; t < THREADS; ++t) {
        makers[t] = (maker){.store = store};
        assert_int_equal(pthread_create(&threads[t], NULL, make_meshes, &makers[t]), 0);
    }
    for (int32_t t = 0; t < THREADS; ++t) pthread_join(threads[t], NULL);
    for (int32_t t = 0; t < THREADS; ++t) assert_int_equal(makers[t].wrong, 0);
    OK(fe_store_destroy(store));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_complete_but_for_the_arrays),
        cmocka_unit_test(a_cube_is_read_back),
        cmocka_unit_test(arrays_may_have_strides),
        cmocka_unit_test(dropped_triangles_are_counted_and_told),
        cmocka_unit_test(what_is_wrong_is_refused_and_named),
        cmocka_unit_test(handles_of_others_are_refused),
        cmocka_unit_test(static_and_kinematic_bodies_have_meshes),
        cmocka_unit_test(forms_that_move_are_no_meshes),
        cmocka_unit_test(materials_change_under_bodies),
        cmocka_unit_test(each_allocation_may_fail),
        cmocka_unit_test(threads_build_side_by_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
