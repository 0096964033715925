// `feather-bench speed`: time per step of every engine on the same scenes.
//
// A shared machine drifts by half within minutes, so the engines take turns: a block of steps each, round after round,
// and the noise hits all alike. What holds are the ratios of one run. The first step of a block runs with caches full
// of another engine's data, which no game would see: it is made and not counted.
#include "bench.h"

#include "memory.h"
#include "options.h"
#include "random.h"
#include "report.h"
#include "run.h"
#include "start.h"
#include "svg.h"
#include "trial.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    BLOCK_STEPS = 10,
    RAY_COUNT = 20000,
    RAY_BLOCK = 1000,
};

static const uint64_t RAY_SEED = 0x1234567u;

// ---- progress ------------------------------------------------------------------------------------------------------

static void show_progress(const bench_scene *scene, const char *what, int32_t done, int32_t all)
{
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K%s: %s %d/%d", scene->name, what, done, all);
}

static void end_progress(void)
{
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K");
}

// ---- which engines -------------------------------------------------------------------------------------------------

static void add_run(bench_table *table, const bench_engine *engine, int32_t workers, int32_t substeps)
{
    if (table->run_count == BENCH_MAX_RUNS) return;
    bench_run *run = &table->runs[table->run_count++];
    memset(run, 0, sizeof *run);
    run->engine = engine;
    if (engine->has_workers) run->workers = workers, run->substeps = substeps;
}

static void add_feather_runs(bench_table *table, const bench_options *options)
{
    if (options->worker_count == 0 && options->substep_count == 0) {
        add_run(table, &bench_feather, 1, 4);
        add_run(table, &bench_feather, 1, 8);
        add_run(table, &bench_feather, 2, 4);
        return;
    }
    const int32_t one = 1, four = 4;
    const int32_t *workers = options->worker_count > 0 ? options->workers : &one;
    const int32_t *substeps = options->substep_count > 0 ? options->substeps : &four;
    const int32_t worker_count = options->worker_count > 0 ? options->worker_count : 1;
    const int32_t substep_count = options->substep_count > 0 ? options->substep_count : 1;
    for (int32_t w = 0; w < worker_count; w++) {
        for (int32_t s = 0; s < substep_count; s++) add_run(table, &bench_feather, workers[w], substeps[s]);
    }
}

static int is_asked(const bench_options *options, const char *peer)
{
    if (options->no_peers) return 0;
    for (int32_t i = 0; i < options->peer_count; i++) {
        if (strcmp(options->peers[i], peer) == 0) return 1;
    }
    return options->peer_count == 0;
}

static void add_peer_runs(bench_table *table, const bench_options *options)
{
    for (int32_t i = 0; i < bench_engine_count; i++) {
        const bench_engine_entry *entry = &bench_engines[i];
        if (entry->engine == &bench_feather || !is_asked(options, entry->name)) continue;
        if (entry->engine != NULL && (table->scene.planar || !entry->engine->planar_only))
            add_run(table, entry->engine, 0, 0);
    }
}

// A peer that is missing is not passed over in silence: without it, the ratios are.
static int check_peers(const bench_options *options)
{
    for (int32_t i = 0; i < bench_engine_count; i++) {
        const bench_engine_entry *entry = &bench_engines[i];
        if (entry->engine != NULL || !is_asked(options, entry->name)) continue;
        fprintf(stderr, "*** %s IS MISSING: install %s and build again ***\n", entry->name, entry->package);
    }
    for (int32_t p = 0; p < options->peer_count; p++) {
        int32_t i = 0;
        while (i < bench_engine_count && strcmp(bench_engines[i].name, options->peers[p]) != 0) i++;
        if (i == bench_engine_count) {
            fprintf(stderr, "feather-bench: no engine \"%s\"; try: feather-bench list\n", options->peers[p]);
            return -1;
        }
    }
    return 0;
}

// ---- worlds --------------------------------------------------------------------------------------------------------

