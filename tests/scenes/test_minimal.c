// Minimal scenes: one mechanism each, against what it must do.
#include "scenes/mechanics.h"

#include <string.h>

static fe_geometry cube(void) { return box(0.5, 0.5, 0.5); }

static fe_body add_kinematic(scene *s, fe_geometry form, vec at, fe_material material)
{
    return add_body(s, FE_BODY_KINEMATIC, form, at, UNTURNED, material, WATER);
}

static fe_shape shape_of(const scene *s, fe_body body)
{
    fe_shape shape = 0;
    FE_TRUE(fe_body_get_shapes(s->world, body, &shape, 1) == 1);
    return shape;
}

// ---- kinematic bodies ----------------------------------------------------------------------------------------------

// A platform takes its box along: up and down at once, sideways while the friction can: mu g = 5.9 m/s2.
static void a_platform_carries_a_box(void **state)
{
    static const vec ways[] = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}};
    for (int i = 0; i < 4; ++i) {
        scene s = scene_begin(state);
        fe_body platform = add_kinematic(&s, box(3, 0.25, 3), v3(0, -0.25, 0), friction(0.6));
        fe_body body = add_dynamic(&s, cube(), v3(0, 0.5, 0), UNTURNED, friction(0.6), WATER);
        run(&s, 30);
        double speed = 0;
        for (int k = 0; k < 90; ++k) {
            speed = fmin(speed + 2 * STEP, 1); // 2 m/s2, then steady
            set_velocity(&s, platform, times(speed, ways[i]), v3(0, 0, 0));
            run(&s, 1);
        }
        vec apart = minus(position(&s, body), position(&s, platform));
        FE_NEAR(apart.x, 0, LINEAR_SLOP);
        FE_NEAR(apart.y, 0.75, LINEAR_SLOP);
        FE_NEAR(apart.z, 0, LINEAR_SLOP);
        FE_NEAR(length(minus(velocity(&s, body), times(speed, ways[i]))), 0, 0.01);
        // the platform itself is moved by nothing but its velocity
        FE_NEAR(length(minus(velocity(&s, platform), times(speed, ways[i]))), 0, 1e-6);
        scene_end(&s);
    }
}

// A turntable takes its box round: v = w r, held inwards by friction while w^2 r < mu g. Friction holds it to the arc
// of the surface, not to its tangent, so that it keeps its radius (tests/laws/test_turntable draws riders and tables).
static void a_turntable_takes_a_box_round(void **state)
{
    scene s = scene_begin(state);
    fe_body table = add_kinematic(&s, box(3, 0.25, 3), v3(0, -0.25, 0), friction(0.6));
    fe_body body = add_dynamic(&s, cube(), v3(2, 0.5, 0), UNTURNED, friction(0.6), WATER);
    double w = 0;
    for (int k = 0; k < 240; ++k) {
        w = fmin(w + 0.5 * STEP, 1);
        set_velocity(&s, table, v3(0, 0, 0), v3(0, w, 0));
        run(&s, 1);
    }
    vec at = position(&s, body), v = velocity(&s, body);
    FE_NEAR(hypot(at.x, at.z), 2, 1e-3);
    FE_NEAR(length(minus(v, cross(v3(0, 1, 0), at))), 0, 3 * s.h); // the velocity of the substep's start
    FE_NEAR(spin(&s, body).y, 1, 0.01);
    scene_end(&s);
}

// set_target brings the body there in the time given, and it stays there.
static void a_target_is_reached_in_time(void **state)
{
    scene s = scene_begin(state);
    fe_body body = add_kinematic(&s, cube(), v3(1, 2, 3), friction(0.6));
    fe_transform target = {to_world(&s, v3(2, 1, 5)), compose(s.turn, turned(v3(1, 2, -1), 100 * DEGREES))};
    // 30 steps of 1/60 s; each goes on from where the last one left
    for (int k = 30; k > 0; --k) {
        MUST(fe_body_set_target(s.world, body, &target, (float)k * DT));
        run(&s, 1);
    }
    FE_NEAR(length(minus(position(&s, body), v3(2, 1, 5))), 0, 1e-5);
    fe_quat q = compose(inverse(target.rotation), body_transform(s.world, body).rotation);
    FE_NEAR(length(v3(q.x, q.y, q.z)), 0, 1e-5);
    scene_end(&s);
}

// ---- surfaces ------------------------------------------------------------------------------------------------------

