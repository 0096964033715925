// test_snapshot.c - the calls: arguments, sizes, assets by key and inside, numbers, pair filters, allocations that
// fail.
#include "fe_test.h"
#include "robust/counting_allocator.h"
#include "support/play.h"

#include <stdlib.h>
#include <string.h>

typedef struct bytes {
    unsigned char *data;
    int64_t size;
} bytes;

static bytes save_by(const fe_world *world, const fe_save_options *options)
{
    bytes b = {NULL, fe_world_save(world, options, NULL, 0)};
    FE_TRUE(b.size > 0);
    b.data = malloc((size_t)b.size);
    FE_TRUE(b.data && fe_world_save(world, options, b.data, b.size) == b.size);
    return b;
}

static bytes save(const fe_world *world) { return save_by(world, NULL); }

static int32_t are_same(bytes a, bytes b) { return a.size == b.size && memcmp(a.data, b.data, (size_t)a.size) == 0; }

static fe_world *make(const script *s, int32_t steps)
{
    static play p;
    fe_world *world;
    FE_TRUE(fe_world_create(NULL, &world) == FE_OK);
    play_begin(&p, world);
    play_until(&p, s, steps);
    return world;
}

static uint64_t hash_of(const fe_world *world)
{
    uint32_t words[2];
    FE_TRUE(fe_world_hash(world, words) == FE_OK);
    return words[0] | (uint64_t)words[1] << 32;
}

static void destroy(fe_world *world) { FE_TRUE(fe_world_destroy(world) == FE_OK); }

// ---- arguments ------------------------------------------------------------------------------------------------------
static void saving_says_how_large_it_is_and_writes_no_less(void **state)
{
    (void)state;
    fe_world *world = make(&script_brief, 30);
    bytes b = save(world);
    unsigned char *short_room = calloc(1, (size_t)b.size);
    FE_TRUE(fe_world_save(world, NULL, short_room, b.size - 1) == b.size);
    for (int64_t i = 0; i < b.size; ++i) FE_TRUE(short_room[i] == 0);
    FE_TRUE(fe_world_save(NULL, NULL, short_room, b.size) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_world_save(world, NULL, NULL, 1) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_world_save(world, NULL, short_room, -1) == FE_ERROR_ARGUMENT);
    fe_save_options options;
    fe_save_options_init(&options, sizeof options);
    options.flags = 4;
    FE_TRUE(fe_world_save(world, &options, NULL, 0) == FE_ERROR_ARGUMENT);
    options.flags = 0, options.struct_size = 3;
    FE_TRUE(fe_world_save(world, &options, NULL, 0) == FE_ERROR_ARGUMENT);
    free(short_room);
    free(b.data);
    destroy(world);
}

static void restoring_refuses_what_is_no_snapshot(void **state)
{
    (void)state;
    fe_world *world = make(&script_brief, 30), *other = NULL;
    bytes b = save(world);
    uint64_t hash = hash_of(world);
    FE_TRUE(fe_world_restore(NULL, NULL, b.data, b.size) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_world_restore(world, NULL, NULL, b.size) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_world_restore(world, NULL, b.data, -1) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_world_restore(world, NULL, b.data, 0) == FE_ERROR_DATA);
    FE_TRUE(fe_world_load(NULL, NULL, b.data, b.size, NULL) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_world_load(NULL, NULL, b.data, 7, &other) == FE_ERROR_DATA && !other);
    fe_restore_options options;
    fe_restore_options_init(&options, sizeof options);
    options.asset_count = 1;
    FE_TRUE(fe_world_restore(world, &options, b.data, b.size) == FE_ERROR_ARGUMENT);
    options.asset_count = 0, options.new_number = 2;
    FE_TRUE(fe_world_restore(world, &options, b.data, b.size) == FE_ERROR_ARGUMENT);
    FE_TRUE(hash_of(world) == hash);
    free(b.data);
    destroy(world);
}

