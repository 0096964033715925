// deferral.simd.c - which of the deferred pairs may meet in a step, W of them at a time: the bound of deferral.h.
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
#define UPPER_HALF 0xffff0000u

typedef uint32_t wide_ticks __attribute__((vector_size(4 * FE_W)));
typedef struct {
    wide_ticks x, y, z, turned;
} odometers;

// m, of a difference of places
FE_INLINE wide metres(wide_ticks d) { return (1.0f / FE__TICKS) * __builtin_convertvector((wide_int)d, wide); }

// Sines, of a sum: all 32 bits count, in two halves that floats hold, so that it is rounded once
FE_INLINE wide sines(wide_ticks sum)
{
    wide high = __builtin_convertvector((wide_int)(sum >> HALF_BITS), wide),
         low = __builtin_convertvector((wide_int)(sum & LOWER_HALF), wide);
    return (1.0f / FE__TICKS) * (65536.0f * high + low);
}

FE_INLINE odometers ticks_of(wide4 a)
{
    return (odometers){(wide_ticks)a.x, (wide_ticks)a.y, (wide_ticks)a.z, (wide_ticks)a.w};
}

// The bits of the lanes whose pair cannot have moved too far, by the measure of recycle.simd.c, nor will in the step
FE_INLINE unsigned waiting(const fe__deferral *deferrals, const fe__odometer *odometer, const int32_t *place, float dt)
{
    wide4 plane = w_gather(deferrals->normal, DEFERRAL_STRIDE, place),
          rest = w_gather((const float *)&deferrals->body_a, DEFERRAL_STRIDE, place), move_a, move_b, at_a, at_b;
    odometers then = ticks_of(w_gather((const float *)deferrals->apart, DEFERRAL_STRIDE, place));
    _Alignas(64) int32_t body_a[FE_W], body_b[FE_W];
    *(wide_int *)body_a = (wide_int)rest.x, *(wide_int *)body_b = (wide_int)rest.y;
    w_gather_both((const float *)odometer->at, ODOMETER_STRIDE, body_a, &at_a, &move_a);
    w_gather_both((const float *)odometer->at, ODOMETER_STRIDE, body_b, &at_b, &move_b);
    odometers a = ticks_of(at_a), b = ticks_of(at_b);
    wide3 n = w_xyz(plane), v = w_sub(w_xyz(move_a), w_xyz(move_b)),
          d = {metres(b.x - a.x - then.x), metres(b.y - a.y - then.y), metres(b.z - a.z - then.z)};
    wide zero = w_set(0.0f), root3 = w_set(1.7322f); // rounded up
    wide arm_a = (wide)((wide_ticks)rest.z & UPPER_HALF), arm_b = (wide)((wide_ticks)rest.z << HALF_BITS);
    wide most = rest.w, gap = plane.w, square = w_dot(d, d), spins = arm_a * move_a.w + arm_b * move_b.w;
    wide turns = 2.0f * w_max(arm_a, arm_b) * sines(a.turned + b.turned - then.turned);
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
