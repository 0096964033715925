// joint_record.h - the cold half of a joint: what the API set, and its places in lists.
//
// Record i here, fe__joints' records i and slot i - 1 of the handles are one thing; index 0 is no joint. What only one
// type has lies in a pool of that type's settings, so that a cloth of ball joints does not pay for configurable ones.
#ifndef FE_WORLD_JOINT_RECORD_H
#define FE_WORLD_JOINT_RECORD_H
#include "core/math.h"
#include "world/pair.h"

#include <stddef.h>

enum { FE__JOINT_TYPES = FE_JOINT_CONFIGURABLE + 1 }; // 0 is none

// A definition of any type; `common` is the front of all of them
typedef union fe__joint_any {
    fe_joint_def common;
    fe_distance_joint_def distance;
    fe_ball_joint_def ball;
    fe_hinge_joint_def hinge;
    fe_fixed_joint_def fixed;
    fe_configurable_joint_def configurable;
} fe__joint_any;

enum { FE__JOINT_FRONT = sizeof(fe_joint_def) }; // bytes: what follows is the type's own
_Static_assert(offsetof(fe_distance_joint_def, limit_enabled) == FE__JOINT_FRONT &&
                   offsetof(fe_ball_joint_def, cone_enabled) == FE__JOINT_FRONT &&
                   offsetof(fe_hinge_joint_def, limit_enabled) == FE__JOINT_FRONT &&
                   offsetof(fe_fixed_joint_def, angular_hertz) == FE__JOINT_FRONT &&
                   offsetof(fe_configurable_joint_def, axes) == FE__JOINT_FRONT,
               "all definitions have one front");

enum {
    FE__JOINT_ENABLED = 1,
    FE__JOINT_COLLIDES = 2 // its bodies may touch
};

typedef struct fe__joint_record {
    int32_t type;                       // fe_joint_type, 0: a free record
    uint32_t flags;                     // FE__JOINT_*
    int32_t body[2];                    // A, B
    fe__link links[2];                  // joints of A, of B in the order of creation, 0: none
    int32_t order_next, order_previous; // all joints in the order of creation, 0: none
    int32_t awake_index;                // place in the list of awake joints, -1: no dynamic end is awake
    int32_t settings;                   // record in the pool of its type
    int32_t shift;                      // the solver's X is axis X + shift of its frames
    fe_frame frame[2];                  // in A's and B's space, unit rotations
    float hertz, damping_ratio;
    float break_force, break_torque; // N, N m, 0: never
    uint64_t user_data;
    fe_dvec3 world_origin; // m, where the frame of an end that is the world is measured from
} fe__joint_record;

// bytes of a type's definition
static inline int32_t fe__joint_def_size(int32_t type)
{
    static const int32_t sizes[FE__JOINT_TYPES] = {0,
                                                   sizeof(fe_distance_joint_def),
                                                   sizeof(fe_ball_joint_def),
                                                   sizeof(fe_hinge_joint_def),
                                                   sizeof(fe_fixed_joint_def),
                                                   sizeof(fe_configurable_joint_def)};
    return sizes[type];
}

#endif
