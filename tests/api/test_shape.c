// The API of shapes: geometry, local pose, material, filter, triggers; each documented error.
#include "api/api_test.h"

static fe_shape only_shape(const fe_world *world, fe_body body)
{
    fe_shape shape = 0;
    assert_int_equal(fe_body_get_shapes(world, body, &shape, 1), 1);
    return shape;
}

// ---- definitions ---------------------------------------------------------------------------------------------------

static void defaults_are_those_of_the_header(void **state)
{
    (void)state;
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    FE_NEAR(def.density, 1000, 0), FE_NEAR(def.frame.rotation.w, 1, 0);
    FE_NEAR(def.material.static_friction, 0.6f, 0), FE_NEAR(def.material.dynamic_friction, 0.5f, 0),
        FE_NEAR(def.material.restitution, 0, 0);
    assert_true(def.layer == 1 && def.mask == 0xFFFFFFFF && def.trigger == 0 && def.events == FE_SHAPE_EVENTS_TOUCH);
    fe_shape_def_init(NULL, sizeof def);
    fe_geometry_init(NULL, sizeof(fe_geometry));
}

static void what_a_definition_says_is_read_back(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 1, 2, 3), owner;
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    def.density = 7, def.frame.position = fe_make_vec3(1, 2, 3), def.frame.rotation = (fe_quat){0, 0, 3, 4};
    def.material =
        (fe_material){0.1f, 0.2f, 0.3f, 0.4f, 0.5f, FE_COMBINE_MINIMUM, FE_COMBINE_MULTIPLY, {0}, UINT64_MAX};
    def.layer = 4, def.mask = 8, def.group = -3, def.trigger = 1,
    def.events = FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT;
    def.surface_velocity = fe_make_vec3(0, 0, 2), def.user_data = 99;
    fe_geometry capsule, got = {.struct_size = sizeof got};
    fe_geometry_capsule(&capsule, 0.5f, 0.25f);
    fe_shape shape;
    OK(fe_shape_create(world, body, &def, &capsule, &shape));
    assert_true(shape < 1ull << 53);

    fe_frame frame;
    fe_vec3 velocity;
    fe_material material;
    uint32_t layer, mask, events;
    int32_t trigger, group;
    float density;
    uint64_t data;
    OK(fe_shape_get_body(world, shape, &owner));
    OK(fe_shape_get_geometry(world, shape, &got));
    OK(fe_shape_get_frame(world, shape, &frame));
    OK(fe_shape_get_density(world, shape, &density));
    OK(fe_shape_get_material(world, shape, &material));
    OK(fe_shape_get_filter(world, shape, &layer, &mask, &group));
    OK(fe_shape_get_trigger(world, shape, &trigger));
    OK(fe_shape_get_events(world, shape, &events));
    OK(fe_shape_get_surface_velocity(world, shape, &velocity));
    OK(fe_shape_get_user_data(world, shape, &data));
    assert_true(owner == body && got.type == FE_GEOMETRY_CAPSULE);
    FE_NEAR(got.half_height, 0.5, 0), FE_NEAR(got.radius, 0.25, 0), FE_NEAR(density, 7, 0),
        FE_NEAR(frame.position.y, 2, 0);
    FE_NEAR(frame.rotation.z, 0.6, 1e-7), FE_NEAR(frame.rotation.w, 0.8, 1e-7);
    assert_memory_equal(&material, &def.material, sizeof material);
    assert_true(group == -3 && layer == 4 && mask == 8 && events == (FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT) &&
                trigger == 1 && data == 99);
    FE_NEAR(velocity.z, 2, 0);
    OK(fe_world_destroy(world));
}

static void a_bad_definition_is_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_shape_def good, bad;
    fe_geometry box;
    fe_shape shape;
    fe_shape_def_init(&good, sizeof good);
    fe_geometry_box(&box, 1, 1, 1);
