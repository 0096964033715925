// Reading and writing many joints with one call: each row is what the call for one joint says or does; all or none.
#include "api/api_test.h"

enum { HINGE, SLIDER, ROPE, BALL, COUNT, DRIVEN = BALL }; // a ball has no free axis of its own

typedef struct arm {
    fe_world *world;
    fe_body bodies[COUNT + 1];
    fe_joint joints[COUNT];
} arm;

static fe_joint make_hinge(const arm *a)
{
    fe_hinge_joint_def def;
    fe_joint joint = 0;
    fe_hinge_joint_def_init(&def, sizeof def);
    OK(fe_hinge_joint_def_at(a->world, &def, a->bodies[0], a->bodies[1], &(fe_dvec3){1, 0, 0}, &(fe_vec3){0, 0, 1}));
    def.motor_max = 200.0f, def.spring_hertz = 2.0f;
    OK(fe_hinge_joint_create(a->world, &def, &joint));
    return joint;
}

static fe_joint make_slider(const arm *a)
{
    fe_configurable_joint_def def;
    fe_joint joint = 0;
    fe_configurable_joint_def_init(&def, sizeof def);
    OK(fe_configurable_joint_def_at(a->world, &def, a->bodies[1], a->bodies[2], &(fe_dvec3){3, 0, 0},
                                    &(fe_vec3){1, 0, 0}));
    for (int k = 0; k < 6; ++k) def.axes[k].motion = FE_MOTION_LOCKED;
    fe_joint_axis *along = &def.axes[FE_DOF_LINEAR_X];
    along->motion = FE_MOTION_FREE, along->motor_max = 300.0f;
    along->spring = FE_SPRING_HERTZ, along->spring_hertz = 2.0f;
    OK(fe_configurable_joint_create(a->world, &def, &joint));
    return joint;
}

static fe_joint make_rope(const arm *a)
{
    fe_distance_joint_def def;
    fe_joint joint = 0;
    fe_distance_joint_def_init(&def, sizeof def);
    OK(fe_distance_joint_def_at(a->world, &def, a->bodies[2], a->bodies[3], &(fe_dvec3){4, 0, 0},
                                &(fe_dvec3){6, 0, 0}));
    def.limit_enabled = 0, def.motor_max = 100.0f, def.spring_hertz = 1.0f;
    OK(fe_distance_joint_create(a->world, &def, &joint));
    return joint;
}

static fe_joint make_ball(const arm *a)
{
    fe_ball_joint_def def;
    fe_joint joint = 0;
    fe_ball_joint_def_init(&def, sizeof def);
    OK(fe_ball_joint_def_at(a->world, &def, a->bodies[3], a->bodies[4], &(fe_dvec3){7, 0, 0}, &(fe_vec3){1, 0, 0}));
    OK(fe_ball_joint_create(a->world, &def, &joint));
    return joint;
}

// Boxes in a row, the first one static
static arm make_arm(void)
{
    arm a = {.world = new_world_of(3)};
    a.bodies[0] = new_body(a.world, FE_BODY_STATIC, 0, 0, 0);
    for (int i = 1; i <= COUNT; ++i) a.bodies[i] = new_box(a.world, 2.0 * i, 0, 0);
    a.joints[HINGE] = make_hinge(&a), a.joints[SLIDER] = make_slider(&a);
    a.joints[ROPE] = make_rope(&a), a.joints[BALL] = make_ball(&a);
    return a;
}

static fe_joint_state state_of(const arm *a, int which)
{
    fe_joint_state s;
    fe_joint_state_init(&s, sizeof s);
    OK(fe_joint_get_state(a->world, a->joints[which], &s));
    return s;
}

// ---- reading -------------------------------------------------------------------------------------------------------
typedef struct row {
    int32_t mine;
    float numbers[6];
    int32_t also_mine;
} row;

