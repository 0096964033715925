// play_terrain.c - the script of heightfields: two waves side by side, with holes and cells of other materials, under a
// rain of spheres, capsules and boxes; heights that change under sleeping bodies, a trigger that feels the ground, an
// asset whose handle dies.
#include "support/play.h"

enum { CELLS = 16, SAMPLES = CELLS + 1, FIELDS = 2, BODIES = 140, EDIT = 4 };

static fe_asset make_field(play *p, int32_t which)
{
    fe_asset field = 0;
    float heights[SAMPLES * SAMPLES];
    uint8_t holes[CELLS * CELLS] = {0}, kinds[CELLS * CELLS];
    const fe_material materials[3] = {SURFACE(0.6f, 0.5f, 0.0f, 0.1f, 0.02f), SURFACE(0.1f, 0.1f, 0.0f, 0.1f, 0.02f),
                                      SURFACE(0.6f, 0.5f, 0.6f, 0.1f, 0.02f)};
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) heights[i] = play_wave(i % SAMPLES + which * CELLS, i / SAMPLES);
    for (int32_t i = 0; i < CELLS * CELLS; ++i) kinds[i] = (uint8_t)(i % 11 == 0 ? 1 : i % 13 == 0 ? 2 : 0);
    holes[5 * CELLS + 5] = holes[5 * CELLS + 6] = (uint8_t)which;
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = SAMPLES, def.heights = heights, def.holes = holes;
    if (which) def.cell_materials = kinds, def.materials = materials, def.material_count = 3;
    PLAY(p, fe_heightfield_create(world_store(p->world), &def, &field));
    return field;
}

static fe_asset field_of(play *p, int32_t actor)
{
    fe_geometry g = {.struct_size = sizeof g};
    PLAY(p, fe_shape_get_geometry(p->world, p->shapes[actor], &g));
    return g.asset;
}

static part any_part(play *p, int32_t i)
{
    double x = (double)play_between(p, -12.0f, 12.0f), z = (double)play_between(p, 2.0f, 14.0f), y = 2.5 + 0.03 * i;
    float size = play_between(p, 0.15f, 0.4f);
    part a = i % 3 == 0   ? part_sphere(size, x, y, z)
             : i % 3 == 1 ? part_capsule(size, 0.6f * size, x, y, z)
                          : part_box(size, 0.5f * size, 0.8f * size, x, y, z);
    play_tumble(p, i, -20.0f, &a);
    return a;
}

static void build(play *p)
{
    for (int32_t i = 0; i < FIELDS; ++i) {
        part ground = part_static_box(1.0f, 1.0f, 1.0f, (i - 1) * (double)CELLS, 0.0, 0.0);
        fe_geometry_heightfield(&ground.geometry, make_field(p, i));
        play_add(p, &ground);
    }
    for (int32_t i = 0; i < BODIES; ++i) {
        part a = any_part(p, i);
        play_add(p, &a);
    }
}

static void act(play *p)
{
    if (p->step == 100) PLAY(p, fe_asset_destroy(world_store(p->world), field_of(p, 0)));
    if (p->step == 120 || p->step == 260) {
        float heights[EDIT * EDIT];
        for (int32_t i = 0; i < EDIT * EDIT; ++i) heights[i] = p->step == 120 ? 1.5f : 0.25f;
        PLAY(p, fe_heightfield_set_heights(world_store(p->world), field_of(p, 1), 3, 8, EDIT, EDIT, heights));
    }
    if (p->step == 200) play_remove(p, FIELDS + 7);
    if (p->step == 230) {
        fe_geometry ball;
        fe_geometry_sphere(&ball, 0.5f);
        PLAY(p, fe_shape_set_geometry(p->world, p->shapes[0], &ball)); // the first field is gone, with its asset
    }
}

const script script_terrain = {"terrain", 300, build, act};
