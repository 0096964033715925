// fe_body.c - the API of velocities, forces and impulses.
#include "api/check.h"
#include "core/fp_state.h"
#include "world/body.h"
#include "world/body_creation.h"
#include "world/body_motion.h"
#include "world/mass.h"
#include "world/shape.h"
#include "world/sleep.h"
#include "world/world.h"

#include <string.h>

// ---- body motion ----------------------------------------------------------------------------------------------------

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

// ---- body -----------------------------------------------------------------------------------------------------------
// The API of bodies: life, pose, mass, locks, switches. Velocities and forces are in fe_body.c.

// ---- life ----------------------------------------------------------------------------------------------------------

static fe_body_def default_body(void)
{
    return (fe_body_def){.struct_size = sizeof(fe_body_def),
                         .type = FE_BODY_DYNAMIC,
                         .transform.rotation.w = 1.0f,
                         .gravity_scale = 1.0f,
                         .sleep_threshold = 0.05f,
                         .awake = 1,
                         .sleep_allowed = 1,
                         .enabled = 1};
}

void fe_body_def_init(fe_body_def *def, uint32_t struct_size)
{
    fe_body_def defaults = default_body();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

static fe_result read_body_def(const char *function, const fe_body_def *def, fe_body_def *full)
{
    *full = default_body();
    if (!def) return FE_OK;
    FE_READ_STRUCT(def, full);
    FE_CHECK_INT(full->type, FE_BODY_STATIC, FE_BODY_DYNAMIC);
    FE_CHECK_TRANSFORM(&full->transform);
    FE_CHECK_VEC3(&full->linear_velocity, FE_MAX_SPEED);
    FE_CHECK_VEC3(&full->angular_velocity, FE_MAX_SPEED);
    FE_CHECK_FLOAT(full->linear_damping, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(full->angular_damping, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(full->gravity_scale, -FE_MAX_VALUE, FE_MAX_VALUE);
    FE_CHECK_FLOAT(full->sleep_threshold, 0.0f, FE_MAX_SPEED);
    FE_CHECK_BITS(full->linear_locks, FE_AXIS_ALL);
    FE_CHECK_BITS(full->angular_locks, FE_AXIS_ALL);
    FE_CHECK_BOOL(full->awake);
    FE_CHECK_BOOL(full->sleep_allowed);
    FE_CHECK_BOOL(full->enabled);
    FE_CHECK_BOOL(full->bullet);
    return FE_OK;
}

// Where nobody may sleep, nobody is born asleep
static fe_body create(fe_world *world, fe_body_def full)
{
    if (!world->tuning.sleep_enabled) full.awake = 1;
    fe__fp_state fp = fe__fp_enter();
    int32_t index = fe__body_create(world, &full);
    fe__fp_leave(fp);
    return fe__body_handle(world, index);
}

fe_result fe_body_create(fe_world *world, const fe_body_def *def, fe_body *out_body)
{
    if (out_body) *out_body = 0;
    FE_WRITE_ALONE(world);
    FE_CHECK_POINTER(out_body);
    fe_body_def full;
    FE_TRY(read_body_def(function, def, &full));
    FE_TRY(fe__report(function, fe__reserve_bodies(world, 1)));
    *out_body = create(world, full);
    FE_RECORD(body_create, def, out_body);
    return FE_OK;
}

fe_result fe_body_create_many(fe_world *world, const fe_body_def *defs, uint32_t stride, int32_t count,
                              fe_body *out_bodies)
{
    if (out_bodies && count > 0) memset(out_bodies, 0, sizeof *out_bodies * (size_t)count);
    FE_WRITE(world);
    FE_CHECK_ARRAY(defs, count);
    FE_CHECK_ARRAY(out_bodies, count);
    if (count == 0) return FE_OK;
    FE_CHECK_STRUCT_SIZE(defs);
    FE_CHECK_RECORD_STRIDE(stride, (uint32_t)sizeof defs->struct_size, count);
    fe_body_def full;
    for (int32_t i = 0; i < count; ++i) {
        const fe_body_def *def = fe__at_const(defs, stride, i);
        FE_TRY(read_body_def(function, def, &full));
    }
    FE_TRY(fe__report(function, fe__reserve_bodies(world, count)));
    for (int32_t i = 0; i < count; ++i) {
        (void)read_body_def(function, fe__at_const(defs, stride, i), &full);
        out_bodies[i] = create(world, full);
    }
    FE_RECORD(body_create_many, defs, stride, count, out_bodies);
    return FE_OK;
}

static void destroy(fe_world *world, int32_t index)
{
    fe__fp_state fp = fe__fp_enter();
    fe__body_destroy(world, index);
    fe__fp_leave(fp);
}

fe_result fe_body_destroy(fe_world *world, fe_body body)
{
    FE_WRITE_ALONE(world);
    FE_FIND_BODY(index, body);
    destroy(world, index);
    FE_RECORD(body_destroy, body);
    return FE_OK;
}

// Finds all of them, each once; what is found is marked until the call ends.
static fe_result mark_bodies(const char *function, fe_world *world, const fe_body *bodies, int32_t count,
                             int32_t *out_marked)
{
    for (int32_t i = 0; i < count; ++i) {
        FE_FIND_BODY(index, bodies[i]);
        if (world->bodies[index].flags & FE__BODY_STARTED) {
            return fe__fail(function, FE_ERROR_ARGUMENT, "bodies[%d] is body 0x%llx for the second time", (int)i,
                            bodies[i]);
        }
        world->bodies[index].flags |= FE__BODY_STARTED;
        *out_marked = i + 1;
    }
    return FE_OK;
}

fe_result fe_body_destroy_many(fe_world *world, const fe_body *bodies, int32_t count)
{
    FE_WRITE_ALONE(world);
    FE_CHECK_ARRAY(bodies, count);
    int32_t marked = 0;
    fe_result result = mark_bodies(function, world, bodies, count, &marked);
    for (int32_t i = 0; i < marked; ++i) world->bodies[fe__id_slot_of(bodies[i])].flags &= ~(uint32_t)FE__BODY_STARTED;
    FE_TRY(result);
    for (int32_t i = 0; i < count; ++i) destroy(world, fe__id_slot_of(bodies[i]));
    FE_RECORD(body_destroy_many, bodies, count);
    return FE_OK;
}

int32_t fe_body_is_valid(const fe_world *world, fe_body body)
{
    int32_t index;
    return world && fe__id_pool_find(&world->body_ids, body, &index) == FE_OK;
}

// ---- type and pose -------------------------------------------------------------------------------------------------

// Every form of the body may be on one of that type; else *out_form is the first that may not.
static int32_t may_be(const fe_world *world, int32_t body, int32_t type, const fe__form **out_form)
{
    for (int32_t shape = world->bodies[body].first_shape; shape >= 0; shape = world->shapes[shape].next) {
        const fe__form *form = *out_form = &world->shapes[shape].form;
        if (type == FE_BODY_STATIC || !fe__form_is_static_only(form)) continue;
        if (type == FE_BODY_DYNAMIC || !fe__form_is_carried(form)) return 0;
    }
    return 1;
}

fe_result fe_body_set_type(fe_world *world, fe_body body, int32_t type)
{
    FE_WRITE_ALONE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_INT(type, FE_BODY_STATIC, FE_BODY_DYNAMIC);
    const fe__form *form;
    if (!may_be(world, index, type, &form)) {
        return fe__fail(function, FE_ERROR_UNSUPPORTED, "body 0x%llx has a %s, so that it must be static%s", body,
                        fe__traits_of(form)->name, fe__form_is_carried(form) ? " or kinematic" : "");
    }
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__body_set_type(world, index, type);
    fe__fp_leave(fp);
    FE_TRY(fe__report(function, result));
    FE_RECORD(body_set_type, body, type);
    return FE_OK;
}

fe_result fe_body_get_type(const fe_world *world, fe_body body, int32_t *out_type)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_type);
    *out_type = world->bodies[index].type;
    return FE_OK;
}

fe_result fe_body_set_transform(fe_world *world, fe_body body, const fe_transform *transform)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_TRANSFORM(transform);
    fe_transform copy = *transform;
    fe__fp_state fp = fe__fp_enter();
    fe__body_set_transform(world, index, &copy);
    fe__fp_leave(fp);
    FE_RECORD(body_set_transform, body, transform);
    return FE_OK;
}

