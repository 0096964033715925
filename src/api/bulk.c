// bulk.c - the API that reads and writes many bodies with one call.
//
// Writing is all or none: everything is checked before the first body changes. A body may be named twice: its last
// value stands, forces add up.
#include "api/check.h"
#include "api/record.h"
#include "core/fp_state.h"
#include "world/bodies.h"
#include "world/handles.h"
#include "world/motion.h"

#include <string.h>

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
