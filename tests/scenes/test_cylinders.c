// Cylinders and cones: they roll straight and without loss, stand on four points that stay, tip over where they must.
#include "scene.h"

#include "terrain.h"

static fe_geometry cylinder(double half_height, double radius)
{
    fe_geometry form;
    fe_geometry_cylinder(&form, (float)half_height, (float)radius);
    return form;
}

static fe_geometry cone(double half_height, double radius)
{
    fe_geometry form;
    fe_geometry_cone(&form, (float)half_height, (float)radius);
    return form;
}

static const fe_quat *lying(void)
{
    static fe_quat q;
    q = turned(v3(1, 0, 0), PI / 2);
    return &q;
}

// ---- mass ----------------------------------------------------------------------------------------------------------
static void masses_are_those_of_the_closed_forms(void **state)
{
    scene s = scene_begin(state);
    const double r = 0.3, h = 0.7, ball = 1e-6;
    fe_body can = add_dynamic(&s, cylinder(h, r), v3(0, 0, 0), UNTURNED, friction(0.5), WATER),
            hat = add_dynamic(&s, cone(h, r), v3(9, 0, 0), UNTURNED, friction(0.5), WATER);
    double m = WATER * PI * r * r * 2 * h, c = m / 3;
    fe_mass_data of_can = mass_data_of(&s, can), of_hat = mass_data_of(&s, hat);
    FE_NEAR(of_can.mass, m, ball * m);
    FE_NEAR(of_can.inertia.y, m * r * r / 2, ball * m * r * r);
    FE_NEAR(of_can.inertia.x, m * (r * r / 4 + h * h / 3), ball * m);
    FE_NEAR(of_hat.mass, c, ball * c);
    FE_NEAR(of_hat.centre.y, -h / 2, ball);
    FE_NEAR(of_hat.inertia.y, 0.3 * c * r * r, ball * c * r * r);
    FE_NEAR(of_hat.inertia.x, c * (3 * r * r / 20 + 3 * (2 * h) * (2 * h) / 80), ball * c);
    scene_end(&s);
}

static void what_is_set_comes_back_and_what_is_wrong_is_refused(void **state)
{
    scene s = scene_begin(state);
    fe_body body = add_static(&s, cone(0.7, 0.3), v3(0, 0, 0), UNTURNED, friction(0.5));
    fe_shape shape;
    fe_geometry got = {.struct_size = sizeof got},
                bad[] = {cylinder(0, 1), cylinder(1, -1), cone(1e6, 1), cone(1, NAN)};
    FE_NEAR(fe_body_get_shapes(s.world, body, &shape, 1), 1, 0);
    MUST(fe_shape_get_geometry(s.world, shape, &got));
    FE_TRUE(got.type == FE_GEOMETRY_CONE && got.half_height == 0.7f && got.radius == 0.3f && got.half_extents.x == 0);
    for (int i = 0; i < 4; ++i) FE_NEAR(fe_shape_set_geometry(s.world, shape, &bad[i]), FE_ERROR_ARGUMENT, 0);
    fe_geometry can = cylinder(0.2, 0.4);
    MUST(fe_shape_set_geometry(s.world, shape, &can));
    MUST(fe_shape_get_geometry(s.world, shape, &got));
    FE_TRUE(got.type == FE_GEOMETRY_CYLINDER && got.half_height == 0.2f && got.radius == 0.4f);

    // queries: a ray down on the cap, a cylinder swept onto it, one that overlaps it
    fe_dvec3 from = {0.1, 5, 0}, down = {0, -10, 0};
    fe_hit hit = {0};
    FE_NEAR(fe_world_raycast(s.world, &from, &down, NULL, &hit), 1, 0);
    FE_NEAR(hit.fraction, 0.48, 1e-7);
    fe_transform at = {{0.3, 5, 0}, UNTURNED};
    FE_NEAR(fe_world_sweep(s.world, &can, &at, &down, NULL, &hit), 1, 0);
    FE_NEAR(hit.fraction, 0.46, 1e-6);
    FE_NEAR(hit.normal.y, 1, 1e-6);
    at.position = fe_make_dvec3(0.55, 0.1, 0.55);
    FE_NEAR(fe_world_overlap_any(s.world, &can, &at, NULL), 1, 0);
    at.position = fe_make_dvec3(0.57, 0.1, 0.57); // the boxes around them still overlap
    FE_NEAR(fe_world_overlap_any(s.world, &can, &at, NULL), 0, 0);
    scene_end(&s);
}

