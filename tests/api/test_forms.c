// What each kind of form can be: on which bodies, one-way, moved by queries, seen from which side; and what it keeps.
#include "asset_test.h"

// A valley: two square sheets of 4 m, each 45 degrees up from the z axis. Its flat parts look at (0, 1, 0).
static const float corners[6][3] = {{-2, 2, -2}, {-2, 2, 2}, {0, 0, -2}, {0, 0, 2}, {2, 2, -2}, {2, 2, 2}};
static const uint32_t sheets[4][3] = {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}};
static const uint8_t painted[4] = {0, 0, 0, 0}, flat_cell[1] = {0};
static const fe_material own = {.static_friction = 0.5f, .user_id = 5}, others = {.user_id = 9};
static const float heights[4] = {0, 0, 0, 0};
static const float cube[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                 {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};

static fe_store *store_of(const fe_world *world)
{
    fe_store *store = NULL;
    OK(fe_world_get_store(world, &store));
    return store;
}

static fe_geometry valley(const fe_world *world, uint32_t flags)
{
    fe_mesh_def d;
    fe_mesh_def_init(&d, sizeof d);
    d.flags = flags;
    d.vertices = corners[0], d.vertex_count = 6, d.indices = sheets, d.triangle_count = 4;
    d.triangle_materials = painted, d.materials = &own, d.material_count = 1;
    fe_asset mesh = 0;
    OK(fe_mesh_create(store_of(world), &d, &mesh));
    fe_geometry g;
    fe_geometry_mesh(&g, mesh);
    return g;
}

// From the origin to 8 m along x and z
static fe_geometry field(const fe_world *world)
{
    fe_heightfield_def d;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = d.columns = 2, d.cell_x = d.cell_z = 8, d.heights = heights;
    d.cell_materials = flat_cell, d.materials = &own, d.material_count = 1;
    fe_asset asset = 0;
    OK(fe_heightfield_create(store_of(world), &d, &asset));
    fe_geometry g;
    fe_geometry_heightfield(&g, asset);
    return g;
}

static fe_geometry hull(const fe_world *world)
{
    fe_hull_def d;
    fe_hull_def_init(&d, sizeof d);
    d.points = cube[0], d.point_count = 8;
    fe_asset asset = 0;
    OK(fe_hull_create(store_of(world), &d, &asset));
    fe_geometry g;
    fe_geometry_hull(&g, asset);
    return g;
}

enum { FORMS = 9, CONVEX = 6 };

static void make_forms(const fe_world *world, fe_geometry forms[FORMS])
{
    fe_geometry_sphere(&forms[0], 1);
    fe_geometry_capsule(&forms[1], 1, 1);
    fe_geometry_box(&forms[2], 1, 1, 1);
    fe_geometry_cylinder(&forms[3], 1, 1);
    fe_geometry_cone(&forms[4], 1, 1);
    forms[5] = hull(world);
    fe_geometry_plane(&forms[6], 0, 1, 0, 0);
    forms[7] = field(world);
    forms[8] = valley(world, 0);
}

// ---- what it can be ------------------------------------------------------------------------------------------------

static int32_t is_for(int32_t form, int32_t type)
{
    int32_t most = form < CONVEX ? FE_BODY_DYNAMIC : form == 8 ? FE_BODY_KINEMATIC : FE_BODY_STATIC;
    return type <= most;
}

static void a_form_is_on_its_bodies_only(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry forms[FORMS];
    make_forms(world, forms);
    for (int32_t type = FE_BODY_STATIC; type <= FE_BODY_DYNAMIC; ++type) {
        for (int32_t i = 0; i < FORMS; ++i) {
            fe_body body = new_body(world, type, 0, 0, 0);
            fe_shape other = add_box(world, body, 1), shape = 0;
            if (!is_for(i, type)) {
                REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_create(world, body, NULL, &forms[i], &shape));
                REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_set_geometry(world, other, &forms[i]));
                OK(fe_body_destroy(world, body));
                continue;
            }
            OK(fe_shape_create(world, body, NULL, &forms[i], &shape));
            OK(fe_shape_set_geometry(world, other, &forms[i]));
            for (int32_t next = FE_BODY_STATIC; next <= FE_BODY_DYNAMIC; ++next) {
                if (is_for(i, next))
                    OK(fe_body_set_type(world, body, next));
                else
                    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_body_set_type(world, body, next));
            }
            OK(fe_body_destroy(world, body));
        }
    }
    OK(fe_world_destroy(world));
}

