// test_replay.c - recordings that something happened to: altered, cut, kept short, played backwards, or made with a
// filter, a restore, an edited ground; and what goes wrong is named.
#include "core/bytes.h"
#include "fe_test.h"
#include "recording/recorder.h"
#include "recording/ops.h"
#include "robust/counting_allocator.h"
#include "support/play.h"
#include "support/recorded.h"

#include <stdlib.h>
#include <string.h>

static const float dt = 1.0f / 60.0f;

static fe_world *new_world(const fe_allocator *allocator)
{
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.number = 5, def.allocator = allocator;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    return world;
}

static fe_body add_box(fe_world *world, double x, double y, double z, int32_t judged)
{
    fe_body_def def;
    fe_shape_def shape_def;
    fe_geometry box;
    fe_body body;
    fe_shape shape;
    fe_body_def_init(&def, sizeof def);
    fe_shape_def_init(&shape_def, sizeof shape_def);
    fe_geometry_box(&box, 0.5f, 0.5f, 0.5f);
    def.transform.position = (fe_dvec3){x, y, z};
    shape_def.pair_filter = judged;
    FE_TRUE(fe_body_create(world, &def, &body) == FE_OK);
    FE_TRUE(fe_shape_create(world, body, &shape_def, &box, &shape) == FE_OK);
    return body;
}

static void add_ground(fe_world *world)
{
    fe_body_def def;
    fe_geometry plane;
    fe_body body;
    fe_shape shape;
    fe_body_def_init(&def, sizeof def);
    fe_geometry_plane(&plane, 0.0f, 1.0f, 0.0f, 0.0f);
    def.type = FE_BODY_STATIC;
    FE_TRUE(fe_body_create(world, &def, &body) == FE_OK);
    FE_TRUE(fe_shape_create(world, body, NULL, &plane, &shape) == FE_OK);
}

static void steps(fe_world *world, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) FE_TRUE(fe_world_step(world, dt) == FE_OK);
}

static uint64_t hash_of(const fe_world *world)
{
    uint32_t words[2];
    FE_TRUE(fe_world_hash(world, words) == FE_OK);
    return words[0] | (uint64_t)words[1] << 32;
}

// Six boxes fall on one another; the fourth gets a velocity before step 11
static recorded falling(uint32_t flags, int32_t count, fe_body *out_body, uint64_t *out_hash)
{
    fe_world *world = new_world(NULL);
    fe_recorder *recorder = recorded_begin(world, flags, 25);
    recorded r = {0};
    add_ground(world);
    fe_body bodies[6];
    for (int32_t i = 0; i < 6; ++i) bodies[i] = add_box(world, 0.1 * i, 1.0 + 1.5 * i, 0.0, 0);
    steps(world, 10);
    fe_vec3 velocity = {1.5f, 0.25f, -2.5f};
    FE_TRUE(fe_body_set_linear_velocity(world, bodies[3], &velocity) == FE_OK);
    for (int32_t i = 0; i < count - 10; ++i) {
        if (i % 8 == 0) recorded_read(&r, recorder);
        steps(world, 1);
    }
    recorded_read(&r, recorder);
    if (out_body) *out_body = bodies[3];
    if (out_hash) *out_hash = hash_of(world);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
    return r;
}

// ---- chunks of a file ----------------------------------------------------------------------------------------------
static uint64_t u64_at(const unsigned char *at) { return fe__take_u64(&at); }
static uint32_t u32_at(const unsigned char *at) { return fe__take_u32(&at); }
static int64_t chunk_size(const unsigned char *chunk)
{
    return FE__CHUNK_HEADER + ((int64_t)u64_at(chunk + 8) + 7) / 8 * 8;
}

// Somebody who knows the sums
static void mend(unsigned char *bytes, int64_t size)
{
    for (int64_t at = FE__RECORDING_HEADER; at + FE__CHUNK_HEADER <= size; at += chunk_size(bytes + at)) {
        if (chunk_size(bytes + at) < 0 || at + chunk_size(bytes + at) > size) return;
        fe__put_u64(bytes + at + 16, fe__chunk_sum(bytes + at, bytes + at + FE__CHUNK_HEADER));
    }
}

static unsigned char *copy_of(const recorded *r)
{
    unsigned char *copy = malloc((size_t)r->size);
    FE_TRUE(copy != NULL);
    return memcpy(copy, r->bytes, (size_t)r->size);
}

static fe_divergence divergence_of(const fe_player *player)
{
    fe_divergence d;
    fe_divergence_init(&d, sizeof d);
    FE_TRUE(fe_player_get_divergence(player, &d) == FE_OK);
    return d;
}

// ---- divergence ----------------------------------------------------------------------------------------------------
// The argument of the only call of its kind, one unit in the last place of one component further
static int32_t nudge(unsigned char *bytes, int64_t size, const fe_vec3 *velocity, int32_t component)
{
    for (int64_t at = 0; at + (int64_t)sizeof *velocity <= size; ++at) {
        if (memcmp(bytes + at, velocity, sizeof *velocity) != 0) continue;
        unsigned char *word = bytes + at + 4 * component;
        fe__put_u32(word, u32_at(word) + 1);
        mend(bytes, size);
        return 1;
    }
    return 0;
}

