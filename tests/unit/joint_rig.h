// joint_rig.h - bodies and joints straight on the solver: records by hand, the graph, the substeps, poses. No world, no
// shapes, no API.
#ifndef FE_TESTS_JOINT_RIG_H
#define FE_TESTS_JOINT_RIG_H
#include "../fe_test.h"
#include "core/bytes.h"
#include "solver/graph/graph.h"
#include "solver/solve.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { RIG_BODIES = 10200, RIG_JOINTS = 20200, RIG_AXES = 64 };

typedef struct rig {
    fe__memory memory;
    fe__workers workers;
    const fe__kernels *kernels;
    fe__solver solver;
    fe__body *bodies; // body 0 is static, at the origin
    int32_t *awake_bodies, *awake_joints;
    int32_t body_count, joint_count;
    fe__joints joints;
    int32_t substeps, built;
    float gravity, dt, last_h;
} rig;

static inline rig rig_make(int32_t simd, fe_pool *pool, int32_t workers, int32_t substeps)
{
    rig r = {.substeps = substeps, .gravity = -10.0f, .dt = 1.0f / 60.0f, .kernels = fe__kernels_of(simd)};
    fe__memory_init(&r.memory, NULL);
    r.workers = (fe__workers){.count = workers, .pool = pool};
    r.bodies = fe__allocate(&r.memory, sizeof(fe__body) * RIG_BODIES);
    r.awake_bodies = fe__allocate(&r.memory, sizeof(int32_t) * RIG_BODIES);
    r.awake_joints = fe__allocate(&r.memory, sizeof(int32_t) * RIG_JOINTS);
    r.joints.joints = fe__allocate(&r.memory, sizeof(fe__joint) * RIG_JOINTS);
    r.joints.frames = fe__allocate(&r.memory, sizeof(fe__joint_frame) * RIG_JOINTS);
    r.joints.reactions = fe__allocate(&r.memory, sizeof(fe__joint_reaction) * RIG_JOINTS);
    r.joints.axes = fe__allocate(&r.memory, sizeof(fe__joint_axes) * RIG_AXES);
    r.bodies[0] =
        (fe__body){.rotation = {0, 0, 0, 1}, .inertia_axes = {0, 0, 0, 1}, .type = FE_BODY_STATIC, .awake_index = -1};
    r.body_count = 1;
    return r;
}

static inline void rig_free(rig *r)
{
    fe__solver_destroy(&r->solver, &r->memory);
    fe__release(&r->memory, r->bodies, sizeof(fe__body) * RIG_BODIES);
    fe__release(&r->memory, r->awake_bodies, sizeof(int32_t) * RIG_BODIES);
    fe__release(&r->memory, r->awake_joints, sizeof(int32_t) * RIG_JOINTS);
    fe__release(&r->memory, r->joints.joints, sizeof(fe__joint) * RIG_JOINTS);
    fe__release(&r->memory, r->joints.frames, sizeof(fe__joint_frame) * RIG_JOINTS);
    fe__release(&r->memory, r->joints.reactions, sizeof(fe__joint_reaction) * RIG_JOINTS);
    fe__release(&r->memory, r->joints.axes, sizeof(fe__joint_axes) * RIG_AXES);
}

static inline int32_t rig_body(rig *r, double x, double y, double z, float mass, float ix, float iy, float iz)
{
    int32_t i = r->body_count++;
    fe__body *b = r->bodies + i;
    *b = (fe__body){.centre = {x, y, z},
                    .rotation = {0, 0, 0, 1},
                    .inertia = {ix, iy, iz},
                    .mass = mass,
                    .inertia_axes = {0, 0, 0, 1},
                    .gravity_scale = 1.0f,
                    .type = FE_BODY_DYNAMIC};
    b->inverse_mass = 1.0f / mass;
    if (ix == iy && iy == iz) b->flags |= FE__BODY_ISOTROPIC;
    for (int k = 0; k < 3; ++k) {
        b->centre_high[k] = (float)b->centre[k];
        b->centre_low[k] = (float)(b->centre[k] - (double)b->centre_high[k]);
    }
    b->awake_index = i - 1;
    r->awake_bodies[i - 1] = i;
    return i;
}

static inline void rig_to_local(const fe__body *b, fe_dvec3 point, float *out_arm)
{
    fe_dvec3 d = {point.x - b->centre[0], point.y - b->centre[1], point.z - b->centre[2]};
    fe_vec3 a =
        fe__narrow(fe__drotate_back((fe_quat){b->rotation[0], b->rotation[1], b->rotation[2], b->rotation[3]}, d));
    out_arm[0] = a.x, out_arm[1] = a.y, out_arm[2] = a.z;
}

