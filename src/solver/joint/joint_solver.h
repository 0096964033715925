// joint_solver.h - what the solver knows of a joint.
//
// The world fills the records; fe__joint_link puts a joint into the constraint graph; prepare (joint_solver.simd.c)
// turns its parts into lanes of rows; store brings impulses and reactions back. Record 0 of each array is zeros: no
// joint, no axes.
//
// Body B's frame seen from A's:  q = (qA fA)^-1 (qB fB),  d = R(qA fA)^T (anchor of B - anchor of A).  The twist is
// about X, and q = swing twist:
//     twist   t = 2 atan2(q.x, q.w)
//     swing   s = q twist^-1 = (n, 0, s.y, s.z),  n = sqrt(q.w^2 + q.x^2);  as a rotation vector
//             (y, z) = 2 atan2(|s|, n) (s.y, s.z) / |s|
//     cone    (y / a)^2 + (z / b)^2 <= 1, half angles a about Y, b about Z
// q and -q are one rotation: the one with w >= 0 counts, so that t is in [-pi, pi] and a swing at most pi. Impulses are
// those on B, torques about its anchor; A gets the opposite.
#ifndef FE_SOLVER_JOINT_JOINT_SOLVER_H
#define FE_SOLVER_JOINT_JOINT_SOLVER_H
#include "solver/solver_body.h"
#include "solver/tree/forest.h"

// Parts of a joint: each is a lane in a row of a kind of its own. A pass goes through them in this order over all
// joints, so that what holds the anchors together has the last word.
typedef enum fe__joint_part {
    FE__PART_X, // one axis: limits, drive, motor. Linear ones: along an axis of frame A, or between the anchors
    FE__PART_Y,
    FE__PART_Z,
    FE__PART_DISTANCE,
    FE__PART_TWIST, // angular ones
    FE__PART_SWING_Y,
    FE__PART_SWING_Z,
    FE__PART_CONE,
    FE__PART_ROTATION, // three angles at once: drive towards a rotation, friction
    FE__PART_HINGE,    // locks: X of B stays on X of A
    FE__PART_FIXED,    // the frames stay parallel
    // anchors stay together along some axes of frame A; and any point with locked bodies or a softness of its own
    FE__PART_SLIDE,
    FE__PART_POINT, // anchors stay together, with the world's softness
    FE__PARTS
} fe__joint_part;

enum {
    // parts that lock whatever their settings; a distance locks where its limits are one
    FE__LOCKS = 1 << FE__PART_HINGE | 1 << FE__PART_FIXED | 1 << FE__PART_SLIDE | 1 << FE__PART_POINT,
    // which ends are dynamic, so are written
    FE__MOVES_A = 1,
    FE__MOVES_B = 2,
    FE__KINEMATIC_END = 4,
    FE__SIDES_SHIFT = 16, // of them in fe__joint.rows

    // locked translations in fe__joint_frame.locked
    FE__LOCK_X = 1,
    FE__LOCK_Y = 2,
    FE__LOCK_Z = 4,

    FE__JOINT_COLOURS = 31,  // joints of a colour share no dynamic body
    FE__JOINT_OVERFLOW = 31, // one joint a row, in order of creation

    // places in fe__joint_axes.axis
    FE__AXIS_LINEAR = 0, // X, Y, Z; DISTANCE in the first
    FE__AXIS_TWIST = 3,
    FE__AXIS_SWING = 4, // Y, Z; CONE in the first
    FE__AXES = 6
};

#define FE__UNLIMITED 1e30f // as a limit, a cap

// Hot: all that a plain ball joint needs
typedef struct fe__joint {
    _Alignas(64) float arm_a[3]; // anchor from A's centre of mass, A's frame, m
    float hertz;                 // of the locks, 0: the world's
    float arm_b[3];              // of B
    float damping_ratio;         // of the locks
    float impulse[4];            // of POINT in world axes, of SLIDE in frame A, N s in the last substep
    int32_t body_a, body_b;      // records; at least one is dynamic, the other may be of any kind
    int32_t colour;              // -1: not in the graph
    uint32_t rows;               // set by fe__joint_link: 1 << part of each row, FE__MOVES_* << FE__SIDES_SHIFT
} fe__joint;
_Static_assert(sizeof(fe__joint) == 64, "a joint is a cache line");
FE__IS_QUAD(fe__joint, arm_a, hertz);
FE__IS_QUAD(fe__joint, arm_b, damping_ratio);

typedef struct fe__joint_frame {
    _Alignas(64) float frame_a[4]; // unit quaternion x y z w, from the joint's axes to A's frame
    float frame_b[4];              // to B's frame
    float impulse[4];              // of HINGE about Y and Z of A, of FIXED in world axes, N m s in the last substep
    uint64_t serial;               // of creation
    int32_t axes;                  // record of fe__joint_axes, 0: none
    uint16_t parts;                // what it is made of, 1 << part
    uint16_t locked;               // FE__LOCK_* of SLIDE
} fe__joint_frame;
_Static_assert(sizeof(fe__joint_frame) == 64, "a frame is a cache line");

