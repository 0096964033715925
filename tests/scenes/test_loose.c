// Loose stacks: gaps that carry nothing, which the solver skips, until something closes them.
#include "scenes/mechanics.h"

#include <string.h>

// ---- bits ----------------------------------------------------------------------------------------------------------

// n x n x n cubes on the ground, x and z from `aside` on, with gaps of 1 to 12 mm; a ball of speed u comes from aside,
// and hits one at its edge
static void build_stack(scene *s, int n, double aside, double u, fe_body *out)
{
    for (int i = 0; i < n * n * n; ++i) {
        double gap = 0.001 * (1 + i * 7 % 12);
        vec at = v3(aside + 0.512 * (i % n), 0.25 + 0.505 * (i / (n * n)), 0.51 * (i / n % n) + gap);
        out[i] = add_dynamic(s, box(0.25, 0.25, 0.25), at, UNTURNED, friction(0.5), WATER);
    }
    out[n * n * n] = add_dynamic(s, sphere(0.3), v3(aside - 3, 0.6, 0.4), UNTURNED, friction(0.5), 4 * WATER);
    set_velocity(s, out[n * n * n], v3(u, 0, u / 10), v3(0, 0, 20));
}

enum { LARGEST = 6, MOST_BODIES = LARGEST * LARGEST * LARGEST + 1 };

static void hash_of_shot(int simd, int workers, int n, int steps, uint32_t out_hash[4])
{
    fe_body bodies[MOST_BODIES];
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.substeps = 4, def.worker_count = workers, def.simd = simd, def.gravity = fe_make_vec3(0, -(float)G, 0);
    scene s = {NULL, UNTURNED, 4, STEP / 4};
    memset(out_hash, 0, 4 * sizeof *out_hash);
    if (fe_world_create(&def, &s.world) < 0) return; // not on this processor
    add_ground(&s, friction(0.5));
    build_stack(&s, n, 0, 30, bodies);
    run(&s, steps);
    MUST(fe_world_hash(s.world, out_hash));
    scene_end(&s);
}

// What is skipped hangs on who is beside whom in a row; what comes out does not. The impact comes within the first
// 6 steps, then everything moves and turns.
static void a_shot_stack_has_the_same_bits_on_every_set(void **state)
{
    static const int sizes[] = {3, LARGEST}; // islands below and above the size that all workers share
    (void)state;
    for (int k = 0; k < 2; ++k) {
        uint32_t first[4], other[4];
        hash_of_shot(FE_SIMD_PLAIN, 1, sizes[k], SLOW_BUILD ? 15 : 60, first);
        for (int simd = FE_SIMD_PLAIN; simd <= FE_SIMD_NEON; ++simd) {
            for (int workers = 1; workers <= 2; ++workers) {
                hash_of_shot(simd, workers, sizes[k], SLOW_BUILD ? 15 : 60, other);
                if (other[0] | other[1] | other[2] | other[3]) assert_memory_equal(first, other, sizeof first);
            }
        }
    }
}

// A ball whose centre of mass is `off` above that of its sphere, near the point next to another ball: that point
// hardly has an arm, the core of the ball has. Spins by w.
static fe_body add_wobbler(scene *s, vec at, double off, double w)
{
    fe_body body = add_dynamic(s, sphere(0.5), at, UNTURNED, friction(0.5), WATER);
    fe_mass_data mass = {.struct_size = sizeof mass, .mass = 10, .inertia = {1, 1, 1}};
    mass.centre = narrow(v3(0, off, 0));
    mass.inertia_rotation = UNTURNED;
    MUST(fe_body_set_mass_data(s->world, body, &mass));
    set_velocity(s, body, v3(0, 0, 0), v3(0, 0, w));
    return body;
}

// Velocities of two whose points are `gap` apart, after two steps beside `others` far off
static int motion_of_wobblers(int simd, int others, double gap, double w, vec out[4])
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.substeps = 8, def.simd = simd;
    scene s = {NULL, UNTURNED, 8, STEP / 8};
    if (fe_world_create(&def, &s.world) < 0) return 0; // not on this processor
    fe_body a = add_wobbler(&s, v3(0, 0, 0), 0.4999, w), b = add_wobbler(&s, v3(0, 1 + gap, 0), -0.4999, -w);
    // these touch: the row that they share with the pair is solved
    for (int i = 1; i <= others; ++i)
        add_wobbler(&s, v3(20 * i, 0, 0), 0, 0), add_wobbler(&s, v3(20 * i, 0.98, 0), 0, 0);
    run(&s, 2);
    out[0] = velocity(&s, a), out[1] = spin(&s, a), out[2] = velocity(&s, b), out[3] = spin(&s, b);
    scene_end(&s);
    return 1;
}

// How far a gap may close by rotation is a matter of the cores of round forms, too. Who shares a row with a touching
// pair hangs on what else there is, and on the row's width.
static void off_centre_balls_have_the_same_bits_beside_others(void **state)
{
    (void)state;
    for (double gap = 0.00005; gap < 0.005; gap *= 2)
        for (double w = 1; w < 30; w *= 3) {
            vec alone[4], beside[4];
            FE_TRUE(motion_of_wobblers(FE_SIMD_PLAIN, 0, gap, w, alone));
            for (int simd = FE_SIMD_PLAIN; simd <= FE_SIMD_NEON; ++simd)
                if (motion_of_wobblers(simd, 3, gap, w, beside)) assert_memory_equal(alone, beside, sizeof alone);
        }
}

