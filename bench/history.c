// `feather-bench history`: what it takes to keep a frame, and to go back 8, in a pile that is awake and in a level that
// sleeps. Medians of processor time, us; between the calls the same bytes are copied plainly, to as many places in
// turn.
#include "bench.h"

#include "feather.h"
#include "memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { FRAMES = 16, BACK = 8, ROUNDS = 60, WARM = 20, PLACES = FRAMES + 1, MOST = ROUNDS * BACK };

typedef struct times {
    double us[MOST];
    int32_t count;
} times;

static double now(void) // us
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

static void note(times *t, double since) { t->us[t->count++] = now() - since; }

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(times *t)
{
    qsort(t->us, (size_t)t->count, sizeof *t->us, compare);
    return t->us[t->count / 2];
}

static void add(fe_world *world, int32_t type, double x, double y, double z, const fe_geometry *form)
{
    fe_body_def def;
    fe_body body = 0;
    fe_shape shape = 0;
    fe_body_def_init(&def, sizeof def);
    def.type = type, def.transform = fe_make_transform(x, y, z);
    fe_body_create(world, &def, &body);
    fe_shape_create(world, body, NULL, form, &shape);
}

// Boxes of 1 m: a heap 8 wide and 8 deep that never sleeps, or a level of boxes that lie apart and fall asleep
static fe_world *world_of(int32_t boxes, int32_t sleeps)
{
    enum { SIDE = 8, ROW = 100, STEPS = 300 };
    fe_world *world = NULL;
    fe_world_tuning tuning;
    fe_geometry form;
    if (fe_world_create(NULL, &world) != FE_OK) return NULL;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.sleep_enabled = sleeps;
    fe_world_set_tuning(world, &tuning);
    fe_geometry_plane(&form, 0.0f, 1.0f, 0.0f, 0.0f);
    add(world, FE_BODY_STATIC, 0.0, 0.0, 0.0, &form);
    fe_geometry_box(&form, 0.5f, 0.5f, 0.5f);
    for (int32_t i = 0; i < boxes; ++i) {
        double lean = 0.05 * (double)(i * 7 % 11);
        if (sleeps)
            add(world, FE_BODY_DYNAMIC, 1.5 * (i % ROW), 0.5, 1.5 * (i / ROW), &form);
        else
            add(world, FE_BODY_DYNAMIC, 0.95 * (i % SIDE) + lean, 0.6 + 1.1 * (i / SIDE / SIDE),
                0.95 * (i / SIDE % SIDE) - lean, &form);
    }
    for (int32_t i = 0; i < STEPS; ++i)
        if (fe_world_step(world, 1.0f / 60.0f) != FE_OK) return NULL;
    return world;
}

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
    fe_world *pile = world_of(AWAKE, 0), *level = world_of(ASLEEP, 1);
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
