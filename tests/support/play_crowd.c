// play_crowd.c - the script with everything in it: a tilted pit full of boxes, spheres and capsules, rolling and
// bouncing things on a tilted plane, locked bodies, riders on a kinematic platform, a conveyor, triggers, stacks that
// sleep and are woken, bodies that come and go, settings that change. More than 1000 contacts in one island, so that it
// is spread over the workers, and small islands beside it.
#include "support/play.h"

enum { PIT_BODIES = 480, ROLLERS = 24, BOUNCERS = 9, LOCKED = 16, RIDERS = 6, STACKS = 4, STACK_BOXES = 5, CARGO = 4 };
enum { PIT, ROLLER, BOUNCER, LOCK, PLATFORM, RIDER, STACK, CARGO_BOX, FLOOR, TRIGGER }; // groups

// ---- the pit -------------------------------------------------------------------------------------------------------

static const double pit_x = -12.0, pit_half = 2.4; // m

static part pit_part(play *p, int32_t i)
{
    float size = play_between(p, 0.18f, 0.3f), long_side = play_between(p, 0.3f, 0.5f);
    double x = pit_x + (double)play_between(p, -1.8f, 1.8f);
    double z = (double)play_between(p, -1.8f, 1.8f);
    double y = 1.0 + 0.045 * (double)i;
    part a;
    switch (i % 4) {
    case 0:
        a = part_sphere(size, x, y, z);
        break;
    case 1:
        a = part_capsule(0.6f * long_side, 0.7f * size, x, y, z);
        break;
    default:
        a = part_box(size, 0.7f * size, long_side, x, y, z);
    }
    a.body.transform.rotation.x = play_between(p, -1.0f, 1.0f);
    a.body.transform.rotation.z = play_between(p, -1.0f, 1.0f);
    if (i % 5 == 0) a.shape.material.rolling_resistance = 0.02f;
    if (i % 7 == 0) a.shape.material.restitution = 0.4f;
    if (i % 11 == 0) a.shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT;
    return a;
}

static void build_pit(play *p)
{
    part floor = part_static_box(3.5f, 0.5f, 3.5f, pit_x, -0.4, 0.0);
    floor.body.transform.rotation.z = 0.06f; // 7 degrees
    floor.body.transform.rotation.x = 0.02f;
    p->groups[FLOOR] = play_add(p, &floor);
    for (int32_t side = -1; side <= 1; side += 2) {
        part wall_x = part_static_box(0.5f, 8.0f, 3.5f, pit_x + side * (pit_half + 0.5), 7.0, 0.0);
        part wall_z = part_static_box(3.5f, 8.0f, 0.5f, pit_x, 7.0, side * (pit_half + 0.5));
        wall_x.shape.material.static_friction = wall_x.shape.material.dynamic_friction = 0.2f;
        play_add(p, &wall_x);
        play_add(p, &wall_z);
    }
    part trigger = part_static_box(1.0f, 0.5f, 1.0f, pit_x, 1.2, 0.0);
    trigger.shape.trigger = 1;
    trigger.shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY;
    p->groups[TRIGGER] = play_add(p, &trigger);
    p->groups[PIT] = p->actor_count;
    for (int32_t i = 0; i < PIT_BODIES; ++i) {
        part a = pit_part(p, i);
        play_add(p, &a);
    }
}

// ---- on the plane --------------------------------------------------------------------------------------------------

static void build_rollers(play *p)
{
    p->groups[ROLLER] = p->actor_count;
    for (int32_t i = 0; i < ROLLERS; ++i) {
        float r = 0.2f + 0.02f * (float)(i % 5);
        double z = -10.0 - 1.0 * i;
        part a = i % 3 == 2 ? part_capsule(0.3f, r, -6.0, (double)r, z) : part_sphere(r, -6.0, (double)r + 0.01, z);
        if (i % 3 == 2) a.body.transform.rotation.x = 1.0f, a.body.transform.rotation.w = 1.0f; // its axis along z
        a.body.linear_velocity.x = 10.0f;                                                       // m/s
        a.body.angular_velocity.z = -10.0f / r;
        a.shape.material.rolling_resistance = 0.01f * (float)(i % 4);
        a.shape.material.spinning_resistance = 0.005f * (float)(i % 3);
        if (i % 4 == 1) a.body.angular_velocity.y = 20.0f;
        if (i % 6 == 0) a.body.bullet = 1;
        play_add(p, &a);
    }
    p->groups[BOUNCER] = p->actor_count;
    for (int32_t i = 0; i < BOUNCERS; ++i) {
        part a =
            i % 3 ? part_sphere(0.25f, 4.0 + i, 2.0 + 0.3 * i, 6.0) : part_box(0.2f, 0.3f, 0.25f, 4.0 + i, 3.0, 6.0);
        a.shape.material.restitution = 0.9f;
        a.shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_HIT;
        a.body.transform.rotation.z = 0.2f * (float)(i % 2);
        play_add(p, &a);
    }
}

