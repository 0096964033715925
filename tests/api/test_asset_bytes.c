// Assets as bytes: what is saved is what is loaded, bit for bit, and moves worlds alike; bytes that are cut, altered or
// made up are refused with their place, or are sound.
//
//     build/tests/api/test_asset_bytes 1000000            that many random hulls
#include "api/asset_test.h"
#include "support/cooked.h"
#include "store/store.h"
#include "support/hull_clouds.h"

#include <stdlib.h>

// EVERY: of the places where bytes are broken, one of so many is tried. ThreadSanitizer has nothing to find in one
// thread
#if defined(__SANITIZE_THREAD__)
enum { HULLS = 20, MESHES = 10, FLIPS = 1, EVERY = 13 };
#elif defined(FE_SANITIZED)
enum { HULLS = 60, MESHES = 20, FLIPS = 1, EVERY = 4 };
#else
enum { HULLS = 2000, MESHES = 400, FLIPS = 2, EVERY = 1 };
#endif
static int32_t hulls = HULLS;
enum { HEADER = 40, VERSION_AT = 8, KIND_AT = 12, FEATURES_AT = 16, MATERIALS_AT = 20, SIZE_AT = 24 };

typedef struct blob {
    unsigned char *bytes;
    int64_t size;
} blob;

static blob save(const fe_store *store, fe_asset asset)
{
    blob b = {.size = fe_asset_save(store, asset, NULL, 0)};
    FE_TRUE(b.size > HEADER && b.size % 8 == 0);
    b.bytes = malloc((size_t)b.size);
    assert_true(fe_asset_save(store, asset, b.bytes, b.size) == b.size);
    return b;
}

static blob seed(int32_t which)
{
    fe_store *store = new_store(NULL);
    blob b = save(store, cooked_seed(store, which));
    OK(fe_store_destroy(store));
    return b;
}

static void check_equal(const blob *a, const blob *b)
{
    assert_true(a->size == b->size);
    assert_memory_equal(a->bytes, b->bytes, (size_t)a->size);
}

static int64_t bytes_of(const fe_store *store)
{
    int64_t bytes;
    OK(fe_store_get_bytes(store, &bytes));
    return bytes;
}

// Loaded into a store of its own, at an odd address; saved again, as deep as a world can see
static void check_round_trip(fe_store *store, fe_asset asset, int32_t steps)
{
    fe_store *other = new_store(NULL);
    fe_asset loaded = 1;
    blob first = save(store, asset);
    unsigned char *odd = malloc((size_t)first.size + 1);
    memcpy(odd + 1, first.bytes, (size_t)first.size);
    OK(fe_asset_load(other, odd + 1, first.size, &loaded));
    memset(odd, 0xff, (size_t)first.size + 1); // it was copied
    FE_TRUE(fe_asset_get_type(other, loaded) == fe_asset_get_type(store, asset));
    blob second = save(other, loaded);
    check_equal(&first, &second);
    if (steps) FE_TRUE(cooked_use(store, asset, steps) == cooked_use(other, loaded, steps));
    free(first.bytes), free(second.bytes), free(odd);
    OK(fe_store_destroy(other));
}

// ---- round trips ---------------------------------------------------------------------------------------------------

static void random_hulls_return(void **state)
{
    (void)state;
    for (int32_t i = 0; i < hulls; ++i) {
        fe_store *store = new_store(NULL);
        cloud c;
        fe_asset hull;
        fe_hull_def def;
        uint64_t chance = (uint64_t)i + 1;
        cloud_make(&c, (uint64_t)i + 1);
        fe_hull_def_init(&def, sizeof def);
        def.points = c.points[0], def.point_count = c.count;
        const int32_t most[4] = {4, 12, 64, 255};
        def.max_vertices = most[cloud_int(&chance, 4)];
        if (i % 5 == 0) def.tolerance = 0.01f;
        if (fe_hull_create(store, &def, &hull) == FE_OK) check_round_trip(store, hull, i % 10 ? 0 : 5);
        OK(fe_store_destroy(store));
    }
}

typedef struct soup {
    float vertices[3000][3];
    uint32_t triangles[3000][3];
    uint8_t kinds[3000];
    uint32_t data[3000];
} soup;

static const fe_material surfaces[3] = {SURFACE(0.6f, 0.5f, 0.0f, 0.1f, 0.02f), SURFACE(0.1f, 0.1f, 0.0f, 0.0f, 0.0f),
                                        SURFACE(0.6f, 0.5f, 0.6f, 0.0f, 0.0f)};

