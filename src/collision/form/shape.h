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

// A serial holds, from the low bits, the number of a part + 1 (0: no part), then that of creation. So parts come behind
// their compound, and before what was created after it.
enum { FE__PART_BITS = 16 };
static inline int32_t fe__part_of_serial(uint64_t serial)
{
    return (int32_t)(serial & ((1u << FE__PART_BITS) - 1)) - 1;
}
static inline uint64_t fe__serial_of_whole(uint64_t serial) { return serial >> FE__PART_BITS << FE__PART_BITS; }

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
    uint64_t serial;        // of creation and of the part, never reused by another shape
    uint64_t body_serial;   // of its body
    uint64_t user_data;
    int32_t next_user; // of the same asset, -1: none
    int32_t parent;    // the shape whose part it is, right before the parts in the body's list; -1: it is no part
} fe__shape;

// What the caller knows: of a part, its compound
static inline int32_t fe__whole_shape(const fe__shape *shapes, int32_t shape)
{
    int32_t parent = shapes[shape].parent;
    return parent >= 0 ? parent : shape;
}

#endif
