// Joints whose one end is the world, and what a game changes of a joint each step.
#include "api_test.h"

static fe_joint hang(fe_world *world, fe_body body, fe_body other, double x, double y)
{
    fe_ball_joint_def def;
    fe_ball_joint_def_init(&def, sizeof def);
    OK(fe_ball_joint_def_at(world, &def, other, body, &(fe_dvec3){x, y, 0}, &(fe_vec3){0, 1, 0}));
    fe_joint joint;
    OK(fe_ball_joint_create(world, &def, &joint));
    return joint;
}

static fe_dvec3 place(const fe_world *world, fe_body body)
{
    fe_transform t;
    OK(fe_body_get_transform(world, body, &t));
    return t.position;
}

// A pendulum on the world swings bit for bit as one on a static body at the same point.
static void the_world_holds_as_a_static_body_does(void **state)
{
    (void)state;
    fe_world *a = new_world(), *b = new_world();
    fe_body bob_a = new_box(a, 2, 0, 0), post = new_body(b, FE_BODY_STATIC, 0, 3, 0), bob_b = new_box(b, 2, 0, 0);
    hang(a, bob_a, 0, 0, 3), hang(b, bob_b, post, 0, 3);
    for (int i = 0; i < 200; ++i) {
        step(a, 1), step(b, 1);
        fe_dvec3 p = place(a, bob_a), q = place(b, bob_b);
        assert_memory_equal(&p, &q, sizeof p);
    }
    OK(fe_world_destroy(a));
    OK(fe_world_destroy(b));
}

// 1e7 m from the origin a float frame would miss by half a metre: the world's frame is double
static void the_worlds_frame_is_double(void **state)
{
    (void)state;
    fe_world *world = new_world();
    const double far = 1e7 + 0.3;
    fe_body bob = new_box(world, far, -2, 0);
    fe_joint joint = hang(world, bob, 0, far, 0);
    step(world, 60);
    fe_transform frame_a, frame_b;
    OK(fe_joint_get_frames(world, joint, &frame_a, &frame_b));
    assert_true(frame_a.position.x == far && fabs(frame_b.position.x - far) < 1e-4 && fabs(frame_b.position.y) < 1e-3);
    OK(fe_world_destroy(world));
}

// No body, no handle, no serial: counts, lists, hashes of later bodies and handles are as without it
static void the_world_is_no_body(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body bob = new_box(world, 0, 0, 0);
    fe_joint joint = hang(world, bob, 0, 0, 3);
    fe_body ends[2] = {7, 7}, listed[4];
    OK(fe_joint_get_bodies(world, joint, &ends[0], &ends[1]));
    FE_TRUE(ends[0] == 0 && ends[1] == bob);
    fe_ball_joint_def def;
    fe_ball_joint_def_init(&def, sizeof def);
    OK(fe_ball_joint_get(world, joint, &def));
    FE_TRUE(def.body_a == 0 && def.world_origin.y == 3.0);
    assert_int_equal(fe_world_get_bodies(world, listed, 4), 1);
    for (fe_handle low = 0; low < 8; ++low) { // no made-up handle finds it
        fe_body made_up = (bob & ~(fe_handle)0x1fffff) | low;
        if (made_up != bob) assert_int_equal(fe_body_is_valid(world, made_up), 0);
    }
    def.world_origin.y = 4.0;
    OK(fe_ball_joint_set(world, joint, &def));
    step(world, 120);
    fe_transform frame_a, frame_b;
    OK(fe_joint_get_frames(world, joint, &frame_a, &frame_b));
    assert_true(frame_a.position.y == 4.0 && fabs(frame_b.position.y - 4.0) < 0.01);
    for (int i = 0; i < 1000; ++i) { // its slot goes back
        OK(fe_joint_destroy(world, joint));
        joint = hang(world, bob, 0, 0, 3);
    }
    fe_counters counters;
    fe_counters_init(&counters, sizeof counters);
    OK(fe_world_get_counters(world, &counters));
    assert_true(counters.bodies == 1 && counters.joints == 1);
    OK(fe_body_destroy(world, bob));
    assert_int_equal(fe_joint_is_valid(world, joint), 0);
    fe_ball_joint_def_init(&def, sizeof def);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_ball_joint_create(world, &def, &joint));
    REFUSES(world, FE_ERROR_ARGUMENT,
            fe_ball_joint_def_at(world, &def, 0, 0, &(fe_dvec3){0, 0, 0}, &(fe_vec3){1, 0, 0}));
    OK(fe_world_destroy(world));
}