static inline void rig_to_frame(const fe__body *b, fe_quat world, float *out_frame)
{
    fe_quat q =
        fe__product(fe__conjugate((fe_quat){b->rotation[0], b->rotation[1], b->rotation[2], b->rotation[3]}), world);
    out_frame[0] = q.x, out_frame[1] = q.y, out_frame[2] = q.z, out_frame[3] = q.w;
}

// anchors at one world point, frames along `axes`; not linked yet
static inline int32_t rig_joint(rig *r, int32_t a, int32_t b, fe_dvec3 point, fe_quat axes, uint32_t parts)
{
    int32_t i = ++r->joint_count;
    fe__joint *j = r->joints.joints + i;
    fe__joint_frame *f = r->joints.frames + i;
    *j = (fe__joint){.body_a = a, .body_b = b, .colour = -1};
    *f = (fe__joint_frame){.serial = (uint64_t)i, .parts = (uint16_t)parts};
    rig_to_local(r->bodies + a, point, j->arm_a), rig_to_local(r->bodies + b, point, j->arm_b);
    rig_to_frame(r->bodies + a, axes, f->frame_a), rig_to_frame(r->bodies + b, axes, f->frame_b);
    r->awake_joints[i - 1] = i;
    return i;
}

static inline int32_t rig_ball(rig *r, int32_t a, int32_t b, double x, double y, double z)
{
    int32_t j = rig_joint(r, a, b, (fe_dvec3){x, y, z}, fe__identity(), 1u << FE__PART_POINT);
    fe__joint_link(&r->joints, r->bodies, j);
    return j;
}

static inline void rig_kinematic(rig *r, int32_t body, fe_vec3 velocity, fe_vec3 spin)
{
    fe__body *b = r->bodies + body;
    b->type = FE_BODY_KINEMATIC;
    const float v[3] = {velocity.x, velocity.y, velocity.z}, w[3] = {spin.x, spin.y, spin.z};
    memcpy(b->velocity, v, sizeof v), memcpy(b->spin, w, sizeof w);
    b->inverse_mass = 0.0f;
}

// a dynamic body's axes, linear | angular << 3; its joints are linked anew
static inline void rig_lock(rig *r, int32_t body, int32_t locks)
{
    for (int32_t i = 1; i <= r->joint_count; ++i) {
        const fe__joint *j = r->joints.joints + i;
        if (j->body_a == body || j->body_b == body) fe__joint_unlink(&r->joints, r->bodies, i);
    }
    r->bodies[body].locked = locks != 0;
    r->bodies[body].lock_bits = (float)locks;
    if (locks >> 3) r->bodies[body].flags |= FE__BODY_ISOTROPIC;
    for (int32_t i = 1; i <= r->joint_count; ++i)
        if (r->joints.joints[i].colour < 0) fe__joint_link(&r->joints, r->bodies, i);
}

static inline void rig_build(rig *r)
{
    fe__graph_input in = {.bodies = r->bodies,
                          .awake_bodies = r->awake_bodies,
                          .body_count = r->body_count - 1,
                          .joints = &r->joints,
                          .awake_joints = r->awake_joints,
                          .joint_count = r->joint_count};
    fe__graph_bound bound = {.bodies = r->body_count - 1, .joint_set = &r->joints, .joints = r->joint_count};
    FE_TRUE(fe__graph_reserve(&r->solver, &r->memory, r->kernels, &bound, r->workers.count));
    fe__graph_build(&r->solver, r->kernels, &in);
    r->built = 1;
}

static inline void rig_follow(fe__body *b, const fe__velocity_line *velocity, const fe__motion_line *motion)
{
    fe_quat q = {b->rotation[0], b->rotation[1], b->rotation[2], b->rotation[3]};
    q = fe__normalized(fe__product(fe__quat_of(motion->rotation), q));
    b->rotation[0] = q.x, b->rotation[1] = q.y, b->rotation[2] = q.z, b->rotation[3] = q.w;
    for (int k = 0; k < 3; ++k) {
        b->velocity[k] = velocity->v[k], b->spin[k] = velocity->w[k];
        b->centre[k] += (double)motion->shift[k];
        b->centre_high[k] = (float)b->centre[k];
        b->centre_low[k] = (float)(b->centre[k] - (double)b->centre_high[k]);
    }
}

