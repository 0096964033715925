// play_joints.c - the script of joints: ragdolls of examples/machines.h fall over each other, a net of ball joints in
// one island wide enough to be spread over the workers, heavy weights on chains that reach into it, a row of each type
// with limits, springs and motors at work, strings that break in one step, joints that are made, changed, switched and
// destroyed, bodies that take theirs along.
#include "support/any_joint.h"
#include "support/play.h"

#include "../../examples/machines.h"

#include <stdlib.h>

enum { PEOPLE = 4, NET = 24, GUESTS = 6, CHAINS = 6, LINKS = 8, ROW = 4 * ANY_KINDS, STRINGS = 12 };
enum { NET_GROUP, GUEST_GROUP, ROW_GROUP, STRING_GROUP };          // p->groups: first actors
enum { ROW_JOINTS = STRING_GROUP + 1, STRING_JOINTS, LAST_GROUP }; // p->groups: first joints

static fe_joint *new_joint(play *p)
{
    if (p->joint_count == PLAY_MOST_JOINTS) abort();
    return &p->joints[p->joint_count++];
}

static void tie(play *p, int32_t a, int32_t b, fe_dvec3 point, float break_force)
{
    const fe_vec3 down = {0, -1, 0};
    fe_ball_joint_def d;
    fe_ball_joint_def_init(&d, sizeof d);
    d.break_force = break_force;
    PLAY(p, fe_ball_joint_def_at(p->world, &d, p->actors[a], p->actors[b], &point, &down));
    PLAY(p, fe_ball_joint_create(p->world, &d, new_joint(p)));
}

// ---- a net of balls in the air, and what falls into it -------------------------------------------------------------

static void add_net(play *p)
{
    p->groups[NET_GROUP] = p->actor_count;
    for (int32_t i = 0; i < NET * NET; ++i) {
        int32_t row = i / NET, column = i % NET;
        fe_dvec3 at = {-20.0 + 0.25 * column, 6.0, 0.25 * row}, left = {at.x - 0.125, at.y, at.z},
                 behind = {at.x, at.y, at.z - 0.125};
        part knot = part_sphere(0.1f, at.x, at.y, at.z);
        if (row == 0 || column == 0) knot.body.type = FE_BODY_STATIC;
        knot.shape.layer = 2, knot.shape.mask = 4; // touches guests only
        int32_t actor = play_add(p, &knot);
        if (column && row) tie(p, actor - 1, actor, left, 0);
        if (column && row) tie(p, actor - NET, actor, behind, 0);
    }
    p->groups[GUEST_GROUP] = p->actor_count;
    for (int32_t i = 0; i < GUESTS; ++i) {
        part guest = part_box(0.3f, 0.2f, 0.25f, -18.5 + 0.6 * i, 6.6 + 0.3 * i, 1.5 + 0.5 * i);
        guest.shape.layer = 4;
        play_add(p, &guest);
    }
}

// Weights of 130 links each, on chains of which every other is branched: trees of the net's island, as soon as they
// touch it
static void add_chains(play *p)
{
    for (int32_t i = 0; i < CHAINS; ++i) {
        double x = -19.0 + 0.7 * i, z = 4.5, y = 6.6;
        part post = part_static_box(0.05f, 0.05f, 0.05f, x, y + 0.2 * LINKS + 0.1, z);
        int32_t above = play_add(p, &post);
        for (int32_t k = 0; k <= LINKS; ++k) {
            part link = part_capsule(0.05f, 0.02f, x, y + 0.2 * (LINKS - k), z),
                 weight = part_box(0.2f, 0.1f, 0.2f, x, y, z);
            link.shape.mask = 0, weight.shape.layer = 4;
            weight.body.linear_velocity.x = 2.0f;
            int32_t actor = play_add(p, k < LINKS ? &link : &weight);
            tie(p, above, actor, (fe_dvec3){x, y + 0.2 * (LINKS - k) + 0.1, z}, 0);
            if (k == 3 && i % 2) {
                part side = part_box(0.1f, 0.1f, 0.1f, x + 0.15, y + 0.2 * (LINKS - k), z);
                side.shape.mask = 0;
                tie(p, actor, play_add(p, &side), (fe_dvec3){x + 0.02, y + 0.2 * (LINKS - k), z}, 0);
            }
            above = actor;
        }
    }
}

// ---- a row of all types --------------------------------------------------------------------------------------------

