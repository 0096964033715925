// lockstep_worlds.h - worlds that differ in all that the solver tells apart: made for the purpose, or a script's at
// some moment. All use one store, so that any world of it may become any of them.
#ifndef LOCKSTEP_WORLDS_H
#define LOCKSTEP_WORLDS_H
#include "scenes/joint_scene.h"
#include "support/play.h"

#include <string.h>

enum { MOST_MOMENTS = 64, CHAIN = 8 };

typedef struct moment {
    const char *name;
    fe_state *state;
    unsigned char *bytes; // the same, saved
    int64_t size;
    int32_t is_heavy; // seldom chosen: a step of it takes milliseconds
} moment;

static fe_store *store; // of all of them
static moment moments[MOST_MOMENTS];
static int32_t moment_count;

static fe_world *open_world(int32_t simd)
{
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.store = store, def.simd = simd, def.substeps = 4;
    MUST(fe_world_create(&def, &world));
    return world;
}

// ---- parts ---------------------------------------------------------------------------------------------------------
static fe_body put_box(scene *s, vec at, double half, double mass)
{
    fe_body body = add_dynamic(s, box(half, half, half), at, UNTURNED, friction(0.6), WATER);
    MUST(fe_body_set_mass(s->world, body, (float)mass));
    return body;
}

static fe_body put_ball(scene *s, vec at, double radius, double restitution)
{
    return add_dynamic(s, sphere(radius), at, UNTURNED, bouncy(0.3, restitution), WATER);
}

static void let_all_sleep(scene *s)
{
    static fe_body all[4096];
    int32_t count = fe_world_get_bodies(s->world, all, 4096);
    for (int32_t i = 0; i < count; ++i) MUST(fe_body_set_sleep_allowed(s->world, all[i], 1));
}

// Links of 1 kg downwards, a load at the end, which swings. Returns the last
static fe_body hang_chain(scene *s, link_kind kind, vec top, double load, int links, fe_body out_first[2])
{
    fe_body last = add_anchor(s, top);
    for (int i = 0; i < links; ++i) {
        vec at = plus(top, v3(0, -0.2 * i, 0));
        fe_body body = add_plain(s, box(0.04, 0.08, 0.04), plus(at, v3(0, -0.1, 0)));
        touch_nothing(s, body);
        MUST(fe_body_set_mass(s->world, body, (float)(i + 1 < links ? 1 : load)));
        (void)link_bodies(s, kind, last, body, at);
        if (i < 2) out_first[i] = body;
        last = body;
    }
    set_velocity(s, last, v3(2, 0, 1), v3(0, 1, 0));
    return last;
}

// ---- worlds --------------------------------------------------------------------------------------------------------
static void make_empty(scene *s) { (void)s; }

// No pair, nor room for one
static void make_lone(scene *s) { set_velocity(s, put_ball(s, v3(0, 5, 0), 0.5, 0), v3(1, 0, 0), v3(0, 2, 0)); }

static void make_bouncing(scene *s)
{
    add_ground(s, bouncy(0.5, 0.8));
    for (int i = 0; i < 3; ++i) (void)put_ball(s, v3(2 * i, 1 + 0.1 * i, 0), 0.5, 0.8);
}

static void make_resting(scene *s)
{
    add_ground(s, friction(0.6));
    for (int i = 0; i < 5; ++i) (void)put_box(s, v3(0, 0.5 + i, 0), 0.5, 1);
}

// Strained at once, and while it lasts: what light boxes bear
static void make_strained(scene *s)
{
    add_ground(s, friction(0.6));
    for (int i = 0; i < 3; ++i) (void)put_box(s, v3(0, 0.5 + i, 0), 0.5, 1);
    (void)put_box(s, v3(0, 3.5, 0), 0.5, 1000);
    (void)put_box(s, v3(4, 0.5, 0), 0.5, 1);
    set_velocity(s, put_box(s, v3(4, 1.7, 0), 0.5, 50), v3(0, -20, 0), v3(0, 0, 0));
    (void)put_box(s, v3(8, 0.5, 0), 0.5, 1);
}

// Some balls that bounce beside a strained stack: rows with restitution of more than one pace
static void make_strained_bouncing(scene *s)
{
    make_strained(s);
    for (int i = 0; i < 6; ++i) (void)put_ball(s, v3(12 + 2.5 * (i / 3), 0.6 + 1.01 * (i % 3), 0), 0.5, 0.7);
    fe_body light = add_dynamic(s, box(0.5, 0.5, 0.5), v3(20, 0.5, 0), UNTURNED, bouncy(0.6, 0.5), 1);
    (void)light;
    set_velocity(s, put_box(s, v3(20, 1.6, 0), 0.5, 200), v3(0, -15, 0), v3(0, 0, 0));
}

