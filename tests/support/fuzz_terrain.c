// fuzz_terrain.c - the fuzzer's calls on heightfields, meshes and hulls: the assets of its store. See fuzz.c.
#include "support/fuzz_state.h"

enum { MOST_SAMPLES = 8, ASSETS = 8 };

fe_asset fuzz_asset(fuzz *f)
{
    uint8_t kind = fuzz_byte(f);
    return kind < 6 ? fuzz_shape(f) : f->assets[kind % ASSETS];
}

// Of a few, so that shapes share them, or anything
void fuzz_scale(fuzz *f, fe_geometry *geometry)
{
    static const float some[8] = {1.0f, -1.0f, 0.5f, 2.0f, 1.0f, -0.7f, 0.001f, 30.0f};
    uint8_t which = fuzz_byte(f), more = fuzz_byte(f);
    if (which < 100) return;
    if (which > 240)
        geometry->scale = fuzz_vec3(f);
    else
        fe_geometry_set_scale(geometry, some[more & 7], some[more >> 3 & 3], some[more >> 5]);
}

static fe_asset *next_asset(fuzz *f) { return f->assets + f->asset_count % ASSETS; }

// of points in a ball, or anywhere
static fe_result create_hull(fuzz *f)
{
    enum { MOST = 24 };
    float points[MOST][3];
    uint8_t which = fuzz_byte(f);
    for (int32_t i = 0; i < MOST; ++i)
        for (int32_t k = 0; k < 3; ++k)
            points[i][k] = which == 3 ? fuzz_float(f) : (which == 4 ? 1e4f : 0.0f) + 0.01f * (float)fuzz_byte(f);
    fe_hull_def d;
    fe_hull_def_init(&d, sizeof d);
    d.points = points[0], d.point_count = 3 + which % (MOST - 2);
    fe_result result = fe_hull_create(world_store(f->world), &d, next_asset(f));
    if (result == FE_OK) ++f->asset_count;
    return result;
}

// a grid whose triangles may be turned, missing or wild
static fe_result create_mesh(fuzz *f)
{
    enum { SIDE = 5, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };
    float vertices[VERTICES][3];
    uint16_t triangles[TRIANGLES][3];
    uint8_t kinds[TRIANGLES], which = fuzz_byte(f);
    const fe_material materials[2] = {SURFACE(0.6f, 0.5f, 0.0f, 0.0f, 0.0f), SURFACE(0.0f, 0.0f, 0.5f, 0.1f, 0.0f)};
    for (int32_t i = 0; i < VERTICES; ++i) {
        vertices[i][0] = 0.7f * (float)(i % SIDE), vertices[i][2] = 0.7f * (float)(i / SIDE);
        vertices[i][1] = which == 7 ? fuzz_float(f) : 0.01f * (float)(fuzz_byte(f) % 64);
    }
    for (int32_t i = 0; i < TRIANGLES; ++i) {
        uint8_t draw = fuzz_byte(f);
        int32_t cell = i / 2, corner = cell / (SIDE - 1) * SIDE + cell % (SIDE - 1), odd = i % 2, turned = draw == 1;
        const int32_t v[3] = {corner, odd ? corner + SIDE + 1 : corner + SIDE, odd ? corner + 1 : corner + SIDE + 1};
        for (int32_t k = 0; k < 3; ++k)
            triangles[i][k] = (uint16_t)(draw == 2 ? fuzz_byte(f) % 26 : v[turned ? 2 - k : k]);
        kinds[i] = which == 8 ? draw % 3 : (uint8_t)odd;
    }
    fe_mesh_def d;
    fe_mesh_def_init(&d, sizeof d);
    d.vertices = vertices[0], d.vertex_count = which == 9 ? fuzz_byte(f) % (VERTICES + 1) : VERTICES;
    d.indices = triangles, d.triangle_count = TRIANGLES, d.index_type = FE_INDEX_U16;
    d.flags = which % 4, d.weld_distance = which == 10 ? fuzz_float(f) : 0.0f;
    if (which & 32) d.triangle_materials = kinds, d.materials = materials, d.material_count = 2;
    fe_result result = fe_mesh_create(world_store(f->world), &d, next_asset(f));
    if (result == FE_OK) ++f->asset_count;
    return result;
}

