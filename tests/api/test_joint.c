// The API of joints: life, definitions of every type, what is read back; each documented error.
#include "api/api_test.h"
#include "support/any_joint.h"

#define ANY_PI 3.14159274f // the float next to pi

static void init(int32_t kind, any_def *d)
{
    memset(d, 0xAB, sizeof *d);
    any_init(kind, d);
}

// the names of the calls, so that their sentences can be checked
static const char *const create_names[ANY_KINDS] = {"fe_distance_joint_create(", "fe_ball_joint_create(",
                                                    "fe_hinge_joint_create(", "fe_fixed_joint_create(",
                                                    "fe_configurable_joint_create("};
static const char *const set_names[ANY_KINDS] = {"fe_distance_joint_set(", "fe_ball_joint_set(", "fe_hinge_joint_set(",
                                                 "fe_fixed_joint_set(", "fe_configurable_joint_set("};
static const char *const get_names[ANY_KINDS] = {"fe_distance_joint_get(", "fe_ball_joint_get(", "fe_hinge_joint_get(",
                                                 "fe_fixed_joint_get(", "fe_configurable_joint_get("};

#define REFUSES_AS(world, expected, call, name)                             \
    do {                                                                    \
        uint64_t before_call = hash_of(world);                              \
        check_refusal((int32_t)(call), expected, name, __FILE__, __LINE__); \
        FE_TRUE(hash_of(world) == before_call);                             \
    } while (0)

// Two balls without a ground, 1 m apart, and a joint of the kind between them
typedef struct fixture {
    fe_world *world;
    fe_body a, b;
    fe_joint joint;
} fixture;

static fixture begin(int kind)
{
    fixture f = {new_world(), 0, 0, 0};
    f.a = new_box(f.world, 0, 0, 0);
    f.b = new_box(f.world, 2, 0, 0);
    if (kind < 0) return f;
    any_def def;
    init(kind, &def);
    def.common.body_a = f.a, def.common.body_b = f.b;
    def.common.frame_a.position = fe_make_vec3(1, 0, 0), def.common.frame_b.position = fe_make_vec3(-1, 0, 0);
    if (kind == 0) def.distance.lower = 0;
    OK(any_create(kind, f.world, &def, &f.joint));
    assert_true(f.joint != 0 && f.joint < 1ull << 53);
    return f;
}

static void end(fixture *f) { OK(fe_world_destroy(f->world)); }

// ---- definitions ---------------------------------------------------------------------------------------------------

static void defaults_are_those_of_the_header(void **state)
{
    (void)state;
    any_def d;
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        init(kind, &d);
        assert_int_equal(d.common.struct_size, any_sizes[kind]);
        assert_true(d.common.enabled == 1 && d.common.collide_connected == 0 && d.common.body_a == 0 &&
                    d.common.body_b == 0);
        FE_NEAR(d.common.hertz, 0, 0), FE_NEAR(d.common.damping_ratio, 1, 0);
        FE_NEAR(d.common.break_force + d.common.break_torque, 0, 0);
        FE_NEAR(d.common.frame_a.rotation.w, 1, 0), FE_NEAR(d.common.frame_b.rotation.w, 1, 0);
        FE_NEAR(d.common.frame_a.position.x, 0, 0), FE_NEAR(d.common.frame_b.position.z, 0, 0);
    }
    init(0, &d);
    FE_NEAR(d.distance.lower, 1, 0), FE_NEAR(d.distance.upper, 1, 0), FE_NEAR(d.distance.target, 1, 0);
    FE_NEAR(d.distance.spring_hertz, 0, 0), FE_NEAR(d.distance.spring_damping_ratio, 1, 0),
        FE_NEAR(d.distance.spring_max, 1e15f, 0);
    FE_NEAR(d.distance.motor_max, 0, 0);
    init(1, &d);
    FE_NEAR(d.ball.cone_y, ANY_PI, 0), FE_NEAR(d.ball.cone_z, ANY_PI, 0), FE_NEAR(d.ball.lower, -ANY_PI, 0),
        FE_NEAR(d.ball.upper, ANY_PI, 0);
    assert_true(d.ball.cone_enabled == 0 && d.ball.limit_enabled == 0);
    FE_NEAR(d.ball.target.w, 1, 0), FE_NEAR(d.ball.spring_max, 1e15f, 0), FE_NEAR(d.ball.motor_max, 0, 0),
        FE_NEAR(d.ball.spring_hertz, 0, 0);
    FE_NEAR(d.ball.limit_damping_ratio, 1, 0), FE_NEAR(d.ball.spring_damping_ratio, 1, 0);
    init(2, &d);
    FE_NEAR(d.hinge.lower, -ANY_PI, 0), FE_NEAR(d.hinge.upper, ANY_PI, 0), FE_NEAR(d.hinge.spring_max, 1e15f, 0);
    FE_NEAR(d.hinge.spring_damping_ratio, 1, 0), FE_NEAR(d.hinge.limit_damping_ratio, 1, 0),
        FE_NEAR(d.hinge.motor_max, 0, 0);
    assert_int_equal(d.hinge.limit_enabled, 0);
    init(3, &d);
    FE_NEAR(d.fixed.angular_hertz, 0, 0), FE_NEAR(d.fixed.angular_damping_ratio, 1, 0);
    init(4, &d);
    for (int k = 0; k < 6; ++k) {
        assert_true(d.configurable.axes[k].motion == FE_MOTION_LOCKED &&
                    d.configurable.axes[k].spring == FE_SPRING_NONE);
        FE_NEAR(d.configurable.axes[k].limit_damping_ratio, 1, 0), FE_NEAR(d.configurable.axes[k].spring_max, 1e15f, 0);
    }
    fe_hinge_joint_def_init(NULL, sizeof(fe_hinge_joint_def)); // does nothing
}

