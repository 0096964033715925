// joint_drive.h - where a joint's definition has what drives it along a degree of freedom (fe_dof).
#ifndef FE_WORLD_JOINT_DRIVE_H
#define FE_WORLD_JOINT_DRIVE_H
#include "world/world.h"

// The motor's speed, the spring's target; NULL: the joint has none there
float *fe__joint_motor_speed(fe__joint_any *def, int32_t type, int32_t dof);
float *fe__joint_target(fe__joint_any *def, int32_t type, int32_t dof);
// What a target may be there, m or rad: as the joint's definition may have it
void fe__joint_target_range(int32_t type, int32_t dof, float *out_least, float *out_most);
// The degree of freedom of a joint that has one, or the first of several; -1: of a ball, or none
int32_t fe__joint_free_dof(const fe__joint_any *def, int32_t type);

#endif