static void one_way_forms_are_convex(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    fe_geometry forms[FORMS], box;
    make_forms(world, forms);
    fe_geometry_box(&box, 1, 1, 1);
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    def.one_way = 1;
    for (int32_t i = 0; i < FORMS; ++i) {
        fe_shape platform = 0, plain = add_shape(world, body, &forms[i]), shape = 0;
        OK(fe_shape_create(world, body, &def, &box, &platform));
        OK(fe_shape_set_one_way(world, plain, 0, NULL));
        if (i < CONVEX) {
            OK(fe_shape_create(world, body, &def, &forms[i], &shape));
            OK(fe_shape_set_geometry(world, platform, &forms[i]));
            OK(fe_shape_set_one_way(world, plain, 1, NULL));
        } else {
            REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_create(world, body, &def, &forms[i], &shape));
            SAYS("one-way");
            REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_set_geometry(world, platform, &forms[i]));
            REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_set_one_way(world, plain, 1, NULL));
        }
    }
    OK(fe_world_destroy(world));
}

// Of a mesh too much is a limit of the format (test_mesh.c), of all else an argument out of range
static void too_much_is_out_of_range(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_store *store = store_of(world);
    fe_asset asset = 0;
    fe_hull_def h;
    fe_hull_def_init(&h, sizeof h);
    h.points = cube[0], h.point_count = 1000001;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_create(store, &h, &asset));
    h.point_count = 8, h.max_vertices = 256;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_hull_create(store, &h, &asset));
    fe_heightfield_def d;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = 32769, d.columns = 2, d.heights = heights;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_heightfield_create(store, &d, &asset));
    d.rows = d.columns = 32768;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_heightfield_create(store, &d, &asset));
    OK(fe_world_destroy(world));
}

// What a query moves is convex, has an inside, and its asset is the world's
static void queries_move_convex_forms(void **state)
{
    (void)state;
    fe_world *world = new_world(), *other = new_world();
    fe_geometry forms[FORMS], foreign = hull(other), wrong, thin;
    make_forms(world, forms);
    fe_transform start = fe_make_transform(0, 9, 0);
    fe_dvec3 way = {0, -5, 0};
    fe_hit hit;
    fe_overlap overlap;
    for (int32_t i = 0; i < FORMS; ++i) {
        if (i < CONVEX) {
            assert_int_equal(fe_world_sweep(world, &forms[i], &start, &way, NULL, &hit), 0);
            continue;
        }
        REFUSES(world, FE_ERROR_UNSUPPORTED, fe_world_sweep(world, &forms[i], &start, &way, NULL, &hit));
        REFUSES(world, FE_ERROR_UNSUPPORTED,
                fe_world_overlap_shapes(world, &forms[i], &start, NULL, &overlap, sizeof overlap, 1));
    }
    wrong = thin = forms[5], wrong.asset = forms[8].asset;
    fe_geometry_set_scale(&thin, 1, 0.001f, 100);
    REFUSES(world, FE_ERROR_STALE, fe_world_sweep(world, &foreign, &start, &way, NULL, &hit));
    REFUSES(world, FE_ERROR_KIND, fe_world_sweep(world, &wrong, &start, &way, NULL, &hit));
    REFUSES(world, FE_ERROR_DEGENERATE, fe_world_sweep(world, &thin, &start, &way, NULL, &hit));
    OK(fe_world_destroy(world));
    OK(fe_world_destroy(other));
}

// ---- sides ---------------------------------------------------------------------------------------------------------

// 1 m above the valley's slope at x = 1, and 1 m below it, across it
static const fe_dvec3 above = {1 - 0.70710678118654752, 1 + 0.70710678118654752, 0},
                      behind = {1 + 0.70710678118654752, 1 - 0.70710678118654752, 0};

static void a_mesh_has_a_side_and_no_inside(void **state)
{
    (void)state;
    for (uint32_t flags = 0; flags <= FE_MESH_TWO_SIDED; flags += FE_MESH_TWO_SIDED) {
        fe_world *world = new_world();
        fe_geometry mesh = valley(world, flags), ball, point;
        fe_geometry_sphere(&ball, 0.25f), fe_geometry_sphere(&point, 0);
        fe_shape shape = add_shape(world, new_body(world, FE_BODY_STATIC, 0, 0, 0), &mesh);
        const double d = sqrt(2);
        fe_dvec3 in = {d, -d, 0}, out = {-d, d, 0};
        fe_transform from = {above, {0, 0, 0, 1}}, back = {behind, {0, 0, 0, 1}}, on = {{1.05, 1.05, 0}, {0, 0, 0, 1}};
        fe_hit hit;
        HIT(fe_world_raycast(world, &above, &in, NULL, &hit));
        FE_NEAR(hit.fraction, 0.5, 1e-12);
        assert_int_equal(hit.flags, FE_HIT_DEFAULT);
        HIT(fe_world_sweep(world, &ball, &from, &in, NULL, &hit));
        FE_NEAR(hit.fraction, 0.375, 1e-6);
        assert_int_equal(hit.flags, FE_HIT_DEFAULT);
        int32_t seen = flags == FE_MESH_TWO_SIDED;
        assert_int_equal(fe_world_raycast(world, &behind, &out, NULL, &hit), seen);
        if (seen) assert_int_equal(hit.flags, FE_HIT_BACK);
        assert_int_equal(fe_world_sweep(world, &ball, &back, &out, NULL, &hit), seen);
        if (seen) assert_int_equal(hit.flags, FE_HIT_BACK);
        assert_int_equal(fe_world_overlap_any(world, &ball, &back, NULL), 0);
        assert_int_equal(fe_world_overlap_any(world, &point, &back, NULL), 0);
        assert_int_equal(fe_world_overlap_any(world, &ball, &on, NULL), 1);
        fe_closest c;
        for (int32_t k = 0; k < 2; ++k) {
            const double sign = k ? -1 : 1;
            HIT(fe_shape_closest_point(world, shape, k ? &behind : &above, &c));
            FE_NEAR(c.distance, 1, 1e-9);
            FE_NEAR(c.normal.x, -sign * sqrt(0.5), 1e-6);
            FE_NEAR(c.normal.y, sign * sqrt(0.5), 1e-6);
            HIT(fe_world_closest_point(world, k ? &behind : &above, 2, NULL, &c));
            FE_NEAR(c.distance, 1, 1e-9);
        }
        OK(fe_world_destroy(world));
    }
}

