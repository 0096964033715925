// Sleep: islands fall asleep and wake as one, what touches a sleeper wakes it, and what sleeps does not change one bit.
#include "scenes/mechanics.h"

#include <string.h>

// as add_dynamic, but it may sleep
static fe_body add_sleeper(scene *s, fe_geometry form, vec at)
{
    fe_body body = add_dynamic(s, form, at, UNTURNED, friction(0.6), WATER);
    MUST(fe_body_set_sleep_allowed(s->world, body, 1));
    return body;
}

static int awake(const scene *s, fe_body body)
{
    int32_t is = -1;
    MUST(fe_body_get_awake(s->world, body, &is));
    return is;
}

static int awake_count(const scene *s)
{
    fe_counters counters = {.struct_size = sizeof counters};
    MUST(fe_world_get_counters(s->world, &counters));
    return counters.awake_bodies;
}

static uint64_t hash_of(const scene *s)
{
    uint32_t words[2];
    MUST(fe_world_hash(s->world, words));
    return (uint64_t)words[1] << 32 | words[0];
}

// steps until nothing is awake; how many it took
static int settle(scene *s, int most)
{
    int steps = 0;
    while (steps < most && (awake_count(s) || !steps)) run(s, 1), ++steps;
    FE_TRUE(awake_count(s) == 0);
    return steps;
}

static int count_pair_events(const scene *s, int kind)
{
    fe_pair_event events[64];
    int32_t count = fe_world_get_pair_events(s->world, events, sizeof *events, 64), found = 0;
    FE_WITHIN(count, 0, 64);
    for (int i = 0; i < count; ++i) found += events[i].kind == kind;
    return found;
}

static int body_event(const scene *s, fe_body body, int kind)
{
    fe_body_event events[64];
    int32_t count = fe_world_get_body_events(s->world, events, sizeof *events, 64), found = 0;
    FE_WITHIN(count, 0, 64);
    for (int i = 0; i < count; ++i) found += events[i].body == body && events[i].kind == kind;
    return found;
}

static fe_geometry cube(void) { return box(0.5, 0.5, 0.5); }

enum { TOWER = 4 };

static void build_tower(scene *s, fe_body *bodies, double x)
{
    for (int i = 0; i < TOWER; ++i) bodies[i] = add_sleeper(s, cube(), v3(x, 0.5 + i, 0));
}

static int all_awake(const scene *s, const fe_body *bodies, int count)
{
    int sum = 0;
    for (int i = 0; i < count; ++i) sum += awake(s, bodies[i]);
    FE_TRUE(sum == 0 || sum == count); // an island is of one mind
    return sum != 0;
}

// ---- falling asleep ------------------------------------------------------------------------------------------------

// 0.5 s below 0.05 m/s: a body at rest from the start sleeps after 30 steps, the rounding of 30 sums included one more.
static void a_body_at_rest_sleeps_after_half_a_second(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body body = add_sleeper(&s, cube(), v3(0, 0, 0));
    FE_WITHIN(settle(&s, 100), 30, 31);
    FE_TRUE(body_event(&s, body, FE_EVENT_SLEEP) == 1);
    FE_NEAR(length(velocity(&s, body)), 0, 0);
    run(&s, 1);
    FE_TRUE(body_event(&s, body, FE_EVENT_SLEEP) == 0);
    scene_end(&s);
}

// The fastest point counts: turning at w, a corner moves at w times its distance from the centre.
static void the_fastest_point_decides(void **state)
{
    static const double shares[] = {0.9, 1.1};
    for (int i = 0; i < 2; ++i) {
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        fe_body slides = add_sleeper(&s, cube(), v3(0, 0, 0)), turns = add_sleeper(&s, sphere(0.5), v3(5, 0, 0));
        set_velocity(&s, slides, v3(0.05 * shares[i], 0, 0), v3(0, 0, 0));
        set_velocity(&s, turns, v3(0, 0, 0), v3(0, 0.05 / 0.5 * shares[i], 0));
        run(&s, 60);
        FE_TRUE(awake(&s, slides) == (shares[i] > 1));
        FE_TRUE(awake(&s, turns) == (shares[i] > 1));
        scene_end(&s);
    }
}

