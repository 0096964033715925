// What joints do to the rest of a world: sleep, filters, events, types, locks, masses, teleports, steps of other
// lengths.
#include "scenes/joint_scene.h"

static int is_awake(const scene *s, fe_body body)
{
    int32_t awake = -1;
    MUST(fe_body_get_awake(s->world, body, &awake));
    return awake;
}

static void let_sleep(scene *s, fe_body body) { MUST(fe_body_set_sleep_allowed(s->world, body, 1)); }

static int32_t contacts_of(const scene *s, fe_body body) { return fe_body_get_contacts(s->world, body, NULL, 0, 0); }

static fe_body add_sleeper(scene *s, vec at)
{
    fe_body body = add_plain(s, box(0.5, 0.5, 0.5), at);
    let_sleep(s, body);
    return body;
}

// two boxes on the ground, 3 m apart, tied by a rope of 4 m
typedef struct tied {
    fe_body a, b;
    fe_joint rope;
} tied;

static tied add_tied(scene *s)
{
    add_ground(s, friction(0.6));
    tied t = {add_sleeper(s, v3(0, 0.5, 0)), add_sleeper(s, v3(4, 0.5, 0)), 0};
    fe_distance_joint_def d = distance_def();
    d.lower = 0, d.upper = 4;
    t.rope = add_distance(s, d, t.a, t.b, v3(0.5, 0.5, 0), v3(3.5, 0.5, 0));
    return t;
}

// ---- sleep ---------------------------------------------------------------------------------------------------------

static void joined_bodies_sleep_and_wake_together(void **state)
{
    scene s = scene_begin(state);
    tied t = add_tied(&s);
    run(&s, 60);
    FE_TRUE(!is_awake(&s, t.a) && !is_awake(&s, t.b));
    MUST(fe_body_set_awake(s.world, t.a, 1));
    FE_TRUE(is_awake(&s, t.b)); // at once
    run(&s, 20);
    MUST(fe_body_set_sleep_allowed(s.world, t.b, 0));
    run(&s, 120);
    FE_TRUE(is_awake(&s, t.a) && is_awake(&s, t.b)); // neither without the other
    FE_TRUE(fe_body_set_awake(s.world, t.a, 0) == FE_ERROR_STATE);
    MUST(fe_body_set_sleep_allowed(s.world, t.b, 1));
    MUST(fe_body_set_awake(s.world, t.a, 0));
    FE_TRUE(!is_awake(&s, t.b));
    fe_body_event events[4];
    run(&s, 1);
    FE_TRUE(fe_world_get_body_events(s.world, events, sizeof *events, 4) == 2);
    scene_end(&s);
}

static void a_contact_wakes_what_is_joined(void **state)
{
    scene s = scene_begin(state);
    tied t = add_tied(&s);
    run(&s, 60);
    FE_TRUE(!is_awake(&s, t.b));
    fe_body ball = add_plain(&s, sphere(0.3), v3(0, 1.5, 0));
    set_velocity(&s, ball, v3(0, -5, 0), v3(0, 0, 0));
    run(&s, 10);
    FE_TRUE(is_awake(&s, t.a) && is_awake(&s, t.b));
    scene_end(&s);
}

static void each_change_of_a_joint_wakes_its_bodies(void **state)
{
    for (int change = 0; change < 5; ++change) {
        scene s = scene_begin(state);
        tied t = add_tied(&s);
        run(&s, 60);
        FE_TRUE(!is_awake(&s, t.a) && !is_awake(&s, t.b));
        fe_joint other;
        fe_distance_joint_def d = distance_def();
        fe_joint_def front = {.struct_size = sizeof front};
        d.body_a = t.a, d.body_b = t.b;
        MUST(fe_joint_get(s.world, t.rope, &front));
        if (change == 0) MUST(fe_distance_joint_set(s.world, t.rope, &d));
        if (change == 1) MUST(fe_joint_set(s.world, t.rope, &front));
        if (change == 2) MUST(fe_joint_set_enabled(s.world, t.rope, 0));
        if (change == 3) MUST(fe_joint_destroy(s.world, t.rope));
        if (change == 4) MUST(fe_distance_joint_create(s.world, &d, &other));
        FE_TRUE(is_awake(&s, t.a) && is_awake(&s, t.b));
        scene_end(&s);
    }
}