// A belt that runs at 2 m/s brings a box to 2 m/s, by mu g on the way; its own body stands.
static void a_conveyor_brings_a_box_to_its_speed(void **state)
{
    for (int type = FE_BODY_STATIC; type <= FE_BODY_KINEMATIC; ++type) {
        scene s = scene_begin(state);
        fe_body belt = add_body(&s, type, box(30, 0.25, 2), v3(0, -0.25, 0), UNTURNED, friction(0.5), WATER);
        fe_vec3 surface = {2, 0, 0};
        MUST(fe_shape_set_surface_velocity(s.world, shape_of(&s, belt), &surface));
        fe_body body = add_dynamic(&s, box(0.5, 0.25, 0.5), v3(-5, 0.25, 0), UNTURNED, friction(0.5), WATER);
        run(&s, 12);
        FE_NEAR(velocity(&s, body).x, 0.5 * G * 12 * STEP, 0.02 * 0.5 * G * 12 * STEP);
        run(&s, 108);
        FE_NEAR(velocity(&s, body).x, 2, 0.01);
        FE_NEAR(velocity(&s, body).z, 0, 0.01);
        FE_NEAR(position(&s, body).y, 0.25, LINEAR_SLOP);
        FE_NEAR(length(minus(position(&s, belt), v3(0, -0.25, 0))), 0, 0);
        scene_end(&s);
    }
}

// A box that is a belt itself drives off on a still ground: the other way.
static void a_running_belt_drives_its_own_body(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.5));
    fe_body body = add_dynamic(&s, box(0.5, 0.25, 0.5), v3(0, 0.25, 0), UNTURNED, friction(0.5), WATER);
    fe_vec3 surface = {1, 0, 0};
    MUST(fe_shape_set_surface_velocity(s.world, shape_of(&s, body), &surface));
    run(&s, 120);
    FE_NEAR(velocity(&s, body).x, -1, 0.01);
    scene_end(&s);
}

// sqrt(a b): a frictionless side makes a frictionless pair, and sticking takes more than sliding (V11)
static void a_contact_sticks_by_static_and_slides_by_dynamic_friction(void **state)
{
    scene s = scene_begin(state);
    fe_material rough = SURFACE(0.8f, 0.2f, 0, 0, 0), mixed = SURFACE(0.45f, 0.2f, 0, 0, 0); // sqrt(0.8 0.45) = 0.6
    add_ground(&s, rough);
    fe_body body = add_dynamic(&s, box(0.5, 0.05, 0.5), v3(0, 0.05, 0), UNTURNED, mixed, 100);
    double weight = mass_of(&s, body) * G;
    run(&s, 30);
    for (int k = 0; k < 60; ++k) {
        add_force(&s, body, v3(0.57 * weight, 0, 0));
        run(&s, 1);
    }
    FE_NEAR(position(&s, body).x, 0, LINEAR_SLOP);
    for (int k = 0; k < 12; ++k) {
        add_force(&s, body, v3(0.63 * weight, 0, 0));
        run(&s, 1);
    }
    double speed = velocity(&s, body).x;
    for (int k = 0; k < 30; ++k) {
        add_force(&s, body, v3(0.57 * weight, 0, 0));
        run(&s, 1);
    }
    // it slides now: a = (0.57 - 0.2) g
    FE_NEAR(velocity(&s, body).x - speed, 0.37 * G * 30 * STEP, 0.02 * 0.37 * G * 30 * STEP);
    scene_end(&s);
}

// ---- settings that change ------------------------------------------------------------------------------------------

// A stack at rest stays at rest when the substeps and the step change: stored impulses are per substep, and are
// rescaled.
static void substeps_and_steps_may_change_under_a_stack(void **state)
{
    enum { COUNT = 5 };
    static const int substeps[] = {4, 16, 8, 32, 5, 8};
    static const float steps[] = {1 / 60.0f, 1 / 60.0f, 1 / 30.0f, 1 / 60.0f, 1 / 90.0f, 1 / 144.0f};
    fe_body bodies[COUNT];
    vec before[COUNT];
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    for (int k = 0; k < COUNT; ++k)
        bodies[k] = add_dynamic(&s, cube(), v3(0, 0.5 + k, 0), UNTURNED, friction(0.6), WATER);
    run(&s, 600);
    for (int k = 0; k < COUNT; ++k) before[k] = position(&s, bodies[k]);
    for (int i = 0; i < 6; ++i) {
        MUST(fe_world_set_substeps(s.world, substeps[i]));
        for (int n = 0; n < 10; ++n) {
            MUST(fe_world_step(s.world, steps[i]));
            for (int k = 0; k < COUNT; ++k) {
                // without rescaling, half the impulse would be missing for a substep: g dt / 16 = 10 mm/s at least
                FE_NEAR(length(velocity(&s, bodies[k])), 0, 1e-3);
                // hertz are clamped to an eighth of the substep rate: at 30 Hz and 8 substeps not below the 30 they are
                // set to
                FE_NEAR(length(minus(position(&s, bodies[k]), before[k])), 0, 1e-4);
            }
        }
    }
    scene_end(&s);
}

