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
    // a batch of islands without contacts ends here: about as many lines as a second-level cache holds
    BATCH_BODIES = 1024,
    // lines of zeros before a batch's bodies, one for each kind of row: what its padding lanes name. A batch's own, so that no two workers write
    // one line
    DUMMY_LINES = FE__MAX_WIDTH
};
_Static_assert((int)DUMMY_LINES >= (int)FE__ROW_KINDS, "one dummy line for each kind");

// scratch of a build, carved from one block of ints
typedef struct builder {
    fe__solver *s;
    const fe__graph_input *in;
    int32_t width;
    int32_t *parent;           // by awake index of a body; a parent's index is never above its child's
    int32_t *island_of;        // by awake index, NONE: kinematic
    int32_t *island_contacts;  // by island
    int32_t *island_bodies;
    int32_t *batch_of;         // of an island
    int32_t *kinematic_line;   // by awake index: line of the copy in the batch at hand
    int32_t *body_order;       // awake indices by batch
    int32_t *linked;           // contacts in the graph, each with the awake index of its body B
    int32_t linked_count;
    int32_t *contact_order;    // contacts by batch
    int32_t *body_start;       // by batch, one more than there are
    int32_t *contact_start;
    int32_t *key_count;        // by colour and kind
} builder;

// ---- room ---------------------------------------------------------------------------------------------------------------------------
static int32_t batch_bound(const fe__graph_bound *b)
{
    // two neighbouring small batches together exceed a limit; large islands exceed theirs; one for kinematic bodies, one that stayed open
    return 2 * (b->contacts / FE__BATCH_CONTACTS + b->bodies / BATCH_BODIES) + b->contacts / FE__ISLAND_LARGE + 3;
}

// distinct groups of one batch: a greedy colour is below the contacts of both bodies
static int32_t group_bound(const fe__graph_bound *b)
{
    int32_t colours = fe__mini(2 * b->most_contacts, FE__COLOURS);
    return colours * b->kinds;
}

static int64_t row_bound(const fe__graph_bound *b, int32_t contacts, int32_t width)
{
    int64_t rows = contacts / width + fe__mini(group_bound(b), contacts) + fe__mini(b->crowded, contacts);
    return rows < contacts ? rows : contacts;
}

static int64_t scratch_bound(const fe__graph_bound *b)
{
    return 7 * (int64_t)b->bodies + 3 * (int64_t)b->contacts + 2 * (batch_bound(b) + 1) + GROUP_KEYS;
}

int32_t fe__graph_reserve(fe__solver *s, fe__memory *memory, const fe__kernels *kernels, const fe__graph_bound *b, int32_t workers)
{
    int32_t batches = batch_bound(b), width = kernels->width;
    int64_t groups = (int64_t)fe__mini(group_bound(b) * batches, b->contacts) + fe__mini(b->crowded, b->contacts);
    int64_t lanes = b->contacts + (int64_t)(width - 1) * groups;
    // each contact of a kinematic body may bring a copy of it
    int64_t lines = FE__MAX_WIDTH + (int64_t)b->bodies + (int64_t)batches * (DUMMY_LINES + FE__MAX_WIDTH) + (b->special ? b->contacts : 0);
    int64_t lane_limit = b->contacts * (int64_t)width;
    if (lanes > lane_limit) lanes = lane_limit;
    int64_t widest = kernels->contact->row_size[b->special ? FE__ROW_PAIR | FE__ROW_SPECIAL : FE__ROW_PAIR];
    int64_t small = row_bound(b, fe__mini(b->contacts, FE__BATCH_CONTACTS + FE__ISLAND_LARGE), width) * widest;
    int64_t large = b->contacts > FE__ISLAND_LARGE ? row_bound(b, b->contacts, width) * widest : 0;
    int64_t rows = small * workers > large ? small * workers : large;
    if (!FE_RESERVE(memory, s->velocity, s->line_capacity[0], lines) || !FE_RESERVE(memory, s->motion, s->line_capacity[1], lines) ||
        !FE_RESERVE(memory, s->start, s->line_capacity[2], lines) || !FE_RESERVE(memory, s->inertia, s->line_capacity[3], lines) ||
        !FE_RESERVE(memory, s->drive, s->line_capacity[4], lines) || !FE_RESERVE(memory, s->spin, s->line_capacity[5], lines) ||
        !FE_RESERVE(memory, s->body_of_line, s->body_of_line_capacity, lines) || !FE_RESERVE(memory, s->batches, s->batch_capacity, batches) ||
        !FE_RESERVE(memory, s->groups, s->group_capacity, groups + 1) || !FE_RESERVE(memory, s->lanes, s->lane_capacity, lanes + width) ||
        !FE_RESERVE(memory, s->sort_items, s->sort_capacity, 2 * (int64_t)fe__mini(b->crowded, b->contacts)) ||
        !FE_RESERVE(memory, s->scratch, s->scratch_capacity, scratch_bound(b)) || !FE_RESERVE(memory, s->rows, s->row_capacity, rows / 64 + 1))
        return 0;
    s->worker_row_bytes = (small + 63) / 64 * 64;
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
    FE_FREE(memory, s->batches, s->batch_capacity);
    FE_FREE(memory, s->groups, s->group_capacity);
    FE_FREE(memory, s->lanes, s->lane_capacity);
    FE_FREE(memory, s->sort_items, s->sort_capacity);
    FE_FREE(memory, s->scratch, s->scratch_capacity);
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
    int32_t *at = s->scratch;
    int64_t n = in->body_count;
    builder b = {.s = s, .in = in, .width = kernels->width};
    b.parent = carve(&at, n);
    b.island_of = carve(&at, n);
    b.island_contacts = carve(&at, n);
    b.island_bodies = carve(&at, n);
    b.batch_of = carve(&at, n);
    b.kinematic_line = carve(&at, n);
    b.body_order = carve(&at, n);
    b.linked = carve(&at, 2 * (int64_t)in->contact_count);
    b.contact_order = carve(&at, in->contact_count);
    b.key_count = carve(&at, GROUP_KEYS);
    b.body_start = carve(&at, (s->scratch + s->scratch_capacity - at) / 2);
    b.contact_start = at;
    return b;
}