// Fills all but the front with different legal values
static void make_unlike_defaults(int kind, any_def *d)
{
    d->common.enabled = 0, d->common.collide_connected = 1;
    d->common.hertz = 20, d->common.damping_ratio = 0.5f, d->common.break_force = 100, d->common.break_torque = 200;
    d->common.user_data = 0xFFFFFFFFFFFFFFFFull;
    d->common.frame_a = (fe_frame){{1, 2, 3}, {0, 0.6f, 0, 0.8f}};
    d->common.frame_b = (fe_frame){{-1, -2, -3}, {0.6f, 0, 0, 0.8f}};
    switch (kind) {
    case 0:
        d->distance.lower = 0.5f, d->distance.upper = 2, d->distance.target = 1.5f, d->distance.spring_hertz = 3;
        d->distance.spring_damping_ratio = 0.25f, d->distance.spring_max = 7, d->distance.motor_speed = -1,
        d->distance.motor_max = 9;
        break;
    case 1:
        d->ball.cone_enabled = 1, d->ball.cone_y = 0.5f, d->ball.cone_z = 0.25f, d->ball.limit_enabled = 1,
        d->ball.lower = -1;
        d->ball.upper = 2, d->ball.limit_hertz = 11, d->ball.limit_damping_ratio = 0.125f, d->ball.spring_hertz = 2;
        d->ball.spring_damping_ratio = 0.7f, d->ball.spring_max = 5, d->ball.target = (fe_quat){0, 0, 0.6f, 0.8f};
        d->ball.motor_velocity = fe_make_vec3(1, 2, 3), d->ball.motor_max = 4;
        break;
    case 2:
        d->hinge.limit_enabled = 1, d->hinge.lower = -0.5f, d->hinge.upper = 0.75f, d->hinge.limit_hertz = 12;
        d->hinge.limit_damping_ratio = 0.3f, d->hinge.spring_hertz = 4, d->hinge.spring_damping_ratio = 0.9f,
        d->hinge.spring_max = 8;
        d->hinge.target = 0.25f, d->hinge.motor_speed = -3, d->hinge.motor_max = 6;
        break;
    case 3:
        d->fixed.angular_hertz = 5, d->fixed.angular_damping_ratio = 0.6f;
        break;
    default:
        for (int k = 0; k < 6; ++k) {
            float v = (float)(k + 1);
            d->configurable.axes[k] = (fe_joint_axis){.motion = FE_MOTION_LIMITED,
                                                      .lower = -0.1f * v,
                                                      .upper = 0.2f * v,
                                                      .limit_hertz = v,
                                                      .limit_damping_ratio = 0.1f * v,
                                                      .spring = FE_SPRING_STIFFNESS,
                                                      .spring_hertz = 5 * v,
                                                      .spring_damping_ratio = 0.3f * v,
                                                      .spring_stiffness = 10 * v,
                                                      .spring_damping = 2 * v,
                                                      .spring_max = 3 * v,
                                                      .target = 0.01f * v,
                                                      .motor_speed = -v,
                                                      .motor_max = 4 * v};
        }
        break;
    }
}

static void what_a_definition_says_is_read_back_and_can_be_changed(void **state)
{
    (void)state;
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        fixture f = begin(kind);
        any_def d, read;
        init(kind, &d);
        make_unlike_defaults(kind, &d);
        OK(any_set(kind, f.world, f.joint, &d)); // bodies 0: as they are
        d.common.body_a = f.a, d.common.body_b = f.b;
        memset(&read, 0, sizeof read);
        read.common.struct_size = any_sizes[kind];
        OK(any_get(kind, f.world, f.joint, &read));
        assert_memory_equal(&read, &d, any_sizes[kind]);
        fe_joint other;
        OK(any_create(kind, f.world, &d, &other)); // born with the same values
        OK(any_get(kind, f.world, other, &read));
        assert_memory_equal(&read, &d, any_sizes[kind]);
        OK(any_set(kind, f.world, other, &read));
        end(&f);
    }
}

static void an_older_clients_definition_keeps_what_it_does_not_know(void **state)
{
    (void)state;
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        fixture f = begin(kind);
        any_def full, part, read;
        init(kind, &full);
        make_unlike_defaults(kind, &full);
        OK(any_set(kind, f.world, f.joint, &full));
        part = full;
        part.common.struct_size = sizeof(fe_joint_def);
        part.common.break_force = 300;
        OK(any_set(kind, f.world, f.joint, &part));
        memset(&read, 0, sizeof read);
        read.common.struct_size = any_sizes[kind];
        OK(any_get(kind, f.world, f.joint, &read));
        FE_NEAR(read.common.break_force, 300, 0);
        assert_memory_equal((char *)&read + sizeof(fe_joint_def), (char *)&full + sizeof(fe_joint_def),
                            any_sizes[kind] - sizeof(fe_joint_def));
        memset(&read, 0x11, sizeof read);
        read.common.struct_size = 8;
        OK(any_get(kind, f.world, f.joint, &read)); // its front only
        assert_int_equal(((unsigned char *)&read)[8], 0x11);
        unsigned char longer[sizeof(any_def) + 16] = {0};
        memcpy(longer, &full, any_sizes[kind]);
        uint32_t size = any_sizes[kind] + 8;
        memcpy(longer, &size, sizeof size);
        OK(any_set(kind, f.world, f.joint, (const any_def *)(const void *)longer));
        longer[any_sizes[kind] + 3] = 1;
        REFUSES_AS(f.world, FE_ERROR_ARGUMENT, any_set(kind, f.world, f.joint, (const any_def *)(const void *)longer),
                   set_names[kind]);
        end(&f);
    }
}

