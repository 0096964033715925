// mesh_ray.h - a ray against a mesh, watertight, in double, in the mesh's frame.
//
// origin + t * translation, 0 <= t <= limit. One-sided meshes are met from the side around which corners turn left;
// two-sided ones from both, with the normal against the ray. A mesh has no inside, and a translation of length 0 meets
// nothing. Of equal t the triangle with the lowest number is hit: the answer does not depend on the tree.
#ifndef FE_COLLISION_CAST_MESH_RAY_H
#define FE_COLLISION_CAST_MESH_RAY_H
#include "collision/form/ground.h"
#include "collision/form/form.h"
#include "core/simd_sets.h"

// A translation that moves less than this moves by nothing, m
#define FE__MESH_STILL 1e-200

typedef struct fe__mesh_hit {
    fe__ray_hit hit;   // .triangle: the caller's number, .index: the slot
    int32_t is_back;   // from the side around which corners turn right
    double weights[3]; // of the corners, their sum is 1
} fe__mesh_hit;

// A box along its way. `visit` gets the slot of a triangle and returns what is left of the way, t
typedef struct fe__mesh_way {
    fe_dvec3 origin, translation, half;
} fe__mesh_way;
typedef double (*fe__mesh_visit)(void *context, int32_t slot);

// Once for each SIMD set, with the same answers
struct fe__mesh_casts {
    int32_t (*ray)(const fe__mesh *mesh, fe_dvec3 origin, fe_dvec3 translation, double limit,
                   fe__mesh_hit *hit); // 1: hit
    // Triangles whose bounds the box meets at 0 <= t <= limit, of a node's children the nearest first. None for a
    // translation that moves by nothing.
    void (*sweep)(const fe__mesh *mesh, const fe__mesh_way *way, double limit, fe__mesh_visit visit, void *context);
};
extern const fe__mesh_casts FE_BASE_SET(fe__mesh_casts);
const fe__mesh_casts *fe__mesh_casts_of(int32_t simd); // of a set that was built, else of plain C

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
