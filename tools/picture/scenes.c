// scenes.c - see scenes.h. No angles: a quaternion of any length turns by twice the arc tangent of |x y z| / w.
#include "scenes.h"

#include "../../examples/machines.h"

#include <stdio.h>
#include <stdlib.h>

int32_t picture_must(int32_t result)
{
    if (result >= 0) return result;
    fprintf(stderr, "feather-picture: %s\n", fe_last_error());
    exit(1);
}

#define MUST picture_must

fe_world *picture_play(const picture_scene *scene, const fe_world_def *def, int32_t steps)
{
    fe_world *world;
    MUST(fe_world_create(def, &world));
    scene->build(world);
    for (int32_t i = 0; i < steps; ++i) MUST(fe_world_step(world, 1.0f / 60));
    return world;
}

// Fowler, Noll and Vo's, 1a
uint64_t picture_hash(const picture_scene *scene)
{
    enum { WIDTH = 160, HEIGHT = 100 };
    fe_world *world = picture_play(scene, NULL, 0);
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    size_t size = 0;
    uint8_t *png = picture_take(world, &scene->view, WIDTH, HEIGHT, &size);
    for (size_t i = 0; png && i < size; ++i) hash = (hash ^ png[i]) * UINT64_C(0x100000001b3);
    free(png);
    MUST(fe_world_destroy(world));
    return hash;
}

// In -1..1, from integers alone. Once in an expression: compilers differ in which argument comes first
static float draw(uint32_t *seed)
{
    *seed = *seed * UINT32_C(1664525) + UINT32_C(1013904223);
    return (float)(*seed >> 8) / 8388608.0f - 1.0f;
}

static fe_body put(fe_world *world, int32_t type, fe_transform at, const fe_geometry *form, float density)
{
    fe_body body;
    MUST(machine_body(world, type, at, form, density, &body));
    return body;
}

static fe_body put_box(fe_world *world, int32_t type, double x, double y, double z, float hx, float hy, float hz)
{
    fe_geometry form;
    fe_geometry_box(&form, hx, hy, hz);
    return put(world, type, fe_make_transform(x, y, z), &form, 500);
}

static void put_ground(fe_world *world)
{
    fe_geometry form;
    fe_geometry_plane(&form, 0, 1, 0, 0);
    put(world, FE_BODY_STATIC, fe_make_transform(0, 0, 0), &form, 0);
}

// The hue of an island is that of its oldest body, by its number: `count` numbers are used up
static void skip_hues(fe_world *world, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        fe_body body;
        MUST(fe_body_create(world, NULL, &body));
        MUST(fe_body_destroy(world, body));
    }
}

static fe_transform turned(double x, double y, double z, uint32_t *seed)
{
    fe_transform at = fe_make_transform(x, y, z);
    at.rotation.x = draw(seed), at.rotation.y = draw(seed), at.rotation.z = draw(seed), at.rotation.w = draw(seed) + 2;
    return at;
}

// Place number i of layers of `side` x `side` places, so that nothing is born inside another
static fe_transform in_layers(int32_t i, int32_t side, double pitch, double bottom, uint32_t *seed)
{
    double middle = 0.5 * (side - 1), y = bottom + pitch * (i / (side * side));
    return turned(pitch * (i % side - middle), y, pitch * (i / side % side - middle), seed);
}

// ---- every form ----------------------------------------------------------------------------------------------------
static fe_asset make_rock(fe_world *world, uint32_t *seed, int32_t points, float size)
{
    float at[64][3];
    for (int32_t i = 0; i < points;) {
        float x = draw(seed), y = draw(seed), z = draw(seed), l = x * x + y * y + z * z;
        if (l > 1 || l < 0.3f) continue;
        l = sqrtf(l); // onto a sphere, then out of round
        at[i][0] = 1.2f * size * x / l, at[i][1] = 0.85f * size * y / l, at[i][2] = size * z / l, ++i;
    }
    fe_hull_def def;
    fe_store *store;
    fe_asset rock;
    fe_hull_def_init(&def, sizeof def);
    def.points = at[0], def.point_count = points;
    MUST(fe_world_get_store(world, &store));
    MUST(fe_hull_create(store, &def, &rock));
    return rock;
}

static void make_form(int32_t kind, float s, fe_asset rock, fe_geometry *out)
{
    switch (kind) {
    case 0:
        fe_geometry_box(out, s, 0.8f * s, 0.9f * s);
        break;
    case 1:
        fe_geometry_sphere(out, s);
        break;
    case 2:
        fe_geometry_capsule(out, 0.8f * s, 0.6f * s);
        break;
    case 3:
        fe_geometry_cylinder(out, 0.8f * s, 0.8f * s);
        break;
    case 4:
        fe_geometry_cone(out, s, s);
        break;
    default:
        fe_geometry_hull(out, rock);
        break;
    }
}