// what stands on the ground is not concerned when a joint to the ground changes
static void a_joint_to_the_ground_wakes_only_its_own_body(void **state)
{
    scene s = scene_begin(state);
    fe_body ground = add_ground(&s, friction(0.6)), a = add_sleeper(&s, v3(0, 0.5, 0)),
            b = add_sleeper(&s, v3(4, 0.5, 0));
    run(&s, 60);
    FE_TRUE(!is_awake(&s, a) && !is_awake(&s, b));
    add_ball(&s, ball_def(), ground, a, v3(0, 0, 0), v3(0, 1, 0));
    FE_TRUE(is_awake(&s, a) && !is_awake(&s, b));
    scene_end(&s);
}

static void a_moving_kinematic_body_keeps_awake_what_it_holds(void **state)
{
    scene s = scene_begin(state);
    fe_body hand = add_body(&s, FE_BODY_KINEMATIC, sphere(0.1), v3(0, 3, 0), UNTURNED, friction(0), WATER);
    let_sleep(&s, hand);
    fe_body bob = add_plain(&s, sphere(0.2), v3(0, 2, 0));
    let_sleep(&s, bob);
    MUST(fe_body_set_damping(s.world, bob, 5, 5));
    add_ball(&s, ball_def(), hand, bob, v3(0, 3, 0), v3(0, -1, 0));
    set_velocity(&s, hand, v3(0.01, 0, 0), v3(0, 0, 0)); // slower than the sleep threshold
    run(&s, 240);
    FE_TRUE(is_awake(&s, bob));
    FE_NEAR(position(&s, bob).x, 4 * 0.01 - 0.01 * 5 / G,
            0.001); // it lags by what the air takes: v c / g of its string of 1 m
    FE_TRUE(fe_body_set_awake(s.world, bob, 0) == FE_ERROR_STATE);
    set_velocity(&s, hand, v3(0, 0, 0), v3(0, 0, 0));
    run(&s, 240);
    FE_TRUE(!is_awake(&s, bob));
    set_velocity(&s, hand, v3(0.5, 0, 0), v3(0, 0, 0)); // wakes what it holds
    FE_TRUE(is_awake(&s, bob));
    run(&s, 60);
    FE_WITHIN(position(&s, bob).x, 0.2, 0.6);
    scene_end(&s);
}

// ---- filter --------------------------------------------------------------------------------------------------------

static int32_t pair_events(const scene *s, int32_t kind)
{
    fe_pair_event events[8];
    int32_t count = fe_world_get_pair_events(s->world, events, sizeof *events, 8), found = 0;
    for (int32_t i = 0; i < count && i < 8; ++i) found += events[i].kind == kind;
    return found;
}

static void joined_bodies_touch_only_if_asked(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body a = add_plain(&s, box(0.5, 0.5, 0.5), v3(0, 0, 0)), b = add_plain(&s, box(0.5, 0.5, 0.5), v3(0.98, 0, 0));
    run(&s, 1);
    FE_TRUE(contacts_of(&s, a) == 1 && pair_events(&s, FE_EVENT_ENTER) == 1);
    fe_joint joint = add_fixed(&s, fixed_def(), a, b, v3(0.5, 0, 0));
    FE_TRUE(contacts_of(&s, a) == 0);
    run(&s, 1);
    FE_TRUE(contacts_of(&s, a) == 0 && pair_events(&s, FE_EVENT_EXIT) == 1);
    run(&s, 30);
    FE_TRUE(contacts_of(&s, a) == 0);
    fe_joint_def front = {.struct_size = sizeof front};
    MUST(fe_joint_get(s.world, joint, &front));
    front.collide_connected = 1;
    MUST(fe_joint_set(s.world, joint, &front));
    run(&s, 1);
    FE_TRUE(contacts_of(&s, a) == 1 && pair_events(&s, FE_EVENT_ENTER) == 1);
    front.collide_connected = 0;
    MUST(fe_joint_set(s.world, joint, &front));
    run(&s, 1);
    FE_TRUE(contacts_of(&s, a) == 0 && pair_events(&s, FE_EVENT_EXIT) == 1);
    MUST(fe_joint_set_enabled(s.world, joint, 0)); // as if it were not there
    run(&s, 1);
    FE_TRUE(contacts_of(&s, a) == 1);
    MUST(fe_joint_set_enabled(s.world, joint, 1));
    run(&s, 1);
    FE_TRUE(contacts_of(&s, a) == 0);
    fe_joint second = add_ball(&s, ball_def(), b, a, v3(0.5, 0, 0), v3(1, 0, 0));
    MUST(fe_joint_destroy(s.world, joint));
    run(&s, 1);
    FE_TRUE(contacts_of(&s, a) == 0); // the other one still forbids it
    MUST(fe_joint_destroy(s.world, second));
    run(&s, 1);
    FE_TRUE(contacts_of(&s, a) == 1);
    scene_end(&s);
}

