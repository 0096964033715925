// Coulomb friction of boxes on planes: what holds, what slides and how fast, what tips. Answers are those of statics
// and of mu g.
#include "scene.h"

static const fe_material SMOOTH = SURFACE(0, 0, 0, 0, 0);

// ---- slopes --------------------------------------------------------------------------------------------------------

// A box lying flush on a slope
static fe_body add_box_on_slope(scene *s, double angle, double half_along, double half_up, double mu)
{
    add_slope(s, angle, friction(mu));
    return add_dynamic(s, box(half_along, half_up, 0.5), times(half_up, slope_normal(angle)), slope_turn(angle),
                       friction(mu), WATER);
}

static double slip_in(scene *s, fe_body body, int steps)
{
    vec start = position(s, body);
    run(s, steps);
    return length(minus(position(s, body), start));
}

// The library's promise: 1 mm in 10 s
static void a_box_on_20_degrees_stays_for_ten_seconds(void **state)
{
    scene s = scene_begin(state);
    fe_body block = add_box_on_slope(&s, 20 * DEGREES, 0.5, 0.5, 0.6);
    FE_WITHIN(slip_in(&s, block, 600), 0, 0.001);
    scene_end(&s);
}

static void a_box_sticks_just_below_the_angle_of_friction(void **state)
{
    for (int degrees = 5; degrees <= 40; degrees += 5) {
        scene s = scene_begin(state);
        fe_body block = add_box_on_slope(&s, degrees * DEGREES, 0.5, 0.5, 1.02 * tan(degrees * DEGREES));
        FE_WITHIN(slip_in(&s, block, 600), 0, LINEAR_SLOP);
        scene_end(&s);
    }
}

// way between two moments of a motion from rest
static double discrete_way_between(double a, double t0, double t1, double h)
{
    return discrete_way(a, t1, h) - discrete_way(a, t0, h);
}

// a = 0.02 g sin(angle): a tenth of it is two thousandths of the friction
static void a_box_slides_just_above_the_angle_of_friction(void **state)
{
    for (int degrees = 5; degrees <= 40; degrees += 5) {
        scene s = scene_begin(state);
        double angle = degrees * DEGREES, way = discrete_way_between(0.02 * G * sin(angle), 1, 3, s.h);
        fe_body block = add_box_on_slope(&s, angle, 0.5, 0.5, 0.98 * tan(angle));
        run(&s, 60);
        FE_NEAR(slip_in(&s, block, 120), way, 0.1 * way);
        scene_end(&s);
    }
}

// a = g (sin - mu cos): 9.655 m from 0.5 to 2.5 s at 8 substeps and 35 degrees, straight down the slope
static void check_slide(scene *s, fe_body block, double angle, double mu)
{
    double a = G * (sin(angle) - mu * cos(angle));
    run(s, 30);
    vec start = position(s, block);
    run(s, 120);
    vec way = minus(position(s, block), start);
    FE_NEAR(dot(way, downhill(angle)), discrete_way_between(a, 0.5, 2.5, s->h), LINEAR_SLOP);
    FE_NEAR(way.z, 0, LINEAR_SLOP);
    FE_NEAR(dot(way, slope_normal(angle)), 0, LINEAR_SLOP);
}

static void a_sliding_box_follows_coulomb(void **state)
{
    scene s = scene_begin(state);
    check_slide(&s, add_box_on_slope(&s, 35 * DEGREES, 0.5, 0.5, 0.3), 35 * DEGREES, 0.3);
    scene_end(&s);
}

// a plank of 40 m instead of a plane; and locks that are not in the way, which take the solver's special rows
static void a_sliding_box_follows_coulomb_on_a_plank(void **state)
{
    for (int locked = 0; locked < 2; ++locked) {
        scene s = scene_begin(state);
        double angle = 35 * DEGREES;
        add_static(&s, box(20, 0.5, 2), times(-0.5, slope_normal(angle)), slope_turn(angle), friction(0.3));
        fe_body block = add_dynamic(&s, box(0.5, 0.5, 0.5), times(0.5, slope_normal(angle)), slope_turn(angle),
                                    friction(0.3), WATER);
        if (locked) MUST(fe_body_set_locks(s.world, block, FE_AXIS_Z, FE_AXIS_X | FE_AXIS_Y));
        check_slide(&s, block, angle, 0.3);
        scene_end(&s);
    }
}

