// Near misses: what stands near but does not touch costs no narrow phase while nothing moves against each other, and
// has the right contact as soon as it does.
#include "scenes/mechanics.h"

static fe_counters counters_of(const scene *s)
{
    fe_counters counters = {.struct_size = sizeof counters};
    MUST(fe_world_get_counters(s->world, &counters));
    return counters;
}

// Three layers of 4 x 4 cubes, `gap` m from each other in their layer
static void add_layers(scene *s, double gap, double layer_gap)
{
    enum { SIDE = 4, LAYERS = 3 };
    for (int i = 0; i < SIDE * SIDE * LAYERS; ++i) {
        int x = i % SIDE, y = i / (SIDE * SIDE), z = i / SIDE % SIDE;
        vec at = v3(x * (1 + gap), 0.5 + y * (1 + layer_gap), z * (1 + gap));
        add_dynamic(s, box(0.5, 0.5, 0.5), at, UNTURNED, friction(0.6), WATER);
    }
}

// In each of the next steps every pair keeps what the narrow phase once found
static void expect_no_tests(scene *s, int steps)
{
    for (int i = 0; i < steps; ++i) {
        run(s, 1);
        fe_counters now = counters_of(s);
        FE_TRUE(now.pairs > 0);
        FE_TRUE(now.recycled == now.pairs);
    }
}

// Stacks that stand side by side, nearer and farther than the speculative distance of 2 cm, and just at it
static void neighbours_at_rest_are_not_tested_anew(void **state)
{
    static const double gaps[] = {0.003, 0.006, 0.01, 0.019, 0.02, 0.021, 0.03};
    for (int i = 0; i < (int)(sizeof gaps / sizeof *gaps); ++i) {
        scene s = scene_begin(state);
        add_ground(&s, friction(0.6));
        add_layers(&s, gaps[i], 0);
        run(&s, 60);
        expect_no_tests(&s, 60);
        scene_end(&s);
    }
}

// Falling, all have the same velocity: nothing moves against anything
static void neighbours_that_fall_together_are_not_tested_anew(void **state)
{
    scene s = scene_begin(state);
    add_layers(&s, 0.01, 0.01);
    run(&s, 1);
    expect_no_tests(&s, 60);
    scene_end(&s);
}

// A ball hovers over a box, by its edge, until the pair is recycled. Then it is thrown so that it touches the edge
// within one step: not the face that it stood over. Where its centre comes to |c| = r from the edge, along n = c / r,
// it loses its speed along n (restitution and friction 0, so nothing else): v' = v - (v.n) n. It grazes: 1 mm of its
// way turns n by 0.01 rad, and changes v.n by 0.07 m/s. Bound: 2 mm. The face's normal would take 1.2 m/s along y.
static void a_ball_that_hovered_touches_the_edge(void **state)
{
    const double r = 0.1, inside = 0.051, gap = 0.01;
    const vec v = v3(7, -1.2, 0), from = v3(-inside, r + gap, 0);
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    add_static(&s, box(0.5, 0.5, 0.5), v3(-0.5, -0.5, 0), UNTURNED, friction(0));
    fe_body ball = add_dynamic(&s, sphere(r), from, UNTURNED, friction(0), WATER);
    run(&s, 5);
    FE_TRUE(counters_of(&s).contacts == 1);
    FE_TRUE(counters_of(&s).recycled == 1);
    set_velocity(&s, ball, v, v3(0, 0, 0));
    run(&s, 1);
    double b = dot(from, v), time = (-b - sqrt(b * b - dot(v, v) * (dot(from, from) - r * r))) / dot(v, v);
    FE_WITHIN(time, 0, STEP);
    vec n = times(1 / r, plus(from, times(time, v))), left = minus(v, times(dot(v, n), n));
    FE_WITHIN(length(minus(velocity(&s, ball), left)), 0, 2e-3 * length(v) / r);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(neighbours_at_rest_are_not_tested_anew),
        WITH_4_SUBSTEPS(neighbours_at_rest_are_not_tested_anew),
        TEST_WITH(neighbours_at_rest_are_not_tested_anew, ", z up", up_along_z),
        TEST(neighbours_that_fall_together_are_not_tested_anew),
        EVERY_WAY_UP(a_ball_that_hovered_touches_the_edge),
        WITH_4_SUBSTEPS(a_ball_that_hovered_touches_the_edge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
