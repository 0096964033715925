// The API of compounds: parts, errors, what is read back, what keeps what alive, failing allocations.
#include "asset_test.h"

static const float cube[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};

static fe_asset new_hull(fe_store *store)
{
    fe_hull_def d;
    fe_asset hull = 0;
    fe_hull_def_init(&d, sizeof d);
    d.points = &cube[0][0], d.point_count = 8;
    OK(fe_hull_create(store, &d, &hull));
    return hull;
}

static fe_asset new_field(fe_store *store, float height)
{
    const float flat[4] = {height, height, height, height};
    fe_heightfield_def d;
    fe_asset field = 0;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = d.columns = 2, d.heights = flat, d.cell_x = d.cell_z = 4;
    OK(fe_heightfield_create(store, &d, &field));
    return field;
}

static fe_asset new_mesh(fe_store *store)
{
    static const float corners[3][3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
    static const uint32_t triangle[3] = {0, 1, 2};
    fe_mesh_def d;
    fe_asset mesh = 0;
    fe_mesh_def_init(&d, sizeof d);
    d.vertices = corners[0], d.vertex_count = 3, d.indices = triangle, d.triangle_count = 1;
    OK(fe_mesh_create(store, &d, &mesh));
    return mesh;
}

static fe_compound_part new_part(void)
{
    fe_compound_part p;
    fe_compound_part_init(&p, sizeof p);
    fe_geometry_box(&p.geometry, 0.5f, 0.25f, 0.125f);
    return p;
}

static fe_asset new_compound(fe_store *store, const fe_compound_part *parts, int32_t count)
{
    fe_asset asset = 0;
    OK(fe_compound_create(store, parts, sizeof *parts, count, &asset));
    assert_true(asset != 0);
    return asset;
}

static fe_geometry form_of(fe_asset compound)
{
    fe_geometry g;
    fe_geometry_compound(&g, compound);
    return g;
}

static int64_t bytes_of(const fe_store *store)
{
    int64_t bytes = -1;
    OK(fe_store_get_bytes(store, &bytes));
    return bytes;
}

// ---- parts ---------------------------------------------------------------------------------------------------------

static void defaults_are_complete_but_for_the_geometry(void **state)
{
    (void)state;
    fe_compound_part p;
    fe_compound_part_init(NULL, sizeof p);
    memset(&p, 0xEE, sizeof p);
    fe_compound_part_init(&p, sizeof p);
    fe_material m;
    fe_material_init(&m);
    FE_TRUE(p.struct_size == sizeof p && p.density == -1.0f && p.own_material == 0 && p.user_data == 0);
    FE_TRUE(p.frame.position.x == 0 && p.frame.rotation.x == 0 && p.frame.rotation.w == 1);
    FE_TRUE(p.geometry.struct_size == sizeof p.geometry && p.geometry.type == FE_GEOMETRY_NONE);
    FE_TRUE(memcmp(&p.material, &m, sizeof m) == 0);
    fe_compound_info i;
    fe_compound_info_init(NULL, sizeof i);
    fe_compound_info_init(&i, sizeof i);
    FE_TRUE(i.struct_size == sizeof i && i.part_count == 0);
}

static void what_was_given_is_read_back(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    fe_compound_part p[3] = {new_part(), new_part(), new_part()}, read;
    p[0].density = 0, p[0].user_data = UINT64_MAX;
    p[0].material.restitution = 7; // does not count
    p[1].own_material = 1, p[1].material.static_friction = 2, p[1].material.user_id = 5;
    p[1].frame.position.x = 3, p[1].frame.rotation.y = 1, p[1].frame.rotation.w = 0;
    fe_geometry_hull(&p[2].geometry, new_hull(store));
    fe_geometry_set_scale(&p[2].geometry, 2, -1, 1);
    fe_asset asset = new_compound(store, p, 3);
    FE_TRUE(fe_asset_is_valid(store, asset));
    assert_int_equal(fe_asset_get_type(store, asset), FE_GEOMETRY_COMPOUND);
    for (int32_t i = 0; i < 3; ++i) {
        fe_compound_part_init(&read, sizeof read);
        OK(fe_compound_get_part(store, asset, i, &read));
        FE_TRUE(memcmp(&read, p + i, offsetof(fe_compound_part, geometry)) == 0);
        FE_TRUE(read.geometry.type == p[i].geometry.type && read.geometry.asset == p[i].geometry.asset);
        FE_TRUE(memcmp(&read.material, &p[i].material, sizeof read.material) == 0 && read.user_data == p[i].user_data);
    }
    FE_TRUE(read.geometry.scale.x == 2 && read.geometry.scale.y == -1);
    fe_compound_info info;
    fe_compound_info_init(&info, sizeof info);
    OK(fe_compound_get_info(store, asset, &info));
    assert_int_equal(info.part_count, 3);
    FE_NEAR(info.lower.x, -0.5, 1e-6), FE_NEAR(info.lower.y, -1, 1e-6), FE_NEAR(info.lower.z, -0.125, 1e-6);
    FE_NEAR(info.upper.x, 3.5, 1e-6), FE_NEAR(info.upper.y, 0.25, 1e-6), FE_NEAR(info.upper.z, 1, 1e-6);
    FE_WITHIN(info.bytes, 3 * 100, 3 * 400);
    OK(fe_store_destroy(store));
}

// A longer stride skips what is the caller's; a shorter struct of an older client has defaults behind it.
static void strides_and_sizes_are_the_callers(void **state)
{
    (void)state;
    struct {
        fe_compound_part part;
        char own[16];
    } wide[2] = {{.part = new_part()}, {.part = new_part()}};
    fe_store *store = new_store(NULL);
    fe_asset asset = 0;
    fe_compound_part read;
    fe_compound_part_init(&read, sizeof read);
    wide[0].part.user_data = 1, wide[1].part.user_data = 2;
    wide[1].part.struct_size = offsetof(fe_compound_part, user_data);
    OK(fe_compound_create(store, &wide[0].part, sizeof *wide, 2, &asset));
    OK(fe_compound_get_part(store, asset, 0, &read));
    FE_TRUE(read.user_data == 1);
    OK(fe_compound_get_part(store, asset, 1, &read));
    FE_TRUE(read.user_data == 0);
    OK(fe_store_destroy(store));
}

#define BAD_PART(change, expected, words)                                                           \
    do {                                                                                            \
        fe_compound_part p[2] = {new_part(), new_part()};                                           \
        fe_asset asset = 77;                                                                        \
        change;                                                                                     \
        assert_int_equal(fe_compound_create(store, p, sizeof *p, 2, &asset), expected);             \
        FE_TRUE(asset == 0 && strncmp(fe_last_error(), "fe_compound_create, parts[1]: ", 30) == 0); \
        SAYS(words);                                                                                \
        FE_TRUE(bytes_of(store) == before);                                                         \
    } while (0)

static void a_part_out_of_range_is_named(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL), *other = new_store(NULL);
    fe_asset hull = new_hull(store), gone = new_hull(store), foreign = new_hull(other), field = new_field(store, 0);
    fe_compound_part one = new_part();
    fe_asset inner = new_compound(store, &one, 1);
    OK(fe_asset_destroy(store, gone));
    int64_t before = bytes_of(store);
    BAD_PART(p[1].density = -0.5f, FE_ERROR_ARGUMENT, "density");
    BAD_PART(p[1].density = 2e7f, FE_ERROR_ARGUMENT, "density");
    BAD_PART(p[1].density = NOT_A_NUMBER, FE_ERROR_ARGUMENT, "density is NaN");
    BAD_PART(p[1].frame.position.y = 2e6f, FE_ERROR_ARGUMENT, "position.y");
    BAD_PART(p[1].frame.position.z = NOT_A_NUMBER, FE_ERROR_ARGUMENT, "position.z");
    BAD_PART(p[1].frame.rotation.w = 0, FE_ERROR_ARGUMENT, "rotation");
    BAD_PART(p[1].frame.rotation.x = INFINITE, FE_ERROR_ARGUMENT, "rotation");
    BAD_PART(p[1].own_material = 2, FE_ERROR_ARGUMENT, "own_material");
    BAD_PART((p[1].own_material = 1, p[1].material.restitution = 1.5f), FE_ERROR_ARGUMENT, "restitution");
    BAD_PART(p[1].geometry.half_extents.x = 0, FE_ERROR_ARGUMENT, "half_extents.x");
    BAD_PART(p[1].geometry.type = FE_GEOMETRY_NONE, FE_ERROR_ARGUMENT, "type is 0");
    BAD_PART(p[1].geometry.type = 12345, FE_ERROR_ARGUMENT, "type is 12345");
    BAD_PART(p[1].geometry.reserved[0] = 1, FE_ERROR_ARGUMENT, "reserved");
    BAD_PART(p[1].geometry.struct_size = sizeof(fe_geometry) + 8, FE_ERROR_ARGUMENT, "geometry.struct_size");
    BAD_PART(p[1].geometry.struct_size = 1u << 20, FE_ERROR_ARGUMENT, "geometry.struct_size");
    BAD_PART(p[1].struct_size = 3, FE_ERROR_ARGUMENT, "struct_size");
    BAD_PART(p[1].struct_size = sizeof *p + 8, FE_ERROR_ARGUMENT, "stride");
    BAD_PART(fe_geometry_plane(&p[1].geometry, 0, 1, 0, 0), FE_ERROR_UNSUPPORTED, "no plane");
    BAD_PART(fe_geometry_compound(&p[1].geometry, inner), FE_ERROR_UNSUPPORTED, "no compound");
    BAD_PART(fe_geometry_hull(&p[1].geometry, 0), FE_ERROR_STALE, "asset");
    BAD_PART(fe_geometry_hull(&p[1].geometry, gone), FE_ERROR_STALE, "destroyed");
    BAD_PART(fe_geometry_hull(&p[1].geometry, foreign), FE_ERROR_STALE, "asset");
    BAD_PART(fe_geometry_hull(&p[1].geometry, field), FE_ERROR_KIND, "heightfield");
    BAD_PART((fe_geometry_hull(&p[1].geometry, hull), fe_geometry_set_scale(&p[1].geometry, 1, 0, 1)),
             FE_ERROR_ARGUMENT, "scale");
    BAD_PART((fe_geometry_heightfield(&p[1].geometry, field), fe_geometry_set_scale(&p[1].geometry, 2, 2, 2)),
             FE_ERROR_UNSUPPORTED, "scale");
    BAD_PART((fe_geometry_hull(&p[0].geometry, hull), p[1].density = -2), FE_ERROR_ARGUMENT, "density");
    OK(fe_asset_destroy(store, hull)); // no failed call holds it: its memory goes at once
    FE_TRUE(bytes_of(store) < before);
    OK(fe_store_destroy(store)), OK(fe_store_destroy(other));
}

