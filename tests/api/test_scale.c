// The scale of geometries: what is read back, what is refused, what shapes share, how long it lives.
#include "asset_test.h"

static const float cube[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                 {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
static const uint16_t cube_sides[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                           {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
static const uint8_t painted[12];
static const fe_material stone = SURFACE(0.8f, 0.7f, 0, 0, 0), ice = SURFACE(0.01f, 0.01f, 0, 0, 0);

static fe_asset new_hull(fe_store *store)
{
    fe_hull_def d;
    fe_hull_def_init(&d, sizeof d);
    d.points = cube[0], d.point_count = 8;
    fe_asset hull = 0;
    OK(fe_hull_create(store, &d, &hull));
    return hull;
}

static fe_asset new_mesh(fe_store *store)
{
    fe_mesh_def d;
    fe_mesh_def_init(&d, sizeof d);
    d.vertices = cube[0], d.vertex_count = 8;
    d.indices = cube_sides, d.index_type = FE_INDEX_U16, d.triangle_count = 12;
    d.triangle_materials = painted, d.materials = &stone, d.material_count = 1;
    fe_asset mesh = 0;
    OK(fe_mesh_create(store, &d, &mesh));
    return mesh;
}

static fe_geometry hull_of(fe_asset hull, float x, float y, float z)
{
    fe_geometry g;
    fe_geometry_hull(&g, hull);
    fe_geometry_set_scale(&g, x, y, z);
    return g;
}

static fe_geometry mesh_of(fe_asset mesh, float x, float y, float z)
{
    fe_geometry g;
    fe_geometry_mesh(&g, mesh);
    fe_geometry_set_scale(&g, x, y, z);
    return g;
}

static fe_store *store_of(const fe_world *world)
{
    fe_store *store = NULL;
    OK(fe_world_get_store(world, &store));
    return store;
}

static int64_t bytes_of(const fe_store *store)
{
    int64_t bytes = 0;
    OK(fe_store_get_bytes(store, &bytes));
    return bytes;
}

static fe_geometry geometry_of(const fe_world *world, fe_shape shape)
{
    fe_geometry g;
    fe_geometry_init(&g, sizeof g);
    OK(fe_shape_get_geometry(world, shape, &g));
    return g;
}

static void has_scale(const fe_world *world, fe_shape shape, float x, float y, float z)
{
    fe_geometry g = geometry_of(world, shape);
    FE_TRUE(g.scale.x == x && g.scale.y == y && g.scale.z == z);
}

static void reaches_to(const fe_world *world, fe_shape shape, double x, double y, double z)
{
    fe_bounds b;
    OK(fe_shape_get_bounds(world, shape, &b));
    const double near = 0.2; // a box in the tree is larger
    FE_WITHIN(b.upper.x, x, x + near), FE_WITHIN(b.upper.y, y, y + near), FE_WITHIN(b.upper.z, z, z + near);
    FE_WITHIN(-b.lower.x, x, x + near), FE_WITHIN(-b.lower.y, y, y + near), FE_WITHIN(-b.lower.z, z, z + near);
}

// ---- reading back --------------------------------------------------------------------------------------------------
static void a_scale_is_read_back(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *store = store_of(world);
    fe_asset hull = new_hull(store), mesh = new_mesh(store);
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0), body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_geometry g = hull_of(hull, 0, 0, 0);
    fe_shape plain = add_shape(world, body, &g);
    has_scale(world, plain, 1, 1, 1);
    g = hull_of(hull, 1, 1, 1);
    has_scale(world, add_shape(world, body, &g), 1, 1, 1);
    g = hull_of(hull, -2, 0.5f, 3);
    fe_shape scaled = add_shape(world, body, &g);
    has_scale(world, scaled, -2, 0.5f, 3);
    assert_int_equal(geometry_of(world, scaled).asset, hull);
    reaches_to(world, scaled, 2, 0.5, 3);
    g = mesh_of(mesh, 4, -0.25f, 1000);
    fe_shape wide = add_shape(world, ground, &g);
    has_scale(world, wide, 4, -0.25f, 1000);
    assert_int_equal(geometry_of(world, wide).asset, mesh);
    reaches_to(world, wide, 4, 0.25, 1000);

    g = geometry_of(world, scaled); // what was read can be set again
    OK(fe_shape_set_geometry(world, plain, &g));
    has_scale(world, plain, -2, 0.5f, 3);
    g = hull_of(hull, 2, 2, 2);
    OK(fe_shape_set_geometry(world, scaled, &g));
    has_scale(world, scaled, 2, 2, 2);
    reaches_to(world, scaled, 2, 2, 2);
    has_scale(world, plain, -2, 0.5f, 3);
    fe_geometry_sphere(&g, 1.0f);
    OK(fe_shape_set_geometry(world, scaled, &g));
    has_scale(world, scaled, 0, 0, 0);
    fe_hull_info info;
    fe_hull_info_init(&info, sizeof info);
    OK(fe_hull_get_info(store, hull, &info)); // the asset's own
    FE_NEAR(info.volume, 8.0, 1e-5);
    FE_TRUE(info.upper.x == 1.0f);
    OK(fe_world_destroy(world));
}

// Of sides 2 a, 2 b, 2 c: 8 a b c of volume, m / 3 (b^2 + c^2) about x
static void a_scaled_hull_weighs_what_it_holds(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_asset hull = new_hull(store_of(world));
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_geometry g = hull_of(hull, -2, 0.5f, 3);
    fe_shape shape = add_shape(world, body, &g);
    fe_mass_data m;
    fe_mass_data_init(&m, sizeof m);
    OK(fe_body_get_mass_data(world, body, &m));
    double mass = 1000.0 * 8.0 * 3.0;
    FE_NEAR(m.mass, mass, 1e-6 * mass);
    const double own[3] = {mass / 3 * (0.25 + 9), mass / 3 * (4 + 9), mass / 3 * (4 + 0.25)};
    FE_NEAR(m.inertia.x + m.inertia.y + m.inertia.z, own[0] + own[1] + own[2], 2e-6 * (own[0] + own[1] + own[2]));
    g = hull_of(hull, 1, 1, -1);
    OK(fe_shape_set_geometry(world, shape, &g)); // and follows it
    OK(fe_body_get_mass_data(world, body, &m));
    FE_NEAR(m.mass, 8000.0, 1e-6 * 8000.0);
    OK(fe_world_destroy(world));
}

// ---- errors --------------------------------------------------------------------------------------------------------
static void what_is_wrong_is_refused_and_named(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *store = store_of(world);
    fe_asset hull = new_hull(store), mesh = new_mesh(store);
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    fe_geometry g = hull_of(hull, 2, 2, 2);
    fe_shape shape = add_shape(world, ground, &g), out = 77;
    int64_t bytes = bytes_of(store);
    static const struct {
        fe_vec3 scale;
        const char *says;
    } bad[] = {{{0.0f, 1.0f, 1.0f}, "geometry->scale.x is 0, its magnitude must be in [0.00100000005, 1000]"},
               {{1.0f, 0.0009f, 1.0f}, "scale.y"},
               {{1.0f, 1.0f, -1001.0f}, "geometry->scale.z is -1001"},
               {{NOT_A_NUMBER, 1.0f, 1.0f}, "scale.x"},
               {{1.0f, -INFINITE, 1.0f}, "scale.y"},
               {{0.0f, 0.0f, 1e-30f}, "scale.x"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        fe_vec3 s = bad[i].scale;
        for (int32_t kind = 0; kind < 2; ++kind) {
            g = kind ? mesh_of(mesh, s.x, s.y, s.z) : hull_of(hull, s.x, s.y, s.z);
            REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_create(world, ground, NULL, &g, &out));
            SAYS(bad[i].says);
            REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &g));
            SAYS(bad[i].says);
        }
        g = hull_of(hull, s.x, s.y, s.z);
        fe_dvec3 at = {0, 0, 0}, way = {1, 0, 0};
        fe_quat unturned = {0, 0, 0, 1};
        fe_transform pose = {at, unturned};
        fe_hit hit;
        REFUSES(world, FE_ERROR_ARGUMENT, fe_world_sweep(world, &g, &pose, &way, NULL, &hit));
        SAYS(bad[i].says);
    }
    // of other forms 0 or 1
    fe_geometry other[4];
    fe_geometry_sphere(&other[0], 1.0f), fe_geometry_box(&other[1], 1, 1, 1), fe_geometry_plane(&other[2], 0, 1, 0, 0);
    fe_geometry_cone(&other[3], 1.0f, 1.0f);
    static const char *const names[4] = {"of a sphere", "of a box", "of a plane", "of a cone"};
    for (int32_t i = 0; i < 4; ++i) {
        fe_geometry_set_scale(&other[i], 1, 1, 1);
        add_shape(world, ground, &other[i]);
        fe_geometry_set_scale(&other[i], 1, 2, 1);
        REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_create(world, ground, NULL, &other[i], &out));
        SAYS("geometry->scale is (1, 2, 1)");
        SAYS(names[i]);
        fe_geometry_set_scale(&other[i], NOT_A_NUMBER, 0, 0);
        REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &other[i]));
    }
    static const float flat[4];
    fe_heightfield_def d;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = d.columns = 2, d.heights = flat;
    fe_asset field = 0;
    OK(fe_heightfield_create(store, &d, &field));
    fe_geometry_heightfield(&g, field);
    fe_geometry_set_scale(&g, 1, 1, 2);
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_create(world, ground, NULL, &g, &out));
    SAYS("of a heightfield");
    OK(fe_asset_destroy(store, field));

    // lengths and thickness
    g = hull_of(hull, 0.001f, 1, 1); // 2 mm of 2 m
    fe_shape thin = add_shape(world, ground, &g);
    g = hull_of(hull, 0.001f, 30, 1); // 2 mm of 60 m
    REFUSES(world, FE_ERROR_DEGENERATE, fe_shape_create(world, ground, NULL, &g, &out));
    SAYS("makes the hull 0.002000 m thick, must be at least 0.006000 m");
    REFUSES(world, FE_ERROR_DEGENERATE, fe_shape_set_geometry(world, thin, &g));
    static const float far[3][3] = {{0, 0, 0}, {0, 0, 200}, {200, 0, 0}};
    static const uint16_t one[3] = {0, 1, 2};
    fe_mesh_def m;
    fe_mesh_def_init(&m, sizeof m);
    m.vertices = far[0], m.vertex_count = 3, m.indices = one, m.index_type = FE_INDEX_U16, m.triangle_count = 1;
    fe_asset wide = 0;
    OK(fe_mesh_create(store, &m, &wide));
    g = mesh_of(wide, 1, 1, 501);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_create(world, ground, NULL, &g, &out));
    SAYS("geometry->scale takes a point to a coordinate of 100200 m");
    g = mesh_of(wide, 1, 1, 500);
    OK(fe_shape_destroy(world, add_shape(world, ground, &g)));
    static const float sliver[3][3] = {{0, 0, 0}, {1, 0, 0}, {1, 0, -1e-6f}};
    m.vertices = sliver[0];
    fe_asset narrow = 0;
    OK(fe_mesh_create(store, &m, &narrow));
    g = mesh_of(narrow, 1, 1, 0.001f);
    REFUSES(world, FE_ERROR_DEGENERATE, fe_shape_create(world, ground, NULL, &g, &out));
    SAYS("geometry->scale leaves triangle 0 of the mesh without height");
    assert_int_equal(out, 0);
    OK(fe_shape_destroy(world, thin));
    OK(fe_asset_destroy(store, wide)), OK(fe_asset_destroy(store, narrow));
    FE_WITHIN(bytes_of(store) - bytes, 0, 8192); // a chunk of records, a table of handles
    OK(fe_world_destroy(world));
}

