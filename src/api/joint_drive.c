// joint_drive.c - the API of what a game changes each step: speed of a motor, target of a spring, nothing else.
#include "api/joint_def.h"
#include "api/record.h"
#include "world/joint_drive.h"
#include "world/joints.h"

typedef float *(*field_of)(fe__joint_any *def, int32_t type, int32_t dof);

static fe_result set(const char *function, fe_world *world, fe_joint joint, int32_t dof, field_of find,
                     const char *name, float value)
{
    FE_FIND_JOINT(index, joint);
    FE_CHECK_INT(dof, FE_DOF_LINEAR_X, FE_DOF_ANGULAR_Z);
    FE_TRY(fe__check_number(function, name, "", (double)value, (double)-FE_MAX_SPEED, (double)FE_MAX_SPEED));
    fe__joint_any full;
    fe__joint_describe(world, index, &full);
    int32_t type = world->joint_records[index].type;
    float *field = find(&full, type, dof);
    if (!field)
        return fe__fail(function, FE_ERROR_STATE, "joint 0x%llx has no %s about or along dof %d", joint, name,
                        (int)dof);
    if (*field == value) return FE_OK;
    *field = value;
    FE_TRY(fe__check_joint_def(function, type, &full));
    return fe__change_joint(function, world, index, &full);
}

fe_result fe_joint_set_motor_speed(fe_world *world, fe_joint joint, int32_t dof, float speed)
{
    FE_WRITE(world);
    FE_TRY(set(function, world, joint, dof, fe__joint_motor_speed, "speed", speed));
    FE_RECORD(joint_set_motor_speed, joint, dof, speed);
    return FE_OK;
}

fe_result fe_joint_set_target(fe_world *world, fe_joint joint, int32_t dof, float target)
{
    FE_WRITE(world);
    FE_TRY(set(function, world, joint, dof, fe__joint_target, "target", target));
    FE_RECORD(joint_set_target, joint, dof, target);
    return FE_OK;
}

fe_result fe_ball_joint_set_target(fe_world *world, fe_joint joint, const fe_quat *target)
{
    FE_WRITE(world);
    FE_FIND_JOINT(index, joint);
    FE_CHECK_QUAT(target);
    if (world->joint_records[index].type != FE_JOINT_BALL) {
        return fe__fail(function, FE_ERROR_STATE, "joint 0x%llx is no ball joint", joint);
    }
    fe__joint_any full;
    fe__joint_describe(world, index, &full);
    full.ball.target = *target;
    FE_TRY(fe__change_joint(function, world, index, &full));
    FE_RECORD(ball_joint_set_target, joint, target);
    return FE_OK;
}
