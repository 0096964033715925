// world.h - the world: plain arrays of records, lists by index, and the stages' scratch.
//
// Below the API nothing checks handles or arguments: an index is a living record (asserts say so). Whatever a call
// needs is reserved before it changes anything, so that a failed allocation leaves no trace.
#ifndef FE_WORLD_WORLD_H
#define FE_WORLD_WORLD_H
#include "broadphase/pair_set.h"
#include "broadphase/tree.h"
#include "collision/form/form.h"
#include "collision/form/heightfield.h"
#include "collision/manifold/patch.h"
#include "core/id_pool.h"
#include "core/memory.h"
#include "core/owner.h"
#include "core/threads.h"
#include "solver/contact/skip_test.h"
#include "solver/solver.h"
#include "solver/solver_body.h"
#include "store/store.h"
#include "world/clusters.h"

// Records that world/contact.h and world/joint.h define.
typedef struct fe__pair fe__pair;
typedef struct fe__points fe__points;
typedef struct fe__features fe__features;
typedef struct fe__extra fe__extra;
typedef struct fe__pair_event_record fe__pair_event_record;
typedef struct fe__body_event_record fe__body_event_record;
typedef struct fe__hit_event_record fe__hit_event_record;
typedef struct fe__joint_event_record fe__joint_event_record;
typedef struct fe__joint_record fe__joint_record;

enum { FE__JOINT_TYPES = FE_JOINT_CONFIGURABLE + 1 }; // 0 is none

// An asset of the store that shapes of this world have.
typedef struct fe__asset_use {
    int32_t asset;
    int32_t first_user; // shapes, threaded through fe__shape.next_user
} fe__asset_use;

// clang-format off
struct fe_world {
    fe__memory memory;
    fe__workers workers;
    fe__owner owner;
    uint64_t user_data;
    int32_t number; // the world's number, part of every handle

    struct fe_history *first_history; // histories that keep frames of this world (snapshot/history.h)
    const struct fe_batch *batch;     // the batch that owns the world, and nobody else; NULL: none (batch/batch.h)

    fe_pair_filter pair_filter; // the host's; NULL: none
    void *pair_filter_user;
    fe_recorder *recorder;      // notes each call that changes the world; NULL: none

    // settings
    fe_vec3 gravity;
    int32_t substeps;
    fe_world_tuning tuning;
    const fe__kernels *kernels;       // the SIMD set's
    const fe__mesh_casts *mesh_casts; // the SIMD set's
    int32_t simd;                     // fe_simd

    // records
    fe__id_pool body_ids, shape_ids;
    fe__body *bodies;
    fe__odometer *odometers; // by body
    fe__drift *drifts;       // by body
    int32_t body_capacity, odometer_capacity, drift_capacity;
    fe__shape *shapes;
    int32_t shape_capacity;
    fe_store *store;         // assets of the shapes: its own, its definition's, or that of the world it was cloned from
    fe__store_member member; // in the store's list
    fe__asset_use *uses;     // by rising asset; read and written under the store's lock, as their number is
    int32_t use_count, use_capacity;
    uint64_t next_serial;                      // for bodies, shapes and joints alike
    int32_t first_body, last_body, body_count; // in the order of creation
    int32_t static_count, kinematic_count;     // how many of body_count are static, kinematic
    int32_t shape_count, part_count;           // parts of compounds count among the shapes

    // contacts: hot and cold halves by the same index; free ones are linked through links[0].next
    fe__contact *contacts;
    fe__pair *pairs;
    int32_t contact_capacity, pair_capacity;
    // points by fe__contact.points, for contacts that have any; see contact_solver.h
    fe__points *points;
    fe__features *features;
    uint64_t *point_serials;          // fe__pair_serial of A and of B, two a record
    fe__extra *extras;                // mixed materials of special rows; none before the first of them
    int32_t *point_order;             // a permutation of the records: the first point_count are in use, or record 0
    _Atomic int32_t point_count;      // record 0 among them
    int32_t point_capacity, feature_capacity, point_serial_capacity, extra_capacity, point_order_capacity;
    int32_t pair_limit;               // indices below were used
    int32_t first_free_pair;          // -1: none
    int32_t pair_count, linked_count; // patches count with their head; each that is linked counts
    int32_t awake_linked_count;       // linked ones in the list of awake pairs
    int32_t field_pair_count;         // pairs with a heightfield or mesh
    int32_t trigger_pair_count;       // pairs with a trigger
    // bounds for what a step may need; they only grow
    int32_t pair_colours, static_colours; // all that there ever were are among the first so many
    uint32_t row_kinds;                   // 1 << FE__ROW_* of every pair
    int32_t wants_hits;                   // 1: a shape asked for hit events
    int32_t has_bullets;                  // 1: a body was one
    int32_t has_stale_sizes;              // 1: a body has FE__BODY_SIZES_STALE
    _Atomic int32_t swiftest;             // largest speed over thickness, 1/s: bits of a float, which rise with it
    fe__clusters clusters;
    fe__pair_set pair_set;                // pairs by shape indices
    fe__pair_set encounter_set;           // encounters (encounter.h) by the indices of the whole shapes
    fe__record_pool encounters;
    int32_t encounter_count, part_pair_count; // part_pair_count: pairs that are in an encounter
    int32_t first_changed;                    // encounter to report, 0: none
    fe__pair_set ignored;                     // records of fe_world_ignore_collision, by body indices (filter.h)
    fe__record_pool ignores;

