// cooked.c - see cooked.h.
#include "support/cooked.h"

#include "store/asset_bytes.h"
#include "support/values.h"

#include <math.h>
#include <string.h>

// ---- seeds ---------------------------------------------------------------------------------------------------------
static const float corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
static const uint32_t sides[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
static const fe_material surfaces[2] = {SURFACE(0.6f, 0.5f, 0.3f, 0.1f, 0.02f), SURFACE(0.1f, 0.1f, 0.0f, 0.0f, 0.0f)};

static fe_asset make_hull(fe_store *store, const float (*points)[3], int32_t count)
{
    fe_hull_def d;
    fe_hull_def_init(&d, sizeof d);
    d.points = points[0], d.point_count = count;
    fe_asset made;
    value_must(fe_hull_create(store, &d, &made));
    return made;
}

// A rock, far from its origin
static fe_asset make_rock(fe_store *store)
{
    float points[14][3];
    for (int32_t i = 0; i < 14; ++i)
        for (int32_t k = 0; k < 3; ++k)
            points[i][k] = 40.0f + (i < 8 ? 0.5f * corners[i][k] : (i - 8) / 2 == k ? (i % 2 ? 0.9f : -0.8f) : 0.1f);
    return make_hull(store, (const float(*)[3])points, 14);
}

static fe_asset make_cube(fe_store *store)
{
    static const uint8_t kinds[12] = {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1};
    static const uint32_t data[12] = {10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 0xffffffffu};
    fe_mesh_def d;
    fe_mesh_def_init(&d, sizeof d);
    d.vertices = corners[0], d.vertex_count = 8, d.indices = sides, d.triangle_count = 12;
    d.triangle_materials = kinds, d.materials = surfaces, d.material_count = 2, d.triangle_data = data;
    fe_asset made;
    value_must(fe_mesh_create(store, &d, &made));
    return made;
}

// Enough triangles for a tree of two levels and for shortcuts; one of them has no area, and one is there twice
static fe_asset make_sheet(fe_store *store)
{
    enum { CELLS = 7, SAMPLES = CELLS + 1, COUNT = 2 * CELLS * CELLS + 2 };
    float vertices[SAMPLES * SAMPLES][3];
    uint16_t triangles[COUNT][3] = {{0, 1, 1}, {0, SAMPLES, 1}};
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) {
        vertices[i][0] = 0.5f * (float)(i % SAMPLES) - 1.75f, vertices[i][2] = 0.5f * (float)(i / SAMPLES) - 1.75f;
        vertices[i][1] = 0.1f * (float)(i * 7 % 5);
    }
    for (int32_t i = 0; i < CELLS * CELLS; ++i) {
        int32_t v = i / CELLS * SAMPLES + i % CELLS;
        const int32_t both[2][3] = {{v, v + SAMPLES, v + 1}, {v + 1, v + SAMPLES, v + SAMPLES + 1}};
        for (int32_t k = 0; k < 6; ++k) triangles[2 + 2 * i + k / 3][k % 3] = (uint16_t)both[k / 3][k % 3];
    }
    fe_mesh_def d;
    fe_mesh_def_init(&d, sizeof d);
    d.vertices = vertices[0], d.vertex_count = SAMPLES * SAMPLES;
    d.indices = triangles, d.triangle_count = COUNT, d.index_type = FE_INDEX_U16, d.flags = FE_MESH_TWO_SIDED;
    fe_asset made;
    value_must(fe_mesh_create(store, &d, &made));
    return made;
}

static fe_asset make_field(fe_store *store, int32_t is_plain)
{
    static const float heights[20] = {0, 0.5f, 0, 1, 0, 0.25f, 0, 0.5f, 0, -1, 0, 0, 0.5f, 0, 0.25f, 0, 0, 1, 0, 0};
    static const uint8_t holes[12] = {0, 0, 0, 0, 0, 1}, kinds[12] = {0, 1, 1, 0, 0, 1};
    fe_heightfield_def d;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = 4, d.columns = 5, d.heights = heights, d.cell_z = 1.5f;
    if (!is_plain) d.holes = holes, d.cell_materials = kinds, d.materials = surfaces, d.material_count = 2;
    fe_asset made;
    value_must(fe_heightfield_create(store, &d, &made));
    return made;
}

