// `feather-bench check` and `update`: has anything changed since a change was last accepted? Results by their
// fingerprint, quality by the criteria, speed by phase, as a ratio to a calibration loop that runs between the steps,
// so that it means the same on every machine.
#include "bench.h"

#include "answers.h"
#include "memory.h"
#include "reference.h"
#include "stats.h"
#include "trial.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    QUICK_STEPS = 120,
    SUBSTEPS = 8,
    CALIBRATIONS = 8, // in each step's share, see calibrate
    ATTEMPTS = 3      // a phase that looks slow is measured again: a loaded machine slows one run, seldom three
};
static const double SLOWER = 1.5;      // what counts as a regression of speed; noise below it is common
static const double LEAST_SHARE = 0.1; // of a step, and
static const double LEAST_UNITS =
    0.5; // of the calibration loop: shorter phases are not judged, their clock is too coarse

static const char *const regression_set[] = {
    "vertical-stack",
    "pyramid",
    "high-mass-ratio-1",
    "overlap-recovery",
    "double-domino",
    "circle-stack",
    "warm-start-energy",
    "friction-slope",
    "far-pyramid",
    "far-stack",
    "far-chain",
    "bridge",
    "ball-and-chain-2d",
    "stretched-chain",
    "ragdoll",
    "far-ragdolls",
    "capsule-stack",
    "spinning-books",
    "isotropic-friction",
    "rolling-resistance",
    "restitution-row",
    "slide-twist",
    "locked-pyramid",
};
enum { SET = (int)(sizeof regression_set / sizeof regression_set[0]) };

// A stretch of dependent and independent float work that the compiler cannot drop. Its time is the unit of the phases'
// times.
static double calibrate(void)
{
    enum { COUNT = 4096 };
    static float a[COUNT], b[COUNT];
    volatile float sink;
    double start = bench_wall_ms();
    for (int k = 0; k < CALIBRATIONS; k++) {
        for (int i = 0; i < COUNT; i++) a[i] = a[i] * 0.999f + b[(i * 7 + k) % COUNT] + 1.0f;
        for (int i = 0; i < COUNT; i++) b[i] = b[i] * 0.5f + sqrtf(fabsf(a[COUNT - 1 - i]));
    }
    sink = a[0] + b[COUNT - 1];
    (void)sink;
    return bench_wall_ms() - start;
}

// ---- one scene -----------------------------------------------------------------------------------------------------

// Fingerprint after QUICK_STEPS, then the whole run with its criteria, unless `quick`.
static int fingerprint(const char *name, int32_t quick, bench_reference *out)
{
    int32_t planar = 0;
    const bench_case *rule = bench_case_find(name, &planar);
    bench_trial trial;
    bench_case shorter;
    memset(out, 0, sizeof *out);
    snprintf(out->scene, sizeof out->scene, "%s", name);
    if (rule == NULL) return -1;
    shorter = *rule;
    shorter.seconds = fmin(rule->seconds, QUICK_STEPS / 60.0);
    int status = bench_trial_run(&trial, &(bench_setup){&shorter, &bench_feather, planar, 1, SUBSTEPS, 0, 0});
    out->quick = trial.hash;
    bench_trial_free(&trial);
    if (quick || status != 0) return status;
    status = bench_trial_run(&trial, &(bench_setup){rule, &bench_feather, planar, 1, SUBSTEPS, 0, 0});
    out->full = trial.hash;
    out->passed = bench_trial_passed(&trial);
    bench_trial_free(&trial);
    return status;
}

// Least ratio of each phase to the calibration loop next to it, over blocks of steps.
static int time_phases(const char *name, bench_reference *out)
{
    enum { BLOCKS = 12, STEPS = 10 };
    int32_t planar = 0;
    const bench_case *rule = bench_case_find(name, &planar);
    bench_scene scene;
    bench_trial_build(&scene, rule, planar);
    bench_world *world = bench_feather.create(&scene, 1, SUBSTEPS);
    int status = world == NULL ? -1 : 0;
    while (out->phase_count < BENCH_REFERENCE_PHASES && bench_feather.phase_names[out->phase_count] != NULL)
        out->phases[out->phase_count++] = HUGE_VAL;
    for (int32_t block = 0; block < BLOCKS && status == 0; block++) {
        double sum[BENCH_MAX_PHASES] = {0.0}, ms[BENCH_MAX_PHASES], unit = calibrate();
        for (int32_t i = 0; i < STEPS && status == 0; i++) {
            status = bench_feather.step(world, scene.dt);
            bench_feather.read_phases(world, ms);
            for (int32_t p = 0; p < out->phase_count; p++) sum[p] += ms[p];
        }
        unit = fmin(unit, calibrate());
        for (int32_t p = 0; p < out->phase_count; p++) out->phases[p] = fmin(out->phases[p], sum[p] / (STEPS * unit));
    }
    if (world != NULL) bench_feather.destroy(world);
    bench_scene_destroy(&scene);
    return status;
}

// ---- the commands --------------------------------------------------------------------------------------------------

static const bench_reference *find(const bench_reference *all, int32_t count, const char *name)
{
    for (int32_t i = 0; i < count; i++) {
        if (strcmp(all[i].scene, name) == 0) return &all[i];
    }
    return NULL;
}

