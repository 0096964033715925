// fe_joint_def.c - definitions of joints from points and axes of the world: the present pose is the zero.
#include "api/fe_joint_def.h"

#include "core/fp_state.h"
#include "core/math.h"
#include "world/joint.h"
#include "world/world.h"

// ---- joint at -------------------------------------------------------------------------------------------------------

// ---- frames --------------------------------------------------------------------------------------------------------
typedef struct ends {
    int32_t body[2];
} ends;

// A point of the world in body space; far ones are found where the definition is used
static fe_vec3 into_body(const fe__body *body, const fe_dvec3 *point)
{
    fe_dvec3 arm = {point->x - body->origin[0], point->y - body->origin[1], point->z - body->origin[2]};
    return fe__narrow(fe__drotate_back(fe__body_transform(body).rotation, arm));
}

static fe_frame frame_in(const fe__body *body, const fe_dvec3 *point, fe_quat rotation)
{
    return (fe_frame){into_body(body, point),
                      fe__normalized(fe__product(fe__conjugate(fe__body_transform(body).rotation), rotation))};
}

// The shortest turn from X to a direction: (x cross a, 1 + x . a), normalised; half a turn about Z for -X
static fe_quat turn_to(fe_vec3 axis)
{
    const double opposite = 1e-12; // 1 + cosine below which the turn's axis is lost
    double x = (double)axis.x, y = (double)axis.y, z = (double)axis.z, k = 1.0 / sqrt(x * x + y * y + z * z),
           w = 1.0 + k * x;
    if (w < opposite) return (fe_quat){0.0f, 0.0f, 1.0f, 0.0f};
    double qy = -k * z, qz = k * y, n = 1.0 / sqrt(qy * qy + qz * qz + w * w);
    return (fe_quat){0.0f, (float)(n * qy), (float)(n * qz), (float)(n * w)};
}

// The rotation with Z along `up` made square to X along `axis`; they are not parallel
static fe_quat turn_upright(fe_vec3 axis, fe_vec3 up)
{
    fe_quat first = turn_to(axis);
    fe_dvec3 v = fe__drotate_back(first, fe__widen(up)); // then about X until it has no Y
    double half = 0.5 * fe__atan2(-v.y, v.z), sine, cosine;
    fe__sincos(half, &sine, &cosine);
    return fe__normalized(fe__product(first, (fe_quat){(float)sine, 0.0f, 0.0f, (float)cosine}));
}

// The rotation of a body; the world's is none
static fe_quat rotation_of(const fe_world *world, int32_t body)
{
    return body < 0 ? (fe_quat){0.0f, 0.0f, 0.0f, 1.0f} : fe__body_transform(&world->bodies[body]).rotation;
}

static void set_end(const fe_world *world, int32_t body, const fe_dvec3 *point, fe_quat rotation, fe_body *out_body,
                    fe_frame *out_frame, fe_dvec3 *world_origin)
{
    if (body >= 0) {
        *out_body = fe__body_handle(world, body);
        *out_frame = frame_in(&world->bodies[body], point, rotation);
        return;
    }
    *out_body = 0;
    *out_frame = (fe_frame){{0.0f, 0.0f, 0.0f}, rotation};
    *world_origin = *point;
}

static void set_ends(const fe_world *world, fe_joint_def *front, const ends *e, const fe_dvec3 *point_a,
                     const fe_dvec3 *point_b, fe_quat rotation)
{
    front->world_origin = (fe_dvec3){0.0, 0.0, 0.0};
    set_end(world, e->body[0], point_a, rotation, &front->body_a, &front->frame_a, &front->world_origin);
    set_end(world, e->body[1], point_b, rotation, &front->body_b, &front->frame_b, &front->world_origin);
}

