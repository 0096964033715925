// joint_state.h - how joints stand: frames, coordinates, speeds, errors.
//
// Read from the bodies' poses and velocities as they are, by the API.
#ifndef FE_WORLD_JOINT_STATE_H
#define FE_WORLD_JOINT_STATE_H
#include "world/world.h"

fe_transform fe__joint_frame_now(const fe_world *world, int32_t joint, int32_t side); // 0: A's, 1: B's; world space
void fe__joint_state_of(const fe_world *world, int32_t joint, fe_joint_state *out_state);

#endif