static void one_bit_of_a_velocity_is_named(void **state)
{
    (void)state;
    fe_body body;
    recorded r = falling(FE_RECORD_ASSETS | FE_RECORD_FINE, 40, &body, NULL);
    const fe_vec3 velocity = {1.5f, 0.25f, -2.5f};
    static const char *const names[] = {"x", "y", "z"};
    for (int32_t k = 0; k < 3; ++k) {
        unsigned char *copy = copy_of(&r);
        FE_TRUE(nudge(copy, r.size, &velocity, k));
        played p = recorded_play(copy, r.size, 1, FE_SIMD_AUTO, 0);
        assert_int_equal(p.result, FE_ERROR_DIVERGED);
        fe_divergence d = divergence_of(p.player);
        assert_int_equal(d.type, FE_DIVERGENCE_STEP);
        assert_int_equal(d.step, 11);
        FE_TRUE(d.body == body);
        FE_TRUE(d.component == k);
        assert_string_equal(d.field, "linear velocity");
        FE_TRUE(strstr(d.text, "step 11") && strstr(d.text, d.field) && strstr(d.text, names[k]));
        FE_TRUE(fe_player_step(p.player) == FE_OK); // it goes on
        FE_TRUE(fe_player_destroy(p.player) == FE_OK);
        free(copy);
    }
    recorded_free(&r);
}

static void without_traces_the_step_is_named(void **state)
{
    (void)state;
    recorded r = falling(FE_RECORD_ASSETS, 40, NULL, NULL);
    FE_TRUE(nudge(r.bytes, r.size, &(fe_vec3){1.5f, 0.25f, -2.5f}, 1));
    played p = recorded_play(r.bytes, r.size, 1, FE_SIMD_AUTO, 0);
    assert_int_equal(p.result, FE_ERROR_DIVERGED);
    fe_divergence d = divergence_of(p.player);
    assert_int_equal(d.type, FE_DIVERGENCE_STEP);
    assert_int_equal(d.step, 11);
    FE_TRUE(d.body == 0 && d.component == -1);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    recorded_free(&r);
}

static void another_handle_is_named(void **state)
{
    (void)state;
    fe_body body;
    recorded r = falling(FE_RECORD_ASSETS, 40, &body, NULL);
    unsigned char handle[8];
    fe__put_u64(handle, body);
    int32_t found = 0;
    for (int64_t at = 0; at + 8 <= r.size && !found; ++at)
        if (memcmp(r.bytes + at, handle, sizeof handle) == 0) found = 1, r.bytes[at] ^= 2;
    FE_TRUE(found);
    mend(r.bytes, r.size);
    played p = recorded_play(r.bytes, r.size, 1, FE_SIMD_AUTO, 0);
    assert_int_equal(p.result, FE_ERROR_DIVERGED);
    fe_divergence d = divergence_of(p.player);
    assert_int_equal(d.type, FE_DIVERGENCE_CALL);
    assert_string_equal(d.field, "fe_body_create");
    FE_TRUE(d.body == body);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    recorded_free(&r);
}

// A number of a sleeping body that no step reads: the next keyframe tells
static void keyframes_compare_all(void **state)
{
    (void)state;
    fe_world *world = new_world(NULL);
    add_ground(world);
    fe_body body = add_box(world, 0.0, 3.0, 0.0, 0);
    fe_recorder *recorder = recorded_begin(world, FE_RECORD_ASSETS, 10);
    recorded r = {0};
    FE_TRUE(fe_body_set_user_data(world, body, UINT64_C(0x1234567812345678)) == FE_OK);
    steps(world, 10);
    recorded_read(&r, recorder);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
    int32_t found = 0;
    for (int64_t at = 0; at + 8 <= r.size && !found; ++at)
        if (u64_at(r.bytes + at) == UINT64_C(0x1234567812345678)) found = 1, r.bytes[at] ^= 1;
    FE_TRUE(found);
    mend(r.bytes, r.size);
    played p = recorded_play(r.bytes, r.size, 1, FE_SIMD_AUTO, 0);
    assert_int_equal(p.result, FE_ERROR_DIVERGED);
    fe_divergence d = divergence_of(p.player);
    assert_int_equal(d.type, FE_DIVERGENCE_KEYFRAME);
    assert_int_equal(d.step, 10);
    assert_string_equal(d.field, "bodies");
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    recorded_free(&r);
}

