// graph.c - the build: batches of islands (graph.c), then of each its lines for bodies and its groups of lanes
// by colour and kind of row; those of joints are in graph.c, the room for all in graph_capacity.c.
//
// All orders that could matter follow the creation of the pairs; everything else is free to follow the awake lists,
// because lanes are independent and a group's contacts share no dynamic body.
#include "solver/graph/graph.h"

#include "core/bytes.h"
#include "core/sort.h"
#include "solver/pace.h"

#include <assert.h>
#include <string.h>

// ---- graph ----------------------------------------------------------------------------------------------------------

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

// ---- graph build ----------------------------------------------------------------------------------------------------

int32_t fe__line_of(const fe__builder *b, int32_t body)
{
    const fe__body *a = b->in->bodies + body;
    if (a->type == FE_BODY_DYNAMIC) return a->line;
    return fe__is_kinematic(a) && a->awake_index >= 0 ? b->kinematic_line[a->awake_index] : FE__STATIC_LINE;
}

fe__group *fe__open_group(fe__builder *b, fe__batch *batch, fe__group like, int32_t lanes, int32_t row_size)
{
    fe__solver *s = b->s;
    fe__group *g = s->groups + s->group_count++;
    int32_t dummy = batch->first_line + (like.kind < FE__ROW_KINDS ? like.kind : FE__ROW_KINDS - 1 + like.sides);
    *g = like;
    g->lane = s->lane_count, g->offset = batch->row_bytes, g->rows = (lanes + like.width - 1) / like.width;
    for (int32_t i = 0; i < g->rows * g->width; ++i) s->lanes[s->lane_count + i] = (fe__lane){0, 0, dummy, dummy, 0};
    s->lane_count += g->rows * g->width;
    // a wide row may come after thin ones
    batch->row_bytes += g->rows * (g->width < b->width ? fe__whole_blocks(row_size) : row_size);
    ++batch->group_count;
    return g;
}

// ---- colour ---------------------------------------------------------------------------------------------------------

// ---- the constraint graph -------------------------------------------------------------------------------------------
static int32_t first_colour(uint64_t used_low, uint64_t used_high, int32_t first, int32_t end)
{
    for (int32_t word = first / 64; word <= (end - 1) / 64; ++word) {
        uint64_t free = ~(word ? used_high : used_low);
        if (word == first / 64) free &= UINT64_MAX << first % 64;
        if (!free) continue;
        int32_t colour = 64 * word + __builtin_ctzll(free);
        if (colour < end) return colour;
    }
    return FE__OVERFLOW_COLOUR;
}

static void take_colour(fe__body *body, int32_t colour) { body->colours[colour / 64] |= UINT64_C(1) << colour % 64; }

static void return_colour(fe__body *body, int32_t colour)
{
    body->colours[colour / 64] &= ~(UINT64_C(1) << colour % 64);
}

// Contacts of a pile come in an order, left before right. The first free colour would be another name for it: the
// solver would take left before right everywhere, and what a sweep gets wrong would add up (the top of 100 rows went
// 0.15 m aside). So it is drawn which of a colour and its mate (0 and 1, 2 and 3, ...) is taken; layers still follow
// each other as their colours come. The draw hangs on the meetings of the two bodies and of those that they met, not on
// serials, which strangers shift.
static int32_t draw_colour(fe__body *a, fe__body *b)
{
    uint64_t used[2] = {a->colours[0] | b->colours[0], a->colours[1] | b->colours[1]};
    uint64_t mixed = (((uint64_t)a->drawn << 32 | b->drawn) + 1) * FE_HASH_FACTOR;
    a->drawn = b->drawn = (uint32_t)(mixed >> 32);
    int32_t colour = first_colour(used[0], used[1], 0, FE__PAIR_COLOURS), mate = colour ^ 1;
    if (colour == FE__OVERFLOW_COLOUR || used[mate / 64] >> mate % 64 & 1) return colour;
    return a->drawn >> 31 ? mate : colour;
}

