// joint_parts.c - the parts of each type of joint: locks, limits, drives and motors, as the solver knows them
// (solver/joint/joint_solver.h).
//
// Called when a joint is made or changed, with a checked definition. Targets are clamped to the limits here, so that no
// drive presses on a stop for good.
#include "world/joint_parts.h"

#include "core/math.h"
#include "world/body.h"
#include "world/joint.h"

// The longest range that a definition can ask for, m: no limit
#define MOST_DISTANCE 1e6f

static uint32_t bit(fe__joint_part part) { return 1u << part; }

// ---- one axis -------------------------------------------------------------------------------------------------------

static void set_limit(fe__joint_axis *axis, float low, float high, float hertz, float damping_ratio)
{
    axis->limit.low = low, axis->limit.high = high, axis->limit.hertz = hertz,
    axis->limit.damping_ratio = damping_ratio;
}

static void set_unlimited(fe__joint_axis *axis) { set_limit(axis, -FE__UNLIMITED, FE__UNLIMITED, 0.0f, 0.0f); }

static void set_drive(fe__joint_axis *axis, float target, float stiffness, float damping, float cap, int32_t unit)
{
    axis->drive.target = fe__clampf(target, axis->limit.low, axis->limit.high);
    axis->drive.stiffness = stiffness, axis->drive.damping = damping, axis->drive.cap = cap;
    axis->motor.drive_unit = (float)unit;
}

static void set_motor(fe__joint_axis *axis, float speed, float cap)
{
    axis->motor.speed = speed, axis->motor.cap = cap;
}

// ---- distance, hinge, fixed -----------------------------------------------------------------------------------------

static void plan_distance(const fe_distance_joint_def *d, fe__joint_plan *plan)
{
    fe__joint_axis *axis = plan->axes.axis + FE__AXIS_LINEAR;
    plan->parts = bit(FE__PART_DISTANCE);
    set_limit(axis, d->limit_enabled ? d->lower : 0.0f, d->limit_enabled ? d->upper : MOST_DISTANCE, d->hertz,
              d->damping_ratio);
    if (d->spring_hertz > 0.0f)
        set_drive(axis, d->target, d->spring_hertz, d->spring_damping_ratio, d->spring_max, FE__DRIVE_HERTZ);
    set_motor(axis, d->motor_speed, d->motor_max);
}

static void plan_point(fe__joint_plan *plan)
{
    plan->parts |= bit(FE__PART_POINT);
    plan->locked = FE__LOCK_X | FE__LOCK_Y | FE__LOCK_Z;
}

static void plan_hinge(const fe_hinge_joint_def *d, fe__joint_plan *plan)
{
    fe__joint_axis *axis = plan->axes.axis + FE__AXIS_TWIST;
    plan_point(plan);
    plan->parts |= bit(FE__PART_HINGE);
    if (!d->limit_enabled && d->spring_hertz == 0.0f && d->motor_max == 0.0f) return;
    plan->parts |= bit(FE__PART_TWIST);
    set_unlimited(axis);
    if (d->limit_enabled) set_limit(axis, d->lower, d->upper, d->limit_hertz, d->limit_damping_ratio);
    if (d->spring_hertz > 0.0f)
        set_drive(axis, d->target, d->spring_hertz, d->spring_damping_ratio, d->spring_max, FE__DRIVE_HERTZ);
    set_motor(axis, d->motor_speed, d->motor_max);
}