// Triangles between random vertices, of which some are one: crowded, flipped and open edges, triangles that are dropped
static fe_mesh_def random_mesh(soup *s, uint64_t *chance)
{
    fe_mesh_def d;
    fe_mesh_def_init(&d, sizeof d);
    d.vertex_count = 3 + cloud_int(chance, cloud_int(chance, 2) ? 10 : 1000);
    d.triangle_count = 1 + cloud_int(chance, cloud_int(chance, 2) ? 20 : 3000);
    double size = cloud_int(chance, 3) ? 2.0 : 1e4;
    for (int32_t i = 0; i < d.vertex_count; ++i)
        for (int32_t k = 0; k < 3; ++k) s->vertices[i][k] = (float)(size * cloud_unit(chance));
    for (int32_t i = 0; i < d.triangle_count; ++i) {
        for (int32_t k = 0; k < 3; ++k) s->triangles[i][k] = (uint32_t)cloud_int(chance, d.vertex_count);
        s->kinds[i] = (uint8_t)cloud_int(chance, 3), s->data[i] = (uint32_t)cloud_draw(chance);
    }
    d.vertices = s->vertices[0], d.indices = s->triangles;
    if (cloud_int(chance, 2)) d.triangle_materials = s->kinds, d.materials = surfaces, d.material_count = 3;
    if (cloud_int(chance, 2)) d.triangle_data = s->data;
    if (cloud_int(chance, 2)) d.flags = FE_MESH_TWO_SIDED;
    return d;
}

static void random_meshes_return(void **state)
{
    (void)state;
    soup *s = malloc(sizeof *s);
    uint64_t chance = 5;
    for (int32_t i = 0; i < MESHES; ++i) {
        fe_store *store = new_store(NULL);
        fe_mesh_def d = random_mesh(s, &chance);
        fe_asset mesh;
        if (fe_mesh_create(store, &d, &mesh) == FE_OK) check_round_trip(store, mesh, i % 10 ? 0 : 5);
        OK(fe_store_destroy(store));
    }
    free(s);
}

static void a_large_mesh_returns(void **state)
{
    (void)state;
    enum { CELLS = 150, SAMPLES = CELLS + 1 };
    fe_store *store = new_store(NULL);
    float(*vertices)[3] = calloc(SAMPLES * SAMPLES, sizeof *vertices);
    uint32_t(*triangles)[3] = calloc(2 * CELLS * CELLS, sizeof *triangles);
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) {
        vertices[i][0] = (float)(i % SAMPLES), vertices[i][2] = (float)(i / SAMPLES);
        vertices[i][1] = 0.01f * (float)(i * 7919 % 101);
    }
    for (int32_t i = 0; i < CELLS * CELLS; ++i) {
        uint32_t v = (uint32_t)(i / CELLS * SAMPLES + i % CELLS);
        const uint32_t both[6] = {v, v + SAMPLES, v + 1, v + 1, v + SAMPLES, v + SAMPLES + 1};
        memcpy(triangles[2 * i], both, sizeof both);
    }
    fe_mesh_def d;
    fe_asset mesh;
    fe_mesh_def_init(&d, sizeof d);
    d.vertices = vertices[0], d.vertex_count = SAMPLES * SAMPLES;
    d.indices = triangles, d.triangle_count = 2 * CELLS * CELLS;
    OK(fe_mesh_create(store, &d, &mesh));
    check_round_trip(store, mesh, 20);
    fe_mesh_info info;
    fe_mesh_info_init(&info, sizeof info);
    OK(fe_mesh_get_info(store, mesh, &info));
    // 12 bytes a vertex, of which each stands in one group or two, and 9 a triangle
    FE_WITHIN(fe_asset_save(store, mesh, NULL, 0), 15 * d.triangle_count, info.bytes);
    free(vertices), free(triangles);
    OK(fe_store_destroy(store));
}

static void seeds_return_and_move_worlds_alike(void **state)
{
    (void)state;
    for (int32_t i = 0; i < COOKED_SEEDS; ++i) {
        fe_store *store = new_store(NULL);
        check_round_trip(store, cooked_seed(store, i), 60);
        OK(fe_store_destroy(store));
    }
}

