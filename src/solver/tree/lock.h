// lock.h - what the trees read of a lock and write to it: a lane of the sweep's rows, in scalars.
//
// Rows are as wide as the SIMD set, or thin: each width has its own functions for them (joint/lock_lanes.inl). The
// locks of one tree may lie in rows of both.
#ifndef FE_SOLVER_TREE_LOCK_H
#define FE_SOLVER_TREE_LOCK_H
#include "core/math.h"
#include "solver/tree/forest.h"

enum { FE__MOST_LOCKS = 3 }; // parts of a joint that are locks

// Where a link of a tree finds its bodies and the rows of its joint
typedef struct fe__tree_place {
    int32_t line, parent_line; // of the body, of the joint's other end
    int32_t locks;
    struct {
        const struct fe__lock_lanes *of; // of the row's width
        int32_t part, lane;              // FE__PART_*; its lane in the row
        int64_t row;                     // bytes into the batch's row memory
    } lock[FE__MOST_LOCKS];
} fe__tree_place;

// A lock as the sweep holds it. Which members are filled depends on the part. World axes; arms, gap, frames and axes
// are those of the step's beginning.
typedef struct fe__lock {
    int32_t line_a, line_b;
    fe_vec3 arm_a, arm_b;   // POINT, SLIDE, DISTANCE: from the centres to the anchors, m
    fe_vec3 gap;            // anchor of B - anchor of A, m
    fe_quat frame;          // SLIDE, DISTANCE: A's; FIXED: QB QA^-1
    fe_vec3 t1, t2, axis_b; // HINGE
    float keeps[3];         // SLIDE: 1 for a locked axis of the frame, 0 for a free one
    float length;           // DISTANCE: wanted, m
    float impulse[3];       // POINT: world; SLIDE: along the frame's axes; DISTANCE: along the rod; N s
} fe__lock;

struct fe__velocity_line;

// `row` and `lane` as in fe__tree_place
typedef struct fe__lock_lanes {
    int32_t width; // lanes of a row
    // from a row of POINT to the x of its impulses, and from there to that of their sums over the step, in floats; y
    // and z follow, a row of lanes each
    int32_t point_impulse, point_sum;
    void (*read)(int32_t part, const void *row, int32_t lane, fe__lock *out_lock);
    // Adds impulses in the order of the lock's rows, with `total` to the sum over the step too. Returns how many.
    int32_t (*add)(int32_t part, void *row, int32_t lane, const double *impulse, int32_t total);
    // Moves the impulses to `impulse` and leaves none. Returns how many.
    int32_t (*take)(int32_t part, void *row, int32_t lane, double *impulse);
    // squares: by how much the lock is open, m2; how fast its points come apart, (m/s)2, by the velocities of both ends
    float (*gap)(int32_t part, const void *row, int32_t lane);
    float (*speed)(int32_t part, const void *row, int32_t lane, const struct fe__velocity_line *a,
                   const struct fe__velocity_line *b);
} fe__lock_lanes;

#endif