static void handles_of_other_stores_are_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *other = new_store(NULL);
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    fe_shape out = 0;
    fe_geometry g = hull_of(new_hull(other), 2, 2, 2);
    REFUSES(world, FE_ERROR_STALE, fe_shape_create(world, ground, NULL, &g, &out));
    g = mesh_of(new_hull(store_of(world)), 2, 2, 2);
    REFUSES(world, FE_ERROR_KIND, fe_shape_create(world, ground, NULL, &g, &out));
    OK(fe_world_destroy(world));
    OK(fe_store_destroy(other));
}

// ---- life ----------------------------------------------------------------------------------------------------------
// A scale's second shape takes nothing, its last one gives all back; what it takes is known to no handle
static void shapes_of_a_scale_share_it(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *store = store_of(world);
    fe_asset assets[2] = {new_hull(store), new_mesh(store)};
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    for (int32_t kind = 0; kind < 2; ++kind) {
        fe_geometry g = kind ? mesh_of(assets[1], 2, 3, -4) : hull_of(assets[0], 2, 3, -4);
        fe_shape first = add_shape(world, ground, &g);
        OK(fe_shape_destroy(world, first)); // records and tables have their room now
        int64_t none = bytes_of(store);
        first = add_shape(world, ground, &g);
        int64_t one = bytes_of(store);
        FE_TRUE(kind ? one == none : one > none); // a mesh shares its arrays
        fe_shape second = add_shape(world, ground, &g);
        assert_int_equal(bytes_of(store), one);
        OK(fe_shape_destroy(world, first));
        assert_int_equal(bytes_of(store), one);
        OK(fe_shape_destroy(world, second));
        assert_int_equal(bytes_of(store), none);
    }
    OK(fe_world_destroy(world));
}

