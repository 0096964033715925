// The API of heightfields: definitions, errors, rays, edits, and how long an asset lives.
#include "api_test.h"

enum { ROWS = 4, COLUMNS = 5, SAMPLES = ROWS * COLUMNS, CELLS = (ROWS - 1) * (COLUMNS - 1) };

static const float flat[SAMPLES];

static fe_heightfield_def flat_def(void)
{
    fe_heightfield_def d;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = ROWS, d.columns = COLUMNS, d.cell_x = 2.0f, d.cell_z = 0.5f, d.heights = flat;
    return d;
}

static fe_asset new_field(fe_world *world)
{
    fe_heightfield_def d = flat_def();
    fe_asset asset = 0;
    OK(fe_heightfield_create(world_store(world), &d, &asset));
    return asset;
}

static fe_body new_body_of(fe_world *world, int32_t type)
{
    fe_body_def d;
    fe_body_def_init(&d, sizeof d);
    d.type = type;
    fe_body body;
    OK(fe_body_create(world, &d, &body));
    return body;
}

static fe_shape new_terrain(fe_world *world, fe_asset asset)
{
    fe_geometry g;
    fe_geometry_heightfield(&g, asset);
    fe_shape shape;
    OK(fe_shape_create(world, new_body_of(world, FE_BODY_STATIC), NULL, &g, &shape));
    return shape;
}

// -1: a miss; else the triangle. The height hit goes to *y.
static int32_t triangle_below(const fe_world *world, double x, double z, double *y)
{
    fe_hit hit;
    int32_t result = fe_world_raycast(world, &(fe_dvec3){x, 100.0, z}, &(fe_dvec3){0.0, -200.0, 0.0}, NULL, &hit);
    if (result == 0) return -1;
    assert_int_equal(result, 1);
    FE_TRUE(hit.normal.y > 0.0f && hit.triangle >= 0);
    if (y) *y = hit.point.y;
    return hit.triangle;
}

static void defaults_are_complete_but_for_the_heights(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_heightfield_def d;
    fe_heightfield_def_init(NULL, sizeof d);
    fe_heightfield_def_init(&d, sizeof d);
    FE_TRUE(d.struct_size == sizeof d && d.cell_x == 1.0f && d.cell_z == 1.0f && !d.heights && !d.holes &&
            !d.cell_materials);
    fe_asset asset = 7;
    d.rows = ROWS, d.columns = COLUMNS;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_create(world_store(world), &d, &asset));
    FE_TRUE(asset == 0);
    d.heights = flat;
    OK(fe_heightfield_create(world_store(world), &d, &asset));
    FE_TRUE(fe_asset_is_valid(world_store(world), asset));
    d.struct_size = (uint32_t)offsetof(fe_heightfield_def, holes); // of an older client
    OK(fe_heightfield_create(world_store(world), &d, &asset));
    OK(fe_world_destroy(world));
}

#define REFUSES_DEF(change)                                                                       \
    do {                                                                                          \
        fe_heightfield_def d = flat_def();                                                        \
        change;                                                                                   \
        REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_create(world_store(world), &d, &asset)); \
    } while (0)

static void what_is_out_of_range_is_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_asset asset;
    float heights[SAMPLES] = {0};
    uint8_t cells[CELLS] = {0};
    fe_material materials[2] = {{.static_friction = 1.0f}, {.static_friction = 1.0f}};
    REFUSES_DEF(d.rows = 1);
    REFUSES_DEF(d.columns = 1);
    REFUSES_DEF(d.rows = -1);
    REFUSES_DEF(d.rows = 40000);
    REFUSES_DEF((d.rows = 32768, d.columns = 32768));
    REFUSES_DEF(d.cell_x = 0.0f);
    REFUSES_DEF(d.cell_z = NOT_A_NUMBER);
    REFUSES_DEF(d.cell_z = -1.0f);
    REFUSES_DEF((d.cell_x = 1e5f, d.columns = 12));
    heights[7] = NOT_A_NUMBER;
    REFUSES_DEF(d.heights = heights);
    SAYS("heights[7]");
    heights[7] = INFINITE;
    REFUSES_DEF(d.heights = heights);
    cells[3] = 2;
    REFUSES_DEF(d.holes = cells);
    SAYS("holes[3]");
    REFUSES_DEF((d.cell_materials = cells, d.materials = materials, d.material_count = 2));
    SAYS("cell_materials[3]");
    cells[3] = 1;
    REFUSES_DEF((d.cell_materials = cells, d.materials = materials, d.material_count = 0));
    REFUSES_DEF((d.cell_materials = cells, d.materials = materials, d.material_count = 256));
    REFUSES_DEF((d.cell_materials = cells, d.materials = NULL, d.material_count = 2));
    REFUSES_DEF((d.cell_materials = cells, d.materials = materials, d.material_count = 2, d.material_stride = 4));
    materials[1].restitution = 2.0f;
    REFUSES_DEF((d.cell_materials = cells, d.materials = materials, d.material_count = 2));
    REFUSES_DEF(d.struct_size = 0);
    fe_heightfield_def d = flat_def();
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_create(world_store(world), NULL, &asset));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_create(world_store(world), &d, NULL));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_heightfield_create(NULL, &d, &asset));
    OK(fe_world_destroy(world));
}