// Counted in pairs, fours and bytes side by side (Knuth 7.1.3, (62)), both words together from the fours on: without an
// instruction for it, which not every machine has, the compiler calls a function for each word
int32_t fe__colours_of(const fe__body *body)
{
    const uint64_t pairs = UINT64_MAX / 3, fours = UINT64_MAX / 5, bytes = UINT64_MAX / 17, ones = UINT64_MAX / 255;
    uint64_t low = body->colours[0], high = body->colours[1];
    low -= low >> 1 & pairs, high -= high >> 1 & pairs;
    low = (low & fours) + (low >> 2 & fours) + (high & fours) + (high >> 2 & fours);
    return (int32_t)(((low & bytes) + (low >> 4 & bytes)) * ones >> 56);
}

void fe__colour_contact(fe__body *bodies, fe__contact *m)
{
    assert(m->colour < 0);
    fe__body *a = bodies + m->body_a, *b = bodies + m->body_b;
    int32_t both = m->kind & FE__ROW_PAIR;
    m->colour =
        both ? draw_colour(a, b)
             : first_colour(b->colours[0], b->colours[1], FE__PAIR_COLOURS, FE__PAIR_COLOURS + FE__STATIC_COLOURS);
    if (m->colour == FE__OVERFLOW_COLOUR) return;
    take_colour(b, m->colour);
    if (both) take_colour(a, m->colour);
}

static int32_t claim_colour(fe__body *body, int32_t colour)
{
    if (body->colours[colour / 64] >> colour % 64 & 1) return 0;
    take_colour(body, colour);
    return 1;
}

int32_t fe__recolour_contact(fe__body *bodies, const fe__contact *m)
{
    int32_t both = m->kind & FE__ROW_PAIR;
    if (m->colour == FE__OVERFLOW_COLOUR) return 1;
    if (both != (m->colour < FE__PAIR_COLOURS ? FE__ROW_PAIR : 0)) return 0;
    return claim_colour(bodies + m->body_b, m->colour) && (!both || claim_colour(bodies + m->body_a, m->colour));
}

void fe__uncolour_contact(fe__body *bodies, fe__contact *m)
{
    if (m->colour != FE__OVERFLOW_COLOUR) {
        return_colour(bodies + m->body_b, m->colour);
        if (m->kind & FE__ROW_PAIR) return_colour(bodies + m->body_a, m->colour);
    }
    m->colour = -1;
}

// ---- graph islands --------------------------------------------------------------------------------------------------
// Islands by union-find, batches of islands, what is in a batch.
//
// In whatever order the awake lists are: islands share no dynamic body, so that who is solved first does not show.

enum { AHEAD = 16 }; // contacts come from the whole of memory: each is fetched so many rounds before it is read, twice

static void join(int32_t *parent, int32_t a, int32_t b)
{
    int32_t x = fe__root_of(parent, a), y = fe__root_of(parent, b);
    if (x < y)
        parent[y] = x;
    else
        parent[x] = y;
}

int32_t fe__graph_is_loose(const fe__contact *m, const fe__points *q)
{
    if (!(m->kind & FE__ROW_PAIR) || m->kind & FE__ROW_SPECIAL) return 0;
    for (int k = 0; k < FE__POINTS; ++k)
        if (q->total_impulse[k] > 0.0f || (k < (int32_t)m->point_count && !(q->separation[k] > 0.0f))) return 0;
    return 1;
}

// of the i-th contact: first its own lines, then its points', which the second names
FE_FETCHES fetch_ahead(const fe__graph_input *in, int32_t i)
{
    if (i + 2 * AHEAD < in->contact_count)
        fe__fetch(in->contacts + in->awake_contacts[i + 2 * AHEAD], sizeof *in->contacts);
    if (i + AHEAD < in->contact_count)
        __builtin_prefetch(in->points + in->contacts[in->awake_contacts[i + AHEAD]].points);
}

