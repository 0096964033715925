// ops.c - what is written of each call that changes a world.
//
// Made by tools/ops from include/feather.h; not to be edited.
#include "recording/ops.h"

#include "recording/recorder.h"
#include "recording/op_write.h"

static const fe__words words_of_fe_ball_joint_def[] = {{4, 2}, {8, 6}, {4, 40}, {0, 0}};
static const fe__words words_of_fe_body_def[] = {{4, 2}, {8, 3}, {4, 20}, {8, 1}, {0, 0}};
static const fe__words words_of_fe_configurable_joint_def[] = {{4, 2}, {8, 6}, {4, 116}, {0, 0}};
static const fe__words words_of_fe_distance_joint_def[] = {{4, 2}, {8, 6}, {4, 30}, {0, 0}};
static const fe__words words_of_fe_dvec3[] = {{8, 3}, {0, 0}};
static const fe__words words_of_fe_fixed_joint_def[] = {{4, 2}, {8, 6}, {4, 22}, {0, 0}};
static const fe__words words_of_fe_frame[] = {{4, 7}, {0, 0}};
static const fe__words words_of_fe_geometry[] = {{4, 16}, {8, 3}, {0, 0}};
static const fe__words words_of_fe_hinge_joint_def[] = {{4, 2}, {8, 6}, {4, 32}, {0, 0}};
static const fe__words words_of_fe_joint_def[] = {{4, 2}, {8, 6}, {4, 20}, {0, 0}};
static const fe__words words_of_fe_mass_data[] = {{4, 12}, {0, 0}};
static const fe__words words_of_fe_material[] = {{4, 10}, {8, 1}, {0, 0}};
static const fe__words words_of_fe_quat[] = {{4, 4}, {0, 0}};
static const fe__words words_of_fe_shape_def[] = {{4, 20}, {8, 1}, {4, 12}, {8, 1}, {0, 0}};
static const fe__words words_of_fe_transform[] = {{8, 3}, {4, 4}, {0, 0}};
static const fe__words words_of_fe_vec3[] = {{4, 3}, {0, 0}};
static const fe__words words_of_fe_world_tuning[] = {{4, 14}, {0, 0}};

void fe__record_world_set_gravity(fe_recorder *recorder, const fe_vec3 *gravity)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_WORLD_SET_GRAVITY, (int64_t)(FE__OP_STRUCT + sizeof *gravity));
    if (!at) return;
    at = fe__put_plain(at, gravity, sizeof *gravity, words_of_fe_vec3);
    fe__op_end(recorder, at);
}

void fe__record_world_set_substeps(fe_recorder *recorder, int32_t substeps)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_WORLD_SET_SUBSTEPS, (int64_t)(4));
    if (!at) return;
    at = fe__put_i32(at, substeps);
    fe__op_end(recorder, at);
}

void fe__record_world_set_user_data(fe_recorder *recorder, uint64_t user_data)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_WORLD_SET_USER_DATA, (int64_t)(8));
    if (!at) return;
    at = fe__put_u64(at, user_data);
    fe__op_end(recorder, at);
}

void fe__record_world_set_tuning(fe_recorder *recorder, const fe_world_tuning *tuning)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_WORLD_SET_TUNING, (int64_t)(FE__OP_STRUCT + sizeof *tuning));
    if (!at) return;
    at = fe__put_sized(at, tuning, sizeof *tuning, words_of_fe_world_tuning);
    fe__op_end(recorder, at);
}

void fe__record_world_ignore_collision(fe_recorder *recorder, fe_body a, fe_body b, int32_t ignore)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_WORLD_IGNORE_COLLISION, (int64_t)(8 + 8 + 4));
    if (!at) return;
    at = fe__put_u64(at, a);
    at = fe__put_u64(at, b);
    at = fe__put_i32(at, ignore);
    fe__op_end(recorder, at);
}

void fe__record_world_optimize(fe_recorder *recorder)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_WORLD_OPTIMIZE, (int64_t)(0));
    if (!at) return;
    fe__op_end(recorder, at);
}

void fe__record_body_create(fe_recorder *recorder, const fe_body_def *def, const fe_body *out_body)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_BODY_CREATE, (int64_t)(FE__OP_STRUCT + sizeof *def + sizeof(fe_handle)));
    if (!at) return;
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_body_def);
    at = fe__put_u64(at, *out_body);
    fe__op_end(recorder, at);
}

