// shape.h - the record of a shape: form, local pose, material, filter; where it is now and its box in the broad phase.
#ifndef FE_COLLISION_FORM_SHAPE_H
#define FE_COLLISION_FORM_SHAPE_H
#include "collision/form/form.h"

enum {
    FE__SHAPE_TRIGGER = 1,
    FE__SHAPE_CENTRED = 2, // local pose is the identity
    FE__SHAPE_IN_TREE = 4,
    FE__SHAPE_IN_PLANES = 8, // planes are in a list, not in a tree
    FE__SHAPE_JUDGED = 32,   // the pair filter judges its new pairs
    FE__SHAPE_ONE_WAY = 64,  // holds back only what comes against one_way
    FE__SHAPE_MOVED = 16     // in the list of proxies whose box is new: looks for pairs in the next step
};

// First what a query reads: two cache lines.
typedef struct fe__shape {
    uint32_t layer, mask;
    uint32_t flags; // FE__SHAPE_*
    int32_t body;
    fe__pose pose; // in the world, follows the body
    fe__form form;
    fe_vec3 local_position; // m, body's frame
    fe_quat local_rotation;
    fe_material material;
    int32_t group;   // 0: none
    uint32_t events; // fe_shape_events
    float density;
    float arm; // from the body's centre of mass to the farthest point of its core, m; 0 for what is static only
    fe_vec3 surface_velocity;
    fe_vec3 one_way;        // its own frame, any length but zero
    int32_t next, previous; // of the body's shapes, in the order of creation
    uint64_t serial;        // of creation, never reused
    uint64_t body_serial;   // of its body
    uint64_t user_data;
    int32_t next_user; // of the same heightfield, -1: none
} fe__shape;

#endif
