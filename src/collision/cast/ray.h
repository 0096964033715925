// ray.h - a ray against a form, exact, in double, in the form's frame.
//
// origin + t * translation, 0 <= t <= limit. Starting in the form is a hit at t = 0 with the normal against the
// direction (for a zero translation: the shortest way out) and the depth below the surface. A triangle is hit from its
// side only and has no inside; a heightfield's ray is in heightfield.h.
#ifndef FE_COLLISION_CAST_RAY_H
#define FE_COLLISION_CAST_RAY_H
#include "collision/form/ray_hit.h"

// 1: hit
int32_t fe__form_ray_at(const fe__form *form, const fe_dvec3 *origin, const fe_dvec3 *translation, double limit,
                        fe__ray_hit *hit);
static inline int32_t fe__form_ray(const fe__form *form, fe_dvec3 origin, fe_dvec3 translation, double limit,
                                   fe__ray_hit *hit)
{
    return fe__form_ray_at(form, &origin, &translation, limit, hit);
}

#endif