// ---- breaking ------------------------------------------------------------------------------------------------------

static void a_joint_breaks_above_its_force_and_says_so(void **state)
{
    for (int by_torque = 0; by_torque < 2; ++by_torque)
        for (int heavy = 0; heavy < 2; ++heavy) {
            scene s = scene_begin(state);
            fe_body anchor = add_anchor(&s, v3(0, 0, 0)), bar = add_plain(&s, box(0.5, 0.1, 0.1), v3(0.5, 0, 0));
            double load = mass_of(&s, bar) * G * (by_torque ? 0.5 : 1);
            fe_fixed_joint_def d = fixed_def();
            d.user_data = 77;
            // the load comes at once: a spring without damping would take twice the load, this one, overdamped, no more
            // than a fifth above it
            float most = (float)(load * (heavy ? 0.95 : 1.3));
            if (by_torque)
                d.break_torque = most;
            else
                d.break_force = most;
            fe_joint joint = add_fixed(&s, d, anchor, bar, v3(0, 0, 0));
            int broke = 0;
            for (int i = 0; i < 60; ++i) {
                run(&s, 1);
                fe_joint_event e;
                int32_t count = fe_world_get_joint_events(s.world, &e, sizeof e, 1);
                if (!count) continue;
                FE_TRUE(++broke == 1 && count == 1);
                FE_TRUE(e.joint == joint && e.body_a == anchor && e.body_b == bar && e.user_data == 77 &&
                        e.kind == FE_EVENT_BREAK && e.type == FE_JOINT_FIXED);
                FE_WITHIN(length(widen(by_torque ? e.torque : e.force)), (double)most, 1.3 * load);
                FE_TRUE(!fe_joint_is_valid(s.world, joint));
            }
            FE_TRUE(broke == heavy);
            FE_TRUE(fe_joint_is_valid(s.world, joint) == !heavy);
            if (heavy)
                FE_WITHIN(position(&s, bar).y, -6, -3); // falls
            else
                FE_NEAR(position(&s, bar).y, 0, 0.01);
            scene_end(&s);
        }
}

// six weights on six strings, made in another order than they hang; those too heavy break in the order of their
// creation
static void joints_break_in_the_order_of_creation(void **state)
{
    enum { WEIGHTS = 6 };
    static const int order[WEIGHTS] = {3, 0, 5, 1, 4, 2};
    scene s = scene_begin(state);
    fe_body anchor = add_anchor(&s, v3(0, 0, 0)), weights[WEIGHTS];
    fe_joint strings[WEIGHTS];
    for (int i = 0; i < WEIGHTS; ++i) weights[i] = add_plain(&s, sphere(0.2), v3(i, -1, 0));
    double load = mass_of(&s, weights[0]) * G;
    for (int i = 0; i < WEIGHTS; ++i) {
        fe_ball_joint_def d = ball_def();
        d.break_force = (float)(i % 3 == 1 ? 2 * load : 0.5 * load);
        strings[i] = add_ball(&s, d, anchor, weights[order[i]], v3(order[i], 0, 0), v3(0, 1, 0));
    }
    fe_joint_event events[WEIGHTS];
    int32_t count = 0;
    for (int i = 0; i < 10 && !count; ++i) {
        run(&s, 1);
        count = fe_world_get_joint_events(s.world, events, sizeof *events, WEIGHTS);
    }
    FE_TRUE(count == 4);
    FE_TRUE(events[0].joint == strings[0] && events[1].joint == strings[2] && events[2].joint == strings[3] &&
            events[3].joint == strings[5]);
    run(&s, 1);
    FE_TRUE(fe_world_get_joint_events(s.world, NULL, 0, 0) == 0);
    fe_joint left[WEIGHTS];
    FE_TRUE(fe_world_get_joints(s.world, left, WEIGHTS) == 2 && left[0] == strings[1] && left[1] == strings[4]);
    scene_end(&s);
}