static void arguments_are_checked(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    fe_compound_part p = new_part();
    fe_asset asset = 77, hull = new_hull(store), good = new_compound(store, &p, 1);
    fe_compound_info info;
    fe_compound_info_init(&info, sizeof info);
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_create(NULL, &p, sizeof p, 1, &asset));
    FE_TRUE(asset == 0);
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_create(store, NULL, sizeof p, 1, &asset));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_create(store, &p, sizeof p, 1, NULL));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_create(store, &p, sizeof p, 0, &asset));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_create(store, &p, sizeof p, -1, &asset));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_create(store, &p, sizeof p, 65536, &asset));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_create(store, &p, 0, 1, &asset));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_create(store, &p, 6, 1, &asset));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_get_info(NULL, good, &info));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_get_info(store, good, NULL));
    REFUSES(NULL, FE_ERROR_STALE, fe_compound_get_info(store, 0, &info));
    REFUSES(NULL, FE_ERROR_KIND, fe_compound_get_info(store, hull, &info));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_get_part(NULL, good, 0, &p));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_get_part(store, good, 0, NULL));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_get_part(store, good, -1, &p));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_get_part(store, good, 1, &p));
    REFUSES(NULL, FE_ERROR_KIND, fe_compound_get_part(store, hull, 0, &p));
    info.struct_size = 6;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_compound_get_info(store, good, &info));
    OK(fe_asset_destroy(store, good));
    REFUSES(NULL, FE_ERROR_STALE, fe_compound_get_part(store, good, 0, &p));
    REFUSES(NULL, FE_ERROR_STALE, fe_asset_destroy(store, good));
    OK(fe_store_destroy(store));
}