// B is dynamic in every contact; A may be anything
static void join_contacts(fe__builder *b)
{
    const fe__graph_input *in = b->in;
    b->linked_count = 0;
    for (int32_t i = 0; i < in->contact_count; ++i) {
        int32_t contact = in->awake_contacts[i];
        const fe__contact *m = in->contacts + contact;
        fetch_ahead(in, i);
        if (m->colour < 0) continue;
        int32_t awake_a = in->bodies[m->body_a].awake_index, awake_b = in->bodies[m->body_b].awake_index;
        b->linked[b->linked_count++] = (fe__linked){contact, m->points, m->colour * FE__ROW_KINDS + m->kind,
                                                    awake_a, awake_b,   fe__graph_is_loose(m, in->points + m->points)};
        if (m->kind & FE__ROW_PAIR) join(b->parent, awake_a, awake_b);
    }
}

static const fe__joint *joint_at(const fe__builder *b, int32_t i)
{
    return b->in->joints->joints + b->in->awake_joints[i];
}

static void join_joints(fe__builder *b)
{
    const fe__body *bodies = b->in->bodies;
    for (int32_t i = 0; i < b->in->joint_count; ++i) {
        const fe__joint *j = joint_at(b, i);
        if (j->colour >= 0 && fe__sides_of(j) == (FE__MOVES_A | FE__MOVES_B))
            join(b->parent, bodies[j->body_a].awake_index, bodies[j->body_b].awake_index);
    }
}

static int32_t island_of_joint(const fe__builder *b, const fe__joint *j)
{
    return b->island_of[b->in->bodies[fe__sides_of(j) & FE__MOVES_B ? j->body_b : j->body_a].awake_index];
}

static void count_constraints(fe__builder *b)
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

static void find_islands(fe__builder *b)
{
    const fe__graph_input *in = b->in;
    for (int32_t i = 0; i < in->body_count; ++i) b->parent[i] = i;
    join_contacts(b);
    join_joints(b);
    int32_t count = 0;
    for (int32_t i = 0; i < in->body_count; ++i) {
        int32_t is_root = b->parent[i] == i; // else its parent came before it
        if (fe__is_kinematic(fe__awake_body(b, i))) {
            b->island_of[i] = b->kinematic_line[i] = FE__NONE; // no copy in any batch yet
            continue;
        }
        if (is_root) {
            b->island_contacts[count] = b->island_joints[count] = b->island_bodies[count] = b->island_pace[count] = 0;
            b->island_of[i] = count++;
        } else
            b->island_of[i] = b->island_of[b->parent[i]];
        ++b->island_bodies[b->island_of[i]];
        b->island_pace[b->island_of[i]] |=
            (int32_t)(fe__awake_body(b, i)->flags & (FE__BODY_STRAINED | FE__BODY_STRETCHED));
    }
    b->s->island_count = count;
    count_constraints(b);
}

// ---- batches --------------------------------------------------------------------------------------------------------
static fe__batch *open_batch(fe__solver *s)
{
    fe__batch *batch = s->batches + s->batch_count++;
    *batch = (fe__batch){0};
    return batch;
}

static void add_island(fe__builder *b, int32_t island)
{
    fe__batch *batch = b->s->batches + b->s->batch_count - 1;
    batch->contact_count += b->island_contacts[island];
    batch->joint_count += b->island_joints[island];
    batch->lane_count += b->island_lanes[island];
    batch->body_count += b->island_bodies[island];
    ++batch->island_count;
    b->batch_of[island] = b->s->batch_count - 1;
}

static int32_t pace_of(const fe__builder *b, int32_t island)
{
    return fe__pace_of((uint32_t)b->island_pace[island], b->island_joints[island] > 0);
}

