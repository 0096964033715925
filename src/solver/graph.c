// graph.c - islands by union-find, batches of islands, lines for bodies, groups of lanes by colour and kind of row.
//
// All orders that could matter follow the creation of the pairs; everything else is free to follow the awake lists, because lanes are
// independent and a group's contacts share no dynamic body.
#include "solver/graph.h"

#include "core/array_sort.h"

#include <assert.h>
#include <string.h>

enum {
    NONE = -1,
    GROUP_KEYS = FE__COLOURS * FE__ROW_KINDS,
    SIDES = 3, // A, B, both: FE__MOVES_* - 1
    JOINT_KEYS = FE__JOINT_KEYS * SIDES,
    // a batch of islands without contacts ends here: about as many lines as a second-level cache holds
    BATCH_BODIES = 1024,
    // lines of zeros before a batch's bodies, one for each kind of row: what its padding lanes name. A batch's own, so that no two workers
    // write one line
    DUMMY_LINES = FE__MAX_WIDTH,
    AHEAD = 16 // contacts come from the whole of memory: each is asked for so many turns before it is read
};
_Static_assert((int)DUMMY_LINES >= (int)FE__ROW_KINDS + (int)SIDES, "one dummy line for each kind that may be in a colour");

// What a build asks of a contact in the graph, which lies anywhere in memory: read once
typedef struct linked {
    int32_t contact;
    int32_t key;              // colour * FE__ROW_KINDS + kind of row
    int32_t awake_a, awake_b; // awake indices of its bodies, NONE of a static one
} linked;
enum { LINKED_INTS = sizeof(linked) / sizeof(int32_t) };

// scratch of a build, carved from one block of ints
typedef struct builder {
    fe__solver *s;
    const fe__graph_input *in;
    int32_t width;
    int32_t *parent;          // by awake index of a body; a parent's index is never above its child's
    int32_t *island_of;       // by awake index, NONE: kinematic
    int32_t *island_contacts; // by island
    int32_t *island_joints;
    int32_t *island_lanes; // contacts and parts of joints
    int32_t *island_bodies;
    int32_t *island_pace;    // bits of FE__BODY_STRAINED, FE__BODY_STRETCHED until asked by pace_of
    int32_t *batch_of;       // of an island
    int32_t *kinematic_line; // by awake index: line of the copy in the batch at hand
    int32_t *body_order;     // awake indices by batch
    int32_t *line;           // by awake index, of bodies that are not kinematic
    linked *linked;          // contacts in the graph
    int32_t linked_count;
    int32_t *contact_order; // places in `linked` by batch
    int32_t *body_start;    // by batch, one more than there are
    int32_t *contact_start;
    int32_t *joint_order; // joints by batch
    int32_t *joint_start;
    int32_t *key_count;       // by colour and kind
    int32_t *joint_key_count; // by part, colour and sides
    int32_t *joint_key_group;
} builder;

// ---- room -----------------------------------------------------------------------------------------------------------------------------
static int32_t joint_rows(const fe__graph_bound *b)
{
    return b->joint_set ? (int32_t)fe__minl(b->joint_set->rows, (int64_t)b->joints * __builtin_popcount(b->joint_set->row_kinds)) : 0;
}

static int32_t overflowing_rows(const fe__graph_bound *b)
{
    if (!b->joint_set) return 0;
    return (int32_t)fe__minl(joint_rows(b), (int64_t)b->joint_set->overflowing * __builtin_popcount(b->joint_set->row_kinds));
}

static int32_t batch_bound(const fe__graph_bound *b)
{
    // two neighbouring small batches together exceed a limit; large islands exceed theirs; one for kinematic bodies, two that stayed open
    int32_t lanes = b->contacts + joint_rows(b);
    return 2 * (lanes / FE__BATCH_CONTACTS + b->bodies / BATCH_BODIES) + lanes / FE__ISLAND_LARGE + 4;
}

// distinct groups of one batch: a colour between dynamic bodies, or its mate, is below the contacts of both; one with others below the
// body's
static int32_t group_bound(const fe__graph_bound *b)
{
    const uint32_t pairs = 0xAA; // kinds with FE__ROW_PAIR
    return fe__mini(2 * b->most_contacts, FE__PAIR_COLOURS) * __builtin_popcount(b->kinds & pairs) +
           fe__mini(b->most_contacts, FE__STATIC_COLOURS) * __builtin_popcount(b->kinds & ~pairs);
}

static int32_t joint_group_bound(const fe__graph_bound *b)
{
    if (!b->joint_set) return 0;
    return fe__mini(2 * b->joint_set->most, FE__JOINT_COLOURS) * __builtin_popcount(b->joint_set->row_kinds) * SIDES;
}