// A soft fixed joint is a spring: drives along the axes, and a drive towards no rotation.
static void plan_fixed(const fe_fixed_joint_def *d, fe__joint_plan *plan)
{
    plan->hertz = plan->damping_ratio = 0.0f;
    if (d->hertz == 0.0f) plan_point(plan);
    for (int k = 0; k < 3 && d->hertz > 0.0f; ++k) {
        plan->parts |= bit((fe__joint_part)(FE__PART_X + k));
        set_unlimited(plan->axes.axis + k);
        set_drive(plan->axes.axis + k, 0.0f, d->hertz, d->damping_ratio, FE__UNLIMITED, FE__DRIVE_HERTZ);
    }
    if (d->angular_hertz == 0.0f) {
        plan->parts |= bit(FE__PART_FIXED);
        return;
    }
    fe__joint_rotation *rotation = &plan->axes.rotation;
    plan->parts |= bit(FE__PART_ROTATION);
    rotation->target[3] = 1.0f;
    rotation->drive.stiffness = d->angular_hertz, rotation->drive.damping = d->angular_damping_ratio,
    rotation->drive.cap = FE__UNLIMITED, rotation->drive.unit = FE__DRIVE_HERTZ;
}

// ---- ball -----------------------------------------------------------------------------------------------------------

typedef struct angles {
    float twist, swing_y, swing_z; // rad
} angles;

// q = swing twist, see solver/joint/joint_solver.h
static fe_quat rotation_of(angles a)
{
    float length = sqrtf(a.swing_y * a.swing_y + a.swing_z * a.swing_z), sine, cosine, k, c;
    fe__sincosf(0.5f * a.twist, &sine, &cosine);
    fe__sincosf(0.5f * length, &k, &c);
    k = length > 0.0f ? k / length : 0.0f;
    return fe__product((fe_quat){0.0f, k * a.swing_y, k * a.swing_z, c}, (fe_quat){sine, 0.0f, 0.0f, cosine});
}

void fe__joint_angles(fe_quat q, float *out_twist, float *out_swing_y, float *out_swing_z)
{
    if (q.w < 0.0f) q = (fe_quat){-q.x, -q.y, -q.z, -q.w};
    float n = sqrtf(q.w * q.w + q.x * q.x), sine = sqrtf(q.y * q.y + q.z * q.z), angle = 2.0f * fe__atan2f(sine, n);
    float y = n > 0.0f ? q.w * q.y - q.x * q.z : q.y, z = n > 0.0f ? q.w * q.z + q.x * q.y : q.z,
          length = sqrtf(y * y + z * z);
    float k = length > 0.0f ? angle / length : 0.0f;
    *out_twist = 2.0f * fe__atan2f(q.x, q.w), *out_swing_y = k * y, *out_swing_z = k * z;
}

fe_quat fe__joint_shift(int32_t shift)
{
    static const fe_quat turns[3] = {{0.0f, 0.0f, 0.0f, 1.0f}, {0.5f, 0.5f, 0.5f, 0.5f}, {-0.5f, -0.5f, -0.5f, 0.5f}};
    return turns[shift];
}

static void set_target(fe__joint_rotation *rotation, fe_quat q)
{
    rotation->target[0] = q.x, rotation->target[1] = q.y, rotation->target[2] = q.z, rotation->target[3] = q.w;
}

// The target within cone and range: a swing too wide comes back along its own direction
static fe_quat clamped_target(const fe_ball_joint_def *d)
{
    fe_quat q = fe__normalized(d->target);
    angles a;
    fe__joint_angles(q, &a.twist, &a.swing_y, &a.swing_z);
    float y = a.swing_y / d->cone_y, z = a.swing_z / d->cone_z, out = y * y + z * z;
    int32_t twists = d->limit_enabled && (a.twist < d->lower || a.twist > d->upper),
            swings = d->cone_enabled && out > 1.0f;
    if (!twists && !swings) return q;
    if (twists) a.twist = fe__clampf(a.twist, d->lower, d->upper);
    if (swings) a.swing_y /= sqrtf(out), a.swing_z /= sqrtf(out);
    return rotation_of(a);
}

