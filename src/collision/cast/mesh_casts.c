// mesh_casts.c - which of the casts against meshes a world takes: those of its SIMD set (mesh_ray.simd.c).
#include "collision/cast/mesh_ray.h"

#define DECLARE(simd, name) extern const fe__mesh_casts fe__mesh_casts_##name;
FE_EACH_WIDE_SET(DECLARE)

const fe__mesh_casts *fe__mesh_casts_of(int32_t simd)
{
    switch (simd) {
#define CASE(set, name) \
    case set:           \
        return &fe__mesh_casts_##name;
        FE_EACH_WIDE_SET(CASE)
    default:
        return &FE_BASE_SET(fe__mesh_casts);
    }
}
