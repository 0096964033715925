// `feather-bench worse`, and the end of `compare`: is there a scene in which Feather does worse than another engine?
// Read from the tables that scenes.c writes. Worse is
//
//   falls          a criterion for all engines that the other holds and Feather does not
//   drifts         what should stay moves farther than in the other engine by more than the linear slop
//   opens          a joint's gap is beyond its bound (the predictor of soft joints, or the linear slop) and beyond the
//   other's gains energy   more than the other by a thousandth of what is turned over, motors and forces apart
//
// Heights of soft stacks are Feather's own: other engines' contacts have skins and slops of their own, which add up
// over a stack. Cases too long for an engine are not compared. Box2D and ODE at the default substeps count for the exit
// code; the rest is told.
#include "worse.h"

#include "bench.h"
#include "memory.h"
#include "trial.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_SUBSTEPS = 8 };
static const double ENERGY_MARGIN = 1e-3;

typedef struct row {
    char scene[64], engine[16], kind[16], what[96];
    int32_t substeps; // 0: not Feather
    double value, low, high;
    int32_t ok;
} row;

typedef struct rows {
    row *items;
    int32_t count, capacity;
} rows;

// ---- the tables ----------------------------------------------------------------------------------------------------

static int32_t read_row(row *out, const char *line)
{
    const char *measure = strchr(line, '"');
    double ms;
    memset(out, 0, sizeof *out);
    if (measure == NULL || sscanf(line, "%63[^,],%15[^,],%d", out->scene, out->engine, &out->substeps) < 2) return 0;
    if (strcmp(out->engine, bench_feather.name) != 0) out->substeps = 0;
    return sscanf(measure, "\"%95[^\"]\",%lf,%lf,%lf,%d,%lf,%*[^,],%15[^,]", out->what, &out->value, &out->low,
                  &out->high, &out->ok, &ms, out->kind) == 7;
}

static int read_rows(rows *all, const char *path)
{
    char line[2048];
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        fprintf(stderr, "feather-bench: %s: %s\n", path, strerror(errno));
        return -1;
    }
    while (fgets(line, sizeof line, file) != NULL) {
        row r;
        if (!read_row(&r, line)) continue; // the heading
        if (all->count == all->capacity) {
            all->capacity = 2 * all->capacity + 1024;
            all->items = bench_resize(all->items, (size_t)all->capacity, sizeof *all->items);
        }
        all->items[all->count++] = r;
    }
    fclose(file);
    return 0;
}

static const row *find_row(const rows *all, const row *like, const char *engine)
{
    for (int32_t i = 0; i < all->count; i++) {
        const row *r = &all->items[i];
        if (strcmp(r->scene, like->scene) == 0 && strcmp(r->engine, engine) == 0 && strcmp(r->what, like->what) == 0)
            return r;
    }
    return NULL;
}

// ---- the judgement -------------------------------------------------------------------------------------------------

static int32_t is_kind(const row *r, bench_kind kind) { return strcmp(r->kind, bench_kind_names[kind]) == 0; }

// What Feather does worse in this row; NULL: nothing
static const char *verdict(const row *ours, const row *theirs)
{
    const int32_t opens = is_kind(ours, BENCH_OPEN) || is_kind(ours, BENCH_OWN_OPEN);
    if (opens) return !ours->ok && ours->value > theirs->value ? "opens" : NULL;
    if (is_kind(ours, BENCH_OWN)) return NULL;
    if (!ours->ok && theirs->ok) return "falls";
    if (is_kind(ours, BENCH_STRAY) && ours->value > theirs->value + BENCH_LINEAR_SLOP) return "drifts";
    if (strcmp(ours->what, bench_measure_names[BENCH_M_ENERGY]) == 0 && ours->value > theirs->value + ENERGY_MARGIN)
        return "gains energy";
    return NULL;
}

static void print_verdict(const row *ours, const row *theirs, const char *worse)
{
    char bound[48] = "";
    if (strcmp(ours->kind, "measure") != 0) snprintf(bound, sizeof bound, " of [%.4g, %.4g]", ours->low, ours->high);
    printf("%s, %d substeps: %s worse than %s\n    %s: %.4g%s, %.4g there\n", ours->scene, ours->substeps, worse,
           theirs->engine, ours->what, ours->value, bound, theirs->value);
}

int bench_worse(const char *const *paths, int32_t count)
{
    static const char *const peers[] = {"box2d", "ode", "bullet"};
    enum { PEERS = 3, THAT_COUNT = 2 };
    rows all = {NULL, 0, 0};
    int32_t worse = 0, compared[PEERS] = {0};
    for (int32_t i = 0; i < count; i++) {
        if (read_rows(&all, paths[i]) == 0) continue;
        free(all.items);
        return 2;
    }
    for (int32_t i = 0; i < all.count; i++) {
        const row *ours = &all.items[i];
        for (int32_t p = 0; p < PEERS && ours->substeps > 0; p++) {
            const row *theirs = find_row(&all, ours, peers[p]);
            if (theirs == NULL) continue;
            const char *what = verdict(ours, theirs);
            compared[p] += ours->substeps == DEFAULT_SUBSTEPS;
            if (what == NULL) continue;
            print_verdict(ours, theirs, what);
            worse += p < THAT_COUNT && ours->substeps == DEFAULT_SUBSTEPS;
        }
    }
    printf("%d substeps: worse than Box2D or ODE in %d measures\n"
           "    compared: %d with Box2D, %d with ODE; with Bullet, which does not count, %d\n",
           DEFAULT_SUBSTEPS, worse, compared[0], compared[1], compared[2]);
    free(all.items);
    return worse != 0;
}

int bench_command_worse(int argc, char **argv)
{
    if (argc == 0) {
        fprintf(stderr, "usage: feather-bench worse FILE.csv...\n");
        return 2;
    }
    return bench_worse((const char *const *)argv, argc);
}