static void what_is_read_of_a_loaded_mesh_is_what_was_made(void **state)
{
    (void)state;
    soup *s = malloc(sizeof *s);
    uint64_t chance = 77;
    fe_store *store = new_store(NULL);
    fe_mesh_def d = random_mesh(s, &chance);
    fe_asset mesh, loaded;
    OK(fe_mesh_create(store, &d, &mesh));
    blob b = save(store, mesh);
    OK(fe_asset_load(store, b.bytes, b.size, &loaded));
    fe_mesh_info made, read;
    fe_mesh_info_init(&made, sizeof made), fe_mesh_info_init(&read, sizeof read);
    OK(fe_mesh_get_info(store, mesh, &made));
    OK(fe_mesh_get_info(store, loaded, &read));
    assert_memory_equal(&made, &read, sizeof made);
    for (int32_t i = 0; i < d.triangle_count; ++i) {
        fe_mesh_triangle t, u;
        fe_mesh_triangle_init(&t, sizeof t), fe_mesh_triangle_init(&u, sizeof u);
        OK(fe_mesh_get_triangle(store, mesh, i, &t));
        OK(fe_mesh_get_triangle(store, loaded, i, &u));
        assert_memory_equal(&t, &u, sizeof t);
    }
    free(b.bytes), free(s);
    OK(fe_store_destroy(store));
}

// Heights and materials are saved as they are now
static void edits_are_saved(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    fe_asset field = cooked_seed(store, 4), mesh = cooked_seed(store, 2), loaded;
    const float heights[4] = {7, 8, 9, 10};
    float read[4];
    OK(fe_heightfield_set_heights(store, field, 1, 2, 2, 2, heights));
    blob b = save(store, field);
    OK(fe_asset_load(store, b.bytes, b.size, &loaded));
    OK(fe_heightfield_get_heights(store, loaded, 1, 2, 2, 2, read));
    assert_memory_equal(read, heights, sizeof read);
    OK(fe_heightfield_set_heights(store, loaded, 0, 0, 2, 2, heights)); // it is one like any other
    blob before = save(store, mesh);
    OK(fe_mesh_set_materials(store, mesh, surfaces + 1, 0, 2));
    blob after = save(store, mesh);
    FE_TRUE(before.size == after.size && memcmp(before.bytes, after.bytes, (size_t)after.size) != 0);
    free(b.bytes), free(before.bytes), free(after.bytes);
    OK(fe_store_destroy(store));
}

// ---- arguments -----------------------------------------------------------------------------------------------------

static void arguments_are_checked(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL), *other = new_store(NULL);
    fe_asset asset = cooked_seed(store, 0), loaded = 5;
    unsigned char out[4096], untouched[4096];
    memset(out, 0xA5, sizeof out), memset(untouched, 0xA5, sizeof untouched);
    int64_t size = fe_asset_save(store, asset, NULL, 0);
    assert_true(fe_asset_save(store, asset, out, size - 1) == size);
    assert_true(fe_asset_save(store, asset, out, 0) == size);
    assert_memory_equal(out, untouched, sizeof out);
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_asset_save(NULL, asset, out, 4096));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_asset_save(store, asset, NULL, 1));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_asset_save(store, asset, out, -1));
    REFUSES(NULL, FE_ERROR_STALE, fe_asset_save(other, asset, out, 4096));
    REFUSES(NULL, FE_ERROR_STALE, fe_asset_save(store, 0, out, 4096));
    assert_memory_equal(out, untouched, sizeof out);
    assert_true(fe_asset_save(store, asset, out, 4096) == size);
    assert_memory_equal(out + size, untouched, sizeof out - (size_t)size);
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_asset_load(NULL, out, size, &loaded));
    FE_TRUE(loaded == 0);
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_asset_load(store, NULL, size, &loaded));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_asset_load(store, out, -1, &loaded));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_asset_load(store, out, size, NULL));
    REFUSES(NULL, FE_ERROR_DATA, fe_asset_load(store, out, 0, &loaded));
    OK(fe_asset_destroy(store, asset));
    REFUSES(NULL, FE_ERROR_STALE, fe_asset_save(store, asset, NULL, 0));
    OK(fe_asset_load(store, out, size, &loaded));
    OK(fe_store_destroy(store));
    OK(fe_store_destroy(other));
}

static void assets_tell_their_type(void **state)
{
    (void)state;
    static const int32_t types[COOKED_SEEDS] = {FE_GEOMETRY_HULL,     FE_GEOMETRY_HULL,        FE_GEOMETRY_MESH,
                                                FE_GEOMETRY_MESH,     FE_GEOMETRY_HEIGHTFIELD, FE_GEOMETRY_HEIGHTFIELD,
                                                FE_GEOMETRY_COMPOUND, FE_GEOMETRY_COMPOUND};
    fe_store *store = new_store(NULL);
    for (int32_t i = 0; i < COOKED_SEEDS; ++i)
        assert_int_equal(fe_asset_get_type(store, cooked_seed(store, i)), types[i]);
    REFUSES(NULL, FE_ERROR_STALE, fe_asset_get_type(store, 0));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_asset_get_type(NULL, 0));
    OK(fe_store_destroy(store));
}

