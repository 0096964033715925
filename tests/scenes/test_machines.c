// The machines of examples/machines.h do what they are for: a car drives over hills, a rope bridge hangs and bears, a
// door closes, a crane carries a thousand times a link's weight. (The ragdoll:
// tests/invariants/test_joint_invariants.c.)
#include "../../examples/machines.h"
#include "scenes/joint_scene.h"

enum { SIDE = 97 }; // samples of the hills, 0.5 m apart
#define CELL 0.5

static double hill(double x)
{
    return 0.25 * (1 - cos(0.5 * x));
} // m; its steepest slope of 0.125 takes 1.6 kN of the motors' 2 kN
static double hills(double x, double z) { return (void)z, hill(x); }

// Ground for a car that drives along x, from 0 to 48, in the middle of z
static void add_field(scene *s, double height(double x, double z))
{
    static float heights[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; ++i)
        heights[i] = (float)height(CELL * (i % SIDE), CELL * (i / SIDE - (SIDE - 1) / 2));
    fe_heightfield_def field;
    fe_heightfield_def_init(&field, sizeof field);
    field.rows = field.columns = SIDE, field.cell_x = field.cell_z = (float)CELL, field.heights = heights;
    fe_asset asset;
    MUST(fe_heightfield_create(world_store(s->world), &field, &asset));
    fe_geometry form;
    fe_geometry_heightfield(&form, asset);
    add_body(s, FE_BODY_STATIC, form, v3(0, 0, -CELL * (SIDE - 1) / 2), UNTURNED, friction(0.8), WATER);
}

static void a_car_drives_over_hills_on_its_wheel_joints(void **state)
{
    scene s = scene_begin(state);
    car c;
    double highest = -1, lowest = 1e9;
    add_field(&s, hills);
    const double valley = 4 * PI;
    MUST(car_build(s.world, valley, 0.1, 0, &c));
    run(&s, 60);
    MUST(car_drive(s.world, &c, 6, 400, 0));
    for (int i = 0; i < 300; ++i) {
        run(&s, 1);
        FE_WITHIN(tilt(&s, c.chassis), 0, 30 * DEGREES);
        for (int k = 0; k < 4; ++k) {
            fe_joint_state at = state_of(&s, c.axles[k]);
            FE_WITHIN(at.linear_error, 0, 2 * LINEAR_SLOP); // across the suspension, and beyond its travel
            FE_WITHIN(at.translation.z, -0.25 - 2 * LINEAR_SLOP, 0.25 + 2 * LINEAR_SLOP);
            FE_WITHIN(position(&s, c.wheels[k]).y, hill(position(&s, c.wheels[k]).x) + 0.4 - 0.05,
                      3); // not in the ground
        }
        highest = fmax(highest, position(&s, c.chassis).y), lowest = fmin(lowest, position(&s, c.chassis).y);
    }
    // 1.28 t pulled by 2 x 400 N m / 0.4 m: 1.5 m/s2 up to 6 m/s on flat ground
    FE_WITHIN(position(&s, c.chassis).x - valley, 12, 30);
    FE_WITHIN(velocity(&s, c.chassis).x, 3, 7.5);
    FE_NEAR(position(&s, c.chassis).z, 0, 0.5); // straight on
    FE_WITHIN(highest - lowest, 0.3, 0.8);      // up and down hills of 0.5 m
    scene_end(&s);
}

// On its springs, not on their ends: each bears a quarter of the chassis
static void a_car_rests_on_its_springs(void **state)
{
    scene s = scene_begin(state);
    car c;
    add_ground(&s, friction(0.8));
    MUST(car_build(s.world, 0, 0.1, 0, &c));
    run(&s, 240);
    for (int k = 0; k < 4; ++k) {
        fe_configurable_joint_def d = {.struct_size = sizeof d};
        MUST(fe_configurable_joint_get(s.world, c.axles[k], &d));
        FE_NEAR(state_of(&s, c.axles[k]).translation.z,
                mass_of(&s, c.chassis) * G / 4 / (double)d.axes[FE_DOF_LINEAR_Z].spring_stiffness, LINEAR_SLOP);
    }
    scene_end(&s);
}

// Waves along and across, 0.4 m from trough to crest, for 48 m along x
static double wave(double x, double z) { return 0.1 * (sin(0.7 * x) + cos(0.9 * z)); }

// Straight on for 20 s over ground that lifts each wheel in its own time (B38)
static void a_car_on_waves_keeps_its_wheels_down(void **state)
{
    scene s = scene_begin(state);
    car c;
    add_field(&s, wave);
    MUST(car_build(s.world, 2, 0.3, 0, &c));
    run(&s, 60);
    MUST(car_drive(s.world, &c, 2, 400, 0));
    for (int i = 0; i < 1200; ++i) {
        run(&s, 1);
        FE_WITHIN(tilt(&s, c.chassis), 0, 30 * DEGREES);
        for (int k = 0; k < 4; ++k) FE_WITHIN(state_of(&s, c.axles[k]).linear_error, 0, 2 * LINEAR_SLOP);
    }
    FE_WITHIN(position(&s, c.chassis).x, 25, 46);
    scene_end(&s);
}

