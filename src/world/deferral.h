// deferral.h - deferred pairs: awake, without points and events, whose bodies cannot have met since the narrow phase
// looked at them.
//
// Most pairs of a heap are near misses. Recycling computes exactly how far the bodies of a pair moved against each
// other, from six cache lines that lie anywhere. The sum of both bodies' travel is an upper bound of it, from records
// that lie one after the other and a small table of bodies. Where the bound does not decide, the exact test does, so
// that no result depends on it. While a pair is deferred, no stage reads more of it.
#ifndef FE_WORLD_DEFERRAL_H
#define FE_WORLD_DEFERRAL_H
#include "core/math.h"

// How far a body travelled since it was made, in ticks, modulo 2^32: only differences count. No pair is deferred for so
// long that one wraps
typedef struct fe__odometer {
    uint32_t shifted; // of its centre of mass, m
    uint32_t turned;  // |sin(angle / 2)| of its rotations
    float speed;      // fe__body.speed
} fe__odometer;

// By place in the list of awake pairs
typedef struct fe__deferral {
    int32_t body_a, body_b;
    uint32_t shifted, turned; // sums over both bodies, when it was last looked at
    float slack;              // m; how far they may move from then on
    float reach;              // m; arm of the rotations, fe__contact.longest_arm
} fe__deferral;

// An entry of that list is the pair, or ~pair while it is deferred
static inline int32_t fe__pair_of(int32_t entry) { return entry ^ entry >> 31; }

#define FE__TICKS 4194304.0f   // in 1 m, or 1 of a sine
#define FE__MOST_TRAVEL 128.0f // m in a step, and of slack: four of them are 2^31 ticks

// rounded up, by more than a rotation loses in its rounding
static inline uint32_t fe__ticks(float travel) { return (uint32_t)(FE__TICKS * fe__minf(travel, FE__MOST_TRAVEL)) + 1; }

static inline void fe__odometer_advance(fe__odometer *o, float shift, float half_sine)
{
    o->shifted += fe__ticks(shift);
    o->turned += fe__ticks(half_sine);
}

// From now on, when the recycling would let the bodies move by `slack` before it looks again
static inline void fe__defer(fe__deferral *p, const fe__odometer *odometers, int32_t body_a, int32_t body_b,
                             float slack, float reach)
{
    const fe__odometer *a = odometers + body_a, *b = odometers + body_b;
    const float rounding = 1e-5f * (1.0f + reach + slack); // of the exact test, m: it must come to the same
    *p = (fe__deferral){
        body_a, body_b, a->shifted + b->shifted, a->turned + b->turned, fe__minf(FE__MOST_TRAVEL, slack - rounding),
        reach};
}

// Has not moved too far, by the measure of recycle.simd.c, nor will within a step of dt
static inline int32_t fe__stays_deferred(const fe__deferral *p, const fe__odometer *odometers, float dt)
{
    const fe__odometer *a = odometers + p->body_a, *b = odometers + p->body_b;
    const float most = 1.7322f / FE__TICKS; // sqrt 3, rounded up: (x + y + z)^2 <= 3 (x^2 + y^2 + z^2)
    float shifted = (float)(a->shifted + b->shifted - p->shifted), turned = (float)(a->turned + b->turned - p->turned);
    return p->slack - dt * (a->speed + b->speed) > most * (shifted + 2.0f * p->reach * turned);
}

#endif