fe_result fe_body_get_transform(const fe_world *world, fe_body body, fe_transform *out_transform)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_transform);
    *out_transform = fe__body_transform(&world->bodies[index]);
    return FE_OK;
}

fe_result fe_body_get_centre(const fe_world *world, fe_body body, fe_dvec3 *out_centre)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_centre);
    const double *centre = world->bodies[index].centre;
    *out_centre = (fe_dvec3){centre[0], centre[1], centre[2]};
    return FE_OK;
}

// ---- mass ----------------------------------------------------------------------------------------------------------

static fe_result check_dynamic(const char *function, const fe_world *world, int32_t index, fe_body body)
{
    if (world->bodies[index].type == FE_BODY_DYNAMIC) return FE_OK;
    return fe__fail(function, FE_ERROR_STATE, "body 0x%llx is not dynamic, it has no mass", body);
}

// A moment is the integral of two of the squares x^2, y^2, z^2 over the mass: none exceeds the sum of the others. Flat
// bodies reach it, and rounding passes it by a little.
static fe_result check_triangle(const char *function, const fe_vec3 *inertia)
{
    const double slack = 1.0 + 1e-5;
    double x = (double)inertia->x, y = (double)inertia->y, z = (double)inertia->z;
    if (x <= (y + z) * slack && y <= (z + x) * slack && z <= (x + y) * slack) return FE_OK;
    return fe__fail(function, FE_ERROR_ARGUMENT,
                    "data->inertia is (%.9g, %.9g, %.9g): no body has a moment above the sum of the other two", x, y,
                    z);
}