static void hang_net(scene *s, int columns, int rows, double scale, vec at)
{
    static fe_body ball[20][20];
    for (int k = 0; k < columns; ++k)
        for (int i = 0; i < rows; ++i) {
            vec place = plus(at, v3(k, -i, 0));
            int held = i == 0 && k == columns / 2;
            ball[k][i] = held ? add_anchor(s, place) : add_plain(s, sphere(0.4), place);
            if (!held) MUST(fe_body_set_gravity_scale(s->world, ball[k][i], (float)scale));
            if (i) (void)add_ball(s, ball_def(), ball[k][i - 1], ball[k][i], plus(place, v3(0, 0.5, 0)), v3(0, 0, 1));
            if (k) (void)add_ball(s, ball_def(), ball[k - 1][i], ball[k][i], plus(place, v3(-0.5, 0, 0)), v3(0, 0, 1));
        }
}

static void make_net(scene *s) { hang_net(s, 2, 18, 36, v3(0, 0, 0)); }

// Opens while it falls on a floor, beside another one that does not open
static void make_falling_net(scene *s)
{
    (void)add_static(s, box(50, 0.5, 50), v3(0, -9, 0), UNTURNED, friction(0.6));
    hang_net(s, 8, 8, 16, v3(0, 0, 0));
    hang_net(s, 3, 3, 1, v3(20, 0, 0));
}

static void make_ropes(scene *s)
{
    fe_body first[2];
    static const double loads[] = {1000, 1, 30, 1000};
    for (int i = 0; i < 4; ++i) (void)hang_chain(s, LINK_BALLS, v3(2 * i, 0, 0), loads[i], i == 2 ? 3 : CHAIN, first);
}

// Some of them torn, by who moved a link
static void make_torn_ropes(scene *s)
{
    fe_body first[2];
    for (int i = 0; i < 3; ++i) {
        (void)hang_chain(s, LINK_BALLS, v3(2 * i, 0, 0), 1 + 100 * i, CHAIN, first);
        fe_transform at = body_transform(s->world, first[1]);
        at.position.z += 3 + i;
        MUST(fe_body_set_transform(s->world, first[1], &at));
    }
}

static void make_heavy_chains(scene *s)
{
    fe_body first[2];
    for (int i = 0; i < LINK_KINDS; ++i) (void)hang_chain(s, (link_kind)i, v3(2 * i, 0, 0), 1000, CHAIN, first);
    fe_body last = hang_chain(s, LINK_HINGES, v3(12, 0, 0), 500, CHAIN, first); // turns in its plane
    MUST(fe_body_set_locks(s->world, last, FE_AXIS_Z, FE_AXIS_X | FE_AXIS_Y));
}

// Trees all of whose bodies have the same locks
static void make_locked_chains(scene *s)
{
    fe_body first[2], bodies[2 * LINK_KINDS * CHAIN];
    for (int i = 0; i < LINK_KINDS; ++i) (void)hang_chain(s, (link_kind)i, v3(2 * i, 0, 0), 300, CHAIN, first);
    int32_t count = fe_world_get_bodies(s->world, bodies, 2 * LINK_KINDS * CHAIN);
    for (int32_t i = 0; i < count; ++i) MUST(fe_body_set_locks(s->world, bodies[i], FE_AXIS_Z, FE_AXIS_X | FE_AXIS_Y));
}

// Light chains that a slack rope leaves to the sweep, until what comes flying opens them
static void make_light_trees(scene *s)
{
    fe_body first[2];
    for (int i = 0; i < 5; ++i) {
        fe_body last = hang_chain(s, i % 2 ? LINK_HINGES : LINK_BALLS, v3(0, 0, 2 * i), 1, 5, first);
        add_slack_rope(s, first[0], first[1]);
        MUST(fe_body_set_filter(s->world, last, 1, 0xFFFFFFFFu, 0));
        fe_body ball = put_ball(s, v3(-3 - i, -0.9, 2 * i), 0.2, 0.2);
        MUST(fe_body_set_mass(s->world, ball, 30));
        set_velocity(s, ball, v3(25, 2, 0), v3(0, 0, 0));
    }
}

