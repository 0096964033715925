// Reading and writing many bodies with one call: strides, all or none, the moved ones.
#include "api/api_test.h"

enum { COUNT = 4 };

typedef struct row {
    int32_t mine;
    int32_t padding;
    fe_transform transform;
    float velocity[6];
    float relative[7];
    int32_t also_mine;
} row;

static fe_world *world_with(fe_body *bodies)
{
    fe_world *world = new_world();
    for (int i = 0; i < COUNT; ++i) bodies[i] = new_box(world, 10.0 * i, 5, 0);
    return world;
}

static void transforms_are_read_and_written_with_strides(void **state)
{
    (void)state;
    fe_body bodies[COUNT];
    fe_world *world = world_with(bodies);
    row rows[COUNT];
    fe_transform packed[COUNT];
    memset(rows, 0x11, sizeof rows);
    OK(fe_world_get_transforms(world, bodies, &rows[0].transform, sizeof *rows, COUNT));
    OK(fe_world_get_transforms(world, bodies, packed, 0, COUNT));
    for (int i = 0; i < COUNT; ++i) {
        FE_NEAR(rows[i].transform.position.x, 10.0 * i, 0);
        assert_memory_equal(&rows[i].transform, &packed[i], sizeof packed[i]);
        assert_true(rows[i].mine == 0x11111111 && rows[i].also_mine == 0x11111111);
        rows[i].transform.position.x = -i;
    }
    OK(fe_world_set_transforms(world, bodies, &rows[0].transform, sizeof *rows, COUNT));
    for (int i = 0; i < COUNT; ++i) FE_NEAR(body_transform(world, bodies[i]).position.x, -i, 0);
    OK(fe_world_set_transforms(world, NULL, NULL, 0, 0));
    OK(fe_world_destroy(world));
}

static void writing_is_all_or_none(void **state)
{
    (void)state;
    fe_body bodies[COUNT], wrong[COUNT];
    fe_world *world = world_with(bodies);
    fe_transform good[COUNT], bad[COUNT];
    float floats[COUNT][6] = {{0}};
    OK(fe_world_get_transforms(world, bodies, good, 0, COUNT));
    memcpy(bad, good, sizeof bad);
    for (int i = 0; i < COUNT; ++i) bad[i].position.y = 50;
    bad[COUNT - 1].rotation.w = NOT_A_NUMBER;
    memcpy(wrong, bodies, sizeof wrong);
    wrong[COUNT - 1] += NEXT_GENERATION;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_transforms(world, bodies, bad, 0, COUNT));
    REFUSES(world, FE_ERROR_STALE, fe_world_set_transforms(world, wrong, good, 0, COUNT));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_transforms(world, bodies, good, 39, COUNT));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_transforms(world, bodies, good, 42, COUNT));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_transforms(world, bodies, NULL, 0, COUNT));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_transforms(world, NULL, good, 0, COUNT));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_transforms(world, bodies, good, 0, -1));
    floats[0][0] = 5, floats[COUNT - 1][5] = NOT_A_NUMBER;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_velocities(world, bodies, &floats[0][0], 0, COUNT));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_add_forces(world, bodies, &floats[0][0], 0, COUNT));
    floats[COUNT - 1][5] = 0;
    REFUSES(world, FE_ERROR_STALE, fe_world_set_velocities(world, wrong, &floats[0][0], 0, COUNT));
    REFUSES(world, FE_ERROR_STALE, fe_world_add_forces(world, wrong, &floats[0][0], 0, COUNT));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_set_velocities(world, bodies, &floats[0][0], 20, COUNT));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_add_forces(world, bodies, NULL, 0, COUNT));
    wrong[COUNT - 1] = new_ground(world);
    REFUSES(world, FE_ERROR_STATE, fe_world_set_velocities(world, wrong, &floats[0][0], 0, COUNT));
    OK(fe_world_destroy(world));
}

static void reading_is_all_or_none(void **state)
{
    (void)state;
    fe_body bodies[COUNT];
    fe_world *world = world_with(bodies);
    fe_transform out[COUNT], untouched[COUNT];
    float floats[COUNT * 7];
    fe_dvec3 origin = {0, 0, 0}, nowhere = {(double)INFINITE, 0, 0};
    memset(out, 0x22, sizeof out);
    memset(floats, 0x22, sizeof floats);
    memcpy(untouched, out, sizeof out);
    bodies[COUNT - 1] += NEXT_GENERATION;
    REFUSES(world, FE_ERROR_STALE, fe_world_get_transforms(world, bodies, out, 0, COUNT));
    REFUSES(world, FE_ERROR_STALE, fe_world_get_transforms_f32(world, bodies, &origin, floats, 0, COUNT));
    REFUSES(world, FE_ERROR_STALE, fe_world_get_velocities(world, bodies, floats, 0, COUNT));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_transforms(world, bodies, NULL, 0, 1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_transforms_f32(world, bodies, &nowhere, floats, 0, 1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_transforms_f32(world, bodies, NULL, floats, 0, 1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_transforms_f32(world, bodies, &origin, floats, 24, 1));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_velocities(world, NULL, floats, 0, 1));
    assert_memory_equal(out, untouched, sizeof out);
    assert_memory_equal(floats, untouched, sizeof floats);
    OK(fe_world_destroy(world));
}

// Far from the world's origin the floats are exact: the difference is taken in double.
static void floats_are_relative_to_a_near_origin(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 1e8 + 0.125, -1e8, 3);
    fe_dvec3 origin = {1e8, -1e8, 1};
    row r;
    OK(fe_world_get_transforms_f32(world, &body, &origin, r.relative, sizeof r, 1));
    FE_NEAR(r.relative[0], 0.125, 1e-8), FE_NEAR(r.relative[1], 0, 0), FE_NEAR(r.relative[2], 2, 0),
        FE_NEAR(r.relative[6], 1, 0);
    OK(fe_world_destroy(world));
}

