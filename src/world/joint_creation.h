// joint_creation.h - the life of joints: creation, change, destruction. joint_parts.h has the parts that they are made
// of.
#ifndef FE_WORLD_JOINT_CREATION_H
#define FE_WORLD_JOINT_CREATION_H
#include "world/joint.h"
#include "world/world.h"

void fe__joints_init(fe_world *world);
// From a checked definition of that type; an end of -1 is the world. FE_ERROR_MEMORY, FE_ERROR_LIMIT: nothing changed.
// Creation and change wake the bodies.
fe_result fe__joint_create(fe_world *world, int32_t type, const fe__joint_any *def, const int32_t *ends,
                           int32_t *out_joint);
fe_result fe__joint_change(fe_world *world, int32_t joint, const fe__joint_any *def); // all but its bodies
void fe__joint_destroy(fe_world *world, int32_t joint);
// Destroys a joint and wakes no body: within a step, which has reserved for the bodies that it found awake.
void fe__joint_remove(fe_world *world, int32_t joint);
// Writes the solver's half of a joint by a plan of its settings. Impulses and states of parts that stay go on.
struct fe__joint_plan;
void fe__joint_fill(fe_world *world, int32_t joint, const struct fe__joint_plan *plan);
int32_t fe__joint_acts(const fe_world *world, int32_t joint); // 1: it is in the constraint graph, or is to be
// The definition as it was set; struct_size is that of its type.
void fe__joint_describe(const fe_world *world, int32_t joint, fe__joint_any *out_def);

void fe__body_drop_joints(fe_world *world, int32_t body); // destroys its joints, in the order of creation
// Called before, and after, a change of the body's type or locks, or of whether it is enabled.
void fe__body_unlink_joints(fe_world *world, int32_t body);
void fe__body_link_joints(fe_world *world, int32_t body);
void fe__body_place_anchors(fe_world *world, int32_t body); // after a change of its centre of mass
void fe__body_wind_joints(fe_world *world, int32_t body);   // after a change of its pose
void fe__body_forget_joints(fe_world *world, int32_t body); // clears impulses and states of its joints

// The handle of a joint's end; 0: the world
static inline fe_body fe__joint_end_handle(const fe_world *world, int32_t joint, int32_t side)
{
    int32_t body = world->joint_records[joint].body[side];
    return world->bodies[body].flags & FE__BODY_ANCHOR ? 0 : fe__body_handle(world, body);
}

// ---- joint trees ----------------------------------------------------------------------------------------------------
// The joints that the tree solver takes: a spanning forest of the bodies that they hold.

int32_t fe__find_joint_trees(fe_world *world); // unless they are up to date. 0: no memory, nothing changed
void fe__forest_free(fe__forest *forest, fe__memory *memory);

#endif