static void rows_are_what_the_calls_for_one_say(void **state)
{
    (void)state;
    arm a = make_arm();
    row rows[COUNT];
    memset(rows, 0x11, sizeof rows);
    step(a.world, 20);
    OK(fe_world_get_joint_coordinates(a.world, a.joints, rows[0].numbers, sizeof *rows, COUNT));
    const fe_joint_state hinge = state_of(&a, HINGE), slider = state_of(&a, SLIDER), rope = state_of(&a, ROPE);
    const float expected[COUNT][2] = {{hinge.angle, hinge.angular_velocity.x},
                                      {slider.translation.x, slider.linear_velocity.x},
                                      {rope.length, rope.speed},
                                      {0, 0}};
    for (int i = 0; i < COUNT; ++i) {
        assert_true(rows[i].numbers[0] == expected[i][0] && rows[i].numbers[1] == expected[i][1]);
        assert_true(rows[i].mine == 0x11111111 && rows[i].also_mine == 0x11111111);
    }
    assert_true(expected[HINGE][0] != 0 && expected[SLIDER][1] != 0 && expected[ROPE][1] != 0);
    OK(fe_world_get_joint_reactions(a.world, a.joints, rows[0].numbers, sizeof *rows, COUNT));
    for (int i = 0; i < COUNT; ++i) {
        fe_vec3 twist[2];
        OK(fe_joint_get_reaction(a.world, a.joints[i], &twist[0], &twist[1]));
        assert_memory_equal(rows[i].numbers, twist, sizeof twist);
        assert_true(rows[i].mine == 0x11111111 && rows[i].also_mine == 0x11111111);
    }
    OK(fe_world_destroy(a.world));
}

// ---- writing -------------------------------------------------------------------------------------------------------
static void drives_are_those_of_the_calls_for_one(void **state)
{
    (void)state;
    static const int32_t dofs[] = {FE_DOF_ANGULAR_X, FE_DOF_LINEAR_X, FE_DOF_LINEAR_X};
    static const float targets[] = {0.5f, -0.3f, 1.5f}, speeds[] = {1.0f, 0.2f, -0.4f};
    arm many = make_arm(), one = make_arm();
    OK(fe_world_set_joint_targets(many.world, many.joints, targets, 0, DRIVEN));
    OK(fe_world_set_joint_motor_speeds(many.world, many.joints, speeds, 0, DRIVEN));
    for (int i = 0; i < DRIVEN; ++i) {
        OK(fe_joint_set_target(one.world, one.joints[i], dofs[i], targets[i]));
        OK(fe_joint_set_motor_speed(one.world, one.joints[i], dofs[i], speeds[i]));
    }
    const uint64_t start = hash_of(many.world);
    step(many.world, 30), step(one.world, 30);
    assert_true(hash_of(many.world) == hash_of(one.world) && hash_of(many.world) != start);
    OK(fe_world_destroy(many.world));
    OK(fe_world_destroy(one.world));
}

// On B, and the opposite on A: between two bodies alone in space no momentum comes of it. A joint named twice gets both
static void forces_add_up_and_act_on_both(void **state)
{
    (void)state;
    arm twice = make_arm(), once = make_arm();
    const fe_joint named[] = {twice.joints[ROPE], twice.joints[ROPE]};
    const float halves[] = {3000.0f, 2000.0f}, whole = 5000.0f; // N, more than the motor holds back
    OK(fe_world_add_joint_forces(twice.world, named, halves, 0, 2));
    OK(fe_world_add_joint_forces(once.world, once.joints + ROPE, &whole, 0, 1));
    const uint64_t start = hash_of(once.world);
    step(twice.world, 1), step(once.world, 1);
    assert_true(hash_of(twice.world) == hash_of(once.world) && hash_of(once.world) != start);
    OK(fe_world_destroy(twice.world));

    fe_vec3 a, b;
    OK(fe_world_destroy(once.world));
    arm free = make_arm();
    OK(fe_world_set_gravity(free.world, &(fe_vec3){0, 0, 0}));
    OK(fe_joint_destroy(free.world, free.joints[SLIDER]));
    OK(fe_joint_destroy(free.world, free.joints[BALL]));
    fe_distance_joint_def loose;
    fe_distance_joint_def_init(&loose, sizeof loose);
    OK(fe_distance_joint_get(free.world, free.joints[ROPE], &loose));
    loose.motor_max = 0, loose.spring_hertz = 0;
    OK(fe_distance_joint_set(free.world, free.joints[ROPE], &loose));
    OK(fe_world_add_joint_forces(free.world, free.joints + ROPE, &whole, 0, 1));
    step(free.world, 1);
    OK(fe_body_get_linear_velocity(free.world, free.bodies[2], &a));
    OK(fe_body_get_linear_velocity(free.world, free.bodies[3], &b));
    float mass = 0;
    OK(fe_body_get_mass(free.world, free.bodies[3], &mass));
    // F t / m, outwards; alike bodies
    FE_NEAR(b.x, (double)whole / 60 / (double)mass, 1e-6);
    FE_NEAR(a.x, -(double)b.x, 1e-9);
    OK(fe_world_destroy(free.world));
}

