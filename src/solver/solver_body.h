// solver_body.h - the record of a body.
//
// Stable: it stays at the index of its handle while the body lives. The first four lines are what a step reads and
// writes, in quads that a wide kernel gathers one by one; the rest is for the API and for life and death. Lists are
// kept by index, never by pointer.
#ifndef FE_SOLVER_SOLVER_BODY_H
#define FE_SOLVER_SOLVER_BODY_H
#include "core/math.h"

enum {
    FE__BODY_ENABLED = 1,
    FE__BODY_BULLET = 2,
    FE__BODY_SLEEP_ALLOWED = 4,
    FE__BODY_MASS_GIVEN = 8,      // mass data set by hand: shapes no longer change it
    FE__BODY_LOST = 16,           // overflowed in this step, see finalize.c
    FE__BODY_ISOTROPIC = 32,      // equal principal moments, or a rotation lock: no gyroscopic torque
    FE__BODY_STARTED = 64,        // scratch of a walk: over an island, over a list of handles
    FE__BODY_IGNORES = 128,       // first_ignored is not 0
    FE__BODY_DISTURBED = 256,     // in the list of bodies that woke or fell asleep
    FE__BODY_SEEN_AWAKE = 512,    // when the events of the last step were written
    FE__BODY_CHASED = 1024,       // in the list of bodies that continuous collision looks at
    FE__BODY_STRAINED = 2048,     // bears many times its weight, or a body many times as heavy just fell on it
    FE__BODY_HELD = 4096,         // joined to others, and stopped by continuous collision in this step: joined_bodies.h
    FE__BODY_STRETCHED = 8192,    // a joint of it is wide open
    FE__BODY_ANCHOR = 16384,      // the end of a joint that is the world, see world/joint.h
    FE__BODY_SIZES_STALE = 32768, // a static one: reach and thickness are of shapes that it had
    FE__BODY_BURDENED = 65536     // bore many times its weight in the last step, not in the one before
};

typedef struct fe__body {
    // pose. centre = high + low to 48 bits: the difference of two bodies' centres, taken in floats, is exact to the
    // last digit of a float
    _Alignas(64) float centre_high[4]; // centre of mass, m, rounded to float, 0
    float centre_low[3];               // what the rounding left
    float speed;                       // of the fastest point, m/s, at least
    float rotation[4];                 // unit quaternion of the body's frame
    float local_centre[3];             // of mass, m, body's frame
    float reach;                       // the largest distance from it to a point of the body, m
    // velocities and what changes them
    float velocity[3];     // of the centre of mass, m/s
    float inverse_mass;    // 1/kg, 0 unless dynamic
    float spin[3];         // rad/s, world axes
    float lock_bits;       // a whole number: linear | angular << 3
    float force[3];        // N, during the next step
    float linear_damping;  // 1/s
    float torque[3];       // N m, during the next step
    float angular_damping; // 1/s
    // mass
    float inertia[3];      // principal moments, kg m2; of a dynamic body > 0
    float mass;            // kg
    float inertia_axes[4]; // their axes in the body's frame
    float gravity_scale;
    float thickness;       // smallest half width of its shapes, m; FLT_MAX without any
    float sleep_threshold; // m/s
    float sleep_timer;     // s below the threshold
    int32_t line;          // in the solver while awake, set when the graph is built
    int32_t awake_index;   // place in the list of awake bodies, -1: asleep, static or disabled
    int32_t island;        // of the last graph, while awake
    int32_t type;          // fe_body_type
    uint32_t flags;        // FE__BODY_*
    // pose in full
    double centre[3]; // of mass, m
    double origin[3]; // of the body's frame, m
    // colours taken by its contacts in the constraint graph, one bit each
    uint64_t colours[2];
    uint32_t drawn;                       // what its last contact's colour was drawn with, 0 at first
    uint32_t joint_colours;               // the same of its joints
    int32_t joint_count;                  // linked ones, see joint_solver.h
    uint64_t serial;                      // of creation, never reused
    int32_t first_contact, contact_count; // list of pairs, threaded through fe__pair.links
    int32_t static_pairs;                 // of them, those with a static body
    // of the stage or the call at hand, else 0
    union {
        int32_t coming_contacts; // while a step reserves: candidates with this body
        int32_t place_before;    // while its island gathers to fall asleep: its place among the awake until then
    };
    int32_t first_shape, last_shape, shape_count; // list in the order of creation
    // all joints, threaded through fe__joint_record.links in the order of creation; 0: none
    int32_t first_joint, last_joint, joint_total;
    int32_t first_ignored; // list of fe_world.ignores, 0: none
    int32_t locked;        // 1: any lock bit is set
    int64_t moved_step;    // number of the last step that moved it, 0: none
    uint64_t user_data;
    int32_t order_next, order_previous; // list of all bodies in the order of creation
    // rad/s: the spin after the last substep less the one it rotated by, 0; of joined bodies, see joined_change
    _Alignas(16) float relaxed[4];
} fe__body;
_Static_assert(sizeof(fe__body) % 64 == 0, "bodies are made of cache lines");

// By body: how far it went, net, in the window of time that its sleep timer is in
typedef struct fe__drift {
    float shift[3]; // of the centre, m
    float turn[3];  // rad: small rotations add as vectors
} fe__drift;

FE__IS_QUAD(fe__body, centre_low, speed);
FE__IS_QUAD(fe__body, local_centre, reach);
FE__IS_QUAD(fe__body, velocity, inverse_mass);
FE__IS_QUAD(fe__body, spin, lock_bits);
FE__IS_QUAD(fe__body, force, linear_damping);
FE__IS_QUAD(fe__body, torque, angular_damping);
FE__IS_QUAD(fe__body, inertia, mass);
FE__IS_QUAD(fe__body, relaxed, relaxed[3]);

#endif