static fe_compound_part make_part(float x, float y, float z)
{
    fe_compound_part p;
    fe_compound_part_init(&p, sizeof p);
    p.frame.position = (fe_vec3){x, y, z};
    p.frame.rotation = (fe_quat){0.2f * x, 0.1f, 0.3f * z, 0.9f};
    return p;
}

static fe_asset make_compound(fe_store *store, const fe_compound_part *parts, int32_t count)
{
    fe_asset made;
    value_must(fe_compound_create(store, parts, sizeof *parts, count, &made));
    return made;
}

static fe_asset make_toy(fe_store *store)
{
    fe_compound_part p[5];
    for (int32_t i = 0; i < 5; ++i) p[i] = make_part(0.7f * (float)(i % 3), 0.2f * (float)i, 0.6f * (float)(i / 3));
    fe_geometry_sphere(&p[0].geometry, 0.5f);
    fe_geometry_box(&p[1].geometry, 0.4f, 0.3f, 0.2f);
    fe_geometry_cylinder(&p[2].geometry, 0.3f, 0.4f);
    fe_geometry_cone(&p[3].geometry, 0.6f, 0.3f);
    fe_geometry_capsule(&p[4].geometry, 0.3f, 0.2f);
    p[1].own_material = 1, p[1].material = surfaces[0];
    p[3].density = 100.0f, p[3].user_data = UINT64_C(0xfedcba9876543210);
    return make_compound(store, p, 5);
}

// Nobody but the compound keeps its assets
static fe_asset make_yard(fe_store *store)
{
    fe_asset hull = make_hull(store, corners, 8), mesh = make_cube(store), field = make_field(store, 0);
    fe_compound_part p[4];
    for (int32_t i = 0; i < 4; ++i) p[i] = make_part(1.5f * (float)i, 0.3f * (float)i, 0.5f);
    fe_geometry_hull(&p[0].geometry, hull);
    fe_geometry_set_scale(&p[0].geometry, -0.5f, 0.75f, 1.5f);
    fe_geometry_heightfield(&p[1].geometry, field);
    fe_geometry_hull(&p[2].geometry, hull);
    fe_geometry_mesh(&p[3].geometry, mesh);
    fe_geometry_set_scale(&p[3].geometry, 0.5f, 0.5f, 0.25f);
    fe_asset made = make_compound(store, p, 4);
    value_must(fe_asset_destroy(store, hull));
    value_must(fe_asset_destroy(store, mesh));
    value_must(fe_asset_destroy(store, field));
    return made;
}

fe_asset cooked_seed(fe_store *store, int32_t which)
{
    switch (which) {
    case 0:
        return make_hull(store, corners, 8);
    case 1:
        return make_rock(store);
    case 2:
        return make_cube(store);
    case 3:
        return make_sheet(store);
    case 6:
        return make_toy(store);
    case 7:
        return make_yard(store);
    default:
        return make_field(store, which == 4);
    }
}

// ---- bytes ---------------------------------------------------------------------------------------------------------
void cooked_stamp(unsigned char *bytes, int64_t size)
{
    static const unsigned char magic[8] = {'F', 'E', 'A', 'T', 'H', 'E', 'R', 0x1A};
    memcpy(bytes, magic, sizeof magic);
    for (int32_t k = 0; k < 8; ++k) bytes[24 + k] = (unsigned char)((uint64_t)size >> 8 * k);
    fe__asset_seal(bytes, size);
}

// ---- use -----------------------------------------------------------------------------------------------------------
static void must(int32_t holds, const char *what)
{
    if (holds) return;
    fprintf(stderr, "a world with a loaded asset: %s\n", what);
    abort();
}