// ---- islands ------------------------------------------------------------------------------------------------------------------------
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
        if (m->colour < 0) continue;
        int32_t awake = in->bodies[m->body_b].awake_index;
        b->linked[2 * b->linked_count] = contact;
        b->linked[2 * b->linked_count++ + 1] = awake;
        if (m->kind & FE__ROW_PAIR) join(b->parent, in->bodies[m->body_a].awake_index, awake);
    }
}

static void find_islands(builder *b)
{
    const fe__graph_input *in = b->in;
    for (int32_t i = 0; i < in->body_count; ++i) b->parent[i] = i;
    join_contacts(b);
    int32_t count = 0;
    for (int32_t i = 0; i < in->body_count; ++i) {
        int32_t is_root = b->parent[i] == i; // else its parent came before it
        if (is_kinematic(awake_body(b, i))) {
            b->island_of[i] = NONE;
            continue;
        }
        if (is_root) {
            b->island_contacts[count] = b->island_bodies[count] = 0;
            b->island_of[i] = count++;
        } else
            b->island_of[i] = b->island_of[b->parent[i]];
        ++b->island_bodies[b->island_of[i]];
    }
    for (int32_t i = 0; i < b->linked_count; ++i) ++b->island_contacts[b->island_of[b->linked[2 * i + 1]]];
    b->s->island_count = count;
}

// ---- batches ------------------------------------------------------------------------------------------------------------------------
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
    batch->body_count += b->island_bodies[island];
    ++batch->island_count;
    b->batch_of[island] = b->s->batch_count - 1;
}

// large islands first, each a batch of its own; then the small ones, in order
static void make_batches(builder *b)
{
    fe__solver *s = b->s;
    s->batch_count = 0;
    for (int32_t i = 0; i < s->island_count; ++i) {
        if (b->island_contacts[i] <= FE__ISLAND_LARGE) continue;
        open_batch(s);
        add_island(b, i);
    }
    s->large_count = s->batch_count;
    const fe__batch *open = NULL;
    for (int32_t i = 0; i < s->island_count; ++i) {
        if (b->island_contacts[i] > FE__ISLAND_LARGE) continue;
        if (!open || open->contact_count + b->island_contacts[i] > FE__BATCH_CONTACTS || open->body_count + b->island_bodies[i] > BATCH_BODIES)
            open = open_batch(s);
        add_island(b, i);
    }
    open_batch(s); // of the kinematic bodies
}

static int32_t batch_of_body(const builder *b, int32_t i) { return b->island_of[i] < 0 ? b->s->batch_count - 1 : b->batch_of[b->island_of[i]]; }

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
    for (int32_t i = 0; i < b->linked_count; ++i)
        b->contact_order[b->contact_start[batch_of_body(b, b->linked[2 * i + 1])]++] = b->linked[2 * i];
    unwind(b->contact_start, batches);
}

// ---- lines --------------------------------------------------------------------------------------------------------------------------
static void close_block(fe__solver *s)
{
    while (s->line_count % FE__MAX_WIDTH) s->body_of_line[s->line_count++] = NONE;
}

static void add_line(fe__solver *s, int32_t body) { s->body_of_line[s->line_count++] = body; }