#define REFUSED_WITH(change)                                                                 \
    do {                                                                                     \
        bad = good;                                                                          \
        change;                                                                              \
        shape = 99;                                                                          \
        REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_create(world, body, &bad, &box, &shape)); \
        assert_true(shape == 0);                                                             \
        assert_int_equal(fe_body_get_shapes(world, body, NULL, 0), 0);                       \
    } while (0)
    REFUSED_WITH(bad.density = -1);
    REFUSED_WITH(bad.density = NOT_A_NUMBER);
    REFUSED_WITH(bad.frame.position.x = INFINITE);
    REFUSED_WITH(bad.frame.rotation.w = 0);
    REFUSED_WITH(bad.frame.rotation.y = NOT_A_NUMBER);
    REFUSED_WITH(bad.material.static_friction = -1);
    REFUSED_WITH(bad.material.dynamic_friction = NOT_A_NUMBER);
    REFUSED_WITH(bad.material.restitution = 1.01f);
    REFUSED_WITH(bad.material.rolling_resistance = -1);
    REFUSED_WITH(bad.material.spinning_resistance = INFINITE);
    REFUSED_WITH(bad.layer = 0);
    REFUSED_WITH(bad.layer = 5);
    REFUSED_WITH(bad.trigger = 2);
    REFUSED_WITH(bad.events = 8);
    REFUSED_WITH(bad.surface_velocity.y = NOT_A_NUMBER);
    REFUSED_WITH(bad.struct_size = 6);
#undef REFUSED_WITH
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_create(world, body, &good, NULL, &shape));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_create(world, body, &good, &box, NULL));
    REFUSES(world, FE_ERROR_STALE, fe_shape_create(world, body + NEXT_GENERATION, &good, &box, &shape));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_shape_create(NULL, body, &good, &box, &shape));
    OK(fe_shape_create(world, body, NULL, &box, &shape));
    REFUSES(world, FE_ERROR_KIND, fe_shape_create(world, shape, NULL, &box, &shape));
    OK(fe_world_destroy(world));
}

static void an_older_definition_gets_the_defaults(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_shape_def def;
    memset(&def, 0xFF, sizeof def);
    fe_shape_def_init(&def, offsetof(fe_shape_def, material));
    fe_geometry box;
    fe_geometry_box(&box, 1, 1, 1);
    fe_shape shape;
    OK(fe_shape_create(world, body, &def, &box, &shape));
    fe_material material;
    uint32_t layer, mask;
    int32_t group;
    OK(fe_shape_get_material(world, shape, &material));
    OK(fe_shape_get_filter(world, shape, &layer, &mask, &group));
    FE_NEAR(material.static_friction, 0.6f, 0);
    assert_true(layer == 1 && mask == 0xFFFFFFFF && group == 0);
    // a geometry of an older client that knows only spheres
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 0.5f);
    sphere.struct_size = offsetof(fe_geometry, half_height);
    sphere.half_height = NOT_A_NUMBER; // beyond its end
    OK(fe_shape_set_geometry(world, shape, &sphere));
    OK(fe_world_destroy(world));
}

// ---- geometry ------------------------------------------------------------------------------------------------------

static void lengths_lie_between_a_millimetre_and_a_hundred_kilometres(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 0, 0);
    fe_shape shape = only_shape(world, body);
    const float bad[] = {0, -1, 0.0009f, 100001, NOT_A_NUMBER, INFINITE};
    fe_geometry g;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        fe_geometry_sphere(&g, bad[i]);
        REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &g));
        SAYS(": radius is");
        fe_geometry_capsule(&g, bad[i], 1);
        REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &g));
        fe_geometry_capsule(&g, 1, bad[i]);
        REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &g));
        for (int axis = 0; axis < 3; ++axis) {
            fe_geometry_box(&g, axis == 0 ? bad[i] : 1, axis == 1 ? bad[i] : 1, axis == 2 ? bad[i] : 1);
            REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &g));
        }
    }
    fe_geometry_sphere(&g, 0.001f);
    OK(fe_shape_set_geometry(world, shape, &g));
    fe_geometry_sphere(&g, 100000);
    OK(fe_shape_set_geometry(world, shape, &g));
    g.type = 77;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &g));
    g.type = FE_GEOMETRY_SPHERE, g.struct_size = 0;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &g));
    SAYS("is it filled by its _init?");
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_geometry(world, shape, NULL));
    OK(fe_world_destroy(world));
}

