// joint_solver.c - joints in and out of the constraint graph, and what is read of them from the poses.
#include "solver/joint/joint_solver.h"

#include "core/math.h"

#include <assert.h>
#include <string.h>

// ---- the graph ------------------------------------------------------------------------------------------------------
static const uint32_t all_colours = (1u << FE__JOINT_COLOURS) - 1u, all_parts = (1u << FE__PARTS) - 1u;

static uint32_t sides_of(const fe__joint *j) { return j->rows >> FE__SIDES_SHIFT; }

// A plain point is the fast kind of row: the world's softness, no locked body. SLIDE takes the others.
static uint32_t rows_of(const fe__joint *j, const fe__joint_frame *f, const fe__body *a, const fe__body *b)
{
    uint32_t rows = f->parts, point = 1u << FE__PART_POINT, sides = 0;
    if (rows & point && (a->locked || b->locked || j->hertz > 0.0f)) rows = (rows & ~point) | 1u << FE__PART_SLIDE;
    if (a->type == FE_BODY_DYNAMIC) sides |= FE__MOVES_A;
    if (b->type == FE_BODY_DYNAMIC) sides |= FE__MOVES_B;
    if (a->type == FE_BODY_KINEMATIC || b->type == FE_BODY_KINEMATIC) sides |= FE__KINEMATIC_END;
    return rows | sides << FE__SIDES_SHIFT;
}

// the dynamic ends of a linked joint
static int32_t dynamic_ends(const fe__joint *j, fe__body *bodies, fe__body **ends)
{
    int32_t count = 0;
    if (sides_of(j) & FE__MOVES_A) ends[count++] = bodies + j->body_a;
    if (sides_of(j) & FE__MOVES_B) ends[count++] = bodies + j->body_b;
    return count;
}

static void count_joint(fe__joints *joints, const fe__joint *j, int32_t sign)
{
    joints->forest.changed = 1;
    joints->linked += sign;
    joints->rows += sign * __builtin_popcount(j->rows & all_parts);
    joints->kinematic += sides_of(j) & FE__KINEMATIC_END ? sign : 0;
    joints->overflowing += j->colour == FE__JOINT_OVERFLOW ? sign : 0;
}

void fe__joint_link(fe__joints *joints, fe__body *bodies, int32_t joint)
{
    fe__joint *j = joints->joints + joint;
    const fe__joint_frame *f = joints->frames + joint;
    fe__body *ends[2];
    uint32_t before = j->rows & all_parts, taken = 0;
    assert(j->colour < 0 && j->body_a != j->body_b);
    j->rows = rows_of(j, f, bodies + j->body_a, bodies + j->body_b);
    if (before != (j->rows & all_parts)) fe__joint_forget_impulses(joints, joint); // they may be in other axes now
    int32_t count = dynamic_ends(j, bodies, ends);
    assert(count);
    for (int32_t k = 0; k < count; ++k) taken |= ends[k]->joint_colours;
    j->colour = ~taken & all_colours ? __builtin_ctz(~taken & all_colours) : FE__JOINT_OVERFLOW;
    for (int32_t k = 0; k < count; ++k) {
        joints->most = fe__maxi(joints->most, ++ends[k]->joint_count);
        if (j->colour != FE__JOINT_OVERFLOW) ends[k]->joint_colours |= 1u << j->colour;
    }
    count_joint(joints, j, 1);
    joints->row_kinds |= j->rows & all_parts;
}

int32_t fe__joint_relink(fe__joints *joints, fe__body *bodies, int32_t joint)
{
    fe__joint *j = joints->joints + joint;
    fe__body *ends[2];
    if (j->rows != rows_of(j, joints->frames + joint, bodies + j->body_a, bodies + j->body_b)) return 0;
    int32_t count = dynamic_ends(j, bodies, ends);
    for (int32_t k = 0; k < count; ++k) {
        uint32_t colour = j->colour == FE__JOINT_OVERFLOW ? 0 : 1u << j->colour;
        if (ends[k]->joint_colours & colour) return 0;
        ends[k]->joint_colours |= colour;
        joints->most = fe__maxi(joints->most, fe__maxi(++ends[k]->joint_count, j->colour));
    }
    count_joint(joints, j, 1);
    joints->row_kinds |= j->rows & all_parts;
    return 1;
}

