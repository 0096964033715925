// world.h - the world: plain arrays of records, lists by index, and the stages' scratch.
//
// Below the API nothing checks handles or arguments: an index is a living record (asserts say so). Whatever a call needs is reserved before
// it changes anything, so that a failed allocation leaves no trace.
#ifndef FE_WORLD_WORLD_H
#define FE_WORLD_WORLD_H
#include "broadphase/pair_set.h"
#include "broadphase/tree.h"
#include "core/id_pool.h"
#include "core/memory.h"
#include "core/record_pool.h"
#include "core/threads.h"
#include "solver/solver.h"
#include "solver/body.h"
#include "world/clusters.h"
#include "world/joint_record.h"
#include "world/pair.h"
#include "world/wait.h"
#include "collision/form/heightfield.h"
#include "collision/form/shape.h"
#include "collision/manifold/terrain.h"

// An event as the step writes it. Serials order it; handles name it also after a destruction.
typedef struct fe__pair_event_record {
    uint64_t serial_a, serial_b;
    fe_pair_event event;
} fe__pair_event_record;

typedef struct fe__body_event_record {
    uint64_t serial;
    fe_body_event event;
} fe__body_event_record;

typedef struct fe__hit_event_record {
    uint64_t serial_a, serial_b;
    fe_hit_event event;
} fe__hit_event_record;

// What shapes share. Record i of the assets and record i of the heightfields are one thing.
typedef struct fe__asset {
    fe_material *materials; // of the cells
    int32_t material_count;
    int32_t special;    // a material needs special rows
    int32_t first_user; // shapes, threaded through fe__shape.next_user; -1: none
    int32_t destroyed;  // by its owner: it goes with its last user
} fe__asset;

struct fe_world {
    fe__memory memory;
    fe__workers workers;
    fe_pool *own_pool; // or NULL
    _Atomic int32_t stepping;
    uint64_t user_data;

    // settings
    fe_vec3 gravity;
    int32_t substeps;
    fe_world_tuning tuning;
    const fe__kernels *kernels; // of the SIMD set
    int32_t simd;               // fe_simd

    // records
    fe__id_pool body_ids, shape_ids, asset_ids;
    fe__body *bodies;
    fe__odometer *odometers; // by body
    int32_t body_capacity, odometer_capacity;
    fe__shape *shapes;
    int32_t shape_capacity;
    fe__heightfield *fields; // heightfields, and the rest of the same assets
    fe__asset *assets;
    int32_t field_capacity, asset_capacity;
    uint64_t next_serial;                      // of bodies, shapes and joints alike
    int32_t first_body, last_body, body_count; // in the order of creation
    int32_t static_count;                      // of them
    int32_t shape_count;

    // contacts: hot and cold halves by the same index; free ones are linked through links[0].next
    fe__contact *contacts;
    fe__pair *pairs;
    fe__extra *extras;      // mixed materials of special rows
    uint64_t *pair_serials; // of shape A, of shape B: the order of everything
    int32_t contact_capacity, pair_capacity, extra_capacity, serial_capacity;
    int32_t pair_limit;               // indices below were used
    int32_t first_free_pair;          // -1: none
    int32_t pair_count, linked_count; // patches count with their head, and each that is linked
    int32_t field_pair_count;         // with a heightfield in them
    // bounds for what a step may need; they only grow
    int32_t most_contacts;    // of one dynamic body
    uint32_t row_kinds;       // 1 << FE__ROW_* of every pair
    int32_t wants_hits;       // a shape asked for hit events
    int32_t has_bullets;      // a body was one
    _Atomic int32_t swiftest; // speed over thickness, 1/s, of the body that has most of it: the bits of a float, which rise with it
    fe__clusters clusters;
    fe__pair_set pair_set; // by shape indices
    fe__pair_set ignored;  // by body indices: fe_world_ignore_collision

    // joints: what the solver reads, and the rest by the same index; slot i - 1 of the handles is joint i
    fe__id_pool joint_ids;
    fe__joints joints;
    fe__joint_record *joint_records;
    int32_t joint_capacity[4];
    fe__record_pool joint_axes;                      // fe__joints.axes
    fe__record_pool joint_settings[FE__JOINT_TYPES]; // what a type's definition has beyond the common front
    int32_t first_joint, last_joint, joint_count;    // in the order of creation
    int32_t breakable_count;                         // joints with a break force or torque

    // who is awake: dense lists of indices, in no order that matters
    int32_t *awake_bodies;
    int32_t awake_body_count, awake_body_capacity;
    int32_t *awake_pairs; // or ~pair, see wait.h
    fe__wait *waits;      // beside it
    int32_t awake_pair_count, awake_pair_capacity, wait_capacity;
    int32_t *awake_joints;
    int32_t awake_joint_count, awake_joint_capacity;

