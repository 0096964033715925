/// @file options.h
/// What the user asked of `feather-bench speed`, `scaling`, `scenes`, `run`, `compare`, `tasks`.
#ifndef BENCH_OPTIONS_H
#define BENCH_OPTIONS_H

#include <stdint.h>

enum {
    BENCH_MAX_SCENES = 64,
    BENCH_MAX_PEERS = 8,
    BENCH_MAX_NUMBERS = 8, ///< in one list
};

typedef struct bench_options {
    char *scenes[BENCH_MAX_SCENES];
    char *peers[BENCH_MAX_PEERS];
    int32_t workers[BENCH_MAX_NUMBERS];
    int32_t substeps[BENCH_MAX_NUMBERS];
    int32_t scene_count, peer_count, worker_count, substep_count; ///< 0: the defaults
    int32_t steps;                                                ///< 0: the scene's own
    int32_t no_peers;
    int32_t no_feather;
    int32_t rays;
    int32_t profile;
    int32_t variants; ///< of chaotic cases; 0: the default
    const char *out;
    int32_t out_given; ///< 0: `out` is the default
} bench_options;

/// Lists are split in place: `argv` is changed. 0 on success; else it has said on stderr what is wrong.
int bench_options_parse(bench_options *out_options, int argc, char **argv);

#endif