static fe_result read_mass_data(const char *function, const fe_mass_data *data, fe_mass_data *copy)
{
    *copy = (fe_mass_data){.struct_size = sizeof *copy, .inertia_rotation.w = 1.0f};
    FE_READ_STRUCT(data, copy);
    FE_CHECK_FLOAT(copy->mass, FE_LEAST_MASS, FE_MAX_MASS);
    FE_CHECK_VEC3(&copy->centre, FE_MAX_LOCAL);
    FE_CHECK_FLOAT(copy->inertia.x, FE_LEAST_INERTIA, FE_MAX_INERTIA);
    FE_CHECK_FLOAT(copy->inertia.y, FE_LEAST_INERTIA, FE_MAX_INERTIA);
    FE_CHECK_FLOAT(copy->inertia.z, FE_LEAST_INERTIA, FE_MAX_INERTIA);
    FE_CHECK_QUAT(&copy->inertia_rotation);
    return check_triangle(function, &copy->inertia);
}

static void give_mass(fe_world *world, int32_t index, const fe_mass_data *data)
{
    fe__fp_state fp = fe__fp_enter();
    fe__body_set_mass(world, index, data);
    fe__fp_leave(fp);
}

void fe_mass_data_init(fe_mass_data *data, uint32_t struct_size)
{
    fe_mass_data defaults = {.struct_size = sizeof defaults,
                             .mass = 1.0f,
                             .inertia = {1.0f, 1.0f, 1.0f},
                             .inertia_rotation = {.w = 1.0f}};
    fe__init_struct(data, &defaults, sizeof defaults, struct_size);
}

fe_result fe_body_set_mass_data(fe_world *world, fe_body body, const fe_mass_data *data)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    fe_mass_data copy;
    FE_TRY(read_mass_data(function, data, &copy));
    FE_TRY(check_dynamic(function, world, index, body));
    give_mass(world, index, &copy);
    FE_RECORD(body_set_mass_data, body, data);
    return FE_OK;
}

fe_result fe_body_get_mass_data(const fe_world *world, fe_body body, fe_mass_data *out_data)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_STRUCT_SIZE(out_data);
    fe_mass_data data = {.struct_size = sizeof data};
    fe__body_mass_data(world, index, &data);
    fe__write_struct(out_data, &data, sizeof data);
    return FE_OK;
}

fe_result fe_body_set_mass(fe_world *world, fe_body body, float mass)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_FLOAT(mass, FE_LEAST_MASS, FE_MAX_MASS);
    FE_TRY(check_dynamic(function, world, index, body));
    fe__fp_state fp = fe__fp_enter();
    fe_mass_data scaled = fe__body_scaled_mass(world, index, mass);
    fe__fp_leave(fp);
    FE_CHECK_FLOAT(scaled.inertia.x, FE_LEAST_INERTIA, FE_MAX_INERTIA);
    FE_CHECK_FLOAT(scaled.inertia.y, FE_LEAST_INERTIA, FE_MAX_INERTIA);
    FE_CHECK_FLOAT(scaled.inertia.z, FE_LEAST_INERTIA, FE_MAX_INERTIA);
    give_mass(world, index, &scaled);
    FE_RECORD(body_set_mass, body, mass);
    return FE_OK;
}

fe_result fe_body_get_mass(const fe_world *world, fe_body body, float *out_mass)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_mass);
    *out_mass = world->bodies[index].mass;
    return FE_OK;
}

fe_result fe_body_reset_mass(fe_world *world, fe_body body)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    if (!(world->bodies[index].flags & FE__BODY_MASS_GIVEN)) return FE_OK;
    fe__fp_state fp = fe__fp_enter();
    world->bodies[index].flags &= ~(uint32_t)FE__BODY_MASS_GIVEN;
    fe__body_disturb(world, index);
    fe__body_update_mass(world, index);
    fe__fp_leave(fp);
    FE_RECORD(body_reset_mass, body);
    return FE_OK;
}

