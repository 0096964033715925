// Rolling and spinning on planes: accelerations of round bodies, the change from sliding to rolling, resistances, the
// twist of a flat contact.
#include "scene.h"

static const double LAW = 0.01,
                    CAP = 0.02; // what may be off, relative: a law of motion; one that is ended by a cap on a torque

// ---- down a slope --------------------------------------------------------------------------------------------------

// way down the slope in the first 2 s, m
static double way_down(scene *s, fe_body body, double angle)
{
    vec start = position(s, body);
    run(s, 120);
    return dot(minus(position(s, body), start), downhill(angle));
}

// a = 5/7 g sin, and w r = v
static void a_sphere_rolls_down_with_five_sevenths(void **state)
{
    scene s = scene_begin(state);
    double angle = 20 * DEGREES, r = 0.5, way = discrete_way(5.0 / 7 * G * sin(angle), 2, s.h);
    add_slope(&s, angle, friction(0.6));
    fe_body ball = add_dynamic(&s, sphere(r), times(r, slope_normal(angle)), UNTURNED, friction(0.6), WATER);
    FE_NEAR(way_down(&s, ball, angle), way, LAW * way);
    double v = length(velocity(&s, ball));
    FE_NEAR(spin(&s, ball).z * r, v, LAW * v);
    FE_NEAR(dot(position(&s, ball), slope_normal(angle)), r, LINEAR_SLOP);
    FE_NEAR(position(&s, ball).z, 0, LINEAR_SLOP);
    scene_end(&s);
}

// mu < 2/7 tan: a = g (sin - mu cos), w' = 5 mu g cos / (2 r)
static void a_sphere_on_little_friction_slips_and_turns_slower(void **state)
{
    scene s = scene_begin(state);
    double angle = 20 * DEGREES, r = 0.5, mu = 0.05, way = discrete_way(G * (sin(angle) - mu * cos(angle)), 2, s.h);
    add_slope(&s, angle, friction(mu));
    fe_body ball = add_dynamic(&s, sphere(r), times(r, slope_normal(angle)), UNTURNED, friction(mu), WATER);
    double w = 5 * mu * G * cos(angle) / (2 * r) * 120 * STEP;
    FE_NEAR(way_down(&s, ball, angle), way, LAW * way);
    FE_NEAR(spin(&s, ball).z, w, LAW * w);
    scene_end(&s);
}

// a = g sin / (1 + I / (m r^2)), with the moments of a cylinder and two half balls
static void a_capsule_rolls_on_its_side_by_its_moment(void **state)
{
    scene s = scene_begin(state);
    const double angle = 20 * DEGREES, half = 0.6, r = 0.3, cylinder = WATER * PI * r * r * 2 * half,
                 ball = WATER * 4.0 / 3 * PI * r * r * r;
    double mass = cylinder + ball, axial = cylinder * r * r / 2 + ball * 2.0 / 5 * r * r;
    double ends = ball * (2.0 / 5 * r * r + half * half + 3.0 / 4 * half * r),
           across = cylinder * (r * r / 4 + half * half / 3) + ends;
    add_slope(&s, angle, friction(0.6));
    fe_body pill = add_dynamic(&s, capsule(half, r), times(r, slope_normal(angle)), turned(v3(1, 0, 0), PI / 2),
                               friction(0.6), WATER);
    fe_mass_data data = mass_data_of(&s, pill);
    FE_NEAR(data.mass, mass, 1e-6 * mass);
    FE_NEAR(data.inertia.y, axial, 1e-6 * axial);
    FE_NEAR(data.inertia.x, across, 1e-6 * across);
    double way = discrete_way(G * sin(angle) / (1 + axial / (mass * r * r)), 2, s.h);
    FE_NEAR(way_down(&s, pill, angle), way, LAW * way);
    FE_NEAR(dot(position(&s, pill), slope_normal(angle)), r, LINEAR_SLOP);
    FE_NEAR(between(axis_of(&s, pill, v3(0, 1, 0)), v3(0, 0, 1)), 0, LINEAR_SLOP / half);
    scene_end(&s);
}

// ---- on the level --------------------------------------------------------------------------------------------------