static void make_cradle(scene *s)
{
    add_ground(s, bouncy(0, 1));
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 7; ++i) {
            fe_body ball = put_ball(s, v3(1.001 * i, 0.5, 3 * k), 0.5, 1);
            if (i == 0) set_velocity(s, ball, v3(4, 0, 0), v3(0, 0, 0));
            if (i == 6 && k) set_velocity(s, ball, v3(-3, 0, 0), v3(0, 0, 0));
        }
    for (int i = 0; i < 10; ++i) {
        int row = i < 1 ? 0 : i < 3 ? 1 : i < 6 ? 2 : 3;
        static const int first[] = {0, 1, 3, 6};
        (void)put_ball(s, v3(0.88 * row, 0.5, 10 + 1.01 * (i - first[row] - 0.5 * row)), 0.5, 0.9);
    }
    set_velocity(s, put_ball(s, v3(-6, 0.5, 10.1), 0.5, 0.9), v3(20, 0, 0), v3(0, 0, 0));
}

static void make_bullets(scene *s)
{
    add_ground(s, friction(0.4));
    for (int i = 0; i < 4; ++i) {
        (void)add_static(s, box(0.02, 2, 0.4), v3(6 + i, 2, i), UNTURNED, friction(0.4));
        fe_body bullet = put_ball(s, v3(-5 - 9 * i, 1, i), 0.1, 0.3 * i);
        set_velocity(s, bullet, v3(250, 1, 0), v3(0, 0, 30));
        MUST(fe_body_set_bullet(s->world, bullet, i % 2));
    }
    for (int i = 0; i < 4; ++i) (void)put_box(s, v3(3, 0.25 + 0.5 * i, 1), 0.25, 2);
    fe_body stick = add_dynamic(s, box(1, 0.03, 0.03), v3(0, 3, 8), UNTURNED, friction(0.5), WATER);
    set_velocity(s, stick, v3(0, -60, 0), v3(0, 0, 90));
    fe_body blade = add_body(s, FE_BODY_KINEMATIC, box(0.05, 1, 1), v3(-20, 1, 14), UNTURNED, friction(0.5), WATER);
    set_velocity(s, blade, v3(120, 0, 0), v3(0, 0, 0));
    for (int i = 0; i < 3; ++i) (void)put_box(s, v3(3 * i, 0.5, 14), 0.4, 1);
}

// A pendulum of a bullet on a rod, and a whip, which outrun their thickness: joints and trails
static void make_fast_joints(scene *s)
{
    (void)add_static(s, box(0.03, 3, 3), v3(3, 0, 0), UNTURNED, friction(0.5));
    fe_body ball = put_ball(s, v3(0, -4, 0), 0.1, 0);
    (void)add_rod(s, add_anchor(s, v3(0, 0, 0)), ball, v3(0, 0, 0), v3(0, -4, 0));
    set_velocity(s, ball, v3(120, 0, 0), v3(0, 0, 0));
    fe_body first[2], last = hang_chain(s, LINK_BALLS, v3(0, 0, 8), 1, CHAIN, first);
    set_velocity(s, last, v3(150, 0, 0), v3(0, 0, 0));
    last = hang_chain(s, LINK_HINGES, v3(2, 0, 8), 20, CHAIN, first);
    set_velocity(s, last, v3(90, 0, 0), v3(0, 0, 0));
}

static void make_kinematic(scene *s)
{
    add_ground(s, friction(0.6));
    fe_body plate = add_body(s, FE_BODY_KINEMATIC, box(3, 0.2, 3), v3(0, 1, 0), UNTURNED, friction(0.8), WATER);
    set_velocity(s, plate, v3(0.5, 0.3, 0), v3(0, 0.7, 0));
    for (int i = 0; i < 6; ++i) (void)put_box(s, v3(-2 + 0.9 * i, 1.7, 0.3 * i), 0.4, 3);
    fe_body motor = add_body(s, FE_BODY_KINEMATIC, sphere(0.2), v3(8, 3, 0), UNTURNED, friction(0.5), WATER);
    set_velocity(s, motor, v3(0, 0, 0), v3(0, 0, 3));
    touch_nothing(s, motor);
    fe_body arm = add_plain(s, box(0.5, 0.1, 0.1), v3(9, 3, 0)), end = add_plain(s, box(0.5, 0.1, 0.1), v3(10.2, 3, 0));
    (void)add_fixed(s, fixed_def(), motor, arm, v3(8.4, 3, 0));
    (void)add_hinge(s, hinge_def(), end, arm, v3(9.6, 3, 0), v3(0, 0, 1));
    for (int i = 0; i < 3; ++i) (void)put_box(s, v3(9 + i, 0.5, 0), 0.4, 1);
}

