// hull.c - a ray on a form with a hull, the point of one nearest to a point, and the face where it is met: those of the
// hull (form/hull.c, nearest_hull.c), in the form's frame.
#include "collision/cast/kinds.h"
#include "collision/form/hull_form.h"

int32_t fe__ray_hull(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    double limit = r->per_s > 0.0 ? r->limit / r->per_s : r->limit;
    fe_dvec3 way = fe__dscale(1.0 / (double)form->scale, r->direction);
    if (!fe__hull_ray(form->hull, fe__in_hull(form, r->origin), way, limit, hit)) return 0;
    hit->t *= r->per_s;
    hit->depth *= (double)form->scale;
    return 1;
}

fe__nearest fe__nearest_on_hull(const fe__form *form, fe_dvec3 point)
{
    fe__nearest n = fe__hull_nearest(form->hull, fe__in_hull(form, point));
    n.distance *= (double)form->scale;
    n.point = fe__from_hull(form, n.point);
    return n;
}

#define ON_FACE \
    1e-5 // of the hull's extent: a point that near to a face's plane is on it; a hundred roundings of floats

int32_t fe__hull_face_at(const fe__form *form, fe_dvec3 point, fe_dvec3 normal)
{
    const fe__hull *hull = form->hull;
    fe_dvec3 p = fe__in_hull(form, point);
    double most = -(double)INFINITY, lowest = -ON_FACE * (double)hull->extent - (double)hull->flatness;
    int32_t face = -1;
    for (int32_t i = 0; i < hull->face_count; ++i) {
        fe_dvec3 n = fe__widen(fe__hull_normal(hull, i));
        if (fe__ddot(n, p) - (double)hull->distances[i] < lowest || fe__ddot(n, normal) <= most) continue;
        most = fe__ddot(n, normal);
        face = i;
    }
    return face >= 0 ? face : fe__hull_facing(hull, normal);
}
