// `feather-bench state`: what snapshots cost, in a settled pile of 1000 awake boxes and in 10 000 boxes that sleep on
// the ground. Medians of the processor's time, by turns with memcpy of as many bytes.
#include "bench.h"

#include "feather.h"
#include "memory.h"
#include "random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ROUNDS = 41, CALLS = 5 };
enum { COPY, SAVE, RESTORE, LOAD, CHECK, COMPARE };
static const char *const names[CALLS + 1] = {"memcpy", "save", "restore", "load", "check", "compare"};

static double now(void) // us of the processor
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

static void add(fe_world *world, int32_t type, double x, double y, double z, float half, float half_height)
{
    fe_body_def def;
    fe_body body = 0;
    fe_shape shape = 0;
    fe_geometry form;
    fe_geometry_box(&form, half, half_height, half);
    fe_body_def_init(&def, sizeof def);
    def.type = type, def.transform = fe_make_transform(x, y, z);
    fe_body_create(world, &def, &body);
    fe_shape_create(world, body, NULL, &form, &shape);
}

static fe_world *new_world(int32_t sleeps)
{
    fe_world_def def;
    fe_world *world = NULL;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = 1;
    if (fe_world_create(&def, &world) != FE_OK) return NULL;
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.sleep_enabled = sleeps;
    fe_world_set_tuning(world, &tuning);
    add(world, FE_BODY_STATIC, 0.0, -1.0, 0.0, 300.0f, 1.0f);
    return world;
}

static fe_world *make_pile(void)
{
    enum { BODIES = 1000, COLUMNS = 8, LAYER = COLUMNS * COLUMNS, STEPS = 400 };
    const double pitch = 1.05, jitter = 0.1, layer_height = 1.2; // m
    fe_world *world = new_world(0);
    uint64_t state = 0x9e3779b97f4a7c15u;
    for (int32_t i = 0; i < BODIES && world; ++i) {
        int32_t c = i % LAYER;
        double x = pitch * (c % COLUMNS - COLUMNS / 2) + jitter * bench_random(&state);
        double z = pitch * (c / COLUMNS - COLUMNS / 2) + jitter * bench_random(&state);
        add(world, FE_BODY_DYNAMIC, x, 1.0 + layer_height * (i / LAYER), z, 0.5f, 0.5f);
    }
    for (int32_t i = 0; i < STEPS && world; ++i) fe_world_step(world, 1.0f / 60.0f);
    return world;
}

static fe_world *make_rest(void)
{
    enum { BODIES = 10000, SIDE = 100, STEPS = 120 };
    const double pitch = 1.5; // m
    fe_world *world = new_world(1);
    for (int32_t i = 0; i < BODIES && world; ++i)
        add(world, FE_BODY_DYNAMIC, pitch * (i % SIDE), 0.5, pitch * (i / SIDE), 0.5f, 0.5f);
    for (int32_t i = 0; i < STEPS && world; ++i) fe_world_step(world, 1.0f / 60.0f);
    return world;
}

typedef struct room {
    fe_world *world;
    unsigned char *bytes, *copy;
    int64_t size;
} room;

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
    default:
        return fe_snapshot_compare(r->bytes, r->size, r->copy, r->size, NULL);
    }
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median_of(double *values)
{
    qsort(values, ROUNDS, sizeof *values, by_value);
    return values[ROUNDS / 2];
}

static int measure(const char *scene, fe_world *world)
{
    double us[CALLS + 1][ROUNDS], median[CALLS + 1];
    fe_counters counters;
    fe_counters_init(&counters, sizeof counters);
    if (!world || fe_world_get_counters(world, &counters) != FE_OK) return -1;
    room r = {.world = world, .size = fe_world_save(world, NULL, NULL, 0)};
    if (r.size <= 0) return -1;
    r.bytes = bench_allocate((size_t)r.size, 1), r.copy = bench_allocate((size_t)r.size, 1);
    int failed = call(&r, SAVE) != 0;
    for (int32_t i = 0; i < ROUNDS; ++i)
        for (int32_t which = COPY; which <= COMPARE; ++which) {
            double start = now();
            failed |= call(&r, which) != 0;
            us[which][i] = now() - start;
        }
    printf("%s: %d bodies, %d pairs, %d contacts, %.0f bytes a body\n", scene, (int)counters.bodies,
           (int)counters.pairs, (int)counters.contacts, (double)r.size / (double)(counters.bodies - 1));
    for (int32_t which = COPY; which <= COMPARE; ++which) {
        median[which] = median_of(us[which]);
        printf("  %-8s %9.1f us  %6.1f memcpy\n", names[which], median[which], median[which] / median[COPY]);
    }
    free(r.bytes), free(r.copy);
    return failed || fe_world_destroy(world) != FE_OK ? -1 : 0;
}

int bench_command_state(int argc, char **argv)
{
    (void)argv;
    if (argc > 0 || measure("pile", make_pile()) || measure("rest", make_rest())) {
        fprintf(stderr, "feather-bench: state: %s\n", argc > 0 ? "it takes no arguments" : fe_last_error());
        return 2;
    }
    return 0;
}