// small islands, in order
static void batch_small(fe__builder *b, int32_t pace)
{
    fe__batch *open = NULL;
    for (int32_t i = 0; i < b->s->island_count; ++i) {
        if (b->island_lanes[i] > FE__ISLAND_LARGE || pace_of(b, i) != pace) continue;
        if (!open || open->lane_count + b->island_lanes[i] > FE__BATCH_CONTACTS ||
            open->body_count + b->island_bodies[i] > FE__BATCH_BODIES) {
            open = open_batch(b->s);
            open->pace = pace;
        }
        add_island(b, i);
    }
}

// large islands first, each a batch of its own; then those that take longest
static void make_batches(fe__builder *b)
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

static int32_t batch_of_body(const fe__builder *b, int32_t i)
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

static void sort_by_batch(fe__builder *b)
{
    const fe__graph_input *in = b->in;
    int32_t batches = b->s->batch_count;
    memset(b->body_start, 0, sizeof(int32_t) * (size_t)(batches + 1));
    memset(b->contact_start, 0, sizeof(int32_t) * (size_t)(batches + 1));
    for (int32_t i = 0; i < in->body_count; ++i) ++b->body_start[batch_of_body(b, i) + 1];
    sum_up(b->body_start, batches);
    for (int32_t i = 0; i < in->body_count; ++i) b->body_order[b->body_start[batch_of_body(b, i)]++] = i;
    unwind(b->body_start, batches);
    for (int32_t k = 0; k < batches; ++k)
        b->contact_start[k + 1] = b->contact_start[k] + b->s->batches[k].contact_count;
    for (int32_t i = 0; i < b->linked_count; ++i)
        b->contact_order[b->contact_start[batch_of_body(b, b->linked[i].awake_b)]++] = i;
    unwind(b->contact_start, batches);
    b->joint_start[0] = 0;
    for (int32_t k = 0; k < batches; ++k) b->joint_start[k + 1] = b->joint_start[k] + b->s->batches[k].joint_count;
    for (int32_t i = 0; i < in->joint_count; ++i) {
        const fe__joint *j = joint_at(b, i);
        if (j->colour >= 0) b->joint_order[b->joint_start[b->batch_of[island_of_joint(b, j)]]++] = in->awake_joints[i];
    }
    unwind(b->joint_start, batches);
}

void fe__graph_find_batches(fe__builder *b)
{
    find_islands(b);
    make_batches(b);
    sort_by_batch(b);
}

// ---- graph joints ---------------------------------------------------------------------------------------------------
// Groups of lanes for the parts of a batch's joints, and for its trees.

// ---- lanes: by part, then by colour, then by which ends move --------------------------------------------------------
static int32_t joint_key(int32_t part, const fe__joint *j)
{
    return (part * (FE__JOINT_COLOURS + 1) + j->colour) * FE__SIDES + (int32_t)fe__sides_of(j) - 1;
}

static fe__group *open_joints(fe__builder *b, fe__batch *batch, int32_t key, int32_t lanes, const fe__kernels *kernels)
{
    int32_t colour = key / FE__SIDES, part = colour / (FE__JOINT_COLOURS + 1);
    fe__group like = {.kind = FE__ROW_KINDS + part, .colour = colour, .sides = 1 + key % FE__SIDES};
    like.alone = colour % (FE__JOINT_COLOURS + 1) == FE__JOINT_OVERFLOW;
    like.width = fe__width_for(b, lanes);
    return fe__open_group(b, batch, like, lanes, fe__joint_kernels_of(kernels, like.width)->of[part].row_size);
}

static fe__lane joint_lane(const fe__builder *b, int32_t joint)
{
    const fe__joint *j = b->in->joints->joints + joint;
    return (fe__lane){joint, 0, fe__line_of(b, j->body_a), fe__line_of(b, j->body_b), 0};
}

// joints beyond the colours of a crowded body, sorted by creation: their number
static int32_t sort_overflow(fe__builder *b, int32_t k)
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

// ---- trees ----------------------------------------------------------------------------------------------------------
static int32_t link_of(const fe__builder *b, int32_t joint)
{
    const fe__forest *f = &b->in->joints->forest;
    return f->link_count ? f->link_of[joint] : FE__NONE;
}

