// What a world amounts to: energy, momentum, bounds, stiffness in use, who overlaps what and how deep; the switches of
// its tuning.
#include "api_test.h"

static fe_energy energy_of(const fe_world *world)
{
    fe_energy e;
    fe_energy_init(&e, sizeof e);
    OK(fe_world_get_energy(world, &e));
    return e;
}

// A thrown, spinning brick of 16 kg in free flight: T + V of the discrete flight stays to rounding. Each of 960
// substeps rounds a velocity of up to 20 m/s to a float, by 1e-6 m/s at most: m v dv = 16 20 960e-6 = 0.31 J. T(v) +
// V(x) would swing by h/2 m g v = 3.3 J.
static void energy_of_a_free_flight_stays(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 1, 5, 2);
    fe_geometry geometry;
    fe_geometry_box(&geometry, 0.1f, 0.2f, 0.1f);
    add_shape(world, body, &geometry);
    assert_true(fabs(energy_of(world).potential - 16.0 * 9.81 * 5.0) < 1e-3 && energy_of(world).kinetic == 0.0);
    OK(fe_body_set_linear_velocity(world, body, &(fe_vec3){3, 20, 0}));
    OK(fe_body_set_angular_velocity(world, body, &(fe_vec3){0, 6, 0}));
    // T = m v v / 2 + I w w / 2, I about Y of a box = m (4 a a + 4 c c) / 12
    double kinetic = 0.5 * 16 * (9 + 400) + 0.5 * 16 * (0.04 + 0.04) / 12 * 36;
    assert_true(fabs(energy_of(world).kinetic - kinetic) < 1e-5 * kinetic);
    OK(fe_world_step(world, 1.0f / 60.0f));
    fe_energy first = energy_of(world);
    for (int i = 0; i < 120; ++i) {
        OK(fe_world_step(world, 1.0f / 60.0f));
        fe_energy e = energy_of(world);
        assert_true(fabs(e.kinetic + e.potential - first.kinetic - first.potential) < 0.31);
    }
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_energy(world, NULL));
    OK(fe_world_destroy(world));
}

// Two spheres: P = sum m v, L = sum (x - about) x m v + I w; about another point L changes by (about - other) x P
static void momentum_is_that_of_mechanics(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body a = new_body(world, FE_BODY_DYNAMIC, 2, 0, 0), b = new_body(world, FE_BODY_DYNAMIC, -1, 3, 0);
    add_sphere(world, a, 0.5f), add_sphere(world, b, 0.5f);
    new_ground(world);
    OK(fe_body_set_mass(world, a, 2));
    OK(fe_body_set_mass(world, b, 3));
    OK(fe_body_set_linear_velocity(world, a, &(fe_vec3){0, 4, 0}));
    OK(fe_body_set_linear_velocity(world, b, &(fe_vec3){5, 0, 0}));
    OK(fe_body_set_angular_velocity(world, a, &(fe_vec3){0, 0, 10}));
    fe_dvec3 p, l, shifted;
    OK(fe_world_get_momentum(world, &(fe_dvec3){0, 0, 0}, &p, &l));
    assert_true(p.x == 15 && p.y == 8 && p.z == 0);
    // 2 * 8 - 3 * 15 + 0.4 m r r w
    assert_true(fabs(l.z - (16.0 - 45.0 + 0.4 * 2 * 0.25 * 10)) < 1e-5 && l.x == 0 && l.y == 0);
    OK(fe_world_get_momentum(world, &(fe_dvec3){1, 2, 0}, &p, &shifted));
    assert_true(fabs(shifted.z - (l.z - (1 * p.y - 2 * p.x))) < 1e-6);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_momentum(world, NULL, &p, &l));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_momentum(world, &(fe_dvec3){(double)NAN, 0, 0}, &p, &l));
    OK(fe_world_destroy(world));
}

