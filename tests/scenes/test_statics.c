// What rests: forces by statics, overlaps by the fixed point of a soft contact (P1: load / (effective mass w^2), w = 2
// pi 30/s, twice that against a static body). The effective mass of a contact point: 1 / (1/m + (r x n) . I^-1 (r x
// n)), summed over the bodies that move.
#include "scene.h"

static const double SINGLE = 0.05,
                    STACK =
                        0.2; // what P1 may be off by, relative: one body; what the bodies of a stack do to each other

// ---- one body on the ground ----------------------------------------------------------------------------------------

static void a_sphere_sinks_by_the_predicted_overlap(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    fe_body ball = add_dynamic(&s, sphere(0.5), v3(0, 0.5, 0), UNTURNED, friction(0.6), WATER);
    run(&s, 120);
    double m = mass_of(&s, ball), predicted = sink(m * G, m, 1);
    FE_NEAR(0.5 - position(&s, ball).y, predicted, SINGLE * predicted);
    scene_end(&s);
}

// four corners carry a quarter each
static void a_box_sinks_by_the_predicted_overlap(void **state)
{
    scene s = scene_begin(state);
    const double x = 0.5, y = 0.2, z = 0.3;
    add_ground(&s, friction(0.6));
    fe_body block = add_dynamic(&s, box(x, y, z), v3(0, y, 0), UNTURNED, friction(0.6), WATER);
    run(&s, 120);
    double m = WATER * 8 * x * y * z, about_x = m / 3 * (y * y + z * z), about_z = m / 3 * (x * x + y * y);
    double predicted = sink(m * G / 4, 1 / (1 / m + z * z / about_x + x * x / about_z), 1);
    FE_NEAR(y - position(&s, block).y, predicted, SINGLE * predicted);
    FE_WITHIN(tilt(&s, block), 0, SINGLE * predicted / z);
    scene_end(&s);
}

// both ends of the axis carry a half each
static void a_capsule_on_its_side_sinks_by_the_predicted_overlap(void **state)
{
    scene s = scene_begin(state);
    const double half = 0.5, r = 0.3;
    add_ground(&s, friction(0.6));
    fe_body pill = add_dynamic(&s, capsule(half, r), v3(0, r, 0), turned(v3(0, 0, 1), PI / 2), friction(0.6), WATER);
    run(&s, 120);
    double m = mass_of(&s, pill), across = (double)mass_data_of(&s, pill).inertia.x;
    double predicted = sink(m * G / 2, 1 / (1 / m + half * half / across), 1);
    FE_NEAR(r - position(&s, pill).y, predicted, SINGLE * predicted);
    FE_NEAR(length(v3(position(&s, pill).x, 0, position(&s, pill).z)), 0, predicted);
    scene_end(&s);
}

// ---- stacks --------------------------------------------------------------------------------------------------------

enum { HIGHEST = 10 };

// `count` bodies of 1 m on a static floor of 10 m
static fe_body build_stack(scene *s, fe_geometry form, int count, fe_body *bodies)
{
    fe_body floor = add_static(s, box(5, 0.5, 5), v3(0, -0.5, 0), UNTURNED, friction(0.6));
    for (int i = 0; i < count; ++i) bodies[i] = add_dynamic(s, form, v3(0, 0.5 + i, 0), UNTURNED, friction(0.6), WATER);
    run(s, 300);
    return floor;
}

// The interface below k bodies carries k m g. Of a cube: four corners of m / 8 each between two cubes, of m / 4 each on
// the ground. Of a sphere: one point of m / 2, and of m. So both give by 2 k g / w^2, and by n g / (2 w)^2 on the
// ground.
static void check_sinks(const scene *s, const fe_body *bodies, int count)
{
    double below = sink(count * G, 1, 1), sunk = below;
    FE_NEAR(0.5 - position(s, bodies[0]).y, below, STACK * below);
    for (int i = 1; i < count; ++i) {
        double give = sink(2 * (count - i) * G, 1, 0);
        sunk += give;
        FE_NEAR(1 - (position(s, bodies[i]).y - position(s, bodies[i - 1]).y), give, STACK * give);
    }
    FE_NEAR(count - 0.5 - position(s, bodies[count - 1]).y, sunk, STACK * sunk);
}

