// fours.h - four doubles side by side, for files that are compiled once per SIMD set.
//
// + - * / are the compiler's (vector extensions of gcc and clang); it halves them where registers are of 128 bits. Each
// operation is IEEE and acts on each lane alone: a lane's bits are those of the scalar formula, on every machine.
#ifndef FE_CORE_FOURS_H
#define FE_CORE_FOURS_H
#include "core/lanes.h"

typedef double fe__four __attribute__((vector_size(32), may_alias));
typedef int64_t fe__four_int __attribute__((vector_size(32)));

FE_LANES_INLINE fe__four fe__four_set(double x) { return (fe__four){x, x, x, x}; }

#if FE_LANES_X86 && defined(__AVX__)
FE_LANES_INLINE fe__four fe__four_of(fe__quad x) { return (fe__four)_mm256_cvtps_pd((__m128)x); }
FE_LANES_INLINE fe__quad fe__four_narrow(fe__four x) { return (fe__quad)_mm256_cvtpd_ps((__m256d)x); }
// a < b ? a : b, a > b ? a : b
FE_LANES_INLINE fe__four fe__four_min(fe__four a, fe__four b)
{
    return (fe__four)_mm256_min_pd((__m256d)a, (__m256d)b);
}
FE_LANES_INLINE fe__four fe__four_max(fe__four a, fe__four b)
{
    return (fe__four)_mm256_max_pd((__m256d)a, (__m256d)b);
}
// bit i: sign of lane i
FE_LANES_INLINE uint32_t fe__four_signs(fe__four_int x) { return (uint32_t)_mm256_movemask_pd((__m256d)x); }
#else
FE_LANES_INLINE fe__four fe__four_of(fe__quad x)
{
    fe__doubles a = fe__doubles_low(x), b = fe__doubles_high(x);
    return __builtin_shufflevector(a, b, 0, 1, 2, 3);
}
FE_LANES_INLINE fe__quad fe__four_narrow(fe__four x)
{
    return fe__quad_narrow(__builtin_shufflevector(x, x, 0, 1), __builtin_shufflevector(x, x, 2, 3));
}
FE_LANES_INLINE fe__four fe__four_choose(fe__four_int mask, fe__four yes, fe__four no)
{
    return (fe__four)((mask & (fe__four_int)yes) | (~mask & (fe__four_int)no));
}
FE_LANES_INLINE fe__four fe__four_min(fe__four a, fe__four b) { return fe__four_choose(a < b, a, b); }
FE_LANES_INLINE fe__four fe__four_max(fe__four a, fe__four b) { return fe__four_choose(a > b, a, b); }
FE_LANES_INLINE uint32_t fe__four_signs(fe__four_int x)
{
    return (uint32_t)(x[0] < 0) | (uint32_t)(x[1] < 0) << 1 | (uint32_t)(x[2] < 0) << 2 | (uint32_t)(x[3] < 0) << 3;
}
#endif

#endif
