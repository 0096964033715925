// nearest.h - the point of a form's surface nearest to a point.
//
// Closed forms in double, in the form's frame. Read by queries. Distances are signed: below 0 inside.
#ifndef FE_COLLISION_CAST_NEAREST_H
#define FE_COLLISION_CAST_NEAREST_H
#include "collision/form/ground.h"
#include "collision/form/hull.h"

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

#endif