static void a_stack_of_cubes_sinks_by_the_predicted_overlaps(void **state)
{
    scene s = scene_begin(state);
    fe_body cubes[HIGHEST];
    build_stack(&s, box(0.5, 0.5, 0.5), 5, cubes);
    check_sinks(&s, cubes, 5);
    scene_end(&s);
}

static void a_column_of_spheres_sinks_by_the_predicted_overlaps(void **state)
{
    scene s = scene_begin(state);
    fe_body balls[HIGHEST];
    build_stack(&s, sphere(0.5), HIGHEST, balls);
    check_sinks(&s, balls, HIGHEST);
    scene_end(&s);
}

// Impulses over one step: interface k carries k m g dt
static void each_interface_of_a_stack_carries_what_is_above_it(void **state)
{
    scene s = scene_begin(state);
    fe_body cubes[HIGHEST], floor = build_stack(&s, box(0.5, 0.5, 0.5), 5, cubes);
    double weight = mass_of(&s, cubes[0]) * G * STEP;
    FE_NEAR(normal_impulse(&s, cubes[0], floor), 5 * weight, 0.005 * 5 * weight);
    for (int i = 1; i < 5; ++i)
        FE_NEAR(normal_impulse(&s, cubes[i], cubes[i - 1]), (5 - i) * weight, 0.005 * (5 - i) * weight);
    scene_end(&s);
}

// ... and the ground all of a pyramid, whatever way its weight takes
static void the_ground_carries_the_weight_of_a_pyramid(void **state)
{
    enum { ROWS = 5 };
    scene s = scene_begin(state);
    fe_body ground = add_ground(&s, friction(0.6)), bottom[ROWS];
    double weight = 0, carried = 0;
    for (int row = 0; row < ROWS; ++row)
        for (int i = 0; i < ROWS - row; ++i) {
            fe_body cube = add_dynamic(&s, box(0.25, 0.25, 0.25), v3(0.5 * i + 0.25 * row, 0.25 + 0.5 * row, 0),
                                       UNTURNED, friction(0.6), WATER);
            weight += mass_of(&s, cube) * G * STEP;
            if (row == 0) bottom[i] = cube;
        }
    run(&s, 300);
    for (int i = 0; i < ROWS; ++i) carried += normal_impulse(&s, bottom[i], ground);
    FE_NEAR(carried, weight, 0.005 * weight);
    scene_end(&s);
}

// ---- two supports --------------------------------------------------------------------------------------------------

// A smooth sphere between two planes at `angle` from the vertical: each carries N = m g / (2 sin angle) and gives by P1
static void a_sphere_in_a_groove_is_carried_by_both_sides(void **state)
{
    for (int degrees = 20; degrees <= 80; degrees += 15) {
        scene s = scene_begin(state);
        double angle = degrees * DEGREES, r = 0.5;
        fe_body left = add_plane(&s, v3(cos(angle), sin(angle), 0), 0, friction(0));
        fe_body right = add_plane(&s, v3(-cos(angle), sin(angle), 0), 0, friction(0));
        fe_body ball = add_dynamic(&s, sphere(r), v3(0, r / sin(angle), 0), UNTURNED, friction(0), WATER);
        run(&s, 120);
        double m = mass_of(&s, ball), load = m * G / (2 * sin(angle)), predicted = sink(load, m, 1);
        FE_NEAR(normal_impulse(&s, ball, left) / STEP, load, 0.01 * load);
        FE_NEAR(normal_impulse(&s, ball, right) / STEP, load, 0.01 * load);
        FE_NEAR(r - sin(angle) * position(&s, ball).y, predicted, SINGLE * predicted);
        FE_NEAR(hypot(position(&s, ball).x, position(&s, ball).z), 0, SINGLE * predicted);
        FE_NEAR(length(spin(&s, ball)), 0, rounding(120 * s.substeps));
        scene_end(&s);
    }
}