// What pushes bodies apart adds nothing to their velocity: born at one place they are out of each other, but for the
// slop, before they sleep.
static void what_is_pushed_apart_is_not_at_rest(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body a = add_sleeper(&s, cube(), v3(0, 0, 0)), b = add_sleeper(&s, cube(), v3(0.01, 0.01, 0));
    settle(&s, 200);
    vec d = minus(position(&s, b), position(&s, a));
    FE_WITHIN(fmax(fmax(fabs(d.x), fabs(d.y)), fabs(d.z)), 1 - LINEAR_SLOP, 1.1);
    scene_end(&s);
}

static void threshold_time_and_permission_are_obeyed(void **state)
{
    scene s = scene_begin(state);
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.sleep_time = 2;
    MUST(fe_world_set_tuning(s.world, &tuning));
    set_gravity(&s, v3(0, 0, 0));
    fe_body at_rest = add_sleeper(&s, cube(), v3(0, 0, 0)), lively = add_sleeper(&s, cube(), v3(5, 0, 0));
    fe_body forbidden = add_dynamic(&s, cube(), v3(10, 0, 0), UNTURNED, friction(0.6), WATER);
    set_velocity(&s, lively, v3(0.04, 0, 0), v3(0, 0, 0));
    MUST(fe_body_set_sleep_threshold(s.world, lively, 0.03f));
    run(&s, 118);
    FE_TRUE(awake(&s, at_rest));
    run(&s, 4);
    FE_TRUE(!awake(&s, at_rest));
    run(&s, 120);
    FE_TRUE(awake(&s, lively));
    FE_TRUE(awake(&s, forbidden));
    scene_end(&s);
}

static void an_island_falls_asleep_as_one(void **state)
{
    scene s = scene_begin(state);
    fe_body bodies[TOWER];
    add_ground(&s, friction(0.6));
    build_tower(&s, bodies, 0);
    for (int i = 0; i < 300; ++i) {
        run(&s, 1);
        if (!all_awake(&s, bodies, TOWER)) break;
    }
    FE_TRUE(!all_awake(&s, bodies, TOWER));
    for (int i = 0; i < TOWER; ++i) FE_TRUE(body_event(&s, bodies[i], FE_EVENT_SLEEP) == 1);
    scene_end(&s);
}

// One that may not sleep keeps all it touches awake, and nobody else.
static void one_that_may_not_sleep_keeps_its_island_awake(void **state)
{
    scene s = scene_begin(state);
    fe_body bodies[TOWER], others[TOWER];
    add_ground(&s, friction(0.6));
    build_tower(&s, bodies, 0);
    build_tower(&s, others, 3);
    MUST(fe_body_set_sleep_allowed(s.world, bodies[2], 0));
    run(&s, 300);
    FE_TRUE(all_awake(&s, bodies, TOWER));
    FE_TRUE(!all_awake(&s, others, TOWER));
    MUST(fe_body_set_sleep_allowed(s.world, bodies[2], 1));
    run(&s, 60);
    FE_TRUE(!all_awake(&s, bodies, TOWER));
    scene_end(&s);
}

// ---- asleep --------------------------------------------------------------------------------------------------------

static void a_sleeping_world_does_not_change_one_bit(void **state)
{
    scene s = scene_begin(state);
    fe_body bodies[2 * TOWER + 1];
    fe_transform before[2 * TOWER + 1];
    enum { COUNT = 2 * TOWER + 1 };
    add_ground(&s, friction(0.6));
    build_tower(&s, bodies, 0);
    build_tower(&s, bodies + TOWER, 3);
    bodies[COUNT - 1] = add_sleeper(&s, capsule(0.4, 0.3), v3(-3, 0.7, 0));
    MUST(fe_body_set_transform(s.world, bodies[COUNT - 1],
                               &(fe_transform){to_world(&s, v3(-3, 0.3, 0)),
                                               compose(s.turn, turned(v3(0, 0, 1), 90 * DEGREES))}));
    settle(&s, 600);
    run(&s, 1); // the events of falling asleep are gone
    for (int i = 0; i < COUNT; ++i) before[i] = body_transform(s.world, bodies[i]);
    uint64_t hash = hash_of(&s);
    for (int k = 0; k < 120; ++k) {
        run(&s, 1);
        FE_TRUE(hash_of(&s) == hash);
        FE_TRUE(awake_count(&s) == 0);
        FE_TRUE(fe_world_get_pair_events(s.world, NULL, 0, 0) == 0);
        FE_TRUE(fe_world_get_body_events(s.world, NULL, 0, 0) == 0);
        FE_TRUE(fe_world_get_moved(s.world, NULL, NULL, 0, 0) == 0);
    }
    for (int i = 0; i < COUNT; ++i) {
        fe_transform now = body_transform(s.world, bodies[i]);
        assert_memory_equal(&now, &before[i], sizeof now);
    }
    scene_end(&s);
}