// each lock in turn, in two rows that fall on each other
static void build_locked(play *p)
{
    p->groups[LOCK] = p->actor_count;
    for (int32_t i = 0; i < LOCKED; ++i) {
        part a = part_box(0.3f, 0.2f, 0.25f, 3.0 + 0.7 * (i % 8), 0.8 + 0.6 * (i / 8), 0.05 * i);
        a.body.linear_locks = (uint32_t)(i % 8 == 1 ? FE_AXIS_X : i % 8 == 2 ? FE_AXIS_Z : FE_AXIS_NONE);
        a.body.angular_locks = (uint32_t)(i % 8);
        a.body.transform.rotation.x = 0.1f;
        play_add(p, &a);
    }
}

static void build_platform(play *p)
{
    part platform = part_box(1.5f, 0.1f, 1.0f, 0.0, 2.0, -5.0);
    platform.body.type = FE_BODY_KINEMATIC;
    p->groups[PLATFORM] = play_add(p, &platform);
    p->groups[RIDER] = p->actor_count;
    for (int32_t i = 0; i < RIDERS; ++i) {
        part a = i % 2 ? part_box(0.2f, 0.15f, 0.3f, -1.0 + 0.4 * i, 2.3, -5.0)
                       : part_capsule(0.2f, 0.15f, -1.0 + 0.4 * i, 2.5, -5.0);
        play_add(p, &a);
    }
    part belt = part_static_box(2.0f, 0.2f, 0.6f, 0.0, 0.6, 4.0);
    belt.shape.surface_velocity.x = 1.5f;
    play_add(p, &belt);
    p->groups[CARGO_BOX] = p->actor_count;
    for (int32_t i = 0; i < CARGO; ++i) {
        part a = part_box(0.15f, 0.2f, 0.25f, -1.5 + 0.7 * i, 1.05, 4.0);
        play_add(p, &a);
        // a feeler around each: a second shape, a trigger
        fe_shape feeler;
        a.shape.trigger = 1;
        fe_geometry_sphere(&a.geometry, 0.6f);
        PLAY(p, fe_shape_create(p->world, p->actors[p->actor_count - 1], &a.shape, &a.geometry, &feeler));
    }
}

static void build_stacks(play *p)
{
    p->groups[STACK] = p->actor_count;
    for (int32_t k = 0; k < STACKS; ++k) {
        part base = part_static_box(0.6f, 0.2f, 0.6f, 10.0 + 3.0 * k, 0.0, 0.0);
        play_add(p, &base);
        for (int32_t i = 0; i < STACK_BOXES; ++i) {
            part a = part_box(0.3f, 0.2f, 0.35f, 10.0 + 3.0 * k, 0.4 + 0.4 * i, 0.0);
            play_add(p, &a);
        }
    }
}

static void build(play *p)
{
    part ground = part_plane(0.02f, 1.0f, 0.01f);
    play_add(p, &ground);
    build_pit(p);
    build_rollers(p);
    build_locked(p);
    build_platform(p);
    build_stacks(p);
}

// ---- what happens --------------------------------------------------------------------------------------------------

// along a triangle wave of 1 m and 2 s, turning slowly
static void drive_platform(play *p)
{
    int32_t phase = p->step % 120;
    double x = (phase < 60 ? phase - 30 : 90 - phase) / 30.0;
    fe_transform target = fe_make_transform(x, 2.0 + 0.2 * x, -5.0);
    target.rotation.y = 0.1f * (float)x;
    PLAY(p, fe_body_set_target(p->world, p->actors[p->groups[PLATFORM]], &target, p->dt));
}