static void only_static_bodies_have_one(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_asset asset = new_field(world);
    fe_geometry g, sphere, got = {.struct_size = sizeof got};
    fe_geometry_heightfield(&g, asset);
    fe_geometry_sphere(&sphere, 1.0f);
    fe_shape shape;
    const int32_t moving[2] = {FE_BODY_DYNAMIC, FE_BODY_KINEMATIC};
    for (int i = 0; i < 2; ++i) {
        fe_body body = new_body_of(world, moving[i]);
        REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_create(world, body, NULL, &g, &shape));
        SAYS("heightfield");
        OK(fe_shape_create(world, body, NULL, &sphere, &shape));
        REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_set_geometry(world, shape, &g));
    }
    shape = new_terrain(world, asset);
    OK(fe_shape_get_geometry(world, shape, &got));
    FE_TRUE(got.type == FE_GEOMETRY_HEIGHTFIELD && got.asset == asset && got.radius == 0.0f &&
            got.half_extents.x == 0.0f);
    fe_body body;
    OK(fe_shape_get_body(world, shape, &body));
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_body_set_type(world, body, FE_BODY_DYNAMIC));
    fe_mass_data mass = {.struct_size = sizeof mass,
                         .mass = 1.0f,
                         .inertia = {1.0f, 1.0f, 1.0f},
                         .inertia_rotation = {.w = 1.0f}};
    REFUSES(world, FE_ERROR_STATE, fe_body_set_mass_data(world, body, &mass));
    REFUSES(world, FE_ERROR_STATE, fe_body_set_mass(world, body, 1.0f));
    OK(fe_world_destroy(world));
}

static void wrong_handles_are_refused(void **state)
{
    (void)state;
    fe_world *world = new_world(), *other = new_world();
    fe_asset asset = new_field(world), foreign = new_field(other);
    foreign = new_field(other); // a slot that this world does not have
    fe_body body = new_body_of(world, FE_BODY_STATIC);
    fe_shape shape, terrain = new_terrain(world, asset);
    const struct {
        fe_handle handle;
        int32_t result;
    } wrong[] = {{0, FE_ERROR_STALE},
                 {body, FE_ERROR_KIND},
                 {terrain, FE_ERROR_KIND},
                 {foreign, FE_ERROR_STALE},
                 {UINT64_MAX, FE_ERROR_STALE}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        fe_geometry g;
        float heights[1] = {0};
        fe_geometry_heightfield(&g, wrong[i].handle);
        REFUSES(world, wrong[i].result, fe_shape_create(world, body, NULL, &g, &shape));
        REFUSES(world, wrong[i].result, fe_shape_set_geometry(world, terrain, &g));
        REFUSES(world, wrong[i].result,
                fe_heightfield_set_heights(world_store(world), wrong[i].handle, 0, 0, 1, 1, heights));
        REFUSES(world, wrong[i].result,
                fe_heightfield_get_heights(world_store(world), wrong[i].handle, 0, 0, 1, 1, heights));
        REFUSES(world, wrong[i].result, fe_asset_destroy(world_store(world), wrong[i].handle));
        FE_TRUE(!fe_asset_is_valid(world_store(world), wrong[i].handle));
    }
    FE_TRUE(!fe_asset_is_valid(NULL, asset));
    REFUSES(world, FE_ERROR_KIND, fe_body_destroy(world, asset));
    REFUSES(world, FE_ERROR_KIND, fe_shape_destroy(world, asset));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_asset_destroy(NULL, asset));
    OK(fe_world_destroy(world));
    OK(fe_world_destroy(other));
}