// ---- what a joint holds goes on through changes --------------------------------------------------------------------

typedef struct hung {
    fe_body anchor, upper, lower;
    fe_joint top, middle;
    double weight; // of one
} hung;

static hung add_hung(scene *s)
{
    hung h = {add_anchor(s, v3(0, 2, 0)),
              add_plain(s, box(0.2, 0.4, 0.2), v3(0, 1, 0)),
              add_plain(s, box(0.2, 0.4, 0.2), v3(0, -1, 0)),
              0,
              0,
              0};
    h.top = add_ball(s, ball_def(), h.anchor, h.upper, v3(0, 2, 0), v3(0, -1, 0));
    h.middle = add_hinge(s, hinge_def(), h.upper, h.lower, v3(0, 0, 0), v3(1, 0, 0));
    h.weight = mass_of(s, h.upper) * G;
    run(s, 120);
    return h;
}

static void check_hangs(scene *s, const hung *h, double slack)
{
    FE_NEAR(force_of(s, h->top).y, 2 * h->weight, 0.005 * 2 * h->weight);
    FE_NEAR(force_of(s, h->middle).y, h->weight, 0.005 * h->weight);
    FE_WITHIN(gap_of(s, h->top), 0, slack);
    FE_WITHIN(gap_of(s, h->middle), 0, slack);
    FE_WITHIN(length(velocity(s, h->lower)), 0, 1e-3);
}

static void a_disabled_joint_holds_nothing_and_holds_again(void **state)
{
    scene s = scene_begin(state);
    hung h = add_hung(&s);
    check_hangs(&s, &h, LINEAR_SLOP);
    MUST(fe_joint_set_enabled(s.world, h.middle, 0));
    double from = position(&s, h.lower).y;
    run(&s, 6);
    FE_NEAR(position(&s, h.lower).y, from - discrete_way(G, 6 * STEP, s.h), 1e-4);
    FE_NEAR(length(force_of(&s, h.middle)), 0, 0);
    totals before = totals_of(&s, (fe_body[]){h.upper, h.lower}, 2);
    MUST(fe_joint_set_enabled(s.world, h.middle, 1)); // 49 mm open
    for (int i = 0; i < 300; ++i) {
        run(&s, 1);
        totals now = totals_of(&s, (fe_body[]){h.upper, h.lower}, 2);
        FE_WITHIN(now.energy, -1e9,
                  before.energy + h.weight * 0.06); // what the open joint stores by its height, and no more
    }
    check_hangs(&s, &h, LINEAR_SLOP);
    scene_end(&s);
}

static void a_body_that_turns_static_and_back_stays_held(void **state)
{
    scene s = scene_begin(state);
    hung h = add_hung(&s);
    MUST(fe_body_set_type(s.world, h.upper, FE_BODY_STATIC)); // the top joint now has no dynamic end
    run(&s, 60);
    FE_NEAR(force_of(&s, h.middle).y, h.weight, 0.005 * h.weight);
    MUST(fe_body_set_type(s.world, h.upper, FE_BODY_KINEMATIC));
    run(&s, 60);
    FE_NEAR(force_of(&s, h.middle).y, h.weight, 0.005 * h.weight);
    MUST(fe_body_set_type(s.world, h.upper, FE_BODY_DYNAMIC));
    run(&s, 120);
    check_hangs(&s, &h, LINEAR_SLOP);
    MUST(fe_body_set_enabled(s.world, h.upper, 0)); // then nothing holds the lower one
    double from = position(&s, h.lower).y;
    run(&s, 6);
    FE_NEAR(position(&s, h.lower).y, from - discrete_way(G, 6 * STEP, s.h), 1e-4);
    MUST(fe_body_set_enabled(s.world, h.upper, 1));
    run(&s, 300);
    check_hangs(&s, &h, LINEAR_SLOP);
    scene_end(&s);
}

