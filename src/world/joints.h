// joints.h - the life of joints. What they are made of: joint_parts.h; how they stand: joint_state.h.
#ifndef FE_WORLD_JOINTS_H
#define FE_WORLD_JOINTS_H
#include "world/world.h"

void fe__joints_init(fe_world *world);
// From a checked definition of that type; an end of -1 is the world. FE_ERROR_MEMORY, FE_ERROR_LIMIT: nothing changed.
// Both wake the bodies.
fe_result fe__joint_create(fe_world *world, int32_t type, const fe__joint_any *def, const int32_t *ends,
                           int32_t *out_joint);
fe_result fe__joint_change(fe_world *world, int32_t joint, const fe__joint_any *def); // all but its bodies
void fe__joint_destroy(fe_world *world, int32_t joint);
// Wakes nobody: within a step, which has reserved for those that it found awake
void fe__joint_remove(fe_world *world, int32_t joint);
// What the solver reads of it, by the plan of its settings; impulses and states go on where their parts do
struct fe__joint_plan;
void fe__joint_fill(fe_world *world, int32_t joint, const struct fe__joint_plan *plan);
int32_t fe__joint_acts(const fe_world *world, int32_t joint); // 1: it is in the constraint graph, or is to be
void fe__joint_describe(const fe_world *world, int32_t joint,
                        fe__joint_any *out_def);          // as it was set; struct_size is that of its type
void fe__body_drop_joints(fe_world *world, int32_t body); // in the order of creation
void fe__body_unlink_joints(fe_world *world,
                            int32_t body);                // before its type, its locks or whether it is enabled change
void fe__body_link_joints(fe_world *world, int32_t body); // after
void fe__body_place_anchors(fe_world *world, int32_t body); // its centre of mass is another point
void fe__body_wind_joints(fe_world *world, int32_t body);   // its pose was set
void fe__body_forget_joints(fe_world *world, int32_t body); // impulses and states of its joints

#endif