// The record takes the next slot of the store's, which a handle could be guessed for
static void no_handle_names_a_scaled_asset(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *store = store_of(world);
    fe_asset hull = new_hull(store);
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    fe_geometry g = hull_of(hull, 2, 2, 2);
    add_shape(world, ground, &g);
    fe_asset guessed = hull + 1;
    assert_int_equal(fe_asset_is_valid(store, hull), 1);
    assert_int_equal(fe_asset_is_valid(store, guessed), 0);
    REFUSES(world, FE_ERROR_STALE, fe_asset_destroy(store, guessed));
    fe_geometry_hull(&g, guessed);
    fe_shape out = 0;
    REFUSES(world, FE_ERROR_STALE, fe_shape_create(world, ground, NULL, &g, &out));
    OK(fe_world_destroy(world));
}

// The asset goes with the last shape of any of its scales
static void scaled_shapes_outlive_their_asset(void **state)
{
    (void)state;
    counting c = {0};
    fe_world *world = counting_world(&c);
    fe_store *store = store_of(world);
    fe_asset hull = new_hull(store), mesh = new_mesh(store);
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0), body = new_body(world, FE_BODY_DYNAMIC, 0, 10, 0);
    fe_geometry floor = mesh_of(mesh, 20, -1, 20), g = hull_of(hull, 0.5f, 0.5f, -0.5f);
    fe_shape floor_shape = add_shape(world, ground, &floor), shape = add_shape(world, body, &g);
    OK(fe_asset_destroy(store, hull)), OK(fe_asset_destroy(store, mesh));
    assert_int_equal(fe_asset_is_valid(store, mesh), 0);
    step(world, 180);
    fe_transform at;
    OK(fe_body_get_transform(world, body, &at));
    FE_NEAR(at.position.y, 1.5, 0.005); // on the mesh
    assert_int_equal(geometry_of(world, floor_shape).asset, mesh);
    fe_shape out = 0;
    REFUSES(world, FE_ERROR_STALE, fe_shape_create(world, ground, NULL, &floor, &out));
    int64_t bytes = bytes_of(store);
    OK(fe_shape_destroy(world, floor_shape));
    int64_t without = bytes_of(store);
    FE_TRUE(without < bytes);
    OK(fe_shape_destroy(world, shape));
    FE_TRUE(bytes_of(store) < without);
    OK(fe_world_destroy(world));
    assert_int_equal(c.blocks, 0), assert_int_equal(c.bytes, 0), assert_int_equal(c.wrong, 0);
}

