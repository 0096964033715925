// lanes.h - eight floats side by side: what the trees of a world and of a mesh need and nothing else.
//
// Two quads of 128 bits, which every 64-bit machine has, so that one compile serves all of them. + - * / and
// comparisons are the compiler's (vector extensions of gcc and clang); min, max and the sign mask are intrinsics on x86
// and WebAssembly, and plain C of the same meaning elsewhere (FE_PLAIN_C forces the latter). Each operation is IEEE and
// acts on each lane alone: the bits do not depend on the machine.
//     min(a, b) = a < b ? a : b       max(a, b) = a > b ? a : b
#ifndef FE_CORE_LANES_H
#define FE_CORE_LANES_H
#include "core/contraction.h"

#include <stdint.h>
#if defined(__SSE2__) && !defined(FE_PLAIN_C)
#ifdef __AVX__
#include <immintrin.h>
#else
#include <emmintrin.h>
#endif
#define FE_LANES_X86 1
#else
#define FE_LANES_X86 0
#if defined(__wasm_simd128__) && !defined(FE_PLAIN_C)
#include <wasm_simd128.h>
#define FE_LANES_WASM 1
#else
#define FE_LANES_WASM 0
#endif
#endif

typedef float fe__quad __attribute__((vector_size(16), may_alias));
typedef int32_t fe__quad_int __attribute__((vector_size(16)));

typedef struct fe__lanes {
    fe__quad a, b; // lanes 0-3, 4-7
} fe__lanes;

#define FE_LANES_INLINE static inline __attribute__((always_inline))

// ---- four ----------------------------------------------------------------------------------------------------------
FE_LANES_INLINE fe__quad fe__quad_set(float x) { return (fe__quad){x, x, x, x}; }
FE_LANES_INLINE fe__quad fe__quad_abs(fe__quad x) { return (fe__quad)((fe__quad_int)x & INT32_MAX); }
FE_LANES_INLINE fe__quad fe__quad_choose(fe__quad_int mask, fe__quad yes, fe__quad no)
{
    return (fe__quad)((mask & (fe__quad_int)yes) | (~mask & (fe__quad_int)no));
}
// one lane in all four
#define FE_QUAD_SPREAD(x, lane) __builtin_shufflevector(x, x, lane, lane, lane, lane)
// two doubles
typedef double fe__doubles __attribute__((vector_size(16), may_alias));
typedef int64_t fe__doubles_int __attribute__((vector_size(16)));
FE_LANES_INLINE fe__doubles fe__doubles_abs(fe__doubles x) { return (fe__doubles)((fe__doubles_int)x & INT64_MAX); }
FE_LANES_INLINE fe__doubles fe__doubles_choose(fe__doubles_int mask, fe__doubles yes, fe__doubles no)
{
    return (fe__doubles)((mask & (fe__doubles_int)yes) | (~mask & (fe__doubles_int)no));
}
#if FE_LANES_X86
FE_LANES_INLINE fe__doubles fe__doubles_min(fe__doubles x, fe__doubles y)
{
    return (fe__doubles)_mm_min_pd((__m128d)x, (__m128d)y);
}
FE_LANES_INLINE fe__doubles fe__doubles_max(fe__doubles x, fe__doubles y)
{
    return (fe__doubles)_mm_max_pd((__m128d)x, (__m128d)y);
}
FE_LANES_INLINE fe__doubles fe__doubles_low(fe__quad x) { return (fe__doubles)_mm_cvtps_pd((__m128)x); }
FE_LANES_INLINE fe__doubles fe__doubles_high(fe__quad x)
{
    return fe__doubles_low((fe__quad)_mm_movehl_ps((__m128)x, (__m128)x));
}
FE_LANES_INLINE fe__quad fe__quad_narrow(fe__doubles a, fe__doubles b)
{
    return (fe__quad)_mm_movelh_ps(_mm_cvtpd_ps((__m128d)a), _mm_cvtpd_ps((__m128d)b));
}
FE_LANES_INLINE fe__quad fe__quad_min(fe__quad x, fe__quad y) { return (fe__quad)_mm_min_ps((__m128)x, (__m128)y); }
FE_LANES_INLINE fe__quad fe__quad_max(fe__quad x, fe__quad y) { return (fe__quad)_mm_max_ps((__m128)x, (__m128)y); }
// bit i: sign of lane i
FE_LANES_INLINE uint32_t fe__quad_signs(fe__quad_int x) { return (uint32_t)_mm_movemask_ps((__m128)x); }
#elif FE_LANES_WASM // pmin(a, b) = b < a ? b : a, and likewise pmax: the operands change places
FE_LANES_INLINE fe__doubles fe__doubles_min(fe__doubles x, fe__doubles y)
{
    return (fe__doubles)wasm_f64x2_pmin((v128_t)y, (v128_t)x);
}
FE_LANES_INLINE fe__doubles fe__doubles_max(fe__doubles x, fe__doubles y)
{
    return (fe__doubles)wasm_f64x2_pmax((v128_t)y, (v128_t)x);
}
FE_LANES_INLINE fe__doubles fe__doubles_low(fe__quad x) { return (fe__doubles)wasm_f64x2_promote_low_f32x4((v128_t)x); }
FE_LANES_INLINE fe__doubles fe__doubles_high(fe__quad x)
{
    return fe__doubles_low(__builtin_shufflevector(x, x, 2, 3, 2, 3));
}
FE_LANES_INLINE fe__quad fe__quad_narrow(fe__doubles a, fe__doubles b)
{
    return __builtin_shufflevector((fe__quad)wasm_f32x4_demote_f64x2_zero((v128_t)a),
                                   (fe__quad)wasm_f32x4_demote_f64x2_zero((v128_t)b), 0, 1, 4, 5);
}
FE_LANES_INLINE fe__quad fe__quad_min(fe__quad x, fe__quad y)
{
    return (fe__quad)wasm_f32x4_pmin((v128_t)y, (v128_t)x);
}
FE_LANES_INLINE fe__quad fe__quad_max(fe__quad x, fe__quad y)
{
    return (fe__quad)wasm_f32x4_pmax((v128_t)y, (v128_t)x);
}
FE_LANES_INLINE uint32_t fe__quad_signs(fe__quad_int x) { return wasm_i32x4_bitmask((v128_t)x); }
#else
FE_LANES_INLINE fe__doubles fe__doubles_min(fe__doubles x, fe__doubles y) { return fe__doubles_choose(x < y, x, y); }
FE_LANES_INLINE fe__doubles fe__doubles_max(fe__doubles x, fe__doubles y) { return fe__doubles_choose(x > y, x, y); }
FE_LANES_INLINE fe__doubles fe__doubles_low(fe__quad x) { return (fe__doubles){(double)x[0], (double)x[1]}; }
FE_LANES_INLINE fe__doubles fe__doubles_high(fe__quad x) { return (fe__doubles){(double)x[2], (double)x[3]}; }
FE_LANES_INLINE fe__quad fe__quad_narrow(fe__doubles a, fe__doubles b)
{
    return (fe__quad){(float)a[0], (float)a[1], (float)b[0], (float)b[1]};
}
FE_LANES_INLINE fe__quad fe__quad_min(fe__quad x, fe__quad y) { return fe__quad_choose(x < y, x, y); }
FE_LANES_INLINE fe__quad fe__quad_max(fe__quad x, fe__quad y) { return fe__quad_choose(x > y, x, y); }
FE_LANES_INLINE uint32_t fe__quad_signs(fe__quad_int x)
{
    const fe__quad_int bit = {1, 2, 4, 8};
    fe__quad_int m = (x < 0) & bit;
    return (uint32_t)(m[0] | m[1] | m[2] | m[3]);
}
#endif