// Three shapes on two bodies share one asset; two assets share nothing.
static void an_asset_lives_until_its_last_shape_is_gone(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_asset asset = new_field(world), unused = new_field(world);
    fe_shape first = new_terrain(world, asset), second = new_terrain(world, asset), third = new_terrain(world, asset);
    fe_body body;
    OK(fe_shape_get_body(world, second, &body));
    OK(fe_asset_destroy(world_store(world), asset));
    OK(fe_asset_destroy(world_store(world), unused));
    FE_TRUE(!fe_asset_is_valid(world_store(world), asset) && !fe_asset_is_valid(world_store(world), unused));
    REFUSES(world, FE_ERROR_STALE, fe_asset_destroy(world_store(world), asset));
    SAYS("destroyed");
    fe_geometry g, sphere;
    fe_geometry_heightfield(&g, asset);
    fe_geometry_sphere(&sphere, 1.0f);
    REFUSES(world, FE_ERROR_STALE, fe_shape_set_geometry(world, first, &g));
    OK(fe_shape_destroy(world, first));
    FE_TRUE(triangle_below(world, 1.0, 0.3, NULL) >= 0);
    OK(fe_body_destroy(world, body));
    FE_TRUE(triangle_below(world, 1.0, 0.3, NULL) >= 0);
    fe_asset next = new_field(world), after = new_field(world); // unused's slot, and a new one: asset's is taken still
    FE_TRUE(triangle_below(world, 1.0, 0.3, NULL) >= 0);
    OK(fe_shape_set_geometry(world, third, &sphere));
    FE_TRUE(fe_asset_is_valid(world_store(world), next) && fe_asset_is_valid(world_store(world), after) &&
            !fe_asset_is_valid(world_store(world), asset));
    fe_asset reborn = new_field(world); // in asset's slot
    FE_TRUE((reborn & HANDLE_SLOT) == (asset & HANDLE_SLOT) && reborn != asset);
    OK(fe_world_destroy(world));
}

// The number of a triangle, the diagonal and the holes are as documented.
static void rays_tell_the_triangle(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_heightfield_def d = flat_def();
    uint8_t holes[CELLS] = {0};
    holes[6] = 1; // row 1, column 2
    d.holes = holes;
    fe_asset asset;
    OK(fe_heightfield_create(world_store(world), &d, &asset));
    (void)new_terrain(world, asset);
    for (int32_t cell = 0; cell < CELLS; ++cell) {
        double x = 2.0 * (cell % (COLUMNS - 1)), z = 0.5 * (cell / (COLUMNS - 1)), y = -1.0;
        int32_t near_z = triangle_below(world, x + 2.0 * 0.4, z + 0.5 * 0.6, &y),
                near_x = triangle_below(world, x + 2.0 * 0.6, z + 0.5 * 0.4, &y);
        FE_TRUE(near_z == (cell == 6 ? -1 : 2 * cell) && near_x == (cell == 6 ? -1 : 2 * cell + 1));
        if (cell != 6) FE_TRUE(y == 0.0);
    }
    FE_TRUE(triangle_below(world, -0.1, 0.5, NULL) < 0 && triangle_below(world, 8.1, 0.5, NULL) < 0);
    fe_hit hit; // from below
    FE_TRUE(fe_world_raycast(world, &(fe_dvec3){1.0, -1.0, 0.3}, &(fe_dvec3){0.0, 2.0, 0.0}, NULL, &hit) == 0);
    OK(fe_world_destroy(world));
}