void fe__record_body_create_many(fe_recorder *recorder, const fe_body_def *defs, uint32_t stride, int32_t count,
                                 const fe_body *out_bodies)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_CREATE_MANY,
                                     (int64_t)(4 + (size_t)count * sizeof *defs + (size_t)count * sizeof(fe_handle)));
    if (!at) return;
    at = fe__put_i32(at, count);
    at = fe__put_sized_array(at, defs, stride, count, sizeof *defs, words_of_fe_body_def);
    at = fe__put_array(at, out_bodies, 0, count, sizeof(fe_handle), fe__handle_words);
    fe__op_end(recorder, at);
}

void fe__record_body_destroy(fe_recorder *recorder, fe_body body)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_DESTROY, (int64_t)(8));
    if (!at) return;
    at = fe__put_u64(at, body);
    fe__op_end(recorder, at);
}

void fe__record_body_destroy_many(fe_recorder *recorder, const fe_body *bodies, int32_t count)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_BODY_DESTROY_MANY, (int64_t)(4 + (size_t)count * sizeof(fe_handle)));
    if (!at) return;
    at = fe__put_i32(at, count);
    at = fe__put_array(at, bodies, 0, count, sizeof(fe_handle), fe__handle_words);
    fe__op_end(recorder, at);
}

void fe__record_body_set_type(fe_recorder *recorder, fe_body body, int32_t type)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_TYPE, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_i32(at, type);
    fe__op_end(recorder, at);
}

void fe__record_body_set_transform(fe_recorder *recorder, fe_body body, const fe_transform *transform)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_BODY_SET_TRANSFORM, (int64_t)(8 + FE__OP_STRUCT + sizeof *transform));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_plain(at, transform, sizeof *transform, words_of_fe_transform);
    fe__op_end(recorder, at);
}

void fe__record_body_set_linear_velocity(fe_recorder *recorder, fe_body body, const fe_vec3 *velocity)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_BODY_SET_LINEAR_VELOCITY, (int64_t)(8 + FE__OP_STRUCT + sizeof *velocity));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_plain(at, velocity, sizeof *velocity, words_of_fe_vec3);
    fe__op_end(recorder, at);
}

void fe__record_body_set_angular_velocity(fe_recorder *recorder, fe_body body, const fe_vec3 *velocity)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_BODY_SET_ANGULAR_VELOCITY, (int64_t)(8 + FE__OP_STRUCT + sizeof *velocity));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_plain(at, velocity, sizeof *velocity, words_of_fe_vec3);
    fe__op_end(recorder, at);
}

void fe__record_body_set_target(fe_recorder *recorder, fe_body body, const fe_transform *target, float seconds)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_BODY_SET_TARGET, (int64_t)(8 + FE__OP_STRUCT + sizeof *target + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_plain(at, target, sizeof *target, words_of_fe_transform);
    at = fe__put_float(at, seconds);
    fe__op_end(recorder, at);
}

void fe__record_body_add_force(fe_recorder *recorder, fe_body body, const fe_vec3 *force)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_ADD_FORCE, (int64_t)(8 + FE__OP_STRUCT + sizeof *force));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_plain(at, force, sizeof *force, words_of_fe_vec3);
    fe__op_end(recorder, at);
}

void fe__record_body_add_force_at(fe_recorder *recorder, fe_body body, const fe_vec3 *force, const fe_dvec3 *point)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_ADD_FORCE_AT,
                                     (int64_t)(8 + FE__OP_STRUCT + sizeof *force + FE__OP_STRUCT + sizeof *point));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_plain(at, force, sizeof *force, words_of_fe_vec3);
    at = fe__put_plain(at, point, sizeof *point, words_of_fe_dvec3);
    fe__op_end(recorder, at);
}

void fe__record_body_add_torque(fe_recorder *recorder, fe_body body, const fe_vec3 *torque)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_ADD_TORQUE, (int64_t)(8 + FE__OP_STRUCT + sizeof *torque));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_plain(at, torque, sizeof *torque, words_of_fe_vec3);
    fe__op_end(recorder, at);
}

void fe__record_body_add_impulse(fe_recorder *recorder, fe_body body, const fe_vec3 *impulse)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_ADD_IMPULSE, (int64_t)(8 + FE__OP_STRUCT + sizeof *impulse));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_plain(at, impulse, sizeof *impulse, words_of_fe_vec3);
    fe__op_end(recorder, at);
}

