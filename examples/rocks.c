// rocks.c - rocks, which are convex hulls, roll down a valley, which is a mesh of triangles.
//
//     cc rocks.c -lfeather -lm -o rocks && ./rocks
//
// Shows hulls from points and a mesh from arrays, both assets of the world's store that any number of shapes share, and
// a ray that tells the triangle it meets. The last line is the same on every machine.
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>

#define DT (1.0f / 60)
enum { CELLS = 16, SAMPLES = CELLS + 1, VERTICES = SAMPLES * SAMPLES, TRIANGLES = 2 * CELLS * CELLS };
enum { KINDS = 3, ROCKS = 24, POINTS = 24, STEPS = 360 };

static int32_t must(int32_t result)
{
    if (result >= 0) return result;
    printf("%s\n", fe_last_error());
    exit(1);
}

// Any number in -1..1: integers alone, so that every machine has the same rocks
static float draw(void)
{
    static uint32_t seed = 1;
    seed = seed * UINT32_C(1664525) + UINT32_C(1013904223);
    return (float)(seed >> 8) / 8388608.0f - 1.0f;
}

// m: a bowl with bumps
static float height(int32_t row, int32_t column)
{
    int32_t x = column - CELLS / 2, z = row - CELLS / 2;
    return 0.0625f * (float)(x * x + z * z) + 0.125f * (float)((row * 7 + column * 5) % 4);
}

static fe_asset make_valley(fe_store *store)
{
    static float vertices[VERTICES][3];
    static uint16_t triangles[TRIANGLES][3];
    for (int32_t i = 0; i < VERTICES; ++i) {
        vertices[i][0] = (float)(i % SAMPLES - CELLS / 2);
        vertices[i][1] = height(i / SAMPLES, i % SAMPLES);
        vertices[i][2] = (float)(i / SAMPLES - CELLS / 2);
    }
    // counterclockwise seen from above: only that side counts
    for (int32_t i = 0; i < CELLS * CELLS; ++i) {
        uint16_t a = (uint16_t)(i / CELLS * SAMPLES + i % CELLS), b = (uint16_t)(a + 1), c = (uint16_t)(a + SAMPLES);
        uint16_t d = (uint16_t)(c + 1);
        uint16_t *t = triangles[2 * i];
        t[0] = a, t[1] = c, t[2] = d, t[3] = a, t[4] = d, t[5] = b;
    }
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = vertices[0], def.vertex_count = VERTICES;
    def.indices = triangles, def.triangle_count = TRIANGLES, def.index_type = FE_INDEX_U16;
    fe_asset valley;
    must(fe_mesh_create(store, &def, &valley));
    return valley;
}

static fe_asset make_rock(fe_store *store)
{
    float points[POINTS][3];
    for (int32_t i = 0; i < POINTS; ++i) {
        points[i][0] = 0.6f * draw();
        points[i][1] = 0.4f * draw();
        points[i][2] = 0.5f * draw();
    }
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = POINTS;
    fe_asset rock;
    must(fe_hull_create(store, &def, &rock));
    fe_hull_info info;
    fe_hull_info_init(&info, sizeof info);
    must(fe_hull_get_info(store, rock, &info));
    printf("a rock of %d vertices and %d faces, %.3f m3\n", info.vertex_count, info.face_count, (double)info.volume);
    return rock;
}

static void add_body(fe_world *world, int32_t type, fe_transform at, const fe_geometry *form)
{
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform = at;
    fe_body body;
    fe_shape shape;
    must(fe_body_create(world, &def, &body));
    must(fe_shape_create(world, body, NULL, form, &shape));
}

int main(void)
{
    fe_world *world;
    fe_store *store;
    must(fe_world_create(NULL, &world));
    must(fe_world_get_store(world, &store));
    fe_geometry form;
    fe_geometry_mesh(&form, make_valley(store));
    add_body(world, FE_BODY_STATIC, fe_make_transform(0, 0, 0), &form);
    fe_asset kinds[KINDS];
    for (int32_t i = 0; i < KINDS; ++i) kinds[i] = make_rock(store);
    for (int32_t i = 0; i < ROCKS; ++i) {
        fe_geometry_hull(&form, kinds[i % KINDS]);
        add_body(world, FE_BODY_DYNAMIC, fe_make_transform(5.0 - 2.0 * (i % 6), 8.0 + 0.5 * i, 4.0 - 2.5 * (i / 6)),
                 &form);
    }
    for (int32_t i = 0; i < STEPS; ++i) must(fe_world_step(world, DT));

    fe_dvec3 from = {7.25, 20, 0.5}, way = {0, -30, 0};
    fe_hit hit;
    if (must(fe_world_raycast(world, &from, &way, NULL, &hit)) == 1)
        printf("triangle %d of the valley at %.3f m\n", hit.triangle, hit.point.y);
    fe_counters counters;
    fe_counters_init(&counters, sizeof counters);
    must(fe_world_get_counters(world, &counters));
    uint32_t hash[2];
    must(fe_world_hash(world, hash));
    printf("%d of %d rocks are awake, hash %08x%08x\n", counters.awake_bodies, ROCKS, hash[1], hash[0]);
    must(fe_world_destroy(world));
    return 0;
}
