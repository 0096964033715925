// contact.h - a pair of shapes whose boxes meet: its records, the lists that it is in, its materials, its points.
//
// find_pairs.c creates pairs (contact_creation.h), the narrow phase gives them points, the solver reads the contacts.
#ifndef FE_WORLD_CONTACT_H
#define FE_WORLD_CONTACT_H
#include "core/math.h"
#include "feather.h"
#include "world/world.h"

// ---- pair -----------------------------------------------------------------------------------------------------------
// Two shapes whose boxes meet: the cold half of a contact. Record i of the pairs and record i of the contacts
// (contact_solver.h) are one thing.

enum {
    FE__PAIR_SENSOR = 1,      // a trigger is in it: no contact, only events
    FE__PAIR_TOUCHING = 2,    // entered: an exit is owed
    FE__PAIR_LINKED = 4,      // has points and is in the constraint graph
    FE__PAIR_FLIPPED = 8,     // the solver's A is shape B
    FE__PAIR_SWAPPED = 16,    // fe__collide's A is shape B
    FE__PAIR_ONCE = 32,       // looked at in the next step although both sides sleep
    FE__PAIR_PATCH = 64,      // a further patch of a pair with a heightfield
    FE__PAIR_CROSSED = 128,   // a trigger that was passed between two steps
    FE__PAIR_DENIED = 256,    // the pair filter refused it: no contact, no events, until the boxes part
    FE__PAIR_PASSING = 512,   // passes a one-way shape: no contact until they are apart. The encounter counts it
    FE__PAIR_FREE = 1024,     // the record is no pair
    FE__PAIR_OF_PARTS = 2048, // a part of a compound is in it: its events are the encounter's (encounter.h)
    // above these bits: the number of a patch, from 1; 0 of a head
    FE__PAIR_NUMBER_SHIFT = 16
};

// Pairs with one of these flags may have events. The others, most of a heap, have no points and owe no exit.
enum { FE__PAIR_MAY_REPORT = FE__PAIR_LINKED | FE__PAIR_SENSOR | FE__PAIR_TOUCHING | FE__PAIR_CROSSED | FE__PAIR_ONCE };

// Results of the narrow phase, applied afterwards in a fixed order
enum { FE__RESULT_NONE, FE__RESULT_BEGIN, FE__RESULT_END, FE__RESULT_APART, FE__RESULT_PASSES };

typedef struct fe__link {
    int32_t next, previous; // pair index, -1: none
} fe__link;

// A pair with a heightfield or a mesh has a manifold for each direction: its own contact, the head, and FE__PATCHES - 1
// patch records that live as long as it does. To the solver each is a contact; while linked it is in the lists of
// bodies and of awake pairs. Events, filters and recycling are the head's alone. The head is the first to have points.
typedef struct fe__pair {
    int32_t shape_a, shape_b; // A was created first
    int32_t body_a, body_b;
    fe__link links[2]; // in the lists of body A and body B
    // the search for events reads these of every pair
    uint32_t flags;      // FE__PAIR_*
    uint8_t events;      // fe_shape_events of either shape
    uint8_t left_out;    // FE_LEFT_*: more of its faces touches than the points
    int16_t result;      // FE__RESULT_*; in the events stage the kind of an event
    int32_t next_patch;  // next record of the same pair, -1: none
    int32_t awake_index; // place in the list of awake pairs, -1: both sides sleep
    int32_t axis;        // fe__manifold.axis of the last narrow phase, and its axis_separation
    float axis_separation;
    int32_t head;     // a patch's head, -1 in the head itself
    int32_t triangle; // triangle under a patch, -1: none
} fe__pair;
_Static_assert(sizeof(fe__pair) == 64, "a pair is a cache line");

// The cold half of fe__points, which the solver does not read
typedef struct fe__features {
    uint32_t ids[4]; // a point's pair of features
    float approach;  // speed of the impact in this step, m/s
} fe__features;

// ---- material -------------------------------------------------------------------------------------------------------

// `triangle`: where on its surface, -1: none in particular
static inline const fe_material *fe__shape_material(const fe_world *world, const fe__shape *shape, int32_t triangle)
{
    return fe__material_of_shape(world->store, shape, triangle);
}

// The material of shape A (side 0) or B (1) under a pair's points
static inline const fe_material *fe__pair_material(const fe_world *world, int32_t pair, int32_t side)
{
    const fe__pair *p = world->pairs + pair;
    return fe__shape_material(world, world->shapes + (side ? p->shape_b : p->shape_a), p->triangle);
}