// its joints have no rows
static int32_t is_in_rope(const fe__builder *b, int32_t joint)
{
    const fe__forest *f = &b->in->joints->forest;
    const int32_t link = link_of(b, joint);
    return link >= 0 && f->trees[f->links[link].tree].kind == FE__TREE_ROPE;
}

static void set_bodies(fe__builder *b, int32_t link, fe__lane lane)
{
    int32_t holds_b = b->in->joints->forest.links[link].holds_b;
    b->s->places[link] = (fe__tree_place){.line = holds_b ? lane.line_b : lane.line_a,
                                          .parent_line = holds_b ? lane.line_a : lane.line_b};
}

// a tree, when the first of its links comes by
static void open_tree(fe__builder *b, int32_t link)
{
    fe__solver *s = b->s;
    const fe__forest *f = &b->in->joints->forest;
    const fe__tree_link *l = f->links + link;
    int32_t first = f->trees[l->tree].first, rootless = !f->links[first].joint;
    if (link != first + rootless) return;
    if (rootless)
        s->places[first] =
            (fe__tree_place){.line = fe__line_of(b, f->links[first].body), .parent_line = FE__STATIC_LINE};
    s->trees[s->tree_count++] = (fe__tree_name){0, l->tree};
}

static const fe__joint_tree *tree_of(const fe__builder *b, fe__tree_name name)
{
    return b->of[name.home].joints.forest.trees + name.tree;
}

static int32_t are_alike(const fe__builder *b, fe__tree_name one, fe__tree_name other)
{
    return fe__trees_are_alike(&b->of[one.home].joints.forest, one.tree, &b->of[other.home].joints.forest, other.tree);
}

// those of one form one after another
static void sort_trees(const fe__builder *b, int32_t first)
{
    fe__sort_item *items = b->s->sort_items;
    fe__tree_name *trees = b->s->trees + first;
    int32_t n = b->s->tree_count - first;
    for (int32_t i = 0; i < n; ++i)
        items[i] = (fe__sort_item){tree_of(b, trees[i])->form, trees[i].tree, trees[i].home};
    fe__sort_keys(items, n, items + n);
    for (int32_t i = 0; i < n; ++i) trees[i] = (fe__tree_name){items[i].spare, items[i].value};
}

void fe__graph_group_trees(fe__builder *b, fe__batch *batch, int32_t first, const fe__kernels *kernels)
{
    fe__solver *s = b->s;
    const int32_t widest = fe__forest_kernels_of(kernels, INT32_MAX)->lanes;
    sort_trees(b, first);
    for (int32_t i = first, last; i < s->tree_count; i = last) {
        for (last = i + 1; last < s->tree_count && last - i < widest; ++last)
            if (!are_alike(b, s->trees[i], s->trees[last])) break;
        batch->row_bytes = fe__whole_blocks(batch->row_bytes);
        s->groups[s->group_count++] = (fe__group){.width = b->width,
                                                  .kind = FE__TREE_KIND,
                                                  .colour = FE__TREE_COLOUR,
                                                  .lane = i,
                                                  .rows = 1,
                                                  .trees = last - i,
                                                  .offset = batch->row_bytes};
        batch->row_bytes += fe__forest_bytes(fe__forest_kernels_of(kernels, last - i), tree_of(b, s->trees[i])->count);
        ++batch->group_count, ++batch->tree_groups;
    }
}

void fe__graph_add_lock(const fe__builder *b, int32_t place, int32_t part, int32_t group, int32_t lane,
                        const fe__kernels *kernels)
{
    const fe__group *g = b->s->groups + group;
    fe__tree_place *p = b->s->places + place;
    if (!((FE__LOCKS | 1 << FE__PART_DISTANCE) >> part & 1)) return;
    const fe__joint_kernels *width = fe__joint_kernels_of(kernels, g->width);
    p->lock[p->locks].of = &width->locks;
    p->lock[p->locks].part = part;
    p->lock[p->locks].lane = (lane - g->lane) % g->width;
    p->lock[p->locks++].row = g->offset + (int64_t)((lane - g->lane) / g->width) * width->of[part].row_size;
}

