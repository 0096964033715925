// handles.h - the handle of a record.
#ifndef FE_WORLD_HANDLES_H
#define FE_WORLD_HANDLES_H
#include "world/world.h"

static inline fe_handle fe__body_handle(const fe_world *world, int32_t body)
{
    return fe__id_pool_handle(&world->body_ids, body);
}
// Of a part: that of its compound
static inline fe_handle fe__shape_handle(const fe_world *world, int32_t shape)
{
    return fe__id_pool_handle(&world->shape_ids, fe__whole_shape(world->shapes, shape));
}
static inline fe_handle fe__joint_handle(const fe_world *world, int32_t joint)
{
    return fe__id_pool_handle(&world->joint_ids, joint - 1); // joint 0 is none
}

// Of the end of a joint; 0: the world
static inline fe_body fe__joint_end_handle(const fe_world *world, int32_t joint, int32_t side)
{
    int32_t body = world->joint_records[joint].body[side];
    return world->bodies[body].flags & FE__BODY_ANCHOR ? 0 : fe__body_handle(world, body);
}

#endif