// ---- on the level --------------------------------------------------------------------------------------------------

// 10 kg: a cube of 0.2 m. A force that grows by 1 N/s moves it above mu_s m g, and then only mu_d m g resist.
static void static_friction_holds_and_dynamic_friction_brakes(void **state)
{
    scene s = scene_begin(state);
    fe_material material = SURFACE(0.6f, 0.4f, 0, 0, 0);
    add_ground(&s, material);
    fe_body block = add_dynamic(&s, box(0.1, 0.1, 0.1), v3(0, 0.1, 0), UNTURNED, material, 1250);
    double moved_at = 0, gained = 0;
    for (int i = 0; i < 61 * 60; ++i) {
        double before = velocity(&s, block).x, force = i * STEP;
        add_force(&s, block, v3(force, 0, 0));
        run(&s, 1);
        // 0.01 m/s: above what a contact that sticks can creep with, below what one step gives to a box that slides
        if (!(moved_at > 0) && velocity(&s, block).x > 0.01) moved_at = force;
        gained = velocity(&s, block).x - before;
        if (moved_at > 0 && force > moved_at + 2 * STEP)
            FE_NEAR(gained, STEP * (force - 0.4 * 10 * G) / 10, 0.01 * gained);
    }
    FE_WITHIN(moved_at, 0.6 * 10 * G, 0.6 * 10 * G + 0.5);
    FE_TRUE(gained > 0);
    scene_end(&s);
}

// A force that comes at once, above the contact: static friction holds all of it, whatever the dynamic one is; what
// topples the box first is left out
static void a_sudden_force_below_static_friction_moves_nothing(void **state)
{
    static const double half_heights[] = {0.1, 0.3, 0.5, 0.7}, shares[] = {0.4, 0.45, 0.5, 0.55, 0.58};
    for (int h = 0; h < 4; ++h) {
        for (int f = 0; f < 5; ++f) {
            scene s = scene_begin(state);
            fe_material material = SURFACE(0.6f, 0.4f, 0, 0, 0);
            add_ground(&s, material);
            fe_body block =
                add_dynamic(&s, box(0.5, half_heights[h], 0.5), v3(0, half_heights[h], 0), UNTURNED, material, WATER);
            run(&s, 60);
            for (int i = 0; i < 60; ++i) {
                add_force(&s, block, v3(shares[f] * mass_of(&s, block) * G, 0, 0));
                run(&s, 1);
            }
            FE_WITHIN(position(&s, block).x, -LINEAR_SLOP, LINEAR_SLOP);
            FE_WITHIN(length(velocity(&s, block)), 0, 0.01);
            scene_end(&s);
        }
    }
}

// What is set down on a slope has all of its friction from the first substep on: it gains no tenth of what gravity
// alone gives it in a step beyond (sin - mu cos) g t
static void a_box_set_down_on_a_slope_has_its_friction_at_once(void **state)
{
    for (int half = 0; half < 3; ++half) {
        scene s = scene_begin(state);
        double angle = 40 * DEGREES, due = G * (sin(angle) - 0.8 * cos(angle));
        fe_body block = add_box_on_slope(&s, angle, 0.5, 0.1 + 0.2 * half, 0.8);
        run(&s, 10);
        FE_WITHIN(length(velocity(&s, block)) - due * 10 * STEP, -0.002, 0.1 * G * sin(angle) * STEP);
        scene_end(&s);
    }
}

enum { DIRECTIONS = 32 };

// d = v0^2 / (2 mu g), within the way of one substep; the same to 0.5 % in every direction: a disc, not a pyramid
static void a_sliding_box_stops_after_the_same_way_in_every_direction(void **state)
{
    scene s = scene_begin(state);
    fe_body blocks[DIRECTIONS];
    double way = 25 / (2 * 0.5 * G), least = INFINITY, most = 0;
    add_ground(&s, friction(0.5));
    for (int i = 0; i < DIRECTIONS; ++i) {
        double angle = 2 * PI * i / DIRECTIONS;
        blocks[i] = add_dynamic(&s, box(0.5, 0.25, 0.5), v3(20 * i, 0.25, 0), UNTURNED, friction(0.5), WATER);
        set_velocity(&s, blocks[i], v3(5 * cos(angle), 0, 5 * sin(angle)), v3(0, 0, 0));
    }
    run(&s, 90);
    for (int i = 0; i < DIRECTIONS; ++i) {
        double angle = 2 * PI * i / DIRECTIONS;
        vec d = minus(position(&s, blocks[i]), v3(20 * i, 0.25, 0));
        FE_NEAR(d.x * cos(angle) + d.z * sin(angle), way, 5 * s.h);
        FE_NEAR(d.z * cos(angle) - d.x * sin(angle), 0, LINEAR_SLOP);
        FE_WITHIN(length(velocity(&s, blocks[i])), 0, G * s.h);
        least = fmin(least, length(d));
        most = fmax(most, length(d));
    }
    FE_WITHIN(most - least, 0, 0.005 * way);
    scene_end(&s);
}