// Stacks in a distance share rows with the first: they decide what of it is skipped, and change no bit of it.
static void stacks_far_off_change_no_bit(void **state)
{
    enum { SIDE = 3, COUNT = SIDE * SIDE * SIDE + 1, OTHERS = 6 };
    fe_body alone[COUNT], bodies[OTHERS + 1][COUNT];
    for (int others = 1; others <= OTHERS; ++others) {
        double u = others % 2 ? 30 : 60;
        scene s = scene_begin(state), t = scene_begin(state);
        add_ground(&s, friction(0.5)), add_ground(&t, friction(0.5));
        build_stack(&s, SIDE, 0, u, alone);
        build_stack(&t, SIDE, 0, u, bodies[0]);
        for (int i = 1; i <= others; ++i) build_stack(&t, SIDE, 100 * i, 60 / i, bodies[i]);
        run(&s, SLOW_BUILD ? 15 : 60), run(&t, SLOW_BUILD ? 15 : 60);
        for (int i = 0; i < COUNT; ++i) {
            vec apart = minus(position(&s, alone[i]), position(&t, bodies[0][i]));
            vec faster = minus(velocity(&s, alone[i]), velocity(&t, bodies[0][i]));
            vec turning = minus(spin(&s, alone[i]), spin(&t, bodies[0][i]));
            assert_true(dot(apart, apart) + dot(faster, faster) + dot(turning, turning) == 0);
        }
        scene_end(&s), scene_end(&t);
    }
}

// ---- laws ----------------------------------------------------------------------------------------------------------

// All gaps are closed and opened by contacts alone: energy comes from nowhere.
static void a_shot_stack_gains_no_energy(void **state)
{
    enum { SIDE = 4, COUNT = SIDE * SIDE * SIDE + 1 };
    fe_body bodies[COUNT];
    scene s = scene_begin(state);
    add_ground(&s, friction(0.5));
    build_stack(&s, SIDE, 0, 30, bodies);
    double before = totals_of(&s, bodies, COUNT).energy;
    for (int i = 0; i < 90; ++i) {
        run(&s, 1);
        double now = totals_of(&s, bodies, COUNT).energy;
        FE_WITHIN(now, 0, before * (1 + ENERGY_GAIN));
    }
    scene_end(&s);
}

// A heavy box runs at u into a row of boxes, 1 m each, with gaps between them, in weightlessness. The momentum stays
// and no energy is gained. Gaps are to be closed and no more: an order of the colours that is as bad as can be lets a
// box into the next by what it moves in the substep of the impact, and by no more than that in the one that stops it.
static void pushed_row(void **state, double gap, double u)
{
    enum { COUNT = 13 };
    fe_body bodies[COUNT];
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    bodies[0] = add_dynamic(&s, box(0.5, 0.5, 0.5), v3(-0.1, 0, 0), UNTURNED, friction(0.5), 20 * WATER);
    for (int i = 1; i < COUNT; ++i)
        bodies[i] = add_dynamic(&s, box(0.5, 0.5, 0.5), v3(i * (1 + gap), 0, 0), UNTURNED, friction(0.5), WATER);
    set_velocity(&s, bodies[0], v3(u, 0, 0), v3(0, 0, 0));
    totals first = totals_of(&s, bodies, COUNT);
    double kinetic = first.kinetic;
    for (int step = 0; step < 120; ++step) {
        run(&s, 1);
        totals now = totals_of(&s, bodies, COUNT);
        FE_NEAR(length(minus(now.momentum, first.momentum)), 0, rounding(120 * COUNT) * first.momenta);
        FE_WITHIN(now.kinetic, 0, kinetic * (1 + ENERGY_GAIN));
        for (int i = 1; i < COUNT; ++i)
            FE_WITHIN(position(&s, bodies[i]).x - position(&s, bodies[i - 1]).x, 1 - 2 * u * s.h, 100);
    }
    // nobody is left behind by what pushes
    for (int i = 1; i < COUNT; ++i) FE_WITHIN(velocity(&s, bodies[i]).x, velocity(&s, bodies[i - 1]).x - 0.01, 2 * u);
    scene_end(&s);
}

static void a_row_of_gaps_hands_a_push_on(void **state)
{
    pushed_row(state, 0.001, 5);
    pushed_row(state, 0.005, 5);
    pushed_row(state, 0.015, 5);
    pushed_row(state, 0.005, 0.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_shot_stack_has_the_same_bits_on_every_set), TEST(off_centre_balls_have_the_same_bits_beside_others),
        EVERY_WAY_UP(stacks_far_off_change_no_bit),        WITH_4_SUBSTEPS(stacks_far_off_change_no_bit),
        EVERY_WAY_UP(a_shot_stack_gains_no_energy),        WITH_4_SUBSTEPS(a_shot_stack_gains_no_energy),
        EVERY_WAY_UP(a_row_of_gaps_hands_a_push_on),       WITH_4_SUBSTEPS(a_row_of_gaps_hands_a_push_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
