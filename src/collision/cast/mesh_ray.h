// mesh_ray.h - a ray against a mesh, watertight, in double, in the mesh's frame.
//
// origin + t * translation, 0 <= t <= limit. One-sided meshes are met from the side around which corners turn left;
// two-sided ones from both, with the normal against the ray. A mesh has no inside, and a translation of length 0 meets
// nothing. Of equal t the triangle with the lowest number is hit: the answer does not depend on the tree.
#ifndef FE_COLLISION_CAST_MESH_RAY_H
#define FE_COLLISION_CAST_MESH_RAY_H
#include "collision/form/ground.h"
#include "collision/form/ray_hit.h"

typedef struct fe__mesh_hit {
    fe__ray_hit hit; // .triangle: the caller's number
    int32_t slot;
    int32_t is_back;   // from the side around which corners turn right
    double weights[3]; // of the corners, their sum is 1
} fe__mesh_hit;

// 1: hit
int32_t fe__mesh_ray(const fe__mesh *mesh, fe_dvec3 origin, fe_dvec3 translation, double limit, fe__mesh_hit *hit);
static inline int32_t fe__ground_ray(const fe__ground *s, fe_dvec3 origin, fe_dvec3 translation, double limit,
                                     fe__ray_hit *hit)
{
    if (!s->mesh) return fe__heightfield_ray(s->field, origin, translation, limit, hit);
    fe__mesh_hit found;
    if (!fe__mesh_ray(s->mesh, origin, translation, limit, &found)) return 0;
    *hit = found.hit;
    return 1;
}

#endif
