// fe_bulk.c - the API that reads and writes many joints with one call.
//
// The rows are those of a batch's fields (batch/field.h). Writing is all or none: every row is checked before the first
// joint changes. A joint may be named twice: its last value stands, forces add up.
#include "api/check.h"
#include "batch/field.h"
#include "core/fp_state.h"
#include "world/body_creation.h"
#include "world/body_motion.h"
#include "world/world.h"

#include <string.h>

// ---- bulk joints ----------------------------------------------------------------------------------------------------

enum { COORDINATE_FLOATS = 2, REACTION_FLOATS = 6 };

static void read_row(const fe_world *world, const fe__batch_field *field, fe_joint joint, void *out_floats)
{
    static const fe__field_frame frame = {{0.0, 0.0, 0.0}, {0.0f, 0.0f, 0.0f, 1.0f}};
    double row[FE__MOST_COMPONENTS];
    float floats[FE__MOST_COMPONENTS];
    int32_t index;
    (void)fe__field_find(world, field, joint, &index);
    field->read(world, index, &frame, row);
    for (int32_t k = 0; k < field->components; ++k) floats[k] = (float)row[k];
    memcpy(out_floats, floats, (size_t)field->components * sizeof *floats); // it may lie at any address
}

static fe_result read_rows(const char *function, const fe_world *world, int32_t which, const fe_joint *joints,
                           float *out_floats, uint32_t stride, int32_t count)
{
    const fe__batch_field *field = fe__field_of(which);
    for (int32_t i = 0; i < count; ++i) {
        FE_FIND_JOINT(index, joints[i]);
        (void)index;
    }
    fe__fp_state fp = fe__fp_enter();
    for (int32_t i = 0; i < count; ++i) read_row(world, field, joints[i], fe__at(out_floats, stride, i));
    fe__fp_leave(fp);
    return FE_OK;
}

static double value_at(const float *values, uint32_t stride, int32_t i)
{
    float value;
    memcpy(&value, fe__at_const(values, stride, i), sizeof value);
    return (double)value;
}

static fe_result refuse(const char *function, fe_result result, const fe_joint *joints, int32_t i, double value)
{
    if (result == FE_ERROR_STATE)
        return fe__fail(function, result, "joints[%d], 0x%llx, has no free axis, or nothing there that could be set",
                        (int)i, (unsigned long long)joints[i]);
    return fe__fail(function, result, "values[%d] is %g, out of range or not finite", (int)i, value);
}

static fe_result write_rows(const char *function, fe_world *world, int32_t which, const fe_joint *joints,
                            const float *values, uint32_t stride, int32_t count)
{
    const fe__batch_field *field = fe__field_of(which);
    for (int32_t i = 0; i < count; ++i) {
        FE_FIND_JOINT(index, joints[i]);
        double value = value_at(values, stride, i);
        fe_result result = field->takes(world, index, &value);
        if (result != FE_OK) return refuse(function, result, joints, i, value);
    }
    fe_result result = FE_OK;
    fe__fp_state fp = fe__fp_enter();
    for (int32_t i = 0; i < count && result == FE_OK; ++i) {
        double value = value_at(values, stride, i);
        int32_t index;
        (void)fe__field_find(world, field, joints[i], &index);
        result = field->write(world, index, &value);
    }
    fe__fp_leave(fp);
    return fe__report(function, result);
}

// ---- reading -------------------------------------------------------------------------------------------------------
fe_result fe_world_get_joint_coordinates(const fe_world *world, const fe_joint *joints, float *out_floats,
                                         uint32_t stride, int32_t count)
{
    FE_READ(world);
    FE_CHECK_ARRAY(joints, count);
    FE_CHECK_ARRAY(out_floats, count);
    FE_CHECK_STRIDE(stride, COORDINATE_FLOATS * sizeof(float), COORDINATE_FLOATS * sizeof(float));
    return read_rows(function, world, FE_FIELD_JOINT, joints, out_floats, stride, count);
}

fe_result fe_world_get_joint_reactions(const fe_world *world, const fe_joint *joints, float *out_floats,
                                       uint32_t stride, int32_t count)
{
    FE_READ(world);
    FE_CHECK_ARRAY(joints, count);
    FE_CHECK_ARRAY(out_floats, count);
    FE_CHECK_STRIDE(stride, REACTION_FLOATS * sizeof(float), REACTION_FLOATS * sizeof(float));
    return read_rows(function, world, FE_FIELD_REACTION, joints, out_floats, stride, count);
}

// ---- writing -------------------------------------------------------------------------------------------------------
#define CHECK_WRITTEN()            \
    FE_CHECK_ARRAY(joints, count); \
    FE_CHECK_ARRAY(values, count); \
    FE_CHECK_STRIDE(stride, sizeof(float), sizeof(float))