// All are poured into a tray
static void build_forms(fe_world *world)
{
    enum { FORMS = 6, POURED = 320 };
    uint32_t seed = 7;
    put_ground(world);
    for (int32_t i = 0; i < 4; ++i) {
        double x = i == 0 ? 4.2 : i == 1 ? -4.2 : 0, z = i == 2 ? 4.2 : i == 3 ? -4.2 : 0;
        put_box(world, FE_BODY_STATIC, x, 0.6, z, i < 2 ? 0.2f : 4.0f, 0.6f, i < 2 ? 4.4f : 0.2f);
    }
    skip_hues(world, 1);
    fe_asset rock = make_rock(world, &seed, 16, 0.42f);
    for (int32_t i = 0; i < POURED; ++i) {
        fe_geometry form;
        make_form(i % FORMS, 0.36f + 0.08f * draw(&seed), rock, &form);
        put(world, FE_BODY_DYNAMIC, in_layers(i, 4, 1.3, 1.0, &seed), &form, 500);
    }
}

// ---- rocks in a valley ---------------------------------------------------------------------------------------------
#define CELL 2.0f // m
enum { CELLS = 28, SAMPLES_ACROSS = CELLS + 1, KINDS = 10, ROCKS = 150 };

// A valley along z, closed at both ends
static float height(float x, float z, uint32_t *seed)
{
    float side = x < 0 ? -x : x, far = z < 0 ? -z : z;
    float slope = side < 6 ? 0 : 0.42f * (side - 6), end = far < 10 ? 0 : 0.25f * (far - 10);
    return 0.02f * x * x * (side < 6) + 0.72f * (side >= 6) + slope + end + 0.4f * draw(seed);
}

static void build_valley(fe_world *world, uint32_t *seed)
{
    static float vertices[SAMPLES_ACROSS * SAMPLES_ACROSS][3];
    static uint16_t indices[2 * CELLS * CELLS][3];
    for (int32_t i = 0; i < SAMPLES_ACROSS * SAMPLES_ACROSS; ++i) {
        vertices[i][0] = CELL * (float)(i % SAMPLES_ACROSS - CELLS / 2);
        vertices[i][2] = CELL * (float)(i / SAMPLES_ACROSS - CELLS / 2);
        vertices[i][1] = height(vertices[i][0], vertices[i][2], seed);
    }
    for (int32_t i = 0; i < CELLS * CELLS; ++i) {
        uint16_t a = (uint16_t)(i / CELLS * SAMPLES_ACROSS + i % CELLS), c = (uint16_t)(a + SAMPLES_ACROSS);
        uint16_t *t = indices[2 * i];
        t[0] = a, t[1] = c, t[2] = (uint16_t)(c + 1), t[3] = a, t[4] = (uint16_t)(c + 1), t[5] = (uint16_t)(a + 1);
    }
    fe_mesh_def def;
    fe_store *store;
    fe_asset valley;
    fe_geometry form;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = vertices[0], def.vertex_count = SAMPLES_ACROSS * SAMPLES_ACROSS;
    def.indices = indices, def.triangle_count = 2 * CELLS * CELLS, def.index_type = FE_INDEX_U16;
    MUST(fe_world_get_store(world, &store));
    MUST(fe_mesh_create(store, &def, &valley));
    fe_geometry_mesh(&form, valley);
    put(world, FE_BODY_STATIC, fe_make_transform(0, 0, 0), &form, 0);
}

static void build_rocks(fe_world *world)
{
    uint32_t seed = 3;
    fe_asset kinds[KINDS];
    build_valley(world, &seed);
    skip_hues(world, 4);
    for (int32_t i = 0; i < KINDS; ++i) kinds[i] = make_rock(world, &seed, 9 + 3 * i, 0.5f);
    for (int32_t i = 0; i < ROCKS; ++i) {
        fe_geometry form;
        float size = 1.3f + 0.7f * draw(&seed);
        fe_geometry_hull(&form, kinds[i % KINDS]);
        fe_geometry_set_scale(&form, size, size, size);
        put(world, FE_BODY_DYNAMIC, in_layers(i, 5, 2.6, 4.0, &seed), &form, 2500);
    }
}

