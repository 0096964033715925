// bulk_joints.c - the API that reads and writes many joints with one call.
//
// The rows are those of a batch's fields (batch/field.h). Writing is all or none: every row is checked before the first
// joint changes. A joint may be named twice: its last value stands, forces add up.
#include "api/check.h"
#include "api/record.h"
#include "batch/field.h"
#include "core/fp_state.h"

#include <string.h>

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
