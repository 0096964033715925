// nearest.c - see nearest.h.
#include "collision/cast/nearest.h"

#include "collision/cast/kinds.h"

static double clamp(double x, double half) { return fe__mind(fe__maxd(x, -half), half); }

// A core's nearest point and a radius. `flat` is the normal where the point lies on the core.
static fe__nearest on_round(fe_dvec3 point, fe_dvec3 core, double radius, fe_dvec3 flat)
{
    fe_dvec3 away = fe__dsub(point, core);
    double distance = sqrt(fe__ddot(away, away));
    fe_dvec3 normal = distance > 0.0 ? fe__dscale(1.0 / distance, away) : flat;
    return (fe__nearest){distance - radius, normal, fe__dadd(core, fe__dscale(radius, normal)), -1, -1};
}

static fe__nearest on_box_from_inside(fe_dvec3 point, fe_dvec3 half)
{
    const double p[3] = {point.x, point.y, point.z}, h[3] = {half.x, half.y, half.z};
    int32_t axis = 0;
    for (int32_t k = 1; k < 3; ++k) {
        if (h[k] - fe__absd(p[k]) < h[axis] - fe__absd(p[axis])) axis = k;
    }
    double side = p[axis] < 0.0 ? -1.0 : 1.0, on[3] = {p[0], p[1], p[2]}, n[3] = {0.0, 0.0, 0.0};
    on[axis] = side * h[axis], n[axis] = side;
    return (fe__nearest){fe__absd(p[axis]) - h[axis], {n[0], n[1], n[2]}, {on[0], on[1], on[2]}, -1, -1};
}

fe__nearest fe__nearest_on_sphere(const fe__form *form, fe_dvec3 point)
{
    return on_round(point, (fe_dvec3){0.0, 0.0, 0.0}, (double)form->radius, (fe_dvec3){0.0, 1.0, 0.0});
}

fe__nearest fe__nearest_on_capsule(const fe__form *form, fe_dvec3 point)
{
    return on_round(point, (fe_dvec3){0.0, clamp(point.y, (double)form->half_height), 0.0}, (double)form->radius,
                    (fe_dvec3){1.0, 0.0, 0.0});
}

fe__nearest fe__nearest_on_box(const fe__form *form, fe_dvec3 point)
{
    fe_dvec3 half = fe__widen(form->half), flat = {0.0, 1.0, 0.0};
    fe_dvec3 core = {clamp(point.x, half.x), clamp(point.y, half.y), clamp(point.z, half.z)};
    int32_t inside = core.x == point.x && core.y == point.y && core.z == point.z;
    return inside ? on_box_from_inside(point, half) : on_round(point, core, 0.0, flat);
}

fe__nearest fe__nearest_on_plane(const fe__form *form, fe_dvec3 point)
{
    fe_dvec3 n = fe__widen(form->normal);
    double length = sqrt(fe__ddot(n, n)); // 1 up to the rounding of floats
    double height = (fe__ddot(n, point) - (double)form->distance) / length;
    fe_dvec3 unit = fe__dscale(1.0 / length, n);
    return (fe__nearest){height, unit, fe__dsub(point, fe__dscale(height, unit)), -1, -1};
}

fe__nearest fe__form_nearest(const fe__form *form, fe_dvec3 point)
{
    return fe__casts[form->type].nearest(form, point);
}
