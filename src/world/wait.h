// wait.h - near misses that wait: awake pairs that have no points and nothing to tell, whose bodies cannot have met since a look.
//
// Most pairs of a heap are near misses. Recycling asks exactly how far the bodies of a pair moved against each other, from six cache lines
// that lie anywhere. The sum of the ways that they went is a bound of it, from records that lie one after the other and a small table of
// bodies. What the bound cannot tell is asked exactly, so that no result depends on it; and while a pair waits, no stage reads more of it.
#ifndef FE_WORLD_WAIT_H
#define FE_WORLD_WAIT_H
#include "core/math.h"

// The way of a body since it was made, in ticks, modulo 2^32: only differences count. No pair waits for so long a way that one wraps round
typedef struct fe__odometer {
    uint32_t shifted; // of its centre of mass, m
    uint32_t turned;  // |sin(turn / 2)|
    float speed;      // as fe__body.centre_low
} fe__odometer;

// By place in the list of awake pairs
typedef struct fe__wait {
    int32_t body_a, body_b;
    uint32_t shifted, turned; // sums over both bodies, when it was last looked at
    float slack;              // m; how far they may move from then on
    float reach;              // m; of a turn, as fe__contact.found_span
} fe__wait;

// An entry of that list is the pair, or ~pair while it waits
static inline int32_t fe__pair_of(int32_t entry) { return entry ^ entry >> 31; }

#define FE__TICKS 4194304.0f // in 1 m, or 1 of a sine
#define FE__MOST_WAY 128.0f  // m in a step, and of slack: four of them are 2^31 ticks

// rounded up, by more than a rotation loses in its rounding
static inline uint32_t fe__ticks(float way) { return (uint32_t)(FE__TICKS * fe__minf(way, FE__MOST_WAY)) + 1; }

static inline void fe__odometer_advance(fe__odometer *o, float shift, float half_sine)
{
    o->shifted += fe__ticks(shift);
    o->turned += fe__ticks(half_sine);
}

// From now on, when the recycling would let the bodies move by `slack` before it looks again
static inline void fe__begin_to_wait(fe__wait *p, const fe__odometer *odometers, int32_t body_a, int32_t body_b, float slack, float reach)
{
    const fe__odometer *a = odometers + body_a, *b = odometers + body_b;
    const float rounding = 1e-5f * (1.0f + reach + slack); // of the exact test, m: it must come to the same
    *p = (fe__wait){body_a, body_b, a->shifted + b->shifted, a->turned + b->turned, fe__minf(FE__MOST_WAY, slack - rounding), reach};
}

// Has not moved too far, by the measure of recycle.simd.c, nor will within a step of dt
static inline int32_t fe__still_waits(const fe__wait *p, const fe__odometer *odometers, float dt)
{
    const fe__odometer *a = odometers + p->body_a, *b = odometers + p->body_b;
    const float most = 1.7322f / FE__TICKS; // sqrt 3, rounded up: (x + y + z)^2 <= 3 (x^2 + y^2 + z^2)
    float shifted = (float)(a->shifted + b->shifted - p->shifted), turned = (float)(a->turned + b->turned - p->turned);
    return p->slack - dt * (a->speed + b->speed) > most * (shifted + 2.0f * p->reach * turned);
}

#endif