// of any forms, in any places
static fe_result create_compound(fuzz *f)
{
    enum { MOST = 6 };
    fe_compound_part parts[MOST], read;
    uint8_t which = fuzz_byte(f);
    for (int32_t i = 0; i < MOST; ++i) {
        fe_compound_part_init(parts + i, sizeof *parts);
        uint8_t draw = fuzz_byte(f);
        fe_geometry_box(&parts[i].geometry, 0.3f, 0.2f, 0.1f);
        if (draw & 1) parts[i].geometry = fuzz_geometry(f);
        if (draw & 2) parts[i].frame.position = fuzz_vec3(f);
        if (draw & 4) parts[i].frame.rotation = fuzz_quat(f);
        if (draw & 8) parts[i].density = fuzz_float(f);
        parts[i].own_material = draw == 255 ? 2 : draw >> 4 & 1;
    }
    fe_result result =
        fe_compound_create(world_store(f->world), or_null(f, parts), sizeof *parts, which % (MOST + 1), next_asset(f));
    if (result != FE_OK) return result;
    fe_compound_part_init(&read, sizeof read);
    result = fe_compound_get_part(world_store(f->world), *next_asset(f), which % 9 - 1, &read);
    ++f->asset_count;
    return result;
}

// saved and loaded, at times with a byte that is another or missing, or with too little room
static fe_result cook(fuzz *f)
{
    enum { ROOM = 1 << 13 };
    unsigned char bytes[ROOM];
    fe_store *store = world_store(f->world);
    uint8_t which = fuzz_byte(f);
    fe_asset asset = fuzz_asset(f);
    int64_t size = fe_asset_save(store, asset, bytes, which == 1 ? fuzz_byte(f) : ROOM);
    if (size < 0) return (fe_result)size;
    if (size > ROOM || which == 1) return FE_OK;
    if (which % 4 == 2) bytes[(fuzz_byte(f) << 8 | fuzz_byte(f)) % size] ^= fuzz_byte(f);
    fe_result result = fe_asset_load(store, bytes, which == 3 ? fuzz_byte(f) : size, next_asset(f));
    if (result == FE_OK) ++f->asset_count;
    fe__hash_u64(&f->told, (uint64_t)fe_asset_get_type(store, asset));
    return result;
}

// mostly one that a game could have, under the bodies of fuzz_calls.c's create_whole
int32_t fuzz_create_field(fuzz *f)
{
    float heights[MOST_SAMPLES * MOST_SAMPLES];
    uint8_t holes[MOST_SAMPLES * MOST_SAMPLES], kinds[MOST_SAMPLES * MOST_SAMPLES], which = fuzz_byte(f);
    const fe_material materials[2] = {SURFACE(0.6f, 0.5f, 0.0f, 0.0f, 0.0f), SURFACE(0.0f, 0.0f, 0.5f, 0.1f, 0.0f)};
    for (int32_t i = 0; i < MOST_SAMPLES * MOST_SAMPLES; ++i) {
        heights[i] = which == 7 ? fuzz_float(f) : 0.01f * (float)(fuzz_byte(f) % 64);
        holes[i] = which == 9 ? fuzz_byte(f) % 3 : i % 13 == which;
        kinds[i] = which == 8 ? fuzz_byte(f) % 3 : i % 2 == 0;
    }
    struct {
        fe_heightfield_def def;
        unsigned char tail[FUZZ_TAIL];
    } field;
    memset(&field, 0, sizeof field);
    fe_heightfield_def_init(&field.def,
                            which == 3 ? fuzz_struct_size(f, sizeof field.def) : (uint32_t)sizeof field.def);
    fe_heightfield_def *d = &field.def;
    d->rows = 2 + which % (MOST_SAMPLES - 1), d->columns = which == 5 ? (int32_t)fuzz_byte(f) - 2 : 8;
    if (d->columns > MOST_SAMPLES) d->columns = MOST_SAMPLES;
    d->cell_x = which == 4 ? fuzz_size(f) : 0.7f, d->cell_z = 0.7f;
    d->heights = which == 1 ? NULL : heights;
    if (which & 16) d->holes = holes;
    if (which & 32) d->cell_materials = kinds, d->materials = materials, d->material_count = which == 33 ? 0 : 2;
    if (fe_asset_is_valid(world_store(f->world), *next_asset(f)))
        return fe_asset_destroy(world_store(f->world), *next_asset(f));
    if (which > 224) return create_compound(f);
    if (which > 192) return cook(f);
    if (which & 64) return which & 8 ? create_mesh(f) : create_hull(f);
    fe_result result = fe_heightfield_create(world_store(f->world), d, next_asset(f));
    if (result == FE_OK) ++f->asset_count;
    return result;
}

