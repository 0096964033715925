// graph.h - which contacts are solved together: islands, batches, colours, rows.
//
// Input: the awake bodies and the linked contacts. Output: batches of lines, groups of lanes in fe__solver. The graph
// lives on while nothing links, unlinks, wakes or sleeps.
#ifndef FE_SOLVER_GRAPH_GRAPH_H
#define FE_SOLVER_GRAPH_GRAPH_H
#include "solver/solver.h"

// ---- graph input ----------------------------------------------------------------------------------------------------
// What a graph is built of, and what it may need at most.

typedef struct fe__graph_input {
    fe__body *bodies;
    const fe__contact *contacts;
    const fe__points *points;
    const uint64_t *serials;     // of the pairs, two for each record of points: orders overflowing contacts
    const int32_t *awake_bodies; // dynamic and kinematic; bodies[awake_bodies[i]].awake_index == i
    int32_t body_count;
    const int32_t *awake_contacts; // linked or not: colour -1 is not
    int32_t contact_count;
    const fe__joints *joints;    // NULL: none
    const int32_t *awake_joints; // a dynamic end is awake; linked or not
    int32_t joint_count;
} fe__graph_input;

// What a graph of so many bodies and contacts may need at most
typedef struct fe__graph_bound {
    int32_t bodies, contacts;
    int32_t kinematic;                    // of the bodies, at most
    int32_t fresh;                        // of them, those that the last graph does not have
    int32_t pair_colours, static_colours; // the colours of these are among the first so many
    int32_t crowded;                      // of these, contacts of bodies that may run out of colours
    int32_t largest;                      // contacts and parts of joints of the largest island
    int32_t fast, fast_kinematic;         // bodies that leave a trail; 1: kinematic ones do
    uint32_t kinds;                       // of rows in use: 1 << FE__ROW_*
    int32_t special;                      // 1: special rows are among them
    const fe__joints *joint_set;          // NULL: none
    int32_t joints;                       // of them, awake or about to wake, at most
} fe__graph_bound;

// ---- graph ----------------------------------------------------------------------------------------------------------

// 1: there are rows already for any such graph, whatever its islands
int32_t fe__graph_has_rows(const fe__solver *s, const fe__kernels *kernels, const fe__graph_bound *bound,
                           int32_t workers);
// Room for every graph within the bound. 0: no memory, nothing changed but capacities.
int32_t fe__graph_reserve(fe__solver *s, fe__memory *memory, const fe__kernels *kernels, const fe__graph_bound *bound,
                          int32_t workers);
// Lines and rows change hands, the graph stays: a solver needs them from `fe__solve` on, to the end of the step
void fe__solver_trade_lines(fe__solver *one, fe__solver *other);
void fe__graph_build(fe__solver *s, const fe__kernels *kernels, const fe__graph_input *input);
void fe__graph_forget(fe__solver *s); // the next step builds it from nothing
void fe__solver_destroy(fe__solver *s, fe__memory *memory);

// ---- graph build ----------------------------------------------------------------------------------------------------
// What the parts of a build of the graph share: first graph.c, then graph.c and graph.c
// for each batch.

enum {
    FE__NONE = -1,
    FE__GROUP_KEYS = FE__COLOURS * FE__ROW_KINDS,
    FE__SIDES = 3, // A, B, both: FE__MOVES_* - 1
    FE__JOINT_GROUP_KEYS = FE__JOINT_KEYS * FE__SIDES,
    // a batch of islands without contacts ends here: about as many lines as a second-level cache holds
    FE__BATCH_BODIES = 1024,
    // lines of zeros before a batch's bodies, one for each kind of row: what its padding lanes name. A batch's own, so
    // that no two workers write one line
    FE__DUMMY_LINES = FE__MAX_WIDTH
};
_Static_assert((int)FE__DUMMY_LINES >= (int)FE__ROW_KINDS + (int)FE__SIDES,
               "one dummy line for each kind that may be in a colour");

// Sets of keys of groups, a bit each: of thousands of keys a small world has ten
enum { FE__KEY_WORD = 64 };
#define FE__KEY_WORDS(keys) (((int)(keys) + FE__KEY_WORD - 1) / FE__KEY_WORD)

// What a build needs of a contact in the graph. Contacts lie anywhere in memory: each is read once.
typedef struct fe__linked {
    int32_t contact, points;
    int32_t key;              // colour * FE__ROW_KINDS + kind of row
    int32_t awake_a, awake_b; // awake indices of its bodies, FE__NONE of a static one
    int32_t loose;            // 1: bore nothing in the last step, and has a gap at each point
} fe__linked;
enum { FE__LINKED_INTS = sizeof(fe__linked) / sizeof(int32_t) };

