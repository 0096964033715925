// joint_def.c - see joint_def.h.
#include "api/joint_def.h"
#include "world/joint_record.h"

// The least half angle of a cone, rad: a narrower one is a hinge, whose cone's slope a float cannot hold
#define LEAST_CONE 0.01f
#define NO_CAP FE_MAX_FORCE

// ---- defaults -------------------------------------------------------------------------------------------------------------------------
static void default_axes(fe_joint_axis *axes)
{
    for (int k = 0; k < 6; ++k) axes[k] = (fe_joint_axis){.mode = FE_MOTION_LOCKED, .limit_damping_ratio = 1.0f, .drive_force = NO_CAP};
}

void fe__joint_defaults(int32_t type, fe__joint_any *out_desc)
{
    *out_desc = (fe__joint_any){0};
    out_desc->common = (fe_joint_def){.struct_size = (uint32_t)fe__joint_def_size(type),
                                      .enabled = 1,
                                      .frame_a.rotation.w = 1.0f,
                                      .frame_b.rotation.w = 1.0f,
                                      .damping_ratio = 1.0f};
    switch (type) {
    case FE_JOINT_DISTANCE:
        out_desc->distance.min_length = out_desc->distance.max_length = out_desc->distance.length = 1.0f;
        out_desc->distance.spring_damping_ratio = 1.0f;
        out_desc->distance.spring_force = NO_CAP;
        break;
    case FE_JOINT_BALL:
        out_desc->ball.cone_y = out_desc->ball.cone_z = out_desc->ball.max_twist = FE_PI;
        out_desc->ball.min_twist = -FE_PI;
        out_desc->ball.limit_damping_ratio = out_desc->ball.drive_damping_ratio = out_desc->ball.target.w = 1.0f;
        out_desc->ball.drive_torque = NO_CAP;
        break;
    case FE_JOINT_HINGE:
        out_desc->hinge.min_angle = -FE_PI;
        out_desc->hinge.max_angle = FE_PI;
        out_desc->hinge.limit_damping_ratio = out_desc->hinge.spring_damping_ratio = 1.0f;
        out_desc->hinge.spring_torque = NO_CAP;
        break;
    case FE_JOINT_FIXED:
        out_desc->fixed.angular_damping_ratio = 1.0f;
        break;
    default:
        default_axes(out_desc->configurable.axes);
        break;
    }
}

static void init(int32_t type, void *desc, uint32_t struct_size)
{
    fe__joint_any defaults;
    fe__joint_defaults(type, &defaults);
    fe__init_struct(desc, &defaults, defaults.common.struct_size, struct_size);
}

void fe_distance_def_init(fe_distance_def *desc, uint32_t struct_size) { init(FE_JOINT_DISTANCE, desc, struct_size); }
void fe_ball_def_init(fe_ball_def *desc, uint32_t struct_size) { init(FE_JOINT_BALL, desc, struct_size); }
void fe_hinge_def_init(fe_hinge_def *desc, uint32_t struct_size) { init(FE_JOINT_HINGE, desc, struct_size); }
void fe_fixed_def_init(fe_fixed_def *desc, uint32_t struct_size) { init(FE_JOINT_FIXED, desc, struct_size); }
void fe_configurable_def_init(fe_configurable_def *desc, uint32_t struct_size) { init(FE_JOINT_CONFIGURABLE, desc, struct_size); }

// ---- checks ---------------------------------------------------------------------------------------------------------------------------
#define FE_CHECK_SOFTNESS(hertz, damping_ratio)            \
    do {                                                   \
        FE_CHECK_FLOAT(hertz, 0.0f, FE_MAX_VALUE);         \
        FE_CHECK_FLOAT(damping_ratio, 0.0f, FE_MAX_VALUE); \
    } while (0)
#define FE_CHECK_CAP(value) FE_CHECK_FLOAT(value, 0.0f, FE_MAX_FORCE)
#define FE_CHECK_ANGLE(value) FE_CHECK_FLOAT(value, -FE_PI, FE_PI)

fe_result fe__check_joint_common(const char *function, const fe_joint_def *def)
{
    FE_CHECK_BOOL(def->enabled);
    FE_CHECK_VEC3(&def->frame_a.position, FE_MAX_LOCAL);
    FE_CHECK_QUAT(&def->frame_a.rotation);
    FE_CHECK_VEC3(&def->frame_b.position, FE_MAX_LOCAL);
    FE_CHECK_QUAT(&def->frame_b.rotation);
    FE_CHECK_BOOL(def->collide_connected);
    FE_CHECK_SOFTNESS(def->hertz, def->damping_ratio);
    FE_CHECK_CAP(def->break_force);
    FE_CHECK_CAP(def->break_torque);
    FE_CHECK_INT(def->reserved, 0, 0);
    return FE_OK;
}