static void open_part(fe__builder *b, fe__batch *batch, int32_t part, int32_t overflowing, const fe__kernels *kernels)
{
    enum { KEYS = FE__JOINT_COLOURS * FE__SIDES };
    fe__solver *s = b->s;
    int32_t first = part * (FE__JOINT_COLOURS + 1) * FE__SIDES;
    for (int32_t key = first; (key = fe__next_key(b->joint_keys, key, first + KEYS)) < first + KEYS; ++key) {
        b->joint_key_group[key] = s->group_count;
        b->joint_key_count[key] = open_joints(b, batch, key, b->joint_key_count[key], kernels)->lane;
    }
    for (int32_t i = 0; i < overflowing; ++i) {
        int32_t joint = s->sort_items[i].value, link = link_of(b, joint);
        const fe__joint *j = b->in->joints->joints + joint;
        if (!(j->rows >> part & 1) || is_in_rope(b, joint)) continue;
        int32_t group = s->group_count, lane = open_joints(b, batch, joint_key(part, j), 1, kernels)->lane;
        s->lanes[lane] = joint_lane(b, joint);
        if (link >= 0) fe__graph_add_lock(b, link, part, group, lane, kernels);
    }
}

static void fill_joint_lanes(fe__builder *b, int32_t joint, const fe__kernels *kernels)
{
    const fe__joint *j = b->in->joints->joints + joint;
    fe__lane lane = joint_lane(b, joint);
    int32_t link = link_of(b, joint);
    if (link >= 0) set_bodies(b, link, lane), open_tree(b, link);
    if (link >= 0 && is_in_rope(b, joint)) return;
    for (int32_t part = 0; part < FE__PARTS; ++part) {
        if (!(j->rows >> part & 1)) continue;
        int32_t key = joint_key(part, j), at = b->joint_key_count[key]++;
        b->s->lanes[at] = lane;
        if (link >= 0) fe__graph_add_lock(b, link, part, b->joint_key_group[key], at, kernels);
    }
}

void fe__graph_joint_groups(fe__builder *b, int32_t k, const fe__kernels *kernels)
{
    fe__batch *batch = b->s->batches + k;
    if (!batch->joint_count) return;
    memset(b->joint_keys, 0, sizeof b->joint_keys);
    for (int32_t i = b->joint_start[k]; i < b->joint_start[k + 1]; ++i) {
        const fe__joint *j = b->in->joints->joints + b->joint_order[i];
        if (is_in_rope(b, b->joint_order[i])) continue;
        for (int32_t part = 0; part < FE__PARTS; ++part)
            if (j->rows >> part & 1) fe__count_key(b->joint_keys, b->joint_key_count, joint_key(part, j), 1);
    }
    int32_t overflowing = sort_overflow(b, k), first_tree = b->s->tree_count;
    for (int32_t i = 0; i < overflowing; ++i) {
        int32_t joint = b->s->sort_items[i].value, link = link_of(b, joint);
        if (link >= 0) set_bodies(b, link, joint_lane(b, joint));
    }
    for (int32_t part = 0; part < FE__PARTS; ++part) open_part(b, batch, part, overflowing, kernels);
    for (int32_t i = 0; i < overflowing; ++i) {
        int32_t link = link_of(b, b->s->sort_items[i].value);
        if (link >= 0) open_tree(b, link);
    }
    for (int32_t i = b->joint_start[k]; i < b->joint_start[k + 1]; ++i) {
        const fe__joint *j = b->in->joints->joints + b->joint_order[i];
        if (j->colour != FE__JOINT_OVERFLOW) fill_joint_lanes(b, b->joint_order[i], kernels);
    }
    if (b->s->tree_count > first_tree) fe__graph_group_trees(b, batch, first_tree, kernels);
    batch->joint_groups = batch->group_count;
}