// The caller's definition, as far as both sides know it, into a whole one and back
static fe_result open(const char *function, const fe_world *world, int32_t type, const void *def, fe_body body_a,
                      fe_body body_b, ends *out_ends, fe__joint_any *full)
{
    fe__joint_defaults(type, full);
    FE_TRY(fe__read_struct(function, "def", def, full, fe__joint_fields(type)));
    return fe__find_joint_ends(function, world, body_a, body_b, out_ends->body);
}

static fe_result at_point(const char *function, const fe_world *world, int32_t type, void *def, fe_body body_a,
                          fe_body body_b, const fe_dvec3 *point, const fe_vec3 *axis)
{
    ends e;
    fe__joint_any full;
    FE_TRY(open(function, world, type, def, body_a, body_b, &e, &full));
    FE_CHECK_DVEC3(point, FE_MAX_POSITION);
    if (axis) FE_CHECK_DIRECTION(axis);
    fe__fp_state fp = fe__fp_enter();
    fe_quat rotation = axis ? turn_to(*axis) : rotation_of(world, e.body[0]);
    set_ends(world, &full.common, &e, point, point, rotation);
    fe__fp_leave(fp);
    fe__write_struct(def, &full, full.common.struct_size);
    return FE_OK;
}

// ---- the five types ------------------------------------------------------------------------------------------------
fe_result fe_ball_joint_def_at(const fe_world *world, fe_ball_joint_def *def, fe_body body_a, fe_body body_b,
                               const fe_dvec3 *point, const fe_vec3 *axis)
{
    FE_READ(world);
    FE_CHECK_POINTER(axis);
    return at_point(function, world, FE_JOINT_BALL, def, body_a, body_b, point, axis);
}

fe_result fe_hinge_joint_def_at(const fe_world *world, fe_hinge_joint_def *def, fe_body body_a, fe_body body_b,
                                const fe_dvec3 *point, const fe_vec3 *axis)
{
    FE_READ(world);
    FE_CHECK_POINTER(axis);
    return at_point(function, world, FE_JOINT_HINGE, def, body_a, body_b, point, axis);
}

fe_result fe_fixed_joint_def_at(const fe_world *world, fe_fixed_joint_def *def, fe_body body_a, fe_body body_b,
                                const fe_dvec3 *point)
{
    FE_READ(world);
    return at_point(function, world, FE_JOINT_FIXED, def, body_a, body_b, point, NULL);
}

fe_result fe_configurable_joint_def_at(const fe_world *world, fe_configurable_joint_def *def, fe_body body_a,
                                       fe_body body_b, const fe_dvec3 *point, const fe_vec3 *axis)
{
    FE_READ(world);
    FE_CHECK_POINTER(axis);
    return at_point(function, world, FE_JOINT_CONFIGURABLE, def, body_a, body_b, point, axis);
}

static fe_result between_points(const char *function, const fe_world *world, fe__joint_any *full, const ends *e,
                                const fe_dvec3 *point_a, const fe_dvec3 *point_b)
{
    FE_CHECK_DVEC3(point_a, FE_MAX_POSITION);
    FE_CHECK_DVEC3(point_b, FE_MAX_POSITION);
    fe_dvec3 d = fe__dsub(*point_b, *point_a);
    set_ends(world, &full->common, e, point_a, point_b, rotation_of(world, e->body[0]));
    full->distance.target = full->distance.lower = full->distance.upper = (float)sqrt(fe__ddot(d, d));
    return FE_OK;
}

fe_result fe_distance_joint_def_at(const fe_world *world, fe_distance_joint_def *def, fe_body body_a, fe_body body_b,
                                   const fe_dvec3 *point_a, const fe_dvec3 *point_b)
{
    FE_READ(world);
    ends e;
    fe__joint_any full;
    FE_TRY(open(function, world, FE_JOINT_DISTANCE, def, body_a, body_b, &e, &full));
    fe__fp_state fp = fe__fp_enter();
    fe_result result = between_points(function, world, &full, &e, point_a, point_b);
    fe__fp_leave(fp);
    if (result == FE_OK) fe__write_struct(def, &full, full.common.struct_size);
    return result;
}