static int64_t joint_row_bound(const fe__graph_bound *b, int32_t lanes, int32_t width)
{
    int64_t rows = lanes / width + fe__mini(joint_group_bound(b), lanes) + fe__mini(overflowing_rows(b), lanes);
    return rows < lanes ? rows : lanes;
}

static int64_t widest_joint(const fe__graph_bound *b, const fe__kernels *kernels)
{
    int32_t widest = 0;
    for (int32_t part = 0; b->joint_set && part < FE__PARTS; ++part)
        if (b->joint_set->row_kinds >> part & 1) widest = fe__maxi(widest, kernels->joint->of[part].row_size);
    return widest;
}

static int64_t row_bound(const fe__graph_bound *b, int32_t contacts, int32_t width)
{
    int64_t rows = contacts / width + fe__mini(group_bound(b), contacts) + fe__mini(b->crowded, contacts);
    return rows < contacts ? rows : contacts;
}

// Rows of narrow kernels are not whole blocks, but nodes of trees begin with one
static int64_t whole_blocks(int64_t bytes)
{
    const int64_t block = sizeof(fe__row_block);
    return (bytes + block - 1) / block * block;
}

static int32_t tree_links(const fe__graph_bound *b) { return b->joint_set ? b->joint_set->forest.link_count : 0; }

// bytes of rows of so many contacts and parts of joints; each body is in one tree at most
static int64_t row_bytes(const fe__graph_bound *b, const fe__kernels *kernels, int32_t contacts, int32_t joint_lanes, int64_t bodies)
{
    int64_t widest = kernels->contact->row_size[b->special ? FE__ROW_PAIR | FE__ROW_SPECIAL : FE__ROW_PAIR];
    int64_t links = fe__minl(tree_links(b), bodies);
    return row_bound(b, contacts, kernels->width) * widest + joint_row_bound(b, joint_lanes, kernels->width) * widest_joint(b, kernels) +
           links * (kernels->joint->tree.node_size + (int64_t)sizeof(fe__row_block));
}

static int64_t scratch_bound(const fe__graph_bound *b)
{
    return 11 * (int64_t)b->bodies + (LINKED_INTS + 1) * (int64_t)b->contacts + b->joints + 3 * (batch_bound(b) + 1) + GROUP_KEYS +
           2 * JOINT_KEYS;
}

// bytes of rows of the largest island, and of a worker's stretch
static int64_t all_rows(const fe__graph_bound *b, const fe__kernels *kernels, int32_t workers, int64_t *out_small)
{
    int32_t some = FE__BATCH_CONTACTS + FE__ISLAND_LARGE, parts = joint_rows(b);
    // an island has a body more than constraints, at most
    int64_t small = row_bytes(b, kernels, fe__mini(b->contacts, some), fe__mini(parts, some), fe__maxi(BATCH_BODIES, FE__ISLAND_LARGE + 1));
    int64_t large = b->largest > FE__ISLAND_LARGE
                        ? row_bytes(b, kernels, fe__mini(b->contacts, b->largest), fe__mini(parts, b->largest), (int64_t)b->largest + 1)
                        : 0;
    *out_small = small;
    return small * workers > large ? small * workers : large;
}

// Passes of a large batch, see make_program in solve.c. Its groups come colour by colour, a group or more each, and each of the four verbs
// of rows (prepare, solve, relax, bounce; joints do not bounce) has a pass a colour at most. Three more are over lines, one stores, and one
// is the trees'.
static int64_t pass_bound(int64_t groups)
{
    enum { EVERY_COLOUR = 4 * FE__COLOURS + 3 * FE__CONTACT_COLOURS, OTHERS = 5 };
    return fe__minl(4 * groups, EVERY_COLOUR) + OTHERS;
}

int32_t fe__graph_has_rows(const fe__solver *s, const fe__kernels *kernels, const fe__graph_bound *bound, int32_t workers)
{
    int64_t small;
    return all_rows(bound, kernels, workers, &small) < (int64_t)sizeof(fe__row_block) * s->row_capacity;
}

