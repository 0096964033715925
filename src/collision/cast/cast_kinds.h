// cast_kinds.h - what each kind of form puts into the table of casts.
#ifndef FE_COLLISION_CAST_CAST_KINDS_H
#define FE_COLLISION_CAST_CAST_KINDS_H
#include "collision/form/form.h"
#include "collision/form/ground.h"
#include "collision/form/hull.h"

// ---- closest --------------------------------------------------------------------------------------------------------
// The point of a form's surface nearest to a point.
//
// Closed forms in double, in the form's frame. Read by queries. Distances are signed: below 0 inside.

// ---- nearest --------------------------------------------------------------------------------------------------------

typedef struct fe__nearest {
    double distance;  // m, below 0 inside
    fe_dvec3 normal;  // unit, out of the form; where several are as near, always the same
    fe_dvec3 point;   // on the surface
    int32_t triangle; // number, of a heightfield or a mesh; the face of a hull; else -1
    int32_t index;    // of a triangle of the ground: see ground.h
} fe__nearest;

fe__nearest fe__form_nearest(const fe__form *form, fe_dvec3 point);

// The nearest point of a heightfield's upper side, or of either side of a mesh, no farther than `limit`, which may be
// infinite: 1. From below a triangle of a heightfield is not seen: a point under all of them has none, and a field of
// holes has none for any point.
int32_t fe__ground_nearest(const fe__ground *surface, fe_dvec3 point, double limit, fe__nearest *nearest);

// In the hull's frame. Outside it is the nearest point of a face, the lowest of those as near; inside, the way out is
// through the plane that is nearest. Both are off by the hull's flatness at most.
fe__nearest fe__hull_nearest(const fe__hull *hull, fe_dvec3 point);

// ---- distance -------------------------------------------------------------------------------------------------------
// How far two forms are apart, wherever they are.
//
// In double, by GJK on the cores, in a frame that the caller puts near them. Read by the time of impact. Planes are
// half spaces; a heightfield hands in its triangles.

typedef struct fe__gap {
    double distance; // m; below 0 the round sides overlap, by so much at most: the cores are still apart
    fe_dvec3 normal; // unit, from A to B
    fe_dvec3 on_b;   // B's core, nearest to A
    int32_t overlap; // the cores overlap: distance is minus both radii, normal and point of no meaning
} fe__gap;

void fe__form_gap(const fe__form *a, const fe__pose *pose_a, const fe__form *b, const fe__pose *pose_b, fe__gap *gap);

// ---- the table ----------------------------------------------------------------------------------------------------

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
extern const fe__cast_traits fe__casts[FE__FORM_TYPES]; // cast_table.c

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

// ---- ray ------------------------------------------------------------------------------------------------------------
// A ray against a form, exact, in double, in the form's frame.
//
// origin + t * translation, 0 <= t <= limit. Starting in the form is a hit at t = 0 with the normal against the
// direction (for a zero translation: the shortest way out) and the depth below the surface. A triangle is hit from its
// side only and has no inside; a heightfield's ray is in heightfield.h.

// 1: hit
int32_t fe__form_ray_at(const fe__form *form, const fe_dvec3 *origin, const fe_dvec3 *translation, double limit,
                        fe__ray_hit *hit);
static inline int32_t fe__form_ray(const fe__form *form, fe_dvec3 origin, fe_dvec3 translation, double limit,
                                   fe__ray_hit *hit)
{
    return fe__form_ray_at(form, &origin, &translation, limit, hit);
}

#endif