// ---- shapes --------------------------------------------------------------------------------------------------------

// Meshes and heightfields among the parts bind the whole as they do alone.
static void a_part_says_which_bodies_may_have_the_compound(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *store = world_store(world);
    fe_compound_part p[2] = {new_part(), new_part()};
    fe_geometry_mesh(&p[1].geometry, new_mesh(store));
    fe_geometry mesh = form_of(new_compound(store, p, 2));
    fe_geometry_heightfield(&p[1].geometry, new_field(store, 0));
    fe_geometry field = form_of(new_compound(store, p, 2)), plain = form_of(new_compound(store, p, 1));
    fe_body still = new_body(world, FE_BODY_STATIC, 0, 0, 0), lift = new_body(world, FE_BODY_KINEMATIC, 5, 0, 0),
            loose = new_body(world, FE_BODY_DYNAMIC, 9, 0, 0);
    fe_shape shape = 0, own = add_shape(world, loose, &plain);
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_create(world, loose, NULL, &mesh, &shape));
    SAYS("a mesh");
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_create(world, lift, NULL, &field, &shape));
    SAYS("a heightfield");
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_set_geometry(world, own, &mesh));
    FE_TRUE(shape == 0);
    add_shape(world, still, &field), shape = add_shape(world, lift, &mesh);
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_body_set_type(world, lift, FE_BODY_DYNAMIC));
    SAYS("a mesh");
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_set_one_way(world, shape, 1, NULL));
    OK(fe_shape_set_one_way(world, own, 1, NULL));
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_body_set_type(world, still, FE_BODY_KINEMATIC));
    OK(fe_body_set_type(world, loose, FE_BODY_KINEMATIC)), OK(fe_body_set_type(world, loose, FE_BODY_STATIC));
    step(world, 2);
    OK(fe_body_set_type(world, loose, FE_BODY_DYNAMIC));
    OK(fe_world_destroy(world));
}