    // joints: what the solver reads, and the rest by the same index; slot i - 1 of the handles is joint i
    fe__id_pool joint_ids;
    fe__joints joints;
    fe__joint_record *joint_records;
    int32_t joint_capacity[4];
    fe__record_pool joint_axes;                      // fe__joints.axes
    fe__record_pool joint_settings[FE__JOINT_TYPES]; // settings of a type beyond the common front of definitions
    int32_t first_joint, last_joint, joint_count;    // in the order of creation
    int32_t breakable_count;                         // joints with a break force or torque

    // awake records: dense lists of indices, in no order that matters
    int32_t *awake_bodies;
    int32_t awake_body_count, awake_body_capacity;
    int32_t *awake_pairs;    // the pair, or ~pair while it is deferred, see skip_test.h
    fe__deferral *deferrals; // by place in that list
    int32_t awake_pair_count, awake_pair_capacity, deferral_capacity;
    int32_t *awake_joints;
    int32_t awake_joint_count, awake_joint_capacity;

    // broad phase
    fe__tree static_tree, moving_tree; // proxies are shape indices; kinematic bodies' are in the moving tree
    int32_t *planes;                   // shapes
    int32_t plane_count, plane_capacity;
    // Shapes whose box is new since the last step's pairs. A shape that has left since is still listed (neither IN_TREE
    // nor IN_PLANES): skip it. Emptying the list clears FE__SHAPE_MOVED of all in it.
    int32_t *moved;
    int32_t moved_count, moved_capacity;

    // events of the last step, and exits owed to the next one by pairs that ended in between
    fe__pair_event_record *pair_events;
    int32_t pair_event_count, pair_event_capacity;
    int32_t first_owed, owed_count; // records of ended pairs that owe an exit, linked as free ones are; 0: none
    fe__body_event_record *body_events;
    int32_t body_event_count, body_event_capacity;
    int32_t *disturbed; // bodies that woke or fell asleep since the last step's events, each once
    int32_t disturbed_count, disturbed_capacity;
    fe__hit_event_record *hit_events;
    int32_t hit_event_count, hit_event_capacity;
    fe__joint_event_record *joint_events;
    int32_t joint_event_count, joint_event_capacity;

    fe__solver solver;                // graph, rows, body lines
    struct fe__step_scratch *scratch; // shared by the stages (world_memory.h)
    fe__memory *step_memory;          // allocates solver and scratch: `memory`, or that of the workroom that lends them
    int64_t step_number;              // number of the last step, 0: none yet
    float last_h;                     // substep length that the stored impulses belong to, s, 0: none
    float last_dt;                    // length of the last step that moved anything, s: boxes look so far ahead

    fe_profile profile;
    fe_counters counters;
};
// clang-format on

// The records of a shape: its own, then those of its parts. -1: no more
static inline int32_t fe__next_of_whole(const fe_world *world, int32_t whole, int32_t record)
{
    int32_t next = world->shapes[record].next;
    return next >= 0 && world->shapes[next].parent == whole ? next : -1;
}
// 1: the record is the shape's, or that of a part of it.
static inline int32_t fe__is_of_whole(const fe_world *world, int32_t record, int32_t whole)
{
    return record == whole || world->shapes[record].parent == whole;
}

// ---- handles --------------------------------------------------------------------------------------------------------

static inline fe_handle fe__body_handle(const fe_world *world, int32_t body)
{
    return fe__id_pool_handle(&world->body_ids, body);
}
// The handle of a shape; a part has its compound's.
static inline fe_handle fe__shape_handle(const fe_world *world, int32_t shape)
{
    return fe__id_pool_handle(&world->shape_ids, fe__whole_shape(world->shapes, shape));
}
static inline fe_handle fe__joint_handle(const fe_world *world, int32_t joint)
{
    return fe__id_pool_handle(&world->joint_ids, joint - 1); // joint 0 is none
}

#endif
