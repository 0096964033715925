// machines.h - things made of joints, to copy from: a ragdoll, a car, a rope bridge, a door, a crane. The tests and
// examples/machines.c use them.
//
// Each builder fills a struct of handles and returns the first error, or FE_OK. y is up; lengths in m.
#ifndef FEATHER_EXAMPLE_MACHINES_H
#define FEATHER_EXAMPLE_MACHINES_H
#include "feather.h"

#include <math.h>

#define MACHINE_DEGREE 0.017453293f
#define MACHINE_TRY(call)                                 \
    do {                                                  \
        fe_result machine_tried = (call);                 \
        if (machine_tried != FE_OK) return machine_tried; \
    } while (0)

// ---- parts ---------------------------------------------------------------------------------------------------------
static inline fe_vec3 machine_rotate(fe_quat q, fe_vec3 a)
{
    fe_vec3 t = {2 * (q.y * a.z - q.z * a.y), 2 * (q.z * a.x - q.x * a.z), 2 * (q.x * a.y - q.y * a.x)};
    return fe_make_vec3(a.x + q.w * t.x + q.y * t.z - q.z * t.y, a.y + q.w * t.y + q.z * t.x - q.x * t.z,
                        a.z + q.w * t.z + q.x * t.y - q.y * t.x);
}

