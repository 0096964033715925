// body_motion.c - the API of velocities, forces and impulses.
#include "api/check.h"
#include "api/record.h"
#include "core/fp_state.h"
#include "world/motion.h"
#include "world/pose.h"

// ---- velocities ----------------------------------------------------------------------------------------------------

static fe_result check_moves(const char *function, const fe_world *world, int32_t index, fe_body body)
{
    if (world->bodies[index].type != FE_BODY_STATIC) return FE_OK;
    return fe__fail(function, FE_ERROR_STATE, "body 0x%llx is static, it has no velocity", body);
}

fe_result fe_body_set_linear_velocity(fe_world *world, fe_body body, const fe_vec3 *velocity)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_VEC3(velocity, FE_MAX_SPEED);
    FE_TRY(check_moves(function, world, index, body));
    fe__fp_state fp = fe__fp_enter();
    fe__body_set_velocity(world, index, velocity, NULL);
    fe__fp_leave(fp);
    FE_RECORD(body_set_linear_velocity, body, velocity);
    return FE_OK;
}

fe_result fe_body_get_linear_velocity(const fe_world *world, fe_body body, fe_vec3 *out_velocity)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_velocity);
    *out_velocity = fe__body_velocity(&world->bodies[index]);
    return FE_OK;
}

fe_result fe_body_set_angular_velocity(fe_world *world, fe_body body, const fe_vec3 *velocity)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_VEC3(velocity, FE_MAX_SPEED);
    FE_TRY(check_moves(function, world, index, body));
    fe__fp_state fp = fe__fp_enter();
    fe__body_set_velocity(world, index, NULL, velocity);
    fe__fp_leave(fp);
    FE_RECORD(body_set_angular_velocity, body, velocity);
    return FE_OK;
}

fe_result fe_body_get_angular_velocity(const fe_world *world, fe_body body, fe_vec3 *out_velocity)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_velocity);
    *out_velocity = fe__body_spin(&world->bodies[index]);
    return FE_OK;
}

// From the centre of mass to a point of the world
static fe_dvec3 arm_to(const fe__body *body, const fe_dvec3 *point)
{
    return (fe_dvec3){point->x - body->centre[0], point->y - body->centre[1], point->z - body->centre[2]};
}

fe_result fe_body_get_point_velocity(const fe_world *world, fe_body body, const fe_dvec3 *point, fe_vec3 *out_velocity)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_DVEC3(point, FE_MAX_POSITION);
    FE_CHECK_POINTER(out_velocity);
    const fe__body *record = &world->bodies[index];
    fe__fp_state fp = fe__fp_enter();
    fe_dvec3 turning = fe__dcross(fe__widen(fe__body_spin(record)), arm_to(record, point));
    *out_velocity = fe__narrow(fe__dadd(fe__widen(fe__body_velocity(record)), turning));
    fe__fp_leave(fp);
    return FE_OK;
}

// v = distance / seconds: the centre of a kinematic body is its origin
static void velocities_to(const fe__body *body, const fe_transform *target, double seconds, fe_vec3 *out_linear,
                          fe_vec3 *out_angular)
{
    fe_transform now = fe__body_transform(body);
    *out_linear = fe__narrow(fe__dscale(1.0 / seconds, fe__dsub(target->position, now.position)));
    *out_angular = fe__spin_between(now.rotation, fe__unit_rotation(target->rotation), seconds);
}

fe_result fe_body_set_target(fe_world *world, fe_body body, const fe_transform *target, float seconds)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_TRANSFORM(target);
    FE_CHECK_FLOAT(seconds, FE_LEAST_VALUE, FE_MAX_VALUE);
    if (world->bodies[index].type != FE_BODY_KINEMATIC) {
        return fe__fail(function, FE_ERROR_STATE, "body 0x%llx is not kinematic, only those have targets", body);
    }
    fe_vec3 needed_velocity, needed_spin;
    fe__fp_state fp = fe__fp_enter();
    velocities_to(&world->bodies[index], target, (double)seconds, &needed_velocity, &needed_spin);
    fe__fp_leave(fp);
    FE_CHECK_VEC3(&needed_velocity, FE_MAX_SPEED);
    FE_CHECK_VEC3(&needed_spin, FE_MAX_SPEED);
    fe__body_set_velocity(world, index, &needed_velocity, &needed_spin);
    FE_RECORD(body_set_target, body, target, seconds);
    return FE_OK;
}