// A block thrown onto a slab that glides freely: friction brakes the one and drags the other until both have  m v0 / (m
// + M),  after v0 / (mu g (1 + m / M)) and  v0 / 2  times that against each other
static void a_block_drags_a_free_slab_to_their_common_velocity(void **state)
{
    scene s = scene_begin(state);
    const double mu = 0.5, v0 = 4;
    add_ground(&s, SMOOTH);
    fe_body slab = add_dynamic(&s, box(4, 0.25, 4), v3(0, 0.25, 0), UNTURNED, friction(mu), 100);
    fe_body block = add_dynamic(&s, box(0.5, 0.25, 0.5), v3(0, 0.75, 0), UNTURNED, friction(mu), WATER);
    double m = mass_of(&s, block), mass = mass_of(&s, slab), common = m * v0 / (m + mass),
           time = v0 / (mu * G * (1 + m / mass));
    int half_time = (int)(time / 2 / STEP);
    vec ahead = v3(0.6, 0, 0.8);
    set_velocity(&s, block, times(v0, ahead), v3(0, 0, 0));
    run(&s, half_time);
    FE_NEAR(dot(velocity(&s, block), ahead), v0 - mu * G * half_time * STEP, 0.01 * v0);
    FE_NEAR(dot(velocity(&s, slab), ahead), mu * G * m / mass * half_time * STEP, 0.01 * common);
    run(&s, 90);
    FE_NEAR(length(minus(velocity(&s, block), times(common, ahead))), 0, 0.01 * common);
    FE_NEAR(length(minus(velocity(&s, slab), times(common, ahead))), 0, 0.01 * common);
    FE_NEAR(length(minus(position(&s, block), position(&s, slab))), hypot(0.5, v0 * time / 2), v0 * s.h + LINEAR_SLOP);
    scene_end(&s);
}

// ---- tipping -------------------------------------------------------------------------------------------------------

// between the body's y axis and the slope's normal, rad
static double lean(const scene *s, fe_body body, double angle)
{
    return between(axis_of(s, body, v3(0, 1, 0)), slope_normal(angle));
}

// A box of width w and height H topples on a slope above tan(angle) = w / H: 26.57 degrees for 0.5 and 1 m
static void a_box_stands_below_its_tipping_angle(void **state)
{
    scene s = scene_begin(state);
    fe_body block = add_box_on_slope(&s, 25.5 * DEGREES, 0.25, 0.5, 1.5);
    run(&s, 600);
    FE_WITHIN(lean(&s, block, 25.5 * DEGREES), 0, LINEAR_SLOP / 0.5);
    FE_NEAR(length(minus(position(&s, block), times(0.5, slope_normal(25.5 * DEGREES)))), 0, LINEAR_SLOP);
    scene_end(&s);
}

static void a_box_topples_above_its_tipping_angle(void **state)
{
    scene s = scene_begin(state);
    fe_body block = add_box_on_slope(&s, 27.6 * DEGREES, 0.25, 0.5, 1.5);
    run(&s, 300);
    FE_WITHIN(lean(&s, block, 27.6 * DEGREES), 60 * DEGREES, PI);
    scene_end(&s);
}

// A cube of 1 m pushed at its top edge by `share` of its weight
static fe_body push_cube_at_top(scene *s, double mu, double share, int steps)
{
    add_ground(s, friction(mu));
    fe_body cube = add_dynamic(s, box(0.5, 0.5, 0.5), v3(0, 0.5, 0), UNTURNED, friction(mu), WATER);
    run(s, 30);
    for (int i = 0; i < steps; ++i) {
        vec top = plus(position(s, cube), times(0.5, axis_of(s, cube, v3(0, 1, 0))));
        add_force_at(s, cube, v3(share * mass_of(s, cube) * G, 0, 0), top);
        run(s, 1);
    }
    return cube;
}

