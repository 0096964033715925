// material.h - what a shape is made of, there.
#ifndef FE_WORLD_MATERIAL_H
#define FE_WORLD_MATERIAL_H
#include "world/world.h"

// `cell`: of its heightfield, -1: none in particular
static inline const fe_material *fe__shape_material(const fe_world *world, const fe__shape *shape, int32_t cell)
{
    if (!fe__form_is_field(&shape->form) || cell < 0) return &shape->material;
    const fe__asset *a = fe__store_asset(world->store, shape->form.field);
    return a->material_count ? a->materials + a->field.cells[cell] : &shape->material;
}

#endif
