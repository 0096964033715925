// graph.c - the build: batches of islands (graph_islands.c), then of each its lines for bodies and its groups of lanes
// by colour and kind of row; those of joints are in graph_joints.c, the room for all in graph_room.c.
//
// All orders that could matter follow the creation of the pairs; everything else is free to follow the awake lists,
// because lanes are independent and a group's contacts share no dynamic body.
#include "solver/graph/graph.h"

#include "solver/graph/graph_build.h"

#include "core/array_sort.h"

#include <assert.h>
#include <string.h>

static int32_t *carve(int32_t **from, int64_t count)
{
    int32_t *block = *from;
    *from += count;
    return block;
}

static fe__builder make_builder(fe__solver *s, const fe__kernels *kernels, const fe__graph_input *in)
{
    int32_t *at = (int32_t *)(void *)s->rows; // no rows are in use while the graph is built
    int64_t n = in->body_count;
    fe__builder b = {.s = s, .in = in, .width = kernels->width};
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
    b.linked = (fe__linked *)(void *)carve(&at, FE__LINKED_INTS * (int64_t)in->contact_count);
    b.contact_order = carve(&at, in->contact_count);
    b.joint_order = carve(&at, in->joint_count);
    b.key_count = carve(&at, FE__GROUP_KEYS);
    b.joint_key_count = carve(&at, FE__JOINT_GROUP_KEYS);
    b.joint_key_group = carve(&at, FE__JOINT_GROUP_KEYS);
    const int32_t *end = (const int32_t *)(const void *)(s->rows + s->row_capacity);
    int64_t starts = (end - at) / 3;
    b.body_start = carve(&at, starts);
    b.contact_start = carve(&at, starts);
    b.joint_start = at;
    return b;
}

// ---- lines ----------------------------------------------------------------------------------------------------------
static void add_line(fe__solver *s, int32_t body) { s->body_of_line[s->line_count++] = (fe__body_name){0, body}; }

static void close_block(fe__solver *s)
{
    while (s->line_count % FE__MAX_WIDTH) add_line(s, FE__NONE);
}

static void add_kinematic(fe__builder *b, const fe__batch *batch, int32_t awake)
{
    if (awake < 0 || !fe__is_kinematic(fe__awake_body(b, awake)) || b->kinematic_line[awake] >= batch->first_line)
        return;
    b->kinematic_line[awake] = b->s->line_count;
    add_line(b->s, b->in->awake_bodies[awake]);
}

// its dummies, its bodies, and copies of the kinematic bodies that its contacts and joints read: those a worker moves
// along by itself
static void assign_lines(fe__builder *b, int32_t k)
{
    fe__solver *s = b->s;
    fe__batch *batch = s->batches + k;
    batch->first_line = s->line_count;
    for (int32_t i = 0; i < FE__DUMMY_LINES; ++i) add_line(s, FE__NONE);
    for (int32_t i = b->body_start[k]; i < b->body_start[k + 1]; ++i) {
        fe__body *body = b->in->bodies + b->in->awake_bodies[b->body_order[i]];
        body->line = b->line[b->body_order[i]] = s->line_count;
        body->island = b->island_of[b->body_order[i]];
        add_line(s, b->in->awake_bodies[b->body_order[i]]);
    }
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        const fe__linked *c = b->linked + b->contact_order[i];
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

static fe__lane lane_of(const fe__builder *b, const fe__linked *c)
{
    int32_t line_a = c->awake_a < 0          ? FE__STATIC_LINE
                     : c->key & FE__ROW_PAIR ? b->line[c->awake_a]
                                             : b->kinematic_line[c->awake_a];
    return (fe__lane){c->contact, c->points, line_a, b->line[c->awake_b], 0};
}

// Of a hub each contact has a colour to itself, or none: its group has a row, which would be empty but for a lane
static fe__group *open_contacts(fe__builder *b, fe__batch *batch, int32_t colour, int32_t kind, int32_t contacts,
                                const fe__kernels *kernels)
{
    fe__group like = {.kind = kind, .colour = FE__CONTACT_COLOURS + colour, .alone = colour == FE__OVERFLOW_COLOUR};
    like.width = fe__width_for(b, contacts);
    return fe__open_group(b, batch, like, contacts, fe__contact_kernels_of(kernels, like.width)->row_size[kind]);
}

// contacts beyond the colours of a crowded body: one a row, in the order of the pairs' creation
static void add_overflow(fe__builder *b, int32_t k, const fe__kernels *kernels)
{
    fe__solver *s = b->s;
    int32_t n = 0;
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        const fe__linked *c = b->linked + b->contact_order[i];
        if (c->key / FE__ROW_KINDS == FE__OVERFLOW_COLOUR)
            s->sort_items[n++] = (fe__sort_item){b->in->serials[2 * c->points + 1], b->contact_order[i], 0};
    }
    if (n == 0) return; // then there may be no items at all
    s->built.overflow += n;
    fe__sort_keys(s->sort_items, n, s->sort_items + n);
    for (int32_t i = 0; i < n; ++i) s->sort_items[i].key = b->in->serials[2 * b->linked[s->sort_items[i].value].points];
    fe__sort_keys(s->sort_items, n, s->sort_items + n);
    for (int32_t i = 0; i < n; ++i) {
        const fe__linked *c = b->linked + s->sort_items[i].value;
        s->lanes[open_contacts(b, s->batches + k, FE__OVERFLOW_COLOUR, c->key % FE__ROW_KINDS, 1, kernels)->lane] =
            lane_of(b, c);
    }
}