// Waking gives the stack back its impulses: it must not sag, hop or slide. The slow pole of an overdamped contact is w
// / (2 zeta) = 9.4 1/s: after 8 s nothing moves that is not rounding, and the fall of one step without impulses would
// be 0.16 m/s.
static void waking_disturbs_nothing(void **state)
{
    scene s = scene_begin(state);
    fe_body bodies[TOWER];
    vec before[TOWER];
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.sleep_time = 8;
    MUST(fe_world_set_tuning(s.world, &tuning));
    add_ground(&s, friction(0.6));
    build_tower(&s, bodies, 0);
    settle(&s, 900);
    for (int i = 0; i < TOWER; ++i) before[i] = position(&s, bodies[i]);
    MUST(fe_body_set_awake(s.world, bodies[0], 1));
    FE_TRUE(all_awake(&s, bodies, TOWER));
    for (int k = 0; k < 20; ++k) {
        run(&s, 1);
        for (int i = 0; i < TOWER; ++i) {
            FE_NEAR(length(minus(position(&s, bodies[i]), before[i])), 0, 1e-5);
            FE_NEAR(length(velocity(&s, bodies[i])), 0, 1e-4);
        }
    }
    scene_end(&s);
}

// ---- waking --------------------------------------------------------------------------------------------------------

// Each of these wakes its body and all that it stands on or carries, at once, and the next step tells; another island
// sleeps on.
typedef void stimulus(scene *s, fe_body body);

static void by_force(scene *s, fe_body body) { add_force(s, body, v3(1, 0, 0)); }
static void by_torque(scene *s, fe_body body) { add_torque(s, body, v3(0, 1, 0)); }
static void by_impulse(scene *s, fe_body body)
{
    fe_vec3 impulse = {1, 0, 0};
    MUST(fe_body_add_impulse(s->world, body, &impulse));
}
static void by_angular_impulse(scene *s, fe_body body)
{
    fe_vec3 impulse = {0, 1, 0};
    MUST(fe_body_add_angular_impulse(s->world, body, &impulse));
}
static void by_velocity(scene *s, fe_body body) { set_velocity(s, body, v3(0, 0.2, 0), v3(0, 0, 0)); }
static void by_spin(scene *s, fe_body body) { set_velocity(s, body, v3(0, 0, 0), v3(0, 0.2, 0)); }
static void by_call(scene *s, fe_body body) { MUST(fe_body_set_awake(s->world, body, 1)); }
static void by_teleport(scene *s, fe_body body)
{
    fe_transform t = body_transform(s->world, body);
    t.position.x += 0.001;
    MUST(fe_body_set_transform(s->world, body, &t));
}
static void by_filter(scene *s, fe_body body) { MUST(fe_body_set_filter(s->world, body, 2, 0xffffffffu, 0)); }
static void by_type(scene *s, fe_body body) { MUST(fe_body_set_type(s->world, body, FE_BODY_STATIC)); }
static void by_disabling(scene *s, fe_body body) { MUST(fe_body_set_enabled(s->world, body, 0)); }
static void by_destroying(scene *s, fe_body body) { MUST(fe_body_destroy(s->world, body)); }
static void by_locks(scene *s, fe_body body) { MUST(fe_body_set_locks(s->world, body, FE_AXIS_Z, 0)); }
static void by_mass(scene *s, fe_body body) { MUST(fe_body_set_mass(s->world, body, 10)); }
static void by_form(scene *s, fe_body body)
{
    fe_shape shape;
    fe_geometry small = box(0.4, 0.5, 0.4);
    FE_TRUE(fe_body_get_shapes(s->world, body, &shape, 1) == 1);
    MUST(fe_shape_set_geometry(s->world, shape, &small));
}