static void a_plane_s_normal_is_normalised(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    fe_geometry plane, got = {.struct_size = sizeof got}, again = {.struct_size = sizeof again};
    fe_shape shape;
    fe_geometry_plane(&plane, 0, 3e10f, 4e10f, 2);
    OK(fe_shape_create(world, body, NULL, &plane, &shape));
    OK(fe_shape_get_geometry(world, shape, &got));
    FE_NEAR(got.normal.y, 0.6, 1e-7), FE_NEAR(got.normal.z, 0.8, 1e-7), FE_NEAR(got.distance, 2, 0);
    OK(fe_shape_set_geometry(world, shape, &got));
    OK(fe_shape_get_geometry(world, shape, &again));
    assert_memory_equal(&got, &again, sizeof got);
    fe_geometry_plane(&plane, 0, 0, 0, 2);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &plane));
    fe_geometry_plane(&plane, 0, NOT_A_NUMBER, 0, 2);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &plane));
    fe_geometry_plane(&plane, 0, 1, 0, INFINITE);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_geometry(world, shape, &plane));
    OK(fe_world_destroy(world));
}

// The first thing below (x, 50, 0), or 0
static fe_shape seen_below(const fe_world *world, double x)
{
    fe_dvec3 from = {x, 50, 0}, down = {0, -100, 0};
    fe_hit hit;
    return fe_world_raycast(world, &from, &down, NULL, &hit) == 1 ? hit.shape : 0;
}

// Queries see a change at once (R38).
static void shapes_are_seen_where_they_are_now(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 0, 0);
    fe_shape shape = only_shape(world, body);
    fe_frame aside = {{10, 0, 0}, {0, 0, 0, 1}}, home = {{0, 0, 0}, {0, 0, 0, 1}};
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 4);
    assert_true(seen_below(world, 0) == shape && seen_below(world, 2) == 0);
    OK(fe_shape_set_frame(world, shape, &aside));
    assert_true(seen_below(world, 0) == 0 && seen_below(world, 10) == shape);
    OK(fe_shape_set_frame(world, shape, &home));
    OK(fe_shape_set_geometry(world, shape, &sphere));
    assert_true(seen_below(world, 3) == shape);
    fe_transform there = fe_make_transform(100, 0, 0);
    OK(fe_body_set_transform(world, body, &there));
    assert_true(seen_below(world, 3) == 0 && seen_below(world, 100) == shape);
    fe_shape second = add_box(world, body, 0.5f);
    assert_true(seen_below(world, 100) == shape); // the sphere is higher
    OK(fe_shape_destroy(world, shape));
    assert_true(seen_below(world, 100) == second);
    OK(fe_body_set_type(world, body, FE_BODY_STATIC));
    assert_true(seen_below(world, 100) == second);
    OK(fe_body_destroy(world, body));
    assert_true(seen_below(world, 100) == 0);
    fe_body ground = new_ground(world);
    fe_shape plane = only_shape(world, ground);
    assert_true(seen_below(world, -77) == plane);
    fe_geometry box;
    fe_geometry_box(&box, 1, 1, 1);
    OK(fe_shape_set_geometry(world, plane, &box)); // a plane becomes a box
    assert_true(seen_below(world, -77) == 0 && seen_below(world, 0.5) == plane);
    OK(fe_world_destroy(world));
}

static void a_bad_frame_is_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 0, 0);
    fe_shape shape = only_shape(world, body);
    const fe_frame far = {{1e7f, 0, 0}, {0, 0, 0, 1}}, flat = {{1, 2, 3}, {0, 0, 0, 0}},
                   nan = {{0, NOT_A_NUMBER, 0}, {0, 0, 0, 1}};
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_frame(world, shape, &far));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_frame(world, shape, &flat));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_frame(world, shape, &nan));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_frame(world, shape, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_frame(world, shape, NULL));
    OK(fe_world_destroy(world));
}

// ---- the rest ------------------------------------------------------------------------------------------------------

