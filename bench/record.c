// `feather-bench record [BODIES [SLEEPING]]`: what it costs to record, and how fast a recording plays. Two equal worlds
// take turns, step by step, and one of them is recorded: a pile of boxes that are awake, then boxes at rest. Time is
// that of the processor, us.
#include "bench.h"

#include "boxes.h"
#include "feather.h"
#include "memory.h"
#include "stats.h"

#include <stdio.h>
#include <stdlib.h>

enum { USUAL_BODIES = 1000, USUAL_SLEEPING = 10000, PILE_STEPS = 1200, REST_STEPS = 3000 };

static double now(void) { return 1e3 * bench_cpu_ms(); } // us of the processor

static fe_world *boxes(int32_t bodies, int32_t sleeps)
{
    return sleeps ? bench_create_rest(bodies) : bench_create_pile(bodies);
}

typedef struct costs {
    double plain, recorded, worst; // us, of all steps; of one
    int64_t bytes;
    unsigned char *file;
} costs;

static double step(fe_world *world)
{
    double start = now();
    fe_world_step(world, 1.0f / 60.0f);
    return now() - start;
}

static double middle(double *times, int32_t count) { return bench_stats_of(times, count).median; }

static int64_t waiting(fe_recorder *recorder)
{
    int64_t size = 0;
    fe_recorder_read(recorder, NULL, 0, &size);
    return size;
}

static costs measure(int32_t bodies, int32_t sleeps, int32_t count)
{
    fe_world *plain = boxes(bodies, sleeps), *world = boxes(bodies, sleeps);
    fe_recorder *recorder = NULL;
    fe_recorder_def def;
    costs c = {0};
    fe_recorder_def_init(&def, sizeof def);
    def.buffer_bytes = INT64_C(1) << 30;
    if (!plain || !world || fe_recorder_create(world, &def, &recorder) != FE_OK) return c;
    double *times = bench_allocate((size_t)count, sizeof *times),
           *others = bench_allocate((size_t)count, sizeof *others);
    step(world), step(plain);
    for (int32_t i = 0; i < count; ++i) {
        others[i] = step(plain), c.plain += others[i];
        times[i] = step(world), c.recorded += times[i];
        if (times[i] - others[i] > c.worst) c.worst = times[i] - others[i];
    }
    c.bytes = waiting(recorder);
    printf("  step: median %.1f us, recorded %.1f us: %+.2f us; mean %+.2f us, most %+.0f us\n", middle(others, count),
           middle(times, count), middle(times, count) - middle(others, count), (c.recorded - c.plain) / count, c.worst);
    c.file = bench_allocate((size_t)c.bytes, 1);
    fe_recorder_read(recorder, c.file, c.bytes, &c.bytes);
    fe_recorder_destroy(recorder);
    fe_world_destroy(world);
    fe_world_destroy(plain);
    free(times);
    free(others);
    return c;
}

static double keyframe_bytes(const costs *c)
{
    double all = 0.0;
    for (int64_t at = 40; at + 32 <= c->bytes;) { // header, chunks: src/recording/recorder.h
        uint64_t size = 0;
        for (int k = 7; k >= 0; --k) size = size << 8 | c->file[at + 8 + k];
        if (c->file[at] == 'K') all += 32.0 + (double)size;
        at += 32 + ((int64_t)size + 7) / 8 * 8;
    }
    return all;
}

static void replay(const costs *c, int32_t count)
{
    fe_player *player = NULL;
    fe_result result = FE_ERROR_STATE;
    if (fe_player_create(NULL, &player) != FE_OK || fe_player_feed(player, c->file, c->bytes) != FE_OK) return;
    fe_player_step(player);
    double start = now();
    int32_t steps = 0;
    while ((result = fe_player_step(player)) == FE_OK) ++steps;
    double spent = now() - start;
    printf("  replay: %d steps of %d, %s, %.1f us a step: %.3f of the speed without recording\n", steps, count,
           result == FE_END ? "all the same" : fe_last_error(), spent / steps, c->plain / count / (spent / steps));
    fe_player_destroy(player);
}

static int run(const char *name, int32_t bodies, int32_t sleeps, int32_t count)
{
    printf("%s of %d\n", name, bodies);
    costs c = measure(bodies, sleeps, count);
    if (!c.file) return 2;
    double keyframes = keyframe_bytes(&c);
    printf("  %.1f bytes a step, and keyframes of %.0f bytes\n", ((double)c.bytes - keyframes) / count, keyframes);
    replay(&c, count);
    free(c.file);
    return 0;
}

int bench_command_record(int argc, char **argv)
{
    int32_t bodies = argc > 0 ? atoi(argv[0]) : USUAL_BODIES, sleeping = argc > 1 ? atoi(argv[1]) : USUAL_SLEEPING;
    if (bodies < 1 || sleeping < 1) {
        fprintf(stderr, "feather-bench: record [BODIES [SLEEPING]]: at least one\n");
        return 2;
    }
    int failed = run("pile", bodies, 0, PILE_STEPS);
    return failed ? failed : run("rest", sleeping, 1, REST_STEPS);
}