static void plan_ball(const fe_ball_joint_def *d, fe__joint_plan *plan)
{
    plan_point(plan);
    if (d->cone_enabled) {
        plan->parts |= bit(FE__PART_CONE);
        set_limit(plan->axes.axis + FE__AXIS_SWING, d->cone_y, d->cone_z, d->limit_hertz, d->limit_damping_ratio);
    }
    if (d->limit_enabled) {
        plan->parts |= bit(FE__PART_TWIST);
        set_limit(plan->axes.axis + FE__AXIS_TWIST, d->lower, d->upper, d->limit_hertz, d->limit_damping_ratio);
    }
    if (d->spring_hertz == 0.0f && d->motor_max == 0.0f) return;
    fe__joint_rotation *rotation = &plan->axes.rotation;
    plan->parts |= bit(FE__PART_ROTATION);
    set_target(rotation, clamped_target(d));
    if (d->spring_hertz > 0.0f)
        rotation->drive.stiffness = d->spring_hertz, rotation->drive.damping = d->spring_damping_ratio,
        rotation->drive.cap = d->spring_max, rotation->drive.unit = FE__DRIVE_HERTZ;
    rotation->motor.velocity[0] = d->motor_velocity.x, rotation->motor.velocity[1] = d->motor_velocity.y,
    rotation->motor.velocity[2] = d->motor_velocity.z;
    rotation->motor.cap = d->motor_max;
}

// ---- configurable ---------------------------------------------------------------------------------------------------

// Stiffness and damping are in the unit of the axis's spring.
static float stiffness_of(const fe_joint_axis *a)
{
    return a->spring == FE_SPRING_STIFFNESS ? a->spring_stiffness : a->spring_hertz;
}
static float damping_of(const fe_joint_axis *a)
{
    return a->spring == FE_SPRING_STIFFNESS ? a->spring_damping : a->spring_damping_ratio;
}
static int32_t drives(const fe_joint_axis *a)
{
    return a->spring != FE_SPRING_NONE && (stiffness_of(a) > 0.0f || damping_of(a) > 0.0f);
}

// Plans limits, drive and motor of an axis that is not locked. 0: it has none
static int32_t plan_axis(const fe_joint_axis *a, fe__joint_axis *axis)
{
    if (a->motion == FE_MOTION_FREE && !drives(a) && a->motor_max == 0.0f) return 0;
    set_unlimited(axis);
    if (a->motion == FE_MOTION_LIMITED) set_limit(axis, a->lower, a->upper, a->limit_hertz, a->limit_damping_ratio);
    int32_t unit = a->spring == FE_SPRING_STIFFNESS ? FE__DRIVE_STIFFNESS : FE__DRIVE_HERTZ;
    if (drives(a)) set_drive(axis, a->target, stiffness_of(a), damping_of(a), a->spring_max, unit);
    set_motor(axis, a->motor_speed, a->motor_max);
    return 1;
}

// Plans one drive for three free rotations that are driven alike, because large angles about three axes do not add up.
// 0: they are not alike
static int32_t plan_turn(const fe_joint_axis *a, fe__joint_plan *plan)
{
    for (int k = 0; k < 3; ++k) {
        int32_t alike = a[k].spring == a[0].spring && stiffness_of(a + k) == stiffness_of(a) &&
                        damping_of(a + k) == damping_of(a) && a[k].spring_max == a[0].spring_max &&
                        a[k].motor_max == a[0].motor_max;
        if (a[k].motion != FE_MOTION_FREE || !alike) return 0;
    }
    if (!drives(a) && a->motor_max == 0.0f) return 0;
    fe__joint_rotation *rotation = &plan->axes.rotation;
    plan->parts |= bit(FE__PART_ROTATION);
    set_target(rotation, rotation_of((angles){a[0].target, a[1].target, a[2].target}));
    if (drives(a)) {
        rotation->drive.stiffness = stiffness_of(a), rotation->drive.damping = damping_of(a),
        rotation->drive.cap = a->spring_max;
        rotation->drive.unit = a->spring == FE_SPRING_STIFFNESS ? FE__DRIVE_STIFFNESS : FE__DRIVE_HERTZ;
    }
    for (int k = 0; k < 3; ++k) rotation->motor.velocity[k] = a[k].motor_speed;
    rotation->motor.cap = a->motor_max;
    return 1;
}

static int32_t is_locked(const fe_joint_axis *a) { return a->motion == FE_MOTION_LOCKED; }

