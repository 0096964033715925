// play_scales.c - the script of scales: four tiles, which are one mesh and its images in mirrors, under a rain of hulls
// of many sizes among other forms; scales that change, an asset whose handle dies, materials that change, a scaled mesh
// that is carried, and scaled hulls that are put where they stop.
#include "support/play.h"

enum { CELLS = 12, SAMPLES = CELLS + 1, TILES = 4, BODIES = 120, HULLS = 3, MESH = HULLS, LIFT = TILES, FIRST };

static const fe_material surfaces[2] = {SURFACE(0.6f, 0.5f, 0.0f, 0.1f, 0.02f), SURFACE(0.3f, 0.2f, 0.5f, 0.1f, 0.0f)};

static void make_tile(play *p)
{
    float vertices[SAMPLES * SAMPLES][3];
    uint16_t triangles[2 * CELLS * CELLS][3];
    uint8_t kinds[2 * CELLS * CELLS];
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) {
        int32_t column = i % SAMPLES, row = i / SAMPLES;
        vertices[i][0] = (float)column, vertices[i][1] = play_wave(column, row), vertices[i][2] = (float)row;
    }
    for (int32_t i = 0; i < CELLS * CELLS; ++i) {
        int32_t corner = i / CELLS * SAMPLES + i % CELLS, flip = (i % CELLS + i / CELLS) % 2;
        int32_t v[4] = {corner, corner + SAMPLES, corner + SAMPLES + 1, corner + 1};
        for (int32_t k = 0; k < 3; ++k) {
            triangles[2 * i][k] = (uint16_t)v[(k + flip) % 4];
            triangles[2 * i + 1][k] = (uint16_t)v[(k + 2 + flip) % 4];
        }
        kinds[2 * i] = kinds[2 * i + 1] = (uint8_t)(i % 7 == 0);
    }
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = vertices[0], def.vertex_count = SAMPLES * SAMPLES;
    def.indices = triangles, def.triangle_count = 2 * CELLS * CELLS, def.index_type = FE_INDEX_U16;
    def.triangle_materials = kinds, def.materials = surfaces, def.material_count = 2;
    PLAY(p, fe_mesh_create(world_store(p->world), &def, p->assets + MESH));
}

static void make_hull(play *p, int32_t which)
{
    enum { MOST = 40 };
    float points[MOST][3];
    const int32_t count = which ? 8 + 16 * which : 8;
    fe_hull_def def;
    for (int32_t i = 0; i < 3 * count; ++i)
        points[i / 3][i % 3] = which ? play_between(p, -0.4f, 0.4f) : i / 3 >> i % 3 & 1 ? 0.3f : -0.3f;
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = count;
    PLAY(p, fe_hull_create(world_store(p->world), &def, p->assets + which));
}

// One of a few: shapes share them
static void scale_hull(play *p, int32_t i, fe_geometry *out)
{
    static const fe_vec3 scales[7] = {{1.0f, 1.0f, 1.0f},   {-1.0f, 1.0f, 1.0f},  {0.5f, 0.5f, 0.5f},
                                      {1.5f, 0.6f, -1.0f},  {-0.4f, -1.3f, 0.8f}, {0.25f, 1.6f, 0.9f},
                                      {-0.7f, -0.7f, -0.7f}};
    fe_vec3 s = scales[i % 7];
    fe_geometry_hull(out, p->assets[i % HULLS]);
    fe_geometry_set_scale(out, s.x, s.y, s.z);
}

static part any_part(play *p, int32_t i)
{
    double x = (double)play_between(p, -9.0f, 9.0f), z = (double)play_between(p, -9.0f, 9.0f);
    part a = part_sphere(0.25f, x, 2.5 + 0.04 * i, z);
    if (i % 6 == 5)
        fe_geometry_capsule(&a.geometry, 0.2f, 0.15f);
    else if (i % 6)
        scale_hull(p, i, &a.geometry);
    play_tumble(p, i, -50.0f, &a);
    return a;
}

static void build(play *p)
{
    static const float sides[TILES][2] = {{1.0f, 1.0f}, {-1.0f, 1.0f}, {1.0f, -1.0f}, {-1.0f, -1.0f}};
    for (int32_t i = 0; i < HULLS; ++i) make_hull(p, i);
    make_tile(p);
    for (int32_t i = 0; i < TILES; ++i) {
        part tile = part_static_box(1.0f, 1.0f, 1.0f, 0.0, 0.0, 0.0);
        fe_geometry_mesh(&tile.geometry, p->assets[MESH]);
        fe_geometry_set_scale(&tile.geometry, sides[i][0], 1.0f, sides[i][1]);
        play_add(p, &tile);
    }
    part lift = part_static_box(1.0f, 1.0f, 1.0f, -1.5, 2.0, -2.0);
    fe_geometry_mesh(&lift.geometry, p->assets[MESH]);
    fe_geometry_set_scale(&lift.geometry, 0.25f, -0.5f, -0.375f);
    lift.body.type = FE_BODY_KINEMATIC, lift.body.angular_velocity.y = 0.75f, lift.body.linear_velocity.y = 0.25f;
    play_add(p, &lift);
    for (int32_t i = 0; i < BODIES; ++i) {
        part a = any_part(p, i);
        play_add(p, &a);
    }
}

static void place(play *p)
{
    const fe_dvec3 way = {1.0, -9.0, 0.5};
    part a = any_part(p, 6 * (p->step / 10) + 1);
    fe_transform *at = &a.body.transform;
    fe_hit hit;
    at->position.y = 9.0;
    if (fe_world_sweep(p->world, &a.geometry, at, &way, NULL, &hit) != 1) return;
    at->position.x += hit.fraction * way.x, at->position.y += hit.fraction * way.y,
        at->position.z += hit.fraction * way.z;
    play_add(p, &a);
}

static void act(play *p)
{
    if (p->step % 10 == 5) place(p);
    if (p->step % 20 == 10) { // another size of what lies there
        fe_geometry g;
        scale_hull(p, p->step / 20 + 2, &g);
        if (p->step < 150) PLAY(p, fe_shape_set_geometry(p->world, p->shapes[FIRST + p->step / 2], &g));
    }
    if (p->step == 60) PLAY(p, fe_asset_destroy(world_store(p->world), p->assets[0]));
    if (p->step == 61) make_hull(p, 0); // in its place, with new handle; its scales live on
    if (p->step == 90) {
        const fe_material others[2] = {surfaces[1], surfaces[0]};
        PLAY(p, fe_mesh_set_materials(world_store(p->world), p->assets[MESH], others, sizeof *others, 2));
    }
    if (p->step == 120) {
        fe_geometry g;
        fe_geometry_mesh(&g, p->assets[MESH]);
        fe_geometry_set_scale(&g, 1.0f, 0.5f, 1.0f);
        PLAY(p, fe_shape_set_geometry(p->world, p->shapes[0], &g)); // a tile sinks under what lies on it
    }
    if (p->step == 150) play_remove(p, LIFT);
}

const script script_scales = {"scales", 200, build, act};
