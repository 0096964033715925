// distance.c - see distance.h.
#include "collision/cast/distance.h"

#include "collision/cast/mover.h"
#include "collision/form/gjk.h"

// B's deepest point below the surface of a half space A
static void plane_gap(const fe__form *plane, const fe__pose *pose_a, const fe__form *b, const fe__pose *pose_b,
                      fe__gap *gap)
{
    fe_dvec3 normal = fe__drotate(pose_a->rotation, fe__widen(plane->normal));
    fe_dvec3 down = fe__drotate_back(pose_b->rotation, fe__dscale(-1.0, normal));
    fe_dvec3 lowest = fe__dadd(pose_b->position, fe__drotate(pose_b->rotation, fe__form_support(b, down)));
    double length = sqrt(fe__ddot(normal, normal)); // 1 up to the rounding of floats
    double height = fe__ddot(normal, fe__dsub(lowest, pose_a->position)) - (double)plane->distance;
    gap->normal = fe__dscale(1.0 / length, normal);
    gap->distance = height / length - (double)b->radius;
    gap->on_b = lowest;
    gap->overlap = 0;
}

void fe__form_gap(const fe__form *a, const fe__pose *pose_a, const fe__form *b, const fe__pose *pose_b, fe__gap *gap)
{
    if (fe__form_is_unbounded(a)) {
        plane_gap(a, pose_a, b, pose_b, gap);
        return;
    }
    if (fe__form_is_unbounded(b)) {
        plane_gap(b, pose_b, a, pose_a, gap);
        gap->on_b = fe__dsub(gap->on_b, fe__dscale(gap->distance + (double)a->radius, gap->normal));
        gap->normal = fe__dscale(-1.0, gap->normal);
        return;
    }
    fe__axes frame = fe__axes_of(pose_a->rotation), other = fe__axes_of(pose_b->rotation);
    fe__cores cores = {a,
                       b,
                       fe__turn_back(&frame, fe__dsub(pose_b->position, pose_a->position)),
                       fe__turn_back(&frame, other.x),
                       fe__turn_back(&frame, other.y),
                       fe__turn_back(&frame, other.z),
                       NULL};
    fe__gjk gjk;
    fe__gjk_distance(&cores, (double)INFINITY, &gjk);
    gap->overlap = gjk.overlap;
    gap->on_b = fe__dadd(pose_a->position, fe__turn(&frame, gjk.on_b));
    gap->distance = gjk.distance - (double)a->radius - (double)b->radius;
    gap->normal = gjk.overlap ? (fe_dvec3){0.0, 0.0, 0.0}
                              : fe__turn(&frame, fe__dscale(1.0 / gjk.distance, fe__dsub(gjk.on_b, gjk.on_a)));
}