// ---- locks, damping, gravity ---------------------------------------------------------------------------------------

fe_result fe_body_set_locks(fe_world *world, fe_body body, uint32_t linear_axes, uint32_t angular_axes)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_BITS(linear_axes, FE_AXIS_ALL);
    FE_CHECK_BITS(angular_axes, FE_AXIS_ALL);
    fe__fp_state fp = fe__fp_enter();
    fe__body_set_locks(world, index, linear_axes, angular_axes);
    fe__fp_leave(fp);
    FE_RECORD(body_set_locks, body, linear_axes, angular_axes);
    return FE_OK;
}

fe_result fe_body_get_locks(const fe_world *world, fe_body body, uint32_t *out_linear_axes, uint32_t *out_angular_axes)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_linear_axes);
    FE_CHECK_POINTER(out_angular_axes);
    uint32_t bits = (uint32_t)world->bodies[index].lock_bits;
    *out_linear_axes = bits & FE_AXIS_ALL;
    *out_angular_axes = bits >> 3;
    return FE_OK;
}

fe_result fe_body_set_damping(fe_world *world, fe_body body, float linear, float angular)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_FLOAT(linear, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(angular, 0.0f, FE_MAX_VALUE);
    world->bodies[index].linear_damping = linear;
    world->bodies[index].angular_damping = angular;
    FE_RECORD(body_set_damping, body, linear, angular);
    return FE_OK;
}

fe_result fe_body_get_damping(const fe_world *world, fe_body body, float *out_linear, float *out_angular)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_linear);
    FE_CHECK_POINTER(out_angular);
    *out_linear = world->bodies[index].linear_damping;
    *out_angular = world->bodies[index].angular_damping;
    return FE_OK;
}

fe_result fe_body_set_gravity_scale(fe_world *world, fe_body body, float scale)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_FLOAT(scale, -FE_MAX_VALUE, FE_MAX_VALUE);
    if (world->bodies[index].gravity_scale == scale) return FE_OK;
    world->bodies[index].gravity_scale = scale;
    fe__body_disturb(world, index);
    FE_RECORD(body_set_gravity_scale, body, scale);
    return FE_OK;
}

fe_result fe_body_get_gravity_scale(const fe_world *world, fe_body body, float *out_scale)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_scale);
    *out_scale = world->bodies[index].gravity_scale;
    return FE_OK;
}

// ---- sleep ---------------------------------------------------------------------------------------------------------

static fe_result put_to_sleep(const char *function, fe_world *world, int32_t index, fe_body body)
{
    if (world->bodies[index].awake_index < 0) return FE_OK;
    if (!world->tuning.sleep_enabled)
        return fe__fail(function, FE_ERROR_STATE, "sleep_enabled of the world's tuning is 0");
    fe_result result = fe__put_to_sleep(world, index);
    if (result != FE_ERROR_STATE) return fe__report(function, result);
    return fe__fail(function, result, "body 0x%llx, or one that it touches, is not allowed to sleep now", body);
}

fe_result fe_body_set_awake(fe_world *world, fe_body body, int32_t awake)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_BOOL(awake);
    if (awake)
        fe__body_disturb(world, index);
    else
        FE_TRY(put_to_sleep(function, world, index, body));
    FE_RECORD(body_set_awake, body, awake);
    return FE_OK;
}

fe_result fe_body_get_awake(const fe_world *world, fe_body body, int32_t *out_awake)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_awake);
    *out_awake = world->bodies[index].awake_index >= 0;
    return FE_OK;
}

static void set_flag(fe_world *world, int32_t index, uint32_t flag, int32_t on)
{
    uint32_t *flags = &world->bodies[index].flags;
    *flags = on ? *flags | flag : *flags & ~flag;
}

fe_result fe_body_set_sleep_allowed(fe_world *world, fe_body body, int32_t allowed)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_BOOL(allowed);
    set_flag(world, index, FE__BODY_SLEEP_ALLOWED, allowed);
    if (!allowed) fe__body_disturb(world, index);
    FE_RECORD(body_set_sleep_allowed, body, allowed);
    return FE_OK;
}

fe_result fe_body_get_sleep_allowed(const fe_world *world, fe_body body, int32_t *out_allowed)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_allowed);
    *out_allowed = (world->bodies[index].flags & FE__BODY_SLEEP_ALLOWED) != 0;
    return FE_OK;
}

fe_result fe_body_set_sleep_threshold(fe_world *world, fe_body body, float speed)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_FLOAT(speed, 0.0f, FE_MAX_SPEED);
    world->bodies[index].sleep_threshold = speed;
    FE_RECORD(body_set_sleep_threshold, body, speed);
    return FE_OK;
}