static void hang(play *p, int32_t i, fe_body a, fe_body b)
{
    const fe_dvec3 top = {2.0 * i, 3.0, 12.0}, low = {2.0 * i, 2.5, 12.0};
    const fe_vec3 axis = {1, (float)(i % 3), 0.5f};
    float strength = (float)(i / ANY_KINDS);
    any_def d;
    any_init(i % ANY_KINDS, &d);
    switch (i % ANY_KINDS) {
    case ANY_DISTANCE:
        PLAY(p, fe_rope_joint_def_at(p->world, &d.distance, a, b, &top, &low, 0.6f));
        d.distance.spring_hertz = strength, d.distance.motor_max = 10 * strength, d.distance.motor_speed = -0.2f;
        break;
    case ANY_BALL:
        d.ball.cone_enabled = d.ball.limit_enabled = i % 2, d.ball.cone_y = 0.5f, d.ball.cone_z = 0.25f;
        d.ball.upper = 0.5f, d.ball.lower = -1, d.ball.limit_hertz = 10 * strength;
        d.ball.spring_hertz = strength, d.ball.motor_max = 5 * strength, d.ball.motor_velocity.y = 1;
        PLAY(p, fe_ball_joint_def_at(p->world, &d.ball, a, b, &top, &axis));
        break;
    case ANY_HINGE:
        d.hinge.limit_enabled = i % 2, d.hinge.lower = -0.5f, d.hinge.upper = 3.1415927f,
        d.hinge.spring_hertz = strength;
        d.hinge.motor_speed = 3, d.hinge.motor_max = 30 * strength, d.hinge.hertz = 10 * strength;
        PLAY(p, fe_hinge_joint_def_at(p->world, &d.hinge, a, b, &top, &axis));
        break;
    case ANY_FIXED:
        d.fixed.angular_hertz = strength, d.fixed.hertz = 3 * strength, d.fixed.angular_damping_ratio = 0.1f;
        PLAY(p, fe_fixed_joint_def_at(p->world, &d.fixed, a, b, &top));
        break;
    default:
        for (int32_t k = 0; k < 6; ++k) {
            fe_joint_axis *way = &d.configurable.axes[k];
            way->motion = (k + i / ANY_KINDS) % 3, way->lower = -0.2f, way->upper = 0.3f;
            if (way->motion)
                way->spring = 1 + k % 2, way->spring_hertz = way->spring_stiffness = 2,
                way->spring_damping_ratio = way->spring_damping = 0.5f, way->motor_max = 3, way->motor_speed = 1;
        }
        PLAY(p, fe_configurable_joint_def_at(p->world, &d.configurable, a, b, &top, &axis));
        break;
    }
    PLAY(p, any_create(i % ANY_KINDS, p->world, &d, new_joint(p)));
}

static void add_row(play *p)
{
    part post = part_static_box(0.1f, 0.1f, 0.1f, 0.0, 3.0, 12.0);
    p->groups[ROW_GROUP] = play_add(p, &post);
    p->groups[ROW_JOINTS] = p->joint_count;
    for (int32_t i = 0; i < ROW; ++i) {
        part bob = part_box(0.2f, 0.3f, 0.15f, 2.0 * i, 2.3, 12.1);
        bob.body.angular_velocity.y = 2.0f;
        int32_t actor = play_add(p, &bob);
        hang(p, i, p->actors[p->groups[ROW_GROUP]], p->actors[actor]);
    }
}

// ---- strings, two thirds of which are too weak, made in another order than they hang -------------------------------

static void add_strings(play *p)
{
    p->groups[STRING_GROUP] = p->actor_count;
    for (int32_t i = 0; i < STRINGS; ++i) {
        part weight = part_sphere(0.2f, (double)i, 2.0, -12.0); // 33.5 kg: 330 N
        play_add(p, &weight);
    }
    p->groups[STRING_JOINTS] = p->joint_count;
    for (int32_t i = 0; i < STRINGS; ++i) {
        int32_t which = i * 5 % STRINGS;
        tie(p, p->groups[ROW_GROUP], p->groups[STRING_GROUP] + which, (fe_dvec3){which, 3.0, -12.0},
            i % 3 ? 200.0f : 2000.0f);
    }
}

// ---- the script ----------------------------------------------------------------------------------------------------

static void build(play *p)
{
    part ground = part_plane(0.0f, 1.0f, 0.0f);
    play_add(p, &ground);
    add_net(p);
    add_chains(p);
    add_row(p);
    add_strings(p);
    for (int32_t i = 0; i < PEOPLE; ++i) {
        ragdoll person;
        PLAY(p, ragdoll_build(p->world, fe_make_transform(0.2 * i, 0.6 + 1.2 * i, 0.1 * (i % 2)), 5, &person));
    }
}

static void change_row(play *p)
{
    fe_hinge_joint_def hinge = {.struct_size = sizeof hinge};
    fe_joint_def front = {.struct_size = sizeof front};
    fe_joint *row = p->joints + p->groups[ROW_JOINTS];
    PLAY(p, fe_hinge_joint_get(p->world, row[7], &hinge));
    hinge.motor_speed = -3;
    PLAY(p, fe_hinge_joint_set(p->world, row[7], &hinge));
    PLAY(p, fe_joint_get(p->world, row[11], &front));
    front.collide_connected = 1;
    PLAY(p, fe_joint_set(p->world, row[11], &front));
    PLAY(p, fe_joint_set_enabled(p->world, row[12], 0));
    PLAY(p, fe_joint_destroy(p->world, row[6]));
}

static void act(play *p)
{
    fe_joint *row = p->joints + p->groups[ROW_JOINTS];
    if (p->step == 20) change_row(p);
    if (p->step == 35) PLAY(p, fe_joint_set_enabled(p->world, row[12], 1));
    if (p->step == 40) play_remove(p, p->groups[ROW_GROUP] + 1 + 8); // and its joint
    if (p->step == 45) hang(p, 6, p->actors[p->groups[ROW_GROUP]], p->actors[p->groups[ROW_GROUP] + 1 + 6]);
    if (p->step == 60) // a hole in the net
        for (int32_t i = 0; i < 3; ++i) play_remove(p, p->groups[NET_GROUP] + NET * (10 + i) + 10);
    if (p->step == 70) PLAY(p, fe_body_set_type(p->world, p->actors[p->groups[ROW_GROUP] + 1 + 13], FE_BODY_STATIC));
    if (p->step == 75) PLAY(p, fe_body_set_enabled(p->world, p->actors[p->groups[ROW_GROUP] + 1 + 14], 0));
}

const script script_joints = {"joints", 100, build, act};