static void bad_ends_are_refused(void **state)
{
    (void)state;
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        fixture f = begin(-1);
        any_def d;
        fe_joint joint = 7;
        fe_body gone = new_box(f.world, 9, 9, 9);
        fe_shape shape = add_box(f.world, f.a, 0.1f);
        OK(fe_body_destroy(f.world, gone));
        init(kind, &d);
        const struct {
            fe_body a, b;
            int32_t result;
        } cases[] = {{1, f.b, FE_ERROR_STALE},    {0, 0, FE_ERROR_ARGUMENT},   {f.a, f.a, FE_ERROR_ARGUMENT},
                     {gone, f.b, FE_ERROR_STALE}, {f.a, gone, FE_ERROR_STALE}, {shape, f.b, FE_ERROR_KIND},
                     {f.a, shape, FE_ERROR_KIND}};
        for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
            d.common.body_a = cases[i].a, d.common.body_b = cases[i].b;
            joint = 7;
            REFUSES_AS(f.world, cases[i].result, any_create(kind, f.world, &d, &joint), create_names[kind]);
            assert_true(joint == 0);
        }
        d.common.body_a = f.a, d.common.body_b = f.b;
        REFUSES_AS(f.world, FE_ERROR_ARGUMENT, any_create(kind, f.world, &d, NULL), create_names[kind]);
        REFUSES_AS(f.world, FE_ERROR_ARGUMENT, any_create(kind, f.world, NULL, &joint), create_names[kind]);
        check_refusal(any_create(kind, NULL, &d, &joint), FE_ERROR_ARGUMENT, create_names[kind], __FILE__, __LINE__);
        d.common.struct_size = 0;
        REFUSES_AS(f.world, FE_ERROR_ARGUMENT, any_create(kind, f.world, &d, &joint), create_names[kind]);
        end(&f);
    }
}

// every number of a definition, by its place
typedef struct bad_value {
    size_t offset;
    float value;
} bad_value;

#define F(member) offsetof(any_def, member)

static void refuses_float(int kind, size_t offset, float value)
{
    fixture f = begin(kind);
    any_def d;
    fe_joint joint;
    init(kind, &d);
    d.common.body_a = f.a, d.common.body_b = f.b;
    memcpy((char *)&d + offset, &value, sizeof value);
    REFUSES_AS(f.world, FE_ERROR_ARGUMENT, any_create(kind, f.world, &d, &joint), create_names[kind]);
    REFUSES_AS(f.world, FE_ERROR_ARGUMENT, any_set(kind, f.world, f.joint, &d), set_names[kind]);
    end(&f);
}

static void refuses_int(int kind, size_t offset, int32_t value)
{
    float bits;
    memcpy(&bits, &value, sizeof bits);
    refuses_float(kind, offset, bits);
}

static void refuses_floats(int kind, const size_t *offsets, size_t count, float below)
{
    for (size_t i = 0; i < count; ++i) {
        refuses_float(kind, offsets[i], NOT_A_NUMBER);
        refuses_float(kind, offsets[i], INFINITE);
        if (below < 0) refuses_float(kind, offsets[i], below);
    }
}

#define COUNT(array) (sizeof(array) / sizeof *(array))

static void bad_values_of_the_front_are_refused(void **state)
{
    (void)state;
    static const size_t any[] = {F(common.frame_a.position.x), F(common.frame_a.position.z),
                                 F(common.frame_b.position.y), F(common.frame_a.rotation.w),
                                 F(common.frame_b.rotation.x)};
    static const size_t positive[] = {F(common.hertz), F(common.damping_ratio), F(common.break_force),
                                      F(common.break_torque)};
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        refuses_floats(kind, any, COUNT(any), 0);
        refuses_floats(kind, positive, COUNT(positive), -1);
        refuses_float(kind, F(common.frame_a.position.x), 2e6f);
        refuses_float(kind, F(common.frame_a.rotation.w), 0);
        refuses_int(kind, F(common.enabled), 2);
        refuses_int(kind, F(common.collide_connected), -1);
        refuses_int(kind, F(common.reserved), 1);
    }
}

static void bad_values_of_each_type_are_refused(void **state)
{
    (void)state;
    static const size_t distance[] = {F(distance.lower),
                                      F(distance.upper),
                                      F(distance.target),
                                      F(distance.spring_hertz),
                                      F(distance.spring_damping_ratio),
                                      F(distance.spring_max),
                                      F(distance.motor_max)};
    static const size_t ball[] = {
        F(ball.cone_y),       F(ball.cone_z),     F(ball.limit_hertz),          F(ball.limit_damping_ratio),
        F(ball.spring_hertz), F(ball.spring_max), F(ball.spring_damping_ratio), F(ball.motor_max)};
    static const size_t ball_any[] = {F(ball.lower), F(ball.upper), F(ball.target.w), F(ball.motor_velocity.x),
                                      F(ball.motor_velocity.z)};
    static const size_t hinge[] = {F(hinge.limit_hertz),          F(hinge.limit_damping_ratio), F(hinge.spring_hertz),
                                   F(hinge.spring_damping_ratio), F(hinge.spring_max),          F(hinge.motor_max)};
    static const size_t hinge_any[] = {F(hinge.lower), F(hinge.upper), F(hinge.target), F(hinge.motor_speed)};
    static const size_t fixed[] = {F(fixed.angular_hertz), F(fixed.angular_damping_ratio)};
#define A(member) offsetof(fe_joint_axis, member)
    static const size_t axis[] = {A(limit_hertz),      A(limit_damping_ratio), A(spring_hertz), A(spring_damping_ratio),
                                  A(spring_stiffness), A(spring_damping),      A(spring_max),   A(motor_max)};
    static const size_t axis_any[] = {A(lower), A(upper), A(target), A(motor_speed)};
    refuses_floats(0, distance, COUNT(distance), -1);
    refuses_float(0, F(distance.motor_speed), NOT_A_NUMBER);
    refuses_float(0, F(distance.lower), 1.5f); // above upper
    refuses_float(0, F(distance.upper), 0);
    refuses_floats(1, ball, COUNT(ball), -1);
    refuses_floats(1, ball_any, COUNT(ball_any), 0);
    refuses_float(1, F(ball.cone_y), 0.001f);
    refuses_float(1, F(ball.cone_z), 3.2f);
    refuses_float(1, F(ball.upper), 3.2f);
    refuses_float(1, F(ball.upper), -3.2f);
    refuses_float(1, F(ball.target.w), 0);
    refuses_int(1, F(ball.cone_enabled), 2);
    refuses_int(1, F(ball.limit_enabled), -1);
    refuses_floats(2, hinge, COUNT(hinge), -1);
    refuses_floats(2, hinge_any, COUNT(hinge_any), 0);
    refuses_float(2, F(hinge.lower), -3.2f);
    refuses_float(2, F(hinge.upper), 3.2f);
    refuses_float(2, F(hinge.target), 4);
    refuses_int(2, F(hinge.limit_enabled), 7);
    refuses_floats(3, fixed, COUNT(fixed), -1);
    for (size_t k = 0; k < 6; ++k) {
        size_t at = F(configurable.axes) + k * sizeof(fe_joint_axis);
        for (size_t i = 0; i < COUNT(axis); ++i) refuses_float(4, at + axis[i], -1);
        for (size_t i = 0; i < COUNT(axis); ++i) refuses_float(4, at + axis[i], NOT_A_NUMBER);
        for (size_t i = 0; i < COUNT(axis_any); ++i) refuses_float(4, at + axis_any[i], NOT_A_NUMBER);
        refuses_int(4, at + A(motion), 3);
        refuses_int(4, at + A(spring), -1);
        refuses_int(4, at + A(reserved), 1);
        refuses_int(4, at + A(reserved[1]), 1);
        refuses_float(4, at + A(lower), 1); // above upper
        if (k >= FE_DOF_ANGULAR_X) refuses_float(4, at + A(upper), 3.2f);
    }
}

