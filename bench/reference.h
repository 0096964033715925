/// @file reference.h
/// bench/reference.json: what Feather did on the scenes of the regression set when a change was last accepted. One
/// scene a line, so that a change of one shows as one line. check.c compares with it.
#ifndef BENCH_REFERENCE_H
#define BENCH_REFERENCE_H

#include <stdint.h>

enum { BENCH_REFERENCE_PHASES = 10, BENCH_REFERENCE_SCENES = 64 };

typedef struct bench_reference {
    char scene[64];
    uint64_t quick, full; ///< fe_world_hash after 120 steps, and at the end
    int32_t passed;       ///< 1: all criteria held
    int32_t phase_count;
    double phases[BENCH_REFERENCE_PHASES]; ///< time of each phase over that of the calibration loop
} bench_reference;

/// Number of scenes read, or -1 (it has said why on stderr).
int32_t bench_reference_read(const char *path, bench_reference *out_scenes);
/// `other_names`: of the phases of the last `other_count` scenes.
int bench_reference_write(const char *path, const bench_reference *scenes, int32_t count,
                          const char *const *phase_names, const char *const *other_names, int32_t other_count);

#endif
