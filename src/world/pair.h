// pair.h - two shapes whose boxes meet: the cold half of a contact. Record i of the pairs and record i of the contacts
// are one thing.
#ifndef FE_WORLD_PAIR_H
#define FE_WORLD_PAIR_H
#include "core/math.h"

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
    FE__PAIR_PASSING = 512,   // through a one-way shape: no contact until they are apart. Counted by the encounter
    FE__PAIR_FREE = 1024,     // the record is no pair
    FE__PAIR_OF_PARTS = 2048, // of compounds: their events are the encounter's (encounter.h)
    // above these bits: the number of a patch, from 1; 0 of a head
    FE__PAIR_NUMBER_SHIFT = 16
};

// Only of these the contact must be seen for events: the others, most of a heap, have no points and owe no exit
enum { FE__PAIR_MAY_REPORT = FE__PAIR_LINKED | FE__PAIR_SENSOR | FE__PAIR_TOUCHING | FE__PAIR_CROSSED | FE__PAIR_ONCE };

// What the narrow phase says of a pair in this step, applied afterwards in a fixed order
enum { FE__RESULT_NONE, FE__RESULT_BEGIN, FE__RESULT_END, FE__RESULT_APART, FE__RESULT_PASSES };

typedef struct fe__link {
    int32_t next, previous; // pair index, -1: none
} fe__link;

// A pair with a heightfield has a patch of points for each direction: its own contact, and those of FE__PATCHES - 1
// patch records that live as long as it does. To the solver each is a contact; while linked it is in the lists of
// bodies and of awake pairs. Events, filters and recycling are the head's alone. Of all patches the head has points
// first.
typedef struct fe__pair {
    int32_t shape_a, shape_b; // A was created first
    int32_t body_a, body_b;
    fe__link links[2]; // in the lists of body A and body B
    // what the search for events reads of every pair, together
    uint32_t flags;      // FE__PAIR_*
    uint8_t events;      // fe_shape_events of either shape
    uint8_t left_out;    // of its faces, beside the points: FE_LEFT_*
    int16_t result;      // FE__RESULT_*, or the kind of an event
    int32_t next_patch;  // of the same pair, -1: none
    int32_t awake_index; // place in the list of awake pairs, -1: both sides sleep
    int32_t axis;        // of the narrow phase: fe__manifold.axis, axis_separation
    float axis_separation;
    int32_t head;     // of a patch
    int32_t triangle; // of the heightfield under a patch, -1: none
} fe__pair;
_Static_assert(sizeof(fe__pair) == 64, "a pair is a cache line");

// What the solver does not read of points: the cold half of fe__points
typedef struct fe__features {
    uint32_t ids[4]; // of the points
    float approach;  // speed of the impact in this step, m/s
} fe__features;

#endif