void fe__joint_unlink(fe__joints *joints, fe__body *bodies, int32_t joint)
{
    fe__joint *j = joints->joints + joint;
    fe__body *ends[2];
    if (j->colour < 0) return;
    int32_t count = dynamic_ends(j, bodies, ends);
    for (int32_t k = 0; k < count; ++k) {
        --ends[k]->joint_count;
        if (j->colour != FE__JOINT_OVERFLOW) ends[k]->joint_colours &= ~(1u << j->colour);
    }
    count_joint(joints, j, -1);
    j->colour = -1;
}

void fe__joint_forget_impulses(fe__joints *joints, int32_t joint)
{
    fe__joint *j = joints->joints + joint;
    fe__joint_frame *f = joints->frames + joint;
    memset(j->impulse, 0, sizeof j->impulse);
    memset(f->impulse, 0, sizeof f->impulse);
    memset(joints->reactions + joint, 0, sizeof *joints->reactions);
    if (!f->axes) return;
    fe__joint_axes *axes = joints->axes + f->axes;
    for (int k = 0; k < FE__AXES; ++k) {
        memset(&axes->axis[k].impulse, 0, sizeof axes->axis[k].impulse);
        axes->axis[k].state.force = 0.0f;
    }
    memset(axes->rotation.impulse, 0, sizeof axes->rotation.impulse);
    memset(axes->rotation.motor_impulse, 0, sizeof axes->rotation.motor_impulse);
    memset(axes->rotation.torque, 0, sizeof axes->rotation.torque);
}

// ---- readings -------------------------------------------------------------------------------------------------------
static fe_quat quat_of(const float *q) { return (fe_quat){q[0], q[1], q[2], q[3]}; }
static fe_vec3 vec_of(const float *a) { return fe__vec3(a[0], a[1], a[2]); }

// body's anchor, m, world
static fe_dvec3 anchor_of(const fe__body *body, const float *arm)
{
    return fe__dadd((fe_dvec3){body->centre[0], body->centre[1], body->centre[2]},
                    fe__drotate(quat_of(body->rotation), fe__widen(vec_of(arm))));
}

fe_dvec3 fe__joint_gap(const fe__joint *joint, const fe__body *bodies)
{
    return fe__dsub(anchor_of(bodies + joint->body_b, joint->arm_b), anchor_of(bodies + joint->body_a, joint->arm_a));
}

// the swing of q as e sin(angle / 2), cos(angle / 2) with a unit e = (0, y, z)
typedef struct swing {
    float y, z; // of e; Y where there is no swing
    float sine, cosine;
    float angle; // 0 .. pi
} swing;

static swing swing_of(fe_quat q)
{
    float n = sqrtf(q.w * q.w + q.x * q.x), y = q.w * q.y - q.x * q.z, z = q.w * q.z + q.x * q.y,
          length = sqrtf(y * y + z * z);
    swing s = {1.0f, 0.0f, 0.0f, n, 0.0f};
    // a swing of 180 degrees: the twist before it is undefined
    if (n == 0.0f) y = q.y, z = q.z, length = sqrtf(y * y + z * z);
    if (length > 0.0f) s.y = y / length, s.z = z / length;
    s.sine = sqrtf(q.y * q.y + q.z * q.z);
    s.angle = 2.0f * fe__atan2f(s.sine, n);
    return s;
}

// A swing of 180 degrees, where y cot y is infinite, is kept away from by this cosine of half the angle
#define LEAST_COSINE 0.02f
// below this cosine of half the swing (168 degrees) the twist is undefined
#define TWIST_DEFINED 0.1f

static fe_quat positive(fe_quat q) { return q.w < 0.0f ? (fe_quat){-q.x, -q.y, -q.z, -q.w} : q; }

void fe__joint_pose_of(const fe__joints *joints, const fe__body *bodies, int32_t joint, fe__joint_pose *out_pose)
{
    const fe__joint *j = joints->joints + joint;
    const fe__joint_frame *f = joints->frames + joint;
    const fe__body *a = bodies + j->body_a, *b = bodies + j->body_b;
    fe_quat frame_a = fe__product(quat_of(a->rotation), quat_of(f->frame_a)),
            frame_b = fe__product(quat_of(b->rotation), quat_of(f->frame_b));
    fe_dvec3 d = fe__joint_gap(j, bodies);
    fe_quat q = positive(fe__product(fe__conjugate(frame_a), frame_b));
    swing s = swing_of(q);
    *out_pose = (fe__joint_pose){.q = q,
                                 .d = fe__narrow(fe__drotate_back(frame_a, d)),
                                 .length = (float)sqrt(fe__ddot(d, d)),
                                 .twist = 2.0f * fe__atan2f(q.x, q.w),
                                 .swing_y = s.angle * s.y,
                                 .swing_z = s.angle * s.z};
}