// If a rotation is locked, q loses its meaning at half a turn of swing: a cardan joint cannot pass it. Free swings end
// before, at 170 degrees.
#define MOST_SWING 2.967f
#define MOST_CARDAN 2.4f         // with a locked twist, whose gradient grows as 1 / cos(swing / 2)
#define MOST_SWING_OF_TWO 1.697f // for each of two ranges: sqrt(2) times it is MOST_CARDAN

static void bound_swings(const fe_joint_axis *about, fe__joint_plan *plan)
{
    fe__joint_axis *y = plan->axes.axis + FE__AXIS_SWING, *z = y + 1;
    int32_t has_y = plan->parts >> FE__PART_SWING_Y & 1, has_z = plan->parts >> FE__PART_SWING_Z & 1;
    if (is_locked(about) && !has_y && !has_z) {
        set_limit(y, MOST_CARDAN, MOST_CARDAN, 0.0f, 0.0f);
        plan->parts |= bit(FE__PART_CONE);
        return;
    }
    float most = is_locked(about) ? MOST_SWING_OF_TWO : MOST_SWING;
    for (int k = 1; k < 3; ++k) {
        fe__joint_axis *axis = k == 1 ? y : z;
        if (is_locked(about + k)) continue;
        if (!(k == 1 ? has_y : has_z)) set_unlimited(axis);
        axis->limit.low = fe__maxf(axis->limit.low, -most), axis->limit.high = fe__minf(axis->limit.high, most);
        plan->parts |= bit(k == 1 ? FE__PART_SWING_Y : FE__PART_SWING_Z);
    }
}

static void plan_rotations(const fe_configurable_joint_def *d, const fe_joint_axis *about, fe__joint_plan *plan)
{
    static const fe__joint_part parts[3] = {FE__PART_TWIST, FE__PART_SWING_Y, FE__PART_SWING_Z};
    int32_t locked = is_locked(about) + is_locked(about + 1) + is_locked(about + 2),
            hinge = is_locked(about + 1) && is_locked(about + 2);
    if (locked == 3) {
        plan->parts |= bit(FE__PART_FIXED);
        return;
    }
    if (plan_turn(about, plan)) return;
    if (hinge) plan->parts |= bit(FE__PART_HINGE);
    for (int k = 0; k < 3; ++k) {
        fe__joint_axis *axis = plan->axes.axis + FE__AXIS_TWIST + k;
        if (is_locked(about + k) && hinge) continue;
        if (is_locked(about + k)) set_limit(axis, 0.0f, 0.0f, d->hertz, d->damping_ratio);
        if (is_locked(about + k) || plan_axis(about + k, axis)) plan->parts |= bit(parts[k]);
    }
    if (locked && !hinge) bound_swings(about, plan);
}

// The one rotation that is not locked becomes the twist, which any number of turns leaves well defined: the joint's
// axes move up by `shift`
static int32_t shift_of(const fe_configurable_joint_def *d)
{
    const fe_joint_axis *about = d->axes + FE_DOF_ANGULAR_X;
    for (int k = 1; k < 3; ++k)
        if (!is_locked(about + k) && is_locked(about) && is_locked(about + 3 - k)) return k;
    return 0;
}

static void plan_configurable(const fe_configurable_joint_def *d, fe__joint_plan *plan)
{
    static const fe__joint_part parts[3] = {FE__PART_X, FE__PART_Y, FE__PART_Z};
    static const uint32_t locks[3] = {FE__LOCK_X, FE__LOCK_Y, FE__LOCK_Z};
    fe_joint_axis along[3], about[3];
    plan->shift = shift_of(d);
    for (int k = 0; k < 3; ++k)
        along[k] = d->axes[(k + plan->shift) % 3], about[k] = d->axes[FE_DOF_ANGULAR_X + (k + plan->shift) % 3];
    for (int k = 0; k < 3; ++k) {
        if (is_locked(along + k))
            plan->locked |= locks[k];
        else if (plan_axis(along + k, plan->axes.axis + FE__AXIS_LINEAR + k))
            plan->parts |= bit(parts[k]);
    }
    if (plan->locked == (FE__LOCK_X | FE__LOCK_Y | FE__LOCK_Z))
        plan->parts |= bit(FE__PART_POINT);
    else if (plan->locked)
        plan->parts |= bit(FE__PART_SLIDE);
    plan_rotations(d, about, plan);
}