    // broad phase
    fe__tree static_tree, moving_tree; // proxies are shape indices; kinematic bodies' are in the moving tree
    int32_t *planes;                   // shapes
    int32_t plane_count, plane_capacity;
    // shapes whose box is new since the last step's pairs. One that has left since is still listed (neither IN_TREE nor IN_PLANES): skip
    // it. Who empties the list clears FE__SHAPE_MOVED of all in it
    int32_t *moved;
    int32_t moved_count, moved_capacity;

    // events of the last step, and exits owed to the next one by what ended in between
    fe__pair_event_record *pair_events;
    int32_t pair_event_count, pair_event_capacity;
    int32_t first_owed, owed_count; // records of ended pairs that owe an exit, linked as free ones are; 0: none
    fe__body_event_record *body_events;
    int32_t body_event_count, body_event_capacity;
    int32_t *stirred; // bodies that woke or fell asleep since the last step's events, each once
    int32_t stirred_count, stirred_capacity;
    fe__hit_event_record *hit_events;
    int32_t hit_event_count, hit_event_capacity;
    fe__joint_event_record *joint_events;
    int32_t joint_event_count, joint_event_capacity;

    fe__solver solver;                // graph, rows, body lines
    struct fe__step_scratch *scratch; // of the step's stages (step.h)
    int64_t step_number;              // of the last step, 0: none yet
    float last_h;                     // substep length that the stored impulses belong to, s, 0: none
    float last_dt;                    // of the last step that moved anything, s: how far ahead boxes look

    fe_profile profile;
    fe_counters counters;
};

// ---- the world (world.c) --------------------------------------------------------------------------------------------------------
// An empty world, all its memory from the definition's allocator. FE_ERROR_MEMORY; FE_ERROR_UNSUPPORTED: no such SIMD set here.
fe_result fe__world_create(const fe_world_def *def, fe_world **out_world);
void fe__world_destroy(fe_world *world);
fe_world_tuning fe__default_tuning(void);

// ---- life of bodies (bodies.c) ----------------------------------------------------------------------------------------------------
// What cannot fail returns void; otherwise FE_OK or the reason, with nothing changed.
fe_result fe__reserve_bodies(fe_world *world, int32_t extra);      // the `extra` creations that follow cannot fail
int32_t fe__body_create(fe_world *world, const fe_body_def *def); // index; room was reserved
void fe__body_destroy(fe_world *world, int32_t body);
fe_result fe__body_set_type(fe_world *world, int32_t body, int32_t type);
fe_result fe__body_set_enabled(fe_world *world, int32_t body, int32_t enabled);
void fe__body_set_transform(fe_world *world, int32_t body, const fe_transform *transform); // wakes
void fe__body_set_locks(fe_world *world, int32_t body, uint32_t linear, uint32_t angular);
void fe__body_place_centre(fe__body *body);                          // centre from origin, rotation and local centre
void fe__body_place(fe_world *world, int32_t body);                  // shapes' poses from the body's
void fe__body_note_speed(fe_world *world, fe__body *body);           // after each change of velocity; on any thread
void fe__body_note_swiftness(fe_world *world, const fe__body *body); // after each change of size
void fe__body_stretch_boxes(fe_world *world, int32_t body);          // boxes that no longer hold what the next step may reach
void fe__body_disturb(fe_world *world, int32_t body);                // wakes it and what touches it; of a static body what touches it
fe_quat fe__unit_rotation(fe_quat q);                                // unchanged when its length is 1 already, q/|q| else

// ---- motion between steps (motion.c) ----------------------------------------------------------------------------------------------
// NULL: as it is. Locked components stay 0; wakes the body unless both are 0. Not for static bodies.
void fe__body_set_velocity(fe_world *world, int32_t body, const fe_vec3 *linear, const fe_vec3 *angular);
void fe__body_stop_locked(fe_world *world, fe__body *body); // zeros the locked components of its velocities
// Only an enabled dynamic body does; on others forces and impulses do nothing, which is no error.
static inline int32_t fe__body_feels_forces(const fe__body *body)
{
    return body->type == FE_BODY_DYNAMIC && body->flags & FE__BODY_ENABLED;
}
// Sums are clamped (far above anything physical), so that no number of calls makes an infinity.
void fe__body_add_force(fe_world *world, int32_t body, fe_vec3 force, fe_vec3 torque);
// The change of the angular velocity by an impulse about the centre: the exact inverse of the inertia over the free axes.
fe_vec3 fe__body_spin_change(const fe__body *body, fe_vec3 angular_impulse);
// The angular velocity that turns `from` into `to` by the shorter way in `seconds`.
fe_vec3 fe__spin_between(fe_quat from, fe_quat to, double seconds);

