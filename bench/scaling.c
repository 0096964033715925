// `feather-bench scaling [--scene FAMILY[,FAMILY]] [--workers N[,N]] [--steps MOST] [--out FILE]`: time and memory of
// scenes of 100 to 100 000 bodies, with one worker and two. Writes build/scaling.csv and, beside it, the same as a
// plot. Then the memory of heaps, awake and asleep; FE_SIMD=sse2, avx2... chooses the lanes.
//
// The machine says how many workers can be measured. For more, what binds is told instead: how many barriers a step
// has, on which all workers of a large island wait, and the share of the step that is not parallel.
#include "bench.h"

#include "memory.h"
#include "options.h"
#include "peers/peer.h"
#include "stats.h"
#include "svg.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    SIZES = 7,
    MOST_LINES = BENCH_MAX_SERIES,
    SUBSTEPS = 4,
    LEAST_STEPS = 10,
    MOST_STEPS = 200,
    WARM_UP = 20,
    PER_COLOUR = 2,
    PER_SUBSTEP = 2
};
static const double BODY_STEPS = 4e5; // steps times bodies of one measurement

// n of a family whose scene has at least so many bodies
static const struct family {
    const char *name;
    int32_t n[SIZES];
} families[] = {
    {"rest", {100, 316, 1000, 3160, 10000, 31600, 100000}},
    {"many", {2, 3, 5, 8, 14, 24, 43}},          // 55 n2 boxes
    {"joints", {10, 18, 32, 57, 100, 178, 317}}, // n2 bodies
};
enum { FAMILIES = (int)(sizeof families / sizeof families[0]) };

typedef struct line {
    char name[64];
    double bodies[SIZES], us[SIZES];
    int32_t count;
} line;

typedef struct sample {
    double ms;     // of the fastest step: other programs slow the rest
    double serial; // share of a step that one worker does alone
    bench_counters counters;
    uint64_t hash;
} sample;

// Of the step, what no second worker shortens: islands and sleep. (finalize and events merge their workers' lists,
// which their phases do not tell apart.)
static void add_serial(bench_world *world, double *serial, double *all)
{
    double ms[BENCH_MAX_PHASES];
    bench_feather.read_phases(world, ms);
    *all += ms[0];
    for (int32_t p = 0; bench_feather.phase_names[p] != NULL; p++) {
        if (strcmp(bench_feather.phase_names[p], "islands") == 0 || strcmp(bench_feather.phase_names[p], "sleep") == 0)
            *serial += ms[p];
    }
}

static int measure(const bench_scene *scene, int32_t workers, int32_t most, sample *out)
{
    const int32_t wanted = (int32_t)(BODY_STEPS / scene->body_count), limit = most > 0 ? most : MOST_STEPS;
    const int32_t steps = wanted < LEAST_STEPS ? LEAST_STEPS : wanted > limit ? limit : wanted;
    double *ms = bench_allocate((size_t)steps, sizeof *ms);
    bench_world *world = bench_feather.create(scene, workers, SUBSTEPS);
    int status = world == NULL ? -1 : 0;
    memset(out, 0, sizeof *out);
    double serial = 0.0, all = 0.0;
    for (int32_t i = -WARM_UP; i < steps && status == 0; i++) {
        const double start = bench_wall_ms();
        status = bench_feather.step(world, scene->dt);
        if (i >= 0) ms[i] = bench_wall_ms() - start, add_serial(world, &serial, &all);
    }
    if (status == 0) {
        out->ms = bench_stats_of(ms, steps).least;
        out->serial = all > 0.0 ? serial / all : 0.0;
        bench_feather.read_counters(world, &out->counters);
        out->hash = bench_feather.read_hash(world);
    }
    if (world != NULL) bench_feather.destroy(world);
    free(ms);
    return status;
}

// Solve and relax pass once over each colour of a large island, integrate and carry over its bodies.
static int32_t barriers_of(const bench_counters *c)
{
    return c->whole_share < 1.0 ? SUBSTEPS * (PER_COLOUR * c->colours + PER_SUBSTEP) : 0;
}

// Bytes of one worker: several have lists of their own, as long as what each happened to take.
static void write_sample(FILE *csv, const bench_scene *scene, int32_t workers, const sample *s)
{
    const double us = 1e3 * s->ms / scene->body_count, each = (double)s->counters.bytes / scene->body_count;
    char bytes[32] = "";
    if (workers == 1) snprintf(bytes, sizeof bytes, "%.1f", each);
    printf("%-16s %8d %3d %10.4f %10.3f %10s %8.3f %6d\n", scene->name, scene->body_count, workers, s->ms, us, bytes,
           s->serial, barriers_of(&s->counters));
    fprintf(csv, "%s,%d,%d,%d,%.6f,%.6f,%s,%.4f,%d\n", scene->name, scene->body_count, s->counters.contacts, workers,
            s->ms, us, bytes, s->serial, barriers_of(&s->counters));
    fflush(stdout);
}