// Mean over the last step of what its locks gave to B; written only where there are such parts
typedef struct fe__joint_reaction {
    float force[4];  // N, world axes
    float torque[4]; // N m, world axes; of HINGE and FIXED
} fe__joint_reaction;

// units of a drive: 1/s and a ratio; N/m and N s/m, N m/rad and N m s/rad
enum { FE__DRIVE_HERTZ, FE__DRIVE_STIFFNESS };

// One degree of freedom: x in m or rad
typedef struct fe__joint_axis {
    _Alignas(16) struct {
        float low, high;            // equal: a lock; FE__UNLIMITED for none. Of CONE: half angles a, b
        float hertz, damping_ratio; // hertz 0: the world's
    } limit;
    struct {
        float target; // x
        float stiffness, damping;
        float cap; // N or N m
    } drive;
    struct {
        float speed;      // m/s or rad/s; 0: friction
        float cap;        // N or N m, 0: off
        float drive_unit; // FE__DRIVE_*, of the drive
        float zero;
    } motor;
    struct {
        float drive, motor, low, high; // in the last substep
    } impulse;
    struct {
        float x;     // at the end of the last step; a twist unwound, see fe__joint_wind
        float force; // or torque, mean over that step
        float zero[2];
    } state;
} fe__joint_axis;
_Static_assert(sizeof(fe__joint_axis) == 80, "an axis is five quads");

// Three angles at once, for ROTATION
typedef struct fe__joint_rotation {
    _Alignas(16) float target[4]; // rotation q
    struct {
        float stiffness, damping, cap; // cap on the torque, N m
        float unit;                    // FE__DRIVE_*
    } drive;
    struct {
        float velocity[3]; // of B against A, axes of frame A, rad/s; 0: friction
        float cap;         // N m, 0: off
    } motor;
    float impulse[4]; // of the drive, world axes
    float motor_impulse[4];
    float torque[4]; // mean over the last step, world axes
} fe__joint_rotation;
_Static_assert(sizeof(fe__joint_rotation) == 96, "a rotation is six quads");

typedef struct fe__joint_axes {
    _Alignas(64) fe__joint_axis axis[FE__AXES];
    fe__joint_rotation rotation;
} fe__joint_axes;
_Static_assert(sizeof(fe__joint_axes) == 576, "axes are nine cache lines");

// The records, and what bounds a graph of them
typedef struct fe__joints {
    fe__joint *joints; // these three by joint index
    fe__joint_frame *frames;
    fe__joint_reaction *reactions;
    fe__joint_axes *axes;
    int32_t linked;      // joints in the graph, awake or asleep
    int32_t rows;        // parts of all of them
    int32_t kinematic;   // joints with a kinematic end
    int32_t overflowing; // joints without a colour, each a row of its own for each of its parts
    uint32_t row_kinds;  // bits of the parts there ever were
    int32_t most;        // joints that one dynamic body ever had
    fe__forest forest;   // of all of them
} fe__joints;

// Into the graph: a colour, and which rows stand for its parts (locks and types of the bodies decide: unlink before
// they change, link after). The caller sets fe__solver.graph_changed. A joint of two bodies that are not dynamic is
// never linked.
void fe__joint_link(fe__joints *joints, fe__body *bodies, int32_t joint);
// The same for one that has its colour and its rows already, from a snapshot. 0: they are not what its bodies, its
// parts and the other joints let them be; it is of no use then
int32_t fe__joint_relink(fe__joints *joints, fe__body *bodies, int32_t joint);
void fe__joint_unlink(fe__joints *joints, fe__body *bodies, int32_t joint); // keeps its impulses
void fe__joint_forget_impulses(fe__joints *joints, int32_t joint);

// ---- readings, from the poses as they are ---------------------------------------------------------------------------
typedef struct fe__joint_pose {
    fe_quat q;
    fe_vec3 d;                     // m, frame A
    float length;                  // |d|
    float twist, swing_y, swing_z; // rad
} fe__joint_pose;
void fe__joint_pose_of(const fe__joints *joints, const fe__body *bodies, int32_t joint, fe__joint_pose *out_pose);
fe_dvec3 fe__joint_gap(const fe__joint *joint, const fe__body *bodies); // anchor of B - anchor of A, m, world axes
// The angle next to `before` that is `twist` plus whole turns. A twist with a range is unwound: it goes on beyond pi,
// so that a limit there holds; FE__PART_TWIST's state.x remembers where it was. Whoever makes or moves a joint writes
// it: fe__joint_wind(twist, middle of the range).
float fe__joint_wind(float twist, float before);
// Mean force and torque of all parts on B over the last step, N and N m, world axes; the torque about B's anchor.
void fe__joint_reaction_of(const fe__joints *joints, const fe__body *bodies, int32_t joint, fe_vec3 *out_force,
                           fe_vec3 *out_torque);

#endif
