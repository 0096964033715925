// ray_hit.h - where a ray meets a form.
#ifndef FE_COLLISION_FORM_RAY_HIT_H
#define FE_COLLISION_FORM_RAY_HIT_H
#include "collision/form/form.h"

typedef struct fe__ray_hit {
    double t;
    fe_dvec3 normal; // unit, form's frame
    double depth;    // > 0 when inside, else 0
    int32_t inside;
    int32_t triangle; // number, of a heightfield or a mesh; the face of a hull; else -1
    int32_t index;    // of a triangle of the ground: see ground.h
} fe__ray_hit;

#endif
