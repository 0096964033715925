// joint_parts.h - from a joint's definition to the parts that the solver knows, and the state of a joint for the API.
#ifndef FE_WORLD_JOINT_PARTS_H
#define FE_WORLD_JOINT_PARTS_H
#include "solver/joint/joint_solver.h"
#include "world/joint.h"
#include "world/world.h"

typedef struct fe__joint_plan {
    uint32_t parts;             // 1 << fe__joint_part
    uint32_t locked;            // FE__LOCK_*
    int32_t shift;              // the solver's X is axis X + shift of the definition's
    float hertz, damping_ratio; // stiffness of the locks, 0: the world's
    fe__joint_axes axes;        // limits, drives, motors; no impulses, no states
} fe__joint_plan;

void fe__joint_make_plan(int32_t type, const fe__joint_any *def, fe__joint_plan *out_plan);
// 1: its parts need a record of axes.
static inline int32_t fe__joint_needs_axes(const fe__joint_plan *plan)
{
    return (plan->parts &
            ~(1u << FE__PART_HINGE | 1u << FE__PART_FIXED | 1u << FE__PART_SLIDE | 1u << FE__PART_POINT)) != 0;
}
// The part that uses a place in fe__joint_axes.axis; FE__PARTS: none
fe__joint_part fe__joint_part_at(uint32_t parts, int32_t place);

// Twist and swing of q, see solver/joint/joint_solver.h
void fe__joint_angles(fe_quat q, float *out_twist, float *out_swing_y, float *out_swing_z);
// From the solver's axes to the definition's: X to axis X + shift
fe_quat fe__joint_shift(int32_t shift);

// ---- joint state ----------------------------------------------------------------------------------------------------
// Frames, coordinates, speeds and errors of joints, computed from the bodies' poses and velocities as they are.

fe_transform fe__joint_frame_now(const fe_world *world, int32_t joint,
                                 int32_t side); // side 0: A's, 1: B's; world space
void fe__joint_state_of(const fe_world *world, int32_t joint, fe_joint_state *out_state);

#endif
