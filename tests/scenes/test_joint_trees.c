// Joints without a loop under a heavy load are met exactly: whatever their type, whatever hangs on them, whoever holds
// them.
#include "scenes/joint_scene.h"

#include <string.h>

enum { LINKS = 12, MOST_BODIES = 40 };
#define STEP_LENGTH 0.2 // m, from joint to joint
#define EXACT (LINEAR_SLOP / 10)

static int trees_of(const scene *s)
{
    fe_counters counters = {.struct_size = sizeof counters};
    MUST(fe_world_get_counters(s->world, &counters));
    return counters.trees;
}

static void set_mass(scene *s, fe_body body, double mass) { MUST(fe_body_set_mass(s->world, body, (float)mass)); }

typedef struct chain {
    fe_body bodies[MOST_BODIES];
    fe_joint joints[MOST_BODIES];
    int count; // of bodies
} chain;

// a row of links of 1 kg downwards from the origin, a load at its end
static chain hang(scene *s, link_kind k, fe_body above, double load)
{
    chain c = {.count = LINKS};
    for (int i = 0; i < LINKS; ++i) {
        vec top = v3(0, -STEP_LENGTH * i, 0);
        c.bodies[i] = add_plain(s, box(0.04, 0.08, 0.04), plus(top, v3(0, -STEP_LENGTH / 2, 0)));
        touch_nothing(s, c.bodies[i]);
        set_mass(s, c.bodies[i], i < LINKS - 1 ? 1 : load);
        c.joints[i] = link_bodies(s, k, i ? c.bodies[i - 1] : above, c.bodies[i], top);
    }
    return c;
}

static double widest_gap(const scene *s, const chain *c) { return worst_gap(s, c->joints, c->count); }

// ---- exact ---------------------------------------------------------------------------------------------------------

// A thousand links swung sideways with 3 m/s, a hundred on rods: what calms light links sees turns, not the way across
// a rod. Rods and hinges swing, sliders slide, fixed ones stay
static void a_load_swings(void **state, link_kind k, double load)
{
    scene s = scene_begin(state);
    chain c = hang(&s, k, add_anchor(&s, v3(0, 0, 0)), load);
    set_velocity(&s, c.bodies[LINKS - 1], v3(k == LINK_FIXTURES || k == LINK_SLIDERS ? 0 : 3, 0, 0), v3(0, 0, 0));
    const double start = totals_of(&s, c.bodies, c.count).energy, turned_over = load * G * LINKS * STEP_LENGTH;
    for (int i = 0; i < (SLOW_BUILD ? 60 : 300); ++i) {
        run(&s, 1);
        FE_TRUE(trees_of(&s) == 1);
        FE_WITHIN(widest_gap(&s, &c), 0, EXACT);
        FE_WITHIN(totals_of(&s, c.bodies, c.count).energy, -1e9, start + 1e-4 * turned_over);
    }
    scene_end(&s);
}
static void on_ball_joints(void **state) { a_load_swings(state, LINK_BALLS, 1000); }
static void on_hinges(void **state) { a_load_swings(state, LINK_HINGES, 1000); }
static void on_fixed_joints(void **state) { a_load_swings(state, LINK_FIXTURES, 1000); }
static void on_rods(void **state) { a_load_swings(state, LINK_RODS, 100); }
static void on_sliders(void **state) { a_load_swings(state, LINK_SLIDERS, 1000); }

// A beam of twelve fixed joints, held at one end, a load of fifty links at the other: P2 of its first joint alone is a
// sag of 40 degrees
static void a_beam_does_not_bend(void **state)
{
    scene s = scene_begin(state);
    fe_body held = add_anchor(&s, v3(0, 0, 0)), last = 0;
    for (int i = 0; i < LINKS; ++i) {
        last = add_plain(&s, box(0.08, 0.04, 0.04), v3(STEP_LENGTH * (i + 0.5), 0, 0));
        touch_nothing(&s, last);
        set_mass(&s, last, i < LINKS - 1 ? 1 : 50);
        add_fixed(&s, fixed_def(), held, last, v3(STEP_LENGTH * i, 0, 0));
        held = last;
    }
    for (int i = 0; i < (SLOW_BUILD ? 60 : 300); ++i) {
        run(&s, 1);
        FE_NEAR(position(&s, last).y, 0, EXACT);
    }
    scene_end(&s);
}