static fe_result check_distance(const char *function, const fe_distance_def *def)
{
    FE_CHECK_FLOAT(def->max_length, FE_LEAST_LENGTH, FE_MAX_LOCAL);
    FE_CHECK_FLOAT(def->min_length, 0.0f, def->max_length);
    FE_CHECK_FLOAT(def->length, 0.0f, FE_MAX_LOCAL);
    FE_CHECK_SOFTNESS(def->spring_hertz, def->spring_damping_ratio);
    FE_CHECK_CAP(def->spring_force);
    FE_CHECK_FLOAT(def->motor_speed, -FE_MAX_SPEED, FE_MAX_SPEED);
    FE_CHECK_CAP(def->motor_force);
    return FE_OK;
}

static fe_result check_ball(const char *function, const fe_ball_def *def)
{
    FE_CHECK_BOOL(def->swing_limited);
    FE_CHECK_FLOAT(def->cone_y, LEAST_CONE, FE_PI);
    FE_CHECK_FLOAT(def->cone_z, LEAST_CONE, FE_PI);
    FE_CHECK_BOOL(def->twist_limited);
    FE_CHECK_ANGLE(def->max_twist);
    FE_CHECK_FLOAT(def->min_twist, -FE_PI, def->max_twist);
    FE_CHECK_SOFTNESS(def->limit_hertz, def->limit_damping_ratio);
    FE_CHECK_SOFTNESS(def->drive_hertz, def->drive_damping_ratio);
    FE_CHECK_CAP(def->drive_torque);
    FE_CHECK_QUAT(&def->target);
    FE_CHECK_VEC3(&def->motor_velocity, FE_MAX_SPEED);
    FE_CHECK_CAP(def->motor_torque);
    FE_CHECK_INT(def->reserved_end, 0, 0);
    return FE_OK;
}

static fe_result check_hinge(const char *function, const fe_hinge_def *def)
{
    FE_CHECK_BOOL(def->limited);
    FE_CHECK_ANGLE(def->max_angle);
    FE_CHECK_FLOAT(def->min_angle, -FE_PI, def->max_angle);
    FE_CHECK_SOFTNESS(def->limit_hertz, def->limit_damping_ratio);
    FE_CHECK_SOFTNESS(def->spring_hertz, def->spring_damping_ratio);
    FE_CHECK_CAP(def->spring_torque);
    FE_CHECK_ANGLE(def->target);
    FE_CHECK_FLOAT(def->motor_speed, -FE_MAX_SPEED, FE_MAX_SPEED);
    FE_CHECK_CAP(def->motor_torque);
    FE_CHECK_INT(def->reserved_end, 0, 0);
    return FE_OK;
}

static fe_result check_fixed(const char *function, const fe_fixed_def *def)
{
    FE_CHECK_SOFTNESS(def->angular_hertz, def->angular_damping_ratio);
    return FE_OK;
}

static fe_result check_configurable(const char *function, const fe_configurable_def *def)
{
    static const char *const names[6] = {"axes[FE_ALONG_X]", "axes[FE_ALONG_Y]", "axes[FE_ALONG_Z]",
                                         "axes[FE_ABOUT_X]", "axes[FE_ABOUT_Y]", "axes[FE_ABOUT_Z]"};
#define CHECK(field, low, high) FE_TRY(fe__check_number(function, names[k], "." #field, (double)axis->field, (double)(low), (double)(high)))
    for (int k = 0; k < 6; ++k) {
        const fe_joint_axis *axis = &def->axes[k];
        float reach = k < FE_ABOUT_X ? FE_MAX_LOCAL : FE_PI;
        CHECK(mode, FE_MOTION_LOCKED, FE_MOTION_FREE);
        CHECK(high, -reach, reach);
        CHECK(low, -reach, axis->high);
        CHECK(limit_hertz, 0.0f, FE_MAX_VALUE);
        CHECK(limit_damping_ratio, 0.0f, FE_MAX_VALUE);
        CHECK(drive, FE_DRIVE_NONE, FE_DRIVE_STIFFNESS);
        CHECK(target, -reach, reach);
        CHECK(stiffness, 0.0f, axis->drive == FE_DRIVE_HERTZ ? FE_MAX_VALUE : FE_MAX_FORCE);
        CHECK(damping, 0.0f, axis->drive == FE_DRIVE_HERTZ ? FE_MAX_VALUE : FE_MAX_FORCE);
        CHECK(drive_force, 0.0f, FE_MAX_FORCE);
        CHECK(motor_speed, -FE_MAX_SPEED, FE_MAX_SPEED);
        CHECK(motor_force, 0.0f, FE_MAX_FORCE);
    }
#undef CHECK
    return FE_OK;
}

fe_result fe__check_joint_def(const char *function, int32_t type, const fe__joint_any *def)
{
    FE_TRY(fe__check_joint_common(function, &def->common));
    switch (type) {
    case FE_JOINT_DISTANCE:
        return check_distance(function, &def->distance);
    case FE_JOINT_BALL:
        return check_ball(function, &def->ball);
    case FE_JOINT_HINGE:
        return check_hinge(function, &def->hinge);
    case FE_JOINT_FIXED:
        return check_fixed(function, &def->fixed);
    default:
        return check_configurable(function, &def->configurable);
    }
}
