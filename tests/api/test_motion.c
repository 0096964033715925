// Velocities, forces, impulses, targets and locks as set between steps.
#include "api/api_test.h"

static fe_vec3 velocity(const fe_world *world, fe_body body) { return body_linear_velocity(world, body); }
static fe_vec3 spin(const fe_world *world, fe_body body) { return body_angular_velocity(world, body); }

static fe_world *weightless_world(void)
{
    fe_world *world = new_world();
    fe_vec3 none = {0, 0, 0};
    OK(fe_world_set_gravity(world, &none));
    return world;
}

// An impulse J on a mass m changes the velocity by J / m, a cube's angular velocity by L / (m a^2 / 6).
static void impulses_act_at_once(void **state)
{
    (void)state;
    fe_world *world = weightless_world();
    fe_body box = new_box(world, 0, 0, 0); // 1 m, 1000 kg
    fe_vec3 impulse = {500, -1000, 250};
    OK(fe_body_add_impulse(world, box, &impulse));
    FE_NEAR(velocity(world, box).x, 0.5, 1e-7);
    FE_NEAR(velocity(world, box).y, -1.0, 1e-7);
    FE_NEAR(velocity(world, box).z, 0.25, 1e-7);
    OK(fe_body_add_angular_impulse(world, box, &impulse));
    FE_NEAR(spin(world, box).x, 500 / (1000 / 6.0), 1e-5);
    FE_NEAR(spin(world, box).y, -1000 / (1000 / 6.0), 1e-5);
    OK(fe_world_destroy(world));
}

// J at r from the centre turns by r x J: (0.5, 0, 0) x (0, 60, 0) = (0, 0, 30)
static void an_impulse_at_a_point_turns_too(void **state)
{
    (void)state;
    fe_world *world = weightless_world();
    fe_body box = new_box(world, 1e6, -3, 0);
    fe_vec3 up = {0, 60, 0};
    fe_dvec3 edge = {1e6 + 0.5, -3, 0};
    OK(fe_body_add_impulse_at(world, box, &up, &edge));
    FE_NEAR(velocity(world, box).y, 0.06, 1e-8);
    FE_NEAR(spin(world, box).z, 30 / (1000 / 6.0), 1e-6);
    FE_NEAR(spin(world, box).x, 0, 0);
    // the point's velocity is v + w x r = 0.06 + 0.18 * 0.5
    fe_vec3 at_edge;
    OK(fe_body_get_point_velocity(world, box, &edge, &at_edge));
    FE_NEAR(at_edge.y, 0.06 + 0.18 * 0.5, 1e-6);
    OK(fe_world_destroy(world));
}

// F during one step of dt changes the velocity by F dt / m (within the rounding of 8 substeps), and is gone afterwards.
static void a_force_acts_for_one_step(void **state)
{
    (void)state;
    fe_world *world = weightless_world();
    fe_body pushed = new_box(world, 0, 0, 0), turned = new_box(world, 10, 0, 0), at = new_box(world, 20, 0, 0);
    fe_vec3 force = {6000, 0, 0}, torque = {0, 1000, 0};
    fe_dvec3 point = {20, 0.5, 0};
    OK(fe_body_add_force(world, pushed, &force));
    OK(fe_body_add_force(world, pushed, &force)); // they add up
    OK(fe_body_add_torque(world, turned, &torque));
    OK(fe_body_add_force_at(world, at, &force, &point));
    step(world, 1);
    FE_NEAR(velocity(world, pushed).x, 12.0 / 60, 1e-6);
    FE_NEAR(spin(world, turned).y, 1000 / (1000 / 6.0) / 60, 1e-6);
    FE_NEAR(velocity(world, at).x, 6.0 / 60, 1e-6);
    FE_NEAR(spin(world, at).z, -3000 / (1000 / 6.0) / 60,
            1e-3); // (0, 0.5, 0) x (6000, 0, 0); the arm turns a little meanwhile
    step(world, 1);
    FE_NEAR(velocity(world, pushed).x, 12.0 / 60, 1e-6);
    OK(fe_world_destroy(world));
}