fe_result fe_body_get_sleep_threshold(const fe_world *world, fe_body body, float *out_speed)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_speed);
    *out_speed = world->bodies[index].sleep_threshold;
    return FE_OK;
}

// ---- switches ------------------------------------------------------------------------------------------------------

fe_result fe_body_set_enabled(fe_world *world, fe_body body, int32_t enabled)
{
    FE_WRITE_ALONE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_BOOL(enabled);
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__body_set_enabled(world, index, enabled);
    fe__fp_leave(fp);
    FE_TRY(fe__report(function, result));
    FE_RECORD(body_set_enabled, body, enabled);
    return FE_OK;
}

fe_result fe_body_get_enabled(const fe_world *world, fe_body body, int32_t *out_enabled)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_enabled);
    *out_enabled = (world->bodies[index].flags & FE__BODY_ENABLED) != 0;
    return FE_OK;
}

fe_result fe_body_set_bullet(fe_world *world, fe_body body, int32_t bullet)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_BOOL(bullet);
    set_flag(world, index, FE__BODY_BULLET, bullet);
    world->has_bullets |= bullet;
    FE_RECORD(body_set_bullet, body, bullet);
    return FE_OK;
}

fe_result fe_body_get_bullet(const fe_world *world, fe_body body, int32_t *out_bullet)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_bullet);
    *out_bullet = (world->bodies[index].flags & FE__BODY_BULLET) != 0;
    return FE_OK;
}

fe_result fe_body_set_user_data(fe_world *world, fe_body body, uint64_t user_data)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    world->bodies[index].user_data = user_data;
    FE_RECORD(body_set_user_data, body, user_data);
    return FE_OK;
}

fe_result fe_body_get_user_data(const fe_world *world, fe_body body, uint64_t *out_user_data)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_user_data);
    *out_user_data = world->bodies[index].user_data;
    return FE_OK;
}

// ---- its shapes ----------------------------------------------------------------------------------------------------

fe_result fe_body_set_filter(fe_world *world, fe_body body, uint32_t layer, uint32_t mask, int32_t group)
{
    FE_WRITE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_FILTER(layer);
    if (world->bodies[index].shape_count == 0)
        return fe__fail(function, FE_ERROR_STATE, "body 0x%llx has no shapes to filter", body);
    fe__fp_state fp = fe__fp_enter();
    for (int32_t shape = world->bodies[index].first_shape; shape >= 0; shape = world->shapes[shape].next)
        if (world->shapes[shape].parent < 0) fe__shape_set_filter(world, shape, layer, mask, group);
    fe__fp_leave(fp);
    FE_RECORD(body_set_filter, body, layer, mask, group);
    return FE_OK;
}

fe_result fe_body_get_filter(const fe_world *world, fe_body body, uint32_t *out_layer, uint32_t *out_mask,
                             int32_t *out_group)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_layer);
    FE_CHECK_POINTER(out_mask);
    FE_CHECK_POINTER(out_group);
    int32_t first = world->bodies[index].first_shape;
    if (first < 0) return fe__fail(function, FE_ERROR_STATE, "body 0x%llx has no shapes, hence no filter", body);
    const fe__shape *a = &world->shapes[first];
    for (int32_t shape = a->next; shape >= 0; shape = world->shapes[shape].next) {
        const fe__shape *b = &world->shapes[shape];
        if (a->layer == b->layer && a->mask == b->mask && a->group == b->group) continue;
        return fe__fail(function, FE_ERROR_STATE, "shapes of body 0x%llx have different filters: ask them", body);
    }
    *out_layer = a->layer;
    *out_mask = a->mask;
    *out_group = a->group;
    return FE_OK;
}

// Without the parts of compounds
static int32_t count_shapes(const fe_world *world, int32_t body)
{
    int32_t count = 0;
    for (int32_t shape = world->bodies[body].first_shape; shape >= 0; shape = world->shapes[shape].next)
        count += world->shapes[shape].parent < 0;
    return count;
}

int32_t fe_body_get_shapes(const fe_world *world, fe_body body, fe_shape *out_shapes, int32_t capacity)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_ARRAY(out_shapes, capacity);
    int32_t count = 0, all = world->bodies[index].shape_count;
    if (world->part_count) all = count_shapes(world, index);
    for (int32_t shape = world->bodies[index].first_shape; shape >= 0 && count < capacity;
         shape = world->shapes[shape].next) {
        if (world->shapes[shape].parent < 0) out_shapes[count++] = fe__shape_handle(world, shape);
    }
    return all;
}
