// lanes.h - eight floats side by side: what the tree's tests need and nothing else.
//
// Two quads of 128 bits, which every 64-bit machine has, so that one compile serves all of them. + - * / and comparisons are the compiler's
// (vector extensions of gcc and clang); min, max and the sign mask are intrinsics on x86 and plain C of the same meaning elsewhere
// (FE_PLAIN_C forces the latter). Each operation is IEEE and acts on each lane alone: the bits do not depend on the machine.
//     min(a, b) = a < b ? a : b       max(a, b) = a > b ? a : b
#ifndef FE_BROADPHASE_LANES_H
#define FE_BROADPHASE_LANES_H
#include <stdint.h>
#if defined(__SSE2__) && !defined(FE_PLAIN_C)
#include <emmintrin.h>
#define FE_LANES_X86 1
#else
#define FE_LANES_X86 0
#endif

typedef float fe__quad __attribute__((vector_size(16), may_alias));
typedef int32_t fe__quad_int __attribute__((vector_size(16)));

typedef struct fe__lanes {
    fe__quad a, b; // lanes 0-3, 4-7
} fe__lanes;

#define FE_LANES_INLINE static inline __attribute__((always_inline))

// ---- four ---------------------------------------------------------------------------------------------------------------------
FE_LANES_INLINE fe__quad fe__quad_set(float x) { return (fe__quad){x, x, x, x}; }
FE_LANES_INLINE fe__quad fe__quad_choose(fe__quad_int mask, fe__quad yes, fe__quad no)
{
    return (fe__quad)((mask & (fe__quad_int)yes) | (~mask & (fe__quad_int)no));
}
#if FE_LANES_X86
FE_LANES_INLINE fe__quad fe__quad_min(fe__quad x, fe__quad y) { return (fe__quad)_mm_min_ps((__m128)x, (__m128)y); }
FE_LANES_INLINE fe__quad fe__quad_max(fe__quad x, fe__quad y) { return (fe__quad)_mm_max_ps((__m128)x, (__m128)y); }
// bit i: sign of lane i
FE_LANES_INLINE uint32_t fe__quad_signs(fe__quad_int x) { return (uint32_t)_mm_movemask_ps((__m128)x); }
#else
FE_LANES_INLINE fe__quad fe__quad_min(fe__quad x, fe__quad y) { return fe__quad_choose(x < y, x, y); }
FE_LANES_INLINE fe__quad fe__quad_max(fe__quad x, fe__quad y) { return fe__quad_choose(x > y, x, y); }
FE_LANES_INLINE uint32_t fe__quad_signs(fe__quad_int x)
{
    const fe__quad_int bit = {1, 2, 4, 8};
    fe__quad_int m = (x < 0) & bit;
    return (uint32_t)(m[0] | m[1] | m[2] | m[3]);
}
#endif

// ---- eight --------------------------------------------------------------------------------------------------------------------
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
FE_LANES_INLINE fe__lanes fe__lanes_min(fe__lanes x, fe__lanes y) { return (fe__lanes){fe__quad_min(x.a, y.a), fe__quad_min(x.b, y.b)}; }
FE_LANES_INLINE fe__lanes fe__lanes_max(fe__lanes x, fe__lanes y) { return (fe__lanes){fe__quad_max(x.a, y.a), fe__quad_max(x.b, y.b)}; }
// bit i: lane i of x is at most, or equal to, lane i of y
FE_LANES_INLINE uint32_t fe__lanes_at_most(fe__lanes x, fe__lanes y)
{
    return fe__quad_signs(x.a <= y.a) | fe__quad_signs(x.b <= y.b) << 4;
}

#endif