// ---- forces --------------------------------------------------------------------------------------------------------

static void push(fe_world *world, int32_t index, fe_vec3 force, fe_vec3 torque)
{
    if (!fe__body_feels_forces(&world->bodies[index])) return;
    fe__fp_state fp = fe__fp_enter();
    fe__body_add_force(world, index, force, torque);
    fe__fp_leave(fp);
}

// r x F
static fe_vec3 moment_of(const fe__body *body, const fe_vec3 *force, const fe_dvec3 *point)
{
    fe__fp_state fp = fe__fp_enter();
    fe_vec3 moment = fe__narrow(fe__dcross(arm_to(body, point), fe__widen(*force)));
    fe__fp_leave(fp);
    return moment;
}

fe_result fe_body_add_force(fe_world *world, fe_body body, const fe_vec3 *force)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_VEC3(force, FE_MAX_FORCE);
    push(world, index, *force, fe__vec3(0.0f, 0.0f, 0.0f));
    FE_RECORD(body_add_force, body, force);
    return FE_OK;
}

fe_result fe_body_add_force_at(fe_world *world, fe_body body, const fe_vec3 *force, const fe_dvec3 *point)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_VEC3(force, FE_MAX_FORCE);
    FE_CHECK_DVEC3(point, FE_MAX_POSITION);
    fe_vec3 torque = moment_of(&world->bodies[index], force, point);
    FE_CHECK_VEC3(&torque, FE_MAX_FORCE);
    push(world, index, *force, torque);
    FE_RECORD(body_add_force_at, body, force, point);
    return FE_OK;
}

fe_result fe_body_add_torque(fe_world *world, fe_body body, const fe_vec3 *torque)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_VEC3(torque, FE_MAX_FORCE);
    push(world, index, fe__vec3(0.0f, 0.0f, 0.0f), *torque);
    FE_RECORD(body_add_torque, body, torque);
    return FE_OK;
}

// ---- impulses ------------------------------------------------------------------------------------------------------

static fe_result strike(const char *function, fe_world *world, int32_t index, fe_vec3 impulse, fe_vec3 angular_impulse)
{
    const fe__body *body = &world->bodies[index];
    if (!fe__body_feels_forces(body)) return FE_OK;
    fe__fp_state fp = fe__fp_enter();
    fe_vec3 new_velocity = fe__add_scaled(fe__body_velocity(body), body->inverse_mass, impulse);
    fe_vec3 new_spin = fe__add(fe__body_spin(body), fe__body_spin_change(body, angular_impulse));
    fe__fp_leave(fp);
    FE_CHECK_VEC3(&new_velocity, FE_MAX_SPEED);
    FE_CHECK_VEC3(&new_spin, FE_MAX_SPEED);
    fe__body_set_velocity(world, index, &new_velocity, &new_spin);
    return FE_OK;
}

fe_result fe_body_add_impulse(fe_world *world, fe_body body, const fe_vec3 *impulse)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_VEC3(impulse, FE_MAX_FORCE);
    FE_TRY(strike(function, world, index, *impulse, fe__vec3(0.0f, 0.0f, 0.0f)));
    FE_RECORD(body_add_impulse, body, impulse);
    return FE_OK;
}

fe_result fe_body_add_impulse_at(fe_world *world, fe_body body, const fe_vec3 *impulse, const fe_dvec3 *point)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_VEC3(impulse, FE_MAX_FORCE);
    FE_CHECK_DVEC3(point, FE_MAX_POSITION);
    FE_TRY(strike(function, world, index, *impulse, moment_of(&world->bodies[index], impulse, point)));
    FE_RECORD(body_add_impulse_at, body, impulse, point);
    return FE_OK;
}

fe_result fe_body_add_angular_impulse(fe_world *world, fe_body body, const fe_vec3 *impulse)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_VEC3(impulse, FE_MAX_FORCE);
    FE_TRY(strike(function, world, index, fe__vec3(0.0f, 0.0f, 0.0f), *impulse));
    FE_RECORD(body_add_angular_impulse, body, impulse);
    return FE_OK;
}
