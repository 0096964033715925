// `feather-bench history`: what it takes to keep a frame, and to go back 8, in a pile that is awake and in a level that
// sleeps. Medians of processor time, us; between the calls the same bytes are copied plainly, to as many places in
// turn.
#include "bench.h"

#include "boxes.h"
#include "feather.h"
#include "memory.h"
#include "stats.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES = 16, BACK = 8, ROUNDS = 60, WARM = 20, PLACES = FRAMES + 1, MOST = ROUNDS * BACK };

typedef struct times {
    double us[MOST];
    int32_t count;
} times;

static double now(void) { return 1e3 * bench_cpu_ms(); } // us of the processor

static void note(times *t, double since) { t->us[t->count++] = now() - since; }

static double median(times *t) { return bench_stats_of(t->us, t->count).median; }

typedef struct copies {
    unsigned char *from, *to[PLACES];
    size_t size;
    int32_t next;
    times times;
} copies;

static void copy_plainly(copies *c)
{
    c->next = (c->next + 1) % PLACES;
    double start = now();
    memcpy(c->to[c->next], c->from, c->size);
    note(&c->times, start);
}

static copies open_copies(const fe_history *history)
{
    fe_history_frame first = {0, 0};
    fe_history_get_frames(history, &first, sizeof first, 1);
    copies c = {.size = (size_t)first.bytes};
    c.from = bench_allocate(c.size, 1);
    memset(c.from, 1, c.size);
    for (int32_t i = 0; i < PLACES; ++i) c.to[i] = memset(bench_allocate(c.size, 1), 1, c.size);
    return c;
}

static void close_copies(copies *c)
{
    free(c->from);
    for (int32_t i = 0; i < PLACES; ++i) free(c->to[i]);
}

static void measure(const char *name, fe_world *world, int32_t boxes)
{
    static times keep, restore, step, again;
    fe_history *history = NULL;
    int64_t frame = 0;
    keep.count = restore.count = step.count = again.count = 0;
    if (fe_history_create(world, NULL, &history) != FE_OK || fe_history_keep(history, frame++) != FE_OK) return;
    copies c = open_copies(history);
    for (int32_t round = 0; round < ROUNDS; ++round) {
        for (int32_t k = 0; k < BACK; ++k) {
            copy_plainly(&c);
            double start = now();
            fe_world_step(world, 1.0f / 60.0f);
            note(k == 0 && round > WARM ? &again : &step, start);
            start = now();
            fe_history_keep(history, frame++);
            note(&keep, start);
        }
        if (round < WARM) {
            keep.count = step.count = c.times.count = 0;
            continue;
        }
        double start = now();
        if (fe_history_restore(history, frame - 1 - BACK) != FE_OK) fprintf(stderr, "%s\n", fe_last_error());
        note(&restore, start);
        frame -= BACK;
    }
    fe_history_frame frames[FRAMES];
    int32_t count = fe_history_get_frames(history, frames, sizeof *frames, FRAMES);
    printf("%-24s keep %7.1f us, restore %7.1f us, %8.0f bytes a frame, %5.0f a body; copied plainly %7.1f us\n", name,
           median(&keep), median(&restore), (double)frames[count - 1].bytes,
           (double)frames[count - 1].bytes / (double)boxes, median(&c.times));
    printf("%-24s a step %7.1f us, that after a restore %7.1f us\n", "", median(&step), median(&again));
    close_copies(&c);
}

int bench_command_history(int argc, char **argv)
{
    enum { AWAKE = 1000, ASLEEP = 10000 };
    (void)argc, (void)argv;
    fe_world *pile = bench_create_pile(AWAKE), *level = bench_create_rest(ASLEEP);
    if (pile == NULL || level == NULL) {
        fprintf(stderr, "feather-bench: history: %s\n", fe_last_error());
        return 2;
    }
    measure("pile of 1000, awake", pile, AWAKE);
    measure("10 000 boxes, asleep", level, ASLEEP);
    fe_world_destroy(pile);
    fe_world_destroy(level);
    return 0;
}