// Twice the hertz, a quarter of the sink; the overlap follows, and gives no energy to speak of.
static void contact_hertz_may_change_between_steps(void **state)
{
    scene s = scene_begin(state);
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    add_ground(&s, friction(0.6));
    fe_body body = add_dynamic(&s, cube(), v3(0, 0.5, 0), UNTURNED, friction(0.6), WATER);
    static const double hertz[] = {15, 30, 10, 25};
    for (int i = 0; i < 4; ++i) {
        tuning.contact_hertz = (float)hertz[i];
        MUST(fe_world_set_tuning(s.world, &tuning));
        for (int k = 0; k < 600; ++k) {
            run(&s, 1);
            FE_WITHIN(velocity(&s, body).y, -0.02, 0.02);
        }
        double expected = sink(G, 1, 1) * pow(30 / hertz[i], 2);
        FE_NEAR(0.5 - position(&s, body).y, expected, 0.05 * expected);
    }
    scene_end(&s);
}

static void gravity_may_turn_between_steps(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    add_plane(&s, v3(-1, 0, 0), -5, friction(0.6)); // x <= 5
    fe_body body = add_dynamic(&s, sphere(0.5), v3(0, 0.5, 0), UNTURNED, friction(0.6), WATER);
    run(&s, 60);
    set_gravity(&s, v3(G, 0, 0));
    run(&s, 240);
    FE_NEAR(position(&s, body).x, 4.5, LINEAR_SLOP);
    scene_end(&s);
}

// gravity scale and damping, one each: v = k g t; v = v0 / (1 + h c)^n
static void gravity_scale_and_damping_follow_their_formulas(void **state)
{
    scene s = scene_begin(state);
    static const double scales[] = {0, 0.5, -2};
    for (int i = 0; i < 3; ++i) {
        fe_body body = add_dynamic(&s, sphere(0.5), v3(3 * i, 0, 0), UNTURNED, friction(0.6), WATER);
        MUST(fe_body_set_gravity_scale(s.world, body, (float)scales[i]));
        run(&s, 30);
        FE_NEAR(velocity(&s, body).y, -scales[i] * G * 0.5, rounding(30 * s.substeps) * 10);
        MUST(fe_body_destroy(s.world, body));
    }
    set_gravity(&s, v3(0, 0, 0));
    fe_body body = add_dynamic(&s, sphere(0.5), v3(0, 0, 0), UNTURNED, friction(0.6), WATER);
    set_velocity(&s, body, v3(5, 0, 0), v3(0, 7, 0));
    MUST(fe_body_set_damping(s.world, body, 0.5f, 1.5f));
    run(&s, 240);
    FE_NEAR(velocity(&s, body).x, 5 * pow(1 + s.h * 0.5, -240.0 * s.substeps), 5 * rounding(240 * s.substeps));
    FE_NEAR(spin(&s, body).y, 7 * pow(1 + s.h * 1.5, -240.0 * s.substeps), 7 * rounding(240 * s.substeps));
    scene_end(&s);
}

static void a_step_of_zero_time_moves_nothing(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    fe_body bodies[2] = {add_dynamic(&s, cube(), v3(0, 0.45, 0), UNTURNED, friction(0.6), WATER),
                         add_dynamic(&s, cube(), v3(0, 1.4, 0), UNTURNED, friction(0.6), WATER)};
    set_velocity(&s, bodies[1], v3(1, -2, 3), v3(4, 5, 6));
    fe_transform before[2] = {body_transform(s.world, bodies[0]), body_transform(s.world, bodies[1])};
    fe_vec3 v = body_linear_velocity(s.world, bodies[1]);
    for (int k = 0; k < 5; ++k) MUST(fe_world_step(s.world, 0));
    fe_transform after[2] = {body_transform(s.world, bodies[0]), body_transform(s.world, bodies[1])};
    fe_vec3 u = body_linear_velocity(s.world, bodies[1]);
    assert_memory_equal(before, after, sizeof before);
    assert_memory_equal(&v, &u, sizeof v);
    scene_end(&s);
}