static int create_world(bench_table *table, bench_run *run, int32_t steps)
{
    run->world = run->engine->create(&table->scene, run->workers, run->substeps);
    if (run->world == NULL) {
        fprintf(stderr, "*** %s cannot build %s ***\n", run->engine->name, table->scene.name);
        return run->engine == &bench_feather ? -1 : 0; // the table does without a peer
    }
    run->samples = bench_allocate((size_t)steps, sizeof *run->samples);
    return bench_check_start(run->engine, run->world, &table->scene);
}

// ---- time ----------------------------------------------------------------------------------------------------------

static void add_phases(bench_run *run)
{
    double ms[BENCH_MAX_PHASES];
    if (run->engine->phase_names == NULL) return;
    run->engine->read_phases(run->world, ms);
    for (int32_t p = 0; run->engine->phase_names[p] != NULL; p++) run->phases[p] += ms[p];
}

// With one worker a step's time is the processor's, which knows nothing of what else the machine does; with several,
// the wall's, which is what they are for.
static int time_block(bench_run *run, float dt, int32_t steps)
{
    for (int32_t i = 0; i < steps; i++) {
        double cpu = bench_cpu_ms(), wall = bench_wall_ms();
        if (run->engine->step(run->world, dt) != 0) return -1;
        wall = bench_wall_ms() - wall;
        cpu = bench_cpu_ms() - cpu;
        if (i == 0 && steps > 1) continue; // cold caches
        run->samples[run->sample_count++] = run->workers > 1 ? wall : cpu;
        run->cpu_ms += cpu;
        add_phases(run);
    }
    return 0;
}

static int warm_up(bench_table *table)
{
    const bench_scene *scene = &table->scene;
    for (int32_t r = 0; r < table->run_count; r++) {
        show_progress(scene, "warm-up", r, table->run_count);
        for (int32_t i = 0; i < scene->warm_up_steps; i++) {
            if (table->runs[r].engine->step(table->runs[r].world, scene->dt) != 0) return -1;
        }
    }
    return 0;
}

static int time_steps(bench_table *table, int32_t steps)
{
    for (int32_t done = 0; done < steps; done += BLOCK_STEPS) {
        show_progress(&table->scene, "step", done, steps);
        int32_t block = steps - done < BLOCK_STEPS ? steps - done : BLOCK_STEPS;
        for (int32_t r = 0; r < table->run_count; r++) {
            if (time_block(&table->runs[r], table->scene.dt, block) != 0) return -1;
        }
    }
    for (int32_t r = 0; r < table->run_count; r++)
        table->runs[r].stats = bench_stats_of(table->runs[r].samples, table->runs[r].sample_count);
    return 0;
}

// ---- rays ----------------------------------------------------------------------------------------------------------

static bench_ray *make_rays(void)
{
    bench_ray *rays = bench_allocate(RAY_COUNT, sizeof *rays);
    uint64_t state = RAY_SEED;
    for (int32_t i = 0; i < RAY_COUNT; i++) {
        double from[3], to[3];
        for (int axis = 0; axis < 3; axis++)
            from[axis] = axis == 1 ? 30.0 * bench_random(&state) : 40.0 * bench_random(&state) - 20.0;
        for (int axis = 0; axis < 3; axis++)
            to[axis] = axis == 1 ? 30.0 * bench_random(&state) - 5.0 : 40.0 * bench_random(&state) - 20.0;
        for (int axis = 0; axis < 3; axis++)
            rays[i].origin[axis] = from[axis], rays[i].translation[axis] = to[axis] - from[axis];
    }
    return rays;
}

// On the calling thread alone: the processor's clock knows nothing of what else the machine does.
static void time_ray_block(bench_run *run, const bench_ray *rays)
{
    double fractions = 0.0;
    int32_t hits = 0;
    double start = bench_cpu_ms();
    for (int32_t i = 0; i < RAY_BLOCK; i++) {
        double fraction = 0.0;
        hits += run->engine->raycast(run->world, &rays[i], &fraction);
        fractions += fraction;
    }
    run->ray_ms += bench_cpu_ms() - start;
    run->ray_count += RAY_BLOCK;
    run->ray_hits += hits;
    run->ray_fractions += fractions;
}