// ---- events ---------------------------------------------------------------------------------------------------------
// An event as the step writes it. Serials order it; handles name it also after a destruction.

// Memory for one of each contact is kept, so that it holds no more than an event needs.
typedef struct fe__pair_event_record {
    uint64_t serial_a, serial_b;
    fe_body body_a, body_b;
    fe_shape shape_a, shape_b;
    int16_t kind;
    uint8_t is_trigger;
    uint8_t field_a;  // 1: the triangle is A's
    int32_t triangle; // -1: none
} fe__pair_event_record;
_Static_assert(sizeof(fe__pair_event_record) == 56, "kept for each contact");

typedef struct fe__body_event_record {
    uint64_t serial;
    fe_body_event event;
} fe__body_event_record;

typedef struct fe__hit_event_record {
    uint64_t serial_a, serial_b;
    fe_hit_event event;
} fe__hit_event_record;

typedef struct fe__joint_event_record {
    uint64_t serial;
    fe_joint_event event;
} fe__joint_event_record;

// ---- lists ----------------------------------------------------------------------------------------------------------
// A pair is in the lists of both bodies, and in that of the awake pairs while one of them is awake.

// The next pair in the list of `body`, -1: none
static inline int32_t fe__next_pair(const fe_world *world, int32_t pair, int32_t body)
{
    return world->pairs[pair].links[world->pairs[pair].body_a == body ? 0 : 1].next;
}
void fe__pair_add_to_list(fe_world *world, int32_t pair, int32_t body);
void fe__pair_remove_from_list(fe_world *world, int32_t pair, int32_t body);

void fe__pair_awaken(fe_world *world, int32_t pair);
void fe__pair_retire(fe_world *world, int32_t pair);
void fe__pair_look_once(fe_world *world, int32_t pair);     // the next step looks at it, even if both bodies sleep
void fe__body_end_deferrals(fe_world *world, int32_t body); // after a change of pose or centre that no step made

// ---- mixed materials ------------------------------------------------------------------------------------------------
// Friction, restitution and resistances of two materials together, and the kind of rows that they take.

int32_t fe__pair_kind(const fe_world *world, int32_t shape_a, int32_t shape_b); // FE__ROW_* of their contact
void fe__pair_mix(fe_world *world, int32_t pair);                               // materials, events, row kind
void fe__pair_mix_surface(fe_world *world, int32_t pair); // materials; writes the pair's records only

// ---- points ---------------------------------------------------------------------------------------------------------
// A pair has a record of points only from its first points until they are gone: while it is linked, or, for a sensor,
// until it ends. Two thirds of a heap's pairs are near misses and cost none. Points, features and extras share the
// index. As a step may not allocate once it changes the world, records are reserved for all pairs without one that it
// may look at; then any thread may take one. Which one it gets shows nowhere: nothing goes over records in the order of
// their indices.

// Reserves so many records beside those in use; with extras for special rows, or without. 0: no memory
int32_t fe__points_reserve(fe_world *world, int64_t more, int32_t with_extras);
// Gives a pair without one a zeroed record; its material is mixed at once. On any thread, in a step that reserved it.
void fe__points_take(fe_world *world, int32_t pair);
void fe__points_release(fe_world *world, int32_t pair); // does nothing for a pair without one

// The serial of shape A (side 0) or B (1), by which everything is ordered. A patch's number makes its serial unique.
enum { FE__PATCH_SHIFT = 56 };
static inline uint64_t fe__pair_serial(const fe_world *world, int32_t pair, int32_t side)
{
    const fe__pair *p = world->pairs + pair;
    if (!side) return world->shapes[p->shape_a].serial;
    return world->shapes[p->shape_b].serial | (uint64_t)(p->flags >> FE__PAIR_NUMBER_SHIFT) << FE__PATCH_SHIFT;
}

static inline fe__points *fe__points_of(const fe_world *world, const fe__contact *contact)
{
    return world->points + contact->points;
}

// The mixed materials of a special row. NULL: it has none, all in it would be 0
static inline fe__extra *fe__extra_of(const fe_world *world, const fe__contact *contact)
{
    int32_t has_extra = contact->points && contact->kind & FE__ROW_SPECIAL && contact->points < world->extra_capacity;
    return has_extra ? world->extras + contact->points : NULL;
}

#endif