// The reaction is the weight below, as measured at rest
static void reactions_are_the_weight_below(void **state)
{
    scene s = scene_begin(state);
    chain c = hang(&s, LINK_BALLS, add_anchor(&s, v3(0, 0, 0)), 1000);
    run(&s, 30);
    for (int i = 0; i < LINKS; ++i) FE_NEAR(force_of(&s, c.joints[i]).y, (1000 + LINKS - 1 - i) * G, 1e-4 * 1000 * G);
    scene_end(&s);
}

// Two loads on a light chain between them, turning about each other in the void: nothing outside holds them
static void a_free_tree_keeps_its_momenta(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    chain c = hang(&s, LINK_BALLS, add_anchor(&s, v3(0, 0, 0)), 500);
    MUST(fe_joint_destroy(s.world, c.joints[0]));
    set_mass(&s, c.bodies[0], 500);
    set_velocity(&s, c.bodies[0], v3(2, 0, 0.5), v3(0, 0, 0)),
        set_velocity(&s, c.bodies[LINKS - 1], v3(-2, 0, 0), v3(0, 0, 0));
    const totals start = totals_of(&s, c.bodies, c.count);
    for (int i = 0; i < (SLOW_BUILD ? 60 : 300); ++i) {
        run(&s, 1);
        const totals now = totals_of(&s, c.bodies, c.count);
        FE_TRUE(trees_of(&s) == 1);
        FE_WITHIN(worst_gap(&s, c.joints + 1, LINKS - 1), 0, EXACT);
        FE_WITHIN(length(minus(now.momentum, start.momentum)), 0,
                  2e-5 * start.momenta); // 300 x 8 x 12 roundings of 2^-25 at random: a third of it
        FE_WITHIN(length(minus(now.angular, start.angular)), 0, 1e-3 * start.angular_all);
        FE_WITHIN(now.kinetic, 0, (1 + 1e-4) * start.kinetic);
    }
    scene_end(&s);
}

// Branches of all kinds with masses of 1 to 1000 kg, flung about
static void random_trees_hold(void **state)
{
    dice d = {.state = 7};
    for (int seed = 0; seed < (SLOW_BUILD ? 3 : 20); ++seed) {
        scene s = scene_begin(state);
        chain c = {.count = 8 + pick(&d, 24)};
        fe_body anchor = add_anchor(&s, v3(0, 0, 0));
        vec places[MOST_BODIES];
        for (int i = 0; i < c.count; ++i) {
            int above = i ? pick(&d, i) : 0;
            vec from = i ? places[above] : v3(0, 0, 0);
            places[i] = plus(from, plus(somewhere(&d, 0.3), v3(0.3, 0, 0)));
            c.bodies[i] = add_dynamic(&s, any_form(&d, 0.3), places[i], any_rotation(&d), friction(0.6), WATER);
            touch_nothing(&s, c.bodies[i]);
            set_mass(&s, c.bodies[i], pick(&d, 3) ? uniform(&d, 1, 5) : uniform(&d, 100, 1000));
            set_velocity(&s, c.bodies[i], somewhere(&d, 3), v3(0, 0, 0));
            c.joints[i] = link_bodies(&s, (link_kind)pick(&d, LINK_RODS), i ? c.bodies[above] : anchor, c.bodies[i],
                                      times(0.5, plus(from, places[i])));
        }
        run(&s, 1); // flung apart, then held
        const double start = totals_of(&s, c.bodies, c.count).energy;
        double turned_over = 0;
        for (int i = 0; i < c.count; ++i) turned_over += mass_of(&s, c.bodies[i]) * G * length(places[i]);
        for (int i = 0; i < 300; ++i) {
            run(&s, 1);
            FE_TRUE(trees_of(&s) == 1);
            FE_WITHIN(widest_gap(&s, &c), 0, LINEAR_SLOP);
            FE_WITHIN(totals_of(&s, c.bodies, c.count).energy, -1e9, start + 1e-2 * turned_over);
        }
        scene_end(&s);
    }
}