static void bounds_hold_the_shapes(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_bounds b;
    REFUSES(world, FE_ERROR_STATE, fe_world_get_bounds(world, &b));
    fe_body ground = new_ground(world);
    fe_shape plane;
    assert_int_equal(fe_body_get_shapes(world, ground, &plane, 1), 1);
    REFUSES(world, FE_ERROR_STATE, fe_world_get_bounds(world, &b));
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_body_get_bounds(world, ground, &b));
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_shape_get_bounds(world, plane, &b));
    fe_body box = new_box(world, 1, 2, 3), empty = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0),
            ball = new_body(world, FE_BODY_STATIC, -4, 0, 0);
    fe_shape sphere = add_sphere(world, ball, 2);
    REFUSES(world, FE_ERROR_STATE, fe_body_get_bounds(world, empty, &b));
    OK(fe_body_get_bounds(world, box, &b));
    assert_true(b.lower.x == 0.5 && b.lower.y == 1.5 && b.lower.z == 2.5 && b.upper.x == 1.5 && b.upper.y == 2.5 &&
                b.upper.z == 3.5);
    OK(fe_shape_get_bounds(world, sphere, &b));
    assert_true(b.lower.x == -6 && b.upper.y == 2);
    OK(fe_world_get_bounds(world, &b));
    assert_true(b.lower.x == -6 && b.lower.y == -2 && b.lower.z == -2 && b.upper.x == 1.5 && b.upper.y == 2.5 &&
                b.upper.z == 3.5);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_bounds(world, NULL));
    OK(fe_world_destroy(world));
}

// 60 Hz, 4 substeps: a rate of 240 Hz; contacts get an eighth of it, joints 0.225
static void hertz_in_use_are_limited_by_the_substeps(void **state)
{
    (void)state;
    fe_world *world = new_world();
    OK(fe_world_set_substeps(world, 4));
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.contact_hertz = 500, tuning.joint_hertz = 40;
    OK(fe_world_set_tuning(world, &tuning));
    float contacts, joints;
    OK(fe_world_get_hertz(world, 1.0f / 60.0f, &contacts, &joints));
    assert_true(fabsf(contacts - 30.0f) < 1e-4f && joints == 40.0f);
    OK(fe_world_get_hertz(world, 0.1f, &contacts, &joints));
    assert_true(fabsf(contacts - 5.0f) < 1e-4f && fabsf(joints - 9.0f) < 1e-4f);
    OK(fe_world_get_hertz(world, 0, &contacts, &joints));
    assert_true(contacts == 500.0f && joints == 40.0f);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_hertz(world, -1, &contacts, &joints));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_hertz(world, 0.1f, NULL, &joints));
    OK(fe_world_destroy(world));
}

// A capsule 0.3 into a box and 0.1 into the ground: moved by depth along direction it touches neither
static void overlaps_tell_the_way_out(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_ground(world);
    fe_body wall = new_body(world, FE_BODY_STATIC, 1, 1, 0);
    add_box(world, wall, 0.5f);
    fe_geometry capsule;
    fe_geometry_capsule(&capsule, 0.5f, 0.4f);
    fe_transform at = fe_make_transform(0.4, 0.8, 0);
    fe_overlap found[4];
    assert_int_equal(fe_world_overlap_shapes(world, &capsule, &at, NULL, NULL, 0, 0), 2);
    assert_int_equal(fe_world_overlap_shapes(world, &capsule, &at, NULL, found, sizeof *found, 4), 2);
    assert_true(fabsf(found[0].depth - 0.1f) < 1e-5f && found[0].direction.y > 0.999999f);
    assert_true(found[1].body == wall && fabsf(found[1].depth - 0.3f) < 1e-5f && found[1].direction.x < -0.999999f);
    for (int i = 0; i < 2; ++i) {
        at.position.x += (double)((found[i].depth + 1e-5f) * found[i].direction.x);
        at.position.y += (double)((found[i].depth + 1e-5f) * found[i].direction.y);
    }
    assert_int_equal(fe_world_overlap_shapes(world, &capsule, &at, NULL, found, sizeof *found, 4), 0);
    // a shorter record gets its front, in order
    at = fe_make_transform(0.4, 0.8, 0);
    unsigned char few[2][24];
    assert_int_equal(fe_world_overlap_shapes(world, &capsule, &at, NULL, (fe_overlap *)(void *)few, sizeof few[0], 2),
                     2);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_overlap_shapes(world, &capsule, &at, NULL, found, 0, 4));
    fe_geometry plane;
    fe_geometry_plane(&plane, 0, 1, 0, 0);
    REFUSES(world, FE_ERROR_UNSUPPORTED, fe_world_overlap_shapes(world, &plane, &at, NULL, found, sizeof *found, 4));
    OK(fe_world_destroy(world));
}

