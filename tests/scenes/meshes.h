// meshes.h - meshes for scenes: grids whose inner samples are shifted, and whose diagonals run either way.
#ifndef MESHES_H
#define MESHES_H

#include "scenes/terrain.h"

typedef struct soup {
    float *vertices; // x y z
    uint32_t *indices;
    int vertex_count, triangle_count;
} soup;

static inline void soup_free(soup *m) { free(m->vertices), free(m->indices); }

// a fixed number in -1..1 for each i
static inline double noise(uint32_t i)
{
    i = (i ^ 61u ^ (i >> 16)) * 9u;
    i = (i ^ (i >> 4)) * 0x27d4eb2du;
    return (double)((i ^ (i >> 15)) & 0xffffu) / 32767.5 - 1.0;
}

// `cells` x `cells`, each `cell` m wide, from (x, z) on; inner samples shifted by up to `jitter` cells
static inline soup make_soup(int cells, double cell, double x, double z, double jitter, height_at *at)
{
    int n = cells + 1;
    soup m = {malloc(sizeof(float) * (size_t)(3 * n * n)), malloc(sizeof(uint32_t) * (size_t)(6 * cells * cells)),
              n * n, 2 * cells * cells};
    for (int r = 0; r < n; ++r) {
        for (int c = 0; c < n; ++c) {
            int i = r * n + c, inner = r > 0 && r < cells && c > 0 && c < cells;
            double px = x + cell * (c + inner * jitter * noise((uint32_t)(2 * i))),
                   pz = z + cell * (r + inner * jitter * noise((uint32_t)(2 * i + 1)));
            m.vertices[3 * i] = (float)px, m.vertices[3 * i + 1] = (float)at(px, pz), m.vertices[3 * i + 2] = (float)pz;
        }
    }
    for (int r = 0; r < cells; ++r) {
        for (int c = 0; c < cells; ++c) {
            uint32_t a = (uint32_t)(r * n + c), b = a + 1, d = a + (uint32_t)n, e = d + 1;
            uint32_t *t = m.indices + 6 * (r * cells + c);
            if ((r + c) % 2)
                t[0] = a, t[1] = d, t[2] = e, t[3] = a, t[4] = e, t[5] = b;
            else
                t[0] = a, t[1] = d, t[2] = b, t[3] = b, t[4] = d, t[5] = e;
        }
    }
    return m;
}

static inline fe_asset make_mesh(scene *s, const soup *m, uint32_t flags)
{
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.flags = flags;
    def.vertices = m->vertices, def.vertex_count = m->vertex_count;
    def.indices = m->indices, def.triangle_count = m->triangle_count;
    fe_asset asset = 0;
    MUST(fe_mesh_create(world_store(s->world), &def, &asset));
    return asset;
}

static inline fe_body place_mesh(scene *s, int32_t type, fe_asset asset, vec at, fe_quat rotation, fe_material material)
{
    fe_geometry form;
    fe_geometry_mesh(&form, asset);
    return add_body(s, type, form, at, rotation, material, WATER);
}

static inline fe_body add_mesh(scene *s, int cells, double cell, double x, double z, double jitter, height_at *at,
                               fe_material material)
{
    soup m = make_soup(cells, cell, x, z, jitter, at);
    fe_body body = place_mesh(s, FE_BODY_STATIC, make_mesh(s, &m, 0), v3(0, 0, 0), UNTURNED, material);
    soup_free(&m);
    return body;
}

#endif