// Of each group loose contacts come last: rows of idle ones alone are skipped (contact/idle.inl)
static void fill_lanes(fe__builder *b, int32_t k, int32_t loose)
{
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        const fe__linked *c = b->linked + b->contact_order[i];
        if (c->loose != loose || c->key / FE__ROW_KINDS == FE__OVERFLOW_COLOUR) continue;
        b->s->lanes[b->key_count[c->key]++] = lane_of(b, c);
    }
}

// ---- groups ---------------------------------------------------------------------------------------------------------
static void make_groups(fe__builder *b, int32_t k, const fe__kernels *kernels)
{
    fe__solver *s = b->s;
    fe__batch *batch = s->batches + k;
    batch->first_group = s->group_count;
    fe__graph_joint_groups(b, k, kernels);
    memset(b->keys, 0, sizeof b->keys);
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        int32_t key = b->linked[b->contact_order[i]].key;
        fe__count_key(b->keys, b->key_count, key, 1);
        batch->bounces |= key & FE__ROW_SPECIAL;
    }
    const int32_t end = FE__OVERFLOW_COLOUR * FE__ROW_KINDS;
    for (int32_t key = 0; (key = fe__next_key(b->keys, key, end)) < end; ++key) {
        int32_t contacts = b->key_count[key], kind = key % FE__ROW_KINDS;
        b->key_count[key] = open_contacts(b, batch, key / FE__ROW_KINDS, kind, contacts, kernels)->lane;
        s->built.contacts[kind] += contacts;
        s->built.colours[kind] += !(b->seen[key / FE__KEY_WORD] >> key % FE__KEY_WORD & 1);
    }
    for (int32_t i = 0; i < FE__KEY_WORDS(FE__GROUP_KEYS); ++i) b->seen[i] |= b->keys[i];
    fill_lanes(b, k, 0);
    fill_lanes(b, k, 1);
    add_overflow(b, k, kernels);
}

// the rows of each batch have room: all of it for a large one, a worker's stretch for the others
static int32_t rows_fit(const fe__solver *s)
{
    for (int32_t k = 0; k < s->batch_count; ++k)
        if (s->batches[k].row_bytes >
            (k < s->large_count ? (int64_t)sizeof(fe__row_block) * s->row_capacity : s->worker_row_bytes))
            return 0;
    return 1;
}

void fe__graph_build(fe__solver *s, const fe__kernels *kernels, const fe__graph_input *input)
{
    fe__records only = {.joints = {.joints = NULL}};
    if (input->joints) only.joints = *input->joints;
    fe__builder b = make_builder(s, kernels, input);
    b.of = &only;
    fe__graph_find_batches(&b);
    s->group_count = s->lane_count = s->line_count = s->tree_count = 0;
    s->built = (fe__built){.overflow = 0};
    s->unbuilt = 0;
    for (int32_t i = 0; i < FE__MAX_WIDTH; ++i) add_line(s, FE__NONE); // FE__STATIC_LINE and its block
    for (int32_t k = 0; k < s->batch_count; ++k) {
        assign_lines(&b, k);
        make_groups(&b, k, kernels);
    }
    assert(s->line_count <= s->body_of_line_capacity && s->lane_count <= s->lane_capacity &&
           s->group_count <= s->group_capacity);
    assert(rows_fit(s));
    (void)rows_fit; // used by the assertion alone
    s->graph_changed = s->graph_age = 0;
}
