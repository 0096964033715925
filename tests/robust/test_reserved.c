// test_reserved.c - a step stays within what it reserved, whatever changes who takes part: the address sanitizer sees
// what does not. Numbers are large against the slack of arrays that grow by a part of what they hold.
#include "fe_test.h"
#include "feather.h"

#define OK(call) assert_int_equal(call, FE_OK)

enum { COUNT = 400, ROW = 20 };

static const float dt = 1 / 60.0f;

static fe_body add(fe_world *world, fe_body_def def, fe_geometry form)
{
    fe_body body = 0;
    fe_shape shape = 0;
    fe_shape_def shape_def;
    fe_shape_def_init(&shape_def, sizeof shape_def);
    shape_def.events = FE_SHAPE_EVENTS_STAY;
    OK(fe_body_create(world, &def, &body));
    OK(fe_shape_create(world, body, &shape_def, &form, &shape));
    return body;
}

static fe_body_def place(int32_t type, double x, double y, double z)
{
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform.position = (fe_dvec3){x, y, z};
    return def;
}

static fe_geometry box(float x, float y, float z)
{
    fe_geometry form;
    fe_geometry_box(&form, x, y, z);
    return form;
}

static fe_world *new_world(void)
{
    fe_world *world = NULL;
    OK(fe_world_create(NULL, &world));
    return world;
}

static void run(fe_world *world, int steps)
{
    for (int i = 0; i < steps; ++i) OK(fe_world_step(world, dt));
}

// No step notes the speed of what is disabled
static void fast_bodies_may_be_enabled(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body bodies[COUNT];
    for (int i = 0; i < COUNT; ++i) {
        fe_body_def def = place(FE_BODY_DYNAMIC, 10.0 * i, 0, 0);
        def.enabled = 0, def.linear_velocity.z = 1000;
        bodies[i] = add(world, def, box(0.1f, 0.1f, 0.1f));
    }
    run(world, 1);
    for (int i = 0; i < COUNT; ++i) OK(fe_body_set_enabled(world, bodies[i], 1));
    run(world, 1);
    OK(fe_world_destroy(world));
}

// Boxes sleep on a platform that rests. Whoever hangs from it and is torn off wakes nobody in the middle of the step
static void a_joint_may_break_at_a_platform_that_sleeps(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body platform = add(world, place(FE_BODY_KINEMATIC, 0, 0, 0), box(50, 0.5f, 50)),
            hung = add(world, place(FE_BODY_DYNAMIC, 0, -5, 0), box(0.5f, 0.5f, 0.5f));
    OK(fe_body_set_sleep_allowed(world, hung, 0));
    fe_ball_joint_def def;
    fe_joint joint = 0;
    fe_ball_joint_def_init(&def, sizeof def);
    def.body_a = platform, def.body_b = hung, def.frame_b.position.y = 5, def.break_force = 1e6f;
    OK(fe_ball_joint_create(world, &def, &joint));
    for (int i = 0; i < COUNT; ++i) {
        add(world, place(FE_BODY_DYNAMIC, 2.0 * (i % ROW) - ROW, 1, 2.0 * (i / ROW) - ROW), box(0.5f, 0.5f, 0.5f));
        if (i % 10 == 9) run(world, 45); // these fall asleep first: rooms stay small
    }
    run(world, 120);
    int32_t awake = 1;
    OK(fe_body_get_awake(world, platform, &awake));
    assert_false(awake);
    OK(fe_body_add_force(world, hung, &(fe_vec3){0, -1e8f, 0}));
    run(world, 1);
    assert_false(fe_joint_is_valid(world, joint));
    run(world, 1);
    OK(fe_world_destroy(world));
}

static void keep_awake(fe_world *world)
{
    fe_world_tuning tuning = {.struct_size = sizeof tuning};
    OK(fe_world_get_tuning(world, &tuning));
    tuning.sleep_enabled = 0;
    OK(fe_world_set_tuning(world, &tuning));
}

// A heightfield of ridges: a ball in a trough lies on two sides of it
static fe_geometry troughs(fe_world *world, int count)
{
    enum { ROWS = 3 };
    const int columns = 2 * count + 3;
    float *heights = test_malloc((size_t)(columns * ROWS) * sizeof *heights);
    for (int i = 0; i < columns * ROWS; ++i) heights[i] = (float)(i % columns % 2);
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = ROWS, def.columns = columns, def.cell_x = 1, def.cell_z = 4, def.heights = heights;
    fe_store *store = NULL;
    fe_asset field = 0;
    OK(fe_world_get_store(world, &store));
    OK(fe_heightfield_create(store, &def, &field));
    test_free(heights);
    fe_geometry form;
    fe_geometry_heightfield(&form, field);
    return form;
}

// Pairs with terrain have more lists of contacts than there are pairs. Of a crowd that falls asleep on a platform,
// which wakes with a part of it, each contact has its room besides
static void a_crowd_may_wake_beside_terrain(void **state)
{
    (void)state;
    enum { TROUGHS = 1200, FIRST = 97, ALL = 450 };
    fe_world *world = new_world();
    keep_awake(world);
    fe_geometry ball;
    fe_geometry_sphere(&ball, 0.3f);
    add(world, place(FE_BODY_STATIC, 0, 0, 0), troughs(world, TROUGHS));
    for (int i = 0; i < TROUGHS; ++i) add(world, place(FE_BODY_DYNAMIC, 2.0 * i, 0.45, 3), ball);
    add(world, place(FE_BODY_STATIC, 0, -20, -200), box(60, 0.5f, 60));
    add(world, place(FE_BODY_DYNAMIC, 0, -19, -200), box(40, 0.5f, 40));
    for (int i = 0; i < ALL; ++i) {
        add(world, place(FE_BODY_DYNAMIC, 2.0 * (i % ROW) - ROW, -18, 2.0 * (i / ROW) - 220), box(0.5f, 0.5f, 0.5f));
        if (i + 1 == FIRST) run(world, 60);
    }
    run(world, 5);
    OK(fe_world_destroy(world));
}

// Lanes without a body stand for nobody: not for the first, which is joined and sleeps
static void who_is_joined_may_sleep_from_the_start(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body bodies[2];
    for (int i = 0; i < 2; ++i) {
        fe_body_def def = place(FE_BODY_DYNAMIC, 0, 3.0 * i, 0);
        def.awake = 0;
        bodies[i] = add(world, def, box(0.5f, 1, 0.25f)); // a cube has no gyroscopic torque
    }
    fe_ball_joint_def def;
    fe_joint joint = 0;
    fe_ball_joint_def_init(&def, sizeof def);
    def.body_a = bodies[0], def.body_b = bodies[1], def.frame_b.position.y = -3;
    OK(fe_ball_joint_create(world, &def, &joint));
    for (int i = 0; i < 2; ++i) OK(fe_body_set_awake(world, bodies[i], 0));
    add(world, place(FE_BODY_DYNAMIC, 20, 0, 0), box(0.5f, 0.5f, 0.5f));
    run(world, 2);
    int32_t awake = 1;
    OK(fe_body_get_awake(world, bodies[0], &awake));
    assert_false(awake);
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fast_bodies_may_be_enabled),
        cmocka_unit_test(a_joint_may_break_at_a_platform_that_sleeps),
        cmocka_unit_test(a_crowd_may_wake_beside_terrain),
        cmocka_unit_test(who_is_joined_may_sleep_from_the_start),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
