// toi.h - the time of impact of two moving forms, by conservative advancement, in double.
//
// The continuous step (continuous/) gives the motions of two bodies and stops them at the impact. The method is that of
// B. Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems (1996), 2.3; the bound along the shortest distance
// is that of X. Zhang, M. Lee, Y. J. Kim, Interactive continuous collision detection for non-convex polyhedra (2006).
#ifndef FE_COLLISION_CAST_TOI_H
#define FE_COLLISION_CAST_TOI_H
#include "collision/form/form.h"

// The motion of a body from one pose to another, 0 <= s <= 1. The centre goes straight; the rotation at s is
// normalize(1 + s (angular_displacement - 1)) rotation, angular_displacement.w >= 0.
typedef struct fe__motion {
    fe_dvec3 centre;              // m, at s = 0; near the origin of the caller's frame
    fe_quat rotation;             // unit, at s = 0
    fe_dvec3 translation;         // m, until s = 1
    fe_quat angular_displacement; // unit, until s = 1
} fe__motion;

typedef struct fe__mobile {
    const fe__form *form;
    fe_dvec3 arm;     // from the body's centre to the form's origin, body's frame, m
    fe_quat rotation; // turns the form's frame into the body's
    fe__motion motion;
} fe__mobile;

fe__pose fe__motion_at(const fe__motion *motion, double s); // The position is that of the centre of mass.
fe__pose fe__mobile_at(const fe__mobile *mobile, double s); // The pose is that of the form.

// The two count as touching when they are nearer than this, m: a fiftieth of the solver's slop.
#define FE_TOUCH 1e-4

typedef enum fe__meeting {
    FE_MEET_NEVER, // They do not touch up to s = limit.
    FE_MEET_LATER, // They touch at s and are no nearer than that before.
    FE_MEET_NOW    // They overlap at s = 0.
} fe__meeting;

typedef struct fe__impact {
    double s;
    fe_dvec3 normal; // unit, from A to B; it means nothing if the cores overlap
    fe_dvec3 on_b;   // point of B's core nearest to A
    int32_t overlap; // The cores overlap.
} fe__impact;

fe__meeting fe__time_of_impact(const fe__mobile *a, const fe__mobile *b, double limit, fe__impact *impact);

#endif
