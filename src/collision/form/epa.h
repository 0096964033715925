// epa.h - depth of two cores that overlap (van den Bergen, Proximity queries and penetration depth computation, 2001),
// in double.
//
// Goes on from the simplex around the origin with which GJK ended.
#ifndef FE_COLLISION_FORM_EPA_H
#define FE_COLLISION_FORM_EPA_H
#include "collision/form/gjk.h"

typedef struct fe__penetration {
    fe_dvec3 normal;     // unit: B leaves A soonest along it
    double depth;        // by so much, m, >= 0
    fe_dvec3 on_a, on_b; // the deepest points of the cores; on_a is the farther along the normal
} fe__penetration;

// `overlap` is a result of fe__gjk_distance with overlap set.
fe__penetration fe__epa_depth(const fe__cores *cores, const fe__gjk *overlap);

#endif