static void a_geometry_is_checked(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *store = world_store(world), *other = new_store(NULL);
    fe_compound_part p = new_part();
    fe_geometry good = form_of(new_compound(store, &p, 1)), bad = good;
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_transform at = fe_make_transform(0, 0, 0);
    fe_shape shape = add_shape(world, body, &good), none;
    bad.asset = new_hull(store);
    REFUSES(world, FE_ERROR_KIND, fe_shape_create(world, body, NULL, &bad, &none));
    bad.asset = new_compound(other, &p, 1);
    REFUSES(world, FE_ERROR_STALE, fe_shape_create(world, body, NULL, &bad, &none));
    bad = good, bad.type = FE_GEOMETRY_HULL;
    REFUSES(world, FE_ERROR_KIND, fe_shape_set_geometry(world, shape, &bad));
    bad = good;
    fe_geometry_set_scale(&bad, 2, 2, 2);
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_create(world, body, NULL, &bad, &none));
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_world_overlap_any(world, &good, &at, NULL));
    OK(fe_asset_destroy(store, good.asset));
    REFUSES(world, FE_ERROR_STALE, fe_shape_create(world, body, NULL, &good, &none));
    step(world, 1); // the shape has it still
    fe_geometry read;
    fe_geometry_init(&read, sizeof read);
    OK(fe_shape_get_geometry(world, shape, &read));
    FE_TRUE(read.type == FE_GEOMETRY_COMPOUND && read.asset == good.asset && read.scale.x == 1);
    OK(fe_world_destroy(world)), OK(fe_store_destroy(other));
}