// ---- a ball into a pyramid -----------------------------------------------------------------------------------------
static void build_pyramid(fe_world *world)
{
    enum { BASE = 14 };
    put_ground(world);
    skip_hues(world, 2);
    for (int32_t layer = 0; layer < BASE; ++layer)
        for (int32_t i = 0; i < (BASE - layer) * (BASE - layer); ++i) {
            double x = i % (BASE - layer) - 0.5 * (BASE - layer - 1), z = i / (BASE - layer) - 0.5 * (BASE - layer - 1);
            put_box(world, FE_BODY_DYNAMIC, 0.64 * x, 0.25 + 0.5 * layer, 0.64 * z, 0.3f, 0.25f, 0.3f);
        }
    fe_geometry ball;
    fe_geometry_sphere(&ball, 0.9f);
    fe_body shot = put(world, FE_BODY_DYNAMIC, fe_make_transform(-14, 5.2, 2.0), &ball, 2000);
    fe_vec3 velocity = {30, 1, -4};
    MUST(fe_body_set_linear_velocity(world, shot, &velocity));
}

// ---- a rope bridge -------------------------------------------------------------------------------------------------
static void build_bridge(fe_world *world)
{
    bridge b;
    ragdoll people[4];
    put_ground(world);
    skip_hues(world, 1);
    MUST(bridge_build(world, -6, 3, 0, &b));
    for (int32_t i = 0; i < 2; ++i) put_box(world, FE_BODY_STATIC, i ? 7.0 : -7.0, 1.4, 0, 0.7f, 1.4f, 1.2f);
    for (int32_t i = 0; i < 4; ++i)
        MUST(ragdoll_build(world, fe_make_transform(-3.6 + 2.4 * i, 3.04, 0.1 * i), 12, people + i));
}

// ---- furniture -----------------------------------------------------------------------------------------------------
static void add_part(fe_compound_part *parts, int32_t *count, float x, float y, float z, const fe_geometry *form)
{
    fe_compound_part *part = parts + (*count)++;
    fe_compound_part_init(part, sizeof *part);
    part->frame.position = fe_make_vec3(x, y, z);
    part->geometry = *form;
}

static void add_slab(fe_compound_part *parts, int32_t *count, float x, float y, float z, float hx, float hy, float hz)
{
    fe_geometry form;
    fe_geometry_box(&form, hx, hy, hz);
    add_part(parts, count, x, y, z, &form);
}

static fe_asset join(fe_world *world, const fe_compound_part *parts, int32_t count)
{
    fe_store *store;
    fe_asset out;
    MUST(fe_world_get_store(world, &store));
    MUST(fe_compound_create(store, parts, sizeof *parts, count, &out));
    return out;
}

static void add_legs(fe_compound_part *parts, int32_t *count, float hx, float hz, float half_height, float radius)
{
    fe_geometry leg;
    fe_geometry_cylinder(&leg, half_height, radius);
    for (int32_t i = 0; i < 4; ++i) add_part(parts, count, i & 1 ? hx : -hx, half_height, i & 2 ? hz : -hz, &leg);
}

static fe_asset make_table(fe_world *world)
{
    fe_compound_part parts[8];
    int32_t count = 0;
    fe_geometry top;
    fe_geometry_cylinder(&top, 0.03f, 0.75f);
    add_part(parts, &count, 0, 0.75f, 0, &top);
    add_legs(parts, &count, 0.42f, 0.42f, 0.36f, 0.04f);
    return join(world, parts, count);
}

static fe_asset make_chair(fe_world *world)
{
    fe_compound_part parts[10];
    int32_t count = 0;
    add_legs(parts, &count, 0.19f, 0.19f, 0.22f, 0.025f);
    add_slab(parts, &count, 0, 0.46f, 0, 0.23f, 0.02f, 0.23f);
    for (int32_t i = 0; i < 2; ++i) add_slab(parts, &count, i ? 0.19f : -0.19f, 0.70f, -0.2f, 0.025f, 0.22f, 0.025f);
    add_slab(parts, &count, 0, 0.84f, -0.2f, 0.165f, 0.07f, 0.018f);
    return join(world, parts, count);
}

static fe_asset make_shelf(fe_world *world)
{
    fe_compound_part parts[12];
    int32_t count = 0;
    for (int32_t i = 0; i < 2; ++i) add_slab(parts, &count, i ? 0.68f : -0.68f, 0.9f, 0, 0.02f, 0.9f, 0.2f);
    for (int32_t i = 0; i < 4; ++i) add_slab(parts, &count, 0, 0.06f + 0.55f * (float)i, 0, 0.66f, 0.02f, 0.2f);
    return join(world, parts, count);
}

static void put_compound(fe_world *world, fe_asset asset, double x, double y, double z, float turn)
{
    fe_geometry form;
    fe_transform at = fe_make_transform(x, y, z);
    at.rotation.y = turn;
    fe_geometry_compound(&form, asset);
    put(world, FE_BODY_DYNAMIC, at, &form, 600);
}