// its dummies, its bodies, and copies of the kinematic bodies that its contacts read: those a worker moves along by itself
static void assign_lines(builder *b, int32_t k)
{
    fe__solver *s = b->s;
    fe__batch *batch = s->batches + k;
    batch->first_line = s->line_count;
    for (int32_t i = 0; i < DUMMY_LINES; ++i) add_line(s, NONE);
    for (int32_t i = b->body_start[k]; i < b->body_start[k + 1]; ++i) {
        fe__body *body = b->in->bodies + b->in->awake_bodies[b->body_order[i]];
        body->line = s->line_count;
        body->island = b->island_of[b->body_order[i]];
        b->kinematic_line[b->body_order[i]] = NONE;
        add_line(s, b->in->awake_bodies[b->body_order[i]]);
    }
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        int32_t body = b->in->contacts[b->contact_order[i]].body_a, awake = b->in->bodies[body].awake_index;
        if (!is_kinematic(b->in->bodies + body) || awake < 0 || b->kinematic_line[awake] >= batch->first_line) continue;
        b->kinematic_line[awake] = s->line_count;
        add_line(s, body);
    }
    close_block(s);
    batch->line_count = s->line_count - batch->first_line;
}

// ---- lanes --------------------------------------------------------------------------------------------------------------------------
static fe__lane lane_of(const builder *b, const fe__batch *batch, int32_t contact)
{
    const fe__contact *m = b->in->contacts + contact;
    const fe__body *a = b->in->bodies + m->body_a;
    int32_t line_a = FE__STATIC_LINE;
    if (a->type == FE_BODY_DYNAMIC) line_a = a->line;
    if (is_kinematic(a) && a->awake_index >= 0) line_a = b->kinematic_line[a->awake_index];
    assert(b->in->bodies[m->body_b].line >= batch->first_line);
    (void)batch;
    return (fe__lane){contact, line_a, b->in->bodies[m->body_b].line};
}

static fe__group *open_group(builder *b, fe__batch *batch, int32_t colour, int32_t kind, int32_t contacts, const fe__kernels *kernels)
{
    fe__solver *s = b->s;
    fe__group *g = s->groups + s->group_count++;
    int32_t rows = (contacts + b->width - 1) / b->width, dummy = batch->first_line + kind;
    *g = (fe__group){s->lane_count, rows, kind, colour, batch->row_bytes};
    for (int32_t i = 0; i < rows * b->width; ++i) s->lanes[s->lane_count + i] = (fe__lane){0, dummy, dummy};
    s->lane_count += rows * b->width;
    batch->row_bytes += (int64_t)rows * kernels->contact->row_size[kind];
    ++batch->group_count;
    return g;
}

// contacts beyond the colours of a crowded body: one a row, in the order of the pairs' creation
static void add_overflow(builder *b, int32_t k, const fe__kernels *kernels)
{
    fe__solver *s = b->s;
    int32_t n = 0;
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        int32_t c = b->contact_order[i];
        if (b->in->contacts[c].colour == FE__OVERFLOW_COLOUR) s->sort_items[n++] = (fe__sort_item){b->in->serials[2 * c + 1], c, 0};
    }
    if (n == 0) return; // then there may be no items at all
    fe__sort_keys(s->sort_items, n, s->sort_items + n);
    for (int32_t i = 0; i < n; ++i) s->sort_items[i].key = b->in->serials[2 * s->sort_items[i].value];
    fe__sort_keys(s->sort_items, n, s->sort_items + n);
    for (int32_t i = 0; i < n; ++i) {
        int32_t c = s->sort_items[i].value;
        fe__group *g = open_group(b, s->batches + k, FE__OVERFLOW_COLOUR, b->in->contacts[c].kind, 1, kernels);
        s->lanes[g->lane] = lane_of(b, s->batches + k, c);
    }
}

static void make_groups(builder *b, int32_t k, const fe__kernels *kernels)
{
    fe__solver *s = b->s;
    fe__batch *batch = s->batches + k;
    batch->first_group = s->group_count;
    memset(b->key_count, 0, sizeof(int32_t) * GROUP_KEYS);
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        const fe__contact *m = b->in->contacts + b->contact_order[i];
        ++b->key_count[m->colour * FE__ROW_KINDS + m->kind];
        batch->bounces |= m->kind & FE__ROW_SPECIAL;
    }
    for (int32_t key = 0; key < FE__OVERFLOW_COLOUR * FE__ROW_KINDS; ++key) {
        int32_t contacts = b->key_count[key];
        if (contacts) b->key_count[key] = open_group(b, batch, key / FE__ROW_KINDS, key % FE__ROW_KINDS, contacts, kernels)->lane;
    }
    for (int32_t i = b->contact_start[k]; i < b->contact_start[k + 1]; ++i) {
        const fe__contact *m = b->in->contacts + b->contact_order[i];
        if (m->colour != FE__OVERFLOW_COLOUR) s->lanes[b->key_count[m->colour * FE__ROW_KINDS + m->kind]++] = lane_of(b, batch, b->contact_order[i]);
    }
    add_overflow(b, k, kernels);
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
    s->graph_changed = 0;
}