// 3000 scales of one asset, found, exchanged and dropped in any order
static void many_scales_leave_nothing_behind(void **state)
{
    (void)state;
    enum { SHAPES = 400, ROUNDS = 4000 };
    counting c = {0};
    fe_world *world = counting_world(&c);
    fe_store *store = store_of(world);
    fe_asset assets[2] = {new_hull(store), new_mesh(store)};
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    static fe_shape shapes[SHAPES];
    static fe_vec3 scales[SHAPES];
    memset(shapes, 0, sizeof shapes);
    uint32_t dice = 1;
    for (int32_t i = 0; i < ROUNDS; ++i) {
        int32_t k = (int32_t)((dice = dice * 1664525u + 1013904223u) >> 8) % SHAPES;
        const float steps[3] = {(float)(dice >> 12 & 63), (float)(dice >> 18 & 31), (float)(dice >> 28)};
        fe_vec3 s = {0.1f + 0.01f * steps[0], i & 1 ? -1.0f - steps[1] : 1.0f, 1.0f + 0.125f * steps[2]};
        fe_geometry g = i % 3 ? hull_of(assets[0], s.x, s.y, s.z) : mesh_of(assets[1], s.x, s.y, s.z);
        if (shapes[k] && i % 5 == 0) {
            OK(fe_shape_destroy(world, shapes[k]));
            shapes[k] = 0;
        } else if (shapes[k]) {
            OK(fe_shape_set_geometry(world, shapes[k], &g)), scales[k] = s;
        } else {
            shapes[k] = add_shape(world, ground, &g), scales[k] = s;
        }
        if (i % 50) continue;
        for (int32_t j = 0; j < SHAPES; ++j)
            if (shapes[j]) has_scale(world, shapes[j], scales[j].x, scales[j].y, scales[j].z);
    }
    int64_t before = 0;
    for (int32_t turn = 0; turn < 3; ++turn) { // the first fills all, which tables may grow for
        for (int32_t j = 0; j < SHAPES; ++j) {
            if (shapes[j]) OK(fe_shape_destroy(world, shapes[j]));
            shapes[j] = 0;
        }
        if (turn == 2) assert_int_equal(bytes_of(store), before);
        before = bytes_of(store);
        for (int32_t j = 0; turn < 2 && j < SHAPES; ++j) {
            fe_geometry g = hull_of(assets[0], 1.0f + 0.01f * (float)j, 1, 1);
            shapes[j] = add_shape(world, ground, &g);
        }
    }
    OK(fe_world_destroy(world));
    assert_int_equal(c.blocks, 0), assert_int_equal(c.bytes, 0), assert_int_equal(c.wrong, 0);
}