// frames are the body's, not its centre's: another shape moves the centre, not the anchor
static void another_centre_of_mass_moves_no_anchor(void **state)
{
    scene s = scene_begin(state);
    hung h = add_hung(&s);
    fe_shape_def weight;
    fe_shape shape;
    fe_geometry form = sphere(0.2);
    fe_shape_def_init(&weight, sizeof weight);
    weight.frame.position = fe_make_vec3(0, -1, 0);
    double before = gap_of(&s, h.middle);
    MUST(fe_shape_create(s.world, h.lower, &weight, &form, &shape));
    FE_NEAR(gap_of(&s, h.middle), before, 1e-6);
    run(&s, 120);
    FE_NEAR(force_of(&s, h.middle).y, mass_of(&s, h.lower) * G, 0.005 * mass_of(&s, h.lower) * G);
    FE_WITHIN(gap_of(&s, h.middle), 0, LINEAR_SLOP);
    scene_end(&s);
}

// impulses are kept per substep: their unit is force times its length
static void steps_of_other_lengths_change_no_force(void **state)
{
    static const double lengths[] = {1.0 / 60, 1.0 / 240, 1.0 / 30, 1.0 / 120, 1.0 / 480, 1.0 / 60};
    static const int substeps[] = {8, 4, 16, 2, 1, 8};
    scene s = scene_begin(state);
    hung h = add_hung(&s);
    for (int k = 0; k < 6; ++k) {
        MUST(fe_world_set_substeps(s.world, substeps[k]));
        for (int i = 0; i < 3; ++i) {
            MUST(fe_world_step(s.world, (float)lengths[k]));
            // a chain at rest: the first step with the new length already bears the weight, up to the change of
            // softness (hertz are limited by the substep) that the world settles to
            FE_WITHIN(length(velocity(&s, h.lower)), 0, 0.05);
        }
        for (int i = 0; i < 60; ++i) MUST(fe_world_step(s.world, (float)lengths[k]));
        check_hangs(&s, &h, 2 * LINEAR_SLOP);
    }
    MUST(fe_world_step(s.world, 0));
    FE_NEAR(force_of(&s, h.top).y, 2 * h.weight, 0.005 * 2 * h.weight); // a step of nothing changes nothing
    scene_end(&s);
}

static void a_teleported_pair_goes_on_as_it_was(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body a = add_plain(&s, box(0.3, 0.2, 0.2), v3(0, 0, 0)), b = add_plain(&s, box(0.3, 0.2, 0.2), v3(1, 0, 0));
    fe_hinge_joint_def d = hinge_def();
    d.limit_enabled = 1, d.lower = -0.2f, d.upper = (float)PI;
    fe_joint joint = add_hinge(&s, d, a, b, v3(0.5, 0, 0), v3(0, 0, 1));
    fe_transform t = {to_world(&s, v3(1000, 5, 0)), compose(s.turn, turned(v3(0, 1, 1), 2))};
    fe_transform u = {plus(t.position, rotate(t.rotation, v3(0.5, 0, 0))),
                      compose(t.rotation, turned(v3(0, 0, 1), 3.1))};
    u.position = plus(u.position, rotate(u.rotation, v3(0.5, 0, 0)));
    MUST(fe_body_set_transform(s.world, a, &t));
    MUST(fe_body_set_transform(s.world, b, &u)); // 3.1 rad: close to the end of its range
    FE_NEAR(state_of(&s, joint).angle, 3.1, 1e-5);
    run(&s, 60);
    FE_NEAR(state_of(&s, joint).angle, 3.1, 1e-3);
    FE_WITHIN(length(velocity(&s, b)), 0, 1e-2);
    set_velocity(&s, b, v3(0, 0, 0), rotate(inverse(s.turn), rotate(t.rotation, v3(0, 0, 2))));
    for (int i = 0; i < 60; ++i) {
        run(&s, 1);
        FE_WITHIN(state_of(&s, joint).angle, 2, PI + 1 * DEGREES); // it stops at half a turn: no jump to the other end
    }
    scene_end(&s);
}