// scratch of a build, carved from one block of ints
typedef struct fe__builder {
    fe__solver *s;
    const fe__graph_input *in;
    const fe__records *of; // by home: where the trees are
    int32_t width;
    int32_t *parent;          // by awake index of a body; a parent's index is never above its child's
    int32_t *island_of;       // by awake index, FE__NONE: kinematic
    int32_t *island_contacts; // by island
    int32_t *island_joints;
    int32_t *island_lanes; // contacts and parts of joints
    int32_t *island_bodies;
    int32_t *island_pace;    // bits of FE__BODY_STRAINED, FE__BODY_STRETCHED until pace_of reads them
    int32_t *batch_of;       // of an island
    int32_t *kinematic_line; // by awake index: line of the copy in the batch at hand
    int32_t *body_order;     // awake indices by batch
    int32_t *line;           // by awake index, of bodies that are not kinematic
    fe__linked *linked;      // contacts in the graph
    int32_t linked_count;
    int32_t *contact_order; // places in `linked` by batch
    int32_t *body_start;    // by batch, one more than there are
    int32_t *contact_start;
    int32_t *joint_order; // joints by batch
    int32_t *joint_start;
    int32_t *key_count; // by colour and kind, of those of the batch at hand: contacts, then the next free lane
    uint64_t keys[FE__KEY_WORDS(FE__GROUP_KEYS)]; // those
    uint64_t seen[FE__KEY_WORDS(FE__GROUP_KEYS)]; // of all batches
    int32_t *joint_key_count;                     // likewise by part, colour and sides
    int32_t *joint_key_group;
    uint64_t joint_keys[FE__KEY_WORDS(FE__JOINT_GROUP_KEYS)];
} fe__builder;

// To the count of a key, the first time from 0
static inline void fe__count_key(uint64_t *keys, int32_t *count, int32_t key, int32_t more)
{
    uint64_t bit = UINT64_C(1) << key % FE__KEY_WORD;
    if (!(keys[key / FE__KEY_WORD] & bit)) count[key] = 0;
    keys[key / FE__KEY_WORD] |= bit;
    count[key] += more;
}

// The least key in the set from `key` on, or `end`
static inline int32_t fe__next_key(const uint64_t *keys, int32_t key, int32_t end)
{
    for (; key < end; key = (key / FE__KEY_WORD + 1) * FE__KEY_WORD) {
        uint64_t bits = keys[key / FE__KEY_WORD] >> key % FE__KEY_WORD;
        if (bits) return fe__mini(key + __builtin_ctzll(bits), end);
    }
    return end;
}

static inline const fe__body *fe__awake_body(const fe__builder *b, int32_t i)
{
    return b->in->bodies + b->in->awake_bodies[i];
}
static inline int32_t fe__is_kinematic(const fe__body *body) { return body->type == FE_BODY_KINEMATIC; }
static inline uint32_t fe__sides_of(const fe__joint *j)
{
    return j->rows >> FE__SIDES_SHIFT & (FE__MOVES_A | FE__MOVES_B);
}

// Rows of narrow kernels are not whole blocks, but nodes of trees begin with one
static inline int64_t fe__whole_blocks(int64_t bytes)
{
    const int64_t block = sizeof(fe__row_block);
    return (bytes + block - 1) / block * block;
}

// of so many links of trees side by side, whole blocks
static inline int64_t fe__forest_bytes(const fe__forest_kernels *forest, int32_t links)
{
    return fe__whole_blocks(forest->head_bytes + (int64_t)forest->link_bytes * links);
}

// Lanes of a row of a group of so many contacts or joints: few would leave a wide one empty
static inline int32_t fe__width_for(const fe__builder *b, int32_t lanes)
{
    return lanes <= FE__THIN_WIDTH ? FE__THIN_WIDTH : b->width;
}

// Islands of bodies, batches of islands; bodies, contacts and joints in the order of their batches
void fe__graph_find_batches(fe__builder *b);
// Groups of the joints of batch k, and its trees
void fe__graph_joint_groups(fe__builder *b, int32_t k, const fe__kernels *kernels);
// It bore nothing in the last step, and there is a gap at each point. Of the kinds of rows that are never skipped
// (contact/idle.inl) none is: their order tells nothing
int32_t fe__graph_is_loose(const fe__contact *contact, const fe__points *points);
// The trees of a batch from `first` on into groups, as many side by side as there are lanes
void fe__graph_group_trees(fe__builder *b, fe__batch *batch, int32_t first, const fe__kernels *kernels);
// To a place of the forest, the row of a part of its joint, if that is a lock: the group, the lane among the solver's
void fe__graph_add_lock(const fe__builder *b, int32_t place, int32_t part, int32_t group, int32_t lane,
                        const fe__kernels *kernels);
// A group of a batch, with a dummy in each lane. `like` has all but the place
fe__group *fe__open_group(fe__builder *b, fe__batch *batch, fe__group like, int32_t lanes, int32_t row_size);
// Of a body in the batch at hand
int32_t fe__line_of(const fe__builder *b, int32_t body);

// ---- colour ---------------------------------------------------------------------------------------------------------
// The colours of contacts: those of one colour share no dynamic body, so that they are solved side by side.

void fe__colour_contact(fe__body *bodies, fe__contact *contact);
int32_t fe__colours_of(const fe__body *body); // that its contacts have: how many
// Of a contact that has its colour already, from a snapshot: its bodies take it. 0: one of them has, or it is of the
// other kind; it is of no use then
int32_t fe__recolour_contact(fe__body *bodies, const fe__contact *contact);
void fe__uncolour_contact(fe__body *bodies, fe__contact *contact);

#endif