// ---- places --------------------------------------------------------------------------------------------------------
static void seeks_both_ways(void **state)
{
    (void)state;
    enum { LAST = 120 };
    recorded r = falling(FE_RECORD_ASSETS, LAST, NULL, NULL);
    uint64_t hashes[LAST + 1] = {0};
    fe_player *player;
    FE_TRUE(fe_player_create(NULL, &player) == FE_OK);
    FE_TRUE(fe_player_feed(player, r.bytes, r.size) == FE_OK);
    for (int32_t step = 1; step <= LAST; ++step) {
        FE_TRUE(fe_player_step(player) == FE_OK);
        hashes[step] = recorded_hash(player);
    }
    assert_int_equal(fe_player_step(player), FE_END);
    for (int32_t i = 0, step = LAST; i < 60; ++i) {
        step = (step * 7 + 31) % LAST + 1;
        FE_TRUE(fe_player_seek(player, step) == FE_OK);
        FE_TRUE(recorded_hash(player) == hashes[step]);
    }
    for (int32_t step = LAST; step > 0; --step) { // backwards
        FE_TRUE(fe_player_seek(player, step) == FE_OK);
        FE_TRUE(recorded_hash(player) == hashes[step]);
    }
    assert_int_equal(fe_player_seek(player, LAST + 5), FE_END);
    FE_TRUE(recorded_hash(player) == hashes[LAST]);
    FE_TRUE(fe_player_seek(player, 0) == FE_OK); // where it began
    FE_TRUE(fe_player_destroy(player) == FE_OK);
    recorded_free(&r);
}

static void a_released_world_goes_on_alone(void **state)
{
    (void)state;
    uint64_t hash;
    recorded r = falling(FE_RECORD_ASSETS, 60, NULL, &hash);
    fe_player *player;
    FE_TRUE(fe_player_create(NULL, &player) == FE_OK);
    FE_TRUE(fe_player_feed(player, r.bytes, r.size) == FE_OK);
    FE_TRUE(fe_player_seek(player, 40) == FE_OK);
    fe_world *world;
    const fe_world *none;
    FE_TRUE(fe_player_release(player, &world) == FE_OK);
    assert_int_equal(fe_player_get_world(player, &none), FE_ERROR_STATE);
    assert_int_equal(fe_player_step(player), FE_ERROR_STATE);
    steps(world, 20);
    FE_TRUE(hash_of(world) == hash);
    FE_TRUE(fe_player_seek(player, 60) == FE_OK && recorded_hash(player) == hash);
    FE_TRUE(fe_player_destroy(player) == FE_OK && fe_world_destroy(world) == FE_OK);
    recorded_free(&r);
}

static fe_world *writable(const fe_player *player)
{
    const fe_world *world;
    FE_TRUE(fe_player_get_world(player, &world) == FE_OK);
    return (fe_world *)(uintptr_t)world; // as a host would that casts const away
}

static void a_played_world_is_only_read(void **state)
{
    (void)state;
    uint64_t hash;
    fe_body body;
    recorded r = falling(FE_RECORD_ASSETS, 60, &body, &hash);
    fe_player *player;
    FE_TRUE(fe_player_create(NULL, &player) == FE_OK);
    FE_TRUE(fe_player_feed(player, r.bytes, r.size) == FE_OK);
    FE_TRUE(fe_player_seek(player, 40) == FE_OK);
    fe_world *world = writable(player), *clone;
    uint64_t here = hash_of(world);
    fe_vec3 still = {0.0f, 0.0f, 0.0f};
    fe_body made;
    fe_recorder *recorder;
    fe_history *history;
    assert_int_equal(fe_world_step(world, dt), FE_ERROR_STATE);
    assert_int_equal(fe_body_create(world, NULL, &made), FE_ERROR_STATE);
    assert_int_equal(fe_body_set_linear_velocity(world, body, &still), FE_ERROR_STATE);
    assert_int_equal(fe_body_destroy(world, body), FE_ERROR_STATE);
    assert_int_equal(fe_world_set_pair_filter(world, NULL, NULL), FE_ERROR_STATE);
    assert_int_equal(fe_recorder_create(world, NULL, &recorder), FE_ERROR_STATE);
    assert_int_equal(fe_history_create(world, NULL, &history), FE_ERROR_STATE);
    assert_int_equal(fe_world_destroy(world), FE_ERROR_STATE);
    FE_TRUE(strstr(fe_last_error(), "clone") != NULL);
    FE_TRUE(hash_of(world) == here);
    FE_TRUE(fe_world_clone(world, NULL, &clone) == FE_OK);
    steps(clone, 20);
    FE_TRUE(hash_of(clone) == hash);
    FE_TRUE(fe_player_seek(player, 60) == FE_OK && hash_of(writable(player)) == hash);
    assert_int_equal(fe_world_step(writable(player), dt), FE_ERROR_STATE);
    FE_TRUE(fe_player_destroy(player) == FE_OK && fe_world_destroy(clone) == FE_OK);
    recorded_free(&r);
}

// ---- filters, restores, grounds ------------------------------------------------------------------------------------
static int32_t every_other(void *user, const fe_filter_pair *pair)
{
    int32_t *asked = user;
    (void)pair;
    return ++*asked % 2;
}