void fe__record_body_add_impulse_at(fe_recorder *recorder, fe_body body, const fe_vec3 *impulse, const fe_dvec3 *point)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_ADD_IMPULSE_AT,
                                     (int64_t)(8 + FE__OP_STRUCT + sizeof *impulse + FE__OP_STRUCT + sizeof *point));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_plain(at, impulse, sizeof *impulse, words_of_fe_vec3);
    at = fe__put_plain(at, point, sizeof *point, words_of_fe_dvec3);
    fe__op_end(recorder, at);
}

void fe__record_body_add_angular_impulse(fe_recorder *recorder, fe_body body, const fe_vec3 *impulse)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_BODY_ADD_ANGULAR_IMPULSE, (int64_t)(8 + FE__OP_STRUCT + sizeof *impulse));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_plain(at, impulse, sizeof *impulse, words_of_fe_vec3);
    fe__op_end(recorder, at);
}

void fe__record_body_set_mass_data(fe_recorder *recorder, fe_body body, const fe_mass_data *data)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_MASS_DATA, (int64_t)(8 + FE__OP_STRUCT + sizeof *data));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_sized(at, data, sizeof *data, words_of_fe_mass_data);
    fe__op_end(recorder, at);
}

void fe__record_body_set_mass(fe_recorder *recorder, fe_body body, float mass)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_MASS, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_float(at, mass);
    fe__op_end(recorder, at);
}

void fe__record_body_reset_mass(fe_recorder *recorder, fe_body body)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_RESET_MASS, (int64_t)(8));
    if (!at) return;
    at = fe__put_u64(at, body);
    fe__op_end(recorder, at);
}

void fe__record_body_set_locks(fe_recorder *recorder, fe_body body, uint32_t linear_axes, uint32_t angular_axes)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_LOCKS, (int64_t)(8 + 4 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_u32(at, linear_axes);
    at = fe__put_u32(at, angular_axes);
    fe__op_end(recorder, at);
}

void fe__record_body_set_damping(fe_recorder *recorder, fe_body body, float linear, float angular)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_DAMPING, (int64_t)(8 + 4 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_float(at, linear);
    at = fe__put_float(at, angular);
    fe__op_end(recorder, at);
}

void fe__record_body_set_gravity_scale(fe_recorder *recorder, fe_body body, float scale)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_GRAVITY_SCALE, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_float(at, scale);
    fe__op_end(recorder, at);
}

void fe__record_body_set_awake(fe_recorder *recorder, fe_body body, int32_t awake)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_AWAKE, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_i32(at, awake);
    fe__op_end(recorder, at);
}

void fe__record_body_set_sleep_allowed(fe_recorder *recorder, fe_body body, int32_t allowed)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_SLEEP_ALLOWED, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_i32(at, allowed);
    fe__op_end(recorder, at);
}

void fe__record_body_set_sleep_threshold(fe_recorder *recorder, fe_body body, float speed)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_SLEEP_THRESHOLD, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_float(at, speed);
    fe__op_end(recorder, at);
}

void fe__record_body_set_enabled(fe_recorder *recorder, fe_body body, int32_t enabled)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_ENABLED, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_i32(at, enabled);
    fe__op_end(recorder, at);
}

void fe__record_body_set_bullet(fe_recorder *recorder, fe_body body, int32_t bullet)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_BULLET, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_i32(at, bullet);
    fe__op_end(recorder, at);
}

void fe__record_body_set_user_data(fe_recorder *recorder, fe_body body, uint64_t user_data)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_USER_DATA, (int64_t)(8 + 8));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_u64(at, user_data);
    fe__op_end(recorder, at);
}

void fe__record_body_set_filter(fe_recorder *recorder, fe_body body, uint32_t layer, uint32_t mask, int32_t group)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BODY_SET_FILTER, (int64_t)(8 + 4 + 4 + 4));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_u32(at, layer);
    at = fe__put_u32(at, mask);
    at = fe__put_i32(at, group);
    fe__op_end(recorder, at);
}

void fe__record_shape_create(fe_recorder *recorder, fe_body body, const fe_shape_def *def, const fe_geometry *geometry,
                             const fe_shape *out_shape)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_SHAPE_CREATE,
                     (int64_t)(8 + FE__OP_STRUCT + sizeof *def + FE__OP_STRUCT + sizeof *geometry + sizeof(fe_handle)));
    if (!at) return;
    at = fe__put_u64(at, body);
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_shape_def);
    at = fe__put_sized(at, geometry, sizeof *geometry, words_of_fe_geometry);
    at = fe__put_u64(at, *out_shape);
    fe__op_end(recorder, at);
}