// ---- memory --------------------------------------------------------------------------------------------------------

static blob to_load;
static fe_result load_it(fe_store *store, fe_asset *out)
{
    return fe_asset_load(store, to_load.bytes, to_load.size, out);
}

static void each_allocation_may_fail(void **state)
{
    (void)state;
    enum { YARD = 7, RECORDS = 6, CHUNK = 32 };
    for (int32_t i = 0; i < YARD; ++i) {
        to_load = seed(i);
        assert_in_range(fail_each_asset_allocation(load_it), 6, 6 * 6 + 8);
        free(to_load.bytes);
    }
    // a compound, three assets and two of them scaled, six times: the last chunk of records is one of 32
    to_load = seed(YARD);
    assert_in_range(fail_each_allocation_of(load_it, CHUNK * (int64_t)sizeof(fe__asset) + 4096), 6 * RECORDS,
                    6 * 6 * RECORDS);
    free(to_load.bytes);
}

// What is refused leaves nothing behind, and asks for no more memory than some times its size
static void check_refused_without_a_trace(fe_store *store, counting *c, const blob *b, fe_result expected)
{
    fe_asset loaded = 5;
    int64_t before = bytes_of(store);
    c->most_bytes = c->bytes;
    fe_result result = fe_asset_load(store, b->bytes, b->size, &loaded);
    FE_TRUE(c->most_bytes - before <= 64 * b->size + 4096);
    if (result == FE_OK) {
        if (expected) fail_msg("loaded, and should have been refused");
        blob again = save(store, loaded);
        check_equal(b, &again);
        cooked_use(store, loaded, 2);
        free(again.bytes);
        OK(fe_asset_destroy(store, loaded));
        return;
    }
    FE_TRUE(loaded == 0 && (result == FE_ERROR_DATA || result == FE_ERROR_VERSION));
    if (expected) assert_int_equal(result, expected);
    FE_TRUE(!strncmp(fe_last_error(), "fe_asset_load: ", 15) && strlen(fe_last_error()) > 30);
    assert_true(bytes_of(store) == before);
}

// ---- broken bytes --------------------------------------------------------------------------------------------------

typedef void breaker(fe_store *store, counting *c, const blob *whole, blob *broken);

static void break_each_seed(breaker *breaking)
{
    for (int32_t i = 0; i < COOKED_SEEDS; ++i) {
        counting c = {0};
        fe_allocator allocator = counting_allocator(&c);
        fe_store *store = new_store(&allocator);
        blob whole = seed(i), broken = seed(i);
        fe_asset first, second;
        OK(fe_asset_load(store, whole.bytes, whole.size, &first));
        OK(fe_asset_load(store, whole.bytes, whole.size, &second)); // the store has its tables, and room for one more
        OK(fe_asset_destroy(store, second));
        breaking(store, &c, &whole, &broken);
        free(whole.bytes), free(broken.bytes);
        OK(fe_store_destroy(store));
        FE_TRUE(c.blocks == 0 && c.wrong == 0);
    }
}

static void flip_each(fe_store *store, counting *c, const blob *whole, blob *broken)
{
    static const unsigned char masks[2] = {1, 0xff};
    for (int64_t at = 0; at < whole->size; at += EVERY) {
        for (int32_t k = 0; k < FLIPS; ++k) {
            broken->bytes[at] ^= masks[k];
            int32_t is_newer = at >= VERSION_AT && at < KIND_AT;
            check_refused_without_a_trace(store, c, broken,
                                          is_newer && (at > VERSION_AT || broken->bytes[at] > 1) ? FE_ERROR_VERSION
                                                                                                 : FE_ERROR_DATA);
            cooked_stamp(broken->bytes, broken->size);
            check_refused_without_a_trace(store, c, broken, FE_OK);
            memcpy(broken->bytes, whole->bytes, (size_t)whole->size);
        }
    }
}

static void each_byte_may_be_flipped(void **state)
{
    (void)state;
    break_each_seed(flip_each);
}

static void cut_at_each(fe_store *store, counting *c, const blob *whole, blob *broken)
{
    for (int64_t size = 0; size < whole->size; size += EVERY) {
        blob cut = {malloc((size_t)size + 1), size}; // a block of its own, which a sanitizer guards
        memcpy(cut.bytes, whole->bytes, (size_t)size);
        check_refused_without_a_trace(store, c, &cut, FE_ERROR_DATA);
        if (size >= HEADER && size % 8 == 0) cooked_stamp(cut.bytes, size);
        check_refused_without_a_trace(store, c, &cut, FE_ERROR_DATA);
        free(cut.bytes);
    }
    blob longer = {calloc(1, (size_t)whole->size + 16), whole->size};
    memcpy(longer.bytes, whole->bytes, (size_t)whole->size);
    for (longer.size += 1; longer.size <= whole->size + 16; ++longer.size) {
        if (longer.size % 8 == 0) cooked_stamp(longer.bytes, longer.size);
        check_refused_without_a_trace(store, c, &longer, FE_ERROR_DATA);
    }
    free(longer.bytes);
    (void)broken;
}