// ---- eight ---------------------------------------------------------------------------------------------------------
FE_LANES_INLINE fe__lanes fe__lanes_load(const float *row) // 16-byte aligned
{
    return (fe__lanes){*(const fe__quad *)row, *(const fe__quad *)(row + 4)};
}
FE_LANES_INLINE void fe__lanes_store(float *row, fe__lanes x)
{
    *(fe__quad *)row = x.a;
    *(fe__quad *)(row + 4) = x.b;
}
FE_LANES_INLINE fe__lanes fe__lanes_set(float x) { return (fe__lanes){fe__quad_set(x), fe__quad_set(x)}; }
FE_LANES_INLINE fe__lanes fe__lanes_add(fe__lanes x, fe__lanes y) { return (fe__lanes){x.a + y.a, x.b + y.b}; }
FE_LANES_INLINE fe__lanes fe__lanes_sub(fe__lanes x, fe__lanes y) { return (fe__lanes){x.a - y.a, x.b - y.b}; }
FE_LANES_INLINE fe__lanes fe__lanes_mul(fe__lanes x, fe__lanes y) { return (fe__lanes){x.a * y.a, x.b * y.b}; }
FE_LANES_INLINE fe__lanes fe__lanes_min(fe__lanes x, fe__lanes y)
{
    return (fe__lanes){fe__quad_min(x.a, y.a), fe__quad_min(x.b, y.b)};
}
FE_LANES_INLINE fe__lanes fe__lanes_max(fe__lanes x, fe__lanes y)
{
    return (fe__lanes){fe__quad_max(x.a, y.a), fe__quad_max(x.b, y.b)};
}

