// kinds.h - what each kind of form puts into the table of casts.
#ifndef FE_COLLISION_CAST_KINDS_H
#define FE_COLLISION_CAST_KINDS_H
#include "collision/cast/nearest.h"
#include "collision/form/ray_hit.h"

// The ray with its translation scaled: origin + s * direction, t = s * per_s.
typedef struct fe__scaled_ray {
    fe_dvec3 origin, direction;
    double per_s;
    double limit; // of t
} fe__scaled_ray;

typedef struct fe__cast_traits {
    int32_t (*ray)(const fe__form *form, const fe__scaled_ray *ray, fe__ray_hit *hit); // 1: hit
    fe__nearest (*nearest)(const fe__form *form, fe_dvec3 point);
    int32_t core; // fe__core_kind
} fe__cast_traits;
extern const fe__cast_traits fe__casts[FE__FORM_TYPES]; // table.c

int32_t fe__ray_sphere(const fe__form *form, const fe__scaled_ray *ray, fe__ray_hit *hit);
int32_t fe__ray_capsule(const fe__form *form, const fe__scaled_ray *ray, fe__ray_hit *hit);
int32_t fe__ray_box(const fe__form *form, const fe__scaled_ray *ray, fe__ray_hit *hit);
int32_t fe__ray_cylinder(const fe__form *form, const fe__scaled_ray *ray, fe__ray_hit *hit);
int32_t fe__ray_cone(const fe__form *form, const fe__scaled_ray *ray, fe__ray_hit *hit);
int32_t fe__ray_hull(const fe__form *form, const fe__scaled_ray *ray, fe__ray_hit *hit);
int32_t fe__ray_plane(const fe__form *form, const fe__scaled_ray *ray, fe__ray_hit *hit);
int32_t fe__ray_triangle(const fe__form *form, const fe__scaled_ray *ray, fe__ray_hit *hit);
fe__nearest fe__nearest_on_sphere(const fe__form *form, fe_dvec3 point);
fe__nearest fe__nearest_on_capsule(const fe__form *form, fe_dvec3 point);
fe__nearest fe__nearest_on_box(const fe__form *form, fe_dvec3 point);
fe__nearest fe__nearest_on_cylinder(const fe__form *form, fe_dvec3 point);
fe__nearest fe__nearest_on_cone(const fe__form *form, fe_dvec3 point);
fe__nearest fe__nearest_on_hull(const fe__form *form, fe_dvec3 point);
fe__nearest fe__nearest_on_plane(const fe__form *form, fe_dvec3 point);
// Of the faces of a hull on which the point lies the one that looks most along `normal`; of equals the lowest.
int32_t fe__hull_face_at(const fe__form *form, fe_dvec3 point, fe_dvec3 normal);

#endif