static void bytes_may_be_cut_anywhere(void **state)
{
    (void)state;
    break_each_seed(cut_at_each);
}

// Of what follows the header, some words
static int64_t way_to_next(int64_t at)
{
    if (at == MATERIALS_AT) return HEADER - MATERIALS_AT;
    return at < HEADER ? 4 : 4 * EVERY;
}

// Counts are believed only when as many bytes are there
static void put_numbers(fe_store *store, counting *c, const blob *whole, blob *broken)
{
    static const uint32_t numbers[] = {0,
                                       1,
                                       2,
                                       3,
                                       255,
                                       256,
                                       40000,
                                       1u << 27,
                                       0x7fffffff,
                                       0x80000000,
                                       0xffffffff,
                                       0x7f800000 /* infinity */,
                                       0x7fc00000 /* NaN */,
                                       0xff800000};
    for (int64_t at = VERSION_AT; at + 4 <= whole->size; at += way_to_next(at)) {
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
            for (int32_t k = 0; k < 4; ++k) broken->bytes[at + k] = (unsigned char)(numbers[i] >> 8 * k);
            cooked_stamp(broken->bytes, broken->size);
            check_refused_without_a_trace(store, c, broken, FE_OK);
        }
        memcpy(broken->bytes, whole->bytes, (size_t)whole->size);
    }
}

static void each_word_may_be_any_number(void **state)
{
    (void)state;
    break_each_seed(put_numbers);
}

// ---- named refusals ------------------------------------------------------------------------------------------------

typedef struct wrong {
    int32_t seed;
    int64_t at;
    int32_t width; // bytes
    uint32_t value;
    fe_result result;
    const char *says;
} wrong;

// Where the parts of the seeds stand. A cube as a hull: 8 vertices, 6 faces, 12 edges, 3 directions. As a mesh: 12
// triangles, 8 vertices, 3 leaves, 1 node. The sheet's 98 of 100 triangles
enum {
    CUBE_MEASURES = HEADER + 12,
    CUBE_VERTICES = CUBE_MEASURES + 28,
    CUBE_NORMALS = CUBE_VERTICES + 96,
    CUBE_DIRECTIONS = CUBE_NORMALS + 72,
    CUBE_HALVES = CUBE_DIRECTIONS + 36,
    CUBE_FACES = CUBE_HALVES + 48,
    CUBE_CORNERS = CUBE_FACES + 6,
    MESH_COUNTS = HEADER + 2 * 48,
    MESH_VERTICES = MESH_COUNTS + 36,
    MESH_LEAVES = MESH_VERTICES + 96,
    MESH_NUMBERS = MESH_LEAVES + 48,
    MESH_DATA = MESH_NUMBERS + 48,
    MESH_EDGES = MESH_DATA + 48,
    MESH_TREE = MESH_EDGES + 12,
    MESH_KINDS = MESH_TREE + 1,
    FIELD_HEIGHTS = HEADER + 16,
    PAINTED_HEIGHTS = HEADER + 2 * 48 + 16
};
// And within a part of a compound
enum { GEOMETRY = 0, ASSET = 4, SIZES = 8, SCALE = 28, PLACE = 40, TURN = 52, DENSITY = 68, OWN = 72, MATERIAL = 80 };
#define PART(i) (HEADER + 8 + 136 * (i))
#define NAN_BITS 0x7fc00000u