static void bounds_are_asked_for_shapes(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_ground(world);
    fe_body a = new_box(world, 0, 5, 0), b = new_box(world, 3, 5, 0);
    fe_shape shapes[4], of_a, of_b;
    assert_int_equal(fe_body_get_shapes(world, a, &of_a, 1), 1);
    assert_int_equal(fe_body_get_shapes(world, b, &of_b, 1), 1);
    fe_bounds box = {{-1, 4, -1}, {2.5, 6, 1}};
    assert_int_equal(fe_world_overlap_bounds(world, &box, NULL, shapes, 4), 2); // b's begins at 2.5
    assert_true(shapes[0] == of_a && shapes[1] == of_b);
    box.upper.x = 2.4;
    assert_int_equal(fe_world_overlap_bounds(world, &box, NULL, shapes, 4), 1);
    box.lower.y = -1; // the ground's half space
    assert_int_equal(fe_world_overlap_bounds(world, &box, NULL, NULL, 0), 2);
    OK(fe_body_set_transform(world, b, &(fe_transform){{0, 5, 0}, {0, 0, 0, 1}})); // seen at once
    assert_int_equal(fe_world_overlap_bounds(world, &box, NULL, NULL, 0), 3);
    box.lower.x = 9;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_overlap_bounds(world, &box, NULL, shapes, 4));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_overlap_bounds(world, NULL, NULL, shapes, 4));
    OK(fe_world_destroy(world));
}

static void a_trigger_tells_who_is_inside(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body zone = new_body(world, FE_BODY_STATIC, 0, 0, 0), in = new_box(world, 0, 0.3, 0),
            out = new_box(world, 9, 0, 0), second = new_box(world, 1, 0, 0);
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    def.trigger = 1;
    fe_geometry geometry;
    fe_geometry_box(&geometry, 2, 2, 2);
    fe_shape trigger, found[4], of_in, of_second;
    OK(fe_shape_create(world, zone, &def, &geometry, &trigger));
    assert_int_equal(fe_shape_get_overlaps(world, trigger, found, 4), 0); // no step has looked yet
    OK(fe_world_step(world, 0));
    assert_int_equal(fe_body_get_shapes(world, in, &of_in, 1), 1);
    assert_int_equal(fe_body_get_shapes(world, second, &of_second, 1), 1);
    assert_int_equal(fe_shape_get_overlaps(world, trigger, found, 4), 2);
    assert_true(found[0] == of_in && found[1] == of_second);
    assert_int_equal(fe_shape_get_overlaps(world, trigger, found, 1), 2);
    assert_true(found[0] == of_in);
    OK(fe_body_set_transform(world, in, &(fe_transform){{50, 0, 0}, {0, 0, 0, 1}}));
    OK(fe_world_step(world, 0));
    assert_int_equal(fe_shape_get_overlaps(world, trigger, found, 4), 1);
    (void)out;
    REFUSES(world, FE_ERROR_STALE, fe_shape_get_overlaps(world, 0, found, 4));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_shape_get_overlaps(world, trigger, NULL, 4));
    OK(fe_world_destroy(world));
}

// ---- switches ------------------------------------------------------------------------------------------------------

static fe_world *world_with(int32_t sleep, int32_t continuous, int32_t warm_start)
{
    fe_world *world = new_world();
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.sleep_enabled = sleep, tuning.continuous_enabled = continuous, tuning.warm_start_enabled = warm_start;
    OK(fe_world_set_tuning(world, &tuning));
    return world;
}

static void nobody_sleeps_where_sleep_is_off(void **state)
{
    (void)state;
    fe_world *world = world_with(0, 1, 1);
    new_ground(world);
    fe_body box = new_box(world, 0, 0.5, 0);
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.awake = 0;
    fe_body born;
    OK(fe_body_create(world, &def, &born));
    assert_int_equal(is_awake(world, born), 1);
    step(world, 120);
    assert_int_equal(is_awake(world, box), 1);
    REFUSES(world, FE_ERROR_STATE, fe_body_set_awake(world, box, 0));
    OK(fe_world_destroy(world));
    world = new_world();
    new_ground(world);
    box = new_box(world, 0, 0.5, 0);
    step(world, 120);
    assert_int_equal(is_awake(world, box), 0);
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    OK(fe_world_get_tuning(world, &tuning));
    tuning.sleep_enabled = 0;
    OK(fe_world_set_tuning(world, &tuning));
    assert_int_equal(is_awake(world, box), 1);
    OK(fe_world_destroy(world));
}