static void a_force_wakes(void **state)
{
    (void)state;
    arm a = make_arm();
    OK(fe_world_set_gravity(a.world, &(fe_vec3){0, 0, 0}));
    int32_t awake = 1;
    for (int i = 0; i < 200 && awake; ++i) {
        step(a.world, 1);
        OK(fe_body_get_awake(a.world, a.bodies[1], &awake));
    }
    assert_int_equal(awake, 0);
    const float torque = 5.0f;
    OK(fe_world_add_joint_forces(a.world, a.joints, &torque, 0, 1));
    OK(fe_body_get_awake(a.world, a.bodies[1], &awake));
    assert_int_equal(awake, 1);
    OK(fe_world_destroy(a.world));
}

// ---- errors --------------------------------------------------------------------------------------------------------
typedef fe_result write_call(fe_world *world, const fe_joint *joints, const float *values, uint32_t stride,
                             int32_t count);

#define WRITES_ALL_OR_NONE(call)                                                             \
    do {                                                                                     \
        float good[COUNT] = {0.1f, 0.1f, 0.1f, 0.1f}, bad[COUNT] = {0.2f, 0.2f, 0.2f, 0.2f}; \
        fe_joint wrong[COUNT];                                                               \
        memcpy(wrong, a.joints, sizeof wrong);                                               \
        REFUSES(a.world, FE_ERROR_STATE, call(a.world, a.joints, good, 0, COUNT));           \
        SAYS("joints[3]");                                                                   \
        bad[ROPE] = NOT_A_NUMBER;                                                            \
        REFUSES(a.world, FE_ERROR_ARGUMENT, call(a.world, a.joints, bad, 0, DRIVEN));        \
        SAYS("values[2]");                                                                   \
        bad[ROPE] = INFINITE;                                                                \
        REFUSES(a.world, FE_ERROR_ARGUMENT, call(a.world, a.joints, bad, 0, DRIVEN));        \
        wrong[ROPE] += NEXT_GENERATION;                                                      \
        REFUSES(a.world, FE_ERROR_STALE, call(a.world, wrong, good, 0, DRIVEN));             \
        wrong[ROPE] = a.bodies[1];                                                           \
        REFUSES(a.world, FE_ERROR_KIND, call(a.world, wrong, good, 0, DRIVEN));              \
        wrong[ROPE] = other.joints[ROPE];                                                    \
        REFUSES(a.world, FE_ERROR_STALE, call(a.world, wrong, good, 0, DRIVEN));             \
        wrong[ROPE] = 0;                                                                     \
        REFUSES(a.world, FE_ERROR_STALE, call(a.world, wrong, good, 0, DRIVEN));             \
        REFUSES(a.world, FE_ERROR_ARGUMENT, call(a.world, NULL, good, 0, DRIVEN));           \
        REFUSES(a.world, FE_ERROR_ARGUMENT, call(a.world, a.joints, NULL, 0, DRIVEN));       \
        REFUSES(a.world, FE_ERROR_ARGUMENT, call(a.world, a.joints, good, 0, -1));           \
        REFUSES(a.world, FE_ERROR_ARGUMENT, call(a.world, a.joints, good, 3, DRIVEN));       \
        REFUSES(NULL, FE_ERROR_ARGUMENT, call(NULL, a.joints, good, 0, DRIVEN));             \
        OK(call(a.world, NULL, NULL, 0, 0));                                                 \
        OK(call(a.world, a.joints, good, 0, DRIVEN));                                        \
    } while (0)