// A height far above all others: the bounds follow, and both triangles of each cell around it.
static void new_heights_are_seen_at_once(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_asset asset = new_field(world);
    (void)new_terrain(world, asset);
    const float peak[1] = {50.0f};
    float got[SAMPLES];
    OK(fe_heightfield_set_heights(world_store(world), asset, 1, 2, 1, 1, peak));
    OK(fe_heightfield_get_heights(world_store(world), asset, 0, 0, ROWS, COLUMNS, got));
    for (int32_t i = 0; i < SAMPLES; ++i) FE_TRUE(got[i] == (i == COLUMNS + 2 ? 50.0f : 0.0f));
    double y = 0.0;
    FE_TRUE(triangle_below(world, 4.0, 0.5, &y) >= 0);
    FE_NEAR(y, 50.0, 1e-9);
    const double around[6][2] = {{3.6, 0.45}, {4.0, 0.45}, {3.6, 0.5}, {4.4, 0.5}, {4.0, 0.55}, {4.4, 0.55}};
    for (int i = 0; i < 6; ++i) {
        (void)triangle_below(world, around[i][0], around[i][1], &y);
        FE_WITHIN(y, 25.0, 50.0); // at most 0.3 of a cell off
    }
    OK(fe_heightfield_set_heights(world_store(world), asset, 0, 0, ROWS, COLUMNS, flat));
    FE_TRUE(triangle_below(world, 4.0, 0.5, &y) >= 0 && y == 0.0);
    float bad[2] = {0.0f, NOT_A_NUMBER};
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_set_heights(world_store(world), asset, 0, 0, 1, 2, bad));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_set_heights(world_store(world), asset, 0, 0, 1, 1, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_set_heights(world_store(world), asset, -1, 0, 1, 1, flat));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_set_heights(world_store(world), asset, 0, COLUMNS, 1, 1, flat));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_set_heights(world_store(world), asset, 1, 0, ROWS, 1, flat));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_set_heights(world_store(world), asset, 0, 1, 1, COLUMNS, flat));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_set_heights(world_store(world), asset, 0, 0, 0, 1, flat));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_get_heights(world_store(world), asset, 0, 0, 1, 1, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_heightfield_get_heights(world_store(world), asset, 0, 0, 1, 6, got));
    OK(fe_world_destroy(world));
}

// The upper side is all there is of a heightfield: from below it, and over holes only, nothing is the closest point,
// whoever asks. From above the flat field the closest point is straight below; beside a hole, on the hole's rim.
static void a_closest_point_is_on_the_upper_side_or_there_is_none(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_heightfield_def d = flat_def();
    uint8_t holes[CELLS];
    memset(holes, 1, sizeof holes);
    d.holes = holes;
    fe_asset all_holes = 0;
    OK(fe_heightfield_create(world_store(world), &d, &all_holes));
    fe_shape nothing = new_terrain(world, all_holes);
    const fe_dvec3 above = {3.0, 2.0, 0.75}, below = {3.0, -3.0, 0.75}, far_off = {-9e8, 9e8, 9e8};
    const fe_dvec3 *points[] = {&above, &below, &far_off};
    fe_closest c = {.distance = 7.0};
    for (int32_t i = 0; i < 3; ++i) {
        assert_int_equal(fe_shape_closest_point(world, nothing, points[i], &c), 0);
        assert_int_equal(fe_world_closest_point(world, points[i], 1e10, NULL, &c), 0);
    }
    fe_shape flat_shape = new_terrain(world, new_field(world));
    fe_body body = 0;
    OK(fe_shape_get_body(world, flat_shape, &body));
    assert_int_equal(fe_shape_closest_point(world, flat_shape, &below, &c), 0);
    assert_int_equal(fe_body_closest_point(world, body, &below, &c), 0);
    assert_int_equal(fe_world_closest_point(world, &below, 1e10, NULL, &c), 0);
    FE_TRUE(c.distance == 7.0 && c.shape == 0); // a miss writes nothing
    HIT(fe_shape_closest_point(world, flat_shape, &above, &c));
    FE_TRUE(c.distance == 2.0 && c.normal.x == 0.0f && c.normal.y == 1.0f && c.normal.z == 0.0f);
    HIT(fe_shape_closest_point(world, flat_shape, &far_off, &c));
    FE_NEAR(c.distance, 9e8 * sqrt(3.0), 10.0); // the field's size

    memset(holes, 0, sizeof holes);
    holes[COLUMNS - 1 + 1] = 1; // row 1, column 1: 2 <= x <= 4, 0.5 <= z <= 1
    fe_asset pierced = 0;
    OK(fe_heightfield_create(world_store(world), &d, &pierced));
    fe_shape rim = new_terrain(world, pierced);
    HIT(fe_shape_closest_point(world, rim, &(fe_dvec3){3.0, 0.0, 0.6}, &c));
    FE_NEAR(c.distance, 0.1, 1e-12);
    FE_NEAR(c.point.z, 0.5, 1e-12);
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_complete_but_for_the_heights),
        cmocka_unit_test(what_is_out_of_range_is_refused),
        cmocka_unit_test(only_static_bodies_have_one),
        cmocka_unit_test(wrong_handles_are_refused),
        cmocka_unit_test(an_asset_lives_until_its_last_shape_is_gone),
        cmocka_unit_test(rays_tell_the_triangle),
        cmocka_unit_test(new_heights_are_seen_at_once),
        cmocka_unit_test(a_closest_point_is_on_the_upper_side_or_there_is_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
