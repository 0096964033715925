// joint_drive.c - see joint_drive.h.
#include "world/joint_drive.h"

#include "core/ranges.h"

float *fe__joint_motor_speed(fe__joint_any *def, int32_t type, int32_t dof)
{
    switch (type) {
    case FE_JOINT_DISTANCE:
        return dof == FE_DOF_LINEAR_X ? &def->distance.motor_speed : NULL;
    case FE_JOINT_BALL: {
        float *velocity[3] = {&def->ball.motor_velocity.x, &def->ball.motor_velocity.y, &def->ball.motor_velocity.z};
        return dof >= FE_DOF_ANGULAR_X ? velocity[dof - FE_DOF_ANGULAR_X] : NULL;
    }
    case FE_JOINT_HINGE:
        return dof == FE_DOF_ANGULAR_X ? &def->hinge.motor_speed : NULL;
    case FE_JOINT_CONFIGURABLE:
        return &def->configurable.axes[dof].motor_speed;
    default:
        return NULL;
    }
}

float *fe__joint_target(fe__joint_any *def, int32_t type, int32_t dof)
{
    switch (type) {
    case FE_JOINT_DISTANCE:
        return dof == FE_DOF_LINEAR_X ? &def->distance.target : NULL;
    case FE_JOINT_HINGE:
        return dof == FE_DOF_ANGULAR_X ? &def->hinge.target : NULL;
    case FE_JOINT_CONFIGURABLE:
        return &def->configurable.axes[dof].target;
    default:
        return NULL;
    }
}

void fe__joint_target_range(int32_t type, int32_t dof, float *out_least, float *out_most)
{
    *out_most = dof < FE_DOF_ANGULAR_X ? FE_MAX_LOCAL : FE_PI;
    *out_least = type == FE_JOINT_DISTANCE ? 0.0f : -*out_most;
}

int32_t fe__joint_free_dof(const fe__joint_any *def, int32_t type)
{
    if (type == FE_JOINT_DISTANCE) return FE_DOF_LINEAR_X;
    if (type == FE_JOINT_HINGE) return FE_DOF_ANGULAR_X;
    if (type != FE_JOINT_CONFIGURABLE) return -1;
    for (int32_t dof = FE_DOF_LINEAR_X; dof <= FE_DOF_ANGULAR_Z; ++dof)
        if (def->configurable.axes[dof].motion != FE_MOTION_LOCKED) return dof;
    return -1;
}
