// simd_sets.h - which SIMD sets were built, for whoever declares or chooses their kernels.
//
// The build defines FE_HAVE_SSE2 and the like for each set that a *.simd.c file is compiled for. Plain C is one of
// them, unless the build defines FE_WITHOUT_PLAIN: a module of WebAssembly that needs its SIMD to be loaded at all
// spares it, and the library in one file, which is compiled for a machine that has the vectors its flags name.
#ifndef FE_CORE_SIMD_SETS_H
#define FE_CORE_SIMD_SETS_H

#ifdef FE_HAVE_SSE2
#define FE_SSE2_SET(X) X(FE_SIMD_SSE2, sse2)
#else
#define FE_SSE2_SET(X)
#endif
#ifdef FE_HAVE_NEON
#define FE_NEON_SET(X) X(FE_SIMD_NEON, neon)
#else
#define FE_NEON_SET(X)
#endif
#ifdef FE_HAVE_AVX2
#define FE_AVX2_SET(X) X(FE_SIMD_AVX2, avx2)
#else
#define FE_AVX2_SET(X)
#endif
#ifdef FE_HAVE_AVX512
#define FE_AVX512_SET(X) X(FE_SIMD_AVX512, avx512)
#else
#define FE_AVX512_SET(X)
#endif

#ifdef FE_HAVE_WASM
#define FE_WASM_SET(X) X(FE_SIMD_WASM, wasm)
#else
#define FE_WASM_SET(X)
#endif

// X(value of fe_simd, suffix of the symbols) for each set but plain C
#define FE_EACH_WIDE_SET(X) FE_SSE2_SET(X) FE_NEON_SET(X) FE_WASM_SET(X) FE_AVX2_SET(X) FE_AVX512_SET(X)

// The set that every CPU has on which the build runs
#ifndef FE_WITHOUT_PLAIN
#define FE_BASE_SET(kernels) kernels##_plain
#elif defined(FE_HAVE_SSE2)
#define FE_BASE_SET(kernels) kernels##_sse2
#elif defined(FE_HAVE_NEON)
#define FE_BASE_SET(kernels) kernels##_neon
#else
#define FE_BASE_SET(kernels) kernels##_wasm
#endif

#endif