// ---- ready-made joints ----------------------------------------------------------------------------------------------
// A definition with the defaults, whatever the caller's holds beyond its size
static fe_result begin_ready(const char *function, const fe_world *world, int32_t type, const void *def, fe_body body_a,
                             fe_body body_b, ends *out_ends, fe__joint_any *full)
{
    FE_TRY(fe__check_struct_size(function, "def", def, fe__joint_fields(type)));
    fe__joint_defaults(type, full);
    return fe__find_joint_ends(function, world, body_a, body_b, out_ends->body);
}

fe_result fe_rope_joint_def_at(const fe_world *world, fe_distance_joint_def *def, fe_body body_a, fe_body body_b,
                               const fe_dvec3 *point_a, const fe_dvec3 *point_b, float max_length)
{
    FE_READ(world);
    ends e;
    fe__joint_any full;
    FE_TRY(begin_ready(function, world, FE_JOINT_DISTANCE, def, body_a, body_b, &e, &full));
    FE_CHECK_FLOAT(max_length, FE_LEAST_LENGTH, FE_MAX_LOCAL);
    fe__fp_state fp = fe__fp_enter();
    fe_result result = between_points(function, world, &full, &e, point_a, point_b);
    fe__fp_leave(fp);
    FE_TRY(result);
    full.distance.lower = 0.0f;
    full.distance.upper = max_length;
    fe__write_struct(def, &full, full.common.struct_size);
    return FE_OK;
}

fe_result fe_slider_joint_def_at(const fe_world *world, fe_configurable_joint_def *def, fe_body body_a, fe_body body_b,
                                 const fe_dvec3 *point, const fe_vec3 *axis)
{
    FE_READ(world);
    ends e;
    fe__joint_any full;
    FE_TRY(begin_ready(function, world, FE_JOINT_CONFIGURABLE, def, body_a, body_b, &e, &full));
    FE_CHECK_DVEC3(point, FE_MAX_POSITION);
    FE_CHECK_DIRECTION(axis);
    fe__fp_state fp = fe__fp_enter();
    set_ends(world, &full.common, &e, point, point, turn_to(*axis));
    fe__fp_leave(fp);
    full.configurable.axes[FE_DOF_LINEAR_X].motion = FE_MOTION_FREE;
    fe__write_struct(def, &full, full.common.struct_size);
    return FE_OK;
}

static int32_t are_parallel(const fe_vec3 *a, const fe_vec3 *b)
{
    const double least = 1e-6; // of the sine squared
    fe_dvec3 x = fe__widen(*a), y = fe__widen(*b), n = fe__dcross(x, y);
    return fe__ddot(n, n) <= least * fe__ddot(x, x) * fe__ddot(y, y);
}

// The mass that a body shows at a frame of its own, along the frame's Z: 1 / (1/m + (r x z) . I^-1 (r x z)), kg; 0
// unless it is dynamic
static float mass_along_z(const fe_world *world, int32_t index, const fe_frame *frame)
{
    if (index < 0) return 0.0f;
    const fe__body *body = &world->bodies[index];
    if (!(body->inverse_mass > 0.0f)) return 0.0f;
    fe_vec3 centre = {body->local_centre[0], body->local_centre[1], body->local_centre[2]};
    fe_vec3 arm = fe__sub(frame->position, centre), z = fe__rotate(frame->rotation, fe__vec3(0.0f, 0.0f, 1.0f));
    fe_quat axes = {body->inertia_axes[0], body->inertia_axes[1], body->inertia_axes[2], body->inertia_axes[3]};
    fe_vec3 m = fe__rotate_back(axes, fe__cross(arm, z));
    return 1.0f / (body->inverse_mass + m.x * m.x / body->inertia[0] + m.y * m.y / body->inertia[1] +
                   m.z * m.z / body->inertia[2]);
}