// ---- rolling -------------------------------------------------------------------------------------------------------
// at 2 m/s for 5 s: 10 m straight on, and nothing lost
static void rolls(scene *s, double r, double half, double y)
{
    fe_body wheel = add_dynamic(s, cylinder(half, r), v3(0, y + r, 0), *lying(), friction(0.6), WATER);
    run(s, 30);
    set_velocity(s, wheel, v3(2, 0, 0), v3(0, 0, -2 / r));
    vec start = position(s, wheel);
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        run(s, 1);
        worst = fmax(worst, fabs(velocity(s, wheel).y));
    }
    vec way = minus(position(s, wheel), start), v = velocity(s, wheel), w = spin(s, wheel);
    double energy = (dot(v, v) + r * r / 2 * w.z * w.z) / (4 + 2);
    FE_NEAR(way.x, 300 * STEP * 2, 0.005);
    FE_NEAR(way.z, 0, 0.005);
    FE_WITHIN(energy, 0.999, 1.001);
    FE_WITHIN(worst, 0, 0.002);
}

static void a_cylinder_rolls_straight_and_loses_nothing(void **state)
{
    static const double radii[] = {0.05, 0.3, 2.0};
    for (int i = 0; i < 3; ++i) {
        scene s = scene_begin(state);
        add_ground(&s, friction(0.6));
        rolls(&s, radii[i], 2 * radii[i], 0);
        scene_end(&s);
    }
}

static void a_cylinder_rolls_on_a_box_as_on_a_plane(void **state)
{
    static const double radii[] = {0.05, 0.3, 2.0};
    for (int i = 0; i < 3; ++i) {
        scene s = scene_begin(state);
        add_static(&s, box(30, 1, 30), v3(0, -1, 0), UNTURNED, friction(0.6));
        rolls(&s, radii[i], 2 * radii[i], 0);
        scene_end(&s);
    }
}

static void a_cylinder_rolls_on_a_heightfield_as_on_a_plane(void **state)
{
    static const double radii[] = {0.05, 0.3, 2.0};
    for (int i = 0; i < 3; ++i) {
        scene s = scene_begin(state);
        add_field(&s, 48, 0.5, -12 + 0.13, -12 + 0.21, level, friction(0.6));
        rolls(&s, radii[i], 2 * radii[i] < 1 ? 2 * radii[i] : 1, 0);
        scene_end(&s);
    }
}

static void a_cylinder_rolls_down_with_two_thirds(void **state)
{
    scene s = scene_begin(state);
    double angle = 20 * DEGREES, r = 0.3, way = discrete_way(2.0 / 3 * G * sin(angle), 2, s.h);
    add_slope(&s, angle, friction(0.6));
    fe_body can = add_dynamic(&s, cylinder(0.5, r), times(r, slope_normal(angle)), *lying(), friction(0.6), WATER);
    vec start = position(&s, can);
    run(&s, 120);
    FE_NEAR(dot(minus(position(&s, can), start), downhill(angle)), way, 0.005 * way);
    FE_NEAR(position(&s, can).z, 0, 0.002);
    scene_end(&s);
}

// ---- standing ------------------------------------------------------------------------------------------------------
// After a second of rest the contact keeps its four points: features and places.
static void stands_still(scene *s, fe_body body, double points)
{
    fe_contact before[MOST_CONTACTS], after[MOST_CONTACTS];
    run(s, 60);
    vec start = position(s, body);
    int32_t count = fe_body_get_contacts(s->world, body, before, sizeof *before, MOST_CONTACTS);
    FE_NEAR(count, 1, 0);
    FE_NEAR(before[0].point_count, points, 0);
    for (int i = 0; i < 120; ++i) {
        run(s, 1);
        MUST(fe_body_get_contacts(s->world, body, after, sizeof *after, MOST_CONTACTS));
        FE_NEAR(after[0].point_count, before[0].point_count, 0);
        for (int32_t k = 0; k < before[0].point_count; ++k) {
            vec d = minus(after[0].points[k].point, before[0].points[k].point);
            FE_WITHIN(length(d), 0, 1e-4);
            FE_NEAR(after[0].points[k].id, before[0].points[k].id, 0);
        }
        before[0] = after[0];
    }
    FE_WITHIN(length(minus(position(s, body), start)), 0, 1e-3);
    FE_WITHIN(tilt(s, body), 0, 0.1 * DEGREES);
}

