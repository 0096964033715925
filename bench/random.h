/// @file random.h
/// The generator of the scenes' random numbers: xorshift64 (Marsaglia 2003, shifts 13, 7, 17), so that a scene is the
/// same everywhere.
#ifndef BENCH_RANDOM_H
#define BENCH_RANDOM_H

#include <stdint.h>

#define BENCH_SEED 0x9e3779b97f4a7c15u ///< the usual first state

/// Uniform in [0, 1) from the top 53 bits. @param state  not zero
static inline double bench_random(uint64_t *state)
{
    uint64_t x = *state;
    x ^= x << 13;
    x ^= x >> 7;
    x ^= x << 17;
    *state = x;
    return (double)(x >> 11) * 0x1p-53;
}

#endif