// ---- plan -----------------------------------------------------------------------------------------------------------

void fe__joint_make_plan(int32_t type, const fe__joint_any *def, fe__joint_plan *out_plan)
{
    *out_plan = (fe__joint_plan){.hertz = def->common.hertz, .damping_ratio = def->common.damping_ratio};
    switch (type) {
    case FE_JOINT_DISTANCE:
        plan_distance(&def->distance, out_plan);
        break;
    case FE_JOINT_BALL:
        plan_ball(&def->ball, out_plan);
        break;
    case FE_JOINT_HINGE:
        plan_hinge(&def->hinge, out_plan);
        break;
    case FE_JOINT_FIXED:
        plan_fixed(&def->fixed, out_plan);
        break;
    default:
        plan_configurable(&def->configurable, out_plan);
        break;
    }
}

fe__joint_part fe__joint_part_at(uint32_t parts, int32_t place)
{
    static const fe__joint_part plain[FE__AXES] = {FE__PART_X,     FE__PART_Y,       FE__PART_Z,
                                                   FE__PART_TWIST, FE__PART_SWING_Y, FE__PART_SWING_Z};
    if (parts >> plain[place] & 1) return plain[place];
    if (place == FE__AXIS_LINEAR && parts >> FE__PART_DISTANCE & 1) return FE__PART_DISTANCE;
    if (place == FE__AXIS_SWING && parts >> FE__PART_CONE & 1) return FE__PART_CONE;
    return FE__PARTS;
}

// ---- joint state ----------------------------------------------------------------------------------------------------

static fe_vec3 spin_of(const fe__body *b) { return fe__quad_vector(b->spin); }

fe_transform fe__joint_frame_now(const fe_world *world, int32_t joint, int32_t side)
{
    const fe__joint_record *r = world->joint_records + joint;
    const fe__body *b = world->bodies + r->body[side];
    return (
        fe_transform){fe__dadd(fe__origin_of(b), fe__drotate(fe__rotation_of(b), fe__widen(r->frame[side].position))),
                      fe__normalized(fe__product(fe__rotation_of(b), r->frame[side].rotation))};
}

// The velocity of a body's point, m/s
static fe_vec3 velocity_at(const fe__body *b, fe_dvec3 point)
{
    return fe__add(fe__quad_vector(b->velocity), fe__cross(spin_of(b), fe__narrow(fe__dsub(point, fe__centre_of(b)))));
}

// How far x is beyond the limits of an axis
static float beyond(const fe__joint_axis *axis, float x)
{
    return fe__maxf(fe__maxf(axis->limit.low - x, x - axis->limit.high), 0.0f);
}

static float linear_error(const fe__joint_frame *f, const fe__joint_axes *axes, const fe__joint_pose *pose)
{
    const float d[3] = {pose->d.x, pose->d.y, pose->d.z};
    float square = 0.0f;
    for (int k = 0; k < 3; ++k) {
        float error = f->locked >> k & 1 ? d[k] : 0.0f;
        if (f->parts >> (FE__PART_X + k) & 1) error = beyond(axes->axis + FE__AXIS_LINEAR + k, d[k]);
        square += error * error;
    }
    if (f->parts >> FE__PART_DISTANCE & 1) return beyond(axes->axis + FE__AXIS_LINEAR, pose->length);
    return sqrtf(square);
}

static float cone_error(const fe__joint_axis *axis, float y, float z)
{
    float a = y / axis->limit.low, b = z / axis->limit.high, out = sqrtf(a * a + b * b);
    return out > 1.0f ? sqrtf(y * y + z * z) * (1.0f - 1.0f / out) : 0.0f;
}

