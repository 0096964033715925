// `feather-bench many`: many small worlds, each engine's in turn and Feather's as a batch too. The processor's time,
// medians of rounds in which all take their turns, and what a world holds.
#include "bench.h"

#include "feather.h"
#include "memory.h"
#include "peers/mujoco.h"
#include "peers/peer.h"
#include "stats.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORLDS = 500, MOST_WORLDS = 100000, ROUNDS = 9, STEPS = 4, MOST_RUNS = 12 };
static const char *const scenes[] = {"people-1", "hoppers-1", "pushers-1"};

// Many worlds of one engine, or of one way to step them
typedef struct crowd {
    const char *name;
    int32_t (*make)(struct crowd *c, const bench_scene *scene); // 0: it cannot, and has said why
    void (*step)(struct crowd *c);                              // STEPS of each world
    void (*reset)(struct crowd *c);                             // NULL: there is none but building anew
    void (*destroy)(struct crowd *c);
    const bench_engine *engine;
    int32_t substeps, workers;
    int32_t at_once; // steps a call

    int32_t count;
    float dt;
    bench_world **worlds; // or Feather's, below
    bench_world *first;
    fe_world **clones;
    fe_batch *batch;
    double kilobytes, create_us, reset_us; // of a world
    double us[ROUNDS], wall[ROUNDS];       // of a step
} crowd;

static double us_now(void) { return 1e3 * bench_cpu_ms(); }

// ---- Feather -------------------------------------------------------------------------------------------------------
static int32_t make_loop(crowd *c, const bench_scene *scene)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    c->first = bench_feather.create(scene, 1, c->substeps);
    c->clones = bench_allocate((size_t)c->count, sizeof *c->clones);
    for (int32_t i = 0; c->first != NULL && i < c->count; i++)
        if (fe_world_clone(bench_feather_world(c->first), &def, &c->clones[i]) != FE_OK) return 0;
    return c->first != NULL;
}

static void step_loop(crowd *c)
{
    for (int32_t k = 0; k < STEPS; k++)
        for (int32_t i = 0; i < c->count; i++) (void)fe_world_step(c->clones[i], c->dt);
}

static void reset_loop(crowd *c)
{
    fe_state *start;
    if (fe_state_create(bench_feather_world(c->first), NULL, &start) != FE_OK) return;
    for (int32_t i = 0; i < c->count; i++) (void)fe_world_set_state(c->clones[i], start);
    (void)fe_state_destroy(start);
}

static void destroy_loop(crowd *c)
{
    for (int32_t i = 0; i < c->count; i++) (void)fe_world_destroy(c->clones[i]);
    bench_feather.destroy(c->first);
    free(c->clones);
}

static int32_t make_batch(crowd *c, const bench_scene *scene)
{
    fe_batch_def def;
    fe_batch_def_init(&def, sizeof def);
    def.world_count = c->count, def.worker_count = c->workers;
    c->first = bench_feather.create(scene, 1, c->substeps);
    return c->first != NULL && fe_batch_create(bench_feather_world(c->first), &def, &c->batch) == FE_OK;
}

static void step_batch(crowd *c)
{
    for (int32_t k = 0; k < STEPS; k += c->at_once) (void)fe_batch_step(c->batch, c->dt, c->at_once, NULL, NULL);
}

static void reset_batch(crowd *c) { (void)fe_batch_reset(c->batch, NULL, NULL, NULL); }

static void destroy_batch(crowd *c)
{
    (void)fe_batch_destroy(c->batch);
    bench_feather.destroy(c->first);
}

// ---- others --------------------------------------------------------------------------------------------------------
static int32_t make_peer(crowd *c, const bench_scene *scene)
{
    c->worlds = bench_allocate((size_t)c->count, sizeof *c->worlds);
    for (int32_t i = 0; i < c->count; i++) {
        c->worlds[i] = c->engine->create(scene, 1, c->substeps);
        if (c->worlds[i] == NULL) return 0;
    }
    return 1;
}

static void step_peer(crowd *c)
{
    for (int32_t k = 0; k < STEPS; k++)
        for (int32_t i = 0; i < c->count; i++) (void)c->engine->step(c->worlds[i], c->dt);
}

static void destroy_peer(crowd *c)
{
    for (int32_t i = 0; i < c->count; i++) c->engine->destroy(c->worlds[i]);
    free(c->worlds);
}

#ifdef FE_BENCH_MUJOCO
static int32_t make_mujoco(crowd *c, const bench_scene *scene)
{
    c->worlds = bench_allocate((size_t)c->count, sizeof *c->worlds);
    for (int32_t i = 0; i < c->count; i++) {
        c->worlds[i] = bench_mujoco_create(scene, i > 0 ? c->worlds[0] : NULL);
        if (c->worlds[i] == NULL) return 0;
    }
    return 1;
}

static void step_mujoco(crowd *c)
{
    for (int32_t k = 0; k < STEPS; k++)
        for (int32_t i = 0; i < c->count; i++) bench_mujoco_step(c->worlds[i]);
}

static void reset_mujoco(crowd *c)
{
    for (int32_t i = 0; i < c->count; i++) bench_mujoco_reset(c->worlds[i]);
}

static void destroy_mujoco(crowd *c)
{
    for (int32_t i = c->count - 1; i >= 0; i--) bench_mujoco_destroy(c->worlds[i], i == 0);
    free(c->worlds);
}
#endif

// ---- the table -----------------------------------------------------------------------------------------------------
static crowd loop_of(const char *name, int32_t substeps)
{
    return (crowd){.name = name,
                   .make = make_loop,
                   .step = step_loop,
                   .reset = reset_loop,
                   .destroy = destroy_loop,
                   .substeps = substeps,
                   .workers = 1};
}

