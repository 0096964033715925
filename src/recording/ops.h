// ops.h - the calls that change a world, as recordings number them. A number is never given again.
//
// Made by tools/ops from include/feather.h; not to be edited.
#ifndef FE_RECORDING_OPS_H
#define FE_RECORDING_OPS_H
#include "recording/recorder.h"

enum {
    FE__OP_WORLD_SET_GRAVITY = 16,
    FE__OP_WORLD_SET_SUBSTEPS = 17,
    FE__OP_WORLD_SET_USER_DATA = 18,
    FE__OP_WORLD_SET_TUNING = 19,
    FE__OP_WORLD_IGNORE_COLLISION = 20,
    FE__OP_WORLD_OPTIMIZE = 21,
    FE__OP_BODY_CREATE = 22,
    FE__OP_BODY_CREATE_MANY = 23,
    FE__OP_BODY_DESTROY = 24,
    FE__OP_BODY_DESTROY_MANY = 25,
    FE__OP_BODY_SET_TYPE = 26,
    FE__OP_BODY_SET_TRANSFORM = 27,
    FE__OP_BODY_SET_LINEAR_VELOCITY = 28,
    FE__OP_BODY_SET_ANGULAR_VELOCITY = 29,
    FE__OP_BODY_SET_TARGET = 30,
    FE__OP_BODY_ADD_FORCE = 31,
    FE__OP_BODY_ADD_FORCE_AT = 32,
    FE__OP_BODY_ADD_TORQUE = 33,
    FE__OP_BODY_ADD_IMPULSE = 34,
    FE__OP_BODY_ADD_IMPULSE_AT = 35,
    FE__OP_BODY_ADD_ANGULAR_IMPULSE = 36,
    FE__OP_BODY_SET_MASS_DATA = 37,
    FE__OP_BODY_SET_MASS = 38,
    FE__OP_BODY_RESET_MASS = 39,
    FE__OP_BODY_SET_LOCKS = 40,
    FE__OP_BODY_SET_DAMPING = 41,
    FE__OP_BODY_SET_GRAVITY_SCALE = 42,
    FE__OP_BODY_SET_AWAKE = 43,
    FE__OP_BODY_SET_SLEEP_ALLOWED = 44,
    FE__OP_BODY_SET_SLEEP_THRESHOLD = 45,
    FE__OP_BODY_SET_ENABLED = 46,
    FE__OP_BODY_SET_BULLET = 47,
    FE__OP_BODY_SET_USER_DATA = 48,
    FE__OP_BODY_SET_FILTER = 49,
    FE__OP_SHAPE_CREATE = 50,
    FE__OP_SHAPE_DESTROY = 51,
    FE__OP_SHAPE_SET_GEOMETRY = 52,
    FE__OP_SHAPE_SET_FRAME = 53,
    FE__OP_SHAPE_SET_DENSITY = 54,
    FE__OP_SHAPE_SET_MATERIAL = 55,
    FE__OP_SHAPE_SET_FILTER = 56,
    FE__OP_SHAPE_SET_PAIR_FILTER = 57,
    FE__OP_SHAPE_SET_ONE_WAY = 58,
    FE__OP_SHAPE_SET_TRIGGER = 59,
    FE__OP_SHAPE_SET_EVENTS = 60,
    FE__OP_SHAPE_SET_SURFACE_VELOCITY = 61,
    FE__OP_SHAPE_SET_USER_DATA = 62,
    FE__OP_DISTANCE_JOINT_CREATE = 63,
    FE__OP_BALL_JOINT_CREATE = 64,
    FE__OP_HINGE_JOINT_CREATE = 65,
    FE__OP_FIXED_JOINT_CREATE = 66,
    FE__OP_CONFIGURABLE_JOINT_CREATE = 67,
    FE__OP_DISTANCE_JOINT_SET = 68,
    FE__OP_BALL_JOINT_SET = 69,
    FE__OP_HINGE_JOINT_SET = 70,
    FE__OP_FIXED_JOINT_SET = 71,
    FE__OP_CONFIGURABLE_JOINT_SET = 72,
    FE__OP_JOINT_DESTROY = 73,
    FE__OP_JOINT_SET = 74,
    FE__OP_JOINT_SET_ENABLED = 75,
    FE__OP_JOINT_SET_MOTOR_SPEED = 76,
    FE__OP_JOINT_SET_TARGET = 77,
    FE__OP_BALL_JOINT_SET_TARGET = 78,
    FE__OP_JOINT_SET_USER_DATA = 79,
    FE__OP_WORLD_SET_TRANSFORMS = 80,
    FE__OP_WORLD_SET_VELOCITIES = 81,
    FE__OP_WORLD_ADD_FORCES = 82,
    FE__OP_WORLD_SET_JOINT_TARGETS = 83,
    FE__OP_WORLD_SET_JOINT_MOTOR_SPEEDS = 84,
    FE__OP_WORLD_ADD_JOINT_FORCES = 85,
};

