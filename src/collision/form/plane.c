// plane.c - the half space normal . p <= distance.
#include "collision/form/kinds.h"

static fe__bounds everywhere(void)
{
    double inf = (double)INFINITY;
    return (fe__bounds){{-inf, -inf, -inf}, {inf, inf, inf}};
}

fe__bounds fe__plane_bounds(const fe__form *form, const fe__pose *pose)
{
    fe__bounds bounds = everywhere();
    fe_dvec3 n = fe__drotate(pose->rotation, fe__widen(form->normal)), p = pose->position;
    double d = (double)form->distance;
    if (n.y == 0.0 && n.z == 0.0) *(n.x > 0.0 ? &bounds.high.x : &bounds.low.x) = p.x + n.x * d;
    if (n.x == 0.0 && n.z == 0.0) *(n.y > 0.0 ? &bounds.high.y : &bounds.low.y) = p.y + n.y * d;
    if (n.x == 0.0 && n.y == 0.0) *(n.z > 0.0 ? &bounds.high.z : &bounds.low.z) = p.z + n.z * d;
    return bounds;
}

// n . p <= d + gap somewhere in the box
int32_t fe__plane_meets_box(const fe__form *plane, const fe__pose *pose, const fe__bounds *box, double gap)
{
    fe_dvec3 n = fe__drotate(pose->rotation, fe__widen(plane->normal));
    double d = fe__ddot(n, pose->position) + (double)plane->distance;
    fe_dvec3 low = {n.x > 0.0 ? box->low.x : box->high.x, n.y > 0.0 ? box->low.y : box->high.y,
                    n.z > 0.0 ? box->low.z : box->high.z};
    return fe__ddot(n, low) <= d + gap;
}

void fe__plane_move_frame(fe__form *plane, fe_quat rotation, fe_dvec3 away)
{
    fe_dvec3 normal = fe__drotate(rotation, fe__widen(plane->normal));
    plane->distance = (float)((double)plane->distance - fe__ddot(normal, away));
}
