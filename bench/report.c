// Prints what was measured on a scene (report.h).
#include "report.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <sys/stat.h>

static const bench_run *find_run(const bench_table *table, const char *engine)
{
    for (int32_t i = 0; i < table->run_count; i++) {
        if (strcmp(table->runs[i].engine->name, engine) == 0) return &table->runs[i];
    }
    return NULL;
}

// How many times as long the named engine takes; "-" when it is this one or was not run.
static void print_ratio(const bench_table *table, const bench_run *run, const char *engine, double ours,
                        double (*of)(const bench_run *))
{
    const bench_run *other = find_run(table, engine);
    if (other == NULL || other == run || ours <= 0.0) {
        printf(" %7s", "-");
    } else {
        printf(" %7.2f", of(other) / ours);
    }
}

static double mean_of(const bench_run *run) { return run->stats.mean; }

static double median_of(const bench_run *run) { return run->stats.median; }

static double ray_us_of(const bench_run *run) { return run->ray_count > 0 ? 1e3 * run->ray_ms / run->ray_count : 0.0; }

static double cpu_of(const bench_run *run) { return run->sample_count > 0 ? run->cpu_ms / run->sample_count : 0.0; }

// "4w 8s": workers and substeps, where the engine takes them.
static void print_label(const bench_run *run)
{
    char settings[32] = "";
    if (run->engine->has_workers) snprintf(settings, sizeof settings, "%dw %ds", run->workers, run->substeps);
    printf("%-8s %-7s", run->engine->name, settings);
}

void bench_print_table(const bench_table *table)
{
    const bench_scene *scene = &table->scene;
    printf("\n%s: %d bodies; of one worker the processor's time, of more the wall's\n", scene->name, scene->body_count);
    printf("%-16s %8s %8s %8s %8s | %15s %15s | %8s %8s %8s %8s %8s %8s\n", "", "ms mean", "median", "p99", "cpu",
           "bullet/ mean,med", "ode/ mean,med", "top m", "deep mm", "drift mm", "z mm", "gap mm", "contacts");
    for (int32_t i = 0; i < table->run_count; i++) {
        const bench_run *run = &table->runs[i];
        print_label(run);
        printf(" %8.3f %8.3f %8.3f %8.3f |", run->stats.mean, run->stats.median, run->stats.p99, cpu_of(run));
        print_ratio(table, run, "bullet", run->stats.mean, mean_of);
        print_ratio(table, run, "bullet", run->stats.median, median_of);
        print_ratio(table, run, "ode", run->stats.mean, mean_of);
        print_ratio(table, run, "ode", run->stats.median, median_of);
        printf(" | %8.3f %8.2f %8.1f %8.2f %8.2f %8d%s\n", run->quality.top_height, 1e3 * run->contacts.deepest,
               1e3 * run->quality.drift, 1e3 * run->quality.z_offset, 1e3 * run->quality.gap, run->contacts.pairs,
               run->quality.finite ? "" : "  NOT FINITE");
    }
    for (int32_t i = 0; i < table->run_count; i++) {
        const bench_run *run = &table->runs[i];
        if (run->engine->read_hash == NULL) continue;
        print_label(run);
        printf(" hash %016" PRIx64 "\n", run->hash);
    }
    fflush(stdout);
}

void bench_print_overlaps(const bench_table *table)
{
    printf("%s: bodies in each other, by the bench's own measure\n%-16s %8s %10s %8s %10s %12s %6s\n",
           table->scene.name, "", "pairs", "deepest mm", "p99 mm", "median mm", "in ground mm", "lost");
    for (int32_t i = 0; i < table->run_count; i++) {
        const bench_overlaps *o = &table->runs[i].overlaps;
        print_label(&table->runs[i]);
        printf(" %8d %10.2f %8.2f %10.3f %12.2f %6d\n", o->pairs, 1e3 * o->deepest, 1e3 * o->p99, 1e3 * o->median,
               1e3 * o->into_ground, o->lost);
    }
    fflush(stdout);
}

