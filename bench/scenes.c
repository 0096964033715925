// `feather-bench scenes`, `run` and `compare`: the cases, judged by their criteria, in Feather and in the engines
// beside it. `tasks` names the runs that `compare` would make, for who makes them side by side (tools/proof).
#include "bench.h"

#include "memory.h"
#include "options.h"
#include "trial.h"
#include "worse.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { FEW = 4, MANY = 8 }; // substeps

typedef struct outcome {
    int32_t passed, known, failed,
        refused; // known: Feather misses what cases/known.c lists; refused: the engine cannot
} outcome;

static void show_progress(const char *name, const char *engine)
{
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K%s: %s", name, engine);
}

static void end_progress(void)
{
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K");
}

// ---- lines ---------------------------------------------------------------------------------------------------------

static void print_label(const bench_trial *t)
{
    char settings[16] = "";
    if (t->engine->has_workers) snprintf(settings, sizeof settings, "%d", t->substeps);
    printf("%-24s %-8s %-2s", t->scene.name, t->engine->name, settings);
}

static const char *cause_of(const bench_trial *t, const bench_check *c)
{
    return t->engine == &bench_feather && !bench_check_passed(t, c) ? bench_known_cause(t, c) : NULL;
}

// 1: every miss is a known one
static int32_t is_known(const bench_trial *t)
{
    for (int32_t i = 0; i < t->check_count; i++) {
        if (!bench_check_passed(t, &t->checks[i]) && cause_of(t, &t->checks[i]) == NULL) return 0;
    }
    return 1;
}

static void print_check(const bench_trial *t, const bench_check *c)
{
    printf("      %s %-44s %14.6g  in [%.6g, %.6g]%s\n", bench_check_passed(t, c) ? "  " : "->", c->what, c->value,
           c->low, c->high,
           (c->kind == BENCH_OWN || c->kind == BENCH_OWN_OPEN) && !t->engine->has_workers ? "  (Feather's own)" : "");
    if (t->variants > 1) printf("%65s%.6g to %.6g\n", "", c->from, c->to);
    if (cause_of(t, c) != NULL) printf("         known: %s\n", cause_of(t, c));
}

static void print_trial(const bench_trial *t, int32_t all_checks)
{
    print_label(t);
    printf(" %s %9.3f ms a step",
           bench_trial_passed(t) ? "ok   "
           : is_known(t)         ? "known"
                                 : "FAIL ",
           t->step > 0 ? t->ms / t->step : 0.0);
    if (t->variants > 1) printf(", medians of %d variants", t->variants);
    printf("\n");
    for (int32_t i = 0; i < t->check_count; i++) {
        if (all_checks || !bench_check_passed(t, &t->checks[i])) print_check(t, &t->checks[i]);
    }
    for (int32_t i = 0; i < BENCH_MEASURES && all_checks; i++) {
        if (!isnan(t->measures[i])) printf("         %-44s %14.6g\n", bench_measure_names[i], t->measures[i]);
    }
    fflush(stdout);
}

static void write_row(FILE *csv, const bench_trial *t, const bench_check *c, const char *kind, int32_t ok,
                      const char *cause)
{
    char settings[64];
    if (t->engine->has_workers)
        snprintf(settings, sizeof settings, "%d", t->substeps);
    else
        snprintf(settings, sizeof settings, "%s", t->engine->settings);
    fprintf(csv, "%s,%s,%s,\"%s\",%.9g,%.9g,%.9g,%d,%.6f,%016" PRIx64 ",%s,\"%s\"\n", t->scene.name, t->engine->name,
            settings, c->what, c->value, c->low, c->high, ok, t->step > 0 ? t->ms / t->step : 0.0, t->hash, kind,
            cause != NULL ? cause : "");
}

static void write_csv(FILE *csv, const bench_trial *t)
{
    for (int32_t i = 0; i < t->check_count; i++) {
        const bench_check *c = &t->checks[i];
        write_row(csv, t, c, bench_kind_names[c->kind], bench_check_passed(t, c), cause_of(t, c));
    }
    for (int32_t i = 0; i < BENCH_MEASURES; i++) {
        if (!isnan(t->measures[i]))
            write_row(csv, t, &(bench_check){.what = bench_measure_names[i], .value = t->measures[i]}, "measure", 1,
                      NULL);
    }
}

static FILE *open_csv(const char *path)
{
    FILE *csv = fopen(path, "w");
    if (csv == NULL) {
        fprintf(stderr, "feather-bench: %s: %s\n", path, strerror(errno));
        return NULL;
    }
    fprintf(csv, "case,engine,settings,measure,value,low,high,ok,ms_per_step,hash,kind,cause\n");
    return csv;
}

// ---- one case in one engine ----------------------------------------------------------------------------------------

typedef struct series {
    const bench_options *options;
    FILE *csv;
    int32_t all_checks; // print those that hold too
    int32_t only_named; // nothing runs
    outcome sum;
} series;

// Chaotic cases run in variants; those of many bodies in a quarter as many, and only where asked to. Other engines, ten
// times as slow, run once.
static int32_t variants_of(const bench_options *o, const bench_case *rule, const bench_engine *engine)
{
    const int32_t share = 4;
    if (!rule->is_chaotic || engine != &bench_feather) return 1;
    if (rule->is_chaotic == BENCH_CHAOTIC_LONG) return o->variants > share ? o->variants / share : 1;
    return o->variants > 0 ? o->variants : BENCH_VARIANTS;
}

// About how long a run takes, so that the longest may begin first
static void print_task(const series *s, const bench_case *rule, int32_t planar, const bench_engine *engine,
                       int32_t substeps)
{
    const double slower = engine == &bench_feather ? 1.0 : 20.0; // other engines
    bench_scene scene;
    bench_trial_build(&scene, rule, planar);
    const double steps = rule->seconds / (double)scene.dt * scene.body_count * variants_of(s->options, rule, engine);
    printf("%.0f %s %s %d\n", slower * steps, scene.name, engine->name, engine->has_workers ? substeps : 0);
    bench_scene_destroy(&scene);
}