// ---- materials -----------------------------------------------------------------------------------------------------
// A body that rests on a scaled mesh by friction slides when the asset's material turns to ice
static void materials_of_the_asset_are_those_of_its_scales(void **state)
{
    (void)state;
    fe_world *world = new_world(), *other = NULL;
    fe_store *store = new_store(NULL);
    OK(fe_world_destroy(world));
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = store;
    OK(fe_world_create(&def, &world)), OK(fe_world_create(&def, &other));
    fe_asset mesh = new_mesh(store);
    fe_world *worlds[2] = {world, other};
    fe_body bodies[2];
    for (int32_t i = 0; i < 2; ++i) {
        fe_body ground = new_body(worlds[i], FE_BODY_STATIC, 0, 0, 0);
        fe_geometry g = mesh_of(mesh, 30, 1, i ? 30.0f : -30.0f);
        add_shape(worlds[i], ground, &g);
        fe_vec3 gravity = {3, -9, 0};
        OK(fe_world_set_gravity(worlds[i], &gravity));
        bodies[i] = new_box(worlds[i], 0, 1.5, 0);
        step(worlds[i], 240);
        assert_int_equal(is_awake(worlds[i], bodies[i]), 0);
    }
    OK(fe_mesh_set_materials(store, mesh, &ice, 0, 1));
    for (int32_t i = 0; i < 2; ++i) {
        assert_int_equal(is_awake(worlds[i], bodies[i]), 1);
        step(worlds[i], 60);
        fe_vec3 v;
        OK(fe_body_get_linear_velocity(worlds[i], bodies[i], &v));
        FE_WITHIN(v.x, 2.3, 3.05); // 3 m/s2 less the friction of a mean of 0.01 and 0.6: 0.077 x 9
        fe_dvec3 up = {0, 5, 0.25}, down = {0, -10, 0};
        fe_hit hit;
        fe_query_filter filter;
        fe_query_filter_init(&filter, sizeof filter);
        filter.excluded = &bodies[i], filter.excluded_count = 1;
        HIT(fe_world_raycast(worlds[i], &up, &down, &filter, &hit));
        FE_NEAR(hit.fraction, 0.4, 1e-6);
        FE_TRUE(hit.material == 0);
    }
    OK(fe_world_destroy(world)), OK(fe_world_destroy(other));
    OK(fe_store_destroy(store));
}

