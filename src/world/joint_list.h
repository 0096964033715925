// joint_list.h - the lists that a joint is in: of both bodies, of all joints by creation, and of the joints that are
// awake.
#ifndef FE_WORLD_JOINT_LIST_H
#define FE_WORLD_JOINT_LIST_H
#include "world/world.h"

static inline int32_t fe__joint_side(const fe__joint_record *r, int32_t body) { return r->body[0] == body ? 0 : 1; }
// in the list of `body`
static inline int32_t fe__next_joint(const fe_world *world, int32_t joint, int32_t body)
{
    const fe__joint_record *r = world->joint_records + joint;
    return r->links[fe__joint_side(r, body)].next;
}
static inline int32_t fe__joint_other(const fe_world *world, int32_t joint, int32_t body)
{
    const fe__joint_record *r = world->joint_records + joint;
    return r->body[!fe__joint_side(r, body)];
}
void fe__joint_add_to_body(fe_world *world, int32_t joint, int32_t body);
void fe__joint_remove_from_body(fe_world *world, int32_t joint, int32_t body);
void fe__joint_append_to_order(fe_world *world, int32_t joint);
void fe__joint_remove_from_order(fe_world *world, int32_t joint);

void fe__joint_awaken(fe_world *world, int32_t joint);      // when a dynamic end is awake
void fe__joint_retire(fe_world *world, int32_t joint);      // when none is
void fe__joint_leave_awake(fe_world *world, int32_t joint); // whoever is

// Does it keep its bodies from touching?
static inline int32_t fe__joint_parts_bodies(const fe__joint_record *r)
{
    return (r->flags & (FE__JOINT_ENABLED | FE__JOINT_COLLIDES)) == FE__JOINT_ENABLED;
}
int32_t fe__bodies_joined(const fe_world *world, int32_t body_a, int32_t body_b); // by a joint that does

#endif
