// Which islands have finer substeps: those in which light bodies bear heavy ones, or are about to. Those of what is
// struck sideways, or for a moment, have not.
#include "scene.h"
#include "world/world.h"

#define LIGHT 1.0      // kg
#define MOST_SINK 0.05 // m: what an impact may sink before it strains

static int strained(const scene *s)
{
    const fe__solver *solver = &s->world->solver;
    for (int32_t i = 0; i < solver->batch_count; ++i)
        if (solver->batches[i].pace == FE__STRAINED) return 1;
    return 0;
}

static int steps_strained(scene *s, int steps)
{
    int count = 0;
    for (int i = 0; i < steps; ++i) {
        run(s, 1);
        count += strained(s);
    }
    return count;
}

static fe_body add_cube(scene *s, vec at, double mass, vec speed)
{
    fe_body body = add_dynamic(s, box(0.5, 0.5, 0.5), at, UNTURNED, friction(0.6), (float)mass); // of 1 m3
    set_velocity(s, body, speed, v3(0, 0, 0));
    return body;
}

// A cube of `ratio` times the mass of one on the ground comes upon it at `speed` from above, in the first step
static int strains_at_once(void **state, double ratio, double speed)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    add_cube(&s, v3(0, 0.5, 0), LIGHT, v3(0, 0, 0));
    add_cube(&s, v3(0, 1.505, 0), ratio * LIGHT, v3(0, -speed, 0));
    run(&s, 1);
    int result = strained(&s);
    scene_end(&s);
    return result;
}

// Two passes a substep, each takes one part in 1 + ratio of the speed u: the sum of what is left, times h / 2
static void an_impact_that_would_sink_by_5_cm_strains_at_once(void **state)
{
    const int substeps = ((const setup *)*state)->substeps;
    const double ratios[] = {8, 15, 50};
    for (int i = 0; i < 3; ++i) {
        double speed = MOST_SINK * 2 * substeps / (STEP * (1 + ratios[i]));
        FE_TRUE(strains_at_once(state, ratios[i], 1.05 * speed));
        FE_TRUE(!strains_at_once(state, ratios[i], 0.95 * speed));
    }
    FE_TRUE(!strains_at_once(state, 4, 20));
    FE_TRUE(!strains_at_once(state, 1, 20));
}

static void what_falls_on_a_heavier_one_strains_nothing(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    add_cube(&s, v3(0, 0.5, 0), 15 * LIGHT, v3(0, 0, 0));
    add_cube(&s, v3(0, 1.505, 0), LIGHT, v3(0, -10, 0));
    FE_TRUE(steps_strained(&s, 60) == 0);
    scene_end(&s);
}

// Nothing holds the light one: the heavy one pushes it along
static void what_is_struck_sideways_is_not_strained(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    add_cube(&s, v3(0, 0.5, 0), LIGHT, v3(0, 0, 0));
    add_cube(&s, v3(1.1, 0.5, 0), 50 * LIGHT, v3(-12, 0, 0));
    FE_TRUE(steps_strained(&s, 60) == 0);
    scene_end(&s);
}

// Without gravity there is no up: any heavy body that comes may pinch a light one
static void without_gravity_every_direction_counts(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    add_cube(&s, v3(0, 0.5, 0), LIGHT, v3(0, 0, 0));
    add_cube(&s, v3(1.005, 0.5, 0), 50 * LIGHT, v3(-12, 0, 0));
    FE_TRUE(steps_strained(&s, 1) == 1);
    scene_end(&s);
}

// 100 times the mass is 101 times the weight on the ground's contact, more than 80; 30 times is not
static void a_load_that_lasts_strains_while_it_lasts(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    add_cube(&s, v3(0, 0.5, 0), LIGHT, v3(0, 0, 0));
    fe_body heavy = add_cube(&s, v3(0, 1.5, 0), 100 * LIGHT, v3(0, 0, 0));
    run(&s, 6);
    FE_TRUE(steps_strained(&s, 60) == 60);
    MUST(fe_body_destroy(s.world, heavy));
    run(&s, 2);
    FE_TRUE(steps_strained(&s, 60) == 0);
    add_cube(&s, v3(0, 1.5, 0), 30 * LIGHT, v3(0, 0, 0));
    FE_TRUE(steps_strained(&s, 120) == 0);
    scene_end(&s);
}

// A press: 200 times the light one's weight, sideways against a wall
static void a_load_from_the_side_strains_what_a_wall_holds(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0));
    add_static(&s, box(0.5, 2, 2), v3(-1, 2, 0), UNTURNED, friction(0.6));
    add_cube(&s, v3(0, 0.5, 0), LIGHT, v3(0, 0, 0));
    fe_body heavy = add_cube(&s, v3(1, 0.5, 0), 20 * LIGHT, v3(0, 0, 0));
    int count = 0;
    for (int i = 0; i < 60; ++i) {
        add_force(&s, heavy, v3(-200 * LIGHT * G, 0, 0));
        run(&s, 1);
        count += i >= 6 && strained(&s);
    }
    FE_TRUE(count == 54);
    scene_end(&s);
}

// The load of an impact is over after a step, however hard it is
static void an_impact_is_no_load(void **state)
{
    for (int speed = 4; speed <= 16; speed += 4) {
        scene s = scene_begin(state);
        add_ground(&s, friction(0.6));
        add_cube(&s, v3(0, 0.5, 0), LIGHT, v3(0, 0, 0));
        add_cube(&s, v3(0, 1.505, 0), 4 * LIGHT, v3(0, -speed, 0));
        FE_TRUE(steps_strained(&s, 60) == 0);
        scene_end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        EVERY_WAY_UP(an_impact_that_would_sink_by_5_cm_strains_at_once),
        WITH_4_SUBSTEPS(an_impact_that_would_sink_by_5_cm_strains_at_once),
        TEST(what_falls_on_a_heavier_one_strains_nothing),
        TEST(what_is_struck_sideways_is_not_strained),
        WITH_4_SUBSTEPS(what_is_struck_sideways_is_not_strained),
        TEST_WITH(what_is_struck_sideways_is_not_strained, ", askew", askew),
        TEST(without_gravity_every_direction_counts),
        EVERY_WAY_UP(a_load_that_lasts_strains_while_it_lasts),
        WITH_4_SUBSTEPS(a_load_that_lasts_strains_while_it_lasts),
        TEST(a_load_from_the_side_strains_what_a_wall_holds),
        TEST(an_impact_is_no_load),
        WITH_4_SUBSTEPS(an_impact_is_no_load),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
