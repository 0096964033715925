// Runs a case and its variants and puts the medians where judges' values were (trial.h): what rounding decides differs
// from build to build and says nothing, its median does. Measures are those of the scene itself.
#include "memory.h"
#include "stats.h"
#include "trial.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// By run and check
typedef double row[BENCH_MAX_CHECKS];

static void note(row *values, int32_t run, const bench_trial *t)
{
    for (int32_t i = 0; i < t->check_count; i++) values[run][i] = t->checks[i].value;
}

// NaN counts as more than any number: a body that does not settle, say.
static double median(const row *values, int32_t count, int32_t column)
{
    double *sorted = bench_allocate((size_t)count, sizeof *sorted);
    for (int32_t i = 0; i < count; i++) sorted[i] = isnan(values[i][column]) ? HUGE_VAL : values[i][column];
    const double middle = bench_stats_of(sorted, count).median;
    free(sorted);
    return isinf(middle) ? (double)NAN : middle;
}

static double worst(const row *values, int32_t count, int32_t column, double good)
{
    double far = good;
    for (int32_t i = 0; i < count; i++) {
        if (!(fabs(values[i][column] - good) <= fabs(far - good))) far = values[i][column];
    }
    return far;
}

static void judge_all(bench_trial *t, const row *values, int32_t count)
{
    for (int32_t i = 0; i < t->check_count; i++) {
        bench_check *c = &t->checks[i];
        for (int32_t run = 0; run < count; run++)
            c->from = fmin(c->from, values[run][i]), c->to = fmax(c->to, values[run][i]);
        c->value = c->low < c->high ? median(values, count, i) : worst(values, count, i, c->low);
    }
}

int bench_trial_run_variants(bench_trial *t, const bench_setup *setup, int32_t count)
{
    int status = bench_trial_run(t, setup);
    if (status != 0 || count == 1 || t->is_too_long) return status;
    row *values = bench_allocate((size_t)count, sizeof *values);
    note(values, 0, t);
    for (int32_t run = 1; run < count && status == 0 && t->finite; run++) {
        bench_trial other;
        bench_setup variant = *setup;
        variant.variant = run;
        variant.measured = 0;
        status = bench_trial_run(&other, &variant);
        note(values, run, &other);
        t->ms += other.ms;
        if (!other.finite) t->finite = 0, t->check_count = 0, bench_expect(t, "a variant stays finite", 0, 1, 1);
        bench_trial_free(&other);
    }
    t->ms /= count;
    t->variants = count;
    if (status == 0 && t->finite) judge_all(t, (const row *)values, count);
    free(values);
    return status;
}