// a shape of one, mostly on a static body
int32_t fuzz_place_field(fuzz *f)
{
    fe_body_def d;
    fe_body_def_init(&d, sizeof d);
    uint8_t which = fuzz_byte(f);
    d.type = which > 14 ? FE_BODY_STATIC : which > 4 ? FE_BODY_KINEMATIC : FE_BODY_DYNAMIC;
    d.transform = fe_make_transform((double)(which % 5) * 0.7 - 3.0, 0.0, (double)(which % 3) * 0.7 - 2.0);
    fe_geometry g;
    if (which & 32)
        fe_geometry_mesh(&g, fuzz_asset(f)), fuzz_scale(f, &g);
    else
        fe_geometry_heightfield(&g, fuzz_asset(f));
    fe_body body;
    fe_shape shape;
    fe_result result = fe_body_create(f->world, &d, &body);
    if (result != FE_OK) return result;
    result = fe_shape_create(f->world, body, NULL, &g, &shape);
    // without memory once more, here: another body would have another serial, and where memory fails depends on the
    // workers
    if (result == FE_ERROR_MEMORY) result = fe_shape_create(f->world, body, NULL, &g, &shape);
    if (result != FE_OK) (void)fe_body_destroy(f->world, body);
    if (result != FE_OK) return result;
    fe__hash_u64(&f->told, shape);
    // in the ring as any other: what it displaces goes
    fe_body oldest = f->bodies[f->body_count % FUZZ_HANDLES];
    if (fe_body_is_valid(f->world, oldest)) (void)fe_body_destroy(f->world, oldest);
    f->bodies[f->body_count++ % FUZZ_HANDLES] = body;
    f->shapes[f->shape_count++ % FUZZ_HANDLES] = shape;
    return FE_OK;
}

int32_t fuzz_edit_field(fuzz *f)
{
    float heights[MOST_SAMPLES * MOST_SAMPLES];
    uint8_t which = fuzz_byte(f);
    for (int32_t i = 0; i < MOST_SAMPLES * MOST_SAMPLES; ++i)
        heights[i] = which == 7 ? fuzz_float(f) : 0.02f * (float)(fuzz_byte(f) % 64);
    int32_t row = fuzz_byte(f) % 9 - 1, column = fuzz_byte(f) % 9 - 1, rows = fuzz_byte(f) % 9,
            columns = fuzz_byte(f) % 9;
    fe_asset asset = fuzz_asset(f);
    if (which % 7 == 3) {
        const fe_material materials[2] = {SURFACE(heights[0], 0.5f, 0.0f, 0.0f, 0.0f),
                                          SURFACE(0.0f, 0.0f, heights[1], 0.1f, 0.0f)};
        return fe_mesh_set_materials(world_store(f->world), asset, materials, 0, which % 2 ? 2 : 1);
    }
    if (which % 5 == 0)
        return fe_heightfield_get_heights(world_store(f->world), asset, row, column, rows, columns, heights);
    return fe_heightfield_set_heights(world_store(f->world), asset, row, column, rows, columns,
                                      which == 6 ? NULL : heights);
}

int32_t fuzz_destroy_asset(fuzz *f) { return fe_asset_destroy(world_store(f->world), fuzz_asset(f)); }