static void every_change_wakes_the_island(void **state)
{
    static stimulus *const stimuli[] = {by_force,    by_torque, by_impulse,   by_angular_impulse,
                                        by_velocity, by_spin,   by_call,      by_teleport,
                                        by_filter,   by_type,   by_disabling, by_destroying,
                                        by_locks,    by_mass,   by_form};
    enum { COUNT = sizeof stimuli / sizeof *stimuli };
    for (int i = 0; i < COUNT; ++i) {
        scene s = scene_begin(state);
        fe_body bodies[TOWER], others[TOWER];
        add_ground(&s, friction(0.6));
        build_tower(&s, bodies, 0);
        build_tower(&s, others, 3);
        settle(&s, 600);
        stimuli[i](&s, bodies[1]);
        for (int k = 0; k < TOWER; ++k)
            if (k != 1 && !awake(&s, bodies[k])) {
                print_error("stimulus %d did not wake body %d\n", i, k);
                FE_TRUE(awake(&s, bodies[k]));
            }
        run(&s, 1);
        FE_TRUE(body_event(&s, bodies[0], FE_EVENT_WAKE) == 1);
        FE_TRUE(body_event(&s, bodies[3], FE_EVENT_WAKE) == 1);
        FE_TRUE(!all_awake(&s, others, TOWER));
        FE_TRUE(body_event(&s, others[0], FE_EVENT_WAKE) == 0);
        scene_end(&s);
    }
}

// What changes nothing wakes nobody.
static void reading_and_zero_forces_wake_nobody(void **state)
{
    scene s = scene_begin(state);
    fe_body bodies[TOWER];
    fe_hit hit;
    fe_contact contacts[8];
    add_ground(&s, friction(0.6));
    build_tower(&s, bodies, 0);
    settle(&s, 600);
    add_force(&s, bodies[1], v3(0, 0, 0));
    add_torque(&s, bodies[1], v3(0, 0, 0));
    vec from = to_world(&s, v3(-5, 0.5, 0)), way = to_world(&s, v3(10, 0, 0));
    FE_TRUE(fe_world_raycast(s.world, &from, &way, NULL, &hit) == 1);
    FE_TRUE(hit.body == bodies[0]);
    FE_TRUE(fe_body_get_contacts(s.world, bodies[1], contacts, sizeof *contacts, 8) ==
            2); // sleep does not end a contact
    MUST(fe_body_set_user_data(s.world, bodies[1], 7));
    FE_TRUE(awake_count(&s) == 0);
    run(&s, 1);
    FE_TRUE(awake_count(&s) == 0);
    scene_end(&s);
}

// The first touch of a sleeper is told, and wakes its whole island in that step; one that sleeps elsewhere goes on
// sleeping.
static void a_touch_wakes_the_island_and_is_reported(void **state)
{
    scene s = scene_begin(state);
    fe_body bodies[TOWER], others[TOWER];
    add_ground(&s, friction(0.6));
    build_tower(&s, bodies, 0);
    build_tower(&s, others, 5);
    settle(&s, 600);
    fe_body ball = add_sleeper(&s, sphere(0.2), v3(-1.5, 0.7, 0));
    MUST(fe_body_set_gravity_scale(s.world, ball, 0));
    set_velocity(&s, ball, v3(1, 0, 0), v3(0, 0, 0));
    int entered = 0;
    for (int i = 0; i < 90 && !entered; ++i) {
        run(&s, 1);
        fe_pair_event events[16];
        int32_t count = fe_world_get_pair_events(s.world, events, sizeof *events, 16);
        for (int k = 0; k < count; ++k)
            entered |= events[k].kind == FE_EVENT_ENTER && events[k].body_a == bodies[0] && events[k].body_b == ball;
    }
    FE_TRUE(entered);
    FE_TRUE(all_awake(&s, bodies, TOWER));
    FE_TRUE(!all_awake(&s, others, TOWER));
    scene_end(&s);
}

