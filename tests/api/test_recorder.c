// test_recorder.c - arguments of recorders and players: each error that the header names, and what an error leaves.
#include "fe_test.h"
#include "feather.h"
#include "support/recorded.h"

#include <stdlib.h>
#include <string.h>

static fe_world *new_world(void)
{
    fe_world *world;
    FE_TRUE(fe_world_create(NULL, &world) == FE_OK);
    return world;
}

static fe_recorder_def recorder_def(void)
{
    fe_recorder_def def;
    fe_recorder_def_init(&def, sizeof def);
    return def;
}

static void defaults_are_those_of_the_header(void **state)
{
    (void)state;
    fe_recorder_def def = recorder_def();
    FE_TRUE(def.struct_size == sizeof def && def.flags == FE_RECORD_ASSETS && def.keyframe_steps == 600);
    FE_TRUE(def.buffer_bytes == INT64_C(64) << 20);
    fe_player_def player;
    fe_player_def_init(&player, sizeof player);
    FE_TRUE(player.struct_size == sizeof player && player.worker_count == 1 && player.simd == FE_SIMD_AUTO);
    fe_recorder_def_init(NULL, sizeof def);
    fe_player_def_init(NULL, sizeof player);
    fe_player_info_init(NULL, 8);
    fe_divergence_init(NULL, 8);
}

#define REFUSES(change, expected)                                               \
    do {                                                                        \
        fe_recorder_def def = recorder_def();                                   \
        fe_recorder *none = NULL;                                               \
        change;                                                                 \
        assert_int_equal(fe_recorder_create(world, &def, &none), (expected));   \
        FE_TRUE(none == NULL && strstr(fe_last_error(), "fe_recorder_create")); \
    } while (0)

static void wrong_definitions_are_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_recorder *recorder;
    assert_int_equal(fe_recorder_create(NULL, NULL, &recorder), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_recorder_create(world, NULL, NULL), FE_ERROR_ARGUMENT);
    REFUSES(def.struct_size = 6, FE_ERROR_ARGUMENT);
    REFUSES(def.flags = 64, FE_ERROR_ARGUMENT);
    REFUSES(def.keyframe_steps = -1, FE_ERROR_ARGUMENT);
    REFUSES(def.reserved = 1, FE_ERROR_ARGUMENT);
    REFUSES(def.buffer_bytes = 65535, FE_ERROR_ARGUMENT);
    FE_TRUE(fe_recorder_create(world, NULL, &recorder) == FE_OK);
    REFUSES((void)0, FE_ERROR_STATE); // it has one
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK);
    fe_body bodies[300];
    for (int32_t i = 0; i < 300; ++i) FE_TRUE(fe_body_create(world, NULL, bodies + i) == FE_OK);
    REFUSES(def.buffer_bytes = 65536, FE_ERROR_LIMIT); // the keyframe is larger
    FE_TRUE(fe_recorder_create(world, NULL, &recorder) == FE_OK);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
}

static void wrong_reads_and_notes_are_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_recorder *recorder;
    int64_t size, waits;
    unsigned char bytes[16];
    FE_TRUE(fe_recorder_create(world, NULL, &recorder) == FE_OK);
    assert_int_equal(fe_recorder_read(NULL, bytes, 16, &size), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_recorder_read(recorder, bytes, 16, NULL), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_recorder_read(recorder, NULL, 16, &size), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_recorder_read(recorder, bytes, -1, &size), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_recorder_read(recorder, bytes, 16, &size), FE_ERROR_LIMIT);
    FE_TRUE(size == 40); // the header of the file
    FE_TRUE(fe_recorder_read(recorder, NULL, 0, &waits) == FE_OK && waits > 40);
    assert_int_equal(fe_recorder_note(NULL, 0, "x"), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_recorder_note(recorder, 0, NULL), FE_ERROR_ARGUMENT);
    char *text = malloc(4098);
    memset(text, 'x', 4097);
    text[4097] = 0;
    assert_int_equal(fe_recorder_note(recorder, 0, text), FE_ERROR_ARGUMENT);
    text[4096] = 0;
    assert_int_equal(fe_recorder_note(recorder, 0, text), FE_OK);
    free(text);
    assert_int_equal(fe_recorder_destroy(NULL), FE_ERROR_ARGUMENT);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
}