static void joints_without_a_dynamic_end_do_nothing(void **state)
{
    scene s = scene_begin(state);
    fe_body a = add_anchor(&s, v3(0, 0, 0)), b = add_anchor(&s, v3(1, 0, 0)),
            c = add_body(&s, FE_BODY_KINEMATIC, sphere(0.1), v3(2, 0, 0), UNTURNED, friction(0), WATER);
    add_ball(&s, ball_def(), a, b, v3(0, 0, 0), v3(1, 0, 0));
    fe_joint joint = add_hinge(&s, hinge_def(), b, c, v3(1, 0, 0), v3(1, 0, 0));
    set_velocity(&s, c, v3(1, 0, 0), v3(0, 0, 0));
    run(&s, 60);
    FE_NEAR(position(&s, c).x, 3, 1e-5);
    FE_NEAR(length(force_of(&s, joint)), 0, 0);
    FE_NEAR(gap_of(&s, joint), 1, 1e-5);
    scene_end(&s);
}

// ---- locks (V7, B37) -----------------------------------------------------------------------------------------------

static void check_locked(const fe_transform *was, const fe_transform *is, uint32_t linear, uint32_t angular)
{
    const double *p = &was->position.x, *q = &is->position.x;
    for (int k = 0; k < 3; ++k)
        if (linear >> k & 1) FE_TRUE(p[k] == q[k]);
    if (angular != 7) return;
    FE_TRUE(was->rotation.x == is->rotation.x && was->rotation.y == is->rotation.y &&
            was->rotation.z == is->rotation.z && was->rotation.w == is->rotation.w);
}

// each of the 63 locks on the lower of two bodies, tied by each type of joint, with gravity, a push and a ground
static void no_joint_moves_a_locked_coordinate(void **state)
{
    const int steps = SLOW_BUILD ? 20 : 100;
    for (uint32_t locks = 1; locks < 64; ++locks) {
        scene s = scene_begin(state);
        uint32_t linear = locks & 7, angular = locks >> 3;
        fe_body anchor = add_anchor(&s, v3(0, 2, 0));
        for (int type = 0; type < 5; ++type) {
            vec at = v3(3 * type, 1, 0);
            fe_body upper = add_dynamic(&s, box(0.2, 0.2, 0.2), at, UNTURNED, friction(0.5), WATER),
                    lower = add_dynamic(&s, box(0.3, 0.2, 0.1), plus(at, v3(0.3, -1, 0.2)), turned(v3(1, 2, 3), 1),
                                        friction(0.5), WATER);
            vec point = plus(at, v3(0, -0.5, 0));
            fe_configurable_joint_def six = configurable_def();
            for (int k = 0; k < 6; ++k)
                six.axes[k].motion = FE_MOTION_LIMITED, six.axes[k].lower = -0.1f, six.axes[k].upper = 0.1f;
            MUST(fe_body_set_locks(s.world, lower, linear, angular));
            add_rod(&s, anchor, upper, v3(3 * type, 2, 0), at);
            if (type == 0) add_rod(&s, upper, lower, at, position(&s, lower));
            if (type == 1) add_ball(&s, ball_def(), upper, lower, point, v3(0, 1, 0));
            if (type == 2) add_hinge(&s, hinge_def(), upper, lower, point, v3(1, 0, 1));
            if (type == 3) add_fixed(&s, fixed_def(), upper, lower, point);
            if (type == 4) add_configurable(&s, six, upper, lower, point, v3(0, 1, 0));
            fe_transform was = body_transform(s.world, lower);
            for (int i = 0; i < steps; ++i) {
                add_force(&s, upper, v3(100 * sin(0.1 * i), 50, 80 * cos(0.13 * i)));
                run(&s, 1);
                fe_transform is = body_transform(s.world, lower);
                check_locked(&was, &is, linear, angular);
                vec v = velocity(&s, lower), w = spin(&s, lower);
                FE_WITHIN(length(v), 0, 100), FE_WITHIN(length(w), 0, 300); // nothing runs away
            }
        }
        scene_end(&s);
    }
}

// ---- many ----------------------------------------------------------------------------------------------------------