// A trolley that drives to and fro carries a load of a thousand links
static void a_trolley_carries_its_load(void **state)
{
    scene s = scene_begin(state);
    fe_body trolley = add_body(&s, FE_BODY_KINEMATIC, box(0.2, 0.1, 0.2), v3(0, 0, 0), UNTURNED, friction(0.6), WATER);
    chain c = hang(&s, LINK_BALLS, trolley, 1000);
    for (int i = 0; i < (SLOW_BUILD ? 60 : 300); ++i) {
        set_velocity(&s, trolley, v3(2 * cos(0.05 * i), 0, 0), v3(0, 0, 0));
        run(&s, 1);
        FE_WITHIN(widest_gap(&s, &c), 0, EXACT);
    }
    scene_end(&s);
}

// In the plane, by locks
static void locked_bodies_swing_in_their_plane(void **state)
{
    scene s = scene_begin(state);
    chain c = hang(&s, LINK_BALLS, add_anchor(&s, v3(0, 0, 0)), 1000);
    for (int i = 0; i < LINKS; ++i) MUST(fe_body_set_locks(s.world, c.bodies[i], FE_AXIS_Z, FE_AXIS_X | FE_AXIS_Y));
    set_velocity(&s, c.bodies[LINKS - 1], v3(3, 0, 0), v3(0, 0, 0));
    double farthest = 0;
    for (int i = 0; i < (SLOW_BUILD ? 60 : 300); ++i) {
        run(&s, 1);
        FE_WITHIN(widest_gap(&s, &c), 0, EXACT);
        FE_NEAR(position(&s, c.bodies[LINKS - 1]).z, 0, 0);
        farthest = fmax(farthest, position(&s, c.bodies[LINKS - 1]).x);
    }
    FE_WITHIN(farthest, SLOW_BUILD ? 0.5 : 1.2, 2); // v2 / 2g = 0.46 m up on 2.3 m: 1.38 m out
    scene_end(&s);
}

// ---- side by side --------------------------------------------------------------------------------------------------
// the last pose of a chain that is flung, beside so many others of its form that are flung harder
static void fling(void **state, link_kind k, double load, int beside, fe_transform out_poses[LINKS])
{
    scene s = scene_begin(state);
    fe_body anchor = add_anchor(&s, v3(0, 0, 0));
    chain c = hang(&s, k, anchor, load);
    set_velocity(&s, c.bodies[LINKS - 1], v3(20, 0, 0), v3(0, 0, 0));
    for (int i = 1; i <= beside; ++i) {
        chain other = hang(&s, k, anchor, load);
        set_velocity(&s, other.bodies[LINKS - 1], v3(20 + 8 * i, 3 * i, 5 * i), v3(0, 0, 0));
    }
    for (int i = 0; i < (SLOW_BUILD ? 30 : 90); ++i) {
        run(&s, 1);
        if (load > 1) FE_TRUE(trees_of(&s) == 1 + beside);
    }
    for (int i = 0; i < LINKS; ++i) MUST(fe_body_get_transform(s.world, c.bodies[i], out_poses + i));
    scene_end(&s);
}