static void answers_of_a_filter_are_played(void **state)
{
    (void)state;
    fe_world *world = new_world(NULL);
    add_ground(world);
    int32_t asked = 0;
    FE_TRUE(fe_world_set_pair_filter(world, every_other, &asked) == FE_OK);
    fe_recorder *recorder = recorded_begin(world, FE_RECORD_ASSETS, 30);
    recorded r = {0};
    for (int32_t i = 0; i < 12; ++i) add_box(world, 0.3 * (i % 3), 1.0 + 0.6 * i, 0.0, 1);
    steps(world, 40);
    FE_TRUE(fe_world_set_pair_filter(world, NULL, NULL) == FE_OK);
    steps(world, 10);
    FE_TRUE(fe_world_set_pair_filter(world, every_other, &asked) == FE_OK);
    steps(world, 30);
    FE_TRUE(asked > 20);
    uint64_t hash = hash_of(world);
    recorded_read(&r, recorder);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
    played p = recorded_play(r.bytes, r.size, 2, FE_SIMD_PLAIN, 0);
    if (p.result != FE_END) fail_msg("%s", fe_last_error());
    FE_TRUE(recorded_hash(p.player) == hash);
    FE_TRUE(fe_player_seek(p.player, 33) == FE_OK);
    fe_world *clone;
    fe_batch *batch;
    FE_TRUE(fe_world_clone(writable(p.player), NULL, &clone) == FE_OK);
    FE_TRUE(fe_batch_create(writable(p.player), NULL, &batch) == FE_OK);
    FE_TRUE(fe_player_seek(p.player, 80) == FE_OK);
    FE_TRUE(recorded_hash(p.player) == hash);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    for (int32_t i = 0; i < 4; ++i) add_box(clone, 0.2 * i, 3.0, 0.0, 1); // new pairs, and no player to ask
    steps(clone, 60);
    FE_TRUE(fe_batch_step(batch, dt, 60, NULL, NULL) == 0);
    FE_TRUE(fe_batch_destroy(batch) == FE_OK && fe_world_destroy(clone) == FE_OK);
    recorded_free(&r);
}

static void restores_are_played(void **state)
{
    (void)state;
    fe_world *world = new_world(NULL);
    add_ground(world);
    for (int32_t i = 0; i < 6; ++i) add_box(world, 0.1 * i, 1.0 + 1.2 * i, 0.0, 0);
    fe_recorder *recorder = recorded_begin(world, FE_RECORD_ASSETS, 1000);
    recorded r = {0};
    steps(world, 20);
    int64_t size = fe_world_save(world, NULL, NULL, 0);
    unsigned char *bytes = malloc((size_t)size);
    FE_TRUE(fe_world_save(world, NULL, bytes, size) == size);
    steps(world, 8);
    FE_TRUE(fe_world_restore(world, NULL, bytes, size) == FE_OK); // as a game that rolls back
    add_box(world, 0.0, 12.0, 0.0, 0);
    steps(world, 30);
    uint64_t hash = hash_of(world);
    recorded_read(&r, recorder);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
    played p = recorded_play(r.bytes, r.size, 2, FE_SIMD_PLAIN, 0);
    if (p.result != FE_END) fail_msg("%s", fe_last_error());
    assert_int_equal(p.steps, 58);
    FE_TRUE(recorded_hash(p.player) == hash);
    FE_TRUE(fe_player_seek(p.player, 28) == FE_OK && fe_player_seek(p.player, 58) == FE_OK);
    FE_TRUE(recorded_hash(p.player) == hash);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    free(bytes);
    recorded_free(&r);
}

// A game that goes back eight frames, again and again
static void rollback_is_played(void **state)
{
    (void)state;
    fe_world *world = new_world(NULL);
    fe_history *history;
    add_ground(world);
    fe_body first = add_box(world, 0.0, 1.0, 0.0, 0);
    for (int32_t i = 1; i < 6; ++i) add_box(world, 0.1 * i, 1.0 + 1.2 * i, 0.0, 0);
    FE_TRUE(fe_history_create(world, NULL, &history) == FE_OK);
    fe_recorder *recorder = recorded_begin(world, FE_RECORD_ASSETS, 1000);
    recorded r = {0};
    for (int32_t frame = 1; frame <= 40; ++frame) {
        FE_TRUE(fe_history_keep(history, frame) == FE_OK);
        steps(world, 1);
        if (frame % 10) continue;
        FE_TRUE(fe_history_restore(history, frame - 7) == FE_OK);
        FE_TRUE(fe_body_add_impulse(world, first, &(fe_vec3){200.0f, 0.0f, 0.0f}) == FE_OK);
        for (int32_t again = frame - 6; again <= frame; ++again) {
            steps(world, 1);
            FE_TRUE(fe_history_keep(history, again) == FE_OK);
        }
    }
    uint64_t hash = hash_of(world);
    recorded_read(&r, recorder);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
    played p = recorded_play(r.bytes, r.size, 2, FE_SIMD_PLAIN, 0);
    if (p.result != FE_END) fail_msg("%s", fe_last_error());
    assert_int_equal(p.steps, 40 + 4 * 7);
    FE_TRUE(recorded_hash(p.player) == hash);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    recorded_free(&r);
}

static fe_asset new_field(fe_store *store)
{
    float heights[25] = {0};
    fe_heightfield_def def;
    fe_asset field;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = 5, def.cell_x = def.cell_z = 2.0f, def.heights = heights;
    FE_TRUE(fe_heightfield_create(store, &def, &field) == FE_OK);
    return field;
}