// What is set on the shape is read from it, and no handle names a part.
static void settings_are_the_shapes(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_compound_part p[3] = {new_part(), new_part(), new_part()};
    fe_geometry g = form_of(new_compound(world_store(world), p, 3));
    fe_body body = new_body(world, FE_BODY_KINEMATIC, 0, 0, 0);
    fe_shape first = add_box(world, body, 1), shape = add_shape(world, body, &g), last = add_box(world, body, 1),
             all[8];
    assert_int_equal(fe_body_get_shapes(world, body, all, 8), 3);
    FE_TRUE(all[0] == first && all[1] == shape && all[2] == last);
    assert_int_equal(fe_body_get_shapes(world, body, NULL, 0), 3);
    for (uint64_t slot = 1; slot < 12; ++slot) {
        fe_shape guess = (first & ~HANDLE_SLOT) | slot;
        FE_TRUE(fe_shape_is_valid(world, guess) == (guess == first || guess == shape || guess == last));
    }
    uint32_t layer, mask;
    int32_t group;
    OK(fe_shape_set_filter(world, shape, 4, 7, -3));
    OK(fe_shape_get_filter(world, shape, &layer, &mask, &group));
    FE_TRUE(layer == 4 && mask == 7 && group == -3);
    REFUSES(world, FE_ERROR_STATE, fe_body_get_filter(world, body, &layer, &mask, &group));
    OK(fe_body_set_filter(world, body, 2, 6, 1));
    OK(fe_body_get_filter(world, body, &layer, &mask, &group));
    FE_TRUE(layer == 2 && mask == 6 && group == 1);
    fe_query_filter filter;
    fe_query_filter_init(&filter, sizeof filter);
    filter.mask = 4;
    fe_dvec3 above = {0.4, 3, 0}, down = {0, -6, 0};
    fe_hit hit;
    assert_int_equal(fe_world_raycast(world, &above, &down, &filter, &hit), 0);
    filter.mask = 2;
    HIT(fe_world_raycast(world, &above, &down, &filter, &hit));
    OK(fe_shape_destroy(world, first)), OK(fe_shape_destroy(world, last));
    HIT(fe_world_raycast(world, &above, &down, NULL, &hit));
    FE_TRUE(hit.shape == shape && hit.part == 0);
    OK(fe_shape_set_trigger(world, shape, 1));
    assert_int_equal(fe_world_raycast(world, &above, &down, NULL, &hit), 0);
    fe_vec3 v = {1, 2, 3}, read;
    OK(fe_shape_set_surface_velocity(world, shape, &v));
    OK(fe_shape_get_surface_velocity(world, shape, &read));
    FE_TRUE(read.x == 1 && read.y == 2 && read.z == 3);
    OK(fe_shape_set_user_data(world, shape, 12));
    fe_counters c;
    fe_counters_init(&c, sizeof c);
    OK(fe_world_get_counters(world, &c));
    assert_int_equal(c.shapes, 1);
    OK(fe_shape_destroy(world, shape));
    FE_TRUE(!fe_shape_is_valid(world, shape));
    assert_int_equal(fe_world_raycast(world, &above, &down, NULL, &hit), 0);
    OK(fe_world_destroy(world));
}

// ---- who keeps whom alive ------------------------------------------------------------------------------------------