int32_t fe__graph_reserve(fe__solver *s, fe__memory *memory, const fe__kernels *kernels, const fe__graph_bound *b, int32_t workers)
{
    int32_t batches = batch_bound(b), width = kernels->width, parts = joint_rows(b);
    int64_t all_lanes = (int64_t)b->contacts + parts;
    int64_t groups = fe__minl((int64_t)group_bound(b) * batches, b->contacts) + fe__mini(b->crowded, b->contacts) +
                     fe__minl((int64_t)joint_group_bound(b) * batches, parts) + overflowing_rows(b) + tree_links(b);
    int64_t lanes = fe__minl(all_lanes + (int64_t)(width - 1) * groups, all_lanes * width);
    // each contact or joint of a kinematic body may bring a copy of it
    int64_t copies = (b->special ? b->contacts : 0) + (b->joint_set ? b->joint_set->kinematic : 0);
    int64_t lines = FE__MAX_WIDTH + (int64_t)b->bodies + (int64_t)batches * (DUMMY_LINES + FE__MAX_WIDTH) + copies;
    int64_t small, rows = all_rows(b, kernels, workers, &small);
    int64_t building = (int64_t)sizeof(int32_t) * scratch_bound(b);
    int64_t sorted = fe__maxi(fe__mini(b->crowded, b->contacts), b->joint_set ? fe__mini(b->joint_set->overflowing, b->joints) : 0);
    if (!FE_RESERVE(memory, s->velocity, s->line_capacity[0], lines) || !FE_RESERVE(memory, s->motion, s->line_capacity[1], lines) ||
        !FE_RESERVE(memory, s->start, s->line_capacity[2], lines) || !FE_RESERVE(memory, s->inertia, s->line_capacity[3], lines) ||
        !FE_RESERVE(memory, s->drive, s->line_capacity[4], lines) || !FE_RESERVE(memory, s->spin, s->line_capacity[5], lines) ||
        !FE_RESERVE(memory, s->body_of_line, s->body_of_line_capacity, lines) ||
        !FE_RESERVE(memory, s->trail_count, s->trail_capacity[0], lines) || !FE_RESERVE(memory, s->trail_of, s->trail_capacity[2], lines) ||
        !FE_RESERVE(memory, s->trail, s->trail_capacity[1], b->fast + (b->fast_kinematic ? copies : 0)) ||
        !FE_RESERVE(memory, s->batches, s->batch_capacity, batches) || !FE_RESERVE(memory, s->groups, s->group_capacity, groups + 1) ||
        !FE_RESERVE(memory, s->lanes, s->lane_capacity, lanes + width) ||
        !FE_RESERVE(memory, s->places, s->place_capacity, tree_links(b)) ||
        !FE_RESERVE(memory, s->passes, s->pass_capacity, pass_bound(groups)) ||
        !FE_RESERVE(memory, s->sort_items, s->sort_capacity, 2 * sorted) ||
        !FE_RESERVE(memory, s->rows, s->row_capacity, fe__maxl(rows, building) / (int64_t)sizeof(fe__row_block) + 1))
        return 0;
    s->worker_row_bytes = whole_blocks(small);
    return 1;
}

void fe__solver_destroy(fe__solver *s, fe__memory *memory)
{
    FE_FREE(memory, s->velocity, s->line_capacity[0]);
    FE_FREE(memory, s->motion, s->line_capacity[1]);
    FE_FREE(memory, s->start, s->line_capacity[2]);
    FE_FREE(memory, s->inertia, s->line_capacity[3]);
    FE_FREE(memory, s->drive, s->line_capacity[4]);
    FE_FREE(memory, s->spin, s->line_capacity[5]);
    FE_FREE(memory, s->body_of_line, s->body_of_line_capacity);
    FE_FREE(memory, s->trail_count, s->trail_capacity[0]);
    FE_FREE(memory, s->trail, s->trail_capacity[1]);
    FE_FREE(memory, s->trail_of, s->trail_capacity[2]);
    FE_FREE(memory, s->batches, s->batch_capacity);
    FE_FREE(memory, s->groups, s->group_capacity);
    FE_FREE(memory, s->lanes, s->lane_capacity);
    FE_FREE(memory, s->places, s->place_capacity);
    FE_FREE(memory, s->passes, s->pass_capacity);
    FE_FREE(memory, s->sort_items, s->sort_capacity);
    FE_FREE(memory, s->rows, s->row_capacity);
    s->batch_count = s->large_count = s->group_count = s->lane_count = s->line_count = s->island_count = 0;
    s->graph_changed = 1;
}

static int32_t *carve(int32_t **from, int64_t count)
{
    int32_t *block = *from;
    *from += count;
    return block;
}