static int32_t check_results(const bench_reference *was, const bench_reference *now, int32_t quick)
{
    int32_t bad = 0;
    if (now->quick != was->quick || (!quick && now->full != was->full)) {
        printf("%-22s RESULTS CHANGED: fingerprint %016" PRIx64 ", was %016" PRIx64 "\n", now->scene,
               quick ? now->quick : now->full, quick ? was->quick : was->full);
        bad = 1;
    }
    if (!quick && now->passed < was->passed) {
        printf("%-22s QUALITY: a criterion that held does not hold; try: feather-bench run %s\n", now->scene,
               now->scene);
        bad = 1;
    }
    return bad;
}

static int32_t check_speed(const bench_reference *was)
{
    const double step = was->phases[0];
    for (int32_t attempt = 1; attempt <= ATTEMPTS; attempt++) {
        bench_reference now = {.phase_count = 0};
        int32_t slow = -1;
        if (time_phases(was->scene, &now) != 0) return 1;
        for (int32_t p = 0; p < now.phase_count && p < was->phase_count; p++) {
            const double least = fmax(LEAST_SHARE * step, LEAST_UNITS);
            if (was->phases[p] > least && now.phases[p] > SLOWER * was->phases[p]) slow = p;
        }
        if (slow < 0) return 0;
        if (attempt < ATTEMPTS) continue;
        printf("%-22s SLOWER: %s takes %.2f times as long\n", was->scene, bench_feather.phase_names[slow],
               now.phases[slow] / was->phases[slow]);
    }
    return 1;
}

// The fastest of several rounds in each of up to ATTEMPTS runs.
static int32_t check_answers(const bench_reference *was, int32_t set, int32_t no_speed)
{
    bench_reference now;
    if (bench_answers(set, no_speed ? NULL : calibrate, &now) != 0) return 1;
    int32_t bad = check_results(was, &now, 1), slow = -1;
    for (int32_t attempt = 1; attempt <= ATTEMPTS && !no_speed; attempt++) {
        slow = -1;
        for (int32_t p = 0; p < now.phase_count; p++) {
            if (now.phases[p] > SLOWER * was->phases[p]) slow = p;
        }
        if (slow < 0) break;
        if (attempt < ATTEMPTS && bench_answers(set, calibrate, &now) != 0) return 1;
    }
    if (slow >= 0)
        printf("%-22s SLOWER: %s takes %.2f times as long\n", was->scene, bench_answer_phases[slow],
               now.phases[slow] / was->phases[slow]);
    return bad || slow >= 0;
}

static void show_progress(const char *name, int32_t i)
{
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K%s %d/%d", name, i + 1, SET);
}

typedef struct request {
    const char *path;
    int32_t quick, no_speed;
} request;

static int read_request(request *out, int argc, char **argv)
{
    *out = (request){"bench/reference.json", 0, 0};
    for (int i = 0; i < argc; i++) {
        if (strcmp(argv[i], "--quick") == 0) {
            out->quick = out->no_speed = 1;
        } else if (strcmp(argv[i], "--no-speed") == 0) {
            out->no_speed = 1;
        } else if (strcmp(argv[i], "--reference") == 0 && i + 1 < argc) {
            out->path = argv[++i];
        } else {
            fprintf(stderr, "feather-bench: check and update know --quick, --no-speed and --reference FILE\n");
            return -1;
        }
    }
    return 0;
}

int bench_command_check(int argc, char **argv)
{
    static bench_reference was[BENCH_REFERENCE_SCENES];
    request r;
    if (read_request(&r, argc, argv) != 0) return 2;
    const int32_t count = bench_reference_read(r.path, was);
    int32_t bad = count < 0;
    for (int32_t i = 0; i < SET && count >= 0; i++) {
        bench_reference now;
        const bench_reference *then = find(was, count, regression_set[i]);
        show_progress(regression_set[i], i);
        if (then == NULL) {
            printf("%-22s has no reference; accept it with: feather-bench update\n", regression_set[i]);
            bad++;
            continue;
        }
        bad += fingerprint(regression_set[i], r.quick, &now) != 0 || check_results(then, &now, r.quick);
        if (!r.no_speed) bad += check_speed(then);
    }
    for (int32_t i = 0; i < BENCH_ANSWER_SETS && count >= 0; i++) {
        const bench_reference *then = find(was, count, bench_answer_names[i]);
        if (then == NULL)
            printf("%-22s has no reference; accept it with: feather-bench update\n", bench_answer_names[i]);
        bad += then == NULL || check_answers(then, i, r.no_speed);
    }
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K");
    printf("%d scenes, %d regressions\n", SET + BENCH_ANSWER_SETS, bad);
    return bad != 0;
}

int bench_command_update(int argc, char **argv)
{
    static bench_reference now[SET + BENCH_ANSWER_SETS];
    request r;
    if (read_request(&r, argc, argv) != 0) return 2;
    for (int32_t i = 0; i < SET; i++) {
        show_progress(regression_set[i], i);
        if (fingerprint(regression_set[i], 0, &now[i]) != 0 || time_phases(regression_set[i], &now[i]) != 0) return 1;
    }
    for (int32_t i = 0; i < BENCH_ANSWER_SETS; i++) {
        if (bench_answers(i, calibrate, &now[SET + i]) != 0) return 1;
    }
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K");
    return bench_reference_write(r.path, now, SET + BENCH_ANSWER_SETS, bench_feather.phase_names, bench_answer_phases,
                                 BENCH_ANSWER_SETS) != 0;
}