// Rough sides may carry a part by friction, but nothing moves. Along the groove the ball rolls freely, and a float's
// rounding (6e-8) is all that keeps gravity square to it: g t^2 / 2 of that.
static void a_sphere_in_a_rough_groove_neither_drifts_nor_spins(void **state)
{
    scene s = scene_begin(state);
    double angle = 40 * DEGREES, r = 0.5;
    add_plane(&s, v3(cos(angle), sin(angle), 0), 0, friction(0.6));
    add_plane(&s, v3(-cos(angle), sin(angle), 0), 0, friction(0.6));
    fe_body ball = add_dynamic(&s, sphere(r), v3(0, r / sin(angle), 0), UNTURNED, friction(0.6), WATER);
    run(&s, 60);
    vec start = position(&s, ball), mark = axis_of(&s, ball, v3(1, 0, 0));
    run(&s, 600);
    double still = 6e-8 * discrete_way(G, 600 * STEP, s.h);
    FE_NEAR(length(minus(position(&s, ball), start)), 0, still);
    FE_NEAR(between(axis_of(&s, ball, v3(1, 0, 0)), mark), 0, still / r);
    scene_end(&s);
}

// A beam on two round supports at -a and b of its centre: they carry m g b / (a + b) and m g a / (a + b)
static void a_beam_loads_its_supports_by_the_lever_rule(void **state)
{
    const double a = 0.5, spread[] = {0.5, 0.75, 1.2};
    for (int i = 0; i < 3; ++i) {
        scene s = scene_begin(state);
        double b = spread[i];
        fe_quat across = turned(v3(1, 0, 0), PI / 2);
        fe_body left = add_static(&s, capsule(0.5, 0.1), v3(-a, 0, 0), across, friction(0.6));
        fe_body right = add_static(&s, capsule(0.5, 0.1), v3(b, 0, 0), across, friction(0.6));
        fe_body beam = add_dynamic(&s, box(1.5, 0.1, 0.4), v3(0, 0.2, 0), UNTURNED, friction(0.6), WATER);
        run(&s, 180);
        double weight = mass_of(&s, beam) * G;
        FE_NEAR(normal_impulse(&s, beam, left) / STEP, weight * b / (a + b), 0.01 * weight * b / (a + b));
        FE_NEAR(normal_impulse(&s, beam, right) / STEP, weight * a / (a + b), 0.01 * weight * a / (a + b));
        scene_end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        EVERY_WAY_UP(a_sphere_sinks_by_the_predicted_overlap),
        WITH_4_SUBSTEPS(a_sphere_sinks_by_the_predicted_overlap),
        EVERY_WAY_UP(a_box_sinks_by_the_predicted_overlap),
        WITH_4_SUBSTEPS(a_box_sinks_by_the_predicted_overlap),
        EVERY_WAY_UP(a_capsule_on_its_side_sinks_by_the_predicted_overlap),
        WITH_4_SUBSTEPS(a_capsule_on_its_side_sinks_by_the_predicted_overlap),
        EVERY_WAY_UP(a_stack_of_cubes_sinks_by_the_predicted_overlaps),
        WITH_4_SUBSTEPS(a_stack_of_cubes_sinks_by_the_predicted_overlaps),
        TEST(a_column_of_spheres_sinks_by_the_predicted_overlaps),
        WITH_4_SUBSTEPS(a_column_of_spheres_sinks_by_the_predicted_overlaps),
        EVERY_WAY_UP(each_interface_of_a_stack_carries_what_is_above_it),
        EVERY_WAY_UP(the_ground_carries_the_weight_of_a_pyramid),
        EVERY_WAY_UP(a_sphere_in_a_groove_is_carried_by_both_sides),
        EVERY_WAY_UP(a_sphere_in_a_rough_groove_neither_drifts_nor_spins),
        EVERY_WAY_UP(a_beam_loads_its_supports_by_the_lever_rule),
    };
    return cmocka_run_group_tests_name("statics", tests, NULL, NULL);
}