// ---- mass (mass.c) ----------------------------------------------------------------------------------------------------------------
void fe__body_update_mass(fe_world *world, int32_t body);                        // from the shapes, unless given; reach always
void fe__body_set_mass(fe_world *world, int32_t body, const fe_mass_data *data); // given
void fe__body_mass_data(const fe_world *world, int32_t body, fe_mass_data *out_data);

// ---- life of shapes (shapes.c) ----------------------------------------------------------------------------------------------------
int32_t fe__shape_create(fe_world *world, int32_t body, const fe_shape_def *def, const fe__form *form); // index, or negative: fe_result
void fe__shape_destroy(fe_world *world, int32_t shape);
fe_result fe__shape_set_form(fe_world *world, int32_t shape, const fe__form *form);
void fe__shape_set_local_pose(fe_world *world, int32_t shape, fe_vec3 position, fe_quat rotation);
void fe__shape_set_filter(fe_world *world, int32_t shape, uint32_t layer, uint32_t mask);
void fe__shape_set_trigger(fe_world *world, int32_t shape, int32_t trigger);
void fe__shape_material_changed(fe_world *world, int32_t shape); // material, events, surface velocity: its pairs mix anew
fe__bounds fe__shape_bounds(const fe_world *world, int32_t shape, float margin);
fe__bounds fe__shape_reach_bounds(const fe_world *world, int32_t shape); // what it may touch in a step
fe__bounds fe__shape_fat_bounds(const fe_world *world, int32_t shape);   // as the trees hold them
// Puts the shape into its tree or list, takes it out, tells it to look for pairs. Room was reserved by fe__reserve_proxies.
int32_t fe__reserve_proxies(fe_world *world, int32_t extra); // 0: no memory
void fe__shape_enter(fe_world *world, int32_t shape);
void fe__shape_leave(fe_world *world, int32_t shape);
void fe__shape_touch(fe_world *world, int32_t shape);      // its pose or form is new: a new box, new pairs
void fe__shape_mark_moved(fe_world *world, int32_t shape); // looks for pairs in the next step

// ---- heightfields (assets.c) -----------------------------------------------------------------------------------------------------
int32_t fe__heightfield_create(fe_world *world, const fe_heightfield_def *def); // index, or negative: fe_result
void fe__heightfield_set_heights(fe_world *world, int32_t index, int32_t row, int32_t column, int32_t rows, int32_t columns,
                                 const float *heights);
void fe__asset_destroy(fe_world *world, int32_t index);       // now, or with its last shape
void fe__shape_take_asset(fe_world *world, int32_t shape);    // becomes a user of its form's, if it has one
void fe__shape_release_asset(fe_world *world, int32_t shape); // the last user of a destroyed one frees it
void fe__assets_free(fe_world *world);
fe_handle fe__asset_handle(const fe_world *world, int32_t index);
// of a cell (-1: none in particular) of a shape
const fe_material *fe__shape_material(const fe_world *world, const fe__shape *shape, int32_t cell);

// ---- filter (filter.c) --------------------------------------------------------------------------------------------------------
// May these two shapes have a pair? Kinds of bodies, layers, ignored pairs.
int32_t fe__may_collide(const fe_world *world, int32_t shape_a, int32_t shape_b);
fe_result fe__ignore_collision(fe_world *world, int32_t body_a, int32_t body_b, int32_t ignore);

// ---- pairs (pairs.c) ------------------------------------------------------------------------------------------------------------
int32_t fe__reserve_pairs(fe_world *world, int32_t extra);
int32_t fe__pair_create(fe_world *world, int32_t shape_a, int32_t shape_b);     // room was reserved; A created first
int32_t fe__pair_kind(const fe_world *world, int32_t shape_a, int32_t shape_b); // FE__ROW_* of their contact
void fe__pair_destroy(fe_world *world, int32_t pair);                           // unlinks, sends the exit it owes
void fe__pair_release(fe_world *world, int32_t pair);                           // a record without a pair is free
void fe__pair_mix(fe_world *world, int32_t pair);                               // materials, events, row kind
int32_t fe__next_pair(const fe_world *world, int32_t pair, int32_t body);       // in the list of `body`
void fe__pair_awaken(fe_world *world, int32_t pair);
void fe__pair_retire(fe_world *world, int32_t pair);
void fe__pair_look_once(fe_world *world, int32_t pair);  // in the next step, whoever sleeps
void fe__body_end_waits(fe_world *world, int32_t body);  // its pose or centre changed, and not by a step
void fe__body_drop_pairs(fe_world *world, int32_t body); // all of them
void fe__body_refilter(fe_world *world, int32_t body);   // those that may no longer collide
void fe__pair_link(fe_world *world, int32_t pair);       // into the constraint graph, with a colour
void fe__pair_unlink(fe_world *world, int32_t pair);
void fe__pair_forget_impulses(fe_world *world, int32_t pair);
// of a pair with a heightfield
int32_t fe__is_field_pair(const fe_world *world, int32_t shape_a, int32_t shape_b);
void fe__patch_leave(fe_world *world, int32_t patch);     // an unlinked one leaves the lists
void fe__pair_mix_surface(fe_world *world, int32_t pair); // frictions and the like; writes the pair's records only