typedef struct meddler {
    fe_world *world;
    fe_recorder *recorder;
    int32_t asked;
} meddler;

static int32_t meddle(void *user, const fe_filter_pair *pair)
{
    meddler *m = user;
    fe_recorder *other = NULL;
    int64_t size;
    (void)pair;
    m->asked += 1;
    assert_int_equal(fe_recorder_create(m->world, NULL, &other), FE_ERROR_STEPPING);
    assert_int_equal(fe_recorder_destroy(m->recorder), FE_ERROR_STEPPING);
    assert_int_equal(fe_recorder_read(m->recorder, NULL, 0, &size), FE_OK); // whoever reads waits for nobody
    return 1;
}

static void a_step_keeps_its_recorder(void **state)
{
    (void)state;
    meddler m = {.world = new_world()};
    FE_TRUE(fe_recorder_create(m.world, NULL, &m.recorder) == FE_OK);
    FE_TRUE(fe_world_set_pair_filter(m.world, meddle, &m) == FE_OK);
    for (int32_t i = 0; i < 2; ++i) {
        fe_body body;
        fe_shape shape;
        fe_geometry ball;
        fe_shape_def def;
        fe_shape_def_init(&def, sizeof def);
        fe_geometry_sphere(&ball, 0.5f);
        def.pair_filter = 1;
        FE_TRUE(fe_body_create(m.world, NULL, &body) == FE_OK);
        FE_TRUE(fe_shape_create(m.world, body, &def, &ball, &shape) == FE_OK);
    }
    FE_TRUE(fe_world_step(m.world, 0.01f) == FE_OK && m.asked == 1);
    FE_TRUE(fe_recorder_destroy(m.recorder) == FE_OK && fe_world_destroy(m.world) == FE_OK);
}

static void wrong_players_are_refused(void **state)
{
    (void)state;
    fe_player_def def;
    fe_player *player = NULL;
    fe_store *store;
    fe_player_def_init(&def, sizeof def);
    assert_int_equal(fe_player_create(NULL, NULL), FE_ERROR_ARGUMENT);
    def.worker_count = 0;
    assert_int_equal(fe_player_create(&def, &player), FE_ERROR_ARGUMENT);
    def.worker_count = 1, def.simd = 77;
    assert_int_equal(fe_player_create(&def, &player), FE_ERROR_ARGUMENT);
    def.simd = FE_SIMD_AUTO, def.reserved = 1;
    assert_int_equal(fe_player_create(&def, &player), FE_ERROR_ARGUMENT);
    def.reserved = 0;
    FE_TRUE(fe_store_create(NULL, &store) == FE_OK && fe_store_destroy(store) == FE_OK);
    def.store = store;
    assert_int_equal(fe_player_create(&def, &player), FE_ERROR_STALE);
    FE_TRUE(player == NULL);
    assert_int_equal(fe_player_destroy(NULL), FE_ERROR_ARGUMENT);
}

static void an_empty_player_waits(void **state)
{
    (void)state;
    fe_player *player;
    const fe_world *world;
    fe_world *released;
    fe_divergence divergence;
    fe_player_info info;
    fe_note note;
    FE_TRUE(fe_player_create(NULL, &player) == FE_OK);
    assert_int_equal(fe_player_step(player), FE_END);
    assert_int_equal(fe_player_step(NULL), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_seek(player, 3), FE_END);
    assert_int_equal(fe_player_seek(player, -1), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_seek(NULL, 1), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_get_world(player, &world), FE_ERROR_STATE);
    assert_int_equal(fe_player_get_world(NULL, &world), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_get_world(player, NULL), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_release(player, &released), FE_ERROR_STATE);
    assert_int_equal(fe_player_release(NULL, &released), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_feed(player, NULL, 1), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_feed(player, "x", -1), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_feed(NULL, "x", 1), FE_ERROR_ARGUMENT);
    FE_TRUE(fe_player_feed(player, NULL, 0) == FE_OK);
    fe_divergence_init(&divergence, sizeof divergence);
    assert_int_equal(fe_player_get_divergence(player, &divergence), FE_ERROR_STATE);
    assert_int_equal(fe_player_get_divergence(player, NULL), FE_ERROR_ARGUMENT);
    fe_player_info_init(&info, sizeof info);
    FE_TRUE(fe_player_get_info(player, &info) == FE_OK && info.library == 0 && info.bytes == 0);
    info.struct_size = 5;
    assert_int_equal(fe_player_get_info(player, &info), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_get_info(NULL, &info), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_get_notes(player, NULL, 0, 0), 0);
    assert_int_equal(fe_player_get_notes(player, &note, 8, 1), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_get_notes(NULL, NULL, 0, 0), FE_ERROR_ARGUMENT);
    const char noise[64] = "no recording at all, whoever says so";
    assert_int_equal(fe_player_feed(player, noise, sizeof noise), FE_ERROR_DATA);
    assert_int_equal(fe_player_feed(player, noise, sizeof noise), FE_ERROR_DATA); // once for all
    FE_TRUE(fe_player_destroy(player) == FE_OK);
}