static const wrong wrongs[] = {
    {0, 0, 1, 'f', FE_ERROR_DATA, "no bytes of fe_asset_save"},
    {0, VERSION_AT, 4, 2, FE_ERROR_VERSION, "format 2 is of a newer library"},
    {0, VERSION_AT, 4, 0, FE_ERROR_DATA, "version"},
    {0, KIND_AT, 4, 5, FE_ERROR_VERSION, "kind 5 is of a newer library"},
    {0, KIND_AT, 4, 0, FE_ERROR_DATA, "kind"},
    {0, FEATURES_AT, 4, 1, FE_ERROR_VERSION, "feature 1 is of a newer library"},
    {2, FEATURES_AT, 4, 4, FE_ERROR_VERSION, "feature 4 is of a newer library"},
    {0, MATERIALS_AT, 4, 1, FE_ERROR_DATA, "number of materials"},
    {2, MATERIALS_AT, 4, 256, FE_ERROR_DATA, "number of materials"},
    {4, MATERIALS_AT, 4, 1, FE_ERROR_DATA, "no cells"},
    {2, HEADER + 8, 4, 0x40000000, FE_ERROR_DATA, "material 0, at byte 48: restitution is 2"},
    {2, HEADER + 48 + 20, 4, 5, FE_ERROR_DATA, "material 1, at byte 108: friction_combine is 5"},
    {2, HEADER + 32, 4, 5, FE_ERROR_DATA, "reserved is 5"},
    // hulls
    {0, HEADER, 4, 256, FE_ERROR_DATA, "number of vertices is 256"},
    {0, HEADER + 4, 4, 13, FE_ERROR_DATA, "number of faces is 13"},
    {0, HEADER + 8, 4, 33, FE_ERROR_DATA, "number of directions is 33"},
    {0, CUBE_MEASURES, 4, NAN_BITS, FE_ERROR_DATA, "origin 0 has nan"},
    {0, CUBE_MEASURES + 12, 4, 0x40800000, FE_ERROR_DATA, "thick"},
    {0, CUBE_MEASURES + 16, 4, 0x3f800000, FE_ERROR_DATA, "its points are 1 m"},
    {0, CUBE_MEASURES + 20, 4, NAN_BITS, FE_ERROR_DATA, "tolerance is nan"},
    {0, CUBE_MEASURES + 24, 4, 0xbf800000, FE_ERROR_DATA, "error is -1"},
    {0, CUBE_VERTICES + 16, 4, NAN_BITS, FE_ERROR_DATA, "vertex 1 has nan as its y"},
    {0, CUBE_VERTICES + 16, 4, 0x48000000, FE_ERROR_DATA, "vertex 1 is farther"},
    {0, CUBE_VERTICES, 4, 0xbf000000, FE_ERROR_DATA, "face"}, // a corner that was pressed in
    {0, CUBE_NORMALS, 4, 0x3f000000, FE_ERROR_DATA, "normal 0 is no unit vector"},
    {0, CUBE_DIRECTIONS, 4, 0x3f000000, FE_ERROR_DATA, "direction 0 is no unit vector"},
    {0, CUBE_HALVES, 2, 24, FE_ERROR_DATA, "corner 0 has half-edge 24"},
    {0, CUBE_HALVES, 2, 3, FE_ERROR_DATA, "or that of another"},
    {0, CUBE_FACES, 1, 2, FE_ERROR_DATA, "face 0 has 2 corners"},
    {0, CUBE_FACES, 1, 3, FE_ERROR_DATA, "V - E + F"},
    {0, CUBE_CORNERS, 1, 8, FE_ERROR_DATA, "is vertex 8 of 8"},
    {0, CUBE_CORNERS, 1, 7, FE_ERROR_DATA, "no two sides of an edge"},
    // meshes
    {2, MESH_COUNTS, 4, 0, FE_ERROR_DATA, "number of triangles is 0"},
    {2, MESH_COUNTS + 24, 4, 1, FE_ERROR_DATA, "have no height"},
    {2, MESH_VERTICES + 4, 4, NAN_BITS, FE_ERROR_DATA, "vertex 0 has nan as its y"},
    {2, MESH_VERTICES + 4, 4, 0x80000000, FE_ERROR_DATA, "and not -0"},
    {2, MESH_LEAVES, 4, 8, FE_ERROR_DATA, "is vertex 8 of 8"},
    {2, MESH_LEAVES, 4, 0xffffffff, FE_ERROR_DATA, "of 8"},
    {2, MESH_NUMBERS, 4, 12, FE_ERROR_DATA, "slot 0 has triangle 12 of 12"},
    {2, MESH_COUNTS + 16, 4, 1, FE_ERROR_DATA, "need 0 shortcuts, not 1"},
    {2, MESH_EDGES, 1, 125, FE_ERROR_DATA, "edges 125"},
    {2, MESH_EDGES, 1, 124, FE_ERROR_DATA, "0 crowded and 0 flipped edges"},
    {2, MESH_TREE, 1, 128 + 4, FE_ERROR_DATA, "node 0 has 4 children of the 3 leaves left"},
    {2, MESH_TREE, 1, 128 + 2, FE_ERROR_DATA, "1 nodes and 2 leaves"},
    {2, MESH_TREE, 1, 3, FE_ERROR_DATA, "node 0 has 3 children of the 0 nodes left"},
    {2, MESH_KINDS, 1, 2, FE_ERROR_DATA, "material 2 of 2"},
    // heightfields
    {4, HEADER, 4, 1, FE_ERROR_DATA, "rows is 1"},
    {4, HEADER + 4, 4, 40000, FE_ERROR_DATA, "columns is 40000"},
    {4, HEADER + 4, 4, 6, FE_ERROR_DATA, "bytes are left, must be 96"},
    {4, HEADER + 8, 4, 0, FE_ERROR_DATA, "cell_x is 0"},
    {4, FIELD_HEIGHTS + 8, 4, NAN_BITS, FE_ERROR_DATA, "height 2 is nan"},
    {5, PAINTED_HEIGHTS + 80, 1, 2, FE_ERROR_DATA, "cell 0 has material 2 of 2"},
    // compounds
    {6, FEATURES_AT, 4, 1, FE_ERROR_VERSION, "feature 1 is of a newer library"},
    {6, MATERIALS_AT, 4, 1, FE_ERROR_DATA, "number of materials is 1"},
    {6, HEADER, 4, 0, FE_ERROR_DATA, "number of parts is 0"},
    {6, HEADER, 4, 65536, FE_ERROR_DATA, "number of parts is 65536"},
    {6, HEADER, 4, 6, FE_ERROR_DATA, "680 bytes are left, must be 816"},
    {6, HEADER, 4, 4, FE_ERROR_DATA, "136 bytes stand behind the assets"},
    {6, HEADER + 4, 4, 1, FE_ERROR_DATA, "680 bytes are left, must be 720"},
    {7, HEADER + 4, 4, 5, FE_ERROR_DATA, "number of assets is 5"},
    {6, PART(0) + GEOMETRY, 4, FE_GEOMETRY_PLANE, FE_ERROR_DATA, "is none of a part"},
    {6, PART(0) + GEOMETRY, 4, FE_GEOMETRY_COMPOUND, FE_ERROR_DATA, "is none of a part"},
    {6, PART(0) + GEOMETRY, 4, 1000, FE_ERROR_DATA, "geometry 1000 is none"},
    {6, PART(0) + GEOMETRY, 4, FE_GEOMETRY_HULL, FE_ERROR_DATA, "but there are none"},
    {6, PART(0) + ASSET, 4, 0, FE_ERROR_DATA, "number of the asset is 0"},
    {6, PART(0) + SIZES, 4, NAN_BITS, FE_ERROR_DATA, "no sizes of a sphere"},
    {6, PART(1) + SIZES, 4, 0x3f000000, FE_ERROR_DATA, "no sizes of a box"},
    {6, PART(1) + SCALE, 4, 0x3f800000, FE_ERROR_DATA, "scale of a form without an asset: 128, must be 0"},
    {6, PART(1) + PLACE, 4, NAN_BITS, FE_ERROR_DATA, "position is nan"},
    {6, PART(1) + PLACE, 4, 0x4b000000, FE_ERROR_DATA, "position is 8388608"},
    {6, PART(1) + TURN, 4, NAN_BITS, FE_ERROR_DATA, "rotation is nan"},
    {6, PART(1) + TURN, 4, 0x3f800000, FE_ERROR_DATA, "length is not 1"},
    {6, PART(1) + DENSITY, 4, NAN_BITS, FE_ERROR_DATA, "density is nan"},
    {6, PART(1) + DENSITY, 4, 0xbf000000, FE_ERROR_DATA, "below 0, and not -1"},
    {6, PART(1) + OWN, 4, 2, FE_ERROR_DATA, "own_material is 2"},
    {6, PART(1) + OWN + 4, 4, 1, FE_ERROR_DATA, "what has no use: 1"},
    {6, PART(1) + MATERIAL + 8, 4, 0x40000000, FE_ERROR_DATA, "material 1, at byte 272: restitution is 2"},
    {6, PART(0) + MATERIAL, 4, 1, FE_ERROR_DATA, "material that the part has not"},
    {7, PART(0) + GEOMETRY, 4, FE_GEOMETRY_MESH, FE_ERROR_DATA, "of another kind than the part"},
    {7, PART(0) + ASSET, 4, 1, FE_ERROR_DATA, "number of the asset is 1, must be 0..0"},
    {7, PART(1) + ASSET, 4, 2, FE_ERROR_DATA, "number of the asset is 2, must be 0..1"},
    {7, PART(3) + ASSET, 4, 3, FE_ERROR_DATA, "number of the asset is 3, must be 0..2"},
    {7, PART(0) + SIZES, 4, 0x3f800000, FE_ERROR_DATA, "sizes of a form that is an asset's: 128, must be 0"},
    {7, PART(0) + SCALE, 4, 0, FE_ERROR_DATA, "cannot have the scale"},
    {7, PART(0) + SCALE, 4, 0x49742400, FE_ERROR_DATA, "scale is 1000000"},
    {7, PART(1) + SCALE, 4, 0x40000000, FE_ERROR_DATA, "cannot have the scale"},
    {7, PART(4) + KIND_AT, 4, 4, FE_ERROR_DATA, "a compound stands among the assets"},
    {7, PART(4) + SIZE_AT, 4, 0x7fffffff, FE_ERROR_DATA, "bytes are left, the asset has 2147483647"},
    {7, PART(4) + SIZE_AT, 4, 48, FE_ERROR_DATA, "the hash is not that"},
    {7, PART(4), 1, 'f', FE_ERROR_DATA, "no bytes of fe_asset_save"},
};

