/// @file run.h
/// One engine on one scene with its settings, and everything measured about it. speed.c fills runs, report.c prints
/// them.
#ifndef BENCH_RUN_H
#define BENCH_RUN_H

#include "overlaps.h"
#include "peers/peer.h"
#include "stats.h"

typedef struct bench_quality {
    double top_height; ///< of the highest moving body's centre, m
    double drift;      ///< largest horizontal distance of a body from its start, m
    double z_offset;   ///< largest |z - start z|, m: out of the plane of a flat pyramid
    double gap;        ///< largest distance of a joint's two points, m
    int32_t finite;    ///< 0: some pose is NaN or infinite
} bench_quality;

typedef struct bench_run {
    const bench_engine *engine;
    int32_t workers, substeps; ///< 0 when the engine takes none
    bench_world *world;
    double *samples; ///< ms of the steps that count: of the processor with one worker, else of the wall
    int32_t sample_count;
    double cpu_ms;                   ///< of these steps, all threads
    bench_stats stats;               ///< ms a step
    double phases[BENCH_MAX_PHASES]; ///< ms, sum over the steps that count
    bench_quality quality;
    bench_contacts contacts;
    bench_overlaps overlaps; ///< of scenes that tell their ground
    bench_counters counters;
    uint64_t hash;
    double ray_ms; ///< all rays
    int32_t ray_count, ray_hits;
    double ray_fractions; ///< mean over the hits
} bench_run;

enum { BENCH_MAX_RUNS = 80 };

/// What was measured on one scene.
typedef struct bench_table {
    bench_scene scene;
    bench_run runs[BENCH_MAX_RUNS];
    int32_t run_count;
    bench_pose *poses; ///< scratch, one per body
} bench_table;

#endif