void fe__record_world_set_gravity(fe_recorder *recorder, const fe_vec3 *gravity);
void fe__record_world_set_substeps(fe_recorder *recorder, int32_t substeps);
void fe__record_world_set_user_data(fe_recorder *recorder, uint64_t user_data);
void fe__record_world_set_tuning(fe_recorder *recorder, const fe_world_tuning *tuning);
void fe__record_world_ignore_collision(fe_recorder *recorder, fe_body a, fe_body b, int32_t ignore);
void fe__record_world_optimize(fe_recorder *recorder);
void fe__record_body_create(fe_recorder *recorder, const fe_body_def *def, const fe_body *out_body);
void fe__record_body_create_many(fe_recorder *recorder, const fe_body_def *defs, uint32_t stride, int32_t count,
                                 const fe_body *out_bodies);
void fe__record_body_destroy(fe_recorder *recorder, fe_body body);
void fe__record_body_destroy_many(fe_recorder *recorder, const fe_body *bodies, int32_t count);
void fe__record_body_set_type(fe_recorder *recorder, fe_body body, int32_t type);
void fe__record_body_set_transform(fe_recorder *recorder, fe_body body, const fe_transform *transform);
void fe__record_body_set_linear_velocity(fe_recorder *recorder, fe_body body, const fe_vec3 *velocity);
void fe__record_body_set_angular_velocity(fe_recorder *recorder, fe_body body, const fe_vec3 *velocity);
void fe__record_body_set_target(fe_recorder *recorder, fe_body body, const fe_transform *target, float seconds);
void fe__record_body_add_force(fe_recorder *recorder, fe_body body, const fe_vec3 *force);
void fe__record_body_add_force_at(fe_recorder *recorder, fe_body body, const fe_vec3 *force, const fe_dvec3 *point);
void fe__record_body_add_torque(fe_recorder *recorder, fe_body body, const fe_vec3 *torque);
void fe__record_body_add_impulse(fe_recorder *recorder, fe_body body, const fe_vec3 *impulse);
void fe__record_body_add_impulse_at(fe_recorder *recorder, fe_body body, const fe_vec3 *impulse, const fe_dvec3 *point);
void fe__record_body_add_angular_impulse(fe_recorder *recorder, fe_body body, const fe_vec3 *impulse);
void fe__record_body_set_mass_data(fe_recorder *recorder, fe_body body, const fe_mass_data *data);
void fe__record_body_set_mass(fe_recorder *recorder, fe_body body, float mass);
void fe__record_body_reset_mass(fe_recorder *recorder, fe_body body);
void fe__record_body_set_locks(fe_recorder *recorder, fe_body body, uint32_t linear_axes, uint32_t angular_axes);
void fe__record_body_set_damping(fe_recorder *recorder, fe_body body, float linear, float angular);
void fe__record_body_set_gravity_scale(fe_recorder *recorder, fe_body body, float scale);
void fe__record_body_set_awake(fe_recorder *recorder, fe_body body, int32_t awake);
void fe__record_body_set_sleep_allowed(fe_recorder *recorder, fe_body body, int32_t allowed);
void fe__record_body_set_sleep_threshold(fe_recorder *recorder, fe_body body, float speed);
void fe__record_body_set_enabled(fe_recorder *recorder, fe_body body, int32_t enabled);
void fe__record_body_set_bullet(fe_recorder *recorder, fe_body body, int32_t bullet);
void fe__record_body_set_user_data(fe_recorder *recorder, fe_body body, uint64_t user_data);
void fe__record_body_set_filter(fe_recorder *recorder, fe_body body, uint32_t layer, uint32_t mask, int32_t group);
void fe__record_shape_create(fe_recorder *recorder, fe_body body, const fe_shape_def *def, const fe_geometry *geometry,
                             const fe_shape *out_shape);