static void settings_refuse_what_is_out_of_range(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 0, 0);
    fe_shape shape = only_shape(world, body), stale = shape + NEXT_GENERATION;
    fe_material material = SURFACE(0, 0, 0, 0, 0), bad = SURFACE(0, 0, -0.1f, 0, 0);
    fe_vec3 v = {0, 0, 0}, nan = {0, 0, NOT_A_NUMBER};
    uint32_t u;
    int32_t i;
    float f = 77;
    uint64_t data;
    fe_body h;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_density(world, shape, -1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_density(world, shape, NOT_A_NUMBER));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_density(world, shape, NULL));
    REFUSES(world, FE_ERROR_STALE, fe_shape_get_density(world, stale, &f));
    FE_NEAR(f, 77, 0);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_material(world, shape, &bad));
    SAYS("restitution is -0.1");
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_material(world, shape, NULL));
    REFUSES(world, FE_ERROR_STALE, fe_shape_set_material(world, stale, &material));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_material(world, shape, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_filter(world, shape, 0, 1, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_filter(world, shape, 6, 1, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_filter(world, shape, NULL, &u, &i));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_filter(world, shape, &u, NULL, &i));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_filter(world, shape, &u, &u, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_trigger(world, shape, 2));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_trigger(world, shape, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_events(world, shape, 16));
    SAYS("only the bits of 0x7");
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_events(world, shape, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_surface_velocity(world, shape, &nan));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_set_surface_velocity(world, shape, NULL));
    REFUSES(world, FE_ERROR_STALE, fe_shape_set_surface_velocity(world, stale, &v));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_surface_velocity(world, shape, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_user_data(world, shape, NULL));
    REFUSES(world, FE_ERROR_STALE, fe_shape_set_user_data(world, stale, 1));
    h = 7;
    REFUSES(world, FE_ERROR_STALE, fe_shape_get_body(world, stale, &h));
    assert_true(h == 0); // a handle, on an error, is nothing
    REFUSES(world, FE_ERROR_KIND, fe_shape_destroy(world, body));
    REFUSES(world, FE_ERROR_STALE, fe_shape_destroy(world, stale));
    OK(fe_shape_set_user_data(world, shape, 5));
    OK(fe_shape_get_user_data(world, shape, &data));
    assert_true(data == 5);
    OK(fe_shape_destroy(world, shape));
    REFUSES(world, FE_ERROR_STALE, fe_shape_destroy(world, shape));
    assert_int_equal(fe_shape_is_valid(world, shape), 0);
    assert_int_equal(fe_shape_is_valid(NULL, shape), 0);
    OK(fe_world_destroy(world));
}

// A conveyor at 1 m/s carries a box along; the belt of a sleeping pile may start.
static void a_belt_that_starts_wakes_what_lies_on_it(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body belt = new_body(world, FE_BODY_STATIC, 0, -0.5, 0), box = new_box(world, 0, 0.5, 0);
    fe_geometry geometry;
    fe_geometry_box(&geometry, 50, 0.5f, 1);
    fe_shape shape = add_shape(world, belt, &geometry);
    step(world, 120);
    assert_int_equal(is_awake(world, box), 0);
    fe_vec3 along = {1, 0, 0};
    OK(fe_shape_set_surface_velocity(world, shape, &along));
    assert_int_equal(is_awake(world, box), 1);
    step(world, 120);
    FE_NEAR(body_linear_velocity(world, box).x, 1, 0.01);
    OK(fe_world_destroy(world));
}

// A box on a 20 degree slope stays at 0.6 and slides at 0.
static void a_surface_that_loses_its_grip_lets_sleepers_slide(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_vec3 gravity = {9.81f * 0.34202014f, -9.81f * 0.93969262f, 0};
    OK(fe_world_set_gravity(world, &gravity));
    fe_body ground = new_ground(world), box = new_box(world, 0, 0.5, 0);
    step(world, 120);
    assert_int_equal(is_awake(world, box), 0);
    fe_material ice = SURFACE(0, 0, 0, 0, 0);
    OK(fe_shape_set_material(world, only_shape(world, ground), &ice));
    step(world, 60);
    FE_NEAR(body_linear_velocity(world, box).x, 9.81 * 0.34202014, 0.02);
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_those_of_the_header),
        cmocka_unit_test(what_a_definition_says_is_read_back),
        cmocka_unit_test(a_bad_definition_is_refused),
        cmocka_unit_test(an_older_definition_gets_the_defaults),
        cmocka_unit_test(lengths_lie_between_a_millimetre_and_a_hundred_kilometres),
        cmocka_unit_test(a_plane_s_normal_is_normalised),
        cmocka_unit_test(shapes_are_seen_where_they_are_now),
        cmocka_unit_test(a_bad_frame_is_refused),
        cmocka_unit_test(settings_refuse_what_is_out_of_range),
        cmocka_unit_test(a_belt_that_starts_wakes_what_lies_on_it),
        cmocka_unit_test(a_surface_that_loses_its_grip_lets_sleepers_slide),
    };
    return cmocka_run_group_tests_name("shape", tests, NULL, NULL);
}
