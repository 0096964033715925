// test_recording.c - what is recorded is played again: the same calls, the same handles, the same bits, with other
// workers and SIMD sets. What was altered is refused, or named.
#include "fe_test.h"
#include "support/fuzz.h"
#include "support/play.h"
#include "support/recorded.h"

#include <stdlib.h>
#include <string.h>

#ifdef FE_SANITIZED
enum { MOST_STEPS = 70, KEYFRAMES = 31 };
#else
enum { MOST_STEPS = 200, KEYFRAMES = 97 };
#endif

static fe_world *new_world(int32_t workers)
{
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = workers;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    return world;
}

static void expect_same_run(const char *name, const recorded *r, int32_t workers, int32_t simd, int64_t piece,
                            uint64_t hash)
{
    played p = recorded_play(r->bytes, r->size, workers, simd, piece);
    if (p.result != FE_END) fail_msg("%s, %d workers: %s", name, (int)workers, fe_last_error());
    if (recorded_hash(p.player) != hash) fail_msg("%s, %d workers: it ends otherwise", name, (int)workers);
    FE_TRUE(fe_player_destroy(p.player) == FE_OK);
}

// ---- scripts -------------------------------------------------------------------------------------------------------
static void record_script(const script *s, uint32_t flags, int32_t begin, int32_t end, recorded *r, uint64_t *out_hash)
{
    static play p;
    play_begin(&p, new_world(1));
    if (begin) play_until(&p, s, begin);
    fe_recorder *recorder = recorded_begin(p.world, flags, KEYFRAMES);
    for (int32_t step = begin + 1; step <= end; ++step) {
        play_until(&p, s, step);
        if (step % 50 == 0) recorded_read(r, recorder);
    }
    *out_hash = play_hash(&p);
    recorded_read(r, recorder);
    FE_TRUE(fe_recorder_destroy(recorder) == FE_OK && fe_world_destroy(p.world) == FE_OK);
}

static void plays_again(const script *s)
{
    recorded r = {0};
    uint64_t hash;
    int32_t steps = s->steps < MOST_STEPS ? s->steps : MOST_STEPS;
    record_script(s, FE_RECORD_ASSETS, 0, steps, &r, &hash);
    expect_same_run(s->name, &r, 3, FE_SIMD_PLAIN, 0, hash);
    expect_same_run(s->name, &r, 1, FE_SIMD_AVX2, 1000, hash);
    recorded_free(&r);
    record_script(s, FE_RECORD_ASSETS | FE_RECORD_FINE, steps / 2, steps, &r, &hash);
    expect_same_run(s->name, &r, 1, FE_SIMD_AUTO, 0, hash);
    recorded_free(&r);
}

#define CASE(name) \
    static void name##_plays_again(void **state) { (void)state, plays_again(&script_##name); }
CASE(brief)
CASE(crowd)
CASE(mixed)
CASE(terrain)
CASE(fast)
CASE(joints)
CASE(spawn)
CASE(solids)
CASE(meshes)
CASE(cooked)
CASE(scales)
CASE(turns)
CASE(compounds)

// ---- any calls -----------------------------------------------------------------------------------------------------
#ifdef FE_SANITIZED
enum { STREAMS = 12 };
#else
enum { STREAMS = 60 };
#endif
enum { STREAM_BYTES = 3000 };

typedef struct taped {
    recorded r;
    fe_recorder *recorder;
    uint64_t hash;
} taped;

static void fuzz_begins(fe_world *world, void *user)
{
    taped *t = user;
    t->recorder = recorded_begin(world, FE_RECORD_ASSETS, 20);
}

static void fuzz_ends(fe_world *world, void *user)
{
    taped *t = user;
    uint32_t words[2];
    FE_TRUE(fe_world_hash(world, words) == FE_OK);
    t->hash = words[0] | (uint64_t)words[1] << 32;
    recorded_read(&t->r, t->recorder);
    FE_TRUE(fe_recorder_destroy(t->recorder) == FE_OK);
}

static void random_calls_play_again(void **state)
{
    (void)state;
    uint8_t bytes[STREAM_BYTES];
    uint32_t seed = 77;
    for (int32_t stream = 0; stream < STREAMS; ++stream) {
        for (int32_t i = 0; i < STREAM_BYTES; ++i) bytes[i] = (uint8_t)((seed = seed * 1664525u + 1013904223u) >> 24);
        taped t = {0};
        fuzz_setting setting = {.workers = 1, .simd = FE_SIMD_AUTO, .failures = 1, .begins = fuzz_begins};
        setting.ends = fuzz_ends, setting.user = &t;
        fuzz_run(bytes, sizeof bytes, &setting);
        char name[32];
        snprintf(name, sizeof name, "stream %d", (int)stream);
        expect_same_run(name, &t.r, 2, stream % 2 ? FE_SIMD_PLAIN : FE_SIMD_AUTO, stream % 3 ? 0 : 777, t.hash);
        recorded_free(&t.r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(brief_plays_again),     cmocka_unit_test(crowd_plays_again),
        cmocka_unit_test(mixed_plays_again),     cmocka_unit_test(terrain_plays_again),
        cmocka_unit_test(fast_plays_again),      cmocka_unit_test(joints_plays_again),
        cmocka_unit_test(spawn_plays_again),     cmocka_unit_test(solids_plays_again),
        cmocka_unit_test(meshes_plays_again),    cmocka_unit_test(cooked_plays_again),
        cmocka_unit_test(scales_plays_again),    cmocka_unit_test(turns_plays_again),
        cmocka_unit_test(compounds_plays_again), cmocka_unit_test(random_calls_play_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