static void put_field(fe_world *world, fe_asset field, double x)
{
    fe_body_def def;
    fe_body body;
    fe_shape shape;
    fe_geometry geometry;
    fe_geometry_heightfield(&geometry, field);
    fe_body_def_init(&def, sizeof def);
    def.type = FE_BODY_STATIC, def.transform.position.x = x;
    FE_TRUE(fe_body_create(world, &def, &body) == FE_OK);
    FE_TRUE(fe_shape_create(world, body, NULL, &geometry, &shape) == FE_OK);
}

static void raise_field(fe_store *store, fe_asset field, float height)
{
    float heights[4] = {height, height, height, height};
    FE_TRUE(fe_heightfield_set_heights(store, field, 1, 1, 2, 2, heights) == FE_OK);
}

// Edited before it is used, while it is used, while it is not, and used again
static void edits_of_the_ground_are_played(void **state)
{
    (void)state;
    fe_world *world = new_world(NULL);
    fe_store *store;
    FE_TRUE(fe_world_get_store(world, &store) == FE_OK);
    fe_recorder *recorder = recorded_begin(world, FE_RECORD_ASSETS, 25);
    recorded r = {0};
    fe_asset field = new_field(store);
    raise_field(store, field, 0.2f);
    put_field(world, field, 0.0);
    for (int32_t i = 0; i < 5; ++i) add_box(world, 2.0 + 0.4 * i, 1.0 + 1.2 * i, 3.0, 0);
    steps(world, 20);
    raise_field(store, field, 0.5f);
    steps(world, 40);
    put_field(world, field, 20.0);
    raise_field(store, field, 0.9f);
    steps(world, 30);
    uint64_t hash = hash_of(world);
    recorded_read(&r, recorder);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
    played p = recorded_play(r.bytes, r.size, 2, FE_SIMD_PLAIN, 0);
    if (p.result != FE_END) fail_msg("%s", fe_last_error());
    FE_TRUE(recorded_hash(p.player) == hash);
    FE_TRUE(fe_player_seek(p.player, 30) == FE_OK && fe_player_seek(p.player, 90) == FE_OK);
    FE_TRUE(recorded_hash(p.player) == hash);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    recorded_free(&r);
}

// ---- cut, kept short, full -----------------------------------------------------------------------------------------
static void cut_files_play_to_the_last_whole_chunk(void **state)
{
    (void)state;
    recorded r = falling(FE_RECORD_ASSETS, 60, NULL, NULL);
    int64_t before = -1;
    for (int64_t size = 0; size <= r.size; size += size < 200 ? 1 : 61) {
        played p = recorded_play(r.bytes, size, 1, FE_SIMD_AUTO, 0);
        assert_int_equal(p.result, FE_END);
        FE_TRUE(p.steps >= before);
        before = p.steps;
        FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    }
    FE_TRUE(before >= 50);
    recorded_free(&r);
}

static void a_flight_recorder_keeps_the_last_seconds(void **state)
{
    (void)state;
    fe_world *world = new_world(NULL);
    add_ground(world);
    for (int32_t i = 0; i < 8; ++i) add_box(world, 0.1 * i, 1.0 + 1.2 * i, 0.0, 0);
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.sleep_enabled = 0;
    FE_TRUE(fe_world_set_tuning(world, &tuning) == FE_OK);
    fe_recorder_def def;
    fe_recorder_def_init(&def, sizeof def);
    def.flags |= FE_RECORD_LAST | FE_RECORD_FINE, def.keyframe_steps = 100, def.buffer_bytes = 150000;
    fe_recorder *recorder;
    FE_TRUE(fe_recorder_create(world, &def, &recorder) == FE_OK);
    steps(world, 3000);
    int64_t waits, size, none;
    FE_TRUE(fe_recorder_read(recorder, NULL, 0, &waits) == FE_OK && waits <= def.buffer_bytes);
    unsigned char *bytes = malloc((size_t)waits);
    assert_int_equal(fe_recorder_read(recorder, bytes, waits - 1, &none), FE_ERROR_LIMIT);
    FE_TRUE(none == waits);
    for (int32_t twice = 0; twice < 2; ++twice)
        FE_TRUE(fe_recorder_read(recorder, bytes, waits, &size) == FE_OK && size == waits);
    played p = recorded_play(bytes, size, 1, FE_SIMD_AUTO, 0);
    if (p.result != FE_END) fail_msg("%s", fe_last_error());
    FE_TRUE(recorded_hash(p.player) == hash_of(world));
    FE_WITHIN((double)p.steps, 200.0, 2000.0); // 8 bodies take some 150 bytes a step
    fe_player_info info;
    fe_player_info_init(&info, sizeof info);
    FE_TRUE(fe_player_get_info(p.player, &info) == FE_OK);
    FE_TRUE(info.first_step == 3000 - p.steps && info.step == 3000 && info.keyframes >= 2);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    free(bytes);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
}