// What happens to a tree is nothing to one of its form: taut or slack, struck or not, it ends where it ends alone
static void neighbours_do_not_show(void **state)
{
    static const int beside[] = {1, 8};
    for (int k = 0; k < LINK_KINDS; ++k)
        for (double load = 1; load < 1e4; load *= 100) {
            fe_transform alone[LINKS], among[LINKS];
            fling(state, (link_kind)k, load, 0, alone);
            for (size_t i = 0; i < sizeof beside / sizeof *beside; ++i) {
                fling(state, (link_kind)k, load, beside[i], among);
                for (int j = 0; j < LINKS; ++j) {
                    FE_TRUE(!memcmp(&alone[j].position, &among[j].position, sizeof alone[j].position));
                    FE_TRUE(!memcmp(&alone[j].rotation, &among[j].rotation, sizeof alone[j].rotation));
                }
            }
        }
}

// ---- which are trees -----------------------------------------------------------------------------------------------

// A second hold closes a loop through the world; without it the chain is a tree again, and nothing tells that there was
// one
static void a_loop_is_no_tree(void **state)
{
    uint32_t words[2][2];
    for (int with = 0; with < 2; ++with) {
        scene s = scene_begin(state);
        fe_body anchor = add_anchor(&s, v3(0, 0, 0)), spare = add_anchor(&s, v3(0, -STEP_LENGTH * LINKS, 0));
        chain c = hang(&s, LINK_BALLS, anchor, 1000);
        fe_joint second =
            add_ball(&s, ball_def(), c.bodies[LINKS - 1], spare, v3(0, -STEP_LENGTH * LINKS, 0), v3(0, 1, 0));
        if (!with) MUST(fe_joint_set_enabled(s.world, second, 0));
        MUST(fe_world_step(s.world, 0)); // finds what there is of trees, moves nothing
        if (with) MUST(fe_joint_set_enabled(s.world, second, 0));
        run(&s, 60);
        FE_TRUE(trees_of(&s) == 1);
        MUST(fe_world_hash(s.world, words[with]));
        MUST(fe_joint_set_enabled(s.world, second, 1));
        run(&s, 1);
        FE_TRUE(trees_of(&s) == 0);
        scene_end(&s);
    }
    FE_TRUE(words[0][0] == words[1][0] && words[0][1] == words[1][1]);
}

// Light chains with a limit are left to the sweep; a mass set later counts from the next step on
static void a_heavy_load_makes_a_tree(void **state)
{
    scene s = scene_begin(state);
    chain c = hang(&s, LINK_BALLS, add_anchor(&s, v3(0, 0, 0)), 1);
    add_slack_rope(&s, c.bodies[0], c.bodies[1]);
    run(&s, 1);
    FE_TRUE(trees_of(&s) == 0);
    set_mass(&s, c.bodies[LINKS - 1], 1000);
    run(&s, 120);
    FE_TRUE(trees_of(&s) == 1);
    FE_WITHIN(widest_gap(&s, &c), 0, EXACT);
    fe_ball_joint_def spring = {.struct_size = sizeof spring}; // a joint with a stiffness of its own is a spring
    MUST(fe_ball_joint_get(s.world, c.joints[0], &spring));
    spring.hertz = 5;
    MUST(fe_ball_joint_set(s.world, c.joints[0], &spring));
    run(&s, 120);
    FE_WITHIN(gap_of(&s, c.joints[0]), 1, 20); // at rest 1.01 t g / (1 kg (2 pi 5 Hz)^2) = 10 m, and falls as far again
    FE_WITHIN(worst_gap(&s, c.joints + 1, LINKS - 1), 0, EXACT);
    scene_end(&s);
}