// A kinematic body that moves into a sleeper wakes it; one that stands still lets its cargo sleep and sleeps itself.
static void a_moving_kinematic_body_wakes_and_a_still_one_lets_sleep(void **state)
{
    scene s = scene_begin(state);
    fe_body lift = add_body(&s, FE_BODY_KINEMATIC, box(2, 0.1, 2), v3(0, -0.1, 0), UNTURNED, friction(0.6), WATER);
    MUST(fe_body_set_sleep_allowed(s.world, lift, 1));
    fe_body cargo = add_sleeper(&s, cube(), v3(0, 0.5, 0));
    settle(&s, 600);
    FE_TRUE(!awake(&s, cargo));
    set_velocity(&s, lift, v3(0, 1, 0), v3(0, 0, 0));
    run(&s, 60);
    FE_TRUE(awake(&s, cargo));
    FE_NEAR(position(&s, cargo).y, 1.5, LINEAR_SLOP);
    set_velocity(&s, lift, v3(0, 0, 0), v3(0, 0, 0));
    run(&s, 120);
    FE_TRUE(!awake(&s, cargo));
    scene_end(&s);
}

// Asleep on a lift that moves, cargo would stay behind in the air: that is refused until the lift stands still.
static void what_rides_cannot_be_put_to_sleep_by_hand(void **state)
{
    scene s = scene_begin(state);
    fe_body lift = add_body(&s, FE_BODY_KINEMATIC, box(2, 0.1, 2), v3(0, -0.1, 0), UNTURNED, friction(0.6), WATER);
    fe_body cargo = add_sleeper(&s, cube(), v3(0, 0.5, 0));
    set_velocity(&s, lift, v3(0, 0.2, 0), v3(0, 0, 0));
    run(&s, 60);
    assert_int_equal(fe_body_set_awake(s.world, cargo, 0), FE_ERROR_STATE);
    FE_TRUE(awake(&s, cargo));
    set_velocity(&s, lift, v3(0, 0, 0), v3(0, 0, 0));
    run(&s, 2);
    MUST(fe_body_set_awake(s.world, cargo, 0));
    FE_TRUE(!awake(&s, cargo));
    scene_end(&s);
}

static void destroying_a_support_wakes_what_rested_on_it(void **state)
{
    for (int kind = 0; kind < 4; ++kind) {
        scene s = scene_begin(state);
        fe_body support = add_static(&s, box(1, 0.5, 1), v3(0, 0, 0), UNTURNED, friction(0.6));
        fe_body bodies[2] = {add_sleeper(&s, cube(), v3(0, 1, 0)), add_sleeper(&s, cube(), v3(0, 2, 0))};
        settle(&s, 600);
        if (kind == 0) MUST(fe_body_destroy(s.world, support));
        if (kind == 1) MUST(fe_body_set_enabled(s.world, support, 0));
        if (kind == 2) MUST(fe_body_set_filter(s.world, support, 1, 0, 0));
        if (kind == 3) {
            fe_transform away = body_transform(s.world, support);
            away.position.x += 100;
            MUST(fe_body_set_transform(s.world, support, &away));
        }
        FE_TRUE(all_awake(&s, bodies, 2));
        run(&s, 30);
        // P3 of half a second
        FE_NEAR(position(&s, bodies[1]).y, 2 - discrete_way(G, 0.5, s.h), 0.01);
        scene_end(&s);
    }
}

// A static body made in a sleeper, or moved into it, is a touch like any other; a world that is loaded asleep stays
// asleep.
static void a_static_body_that_comes_to_a_sleeper_wakes_it(void **state)
{
    for (int made = 0; made < 2; ++made) {
        scene s = scene_begin(state);
        add_ground(&s, friction(0.6));
        fe_body wall = made ? 0 : add_static(&s, cube(), v3(5, 0.5, 0), UNTURNED, friction(0.6));
        fe_body body = add_sleeper(&s, cube(), v3(0, 0.5, 0));
        settle(&s, 600);
        run(&s, 1);
        fe_transform in = {to_world(&s, v3(0.99, 0.5, 0)), s.turn};
        if (made) wall = add_static(&s, cube(), v3(0.99, 0.5, 0), UNTURNED, friction(0.6));
        if (!made) MUST(fe_body_set_transform(s.world, wall, &in));
        run(&s, 1);
        FE_TRUE(awake(&s, body));
        run(&s, 60);
        FE_WITHIN(position(&s, body).x, -0.011, -0.009 + LINEAR_SLOP);
        scene_end(&s);
    }
    scene s = scene_begin(state);
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.awake = 0;
    def.transform.position = to_world(&s, v3(0, 0.5, 0));
    fe_body body;
    fe_shape shape;
    fe_geometry form = cube();
    MUST(fe_body_create(s.world, &def, &body));
    MUST(fe_shape_create(s.world, body, NULL, &form, &shape));
    add_ground(&s, friction(0.6));
    run(&s, 3);
    FE_TRUE(!awake(&s, body));
    scene_end(&s);
}