// Each format but its own, by the number in the header; 0 was none. No world changes
static void other_formats_are_refused_by_name(void **state)
{
    (void)state;
    enum { AT_MAJOR = 8 };
    fe_world *world = make(&script_brief, 30), *other = NULL;
    bytes b = save(world);
    uint64_t hash = hash_of(world);
    uint32_t own = b.data[AT_MAJOR];
    for (uint32_t major = 1; major < 256; ++major) {
        char sentence[64];
        if (major == own) continue;
        b.data[AT_MAJOR] = (unsigned char)major;
        snprintf(sentence, sizeof sentence, "format %u is of a %s", (unsigned)major,
                 major < own ? "library before 1.0" : "newer library");
        FE_TRUE(fe_world_restore(world, NULL, b.data, b.size) == FE_ERROR_VERSION);
        FE_TRUE(strstr(fe_last_error(), sentence) != NULL);
        FE_TRUE(fe_world_load(NULL, NULL, b.data, b.size, &other) == FE_ERROR_VERSION && !other);
        FE_TRUE(strstr(fe_last_error(), sentence) != NULL);
        FE_TRUE(fe_snapshot_check(b.data, b.size, NULL) == FE_ERROR_VERSION);
        FE_TRUE(strstr(fe_last_error(), sentence) != NULL);
    }
    FE_TRUE(hash_of(world) == hash);
    free(b.data);
    destroy(world);
}

static void a_snapshot_says_what_is_in_it(void **state)
{
    (void)state;
    fe_world *world = make(&script_brief, 30);
    bytes b = save(world);
    fe_counters counters;
    uint32_t number = 0;
    fe_counters_init(&counters, sizeof counters);
    FE_TRUE(fe_world_get_counters(world, &counters) == FE_OK && fe_world_get_number(world, &number) == FE_OK);
    fe_snapshot_info info;
    fe_snapshot_info_init(&info, sizeof info);
    FE_TRUE(fe_snapshot_check(b.data, b.size, &info) == FE_OK);
    FE_TRUE(info.bodies == counters.bodies && info.shapes == counters.shapes && info.joints == counters.joints);
    FE_TRUE(info.number == number && info.library == fe_version() && info.step == 30 && !info.foreign);
    FE_TRUE(info.assets == fe_snapshot_get_assets(b.data, b.size, NULL, 0, 0) && info.inside == 0);
    FE_TRUE(fe_snapshot_check(NULL, b.size, &info) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_snapshot_check(b.data, b.size - 8, &info) == FE_ERROR_DATA);
    FE_TRUE(fe_snapshot_get_assets(b.data, 8, NULL, 0, 0) == FE_ERROR_DATA);
    free(b.data);
    destroy(world);
}

// ---- handles, filters, assets ---------------------------------------------------------------------------------------
static void handles_are_the_saved_worlds_unless_a_new_number_is_asked_for(void **state)
{
    (void)state;
    fe_world *world = make(&script_brief, 30), *twin, *other;
    bytes b = save(world);
    fe_body body, same;
    FE_TRUE(fe_world_get_bodies(world, &body, 1) > 0);
    fe_restore_options options;
    fe_restore_options_init(&options, sizeof options);
    FE_TRUE(fe_world_load(NULL, &options, b.data, b.size, &twin) == FE_OK);
    FE_TRUE(fe_world_get_bodies(twin, &same, 1) > 0 && same == body);
    options.new_number = 1;
    FE_TRUE(fe_world_load(NULL, &options, b.data, b.size, &other) == FE_OK);
    FE_TRUE(fe_world_get_bodies(other, &same, 1) > 0 && same != body && !fe_body_is_valid(other, body));
    FE_TRUE(hash_of(other) == hash_of(world));
    // it is as new: the next handles are the same, the old world is not looked at
    FE_TRUE(fe_body_destroy(twin, body) == FE_OK && fe_body_is_valid(world, body));
    free(b.data);
    destroy(world), destroy(twin), destroy(other);
}

static int32_t accept(void *user, const fe_filter_pair *pair) { return (void)user, (void)pair, 1; }