void fe__record_shape_destroy(fe_recorder *recorder, fe_shape shape)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_SHAPE_DESTROY, (int64_t)(8));
    if (!at) return;
    at = fe__put_u64(at, shape);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_geometry(fe_recorder *recorder, fe_shape shape, const fe_geometry *geometry)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_SHAPE_SET_GEOMETRY, (int64_t)(8 + FE__OP_STRUCT + sizeof *geometry));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_sized(at, geometry, sizeof *geometry, words_of_fe_geometry);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_frame(fe_recorder *recorder, fe_shape shape, const fe_frame *frame)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_SHAPE_SET_FRAME, (int64_t)(8 + FE__OP_STRUCT + sizeof *frame));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_plain(at, frame, sizeof *frame, words_of_fe_frame);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_density(fe_recorder *recorder, fe_shape shape, float density)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_SHAPE_SET_DENSITY, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_float(at, density);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_material(fe_recorder *recorder, fe_shape shape, const fe_material *material)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_SHAPE_SET_MATERIAL, (int64_t)(8 + FE__OP_STRUCT + sizeof *material));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_plain(at, material, sizeof *material, words_of_fe_material);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_filter(fe_recorder *recorder, fe_shape shape, uint32_t layer, uint32_t mask, int32_t group)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_SHAPE_SET_FILTER, (int64_t)(8 + 4 + 4 + 4));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_u32(at, layer);
    at = fe__put_u32(at, mask);
    at = fe__put_i32(at, group);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_pair_filter(fe_recorder *recorder, fe_shape shape, int32_t enabled)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_SHAPE_SET_PAIR_FILTER, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_i32(at, enabled);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_one_way(fe_recorder *recorder, fe_shape shape, int32_t enabled, const fe_vec3 *direction)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_SHAPE_SET_ONE_WAY, (int64_t)(8 + 4 + FE__OP_STRUCT + sizeof *direction));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_i32(at, enabled);
    at = fe__put_plain(at, direction, sizeof *direction, words_of_fe_vec3);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_trigger(fe_recorder *recorder, fe_shape shape, int32_t trigger)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_SHAPE_SET_TRIGGER, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_i32(at, trigger);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_events(fe_recorder *recorder, fe_shape shape, uint32_t events)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_SHAPE_SET_EVENTS, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_u32(at, events);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_surface_velocity(fe_recorder *recorder, fe_shape shape, const fe_vec3 *velocity)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_SHAPE_SET_SURFACE_VELOCITY, (int64_t)(8 + FE__OP_STRUCT + sizeof *velocity));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_plain(at, velocity, sizeof *velocity, words_of_fe_vec3);
    fe__op_end(recorder, at);
}

void fe__record_shape_set_user_data(fe_recorder *recorder, fe_shape shape, uint64_t user_data)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_SHAPE_SET_USER_DATA, (int64_t)(8 + 8));
    if (!at) return;
    at = fe__put_u64(at, shape);
    at = fe__put_u64(at, user_data);
    fe__op_end(recorder, at);
}

void fe__record_distance_joint_create(fe_recorder *recorder, const fe_distance_joint_def *def,
                                      const fe_joint *out_joint)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_DISTANCE_JOINT_CREATE,
                                     (int64_t)(FE__OP_STRUCT + sizeof *def + sizeof(fe_handle)));
    if (!at) return;
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_distance_joint_def);
    at = fe__put_u64(at, *out_joint);
    fe__op_end(recorder, at);
}

void fe__record_ball_joint_create(fe_recorder *recorder, const fe_ball_joint_def *def, const fe_joint *out_joint)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_BALL_JOINT_CREATE, (int64_t)(FE__OP_STRUCT + sizeof *def + sizeof(fe_handle)));
    if (!at) return;
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_ball_joint_def);
    at = fe__put_u64(at, *out_joint);
    fe__op_end(recorder, at);
}

