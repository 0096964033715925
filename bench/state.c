// `feather-bench state`: what snapshots cost, in a settled pile of 1000 awake boxes and in 10 000 boxes that sleep on
// the ground. Medians of the processor's time, by turns with memcpy of as many bytes. Differences are those to the step
// before.
#include "bench.h"

#include "boxes.h"
#include "feather.h"
#include "memory.h"
#include "stats.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 41, CALLS = 7, AWAKE = 1000, ASLEEP = 10000 };
enum { COPY, SAVE, RESTORE, LOAD, CHECK, COMPARE, SAVE_DIFF, RESTORE_DIFF };
static const char *const names[CALLS + 1] = {"memcpy", "save",    "restore",           "load",
                                             "check",  "compare", "save a difference", "restore it"};

static double now(void) { return 1e3 * bench_cpu_ms(); } // us of the processor

typedef struct room {
    fe_world *world;
    unsigned char *bytes, *copy, *base, *diff; // base: of the step before
    int64_t size, base_size, diff_room, diff_size;
} room;

static int32_t save_diff(room *r)
{
    fe_save_options options;
    fe_save_options_init(&options, sizeof options);
    options.flags = FE_SAVE_DIFF, options.base = r->base, options.base_size = r->base_size;
    if (!r->diff_room) r->diff_room = fe_world_save(r->world, &options, NULL, 0);
    if (!r->diff && r->diff_room > 0) r->diff = bench_allocate((size_t)r->diff_room, 1);
    r->diff_size = fe_world_save(r->world, &options, r->diff, r->diff_room);
    return r->diff_size > 0 && r->diff_size <= r->diff_room ? 0 : -1;
}

static int32_t restore_diff(room *r)
{
    fe_restore_options options;
    fe_restore_options_init(&options, sizeof options);
    options.base = r->base, options.base_size = r->base_size;
    return fe_world_restore(r->world, &options, r->diff, r->diff_size);
}

static int32_t call(room *r, int32_t which)
{
    fe_world *twin = NULL;
    switch (which) {
    case COPY:
        memcpy(r->copy, r->bytes, (size_t)r->size);
        return 0;
    case SAVE:
        return fe_world_save(r->world, NULL, r->bytes, r->size) == r->size ? 0 : -1;
    case RESTORE:
        return fe_world_restore(r->world, NULL, r->bytes, r->size);
    case LOAD:
        if (fe_world_load(NULL, NULL, r->bytes, r->size, &twin) != FE_OK) return -1;
        return fe_world_destroy(twin);
    case CHECK:
        return fe_snapshot_check(r->bytes, r->size, NULL);
    case COMPARE:
        return fe_snapshot_compare(r->bytes, r->size, r->copy, r->size, NULL);
    case SAVE_DIFF:
        return save_diff(r);
    default:
        return restore_diff(r);
    }
}

static int measure(const char *scene, fe_world *world)
{
    double us[CALLS + 1][ROUNDS], median[CALLS + 1];
    fe_counters counters;
    fe_counters_init(&counters, sizeof counters);
    if (!world || fe_world_get_counters(world, &counters) != FE_OK) return -1;
    room r = {.world = world, .base_size = fe_world_save(world, NULL, NULL, 0)};
    if (r.base_size <= 0) return -1;
    r.base = bench_allocate((size_t)r.base_size, 1);
    if (fe_world_save(world, NULL, r.base, r.base_size) != r.base_size || fe_world_step(world, 1.0f / 60.0f) != FE_OK)
        return -1;
    r.size = fe_world_save(world, NULL, NULL, 0);
    r.bytes = bench_allocate((size_t)r.size, 1), r.copy = bench_allocate((size_t)r.size, 1);
    int failed = call(&r, SAVE) != 0;
    for (int32_t i = 0; i < ROUNDS; ++i)
        for (int32_t which = COPY; which <= CALLS; ++which) {
            double start = now();
            failed |= call(&r, which) != 0;
            us[which][i] = now() - start;
        }
    printf("%s: %d bodies, %d pairs, %d contacts, %.0f bytes a body; a difference of %.1f bytes a body, %lld in all\n",
           scene, (int)counters.bodies, (int)counters.pairs, (int)counters.contacts,
           (double)r.size / (double)(counters.bodies - 1), (double)r.diff_size / (double)(counters.bodies - 1),
           (long long)r.diff_size);
    for (int32_t which = COPY; which <= CALLS; ++which) {
        median[which] = bench_stats_of(us[which], ROUNDS).median;
        printf("  %-17s %9.1f us  %6.1f memcpy\n", names[which], median[which], median[which] / median[COPY]);
    }
    free(r.bytes), free(r.copy), free(r.base), free(r.diff);
    return failed || fe_world_destroy(world) != FE_OK ? -1 : 0;
}

int bench_command_state(int argc, char **argv)
{
    (void)argv;
    if (argc > 0 || measure("pile", bench_create_pile(AWAKE)) || measure("rest", bench_create_rest(ASLEEP))) {
        fprintf(stderr, "feather-bench: state: %s\n", argc > 0 ? "it takes no arguments" : fe_last_error());
        return 2;
    }
    return 0;
}
