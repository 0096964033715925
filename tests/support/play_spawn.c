// play_spawn.c - the script of bodies that queries place: by turns where a ray hits, where a box overlaps nothing, and
// where a swept ball stops. A wrong bit in an answer becomes a wrong body. No gravity; what is pushed comes to rest by
// damping (after Box3D's test of that kind).
#include "support/play.h"

enum { SPAWNED = 50, EVERY = 2, PILLARS = 9, TRIES = 8 };
static const float SIZE = 0.4f; // m: radius and half a side of what is spawned

static void build(play *p)
{
    const fe_vec3 none = {0, 0, 0};
    PLAY(p, fe_world_set_gravity(p->world, &none));
    for (int32_t i = 0; i < PILLARS; ++i) {
        part pillar = part_static_box(0.5f, 3.0f, 0.3f, 3.0 * (i % 3 - 1), 0.0, 3.0 * (i / 3 - 1));
        pillar.body.transform.rotation.y = 0.25f * (float)i;
        play_add(p, &pillar);
    }
}

static void spawn(play *p, fe_dvec3 at)
{
    const int32_t kind = p->actor_count % 3;
    part a = kind == 0   ? part_sphere(SIZE, at.x, at.y, at.z)
             : kind == 1 ? part_box(SIZE, 0.5f * SIZE, SIZE, at.x, at.y, at.z)
                         : part_capsule(SIZE, 0.5f * SIZE, at.x, at.y, at.z);
    a.body.linear_damping = a.body.angular_damping = 1.0f;
    a.body.linear_velocity.x = -(float)at.x, a.body.linear_velocity.z = -(float)at.z; // towards the middle
    play_add(p, &a);
}

static fe_dvec3 somewhere(play *p)
{
    float x = play_between(p, -8.0f, 8.0f), y = play_between(p, -2.0f, 2.0f), z = play_between(p, -8.0f, 8.0f);
    return (fe_dvec3){(double)x, (double)y, (double)z};
}

static void spawn_at_hit(play *p, fe_dvec3 from, fe_dvec3 way)
{
    fe_hit hit;
    if (fe_world_raycast(p->world, &from, &way, NULL, &hit) != 1) return;
    const double off = (double)SIZE;
    spawn(p, (fe_dvec3){hit.point.x + off * (double)hit.normal.x, hit.point.y + off * (double)hit.normal.y,
                        hit.point.z + off * (double)hit.normal.z});
}

static void spawn_where_free(play *p)
{
    fe_geometry room;
    fe_body inside[4];
    fe_geometry_box(&room, SIZE, SIZE, SIZE);
    for (int32_t i = 0; i < TRIES; ++i) {
        fe_dvec3 at = somewhere(p);
        const fe_transform pose = fe_make_transform(at.x, at.y, at.z);
        if (fe_world_overlap(p->world, &room, &pose, NULL, inside, 4) != 0) continue;
        spawn(p, at);
        return;
    }
}

static void spawn_where_stopped(play *p, fe_dvec3 from, fe_dvec3 way)
{
    fe_geometry ball;
    fe_hit hit;
    const fe_transform start = fe_make_transform(from.x, from.y, from.z);
    fe_geometry_sphere(&ball, SIZE);
    if (fe_world_sweep(p->world, &ball, &start, &way, NULL, &hit) != 1) return;
    spawn(p, (fe_dvec3){from.x + hit.fraction * way.x, from.y + hit.fraction * way.y, from.z + hit.fraction * way.z});
}

static void act(play *p)
{
    if (p->step % EVERY != 0 || p->actor_count >= PILLARS + SPAWNED) return;
    fe_dvec3 from = somewhere(p),
             way = {-2.0 * from.x, -2.0 * from.y, -2.0 * from.z}; // through the pillar in the middle
    switch (p->step / EVERY % 3) {
    case 0:
        spawn_at_hit(p, from, way);
        break;
    case 1:
        spawn_where_free(p);
        break;
    default:
        spawn_where_stopped(p, from, way);
        break;
    }
}

const script script_spawn = {"spawn", 200, build, act};
