// material.h - what a shape is made of, there.
#ifndef FE_WORLD_MATERIAL_H
#define FE_WORLD_MATERIAL_H
#include "world/world.h"

// `triangle`: of its surface, -1: none in particular
static inline const fe_material *fe__shape_material(const fe_world *world, const fe__shape *shape, int32_t triangle)
{
    return fe__material_of_shape(world->store, shape, triangle);
}

// Of a pair, under its points: of shape A (0) or B (1)
static inline const fe_material *fe__pair_material(const fe_world *world, int32_t pair, int32_t side)
{
    const fe__pair *p = world->pairs + pair;
    return fe__shape_material(world, world->shapes + (side ? p->shape_b : p->shape_a), p->triangle);
}

#endif
