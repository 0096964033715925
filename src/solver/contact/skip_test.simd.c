// skip_test.simd.c - which of the deferred pairs may meet in a step, W of them at a time: the bound of skip_test.h.
//
// Pairs come by their places in the list of awake pairs, bodies by their odometers. Ticks are subtracted as integers,
// modulo 2^32, and are exact as long as nobody went half way round. Compiled once per SIMD set.
#include "core/simd.h"
#include "solver/solver.h"

enum {
    DEFERRAL_STRIDE = sizeof(fe__deferral) / sizeof(float),
    ODOMETER_STRIDE = sizeof(fe__odometer) / sizeof(float),
    HALF_BITS = 16
};

#define LOWER_HALF 0xffffu
#define TICKS(a) ((wide_ticks)(a))

typedef uint32_t wide_ticks __attribute__((vector_size(4 * FE_W)));

// m, of a difference of places
FE_INLINE wide metres(wide_ticks d) { return (1.0f / FE__TICKS) * __builtin_convertvector((wide_int)d, wide); }

// Sines: all 32 bits count, in two halves that floats hold, so that they are rounded once
FE_INLINE wide sines(wide_ticks sum)
{
    wide high = __builtin_convertvector((wide_int)(sum >> HALF_BITS), wide),
         low = __builtin_convertvector((wide_int)(sum & LOWER_HALF), wide);
    return (1.0f / FE__TICKS) * (65536.0f * high + low);
}

// The bits of the lanes whose pair cannot have moved too far, by the measure of recycle.simd.c, nor will in the step
FE_INLINE unsigned waiting(const fe__deferral *deferrals, const fe__odometer *odometers, const int32_t *place, float dt)
{
    int32_t body_a[FE_W], body_b[FE_W];
    for (int i = 0; i < FE_W; ++i) body_a[i] = deferrals[place[i]].body_a, body_b[i] = deferrals[place[i]].body_b;
    wide4 plane = w_gather(deferrals->normal, DEFERRAL_STRIDE, place),
          apart = w_gather((const float *)deferrals->apart, DEFERRAL_STRIDE, place),
          turned = w_gather((const float *)&deferrals->turned_a, DEFERRAL_STRIDE, place), at_a, at_b, move_a, move_b;
    w_gather_both((const float *)odometers->at, ODOMETER_STRIDE, body_a, &at_a, &move_a);
    w_gather_both((const float *)odometers->at, ODOMETER_STRIDE, body_b, &at_b, &move_b);
    wide3 n = w_xyz(plane), v = w_sub(w_xyz(move_a), w_xyz(move_b)),
          d = {metres(TICKS(at_b.x) - TICKS(at_a.x) - TICKS(apart.x)),
               metres(TICKS(at_b.y) - TICKS(at_a.y) - TICKS(apart.y)),
               metres(TICKS(at_b.z) - TICKS(at_a.z) - TICKS(apart.z))};
    wide zero = w_set(0.0f), root3 = w_set(1.7322f); // rounded up
    wide arm_a = turned.z, arm_b = turned.w, gap = plane.w, most = apart.w, square = w_dot(d, d);
    wide turns =
        2.0f * (arm_a * sines(TICKS(at_a.w) - TICKS(turned.x)) + arm_b * sines(TICKS(at_b.w) - TICKS(turned.y)));
    wide spins = arm_a * move_a.w + arm_b * move_b.w;
    wide_mask near = w_and(w_greater(most, zero), w_greater(most * most, square));
    wide_mask open = w_greater(gap + w_dot(n, d) - turns, dt * (w_max(zero, w_dot(n, v)) + spins));
    wide_mask has_normal = w_greater(w_dot(n, n), zero);
    if (w_bits(has_normal) == (1u << FE_W) - 1) return w_bits(w_and(near, open));
    wide speed = w_sqrt(w_dot(v, v));
    wide_mask clear = w_greater(gap - root3 * (w_sqrt(square) + turns), dt * (speed + spins));
    return w_bits(w_and(near, w_or(w_and(has_normal, open), w_and(w_not(has_normal), clear))));
}

fe__due_kernel FE_NAME(fe__keep_due);

int32_t FE_NAME(fe__keep_due)(const fe__deferral *deferrals, const fe__odometer *odometers, int32_t *places,
                              int32_t count, float dt)
{
    int32_t left = 0;
    for (int32_t i = 0; i < count; i += FE_W) {
        int32_t rest[FE_W], lanes = count - i < FE_W ? count - i : FE_W;
        for (int32_t k = 0; k < FE_W; ++k) rest[k] = places[i + (k < lanes ? k : lanes - 1)];
        unsigned due = ~waiting(deferrals, odometers, rest, dt) & ((1u << lanes) - 1);
        for (; due; due &= due - 1) places[left++] = rest[__builtin_ctz(due)];
    }
    return left;
}