static void a_world_with_a_filter_is_restored_where_one_is(void **state)
{
    (void)state;
    fe_world *world = make(&script_brief, 30), *twin = NULL;
    FE_TRUE(fe_world_set_pair_filter(world, accept, NULL) == FE_OK);
    bytes b = save(world);
    FE_TRUE(fe_world_load(NULL, NULL, b.data, b.size, &twin) == FE_ERROR_STATE && !twin);
    FE_TRUE(fe_world_create(NULL, &twin) == FE_OK && fe_world_set_pair_filter(twin, accept, NULL) == FE_OK);
    FE_TRUE(fe_world_restore(twin, NULL, b.data, b.size) == FE_OK && hash_of(twin) == hash_of(world));
    free(b.data);
    destroy(world), destroy(twin);
}

static fe_world *world_on_a_field(fe_asset *out_field)
{
    const float heights[9] = {0.0f, 0.1f, 0.0f, 0.2f, 0.0f, 0.1f, 0.0f, 0.1f, 0.3f};
    fe_world *world;
    fe_store *store = NULL;
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = 3, def.cell_x = def.cell_z = 4.0f, def.heights = heights;
    FE_TRUE(fe_world_create(NULL, &world) == FE_OK && fe_world_get_store(world, &store) == FE_OK);
    FE_TRUE(fe_heightfield_create(store, &def, out_field) == FE_OK);
    fe_geometry field;
    fe_geometry_init(&field, sizeof field);
    field.type = FE_GEOMETRY_HEIGHTFIELD, field.asset = *out_field;
    fe_body_def ground;
    fe_body_def_init(&ground, sizeof ground);
    ground.type = FE_BODY_STATIC;
    fe_body body;
    fe_shape shape;
    FE_TRUE(fe_body_create(world, &ground, &body) == FE_OK);
    FE_TRUE(fe_shape_create(world, body, NULL, &field, &shape) == FE_OK);
    play p;
    play_begin(&p, world);
    part ball = part_sphere(0.3f, 4.0, 1.0, 4.0);
    play_add(&p, &ball);
    for (int32_t i = 0; i < 40; ++i) FE_TRUE(fe_world_step(world, 1.0f / 60.0f) == FE_OK);
    return world;
}

static void assets_go_by_their_keys_or_inside(void **state)
{
    (void)state;
    fe_asset field;
    fe_world *world = world_on_a_field(&field), *twin = NULL;
    fe_store *store = NULL;
    FE_TRUE(fe_world_get_store(world, &store) == FE_OK);
    fe_save_options options;
    fe_save_options_init(&options, sizeof options);
    bytes plain = save(world);
    options.flags = FE_SAVE_ASSETS;
    bytes whole = save_by(world, &options);
    fe_asset_key key, needed;
    FE_TRUE(fe_asset_get_key(store, field, &key) == FE_OK);
    FE_TRUE(fe_asset_get_key(store, field + 1, &key) < 0 && fe_asset_get_key(NULL, field, &key) < 0);
    FE_TRUE(fe_snapshot_get_assets(plain.data, plain.size, &needed, sizeof needed, 1) == 1);
    FE_TRUE(needed.words[0] == key.words[0] && needed.words[1] == key.words[1]);
    FE_TRUE(fe_snapshot_check(plain.data, plain.size, NULL) == FE_OK);
    FE_TRUE(fe_world_load(NULL, NULL, plain.data, plain.size, &twin) == FE_ERROR_STATE && !twin);
    FE_TRUE(fe_world_load(NULL, NULL, whole.data, whole.size, &twin) == FE_OK);
    for (int32_t i = 0; i < 60; ++i) {
        FE_TRUE(hash_of(twin) == hash_of(world));
        FE_TRUE(fe_world_step(world, 1.0f / 60.0f) == FE_OK && fe_world_step(twin, 1.0f / 60.0f) == FE_OK);
    }
    free(plain.data), free(whole.data);
    destroy(world), destroy(twin);
}

static void an_edited_field_is_another_asset(void **state)
{
    (void)state;
    fe_asset field;
    fe_world *world = world_on_a_field(&field);
    fe_store *store = NULL;
    fe_asset_key before, after;
    float height = 0.5f;
    FE_TRUE(fe_world_get_store(world, &store) == FE_OK && fe_asset_get_key(store, field, &before) == FE_OK);
    bytes b = save(world);
    FE_TRUE(fe_heightfield_set_heights(store, field, 1, 1, 1, 1, &height) == FE_OK);
    FE_TRUE(fe_asset_get_key(store, field, &after) == FE_OK && before.words[0] != after.words[0]);
    FE_TRUE(fe_world_restore(world, NULL, b.data, b.size) == FE_ERROR_STATE);
    free(b.data);
    destroy(world);
}