static int32_t is_finite(fe_dvec3 v) { return isfinite(v.x) && isfinite(v.y) && isfinite(v.z); }

typedef struct using
{
    fe_world *world;
    fe_store *store;
    fe_geometry geometry;
    fe_bounds bounds; // of the asset's shape
    fe_dvec3 middle, half;
}
using;

static fe_body put(using *u, int32_t type, const fe_geometry *geometry, fe_dvec3 at)
{
    fe_body_def body;
    fe_shape_def shape;
    fe_body_def_init(&body, sizeof body);
    fe_shape_def_init(&shape, sizeof shape);
    body.type = type, body.transform.position = at;
    body.transform.rotation = (fe_quat){0.1f, 0.2f, -0.1f, 1.0f};
    if (type == FE_BODY_STATIC) body.transform.rotation = (fe_quat){0.0f, 0.0f, 0.0f, 1.0f};
    fe_body made;
    fe_shape first;
    value_must(fe_body_create(u->world, &body, &made));
    // too heavy or too light for a body: an error, and nothing happened
    if (fe_shape_create(u->world, made, &shape, geometry, &first) != FE_OK) value_must(fe_body_destroy(u->world, made));
    return made;
}

static void find_geometry(using *u, fe_asset asset)
{
    fe_hull_info hull;
    fe_mesh_info mesh;
    fe_compound_info compound;
    fe_hull_info_init(&hull, sizeof hull);
    fe_compound_info_init(&compound, sizeof compound);
    fe_mesh_info_init(&mesh, sizeof mesh);
    if (fe_hull_get_info(u->store, asset, &hull) == FE_OK) {
        fe_geometry_hull(&u->geometry, asset);
    } else if (fe_mesh_get_info(u->store, asset, &mesh) == FE_OK) {
        fe_geometry_mesh(&u->geometry, asset);
        fe_mesh_triangle t;
        fe_mesh_triangle_init(&t, sizeof t);
        int32_t given = mesh.triangle_count + mesh.degenerate_triangles + mesh.duplicate_triangles;
        for (int32_t i = 0; i < given && i < 1000; ++i) value_must(fe_mesh_get_triangle(u->store, asset, i, &t));
    } else if (fe_compound_get_info(u->store, asset, &compound) == FE_OK) {
        fe_compound_part part;
        fe_geometry_compound(&u->geometry, asset);
        fe_compound_part_init(&part, sizeof part);
        for (int32_t i = 0; i < compound.part_count && i < 1000; ++i)
            value_must(fe_compound_get_part(u->store, asset, i, &part));
    } else {
        fe_geometry_heightfield(&u->geometry, asset);
    }
}

static fe_dvec3 at(const using *u, double x, double y, double z)
{
    return (fe_dvec3){u->middle.x + x * u->half.x, u->middle.y + y * u->half.y, u->middle.z + z * u->half.z};
}

static void ask(const using *u)
{
    fe_geometry ball, box;
    fe_hit hits[4];
    fe_closest closest;
    fe_body bodies[8];
    float size = (float)fmin(fmax(0.2 * fmax(u->half.x, fmax(u->half.y, u->half.z)), 0.01), 100.0);
    fe_geometry_sphere(&ball, size);
    fe_geometry_box(&box, size, 0.5f * size, size);
    for (int32_t i = 0; i < 9; ++i) {
        double x = 0.7 * (i % 3 - 1), z = 0.7 * (i / 3 - 1);
        fe_dvec3 from = at(u, x, 2.0, z), way = {0.1 * u->half.x, -5.0 * u->half.y - 1.0, -0.1 * u->half.z};
        fe_transform start = {from, {0.0f, 0.3f, 0.0f, 1.0f}};
        if (fe_world_raycast(u->world, &from, &way, NULL, hits) == 1)
            must(is_finite(hits[0].point) && hits[0].fraction >= 0.0 && hits[0].fraction <= 1.0, "a ray");
        if (fe_world_sweep(u->world, i % 2 ? &ball : &box, &start, &way, NULL, hits) == 1)
            must(is_finite(hits[0].point) && hits[0].fraction >= 0.0 && hits[0].fraction <= 1.0, "a sweep");
        if (fe_world_closest_point(u->world, &from, 1e6, NULL, &closest) == 1)
            must(is_finite(closest.point) && isfinite(closest.distance), "the nearest point");
        start.position = at(u, x, 0.0, z);
        must(fe_world_overlap(u->world, &box, &start, NULL, bodies, 8) >= 0, "an overlap");
        if (fe_world_closest_point(u->world, &start.position, 1e6, NULL, &closest) == 1)
            must(is_finite(closest.point) && isfinite(closest.distance), "the nearest point inside");
    }
}