// A cup is a cylinder, a lamp's shade a cone, a book a box
static void put_small(fe_world *world, int32_t kind, double x, double y, double z)
{
    fe_geometry form;
    double half = kind == 0 ? 0.06 : kind == 1 ? 0.11 : 0.13;
    if (kind == 0)
        fe_geometry_cylinder(&form, 0.06f, 0.05f);
    else if (kind == 1)
        fe_geometry_cone(&form, 0.11f, 0.09f);
    else
        fe_geometry_box(&form, 0.03f, 0.13f, 0.09f);
    put(world, FE_BODY_DYNAMIC, fe_make_transform(x, y + half + 0.002, z), &form, 400);
}

static void build_furniture(fe_world *world)
{
    put_ground(world);
    fe_asset table = make_table(world), chair = make_chair(world), shelf = make_shelf(world);
    put_compound(world, shelf, -1.9, 0, -1.2, 0);
    for (int32_t i = 0; i < 24; ++i)
        put_small(world,
                  i % 8 < 5    ? 2
                  : i % 8 == 5 ? 1
                               : 0,
                  -2.4 + 0.065 * (i % 8) + (i % 8 > 4 ? 0.11 * (i % 8 - 4) : 0), 0.08 + 0.55 * (i / 8), -1.2);
    skip_hues(world, 3);
    put_compound(world, table, 0.3, 0, 0, 0.2f);
    const float turns[4] = {0.1f, 1.1f, -30, -0.9f};
    for (int32_t i = 0; i < 4; ++i)
        put_compound(world, chair,
                     0.3 + (i == 1   ? -1.0
                            : i == 3 ? 1.0
                                     : 0),
                     0,
                     i == 0   ? -1
                     : i == 2 ? 1.0
                              : 0,
                     turns[i]);
    for (int32_t i = 0; i < 5; ++i) put_small(world, i % 2, 0.05 + 0.16 * i, 0.78, i % 2 ? 0.15 : -0.2);
}

// ---- the table of them ---------------------------------------------------------------------------------------------
#define ALL_SHAPES (FE_DRAW_SHAPES | FE_DRAW_ISLANDS | FE_DRAW_SLEEP)

const picture_scene picture_scenes[] = {
    {"pyramid",
     "A ball flies into a pyramid",
     "1015 boxes, each on four, and a ball of six tonnes at 30 m/s. What still touches is one island and has one hue; "
     "what flies has hues of its own.",
     800,
     400,
     36,
     {{-10, 7, 16}, {0.4, 2.75, 0}, 0.82, 13, {0.5f, 1.1f, 0.65f}, ALL_SHAPES, 0.5f},
     build_pyramid},
    {"forms",
     "Every convex form",
     "320 boxes, spheres, capsules, cylinders, cones and hulls fall into a tray. Cylinders and cones are exact in the "
     "solver; only their pictures have facets.",
     800,
     500,
     100,
     {{-6, 8.5, 14.5}, {0, 2.2, 0}, 0.98, 10, {0.45f, 1, 0.55f}, ALL_SHAPES, 0.5f},
     build_forms},
    {"rocks",
     "Rocks in a valley",
     "150 hulls of ten kinds, each with a scale of its own, on a valley of 1568 triangles. Slate are those that sleep "
     "already.",
     800,
     450,
     300,
     {{9, 9, 20}, {0, 0.6, -1}, 1.0, 22, {-0.7f, 1, 0.35f}, ALL_SHAPES, 0.5f},
     build_rocks},
    {"bridge",
     "A rope bridge",
     "24 planks on ropes, and four people of 14 bones. The limits of their joints are drawn: green in the middle of a "
     "range, orange near its end, red at it.",
     800,
     400,
     40,
     {{3.5, 4.6, 9.5}, {-0.3, 2.35, 0}, 0.8, 13, {-0.6f, 1.1f, 0.55f}, ALL_SHAPES | FE_DRAW_LIMITS, 0.22f},
     build_bridge},
    {"furniture",
     "Furniture",
     "Table, chairs and shelves are compounds of boxes and cylinders: one shape each, of up to eight parts. The small "
     "things are boxes, cylinders and cones.",
     800,
     500,
     60,
     {{2.3, 2.35, 4.9}, {-0.2, 0.68, -0.3}, 1.2, 4.5, {-0.5f, 1.2f, 0.7f}, FE_DRAW_SHAPES | FE_DRAW_ISLANDS, 0.2f},
     build_furniture},
};
const int32_t picture_scene_count = sizeof picture_scenes / sizeof *picture_scenes;
