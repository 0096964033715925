// joint.h - the cold half of a joint and the lists that it is in: of both bodies, of all joints by creation, and of the
// joints that are awake. The hot half, which the solver reads, is in joint_solver.h.
#ifndef FE_WORLD_JOINT_H
#define FE_WORLD_JOINT_H
#include "core/math.h"
#include "world/contact.h"
#include "world/world.h"

#include <stddef.h>

// ---- joint record ---------------------------------------------------------------------------------------------------
// Record i here, fe__joints' records i and slot i - 1 of the handles are one thing; index 0 is no joint. Settings that
// only one type has lie in a pool for that type, so that a cloth of ball joints does not pay for configurable ones.

// A definition of any type. All begin with `common`.
typedef union fe__joint_any {
    fe_joint_def common;
    fe_distance_joint_def distance;
    fe_ball_joint_def ball;
    fe_hinge_joint_def hinge;
    fe_fixed_joint_def fixed;
    fe_configurable_joint_def configurable;
} fe__joint_any;

enum { FE__JOINT_FRONT = sizeof(fe_joint_def) }; // bytes; the settings of the type follow
_Static_assert(offsetof(fe_distance_joint_def, limit_enabled) == FE__JOINT_FRONT &&
                   offsetof(fe_ball_joint_def, cone_enabled) == FE__JOINT_FRONT &&
                   offsetof(fe_hinge_joint_def, limit_enabled) == FE__JOINT_FRONT &&
                   offsetof(fe_fixed_joint_def, angular_hertz) == FE__JOINT_FRONT &&
                   offsetof(fe_configurable_joint_def, axes) == FE__JOINT_FRONT,
               "all definitions have one front");

enum {
    FE__JOINT_ENABLED = 1,
    FE__JOINT_COLLIDES = 2 // 1: the bodies may touch
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

// Bytes of a type's definition
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

// ---- lists ----------------------------------------------------------------------------------------------------------

static inline int32_t fe__joint_side(const fe__joint_record *r, int32_t body) { return r->body[0] == body ? 0 : 1; }
// The next joint in the list of `body`, 0: none
static inline int32_t fe__next_joint(const fe_world *world, int32_t joint, int32_t body)
{
    const fe__joint_record *r = world->joint_records + joint;
    return r->links[fe__joint_side(r, body)].next;
}
static inline int32_t fe__joint_other(const fe_world *world, int32_t joint, int32_t body)
{
    const fe__joint_record *r = world->joint_records + joint;
    return r->body[!fe__joint_side(r, body)];
}
void fe__joint_add_to_body(fe_world *world, int32_t joint, int32_t body);
void fe__joint_remove_from_body(fe_world *world, int32_t joint, int32_t body);
void fe__joint_append_to_order(fe_world *world, int32_t joint);
void fe__joint_remove_from_order(fe_world *world, int32_t joint);

void fe__joint_awaken(fe_world *world, int32_t joint);      // if a dynamic end is awake
void fe__joint_retire(fe_world *world, int32_t joint);      // if none is
void fe__joint_leave_awake(fe_world *world, int32_t joint); // in any case

// 1: the joint keeps its bodies from touching.
static inline int32_t fe__joint_parts_bodies(const fe__joint_record *r)
{
    return (r->flags & (FE__JOINT_ENABLED | FE__JOINT_COLLIDES)) == FE__JOINT_ENABLED;
}
int32_t fe__bodies_joined(const fe_world *world, int32_t body_a, int32_t body_b); // by such a joint

// ---- anchor ---------------------------------------------------------------------------------------------------------
// An anchor is the end of a joint that is the world. To the solver it is a static body without shapes, at the point
// that the joint's frame is measured from. It has a slot among the bodies, but no handle, no serial, and no place in
// the order of creation: nothing but its joint finds it.

int32_t fe__anchor_create(fe_world *world, fe_dvec3 origin);          // body index; after fe__reserve_bodies
void fe__anchor_open(fe_world *world, int32_t body, fe_dvec3 origin); // writes the record of a hidden slot
void fe__anchor_destroy(fe_world *world, int32_t body);               // after its joint
void fe__anchor_move(fe_world *world, int32_t body, fe_dvec3 origin);
static inline int32_t fe__is_anchor(const fe_world *world, int32_t body)
{
    return (world->bodies[body].flags & FE__BODY_ANCHOR) != 0;
}

// ---- drives ---------------------------------------------------------------------------------------------------------
// The members of a joint's definition that drive it along a degree of freedom (fe_dof).

// The motor's speed, and the spring's target; NULL: the joint has none there
float *fe__joint_motor_speed(fe__joint_any *def, int32_t type, int32_t dof);
float *fe__joint_target(fe__joint_any *def, int32_t type, int32_t dof);
// The range that a definition may have for the target there, m or rad
void fe__joint_target_range(int32_t type, int32_t dof, float *out_least, float *out_most);
// The degree of freedom of a joint that has one, or the first of several; -1: none, or a ball joint
int32_t fe__joint_free_dof(const fe__joint_any *def, int32_t type);

#endif
