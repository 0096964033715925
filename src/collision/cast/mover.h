// mover.h - a form that moves in the frame of another, and where it is stopped.
#ifndef FE_COLLISION_CAST_MOVER_H
#define FE_COLLISION_CAST_MOVER_H
#include "collision/form/ground.h"

#define FE_SWEEP_GAP 1e-7 // m
// Forms touch when they overlap by no more than this, or are no farther apart, m. It is a hundredth of the gap, and
// more than rounding makes of an exact touch.
#define FE_SWEEP_TOUCH 1e-9

// Three columns of a rotation: the images of the axes.
typedef struct fe__axes {
    fe_dvec3 x, y, z;
} fe__axes;

fe__axes fe__axes_of(fe_quat q); // of any length
static inline fe_dvec3 fe__turn(const fe__axes *m, fe_dvec3 a)
{
    return fe__dadd(fe__dadd(fe__dscale(a.x, m->x), fe__dscale(a.y, m->y)), fe__dscale(a.z, m->z));
}
static inline fe_dvec3 fe__turn_back(const fe__axes *m, fe_dvec3 a)
{
    return (fe_dvec3){fe__ddot(m->x, a), fe__ddot(m->y, a), fe__ddot(m->z, a)};
}

// The moving form (anything bounded) in the frame of the standing one.
typedef struct fe__mover {
    const fe__form *form;
    fe__axes axes;
    fe_dvec3 position, translation; // m
    fe_dvec3 turn;                  // rad: the axes turn so far about it on the way, about the position; 0: not at all
} fe__mover;

typedef struct fe__sweep_hit {
    double t;         // of the translation
    fe_dvec3 normal;  // unit, out of the standing form; inside: the shortest way out
    fe_dvec3 point;   // of the standing form's surface, where it is met; inside: the mover's position
    double depth;     // inside: how far out that way, m
    int32_t inside;   // the forms overlap at the start
    int32_t triangle; // number, of a heightfield or a mesh; the face of a hull; else -1
    int32_t index;    // of a triangle of the ground: see ground.h
} fe__sweep_hit;

#endif
