// joint_at.c - definitions of joints from points and axes of the world: the present pose is the zero.
#include "api/joint_def.h"
#include "core/trig.h"
#include "core/fp_state.h"
#include "world/handles.h"

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
