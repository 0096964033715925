// `feather-bench replay [--quick] [--keep FOLDER] [CASE...]`: every case is recorded while it runs in Feather, and the
// recording is played with other workers, in plain C. Exit 1 where a replay goes another way. --quick: the first two
// seconds. --keep: the recordings are written to FOLDER/CASE.feather. `feather-bench play FILE` plays one.
#include "bench.h"

#include "feather.h"
#include "memory.h"
#include "trial.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SUBSTEPS = 8, WORKERS = 3 };
static const double QUICK_SECONDS = 2.0;

// Of the run at hand: an engine has no room for what stands beside it
static fe_recorder *recorder;
static int32_t differs;
static const char *folder; // to keep recordings in; NULL: none
static const char *name;   // of the case

static bench_world *create_recorded(const bench_scene *scene, int32_t workers, int32_t substeps)
{
    bench_world *world = bench_feather.create(scene, workers, substeps);
    fe_recorder_def def;
    fe_recorder_def_init(&def, sizeof def);
    def.buffer_bytes = INT64_C(1) << 32;
    recorder = NULL;
    if (world != NULL && fe_recorder_create(bench_feather_world(world), &def, &recorder) != FE_OK) {
        fprintf(stderr, "feather-bench: %s\n", fe_last_error());
        bench_feather.destroy(world);
        return NULL;
    }
    return world;
}

static uint64_t hash_of(const fe_world *world)
{
    uint32_t words[2] = {0, 0};
    fe_world_hash(world, words);
    return words[0] | (uint64_t)words[1] << 32;
}

static const char *play(const unsigned char *bytes, int64_t size, uint64_t hash)
{
    fe_player_def def;
    fe_player *player = NULL;
    const fe_world *world;
    fe_player_def_init(&def, sizeof def);
    def.worker_count = WORKERS, def.simd = FE_SIMD_PLAIN;
    fe_result result = fe_player_create(&def, &player);
    if (result == FE_OK) result = fe_player_feed(player, bytes, size);
    while (result == FE_OK) result = fe_player_step(player);
    const char *wrong = result == FE_END ? NULL : fe_last_error();
    if (wrong == NULL && fe_player_get_world(player, &world) == FE_OK && hash_of(world) != hash)
        wrong = "it ends otherwise";
    if (player != NULL) fe_player_destroy(player);
    return wrong;
}

static const char *keep(const unsigned char *bytes, int64_t size)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s.feather", folder, name);
    FILE *file = fopen(path, "wb");
    size_t written = file != NULL ? fwrite(bytes, 1, (size_t)size, file) : 0;
    if (file == NULL || fclose(file) != 0 || written != (size_t)size) return "its file cannot be written";
    return NULL;
}

static void destroy_recorded(bench_world *world)
{
    int64_t size = 0;
    uint64_t hash = hash_of(bench_feather_world(world));
    fe_recorder_read(recorder, NULL, 0, &size);
    unsigned char *bytes = bench_allocate((size_t)size, 1);
    const char *wrong = fe_recorder_read(recorder, bytes, size, &size) == FE_OK ? NULL : fe_last_error();
    fe_recorder_destroy(recorder);
    bench_feather.destroy(world);
    if (wrong == NULL && folder != NULL) wrong = keep(bytes, size);
    if (wrong == NULL) wrong = play(bytes, size, hash);
    printf(" %10.1f KB  %s\n", (double)size / 1024.0, wrong == NULL ? "the same" : wrong);
    differs |= wrong != NULL;
    free(bytes);
}

static int run_case(const bench_case *rule, int32_t planar, int32_t quick)
{
    bench_engine engine = bench_feather;
    bench_trial trial;
    bench_case shorter = *rule;
    engine.create = create_recorded, engine.destroy = destroy_recorded;
    if (quick) shorter.seconds = fmin(rule->seconds, QUICK_SECONDS);
    name = rule->name;
    printf("%-24s", name);
    fflush(stdout);
    int status = bench_trial_run(&trial, &(bench_setup){&shorter, &engine, planar, 1, SUBSTEPS, 0, 0});
    bench_trial_free(&trial);
    return status;
}

int bench_command_replay(int argc, char **argv)
{
    int32_t quick = 0, failed = 0, first = 0;
    for (; first < argc && argv[first][0] == '-'; first++) {
        if (strcmp(argv[first], "--quick") == 0) quick = 1;
        if (strcmp(argv[first], "--keep") == 0 && first + 1 < argc) folder = argv[++first];
    }
    for (int32_t i = first; i < argc; i++) {
        int32_t planar = 0;
        const bench_case *rule = bench_case_find(argv[i], &planar);
        if (rule == NULL) {
            fprintf(stderr, "feather-bench: no case is called %s\n", argv[i]);
            return 2;
        }
        failed |= run_case(rule, planar, quick) != 0;
    }
    for (int32_t i = 0; argc == first && i < bench_case_count(); i++) {
        const bench_case *rule = bench_case_at(i);
        failed |= run_case(rule, rule->planar == BENCH_PLANAR_ONLY, quick) != 0;
    }
    return failed || differs;
}

// A piece at a time, as it would come from a network
static int play_file(FILE *file, fe_player *player)
{
    static unsigned char piece[1 << 16];
    int64_t steps = 0;
    fe_result result = FE_END;
    for (size_t size; result == FE_END && (size = fread(piece, 1, sizeof piece, file)) > 0;) {
        result = fe_player_feed(player, piece, (int64_t)size);
        while (result == FE_OK && (result = fe_player_step(player)) == FE_OK) ++steps;
    }
    printf("%lld steps, %s\n", (long long)steps, result == FE_END ? "the same" : fe_last_error());
    return result != FE_END;
}

int bench_command_play(int argc, char **argv)
{
    FILE *file = argc == 1 ? fopen(argv[0], "rb") : NULL;
    fe_player *player = NULL;
    if (file == NULL || fe_player_create(NULL, &player) != FE_OK) {
        fprintf(stderr, "feather-bench: play FILE: it cannot be read\n");
        return 2;
    }
    int failed = play_file(file, player);
    fe_player_destroy(player);
    fclose(file);
    return failed;
}