// Sticks of 2 m that spin at 60 rad/s, 1 rad a step, are thrown at a thin wall at 100 m/s: contacts are found ahead for
// the rotation at the beginning of a step, and miss some. Continuous collision lets none through.
static int32_t passed_through(int32_t continuous)
{
    enum { STICKS = 60 };
    fe_world *world = world_with(1, continuous, 1);
    OK(fe_world_set_gravity(world, &(fe_vec3){0, 0, 0}));
    fe_body wall = new_body(world, FE_BODY_STATIC, 10, 0, 0), sticks[STICKS];
    fe_geometry plate, stick;
    fe_geometry_box(&plate, 0.02f, 5, 500);
    fe_geometry_capsule(&stick, 1, 0.02f);
    add_shape(world, wall, &plate);
    for (int32_t i = 0; i < STICKS; ++i) {
        sticks[i] = new_body(world, FE_BODY_DYNAMIC, 0.05 * i, 0, 5.0 * (i - STICKS / 2));
        add_shape(world, sticks[i], &stick);
        OK(fe_body_set_linear_velocity(world, sticks[i], &(fe_vec3){100, 0, 0}));
        OK(fe_body_set_angular_velocity(world, sticks[i], &(fe_vec3){0, 0, 60}));
    }
    step(world, 12);
    int32_t behind = 0;
    for (int32_t i = 0; i < STICKS; ++i) {
        fe_dvec3 centre;
        OK(fe_body_get_centre(world, sticks[i], &centre));
        behind += centre.x > 10.0;
    }
    OK(fe_world_destroy(world));
    return behind;
}

static void fast_bodies_pass_where_continuous_collision_is_off(void **state)
{
    (void)state;
    assert_int_equal(passed_through(1), 0);
    assert_true(passed_through(0) > 0);
}

// A stack of ten boxes: each contact bears those above it, k m g on a spring of m_eff w^2. Between two boxes m_eff is
// m/2 and w = 2 pi 30 Hz; on the ground m and twice the hertz. So it sinks by g/w^2 (2 (1 + ... + 9) + 10/4) = 25.5 mm
// when impulses are carried on. Beginning each step from none, it cannot bear as much.
static void contacts_begin_cold_where_warm_starting_is_off(void **state)
{
    (void)state;
    const double w = 2 * 3.14159265358979 * 30, sinks = 9.81 / (w * w) * (2 * 45 + 2.5);
    double depth[2];
    for (int32_t on = 0; on < 2; ++on) {
        fe_world *world = world_with(0, 1, on);
        new_ground(world);
        fe_body last = 0;
        for (int i = 0; i < 10; ++i) last = new_box(world, 0, 0.5 + i, 0);
        step(world, 120);
        fe_transform t;
        OK(fe_body_get_transform(world, last, &t));
        depth[on] = 9.5 - t.position.y;
        OK(fe_world_destroy(world));
    }
    assert_true(fabs(depth[1] - sinks) < 0.02 * sinks);
    assert_true(depth[0] > 1.1 * sinks);
}

static void settings_of_a_world_are_read(void **state)
{
    (void)state;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.number = 4095, def.user_data = UINT64_MAX;
    fe_world *world, *other = new_world(), *next = new_world();
    OK(fe_world_create(&def, &world));
    uint32_t number, a, b;
    uint64_t data;
    OK(fe_world_get_number(world, &number));
    OK(fe_world_get_number(other, &a));
    OK(fe_world_get_number(next, &b));
    assert_true(number == 4095 && a >= 1 && a <= 4095 && b >= 1 && b <= 4095 && a != b);
    OK(fe_world_get_user_data(world, &data));
    FE_TRUE(data == UINT64_MAX);
    OK(fe_world_set_user_data(world, UINT64_C(0x8000000000000001)));
    OK(fe_world_get_user_data(world, &data));
    FE_TRUE(data == UINT64_C(0x8000000000000001));
    fe_body body = new_box(world, 0, 0, 0);
    assert_int_equal(fe_body_is_valid(other, body), 0);
    REFUSES(other, FE_ERROR_STALE, fe_body_destroy(other, body));
    SAYS("of world 4095");
    def.number = 4096;
    fe_world *none = NULL;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_create(&def, &none));
    SAYS("number is 4096, must be 0..4095");
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_number(world, NULL));
    OK(fe_world_destroy(world));
    OK(fe_world_destroy(other));
    OK(fe_world_destroy(next));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy_of_a_free_flight_stays),
        cmocka_unit_test(momentum_is_that_of_mechanics),
        cmocka_unit_test(bounds_hold_the_shapes),
        cmocka_unit_test(hertz_in_use_are_limited_by_the_substeps),
        cmocka_unit_test(overlaps_tell_the_way_out),
        cmocka_unit_test(bounds_are_asked_for_shapes),
        cmocka_unit_test(a_trigger_tells_who_is_inside),
        cmocka_unit_test(nobody_sleeps_where_sleep_is_off),
        cmocka_unit_test(fast_bodies_pass_where_continuous_collision_is_off),
        cmocka_unit_test(contacts_begin_cold_where_warm_starting_is_off),
        cmocka_unit_test(settings_of_a_world_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