// a force given before steps of zero time is still there in the next one that takes time
static void a_force_waits_for_a_step_that_takes_time(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body body = add_dynamic(&s, cube(), v3(0, 0, 0), UNTURNED, friction(0.6), WATER);
    add_force(&s, body, v3(1000 * 6, 0, 0));
    MUST(fe_world_step(s.world, 0));
    run(&s, 1);
    FE_NEAR(velocity(&s, body).x, 6 * STEP, 1e-5);
    run(&s, 1);
    FE_NEAR(velocity(&s, body).x, 6 * STEP, 1e-5);
    scene_end(&s);
}

// ---- bodies --------------------------------------------------------------------------------------------------------

static void add_shape(scene *s, fe_body body, fe_geometry form, vec at, float density)
{
    fe_shape_def def;
    fe_shape shape;
    fe_shape_def_init(&def, sizeof def);
    def.density = density;
    def.frame.position = narrow(at);
    MUST(fe_shape_create(s->world, body, &def, &form, &shape));
}

// Two balls on a bar: the centre is the balance point, and the moments follow Steiner. It lies on both balls, each
// loaded by the lever (V18).
static void a_body_of_several_shapes_weighs_and_lies_as_its_parts(void **state)
{
    scene s = scene_begin(state);
    fe_body ground = add_ground(&s, friction(0.6));
    fe_body body = add_dynamic(&s, sphere(0.3), v3(0, 0.3, 0), UNTURNED, friction(0.6), 1000);
    add_shape(&s, body, sphere(0.3), v3(2, 0, 0), 3000);
    double one = 4.0 / 3 * PI * 0.027 * 1000, all = 4 * one;
    fe_mass_data data = mass_data_of(&s, body);
    FE_NEAR(data.mass, all, 1e-6 * all);
    FE_NEAR(data.centre.x, 1.5, 1e-6);
    // about the centre: 2/5 m r^2 of each along the bar, and m d^2 across
    double along = 0.4 * all * 0.09, across = along + one * 1.5 * 1.5 + 3 * one * 0.5 * 0.5;
    double least = fmin((double)data.inertia.x, fmin((double)data.inertia.y, (double)data.inertia.z));
    double most = fmax((double)data.inertia.x, fmax((double)data.inertia.y, (double)data.inertia.z));
    FE_NEAR(least, along, 1e-5 * along);
    FE_NEAR(most, across, 1e-5 * across);
    run(&s, 300);
    fe_contact contacts[4];
    FE_TRUE(fe_body_get_contacts(s.world, body, contacts, sizeof *contacts, 4) == 2);
    double light = 0, heavy = 0;
    for (int i = 0; i < 2; ++i) {
        double load = (double)contacts[i].points[0].total_impulse;
        FE_TRUE(contacts[i].body_a == ground);
        if (from_world(&s, contacts[i].points[0].point).x < 1) light += load;
        if (from_world(&s, contacts[i].points[0].point).x > 1) heavy += load;
    }
    FE_NEAR(light, 0.25 * all * G * STEP, 0.01 * all * G * STEP);
    FE_NEAR(heavy, 0.75 * all * G * STEP, 0.01 * all * G * STEP);
    scene_end(&s);
}

// Free flight of a body whose centre is not its origin: the centre flies, the origin circles it.
static void the_centre_of_mass_flies_not_the_origin(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body body = add_dynamic(&s, sphere(0.3), v3(0, 0, 0), UNTURNED, friction(0.6), 1000);
    add_shape(&s, body, sphere(0.3), v3(2, 0, 0), 1000);
    set_velocity(&s, body, v3(1, 0, 0), v3(0, 0, 2));
    run(&s, 60);
    fe_dvec3 centre;
    MUST(fe_body_get_centre(s.world, body, &centre));
    FE_NEAR(length(minus(from_world(&s, centre), v3(2, 0, 0))), 0, 1e-5);
    // the origin was at -1 along x from it and turned by 2 rad; the discrete rotation lags by (w h)^2 / 12
    FE_NEAR(length(minus(position(&s, body), v3(2 - cos(2.0), -sin(2.0), 0))), 0, 2 * pow(2 * s.h, 2) / 12 + 1e-5);
    scene_end(&s);
}

