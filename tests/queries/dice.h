// dice.h - random numbers for the tests of queries: the same on every machine.
//
// Numbers are drawn one after the other: compilers may evaluate the members of an initializer in any order.
#ifndef FE_QUERIES_DICE_H
#define FE_QUERIES_DICE_H
#include "feather.h"

#include <math.h>

typedef struct dice {
    uint64_t state; // not 0
} dice;

static inline double uniform(dice *d, double low, double high) // Marsaglia, Xorshift RNGs, 2003
{
    d->state ^= d->state << 13, d->state ^= d->state >> 7, d->state ^= d->state << 17;
    return low + (high - low) * (double)(d->state >> 11) * 0x1p-53;
}

// Every order of magnitude is as likely.
static inline double spread(dice *d, double low, double high) { return low * pow(high / low, uniform(d, 0, 1)); }

static inline int32_t one_of(dice *d, int32_t count) { return (int32_t)uniform(d, 0, count); }
static inline int32_t chance(dice *d, double share) { return uniform(d, 0, 1) < share; }

static inline fe_dvec3 random_vector(dice *d, double most)
{
    double x = uniform(d, -most, most), y = uniform(d, -most, most), z = uniform(d, -most, most);
    return fe_make_dvec3(x, y, z);
}

static inline fe_dvec3 direction(dice *d) // of length 1
{
    for (;;) {
        fe_dvec3 v = random_vector(d, 1);
        double square = v.x * v.x + v.y * v.y + v.z * v.z, k = 1 / sqrt(square);
        if (square > 0.01 && square < 1) return fe_make_dvec3(k * v.x, k * v.y, k * v.z);
    }
}

// Of any length. Now and then along the axes: faces on faces, edges along edges.
static inline fe_quat random_rotation(dice *d)
{
    fe_dvec3 v = random_vector(d, 1);
    float w = (float)uniform(d, 0.1, 1);
    return chance(d, 0.2) ? (fe_quat){0, 0, 0, 1} : (fe_quat){(float)v.x, (float)v.y, (float)v.z, w};
}

#endif
