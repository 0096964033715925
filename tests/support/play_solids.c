// play_solids.c - the script of hulls, cylinders and cones: heaps of them among balls, capsules and boxes, on waves and
// on a floor of hulls; fast ones, triggers, hulls whose handle dies, and forms that sweep, overlap and are put where
// they stop.
#include "support/play.h"

enum { CELLS = 16, SAMPLES = CELLS + 1, HULLS = 6, TILES = 9, BODIES = 150, FLOOR = 1 + TILES, PROBES = 5 };

// Points anywhere in a box; the third hull is a wedge, whose points are the corners of two triangles
static fe_asset make_hull(play *p, int32_t which)
{
    enum { MOST = 80 };
    float points[MOST][3];
    const int32_t count = which == 2 ? 6 : 12 + 13 * which;
    fe_hull_def def;
    fe_asset hull = 0;
    for (int32_t i = 0; i < count; ++i) {
        points[i][0] = which == 2 ? (i % 3 == 1 ? 0.4f : -0.3f) : play_between(p, -0.4f, 0.4f);
        points[i][1] = which == 2 ? (i % 3 == 2 ? 0.3f : -0.2f) : play_between(p, -0.25f, 0.4f);
        points[i][2] = which == 2 ? (i < 3 ? -0.25f : 0.35f) : play_between(p, -0.3f, 0.3f);
    }
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = count, def.max_vertices = which == 5 ? 24 : 64;
    PLAY(p, fe_hull_create(world_store(p->world), &def, &hull));
    return hull;
}

static fe_asset hull_of(play *p, int32_t which)
{
    if (!p->assets[which]) p->assets[which] = make_hull(p, which);
    return p->assets[which];
}

static void add_waves(play *p)
{
    float heights[SAMPLES * SAMPLES];
    fe_asset field = 0;
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) heights[i] = 0.0625f * (float)((i * 7) % 5);
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = SAMPLES, def.heights = heights;
    PLAY(p, fe_heightfield_create(world_store(p->world), &def, &field));
    part ground = part_static_box(1.0f, 1.0f, 1.0f, -16.0, 0.0, -8.0);
    fe_geometry_heightfield(&ground.geometry, field);
    play_add(p, &ground);
}

// a floor beside the waves: eight-cornered tiles, whose seams bodies roll over
static void add_tiles(play *p)
{
    float corners[8][3];
    fe_hull_def def;
    fe_asset tile = 0;
    for (int32_t i = 0; i < 8; ++i) {
        corners[i][0] = i & 1 ? 2.0f : -2.0f;
        corners[i][1] = i & 2 ? 0.0f : -0.5f;
        corners[i][2] = i & 4 ? 2.0f : -2.0f;
    }
    fe_hull_def_init(&def, sizeof def);
    def.points = corners[0], def.point_count = 8;
    PLAY(p, fe_hull_create(world_store(p->world), &def, &tile));
    for (int32_t i = 0; i < TILES; ++i) {
        part a = part_static_box(1.0f, 1.0f, 1.0f, 2.0 + 4.0 * (i % 3), 0.0, -4.0 + 4.0 * (i / 3));
        fe_geometry_hull(&a.geometry, tile);
        play_add(p, &a);
    }
    PLAY(p, fe_asset_destroy(world_store(p->world), tile)); // lives with its shapes
}

static void choose_form(play *p, int32_t i, float size, fe_geometry *out)
{
    switch (i % 8) {
    case 0:
        fe_geometry_cylinder(out, 0.7f * size, size);
        break;
    case 1:
        fe_geometry_cone(out, size, 0.8f * size);
        break;
    case 2:
        fe_geometry_sphere(out, size);
        break;
    case 4:
        fe_geometry_capsule(out, size, 0.6f * size);
        break;
    case 6:
        fe_geometry_box(out, size, 0.5f * size, 0.8f * size);
        break;
    default:
        fe_geometry_hull(out, hull_of(p, i / 2 % HULLS));
    }
}

static part any_part(play *p, int32_t i)
{
    double x = (double)play_between(p, -12.0f, 10.0f), z = (double)play_between(p, -4.0f, 4.0f);
    part a = part_sphere(1.0f, x, 1.5 + 0.04 * i, z);
    choose_form(p, i, play_between(p, 0.15f, 0.4f), &a.geometry);
    a.body.transform.rotation.x = play_between(p, -1.0f, 1.0f);
    a.body.transform.rotation.z = play_between(p, -1.0f, 1.0f);
    a.shape.material.rolling_resistance = 0.1f;
    a.shape.material.spinning_resistance = 0.02f;
    if (i % 5 == 0) a.shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_HIT;
    if (i % 19 == 3) a.shape.trigger = 1, a.body.gravity_scale = 0.2f;
    if (i % 9 == 4) a.body.linear_velocity.x = 40.0f, a.body.linear_velocity.y = -60.0f;
    if (i % 27 == 5) a.body.bullet = 1, a.body.linear_velocity.z = 90.0f;
    return a;
}

static void build(play *p)
{
    add_waves(p);
    add_tiles(p);
    for (int32_t i = 0; i < BODIES; ++i) {
        part a = any_part(p, i);
        play_add(p, &a);
    }
}

// A form that falls from above stays where it is stopped, if nothing is in its way there
static void place(play *p)
{
    const int32_t kinds[PROBES] = {0, 1, 3, 5, 7};
    const fe_dvec3 way = {1.0, -9.0, 0.5};
    part a = any_part(p, kinds[p->step / 10 % PROBES]);
    fe_transform *at = &a.body.transform;
    fe_body over[8];
    fe_hit hit;
    at->position.y = 9.0;
    if (fe_world_sweep(p->world, &a.geometry, at, &way, NULL, &hit) != 1) return;
    at->position.x += hit.fraction * way.x, at->position.y += hit.fraction * way.y,
        at->position.z += hit.fraction * way.z;
    if (fe_world_overlap(p->world, &a.geometry, at, NULL, over, 8) == 0) play_add(p, &a);
}

static void act(play *p)
{
    if (p->step % 10 == 5) place(p);
    if (p->step == 100) PLAY(p, fe_asset_destroy(world_store(p->world), p->assets[1]));
    if (p->step == 120) play_remove(p, FLOOR + 7);
    if (p->step == 130) {
        fe_geometry hull;
        fe_geometry_hull(&hull, p->assets[0]);
        PLAY(p, fe_shape_set_geometry(p->world, p->shapes[FLOOR + 2], &hull)); // was a ball
    }
    if (p->step == 160) play_remove(p, 5); // a tile, under what lies there
}

const script script_solids = {"solids", 200, build, act};