fe_result fe_world_set_joint_targets(fe_world *world, const fe_joint *joints, const float *values, uint32_t stride,
                                     int32_t count)
{
    FE_WRITE(world);
    CHECK_WRITTEN();
    FE_TRY(write_rows(function, world, FE_FIELD_JOINT_TARGET, joints, values, stride, count));
    FE_RECORD(world_set_joint_targets, joints, values, stride, count);
    return FE_OK;
}

fe_result fe_world_set_joint_motor_speeds(fe_world *world, const fe_joint *joints, const float *values, uint32_t stride,
                                          int32_t count)
{
    FE_WRITE(world);
    CHECK_WRITTEN();
    FE_TRY(write_rows(function, world, FE_FIELD_JOINT_SPEED, joints, values, stride, count));
    FE_RECORD(world_set_joint_motor_speeds, joints, values, stride, count);
    return FE_OK;
}

fe_result fe_world_add_joint_forces(fe_world *world, const fe_joint *joints, const float *values, uint32_t stride,
                                    int32_t count)
{
    FE_WRITE(world);
    CHECK_WRITTEN();
    FE_TRY(write_rows(function, world, FE_FIELD_JOINT_FORCE, joints, values, stride, count));
    FE_RECORD(world_add_joint_forces, joints, values, stride, count);
    return FE_OK;
}

// ---- bulk -----------------------------------------------------------------------------------------------------------
// The API that reads and writes many bodies with one call.
//
// Writing is all or none: everything is checked before the first body changes. A body may be named twice: its last
// value stands, forces add up.

// What velocities and forces have in common: six floats
typedef struct twist {
    fe_vec3 linear, angular;
} twist;

// A pose for a renderer: seven floats
typedef struct pose_f32 {
    fe_vec3 position;
    fe_quat rotation;
} pose_f32;

_Static_assert(sizeof(twist) == 6 * sizeof(float) && sizeof(pose_f32) == 7 * sizeof(float),
               "these are arrays of floats to the caller");

// The caller's arrays may lie at any address: records are copied, never pointed to.
static twist twist_at(const float *floats, uint32_t stride, int32_t i)
{
    twist t;
    memcpy(&t, fe__at_const(floats, stride, i), sizeof t);
    return t;
}

static fe_transform transform_at(const fe_transform *transforms, uint32_t stride, int32_t i)
{
    fe_transform t;
    memcpy(&t, fe__at_const(transforms, stride, i), sizeof t);
    return t;
}

static fe_result find_all(const char *function, const fe_world *world, const fe_body *bodies, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        FE_FIND_BODY(index, bodies[i]);
        (void)index;
    }
    return FE_OK;
}

// ---- poses ---------------------------------------------------------------------------------------------------------

int32_t fe_world_get_moved(const fe_world *world, fe_body *out_bodies, fe_transform *out_transforms, uint32_t stride,
                           int32_t capacity)
{
    FE_READ(world);
    FE_CHECK_ARRAY(out_bodies, capacity);
    FE_CHECK_STRIDE(stride, sizeof *out_transforms, sizeof *out_transforms);
    int32_t count = 0;
    for (int32_t i = world->first_body; i >= 0; i = world->bodies[i].order_next) {
        if (world->step_number == 0 || world->bodies[i].moved_step != world->step_number) continue;
        if (count < capacity) {
            out_bodies[count] = fe__body_handle(world, i);
            fe_transform t = fe__body_transform(&world->bodies[i]);
            if (out_transforms) memcpy(fe__at(out_transforms, stride, count), &t, sizeof t);
        }
        count += 1;
    }
    return count;
}

fe_result fe_world_get_transforms(const fe_world *world, const fe_body *bodies, fe_transform *out_transforms,
                                  uint32_t stride, int32_t count)
{
    FE_READ(world);
    FE_CHECK_ARRAY(bodies, count);
    FE_CHECK_ARRAY(out_transforms, count);
    FE_CHECK_STRIDE(stride, sizeof *out_transforms, sizeof *out_transforms);
    FE_TRY(find_all(function, world, bodies, count));
    for (int32_t i = 0; i < count; ++i) {
        fe_transform t = fe__body_transform(&world->bodies[fe__id_slot_of(bodies[i])]);
        memcpy(fe__at(out_transforms, stride, i), &t, sizeof t);
    }
    return FE_OK;
}

fe_result fe_world_set_transforms(fe_world *world, const fe_body *bodies, const fe_transform *transforms,
                                  uint32_t stride, int32_t count)
{
    FE_WRITE(world);
    FE_CHECK_ARRAY(bodies, count);
    FE_CHECK_ARRAY(transforms, count);
    FE_CHECK_STRIDE(stride, sizeof *transforms, sizeof *transforms);
    FE_TRY(find_all(function, world, bodies, count));
    for (int32_t i = 0; i < count; ++i) {
        fe_transform transform = transform_at(transforms, stride, i);
        FE_CHECK_TRANSFORM(&transform);
    }
    fe__fp_state fp = fe__fp_enter();
    for (int32_t i = 0; i < count; ++i) {
        fe_transform transform = transform_at(transforms, stride, i);
        fe__body_set_transform(world, fe__id_slot_of(bodies[i]), &transform);
    }
    fe__fp_leave(fp);
    FE_RECORD(world_set_transforms, bodies, transforms, stride, count);
    return FE_OK;
}