static void making_and_destroying_joints_takes_no_more_and_more_memory(void **state)
{
    scene s = scene_begin(state);
    fe_body a = add_plain(&s, sphere(0.2), v3(0, 0, 0)), b = add_plain(&s, sphere(0.2), v3(1, 0, 0));
    fe_counters counters = {.struct_size = sizeof counters};
    int64_t bytes = 0;
    const int rounds = SLOW_BUILD ? 500 : 50000;
    for (int i = 0; i < rounds; ++i) {
        fe_hinge_joint_def hinge = hinge_def();
        fe_configurable_joint_def six = configurable_def();
        hinge.limit_enabled = 1;
        six.axes[i % 6].motion = FE_MOTION_LIMITED;
        fe_joint one = add_hinge(&s, hinge, a, b, v3(0.5, 0, 0), v3(0, 1, 0)),
                 two = add_configurable(&s, six, a, b, v3(0.5, 0, 0), v3(0, 1, 0));
        if (i % 50 == 0) run(&s, 1);
        MUST(fe_joint_destroy(s.world, one));
        if (i % 2) MUST(fe_joint_destroy(s.world, two));
        if (i % 2 == 0) {
            MUST(fe_body_destroy(s.world, b));
            b = add_plain(&s, sphere(0.2), v3(1, 0, 0));
        }
        MUST(fe_world_get_counters(s.world, &counters));
        if (i == 100) bytes = counters.bytes;
        if (i > 100) FE_TRUE(counters.bytes == bytes);
        FE_TRUE(counters.joints == 0);
    }
    scene_end(&s);
}

// a wheel with more spokes than there are colours
static void a_hub_with_a_hundred_joints_holds_them_all(void **state)
{
    enum { SPOKES = 100 };
    scene s = scene_begin(state);
    fe_body anchor = add_anchor(&s, v3(0, 0, 0)), hub = add_plain(&s, sphere(0.5), v3(0, 0, 0)), rim[SPOKES];
    fe_joint spokes[SPOKES + 1];
    spokes[SPOKES] = add_ball(&s, ball_def(), anchor, hub, v3(0, 0, 0), v3(0, 1, 0));
    for (int i = 0; i < SPOKES; ++i) {
        double angle = 2 * PI * i / SPOKES;
        vec out = v3(cos(angle), sin(angle), 0);
        rim[i] = add_plain(&s, sphere(0.1), times(2, out));
        MUST(fe_body_set_filter(s.world, rim[i], 2, 0, 0));
        spokes[i] = add_ball(&s, ball_def(), hub, rim[i], times(0.5, out), out);
    }
    double load = mass_of(&s, hub) + SPOKES * mass_of(&s, rim[0]);
    for (int i = 0; i < 600; ++i) {
        run(&s, 1);
        FE_WITHIN(worst_gap(&s, spokes, SPOKES + 1), 0, 4 * LINEAR_SLOP);
    }
    for (int i = 0; i < SPOKES; ++i) FE_WITHIN(length(velocity(&s, rim[i])), 0, 20);
    FE_WITHIN(force_of(&s, spokes[SPOKES]).y, 0, 5 * load * G);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(joined_bodies_sleep_and_wake_together),
        TEST(a_contact_wakes_what_is_joined),
        TEST(each_change_of_a_joint_wakes_its_bodies),
        TEST(a_joint_to_the_ground_wakes_only_its_own_body),
        TEST(a_moving_kinematic_body_keeps_awake_what_it_holds),
        TEST(joined_bodies_touch_only_if_asked),
        EVERY_WAY_UP(a_joint_breaks_above_its_force_and_says_so),
        TEST(joints_break_in_the_order_of_creation),
        TEST(a_disabled_joint_holds_nothing_and_holds_again),
        TEST(a_body_that_turns_static_and_back_stays_held),
        TEST(another_centre_of_mass_moves_no_anchor),
        TEST(steps_of_other_lengths_change_no_force),
        EVERY_WAY_UP(a_teleported_pair_goes_on_as_it_was),
        TEST(joints_without_a_dynamic_end_do_nothing),
        TEST(no_joint_moves_a_locked_coordinate),
        TEST(making_and_destroying_joints_takes_no_more_and_more_memory),
        TEST(a_hub_with_a_hundred_joints_holds_them_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
