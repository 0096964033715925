// terrain.h - heightfields for scenes.
#ifndef TERRAIN_H
#define TERRAIN_H

#include "scenes/scene.h"

#include <stdlib.h>

typedef double height_at(double x, double z);

static inline double level(double x, double z)
{
    (void)x, (void)z;
    return 0.0;
}

// A heightfield of `cells` x `cells`, each `cell` m wide, whose first sample stands at (x, z) and whose heights are
// those of `at` in the scene
static inline fe_asset make_field(scene *s, int cells, double cell, double x, double z, height_at *at)
{
    int n = cells + 1;
    float *heights = malloc(sizeof *heights * (size_t)(n * n));
    for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) heights[r * n + c] = (float)at(x + c * cell, z + r * cell);
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = n, def.cell_x = def.cell_z = (float)cell, def.heights = heights;
    fe_asset asset = 0;
    MUST(fe_heightfield_create(world_store(s->world), &def, &asset));
    free(heights);
    return asset;
}

static inline fe_body place_field(scene *s, fe_asset asset, vec corner, fe_quat rotation, fe_material material)
{
    fe_geometry form;
    fe_geometry_heightfield(&form, asset);
    return add_static(s, form, corner, rotation, material);
}

static inline fe_body add_field(scene *s, int cells, double cell, double x, double z, height_at *at,
                                fe_material material)
{
    return place_field(s, make_field(s, cells, cell, x, z, at), v3(x, 0, z), UNTURNED, material);
}

#endif