// It slides for 2 v0 / (7 mu g) and 12 v0^2 / (49 mu g), then rolls with 5/7 v0, for ever
static void a_sliding_sphere_ends_rolling_with_five_sevenths(void **state)
{
    scene s = scene_begin(state);
    const double r = 0.5, mu = 0.2, v0 = 5, v = 5.0 / 7 * v0, t = 2 * v0 / (7 * mu * G),
                 way = 12 * v0 * v0 / (49 * mu * G);
    add_ground(&s, friction(mu));
    fe_body ball = add_dynamic(&s, sphere(r), v3(0, r, 0), UNTURNED, friction(mu), WATER);
    set_velocity(&s, ball, v3(v0, 0, 0), v3(0, 0, 0));
    int early = (int)(0.9 * t / STEP), late = 60;
    run(&s, early);
    FE_NEAR(velocity(&s, ball).x, v0 - mu * G * early * STEP, LAW * v0);
    run(&s, late - early);
    FE_NEAR(velocity(&s, ball).x, v, LAW * v);
    FE_NEAR(-spin(&s, ball).z * r, v, LAW * v);
    FE_NEAR(position(&s, ball).x, way + v * (late * STEP - t), LAW * way);
    run(&s, 600);
    FE_NEAR(velocity(&s, ball).x, v, LAW * v);
    FE_NEAR(position(&s, ball).y, r, LINEAR_SLOP);
    FE_NEAR(position(&s, ball).z, 0, LINEAR_SLOP);
    scene_end(&s);
}

// The contact follows the round side: at 10 m/s a point fixed on it would leave the ground by 27 mm in a step. Overlap
// by P1, 5 % of it.
static void check_fast_roll(scene *s, fe_body body, double r, double predicted)
{
    double v0 = 10;
    set_velocity(s, body, v3(v0, 0, 0), v3(0, 0, -v0 / r));
    run(s, 60);
    for (int i = 0; i < 120; ++i) {
        run(s, 1);
        FE_NEAR(r - position(s, body).y, predicted, 0.05 * predicted);
    }
    FE_NEAR(velocity(s, body).x, v0, 0.001 * v0);
    FE_NEAR(position(s, body).z, 0, LINEAR_SLOP);
}

static void what_rolls_fast_keeps_its_height_and_its_speed(void **state)
{
    const double r = 0.5, half = 0.4;
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    fe_body ball = add_dynamic(&s, sphere(r), v3(0, r, 0), UNTURNED, friction(0.6), WATER);
    check_fast_roll(&s, ball, r, sink(G, 1, 1));
    scene_end(&s);

    s = scene_begin(state);
    add_ground(&s, friction(0.6));
    fe_body pill = add_dynamic(&s, capsule(half, r), v3(0, r, 0), turned(v3(1, 0, 0), PI / 2), friction(0.6), WATER);
    double m = mass_of(&s, pill), across = (double)mass_data_of(&s, pill).inertia.x;
    check_fast_roll(&s, pill, r, sink(m * G / 2, 1 / (1 / m + half * half / across), 1));
    scene_end(&s);
}

// A ball on a slab that moves with a under it: friction F = m a_ball turns it by F r = 2/5 m r^2 w', and  a_ball + w' r
// = a, so that a_ball = 2/7 a. It stands on the slab by P1. Either may be the contact's first body: the one created
// first.
static void a_ball_on_a_pulled_slab_follows_with_two_sevenths(void **state)
{
    for (int ball_first = 0; ball_first < 2; ++ball_first) {
        scene s = scene_begin(state);
        const double r = 0.25, pull = 1;
        vec ahead = v3(0.6, 0, -0.8);
        fe_body ball = 0, slab;
        add_ground(&s, friction(0));
        if (ball_first) ball = add_dynamic(&s, sphere(r), v3(0, 0.5 + r, 0), UNTURNED, friction(0.6), WATER);
        slab = add_dynamic(&s, box(4, 0.25, 4), v3(0, 0.25, 0), UNTURNED, friction(0.6), 100);
        if (!ball_first) ball = add_dynamic(&s, sphere(r), v3(0, 0.5 + r, 0), UNTURNED, friction(0.6), WATER);
        double m = mass_of(&s, ball), mass = mass_of(&s, slab), force = (mass + 2.0 / 7 * m) * pull;
        for (int i = 0; i < 90; ++i) {
            add_force(&s, slab, times(force, ahead));
            run(&s, 1);
        }
        double v = pull * 90 * STEP, predicted = sink(m * G, 1 / (1 / m + 1 / mass), 0);
        FE_NEAR(length(minus(velocity(&s, slab), times(v, ahead))), 0, LAW * v);
        FE_NEAR(length(minus(velocity(&s, ball), times(2.0 / 7 * v, ahead))), 0, LAW * 2.0 / 7 * v);
        FE_NEAR(0.25 + r - (position(&s, ball).y - position(&s, slab).y), predicted, 0.05 * predicted);
        scene_end(&s);
    }
}

// ---- rolling resistance ---------------------------------------------------------------------------------------------
// Its torque is at most c r N: a rolling sphere slows with 5/7 c g, and holds on a slope up to tan(angle) = c