static float whole_angle(fe_quat q)
{
    return 2.0f * fe__atan2f(sqrtf(q.x * q.x + q.y * q.y + q.z * q.z), fe__absf(q.w));
}

static float angular_error(const fe__joint_frame *f, const fe__joint_axes *axes, const fe__joint_pose *pose,
                           float twist)
{
    float swing = sqrtf(pose->swing_y * pose->swing_y + pose->swing_z * pose->swing_z), error = 0.0f;
    if (f->parts >> FE__PART_FIXED & 1) return whole_angle(pose->q);
    if (f->parts >> FE__PART_HINGE & 1) error = swing;
    if (!axes) return error;
    if (f->parts >> FE__PART_TWIST & 1) error = fe__maxf(error, beyond(axes->axis + FE__AXIS_TWIST, twist));
    if (f->parts >> FE__PART_SWING_Y & 1) error = fe__maxf(error, beyond(axes->axis + FE__AXIS_SWING, pose->swing_y));
    if (f->parts >> FE__PART_SWING_Z & 1)
        error = fe__maxf(error, beyond(axes->axis + FE__AXIS_SWING + 1, pose->swing_z));
    if (f->parts >> FE__PART_CONE & 1)
        error = fe__maxf(error, cone_error(axes->axis + FE__AXIS_SWING, pose->swing_y, pose->swing_z));
    return error;
}

// Turns coordinates from the solver's axes back to those of the definition.
static void write_coordinates(int32_t shift, const fe__joint_pose *pose, float twist, fe_joint_state *s)
{
    fe_quat to = fe__joint_shift(shift), q = fe__product(fe__product(to, pose->q), fe__conjugate(to));
    const float d[3] = {pose->d.x, pose->d.y, pose->d.z};
    s->translation = fe__vec3(d[(3 - shift) % 3], d[(4 - shift) % 3], d[(5 - shift) % 3]);
    s->angle = twist, s->swing_y = pose->swing_y, s->swing_z = pose->swing_z;
    if (!shift) return;
    fe__joint_angles(q, &s->angle, &s->swing_y, &s->swing_z);
    *(shift == 1 ? &s->swing_y : &s->swing_z) = twist;
}

void fe__joint_state_of(const fe_world *world, int32_t joint, fe_joint_state *s)
{
    const fe__joint_record *r = world->joint_records + joint;
    const fe__joint_frame *f = world->joints.frames + joint;
    const fe__joint_axes *axes = f->axes ? world->joints.axes + f->axes : NULL;
    const fe__body *a = world->bodies + r->body[0], *b = world->bodies + r->body[1];
    fe_transform frame_a = fe__joint_frame_now(world, joint, 0), frame_b = fe__joint_frame_now(world, joint, 1);
    fe__joint_pose pose;
    fe__joint_pose_of(&world->joints, world->bodies, joint, &pose);
    float twist = pose.twist;
    if (f->parts >> FE__PART_TWIST & 1) twist = fe__joint_wind(pose.twist, axes->axis[FE__AXIS_TWIST].state.x);
    write_coordinates(r->shift, &pose, twist, s);
    s->angular_velocity = fe__rotate_back(frame_a.rotation, fe__sub(spin_of(b), spin_of(a)));
    // frame A turns under the moving point: d/dt (R^T x) = R^T (x' - wA x x), x from A's point, is the velocity against
    // A's matter at B's point
    s->linear_velocity =
        fe__rotate_back(frame_a.rotation, fe__sub(velocity_at(b, frame_b.position), velocity_at(a, frame_b.position)));
    s->length = pose.length;
    s->speed =
        pose.length > 0.0f ? fe__dot(s->translation, s->linear_velocity) / pose.length : fe__length(s->linear_velocity);
    s->linear_error = linear_error(f, axes, &pose);
    s->angular_error = angular_error(f, axes, &pose, twist);
    if (r->type != FE_JOINT_FIXED) return; // the springs of a fixed joint count as locks
    s->linear_error = pose.length;
    s->angular_error = whole_angle(pose.q);
}
