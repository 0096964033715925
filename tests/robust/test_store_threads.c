// test_store_threads.c - every way in which a world comes to use a store, and leaves it, beside every call that edits
// what the store holds.
//
// For ThreadSanitizer above all. Makers create, clone, load, restore, set back, batch, record and play worlds of one
// store, each on a thread of its own. Editors write heights and materials of what these worlds stand on, and make and
// destroy assets. The promise of the header: each call does what it says, or is refused with FE_ERROR_BUSY or
// FE_ERROR_STEPPING and changes nothing. The first argument is the number of rounds of each maker, the second the seed.
#include "api/asset_test.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#if defined(FE_SANITIZED)
enum { ROUNDS = 12 };
#else
enum { ROUNDS = 60 };
#endif
enum { MAKERS = 3, EDITORS = 2, SIDE = 9, SAMPLES = SIDE * SIDE, ROOM = 1 << 18, BATCH = 3, MESH_MATERIALS = 2 };

static int32_t rounds = ROUNDS;
static uint32_t first_seed = 1;

// ---- what all threads share ----------------------------------------------------------------------------------------
typedef struct commons {
    fe_store *store;
    fe_asset field, mesh, compound;
    unsigned char *snapshot, *recording; // of a world of another store, with its assets
    int64_t snapshot_size, recording_size;
    _Atomic int32_t makers; // that are at work
    _Atomic int32_t edits;  // that were made
    _Atomic int32_t faults; // cmocka's failures belong to the main thread
} commons;

static commons all;

static void expect(int32_t holds, const char *call)
{
    if (!holds && atomic_fetch_add(&all.faults, 1) == 0) print_error("%s: %s\n", call, fe_last_error());
}

static int32_t is_refused(int64_t result) { return result == FE_ERROR_BUSY || result == FE_ERROR_STEPPING; }

// An editor is inside for a moment
#define DO(call)                      \
    do {                              \
        int64_t result_;              \
        do result_ = (int64_t)(call); \
        while (is_refused(result_));  \
        expect(result_ >= 0, #call);  \
    } while (0)

static fe_asset make_field(fe_store *store)
{
    float heights[SAMPLES] = {0};
    fe_heightfield_def d;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = d.columns = SIDE, d.heights = heights;
    fe_asset asset = 0;
    expect(fe_heightfield_create(store, &d, &asset) == FE_OK, "fe_heightfield_create");
    return asset;
}

static void materials_of(fe_material *m, float friction)
{
    for (int32_t i = 0; i < MESH_MATERIALS; ++i) {
        fe_material_init(m + i);
        m[i].static_friction = m[i].dynamic_friction = friction;
    }
}

static fe_asset make_mesh(fe_store *store)
{
    static const float corners[] = {0, 0, 20, 8, 0, 20, 8, 0, 28, 0, 0, 28};
    static const uint32_t indices[] = {0, 2, 1, 0, 3, 2};
    static const uint8_t kinds[] = {0, 1};
    fe_material materials[MESH_MATERIALS];
    materials_of(materials, 0.5f);
    fe_mesh_def d;
    fe_mesh_def_init(&d, sizeof d);
    d.vertex_count = 4, d.triangle_count = 2, d.vertices = corners, d.indices = indices;
    d.triangle_materials = kinds, d.materials = materials, d.material_count = MESH_MATERIALS;
    fe_asset asset = 0;
    expect(fe_mesh_create(store, &d, &asset) == FE_OK, "fe_mesh_create");
    return asset;
}

static fe_asset make_compound(fe_store *store, fe_asset mesh)
{
    fe_compound_part parts[2];
    for (int32_t i = 0; i < 2; ++i) fe_compound_part_init(parts + i, sizeof *parts);
    fe_geometry_mesh(&parts[0].geometry, mesh);
    fe_geometry_box(&parts[1].geometry, 1.0f, 1.0f, 1.0f);
    fe_asset asset = 0;
    expect(fe_compound_create(store, parts, sizeof *parts, 2, &asset) == FE_OK, "fe_compound_create");
    return asset;
}

static void add(fe_world *world, int32_t type, double x, double z, const fe_geometry *geometry)
{
    fe_body_def def;
    fe_body body = 0;
    fe_shape shape;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform = fe_make_transform(x, type == FE_BODY_STATIC ? 0.0 : 0.6, z);
    DO(fe_body_create(world, &def, &body));
    DO(fe_shape_create(world, body, NULL, geometry, &shape));
}

static void fill(fe_world *world, fe_asset field, fe_asset mesh, fe_asset compound)
{
    fe_geometry g;
    fe_geometry_heightfield(&g, field);
    add(world, FE_BODY_STATIC, 0, 0, &g);
    fe_geometry_mesh(&g, mesh);
    add(world, FE_BODY_STATIC, 0, 0, &g);
    g.scale = (fe_vec3){2.0f, 1.0f, 1.0f};
    add(world, FE_BODY_STATIC, 20, 0, &g);
    fe_geometry_compound(&g, compound);
    add(world, FE_BODY_STATIC, 60, 0, &g);
    fe_geometry_box(&g, 0.4f, 0.4f, 0.4f);
    for (int32_t i = 0; i < 4; ++i) add(world, FE_BODY_DYNAMIC, 2 + i, 3, &g);
    add(world, FE_BODY_DYNAMIC, 4, 24, &g);
    add(world, FE_BODY_DYNAMIC, 64, 24, &g);
}

static void advance(fe_world *world, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) DO(fe_world_step(world, 1.0f / 60.0f));
}