// mu < w / (2 z): it slides first, with a = (0.45 - 0.4) g, and stays level
static void a_cube_pushed_at_its_top_slides_below_half_friction(void **state)
{
    scene s = scene_begin(state);
    fe_body cube = push_cube_at_top(&s, 0.4, 0.45, 60);
    double v = 0.05 * G * 60 * STEP;
    FE_NEAR(velocity(&s, cube).x, v, 0.01 * v);
    FE_WITHIN(tilt(&s, cube), 0, LINEAR_SLOP);
    scene_end(&s);
}

// mu > w / (2 z): it neither slides nor tips below m g w / (2 z), and tips above
static void a_cube_pushed_at_its_top_tips_at_half_its_weight(void **state)
{
    scene s = scene_begin(state);
    fe_body cube = push_cube_at_top(&s, 0.6, 0.48, 300);
    FE_WITHIN(tilt(&s, cube), 0, LINEAR_SLOP);
    FE_NEAR(position(&s, cube).x, 0, LINEAR_SLOP);
    scene_end(&s);
    s = scene_begin(state);
    cube = push_cube_at_top(&s, 0.6, 0.52, 180);
    FE_WITHIN(tilt(&s, cube), 10 * DEGREES, PI);
    scene_end(&s);
}

// ---- the ladder -----------------------------------------------------------------------------------------------------
// A plank of length L and thickness t, at `angle` to the floor, between it (mu) and a smooth wall. It stands on the
// corners of its lower side: moments about the lower one give the wall's force  N = m g (1 / (2 tan) - t / (2 L)). It
// holds as long as N <= mu m g.

static const double LENGTH = 4, THICKNESS = 0.1;

typedef struct ladder {
    fe_body plank, wall;
} ladder;

static ladder add_ladder(scene *s, double angle, double mu)
{
    vec along = v3(cos(angle), sin(angle), 0), up = v3(-sin(angle), cos(angle), 0);
    vec foot = minus(times(-LENGTH / 2, along), times(THICKNESS / 2, up)),
        head = minus(times(LENGTH / 2, along), times(THICKNESS / 2, up));
    ladder l;
    add_ground(s, friction(mu));
    l.wall = add_plane(s, v3(-1, 0, 0), 0, SMOOTH);
    l.plank = add_dynamic(s, box(LENGTH / 2, THICKNESS / 2, 0.25), v3(-head.x, -foot.y, 0), turned(v3(0, 0, 1), angle),
                          friction(mu), WATER);
    return l;
}

static void a_ladder_holds_while_the_floor_can_carry_the_walls_force(void **state)
{
    scene s = scene_begin(state);
    double angle = 50 * DEGREES;
    ladder l = add_ladder(&s, angle, 0.5);
    FE_WITHIN(slip_in(&s, l.plank, 600), 0, LINEAR_SLOP);
    double push = mass_of(&s, l.plank) * G * (1 / (2 * tan(angle)) - THICKNESS / (2 * LENGTH));
    FE_NEAR(normal_impulse(&s, l.plank, l.wall) / STEP, push, 0.01 * push);
    scene_end(&s);
}

static void a_ladder_too_flat_slides_down(void **state)
{
    scene s = scene_begin(state);
    ladder l = add_ladder(&s, 40 * DEGREES, 0.5);
    double height = position(&s, l.plank).y;
    run(&s, 180);
    FE_WITHIN(position(&s, l.plank).y, 0, height / 2);
    scene_end(&s);
}

// ---- the A-frame ---------------------------------------------------------------------------------------------------
// Two boards, `length` long and `thick`, lean on each other edge to edge at an angle from the vertical; the second is
// turned by `askew` about the vertical. Each stands on an inner edge and leans with the inner edge of its other end, so
// that the force H between them, level by symmetry, has the arm length cos(angle), and the weight the arm of the
// centre:
//     H length cos(angle) = m g (length sin(angle) - thick cos(angle)) / 2
// They hold while H <= mu m g, or mu >= (tan(angle) - thick / length) / 2. Tolerance: 0.01, of which the depth of the
// contacts takes half.
typedef struct board {
    double length, thick, wide;
} board;