static void make_locked(scene *s)
{
    static const uint32_t linear[] = {0, FE_AXIS_Z, FE_AXIS_X | FE_AXIS_Z, 0, FE_AXIS_Z, 7};
    static const uint32_t angular[] = {7, FE_AXIS_X | FE_AXIS_Y, 0, FE_AXIS_Y, 7, FE_AXIS_X};
    fe_body before = 0;
    add_ground(s, friction(0.6));
    for (int i = 0; i < 12; ++i) {
        fe_body body = put_box(s, v3(0.6 * i, 1 + 0.3 * i, 0.1 * i), 0.4, 1 + i);
        MUST(fe_body_set_locks(s->world, body, linear[i % 6], angular[i % 6]));
        set_velocity(s, body, v3(1, 0, -1), v3(3, 2, 1));
        if (i % 4 == 3) (void)add_ball(s, ball_def(), before, body, v3(0.6 * i - 0.3, 1 + 0.3 * i, 0), v3(1, 0, 0));
        before = body;
    }
}

static void make_tops(scene *s)
{
    for (int i = 0; i < 5; ++i) {
        fe_body body = add_plain(s, box(0.5, 0.1 + 0.05 * i, 0.3), v3(2 * i, 0, 0));
        set_velocity(s, body, v3(0, 5, 0), v3(0.1, 9 + 5 * i, 0.2));
        fe_body top = add_plain(s, box(0.6, 0.05, 0.6), v3(2 * i, 0, 5));
        set_velocity(s, top, v3(0, 0, 0), v3(0.3, 20 + i, 0.1));
        if (i % 2)
            (void)add_ball(s, ball_def(), add_anchor(s, v3(2 * i, -0.5, 5)), top, v3(2 * i, -0.5, 5), v3(0, 1, 0));
        else
            (void)add_hinge(s, hinge_def(), add_anchor(s, v3(2 * i, -0.5, 5)), top, v3(2 * i, -0.5, 5), v3(0.1, 1, 0));
    }
}

static void make_breaking(scene *s)
{
    fe_body last = add_anchor(s, v3(0, 0, 0));
    add_plane(s, v3(0, 1, 0), -4, friction(0.5));
    for (int i = 0; i < 10; ++i) {
        fe_ball_joint_def d = ball_def();
        fe_body body = put_ball(s, v3(0.5 * i + 0.5, 0, 0), 0.2, 0);
        d.break_force = i == 4 || i == 8 ? 1500 : 30000;
        (void)add_ball(s, d, last, body, v3(0.5 * i + 0.25, 0, 0), v3(1, 0, 0));
        last = body;
    }
}

static void make_waking(scene *s)
{
    add_ground(s, friction(0.6));
    for (int i = 0; i < 4; ++i) (void)put_box(s, v3(0, 0.5 + i, 0), 0.5, 1);
    for (int i = 0; i < 3; ++i) (void)put_box(s, v3(5, 0.5 + i, 0), 0.5, 1);
    let_all_sleep(s);
    set_velocity(s, put_ball(s, v3(-20, 1, 0), 0.5, 0), v3(12, 8, 0), v3(0, 0, 0));
}

// More lines than a world keeps that sleeps
static void make_sleeping(scene *s)
{
    add_ground(s, friction(0.6));
    for (int i = 0; i < 300; ++i) (void)put_box(s, v3(2 * (i % 20), 0.5, 2 * (i / 20)), 0.5, 1);
    let_all_sleep(s);
}

// As many lines as are merged, no lane, no joint
static void make_flying(scene *s)
{
    for (int i = 0; i < 170; ++i) {
        fe_body ball = put_ball(s, v3(2 * (i % 20), 3 * (i / 20), 0.1 * i), 0.2, 0);
        set_velocity(s, ball, v3(0, 5 + 0.1 * i, 0), v3(0, 0, 1));
    }
}