// ---- what a maker does ---------------------------------------------------------------------------------------------
typedef struct maker {
    fe_world *world; // of the round
    uint32_t seed;
    unsigned char bytes[ROOM];
} maker;

static fe_world *create(void)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = all.store;
    fe_world *world = NULL;
    DO(fe_world_create(&def, &world));
    return world;
}

static void clone_it(maker *m)
{
    fe_world *clone = NULL;
    DO(fe_world_clone(m->world, NULL, &clone));
    advance(clone, 2);
    DO(fe_world_destroy(clone));
}

static void load_it(maker *m)
{
    (void)m;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = all.store;
    fe_world *loaded = NULL;
    DO(fe_world_load(&def, NULL, all.snapshot, all.snapshot_size, &loaded));
    advance(loaded, 2);
    DO(fe_world_destroy(loaded));
}

// On its own assets, as they are now: an edit that comes between makes one of them missing
static void load_beside(const unsigned char *bytes, int64_t size)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = all.store;
    fe_world *loaded = NULL;
    fe_result result = fe_world_load(&def, NULL, bytes, size, &loaded);
    expect(result == FE_OK || result == FE_ERROR_STATE, "fe_world_load");
    if (result != FE_OK) return;
    advance(loaded, 1);
    DO(fe_world_destroy(loaded));
}

static void restore_it(maker *m)
{
    int64_t size;
    do size = fe_world_save(m->world, NULL, m->bytes, ROOM);
    while (is_refused(size));
    expect(size > 0 && size <= ROOM, "fe_world_save");
    load_beside(m->bytes, size);
    advance(m->world, 2);
    int64_t result;
    do result = fe_world_restore(m->world, NULL, m->bytes, size);
    while (is_refused(result));
    expect(result == FE_OK || result == FE_ERROR_STATE, "fe_world_restore");
    advance(m->world, 2);
}

static void set_it_back(maker *m)
{
    fe_state *state = NULL;
    DO(fe_state_create(m->world, NULL, &state));
    advance(m->world, 2);
    // heights that were edited since are put back for every world, or for none
    int64_t result = fe_world_set_state(m->world, state);
    expect(result == FE_OK || is_refused(result), "fe_world_set_state");
    expect(fe_state_destroy(state) == FE_OK, "fe_state_destroy");
}

static void keep_history(maker *m)
{
    fe_history *history = NULL;
    DO(fe_history_create(m->world, NULL, &history));
    for (int32_t i = 0; i < 3; ++i) {
        advance(m->world, 1);
        DO(fe_history_keep(history, i));
    }
    int64_t result = fe_history_restore(history, 1);
    expect(result == FE_OK || is_refused(result), "fe_history_restore");
    DO(fe_history_destroy(history));
}