static crowd batch_of(const char *name, int32_t substeps, int32_t workers, int32_t at_once)
{
    return (crowd){.name = name,
                   .make = make_batch,
                   .step = step_batch,
                   .reset = reset_batch,
                   .destroy = destroy_batch,
                   .substeps = substeps,
                   .workers = workers,
                   .at_once = at_once};
}

static int32_t list_crowds(crowd *out)
{
    int32_t count = 0;
    out[count++] = loop_of("worlds in turn, 4 substeps", 4);
    out[count++] = loop_of("worlds in turn, 8 substeps", 8);
    out[count++] = batch_of("batch, 4 substeps", 4, 1, 1);
    out[count++] = batch_of("batch, 4 substeps, 4 steps a call", 4, 1, STEPS);
    out[count++] = batch_of("batch, 8 substeps", 8, 1, 1);
    out[count++] = batch_of("batch, 4 substeps, 2 workers", 4, 2, 1);
#ifdef FE_BENCH_MUJOCO
    out[count++] = (crowd){.name = "mujoco, steps of 4.2 ms",
                           .make = make_mujoco,
                           .step = step_mujoco,
                           .reset = reset_mujoco,
                           .destroy = destroy_mujoco,
                           .workers = 1};
#endif
    for (int32_t i = 0; i < bench_engine_count; i++) {
        const bench_engine *engine = bench_engines[i].engine;
        if (engine == NULL || engine == &bench_feather || engine->planar_only) continue;
        out[count++] = (crowd){.name = engine->name,
                               .make = make_peer,
                               .step = step_peer,
                               .destroy = destroy_peer,
                               .engine = engine,
                               .workers = 1};
    }
    return count;
}

static int32_t prepare(crowd *c, const bench_scene *scene, int32_t worlds)
{
    c->count = worlds, c->dt = scene->dt;
    const double heap = bench_heap_bytes(), start = us_now();
    if (!c->make(c, scene)) return 0;
    c->create_us = (us_now() - start) / worlds;
    for (int32_t k = 0; k < scene->warm_up_steps; k += STEPS) c->step(c);
    c->kilobytes = (bench_heap_bytes() - heap) / worlds / 1024.0;
    return 1;
}

static void time_rounds(crowd *crowds, int32_t count)
{
    for (int32_t round = 0; round < ROUNDS; round++)
        for (int32_t i = 0; i < count; i++) {
            crowd *c = &crowds[i];
            c->step(c); // into the caches, whose the last crowd was
            const double wall = 1e3 * bench_wall_ms(), start = us_now();
            c->step(c);
            c->us[round] = (us_now() - start) / STEPS / c->count;
            c->wall[round] = (1e3 * bench_wall_ms() - wall) / STEPS / c->count;
        }
    for (int32_t i = 0; i < count; i++) {
        const double start = us_now();
        if (crowds[i].reset != NULL) crowds[i].reset(&crowds[i]);
        crowds[i].reset_us = (us_now() - start) / crowds[i].count;
    }
}

static void tell(const bench_scene *scene, crowd *crowds, int32_t count)
{
    const double first = bench_stats_of(crowds[0].us, ROUNDS).median;
    printf("%s: %d bodies, %d joints, %d worlds\n", scene->name, (int)scene->body_count, (int)scene->joint_count,
           (int)crowds[0].count);
    printf("  %-36s %9s %9s %8s %9s %9s %9s %9s\n", "", "us a step", "wall", "to first", "ms a s", "KB", "create us",
           "reset us");
    for (int32_t i = 0; i < count; i++) {
        crowd *c = &crowds[i];
        const double us = bench_stats_of(c->us, ROUNDS).median, wall = bench_stats_of(c->wall, ROUNDS).median;
        printf("  %-36s %9.2f %9.2f %8.2f %9.2f", c->name, us, wall, us / first, us / (double)scene->dt / 1e3);
        if (c->kilobytes > 0)
            printf(" %9.1f", c->kilobytes);
        else
            printf(" %9s", "-"); // the C library cannot tell
        printf(" %9.1f", c->create_us);
        if (c->reset != NULL) printf(" %9.1f", c->reset_us);
        printf("\n");
    }
}

static int measure(const char *name, int32_t worlds)
{
    bench_scene scene;
    crowd crowds[MOST_RUNS];
    memset(crowds, 0, sizeof crowds);
    int32_t count = list_crowds(crowds), made = 0;
    if (bench_scene_build(name, &scene) != 0) return -1;
    for (int32_t i = 0; i < count; i++) {
        crowds[made] = crowds[i];
        if (prepare(&crowds[made], &scene, worlds)) made++; // what cannot has said why
    }
    time_rounds(crowds, made);
    tell(&scene, crowds, made);
    for (int32_t i = 0; i < made; i++) crowds[i].destroy(&crowds[i]);
    bench_scene_destroy(&scene);
    return 0;
}

int bench_command_many(int argc, char **argv)
{
    const long worlds = argc > 0 ? strtol(argv[0], NULL, 10) : WORLDS;
    if (worlds < 1 || worlds > MOST_WORLDS) {
        fprintf(stderr, "feather-bench: many [WORLDS]: 1 to %d\n", MOST_WORLDS);
        return 2;
    }
#ifndef FE_BENCH_MUJOCO
    printf("without mujoco: install libmujoco-dev and build again\n");
#endif
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        if (measure(scenes[i], (int32_t)worlds) != 0) return 2;
    return 0;
}