static void forces_do_nothing_on_what_is_not_dynamic(void **state)
{
    (void)state;
    fe_world *world = weightless_world();
    fe_body wall = new_body(world, FE_BODY_STATIC, 0, 0, 0), lift = new_body(world, FE_BODY_KINEMATIC, 5, 0, 0);
    fe_vec3 push = {10, 10, 10};
    fe_dvec3 point = {0, 0, 0};
    uint64_t before = hash_of(world);
    for (int i = 0; i < 2; ++i) {
        fe_body body = i ? lift : wall;
        OK(fe_body_add_force(world, body, &push));
        OK(fe_body_add_force_at(world, body, &push, &point));
        OK(fe_body_add_torque(world, body, &push));
        OK(fe_body_add_impulse(world, body, &push));
        OK(fe_body_add_impulse_at(world, body, &push, &point));
        OK(fe_body_add_angular_impulse(world, body, &push));
    }
    FE_TRUE(hash_of(world) == before);
    OK(fe_world_destroy(world));
}

static void a_static_body_has_no_velocity(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body wall = new_ground(world);
    fe_vec3 v = {1, 0, 0};
    REFUSES(world, FE_ERROR_STATE, fe_body_set_linear_velocity(world, wall, &v));
    REFUSES(world, FE_ERROR_STATE, fe_body_set_angular_velocity(world, wall, &v));
    FE_NEAR(velocity(world, wall).x, 0, 0);
    OK(fe_world_destroy(world));
}

static void bad_motion_is_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body box = new_box(world, 0, 10, 0), stale = box + NEXT_GENERATION;
    fe_shape shape;
    assert_int_equal(fe_body_get_shapes(world, box, &shape, 1), 1);
    fe_vec3 good = {1, 2, 3}, nan = {0, NOT_A_NUMBER, 0}, endless = {0, 0, -INFINITE}, huge = {1e30f, 0, 0};
    fe_dvec3 point = {0, 0, 0}, nowhere = {(double)NOT_A_NUMBER, 0, 0};
#define REFUSES_VECTORS(function)                                      \
    REFUSES(world, FE_ERROR_ARGUMENT, function(world, box, &nan));     \
    REFUSES(world, FE_ERROR_ARGUMENT, function(world, box, &endless)); \
    REFUSES(world, FE_ERROR_ARGUMENT, function(world, box, &huge));    \
    REFUSES(world, FE_ERROR_ARGUMENT, function(world, box, NULL));     \
    REFUSES(world, FE_ERROR_STALE, function(world, stale, &good));     \
    REFUSES(world, FE_ERROR_KIND, function(world, shape, &good));      \
    REFUSES(NULL, FE_ERROR_ARGUMENT, function(NULL, box, &good))
    REFUSES_VECTORS(fe_body_set_linear_velocity);
    REFUSES_VECTORS(fe_body_set_angular_velocity);
    REFUSES_VECTORS(fe_body_add_force);
    REFUSES_VECTORS(fe_body_add_torque);
    REFUSES_VECTORS(fe_body_add_impulse);
    REFUSES_VECTORS(fe_body_add_angular_impulse);
#undef REFUSES_VECTORS
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_add_force_at(world, box, &good, &nowhere));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_add_force_at(world, box, &nan, &point));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_add_force_at(world, box, &good, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_add_impulse_at(world, box, &good, &nowhere));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_add_impulse_at(world, box, &endless, &point));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_add_impulse_at(world, box, NULL, &point));
    fe_vec3 out = {7, 7, 7};
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_point_velocity(world, box, &nowhere, &out));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_point_velocity(world, box, &point, NULL));
    REFUSES(world, FE_ERROR_STALE, fe_body_get_linear_velocity(world, stale, &out));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_linear_velocity(world, box, NULL));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_angular_velocity(world, box, NULL));
    FE_NEAR(out.x + out.y + out.z, 21, 0);
    // an impulse that a float could bear, but not the velocity it makes
    fe_vec3 blow = {1e15f, 0, 0};
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_add_impulse(world, box, &blow));
    OK(fe_world_destroy(world));
}

static void no_number_of_forces_makes_an_infinity(void **state)
{
    (void)state;
    fe_world *world = weightless_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    OK(fe_body_set_mass(world, body, 1e-9f));
    fe_vec3 push = {1e15f, 1e15f, -1e15f};
    for (int i = 0; i < 100; ++i) {
        OK(fe_body_add_force(world, body, &push));
        OK(fe_body_add_torque(world, body, &push));
    }
    step(world, 3);
    fe_transform t = body_transform(world, body);
    FE_WITHIN(t.position.x, -1e9, 1e9);
    FE_WITHIN(t.rotation.w, -1, 1);
    FE_WITHIN(velocity(world, body).x, -4001, 4001);
    OK(fe_world_destroy(world));
}