// Joints of one body beyond the colours there are, and contacts
static void make_joint_hub(scene *s)
{
    fe_body hub = put_ball(s, v3(0, 3, 0), 0.3, 0);
    add_ground(s, friction(0.6));
    for (int i = 0; i < 60; ++i) {
        double angle = 2 * PI * i / 60;
        vec arm = v3(2 * cos(angle), 3 + 0.2 * (i % 3), 2 * sin(angle));
        (void)add_ball(s, ball_def(), hub, put_ball(s, arm, 0.1, 0), arm, v3(1, 0, 0));
    }
}

static void make_contact_hub(scene *s)
{
    add_ground(s, friction(0.6));
    (void)add_dynamic(s, box(4, 0.2, 4), v3(0, 0.3, 0), turned(v3(0, 0, 1), 0.01), friction(0.6), WATER);
    for (int i = 0; i < 121; ++i) (void)put_box(s, v3(0.6 * (i % 11 - 5), 0.78, 0.6 * (i / 11 - 5)), 0.25, 1 + i % 3);
}

// One island above FE__ISLAND_LARGE
static void make_pyramid(scene *s)
{
    add_ground(s, friction(0.6));
    for (int row = 0; row < 34; ++row)
        for (int i = 0; i < 34 - row; ++i) (void)put_box(s, v3(0.505 * i + 0.2525 * row, 0.25 + 0.5 * row, 0), 0.25, 1);
}

// Small islands, of more lanes than are merged
static void make_many_stacks(scene *s)
{
    add_ground(s, friction(0.6));
    for (int i = 0; i < 320; ++i) (void)put_box(s, v3(2 * (i / 2 % 16), 0.5 + i % 2, 2 * (i / 32)), 0.5, 1);
}

static void make_weightless(scene *s)
{
    set_gravity(s, v3(0, 0, 0));
    for (int i = 0; i < 8; ++i) {
        fe_body ball = put_ball(s, v3(1.5 * i, 0.1 * (i % 3), 0), 0.5, 0.25 * (i % 4));
        set_velocity(s, ball, v3(4 - i, 0, 0), v3(0, 0, i));
    }
    (void)put_box(s, v3(0, 5, 0), 0.5, 1);
    set_velocity(s, put_box(s, v3(1.1, 5, 0), 0.5, 50), v3(-12, 0, 0), v3(0, 0, 0));
}

static void make_tuned(scene *s)
{
    fe_world_tuning tuning = {.struct_size = sizeof tuning};
    make_bouncing(s);
    make_strained(s);
    MUST(fe_world_set_substeps(s->world, 2));
    MUST(fe_world_get_tuning(s->world, &tuning));
    tuning.contact_hertz = 60, tuning.restitution_threshold = 0.2f, tuning.warm_start_enabled = 0;
    MUST(fe_world_set_tuning(s->world, &tuning));
}

// Rolling and spinning resistance, a conveyor's surface, loose contacts in a heap, triggers, all events
static void make_heap(scene *s)
{
    add_ground(s, friction(0.6));
    for (int i = 0; i < 4; ++i) {
        double turn = 0.5 * PI * i;
        (void)add_static(s, box(0.2, 2, 2.2), v3(2.2 * cos(turn), 2, 2.2 * sin(turn)), turned(v3(0, -1, 0), turn),
                         friction(0.4));
    }
    for (int i = 0; i < 60; ++i) {
        vec at = v3(-1.4 + 0.9 * (i % 4), 0.5 + 0.8 * (i / 16), -1.4 + 0.9 * (i / 4 % 4));
        fe_geometry form = i % 3 == 0 ? sphere(0.4) : i % 3 == 1 ? box(0.35, 0.35, 0.35) : capsule(0.2, 0.25);
        fe_body body = add_dynamic(s, form, at, turned(v3(1, i % 5, 1), 0.3 * i), friction(0.5), WATER);
        fe_shape shape;
        fe_shape_def def = {.struct_size = sizeof def};
        if (i % 4) continue;
        FE_TRUE(fe_body_get_shapes(s->world, body, &shape, 1) == 1);
        fe_shape_def_init(&def, sizeof def);
        fe_material m = SURFACE(0.5f, 0.4f, 0, 0.2f, 0.02f);
        MUST(fe_shape_set_material(s->world, shape, &m));
        MUST(fe_shape_set_events(s->world, shape, FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT));
    }
}

typedef struct kind_of_world {
    const char *name;
    void (*make)(scene *s);
    int32_t steps; // before it is taken
    int32_t is_heavy;
} kind_of_world;

