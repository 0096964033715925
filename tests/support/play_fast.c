// play_fast.c - the script of fast bodies: balls, sticks and boxes at up to 300 m/s in a room of thin walls over
// terrain, bullets among plates, a wall that sweeps, a blade that turns, triggers crossed within a step.
#include "support/play.h"

enum {
    CELLS = 16,
    SAMPLES = CELLS + 1,
    WALLS = 4,
    BODIES = 60,
    PLATES = 12,
    SWEEPER = 5,
    BLADE = 6,
    ZONE = 7,
    FLYING_ZONE = 8,
    FIRST = 9
};

static void add_floor(play *p)
{
    float heights[SAMPLES * SAMPLES];
    fe_asset field = 0;
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) heights[i] = 0.125f * (float)((i * 7) % 5);
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = SAMPLES, def.heights = heights;
    PLAY(p, fe_heightfield_create(world_store(p->world), &def, &field));
    part ground = part_static_box(1.0f, 1.0f, 1.0f, -8.0, 0.0, -8.0);
    fe_geometry_heightfield(&ground.geometry, field);
    play_add(p, &ground);
}

static void add_walls(play *p)
{
    for (int32_t i = 0; i < WALLS; ++i) {
        double out = i % 2 ? 8.0 : -8.0;
        part wall = i < 2 ? part_static_box(0.02f, 6.0f, 8.0f, out, 5.0, 0.0)
                          : part_static_box(8.0f, 6.0f, 0.02f, 0.0, 5.0, out);
        wall.shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_HIT;
        play_add(p, &wall);
    }
}

static void add_machines(play *p)
{
    part sweeper = part_box(0.05f, 2.0f, 4.0f, -6.0, 5.0, 0.0), blade = part_box(3.0f, 0.05f, 0.2f, 0.0, 3.0, 0.0);
    part zone = part_static_box(0.02f, 5.0f, 7.0f, 2.0, 5.0, 0.0), flying = part_box(4.0f, 3.0f, 0.02f, 0.0, 5.0, -6.0);
    sweeper.body.type = blade.body.type = flying.body.type = FE_BODY_KINEMATIC;
    sweeper.body.linear_velocity.x = 90.0f;
    blade.body.angular_velocity.z = 40.0f;
    flying.body.linear_velocity.z = 120.0f;
    zone.shape.trigger = flying.shape.trigger = 1;
    zone.shape.events = flying.shape.events = FE_SHAPE_EVENTS_TOUCH;
    play_add(p, &sweeper);
    play_add(p, &blade);
    play_add(p, &zone);
    play_add(p, &flying);
}

static part any_part(play *p, int32_t i)
{
    double x = (double)play_between(p, -6.0f, 6.0f), y = (double)play_between(p, 2.0f, 9.0f),
           z = (double)play_between(p, -6.0f, 6.0f);
    part a = i % 3 == 0   ? part_sphere(0.1f, x, y, z)
             : i % 3 == 1 ? part_capsule(0.4f, 0.1f, x, y, z)
                          : part_box(0.4f, 0.1f, 0.1f, x, y, z);
    a.body.bullet = i % 4 == 0;
    a.shape.material.restitution = i % 2 ? 0.5f : 0.0f;
    a.body.transform.rotation.x = play_between(p, -1.0f, 1.0f);
    return a;
}

static void shoot(play *p, int32_t actor)
{
    fe_vec3 v = {0.0f, 0.0f, 0.0f}, w = {0.0f, 0.0f, 0.0f};
    v.x = play_between(p, -300.0f, 300.0f), v.y = play_between(p, -100.0f, 100.0f),
    v.z = play_between(p, -300.0f, 300.0f);
    w.x = play_between(p, -30.0f, 30.0f), w.z = play_between(p, -30.0f, 30.0f);
    PLAY(p, fe_body_set_linear_velocity(p->world, p->actors[actor], &v));
    PLAY(p, fe_body_set_angular_velocity(p->world, p->actors[actor], &w));
}

static void build(play *p)
{
    add_floor(p);
    add_walls(p);
    add_machines(p);
    for (int32_t i = 0; i < BODIES; ++i) {
        part a = any_part(p, i);
        play_add(p, &a);
    }
    for (int32_t i = 0; i < PLATES; ++i) {
        part plate = part_box(0.5f, 0.5f, 0.03f, -5.0 + i, 4.0, -5.0 + i);
        play_add(p, &plate);
    }
}

static void act(play *p)
{
    if (p->step % 15 == 0)
        for (int32_t i = p->step / 15 % 3; i < BODIES; i += 3) shoot(p, FIRST + i);
    if (p->step % 20 == 10) {
        fe_vec3 sweep = {p->step % 40 == 10 ? -90.0f : 90.0f, 0.0f, 0.0f},
                fly = {0.0f, 0.0f, p->step % 40 == 10 ? -120.0f : 120.0f};
        PLAY(p, fe_body_set_linear_velocity(p->world, p->actors[SWEEPER], &sweep));
        PLAY(p, fe_body_set_linear_velocity(p->world, p->actors[FLYING_ZONE], &fly));
    }
}

const script script_fast = {"fast", 100, build, act};