static void refusals_name_what_is_wrong(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    for (size_t i = 0; i < sizeof wrongs / sizeof *wrongs; ++i) {
        const wrong *w = wrongs + i;
        blob b = seed(w->seed);
        fe_asset loaded;
        for (int32_t k = 0; k < w->width; ++k) b.bytes[w->at + k] = (unsigned char)(w->value >> 8 * k);
        unsigned char first = b.bytes[0];
        cooked_stamp(b.bytes, b.size);
        b.bytes[0] = first;
        fe_result result = fe_asset_load(store, b.bytes, b.size, &loaded);
        if (result != w->result || !strstr(fe_last_error(), w->says))
            fail_msg("%d: %s, \"%s\" does not say \"%s\"", (int)i, fe_result_name(result), fe_last_error(), w->says);
        free(b.bytes);
    }
    OK(fe_store_destroy(store));
}

static void an_asset_that_no_part_has_is_refused(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    fe_asset loaded;
    blob toy = seed(6), hull = seed(0), both = {malloc((size_t)(toy.size + hull.size)), toy.size + hull.size};
    memcpy(both.bytes, toy.bytes, (size_t)toy.size);
    memcpy(both.bytes + toy.size, hull.bytes, (size_t)hull.size);
    both.bytes[HEADER + 4] = 1; // asset
    cooked_stamp(both.bytes, both.size);
    REFUSES(NULL, FE_ERROR_DATA, fe_asset_load(store, both.bytes, both.size, &loaded));
    SAYS("1 assets follow, parts have 0");
    free(toy.bytes), free(hull.bytes), free(both.bytes);
    OK(fe_store_destroy(store));
}