static fe_asset make_level(fe_store *store, int32_t is_mesh, float height)
{
    enum { CORNERS = 4 };
    float heights[CORNERS] = {height, height, height, height};
    float vertices[3 * CORNERS] = {0, height, 0, 0, height, 4, 4, height, 4, 4, height, 0};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    fe_asset asset = 0;
    fe_heightfield_def field;
    fe_mesh_def mesh;
    fe_heightfield_def_init(&field, sizeof field);
    field.rows = field.columns = 2, field.heights = heights, field.cell_x = field.cell_z = 4.0f;
    fe_mesh_def_init(&mesh, sizeof mesh);
    mesh.vertices = vertices, mesh.vertex_count = CORNERS, mesh.indices = indices, mesh.triangle_count = 2;
    if (is_mesh)
        FE_TRUE(fe_mesh_create(store, &mesh, &asset) == FE_OK);
    else
        FE_TRUE(fe_heightfield_create(store, &field, &asset) == FE_OK);
    return asset;
}

static void add_ball(fe_world *world, double y, fe_body *out_body)
{
    fe_body_def def;
    fe_geometry ball;
    fe_shape shape;
    fe_body_def_init(&def, sizeof def);
    def.transform = fe_make_transform(2.0, y, 1.5);
    FE_TRUE(fe_body_create(world, &def, out_body) == FE_OK);
    fe_geometry_sphere(&ball, 0.5f);
    FE_TRUE(fe_shape_create(world, *out_body, NULL, &ball, &shape) == FE_OK);
}

// A ball sleeps on a level ground, which another one stands for, lower or higher: the ball wakes. It falls onto the
// lower one; another ball, which comes later, falls onto the higher one. It sinks by no more than the slop of a contact
// (5 mm), and as much is left for its fall.
static void an_asset_that_stands_for_another_is_met(void **state)
{
    (void)state;
    enum { DRAWS = 20, STEPS = 240 };
    uint32_t seed = 20261128;
    print_message("seed %u\n", (unsigned)seed);
    for (int32_t i = 0; i < DRAWS; ++i) {
        seed = seed * 1664525u + 1013904223u;
        int32_t level_of_other = (int32_t)((seed >> 8) % 80) + 1;
        float height = (float)(seed >> 31 ? level_of_other : -level_of_other) / 10.0f;
        fe_world *world = NULL;
        fe_store *store = NULL;
        fe_body ground, ball;
        fe_shape shape;
        fe_geometry g;
        fe_asset_key key;
        fe_restore_options options;
        int32_t awake;
        FE_TRUE(fe_world_create(NULL, &world) == FE_OK && fe_world_get_store(world, &store) == FE_OK);
        fe_asset level = make_level(store, i % 2, 0.0f), other = make_level(store, i % 2, height);
        FE_TRUE(fe_body_create(world, NULL, &ground) == FE_OK);
        FE_TRUE(fe_body_set_type(world, ground, FE_BODY_STATIC) == FE_OK);
        if (i % 2)
            fe_geometry_mesh(&g, level);
        else
            fe_geometry_heightfield(&g, level);
        FE_TRUE(fe_shape_create(world, ground, NULL, &g, &shape) == FE_OK);
        add_ball(world, 0.5, &ball);
        for (int32_t k = 0; k < STEPS; ++k) FE_TRUE(fe_world_step(world, 1.0f / 60.0f) == FE_OK);
        FE_TRUE(fe_body_get_awake(world, ball, &awake) == FE_OK && !awake);
        bytes b = save(world);
        FE_TRUE(fe_asset_get_key(store, level, &key) == FE_OK);
        fe_restore_options_init(&options, sizeof options);
        options.asset_count = 1, options.keys = &key, options.assets = &other;
        FE_TRUE(fe_world_restore(world, &options, b.data, b.size) == FE_OK);
        FE_TRUE(fe_body_get_awake(world, ball, &awake) == FE_OK && awake);
        if (height > 0.0f) {
            FE_TRUE(fe_body_destroy(world, ball) == FE_OK);
            add_ball(world, (double)height + 3.0, &ball);
        }
        for (int32_t k = 0; k < STEPS; ++k) FE_TRUE(fe_world_step(world, 1.0f / 60.0f) == FE_OK);
        FE_NEAR(body_transform(world, ball).position.y, (double)height + 0.5, 0.01);
        free(b.data);
        destroy(world);
    }
}