static double way_of_a_frame(void **state, board of, double angle, double askew, double mu)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(mu));
    vec start[2];
    fe_body boards[2];
    for (int i = 0; i < 2; ++i) {
        double side = i ? 1 : -1, turn = i ? askew : 0, end = of.wide / 2 * fabs(sin(turn));
        start[i] = v3(side * ((of.length * sin(angle) + of.thick * cos(angle)) / 2 + end),
                      (of.length * cos(angle) + of.thick * sin(angle)) / 2, 0);
        fe_quat leaning = turned(v3(0, 0, 1), side * angle);
        boards[i] = add_dynamic(&s, box(of.thick / 2, of.length / 2, of.wide / 2), start[i],
                                compose(turned(v3(0, 1, 0), turn), leaning), friction(mu), WATER);
    }
    run(&s, 300);
    double way = 0;
    for (int i = 0; i < 2; ++i) way = fmax(way, length(minus(position(&s, boards[i]), start[i])));
    scene_end(&s);
    return way;
}

static void boards_that_lean_on_each_other_hold_by_their_feet(void **state)
{
    static const board boards[] = {{2, 0.004, 0.6}, {1, 0.02, 0.4}, {0.5, 0.02, 0.3}};
    static const double askew[] = {0, 0.5, 2};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            for (int degrees = 15; degrees <= 40; degrees += 5) {
                double angle = degrees * DEGREES, mu = (tan(angle) - boards[i].thick / boards[i].length) / 2;
                FE_WITHIN(way_of_a_frame(state, boards[i], angle, askew[k] * DEGREES, mu + 0.01), 0, LINEAR_SLOP);
                FE_WITHIN(way_of_a_frame(state, boards[i], angle, askew[k] * DEGREES, mu - 0.01),
                          0.1 * boards[i].length, 2 * boards[i].length);
            }
}

// 25 degrees: 0.2321, of friction alone
static void an_a_frame_holds_from_half_the_tangent_of_its_angle(void **state)
{
    static const board thin = {2, 0.004, 0.6};
    for (int i = 0; i < 4; ++i) {
        double mu = 0.22 + 0.01 * i, way = way_of_a_frame(state, thin, 25 * DEGREES, 0, mu);
        if (mu < 0.23) FE_WITHIN(way, 0.2, 2);
        if (mu > 0.235) FE_WITHIN(way, 0, LINEAR_SLOP);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        EVERY_WAY_UP(a_box_on_20_degrees_stays_for_ten_seconds),
        TEST(a_box_sticks_just_below_the_angle_of_friction),
        TEST(a_box_slides_just_above_the_angle_of_friction),
        EVERY_WAY_UP(a_sliding_box_follows_coulomb),
        WITH_4_SUBSTEPS(a_sliding_box_follows_coulomb),
        TEST(a_sliding_box_follows_coulomb_on_a_plank),
        EVERY_WAY_UP(a_block_drags_a_free_slab_to_their_common_velocity),
        EVERY_WAY_UP(static_friction_holds_and_dynamic_friction_brakes),
        cmocka_unit_test(a_sudden_force_below_static_friction_moves_nothing),
        WITH_4_SUBSTEPS(a_sudden_force_below_static_friction_moves_nothing),
        TEST(a_box_set_down_on_a_slope_has_its_friction_at_once),
        WITH_4_SUBSTEPS(a_box_set_down_on_a_slope_has_its_friction_at_once),
        EVERY_WAY_UP(a_sliding_box_stops_after_the_same_way_in_every_direction),
        EVERY_WAY_UP(a_box_stands_below_its_tipping_angle),
        TEST(a_box_topples_above_its_tipping_angle),
        TEST(a_cube_pushed_at_its_top_slides_below_half_friction),
        TEST(a_cube_pushed_at_its_top_tips_at_half_its_weight),
        EVERY_WAY_UP(a_ladder_holds_while_the_floor_can_carry_the_walls_force),
        TEST(a_ladder_too_flat_slides_down),
        EVERY_WAY_UP(an_a_frame_holds_from_half_the_tangent_of_its_angle),
        TEST(boards_that_lean_on_each_other_hold_by_their_feet),
        WITH_4_SUBSTEPS(boards_that_lean_on_each_other_hold_by_their_feet),
    };
    return cmocka_run_group_tests_name("friction", tests, NULL, NULL);
}
