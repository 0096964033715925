// joint_def.c - see joint_def.h.
#include "api/joint_def.h"
#include "world/joint_drive.h"
#include "world/joint_record.h"

// The least half angle of a cone, rad: a narrower one is a hinge, whose cone's slope a float cannot hold
#define LEAST_CONE 0.01f
#define NO_CAP FE_MAX_FORCE

// ---- defaults ------------------------------------------------------------------------------------------------------
static void default_axes(fe_joint_axis *axes)
{
    for (int k = 0; k < 6; ++k)
        axes[k] = (fe_joint_axis){.motion = FE_MOTION_LOCKED, .limit_damping_ratio = 1.0f, .spring_max = NO_CAP};
}

static const fe__fields *const fields[FE__JOINT_TYPES] = {NULL,
                                                          &fe__fields_of_fe_distance_joint_def,
                                                          &fe__fields_of_fe_ball_joint_def,
                                                          &fe__fields_of_fe_hinge_joint_def,
                                                          &fe__fields_of_fe_fixed_joint_def,
                                                          &fe__fields_of_fe_configurable_joint_def};

const fe__fields *fe__joint_fields(int32_t type) { return fields[type]; }

static fe_result find_end(const char *function, const char *name, const fe_world *world, fe_body body,
                          int32_t *out_body)
{
    if (body == 0) {
        *out_body = -1;
        return FE_OK;
    }
    return fe__find_body(function, name, world, body, out_body);
}

fe_result fe__find_joint_ends(const char *function, const fe_world *world, fe_body body_a, fe_body body_b,
                              int32_t *out_bodies)
{
    FE_TRY(find_end(function, "body_a", world, body_a, &out_bodies[0]));
    FE_TRY(find_end(function, "body_b", world, body_b, &out_bodies[1]));
    if (out_bodies[0] != out_bodies[1]) return FE_OK;
    if (body_a == 0)
        return fe__fail(function, FE_ERROR_ARGUMENT, "body_a and body_b are both 0: one end must be a body");
    return fe__fail(function, FE_ERROR_ARGUMENT, "both ends are body 0x%llx", body_a);
}

void fe_joint_def_init(fe_joint_def *def, uint32_t struct_size)
{
    fe__joint_any defaults;
    fe__joint_defaults(FE_JOINT_FIXED, &defaults);
    defaults.common.struct_size = FE__JOINT_FRONT;
    fe__init_struct(def, &defaults, FE__JOINT_FRONT, struct_size);
}

void fe__joint_defaults(int32_t type, fe__joint_any *out_def)
{
    *out_def = (fe__joint_any){0};
    out_def->common = (fe_joint_def){.struct_size = (uint32_t)fe__joint_def_size(type),
                                     .enabled = 1,
                                     .frame_a.rotation.w = 1.0f,
                                     .frame_b.rotation.w = 1.0f,
                                     .damping_ratio = 1.0f};
    switch (type) {
    case FE_JOINT_DISTANCE:
        out_def->distance.limit_enabled = 1;
        out_def->distance.lower = out_def->distance.upper = out_def->distance.target = 1.0f;
        out_def->distance.spring_damping_ratio = 1.0f;
        out_def->distance.spring_max = NO_CAP;
        break;
    case FE_JOINT_BALL:
        out_def->ball.cone_y = out_def->ball.cone_z = out_def->ball.upper = FE_PI;
        out_def->ball.lower = -FE_PI;
        out_def->ball.limit_damping_ratio = out_def->ball.spring_damping_ratio = out_def->ball.target.w = 1.0f;
        out_def->ball.spring_max = NO_CAP;
        break;
    case FE_JOINT_HINGE:
        out_def->hinge.lower = -FE_PI;
        out_def->hinge.upper = FE_PI;
        out_def->hinge.limit_damping_ratio = out_def->hinge.spring_damping_ratio = 1.0f;
        out_def->hinge.spring_max = NO_CAP;
        break;
    case FE_JOINT_FIXED:
        out_def->fixed.angular_damping_ratio = 1.0f;
        break;
    default:
        default_axes(out_def->configurable.axes);
        break;
    }
}

static void init(int32_t type, void *def, uint32_t struct_size)
{
    fe__joint_any defaults;
    fe__joint_defaults(type, &defaults);
    fe__init_struct(def, &defaults, defaults.common.struct_size, struct_size);
}