// A hull of 12 points in its body, of a shape of its own
static fe_asset add_hull(fe_world *world, int32_t number, fe_body *out_body)
{
    fe_store *store;
    fe_asset asset;
    fe_shape shape;
    fe_geometry geometry;
    fe_hull_def hull;
    fe_body_def def;
    float points[36];
    for (int32_t i = 0; i < 36; ++i)
        points[i] = (float)((i * 7919 + number * 104729) % 1009) / 1009.0f + (i % 3 == i / 12 ? 1.0f : 0.0f);
    FE_TRUE(fe_world_get_store(world, &store) == FE_OK);
    fe_hull_def_init(&hull, sizeof hull);
    hull.points = points, hull.point_count = 12;
    FE_TRUE(fe_hull_create(store, &hull, &asset) == FE_OK);
    fe_body_def_init(&def, sizeof def);
    def.transform = fe_make_transform(0.0, 3.0, 0.0);
    FE_TRUE(fe_body_create(world, &def, out_body) == FE_OK);
    fe_geometry_hull(&geometry, asset);
    FE_TRUE(fe_shape_create(world, *out_body, NULL, &geometry, &shape) == FE_OK);
    return asset;
}

// What breaks makes hulls that nobody ever sees again: a thousand of them take 1.2 MB of the buffer's 200 KB
static void a_flight_recorder_forgets_the_assets_that_are_gone(void **state)
{
    (void)state;
    enum { HULLS = 1000, STEPS_EACH = 3 };
    fe_world *world = new_world(NULL);
    add_ground(world);
    fe_recorder_def def;
    fe_recorder_def_init(&def, sizeof def);
    def.flags |= FE_RECORD_LAST, def.keyframe_steps = 60, def.buffer_bytes = 200000;
    fe_recorder *recorder;
    FE_TRUE(fe_recorder_create(world, &def, &recorder) == FE_OK);
    for (int32_t i = 0; i < HULLS; ++i) {
        fe_body body;
        fe_store *store;
        fe_asset asset = add_hull(world, i, &body);
        steps(world, STEPS_EACH);
        FE_TRUE(fe_body_destroy(world, body) == FE_OK);
        FE_TRUE(fe_world_get_store(world, &store) == FE_OK);
        FE_TRUE(fe_asset_destroy(store, asset) == FE_OK);
    }
    int64_t size;
    unsigned char *bytes = malloc((size_t)def.buffer_bytes);
    FE_TRUE(fe_recorder_read(recorder, bytes, def.buffer_bytes, &size) == FE_OK);
    played p = recorded_play(bytes, size, 1, FE_SIMD_AUTO, 0);
    if (p.result != FE_END) fail_msg("%s", fe_last_error());
    FE_TRUE(recorded_hash(p.player) == hash_of(world));
    FE_WITHIN((double)p.steps, 60.0, (double)HULLS * STEPS_EACH); // from a keyframe on, to the end
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    free(bytes);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
}

static void a_full_buffer_ends_the_recording_alone(void **state)
{
    (void)state;
    fe_world *world = new_world(NULL);
    add_ground(world);
    fe_recorder_def def;
    fe_recorder_def_init(&def, sizeof def);
    def.buffer_bytes = 65536;
    fe_recorder *recorder;
    FE_TRUE(fe_recorder_create(world, &def, &recorder) == FE_OK);
    for (int32_t i = 0; i < 400; ++i) add_box(world, 2.0 * i, 1.0, 0.0, 0); // some 350 bytes each
    steps(world, 2);
    unsigned char *bytes = malloc(1 << 17);
    int64_t size, all = 0;
    while (fe_recorder_read(recorder, bytes + all, (1 << 17) - all, &size) == FE_OK) all += size;
    int64_t none;
    assert_int_equal(fe_recorder_read(recorder, bytes, 1 << 17, &none), FE_ERROR_LIMIT);
    FE_TRUE(strstr(fe_last_error(), "nobody read") != NULL);
    FE_TRUE(all > 30000 && all <= 65536);
    assert_int_equal(fe_recorder_note(recorder, 0, "late"), FE_ERROR_STATE);
    played p = recorded_play(bytes, all, 1, FE_SIMD_AUTO, 0);
    assert_int_equal(p.result, FE_END);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    free(bytes);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
}

static void a_recording_outlives_its_world(void **state)
{
    (void)state;
    fe_world *world = new_world(NULL);
    add_ground(world);
    fe_recorder *recorder = recorded_begin(world, FE_RECORD_ASSETS, 600);
    recorded r = {0};
    add_box(world, 0.0, 2.0, 0.0, 0);
    steps(world, 200); // it sleeps at last
    uint64_t hash = hash_of(world);
    FE_TRUE(fe_recorder_note(recorder, 7, "the end is near") == FE_OK);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
    recorded_read(&r, recorder);
    int64_t size;
    unsigned char byte;
    assert_int_equal(fe_recorder_read(recorder, &byte, 1, &size), FE_END);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK);
    played p = recorded_play(r.bytes, r.size, 1, FE_SIMD_AUTO, 1);
    assert_int_equal(p.result, FE_END);
    assert_int_equal(p.steps, 200);
    FE_TRUE(recorded_hash(p.player) == hash);
    fe_note note;
    assert_int_equal(fe_player_get_notes(p.player, &note, sizeof note, 1), 1);
    FE_TRUE(note.step == 200 && note.about == 7 && strcmp(note.text, "the end is near") == 0);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    recorded_free(&r);
}