static builder make_builder(fe__solver *s, const fe__kernels *kernels, const fe__graph_input *in)
{
    int32_t *at = (int32_t *)(void *)s->rows; // no rows are in use while the graph is built
    int64_t n = in->body_count;
    builder b = {.s = s, .in = in, .width = kernels->width};
    b.parent = carve(&at, n);
    b.island_of = carve(&at, n);
    b.island_contacts = carve(&at, n);
    b.island_joints = carve(&at, n);
    b.island_lanes = carve(&at, n);
    b.island_bodies = carve(&at, n);
    b.island_pace = carve(&at, n);
    b.batch_of = carve(&at, n);
    b.kinematic_line = carve(&at, n);
    b.body_order = carve(&at, n);
    b.line = carve(&at, n);
    b.linked = (linked *)(void *)carve(&at, LINKED_INTS * (int64_t)in->contact_count);
    b.contact_order = carve(&at, in->contact_count);
    b.joint_order = carve(&at, in->joint_count);
    b.key_count = carve(&at, GROUP_KEYS);
    b.joint_key_count = carve(&at, JOINT_KEYS);
    b.joint_key_group = carve(&at, JOINT_KEYS);
    const int32_t *end = (const int32_t *)(const void *)(s->rows + s->row_capacity);
    int64_t starts = (end - at) / 3;
    b.body_start = carve(&at, starts);
    b.contact_start = carve(&at, starts);
    b.joint_start = at;
    return b;
}

// ---- islands --------------------------------------------------------------------------------------------------------------------------
static int32_t root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]]; // path halving
    return i;
}

static const fe__body *awake_body(const builder *b, int32_t i) { return b->in->bodies + b->in->awake_bodies[i]; }
static int32_t is_kinematic(const fe__body *body) { return body->type == FE_BODY_KINEMATIC; }

static void join(int32_t *parent, int32_t a, int32_t b)
{
    int32_t x = root_of(parent, a), y = root_of(parent, b);
    if (x < y)
        parent[y] = x;
    else
        parent[x] = y;
}

// B is dynamic in every contact; A may be anything
static void join_contacts(builder *b)
{
    const fe__graph_input *in = b->in;
    b->linked_count = 0;
    for (int32_t i = 0; i < in->contact_count; ++i) {
        int32_t contact = in->awake_contacts[i];
        const fe__contact *m = in->contacts + contact;
        if (i + AHEAD < in->contact_count) __builtin_prefetch(&in->contacts[in->awake_contacts[i + AHEAD]].colour);
        if (m->colour < 0) continue;
        int32_t awake_a = in->bodies[m->body_a].awake_index, awake_b = in->bodies[m->body_b].awake_index;
        b->linked[b->linked_count++] = (linked){contact, m->colour * FE__ROW_KINDS + m->kind, awake_a, awake_b};
        if (m->kind & FE__ROW_PAIR) join(b->parent, awake_a, awake_b);
    }
}

static const fe__joint *joint_at(const builder *b, int32_t i) { return b->in->joints->joints + b->in->awake_joints[i]; }
static uint32_t sides_of(const fe__joint *j) { return j->rows >> FE__SIDES_SHIFT & (FE__MOVES_A | FE__MOVES_B); }

static void join_joints(builder *b)
{
    const fe__body *bodies = b->in->bodies;
    for (int32_t i = 0; i < b->in->joint_count; ++i) {
        const fe__joint *j = joint_at(b, i);
        if (j->colour >= 0 && sides_of(j) == (FE__MOVES_A | FE__MOVES_B))
            join(b->parent, bodies[j->body_a].awake_index, bodies[j->body_b].awake_index);
    }
}

static int32_t island_of_joint(const builder *b, const fe__joint *j)
{
    return b->island_of[b->in->bodies[sides_of(j) & FE__MOVES_B ? j->body_b : j->body_a].awake_index];
}

static void count_constraints(builder *b)
{
    for (int32_t i = 0; i < b->linked_count; ++i) ++b->island_contacts[b->island_of[b->linked[i].awake_b]];
    for (int32_t i = 0; i < b->s->island_count; ++i) b->island_lanes[i] = b->island_contacts[i];
    for (int32_t i = 0; i < b->in->joint_count; ++i) {
        const fe__joint *j = joint_at(b, i);
        if (j->colour < 0) continue;
        ++b->island_joints[island_of_joint(b, j)];
        b->island_lanes[island_of_joint(b, j)] += __builtin_popcount(j->rows & ((1u << FE__PARTS) - 1u));
    }
}

static void find_islands(builder *b)
{
    const fe__graph_input *in = b->in;
    for (int32_t i = 0; i < in->body_count; ++i) b->parent[i] = i;
    join_contacts(b);
    join_joints(b);
    int32_t count = 0;
    for (int32_t i = 0; i < in->body_count; ++i) {
        int32_t is_root = b->parent[i] == i; // else its parent came before it
        if (is_kinematic(awake_body(b, i))) {
            b->island_of[i] = b->kinematic_line[i] = NONE; // no copy in any batch yet
            continue;
        }
        if (is_root) {
            b->island_contacts[count] = b->island_joints[count] = b->island_bodies[count] = b->island_pace[count] = 0;
            b->island_of[i] = count++;
        } else
            b->island_of[i] = b->island_of[b->parent[i]];
        ++b->island_bodies[b->island_of[i]];
        b->island_pace[b->island_of[i]] |= (int32_t)(awake_body(b, i)->flags & (FE__BODY_STRAINED | FE__BODY_STRETCHED));
    }
    b->s->island_count = count;
    count_constraints(b);
}

