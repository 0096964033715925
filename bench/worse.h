/// @file worse.h
/// Where Feather does worse than another engine, by the tables that `compare` writes.
#ifndef BENCH_WORSE_H
#define BENCH_WORSE_H

#include <stdint.h>

/// Prints a line for each case, engine and measure. 0: nowhere worse than Box2D or ODE with the default substeps; 1:
/// somewhere; 2: a file cannot be read, and it has said so on stderr.
int bench_worse(const char *const *paths, int32_t count);

#endif