static inline fe_quat machine_multiply(fe_quat a, fe_quat b)
{
    fe_quat q = {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                 a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
    return q;
}

// The turn of Y to a direction
static inline fe_quat machine_turn_y_to(fe_vec3 d)
{
    float length = sqrtf(d.x * d.x + d.y * d.y + d.z * d.z), w = length + d.y;
    fe_quat q = {d.z, 0, -d.x, w};
    if (w < 1e-6f * length) q.x = 1;
    return q; // of any length: the library reads q/|q|
}

static inline fe_result machine_body(fe_world *world, int32_t type, fe_transform at, const fe_geometry *form,
                                     float density, fe_body *out_body)
{
    fe_body_def body;
    fe_shape_def surface;
    fe_shape shape;
    fe_body_def_init(&body, sizeof body);
    fe_shape_def_init(&surface, sizeof surface);
    body.type = type;
    body.transform = at;
    surface.density = density;
    MACHINE_TRY(fe_body_create(world, &body, out_body));
    return fe_shape_create(world, *out_body, &surface, form, &shape);
}

static inline fe_result machine_box(fe_world *world, int32_t type, double x, double y, double z, float half_x,
                                    float half_y, float half_z, float density, fe_body *out_body)
{
    fe_geometry form;
    fe_geometry_box(&form, half_x, half_y, half_z);
    return machine_body(world, type, fe_make_transform(x, y, z), &form, density, out_body);
}

// ---- a ragdoll -----------------------------------------------------------------------------------------------------
// Fourteen capsules of a person of 1.75 m and 90 kg, from Box3D's human: frames of the bones, ends of the capsules in
// them, the frames of the joints about Z. Spine, neck, hips and shoulders are balls with a cone and a twist; knees and
// elbows hinges.
enum {
    RAGDOLL_BONES = 14,
    RAGDOLL_PELVIS = 0,
    RAGDOLL_CHEST = 3,
    RAGDOLL_HEAD = 5,
    RAGDOLL_THIGH_L = 6,
    RAGDOLL_THIGH_R = 8,
    RAGDOLL_NONE = 0, // kinds of a bone's joint to its parent
    RAGDOLL_BALL = 1,
    RAGDOLL_HINGE = 2
};

typedef struct ragdoll_bone {
    const char *name;
    int parent, joint;
    fe_vec3 position; // of the bone's frame, person standing at the origin, facing z
    fe_quat rotation;
    fe_vec3 end_a, end_b; // of the capsule
    float radius;
    fe_quat frame_a; // joint's axes in the parent
    fe_vec3 point;   // joint in the bone
    fe_quat frame_b;
    float swing, low, high; // degrees
    float friction;         // of fe_ragdoll's friction torque
} ragdoll_bone;

static const ragdoll_bone ragdoll_bones[RAGDOLL_BONES] = {
    // clang-format off
    {"pelvis", -1, RAGDOLL_NONE,
     {0.0f, 0.932087f, -0.051708f}, {0.739169f, 0.0f, 0.0f, 0.67352f},
     {0.07f, 0.0f, -0.08f}, {-0.07f, 0.0f, -0.08f}, 0.13f,
     {0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f},
     {0.0f, 0.0f, 0.0f, 1.0f}, 0.0f, 0.0f, 0.0f, 1.0f},
    {"spine_01", 0, RAGDOLL_BALL,
     {0.0f, 1.1135f, -0.03481f}, {0.739973f, 0.0f, 0.0f, 0.672637f},
     {0.06f, 0.0f, -0.052264f}, {-0.06f, 0.0f, -0.052264f}, 0.12f,
     {-0.999999f, 0.0f, 0.0f, 0.001194f}, {0.0f, 0.0f, -0.007736f},
     {-1.0f, 0.0f, 0.0f, 0.0f}, 25.0f, -15.0f, 15.0f, 1.0f},
    {"spine_02", 1, RAGDOLL_BALL,
     {0.0f, 1.19434f, -0.027087f}, {0.703611f, 0.0f, 0.0f, 0.710586f},
     {0.08f, -0.015133f, -0.091801f}, {-0.08f, -0.015133f, -0.091801f}, 0.1f,
     {-0.998619f, 0.0f, 0.0f, -0.05254f}, {0.0f, 0.0f, -0.008199f},
     {-1.0f, 0.0f, 0.0f, 0.0f}, 25.0f, -15.0f, 15.0f, 1.0f},
    {"spine_03", 2, RAGDOLL_BALL,
     {0.0f, 1.31043f, -0.028232f}, {0.669856f, 1e-06f, -1e-06f, 0.742491f},
     {0.11f, -0.039753f, -0.13f}, {-0.11f, -0.039753f, -0.13f}, 0.145f,
     {-0.998921f, 1e-06f, -1e-06f, -0.046434f}, {0.0f, 0.0f, 0.0f},
     {-1.0f, 0.0f, -1e-06f, 0.0f}, 15.0f, -10.0f, 10.0f, 1.0f},
    {"neck", 3, RAGDOLL_BALL,
     {0.0f, 1.57558f, -0.055837f}, {0.879922f, 0.0f, 0.0f, 0.475118f},
     {-1e-06f, 0.0f, -0.02f}, {0.0f, -0.005f, -0.08f}, 0.07f,
     {-0.942192f, -1e-06f, 0.0f, 0.335074f}, {0.0f, 0.0f, 0.0f},
     {-1.0f, 0.0f, -1e-06f, 0.0f}, 45.0f, -15.0f, 15.0f, 0.8f},
    {"head", 4, RAGDOLL_BALL,
     {0.0f, 1.65335f, -0.003241f}, {0.750288f, 0.0f, 0.0f, 0.661111f},
     {-1e-06f, 0.016892f, -0.05869f}, {0.0f, -0.003629f, -0.115072f}, 0.0975f,
     {-0.974301f, 0.0f, 0.0f, -0.225251f}, {0.0f, 0.001268f, -0.005104f},
     {-1.0f, 0.0f, 0.0f, 0.0f}, 15.0f, -15.0f, 15.0f, 0.4f},
    {"thigh_l", 0, RAGDOLL_BALL,
     {0.090416f, 0.986104f, -0.03509f}, {-0.703287f, -0.070715f, 0.053866f, 0.705327f},
     {0.023719f, 0.006008f, -0.039068f}, {-0.064492f, -0.004664f, -0.424718f}, 0.09f,
     {-0.714896f, -0.022305f, -0.698361f, -0.02679f}, {0.0f, 0.0f, 0.0f},
     {-0.002064f, 0.758987f, 0.017046f, 0.65088f}, 10.0f, -60.0f, 40.0f, 1.0f},
    {"calf_l", 6, RAGDOLL_HINGE,
     {0.101198f, 0.527027f, -0.037374f}, {-0.653328f, -0.06686f, 0.058582f, 0.751838f},
     {0.001778f, 0.0f, 0.009841f}, {-0.078577f, 0.014707f, -0.41816f}, 0.075f,
     {-0.000677f, 0.760087f, 0.105674f, 0.641171f}, {0.0f, 0.0f, 0.0f},
     {-0.044589f, 0.76554f, 0.053368f, 0.639619f}, 0.0f, -5.0f, 45.0f, 1.0f},
    {"thigh_r", 0, RAGDOLL_BALL,
     {-0.090416f, 0.986104f, -0.03509f}, {-0.703287f, 0.070715f, -0.053865f, 0.705326f},
     {-0.023719f, 0.006008f, -0.039068f}, {0.064492f, -0.004664f, -0.424718f}, 0.09f,
     {-0.039089f, -0.714094f, 0.043177f, 0.697623f}, {0.0f, 0.0f, 0.0f},
     {0.758805f, -0.019886f, -0.651012f, -0.001759f}, 10.0f, -30.0f, 60.0f, 1.0f},
    {"calf_r", 8, RAGDOLL_HINGE,
     {-0.101198f, 0.527027f, -0.037373f}, {-0.653327f, 0.06686f, -0.058582f, 0.751839f},
     {-0.00182f, 0.0f, 0.010071f}, {0.077883f, 0.014825f, -0.418047f}, 0.075f,
     {0.760086f, -0.000675f, -0.641171f, -0.105676f}, {0.0f, 0.0f, 0.0f},
     {0.76554f, -0.044589f, -0.639619f, -0.053368f}, 0.0f, -45.0f, 5.0f, 1.0f},
    {"upper_arm_l", 3, RAGDOLL_BALL,
     {0.20378f, 1.48428f, -0.115897f}, {0.143082f, 0.69598f, -0.69013f, 0.13733f},
     {0.0f, 0.0f, 0.0f}, {-0.091118f, 0.037775f, 0.229719f}, 0.075f,
     {-0.278486f, 0.4456f, -0.097014f, 0.845266f}, {0.0f, 0.0f, 0.0f},
     {-0.201396f, -0.001586f, 0.90185f, 0.382234f}, 60.0f, -5.0f, 5.0f, 1.0f},
    {"lower_arm_l", 10, RAGDOLL_HINGE,
     {0.305614f, 1.24291f, -0.117599f}, {0.165048f, 0.563437f, -0.802002f, 0.109959f},
     {0.0f, 0.0f, 0.0f}, {-0.142406f, 0.039392f, 0.261092f}, 0.05f,
     {0.512487f, -0.180629f, 0.839474f, 0.003742f}, {0.0f, 0.0f, 0.0f},
     {0.503803f, -0.029831f, 0.858168f, 0.0940171f}, 0.0f, -5.0f, 60.0f, 1.0f},
    {"upper_arm_r", 3, RAGDOLL_BALL,
     {-0.20378f, 1.48428f, -0.115899f}, {0.143083f, -0.695978f, 0.690132f, 0.137329f},
     {0.0f, 0.0f, 0.0f}, {0.091118f, 0.037775f, 0.229718f}, 0.075f,
     {-0.253621f, -0.414842f, 0.106962f, 0.867261f}, {0.0f, 0.0f, 0.0f},
     {-0.201397f, 0.001587f, -0.901851f, 0.382233f}, 60.0f, -5.0f, 5.0f, 1.0f},
    {"lower_arm_r", 12, RAGDOLL_HINGE,
     {-0.305614f, 1.24291f, -0.117599f}, {0.165048f, -0.563437f, 0.802002f, 0.109959f},
     {0.0f, 0.0f, 0.0f}, {0.142406f, 0.039392f, 0.261092f}, 0.05f,
     {-0.180627f, 0.512487f, -0.003744f, -0.839474f}, {0.0f, 0.0f, 0.0f},
     {-0.029831f, 0.503803f, -0.094017f, -0.858169f}, 0.0f, -60.0f, 5.0f, 1.0f},
    // clang-format on
};

typedef struct ragdoll {
    fe_body bones[RAGDOLL_BONES];
    fe_joint joints[RAGDOLL_BONES]; // to the parent; [0] is none
} ragdoll;

// A long thin bone turns about its axis a hundred times more easily than across it, a small one like the neck in any
// way; a soft solver then has to hold heavy ends by a light one. No moment of a bone is below a quarter of its largest,
// or below its mass times (10 cm)^2.
static inline fe_result ragdoll_thicken(fe_world *world, fe_body bone)
{
    fe_mass_data mass;
    mass.struct_size = sizeof mass;
    MACHINE_TRY(fe_body_get_mass_data(world, bone, &mass));
    float largest = fmaxf(fmaxf(mass.inertia.x, mass.inertia.y), mass.inertia.z),
          least = fmaxf(0.25f * largest, 0.01f * mass.mass);
    mass.inertia =
        fe_make_vec3(fmaxf(mass.inertia.x, least), fmaxf(mass.inertia.y, least), fmaxf(mass.inertia.z, least));
    return fe_body_set_mass_data(world, bone, &mass);
}

static inline fe_result ragdoll_add_bone(fe_world *world, const ragdoll_bone *bone, fe_transform at, fe_body *out_body)
{
    fe_body_def body;
    fe_shape_def surface;
    fe_shape shape;
    fe_geometry form;
    fe_vec3 a = bone->end_a, b = bone->end_b, along = {b.x - a.x, b.y - a.y, b.z - a.z},
            place = machine_rotate(at.rotation, bone->position);
    fe_body_def_init(&body, sizeof body);
    fe_shape_def_init(&surface, sizeof surface);
    body.transform.position = fe_make_dvec3(at.position.x + (double)place.x, at.position.y + (double)place.y,
                                            at.position.z + (double)place.z);
    body.transform.rotation = machine_multiply(at.rotation, bone->rotation);
    surface.frame.position = fe_make_vec3(0.5f * (a.x + b.x), 0.5f * (a.y + b.y), 0.5f * (a.z + b.z));
    surface.frame.rotation = machine_turn_y_to(along);
    surface.material.rolling_resistance = 0.2f;
    fe_geometry_capsule(&form, 0.5f * sqrtf(along.x * along.x + along.y * along.y + along.z * along.z), bone->radius);
    MACHINE_TRY(fe_body_create(world, &body, out_body));
    MACHINE_TRY(fe_shape_create(world, *out_body, &surface, &form, &shape));
    return ragdoll_thicken(world, *out_body);
}

// the table's joints turn about Z, the library's about X
static inline fe_quat ragdoll_frame(fe_quat q)
{
    const fe_quat x_to_z = {-0.5f, -0.5f, -0.5f, 0.5f};
    return machine_multiply(q, x_to_z);
}

// the joint's point, given in the bone, seen from the parent
static inline fe_vec3 ragdoll_point_in_parent(const ragdoll_bone *bone, const ragdoll_bone *parent)
{
    fe_vec3 p = machine_rotate(bone->rotation, bone->point);
    fe_vec3 d = {bone->position.x + p.x - parent->position.x, bone->position.y + p.y - parent->position.y,
                 bone->position.z + p.z - parent->position.z};
    fe_quat q = parent->rotation, back = {-q.x, -q.y, -q.z, q.w};
    return machine_rotate(back, d);
}

static inline fe_result ragdoll_add_joint(fe_world *world, const ragdoll_bone *bone, fe_body parent, fe_body child,
                                          float friction_torque, fe_joint *out_joint)
{
    fe_frame a = {ragdoll_point_in_parent(bone, ragdoll_bones + bone->parent), ragdoll_frame(bone->frame_a)};
    fe_frame b = {bone->point, ragdoll_frame(bone->frame_b)};
    if (bone->joint == RAGDOLL_HINGE) {
        fe_hinge_joint_def hinge;
        fe_hinge_joint_def_init(&hinge, sizeof hinge);
        hinge.body_a = parent, hinge.body_b = child, hinge.frame_a = a, hinge.frame_b = b;
        hinge.limit_enabled = 1;
        hinge.lower = bone->low * MACHINE_DEGREE, hinge.upper = bone->high * MACHINE_DEGREE;
        hinge.motor_max = bone->friction * friction_torque;
        return fe_hinge_joint_create(world, &hinge, out_joint);
    }
    fe_ball_joint_def ball;
    fe_ball_joint_def_init(&ball, sizeof ball);
    ball.body_a = parent, ball.body_b = child, ball.frame_a = a, ball.frame_b = b;
    ball.cone_enabled = ball.limit_enabled = 1;
    ball.cone_y = ball.cone_z = bone->swing * MACHINE_DEGREE;
    ball.lower = bone->low * MACHINE_DEGREE, ball.upper = bone->high * MACHINE_DEGREE;
    ball.motor_max = bone->friction * friction_torque;
    return fe_ball_joint_create(world, &ball, out_joint);
}

// A person standing at a place. Neighbours in the table do not touch because they are joined; thighs and belly overlap
// without being it.
static inline fe_result ragdoll_build(fe_world *world, fe_transform at, float friction_torque, ragdoll *out)
{
    static const int strangers[3][2] = {{1, RAGDOLL_THIGH_L}, {1, RAGDOLL_THIGH_R}, {RAGDOLL_THIGH_L, RAGDOLL_THIGH_R}};
    for (int i = 0; i < RAGDOLL_BONES; ++i) {
        const ragdoll_bone *bone = ragdoll_bones + i;
        MACHINE_TRY(ragdoll_add_bone(world, bone, at, &out->bones[i]));
        out->joints[i] = 0;
        if (bone->parent < 0) continue;
        MACHINE_TRY(
            ragdoll_add_joint(world, bone, out->bones[bone->parent], out->bones[i], friction_torque, &out->joints[i]));
    }
    for (int i = 0; i < 3; ++i)
        MACHINE_TRY(fe_world_ignore_collision(world, out->bones[strangers[i][0]], out->bones[strangers[i][1]], 1));
    return FE_OK;
}

// ---- a car ---------------------------------------------------------------------------------------------------------
typedef struct car {
    fe_body chassis, wheels[4]; // front left, front right, rear left, rear right; it drives towards x
    fe_joint axles[4];
} car;

static inline fe_result car_add_wheel(fe_world *world, car *c, int i, fe_dvec3 at)
{
    const fe_vec3 axle = {0, 0, -1}, up = {0, 1, 0}; // axle x up is x: positive spin drives forwards
    fe_geometry tyre;
    fe_body_def body;
    fe_shape_def surface;
    fe_shape shape;
    fe_configurable_joint_def d;
    fe_geometry_sphere(&tyre, 0.4f);
    fe_body_def_init(&body, sizeof body);
    body.transform = fe_make_transform(at.x, at.y, at.z);
    fe_shape_def_init(&surface, sizeof surface);
    surface.density = 75; // 20 kg
    surface.material.static_friction = surface.material.dynamic_friction = 1.5f;
    MACHINE_TRY(fe_body_create(world, &body, &c->wheels[i]));
    MACHINE_TRY(fe_shape_create(world, c->wheels[i], &surface, &tyre, &shape));
    d.struct_size = sizeof d;
    MACHINE_TRY(fe_wheel_joint_def_at(world, &d, c->chassis, c->wheels[i], &at, &axle, &up, 2, 0.7f, 0.25f));
    if (i < 2) { // steers by a stiff drive
        fe_joint_axis *steer = &d.axes[FE_DOF_ANGULAR_Z];
        steer->motion = FE_MOTION_LIMITED, steer->lower = -0.6f, steer->upper = 0.6f;
        steer->spring = FE_SPRING_HERTZ, steer->spring_hertz = 10, steer->spring_damping_ratio = 1;
    }
    return fe_configurable_joint_create(world, &d, &c->axles[i]);
}

static inline fe_result car_build(fe_world *world, double x, double y, double z, car *out)
{
    MACHINE_TRY(machine_box(world, FE_BODY_DYNAMIC, x, y + 0.6, z, 1.8f, 0.3f, 0.8f, 350, &out->chassis)); // 1.2 t
    for (int i = 0; i < 4; ++i) {
        double along = i < 2 ? 1.3 : -1.3, aside = i % 2 ? 0.9 : -0.9;
        MACHINE_TRY(car_add_wheel(world, out, i, fe_make_dvec3(x + along, y + 0.4, z + aside)));
    }
    return FE_OK;
}

// @param speed  m/s, the rear wheels turn for it with at most `torque` N m each;  @param steer  rad, to the left
static inline fe_result car_drive(fe_world *world, const car *c, float speed, float torque, float steer)
{
    for (int i = 0; i < 4; ++i) {
        fe_configurable_joint_def d;
        d.struct_size = sizeof d;
        MACHINE_TRY(fe_configurable_joint_get(world, c->axles[i], &d));
        d.axes[FE_DOF_ANGULAR_X].motor_speed = speed / 0.4f;
        d.axes[FE_DOF_ANGULAR_X].motor_max = i < 2 ? 0 : torque;
        d.axes[FE_DOF_ANGULAR_Z].target = steer;
        MACHINE_TRY(fe_configurable_joint_set(world, c->axles[i], &d));
    }
    return FE_OK;
}

// ---- a rope bridge -------------------------------------------------------------------------------------------------
enum { BRIDGE_PLANKS = 24 };
typedef struct bridge {
    fe_body posts[2], planks[BRIDGE_PLANKS];
    fe_joint ropes[2 * (BRIDGE_PLANKS + 1)];
} bridge;

// Planks of 0.5 m along x, hung between two posts 4 % farther apart than they are long. Two ropes of 0.04 m at each
// seam
static inline fe_result bridge_build(fe_world *world, double x, double y, double z, bridge *out)
{
    const double pitch = 0.5, half = 0.23;
    for (int i = 0; i < 2; ++i)
        MACHINE_TRY(machine_box(world, FE_BODY_STATIC, x + (i ? BRIDGE_PLANKS * pitch + 0.5 : -0.5), y, z, 0.48f, 0.2f,
                                1, 0, &out->posts[i]));
    for (int i = 0; i < BRIDGE_PLANKS; ++i)
        MACHINE_TRY(machine_box(world, FE_BODY_DYNAMIC, x + (i + 0.5) * pitch, y, z, (float)half, 0.04f, 0.8f, 600,
                                &out->planks[i]));
    for (int i = 0; i <= BRIDGE_PLANKS; ++i) {
        fe_body a = i ? out->planks[i - 1] : out->posts[0], b = i < BRIDGE_PLANKS ? out->planks[i] : out->posts[1];
        for (int side = 0; side < 2; ++side) {
            fe_dvec3 from = {x + i * pitch - (pitch / 2 - half), y, z + (side ? 0.7 : -0.7)}, to = from;
            fe_distance_joint_def rope;
            to.x += pitch - 2 * half;
            rope.struct_size = sizeof rope;
            MACHINE_TRY(fe_rope_joint_def_at(world, &rope, a, b, &from, &to, 0.06f));
            MACHINE_TRY(fe_distance_joint_create(world, &rope, &out->ropes[2 * i + side]));
        }
    }
    return FE_OK;
}

// ---- a door --------------------------------------------------------------------------------------------------------
typedef struct door {
    fe_body frame, leaf;
    fe_joint hinges[2];
} door;

// A leaf of 0.9 x 2 m and 36 kg on two hinges along y at (x, z). Opens by 100 degrees each way; a spring closes it
static inline fe_result door_build(fe_world *world, double x, double y, double z, door *out)
{
    const fe_vec3 up = {0, 1, 0};
    MACHINE_TRY(machine_box(world, FE_BODY_STATIC, x - 0.06, y + 1, z, 0.05f, 1, 0.05f, 0, &out->frame));
    MACHINE_TRY(machine_box(world, FE_BODY_DYNAMIC, x + 0.45, y + 1.02, z, 0.45f, 1, 0.02f, 500, &out->leaf));
    for (int i = 0; i < 2; ++i) {
        fe_hinge_joint_def hinge;
        fe_dvec3 at = {x, y + (i ? 1.8 : 0.2), z};
        fe_hinge_joint_def_init(&hinge, sizeof hinge);
        hinge.limit_enabled = 1, hinge.lower = -100 * MACHINE_DEGREE, hinge.upper = 100 * MACHINE_DEGREE;
        if (i == 0) hinge.spring_hertz = 0.5f, hinge.spring_damping_ratio = 0.7f;
        MACHINE_TRY(fe_hinge_joint_def_at(world, &hinge, out->frame, out->leaf, &at, &up));
        MACHINE_TRY(fe_hinge_joint_create(world, &hinge, &out->hinges[i]));
    }
    return FE_OK;
}

// ---- a crane -------------------------------------------------------------------------------------------------------
enum { CRANE_LINKS = 10 };
typedef struct crane {
    fe_body mast, trolley, links[CRANE_LINKS], load;
    fe_joint winch; // a slider: the trolley moves along x. A configurable joint
    fe_joint chain[CRANE_LINKS + 1];
    float link_mass, load_mass; // kg
} crane;

// A trolley of 2 t on a rail at height y, ten links of 0.3 m and 1 kg below, and a load `ratio` times as heavy as a
// link. The joints close no loop, so that they bear it without giving; the links are thickened, which lets them turn no
// faster than substeps can follow.
static inline fe_result crane_build(fe_world *world, double x, double y, double z, float ratio, crane *out)
{
    const fe_vec3 along = {1, 0, 0}, down = {0, -1, 0};
    fe_configurable_joint_def rail;
    fe_geometry form;
    out->link_mass = 1, out->load_mass = ratio;
    MACHINE_TRY(machine_box(world, FE_BODY_STATIC, x, y + 1, z, 8, 0.2f, 0.2f, 0, &out->mast));
    MACHINE_TRY(machine_box(world, FE_BODY_DYNAMIC, x, y, z, 0.5f, 0.25f, 0.5f, 4000, &out->trolley));
    fe_dvec3 at = {x, y, z};
    rail.struct_size = sizeof rail;
    MACHINE_TRY(fe_slider_joint_def_at(world, &rail, out->mast, out->trolley, &at, &along));
    rail.axes[FE_DOF_LINEAR_X].motion = FE_MOTION_LIMITED, rail.axes[FE_DOF_LINEAR_X].lower = -6,
    rail.axes[FE_DOF_LINEAR_X].upper = 6;
    rail.axes[FE_DOF_LINEAR_X].spring = FE_SPRING_HERTZ, rail.axes[FE_DOF_LINEAR_X].spring_hertz = 0.5f,
    rail.axes[FE_DOF_LINEAR_X].spring_damping_ratio = 1;
    MACHINE_TRY(fe_configurable_joint_create(world, &rail, &out->winch));
    fe_geometry_capsule(&form, 0.1f, 0.05f);
    fe_body above = out->trolley;
    for (int i = 0; i <= CRANE_LINKS; ++i) {
        fe_body below;
        double top = y - 0.3 * i;
        if (i < CRANE_LINKS) {
            MACHINE_TRY(
                machine_body(world, FE_BODY_DYNAMIC, fe_make_transform(x, top - 0.15, z), &form, 1000, &out->links[i]));
            MACHINE_TRY(fe_body_set_mass(world, out->links[i], out->link_mass));
            MACHINE_TRY(ragdoll_thicken(world, out->links[i]));
            below = out->links[i];
        } else {
            MACHINE_TRY(machine_box(world, FE_BODY_DYNAMIC, x, top - 0.5, z, 0.5f, 0.5f, 0.5f, 1000, &out->load));
            MACHINE_TRY(fe_body_set_mass(world, out->load, out->load_mass));
            below = out->load;
        }
        fe_ball_joint_def ball;
        at = fe_make_dvec3(x, top, z);
        fe_ball_joint_def_init(&ball, sizeof ball);
        ball.motor_max = 0.01f * ratio; // friction, so that a swing dies down
        MACHINE_TRY(fe_ball_joint_def_at(world, &ball, above, below, &at, &down));
        MACHINE_TRY(fe_ball_joint_create(world, &ball, &out->chain[i]));
        above = below;
    }
    return FE_OK;
}

#endif
