// joint_state.c - see joint_state.h.
#include "world/joint_state.h"

#include "core/trig.h"
#include "world/joint_parts.h"
#include "world/pose.h"

static fe_vec3 spin_of(const fe__body *b) { return fe__quad_vector(b->spin); }

fe_transform fe__joint_frame_now(const fe_world *world, int32_t joint, int32_t side)
{
    const fe__joint_record *r = world->joint_records + joint;
    const fe__body *b = world->bodies + r->body[side];
    return (
        fe_transform){fe__dadd(fe__origin_of(b), fe__drotate(fe__rotation_of(b), fe__widen(r->frame[side].position))),
                      fe__normalized(fe__product(fe__rotation_of(b), r->frame[side].rotation))};
}

// of a body's point, m/s
static fe_vec3 velocity_at(const fe__body *b, fe_dvec3 point)
{
    return fe__add(fe__quad_vector(b->velocity), fe__cross(spin_of(b), fe__narrow(fe__dsub(point, fe__centre_of(b)))));
}

// ---- errors --------------------------------------------------------------------------------------------------------
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

// ---- state ---------------------------------------------------------------------------------------------------------
// From the solver's axes back to those of the definition
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
    if (r->type != FE_JOINT_FIXED) return; // whose springs hold too
    s->linear_error = pose.length;
    s->angular_error = whole_angle(pose.q);
}