void fe__record_shape_destroy(fe_recorder *recorder, fe_shape shape);
void fe__record_shape_set_geometry(fe_recorder *recorder, fe_shape shape, const fe_geometry *geometry);
void fe__record_shape_set_frame(fe_recorder *recorder, fe_shape shape, const fe_frame *frame);
void fe__record_shape_set_density(fe_recorder *recorder, fe_shape shape, float density);
void fe__record_shape_set_material(fe_recorder *recorder, fe_shape shape, const fe_material *material);
void fe__record_shape_set_filter(fe_recorder *recorder, fe_shape shape, uint32_t layer, uint32_t mask, int32_t group);
void fe__record_shape_set_pair_filter(fe_recorder *recorder, fe_shape shape, int32_t enabled);
void fe__record_shape_set_one_way(fe_recorder *recorder, fe_shape shape, int32_t enabled, const fe_vec3 *direction);
void fe__record_shape_set_trigger(fe_recorder *recorder, fe_shape shape, int32_t trigger);
void fe__record_shape_set_events(fe_recorder *recorder, fe_shape shape, uint32_t events);
void fe__record_shape_set_surface_velocity(fe_recorder *recorder, fe_shape shape, const fe_vec3 *velocity);
void fe__record_shape_set_user_data(fe_recorder *recorder, fe_shape shape, uint64_t user_data);
void fe__record_distance_joint_create(fe_recorder *recorder, const fe_distance_joint_def *def,
                                      const fe_joint *out_joint);
void fe__record_ball_joint_create(fe_recorder *recorder, const fe_ball_joint_def *def, const fe_joint *out_joint);
void fe__record_hinge_joint_create(fe_recorder *recorder, const fe_hinge_joint_def *def, const fe_joint *out_joint);
void fe__record_fixed_joint_create(fe_recorder *recorder, const fe_fixed_joint_def *def, const fe_joint *out_joint);
void fe__record_configurable_joint_create(fe_recorder *recorder, const fe_configurable_joint_def *def,
                                          const fe_joint *out_joint);
void fe__record_distance_joint_set(fe_recorder *recorder, fe_joint joint, const fe_distance_joint_def *def);
void fe__record_ball_joint_set(fe_recorder *recorder, fe_joint joint, const fe_ball_joint_def *def);
void fe__record_hinge_joint_set(fe_recorder *recorder, fe_joint joint, const fe_hinge_joint_def *def);
void fe__record_fixed_joint_set(fe_recorder *recorder, fe_joint joint, const fe_fixed_joint_def *def);
void fe__record_configurable_joint_set(fe_recorder *recorder, fe_joint joint, const fe_configurable_joint_def *def);
void fe__record_joint_destroy(fe_recorder *recorder, fe_joint joint);
void fe__record_joint_set(fe_recorder *recorder, fe_joint joint, const fe_joint_def *def);
void fe__record_joint_set_enabled(fe_recorder *recorder, fe_joint joint, int32_t enabled);
void fe__record_joint_set_motor_speed(fe_recorder *recorder, fe_joint joint, int32_t dof, float speed);
void fe__record_joint_set_target(fe_recorder *recorder, fe_joint joint, int32_t dof, float target);
void fe__record_ball_joint_set_target(fe_recorder *recorder, fe_joint joint, const fe_quat *target);
void fe__record_joint_set_user_data(fe_recorder *recorder, fe_joint joint, uint64_t user_data);
void fe__record_world_set_transforms(fe_recorder *recorder, const fe_body *bodies, const fe_transform *transforms,
                                     uint32_t stride, int32_t count);
void fe__record_world_set_velocities(fe_recorder *recorder, const fe_body *bodies, const float *floats, uint32_t stride,
                                     int32_t count);
void fe__record_world_add_forces(fe_recorder *recorder, const fe_body *bodies, const float *floats, uint32_t stride,
                                 int32_t count);
void fe__record_world_set_joint_targets(fe_recorder *recorder, const fe_joint *joints, const float *values,
                                        uint32_t stride, int32_t count);
void fe__record_world_set_joint_motor_speeds(fe_recorder *recorder, const fe_joint *joints, const float *values,
                                             uint32_t stride, int32_t count);
void fe__record_world_add_joint_forces(fe_recorder *recorder, const fe_joint *joints, const float *values,
                                       uint32_t stride, int32_t count);

#endif
