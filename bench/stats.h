/// @file stats.h
/// Clocks, and what a list of measured times says.
#ifndef BENCH_STATS_H
#define BENCH_STATS_H

#include <stdint.h>

typedef struct bench_stats {
    double mean, median, p99, least;
} bench_stats;

/// Sorts `values`. All zero for none.
bench_stats bench_stats_of(double *values, int32_t count);

/// Wall clock, ms.
double bench_wall_ms(void);
/// CPU time of all threads of the process, ms: leaves out what other programs of the machine took.
double bench_cpu_ms(void);

#endif
