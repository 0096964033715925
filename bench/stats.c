// Clocks and the summary of measured times (stats.h).
#include "stats.h"

#include <stdlib.h>
#include <time.h>

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

bench_stats bench_stats_of(double *values, int32_t count)
{
    bench_stats stats = {0.0, 0.0, 0.0, 0.0};
    if (count < 1) return stats;
    qsort(values, (size_t)count, sizeof *values, compare_doubles);
    for (int32_t i = 0; i < count; i++) stats.mean += values[i] / count;
    stats.median = 0.5 * (values[(count - 1) / 2] + values[count / 2]);
    stats.p99 = values[(int32_t)(0.99 * (count - 1) + 0.5)];
    stats.least = values[0];
    return stats;
}

static double read_clock(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

double bench_wall_ms(void) { return read_clock(CLOCK_MONOTONIC); }

double bench_cpu_ms(void) { return read_clock(CLOCK_PROCESS_CPUTIME_ID); }
