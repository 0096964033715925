/// @file svg.h
/// Small plots, where looking beats reading: bars of ratios, lines over sizes. The commands write them beside their
/// CSV.
#ifndef BENCH_SVG_H
#define BENCH_SVG_H

#include <stdint.h>

enum { BENCH_MAX_SERIES = 8 };

typedef struct bench_series {
    const char *name;
    const double *x, *y; ///< positive; bars use y alone, one value a label, 0 where there is none
    int32_t count;
} bench_series;

/// Horizontal bars from zero, groups of one bar for each series, with a line at 1. 0 on success; else it has said why
/// on stderr.
int bench_svg_bars(const char *path, const char *title, const char *const *labels, int32_t label_count,
                   const bench_series *series, int32_t series_count);
/// Lines with dots, both axes logarithmic.
int bench_svg_lines(const char *path, const char *title, const char *x_name, const char *y_name,
                    const bench_series *series, int32_t series_count);
/// `path` with its ending changed to .svg, in a buffer that the next call reuses.
const char *bench_svg_path(const char *path);

#endif