// ---- batches --------------------------------------------------------------------------------------------------------------------------
static fe__batch *open_batch(fe__solver *s)
{
    fe__batch *batch = s->batches + s->batch_count++;
    *batch = (fe__batch){0};
    return batch;
}

static void add_island(builder *b, int32_t island)
{
    fe__batch *batch = b->s->batches + b->s->batch_count - 1;
    batch->contact_count += b->island_contacts[island];
    batch->joint_count += b->island_joints[island];
    batch->lane_count += b->island_lanes[island];
    batch->body_count += b->island_bodies[island];
    ++batch->island_count;
    b->batch_of[island] = b->s->batch_count - 1;
}

static int32_t pace_of(const builder *b, int32_t island)
{
    return fe__pace_of((uint32_t)b->island_pace[island], b->island_joints[island] > 0);
}

// small islands, in order
static void batch_small(builder *b, int32_t pace)
{
    fe__batch *open = NULL;
    for (int32_t i = 0; i < b->s->island_count; ++i) {
        if (b->island_lanes[i] > FE__ISLAND_LARGE || pace_of(b, i) != pace) continue;
        if (!open || open->lane_count + b->island_lanes[i] > FE__BATCH_CONTACTS || open->body_count + b->island_bodies[i] > BATCH_BODIES) {
            open = open_batch(b->s);
            open->pace = pace;
        }
        add_island(b, i);
    }
}

// large islands first, each a batch of its own; then those that take longest
static void make_batches(builder *b)
{
    fe__solver *s = b->s;
    s->batch_count = 0;
    for (int32_t i = 0; i < s->island_count; ++i) {
        if (b->island_lanes[i] <= FE__ISLAND_LARGE) continue;
        fe__batch *large = open_batch(s);
        large->pace = b->island_joints[i] ? pace_of(b, i) : FE__USUAL;
        add_island(b, i);
    }
    s->large_count = s->batch_count;
    for (int32_t pace = FE__PACES - 1; pace >= FE__USUAL; --pace) batch_small(b, pace);
    open_batch(s); // of the kinematic bodies
}

static int32_t batch_of_body(const builder *b, int32_t i)
{
    return b->island_of[i] < 0 ? b->s->batch_count - 1 : b->batch_of[b->island_of[i]];
}

// counts in start[k + 1] become first places; places are then taken by start[k]++ and put right by unwind
static void sum_up(int32_t *start, int32_t count)
{
    for (int32_t k = 0; k < count; ++k) start[k + 1] += start[k];
}

static void unwind(int32_t *start, int32_t count)
{
    for (int32_t k = count; k > 0; --k) start[k] = start[k - 1];
    start[0] = 0;
}

static void sort_by_batch(builder *b)
{
    const fe__graph_input *in = b->in;
    int32_t batches = b->s->batch_count;
    memset(b->body_start, 0, sizeof(int32_t) * (size_t)(batches + 1));
    memset(b->contact_start, 0, sizeof(int32_t) * (size_t)(batches + 1));
    for (int32_t i = 0; i < in->body_count; ++i) ++b->body_start[batch_of_body(b, i) + 1];
    sum_up(b->body_start, batches);
    for (int32_t i = 0; i < in->body_count; ++i) b->body_order[b->body_start[batch_of_body(b, i)]++] = i;
    unwind(b->body_start, batches);
    for (int32_t k = 0; k < batches; ++k) b->contact_start[k + 1] = b->contact_start[k] + b->s->batches[k].contact_count;
    for (int32_t i = 0; i < b->linked_count; ++i) b->contact_order[b->contact_start[batch_of_body(b, b->linked[i].awake_b)]++] = i;
    unwind(b->contact_start, batches);
    b->joint_start[0] = 0;
    for (int32_t k = 0; k < batches; ++k) b->joint_start[k + 1] = b->joint_start[k] + b->s->batches[k].joint_count;
    for (int32_t i = 0; i < in->joint_count; ++i) {
        const fe__joint *j = joint_at(b, i);
        if (j->colour >= 0) b->joint_order[b->joint_start[b->batch_of[island_of_joint(b, j)]]++] = in->awake_joints[i];
    }
    unwind(b->joint_start, batches);
}

// ---- lines ----------------------------------------------------------------------------------------------------------------------------
static void close_block(fe__solver *s)
{
    while (s->line_count % FE__MAX_WIDTH) s->body_of_line[s->line_count++] = NONE;
}