static void replace_in_pit(play *p, int32_t i)
{
    int32_t actor = p->groups[PIT] + i;
    if (p->actors[actor]) {
        play_remove(p, actor);
        return;
    }
    part a = pit_part(p, i);
    a.body.transform.position.y = 4.0;
    a.body.linear_velocity.y = -3.0f;
    play_put(p, actor, &a);
}

static void disturb_stacks(play *p)
{
    int32_t first = p->groups[STACK], each = 1 + STACK_BOXES;
    const fe_vec3 impulse = {20.0f, 0.0f, 5.0f}, force = {0.0f, 900.0f, 0.0f};
    if (p->step == 150) play_remove(p, first); // its support goes
    if (p->step == 170) PLAY(p, fe_body_add_impulse(p->world, p->actors[first + each + STACK_BOXES], &impulse));
    if (p->step == 180) {
        part a = part_sphere(0.2f, 16.1, 5.0, 0.0);
        play_add(p, &a); // falls on the third
    }
    if (p->step == 200) PLAY(p, fe_body_add_force(p->world, p->actors[first + 3 * each + 1], &force));
}

static void change_bodies(play *p)
{
    fe_world *w = p->world;
    const fe_body *rider = p->actors + p->groups[RIDER], *lock = p->actors + p->groups[LOCK];
    fe_transform up = fe_make_transform(-0.5, 3.5, -5.0);
    const part ball = part_sphere(0.35f, 0.0, 0.0, 0.0);
    if (p->step == 60) PLAY(p, fe_body_set_type(w, rider[1], FE_BODY_KINEMATIC));
    if (p->step == 90) PLAY(p, fe_body_set_type(w, rider[1], FE_BODY_DYNAMIC));
    if (p->step == 100) PLAY(p, fe_body_set_transform(w, rider[2], &up));
    if (p->step == 110) PLAY(p, fe_body_set_enabled(w, lock[3], 0));
    if (p->step == 140) PLAY(p, fe_body_set_enabled(w, lock[3], 1));
    if (p->step == 120) PLAY(p, fe_body_set_locks(w, lock[5], FE_AXIS_NONE, FE_AXIS_ALL));
    if (p->step == 130) PLAY(p, fe_shape_set_filter(w, p->shapes[p->groups[CARGO_BOX]], 2, 1, 0));
    if (p->step == 145) PLAY(p, fe_world_ignore_collision(w, lock[8], lock[9], 1));
    if (p->step == 160) PLAY(p, fe_body_set_mass(w, lock[10], 500.0f));
    if (p->step == 175) PLAY(p, fe_shape_set_geometry(w, p->shapes[p->groups[LOCK] + 12], &ball.geometry));
}

static void change_settings(play *p)
{
    fe_world *w = p->world;
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    const fe_vec3 askew = {1.0f, -9.0f, 0.5f}, down = {0.0f, -9.81f, 0.0f};
    if (p->step == 185) PLAY(p, fe_world_set_substeps(w, 4));
    if (p->step == 205) PLAY(p, fe_world_set_substeps(w, 8));
    if (p->step == 210) p->dt = 1.0f / 120.0f;
    if (p->step == 220) p->dt = 1.0f / 60.0f;
    if (p->step == 225) PLAY(p, fe_world_step(w, 0.0f));
    if (p->step == 230) PLAY(p, fe_world_set_gravity(w, &askew));
    if (p->step == 245) PLAY(p, fe_world_set_gravity(w, &down));
    tuning.contact_hertz = 40.0f;
    tuning.speculative_distance = 0.03f;
    if (p->step == 235) PLAY(p, fe_world_set_tuning(w, &tuning));
}

static void act(play *p)
{
    drive_platform(p);
    if (p->step % 4 == 3) replace_in_pit(p, (p->step * 37) % PIT_BODIES);
    if (p->step % 8 == 7) replace_in_pit(p, ((p->step - 4) * 37) % PIT_BODIES); // what went half a round ago comes back
    disturb_stacks(p);
    change_bodies(p);
    change_settings(p);
}

const script script_crowd = {"crowd", 300, build, act};