static void a_break_tells_of_the_world(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body bob = new_box(world, 0, 0, 0);
    fe_joint joint = hang(world, bob, 0, 0, 3);
    fe_joint_def def;
    fe_joint_def_init(&def, sizeof def);
    OK(fe_joint_get(world, joint, &def));
    def.break_force = 1;
    OK(fe_joint_set(world, joint, &def));
    fe_joint_event event;
    int32_t count = 0;
    for (int i = 0; i < 60 && !count; ++i) {
        step(world, 1);
        count = fe_world_get_joint_events(world, &event, sizeof event, 1);
    }
    FE_TRUE(count == 1 && event.joint == joint && event.body_a == 0 && event.body_b == bob &&
            event.kind == FE_EVENT_BREAK);
    OK(fe_world_destroy(world));
}

// ---- what changes each step ----------------------------------------------------------------------------------------

static void speed_and_target_change_alone(void **state)
{
    (void)state;
    fe_world *world = new_world();
    OK(fe_world_set_gravity(world, &(fe_vec3){0, 0, 0}));
    fe_body a = new_body(world, FE_BODY_STATIC, 0, 0, 0), b = new_box(world, 0, 0, 0);
    fe_hinge_joint_def hinge;
    fe_hinge_joint_def_init(&hinge, sizeof hinge);
    OK(fe_hinge_joint_def_at(world, &hinge, a, b, &(fe_dvec3){0, 0, 0}, &(fe_vec3){0, 0, 1}));
    hinge.motor_max = 1e6f;
    fe_joint joint;
    OK(fe_hinge_joint_create(world, &hinge, &joint));
    OK(fe_joint_set_motor_speed(world, joint, FE_DOF_ANGULAR_X, 3));
    step(world, 30);
    fe_vec3 w;
    OK(fe_body_get_angular_velocity(world, b, &w));
    assert_true(fabsf(w.z - 3.0f) < 0.01f);
    OK(fe_hinge_joint_get(world, joint, &hinge));
    assert_true(hinge.motor_speed == 3 && hinge.motor_max == 1e6f && hinge.target == 0);
    hinge.motor_max = 0, hinge.spring_hertz = 5;
    OK(fe_hinge_joint_set(world, joint, &hinge));
    OK(fe_joint_set_target(world, joint, FE_DOF_ANGULAR_X, 1));
    step(world, 240);
    fe_joint_state now;
    fe_joint_state_init(&now, sizeof now);
    OK(fe_joint_get_state(world, joint, &now));
    assert_true(fabsf(now.angle - 1.0f) < 0.01f);
    REFUSES(world, FE_ERROR_STATE, fe_joint_set_motor_speed(world, joint, FE_DOF_LINEAR_X, 1));
    REFUSES(world, FE_ERROR_STATE, fe_joint_set_target(world, joint, FE_DOF_ANGULAR_Y, 1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_joint_set_target(world, joint, FE_DOF_ANGULAR_X, 4)); // beyond pi
    REFUSES(world, FE_ERROR_ARGUMENT, fe_joint_set_target(world, joint, 6, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_joint_set_motor_speed(world, joint, -1, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_joint_set_motor_speed(world, joint, FE_DOF_ANGULAR_X, NOT_A_NUMBER));
    REFUSES(world, FE_ERROR_STATE, fe_ball_joint_set_target(world, joint, &(fe_quat){0, 0, 0, 1}));
    REFUSES(world, FE_ERROR_STALE, fe_joint_set_target(world, 0, FE_DOF_ANGULAR_X, 0));
    OK(fe_world_destroy(world));
}

static void a_balls_target_is_a_rotation(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body b = new_box(world, 0, 0, 0);
    fe_ball_joint_def def;
    fe_ball_joint_def_init(&def, sizeof def);
    OK(fe_ball_joint_def_at(world, &def, 0, b, &(fe_dvec3){0, 0, 0}, &(fe_vec3){1, 0, 0}));
    def.spring_hertz = 5;
    fe_joint joint;
    OK(fe_ball_joint_create(world, &def, &joint));
    OK(fe_ball_joint_set_target(world, joint, &(fe_quat){0.5f, 0, 0, 0.8660254f})); // 60 degrees about X
    step(world, 240);
    fe_joint_state now;
    fe_joint_state_init(&now, sizeof now);
    OK(fe_joint_get_state(world, joint, &now));
    assert_true(fabsf(now.angle - 1.0471976f) < 0.01f);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_ball_joint_set_target(world, joint, NULL));
    REFUSES(world, FE_ERROR_STATE, fe_joint_set_target(world, joint, FE_DOF_ANGULAR_X, 0));
    OK(fe_world_destroy(world));
}

// A rope without limits is no rope; with them it is one again
static void a_range_can_be_switched_off(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body b = new_box(world, 0, 0, 0);
    fe_distance_joint_def def;
    fe_distance_joint_def_init(&def, sizeof def);
    OK(fe_rope_joint_def_at(world, &def, 0, b, &(fe_dvec3){0, 1, 0}, &(fe_dvec3){0, 0, 0}, 2));
    def.limit_enabled = 0;
    fe_joint joint;
    OK(fe_distance_joint_create(world, &def, &joint));
    step(world, 120);
    assert_true(place(world, b).y < -15.0);
    OK(fe_body_set_transform(world, b, &(fe_transform){{0, 0, 0}, {0, 0, 0, 1}}));
    OK(fe_body_set_linear_velocity(world, b, &(fe_vec3){0, 0, 0}));
    def.limit_enabled = 1;
    OK(fe_distance_joint_set(world, joint, &def));
    step(world, 240);
    assert_true(fabs(place(world, b).y + 1.0) < 0.01);
    OK(fe_world_destroy(world));
}

// A hinge's bob, 1 kg at 1 m, let go level: m r = 1 kg m against I = 1 + 0.4 kg m2. It pulls with 2 m g / 1.4 from its
// swing and m g of its own, at the lowest, so with less than 3 m g ever, and about the hinge's locked axes with
// nothing, however short the step: a shorter one than 1e-5 s leaves the reaction as it was. Over 1e-5 s a float's
// rounding of the momentum of less than 4 N m s, a half of 2^-22, makes 0.05 N m.
static void a_reaction_stays_finite_in_the_shortest_step(void **state)
{
    (void)state;
    static const float steps[] = {1e-2f, 1e-3f, 1e-4f, 1.01e-5f, 1e-5f, 9e-6f, 1e-7f, 1e-10f, 1e-20f, 1e-40f, 1e-45f};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; ++i) {
        fe_world *world = new_world_of(1), *other = new_world_of(1);
        fe_vec3 before[2], after[2];
        for (int k = 0; k < 2; ++k) {
            fe_world *w = k ? other : world;
            fe_body bob = new_body(w, FE_BODY_DYNAMIC, 1, 0, 0);
            fe_hinge_joint_def def;
            fe_hinge_joint_def_init(&def, sizeof def);
            OK(fe_hinge_joint_def_at(w, &def, 0, bob, &(fe_dvec3){0, 0, 0}, &(fe_vec3){0, 0, 1}));
            def.break_force = def.break_torque = 1000.0f;
            fe_joint joint;
            OK(fe_hinge_joint_create(w, &def, &joint));
            step(w, 30);
            OK(fe_joint_get_reaction(w, joint, &before[0], &before[1]));
            OK(fe_world_step(w, k ? 0.0f : steps[i]));
            OK(fe_joint_get_reaction(w, joint, &after[0], &after[1]));
            const float *f = &after[0].x, *t = &after[1].x;
            FE_TRUE(f[0] * f[0] + f[1] * f[1] + f[2] * f[2] < 9.0f * 9.81f * 9.81f);
            FE_WITHIN(t[0], -0.05, 0.05);
            FE_WITHIN(t[1], -0.05, 0.05);
        }
        if (steps[i] < 1e-5f) {
            assert_memory_equal(before, after, sizeof before);
            assert_true(hash_of(world) == hash_of(other));
        } else {
            assert_true(hash_of(world) != hash_of(other));
        }
        OK(fe_world_destroy(world));
        OK(fe_world_destroy(other));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_world_holds_as_a_static_body_does),
        cmocka_unit_test(the_worlds_frame_is_double),
        cmocka_unit_test(the_world_is_no_body),
        cmocka_unit_test(a_break_tells_of_the_world),
        cmocka_unit_test(speed_and_target_change_alone),
        cmocka_unit_test(a_balls_target_is_a_rotation),
        cmocka_unit_test(a_range_can_be_switched_off),
        cmocka_unit_test(a_reaction_stays_finite_in_the_shortest_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