// ---- compounds inside ----------------------------------------------------------------------------------------------
static bytes save_with_assets(const fe_world *world)
{
    fe_save_options options;
    fe_save_options_init(&options, sizeof options);
    options.flags = FE_SAVE_ASSETS;
    return save_by(world, &options);
}

// At random moments, where no asset is: the loaded world goes where the saved one goes, and holds as much
static void compounds_are_saved_with_their_contents(void **state)
{
    (void)state;
    enum { DRAWS = 10, STEPS = 20 };
    uint32_t seed = 20261128;
    print_message("seed %u\n", (unsigned)seed);
    for (int32_t i = 0; i < DRAWS; ++i) {
        seed = seed * 1664525u + 1013904223u;
        fe_world *world = make(&script_compounds, 1 + (int32_t)(seed >> 8) % 120), *loaded = NULL;
        bytes b = save_with_assets(world);
        FE_TRUE(fe_world_load(NULL, NULL, b.data, b.size, &loaded) == FE_OK);
        bytes again = save_with_assets(loaded);
        FE_TRUE(again.size <= b.size); // two assets of one content have become one
        for (int32_t k = 0; k < STEPS; ++k) {
            FE_TRUE(fe_world_step(world, 1.0f / 60.0f) == FE_OK && fe_world_step(loaded, 1.0f / 60.0f) == FE_OK);
            FE_TRUE(hash_of(loaded) == hash_of(world));
        }
        FE_TRUE(fe_world_restore(world, NULL, b.data, b.size) == FE_OK); // where all assets are
        FE_TRUE(fe_world_restore(loaded, NULL, again.data, again.size) == FE_OK && hash_of(loaded) == hash_of(world));
        free(b.data), free(again.data);
        destroy(world), destroy(loaded);
    }
}

static double height_at(const fe_world *world, double x)
{
    const fe_dvec3 from = {x, 10.0, 0.5}, down = {0.0, -20.0, 0.0};
    fe_hit hit;
    assert_int_equal(fe_world_raycast(world, &from, &down, NULL, &hit), 1);
    return hit.point.y;
}

// A heightfield that is a shape's, and a compound's part 10 m beside it, twice. The loaded world's is one again: its
// new heights are felt at both places
static void an_edit_is_felt_by_a_loaded_compounds_parts(void **state)
{
    (void)state;
    float heights[4] = {0};
    const float raised[4] = {2.0f, 2.0f, 2.0f, 2.0f};
    fe_heightfield_def d;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = d.columns = 2, d.heights = heights;
    fe_world *world = NULL, *loaded = NULL;
    fe_store *store = NULL;
    fe_asset field, compound;
    fe_body body;
    fe_shape shape;
    fe_geometry g;
    fe_compound_part parts[2];
    FE_TRUE(fe_world_create(NULL, &world) == FE_OK && fe_world_get_store(world, &store) == FE_OK);
    FE_TRUE(fe_heightfield_create(store, &d, &field) == FE_OK);
    for (int32_t i = 0; i < 2; ++i) {
        fe_compound_part_init(parts + i, sizeof *parts);
        fe_geometry_heightfield(&parts[i].geometry, field);
        parts[i].frame.position.x = 10.0f * (float)(i + 1);
    }
    FE_TRUE(fe_compound_create(store, parts, sizeof *parts, 2, &compound) == FE_OK);
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = FE_BODY_STATIC;
    FE_TRUE(fe_body_create(world, &def, &body) == FE_OK);
    fe_geometry_heightfield(&g, field);
    FE_TRUE(fe_shape_create(world, body, NULL, &g, &shape) == FE_OK);
    fe_geometry_compound(&g, compound);
    FE_TRUE(fe_shape_create(world, body, NULL, &g, &shape) == FE_OK);

    bytes b = save_with_assets(world);
    FE_TRUE(fe_world_load(NULL, NULL, b.data, b.size, &loaded) == FE_OK);
    FE_TRUE(fe_world_get_store(loaded, &store) == FE_OK);
    fe_hit hit;
    const fe_dvec3 from = {0.5, 10.0, 0.5}, down = {0.0, -20.0, 0.0};
    assert_int_equal(fe_world_raycast(loaded, &from, &down, NULL, &hit), 1);
    fe_geometry_init(&g, sizeof g);
    FE_TRUE(fe_shape_get_geometry(loaded, hit.shape, &g) == FE_OK);
    FE_TRUE(fe_heightfield_set_heights(store, g.asset, 0, 0, 2, 2, raised) == FE_OK);
    for (int32_t i = 0; i < 3; ++i) {
        FE_NEAR(height_at(world, 0.5 + 10.0 * i), 0.0, 1e-6);
        FE_NEAR(height_at(loaded, 0.5 + 10.0 * i), 2.0, 1e-6);
    }
    free(b.data);
    destroy(world), destroy(loaded);
}

