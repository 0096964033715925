/// @file report.h
/// Prints measured scenes: a table for people, CSV for programs.
#ifndef BENCH_REPORT_H
#define BENCH_REPORT_H

#include "run.h"

#include <stdio.h>

void bench_print_table(const bench_table *table);
void bench_print_overlaps(const bench_table *table);
void bench_print_rays(const bench_table *table);
void bench_print_profiles(const bench_table *table);

/// Creates the file (and its folder, one level) and writes the header line. NULL on failure; it has said why on stderr.
FILE *bench_csv_open(const char *path);
void bench_csv_write(FILE *file, const bench_table *table);

#endif