fe_result fe_world_get_transforms_f32(const fe_world *world, const fe_body *bodies, const fe_dvec3 *origin,
                                      float *out_floats, uint32_t stride, int32_t count)
{
    FE_READ(world);
    FE_CHECK_ARRAY(bodies, count);
    FE_CHECK_ARRAY(out_floats, count);
    FE_CHECK_DVEC3(origin, FE_MAX_POSITION);
    FE_CHECK_STRIDE(stride, sizeof(pose_f32), sizeof(pose_f32));
    FE_TRY(find_all(function, world, bodies, count));
    fe__fp_state fp = fe__fp_enter();
    for (int32_t i = 0; i < count; ++i) {
        fe_transform t = fe__body_transform(&world->bodies[fe__id_slot_of(bodies[i])]);
        pose_f32 pose = {fe__narrow(fe__dsub(t.position, *origin)), t.rotation};
        memcpy(fe__at(out_floats, stride, i), &pose, sizeof pose);
    }
    fe__fp_leave(fp);
    return FE_OK;
}

// ---- velocities and forces -----------------------------------------------------------------------------------------

fe_result fe_world_get_velocities(const fe_world *world, const fe_body *bodies, float *out_floats, uint32_t stride,
                                  int32_t count)
{
    FE_READ(world);
    FE_CHECK_ARRAY(bodies, count);
    FE_CHECK_ARRAY(out_floats, count);
    FE_CHECK_STRIDE(stride, sizeof(twist), sizeof(twist));
    FE_TRY(find_all(function, world, bodies, count));
    for (int32_t i = 0; i < count; ++i) {
        const fe__body *body = &world->bodies[fe__id_slot_of(bodies[i])];
        twist t = {fe__body_velocity(body), fe__body_spin(body)};
        memcpy(fe__at(out_floats, stride, i), &t, sizeof t);
    }
    return FE_OK;
}

fe_result fe_world_set_velocities(fe_world *world, const fe_body *bodies, const float *floats, uint32_t stride,
                                  int32_t count)
{
    FE_WRITE(world);
    FE_CHECK_ARRAY(bodies, count);
    FE_CHECK_ARRAY(floats, count);
    FE_CHECK_STRIDE(stride, sizeof(twist), sizeof(twist));
    for (int32_t i = 0; i < count; ++i) {
        FE_FIND_BODY(index, bodies[i]);
        if (world->bodies[index].type == FE_BODY_STATIC) {
            return fe__fail(function, FE_ERROR_STATE, "bodies[%d] is static, it has no velocity", (int)i);
        }
        twist velocity = twist_at(floats, stride, i);
        FE_CHECK_VEC3(&velocity.linear, FE_MAX_SPEED);
        FE_CHECK_VEC3(&velocity.angular, FE_MAX_SPEED);
    }
    fe__fp_state fp = fe__fp_enter();
    for (int32_t i = 0; i < count; ++i) {
        twist velocity = twist_at(floats, stride, i);
        fe__body_set_velocity(world, fe__id_slot_of(bodies[i]), &velocity.linear, &velocity.angular);
    }
    fe__fp_leave(fp);
    FE_RECORD(world_set_velocities, bodies, floats, stride, count);
    return FE_OK;
}

fe_result fe_world_add_forces(fe_world *world, const fe_body *bodies, const float *floats, uint32_t stride,
                              int32_t count)
{
    FE_WRITE(world);
    FE_CHECK_ARRAY(bodies, count);
    FE_CHECK_ARRAY(floats, count);
    FE_CHECK_STRIDE(stride, sizeof(twist), sizeof(twist));
    FE_TRY(find_all(function, world, bodies, count));
    for (int32_t i = 0; i < count; ++i) {
        twist force = twist_at(floats, stride, i);
        FE_CHECK_VEC3(&force.linear, FE_MAX_FORCE);
        FE_CHECK_VEC3(&force.angular, FE_MAX_FORCE);
    }
    fe__fp_state fp = fe__fp_enter();
    for (int32_t i = 0; i < count; ++i) {
        int32_t index = fe__id_slot_of(bodies[i]);
        twist force = twist_at(floats, stride, i);
        if (fe__body_feels_forces(&world->bodies[index])) fe__body_add_force(world, index, force.linear, force.angular);
    }
    fe__fp_leave(fp);
    FE_RECORD(world_add_forces, bodies, floats, stride, count);
    return FE_OK;
}
