// fe_joint.c - the API of what a game changes each step: speed of a motor, target of a spring, nothing else.
#include "api/check.h"
#include "api/fe_joint_def.h"
#include "core/fp_state.h"
#include "world/joint.h"
#include "world/joint_creation.h"
#include "world/joint_parts.h"
#include "world/world.h"

// ---- joint drive ----------------------------------------------------------------------------------------------------

typedef float *(*field_of)(fe__joint_any *def, int32_t type, int32_t dof);

static fe_result set_field(const char *function, fe_world *world, fe_joint joint, int32_t dof, field_of find,
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
    FE_TRY(set_field(function, world, joint, dof, fe__joint_motor_speed, "speed", speed));
    FE_RECORD(joint_set_motor_speed, joint, dof, speed);
    return FE_OK;
}

fe_result fe_joint_set_target(fe_world *world, fe_joint joint, int32_t dof, float target)
{
    FE_WRITE(world);
    FE_TRY(set_field(function, world, joint, dof, fe__joint_target, "target", target));
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

// ---- joint ----------------------------------------------------------------------------------------------------------
// The API of joints: life, change, readings. Definitions are checked in fe_joint_def.c, made from the world in
// fe_joint_def.c.

static const char *const type_names[FE__JOINT_TYPES] = {"none",  "distance joint", "ball joint",
                                                        "hinge", "fixed joint",    "configurable joint"};

// ---- birth ---------------------------------------------------------------------------------------------------------
static fe_result create(const char *function, fe_world *world, int32_t type, const void *def, fe_joint *out_joint)
{
    FE_CHECK_POINTER(out_joint);
    fe__joint_any full;
    fe__joint_defaults(type, &full);
    FE_TRY(fe__read_struct(function, "def", def, &full, fe__joint_fields(type)));
    int32_t bodies[2];
    FE_TRY(fe__find_joint_ends(function, world, full.common.body_a, full.common.body_b, bodies));
    FE_TRY(fe__check_joint_def(function, type, &full));
    int32_t joint = 0;
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__joint_create(world, type, &full, bodies, &joint);
    fe__fp_leave(fp);
    FE_TRY(fe__report(function, result));
    *out_joint = fe__joint_handle(world, joint);
    return FE_OK;
}

fe_result fe_distance_joint_create(fe_world *world, const fe_distance_joint_def *def, fe_joint *out_joint)
{
    if (out_joint) *out_joint = 0;
    FE_WRITE_ALONE(world);
    FE_TRY(create(function, world, FE_JOINT_DISTANCE, def, out_joint));
    FE_RECORD(distance_joint_create, def, out_joint);
    return FE_OK;
}

fe_result fe_ball_joint_create(fe_world *world, const fe_ball_joint_def *def, fe_joint *out_joint)
{
    if (out_joint) *out_joint = 0;
    FE_WRITE_ALONE(world);
    FE_TRY(create(function, world, FE_JOINT_BALL, def, out_joint));
    FE_RECORD(ball_joint_create, def, out_joint);
    return FE_OK;
}

fe_result fe_hinge_joint_create(fe_world *world, const fe_hinge_joint_def *def, fe_joint *out_joint)
{
    if (out_joint) *out_joint = 0;
    FE_WRITE_ALONE(world);
    FE_TRY(create(function, world, FE_JOINT_HINGE, def, out_joint));
    FE_RECORD(hinge_joint_create, def, out_joint);
    return FE_OK;
}

fe_result fe_fixed_joint_create(fe_world *world, const fe_fixed_joint_def *def, fe_joint *out_joint)
{
    if (out_joint) *out_joint = 0;
    FE_WRITE_ALONE(world);
    FE_TRY(create(function, world, FE_JOINT_FIXED, def, out_joint));
    FE_RECORD(fixed_joint_create, def, out_joint);
    return FE_OK;
}

fe_result fe_configurable_joint_create(fe_world *world, const fe_configurable_joint_def *def, fe_joint *out_joint)
{
    if (out_joint) *out_joint = 0;
    FE_WRITE_ALONE(world);
    FE_TRY(create(function, world, FE_JOINT_CONFIGURABLE, def, out_joint));
    FE_RECORD(configurable_joint_create, def, out_joint);
    return FE_OK;
}

// ---- change --------------------------------------------------------------------------------------------------------
static fe_result check_type(const char *function, const fe_world *world, int32_t index, int32_t type)
{
    int32_t actual = world->joint_records[index].type;
    if (actual == type) return FE_OK;
    return fe__fail(function, FE_ERROR_STATE, "joint 0x%llx is a %s, not a %s", fe__joint_handle(world, index),
                    type_names[actual], type_names[type]);
}

// A joint keeps its bodies for life: 0 and their own handles will do
static fe_result check_bodies(const char *function, const fe_world *world, int32_t index, const fe_joint_def *full)
{
    fe_body a = fe__joint_end_handle(world, index, 0), b = fe__joint_end_handle(world, index, 1);
    if ((full->body_a == 0 || full->body_a == a) && (full->body_b == 0 || full->body_b == b)) return FE_OK;
    return fe__fail(function, FE_ERROR_ARGUMENT,
                    "body_a, body_b are 0x%llx, 0x%llx, the joint has 0x%llx, 0x%llx, which no call changes",
                    full->body_a, full->body_b, a, b);
}

fe_result fe__change_joint(const char *function, fe_world *world, int32_t index, const fe__joint_any *full)
{
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__joint_change(world, index, full);
    fe__fp_leave(fp);
    return fe__report(function, result);
}

static fe_result set(const char *function, fe_world *world, int32_t type, fe_joint joint, const void *def)
{
    FE_FIND_JOINT(index, joint);
    FE_TRY(check_type(function, world, index, type));
    fe__joint_any full;
    fe__joint_describe(world, index, &full);
    FE_TRY(fe__read_struct(function, "def", def, &full, fe__joint_fields(type)));
    FE_TRY(check_bodies(function, world, index, &full.common));
    FE_TRY(fe__check_joint_def(function, type, &full));
    return fe__change_joint(function, world, index, &full);
}

static fe_result get(const char *function, const fe_world *world, int32_t type, fe_joint joint, void *out_def)
{
    FE_READ_AS(function, world);
    FE_FIND_JOINT(index, joint);
    FE_TRY(fe__check_struct_size(function, "out_def", out_def, fe__joint_fields(type)));
    FE_TRY(check_type(function, world, index, type));
    fe__joint_any full;
    fe__joint_describe(world, index, &full);
    fe__write_struct(out_def, &full, full.common.struct_size);
    return FE_OK;
}

fe_result fe_distance_joint_set(fe_world *world, fe_joint joint, const fe_distance_joint_def *def)
{
    FE_WRITE(world);
    FE_TRY(set(function, world, FE_JOINT_DISTANCE, joint, def));
    FE_RECORD(distance_joint_set, joint, def);
    return FE_OK;
}
fe_result fe_ball_joint_set(fe_world *world, fe_joint joint, const fe_ball_joint_def *def)
{
    FE_WRITE(world);
    FE_TRY(set(function, world, FE_JOINT_BALL, joint, def));
    FE_RECORD(ball_joint_set, joint, def);
    return FE_OK;
}
fe_result fe_hinge_joint_set(fe_world *world, fe_joint joint, const fe_hinge_joint_def *def)
{
    FE_WRITE(world);
    FE_TRY(set(function, world, FE_JOINT_HINGE, joint, def));
    FE_RECORD(hinge_joint_set, joint, def);
    return FE_OK;
}
fe_result fe_fixed_joint_set(fe_world *world, fe_joint joint, const fe_fixed_joint_def *def)
{
    FE_WRITE(world);
    FE_TRY(set(function, world, FE_JOINT_FIXED, joint, def));
    FE_RECORD(fixed_joint_set, joint, def);
    return FE_OK;
}

fe_result fe_configurable_joint_set(fe_world *world, fe_joint joint, const fe_configurable_joint_def *def)
{
    FE_WRITE(world);
    FE_TRY(set(function, world, FE_JOINT_CONFIGURABLE, joint, def));
    FE_RECORD(configurable_joint_set, joint, def);
    return FE_OK;
}

fe_result fe_distance_joint_get(const fe_world *world, fe_joint joint, fe_distance_joint_def *out_def)
{
    return get(__func__, world, FE_JOINT_DISTANCE, joint, out_def);
}

fe_result fe_ball_joint_get(const fe_world *world, fe_joint joint, fe_ball_joint_def *out_def)
{
    return get(__func__, world, FE_JOINT_BALL, joint, out_def);
}
fe_result fe_hinge_joint_get(const fe_world *world, fe_joint joint, fe_hinge_joint_def *out_def)
{
    return get(__func__, world, FE_JOINT_HINGE, joint, out_def);
}
fe_result fe_fixed_joint_get(const fe_world *world, fe_joint joint, fe_fixed_joint_def *out_def)
{
    return get(__func__, world, FE_JOINT_FIXED, joint, out_def);
}

fe_result fe_configurable_joint_get(const fe_world *world, fe_joint joint, fe_configurable_joint_def *out_def)
{
    return get(__func__, world, FE_JOINT_CONFIGURABLE, joint, out_def);
}

// ---- what all types have -------------------------------------------------------------------------------------------
fe_result fe_joint_set(fe_world *world, fe_joint joint, const fe_joint_def *def)
{
    FE_WRITE(world);
    FE_FIND_JOINT(index, joint);
    fe__joint_any full;
    fe__joint_describe(world, index, &full);
    uint32_t size = full.common.struct_size;
    FE_TRY(fe__read_struct(function, "def", def, &full, &fe__fields_of_fe_joint_def));
    full.common.struct_size = size;
    FE_TRY(check_bodies(function, world, index, &full.common));
    FE_TRY(fe__check_joint_common(function, &full.common));
    FE_TRY(fe__change_joint(function, world, index, &full));
    FE_RECORD(joint_set, joint, def);
    return FE_OK;
}

fe_result fe_joint_get(const fe_world *world, fe_joint joint, fe_joint_def *out_def)
{
    FE_READ(world);
    FE_FIND_JOINT(index, joint);
    FE_CHECK_STRUCT_SIZE(out_def);
    fe__joint_any full;
    fe__joint_describe(world, index, &full);
    fe__write_struct(out_def, &full.common, FE__JOINT_FRONT);
    return FE_OK;
}

fe_result fe_joint_set_enabled(fe_world *world, fe_joint joint, int32_t enabled)
{
    FE_WRITE(world);
    FE_FIND_JOINT(index, joint);
    FE_CHECK_BOOL(enabled);
    fe__joint_any full;
    fe__joint_describe(world, index, &full);
    if (full.common.enabled == enabled) return FE_OK;
    full.common.enabled = enabled;
    FE_TRY(fe__change_joint(function, world, index, &full));
    FE_RECORD(joint_set_enabled, joint, enabled);
    return FE_OK;
}

fe_result fe_joint_get_enabled(const fe_world *world, fe_joint joint, int32_t *out_enabled)
{
    FE_READ(world);
    FE_FIND_JOINT(index, joint);
    FE_CHECK_POINTER(out_enabled);
    *out_enabled = (world->joint_records[index].flags & FE__JOINT_ENABLED) != 0;
    return FE_OK;
}

fe_result fe_joint_set_user_data(fe_world *world, fe_joint joint, uint64_t user_data)
{
    FE_WRITE(world);
    FE_FIND_JOINT(index, joint);
    world->joint_records[index].user_data = user_data;
    FE_RECORD(joint_set_user_data, joint, user_data);
    return FE_OK;
}

fe_result fe_joint_get_user_data(const fe_world *world, fe_joint joint, uint64_t *out_user_data)
{
    FE_READ(world);
    FE_FIND_JOINT(index, joint);
    FE_CHECK_POINTER(out_user_data);
    *out_user_data = world->joint_records[index].user_data;
    return FE_OK;
}

fe_result fe_joint_destroy(fe_world *world, fe_joint joint)
{
    FE_WRITE_ALONE(world);
    FE_FIND_JOINT(index, joint);
    fe__fp_state fp = fe__fp_enter();
    fe__joint_destroy(world, index);
    fe__fp_leave(fp);
    FE_RECORD(joint_destroy, joint);
    return FE_OK;
}

int32_t fe_joint_is_valid(const fe_world *world, fe_joint joint)
{
    int32_t slot;
    return world && fe__id_pool_find(&world->joint_ids, joint, &slot) == FE_OK;
}

fe_result fe_joint_get_type(const fe_world *world, fe_joint joint, int32_t *out_type)
{
    FE_READ(world);
    FE_FIND_JOINT(index, joint);
    FE_CHECK_POINTER(out_type);
    *out_type = world->joint_records[index].type;
    return FE_OK;
}

fe_result fe_joint_get_bodies(const fe_world *world, fe_joint joint, fe_body *out_body_a, fe_body *out_body_b)
{
    FE_READ(world);
    FE_FIND_JOINT(index, joint);
    FE_CHECK_POINTER(out_body_a);
    FE_CHECK_POINTER(out_body_b);
    *out_body_a = fe__joint_end_handle(world, index, 0);
    *out_body_b = fe__joint_end_handle(world, index, 1);
    return FE_OK;
}

// ---- readings ------------------------------------------------------------------------------------------------------
fe_result fe_joint_get_frames(const fe_world *world, fe_joint joint, fe_transform *out_frame_a,
                              fe_transform *out_frame_b)
{
    FE_READ(world);
    FE_FIND_JOINT(index, joint);
    FE_CHECK_POINTER(out_frame_a);
    FE_CHECK_POINTER(out_frame_b);
    fe__fp_state fp = fe__fp_enter();
    *out_frame_a = fe__joint_frame_now(world, index, 0);
    *out_frame_b = fe__joint_frame_now(world, index, 1);
    fe__fp_leave(fp);
    return FE_OK;
}

FE_DEFINE_EMPTY_INIT(fe_joint_state_init, fe_joint_state, state)

fe_result fe_joint_get_state(const fe_world *world, fe_joint joint, fe_joint_state *out_state)
{
    FE_READ(world);
    FE_FIND_JOINT(index, joint);
    FE_CHECK_STRUCT_SIZE(out_state);
    fe_joint_state state = {.struct_size = sizeof state};
    fe__fp_state fp = fe__fp_enter();
    fe__joint_state_of(world, index, &state);
    fe__fp_leave(fp);
    fe__write_struct(out_state, &state, sizeof state);
    return FE_OK;
}

fe_result fe_joint_get_reaction(const fe_world *world, fe_joint joint, fe_vec3 *out_force, fe_vec3 *out_torque)
{
    FE_READ(world);
    FE_FIND_JOINT(index, joint);
    FE_CHECK_POINTER(out_force);
    FE_CHECK_POINTER(out_torque);
    fe__fp_state fp = fe__fp_enter();
    fe__joint_reaction_of(&world->joints, world->bodies, index, out_force, out_torque);
    fe__fp_leave(fp);
    return FE_OK;
}

int32_t fe_world_get_joints(const fe_world *world, fe_joint *out_joints, int32_t capacity)
{
    FE_READ(world);
    FE_CHECK_ARRAY(out_joints, capacity);
    int32_t count = 0;
    for (int32_t joint = world->first_joint; joint && count < capacity; joint = world->joint_records[joint].order_next)
        out_joints[count++] = fe__joint_handle(world, joint);
    return world->joint_count;
}

int32_t fe_body_get_joints(const fe_world *world, fe_body body, fe_joint *out_joints, int32_t capacity)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_ARRAY(out_joints, capacity);
    int32_t count = 0;
    for (int32_t joint = world->bodies[index].first_joint; joint && count < capacity;
         joint = fe__next_joint(world, joint, index))
        out_joints[count++] = fe__joint_handle(world, joint);
    return world->bodies[index].joint_total;
}
