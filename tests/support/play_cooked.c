// play_cooked.c - the script of loaded assets: a hull, a mesh and a heightfield are saved, and all shapes have what was
// loaded from the bytes. The bytes are told, so that they are the same on every machine.
#include "support/play.h"

#include <stdlib.h>

enum { CELLS = 12, SAMPLES = CELLS + 1, MOST_BYTES = 1 << 15, BODIES = 40, HULL = 0, MESH, FIELD };

static const fe_material surfaces[2] = {SURFACE(0.6f, 0.5f, 0.0f, 0.1f, 0.02f), SURFACE(0.1f, 0.1f, 0.3f, 0.1f, 0.02f)};

// ---- assets --------------------------------------------------------------------------------------------------------
static fe_asset make_hull(play *p)
{
    float points[40][3];
    for (int32_t i = 0; i < 40; ++i)
        for (int32_t k = 0; k < 3; ++k) points[i][k] = play_between(p, -0.35f, 0.35f);
    fe_hull_def def;
    fe_asset made = 0;
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = 40;
    PLAY(p, fe_hull_create(world_store(p->world), &def, &made));
    return made;
}

static fe_asset make_mesh(play *p)
{
    float vertices[SAMPLES * SAMPLES][3];
    uint16_t triangles[2 * CELLS * CELLS][3];
    uint8_t kinds[2 * CELLS * CELLS];
    uint32_t data[2 * CELLS * CELLS];
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i)
        vertices[i][0] = (float)(i % SAMPLES), vertices[i][2] = (float)(i / SAMPLES),
        vertices[i][1] = play_wave(i % SAMPLES, i / SAMPLES);
    for (int32_t i = 0; i < 2 * CELLS * CELLS; ++i) {
        int32_t v = i / 2 / CELLS * SAMPLES + i / 2 % CELLS;
        const int32_t halves[2][3] = {{v, v + SAMPLES, v + 1}, {v + 1, v + SAMPLES, v + SAMPLES + 1}};
        for (int32_t k = 0; k < 3; ++k) triangles[i][k] = (uint16_t)halves[i % 2][k];
        kinds[i] = (uint8_t)(i % 7 == 0), data[i] = (uint32_t)(i * 40503);
    }
    fe_mesh_def def;
    fe_asset made = 0;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = vertices[0], def.vertex_count = SAMPLES * SAMPLES;
    def.indices = triangles, def.triangle_count = 2 * CELLS * CELLS, def.index_type = FE_INDEX_U16;
    def.triangle_materials = kinds, def.materials = surfaces, def.material_count = 2, def.triangle_data = data;
    PLAY(p, fe_mesh_create(world_store(p->world), &def, &made));
    return made;
}

static fe_asset make_field(play *p)
{
    float heights[SAMPLES * SAMPLES];
    uint8_t holes[CELLS * CELLS] = {0};
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) heights[i] = play_wave(i % SAMPLES + CELLS, i / SAMPLES);
    holes[CELLS + 1] = 1;
    fe_heightfield_def def;
    fe_asset made = 0;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = SAMPLES, def.heights = heights, def.holes = holes;
    PLAY(p, fe_heightfield_create(world_store(p->world), &def, &made));
    return made;
}

// What was made is gone; `kind` is what its bytes make
static void cook(play *p, int32_t kind, fe_asset made)
{
    static unsigned char bytes[MOST_BYTES];
    fe_store *store = world_store(p->world);
    int64_t size = fe_asset_save(store, made, bytes, MOST_BYTES);
    if (size <= 0 || size > MOST_BYTES) {
        fprintf(stderr, "%s\n", fe_last_error());
        abort();
    }
    for (int64_t i = 0; i < size; ++i) fe__hash_u32(&p->told, bytes[i]);
    PLAY(p, fe_asset_destroy(store, made));
    PLAY(p, fe_asset_load(store, bytes, size, p->assets + kind));
}

// ---- the scene -----------------------------------------------------------------------------------------------------
static void build(play *p)
{
    cook(p, HULL, make_hull(p));
    cook(p, MESH, make_mesh(p));
    cook(p, FIELD, make_field(p));
    part ground = part_static_box(1.0f, 1.0f, 1.0f, 0.0, 0.0, 0.0);
    fe_geometry_mesh(&ground.geometry, p->assets[MESH]);
    play_add(p, &ground);
    ground.body.transform.position.x = CELLS;
    fe_geometry_heightfield(&ground.geometry, p->assets[FIELD]);
    play_add(p, &ground);
    for (int32_t i = 0; i < BODIES; ++i) {
        double x = (double)play_between(p, 2.0f, 2 * CELLS - 2.0f), z = (double)play_between(p, 2.0f, CELLS - 2.0f);
        part a = part_sphere(0.3f, x, 3.0 + 0.1 * i, z);
        if (i % 4) fe_geometry_hull(&a.geometry, p->assets[HULL]);
        play_add(p, &a);
    }
}

static void act(play *p) { (void)p; }

const script script_cooked = {"cooked", 100, build, act};