static void time_rays(bench_table *table)
{
    bench_ray *rays = make_rays();
    for (int32_t done = 0; done < RAY_COUNT; done += RAY_BLOCK) {
        show_progress(&table->scene, "ray", done, RAY_COUNT);
        for (int32_t r = 0; r < table->run_count; r++) time_ray_block(&table->runs[r], rays + done);
    }
    for (int32_t r = 0; r < table->run_count; r++) {
        if (table->runs[r].ray_hits > 0) table->runs[r].ray_fractions /= table->runs[r].ray_hits;
    }
    free(rays);
}

// ---- what became of the scene --------------------------------------------------------------------------------------

static bench_quality measure_quality(const bench_scene *scene, const bench_pose *poses)
{
    bench_quality quality = {-HUGE_VAL, 0.0, 0.0, 0.0, 1};
    for (int32_t i = 0; i < scene->body_count; i++) {
        if (!scene->bodies[i].dynamic) continue;
        const double *p = poses[i].position, *start = scene->bodies[i].start.position;
        double x = p[0] - start[0], z = p[2] - start[2], drift = sqrt(x * x + z * z);
        if (!isfinite(drift) || !isfinite(p[1])) quality.finite = 0;
        if (p[1] > quality.top_height) quality.top_height = p[1];
        if (drift > quality.drift) quality.drift = drift;
        if (fabs(z) > quality.z_offset) quality.z_offset = fabs(z);
    }
    for (int32_t i = 0; i < scene->joint_count; i++) quality.gap = fmax(quality.gap, bench_joint_gap(scene, poses, i));
    return quality;
}

static int measure_end(bench_table *table, bench_run *run)
{
    const bench_engine *engine = run->engine;
    engine->read_poses(run->world, table->poses);
    run->quality = measure_quality(&table->scene, table->poses);
    if (table->scene.ground != BENCH_GROUND_NONE) run->overlaps = bench_measure_overlaps(&table->scene, table->poses);
    if (engine->read_counters != NULL) engine->read_counters(run->world, &run->counters);
    if (engine->read_hash != NULL) run->hash = engine->read_hash(run->world);
    if (!run->quality.finite) fprintf(stderr, "*** %s: NaN or infinity on %s ***\n", engine->name, table->scene.name);
    return run->quality.finite ? 0 : -1;
}

// The bits must not depend on the number of workers.
static int check_hashes(const bench_table *table)
{
    int status = 0;
    for (int32_t i = 0; i < table->run_count; i++) {
        const bench_run *a = &table->runs[i];
        for (int32_t k = i + 1; k < table->run_count; k++) {
            const bench_run *b = &table->runs[k];
            if (a->engine != b->engine || a->engine->read_hash == NULL || a->substeps != b->substeps ||
                a->hash == b->hash)
                continue;
            fprintf(stderr, "*** %s: %s ends differently with %d and %d workers ***\n", table->scene.name,
                    a->engine->name, a->workers, b->workers);
            status = -1;
        }
    }
    return status;
}

// ---- the command ---------------------------------------------------------------------------------------------------

static int run_table(bench_table *table, const bench_options *options)
{
    int32_t steps = options->steps > 0 ? options->steps : table->scene.timed_steps;
    int32_t kept = 0;
    for (int32_t r = 0; r < table->run_count; r++) {
        if (create_world(table, &table->runs[r], steps) != 0) return -1;
        if (table->runs[r].world != NULL) table->runs[kept++] = table->runs[r];
    }
    table->run_count = kept;
    if (warm_up(table) != 0 || time_steps(table, steps) != 0) return -1;
    int status = 0;
    for (int32_t r = 0; r < table->run_count; r++) status |= measure_end(table, &table->runs[r]);
    status |= check_hashes(table);
    if (options->rays) time_rays(table);
    for (int32_t r = 0; r < table->run_count; r++)
        table->runs[r].engine->measure_contacts(table->runs[r].world, &table->runs[r].contacts);
    end_progress();
    bench_print_table(table);
    if (table->scene.ground != BENCH_GROUND_NONE) bench_print_overlaps(table);
    if (options->rays) bench_print_rays(table);
    if (options->profile) bench_print_profiles(table);
    return status;
}