void fe__record_hinge_joint_create(fe_recorder *recorder, const fe_hinge_joint_def *def, const fe_joint *out_joint)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_HINGE_JOINT_CREATE, (int64_t)(FE__OP_STRUCT + sizeof *def + sizeof(fe_handle)));
    if (!at) return;
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_hinge_joint_def);
    at = fe__put_u64(at, *out_joint);
    fe__op_end(recorder, at);
}

void fe__record_fixed_joint_create(fe_recorder *recorder, const fe_fixed_joint_def *def, const fe_joint *out_joint)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_FIXED_JOINT_CREATE, (int64_t)(FE__OP_STRUCT + sizeof *def + sizeof(fe_handle)));
    if (!at) return;
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_fixed_joint_def);
    at = fe__put_u64(at, *out_joint);
    fe__op_end(recorder, at);
}

void fe__record_configurable_joint_create(fe_recorder *recorder, const fe_configurable_joint_def *def,
                                          const fe_joint *out_joint)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_CONFIGURABLE_JOINT_CREATE,
                                     (int64_t)(FE__OP_STRUCT + sizeof *def + sizeof(fe_handle)));
    if (!at) return;
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_configurable_joint_def);
    at = fe__put_u64(at, *out_joint);
    fe__op_end(recorder, at);
}

void fe__record_distance_joint_set(fe_recorder *recorder, fe_joint joint, const fe_distance_joint_def *def)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_DISTANCE_JOINT_SET, (int64_t)(8 + FE__OP_STRUCT + sizeof *def));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_distance_joint_def);
    fe__op_end(recorder, at);
}

void fe__record_ball_joint_set(fe_recorder *recorder, fe_joint joint, const fe_ball_joint_def *def)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_BALL_JOINT_SET, (int64_t)(8 + FE__OP_STRUCT + sizeof *def));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_ball_joint_def);
    fe__op_end(recorder, at);
}

void fe__record_hinge_joint_set(fe_recorder *recorder, fe_joint joint, const fe_hinge_joint_def *def)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_HINGE_JOINT_SET, (int64_t)(8 + FE__OP_STRUCT + sizeof *def));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_hinge_joint_def);
    fe__op_end(recorder, at);
}

void fe__record_fixed_joint_set(fe_recorder *recorder, fe_joint joint, const fe_fixed_joint_def *def)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_FIXED_JOINT_SET, (int64_t)(8 + FE__OP_STRUCT + sizeof *def));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_fixed_joint_def);
    fe__op_end(recorder, at);
}

void fe__record_configurable_joint_set(fe_recorder *recorder, fe_joint joint, const fe_configurable_joint_def *def)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_CONFIGURABLE_JOINT_SET, (int64_t)(8 + FE__OP_STRUCT + sizeof *def));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_configurable_joint_def);
    fe__op_end(recorder, at);
}

void fe__record_joint_destroy(fe_recorder *recorder, fe_joint joint)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_JOINT_DESTROY, (int64_t)(8));
    if (!at) return;
    at = fe__put_u64(at, joint);
    fe__op_end(recorder, at);
}

void fe__record_joint_set(fe_recorder *recorder, fe_joint joint, const fe_joint_def *def)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_JOINT_SET, (int64_t)(8 + FE__OP_STRUCT + sizeof *def));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_sized(at, def, sizeof *def, words_of_fe_joint_def);
    fe__op_end(recorder, at);
}

void fe__record_joint_set_enabled(fe_recorder *recorder, fe_joint joint, int32_t enabled)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_JOINT_SET_ENABLED, (int64_t)(8 + 4));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_i32(at, enabled);
    fe__op_end(recorder, at);
}

void fe__record_joint_set_motor_speed(fe_recorder *recorder, fe_joint joint, int32_t dof, float speed)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_JOINT_SET_MOTOR_SPEED, (int64_t)(8 + 4 + 4));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_i32(at, dof);
    at = fe__put_float(at, speed);
    fe__op_end(recorder, at);
}

void fe__record_joint_set_target(fe_recorder *recorder, fe_joint joint, int32_t dof, float target)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_JOINT_SET_TARGET, (int64_t)(8 + 4 + 4));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_i32(at, dof);
    at = fe__put_float(at, target);
    fe__op_end(recorder, at);
}

void fe__record_ball_joint_set_target(fe_recorder *recorder, fe_joint joint, const fe_quat *target)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_BALL_JOINT_SET_TARGET, (int64_t)(8 + FE__OP_STRUCT + sizeof *target));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_plain(at, target, sizeof *target, words_of_fe_quat);
    fe__op_end(recorder, at);
}