static void a_given_mass_holds_until_it_is_reset(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body body = add_dynamic(&s, cube(), v3(0, 0, 0), UNTURNED, friction(0.6), 1000);
    fe_mass_data data = {.struct_size = sizeof data,
                         .mass = 10,
                         .centre = {0.25f, 0, 0},
                         .inertia = {1, 2, 2.5f},
                         .inertia_rotation = {0, 0, 0, 1}};
    MUST(fe_body_set_mass_data(s.world, body, &data));
    fe_vec3 twist = narrow(to_world(&s, v3(0, 3, 0)));
    add_force(&s, body, v3(60, 0, 0));
    MUST(fe_body_add_angular_impulse(s.world, body, &twist));
    run(&s, 1);
    FE_NEAR(velocity(&s, body).x, 6 * STEP, 1e-6);
    FE_NEAR(spin(&s, body).y, 1.5, 1e-5);
    fe_dvec3 centre;
    MUST(fe_body_get_centre(s.world, body, &centre));
    FE_NEAR(from_world(&s, centre).x, 0.25, 0.01);
    MUST(fe_body_reset_mass(s.world, body));
    FE_NEAR(mass_of(&s, body), 1000, 1e-3);
    scene_end(&s);
}

// A teleport goes through whatever is between, keeps the velocity, and touches at once what is there.
static void a_teleport_passes_through_walls(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    add_static(&s, box(0.5, 5, 5), v3(0, 0, 0), UNTURNED, friction(0.6));
    fe_body wall = add_static(&s, box(0.5, 5, 5), v3(5, 0, 0), UNTURNED, friction(0.6));
    fe_body body = add_dynamic(&s, sphere(0.5), v3(-3, 0, 0), UNTURNED, bouncy(0, 0), WATER);
    set_velocity(&s, body, v3(1, 0, 0), v3(0, 0, 0));
    run(&s, 10);
    fe_transform there = {to_world(&s, v3(3, 0, 0)), s.turn};
    MUST(fe_body_set_transform(s.world, body, &there));
    FE_NEAR(velocity(&s, body).x, 1, 1e-6);
    run(&s, 30);
    FE_NEAR(position(&s, body).x, 3.5, 1e-5);
    run(&s, 120);
    FE_NEAR(position(&s, body).x, 4, LINEAR_SLOP);
    fe_contact contact;
    FE_TRUE(fe_body_get_contacts(s.world, body, &contact, sizeof contact, 1) == 1);
    FE_TRUE(contact.body_a == wall || contact.body_b == wall);
    scene_end(&s);
}

// A body made inside another is pushed out, no faster than 3 m/s, and does not fly off.
static void a_body_made_in_another_is_pushed_out(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    fe_body bodies[2] = {add_dynamic(&s, cube(), v3(0, 0.5, 0), UNTURNED, friction(0.6), WATER),
                         add_dynamic(&s, cube(), v3(0.2, 0.7, 0.1), UNTURNED, friction(0.6), WATER)};
    double highest = 0;
    for (int k = 0; k < 240; ++k) {
        run(&s, 1);
        for (int i = 0; i < 2; ++i) {
            FE_WITHIN(length(velocity(&s, bodies[i])), 0, 3 + G * 0.5);
            highest = fmax(highest, position(&s, bodies[i]).y);
        }
    }
    FE_WITHIN(highest, 0.5, 2 + LINEAR_SLOP);
    for (int i = 0; i < 2; ++i) FE_WITHIN(length(velocity(&s, bodies[i])), 0, 0.05);
    scene_end(&s);
}