static void batch_it(maker *m)
{
    fe_batch *batch = NULL;
    fe_batch_def def;
    fe_batch_def_init(&def, sizeof def);
    def.world_count = BATCH, def.worker_count = 2;
    DO(fe_batch_create(m->world, &def, &batch));
    DO(fe_batch_step(batch, 1.0f / 60.0f, 2, NULL, NULL));
    int32_t failed = fe_batch_reset(batch, NULL, NULL, NULL); // counts worlds that would need what others stand on
    expect(failed >= 0 || is_refused(failed), "fe_batch_reset");
    DO(fe_batch_step(batch, 1.0f / 60.0f, 1, NULL, NULL));
    DO(fe_batch_destroy(batch));
}

static void record_it(maker *m)
{
    fe_recorder *recorder = NULL;
    fe_recorder_def def;
    fe_recorder_def_init(&def, sizeof def);
    def.keyframe_steps = 1;
    DO(fe_recorder_create(m->world, &def, &recorder));
    advance(m->world, 2);
    int64_t size;
    expect(fe_recorder_read(recorder, NULL, 0, &size) == FE_OK, "fe_recorder_read");
    DO(fe_recorder_destroy(recorder));
}

static void play_it(maker *m)
{
    (void)m;
    fe_player_def def;
    fe_player_def_init(&def, sizeof def);
    def.store = all.store;
    fe_player *player = NULL;
    DO(fe_player_create(&def, &player));
    expect(fe_player_feed(player, all.recording, all.recording_size) == FE_OK, "fe_player_feed");
    fe_result result;
    do result = fe_player_step(player);
    while (result == FE_OK);
    expect(result == FE_END, "fe_player_step");
    expect(fe_player_destroy(player) == FE_OK, "fe_player_destroy");
}

static void ask_it(maker *m)
{
    const fe_dvec3 from = {4.0, 5.0, 4.0};
    const fe_dvec3 down = {0.0, -9.0, 0.0};
    fe_hit hit;
    DO(fe_world_raycast(m->world, &from, &down, NULL, &hit));
    fe_store *store = NULL;
    DO(fe_world_get_store(m->world, &store));
    expect(store == all.store, "fe_world_get_store");
    DO(fe_world_optimize(m->world));
}

typedef void edge(maker *m);
static edge *const edges[] = {clone_it, load_it,   restore_it, set_it_back, keep_history,
                              batch_it, record_it, play_it,    ask_it};
enum { EDGES = sizeof edges / sizeof *edges };

