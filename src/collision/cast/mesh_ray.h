// mesh_ray.h - a ray against a mesh, watertight, in double, in the mesh's frame.
//
// Queries and sweeps call it. The ray is origin + t * translation, 0 <= t <= limit.
// One-sided meshes are met from the side around which corners turn left, two-sided ones from both sides, with the
// normal against the ray. A mesh has no inside, and a translation of length 0 meets nothing. Of triangles with equal t
// the one with the lowest number is hit: the answer does not depend on the tree.
#ifndef FE_COLLISION_CAST_MESH_RAY_H
#define FE_COLLISION_CAST_MESH_RAY_H
#include "collision/form/ground.h"
#include "collision/form/form.h"
#include "core/simd_sets.h"

// A shorter translation counts as none, m.
#define FE__MESH_STILL 1e-200

typedef struct fe__mesh_hit {
    fe__ray_hit hit;   // .triangle: the caller's number, .index: the slot
    int32_t is_back;   // The ray comes from the side around which corners turn right.
    double weights[3]; // weights of the corners; their sum is 1
} fe__mesh_hit;

// A box that moves. `visit` gets the slot of a triangle and returns the end of the way that is left, t.
typedef struct fe__mesh_way {
    fe_dvec3 origin, translation, half;
} fe__mesh_way;
typedef double (*fe__mesh_visit)(void *context, int32_t slot);

// The kernels of a SIMD set; all sets give the same answers.
struct fe__mesh_casts {
    // 1: hit
    int32_t (*ray)(const fe__mesh *mesh, fe_dvec3 origin, fe_dvec3 translation, double limit, fe__mesh_hit *hit);
    // Visits the triangles whose bounds the box meets at 0 <= t <= limit, the nearest of a node's children first. A
    // translation that counts as none visits no triangle.
    void (*sweep)(const fe__mesh *mesh, const fe__mesh_way *way, double limit, fe__mesh_visit visit, void *context);
};
extern const fe__mesh_casts FE_BASE_SET(fe__mesh_casts);
// The kernels of that set, or of plain C if it was not built.
const fe__mesh_casts *fe__mesh_casts_of(int32_t simd);

static inline int32_t fe__ground_ray(const fe__ground *s, fe_dvec3 origin, fe_dvec3 translation, double limit,
                                     fe__ray_hit *hit)
{
    if (!s->mesh) return fe__heightfield_ray(s->field, origin, translation, limit, hit);
    fe__mesh_hit found;
    const fe__mesh_casts *casts = s->casts ? s->casts : &FE_BASE_SET(fe__mesh_casts);
    if (!casts->ray(s->mesh, origin, translation, limit, &found)) return 0;
    *hit = found.hit;
    return 1;
}

#endif