// Nobody is awake: steps cost nothing. Who looks, sees them all the same
static void sleeping_worlds_cost_no_bytes(void **state)
{
    (void)state;
    fe_world *world = new_world(NULL);
    add_ground(world);
    add_box(world, 0.0, 0.6, 0.0, 0);
    steps(world, 200);
    fe_recorder *recorder = recorded_begin(world, FE_RECORD_ASSETS, 600);
    recorded r = {0};
    steps(world, 1);
    recorded_read(&r, recorder);
    int64_t size = r.size;
    steps(world, 5000);
    recorded_read(&r, recorder);
    FE_TRUE(r.size - size <= 128);
    played p = recorded_play(r.bytes, r.size, 1, FE_SIMD_AUTO, 0);
    assert_int_equal(p.result, FE_END);
    assert_int_equal(p.steps, 5001);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(world) == FE_OK);
    recorded_free(&r);
}

// ---- any bytes -----------------------------------------------------------------------------------------------------
#ifdef FE_SANITIZED
enum { EVERY = 23 };
#else
enum { EVERY = 3 };
#endif

// To the end or to an error, never beyond what anybody waits for
static void try_bytes(const unsigned char *bytes, int64_t size)
{
    fe_player *player;
    FE_TRUE(fe_player_create(NULL, &player) == FE_OK);
    (void)fe_player_feed(player, bytes, size);
    for (int32_t i = 0; i < 80; ++i) {
        fe_result result = fe_player_step(player);
        if (result != FE_OK && result != FE_ERROR_DIVERGED) break;
    }
    const fe_world *world;
    uint32_t words[2];
    if (fe_player_get_world(player, &world) == FE_OK) FE_TRUE(fe_world_hash(world, words) == FE_OK);
    FE_TRUE(fe_player_destroy(player) == FE_OK);
}

static void each_altered_byte_is_refused(void **state)
{
    (void)state;
    recorded r = falling(FE_RECORD_ASSETS, 30, NULL, NULL);
    for (int64_t i = 0; i < r.size; i += EVERY) {
        r.bytes[i] ^= (unsigned char)(1 << i % 8);
        fe_player *player;
        FE_TRUE(fe_player_create(NULL, &player) == FE_OK);
        fe_result fed = fe_player_feed(player, r.bytes, r.size);
        fe_player_info info;
        fe_player_info_init(&info, sizeof info);
        FE_TRUE(fe_player_get_info(player, &info) == FE_OK);
        // a size that grew waits for bytes that never come
        if (fed != FE_ERROR_DATA && fed != FE_ERROR_VERSION && fed != FE_ERROR_UNSUPPORTED && info.bytes == r.size)
            fail_msg("byte %lld was altered, and nobody noticed", (long long)i);
        FE_TRUE(fe_player_destroy(player) == FE_OK);
        r.bytes[i] ^= (unsigned char)(1 << i % 8);
    }
    recorded_free(&r);
}

static void whatever_is_played_lives(void **state)
{
    (void)state;
    recorded r = falling(FE_RECORD_ASSETS | FE_RECORD_FINE, 24, NULL, NULL);
    uint32_t seed = 5;
    for (int64_t i = 0; i < r.size; i += EVERY * 3) {
        unsigned char *copy = copy_of(&r);
        for (int32_t k = 0; k < 1 + (int32_t)(i % 3); ++k) {
            seed = seed * 1664525u + 1013904223u;
            int64_t place = k ? (int64_t)(seed >> 4) % r.size : i;
            copy[place] ^= (unsigned char)(1 + (seed >> 24) % 255);
        }
        mend(copy, r.size);
        try_bytes(copy, r.size);
        free(copy);
    }
    unsigned char noise[2000];
    for (int32_t i = 0; i < 100; ++i) {
        for (size_t k = 0; k < sizeof noise; ++k) noise[k] = (unsigned char)((seed = seed * 1664525u + 12345u) >> 24);
        memcpy(noise, r.bytes, FE__RECORDING_HEADER);
        try_bytes(noise, sizeof noise);
    }
    recorded_free(&r);
}

// Every call by its number, with arguments that are noise
static void calls_of_noise_are_refused_or_made(void **state)
{
    (void)state;
    recorded r = falling(FE_RECORD_ASSETS, 12, NULL, NULL);
    int64_t front = FE__RECORDING_HEADER;
    while (u32_at(r.bytes + front) != FE__CHUNK_KEYFRAME) front += chunk_size(r.bytes + front);
    front += chunk_size(r.bytes + front);
    enum { NOISE = 400 };
    unsigned char *copy = malloc((size_t)front + FE__CHUNK_HEADER + NOISE);
    memcpy(copy, r.bytes, (size_t)front);
    uint32_t seed = 9;
    for (int32_t number = 0; number < 110; ++number)
        for (int32_t turn = 0; turn < 6; ++turn) {
            unsigned char *chunk = copy + front, *content = chunk + FE__CHUNK_HEADER;
            memset(chunk, 0, FE__CHUNK_HEADER);
            fe__put_u32(chunk, FE__CHUNK_OPS);
            fe__put_u64(chunk + 8, NOISE);
            for (int32_t k = 0; k < NOISE; ++k) {
                seed = seed * 1664525u + 1013904223u;
                content[k] = (unsigned char)(turn < 2 ? seed >> 24 & 1 : seed >> 24);
            }
            content[0] = (unsigned char)number;
            mend(copy, front + FE__CHUNK_HEADER + NOISE);
            try_bytes(copy, front + FE__CHUNK_HEADER + NOISE);
        }
    free(copy);
    recorded_free(&r);
}

