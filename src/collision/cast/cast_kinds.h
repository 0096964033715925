// cast_kinds.h - rays, nearest points and distances of forms, and the table of casts with a row for each kind of form.
//
// The queries, the sweeps and the time of impact call it. All is exact, in double, in the form's frame.
#ifndef FE_COLLISION_CAST_CAST_KINDS_H
#define FE_COLLISION_CAST_CAST_KINDS_H
#include "collision/form/form.h"
#include "collision/form/ground.h"
#include "collision/form/hull.h"

// ---- nearest point --------------------------------------------------------------------------------------------------
// The point of a form's surface nearest to a point. If several are equally near, it is always the same.
typedef struct fe__nearest {
    double distance;  // m, below 0 inside
    fe_dvec3 normal;  // unit, out of the form
    fe_dvec3 point;   // on the surface
    int32_t triangle; // number of a heightfield's or a mesh's triangle, or of a hull's face; -1: other forms
    int32_t index;    // index of the triangle in ground.h
} fe__nearest;

fe__nearest fe__form_nearest(const fe__form *form, fe_dvec3 point);

// Finds the nearest point of a heightfield's upper side, or of either side of a mesh. 1: there is one no farther than
// `limit`, which may be infinite. A triangle of a heightfield is not seen from below: a point under all of them has no
// nearest point, and in a field of holes no point has one.
int32_t fe__ground_nearest(const fe__ground *surface, fe_dvec3 point, double limit, fe__nearest *nearest);

// Works in the hull's frame. For a point outside it gives the nearest point of a face, of equally near faces the one
// with the lowest number; for a point inside, the way out through the nearest plane. Both are off by the hull's
// flatness at most.
fe__nearest fe__hull_nearest(const fe__hull *hull, fe_dvec3 point);

// ---- distance -------------------------------------------------------------------------------------------------------
// The distance of two forms, by GJK on the cores, in a frame that the caller puts near them. The time of impact (toi.c)
// reads it. Planes are half spaces; a heightfield hands in its triangles.
typedef struct fe__gap {
    double distance; // m; below 0 the round sides overlap, by so much at most, but the cores are still apart
    fe_dvec3 normal; // unit, from A to B
    fe_dvec3 on_b;   // point of B's core nearest to A
    int32_t overlap; // The cores overlap: distance is minus both radii; normal and point mean nothing.
} fe__gap;

void fe__form_gap(const fe__form *a, const fe__pose *pose_a, const fe__form *b, const fe__pose *pose_b, fe__gap *gap);

// ---- the table ----------------------------------------------------------------------------------------------------
// A ray with its translation scaled: origin + s * direction, t = s * per_s.
typedef struct fe__scaled_ray {
    fe_dvec3 origin, direction;
    double per_s;
    double limit; // greatest t
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
// The face of a hull on which the point lies; of several the one that looks most along `normal`, of equal ones the one
// with the lowest number.
int32_t fe__hull_face_at(const fe__form *form, fe_dvec3 point, fe_dvec3 normal);

// ---- ray ------------------------------------------------------------------------------------------------------------
// The ray is origin + t * translation, 0 <= t <= limit. A ray that begins in the form hits at t = 0, with the normal
// against its direction (for a zero translation: the shortest way out) and the depth below the surface. A triangle is
// hit from its own side only and has no inside; a heightfield's ray is in heightfield.h. 1: hit
int32_t fe__form_ray_at(const fe__form *form, const fe_dvec3 *origin, const fe_dvec3 *translation, double limit,
                        fe__ray_hit *hit);
static inline int32_t fe__form_ray(const fe__form *form, fe_dvec3 origin, fe_dvec3 translation, double limit,
                                   fe__ray_hit *hit)
{
    return fe__form_ray_at(form, &origin, &translation, limit, hit);
}

#endif