// For the plot: times of each peer over Feather's first run, by median.
typedef struct ratios {
    char names[BENCH_MAX_SCENES][64];
    double over[2][BENCH_MAX_SCENES]; // Bullet, ODE
    int32_t count;
    int32_t workers, substeps; // of Feather's first run
} ratios;
static const char *const plotted[2] = {"bullet", "ode"};

static void note_ratios(const bench_table *table, ratios *out)
{
    if (out->count == BENCH_MAX_SCENES || table->run_count == 0 || table->runs[0].engine != &bench_feather) return;
    const int32_t i = out->count++;
    out->workers = table->runs[0].workers, out->substeps = table->runs[0].substeps;
    snprintf(out->names[i], sizeof out->names[i], "%s", table->scene.name);
    for (int k = 0; k < 2; k++) {
        out->over[k][i] = 0.0;
        for (int32_t r = 0; r < table->run_count; r++) {
            if (strcmp(table->runs[r].engine->name, plotted[k]) == 0)
                out->over[k][i] = table->runs[r].stats.median / table->runs[0].stats.median;
        }
    }
}

static int draw_ratios(const char *path, const ratios *all)
{
    const char *labels[BENCH_MAX_SCENES];
    const bench_series series[2] = {{"Bullet / Feather", NULL, all->over[0], all->count},
                                    {"ODE / Feather", NULL, all->over[1], all->count}};
    char title[96];
    for (int32_t i = 0; i < all->count; i++) labels[i] = all->names[i];
    snprintf(title, sizeof title, "Time of a step, as a multiple of Feather's with %d worker%s and %d substeps",
             all->workers, all->workers > 1 ? "s" : "", all->substeps);
    return all->count > 0 ? bench_svg_bars(path, title, labels, all->count, series, 2) : 0;
}

static int run_scene(const char *name, const bench_options *options, FILE *csv, ratios *all)
{
    bench_table *table = bench_allocate(1, sizeof *table);
    if (bench_scene_build(name, &table->scene) != 0) {
        fprintf(stderr, "feather-bench: no scene \"%s\"; try: feather-bench list\n", name);
        free(table);
        return -1;
    }
    table->poses = bench_allocate((size_t)table->scene.body_count, sizeof *table->poses);
    if (!options->no_feather) add_feather_runs(table, options);
    add_peer_runs(table, options);
    int status = run_table(table, options);
    end_progress();
    if (status == 0) bench_csv_write(csv, table), note_ratios(table, all);
    for (int32_t r = 0; r < table->run_count; r++) {
        if (table->runs[r].world != NULL) table->runs[r].engine->destroy(table->runs[r].world);
        free(table->runs[r].samples);
    }
    free(table->poses);
    bench_scene_destroy(&table->scene);
    free(table);
    return status;
}

int bench_command_speed(int argc, char **argv)
{
    bench_options options;
    if (bench_options_parse(&options, argc, argv) != 0 || check_peers(&options) != 0) return 2;
    FILE *csv = bench_csv_open(options.out);
    if (csv == NULL) return 1;
    static ratios all;
    int status = 0;
    for (int32_t i = 0; i < options.scene_count; i++) status |= run_scene(options.scenes[i], &options, csv, &all);
    for (int32_t i = 0; i < bench_family_count && options.scene_count == 0; i++) {
        if (bench_families[i].is_default) status |= run_scene(bench_families[i].name, &options, csv, &all);
    }
    fclose(csv);
    status |= draw_ratios(bench_svg_path(options.out), &all);
    return status == 0 ? 0 : 1;
}