static void add_line(fe__solver *s, int32_t body) { s->body_of_line[s->line_count++] = body; }

static void add_kinematic(builder *b, const fe__batch *batch, int32_t awake)
{
    if (awake < 0 || !is_kinematic(awake_body(b, awake)) || b->kinematic_line[awake] >= batch->first_line) return;
    b->kinematic_line[awake] = b->s->line_count;
    add_line(b->s, b->in->awake_bodies[awake]);
}

// its dummies, its bodies, and copies of the kinematic bodies that its contacts and joints read: those a worker moves along by itself
static void assign_lines(builder *b, int32_t k)
{
    fe__solver *s = b->s;
    fe__batch *batch = s->batches + k;
    batch->first_line = s->line_count;
    for (int32_t i = 0; i < DUMMY_LINES; ++i) add_line(s, NONE);
    for (int32_t i = b->body_start[k]; i < b->body_start[k + 1]; ++i) {
        fe__body *body = b->in->bodies + b->in->awake_bodies[b->body_order[i]];
        body->line = b->line[b->body_order[i]] = s->line_count;
        body->island = b->island_of[b->body_order[i]];
        add_line(s, b->in->awake_bodies[b->body_order[i]]);
    }
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        const linked *c = b->linked + b->contact_order[i];
        if (!(c->key & FE__ROW_PAIR)) add_kinematic(b, batch, c->awake_a);
    }
    for (int32_t i = b->joint_start[k]; i < b->joint_start[k + 1]; ++i) {
        const fe__joint *j = b->in->joints->joints + b->joint_order[i];
        if (!(j->rows >> FE__SIDES_SHIFT & FE__KINEMATIC_END)) continue;
        add_kinematic(b, batch, b->in->bodies[j->body_a].awake_index);
        add_kinematic(b, batch, b->in->bodies[j->body_b].awake_index);
    }
    close_block(s);
    batch->line_count = s->line_count - batch->first_line;
}

// ---- lanes ----------------------------------------------------------------------------------------------------------------------------
static int32_t line_of(const builder *b, int32_t body)
{
    const fe__body *a = b->in->bodies + body;
    if (a->type == FE_BODY_DYNAMIC) return a->line;
    return is_kinematic(a) && a->awake_index >= 0 ? b->kinematic_line[a->awake_index] : FE__STATIC_LINE;
}

static fe__lane lane_of(const builder *b, const linked *c)
{
    int32_t line_a = c->awake_a < 0 ? FE__STATIC_LINE : c->key & FE__ROW_PAIR ? b->line[c->awake_a] : b->kinematic_line[c->awake_a];
    return (fe__lane){c->contact, line_a, b->line[c->awake_b]};
}

// `like` tells all but the place
static fe__group *open_group(builder *b, fe__batch *batch, fe__group like, int32_t lanes, int32_t row_size)
{
    fe__solver *s = b->s;
    fe__group *g = s->groups + s->group_count++;
    int32_t dummy = batch->first_line + (like.kind < FE__ROW_KINDS ? like.kind : FE__ROW_KINDS - 1 + like.sides);
    *g = like;
    g->lane = s->lane_count, g->offset = batch->row_bytes, g->rows = (lanes + b->width - 1) / b->width;
    for (int32_t i = 0; i < g->rows * b->width; ++i) s->lanes[s->lane_count + i] = (fe__lane){0, dummy, dummy};
    s->lane_count += g->rows * b->width;
    batch->row_bytes += (int64_t)g->rows * row_size;
    ++batch->group_count;
    return g;
}

static fe__group *open_contacts(builder *b, fe__batch *batch, int32_t colour, int32_t kind, int32_t contacts, const fe__kernels *kernels)
{
    fe__group like = {.kind = kind, .colour = FE__CONTACT_COLOURS + colour, .alone = colour == FE__OVERFLOW_COLOUR};
    return open_group(b, batch, like, contacts, kernels->contact->row_size[kind]);
}

// contacts beyond the colours of a crowded body: one a row, in the order of the pairs' creation
static void add_overflow(builder *b, int32_t k, const fe__kernels *kernels)
{
    fe__solver *s = b->s;
    int32_t n = 0;
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        const linked *c = b->linked + b->contact_order[i];
        if (c->key / FE__ROW_KINDS == FE__OVERFLOW_COLOUR)
            s->sort_items[n++] = (fe__sort_item){b->in->serials[2 * c->contact + 1], b->contact_order[i], 0};
    }
    if (n == 0) return; // then there may be no items at all
    fe__sort_keys(s->sort_items, n, s->sort_items + n);
    for (int32_t i = 0; i < n; ++i) s->sort_items[i].key = b->in->serials[2 * b->linked[s->sort_items[i].value].contact];
    fe__sort_keys(s->sort_items, n, s->sort_items + n);
    for (int32_t i = 0; i < n; ++i) {
        const linked *c = b->linked + s->sort_items[i].value;
        s->lanes[open_contacts(b, s->batches + k, FE__OVERFLOW_COLOUR, c->key % FE__ROW_KINDS, 1, kernels)->lane] = lane_of(b, c);
    }
}

