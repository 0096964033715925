// surroundings.h - what static boxes, hulls, meshes and heightfields lie near a body that touches one of them.
#ifndef FE_STEP_SURROUNDINGS_H
#define FE_STEP_SURROUNDINGS_H
#include "collision/manifold/patch.h"
#include "step/view.h"

int32_t fe__is_static_solid(const fe_world *world, const fe__shape *shape);
// What lies near `other` beside `self`, in the view's frame; of much the nearest. `centre`: of the other there
// (fe__form_middle)
void fe__find_surroundings(const fe_world *world, const fe__view *v, const fe__shape *self, const fe__shape *other,
                           fe_vec3 centre, fe__surroundings *found);

#endif