static void a_step_before_the_first_is_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    for (int32_t i = 0; i < 5; ++i) FE_TRUE(fe_world_step(world, 0.01f) == FE_OK);
    fe_recorder *recorder = recorded_begin(world, FE_RECORD_ASSETS, 600);
    recorded r = {0};
    for (int32_t i = 0; i < 5; ++i) FE_TRUE(fe_world_step(world, 0.01f) == FE_OK);
    recorded_read(&r, recorder);
    played p = recorded_play(r.bytes, r.size, 1, FE_SIMD_AUTO, 0);
    assert_int_equal(p.result, FE_END);
    assert_int_equal(fe_player_seek(p.player, 4), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_player_seek(p.player, 5), FE_OK);
    assert_int_equal(fe_player_seek(p.player, 10), FE_OK);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
    recorded_free(&r);
}

// What the recording does not hold is looked for in the store
static void assets_by_key_are_found_in_the_store(void **state)
{
    (void)state;
    fe_store *store;
    fe_world *world;
    fe_world_def world_def;
    fe_asset hull;
    fe_hull_def hull_def;
    const float points[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    FE_TRUE(fe_store_create(NULL, &store) == FE_OK);
    fe_world_def_init(&world_def, sizeof world_def);
    world_def.store = store;
    FE_TRUE(fe_world_create(&world_def, &world) == FE_OK);
    fe_hull_def_init(&hull_def, sizeof hull_def);
    hull_def.points = points, hull_def.point_count = 4;
    FE_TRUE(fe_hull_create(store, &hull_def, &hull) == FE_OK);
    fe_recorder *recorder = recorded_begin(world, FE_RECORD_NONE, 600);
    recorded r = {0};
    fe_body body;
    fe_shape shape;
    fe_geometry geometry;
    fe_geometry_hull(&geometry, hull);
    FE_TRUE(fe_body_create(world, NULL, &body) == FE_OK);
    FE_TRUE(fe_shape_create(world, body, NULL, &geometry, &shape) == FE_OK);
    FE_TRUE(fe_world_step(world, 0.01f) == FE_OK);
    recorded_read(&r, recorder);
    played p = recorded_play(r.bytes, r.size, 1, FE_SIMD_AUTO, 0);
    assert_int_equal(p.result, FE_ERROR_STATE);
    FE_TRUE(strstr(fe_last_error(), "key") != NULL);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    fe_player_def def;
    fe_player *player;
    fe_player_def_init(&def, sizeof def);
    def.store = store;
    FE_TRUE(fe_player_create(&def, &player) == FE_OK && fe_player_feed(player, r.bytes, r.size) == FE_OK);
    if (fe_player_step(player) != FE_OK) fail_msg("%s", fe_last_error());
    assert_int_equal(fe_player_step(player), FE_END);
    FE_TRUE(fe_player_destroy(player) == FE_OK);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
    FE_TRUE(fe_store_destroy(store) == FE_OK);
    recorded_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_those_of_the_header),   cmocka_unit_test(wrong_definitions_are_refused),
        cmocka_unit_test(wrong_reads_and_notes_are_refused),  cmocka_unit_test(a_step_keeps_its_recorder),
        cmocka_unit_test(wrong_players_are_refused),          cmocka_unit_test(an_empty_player_waits),
        cmocka_unit_test(a_step_before_the_first_is_refused), cmocka_unit_test(assets_by_key_are_found_in_the_store),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