static void try_case(series *s, const bench_case *rule, int32_t planar, const bench_engine *engine, int32_t substeps)
{
    if (s->only_named) {
        print_task(s, rule, planar, engine, substeps);
        return;
    }
    bench_trial trial;
    const int32_t workers = s->options->worker_count > 0 ? s->options->workers[0] : 1;
    const bench_setup setup = {rule, engine, planar, workers, engine->has_workers ? substeps : 0, 0, s->all_checks};
    show_progress(rule->name, engine->name);
    const int status = bench_trial_run_variants(&trial, &setup, variants_of(s->options, rule, engine));
    end_progress();
    if (status == 0) {
        print_trial(&trial, s->all_checks);
        write_csv(s->csv, &trial);
        *(bench_trial_passed(&trial) ? &s->sum.passed : is_known(&trial) ? &s->sum.known : &s->sum.failed) += 1;
    } else {
        s->sum.refused++;
    }
    bench_trial_free(&trial);
}

static void try_feather(series *s, const bench_case *rule, int32_t planar)
{
    static const int32_t usual[] = {FEW, MANY};
    const bench_options *o = s->options;
    const int32_t count = o->no_feather ? 0 : o->substep_count > 0 ? o->substep_count : 2;
    for (int32_t i = 0; i < count; i++)
        try_case(s, rule, planar, &bench_feather, o->substep_count > 0 ? o->substeps[i] : usual[i]);
}

static int32_t is_asked(const bench_options *o, const char *peer)
{
    if (o->no_peers) return 0;
    for (int32_t i = 0; i < o->peer_count; i++) {
        if (strcmp(o->peers[i], peer) == 0) return 1;
    }
    return o->peer_count == 0;
}

static void try_peers(series *s, const bench_case *rule, int32_t planar)
{
    for (int32_t i = 0; i < bench_engine_count; i++) {
        const bench_engine *engine = bench_engines[i].engine;
        if (engine == NULL || engine == &bench_feather || (engine->planar_only && !planar)) continue;
        if (is_asked(s->options, engine->name)) try_case(s, rule, planar, engine, 0);
    }
}

// ---- the commands --------------------------------------------------------------------------------------------------

static int try_named(series *s, const char *name, int32_t with_peers)
{
    int32_t planar = 0;
    const bench_case *rule = bench_case_find(name, &planar);
    if (rule == NULL) {
        fprintf(stderr, "feather-bench: no case \"%s\"; try: feather-bench list\n", name);
        return -1;
    }
    try_feather(s, rule, planar);
    if (with_peers) try_peers(s, rule, planar);
    return 0;
}

static void try_all(series *s, int32_t with_peers)
{
    for (int32_t i = 0; i < bench_case_count(); i++) {
        const bench_case *rule = bench_case_at(i);
        for (int32_t planar = rule->planar == BENCH_PLANAR_ONLY; planar <= (rule->planar != BENCH_NOT_PLANAR);
             planar++) {
            try_feather(s, rule, planar);
            if (with_peers) try_peers(s, rule, planar);
        }
    }
}

static int run_cases(int argc, char **argv, const char *out, int32_t with_peers, int32_t all_checks)
{
    bench_options options;
    if (bench_options_parse(&options, argc, argv) != 0) return 2;
    series s = {.options = &options, .all_checks = all_checks};
    s.csv = open_csv(options.out_given ? options.out : out);
    if (s.csv == NULL) return 1;
    int status = 0;
    for (int32_t i = 0; i < options.scene_count; i++) status |= try_named(&s, options.scenes[i], with_peers);
    if (options.scene_count == 0) try_all(&s, with_peers);
    fclose(s.csv);
    printf("%d passed, %d miss what is known, %d failed, %d refused\n", s.sum.passed, s.sum.known, s.sum.failed,
           s.sum.refused);
    return status == 0 && (with_peers || s.sum.failed + s.sum.refused == 0) ? 0 : 1;
}

// A line for each run: its cost, case, engine and substeps (0: the engine has none).
int bench_command_tasks(int argc, char **argv)
{
    bench_options options;
    if (bench_options_parse(&options, argc, argv) != 0) return 2;
    series s = {.options = &options, .only_named = 1};
    int status = 0;
    for (int32_t i = 0; i < options.scene_count; i++) status |= try_named(&s, options.scenes[i], 1);
    if (options.scene_count == 0) try_all(&s, 1);
    return status != 0;
}

int bench_command_scenes(int argc, char **argv) { return run_cases(argc, argv, "build/scenes.csv", 0, 0); }

// The exit code tells whether Feather did worse than Box2D or ODE anywhere.
int bench_command_compare(int argc, char **argv)
{
    const char *out = "build/compare.csv";
    const int status = run_cases(argc, argv, out, 1, 1);
    for (int i = 0; i + 1 < argc; i++) {
        if (strcmp(argv[i], "--out") == 0) out = argv[i + 1];
    }
    return status != 0 ? status : bench_worse(&out, 1);
}

// run NAME [OPTION]...
int bench_command_run(int argc, char **argv)
{
    enum { MOST = 64 };
    static char scene[] = "--scene";
    char *all[MOST] = {scene};
    if (argc < 1 || argc >= MOST) {
        fprintf(stderr, "usage: feather-bench run NAME [OPTION]...\n");
        return 2;
    }
    for (int i = 0; i < argc; i++) all[i + 1] = argv[i];
    return run_cases(argc + 1, all, "build/run.csv", 0, 1);
}
