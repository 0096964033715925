// common.c - what several kinds of forms have in common.
#include "collision/form/kinds.h"

#include <float.h>

fe__mass fe__no_mass(const fe__form *form, double density)
{
    (void)form, (void)density;
    return (fe__mass){.mass = 0.0f};
}

float fe__no_reach(const fe__form *form, fe_vec3 centre)
{
    (void)form, (void)centre;
    return 0.0f;
}

float fe__no_thickness(const fe__form *form)
{
    (void)form;
    return FLT_MAX;
}

// |R| half, the half widths along the world's axes of a box rotated by q: R = 1 + k (...), k = 2 / q.q, so that any
// length of q will do.
fe_dvec3 fe__rotated_widths(fe_quat q, fe_dvec3 half)
{
    double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w,
           k = 2.0 / (x * x + y * y + z * z + w * w);
    double xx = k * x * x, yy = k * y * y, zz = k * z * z, xy = k * x * y, xz = k * x * z, yz = k * y * z;
    double wx = k * w * x, wy = k * w * y, wz = k * w * z;
    return (fe_dvec3){fe__absd(1.0 - yy - zz) * half.x + fe__absd(xy - wz) * half.y + fe__absd(xz + wy) * half.z,
                      fe__absd(xy + wz) * half.x + fe__absd(1.0 - xx - zz) * half.y + fe__absd(yz - wx) * half.z,
                      fe__absd(xz - wy) * half.x + fe__absd(yz + wx) * half.y + fe__absd(1.0 - xx - yy) * half.z};
}

// half is 0 but for a box, half_height is 0 but for a capsule: the core is the box of both
fe__bounds fe__core_bounds(const fe__form *form, const fe__pose *pose)
{
    fe_dvec3 half = fe__widen(form->half), p = pose->position;
    half.y += (double)form->half_height;
    half = fe__rotated_widths(pose->rotation, half);
    double r = (double)form->radius;
    half = (fe_dvec3){half.x + r, half.y + r, half.z + r};
    return (fe__bounds){fe__dsub(p, half), fe__dadd(p, half)};
}

float fe__core_reach(const fe__form *form, fe_vec3 centre)
{
    fe_vec3 far = {fe__absf(centre.x) + form->half.x, fe__absf(centre.y) + form->half.y + form->half_height,
                   fe__absf(centre.z) + form->half.z};
    return fe__length(far) + form->radius;
}

float fe__radius_of(const fe__form *form) { return form->radius; }

fe__form fe__less_radius(const fe__form *form, float by)
{
    fe__form thin = *form;
    thin.radius -= by;
    return thin;
}

fe_dvec3 fe__point_support(const fe__form *form, fe_dvec3 direction)
{
    (void)form, (void)direction;
    return (fe_dvec3){0.0, 0.0, 0.0};
}

void fe__point_face(const fe__form *form, fe_vec3 direction, fe__face *face)
{
    (void)form, (void)direction;
    face->count = 1;
    face->normal = face->vertex[0] = fe__vec3(0.0f, 0.0f, 0.0f);
    face->id = 0;
}
