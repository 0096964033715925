// view.h - a pair as the narrow phase sees it: one shape in the frame of the other, the bodies at some time of the
// step.
#ifndef FE_STEP_VIEW_H
#define FE_STEP_VIEW_H
#include "collision/manifold/manifold.h"
#include "world/world.h"

typedef struct fe__view {
    const fe__shape *a, *b; // fe__collide's
    fe__form form_a;        // a plane's is moved next to B
    fe__relative relative;
    fe_dvec3 origin; // of the frame of A, world
    fe__mat3 rotation;
} fe__view;

// where the two bodies are when the manifold is looked for: the solver's A and B
typedef struct fe__places {
    fe_dvec3 centre_a, centre_b;
    fe_quat rotation_a, rotation_b;
} fe__places;

#endif