// ---- locks ---------------------------------------------------------------------------------------------------------

static void what_is_locked_stays_zero(void **state)
{
    (void)state;
    fe_world *world = weightless_world();
    fe_body box = new_box(world, 0, 0, 0);
    fe_vec3 v = {1, -2, 3};
    OK(fe_body_set_linear_velocity(world, box, &v));
    OK(fe_body_set_angular_velocity(world, box, &v));
    OK(fe_body_set_locks(world, box, FE_AXIS_Y, FE_AXIS_X | FE_AXIS_Z));
    uint32_t linear = 9, angular = 9;
    OK(fe_body_get_locks(world, box, &linear, &angular));
    assert_true(linear == FE_AXIS_Y && angular == (FE_AXIS_X | FE_AXIS_Z));
    FE_TRUE(velocity(world, box).y == 0 && !signbit(velocity(world, box).y));
    FE_TRUE(spin(world, box).x == 0 && spin(world, box).z == 0);
    FE_NEAR(velocity(world, box).x, 1, 0);
    FE_NEAR(spin(world, box).y, -2, 0);
    OK(fe_body_set_linear_velocity(world, box, &v));
    OK(fe_body_add_impulse(world, box, &v));
    OK(fe_body_add_force(world, box, &v));
    FE_NEAR(velocity(world, box).y, 0, 0);
    step(world, 5);
    FE_NEAR(body_transform(world, box).position.y, 0, 0);
    OK(fe_world_destroy(world));
}

// About its free axis a locked body has its own inertia there, not the inverse of the whole tensor's inverse: a long
// box turned by 45 degrees about z, free about x only, has Ixx = (I1 + I2) / 2.
static void a_locked_body_turns_like_one_on_an_axle(void **state)
{
    (void)state;
    fe_world *world = weightless_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_geometry plank;
    fe_geometry_box(&plank, 2, 0.25f, 0.5f); // 4 x 0.5 x 1 m, 2000 kg
    add_shape(world, body, &plank);
    fe_transform t = fe_make_transform(0, 0, 0);
    t.rotation.z = t.rotation.w = 1;
    t.rotation.z = 0.41421356f; // tan(22.5 degrees): the quaternion of 45 degrees, not normalised
    OK(fe_body_set_transform(world, body, &t));
    OK(fe_body_set_locks(world, body, 0, FE_AXIS_Y | FE_AXIS_Z));
    fe_vec3 impulse = {1000, 500, -300};
    OK(fe_body_add_angular_impulse(world, body, &impulse));
    double i1 = 2000 / 3.0 * (0.25 * 0.25 + 0.5 * 0.5), i2 = 2000 / 3.0 * (2 * 2 + 0.5 * 0.5), axle = (i1 + i2) / 2;
    FE_NEAR(spin(world, body).x, 1000 / axle, 1e-6);
    FE_NEAR(spin(world, body).y, 0, 0);
    // free again, the products of inertia couple the axes: w = I^-1 L
    fe_vec3 zero = {0, 0, 0};
    OK(fe_body_set_locks(world, body, 0, 0));
    OK(fe_body_set_angular_velocity(world, body, &zero));
    OK(fe_body_add_angular_impulse(world, body, &impulse));
    double a = (1000 + 500) / sqrt(2), b = (-1000 + 500) / sqrt(2); // L along the plank and across
    double wa = a / i1, wb = b / i2;
    FE_NEAR(spin(world, body).x, (wa - wb) / sqrt(2), 1e-5);
    FE_NEAR(spin(world, body).y, (wa + wb) / sqrt(2), 1e-5);
    OK(fe_world_destroy(world));
}

// ---- kinematic -----------------------------------------------------------------------------------------------------