static void velocities_and_forces_are_six_floats(void **state)
{
    (void)state;
    fe_body bodies[COUNT];
    fe_world *world = world_with(bodies);
    fe_vec3 none = {0, 0, 0};
    OK(fe_world_set_gravity(world, &none));
    row rows[COUNT];
    float floats[COUNT][6];
    for (int i = 0; i < COUNT; ++i) {
        for (int k = 0; k < 6; ++k) rows[i].velocity[k] = (float)(i + k);
    }
    OK(fe_world_set_velocities(world, bodies, rows[0].velocity, sizeof *rows, COUNT));
    OK(fe_world_get_velocities(world, bodies, &floats[0][0], 0, COUNT));
    for (int i = 0; i < COUNT; ++i) assert_memory_equal(floats[i], rows[i].velocity, sizeof floats[i]);
    FE_NEAR(body_angular_velocity(world, bodies[1]).z, 6, 0);

    // the same as one call for each
    fe_world *single = new_world();
    OK(fe_world_set_gravity(single, &none));
    for (int i = 0; i < COUNT; ++i) {
        fe_body body = new_box(single, 10.0 * i, 5, 0);
        fe_vec3 v = {(float)i, (float)(i + 1), (float)(i + 2)}, w = {(float)(i + 3), (float)(i + 4), (float)(i + 5)};
        OK(fe_body_set_linear_velocity(single, body, &v));
        OK(fe_body_set_angular_velocity(single, body, &w));
        OK(fe_body_add_force(single, body, &v));
        OK(fe_body_add_torque(single, body, &w));
    }
    OK(fe_world_add_forces(world, bodies, rows[0].velocity, sizeof *rows, COUNT));
    FE_TRUE(hash_of(world) == hash_of(single));
    step(world, 3), step(single, 3);
    FE_TRUE(hash_of(world) == hash_of(single));
    OK(fe_world_destroy(single));
    OK(fe_world_destroy(world));
}

// Those that the last step moved: not the ones at rest, not the sleepers, nobody after a step of 0 s.
static void the_moved_are_those_of_the_last_step(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_ground(world);
    fe_body falling = new_box(world, 0, 50, 0), resting = new_box(world, 10, 0.5, 0), also = new_box(world, 20, 60, 0),
            moved[4];
    fe_transform poses[4];
    struct {
        fe_transform transform;
        int64_t mine;
    } spread[4];
    OK(fe_world_step(world, 1.0f / 60));
    assert_int_equal(fe_world_get_moved(world, NULL, NULL, 0, 0), 3);
    step(world, 100); // the resting one fell asleep on the way
    assert_int_equal(is_awake(world, resting), 0);
    memset(moved, 0, sizeof moved);
    assert_int_equal(fe_world_get_moved(world, moved, poses, 0, 4), 2);
    assert_true(moved[0] == falling && moved[1] == also && moved[2] == 0);
    FE_NEAR(poses[1].position.y, body_transform(world, also).position.y, 0);
    assert_int_equal(fe_world_get_moved(world, moved, NULL, 0, 1), 2);
    memset(spread, 0x33, sizeof spread);
    assert_int_equal(fe_world_get_moved(world, moved, &spread[0].transform, sizeof *spread, 4), 2);
    FE_NEAR(spread[1].transform.position.x, 20, 0);
    assert_true(spread[0].mine == 0x3333333333333333 && spread[1].mine == 0x3333333333333333);
    OK(fe_world_step(world, 0));
    assert_int_equal(fe_world_get_moved(world, NULL, NULL, 0, 0), 0);
    step(world, 1);
    OK(fe_body_set_awake(world, falling, 0));
    step(world, 1);
    assert_int_equal(fe_world_get_moved(world, moved, NULL, 0, 4), 1);
    assert_true(moved[0] == also);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_moved(world, NULL, poses, 0, 4));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_moved(world, moved, poses, 8, 4));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_get_moved(world, moved, poses, 0, -4));
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(transforms_are_read_and_written_with_strides),
        cmocka_unit_test(writing_is_all_or_none),
        cmocka_unit_test(reading_is_all_or_none),
        cmocka_unit_test(floats_are_relative_to_a_near_origin),
        cmocka_unit_test(velocities_and_forces_are_six_floats),
        cmocka_unit_test(the_moved_are_those_of_the_last_step),
    };
    return cmocka_run_group_tests_name("bulk", tests, NULL, NULL);
}