// ---- joints' lanes: by part, then by colour, then by which ends move ------------------------------------------------------------------
static int32_t joint_key(int32_t part, const fe__joint *j)
{
    return (part * (FE__JOINT_COLOURS + 1) + j->colour) * SIDES + (int32_t)sides_of(j) - 1;
}

static fe__group *open_joints(builder *b, fe__batch *batch, int32_t key, int32_t lanes, const fe__kernels *kernels)
{
    int32_t colour = key / SIDES, part = colour / (FE__JOINT_COLOURS + 1);
    fe__group like = {.kind = FE__ROW_KINDS + part, .colour = colour, .sides = 1 + key % SIDES};
    like.alone = colour % (FE__JOINT_COLOURS + 1) == FE__JOINT_OVERFLOW;
    return open_group(b, batch, like, lanes, kernels->joint->of[part].row_size);
}

static fe__lane joint_lane(const builder *b, int32_t joint)
{
    const fe__joint *j = b->in->joints->joints + joint;
    return (fe__lane){joint, line_of(b, j->body_a), line_of(b, j->body_b)};
}

// joints beyond the colours of a crowded body, sorted by creation: their number
static int32_t sort_overflow(builder *b, int32_t k)
{
    fe__sort_item *items = b->s->sort_items;
    int32_t n = 0;
    for (int32_t i = b->joint_start[k]; i < b->joint_start[k + 1]; ++i) {
        int32_t joint = b->joint_order[i];
        if (b->in->joints->joints[joint].colour == FE__JOINT_OVERFLOW)
            items[n++] = (fe__sort_item){b->in->joints->frames[joint].serial, joint, 0};
    }
    if (n) fe__sort_keys(items, n, items + n);
    return n;
}

static void open_part(builder *b, fe__batch *batch, int32_t part, int32_t overflowing, const fe__kernels *kernels)
{
    enum { KEYS = FE__JOINT_COLOURS * SIDES };
    fe__solver *s = b->s;
    int32_t first = part * (FE__JOINT_COLOURS + 1) * SIDES;
    for (int32_t key = first; key < first + KEYS; ++key) {
        if (!b->joint_key_count[key]) continue;
        b->joint_key_group[key] = s->group_count;
        b->joint_key_count[key] = open_joints(b, batch, key, b->joint_key_count[key], kernels)->lane;
    }
    for (int32_t i = 0; i < overflowing; ++i) {
        int32_t joint = s->sort_items[i].value;
        const fe__joint *j = b->in->joints->joints + joint;
        if (j->rows >> part & 1) s->lanes[open_joints(b, batch, joint_key(part, j), 1, kernels)->lane] = joint_lane(b, joint);
    }
}

// ---- trees ----------------------------------------------------------------------------------------------------------------------------
static int32_t link_of(const builder *b, int32_t joint)
{
    const fe__forest *f = &b->in->joints->forest;
    return f->link_count ? f->link_of[joint] : NONE;
}

// A link's bodies, and a tree's group, when the first of its links comes by
static void open_link(builder *b, fe__batch *batch, int32_t link, fe__lane lane, const fe__kernels *kernels)
{
    fe__solver *s = b->s;
    const fe__forest *f = &b->in->joints->forest;
    const fe__tree_link *l = f->links + link;
    int32_t first = f->trees[l->tree].first, count = f->trees[l->tree].count, rootless = !f->links[first].joint;
    s->places[link] =
        (fe__tree_place){.line = l->holds_b ? lane.line_b : lane.line_a, .parent_line = l->holds_b ? lane.line_a : lane.line_b};
    if (link != first + rootless) return;
    batch->row_bytes = whole_blocks(batch->row_bytes);
    if (rootless) s->places[first] = (fe__tree_place){.line = line_of(b, f->links[first].body), .parent_line = FE__STATIC_LINE};
    s->groups[s->group_count++] =
        (fe__group){.kind = FE__TREE_KIND, .colour = FE__TREE_COLOUR, .lane = l->tree, .rows = 1, .offset = batch->row_bytes};
    batch->row_bytes += (int64_t)count * kernels->joint->tree.node_size;
    ++batch->group_count, ++batch->trees;
}