void fe_distance_joint_def_init(fe_distance_joint_def *def, uint32_t struct_size)
{
    init(FE_JOINT_DISTANCE, def, struct_size);
}
void fe_ball_joint_def_init(fe_ball_joint_def *def, uint32_t struct_size) { init(FE_JOINT_BALL, def, struct_size); }
void fe_hinge_joint_def_init(fe_hinge_joint_def *def, uint32_t struct_size) { init(FE_JOINT_HINGE, def, struct_size); }
void fe_fixed_joint_def_init(fe_fixed_joint_def *def, uint32_t struct_size) { init(FE_JOINT_FIXED, def, struct_size); }
void fe_configurable_joint_def_init(fe_configurable_joint_def *def, uint32_t struct_size)
{
    init(FE_JOINT_CONFIGURABLE, def, struct_size);
}

// ---- checks --------------------------------------------------------------------------------------------------------
#define FE_CHECK_SOFTNESS(hertz, damping_ratio)            \
    do {                                                   \
        FE_CHECK_FLOAT(hertz, 0.0f, FE_MAX_VALUE);         \
        FE_CHECK_FLOAT(damping_ratio, 0.0f, FE_MAX_VALUE); \
    } while (0)
#define FE_CHECK_CAP(value) FE_CHECK_FLOAT(value, 0.0f, FE_MAX_FORCE)
#define FE_CHECK_ANGLE(value) FE_CHECK_FLOAT(value, -FE_PI, FE_PI)

static fe_result check_target(const char *function, const char *name, const char *part, int32_t type, int32_t dof,
                              float target)
{
    float least, most;
    fe__joint_target_range(type, dof, &least, &most);
    return fe__check_number(function, name, part, (double)target, (double)least, (double)most);
}

fe_result fe__check_joint_common(const char *function, const fe_joint_def *full)
{
    FE_CHECK_BOOL(full->enabled);
    FE_CHECK_VEC3(&full->frame_a.position, FE_MAX_LOCAL);
    FE_CHECK_QUAT(&full->frame_a.rotation);
    FE_CHECK_VEC3(&full->frame_b.position, FE_MAX_LOCAL);
    FE_CHECK_QUAT(&full->frame_b.rotation);
    FE_CHECK_BOOL(full->collide_connected);
    FE_CHECK_SOFTNESS(full->hertz, full->damping_ratio);
    FE_CHECK_CAP(full->break_force);
    FE_CHECK_CAP(full->break_torque);
    FE_CHECK_DVEC3(&full->world_origin, FE_MAX_POSITION);
    FE_CHECK_INT(full->reserved, 0, 0);
    return FE_OK;
}

static fe_result check_distance(const char *function, const fe_distance_joint_def *full)
{
    FE_CHECK_BOOL(full->limit_enabled);
    FE_CHECK_FLOAT(full->upper, FE_LEAST_LENGTH, FE_MAX_LOCAL);
    FE_CHECK_FLOAT(full->lower, 0.0f, full->upper);
    FE_TRY(check_target(function, "full->target", "", FE_JOINT_DISTANCE, FE_DOF_LINEAR_X, full->target));
    FE_CHECK_SOFTNESS(full->spring_hertz, full->spring_damping_ratio);
    FE_CHECK_CAP(full->spring_max);
    FE_CHECK_FLOAT(full->motor_speed, -FE_MAX_SPEED, FE_MAX_SPEED);
    FE_CHECK_CAP(full->motor_max);
    FE_CHECK_INT(full->reserved_end, 0, 0);
    return FE_OK;
}

static fe_result check_ball(const char *function, const fe_ball_joint_def *full)
{
    FE_CHECK_BOOL(full->cone_enabled);
    FE_CHECK_FLOAT(full->cone_y, LEAST_CONE, FE_PI);
    FE_CHECK_FLOAT(full->cone_z, LEAST_CONE, FE_PI);
    FE_CHECK_BOOL(full->limit_enabled);
    FE_CHECK_ANGLE(full->upper);
    FE_CHECK_FLOAT(full->lower, -FE_PI, full->upper);
    FE_CHECK_SOFTNESS(full->limit_hertz, full->limit_damping_ratio);
    FE_CHECK_SOFTNESS(full->spring_hertz, full->spring_damping_ratio);
    FE_CHECK_CAP(full->spring_max);
    FE_CHECK_QUAT(&full->target);
    FE_CHECK_VEC3(&full->motor_velocity, FE_MAX_SPEED);
    FE_CHECK_CAP(full->motor_max);
    FE_CHECK_INT(full->reserved_end, 0, 0);
    return FE_OK;
}