static int run_family(const struct family *family, const bench_options *o, FILE *csv, line *lines)
{
    static const int32_t usual[] = {1, 2};
    const int32_t count = o->worker_count > 0 ? o->worker_count : 2,
                  *workers = o->worker_count > 0 ? o->workers : usual;
    for (int32_t w = 0; w < count; w++)
        snprintf(lines[w].name, sizeof lines[w].name, "%s, %d worker%s", family->name, workers[w],
                 workers[w] > 1 ? "s" : "");
    for (int32_t i = 0; i < SIZES; i++) {
        bench_scene scene;
        char name[64];
        uint64_t hash = 0;
        snprintf(name, sizeof name, "%s-%d", family->name, family->n[i]);
        if (bench_scene_build(name, &scene) != 0) return -1;
        for (int32_t w = 0; w < count; w++) {
            sample s;
            if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K%s, %d workers\r", name, workers[w]);
            if (measure(&scene, workers[w], o->steps, &s) != 0) return -1;
            if (w > 0 && s.hash != hash)
                fprintf(stderr, "*** %s ends differently with %d workers ***\n", name, workers[w]);
            hash = s.hash;
            write_sample(csv, &scene, workers[w], &s);
            lines[w].bodies[lines[w].count] = scene.body_count,
            lines[w].us[lines[w].count++] = 1e3 * s.ms / scene.body_count;
        }
        bench_scene_destroy(&scene);
    }
    return 0;
}

// ---- memory of heaps -----------------------------------------------------------------------------------------------
static const struct heap {
    const char *family, *scene;
} heaps[] = {{"debris", "debris-2000"}, {"debris", "debris-10000"}, {"balls", "balls-2000"},
             {"balls", "balls-10000"},  {"bowl", "bowl-2000"},      {"bowl", "bowl-10000"}};
enum { HEAPS = (int)(sizeof heaps / sizeof heaps[0]) };

// The most bytes while the heap is poured, and those of the heap asleep
static int measure_heap(const char *name)
{
    enum { STEPS = 300 };
    bench_scene scene;
    bench_counters now = {0};
    if (bench_scene_build(name, &scene) != 0) return -1;
    bench_world *world = bench_feather.create(&scene, 1, SUBSTEPS);
    int64_t most = 0;
    int32_t contacts = 0;
    int status = world == NULL ? -1 : 0;
    for (int32_t i = 0; i < STEPS && status == 0; i++) {
        status = bench_feather.step(world, scene.dt);
        bench_feather.read_counters(world, &now);
        if (now.bytes > most) most = now.bytes;
        contacts = now.contacts;
    }
    if (status == 0) {
        bench_feather.fall_asleep(world);
        status = bench_feather.step(world, scene.dt);
        bench_feather.read_counters(world, &now);
        printf("%-16s %8d %10.1f %12.0f %12.0f\n", name, scene.body_count, (double)contacts / scene.body_count,
               (double)most / scene.body_count, (double)now.bytes / scene.body_count);
        fflush(stdout);
    }
    if (world != NULL) bench_feather.destroy(world);
    bench_scene_destroy(&scene);
    return status;
}

static int is_asked(const bench_options *o, const char *family)
{
    for (int32_t i = 0; i < o->scene_count; i++) {
        if (strcmp(o->scenes[i], family) == 0) return 1;
    }
    return o->scene_count == 0;
}

static int draw(const char *path, const line *lines)
{
    bench_series series[MOST_LINES];
    int32_t count = 0;
    for (int32_t i = 0; i < MOST_LINES; i++) {
        if (lines[i].count > 0)
            series[count++] = (bench_series){lines[i].name, lines[i].bodies, lines[i].us, lines[i].count};
    }
    return count > 0 ? bench_svg_lines(path, "Time of a step for each body, 4 substeps", "bodies",
                                       "microseconds a body and step", series, count)
                     : 0;
}

int bench_command_scaling(int argc, char **argv)
{
    bench_options o;
    static line lines[MOST_LINES + BENCH_MAX_NUMBERS];
    if (bench_options_parse(&o, argc, argv) != 0) return 2;
    const char *path = o.out_given ? o.out : "build/scaling.csv";
    FILE *csv = fopen(path, "w");
    if (csv == NULL) {
        fprintf(stderr, "feather-bench: %s: %s\n", path, strerror(errno));
        return 1;
    }
    fprintf(csv, "scene,bodies,contacts,workers,ms,us_a_body,bytes_a_body,serial_share,barriers\n");
    printf("%-16s %8s %3s %10s %10s %10s %8s %6s\n", "scene", "bodies", "w", "ms a step", "us a body", "bytes each",
           "serial", "barriers");
    int status = 0;
    int32_t next = 0;
    for (int32_t i = 0; i < FAMILIES && status == 0; i++) {
        if (!is_asked(&o, families[i].name) || next >= MOST_LINES) continue;
        status = run_family(&families[i], &o, csv, lines + next);
        next += o.worker_count > 0 ? o.worker_count : 2;
    }
    fclose(csv);
    printf("\n%-16s %8s %10s %12s %12s\n", "heap", "bodies", "contacts", "bytes awake", "asleep");
    for (int32_t i = 0; i < HEAPS && status == 0; i++)
        if (is_asked(&o, heaps[i].family)) status = measure_heap(heaps[i].scene);
    return status == 0 && draw(bench_svg_path(path), lines) == 0 ? 0 : 1;
}