static void a_steered_car_turns_to_the_left_and_a_braked_one_stops(void **state)
{
    scene s = scene_begin(state);
    car c;
    add_ground(&s, friction(0.8));
    MUST(car_build(s.world, 0, 0.1, 0, &c));
    MUST(car_drive(s.world, &c, 6, 400, 0.3f));
    run(&s, 240);
    FE_WITHIN(velocity(&s, c.chassis).z, -10, -0.5); // y up, x ahead: left is -z
    MUST(car_drive(s.world, &c, 0, 1000, 0));
    run(&s, 240);
    FE_NEAR(length(velocity(&s, c.chassis)), 0, 0.05);
    scene_end(&s);
}

// sag^2 = 3/8 span x (length - span) of a chain that is a little longer than its span: by what its ropes have, and give
static void a_rope_bridge_hangs_by_its_ropes_and_bears_a_load(void **state)
{
    scene s = scene_begin(state);
    bridge b;
    const double rope = 0.06, room = 0.04, span = BRIDGE_PLANKS * 0.5;
    double slack = 0;
    MUST(bridge_build(s.world, 0, 5, 0, &b));
    run(&s, 600);
    for (int i = 0; i < 2 * (BRIDGE_PLANKS + 1); ++i) slack += ((double)state_of(&s, b.ropes[i]).length - room) / 2;
    FE_WITHIN(slack, (BRIDGE_PLANKS + 1) * (rope - room), (BRIDGE_PLANKS + 1) * (rope - room + 2 * LINEAR_SLOP));
    double sag = 5 - position(&s, b.planks[BRIDGE_PLANKS / 2]).y;
    FE_NEAR(sag, sqrt(3.0 / 8 * span * slack), 0.15 * sag);
    fe_body load =
        add_plain(&s, box(0.2, 0.2, 0.2), plus(position(&s, b.planks[BRIDGE_PLANKS / 2]), v3(0, 0.5, 0))); // 64 kg
    run(&s, 300);
    FE_NEAR(position(&s, load).x, span / 2, 1);
    FE_WITHIN(position(&s, load).y, 5 - 1.5 * sag, 5);
    for (int i = 0; i < 2 * (BRIDGE_PLANKS + 1); ++i)
        FE_WITHIN(state_of(&s, b.ropes[i]).length, 0, rope + 2 * LINEAR_SLOP);
    scene_end(&s);
}

static void a_door_is_flung_open_to_its_stop_and_closes(void **state)
{
    scene s = scene_begin(state);
    door d;
    double widest = 0;
    MUST(door_build(s.world, 0, 0, 0, &d));
    MUST(fe_body_set_sleep_allowed(s.world, d.leaf, 0)); // at a turning point it is slower than the threshold of sleep
    fe_vec3 push = {0, 0, 150};
    fe_dvec3 handle = {0.85, 1, 0};
    MUST(fe_body_add_impulse_at(s.world, d.leaf, &push, &handle));
    for (int i = 0; i < 600; ++i) {
        run(&s, 1);
        double angle = fabs((double)state_of(&s, d.hinges[0]).angle);
        widest = fmax(widest, angle);
        FE_WITHIN(angle, 0, 101 * DEGREES);
        FE_WITHIN(worst_gap(&s, d.hinges, 2), 0,
                  i < 60 ? 0.05 : LINEAR_SLOP); // the blow opens them, they close in 1 s (B27)
    }
    FE_WITHIN(widest, 90 * DEGREES, 101 * DEGREES);
    FE_NEAR(state_of(&s, d.hinges[0]).angle, 0, 1 * DEGREES);
    scene_end(&s);
}

static void a_crane_carries_a_thousand_times_the_weight_of_a_link(void **state)
{
    scene s = scene_begin(state);
    crane c;
    MUST(crane_build(s.world, 0, 12, 0, 1000, &c));
    FE_NEAR(mass_of(&s, c.load) / mass_of(&s, c.links[0]), 1000, 1e-3);
    fe_configurable_joint_def rail = {.struct_size = sizeof rail};
    MUST(fe_configurable_joint_get(s.world, c.winch, &rail));
    rail.axes[FE_DOF_LINEAR_X].target = 4;
    MUST(fe_configurable_joint_set(s.world, c.winch, &rail));
    double early = 0, late = 0;
    const int steps = SLOW_BUILD ? 600 : 1800;
    for (int i = 0; i < steps; ++i) {
        run(&s, 1);
        FE_WITHIN(worst_gap(&s, c.chain, CRANE_LINKS + 1), 0, LINEAR_SLOP);
        double v = length(velocity(&s, c.load));
        if (i < steps / 3) early = fmax(early, v);
        if (i >= steps - steps / 3) late = fmax(late, v);
    }
    FE_NEAR(position(&s, c.trolley).x, 4, 0.25);
    FE_NEAR(position(&s, c.load).x, 4, SLOW_BUILD ? 1.5 : 0.5);
    FE_WITHIN(late, 0, early);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_car_drives_over_hills_on_its_wheel_joints),
        WITH_4_SUBSTEPS(a_car_drives_over_hills_on_its_wheel_joints),
        TEST(a_car_rests_on_its_springs),
        TEST(a_car_on_waves_keeps_its_wheels_down),
        TEST(a_steered_car_turns_to_the_left_and_a_braked_one_stops),
        TEST(a_rope_bridge_hangs_by_its_ropes_and_bears_a_load),
        TEST(a_door_is_flung_open_to_its_stop_and_closes),
        TEST(a_crane_carries_a_thousand_times_the_weight_of_a_link),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
