// op_calls.c - each call of a recording, made again.
//
// Made by tools/ops from include/feather.h; not to be edited.
#include "recording/ops.h"

#include "replay/op_in.h"

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

static fe_result play_world_set_gravity(fe__op_in *in)
{
    fe_vec3 gravity;
    int32_t has_gravity = fe__in_plain(in, &gravity, sizeof gravity, words_of_fe_vec3);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_set_gravity(in->world, has_gravity ? &gravity : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_set_substeps(fe__op_in *in)
{
    int32_t substeps = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_set_substeps(in->world, substeps);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_set_user_data(fe__op_in *in)
{
    uint64_t user_data = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_set_user_data(in->world, user_data);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_set_tuning(fe__op_in *in)
{
    fe_world_tuning tuning;
    int32_t has_tuning = fe__in_sized(in, &tuning, sizeof tuning, words_of_fe_world_tuning);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_set_tuning(in->world, has_tuning ? &tuning : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_ignore_collision(fe__op_in *in)
{
    fe_body a = fe__in_u64(in);
    fe_body b = fe__in_u64(in);
    int32_t ignore = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_ignore_collision(in->world, a, b, ignore);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_optimize(fe__op_in *in)
{
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_optimize(in->world);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_create(fe__op_in *in)
{
    fe_body_def def;
    fe_handle out_body = 0;
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_body_def);
    fe_handle then = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_create(in->world, has_def ? &def : NULL, &out_body);
    return fe__in_compare(in, result, &out_body, &then, 1);
}

static fe_result play_body_create_many(fe__op_in *in)
{
    int32_t count = fe__in_count(in);
    fe_body_def *defs = fe__in_sized_array(in, 0, count, sizeof(fe_body_def), words_of_fe_body_def);
    fe_handle *then = fe__in_array(in, FE__IN_THEN, count, sizeof(fe_handle), fe__handle_words);
    fe_handle *out_bodies = fe__in_room(in, FE__IN_NOW, count);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_create_many(in->world, defs, sizeof *defs, count, out_bodies);
    return fe__in_compare(in, result, out_bodies, then, count);
}

static fe_result play_body_destroy(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_destroy(in->world, body);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_destroy_many(fe__op_in *in)
{
    int32_t count = fe__in_count(in);
    fe_handle *bodies = fe__in_array(in, 0, count, sizeof(fe_handle), fe__handle_words);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_destroy_many(in->world, bodies, count);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_type(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    int32_t type = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_type(in->world, body, type);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_transform(fe__op_in *in)
{
    fe_transform transform;
    fe_body body = fe__in_u64(in);
    int32_t has_transform = fe__in_plain(in, &transform, sizeof transform, words_of_fe_transform);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_transform(in->world, body, has_transform ? &transform : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_linear_velocity(fe__op_in *in)
{
    fe_vec3 velocity;
    fe_body body = fe__in_u64(in);
    int32_t has_velocity = fe__in_plain(in, &velocity, sizeof velocity, words_of_fe_vec3);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_linear_velocity(in->world, body, has_velocity ? &velocity : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_angular_velocity(fe__op_in *in)
{
    fe_vec3 velocity;
    fe_body body = fe__in_u64(in);
    int32_t has_velocity = fe__in_plain(in, &velocity, sizeof velocity, words_of_fe_vec3);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_angular_velocity(in->world, body, has_velocity ? &velocity : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_target(fe__op_in *in)
{
    fe_transform target;
    fe_body body = fe__in_u64(in);
    int32_t has_target = fe__in_plain(in, &target, sizeof target, words_of_fe_transform);
    float seconds = fe__in_float(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_target(in->world, body, has_target ? &target : NULL, seconds);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_add_force(fe__op_in *in)
{
    fe_vec3 force;
    fe_body body = fe__in_u64(in);
    int32_t has_force = fe__in_plain(in, &force, sizeof force, words_of_fe_vec3);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_add_force(in->world, body, has_force ? &force : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_add_force_at(fe__op_in *in)
{
    fe_vec3 force;
    fe_dvec3 point;
    fe_body body = fe__in_u64(in);
    int32_t has_force = fe__in_plain(in, &force, sizeof force, words_of_fe_vec3);
    int32_t has_point = fe__in_plain(in, &point, sizeof point, words_of_fe_dvec3);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_add_force_at(in->world, body, has_force ? &force : NULL, has_point ? &point : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_add_torque(fe__op_in *in)
{
    fe_vec3 torque;
    fe_body body = fe__in_u64(in);
    int32_t has_torque = fe__in_plain(in, &torque, sizeof torque, words_of_fe_vec3);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_add_torque(in->world, body, has_torque ? &torque : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_add_impulse(fe__op_in *in)
{
    fe_vec3 impulse;
    fe_body body = fe__in_u64(in);
    int32_t has_impulse = fe__in_plain(in, &impulse, sizeof impulse, words_of_fe_vec3);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_add_impulse(in->world, body, has_impulse ? &impulse : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_add_impulse_at(fe__op_in *in)
{
    fe_vec3 impulse;
    fe_dvec3 point;
    fe_body body = fe__in_u64(in);
    int32_t has_impulse = fe__in_plain(in, &impulse, sizeof impulse, words_of_fe_vec3);
    int32_t has_point = fe__in_plain(in, &point, sizeof point, words_of_fe_dvec3);
    if (in->result != FE_OK) return in->result;
    fe_result result =
        fe_body_add_impulse_at(in->world, body, has_impulse ? &impulse : NULL, has_point ? &point : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_add_angular_impulse(fe__op_in *in)
{
    fe_vec3 impulse;
    fe_body body = fe__in_u64(in);
    int32_t has_impulse = fe__in_plain(in, &impulse, sizeof impulse, words_of_fe_vec3);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_add_angular_impulse(in->world, body, has_impulse ? &impulse : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_mass_data(fe__op_in *in)
{
    fe_mass_data data;
    fe_body body = fe__in_u64(in);
    int32_t has_data = fe__in_sized(in, &data, sizeof data, words_of_fe_mass_data);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_mass_data(in->world, body, has_data ? &data : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_mass(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    float mass = fe__in_float(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_mass(in->world, body, mass);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_reset_mass(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_reset_mass(in->world, body);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_locks(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    uint32_t linear_axes = fe__in_u32(in);
    uint32_t angular_axes = fe__in_u32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_locks(in->world, body, linear_axes, angular_axes);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_damping(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    float linear = fe__in_float(in);
    float angular = fe__in_float(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_damping(in->world, body, linear, angular);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_gravity_scale(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    float scale = fe__in_float(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_gravity_scale(in->world, body, scale);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_awake(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    int32_t awake = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_awake(in->world, body, awake);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_sleep_allowed(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    int32_t allowed = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_sleep_allowed(in->world, body, allowed);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_sleep_threshold(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    float speed = fe__in_float(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_sleep_threshold(in->world, body, speed);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_enabled(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    int32_t enabled = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_enabled(in->world, body, enabled);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_bullet(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    int32_t bullet = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_bullet(in->world, body, bullet);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_user_data(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    uint64_t user_data = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_user_data(in->world, body, user_data);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_body_set_filter(fe__op_in *in)
{
    fe_body body = fe__in_u64(in);
    uint32_t layer = fe__in_u32(in);
    uint32_t mask = fe__in_u32(in);
    int32_t group = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_body_set_filter(in->world, body, layer, mask, group);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_create(fe__op_in *in)
{
    fe_shape_def def;
    fe_geometry geometry;
    fe_handle out_shape = 0;
    fe_body body = fe__in_u64(in);
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_shape_def);
    int32_t has_geometry = fe__in_sized(in, &geometry, sizeof geometry, words_of_fe_geometry);
    fe__in_asset(in, &geometry.asset);
    fe_handle then = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result =
        fe_shape_create(in->world, body, has_def ? &def : NULL, has_geometry ? &geometry : NULL, &out_shape);
    return fe__in_compare(in, result, &out_shape, &then, 1);
}

static fe_result play_shape_destroy(fe__op_in *in)
{
    fe_shape shape = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_destroy(in->world, shape);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_geometry(fe__op_in *in)
{
    fe_geometry geometry;
    fe_shape shape = fe__in_u64(in);
    int32_t has_geometry = fe__in_sized(in, &geometry, sizeof geometry, words_of_fe_geometry);
    fe__in_asset(in, &geometry.asset);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_geometry(in->world, shape, has_geometry ? &geometry : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_frame(fe__op_in *in)
{
    fe_frame frame;
    fe_shape shape = fe__in_u64(in);
    int32_t has_frame = fe__in_plain(in, &frame, sizeof frame, words_of_fe_frame);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_frame(in->world, shape, has_frame ? &frame : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_density(fe__op_in *in)
{
    fe_shape shape = fe__in_u64(in);
    float density = fe__in_float(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_density(in->world, shape, density);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_material(fe__op_in *in)
{
    fe_material material;
    fe_shape shape = fe__in_u64(in);
    int32_t has_material = fe__in_plain(in, &material, sizeof material, words_of_fe_material);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_material(in->world, shape, has_material ? &material : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_filter(fe__op_in *in)
{
    fe_shape shape = fe__in_u64(in);
    uint32_t layer = fe__in_u32(in);
    uint32_t mask = fe__in_u32(in);
    int32_t group = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_filter(in->world, shape, layer, mask, group);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_pair_filter(fe__op_in *in)
{
    fe_shape shape = fe__in_u64(in);
    int32_t enabled = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_pair_filter(in->world, shape, enabled);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_one_way(fe__op_in *in)
{
    fe_vec3 direction;
    fe_shape shape = fe__in_u64(in);
    int32_t enabled = fe__in_i32(in);
    int32_t has_direction = fe__in_plain(in, &direction, sizeof direction, words_of_fe_vec3);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_one_way(in->world, shape, enabled, has_direction ? &direction : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_trigger(fe__op_in *in)
{
    fe_shape shape = fe__in_u64(in);
    int32_t trigger = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_trigger(in->world, shape, trigger);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_events(fe__op_in *in)
{
    fe_shape shape = fe__in_u64(in);
    uint32_t events = fe__in_u32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_events(in->world, shape, events);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_surface_velocity(fe__op_in *in)
{
    fe_vec3 velocity;
    fe_shape shape = fe__in_u64(in);
    int32_t has_velocity = fe__in_plain(in, &velocity, sizeof velocity, words_of_fe_vec3);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_surface_velocity(in->world, shape, has_velocity ? &velocity : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_shape_set_user_data(fe__op_in *in)
{
    fe_shape shape = fe__in_u64(in);
    uint64_t user_data = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_shape_set_user_data(in->world, shape, user_data);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_distance_joint_create(fe__op_in *in)
{
    fe_distance_joint_def def;
    fe_handle out_joint = 0;
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_distance_joint_def);
    fe_handle then = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_distance_joint_create(in->world, has_def ? &def : NULL, &out_joint);
    return fe__in_compare(in, result, &out_joint, &then, 1);
}

static fe_result play_ball_joint_create(fe__op_in *in)
{
    fe_ball_joint_def def;
    fe_handle out_joint = 0;
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_ball_joint_def);
    fe_handle then = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_ball_joint_create(in->world, has_def ? &def : NULL, &out_joint);
    return fe__in_compare(in, result, &out_joint, &then, 1);
}

static fe_result play_hinge_joint_create(fe__op_in *in)
{
    fe_hinge_joint_def def;
    fe_handle out_joint = 0;
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_hinge_joint_def);
    fe_handle then = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_hinge_joint_create(in->world, has_def ? &def : NULL, &out_joint);
    return fe__in_compare(in, result, &out_joint, &then, 1);
}

static fe_result play_fixed_joint_create(fe__op_in *in)
{
    fe_fixed_joint_def def;
    fe_handle out_joint = 0;
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_fixed_joint_def);
    fe_handle then = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_fixed_joint_create(in->world, has_def ? &def : NULL, &out_joint);
    return fe__in_compare(in, result, &out_joint, &then, 1);
}

static fe_result play_configurable_joint_create(fe__op_in *in)
{
    fe_configurable_joint_def def;
    fe_handle out_joint = 0;
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_configurable_joint_def);
    fe_handle then = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_configurable_joint_create(in->world, has_def ? &def : NULL, &out_joint);
    return fe__in_compare(in, result, &out_joint, &then, 1);
}

static fe_result play_distance_joint_set(fe__op_in *in)
{
    fe_distance_joint_def def;
    fe_joint joint = fe__in_u64(in);
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_distance_joint_def);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_distance_joint_set(in->world, joint, has_def ? &def : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_ball_joint_set(fe__op_in *in)
{
    fe_ball_joint_def def;
    fe_joint joint = fe__in_u64(in);
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_ball_joint_def);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_ball_joint_set(in->world, joint, has_def ? &def : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_hinge_joint_set(fe__op_in *in)
{
    fe_hinge_joint_def def;
    fe_joint joint = fe__in_u64(in);
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_hinge_joint_def);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_hinge_joint_set(in->world, joint, has_def ? &def : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_fixed_joint_set(fe__op_in *in)
{
    fe_fixed_joint_def def;
    fe_joint joint = fe__in_u64(in);
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_fixed_joint_def);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_fixed_joint_set(in->world, joint, has_def ? &def : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_configurable_joint_set(fe__op_in *in)
{
    fe_configurable_joint_def def;
    fe_joint joint = fe__in_u64(in);
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_configurable_joint_def);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_configurable_joint_set(in->world, joint, has_def ? &def : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_joint_destroy(fe__op_in *in)
{
    fe_joint joint = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_joint_destroy(in->world, joint);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_joint_set(fe__op_in *in)
{
    fe_joint_def def;
    fe_joint joint = fe__in_u64(in);
    int32_t has_def = fe__in_sized(in, &def, sizeof def, words_of_fe_joint_def);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_joint_set(in->world, joint, has_def ? &def : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_joint_set_enabled(fe__op_in *in)
{
    fe_joint joint = fe__in_u64(in);
    int32_t enabled = fe__in_i32(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_joint_set_enabled(in->world, joint, enabled);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_joint_set_motor_speed(fe__op_in *in)
{
    fe_joint joint = fe__in_u64(in);
    int32_t dof = fe__in_i32(in);
    float speed = fe__in_float(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_joint_set_motor_speed(in->world, joint, dof, speed);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_joint_set_target(fe__op_in *in)
{
    fe_joint joint = fe__in_u64(in);
    int32_t dof = fe__in_i32(in);
    float target = fe__in_float(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_joint_set_target(in->world, joint, dof, target);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_ball_joint_set_target(fe__op_in *in)
{
    fe_quat target;
    fe_joint joint = fe__in_u64(in);
    int32_t has_target = fe__in_plain(in, &target, sizeof target, words_of_fe_quat);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_ball_joint_set_target(in->world, joint, has_target ? &target : NULL);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_joint_set_user_data(fe__op_in *in)
{
    fe_joint joint = fe__in_u64(in);
    uint64_t user_data = fe__in_u64(in);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_joint_set_user_data(in->world, joint, user_data);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_set_transforms(fe__op_in *in)
{
    int32_t count = fe__in_count(in);
    fe_handle *bodies = fe__in_array(in, 0, count, sizeof(fe_handle), fe__handle_words);
    fe_transform *transforms = fe__in_array(in, 1, count, sizeof(fe_transform), words_of_fe_transform);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_set_transforms(in->world, bodies, transforms, 0, count);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_set_velocities(fe__op_in *in)
{
    int32_t count = fe__in_count(in);
    fe_handle *bodies = fe__in_array(in, 0, count, sizeof(fe_handle), fe__handle_words);
    float *floats = fe__in_array(in, 1, count, 6 * sizeof(float), fe__six_floats);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_set_velocities(in->world, bodies, floats, 0, count);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_add_forces(fe__op_in *in)
{
    int32_t count = fe__in_count(in);
    fe_handle *bodies = fe__in_array(in, 0, count, sizeof(fe_handle), fe__handle_words);
    float *floats = fe__in_array(in, 1, count, 6 * sizeof(float), fe__six_floats);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_add_forces(in->world, bodies, floats, 0, count);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_set_joint_targets(fe__op_in *in)
{
    int32_t count = fe__in_count(in);
    fe_handle *joints = fe__in_array(in, 0, count, sizeof(fe_handle), fe__handle_words);
    float *values = fe__in_array(in, 1, count, 1 * sizeof(float), fe__one_float);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_set_joint_targets(in->world, joints, values, 0, count);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_set_joint_motor_speeds(fe__op_in *in)
{
    int32_t count = fe__in_count(in);
    fe_handle *joints = fe__in_array(in, 0, count, sizeof(fe_handle), fe__handle_words);
    float *values = fe__in_array(in, 1, count, 1 * sizeof(float), fe__one_float);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_set_joint_motor_speeds(in->world, joints, values, 0, count);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static fe_result play_world_add_joint_forces(fe__op_in *in)
{
    int32_t count = fe__in_count(in);
    fe_handle *joints = fe__in_array(in, 0, count, sizeof(fe_handle), fe__handle_words);
    float *values = fe__in_array(in, 1, count, 1 * sizeof(float), fe__one_float);
    if (in->result != FE_OK) return in->result;
    fe_result result = fe_world_add_joint_forces(in->world, joints, values, 0, count);
    return fe__in_compare(in, result, NULL, NULL, 0);
}

static const fe__op_call calls[] = {
    [FE__OP_WORLD_SET_GRAVITY] = {"fe_world_set_gravity", play_world_set_gravity},
    [FE__OP_WORLD_SET_SUBSTEPS] = {"fe_world_set_substeps", play_world_set_substeps},
    [FE__OP_WORLD_SET_USER_DATA] = {"fe_world_set_user_data", play_world_set_user_data},
    [FE__OP_WORLD_SET_TUNING] = {"fe_world_set_tuning", play_world_set_tuning},
    [FE__OP_WORLD_IGNORE_COLLISION] = {"fe_world_ignore_collision", play_world_ignore_collision},
    [FE__OP_WORLD_OPTIMIZE] = {"fe_world_optimize", play_world_optimize},
    [FE__OP_BODY_CREATE] = {"fe_body_create", play_body_create},
    [FE__OP_BODY_CREATE_MANY] = {"fe_body_create_many", play_body_create_many},
    [FE__OP_BODY_DESTROY] = {"fe_body_destroy", play_body_destroy},
    [FE__OP_BODY_DESTROY_MANY] = {"fe_body_destroy_many", play_body_destroy_many},
    [FE__OP_BODY_SET_TYPE] = {"fe_body_set_type", play_body_set_type},
    [FE__OP_BODY_SET_TRANSFORM] = {"fe_body_set_transform", play_body_set_transform},
    [FE__OP_BODY_SET_LINEAR_VELOCITY] = {"fe_body_set_linear_velocity", play_body_set_linear_velocity},
    [FE__OP_BODY_SET_ANGULAR_VELOCITY] = {"fe_body_set_angular_velocity", play_body_set_angular_velocity},
    [FE__OP_BODY_SET_TARGET] = {"fe_body_set_target", play_body_set_target},
    [FE__OP_BODY_ADD_FORCE] = {"fe_body_add_force", play_body_add_force},
    [FE__OP_BODY_ADD_FORCE_AT] = {"fe_body_add_force_at", play_body_add_force_at},
    [FE__OP_BODY_ADD_TORQUE] = {"fe_body_add_torque", play_body_add_torque},
    [FE__OP_BODY_ADD_IMPULSE] = {"fe_body_add_impulse", play_body_add_impulse},
    [FE__OP_BODY_ADD_IMPULSE_AT] = {"fe_body_add_impulse_at", play_body_add_impulse_at},
    [FE__OP_BODY_ADD_ANGULAR_IMPULSE] = {"fe_body_add_angular_impulse", play_body_add_angular_impulse},
    [FE__OP_BODY_SET_MASS_DATA] = {"fe_body_set_mass_data", play_body_set_mass_data},
    [FE__OP_BODY_SET_MASS] = {"fe_body_set_mass", play_body_set_mass},
    [FE__OP_BODY_RESET_MASS] = {"fe_body_reset_mass", play_body_reset_mass},
    [FE__OP_BODY_SET_LOCKS] = {"fe_body_set_locks", play_body_set_locks},
    [FE__OP_BODY_SET_DAMPING] = {"fe_body_set_damping", play_body_set_damping},
    [FE__OP_BODY_SET_GRAVITY_SCALE] = {"fe_body_set_gravity_scale", play_body_set_gravity_scale},
    [FE__OP_BODY_SET_AWAKE] = {"fe_body_set_awake", play_body_set_awake},
    [FE__OP_BODY_SET_SLEEP_ALLOWED] = {"fe_body_set_sleep_allowed", play_body_set_sleep_allowed},
    [FE__OP_BODY_SET_SLEEP_THRESHOLD] = {"fe_body_set_sleep_threshold", play_body_set_sleep_threshold},
    [FE__OP_BODY_SET_ENABLED] = {"fe_body_set_enabled", play_body_set_enabled},
    [FE__OP_BODY_SET_BULLET] = {"fe_body_set_bullet", play_body_set_bullet},
    [FE__OP_BODY_SET_USER_DATA] = {"fe_body_set_user_data", play_body_set_user_data},
    [FE__OP_BODY_SET_FILTER] = {"fe_body_set_filter", play_body_set_filter},
    [FE__OP_SHAPE_CREATE] = {"fe_shape_create", play_shape_create},
    [FE__OP_SHAPE_DESTROY] = {"fe_shape_destroy", play_shape_destroy},
    [FE__OP_SHAPE_SET_GEOMETRY] = {"fe_shape_set_geometry", play_shape_set_geometry},
    [FE__OP_SHAPE_SET_FRAME] = {"fe_shape_set_frame", play_shape_set_frame},
    [FE__OP_SHAPE_SET_DENSITY] = {"fe_shape_set_density", play_shape_set_density},
    [FE__OP_SHAPE_SET_MATERIAL] = {"fe_shape_set_material", play_shape_set_material},
    [FE__OP_SHAPE_SET_FILTER] = {"fe_shape_set_filter", play_shape_set_filter},
    [FE__OP_SHAPE_SET_PAIR_FILTER] = {"fe_shape_set_pair_filter", play_shape_set_pair_filter},
    [FE__OP_SHAPE_SET_ONE_WAY] = {"fe_shape_set_one_way", play_shape_set_one_way},
    [FE__OP_SHAPE_SET_TRIGGER] = {"fe_shape_set_trigger", play_shape_set_trigger},
    [FE__OP_SHAPE_SET_EVENTS] = {"fe_shape_set_events", play_shape_set_events},
    [FE__OP_SHAPE_SET_SURFACE_VELOCITY] = {"fe_shape_set_surface_velocity", play_shape_set_surface_velocity},
    [FE__OP_SHAPE_SET_USER_DATA] = {"fe_shape_set_user_data", play_shape_set_user_data},
    [FE__OP_DISTANCE_JOINT_CREATE] = {"fe_distance_joint_create", play_distance_joint_create},
    [FE__OP_BALL_JOINT_CREATE] = {"fe_ball_joint_create", play_ball_joint_create},
    [FE__OP_HINGE_JOINT_CREATE] = {"fe_hinge_joint_create", play_hinge_joint_create},
    [FE__OP_FIXED_JOINT_CREATE] = {"fe_fixed_joint_create", play_fixed_joint_create},
    [FE__OP_CONFIGURABLE_JOINT_CREATE] = {"fe_configurable_joint_create", play_configurable_joint_create},
    [FE__OP_DISTANCE_JOINT_SET] = {"fe_distance_joint_set", play_distance_joint_set},
    [FE__OP_BALL_JOINT_SET] = {"fe_ball_joint_set", play_ball_joint_set},
    [FE__OP_HINGE_JOINT_SET] = {"fe_hinge_joint_set", play_hinge_joint_set},
    [FE__OP_FIXED_JOINT_SET] = {"fe_fixed_joint_set", play_fixed_joint_set},
    [FE__OP_CONFIGURABLE_JOINT_SET] = {"fe_configurable_joint_set", play_configurable_joint_set},
    [FE__OP_JOINT_DESTROY] = {"fe_joint_destroy", play_joint_destroy},
    [FE__OP_JOINT_SET] = {"fe_joint_set", play_joint_set},
    [FE__OP_JOINT_SET_ENABLED] = {"fe_joint_set_enabled", play_joint_set_enabled},
    [FE__OP_JOINT_SET_MOTOR_SPEED] = {"fe_joint_set_motor_speed", play_joint_set_motor_speed},
    [FE__OP_JOINT_SET_TARGET] = {"fe_joint_set_target", play_joint_set_target},
    [FE__OP_BALL_JOINT_SET_TARGET] = {"fe_ball_joint_set_target", play_ball_joint_set_target},
    [FE__OP_JOINT_SET_USER_DATA] = {"fe_joint_set_user_data", play_joint_set_user_data},
    [FE__OP_WORLD_SET_TRANSFORMS] = {"fe_world_set_transforms", play_world_set_transforms},
    [FE__OP_WORLD_SET_VELOCITIES] = {"fe_world_set_velocities", play_world_set_velocities},
    [FE__OP_WORLD_ADD_FORCES] = {"fe_world_add_forces", play_world_add_forces},
    [FE__OP_WORLD_SET_JOINT_TARGETS] = {"fe_world_set_joint_targets", play_world_set_joint_targets},
    [FE__OP_WORLD_SET_JOINT_MOTOR_SPEEDS] = {"fe_world_set_joint_motor_speeds", play_world_set_joint_motor_speeds},
    [FE__OP_WORLD_ADD_JOINT_FORCES] = {"fe_world_add_joint_forces", play_world_add_joint_forces},
};

const fe__op_call *fe__op_call_of(int32_t number)
{
    int32_t count = (int32_t)(sizeof calls / sizeof *calls);
    return number >= 0 && number < count && calls[number].play ? calls + number : NULL;
}