static fe_result check_hinge(const char *function, const fe_hinge_joint_def *full)
{
    FE_CHECK_BOOL(full->limit_enabled);
    FE_CHECK_ANGLE(full->upper);
    FE_CHECK_FLOAT(full->lower, -FE_PI, full->upper);
    FE_CHECK_SOFTNESS(full->limit_hertz, full->limit_damping_ratio);
    FE_CHECK_SOFTNESS(full->spring_hertz, full->spring_damping_ratio);
    FE_CHECK_CAP(full->spring_max);
    FE_TRY(check_target(function, "full->target", "", FE_JOINT_HINGE, FE_DOF_ANGULAR_X, full->target));
    FE_CHECK_FLOAT(full->motor_speed, -FE_MAX_SPEED, FE_MAX_SPEED);
    FE_CHECK_CAP(full->motor_max);
    FE_CHECK_INT(full->reserved_end, 0, 0);
    return FE_OK;
}

static fe_result check_fixed(const char *function, const fe_fixed_joint_def *full)
{
    FE_CHECK_SOFTNESS(full->angular_hertz, full->angular_damping_ratio);
    return FE_OK;
}

static fe_result check_configurable(const char *function, const fe_configurable_joint_def *full)
{
    static const char *const names[6] = {"axes[FE_DOF_LINEAR_X]",  "axes[FE_DOF_LINEAR_Y]",  "axes[FE_DOF_LINEAR_Z]",
                                         "axes[FE_DOF_ANGULAR_X]", "axes[FE_DOF_ANGULAR_Y]", "axes[FE_DOF_ANGULAR_Z]"};
#define CHECK(field, low, high) \
    FE_TRY(fe__check_number(function, names[k], "." #field, (double)axis->field, (double)(low), (double)(high)))
    for (int k = 0; k < 6; ++k) {
        const fe_joint_axis *axis = &full->axes[k];
        float reach = k < FE_DOF_ANGULAR_X ? FE_MAX_LOCAL : FE_PI;
        CHECK(motion, FE_MOTION_LOCKED, FE_MOTION_FREE);
        CHECK(upper, -reach, reach);
        CHECK(lower, -reach, axis->upper);
        CHECK(limit_hertz, 0.0f, FE_MAX_VALUE);
        CHECK(limit_damping_ratio, 0.0f, FE_MAX_VALUE);
        CHECK(spring, FE_SPRING_NONE, FE_SPRING_STIFFNESS);
        FE_TRY(check_target(function, names[k], ".target", FE_JOINT_CONFIGURABLE, k, axis->target));
        CHECK(spring_hertz, 0.0f, FE_MAX_VALUE);
        CHECK(spring_damping_ratio, 0.0f, FE_MAX_VALUE);
        CHECK(spring_stiffness, 0.0f, FE_MAX_FORCE);
        CHECK(spring_damping, 0.0f, FE_MAX_FORCE);
        CHECK(spring_max, 0.0f, FE_MAX_FORCE);
        CHECK(motor_speed, -FE_MAX_SPEED, FE_MAX_SPEED);
        CHECK(motor_max, 0.0f, FE_MAX_FORCE);
        CHECK(reserved[0], 0, 0);
        CHECK(reserved[1], 0, 0);
    }
#undef CHECK
    return FE_OK;
}

fe_result fe__check_joint_def(const char *function, int32_t type, const fe__joint_any *full)
{
    FE_TRY(fe__check_joint_common(function, &full->common));
    switch (type) {
    case FE_JOINT_DISTANCE:
        return check_distance(function, &full->distance);
    case FE_JOINT_BALL:
        return check_ball(function, &full->ball);
    case FE_JOINT_HINGE:
        return check_hinge(function, &full->hinge);
    case FE_JOINT_FIXED:
        return check_fixed(function, &full->fixed);
    default:
        return check_configurable(function, &full->configurable);
    }
}