// Two slots with one triangle, which would lead a walk along its cycle around for ever
static void numbers_are_a_permutation(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    fe_asset loaded;
    blob b = seed(2);
    memcpy(b.bytes + MESH_NUMBERS, b.bytes + MESH_NUMBERS + 4, 4);
    cooked_stamp(b.bytes, b.size);
    REFUSES(NULL, FE_ERROR_DATA, fe_asset_load(store, b.bytes, b.size, &loaded));
    SAYS("slots 0 and 1 both have triangle");
    free(b.bytes);
    OK(fe_store_destroy(store));
}

static void an_altered_byte_is_told_by_the_hash(void **state)
{
    (void)state;
    fe_store *store = new_store(NULL);
    fe_asset loaded;
    blob b = seed(4);
    b.bytes[FIELD_HEIGHTS + 2] ^= 1;
    REFUSES(NULL, FE_ERROR_DATA, fe_asset_load(store, b.bytes, b.size, &loaded));
    SAYS("the hash is not that of the bytes");
    REFUSES(NULL, FE_ERROR_DATA, fe_asset_load(store, b.bytes, b.size - 8, &loaded));
    SAYS("fe_asset_save wrote");
    free(b.bytes);
    OK(fe_store_destroy(store));
}

int main(int argument_count, char **arguments)
{
    if (argument_count > 1) hulls = atoi(arguments[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_hulls_return),
        cmocka_unit_test(random_meshes_return),
        cmocka_unit_test(a_large_mesh_returns),
        cmocka_unit_test(seeds_return_and_move_worlds_alike),
        cmocka_unit_test(what_is_read_of_a_loaded_mesh_is_what_was_made),
        cmocka_unit_test(edits_are_saved),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(assets_tell_their_type),
        cmocka_unit_test(each_allocation_may_fail),
        cmocka_unit_test(each_byte_may_be_flipped),
        cmocka_unit_test(bytes_may_be_cut_anywhere),
        cmocka_unit_test(each_word_may_be_any_number),
        cmocka_unit_test(refusals_name_what_is_wrong),
        cmocka_unit_test(an_asset_that_no_part_has_is_refused),
        cmocka_unit_test(numbers_are_a_permutation),
        cmocka_unit_test(an_altered_byte_is_told_by_the_hash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