static const kind_of_world kinds_of_worlds[] = {
    {"empty", make_empty, 0, 0},
    {"lone", make_lone, 0, 0},
    {"bouncing", make_bouncing, 0, 0},
    {"resting", make_resting, 30, 0},
    {"strained", make_strained, 0, 0},
    {"strained for long", make_strained, 20, 0},
    {"strained, bouncing", make_strained_bouncing, 3, 0},
    {"net", make_net, 0, 0},
    {"net, stretched", make_net, 40, 0},
    {"falling net", make_falling_net, 10, 0},
    {"ropes", make_ropes, 0, 0},
    {"torn ropes", make_torn_ropes, 1, 0},
    {"heavy chains", make_heavy_chains, 0, 0},
    {"heavy chains, later", make_heavy_chains, 50, 0},
    {"locked chains", make_locked_chains, 0, 0},
    {"light trees", make_light_trees, 2, 0},
    {"cradle", make_cradle, 0, 0},
    {"bullets", make_bullets, 0, 0},
    {"fast joints", make_fast_joints, 0, 0},
    {"kinematic", make_kinematic, 0, 0},
    {"locked", make_locked, 0, 0},
    {"tops", make_tops, 0, 0},
    {"breaking", make_breaking, 0, 0},
    {"waking", make_waking, 60, 0},
    {"falling asleep", make_sleeping, 20, 0},
    {"asleep", make_sleeping, 60, 0},
    {"flying", make_flying, 0, 0},
    {"joint hub", make_joint_hub, 5, 0},
    {"contact hub", make_contact_hub, 10, 1},
    {"pyramid", make_pyramid, 3, 1},
    {"many stacks", make_many_stacks, 3, 0},
    {"weightless", make_weightless, 0, 0},
    {"tuned", make_tuned, 10, 0},
    {"heap", make_heap, 20, 0},
};

static const struct {
    const script *script;
    int32_t step, is_heavy;
} script_moments[] = {
    {&script_brief, 60, 0},  {&script_brief, 150, 0},    {&script_crowd, 40, 1},  {&script_mixed, 60, 1},
    {&script_mixed, 20, 1},  {&script_terrain, 60, 1},   {&script_fast, 40, 1},   {&script_joints, 30, 1},
    {&script_meshes, 40, 1}, {&script_compounds, 30, 1}, {&script_solids, 40, 1}, {&script_scales, 30, 1},
};

// ---- moments -------------------------------------------------------------------------------------------------------
static void take_moment(const char *name, fe_world *world, int32_t is_heavy)
{
    moment *m = moments + moment_count++;
    FE_TRUE(moment_count <= MOST_MOMENTS);
    *m = (moment){.name = name, .is_heavy = is_heavy, .size = fe_world_save(world, NULL, NULL, 0)};
    m->bytes = malloc((size_t)m->size);
    FE_TRUE(m->bytes && fe_world_save(world, NULL, m->bytes, m->size) == m->size);
    MUST(fe_state_create(world, NULL, &m->state));
}

static void take_moments(void)
{
    enum {
        KINDS = sizeof kinds_of_worlds / sizeof *kinds_of_worlds,
        SCRIPTS = sizeof script_moments / sizeof *script_moments
    };
    static play p;
    fe_world *played[SCRIPTS]; // all of them first: some edit assets of the store
    MUST(fe_store_create(NULL, &store));
    for (int32_t i = 0; i < SCRIPTS; ++i) {
        played[i] = open_world(FE_SIMD_AUTO);
        play_begin(&p, played[i]);
        play_until(&p, script_moments[i].script, script_moments[i].step);
        FE_TRUE(p.errors == 0);
    }
    for (int32_t i = 0; i < SCRIPTS; ++i)
        take_moment(script_moments[i].script->name, played[i], script_moments[i].is_heavy);
    for (int32_t i = 0; i < KINDS; ++i) {
        scene s = {open_world(FE_SIMD_AUTO), UNTURNED, 4, STEP / 4};
        kinds_of_worlds[i].make(&s);
        run(&s, kinds_of_worlds[i].steps);
        take_moment(kinds_of_worlds[i].name, s.world, kinds_of_worlds[i].is_heavy);
        scene_end(&s);
    }
    for (int32_t i = 0; i < SCRIPTS; ++i) MUST(fe_world_destroy(played[i]));
}

static void forget_moments(void)
{
    for (; moment_count > 0; --moment_count) {
        MUST(fe_state_destroy(moments[moment_count - 1].state));
        free(moments[moment_count - 1].bytes);
    }
    MUST(fe_store_destroy(store));
}

#endif