// ---- joints (joints.c; what they are made of: joint_parts.c; what they read: joint_state.c) -------------------------------------------
void fe__joints_init(fe_world *world);
void fe__joints_free(fe_world *world);
// From a checked definition of that type. FE_ERROR_MEMORY, FE_ERROR_LIMIT: nothing changed. Both wake the bodies.
fe_result fe__joint_create(fe_world *world, int32_t type, const fe__joint_any *def, const int32_t *bodies, int32_t *out_joint);
fe_result fe__joint_change(fe_world *world, int32_t joint, const fe__joint_any *def); // all but its bodies
void fe__joint_destroy(fe_world *world, int32_t joint);
void fe__joint_describe(const fe_world *world, int32_t joint, fe__joint_any *out_def); // as it was set; struct_size is that of its type
int32_t fe__next_joint(const fe_world *world, int32_t joint, int32_t body);             // in the list of `body`
int32_t fe__joint_other(const fe_world *world, int32_t joint, int32_t body);
int32_t fe__bodies_joined(const fe_world *world, int32_t body_a, int32_t body_b); // by a joint that keeps them from touching
void fe__joint_awaken(fe_world *world, int32_t joint);
void fe__joint_retire(fe_world *world, int32_t joint);
void fe__body_drop_joints(fe_world *world, int32_t body);   // in the order of creation
void fe__body_unlink_joints(fe_world *world, int32_t body); // before its type, its locks or whether it is enabled change
void fe__body_link_joints(fe_world *world, int32_t body);   // after
void fe__body_place_anchors(fe_world *world, int32_t body); // its centre of mass is another point
void fe__body_wind_joints(fe_world *world, int32_t body);   // its pose was set
void fe__body_forget_joints(fe_world *world, int32_t body); // impulses and states of its joints
int32_t fe__find_joint_trees(fe_world *world);              // forest.c, where they are stale. 0: no memory, nothing changed
void fe__forest_free(fe__forest *forest, fe__memory *memory);
fe_handle fe__joint_handle(const fe_world *world, int32_t joint);
fe_transform fe__joint_frame_now(const fe_world *world, int32_t joint, int32_t side); // 0: A's, 1: B's; world space
void fe__joint_state_of(const fe_world *world, int32_t joint, fe_joint_state *out_state);

// ---- sleep (sleep.c) --------------------------------------------------------------------------------------------------------------
void fe__wake(fe_world *world, int32_t body);              // it and all that touches it, through dynamic bodies; nothing on static ones
void fe__wake_neighbours(fe_world *world, int32_t body);   // all that touches it, not the body
fe_result fe__put_to_sleep(fe_world *world, int32_t body); // the body's island; FE_ERROR_STATE when part of it may not
void fe__body_awaken_alone(fe_world *world, int32_t body); // into the awake lists, its pairs too
void fe__body_retire(fe_world *world, int32_t body);       // out of the awake lists
void fe__body_fall_asleep(fe_world *world, int32_t body);  // stops and retires it

// ---- the narrow phase (narrow.c, narrow_field.c), one pair at a time; only the pair and its patches are written ----------------------
void fe__collide_pair(fe_world *world, int32_t pair, float dt);       // for a step of dt seconds
void fe__collide_field_pair(fe_world *world, int32_t head, float dt); // with a heightfield

// ---- the step (step.c), events (events.c), hash (hash.c) --------------------------------------------------------------------------
fe_result fe__world_step(fe_world *world, float dt);
void fe__step_scratch_destroy(fe_world *world);
fe_dvec3 fe__contact_point(const fe_world *world, int32_t pair, int32_t point); // m, world
void fe__owe_exit(fe_world *world,
                  int32_t pair); // a touching pair ends: its exit goes to the next step's events, its record is kept for it
uint64_t fe__world_hash(const fe_world *world);
fe_handle fe__body_handle(const fe_world *world, int32_t body);
fe_handle fe__shape_handle(const fe_world *world, int32_t shape);

#endif