static void a_kinematic_body_reaches_its_target(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body lift = new_body(world, FE_BODY_KINEMATIC, 1, 2, 3);
    fe_geometry geometry;
    fe_geometry_box(&geometry, 1, 0.1f, 1);
    fe_shape shape = add_shape(world, lift, &geometry);
    fe_frame aside = {{0.7f, 0, 0}, {0, 0, 0, 1}}; // it rotates about its origin, wherever its shapes are
    OK(fe_shape_set_frame(world, shape, &aside));
    fe_transform target = fe_make_transform(1.5, 2.25, 2);
    target.rotation = (fe_quat){0, 0.38268343f, 0, 0.92387953f}; // 45 degrees about y
    OK(fe_body_set_target(world, lift, &target, 0.5f));
    FE_NEAR(velocity(world, lift).x, 1, 1e-6);
    FE_NEAR(spin(world, lift).y, 3.14159265 / 4 / 0.5, 1e-6);
    step(world, 30);
    fe_transform now = body_transform(world, lift);
    // each substep may round the velocity's path by half a unit of a float: 240 * 1e-7
    FE_NEAR(now.position.x, 1.5, 3e-5), FE_NEAR(now.position.y, 2.25, 3e-5), FE_NEAR(now.position.z, 2, 3e-5);
    // first order turns lag by (w h)^3 / 12 a substep, w h = 3.3e-3: 240 * 3e-9
    FE_NEAR(now.rotation.y, 0.38268343, 3e-5);
    // -q is the same rotation: no turn at all
    target.rotation = (fe_quat){-now.rotation.x, -now.rotation.y, -now.rotation.z, -now.rotation.w};
    OK(fe_body_set_target(world, lift, &target, 0.5f));
    FE_NEAR(spin(world, lift).y, 0, 1e-6);
    OK(fe_world_destroy(world));
}

static void only_kinematic_bodies_have_targets(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body lift = new_body(world, FE_BODY_KINEMATIC, 0, 0, 0), box = new_box(world, 5, 0, 0),
            ground = new_ground(world);
    fe_transform target = fe_make_transform(1, 0, 0), bad = fe_make_transform((double)NOT_A_NUMBER, 0, 0),
                 far = fe_make_transform(1e9, 0, 0);
    REFUSES(world, FE_ERROR_STATE, fe_body_set_target(world, box, &target, 1));
    REFUSES(world, FE_ERROR_STATE, fe_body_set_target(world, ground, &target, 1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_target(world, lift, &target, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_target(world, lift, &target, -1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_target(world, lift, &target, NOT_A_NUMBER));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_target(world, lift, &bad, 1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_target(world, lift, NULL, 1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_target(world, lift, &far, 0.001f)); // a speed of 1e12 m/s
    SAYS("needed_velocity.x");
    OK(fe_world_destroy(world));
}

// A platform at rest sleeps, and so does what stands on it; moving the platform moves both.
static void a_moving_platform_wakes_what_stands_on_it(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body lift = new_body(world, FE_BODY_KINEMATIC, 0, 0, 0), box = new_box(world, 0, 1, 0);
    fe_geometry geometry;
    fe_geometry_box(&geometry, 2, 0.5f, 2);
    add_shape(world, lift, &geometry);
    step(world, 120);
    assert_int_equal(is_awake(world, box), 0);
    fe_vec3 up = {0, 1, 0};
    OK(fe_body_set_linear_velocity(world, lift, &up));
    assert_int_equal(is_awake(world, lift), 1);
    assert_int_equal(is_awake(world, box), 1);
    step(world, 60);
    FE_NEAR(body_transform(world, lift).position.y, 1, 1e-4);
    FE_NEAR(body_transform(world, box).position.y, 2, 0.02);
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(impulses_act_at_once),
        cmocka_unit_test(an_impulse_at_a_point_turns_too),
        cmocka_unit_test(a_force_acts_for_one_step),
        cmocka_unit_test(forces_do_nothing_on_what_is_not_dynamic),
        cmocka_unit_test(a_static_body_has_no_velocity),
        cmocka_unit_test(bad_motion_is_refused),
        cmocka_unit_test(no_number_of_forces_makes_an_infinity),
        cmocka_unit_test(what_is_locked_stays_zero),
        cmocka_unit_test(a_locked_body_turns_like_one_on_an_axle),
        cmocka_unit_test(a_kinematic_body_reaches_its_target),
        cmocka_unit_test(only_kinematic_bodies_have_targets),
        cmocka_unit_test(a_moving_platform_wakes_what_stands_on_it),
    };
    return cmocka_run_group_tests_name("motion", tests, NULL, NULL);
}