// In newtons: a spring in hertz would count the wheel's mass, a twentieth of what stands on it, and sag by metres
static void set_suspension(const fe_world *world, const ends *e, const fe_joint_def *front, float hertz,
                           float damping_ratio, fe_joint_axis *axis)
{
    float mass = mass_along_z(world, e->body[0], &front->frame_a), omega = 2.0f * FE_PI * hertz;
    if (mass == 0.0f) mass = mass_along_z(world, e->body[1], &front->frame_b);
    axis->spring = FE_SPRING_STIFFNESS;
    axis->spring_stiffness = fe__minf(mass * omega * omega, FE_MAX_FORCE);
    axis->spring_damping = fe__minf(2.0f * damping_ratio * mass * omega, FE_MAX_FORCE);
}

fe_result fe_wheel_joint_def_at(const fe_world *world, fe_configurable_joint_def *def, fe_body chassis, fe_body wheel,
                                const fe_dvec3 *point, const fe_vec3 *axle, const fe_vec3 *up, float hertz,
                                float damping_ratio, float travel)
{
    FE_READ(world);
    ends e;
    fe__joint_any full;
    FE_TRY(begin_ready(function, world, FE_JOINT_CONFIGURABLE, def, chassis, wheel, &e, &full));
    FE_CHECK_DVEC3(point, FE_MAX_POSITION);
    FE_CHECK_DIRECTION(axle);
    FE_CHECK_DIRECTION(up);
    if (are_parallel(axle, up)) return fe__fail(function, FE_ERROR_ARGUMENT, "axle and up are parallel");
    FE_CHECK_FLOAT(hertz, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(damping_ratio, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(travel, 0.0f, FE_MAX_LOCAL);
    fe__fp_state fp = fe__fp_enter();
    fe_joint_axis *axes = full.configurable.axes;
    set_ends(world, &full.common, &e, point, point, turn_upright(*axle, *up));
    set_suspension(world, &e, &full.common, hertz, damping_ratio, &axes[FE_DOF_LINEAR_Z]);
    fe__fp_leave(fp);
    axes[FE_DOF_ANGULAR_X].motion = FE_MOTION_FREE;
    axes[FE_DOF_LINEAR_Z].motion = FE_MOTION_LIMITED;
    axes[FE_DOF_LINEAR_Z].lower = -travel, axes[FE_DOF_LINEAR_Z].upper = travel;
    fe__write_struct(def, &full, full.common.struct_size);
    return FE_OK;
}

fe_result fe_motor_joint_def_at(const fe_world *world, fe_configurable_joint_def *def, fe_body body_a, fe_body body_b,
                                float hertz, float damping_ratio, float max_force, float max_torque)
{
    FE_READ(world);
    ends e;
    fe__joint_any full;
    FE_TRY(begin_ready(function, world, FE_JOINT_CONFIGURABLE, def, body_a, body_b, &e, &full));
    FE_CHECK_FLOAT(hertz, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(damping_ratio, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(max_force, 0.0f, FE_MAX_FORCE);
    FE_CHECK_FLOAT(max_torque, 0.0f, FE_MAX_FORCE);
    const fe__body *b = &world->bodies[e.body[1] >= 0 ? e.body[1] : e.body[0]];
    fe_dvec3 centre = {b->centre[0], b->centre[1], b->centre[2]};
    fe__fp_state fp = fe__fp_enter();
    set_ends(world, &full.common, &e, &centre, &centre, rotation_of(world, e.body[0]));
    fe__fp_leave(fp);
    for (int k = 0; k < 6; ++k) {
        fe_joint_axis *axis = full.configurable.axes + k;
        axis->motion = FE_MOTION_FREE;
        axis->spring = FE_SPRING_HERTZ;
        axis->spring_hertz = hertz, axis->spring_damping_ratio = damping_ratio;
        axis->spring_max = k < FE_DOF_ANGULAR_X ? max_force : max_torque;
    }
    fe__write_struct(def, &full, full.common.struct_size);
    return FE_OK;
}

// ---- joint def ------------------------------------------------------------------------------------------------------

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