// Of a new material that bounces too
static void materials_bounce_under_a_scale(void **state)
{
    (void)state;
    static const fe_material rubber = SURFACE(0.5f, 0.5f, 0.8f, 0, 0);
    fe_world *world = new_world();
    fe_store *store = store_of(world);
    fe_asset mesh = new_mesh(store);
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0), ball = new_body(world, FE_BODY_DYNAMIC, 0, 4, 0);
    fe_geometry g = mesh_of(mesh, -10, 1, 10);
    add_shape(world, ground, &g);
    OK(fe_mesh_set_materials(store, mesh, &rubber, 0, 1));
    add_sphere(world, ball, 0.5f);
    double fastest = -10;
    for (int32_t i = 0; i < 90; ++i) {
        step(world, 1);
        fe_vec3 v;
        OK(fe_body_get_linear_velocity(world, ball, &v));
        fastest = fmax(fastest, (double)v.y);
    }
    FE_NEAR(fastest, 0.8 * sqrt(2 * 9.81 * 2.5), 0.2); // from 2.5 m, less a step of the way
    OK(fe_world_destroy(world));
}

// ---- memory --------------------------------------------------------------------------------------------------------
// One call after another with each allocation failing: nothing changes, and the call can be repeated
static void each_allocation_may_fail(void **state)
{
    (void)state;
    int64_t calls = 0, refused = 0;
    for (int64_t first = 0; first <= calls; ++first) {
        counting c = {0};
        fe_world *world = counting_world(&c);
        fe_store *store = store_of(world);
        fe_asset assets[2] = {new_hull(store), new_mesh(store)};
        fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0);
        int64_t before = c.calls;
        if (first) c.fail_from = before + first, c.fail_count = 1;
        for (int32_t i = 0; i < 8; ++i) {
            float size = 1.0f + 0.5f * (float)(i / 2);
            fe_geometry g = i % 2 ? mesh_of(assets[1], size, 2, 1) : hull_of(assets[0], -size, 2, 1);
            fe_shape shape = 0;
            uint64_t hash = hash_of(world);
            int64_t blocks = c.blocks;
            fe_result result = fe_shape_create(world, ground, NULL, &g, &shape);
            if (result == FE_ERROR_MEMORY) {
                SAYS("no memory");
                FE_TRUE(shape == 0 && hash_of(world) == hash);
                FE_WITHIN(c.blocks - blocks, 0, 8); // grown tables stay
                refused += 1;
                OK(fe_shape_create(world, ground, NULL, &g, &shape));
            } else {
                OK(result);
            }
            if (i == 7 && fe_shape_set_geometry(world, shape, &g) != FE_OK) {
                SAYS("no memory");
                refused += 1;
                OK(fe_shape_set_geometry(world, shape, &g));
            }
        }
        if (!first) calls = c.calls - before;
        OK(fe_world_destroy(world));
        assert_int_equal(c.blocks, 0), assert_int_equal(c.bytes, 0), assert_int_equal(c.wrong, 0);
    }
    FE_WITHIN(calls, 8, 60);
    assert_int_equal(refused, calls);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scale_is_read_back),
        cmocka_unit_test(a_scaled_hull_weighs_what_it_holds),
        cmocka_unit_test(what_is_wrong_is_refused_and_named),
        cmocka_unit_test(handles_of_other_stores_are_refused),
        cmocka_unit_test(shapes_of_a_scale_share_it),
        cmocka_unit_test(no_handle_names_a_scaled_asset),
        cmocka_unit_test(scaled_shapes_outlive_their_asset),
        cmocka_unit_test(many_scales_leave_nothing_behind),
        cmocka_unit_test(materials_of_the_asset_are_those_of_its_scales),
        cmocka_unit_test(materials_bounce_under_a_scale),
        cmocka_unit_test(each_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