static void writing_is_all_or_none(void **state)
{
    (void)state;
    fe_world_def def;
    arm a = make_arm(), other = make_arm();
    OK(fe_world_destroy(other.world));
    fe_world_def_init(&def, sizeof def);
    def.number = 4;
    OK(fe_world_create(&def, &other.world));
    for (int i = 0; i <= COUNT; ++i) other.bodies[i] = new_box(other.world, 2.0 * i, 0, 0);
    other.joints[ROPE] = make_rope(&other);
    WRITES_ALL_OR_NONE(fe_world_set_joint_targets);
    WRITES_ALL_OR_NONE(fe_world_set_joint_motor_speeds);
    WRITES_ALL_OR_NONE(fe_world_add_joint_forces);
    OK(fe_world_destroy(other.world));
    OK(fe_world_destroy(a.world));
}

// As in the definitions: a hinge turns by no more than pi, a distance is not negative
static void targets_have_the_range_of_the_definition(void **state)
{
    (void)state;
    static const float least[] = {-3.1415926f, -1e6f, 0.0f}, most[] = {3.1415926f, 1e6f, 1e6f};
    static const float below[] = {-3.2f, -1.1e6f, -0.1f}, above[] = {3.2f, 1.1e6f, 1.1e6f};
    arm a = make_arm();
    for (int i = 0; i < DRIVEN; ++i) {
        REFUSES(a.world, FE_ERROR_ARGUMENT, fe_world_set_joint_targets(a.world, a.joints + i, below + i, 0, 1));
        REFUSES(a.world, FE_ERROR_ARGUMENT, fe_world_set_joint_targets(a.world, a.joints + i, above + i, 0, 1));
        OK(fe_world_set_joint_targets(a.world, a.joints + i, least + i, 0, 1));
        OK(fe_world_set_joint_targets(a.world, a.joints + i, most + i, 0, 1));
    }
    OK(fe_world_destroy(a.world));
}

static void reading_is_all_or_none(void **state)
{
    (void)state;
    arm a = make_arm();
    float out[COUNT * 6], untouched[COUNT * 6];
    memset(out, 0x22, sizeof out);
    memcpy(untouched, out, sizeof out);
    fe_joint wrong[COUNT];
    memcpy(wrong, a.joints, sizeof wrong);
    wrong[BALL] += NEXT_GENERATION;
    REFUSES(a.world, FE_ERROR_STALE, fe_world_get_joint_coordinates(a.world, wrong, out, 0, COUNT));
    REFUSES(a.world, FE_ERROR_STALE, fe_world_get_joint_reactions(a.world, wrong, out, 0, COUNT));
    wrong[BALL] = a.bodies[2];
    REFUSES(a.world, FE_ERROR_KIND, fe_world_get_joint_coordinates(a.world, wrong, out, 0, COUNT));
    REFUSES(a.world, FE_ERROR_ARGUMENT, fe_world_get_joint_coordinates(a.world, a.joints, out, 4, COUNT));
    REFUSES(a.world, FE_ERROR_ARGUMENT, fe_world_get_joint_reactions(a.world, a.joints, out, 20, COUNT));
    REFUSES(a.world, FE_ERROR_ARGUMENT, fe_world_get_joint_coordinates(a.world, NULL, out, 0, COUNT));
    REFUSES(a.world, FE_ERROR_ARGUMENT, fe_world_get_joint_reactions(a.world, a.joints, NULL, 0, COUNT));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_world_get_joint_coordinates(NULL, a.joints, out, 0, COUNT));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_world_get_joint_reactions(NULL, a.joints, out, 0, COUNT));
    assert_memory_equal(out, untouched, sizeof out);
    OK(fe_world_destroy(a.world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_what_the_calls_for_one_say),
        cmocka_unit_test(drives_are_those_of_the_calls_for_one),
        cmocka_unit_test(forces_add_up_and_act_on_both),
        cmocka_unit_test(a_force_wakes),
        cmocka_unit_test(writing_is_all_or_none),
        cmocka_unit_test(targets_have_the_range_of_the_definition),
        cmocka_unit_test(reading_is_all_or_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