static fe_material rolling(double c)
{
    fe_material material = friction(0.6);
    material.rolling_resistance = (float)c;
    return material;
}

static void a_rolling_sphere_stops_by_its_rolling_resistance(void **state)
{
    scene s = scene_begin(state);
    const double r = 0.5, c = 0.05, v0 = 3, way = 7 * v0 * v0 / (10 * c * G), time = 7 * v0 / (5 * c * G);
    add_ground(&s, friction(0.6));
    fe_body ball = add_dynamic(&s, sphere(r), v3(0, r, 0), UNTURNED, rolling(c), WATER);
    set_velocity(&s, ball, v3(v0, 0, 0), v3(0, 0, -v0 / r));
    run(&s, (int)(time / 2 / STEP));
    FE_NEAR(velocity(&s, ball).x, v0 / 2, CAP * v0 / 2);
    run(&s, (int)((1 + CAP) * time / STEP) - (int)(time / 2 / STEP));
    FE_NEAR(position(&s, ball).x, way, CAP * way);
    vec stop = position(&s, ball);
    run(&s, 120);
    FE_NEAR(length(minus(position(&s, ball), stop)), 0, 2 * STEP * LINEAR_SLOP);
    scene_end(&s);
}

static void rolling_resistance_holds_a_sphere_up_to_its_slope(void **state)
{
    const double share[] = {0.95, 1.05};
    for (int i = 0; i < 2; ++i) {
        scene s = scene_begin(state);
        const double r = 0.5, c = 0.1, angle = atan(share[i] * c);
        add_slope(&s, angle, friction(0.6));
        fe_body ball = add_dynamic(&s, sphere(r), times(r, slope_normal(angle)), UNTURNED, rolling(c), WATER);
        double way = way_down(&s, ball, angle), free = 5.0 / 7 * G * (sin(angle) - c * cos(angle));
        if (i == 0) FE_NEAR(way, 0, LINEAR_SLOP);
        if (i == 1) FE_NEAR(way, discrete_way(free, 2, s.h), CAP * 5.0 / 7 * G * sin(angle) * 2);
        scene_end(&s);
    }
}

// ---- about the normal ----------------------------------------------------------------------------------------------

// Its torque is at most s N: t = 2 r^2 w0 / (5 s g). It stays where it is, but for what the rounding of its spin gives
// it to roll with.
static void a_spinning_sphere_stops_by_its_spinning_resistance(void **state)
{
    scene s = scene_begin(state);
    const double r = 0.5, w0 = 20, cap = 0.01, time = 2 * r * r * w0 / (5 * cap * G);
    fe_material material = friction(0.6);
    material.spinning_resistance = (float)cap;
    add_ground(&s, friction(0.6));
    fe_body ball = add_dynamic(&s, sphere(r), v3(0, r, 0), UNTURNED, material, WATER);
    set_velocity(&s, ball, v3(0, 0, 0), v3(0, w0, 0));
    run(&s, (int)((1 - CAP) * time / STEP));
    FE_WITHIN(spin(&s, ball).y, 0.001 * w0, 2 * CAP * w0);
    run(&s, (int)(2 * CAP * time / STEP));
    double noise = w0 * rounding(time / s.h);
    FE_NEAR(length(spin(&s, ball)), 0, noise);
    FE_NEAR(length(velocity(&s, ball)), 0, r * noise);
    scene_end(&s);
}

// On a slab that may turn, the spin is only handed over: both end with  I w0 / (I + J)
static void spinning_resistance_hands_the_spin_to_a_free_slab(void **state)
{
    scene s = scene_begin(state);
    const double r = 0.5, w0 = 20;
    fe_material material = friction(0.6);
    material.spinning_resistance = 0.1f;
    add_ground(&s, friction(0));
    fe_body slab = add_dynamic(&s, box(1, 0.1, 1), v3(0, 0.1, 0), UNTURNED, friction(0.6), WATER);
    fe_body ball = add_dynamic(&s, sphere(r), v3(0, 0.2 + r, 0), UNTURNED, material, WATER);
    double of_ball = 0.4 * mass_of(&s, ball) * r * r, of_slab = mass_of(&s, slab) * 2.0 / 3,
           common = w0 * of_ball / (of_ball + of_slab);
    set_velocity(&s, ball, v3(0, 0, 0), v3(0, w0, 0));
    run(&s, 30);
    double given = 0.1 * mass_of(&s, ball) * G * 30 * STEP;
    FE_NEAR(spin(&s, slab).y, given / of_slab, CAP * given / of_slab);
    FE_NEAR(spin(&s, ball).y, w0 - given / of_ball, CAP * w0);
    run(&s, 150);
    FE_NEAR(spin(&s, slab).y, common, CAP * common);
    FE_NEAR(spin(&s, ball).y, common, CAP * common);
    scene_end(&s);
}

