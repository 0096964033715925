// mesh_casts.c - which of the casts against meshes a world takes: those of its SIMD set (mesh_ray.simd.c).
#include "collision/cast/mesh_ray.h"

#define DECLARE_SET(name) extern const fe__mesh_casts fe__mesh_casts_##name;
#ifdef FE_HAVE_SSE2
DECLARE_SET(sse2)
#endif
#ifdef FE_HAVE_AVX2
DECLARE_SET(avx2)
#endif
#ifdef FE_HAVE_AVX512
DECLARE_SET(avx512)
#endif
#ifdef FE_HAVE_NEON
DECLARE_SET(neon)
#endif

const fe__mesh_casts *fe__mesh_casts_of(int32_t simd)
{
    switch (simd) {
#ifdef FE_HAVE_SSE2
    case FE_SIMD_SSE2:
        return &fe__mesh_casts_sse2;
#endif
#ifdef FE_HAVE_AVX2
    case FE_SIMD_AVX2:
        return &fe__mesh_casts_avx2;
#endif
#ifdef FE_HAVE_AVX512
    case FE_SIMD_AVX512:
        return &fe__mesh_casts_avx512;
#endif
#ifdef FE_HAVE_NEON
    case FE_SIMD_NEON:
        return &fe__mesh_casts_neon;
#endif
    default:
        return &fe__mesh_casts_plain;
    }
}
