/// @file builds.h
/// What building meshes and hulls costs, beside Bullet.
#ifndef BENCH_BUILDS_H
#define BENCH_BUILDS_H

#include <stdio.h>

/// Prints a table and writes its rows to the file of the queries.
void bench_time_builds(FILE *csv);

#endif