static void limits_of_exactly_half_a_turn_are_accepted(void **state)
{
    (void)state;
    fixture f = begin(2);
    any_def d;
    init(2, &d);
    d.hinge.limit_enabled = 1, d.hinge.lower = -ANY_PI, d.hinge.upper = ANY_PI;
    OK(any_set(2, f.world, f.joint, &d));
    d.hinge.lower = ANY_PI; // a lock at half a turn
    OK(any_set(2, f.world, f.joint, &d));
    end(&f);
}

// ---- handles -------------------------------------------------------------------------------------------------------

static void calls_with_a_bad_handle(fe_world *world, fe_joint joint, fe_result expected)
{
    any_def d;
    fe_joint_state s = {.struct_size = sizeof s};
    fe_body a, b;
    fe_vec3 force, torque;
    fe_transform x, y;
    uint64_t data;
    int32_t n;
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        init(kind, &d);
        REFUSES_AS(world, expected, any_set(kind, world, joint, &d), set_names[kind]);
        REFUSES_AS(world, expected, any_get(kind, world, joint, &d), get_names[kind]);
    }
    init(3, &d);
    d.common.struct_size = sizeof d.common;
    REFUSES(world, expected, fe_joint_destroy(world, joint));
    REFUSES(world, expected, fe_joint_get_type(world, joint, &n));
    REFUSES(world, expected, fe_joint_get_bodies(world, joint, &a, &b));
    REFUSES(world, expected, fe_joint_set(world, joint, &d.common));
    REFUSES(world, expected, fe_joint_get(world, joint, &d.common));
    REFUSES(world, expected, fe_joint_set_enabled(world, joint, 1));
    REFUSES(world, expected, fe_joint_get_enabled(world, joint, &n));
    REFUSES(world, expected, fe_joint_set_user_data(world, joint, 1));
    REFUSES(world, expected, fe_joint_get_user_data(world, joint, &data));
    REFUSES(world, expected, fe_joint_get_frames(world, joint, &x, &y));
    REFUSES(world, expected, fe_joint_get_state(world, joint, &s));
    REFUSES(world, expected, fe_joint_get_reaction(world, joint, &force, &torque));
    assert_int_equal(fe_joint_is_valid(world, joint), 0);
}

static void stale_foreign_and_made_up_handles_are_errors(void **state)
{
    (void)state;
    fixture f = begin(2);
    fe_shape shapes[1];
    assert_int_equal(fe_body_get_shapes(f.world, f.a, shapes, 1), 1);
    assert_int_equal(fe_joint_is_valid(f.world, f.joint), 1);
    calls_with_a_bad_handle(f.world, f.a, FE_ERROR_KIND);
    calls_with_a_bad_handle(f.world, shapes[0], FE_ERROR_KIND);
    calls_with_a_bad_handle(f.world, 0, FE_ERROR_STALE);
    calls_with_a_bad_handle(f.world, f.joint + 1, FE_ERROR_STALE);
    OK(fe_joint_destroy(f.world, f.joint));
    calls_with_a_bad_handle(f.world, f.joint, FE_ERROR_STALE);
    fe_joint old = f.joint;
    any_def d;
    init(1, &d);
    d.common.body_a = f.a, d.common.body_b = f.b;
    OK(any_create(1, f.world, &d, &f.joint)); // the slot lives again, the old handle does not
    assert_true(old != f.joint);
    calls_with_a_bad_handle(f.world, old, FE_ERROR_STALE);
    end(&f);
    assert_int_equal(fe_joint_is_valid(NULL, old), 0);
}

static void a_joint_of_another_type_is_refused(void **state)
{
    (void)state;
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        fixture f = begin(kind);
        any_def d;
        int32_t type;
        OK(fe_joint_get_type(f.world, f.joint, &type));
        assert_int_equal(type, kind + 1);
        for (int other = 0; other < ANY_KINDS; ++other) {
            if (other == kind) continue;
            init(other, &d);
            REFUSES_AS(f.world, FE_ERROR_STATE, any_set(other, f.world, f.joint, &d), set_names[other]);
            REFUSES_AS(f.world, FE_ERROR_STATE, any_get(other, f.world, f.joint, &d), get_names[other]);
        }
        end(&f);
    }
}