// A few bodies that only locks hold are a tree whatever they weigh. A limit, a spring or a locked body among them, or a
// lone body: the sweep's
static void a_light_mechanism_is_a_tree(void **state)
{
    enum { PLAIN, LIMIT, SPRING, LOCKED_BODY, LONE, CASES };
    for (int k = 0; k < CASES; ++k) {
        scene s = scene_begin(state);
        fe_body anchor = add_anchor(&s, v3(0, 0, 0)), upper = add_plain(&s, box(0.1, 0.1, 0.1), v3(0, -0.2, 0)),
                lower = add_plain(&s, box(0.1, 0.1, 0.1), v3(0, -0.6, 0));
        fe_hinge_joint_def hinge = hinge_def();
        fe_ball_joint_def ball = ball_def();
        if (k == LIMIT) hinge.limit_enabled = 1, hinge.lower = -1, hinge.upper = 1;
        if (k == SPRING) ball.hertz = 5;
        add_hinge(&s, hinge, anchor, upper, v3(0, 0, 0), v3(0, 0, 1));
        if (k != LONE) add_ball(&s, ball, upper, lower, v3(0, -0.4, 0), v3(1, 0, 0));
        if (k == LOCKED_BODY) MUST(fe_body_set_locks(s.world, lower, 0, FE_AXIS_X));
        run(&s, 1);
        FE_TRUE(trees_of(&s) == (k == PLAIN));
        scene_end(&s);
    }
}

// Two rods of 1 m and 1 kg on hinges, from the horizontal: 10 s, the energy of the discrete flight. Of the 2 m g l that
// they turn over they gain so much at most and lose 3 %, and their anchors stay within a millimetre
static void swing_two_rods(void **state, double most)
{
    const double thin = 0.01, turned_over = 2 * G;
    scene s = scene_begin(state);
    fe_body rods[2], above = add_anchor(&s, v3(0, 0, 0));
    fe_joint hinges[2];
    fe_energy energy = {.struct_size = sizeof energy};
    for (int i = 0; i < 2; ++i) {
        rods[i] = add_plain(&s, box(0.5, thin, thin), v3(0.5 + i, 0, 0));
        touch_nothing(&s, rods[i]);
        set_mass(&s, rods[i], 1);
        MUST(fe_body_set_sleep_allowed(s.world, rods[i], 0));
        hinges[i] = add_hinge(&s, hinge_def(), i ? rods[0] : above, rods[i], v3(i, 0, 0), v3(0, 0, 1));
    }
    MUST(fe_world_get_energy(s.world, &energy));
    const double start = energy.kinetic + energy.potential;
    for (int i = 0; i < 600; ++i) {
        run(&s, 1);
        MUST(fe_world_get_energy(s.world, &energy));
        FE_WITHIN(energy.kinetic + energy.potential - start, -0.03 * turned_over, most);
        FE_WITHIN(worst_gap(&s, hinges, 2), 0, 0.001);
    }
    scene_end(&s);
}

// 0.05 %
static void a_double_pendulum_keeps_its_energy(void **state) { swing_two_rods(state, 5e-4 * 2 * G); }

// A velocity of 5 m/s is rounded by 1.4e-7 m/s, of which 1 kg makes 7e-7 J. Some six roundings a body and substep are
// 230 000 of them, and no two have to do with each other: 480 times as much. Bound: three times that
static void finer_substeps_round_no_energy_into_a_pendulum(void **state) { swing_two_rods(state, 3 * 480 * 7e-7); }
SETUP upright_32 = {{0, 0, 0, 1}, 32};

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(on_ball_joints),
        TEST(on_hinges),
        TEST(on_fixed_joints),
        TEST(on_rods),
        TEST(on_sliders),
        TEST(a_beam_does_not_bend),
        TEST(reactions_are_the_weight_below),
        TEST(a_free_tree_keeps_its_momenta),
        TEST(random_trees_hold),
        TEST(a_trolley_carries_its_load),
        TEST(locked_bodies_swing_in_their_plane),
        TEST(neighbours_do_not_show),
        TEST(a_loop_is_no_tree),
        TEST(a_heavy_load_makes_a_tree),
        TEST(a_light_mechanism_is_a_tree),
        TEST(a_double_pendulum_keeps_its_energy),
        WITH_4_SUBSTEPS(a_double_pendulum_keeps_its_energy),
        TEST_WITH(finer_substeps_round_no_energy_into_a_pendulum, ", 32 substeps", upright_32),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