static void a_sphere_without_spinning_resistance_spins_for_ever(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    fe_body ball = add_dynamic(&s, sphere(0.5), v3(0, 0.5, 0), UNTURNED, friction(0.6), WATER);
    set_velocity(&s, ball, v3(0, 0, 0), v3(0, 20, 0));
    run(&s, 600);
    FE_NEAR(spin(&s, ball).y, 20, 20 * rounding(600 * s.substeps));
    scene_end(&s);
}

// A cube of half edge a on its four corners, at a sqrt(2) from the axis: w' = mu m g a sqrt(2) / I = 2.1213 mu g / a
static fe_body add_spinning_cube(scene *s, double a, double mu, vec linear, double w)
{
    add_ground(s, friction(mu));
    fe_body cube = add_dynamic(s, box(a, a, a), v3(0, a, 0), UNTURNED, friction(mu), WATER);
    set_velocity(s, cube, linear, v3(0, w, 0));
    return cube;
}

static void a_cube_spinning_on_its_face_is_braked_by_its_corners(void **state)
{
    scene s = scene_begin(state);
    const double a = 0.5, mu = 0.5, slowing = 1.5 * sqrt(2) * mu * G / a; // stops after 1 s
    fe_body cube = add_spinning_cube(&s, a, mu, v3(0, 0, 0), slowing);
    run(&s, 30);
    FE_NEAR(spin(&s, cube).y, slowing / 2, CAP * slowing / 2);
    run(&s, 28);
    FE_WITHIN(spin(&s, cube).y, 0, 2 * CAP * slowing);
    FE_TRUE(spin(&s, cube).y > 0.01 * slowing);
    run(&s, 4);
    FE_NEAR(length(spin(&s, cube)), 0, 1e-3);
    FE_NEAR(length(minus(position(&s, cube), v3(0, a, 0))), 0, LINEAR_SLOP);
    scene_end(&s);
}

// Friction acts at the centre and as a twist: each brakes as if it were alone, v = v0 - mu g t, w = w0 - w' t, straight
// ahead
static void sliding_and_spinning_brake_apart_from_each_other(void **state)
{
    scene s = scene_begin(state);
    const double a = 0.5, mu = 0.5, slowing = 1.5 * sqrt(2) * mu * G / a, t = 18 * STEP;
    fe_body cube = add_spinning_cube(&s, a, mu, v3(3 * 0.6, 0, 3 * 0.8), 15);
    run(&s, 18);
    double v = 3 - mu * G * t, w = 15 - slowing * t;
    FE_NEAR(dot(velocity(&s, cube), v3(0.6, 0, 0.8)), v, CAP * v);
    FE_NEAR(dot(velocity(&s, cube), v3(-0.8, 0, 0.6)), 0, CAP * v);
    FE_NEAR(spin(&s, cube).y, w, CAP * w);
    run(&s, 60);
    FE_NEAR(length(velocity(&s, cube)), 0, 1e-3);
    FE_NEAR(length(spin(&s, cube)), 0, 1e-3);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        EVERY_WAY_UP(a_sphere_rolls_down_with_five_sevenths),
        EVERY_WAY_UP(a_sphere_on_little_friction_slips_and_turns_slower),
        EVERY_WAY_UP(a_capsule_rolls_on_its_side_by_its_moment),
        EVERY_WAY_UP(a_sliding_sphere_ends_rolling_with_five_sevenths),
        EVERY_WAY_UP(a_rolling_sphere_stops_by_its_rolling_resistance),
        EVERY_WAY_UP(what_rolls_fast_keeps_its_height_and_its_speed),
        EVERY_WAY_UP(a_ball_on_a_pulled_slab_follows_with_two_sevenths),
        EVERY_WAY_UP(rolling_resistance_holds_a_sphere_up_to_its_slope),
        EVERY_WAY_UP(a_spinning_sphere_stops_by_its_spinning_resistance),
        EVERY_WAY_UP(spinning_resistance_hands_the_spin_to_a_free_slab),
        EVERY_WAY_UP(a_sphere_without_spinning_resistance_spins_for_ever),
        EVERY_WAY_UP(a_cube_spinning_on_its_face_is_braked_by_its_corners),
        EVERY_WAY_UP(sliding_and_spinning_brake_apart_from_each_other),
    };
    return cmocka_run_group_tests_name("rolling", tests, NULL, NULL);
}