static void null_pointers_are_errors(void **state)
{
    (void)state;
    fixture f = begin(2);
    fe_world *w = f.world;
    fe_body a, b;
    fe_vec3 v;
    fe_transform t;
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        fixture g = begin(kind);
        REFUSES_AS(g.world, FE_ERROR_ARGUMENT, any_set(kind, g.world, g.joint, NULL), set_names[kind]);
        REFUSES_AS(g.world, FE_ERROR_ARGUMENT, any_get(kind, g.world, g.joint, NULL), get_names[kind]);
        end(&g);
    }
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get_type(w, f.joint, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get_bodies(w, f.joint, NULL, &b));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get_bodies(w, f.joint, &a, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_set(w, f.joint, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get(w, f.joint, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get_enabled(w, f.joint, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get_user_data(w, f.joint, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get_frames(w, f.joint, NULL, &t));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get_frames(w, f.joint, &t, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get_state(w, f.joint, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get_reaction(w, f.joint, NULL, &v));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_get_reaction(w, f.joint, &v, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_get_joints(w, NULL, 1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_body_get_joints(w, f.a, NULL, 1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_world_get_joint_events(w, NULL, 0, 1));
    REFUSES(w, FE_ERROR_STALE, fe_body_get_joints(w, 0, NULL, 0));
    REFUSES(w, FE_ERROR_KIND, fe_body_get_joints(w, f.joint, NULL, 0));
    check_refusal(fe_joint_destroy(NULL, f.joint), FE_ERROR_ARGUMENT, "fe_joint_destroy(", __FILE__, __LINE__);
    REFUSES(w, FE_ERROR_ARGUMENT, fe_joint_set_enabled(w, f.joint, 2));
    end(&f);
}

// ---- what all types have -------------------------------------------------------------------------------------------

static void the_common_part_is_set_and_read_on_any_type(void **state)
{
    (void)state;
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        fixture f = begin(kind);
        any_def before, after;
        fe_joint_def common = {.struct_size = sizeof common}, read = common;
        before.common.struct_size = after.common.struct_size = any_sizes[kind];
        OK(any_get(kind, f.world, f.joint, &before));
        OK(fe_joint_get(f.world, f.joint, &common));
        assert_true(common.body_a == f.a && common.body_b == f.b);
        common.break_force = 12, common.user_data = 34, common.collide_connected = 1, common.body_b = 0;
        OK(fe_joint_set(f.world, f.joint, &common));
        OK(fe_joint_get(f.world, f.joint, &read));
        FE_NEAR(read.break_force, 12, 0);
        assert_true(read.user_data == 34 && read.collide_connected == 1 && read.body_b == f.b);
        OK(any_get(kind, f.world, f.joint, &after));
        assert_memory_equal((char *)&before + sizeof common, (char *)&after + sizeof common,
                            any_sizes[kind] - sizeof common);
        common.body_a = f.b;
        REFUSES(f.world, FE_ERROR_ARGUMENT, fe_joint_set(f.world, f.joint, &common)); // bodies stay
        common.body_a = 0, common.break_torque = NOT_A_NUMBER;
        REFUSES(f.world, FE_ERROR_ARGUMENT, fe_joint_set(f.world, f.joint, &common));

        int32_t enabled;
        uint64_t data;
        OK(fe_joint_set_enabled(f.world, f.joint, 0));
        OK(fe_joint_set_enabled(f.world, f.joint, 0));
        OK(fe_joint_get_enabled(f.world, f.joint, &enabled));
        assert_int_equal(enabled, 0);
        OK(fe_joint_set_user_data(f.world, f.joint, 56));
        OK(fe_joint_get_user_data(f.world, f.joint, &data));
        assert_true(data == 56);
        end(&f);
    }
}

static void joints_are_listed_in_the_order_of_creation(void **state)
{
    (void)state;
    fixture f = begin(1);
    fe_body c = new_box(f.world, 4, 0, 0);
    any_def d;
    fe_joint second, third, list[4] = {0, 0, 0, 0};
    init(3, &d);
    d.common.body_a = c, d.common.body_b = f.b;
    OK(any_create(3, f.world, &d, &second));
    init(0, &d);
    d.common.body_a = c, d.common.body_b = f.a;
    OK(any_create(0, f.world, &d, &third));
    assert_int_equal(fe_world_get_joints(f.world, NULL, 0), 3);
    assert_int_equal(fe_world_get_joints(f.world, list, 2), 3);
    assert_true(list[0] == f.joint && list[1] == second && list[2] == 0);
    assert_int_equal(fe_body_get_joints(f.world, c, list, 4), 2);
    assert_true(list[0] == second && list[1] == third);
    assert_int_equal(fe_body_get_joints(f.world, f.a, list, 4), 2);
    assert_true(list[0] == f.joint && list[1] == third);

    fe_counters counters = {.struct_size = sizeof counters};
    OK(fe_world_get_counters(f.world, &counters));
    assert_int_equal(counters.joints, 3);
    OK(fe_body_destroy(f.world, f.b)); // takes its joints along
    assert_int_equal(fe_world_get_joints(f.world, list, 4), 1);
    assert_true(list[0] == third && !fe_joint_is_valid(f.world, f.joint) && !fe_joint_is_valid(f.world, second));
    assert_int_equal(fe_body_get_joints(f.world, f.a, NULL, 0), 1);
    OK(fe_body_destroy(f.world, c));
    assert_int_equal(fe_world_get_joints(f.world, NULL, 0), 0);
    assert_int_equal(fe_body_get_joints(f.world, f.a, NULL, 0), 0);
    end(&f);
}

// ---- frames from the world -----------------------------------------------------------------------------------------

static void check_state_is_zero(const fe_world *world, fe_joint joint)
{
    fe_joint_state s = {.struct_size = sizeof s};
    OK(fe_joint_get_state(world, joint, &s));
    // angles of float quaternions: a few units in the last place of 1; points of bodies some metres across
    const double angle = 2e-6, gap = 2e-6;
    FE_NEAR(s.angle, 0, angle), FE_NEAR(s.swing_y, 0, angle), FE_NEAR(s.swing_z, 0, angle);
    FE_NEAR(s.translation.x, 0, gap), FE_NEAR(s.translation.y, 0, gap), FE_NEAR(s.translation.z, 0, gap),
        FE_NEAR(s.length, 0, gap);
    FE_NEAR(s.linear_error, 0, gap), FE_NEAR(s.angular_error, 0, angle);
}

static fixture turned_pair(void)
{
    fixture f = begin(-1);
    fe_transform t = {{1e5, -2e4, 3e4}, {0.1f, -0.7f, 0.3f, 0.5f}},
                 u = {{1e5 + 1, -2e4 + 2, 3e4 - 1}, {-0.4f, 0.2f, 0.6f, -0.3f}};
    OK(fe_body_set_transform(f.world, f.a, &t));
    OK(fe_body_set_transform(f.world, f.b, &u));
    return f;
}

static void frames_made_from_the_world_are_zero_now(void **state)
{
    (void)state;
    const fe_vec3 axes[] = {{1, 0, 0}, {-2, 0, 0}, {0, 3, 0}, {0, 0, -1}, {-1, 1e-4f, 0}, {0.3f, -0.5f, 0.7f}};
    for (size_t i = 0; i < COUNT(axes); ++i) {
        fixture f = turned_pair();
        fe_dvec3 point = {1e5 + 0.5, -2e4 + 1, 3e4};
        fe_ball_joint_def ball;
        fe_hinge_joint_def hinge;
        fe_fixed_joint_def fixed;
        fe_configurable_joint_def slide;
        fe_joint joint;
        fe_transform frame_a, frame_b;
        fe_ball_joint_def_init(&ball, sizeof ball);
        OK(fe_ball_joint_def_at(f.world, &ball, f.a, f.b, &point, &axes[i]));
        OK(fe_ball_joint_create(f.world, &ball, &joint));
        check_state_is_zero(f.world, joint);
        fe_hinge_joint_def_init(&hinge, sizeof hinge);
        hinge.motor_speed = 3;
        OK(fe_hinge_joint_def_at(f.world, &hinge, f.a, f.b, &point, &axes[i]));
        FE_NEAR(hinge.motor_speed, 3, 0); // the rest stays
        OK(fe_hinge_joint_create(f.world, &hinge, &joint));
        check_state_is_zero(f.world, joint);
        OK(fe_joint_get_frames(f.world, joint, &frame_a, &frame_b));
        // R(q) x, the first column
        fe_quat q = frame_a.rotation;
        double n = sqrt((double)(axes[i].x * axes[i].x + axes[i].y * axes[i].y + axes[i].z * axes[i].z));
        FE_NEAR(1 - 2 * (q.y * q.y + q.z * q.z), (double)axes[i].x / n, 1e-6);
        FE_NEAR(2 * (q.x * q.y + q.w * q.z), (double)axes[i].y / n, 1e-6);
        FE_NEAR(2 * (q.x * q.z - q.w * q.y), (double)axes[i].z / n, 1e-6);
        FE_NEAR(frame_b.position.x, point.x, 1e-6), FE_NEAR(frame_b.position.y, point.y, 1e-6),
            FE_NEAR(frame_b.position.z, point.z, 1e-6);
        fe_fixed_joint_def_init(&fixed, sizeof fixed);
        OK(fe_fixed_joint_def_at(f.world, &fixed, f.a, f.b, &point));
        OK(fe_fixed_joint_create(f.world, &fixed, &joint));
        check_state_is_zero(f.world, joint);
        fe_configurable_joint_def_init(&slide, sizeof slide);
        OK(fe_configurable_joint_def_at(f.world, &slide, f.a, f.b, &point, &axes[i]));
        OK(fe_configurable_joint_create(f.world, &slide, &joint));
        check_state_is_zero(f.world, joint);
        memset(&slide, 0xCD, sizeof slide);
        slide.struct_size = sizeof slide;
        OK(fe_slider_joint_def_at(f.world, &slide, f.a, f.b, &point, &axes[i]));
        OK(fe_configurable_joint_create(f.world, &slide, &joint));
        check_state_is_zero(f.world, joint);
        end(&f);
    }
}

static void ready_made_definitions_are_whole(void **state)
{
    (void)state;
    fixture f = turned_pair();
    fe_dvec3 p = {1e5, -2e4, 3e4}, q = {1e5 + 3, -2e4 + 4, 3e4};
    fe_vec3 axle = {0, 0, 2}, up = {1, 5, 1};
    fe_distance_joint_def rope;
    fe_configurable_joint_def c;
    fe_joint joint;
    memset(&rope, 0xCD, sizeof rope);
    rope.struct_size = sizeof rope;
    OK(fe_rope_joint_def_at(f.world, &rope, f.a, f.b, &p, &q, 7));
    FE_NEAR(rope.lower, 0, 0), FE_NEAR(rope.upper, 7, 0), FE_NEAR(rope.target, 5, 1e-6);
    OK(fe_distance_joint_create(f.world, &rope, &joint));
    fe_distance_joint_def_init(&rope, sizeof rope);
    OK(fe_distance_joint_def_at(f.world, &rope, f.a, f.b, &p, &q));
    FE_NEAR(rope.lower, 5, 1e-6), FE_NEAR(rope.upper, 5, 1e-6);
    OK(fe_distance_joint_create(f.world, &rope, &joint));

    memset(&c, 0xCD, sizeof c);
    c.struct_size = sizeof c;
    OK(fe_wheel_joint_def_at(f.world, &c, f.a, f.b, &p, &axle, &up, 4, 0.7f, 0.2f));
    OK(fe_configurable_joint_create(f.world, &c, &joint));
    check_state_is_zero(f.world, joint);
    assert_true(c.axes[FE_DOF_ANGULAR_X].motion == FE_MOTION_FREE &&
                c.axes[FE_DOF_LINEAR_Z].motion == FE_MOTION_LIMITED);
    assert_true(c.axes[FE_DOF_ANGULAR_Z].motion == FE_MOTION_LOCKED &&
                c.axes[FE_DOF_LINEAR_X].motion == FE_MOTION_LOCKED);
    fe_transform a, b;
    OK(fe_joint_get_frames(f.world, joint, &a, &b));
    fe_quat r = a.rotation;
    FE_NEAR(2 * (r.x * r.z - r.w * r.y), 1, 1e-6);     // X along the axle
    FE_WITHIN(2 * (r.y * r.z - r.w * r.x), 0.98, 1.0); // Z along `up`, made square to it
    FE_NEAR(1 - 2 * (r.x * r.x + r.y * r.y), 0, 1e-6);

    memset(&c, 0xCD, sizeof c);
    c.struct_size = sizeof c;
    OK(fe_motor_joint_def_at(f.world, &c, f.a, f.b, 3, 1, 100, 50));
    OK(fe_configurable_joint_create(f.world, &c, &joint));
    check_state_is_zero(f.world, joint);
    FE_NEAR(c.axes[FE_DOF_LINEAR_Y].spring_max, 100, 0), FE_NEAR(c.axes[FE_DOF_ANGULAR_Y].spring_max, 50, 0);
    end(&f);
}

// A kick on the chassis tells the mass it shows at the wheel: the spring swings that mass at the hertz given
static void a_wheels_spring_is_for_its_corner_of_the_chassis(void **state)
{
    (void)state;
    for (int fixed = 0; fixed < 2; ++fixed) {
        fixture f = begin(-1);
        fe_dvec3 p = {0.4, -0.3, 0.2};
        fe_vec3 axle = {0, 0, 1}, up = {0, 1, 0}, kick = {0, 2, 0}, v;
        fe_configurable_joint_def c = {.struct_size = sizeof c};
        if (fixed) OK(fe_body_set_type(f.world, f.a, FE_BODY_STATIC));
        OK(fe_wheel_joint_def_at(f.world, &c, f.a, f.b, &p, &axle, &up, 4, 0.7f, 0.2f));
        OK(fe_body_add_impulse_at(f.world, fixed ? f.b : f.a, &kick, &p));
        OK(fe_body_get_point_velocity(f.world, fixed ? f.b : f.a, &p, &v));
        double mass = (double)(kick.y / v.y), w = 8 * 3.14159265358979;
        assert_int_equal(c.axes[FE_DOF_LINEAR_Z].spring, FE_SPRING_STIFFNESS);
        FE_NEAR(c.axes[FE_DOF_LINEAR_Z].spring_stiffness, mass * w * w, 1e-5 * mass * w * w);
        FE_NEAR(c.axes[FE_DOF_LINEAR_Z].spring_damping, 2 * (double)0.7f * mass * w, 1e-5 * mass * w);
        end(&f);
    }
}

static void bad_arguments_of_the_makers_are_refused(void **state)
{
    (void)state;
    fixture f = begin(-1);
    fe_world *w = f.world;
    fe_dvec3 p = {0, 0, 0}, far = {2e9, 0, 0};
    fe_vec3 x = {1, 0, 0}, none = {0, 0, 0}, nan = {NOT_A_NUMBER, 0, 0};
    fe_ball_joint_def ball;
    fe_hinge_joint_def hinge;
    fe_fixed_joint_def fixed;
    fe_distance_joint_def rod;
    fe_configurable_joint_def c;
    fe_ball_joint_def_init(&ball, sizeof ball), fe_hinge_joint_def_init(&hinge, sizeof hinge),
        fe_fixed_joint_def_init(&fixed, sizeof fixed);
    fe_distance_joint_def_init(&rod, sizeof rod), fe_configurable_joint_def_init(&c, sizeof c);
    REFUSES(w, FE_ERROR_ARGUMENT, fe_ball_joint_def_at(w, NULL, f.a, f.b, &p, &x));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_ball_joint_def_at(w, &ball, f.a, f.a, &p, &x));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_ball_joint_def_at(w, &ball, f.a, f.b, NULL, &x));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_ball_joint_def_at(w, &ball, f.a, f.b, &p, NULL));
    REFUSES(w, FE_ERROR_STALE, fe_ball_joint_def_at(w, &ball, 1, f.b, &p, &x));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_hinge_joint_def_at(w, &hinge, f.a, f.b, &p, &none));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_hinge_joint_def_at(w, &hinge, f.a, f.b, &p, &nan));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_hinge_joint_def_at(w, &hinge, f.a, f.b, &far, &x));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_hinge_joint_def_at(w, NULL, f.a, f.b, &p, &x));
    REFUSES(w, FE_ERROR_STALE, fe_fixed_joint_def_at(w, &fixed, f.a, 1, &p));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_fixed_joint_def_at(w, &fixed, f.a, f.b, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_distance_joint_def_at(w, &rod, f.a, f.b, &p, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_distance_joint_def_at(w, NULL, f.a, f.b, &p, &p));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_configurable_joint_def_at(w, &c, f.a, f.b, &p, NULL));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_configurable_joint_def_at(w, NULL, f.a, f.b, &p, &x));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_rope_joint_def_at(w, &rod, f.a, f.b, &p, &p, 0));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_rope_joint_def_at(w, &rod, f.a, f.b, &p, &far, 1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_slider_joint_def_at(w, &c, f.a, f.b, &p, &none));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_slider_joint_def_at(w, NULL, f.a, f.b, &p, &x));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_wheel_joint_def_at(w, &c, f.a, f.b, &p, &x, &x, 1, 1, 1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_wheel_joint_def_at(w, &c, f.a, f.b, &p, &x, &none, 1, 1, 1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_wheel_joint_def_at(w, &c, f.a, f.b, &p, &x, &x, 1, 1, NOT_A_NUMBER));
    fe_vec3 up = {0, 1, 0};
    REFUSES(w, FE_ERROR_ARGUMENT, fe_wheel_joint_def_at(w, &c, f.a, f.b, &p, &x, &up, -1, 1, 1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_wheel_joint_def_at(w, &c, f.a, f.b, &p, &x, &up, 1, -1, 1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_wheel_joint_def_at(w, &c, f.a, f.b, &p, &x, &up, 1, 1, -1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_motor_joint_def_at(w, &c, f.a, f.b, 1, 1, -1, 1));
    REFUSES(w, FE_ERROR_ARGUMENT, fe_motor_joint_def_at(w, &c, f.a, f.b, 1, 1, 1, NOT_A_NUMBER));
    REFUSES(w, FE_ERROR_STALE, fe_motor_joint_def_at(w, &c, f.a, 1, 1, 1, 1, 1));
    check_refusal(fe_motor_joint_def_at(NULL, &c, f.a, f.b, 1, 1, 1, 1), FE_ERROR_ARGUMENT, "fe_motor_joint_def_at(",
                  __FILE__, __LINE__);
    end(&f);
}

// ---- readings ------------------------------------------------------------------------------------------------------

// B's frame turned by `q` against A's, both at the origin
static fe_joint_state state_of_turn(fe_quat q)
{
    fixture f = begin(-1);
    fe_ball_joint_def d;
    fe_joint joint;
    fe_joint_state s = {.struct_size = sizeof s};
    fe_transform t = {{0, 0, 0}, q};
    OK(fe_body_set_transform(f.world, f.b, &t));
    fe_ball_joint_def_init(&d, sizeof d);
    d.body_a = f.a, d.body_b = f.b;
    OK(fe_ball_joint_create(f.world, &d, &joint));
    OK(fe_joint_get_state(f.world, joint, &s));
    end(&f);
    return s;
}

static void angles_are_twist_about_x_and_swing(void **state)
{
    (void)state;
    for (double twist = -3.1; twist < 3.11; twist += 0.62)
        for (double y = -1.5; y < 1.6; y += 0.5)
            for (double z = -1; z < 1.1; z += 0.4) {
                double swing = sqrt(y * y + z * z), k = swing > 0 ? sin(swing / 2) / swing : 0;
                double sy = k * y, sz = k * z, sw = cos(swing / 2), tx = sin(twist / 2), tw = cos(twist / 2);
                // swing times twist
                fe_quat q = {(float)(sw * tx), (float)(sy * tw + sz * tx), (float)(sz * tw - sy * tx),
                             (float)(sw * tw)};
                fe_joint_state s = state_of_turn(q);
                FE_NEAR(s.angle, twist, 1e-5), FE_NEAR(s.swing_y, y, 1e-5), FE_NEAR(s.swing_z, z, 1e-5);
            }
}

static void speeds_are_those_of_b_in_frame_a(void **state)
{
    (void)state;
    fixture f = begin(-1);
    fe_distance_joint_def d;
    fe_joint joint;
    fe_joint_state s = {.struct_size = sizeof s};
    fe_distance_joint_def_init(&d, sizeof d);
    d.body_a = f.a, d.body_b = f.b;                                 // at 0 and 2 on the x axis
    d.frame_a.rotation = (fe_quat){0, 0, 0.70710678f, 0.70710678f}; // its X is A's Y, its Y A's -X
    OK(fe_distance_joint_create(f.world, &d, &joint));
    fe_vec3 v = {3, 4, 0}, w = {0, 0, 1};
    OK(fe_body_set_linear_velocity(f.world, f.b, &v));
    OK(fe_body_set_angular_velocity(f.world, f.b, &w));
    OK(fe_body_set_angular_velocity(f.world, f.a, &w));
    OK(fe_joint_get_state(f.world, joint, &s));
    FE_NEAR(s.length, 2, 1e-6), FE_NEAR(s.speed, 3, 1e-6), FE_NEAR(s.linear_error, 1, 1e-6);
    FE_NEAR(s.translation.x, 0, 1e-6), FE_NEAR(s.translation.y, -2, 1e-6);
    FE_NEAR(s.linear_velocity.x, 4 - 2, 1e-6),
        FE_NEAR(s.linear_velocity.y, -3, 1e-6); // A's matter there moves at 2 along y
    FE_NEAR(s.angular_velocity.z, 0, 1e-6);
    end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_those_of_the_header),
        cmocka_unit_test(what_a_definition_says_is_read_back_and_can_be_changed),
        cmocka_unit_test(an_older_clients_definition_keeps_what_it_does_not_know),
        cmocka_unit_test(bad_ends_are_refused),
        cmocka_unit_test(bad_values_of_the_front_are_refused),
        cmocka_unit_test(bad_values_of_each_type_are_refused),
        cmocka_unit_test(limits_of_exactly_half_a_turn_are_accepted),
        cmocka_unit_test(stale_foreign_and_made_up_handles_are_errors),
        cmocka_unit_test(a_joint_of_another_type_is_refused),
        cmocka_unit_test(null_pointers_are_errors),
        cmocka_unit_test(the_common_part_is_set_and_read_on_any_type),
        cmocka_unit_test(joints_are_listed_in_the_order_of_creation),
        cmocka_unit_test(frames_made_from_the_world_are_zero_now),
        cmocka_unit_test(ready_made_definitions_are_whole),
        cmocka_unit_test(a_wheels_spring_is_for_its_corner_of_the_chassis),
        cmocka_unit_test(bad_arguments_of_the_makers_are_refused),
        cmocka_unit_test(angles_are_twist_about_x_and_swing),
        cmocka_unit_test(speeds_are_those_of_b_in_frame_a),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
