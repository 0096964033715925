// joint_state.c - how joints stand: frames, coordinates, speeds, errors; and which of them break.
//
// Read from the bodies' poses and velocities as they are, by the API and after the solver.
#include "core/trig.h"
#include "world/joint_parts.h"
#include "step/step.h"

static fe_quat rotation_of(const fe__body *b) { return (fe_quat){b->rotation[0], b->rotation[1], b->rotation[2], b->rotation[3]}; }
static fe_vec3 velocity_of(const fe__body *b) { return fe__vec3(b->velocity[0], b->velocity[1], b->velocity[2]); }
static fe_vec3 spin_of(const fe__body *b) { return fe__vec3(b->spin[0], b->spin[1], b->spin[2]); }

fe_transform fe__joint_frame_now(const fe_world *world, int32_t joint, int32_t side)
{
    const fe__joint_record *r = world->joint_records + joint;
    const fe__body *b = world->bodies + r->body[side];
    fe_dvec3 origin = {b->origin[0], b->origin[1], b->origin[2]};
    return (fe_transform){fe__dadd(origin, fe__drotate(rotation_of(b), fe__widen(r->frame[side].position))),
                          fe__normalized(fe__product(rotation_of(b), r->frame[side].rotation))};
}

// of a body's point, m/s
static fe_vec3 velocity_at(const fe__body *b, fe_dvec3 point)
{
    fe_dvec3 arm = {point.x - b->centre[0], point.y - b->centre[1], point.z - b->centre[2]};
    return fe__add(velocity_of(b), fe__cross(spin_of(b), fe__narrow(arm)));
}

// ---- errors ---------------------------------------------------------------------------------------------------------------------------
static float beyond(const fe__joint_axis *axis, float x) { return fe__maxf(fe__maxf(axis->limit.low - x, x - axis->limit.high), 0.0f); }

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

static float whole_angle(fe_quat q) { return 2.0f * fe__atan2f(sqrtf(q.x * q.x + q.y * q.y + q.z * q.z), fe__absf(q.w)); }

static float angular_error(const fe__joint_frame *f, const fe__joint_axes *axes, const fe__joint_pose *pose, float twist)
{
    float swing = sqrtf(pose->swing_y * pose->swing_y + pose->swing_z * pose->swing_z), error = 0.0f;
    if (f->parts >> FE__PART_FIXED & 1) return whole_angle(pose->q);
    if (f->parts >> FE__PART_HINGE & 1) error = swing;
    if (!axes) return error;
    if (f->parts >> FE__PART_TWIST & 1) error = fe__maxf(error, beyond(axes->axis + FE__AXIS_TWIST, twist));
    if (f->parts >> FE__PART_SWING_Y & 1) error = fe__maxf(error, beyond(axes->axis + FE__AXIS_SWING, pose->swing_y));
    if (f->parts >> FE__PART_SWING_Z & 1) error = fe__maxf(error, beyond(axes->axis + FE__AXIS_SWING + 1, pose->swing_z));
    if (f->parts >> FE__PART_CONE & 1) error = fe__maxf(error, cone_error(axes->axis + FE__AXIS_SWING, pose->swing_y, pose->swing_z));
    return error;
}

// ---- state ----------------------------------------------------------------------------------------------------------------------------
// From the solver's axes back to those of the definition
static void tell_coordinates(int32_t shift, const fe__joint_pose *pose, float twist, fe_joint_state *s)
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
    tell_coordinates(r->shift, &pose, twist, s);
    s->angular_velocity = fe__rotate_back(frame_a.rotation, fe__sub(spin_of(b), spin_of(a)));
    // frame A turns under the moving point: d/dt (R^T x) = R^T (x' - wA x x), x from A's point, is the velocity against A's matter at B's
    // point
    s->linear_velocity = fe__rotate_back(frame_a.rotation, fe__sub(velocity_at(b, frame_b.position), velocity_at(a, frame_b.position)));
    s->length = pose.length;
    s->speed = pose.length > 0.0f ? fe__dot(s->translation, s->linear_velocity) / pose.length : fe__length(s->linear_velocity);
    s->linear_error = linear_error(f, axes, &pose);
    s->angular_error = angular_error(f, axes, &pose, twist);
    if (r->type != FE_JOINT_FIXED) return; // whose springs hold too
    s->linear_error = pose.length;
    s->angular_error = whole_angle(pose.q);
}

// ---- breaking -------------------------------------------------------------------------------------------------------------------------
static int32_t exceeds(fe_vec3 a, float most) { return most > 0.0f && fe__dot(a, a) > most * most; }

// Reads the step's reactions; writes events in the order of creation, then removes the joints in that order
void fe__break_joints(fe__step *step)
{
    fe_world *w = step->world;
    fe__sort_item *items = step->scratch->sort_items;
    int32_t count = 0;
    w->joint_event_count = 0;
    if (!w->breakable_count || step->dt == 0.0f) return;
    for (int32_t i = 0; i < w->awake_joint_count; ++i) {
        int32_t joint = w->awake_joints[i];
        const fe__joint_record *r = w->joint_records + joint;
        if (w->joints.joints[joint].colour < 0 || (r->break_force == 0.0f && r->break_torque == 0.0f)) continue;
        fe_vec3 force, torque;
        fe__joint_reaction_of(&w->joints, w->bodies, joint, &force, &torque);
        if (exceeds(force, r->break_force) || exceeds(torque, r->break_torque))
            items[count++] = (fe__sort_item){w->joints.frames[joint].serial, joint, 0};
    }
    fe__sort_keys(items, count, items + count);
    w->joint_event_count = count;
    for (int32_t i = 0; i < count; ++i) {
        int32_t joint = items[i].value;
        const fe__joint_record *r = w->joint_records + joint;
        fe_joint_event e = {fe__joint_handle(w, joint),
                            fe__body_handle(w, r->body[0]),
                            fe__body_handle(w, r->body[1]),
                            r->user_data,
                            FE_BREAK,
                            r->type,
                            {0, 0, 0},
                            {0, 0, 0}};
        fe__joint_reaction_of(&w->joints, w->bodies, joint, &e.force, &e.torque);
        w->joint_events[i] = (fe__joint_event_record){items[i].key, e};
    }
    for (int32_t i = 0; i < count; ++i) fe__joint_destroy(w, items[i].value);
}