// the rows of a link's locks
static void add_lock(const builder *b, int32_t link, int32_t part, int32_t group, int32_t lane, const fe__kernels *kernels)
{
    const fe__group *g = b->s->groups + group;
    fe__tree_place *p = b->s->places + link;
    if (!((FE__LOCKS | 1 << FE__PART_DISTANCE) >> part & 1)) return;
    p->lock[p->locks].part = part;
    p->lock[p->locks].lane = (lane - g->lane) % b->width;
    p->lock[p->locks++].row = g->offset + (int64_t)((lane - g->lane) / b->width) * kernels->joint->of[part].row_size;
}

static void fill_joint_lanes(builder *b, fe__batch *batch, int32_t joint, const fe__kernels *kernels)
{
    const fe__joint *j = b->in->joints->joints + joint;
    fe__lane lane = joint_lane(b, joint);
    int32_t link = link_of(b, joint);
    if (link >= 0) open_link(b, batch, link, lane, kernels);
    for (int32_t part = 0; part < FE__PARTS; ++part) {
        if (!(j->rows >> part & 1)) continue;
        int32_t key = joint_key(part, j), at = b->joint_key_count[key]++;
        b->s->lanes[at] = lane;
        if (link >= 0) add_lock(b, link, part, b->joint_key_group[key], at, kernels);
    }
}

static void make_joint_groups(builder *b, int32_t k, const fe__kernels *kernels)
{
    fe__batch *batch = b->s->batches + k;
    if (!batch->joint_count) return;
    memset(b->joint_key_count, 0, sizeof(int32_t) * JOINT_KEYS);
    for (int32_t i = b->joint_start[k]; i < b->joint_start[k + 1]; ++i) {
        const fe__joint *j = b->in->joints->joints + b->joint_order[i];
        for (int32_t part = 0; part < FE__PARTS; ++part) b->joint_key_count[joint_key(part, j)] += (int32_t)(j->rows >> part & 1);
    }
    int32_t overflowing = sort_overflow(b, k);
    for (int32_t part = 0; part < FE__PARTS; ++part) open_part(b, batch, part, overflowing, kernels);
    for (int32_t i = b->joint_start[k]; i < b->joint_start[k + 1]; ++i) {
        const fe__joint *j = b->in->joints->joints + b->joint_order[i];
        if (j->colour != FE__JOINT_OVERFLOW) fill_joint_lanes(b, batch, b->joint_order[i], kernels);
    }
    batch->joint_groups = batch->group_count;
}

static void make_groups(builder *b, int32_t k, const fe__kernels *kernels)
{
    fe__solver *s = b->s;
    fe__batch *batch = s->batches + k;
    batch->first_group = s->group_count;
    make_joint_groups(b, k, kernels);
    memset(b->key_count, 0, sizeof(int32_t) * GROUP_KEYS);
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        int32_t key = b->linked[b->contact_order[i]].key;
        ++b->key_count[key];
        batch->bounces |= key & FE__ROW_SPECIAL;
    }
    for (int32_t key = 0; key < FE__OVERFLOW_COLOUR * FE__ROW_KINDS; ++key) {
        int32_t contacts = b->key_count[key];
        if (contacts) b->key_count[key] = open_contacts(b, batch, key / FE__ROW_KINDS, key % FE__ROW_KINDS, contacts, kernels)->lane;
    }
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        const linked *c = b->linked + b->contact_order[i];
        if (c->key / FE__ROW_KINDS != FE__OVERFLOW_COLOUR) s->lanes[b->key_count[c->key]++] = lane_of(b, c);
    }
    add_overflow(b, k, kernels);
}

// the rows of each batch have room: all of it for a large one, a worker's stretch for the others
static int32_t rows_fit(const fe__solver *s)
{
    for (int32_t k = 0; k < s->batch_count; ++k)
        if (s->batches[k].row_bytes > (k < s->large_count ? (int64_t)sizeof(fe__row_block) * s->row_capacity : s->worker_row_bytes))
            return 0;
    return 1;
}

void fe__graph_build(fe__solver *s, const fe__kernels *kernels, const fe__graph_input *input)
{
    builder b = make_builder(s, kernels, input);
    find_islands(&b);
    make_batches(&b);
    sort_by_batch(&b);
    s->group_count = s->lane_count = s->line_count = 0;
    for (int32_t i = 0; i < FE__MAX_WIDTH; ++i) add_line(s, NONE); // FE__STATIC_LINE and its block
    for (int32_t k = 0; k < s->batch_count; ++k) {
        assign_lines(&b, k);
        make_groups(&b, k, kernels);
    }
    assert(s->line_count <= s->body_of_line_capacity && s->lane_count <= s->lane_capacity && s->group_count <= s->group_capacity);
    assert(rows_fit(s));
    (void)rows_fit; // without assertions nobody asks
    s->graph_changed = 0;
}