// Shape, body or world; compound; asset of a part: in every order. Afterwards the store holds nothing of them.
static void everything_may_go_in_every_order(void **state)
{
    (void)state;
    static const int32_t orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int32_t i = 0; i < 18; ++i) {
        counting memory = {0};
        fe_allocator allocator = counting_allocator(&memory);
        fe_store *store = new_store(&allocator);
        fe_world_def def;
        fe_world *world = NULL;
        fe_world_def_init(&def, sizeof def);
        def.store = store;
        OK(fe_world_create(&def, &world));
        OK(fe_asset_destroy(store, new_hull(store))); // the store has its tables
        fe_asset hull = new_hull(store);
        fe_compound_part p[2] = {new_part(), new_part()};
        fe_geometry_hull(&p[1].geometry, hull);
        fe_geometry_set_scale(&p[1].geometry, 1, 2, 1);
        fe_asset compound = new_compound(store, p, 2);
        fe_geometry g = form_of(compound);
        fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
        new_ground(world);
        fe_shape shape = add_shape(world, body, &g);
        step(world, 1);
        for (int32_t k = 0; k < 3; ++k) {
            int32_t what = orders[i % 6][k];
            if (what == 2) OK(fe_asset_destroy(store, hull));
            if (what == 1) OK(fe_asset_destroy(store, compound));
            if (what == 0 && i / 6 == 0) OK(fe_shape_destroy(world, shape));
            if (what == 0 && i / 6 == 1) OK(fe_body_destroy(world, body));
            if (what == 0 && i / 6 == 2) OK(fe_world_destroy(world)), world = NULL;
            if (world) step(world, 2);
        }
        int64_t left = memory.blocks;
        OK(fe_asset_destroy(store, new_hull(store)));
        FE_TRUE(memory.blocks == left && memory.wrong == 0);
        assert_in_range(left, 1, 4); // the store, its table and chunks
        if (world) OK(fe_world_destroy(world));
        OK(fe_store_destroy(store));
        FE_TRUE(memory.blocks == 0 && memory.bytes == 0);
    }
}

// A heightfield among the parts is edited under what lies on it.
static void an_edit_of_a_heightfield_reaches_its_compounds(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *store = world_store(world);
    fe_asset field = new_field(store, 0);
    fe_compound_part p[2] = {new_part(), new_part()};
    fe_geometry_heightfield(&p[1].geometry, field);
    p[0].frame.position.x = 40;
    fe_asset compound = new_compound(store, p, 2);
    fe_geometry g = form_of(compound);
    fe_shape ground = add_shape(world, new_body(world, FE_BODY_STATIC, 0, 0, 0), &g);
    fe_body ball = new_body(world, FE_BODY_DYNAMIC, 2, 0.5, 2);
    add_sphere(world, ball, 0.5f);
    step(world, 120);
    FE_NEAR(body_transform(world, ball).position.y, 0.5, 0.005);
    assert_int_equal(is_awake(world, ball), 0);
    const float lower[4] = {-1, -1, -1, -1};
    OK(fe_heightfield_set_heights(store, field, 0, 0, 2, 2, lower));
    assert_int_equal(is_awake(world, ball), 1);
    step(world, 120);
    FE_NEAR(body_transform(world, ball).position.y, -0.5, 0.005);
    fe_compound_info info;
    fe_compound_info_init(&info, sizeof info);
    OK(fe_compound_get_info(store, compound, &info));
    FE_NEAR(info.lower.y, -1, 1e-6);
    fe_contact c;
    assert_int_equal(fe_shape_get_contacts(world, ground, &c, sizeof c, 1), 1);
    FE_TRUE(c.part_a == 1 && c.triangle_a >= 0 && c.part_b == -1);
    OK(fe_world_destroy(world));
}

// ---- failing allocations -------------------------------------------------------------------------------------------

static fe_result make_one(fe_store *store, fe_asset *out_asset)
{
    fe_compound_part p[4] = {new_part(), new_part(), new_part(), new_part()};
    return fe_compound_create(store, p, sizeof *p, 4, out_asset);
}

static void a_compound_may_lack_memory(void **state)
{
    (void)state;
    FE_WITHIN(fail_each_asset_allocation(make_one), 7, 40);
}