// ---- memory ---------------------------------------------------------------------------------------------------------
static fe_world *world_of(counting *c, bytes from)
{
    fe_allocator allocator;
    fe_world_def def;
    fe_world *world = NULL;
    fe_allocator_init(&allocator, sizeof allocator);
    allocator.user = c, allocator.allocate = counting_allocate, allocator.release = counting_release;
    fe_world_def_init(&def, sizeof def);
    def.allocator = &allocator;
    fe_result result = fe_world_load(&def, NULL, from.data, from.size, &world);
    FE_TRUE(result == FE_OK || (result == FE_ERROR_MEMORY && !world));
    return world;
}

static void each_allocation_may_fail_and_nothing_changes(void **state)
{
    (void)state;
    fe_world *first = make(&script_brief, 20), *second = make(&script_brief, 50);
    bytes a = save(first), b = save(second);
    counting c = {.fail_count = 1};
    fe_world *world = NULL;
    for (c.fail_from = 1; !world; ++c.fail_from) {
        c.calls = 0;
        world = world_of(&c, a);
        if (!world) FE_TRUE(c.blocks == 0 && c.bytes == 0);
    }
    fe_result result = FE_ERROR_MEMORY;
    for (c.fail_from = 1; result != FE_OK; ++c.fail_from) {
        c.calls = 0;
        int64_t blocks = c.blocks, held = c.bytes;
        result = fe_world_restore(world, NULL, b.data, b.size);
        FE_TRUE(result == FE_OK || result == FE_ERROR_MEMORY);
        if (result == FE_OK) break;
        FE_TRUE(c.blocks - blocks <= 1 && c.bytes - held <= 1 << 16); // the scratch of the steps to come
        int64_t calls = c.calls;
        bytes now = save(world);
        FE_TRUE(are_same(now, a) && c.calls == calls); // saving asks for none
        free(now.data);
    }
    c.fail_from = 0;
    bytes now = save(world);
    FE_TRUE(are_same(now, b));
    free(now.data), free(a.data), free(b.data);
    destroy(world), destroy(first), destroy(second);
    FE_TRUE(c.blocks == 0 && c.bytes == 0 && c.wrong == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(saving_says_how_large_it_is_and_writes_no_less),
        cmocka_unit_test(restoring_refuses_what_is_no_snapshot),
        cmocka_unit_test(other_formats_are_refused_by_name),
        cmocka_unit_test(a_snapshot_says_what_is_in_it),
        cmocka_unit_test(an_asset_that_stands_for_another_is_met),
        cmocka_unit_test(compounds_are_saved_with_their_contents),
        cmocka_unit_test(an_edit_is_felt_by_a_loaded_compounds_parts),
        cmocka_unit_test(handles_are_the_saved_worlds_unless_a_new_number_is_asked_for),
        cmocka_unit_test(a_world_with_a_filter_is_restored_where_one_is),
        cmocka_unit_test(assets_go_by_their_keys_or_inside),
        cmocka_unit_test(an_edited_field_is_another_asset),
        cmocka_unit_test(each_allocation_may_fail_and_nothing_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