static inline void rig_step(rig *r)
{
    float h = r->dt / (float)r->substeps;
    fe__step_constants c = {.h = h,
                            .inverse_h = 1.0f / h,
                            .warm_scale = r->last_h > 0.0f ? h / r->last_h : 0.0f,
                            .max_speed = 1e6f,
                            .open = FLT_MAX,
                            .substeps = r->substeps,
                            .division = 1,
                            .sweeps = 1,
                            .gravity = {0.0f, r->gravity, 0.0f},
                            .joint_hertz = 0.225f / h};
    c.joint = fe__make_softness(fe__minf(60.0f, c.joint_hertz), 2.0f, h);
    r->last_h = h;
    if (!r->built) rig_build(r);
    const fe__step_constants paces[FE__PACES] = {c, c, c};
    const fe__records of = {.bodies = r->bodies, .joints = r->joints, .engaged = &r->solver.engaged};
    fe__solve(&r->solver, r->kernels, &r->workers, &of, paces);
    fe__note_solved(&r->solver, r->kernels, &of);
    for (int32_t i = 1; i < r->body_count; ++i) {
        fe__body *b = r->bodies + i;
        rig_follow(b, r->solver.velocity + b->line, r->solver.motion + b->line);
    }
}

// kinetic and potential energy, J
static inline double rig_energy(const rig *r)
{
    double sum = 0.0;
    for (int32_t i = 1; i < r->body_count; ++i) {
        const fe__body *b = r->bodies + i;
        const fe_quat q = {b->rotation[0], b->rotation[1], b->rotation[2], b->rotation[3]};
        fe_dvec3 v = {b->velocity[0], b->velocity[1], b->velocity[2]},
                 w = fe__drotate_back(q, (fe_dvec3){b->spin[0], b->spin[1], b->spin[2]});
        double m = b->mass;
        sum += 0.5 * m * fe__ddot(v, v) +
               0.5 * (b->inertia[0] * w.x * w.x + b->inertia[1] * w.y * w.y + b->inertia[2] * w.z * w.z);
        sum -= m * r->gravity * b->centre[1];
    }
    return sum;
}

static inline double rig_gap(const rig *r, int32_t joint)
{
    fe_dvec3 d = fe__joint_gap(r->joints.joints + joint, r->bodies);
    return sqrt(fe__ddot(d, d));
}

static inline double rig_largest_gap(const rig *r)
{
    double most = 0.0;
    for (int32_t i = 1; i <= r->joint_count; ++i) most = fe__maxd(most, rig_gap(r, i));
    return most;
}

static inline uint64_t rig_hash(const rig *r)
{
    fe__hash h = fe__hash_begin();
    for (int32_t i = 1; i < r->body_count; ++i) {
        const fe__body *b = r->bodies + i;
        for (int k = 0; k < 3; ++k) {
            fe__hash_double(&h, b->centre[k]);
            fe__hash_float(&h, b->velocity[k]), fe__hash_float(&h, b->spin[k]), fe__hash_float(&h, b->rotation[k]);
        }
    }
    for (int32_t i = 1; i <= r->joint_count; ++i)
        for (int k = 0; k < 3; ++k) {
            fe__hash_float(&h, r->joints.joints[i].impulse[k]), fe__hash_float(&h, r->joints.frames[i].impulse[k]);
            fe__hash_float(&h, r->joints.reactions[i].force[k]), fe__hash_float(&h, r->joints.reactions[i].torque[k]);
        }
    const float *axes = &r->joints.axes[0].axis[0].limit.low;
    for (size_t i = 0; i < RIG_AXES * sizeof(fe__joint_axes) / sizeof(float); ++i) fe__hash_float(&h, axes[i]);
    return fe__hash_end(&h);
}

// a capsule along local x between two points of the plane z = 0
static inline int32_t rig_capsule(rig *r, double x0, double y0, double x1, double y1, double radius, double density)
{
    const double pi = 3.14159265358979;
    double l = sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)), rr = radius * radius;
    double mc = density * pi * rr * l, ms = density * 4.0 / 3.0 * pi * rr * radius, d = l / 2.0 + 3.0 * radius / 8.0;
    double ix = mc * rr / 2.0 + 0.4 * ms * rr;
    double iy = mc * (3.0 * rr + l * l) / 12.0 + ms * (0.4 * rr - (3.0 * radius / 8.0) * (3.0 * radius / 8.0) + d * d);
    int32_t b = rig_body(r, 0.5 * (x0 + x1), 0.5 * (y0 + y1), 0.0, (float)(mc + ms), (float)ix, (float)iy, (float)iy);
    double half = 0.5 * atan2(y1 - y0, x1 - x0);
    r->bodies[b].rotation[2] = (float)sin(half), r->bodies[b].rotation[3] = (float)cos(half);
    return b;
}

#endif