// Three of these pairs are of a mesh and a mesh, three of a mesh and a field
static void meshes_and_fields_never_touch(void **state)
{
    (void)state;
    for (int32_t with_field = 0; with_field < 2; ++with_field) {
        for (int32_t triggers = 0; triggers < 3; ++triggers) {
            fe_world *world = new_world();
            fe_geometry still = with_field ? field(world) : valley(world, 0), mesh = valley(world, 0);
            fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0),
                    lift = new_body(world, FE_BODY_KINEMATIC, 0, -1, 0);
            fe_shape_def def;
            fe_shape_def_init(&def, sizeof def);
            fe_shape a = 0, b = 0;
            def.trigger = triggers == 1, OK(fe_shape_create(world, ground, &def, &still, &a));
            def.trigger = triggers == 2, OK(fe_shape_create(world, lift, &def, &mesh, &b));
            OK(fe_body_set_linear_velocity(world, lift, &(fe_vec3){0, 2, 0}));
            for (int32_t i = 0; i < 60; ++i) {
                fe_pair_event event;
                OK(fe_world_step(world, 1.0f / 60));
                assert_int_equal(fe_world_get_pair_events(world, &event, sizeof event, 1), 0);
            }
            OK(fe_world_destroy(world));
        }
    }
}

// ---- what it keeps -------------------------------------------------------------------------------------------------

static void parts_keep_their_materials(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry forms[2] = {valley(world, 0), field(world)};
    for (int32_t i = 0; i < 2; ++i) {
        fe_shape shape = add_shape(world, new_body(world, FE_BODY_STATIC, 0, 5.0 * i, 0), &forms[i]);
        OK(fe_shape_set_material(world, shape, &others));
        fe_dvec3 from = {1.5, 9, 1}, way = {0, -9, 0};
        fe_hit hit;
        HIT(fe_shape_raycast(world, shape, &from, &way, &hit));
        assert_int_equal(hit.material, 5);
        fe_material read;
        OK(fe_shape_get_material(world, shape, &read));
        assert_int_equal(read.user_id, 9);
    }
    OK(fe_world_destroy(world));
}

// A ball in the valley lies on both sheets: one pair, two contacts
static void a_mesh_has_a_contact_for_each_direction(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry mesh = valley(world, 0), ball;
    fe_geometry_sphere(&ball, 0.5f);
    add_shape(world, new_body(world, FE_BODY_STATIC, 0, 0, 0), &mesh);
    fe_shape shape = add_shape(world, new_body(world, FE_BODY_DYNAMIC, 0, 0.70710678, 0.1), &ball);
    for (int32_t i = 0; i < 30; ++i) OK(fe_world_step(world, 1.0f / 60));
    fe_contact c[4];
    assert_int_equal(fe_shape_get_contacts(world, shape, c, sizeof c[0], 4), 2);
    FE_NEAR(c[0].normal.x * c[1].normal.x, -0.5, 1e-3);
    for (int32_t i = 0; i < 2; ++i) {
        FE_WITHIN(c[i].triangle_a, 0, 3);
        FE_TRUE(c[i].triangle_b == -1 && c[i].material_a == 5);
    }
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_form_is_on_its_bodies_only),    cmocka_unit_test(one_way_forms_are_convex),
        cmocka_unit_test(too_much_is_out_of_range),        cmocka_unit_test(queries_move_convex_forms),
        cmocka_unit_test(a_mesh_has_a_side_and_no_inside), cmocka_unit_test(meshes_and_fields_never_touch),
        cmocka_unit_test(parts_keep_their_materials),      cmocka_unit_test(a_mesh_has_a_contact_for_each_direction),
    };
    return cmocka_run_group_tests_name("forms", tests, NULL, NULL);
}