// Its island stops with it. A body created asleep stays where it is, in the air or not, until something happens to it.
static void a_body_can_be_put_to_sleep_by_hand(void **state)
{
    scene s = scene_begin(state);
    fe_body bodies[TOWER];
    add_ground(&s, friction(0.6));
    build_tower(&s, bodies, 0);
    run(&s, 10);
    MUST(fe_body_set_awake(s.world, bodies[2], 0));
    FE_TRUE(!all_awake(&s, bodies, TOWER));
    vec before = position(&s, bodies[3]);
    run(&s, 10);
    FE_NEAR(length(minus(position(&s, bodies[3]), before)), 0, 0);
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.awake = 0;
    def.transform.position = to_world(&s, v3(9, 5, 0));
    fe_body hangs;
    MUST(fe_body_create(s.world, &def, &hangs));
    fe_geometry form = sphere(0.3);
    fe_shape shape;
    MUST(fe_shape_create(s.world, hangs, NULL, &form, &shape));
    run(&s, 60);
    FE_TRUE(!awake(&s, hangs));
    FE_NEAR(position(&s, hangs).y, 5, 0);
    by_force(&s, hangs);
    run(&s, 60);
    FE_WITHIN(position(&s, hangs).y, 0, 1);
    scene_end(&s);
}

// Enters less exits are the contacts there are, whether they sleep or not.
static void contacts_survive_sleep_without_events(void **state)
{
    scene s = scene_begin(state);
    fe_body bodies[TOWER];
    int balance = 0;
    add_ground(&s, friction(0.6));
    build_tower(&s, bodies, 0);
    for (int i = 0; i < 900; ++i) {
        if (i == 300) {
            FE_TRUE(awake_count(&s) == 0);
            FE_TRUE(balance == TOWER);
            by_call(&s, bodies[0]);
        }
        if (i == 600) {
            FE_TRUE(awake_count(&s) == 0);
            FE_TRUE(balance == TOWER);
            by_velocity(&s, bodies[3]);
        }
        run(&s, 1);
        balance += count_pair_events(&s, FE_EVENT_ENTER) - count_pair_events(&s, FE_EVENT_EXIT);
        FE_TRUE(count_pair_events(&s, FE_EVENT_STAY) == 0); // nobody asked
    }
    FE_TRUE(awake_count(&s) == 0);
    FE_TRUE(balance == TOWER);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_body_at_rest_sleeps_after_half_a_second),
        TEST(the_fastest_point_decides),
        TEST(what_is_pushed_apart_is_not_at_rest),
        TEST(threshold_time_and_permission_are_obeyed),
        EVERY_WAY_UP(an_island_falls_asleep_as_one),
        TEST(one_that_may_not_sleep_keeps_its_island_awake),
        TEST(a_sleeping_world_does_not_change_one_bit),
        TEST(waking_disturbs_nothing),
        TEST(every_change_wakes_the_island),
        TEST(reading_and_zero_forces_wake_nobody),
        TEST(a_touch_wakes_the_island_and_is_reported),
        TEST(a_moving_kinematic_body_wakes_and_a_still_one_lets_sleep),
        TEST(what_rides_cannot_be_put_to_sleep_by_hand),
        TEST(destroying_a_support_wakes_what_rested_on_it),
        TEST(a_static_body_that_comes_to_a_sleeper_wakes_it),
        TEST(a_body_can_be_put_to_sleep_by_hand),
        TEST(contacts_survive_sleep_without_events),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