void fe__record_joint_set_user_data(fe_recorder *recorder, fe_joint joint, uint64_t user_data)
{
    unsigned char *at = fe__op_begin(recorder, FE__OP_JOINT_SET_USER_DATA, (int64_t)(8 + 8));
    if (!at) return;
    at = fe__put_u64(at, joint);
    at = fe__put_u64(at, user_data);
    fe__op_end(recorder, at);
}

void fe__record_world_set_transforms(fe_recorder *recorder, const fe_body *bodies, const fe_transform *transforms,
                                     uint32_t stride, int32_t count)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_WORLD_SET_TRANSFORMS,
                     (int64_t)(4 + (size_t)count * sizeof(fe_handle) + (size_t)count * sizeof(*transforms)));
    if (!at) return;
    at = fe__put_i32(at, count);
    at = fe__put_array(at, bodies, 0, count, sizeof(fe_handle), fe__handle_words);
    at = fe__put_array(at, transforms, stride, count, sizeof(*transforms), words_of_fe_transform);
    fe__op_end(recorder, at);
}

void fe__record_world_set_velocities(fe_recorder *recorder, const fe_body *bodies, const float *floats, uint32_t stride,
                                     int32_t count)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_WORLD_SET_VELOCITIES,
                     (int64_t)(4 + (size_t)count * sizeof(fe_handle) + (size_t)count * 6 * sizeof(float)));
    if (!at) return;
    at = fe__put_i32(at, count);
    at = fe__put_array(at, bodies, 0, count, sizeof(fe_handle), fe__handle_words);
    at = fe__put_array(at, floats, stride, count, 6 * sizeof(float), fe__six_floats);
    fe__op_end(recorder, at);
}

void fe__record_world_add_forces(fe_recorder *recorder, const fe_body *bodies, const float *floats, uint32_t stride,
                                 int32_t count)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_WORLD_ADD_FORCES,
                     (int64_t)(4 + (size_t)count * sizeof(fe_handle) + (size_t)count * 6 * sizeof(float)));
    if (!at) return;
    at = fe__put_i32(at, count);
    at = fe__put_array(at, bodies, 0, count, sizeof(fe_handle), fe__handle_words);
    at = fe__put_array(at, floats, stride, count, 6 * sizeof(float), fe__six_floats);
    fe__op_end(recorder, at);
}

void fe__record_world_set_joint_targets(fe_recorder *recorder, const fe_joint *joints, const float *values,
                                        uint32_t stride, int32_t count)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_WORLD_SET_JOINT_TARGETS,
                     (int64_t)(4 + (size_t)count * sizeof(fe_handle) + (size_t)count * 1 * sizeof(float)));
    if (!at) return;
    at = fe__put_i32(at, count);
    at = fe__put_array(at, joints, 0, count, sizeof(fe_handle), fe__handle_words);
    at = fe__put_array(at, values, stride, count, 1 * sizeof(float), fe__one_float);
    fe__op_end(recorder, at);
}

void fe__record_world_set_joint_motor_speeds(fe_recorder *recorder, const fe_joint *joints, const float *values,
                                             uint32_t stride, int32_t count)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_WORLD_SET_JOINT_MOTOR_SPEEDS,
                     (int64_t)(4 + (size_t)count * sizeof(fe_handle) + (size_t)count * 1 * sizeof(float)));
    if (!at) return;
    at = fe__put_i32(at, count);
    at = fe__put_array(at, joints, 0, count, sizeof(fe_handle), fe__handle_words);
    at = fe__put_array(at, values, stride, count, 1 * sizeof(float), fe__one_float);
    fe__op_end(recorder, at);
}

void fe__record_world_add_joint_forces(fe_recorder *recorder, const fe_joint *joints, const float *values,
                                       uint32_t stride, int32_t count)
{
    unsigned char *at =
        fe__op_begin(recorder, FE__OP_WORLD_ADD_JOINT_FORCES,
                     (int64_t)(4 + (size_t)count * sizeof(fe_handle) + (size_t)count * 1 * sizeof(float)));
    if (!at) return;
    at = fe__put_i32(at, count);
    at = fe__put_array(at, joints, 0, count, sizeof(fe_handle), fe__handle_words);
    at = fe__put_array(at, values, stride, count, 1 * sizeof(float), fe__one_float);
    fe__op_end(recorder, at);
}