// ---- eight in one register ------------------------------------------------------------------------------------------
// For files that are compiled once per SIMD set: the widest ones have such registers. The same eight floats in any
// case.
#if FE_LANES_X86 && defined(__AVX__)
typedef __m256 fe__eight;
FE_LANES_INLINE fe__eight fe__eight_load(const float *row) { return _mm256_load_ps(row); } // 32-byte aligned
FE_LANES_INLINE void fe__eight_store(float *row, fe__eight x) { _mm256_store_ps(row, x); }
FE_LANES_INLINE fe__eight fe__eight_set(float x) { return _mm256_set1_ps(x); }
FE_LANES_INLINE fe__eight fe__eight_spread(const float *x) { return _mm256_broadcast_ss(x); }
FE_LANES_INLINE fe__eight fe__eight_sub(fe__eight x, fe__eight y) { return _mm256_sub_ps(x, y); }
FE_LANES_INLINE fe__eight fe__eight_add(fe__eight x, fe__eight y) { return _mm256_add_ps(x, y); }
FE_LANES_INLINE fe__eight fe__eight_mul(fe__eight x, fe__eight y) { return _mm256_mul_ps(x, y); }
FE_LANES_INLINE fe__eight fe__eight_min(fe__eight x, fe__eight y) { return _mm256_min_ps(x, y); }
FE_LANES_INLINE fe__eight fe__eight_max(fe__eight x, fe__eight y) { return _mm256_max_ps(x, y); }
typedef __m256 fe__eight_mask;
FE_LANES_INLINE fe__eight_mask fe__eight_below(fe__eight x, fe__eight y) { return _mm256_cmp_ps(x, y, _CMP_LE_OQ); }
FE_LANES_INLINE fe__eight_mask fe__eight_and(fe__eight_mask x, fe__eight_mask y) { return _mm256_and_ps(x, y); }
FE_LANES_INLINE uint32_t fe__eight_bits(fe__eight_mask x) { return (uint32_t)_mm256_movemask_ps(x); }
#else
typedef fe__lanes fe__eight;
FE_LANES_INLINE fe__eight fe__eight_load(const float *row) { return fe__lanes_load(row); }
FE_LANES_INLINE void fe__eight_store(float *row, fe__eight x) { fe__lanes_store(row, x); }
FE_LANES_INLINE fe__eight fe__eight_set(float x) { return fe__lanes_set(x); }
FE_LANES_INLINE fe__eight fe__eight_spread(const float *x) { return fe__lanes_set(*x); }
FE_LANES_INLINE fe__eight fe__eight_sub(fe__eight x, fe__eight y) { return fe__lanes_sub(x, y); }
FE_LANES_INLINE fe__eight fe__eight_add(fe__eight x, fe__eight y) { return fe__lanes_add(x, y); }
FE_LANES_INLINE fe__eight fe__eight_mul(fe__eight x, fe__eight y) { return fe__lanes_mul(x, y); }
FE_LANES_INLINE fe__eight fe__eight_min(fe__eight x, fe__eight y) { return fe__lanes_min(x, y); }
FE_LANES_INLINE fe__eight fe__eight_max(fe__eight x, fe__eight y) { return fe__lanes_max(x, y); }
typedef struct fe__eight_mask {
    fe__quad_int a, b;
} fe__eight_mask;
FE_LANES_INLINE fe__eight_mask fe__eight_below(fe__eight x, fe__eight y)
{
    return (fe__eight_mask){x.a <= y.a, x.b <= y.b};
}
FE_LANES_INLINE fe__eight_mask fe__eight_and(fe__eight_mask x, fe__eight_mask y)
{
    return (fe__eight_mask){x.a & y.a, x.b & y.b};
}
FE_LANES_INLINE uint32_t fe__eight_bits(fe__eight_mask x) { return fe__quad_signs(x.a) | fe__quad_signs(x.b) << 4; }
#endif
#if FE_LANES_X86 && defined(__AVX2__)
FE_LANES_INLINE fe__eight fe__eight_of_bytes(const uint8_t bytes[8])
{
    return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)bytes)));
}
#elif FE_LANES_X86 && !defined(__AVX__)
FE_LANES_INLINE fe__eight fe__eight_of_bytes(const uint8_t bytes[8])
{
    const __m128i zero = _mm_setzero_si128(),
                  words = _mm_unpacklo_epi8(_mm_loadl_epi64((const __m128i *)(const void *)bytes), zero);
    return (fe__eight){(fe__quad)_mm_cvtepi32_ps(_mm_unpacklo_epi16(words, zero)),
                       (fe__quad)_mm_cvtepi32_ps(_mm_unpackhi_epi16(words, zero))};
}
#else
FE_LANES_INLINE fe__eight fe__eight_of_bytes(const uint8_t bytes[8])
{
    _Alignas(32) float row[8];
    for (int32_t i = 0; i < 8; ++i) row[i] = (float)bytes[i];
    return fe__eight_load(row);
}
#endif
// bit i: lane i of x is at most lane i of y
FE_LANES_INLINE uint32_t fe__eight_at_most(fe__eight x, fe__eight y) { return fe__eight_bits(fe__eight_below(x, y)); }

#endif
