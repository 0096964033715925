// anchor.h - the end of a joint that is the world.
//
// To the solver it is a static body without shapes, at the point that the joint's frame is measured from. It has a slot
// among the bodies, but no handle, no serial, and no place in the order of creation: nothing but its joint finds it.
#ifndef FE_WORLD_ANCHOR_H
#define FE_WORLD_ANCHOR_H
#include "world/world.h"

int32_t fe__anchor_create(fe_world *world, fe_dvec3 origin); // body index; room was reserved by fe__reserve_bodies
void fe__anchor_open(fe_world *world, int32_t body, fe_dvec3 origin); // the record of a hidden slot
void fe__anchor_destroy(fe_world *world, int32_t body);               // its joint is gone
void fe__anchor_move(fe_world *world, int32_t body, fe_dvec3 origin);
static inline int32_t fe__is_anchor(const fe_world *world, int32_t body)
{
    return (world->bodies[body].flags & FE__BODY_ANCHOR) != 0;
}

#endif