// ---- memory --------------------------------------------------------------------------------------------------------
// Each allocation of recorder and world may fail: the world does what it would have done
static void recording_never_harms_the_world(void **state)
{
    (void)state;
    for (int64_t first = 1, goes_on = 1; goes_on; first += 3) {
        counting memory = {.fail_from = first, .fail_count = 1};
        play p;
        play_begin(&p, counting_world(&memory));
        fe_recorder *recorder = NULL;
        if (fe_recorder_create(p.world, NULL, &recorder) != FE_OK) recorder = NULL;
        for (int32_t i = 0; i < 8; ++i) {
            fe_body_def def;
            fe_body body = 0;
            fe_body_def_init(&def, sizeof def);
            def.transform.position.y = (double)i;
            while (fe_body_create(p.world, &def, &body) == FE_ERROR_MEMORY) continue;
            FE_TRUE(body != 0);
            while (fe_world_step(p.world, dt) == FE_ERROR_MEMORY) continue;
        }
        int64_t size = 0;
        if (recorder) {
            fe_result result = fe_recorder_read(recorder, NULL, 0, &size);
            FE_TRUE(result == FE_OK || result == FE_ERROR_MEMORY);
            FE_TRUE(fe_recorder_destroy(recorder) == FE_OK);
        }
        goes_on = memory.failures == 1;
        FE_TRUE(fe_world_destroy(p.world) == FE_OK);
        FE_TRUE(memory.blocks == 0 && memory.bytes == 0 && memory.wrong == 0);
    }
}

// Each allocation of a player may fail: called again, it goes on
static void replays_survive_without_memory(void **state)
{
    (void)state;
    uint64_t hash;
    recorded r = falling(FE_RECORD_ASSETS, 30, NULL, &hash);
    for (int64_t first = 1, goes_on = 1; goes_on; first += 3) {
        counting memory = {.fail_from = first, .fail_count = 1};
        fe_allocator allocator = counting_allocator(&memory);
        fe_player_def def;
        fe_player *player;
        fe_player_def_init(&def, sizeof def);
        def.allocator = &allocator;
        fe_result result;
        while ((result = fe_player_create(&def, &player)) == FE_ERROR_MEMORY) continue;
        FE_TRUE(result == FE_OK);
        while ((result = fe_player_feed(player, r.bytes, r.size)) == FE_ERROR_MEMORY) continue;
        FE_TRUE(result == FE_OK);
        for (int32_t failed = 0; (result = fe_player_step(player)) != FE_END;) {
            if (result != FE_OK && result != FE_ERROR_MEMORY) fail_msg("%s", fe_last_error());
            FE_TRUE((failed += result == FE_ERROR_MEMORY) <= 1);
        }
        FE_TRUE(recorded_hash(player) == hash);
        goes_on = memory.failures == 1;
        FE_TRUE(fe_player_destroy(player) == FE_OK);
        FE_TRUE(memory.blocks == 0 && memory.bytes == 0 && memory.wrong == 0);
    }
    recorded_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_bit_of_a_velocity_is_named),
        cmocka_unit_test(without_traces_the_step_is_named),
        cmocka_unit_test(another_handle_is_named),
        cmocka_unit_test(keyframes_compare_all),
        cmocka_unit_test(seeks_both_ways),
        cmocka_unit_test(a_released_world_goes_on_alone),
        cmocka_unit_test(a_played_world_is_only_read),
        cmocka_unit_test(answers_of_a_filter_are_played),
        cmocka_unit_test(restores_are_played),
        cmocka_unit_test(rollback_is_played),
        cmocka_unit_test(edits_of_the_ground_are_played),
        cmocka_unit_test(cut_files_play_to_the_last_whole_chunk),
        cmocka_unit_test(a_flight_recorder_keeps_the_last_seconds),
        cmocka_unit_test(a_flight_recorder_forgets_the_assets_that_are_gone),
        cmocka_unit_test(a_full_buffer_ends_the_recording_alone),
        cmocka_unit_test(a_recording_outlives_its_world),
        cmocka_unit_test(sleeping_worlds_cost_no_bytes),
        cmocka_unit_test(each_altered_byte_is_refused),
        cmocka_unit_test(whatever_is_played_lives),
        cmocka_unit_test(calls_of_noise_are_refused_or_made),
        cmocka_unit_test(recording_never_harms_the_world),
        cmocka_unit_test(replays_survive_without_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
