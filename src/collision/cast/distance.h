// distance.h - how far two forms are apart, wherever they are.
//
// In double, by GJK on the cores, in a frame that the caller puts near them. Read by the time of impact. Planes are
// half spaces; a heightfield hands in its triangles.
#ifndef FE_COLLISION_CAST_DISTANCE_H
#define FE_COLLISION_CAST_DISTANCE_H
#include "collision/form/form.h"

typedef struct fe__gap {
    double distance; // m; below 0 the round sides overlap, by so much at most: the cores are still apart
    fe_dvec3 normal; // unit, from A to B
    fe_dvec3 on_b;   // B's core, nearest to A
    int32_t overlap; // the cores overlap: distance is minus both radii, normal and point of no meaning
} fe__gap;

void fe__form_gap(const fe__form *a, const fe__pose *pose_a, const fe__form *b, const fe__pose *pose_b, fe__gap *gap);

#endif