static void caps_keep_their_points(void **state)
{
    for (int on_box = 0; on_box < 2; ++on_box) {
        for (int is_cone = 0; is_cone < 2; ++is_cone) {
            scene s = scene_begin(state);
            if (on_box)
                add_static(&s, box(3, 1, 3), v3(0.1, -1, 0.2), turned(v3(0, 1, 0), 0.3), friction(0.6));
            else
                add_ground(&s, friction(0.6));
            fe_geometry form = is_cone ? cone(0.5, 0.4) : cylinder(0.5, 0.25);
            fe_body body = add_dynamic(&s, form, v3(0, 0.5, 0), turned(v3(0, 1, 0), 0.7), friction(0.6), WATER);
            stands_still(&s, body, 4);
            scene_end(&s);
        }
    }
}

static void ten_cylinders_stand_on_each_other(void **state)
{
    scene s = scene_begin(state);
    fe_body cans[10];
    add_ground(&s, friction(0.6));
    for (int i = 0; i < 10; ++i)
        cans[i] = add_dynamic(&s, cylinder(0.5, 0.5), v3(0, 0.5 + 1.1 * i, 0), UNTURNED, friction(0.6), WATER);
    run(&s, 1200);
    for (int i = 0; i < 10; ++i) {
        FE_WITHIN(tilt(&s, cans[i]), 0, 1 * DEGREES);
        FE_NEAR(position(&s, cans[i]).y, 0.5 + i, 0.05);
    }
    scene_end(&s);
}

// Half height 0.5, radius 0.25: the centre is over the rim at atan(r / h) = 26.57 degrees.
static void let_go(void **state, double degrees, int32_t azimuth, int falls_over)
{
    scene s = scene_begin(state);
    double angle = degrees * DEGREES, around = azimuth * DEGREES;
    add_ground(&s, friction(0.8));
    fe_quat q = compose(turned(v3(sin(around), 0, cos(around)), angle), turned(v3(0, 1, 0), 0.2));
    fe_body can =
        add_dynamic(&s, cylinder(0.5, 0.25), v3(0, 0.5 * cos(angle) + 0.25 * sin(angle), 0), q, friction(0.8), WATER);
    double lowest = 0;
    for (int i = 0; i < 240; ++i) {
        run(&s, 1);
        double a = tilt(&s, can), low = position(&s, can).y - 0.5 * fabs(cos(a)) - 0.25 * sin(a);
        lowest = fmin(lowest, low);
    }
    FE_WITHIN(lowest, -LINEAR_SLOP, 0);
    if (falls_over)
        FE_NEAR(tilt(&s, can), PI / 2, 1 * DEGREES);
    else
        FE_WITHIN(tilt(&s, can), 0, 1 * DEGREES);
    scene_end(&s);
}

static void what_leans_less_than_its_rim_carries_rights_itself(void **state)
{
    for (int32_t azimuth = 0; azimuth < 90; azimuth += 17) {
        let_go(state, 24.5, azimuth, 0);
        let_go(state, 27.5, azimuth, 1);
    }
}

// ---- cones ---------------------------------------------------------------------------------------------------------
// Lying, a cone turns about its tip: its base runs around, its centre in a circle.
static void a_cone_rolls_about_its_tip(void **state)
{
    scene s = scene_begin(state);
    const double h = 0.5, r = 0.4, l = sqrt(r * r + 4 * h * h), half_angle = asin(r / l);
    add_ground(&s, friction(0.8));
    // the axis from the base to the tip, `half_angle` below the level; the tip at the origin
    fe_quat q = turned(v3(0, 0, 1), -PI / 2 - half_angle);
    vec axis = rotate(q, v3(0, 1, 0));
    fe_body hat = add_dynamic(&s, cone(h, r), times(-h, axis), q, friction(0.8), WATER);
    // about the vertical by `turn`, and about its axis so that the line on the ground rests
    double turn = 1.0;
    vec line = v3(-1, 0, 0), w = times(turn / tan(half_angle), line);
    vec centre = times(-1.5 * h, axis), v = cross(w, centre);
    set_velocity(&s, hat, v, w);
    int steps = 180;
    run(&s, steps);
    vec tip = plus(position(&s, hat), times(h, axis_of(&s, hat, v3(0, 1, 0))));
    vec now = axis_of(&s, hat, v3(0, -1, 0));
    double turned_by = atan2(now.z, -now.x);
    FE_WITHIN(length(tip), 0, 0.02);
    FE_NEAR(fabs(turned_by), turn * steps * STEP, 0.05 * turn * steps * STEP);
    FE_NEAR(asin(-now.y) + half_angle, 0, 2 * DEGREES);
    scene_end(&s);
}

