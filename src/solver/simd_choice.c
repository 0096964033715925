// simd_choice.c - which SIMD sets were built, which of them this CPU has, and the choice between them.
#include "core/cpu.h"
#include "core/simd_sets.h"
#include "solver/solver.h"

#include <stdlib.h>
#include <string.h>

#define DECLARE(simd, name)                                      \
    extern const fe__contact_kernels fe__contact_kernels_##name; \
    extern const fe__joint_kernels fe__joint_kernels_##name;     \
    extern const fe__forest_kernels fe__forest_kernels_##name;   \
    extern const fe__body_kernels fe__body_kernels_##name;       \
    extern fe__recycle_kernel fe__recycle_##name;                \
    extern fe__due_kernel fe__keep_due_##name;                   \
    extern fe__course_kernel fe__meet_course_##name;
#define TABLE(simd, lanes, name, ...)                                                                                 \
    {                                                                                                                 \
        simd, lanes, &fe__contact_kernels_##name, &fe__joint_kernels_##name, {__VA_ARGS__}, &fe__body_kernels_##name, \
            fe__recycle_##name, fe__keep_due_##name, fe__meet_course_##name, THIN(contact_kernels),                   \
            THIN(joint_kernels)                                                                                       \
    }

#ifndef FE_WITHOUT_PLAIN
DECLARE(FE_SIMD_PLAIN, plain)
#endif
FE_EACH_WIDE_SET(DECLARE)

// The set of FE__THIN_WIDTH lanes: whatever CPU has a wider one has it too
#ifdef FE_HAVE_SSE2
#define THIN(kernels) &fe__##kernels##_sse2
#elif defined(FE_HAVE_NEON)
#define THIN(kernels) &fe__##kernels##_neon
#elif defined(FE_HAVE_WASM)
#define THIN(kernels) &fe__##kernels##_wasm
#else
#define THIN(kernels) &FE_BASE_SET(fe__##kernels)
#endif

#define FOREST(name) &fe__forest_kernels_##name
// narrower ones of avx512, as far as they were built
#ifdef FE_HAVE_AVX2
#define NARROW_FORESTS THIN(forest_kernels), FOREST(avx2)
#else
#define NARROW_FORESTS THIN(forest_kernels)
#endif

// widest last
static const fe__kernels sets[] = {
#ifndef FE_WITHOUT_PLAIN
    TABLE(FE_SIMD_PLAIN, 4, plain, FOREST(plain)),
#endif
#ifdef FE_HAVE_SSE2
    TABLE(FE_SIMD_SSE2, 4, sse2, FOREST(sse2)),
#endif
#ifdef FE_HAVE_NEON
    TABLE(FE_SIMD_NEON, 4, neon, FOREST(neon)),
#endif
#ifdef FE_HAVE_WASM
    TABLE(FE_SIMD_WASM, 4, wasm, FOREST(wasm)),
#endif
#ifdef FE_HAVE_AVX2
    TABLE(FE_SIMD_AVX2, 8, avx2, THIN(forest_kernels), FOREST(avx2)),
#endif
#ifdef FE_HAVE_AVX512
    TABLE(FE_SIMD_AVX512, 16, avx512, NARROW_FORESTS, FOREST(avx512)),
#endif
};
enum { SET_COUNT = sizeof sets / sizeof *sets };

static int32_t environment_choice(void)
{
    static const char *const names[] = {"auto", "plain", "sse2", "avx2", "avx512", "neon", "wasm"}; // by fe_simd
    const char *wanted = getenv("FE_SIMD");
    for (int32_t i = 1; wanted && i < (int32_t)(sizeof names / sizeof *names); ++i)
        if (!strcmp(wanted, names[i])) return i;
    return FE_SIMD_AUTO;
}

const fe__kernels *fe__kernels_of(int32_t simd)
{
    if (simd == FE_SIMD_AUTO) simd = environment_choice();
    uint32_t here = fe__simd_here();
    for (int32_t i = SET_COUNT - 1; i >= 0; --i)
        if ((simd == FE_SIMD_AUTO || sets[i].simd == simd) && (here >> sets[i].simd & 1)) return sets + i;
    return NULL;
}