float fe__joint_wind(float twist, float before)
{
    float turns = (before - twist) * (0.5f / FE_PI),
          whole = (float)(int32_t)fe__clampf(turns + (turns < 0.0f ? -0.5f : 0.5f), -1e6f, 1e6f);
    return twist + whole * (2.0f * FE_PI);
}

// d(coordinate)/dt = gradient . (wB - wA) in frame A; see axis.inl, where the same is wide
static fe_vec3 angular_gradient(fe_quat q, fe__joint_part part, const fe__joint_axis *axis)
{
    swing s = swing_of(q);
    fe_vec3 e = {0.0f, s.y, s.z}, u = {0.0f, s.z, -s.y};
    float g_e = s.y, g_u = s.z, n2 = q.w * q.w + q.x * q.x;
    if (part == FE__PART_TWIST && n2 <= TWIST_DEFINED * TWIST_DEFINED) return fe__vec3(0.0f, 0.0f, 0.0f);
    if (part == FE__PART_TWIST) return fe__vec3(1.0f, (q.x * q.y + q.z * q.w) / n2, (q.x * q.z - q.y * q.w) / n2);
    if (part == FE__PART_SWING_Z) g_e = s.z, g_u = -s.y;
    if (part == FE__PART_CONE) {
        float y = s.y / (axis->limit.low * axis->limit.low), z = s.z / (axis->limit.high * axis->limit.high),
              k = -1.0f / sqrtf(y * y + z * z);
        g_e = k * (y * s.y + z * s.z), g_u = k * (y * s.z - z * s.y);
    }
    float over_sine = s.sine > 1e-4f ? s.angle / (2.0f * s.sine * fe__maxf(s.cosine, LEAST_COSINE)) : 1.0f;
    float cot = over_sine * (s.cosine * s.cosine - s.sine * s.sine);
    return fe__add_scaled(fe__scale(g_e, e), g_u, fe__vec3(-s.angle, cot * u.y, cot * u.z));
}

static fe_vec3 linear_direction(const fe__joint_pose *pose, fe__joint_part part)
{
    if (part == FE__PART_X) return fe__vec3(1.0f, 0.0f, 0.0f);
    if (part == FE__PART_Y) return fe__vec3(0.0f, 1.0f, 0.0f);
    if (part == FE__PART_Z) return fe__vec3(0.0f, 0.0f, 1.0f);
    return pose->length > 0.0f ? fe__scale(1.0f / pose->length, pose->d) : fe__vec3(1.0f, 0.0f, 0.0f);
}

void fe__joint_reaction_of(const fe__joints *joints, const fe__body *bodies, int32_t joint, fe_vec3 *out_force,
                           fe_vec3 *out_torque)
{
    static const int32_t place[] = {
        0, 1, 2, FE__AXIS_LINEAR, FE__AXIS_TWIST, FE__AXIS_SWING, FE__AXIS_SWING + 1, FE__AXIS_SWING};
    const fe__joint *j = joints->joints + joint;
    const fe__joint_frame *f = joints->frames + joint;
    fe_vec3 force = {0.0f, 0.0f, 0.0f}, torque = force;
    fe__joint_pose pose;
    fe__joint_pose_of(joints, bodies, joint, &pose);
    for (int part = FE__PART_X; part <= FE__PART_CONE; ++part) {
        if (!(f->parts >> part & 1)) continue;
        const fe__joint_axis *axis = joints->axes[f->axes].axis + place[part];
        if (part <= FE__PART_DISTANCE)
            force = fe__add_scaled(force, axis->state.force, linear_direction(&pose, (fe__joint_part)part));
        else
            torque = fe__add_scaled(torque, axis->state.force, angular_gradient(pose.q, (fe__joint_part)part, axis));
    }
    fe_quat frame_a = fe__product(quat_of(bodies[j->body_a].rotation), quat_of(f->frame_a));
    const fe__joint_reaction *r = joints->reactions + joint;
    *out_force = fe__add(fe__rotate(frame_a, force), vec_of(r->force));
    *out_torque = fe__add(fe__rotate(frame_a, torque), vec_of(r->torque));
    if (f->parts >> FE__PART_ROTATION & 1)
        *out_torque = fe__add(*out_torque, vec_of(joints->axes[f->axes].rotation.torque));
}