// The asset once more, in a mirror, where it is met too: none if that would be too thin, or of what has no scale
static void put_scaled(using *u)
{
    fe_geometry scaled = u->geometry;
    fe_geometry_set_scale(&scaled, -0.75f, 1.25f, 0.9f);
    put(u, FE_BODY_STATIC, &scaled, at(u, 0.3, 0.2, 0.1));
}

static void drop_forms(using *u, fe_body *out)
{
    float s = (float)fmin(fmax(0.15 * fmax(u->half.x, u->half.z), 0.01), 100.0);
    fe_geometry forms[6];
    fe_geometry_sphere(forms, s);
    fe_geometry_box(forms + 1, s, 0.6f * s, 0.8f * s);
    fe_geometry_capsule(forms + 2, s, 0.5f * s);
    fe_geometry_cylinder(forms + 3, 0.5f * s, s);
    fe_geometry_cone(forms + 4, s, 0.7f * s);
    forms[5] = u->geometry;
    for (int32_t i = 0; i < 6; ++i) {
        if (i == 5 && u->geometry.type != FE_GEOMETRY_HULL && u->geometry.type != FE_GEOMETRY_COMPOUND)
            fe_geometry_sphere(forms + 5, 0.5f * s);
        out[i] = put(u, FE_BODY_DYNAMIC, forms + i, at(u, 0.8 * (i % 3 - 1), 0.9, 0.5 * (i / 3)));
    }
}

uint64_t cooked_use(fe_store *store, fe_asset asset, int32_t steps)
{
    fe_world_def def;
    using u = {.store = store};
    fe_body bodies[6];
    fe_world_def_init(&def, sizeof def);
    def.store = store, def.number = 9;
    value_must(fe_world_create(&def, &u.world));
    find_geometry(&u, asset);
    fe_body ground = put(&u, FE_BODY_STATIC, &u.geometry, (fe_dvec3){1.0, 2.0, 3.0});
    value_must(fe_body_get_bounds(u.world, ground, &u.bounds));
    must(is_finite(u.bounds.lower) && is_finite(u.bounds.upper), "bounds");
    u.middle = (fe_dvec3){0.5 * (u.bounds.lower.x + u.bounds.upper.x), 0.5 * (u.bounds.lower.y + u.bounds.upper.y),
                          0.5 * (u.bounds.lower.z + u.bounds.upper.z)};
    u.half = (fe_dvec3){0.5 * (u.bounds.upper.x - u.bounds.lower.x), 0.5 * (u.bounds.upper.y - u.bounds.lower.y),
                        0.5 * (u.bounds.upper.z - u.bounds.lower.z)};
    put_scaled(&u);
    ask(&u);
    drop_forms(&u, bodies);
    for (int32_t i = 0; i < steps; ++i) value_must(fe_world_step(u.world, 1.0f / 60.0f));
    for (int32_t i = 0; i < 6; ++i)
        if (fe_body_is_valid(u.world, bodies[i]))
            must(is_finite(body_transform(u.world, bodies[i]).position), "a pose");
    ask(&u);
    uint32_t words[2];
    value_must(fe_world_hash(u.world, words));
    fe_world_destroy(u.world);
    return (uint64_t)words[1] << 32 | words[0];
}