static uint32_t draw(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static void *make_worlds(void *argument)
{
    maker *m = argument;
    for (int32_t i = 0; i < rounds; ++i) {
        m->world = create();
        if (i % 2) fill(m->world, all.field, all.mesh, all.compound);
        for (int32_t k = 0; k < EDGES; ++k) edges[(i % 2) ? draw(&m->seed) % EDGES : (uint32_t)k](m);
        DO(fe_world_destroy(m->world));
    }
    atomic_fetch_sub(&all.makers, 1);
    return NULL;
}

// ---- what an editor does -------------------------------------------------------------------------------------------
static void count_edit(int64_t result, const char *call)
{
    expect(result == FE_OK || is_refused(result), call);
    atomic_fetch_add(&all.edits, result == FE_OK);
}

static void read_all(unsigned char *bytes)
{
    float heights[SAMPLES];
    int64_t size;
    fe_asset_key key;
    fe_mesh_triangle triangle;
    fe_compound_info info;
    fe_mesh_triangle_init(&triangle, sizeof triangle);
    fe_compound_info_init(&info, sizeof info);
    expect(fe_heightfield_get_heights(all.store, all.field, 0, 0, SIDE, SIDE, heights) == FE_OK, "get_heights");
    expect(fe_mesh_get_triangle(all.store, all.mesh, 1, &triangle) == FE_OK, "fe_mesh_get_triangle");
    expect(fe_compound_get_info(all.store, all.compound, &info) == FE_OK, "fe_compound_get_info");
    expect(fe_asset_get_key(all.store, all.compound, &key) == FE_OK, "fe_asset_get_key");
    expect(fe_asset_save(all.store, all.compound, bytes, ROOM) > 0, "fe_asset_save");
    expect(fe_store_get_bytes(all.store, &size) == FE_OK, "fe_store_get_bytes");
    expect(fe_store_destroy(all.store) == FE_ERROR_STATE, "fe_store_destroy"); // the test's own world uses it
}

static void *edit(void *argument)
{
    maker *m = argument;
    while (atomic_load(&all.makers) > 0) {
        const float height = 0.01f * (float)(draw(&m->seed) % 10); // of a corner where nobody is
        fe_material materials[MESH_MATERIALS];
        materials_of(materials, 0.1f * (float)(1 + draw(&m->seed) % 9));
        count_edit(fe_heightfield_set_heights(all.store, all.field, SIDE - 1, SIDE - 1, 1, 1, &height), "set_heights");
        count_edit(fe_mesh_set_materials(all.store, all.mesh, materials, 0, MESH_MATERIALS), "fe_mesh_set_materials");
        if (draw(&m->seed) % 4) continue;
        fe_asset mesh = make_mesh(all.store), compound = make_compound(all.store, mesh);
        expect(fe_asset_destroy(all.store, mesh) == FE_OK, "fe_asset_destroy");
        expect(fe_asset_destroy(all.store, compound) == FE_OK, "fe_asset_destroy");
        read_all(m->bytes);
    }
    return NULL;
}

// ---- all at once ---------------------------------------------------------------------------------------------------
// A snapshot and a recording of a world that stands on equal assets of another store
static void take_bytes(void)
{
    fe_store *store = new_store(NULL);
    fe_asset field = make_field(store), mesh = make_mesh(store);
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = store;
    fe_world *world = NULL;
    fe_recorder *recorder = NULL;
    OK(fe_world_create(&def, &world));
    fill(world, field, mesh, make_compound(store, mesh));
    OK(fe_recorder_create(world, NULL, &recorder));
    advance(world, 4);
    fe_save_options options;
    fe_save_options_init(&options, sizeof options);
    options.flags = FE_SAVE_ASSETS;
    all.snapshot_size = fe_world_save(world, &options, all.snapshot, ROOM);
    FE_TRUE(all.snapshot_size > 0 && all.snapshot_size <= ROOM);
    OK(fe_recorder_read(recorder, all.recording, ROOM, &all.recording_size));
    OK(fe_recorder_destroy(recorder));
    OK(fe_world_destroy(world));
    OK(fe_store_destroy(store));
}

static void worlds_come_and_go_beside_edits(void **state)
{
    (void)state;
    static maker threads[MAKERS + EDITORS];
    pthread_t ids[MAKERS + EDITORS];
    print_message("seed %u, %d rounds\n", (unsigned)first_seed, (int)rounds);
    all.snapshot = malloc(ROOM), all.recording = malloc(ROOM);
    take_bytes();
    all.store = new_store(NULL);
    all.field = make_field(all.store), all.mesh = make_mesh(all.store);
    all.compound = make_compound(all.store, all.mesh);
    fe_world *own = create();
    atomic_store(&all.makers, MAKERS);
    for (int32_t i = 0; i < MAKERS + EDITORS; ++i) {
        threads[i].seed = first_seed + 7919u * (uint32_t)i;
        assert_int_equal(pthread_create(ids + i, NULL, i < MAKERS ? make_worlds : edit, threads + i), 0);
    }
    for (int32_t i = 0; i < MAKERS + EDITORS; ++i) pthread_join(ids[i], NULL);
    assert_int_equal(atomic_load(&all.faults), 0);
    FE_TRUE(atomic_load(&all.edits) > 0);
    OK(fe_world_destroy(own));
    OK(fe_store_destroy(all.store));
    free(all.snapshot);
    free(all.recording);
}

int main(int argc, char **argv)
{
    if (argc > 1) rounds = atoi(argv[1]);
    if (argc > 2) first_seed = (uint32_t)strtoul(argv[2], NULL, 0);
    const struct CMUnitTest tests[] = {cmocka_unit_test(worlds_come_and_go_beside_edits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