// A shape that lacks memory changes nothing; asked again it is made, with the handle that it would have had.
static fe_shape add_with_failures(int64_t first, int64_t *out_calls, uint64_t *out_hash)
{
    counting memory = {0};
    fe_world *world = counting_world(&memory);
    fe_compound_part p[40];
    for (int32_t i = 0; i < 40; ++i) {
        p[i] = new_part();
        p[i].frame.position.x = (float)i;
        if (i % 4 == 3) fe_geometry_hull(&p[i].geometry, new_hull(world_store(world)));
    }
    fe_geometry g = form_of(new_compound(world_store(world), p, 40)), box;
    fe_geometry_box(&box, 1, 1, 1);
    new_ground(world);
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0.25, 0);
    int64_t before = memory.calls;
    if (first) memory.fail_from = before + first, memory.fail_count = 1;
    fe_shape shape = 77, other = 0;
    for (int32_t change = 0; change < 3; ++change) {
        uint64_t hash = hash_of(world);
        fe_result result = change == 0   ? fe_shape_create(world, body, NULL, &g, &shape)
                           : change == 1 ? fe_shape_create(world, body, NULL, &box, &other)
                                         : fe_shape_set_geometry(world, other, &g);
        if (result == FE_OK) continue;
        assert_int_equal(result, FE_ERROR_MEMORY);
        FE_TRUE(hash_of(world) == hash);
        assert_int_equal(fe_body_get_shapes(world, body, NULL, 0), change);
        --change;
    }
    for (int32_t i = 0; i < 5; ++i)
        if (fe_world_step(world, 1.0f / 60.0f) != FE_OK) --i;
    *out_calls = memory.calls - before;
    *out_hash = hash_of(world);
    OK(fe_world_destroy(world));
    FE_TRUE(memory.blocks == 0 && memory.wrong == 0);
    return shape & HANDLE_SLOT;
}

static void a_shape_of_parts_may_lack_memory(void **state)
{
    (void)state;
    int64_t calls = 0, again;
    uint64_t hash, same;
    fe_shape shape = add_with_failures(0, &calls, &hash);
    FE_WITHIN(calls, 20, 400);
    for (int64_t first = 1; first <= calls; ++first) {
        FE_TRUE(add_with_failures(first, &again, &same) == shape);
        FE_TRUE(same == hash);
    }
}

// Once a compound lies, steps allocate nothing.
static void a_step_allocates_nothing(void **state)
{
    (void)state;
    counting memory = {0};
    fe_world *world = counting_world(&memory);
    fe_compound_part p[4] = {new_part(), new_part(), new_part(), new_part()};
    for (int32_t i = 0; i < 4; ++i) p[i].frame.position.x = (float)(2 * i);
    fe_geometry g = form_of(new_compound(world_store(world), p, 4));
    new_ground(world);
    fe_body bodies[4];
    for (int32_t i = 0; i < 4; ++i) {
        bodies[i] = new_body(world, FE_BODY_DYNAMIC, 0, 0.26 + 0.51 * i, 0);
        add_shape(world, bodies[i], &g);
        OK(fe_body_set_sleep_allowed(world, bodies[i], 0));
    }
    step(world, 120);
    int64_t calls = memory.calls;
    step(world, 120);
    FE_TRUE(memory.calls == calls);
    OK(fe_world_destroy(world));
    assert_int_equal(memory.blocks, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_complete_but_for_the_geometry),
        cmocka_unit_test(what_was_given_is_read_back),
        cmocka_unit_test(strides_and_sizes_are_the_callers),
        cmocka_unit_test(a_part_out_of_range_is_named),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(a_part_says_which_bodies_may_have_the_compound),
        cmocka_unit_test(a_geometry_is_checked),
        cmocka_unit_test(settings_are_the_shapes),
        cmocka_unit_test(everything_may_go_in_every_order),
        cmocka_unit_test(an_edit_of_a_heightfield_reaches_its_compounds),
        cmocka_unit_test(a_compound_may_lack_memory),
        cmocka_unit_test(a_shape_of_parts_may_lack_memory),
        cmocka_unit_test(a_step_allocates_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
