// `feather-bench profile SCENE [--workers N] [--substeps N] [--steps N] [--out FILE]`: where the time of a step goes in
// Feather, on a scene or a case, phase by phase. Writes build/profile.csv.
#include "bench.h"

#include "memory.h"
#include "options.h"
#include "stats.h"
#include "trial.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { SUBSTEPS = 4, CASE_STEPS = 200, BAR = 40 };

// The scene, or a case's scene without its script.
static int build(const char *name, bench_scene *out)
{
    int32_t planar = 0;
    const bench_case *rule = bench_case_find(name, &planar);
    if (rule == NULL) return bench_scene_build(name, out);
    bench_trial_build(out, rule, planar);
    out->timed_steps = CASE_STEPS;
    return 0;
}

static int run(bench_world *world, const bench_scene *scene, int32_t steps, double *sums)
{
    double ms[BENCH_MAX_PHASES];
    for (int32_t i = 0; i < scene->warm_up_steps + steps; i++) {
        if (isatty(STDERR_FILENO))
            fprintf(stderr, "\r\033[K%s: step %d/%d", scene->name, i, scene->warm_up_steps + steps);
        if (bench_feather.step(world, scene->dt) != 0) return -1;
        bench_feather.read_phases(world, ms);
        for (int32_t p = 0; i >= scene->warm_up_steps && bench_feather.phase_names[p] != NULL; p++) sums[p] += ms[p];
    }
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K");
    return 0;
}

static void print(const bench_scene *scene, bench_world *world, int32_t steps, const double *sums, FILE *csv)
{
    bench_counters c;
    bench_feather.read_counters(world, &c);
    printf("%s: %d bodies, %d contacts (%d recycled), %d islands, %d rows (%.0f %% in batches of one worker, %.0f %% "
           "of their lanes "
           "filled), %.1f MB\n",
           scene->name, scene->body_count, c.contacts, c.recycled, c.islands, c.rows, 100.0 * c.whole_share,
           100.0 * c.fill, (double)c.bytes / 1048576.0);
    fprintf(csv, "scene,phase,ms,share\n");
    for (int32_t p = 0; bench_feather.phase_names[p] != NULL; p++) {
        const double share = sums[0] > 0.0 ? sums[p] / sums[0] : 0.0;
        printf("  %-12s %9.4f ms %5.1f %% %.*s\n", bench_feather.phase_names[p], sums[p] / steps, 100.0 * share,
               (int)(BAR * share), "########################################");
        fprintf(csv, "%s,%s,%.6f,%.4f\n", scene->name, bench_feather.phase_names[p], sums[p] / steps, share);
    }
}

static int profile(const char *name, const bench_options *o, FILE *csv)
{
    bench_scene scene;
    double sums[BENCH_MAX_PHASES] = {0.0};
    if (build(name, &scene) != 0) {
        fprintf(stderr, "feather-bench: no scene and no case \"%s\"; try: feather-bench list\n", name);
        return -1;
    }
    const int32_t steps = o->steps > 0 ? o->steps : scene.timed_steps;
    bench_world *world = bench_feather.create(&scene, o->worker_count > 0 ? o->workers[0] : 1,
                                              o->substep_count > 0 ? o->substeps[0] : SUBSTEPS);
    int status = world == NULL ? -1 : run(world, &scene, steps, sums);
    if (status == 0) print(&scene, world, steps, sums, csv);
    if (world != NULL) bench_feather.destroy(world);
    bench_scene_destroy(&scene);
    return status;
}

int bench_command_profile(int argc, char **argv)
{
    bench_options options;
    if (argc < 1 || argv[0][0] == '-') {
        fprintf(stderr, "usage: feather-bench profile SCENE [OPTION]...\n");
        return 2;
    }
    if (bench_options_parse(&options, argc - 1, argv + 1) != 0) return 2;
    const char *path = options.out_given ? options.out : "build/profile.csv";
    FILE *csv = fopen(path, "w");
    if (csv == NULL) {
        perror(path);
        return 1;
    }
    const int status = profile(argv[0], &options, csv);
    fclose(csv);
    return status != 0;
}