void bench_print_rays(const bench_table *table)
{
    printf("%s: rays\n%-16s %10s %10s %10s %15s\n", table->scene.name, "", "us a ray", "hits", "fraction",
           "bullet/ ode/");
    for (int32_t i = 0; i < table->run_count; i++) {
        const bench_run *run = &table->runs[i];
        print_label(run);
        printf(" %10.3f %10d %10.6f", ray_us_of(run), run->ray_hits, run->ray_fractions);
        print_ratio(table, run, "bullet", ray_us_of(run), ray_us_of);
        print_ratio(table, run, "ode", ray_us_of(run), ray_us_of);
        printf("\n");
    }
    fflush(stdout);
}

void bench_print_profiles(const bench_table *table)
{
    for (int32_t i = 0; i < table->run_count; i++) {
        const bench_run *run = &table->runs[i];
        if (run->engine->phase_names == NULL) continue;
        print_label(run);
        printf(" ms a step:");
        for (int32_t p = 0; run->engine->phase_names[p] != NULL; p++) {
            printf(" %s %.3f", run->engine->phase_names[p],
                   run->sample_count > 0 ? run->phases[p] / run->sample_count : 0.0);
        }
        const bench_counters *c = &run->counters;
        printf("\n%16s islands %d, colours %d, rows %d (%.0f %% whole), fill %.0f %%, contacts %d (%d recycled), %.1f "
               "KB\n",
               "", c->islands, c->colours, c->rows, 100.0 * c->whole_share, 100.0 * c->fill, c->contacts, c->recycled,
               (double)c->bytes / 1024.0);
    }
    fflush(stdout);
}

FILE *bench_csv_open(const char *path)
{
    char folder[1024];
    const char *slash = strrchr(path, '/');
    if (slash != NULL && slash != path && (size_t)(slash - path) < sizeof folder) {
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - path), path);
        (void)mkdir(folder, 0777); // that it exists is the usual case; whatever else is wrong, fopen tells
    }
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        fprintf(stderr, "feather-bench: %s: %s\n", path, strerror(errno));
        return NULL;
    }
    fprintf(file, "scene,engine,workers,substeps,ms_per_step,ms_median,ms_p99,top_height,deepest_overlap,drift,"
                  "contacts,points,z_offset,joint_gap,"
                  "ms_cpu,ms_least,steps,bodies,ray_us,ray_hits,islands,rows,rows_whole,fill,recycled,bytes,hash,"
                  "overlaps,overlap_deepest,overlap_p99,overlap_median,into_ground,lost\n");
    return file;
}

// Columns that an engine does not know stay empty.
void bench_csv_write(FILE *file, const bench_table *table)
{
    for (int32_t i = 0; i < table->run_count; i++) {
        const bench_run *run = &table->runs[i];
        const bench_stats *s = &run->stats;
        fprintf(file, "%s,%s,", table->scene.name, run->engine->name);
        if (run->engine->has_workers) {
            fprintf(file, "%d,%d,", run->workers, run->substeps);
        } else {
            fprintf(file, "1,,");
        }
        fprintf(file, "%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%d,%d,%.6f,%.6f,", s->mean, s->median, s->p99,
                run->quality.top_height, run->contacts.deepest, run->quality.drift, run->contacts.pairs,
                run->contacts.points, run->quality.z_offset, run->quality.gap);
        fprintf(file, "%.6f,%.6f,%d,%d,", cpu_of(run), s->least, run->sample_count, table->scene.body_count);
        if (run->ray_count > 0) {
            fprintf(file, "%.6f,%d,", ray_us_of(run), run->ray_hits);
        } else {
            fprintf(file, ",,");
        }
        const bench_counters *c = &run->counters;
        if (run->engine->read_counters != NULL) {
            fprintf(file, "%d,%d,%.4f,%.4f,%d,%" PRId64 ",", c->islands, c->rows, c->whole_share, c->fill, c->recycled,
                    c->bytes);
        } else {
            fprintf(file, ",,,,,,");
        }
        if (run->engine->read_hash != NULL) fprintf(file, "%016" PRIx64, run->hash);
        const bench_overlaps *o = &run->overlaps;
        if (table->scene.ground != BENCH_GROUND_NONE) {
            fprintf(file, ",%d,%.6f,%.6f,%.6f,%.6f,%d\n", o->pairs, o->deepest, o->p99, o->median, o->into_ground,
                    o->lost);
        } else {
            fprintf(file, ",,,,,,\n");
        }
    }
    fflush(file);
}
