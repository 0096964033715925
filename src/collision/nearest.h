// nearest.h - the point of a form's surface nearest to a point.
//
// Closed forms in double, in the form's frame. Read by queries. Distances are signed: below 0 inside.
#ifndef FE_COLLISION_NEAREST_H
#define FE_COLLISION_NEAREST_H
#include "collision/form.h"

typedef struct fe__nearest {
    double distance; // m, below 0 inside
    fe_dvec3 normal; // unit, out of the form; where several are as near, always the same
    fe_dvec3 point;  // on the surface
} fe__nearest;

fe__nearest fe__form_nearest(const fe__form *form, fe_dvec3 point);

#endif