// What rests at 1e6 m rests as at the origin. (What moves differs: the last place of a double there is 1e-10 m.)
static void far_from_the_origin_is_as_near(void **state)
{
    static const double distances[] = {0, 1e4, 1e6};
    enum { COUNT = 6 };
    vec rest[COUNT];
    for (int i = 0; i < 3; ++i) {
        double d = distances[i];
        scene s = scene_begin(state);
        fe_body bodies[COUNT];
        add_static(&s, box(10, 1, 10), v3(d, -d - 1, 0.5 * d), UNTURNED, friction(0.6));
        for (int k = 0; k < 3; ++k)
            bodies[k] = add_dynamic(&s, cube(), v3(d, -d + 0.5 + k, 0.5 * d), UNTURNED, friction(0.6), WATER);
        bodies[3] = add_dynamic(&s, sphere(0.5), v3(d + 3, -d + 0.6, 0.5 * d), UNTURNED, friction(0.6), WATER);
        bodies[4] = add_dynamic(&s, capsule(0.5, 0.25), v3(d - 3, -d + 0.3, 0.5 * d), turned(v3(0, 0, 1), PI / 2),
                                friction(0.6), WATER);
        bodies[5] = add_dynamic(&s, box(0.5, 0.05, 0.3), v3(d, -d + 0.06, 0.5 * d + 3), UNTURNED, friction(0.6), WATER);
        run(&s, 300);
        for (int k = 0; k < COUNT; ++k) {
            vec at = minus(position(&s, bodies[k]), v3(d, -d, 0.5 * d));
            if (i == 0) rest[k] = at;
            FE_NEAR(length(minus(at, rest[k])), 0, 0.001);
            FE_WITHIN(length(velocity(&s, bodies[k])), 0, 0.001);
        }
        scene_end(&s);
    }
}

// 72 km away a plane is as flat as here: the same fall, the same bounce, to the accuracy of the position's double.
static void a_fall_far_away_is_the_same_fall(void **state)
{
    vec here[2];
    for (int far = 0; far < 2; ++far) {
        vec at = far ? v3(65536, 32768, -16384) : v3(0, 0, 0); // powers of two: sums are exact
        scene s = scene_begin(state);
        add_static(&s, box(8, 1, 8), plus(at, v3(0, -1, 0)), UNTURNED, bouncy(0.5, 0.5));
        fe_body body = add_dynamic(&s, box(0.5, 0.25, 0.375), plus(at, v3(0, 2, 0)), turned(v3(1, 2, 3), 1),
                                   bouncy(0.5, 0.5), WATER);
        for (int k = 0; k < 30; ++k) run(&s, 1);
        vec now = minus(position(&s, body), at);
        here[far] = now;
        scene_end(&s);
    }
    FE_NEAR(length(minus(here[1], here[0])), 0, 1e-4);
}

// Locks are in world axes: a box that may only slide along x and turn about z does that under any push.
static void locked_axes_stay_bit_for_bit(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.3));
    fe_body body = add_dynamic(&s, box(0.5, 0.3, 0.4), v3(0, 2, 0.125), UNTURNED, friction(0.3), WATER);
    MUST(fe_body_set_locks(s.world, body, FE_AXIS_Z, FE_AXIS_X | FE_AXIS_Y));
    for (int i = 0; i < 6; ++i)
        add_dynamic(&s, sphere(0.3), v3(0.1 * i - 0.3, 3 + i, 0.2), UNTURNED, friction(0.5), WATER);
    for (int k = 0; k < 300; ++k) {
        add_force(&s, body, v3(500, 0, 2000));
        add_torque(&s, body, v3(300, 300, 100));
        run(&s, 1);
        fe_transform t = body_transform(s.world, body);
        FE_TRUE(t.position.z == 0.125);
        FE_TRUE(t.rotation.x == 0 && t.rotation.y == 0);
    }
    FE_WITHIN(position(&s, body).x, 0.1,
              0.5 * 500 / mass_of(&s, body) * 5 * 5); // it slides, by no more than without friction
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        EVERY_WAY_UP(a_platform_carries_a_box),
        WITH_4_SUBSTEPS(a_platform_carries_a_box),
        TEST(a_turntable_takes_a_box_round),
        TEST(a_target_is_reached_in_time),
        TEST(a_conveyor_brings_a_box_to_its_speed),
        TEST(a_running_belt_drives_its_own_body),
        TEST(a_contact_sticks_by_static_and_slides_by_dynamic_friction),
        TEST(substeps_and_steps_may_change_under_a_stack),
        TEST(contact_hertz_may_change_between_steps),
        TEST(gravity_may_turn_between_steps),
        TEST(gravity_scale_and_damping_follow_their_formulas),
        TEST(a_step_of_zero_time_moves_nothing),
        TEST(a_force_waits_for_a_step_that_takes_time),
        TEST(a_body_of_several_shapes_weighs_and_lies_as_its_parts),
        TEST(the_centre_of_mass_flies_not_the_origin),
        TEST(a_given_mass_holds_until_it_is_reset),
        TEST(a_teleport_passes_through_walls),
        TEST(a_body_made_in_another_is_pushed_out),
        TEST(far_from_the_origin_is_as_near),
        TEST(a_fall_far_away_is_the_same_fall),
        TEST(locked_axes_stay_bit_for_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