// ---- speed ---------------------------------------------------------------------------------------------------------
static void nothing_thin_is_passed_through(void **state)
{
    for (int i = 0; i < 8; ++i) {
        scene s = scene_begin(state);
        // friction throws it sideways by up to 79 m in the second
        add_static(&s, box(100, 0.01, 100), v3(0, 0, 0), UNTURNED, friction(0.5));
        fe_geometry form = i & 1 ? cone(0.1, 0.05) : cylinder(0.1, 0.05);
        fe_body body = add_dynamic(&s, form, v3(0, 3, 0), turned(v3(1, 0.3 * i, 0.2), i), friction(0.5), WATER);
        set_velocity(&s, body, v3(1, -158, 0), v3(30.0 * i, 0, 10));
        run(&s, 60);
        FE_WITHIN(position(&s, body).y, 0, 100);
        scene_end(&s);
    }
}

// ---- heaps ---------------------------------------------------------------------------------------------------------
static double hills(double x, double z) { return 0.3 * sin(1.7 * x) + 0.2 * cos(2.3 * z + x); }

enum { HEAP = 60 };
static void make_heap(scene *s, fe_body bodies[HEAP], height_at *ground)
{
    add_field(s, 32, 0.5, -8, -8, ground, friction(0.6));
    for (int i = 0; i < HEAP; ++i) {
        double h = 0.1 + 0.03 * (i % 7), r = 0.1 + 0.04 * (i % 5);
        fe_geometry form = i % 5 == 0   ? box(h, r, h)
                           : i % 5 == 1 ? cone(h, r)
                           : i % 5 == 2 ? capsule(h, r)
                                        : cylinder(h, r);
        vec at = v3(0.8 * (i % 4) - 1.2, 1.5 + 0.7 * (i / 16), 0.8 * (i / 4 % 4) - 1.2);
        bodies[i] = add_dynamic(s, form, at, turned(v3(1, 0.2 * (i % 3), 0.3), 0.7 * i), friction(0.6), WATER);
    }
}

static void hills_hold_what_comes_down(void **state)
{
    scene s = scene_begin(state);
    fe_body bodies[HEAP];
    make_heap(&s, bodies, hills);
    run(&s, 600);
    for (int i = 0; i < HEAP; ++i) {
        vec p = position(&s, bodies[i]);
        if (fabs(p.x) > 7.5 || fabs(p.z) > 7.5) continue; // over the border
        FE_WITHIN(p.y - hills(p.x, p.z), 0, 3);
    }
    scene_end(&s);
}

// workers and SIMD sets
static void every_machine_part_gives_the_same_bits(void **state)
{
    uint32_t first[2] = {0, 0};
    for (int32_t simd = FE_SIMD_AUTO; simd <= FE_SIMD_NEON; ++simd) {
        for (int32_t workers = 1; workers <= 3; ++workers) {
            scene s = scene_begin(state);
            MUST(fe_world_destroy(s.world));
            s.world = NULL;
            fe_world_def def;
            fe_world_def_init(&def, sizeof def);
            def.worker_count = workers;
            def.simd = simd;
            if (fe_world_create(&def, &s.world) == FE_ERROR_UNSUPPORTED) continue; // not on this CPU
            fe_body bodies[HEAP];
            make_heap(&s, bodies, hills);
            run(&s, 120);
            uint32_t hash[2] = {0, 0};
            MUST(fe_world_hash(s.world, hash));
            if (!first[0] && !first[1]) first[0] = hash[0], first[1] = hash[1];
            FE_TRUE(hash[0] == first[0] && hash[1] == first[1]);
            scene_end(&s);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(masses_are_those_of_the_closed_forms),
        TEST(what_is_set_comes_back_and_what_is_wrong_is_refused),
        EVERY_WAY_UP(a_cylinder_rolls_straight_and_loses_nothing),
        WITH_4_SUBSTEPS(a_cylinder_rolls_straight_and_loses_nothing),
        TEST(a_cylinder_rolls_on_a_box_as_on_a_plane),
        TEST(a_cylinder_rolls_on_a_heightfield_as_on_a_plane),
        TEST(hills_hold_what_comes_down),
        TEST(every_machine_part_gives_the_same_bits),
        WITH_4_SUBSTEPS(a_cylinder_rolls_on_a_box_as_on_a_plane),
        EVERY_WAY_UP(a_cylinder_rolls_down_with_two_thirds),
        TEST(caps_keep_their_points),
        WITH_4_SUBSTEPS(caps_keep_their_points),
        TEST(ten_cylinders_stand_on_each_other),
        TEST(what_leans_less_than_its_rim_carries_rights_itself),
        TEST(a_cone_rolls_about_its_tip),
        TEST(nothing_thin_is_passed_through),
    };
    return cmocka_run_group_tests_name("cylinders", tests, NULL, NULL);
}
