// graph_capacity.c - what a graph may need at most, reserved before it is built: lines, groups, lanes, rows, the
// scratch of the build.
#include "solver/graph/graph.h"


static int32_t joint_rows(const fe__graph_bound *b)
{
    return b->joint_set
               ? (int32_t)fe__minl(b->joint_set->rows, (int64_t)b->joints * __builtin_popcount(b->joint_set->row_kinds))
               : 0;
}

static int32_t overflowing_rows(const fe__graph_bound *b)
{
    if (!b->joint_set) return 0;
    return (int32_t)fe__minl(joint_rows(b),
                             (int64_t)b->joint_set->overflowing * __builtin_popcount(b->joint_set->row_kinds));
}

static int32_t batch_bound(const fe__graph_bound *b)
{
    // two neighbouring small batches together exceed a limit; large islands exceed theirs, which is that of two pairs;
    // one of each pace stays open, and one is for kinematic bodies
    _Static_assert((int)FE__ISLAND_LARGE >= (int)FE__BATCH_CONTACTS, "an island alone takes what two batches do");
    int32_t lanes = b->contacts + joint_rows(b);
    return 2 * (lanes / FE__BATCH_CONTACTS + b->bodies / FE__BATCH_BODIES) + FE__PACES + 1;
}

// Distinct groups of one batch, by the colours and kinds that there are
static int32_t known_groups(const fe__graph_bound *b)
{
    const uint32_t pairs = 0xAA; // kinds with FE__ROW_PAIR
    return b->pair_colours * __builtin_popcount(b->kinds & pairs) +
           b->static_colours * __builtin_popcount(b->kinds & ~pairs);
}

// Those that the last graph did not have
static int64_t fresh_groups(const fe__graph_bound *b) { return fe__mini(b->fresh, known_groups(b)); }

static int64_t group_bound(const fe__solver *s, const fe__graph_bound *b)
{
    int64_t groups = fresh_groups(b);
    for (int32_t kind = 0; kind < FE__ROW_KINDS; ++kind) groups += s->built.colours[kind];
    return fe__minl(groups, known_groups(b));
}

static int32_t overflow_bound(const fe__solver *s, const fe__graph_bound *b)
{
    return (int32_t)fe__minl((int64_t)s->built.overflow + b->crowded, b->contacts);
}

static int32_t joint_group_bound(const fe__graph_bound *b)
{
    if (!b->joint_set) return 0;
    return fe__mini(2 * b->joint_set->most, FE__JOINT_COLOURS) * __builtin_popcount(b->joint_set->row_kinds) *
           FE__SIDES;
}

static int64_t widest_joint(const fe__graph_bound *b, const fe__joint_kernels *kernels)
{
    int32_t widest = 0;
    for (int32_t part = 0; b->joint_set && part < FE__PARTS; ++part)
        if (b->joint_set->row_kinds >> part & 1) widest = fe__maxi(widest, kernels->of[part].row_size);
    return widest;
}

static int32_t tree_links(const fe__graph_bound *b) { return b->joint_set ? b->joint_set->forest.link_count : 0; }

static int64_t thin_row(const fe__kernels *kernels, int32_t kind)
{
    return fe__whole_blocks(kernels->thin_contact->row_size[kind]);
}

// Rows of so many contacts in so many groups, each of which may leave W - 1 lanes of a row empty
static int64_t wide_rows(const fe__kernels *kernels, int64_t contacts, int64_t groups)
{
    return (contacts + (kernels->width - 1) * groups) / kernels->width;
}

static int64_t wide_row(const fe__kernels *kernels, int32_t kind)
{
    return fe__maxl(kernels->contact->row_size[kind], thin_row(kernels, kind));
}

static int32_t widest_kind(const fe__graph_bound *b)
{
    return b->special ? FE__ROW_PAIR | FE__ROW_SPECIAL : FE__ROW_PAIR;
}

// Of all contacts in one batch. None takes more than a thin row, for a group of so few has one. What has no colour
// takes a thin row whole: as many as may be are the worst
static int64_t all_contact_bytes(const fe__solver *s, const fe__graph_bound *b, const fe__kernels *kernels)
{
    int32_t widest = widest_kind(b), round_up = kernels->width - 1; // fresh ones join groups that there are, too
    int32_t coloured = b->fresh - b->crowded;
    int64_t wide = wide_rows(kernels, (int64_t)coloured + round_up, fresh_groups(b)) * wide_row(kernels, widest),
            thin = coloured * thin_row(kernels, widest);
    for (int32_t kind = 0; kind < FE__ROW_KINDS; ++kind) {
        wide += wide_rows(kernels, s->built.contacts[kind], s->built.colours[kind]) * wide_row(kernels, kind);
        thin += s->built.contacts[kind] * thin_row(kernels, kind);
    }
    return fe__minl(wide, thin) + overflow_bound(s, b) * thin_row(kernels, widest);
}

// of a batch of so many
static int64_t contact_bytes(const fe__solver *s, const fe__graph_bound *b, const fe__kernels *kernels,
                             int32_t contacts)
{
    int32_t widest = widest_kind(b), overflow = fe__mini(overflow_bound(s, b), contacts);
    int64_t coloured = contacts - overflow,
            wide = wide_rows(kernels, coloured + kernels->width - 1, group_bound(s, b)) * wide_row(kernels, widest),
            thin = coloured * thin_row(kernels, widest);
    return fe__minl(fe__minl(wide, thin) + overflow * thin_row(kernels, widest), all_contact_bytes(s, b, kernels));
}

// Of so many parts of joints in one batch. As of contacts, none takes more than a thin row
static int64_t joint_bytes(const fe__graph_bound *b, const fe__kernels *kernels, int32_t lanes)
{
    int64_t thin = fe__whole_blocks(widest_joint(b, kernels->thin_joint)),
            wide = fe__maxl(widest_joint(b, kernels->joint), thin), groups = fe__mini(joint_group_bound(b), lanes),
            overflow = fe__mini(overflowing_rows(b), lanes);
    return fe__minl((lanes / kernels->width + groups) * wide + overflow * thin, lanes * thin);
}

// bytes of rows of so many contacts and parts of joints; each body is in one tree at most
static int64_t row_bytes(const fe__solver *s, const fe__graph_bound *b, const fe__kernels *kernels, int32_t contacts,
                         int32_t joint_lanes, int64_t bodies)
{
    int64_t links = fe__minl(tree_links(b), bodies);
    return contact_bytes(s, b, kernels, contacts) + joint_bytes(b, kernels, joint_lanes) +
           links * (fe__forest_bytes(fe__forest_kernels_of(kernels, INT32_MAX), 1) + (int64_t)sizeof(fe__row_block));
}

static int64_t scratch_bound(const fe__graph_bound *b)
{
    return 11 * (int64_t)b->bodies + (FE__LINKED_INTS + 1) * (int64_t)b->contacts + b->joints +
           3 * (batch_bound(b) + 1) + FE__GROUP_KEYS + 2 * FE__JOINT_GROUP_KEYS;
}

// bytes of rows of the largest island, and of a worker's stretch
static int64_t all_rows(const fe__solver *s, const fe__graph_bound *b, const fe__kernels *kernels, int32_t workers,
                        int64_t *out_small)
{
    // a batch is one small island, or several of FE__BATCH_CONTACTS together
    int32_t some = fe__maxi(FE__BATCH_CONTACTS, FE__ISLAND_LARGE), parts = joint_rows(b);
    // an island has a body more than constraints, at most
    int64_t small = row_bytes(s, b, kernels, fe__mini(b->contacts, some), fe__mini(parts, some),
                              fe__maxi(FE__BATCH_BODIES, FE__ISLAND_LARGE + 1));
    int64_t large = b->largest > FE__ISLAND_LARGE ? row_bytes(s, b, kernels, fe__mini(b->contacts, b->largest),
                                                              fe__mini(parts, b->largest), (int64_t)b->largest + 1)
                                                  : 0;
    small = fe__whole_blocks(small); // stretches begin at one
    *out_small = small;
    return small * workers > large ? small * workers : large;
}

// Passes of a large batch, see make_program in solve.c. Its groups come colour by colour, a group or more each, and
// each of the four verbs of rows (prepare, solve, relax, bounce; joints do not bounce) has a pass a colour at most.
// Four more are over lines, one stores, one passes impacts on, and three are the trees'.
static int64_t pass_bound(int64_t groups)
{
    enum { EVERY_COLOUR = 4 * FE__COLOURS + 3 * FE__CONTACT_COLOURS, OTHERS = 9 };
    return fe__minl(4 * groups, EVERY_COLOUR) + OTHERS;
}

int32_t fe__graph_has_rows(const fe__solver *s, const fe__kernels *kernels, const fe__graph_bound *bound,
                           int32_t workers)
{
    int64_t small;
    return all_rows(s, bound, kernels, workers, &small) < (int64_t)sizeof(fe__row_block) * s->row_capacity;
}

int32_t fe__graph_reserve(fe__solver *s, fe__memory *memory, const fe__kernels *kernels, const fe__graph_bound *b,
                          int32_t workers)
{
    int32_t batches = batch_bound(b), width = kernels->width, parts = joint_rows(b);
    int64_t contact_groups = fe__minl(group_bound(s, b) * batches, b->contacts) + overflow_bound(s, b);
    int64_t joint_groups = fe__minl((int64_t)joint_group_bound(b) * batches, parts) + overflowing_rows(b);
    int64_t groups = contact_groups + joint_groups + tree_links(b);
    int64_t lanes = fe__minl(b->contacts + (width - 1) * contact_groups, (int64_t)FE__THIN_WIDTH * b->contacts) +
                    fe__minl(parts + (width - 1) * joint_groups, (int64_t)FE__THIN_WIDTH * parts);
    // a batch has one copy of each kinematic body, which a contact or a joint of it brings
    int64_t copies = fe__minl((int64_t)b->kinematic * batches,
                              (b->special ? b->contacts : 0) + (b->joint_set ? b->joint_set->kinematic : 0));
    int64_t lines = FE__MAX_WIDTH + (int64_t)b->bodies + (int64_t)batches * (FE__DUMMY_LINES + FE__MAX_WIDTH) + copies;
    int64_t small, rows = all_rows(s, b, kernels, workers, &small);
    int64_t building = (int64_t)sizeof(int32_t) * scratch_bound(b);
    int32_t trees = b->joint_set ? b->joint_set->forest.tree_count : 0;
    int64_t sorted = fe__maxi(fe__maxi(overflow_bound(s, b), trees),
                              b->joint_set ? fe__mini(b->joint_set->overflowing, b->joints) : 0);
    // trails lie behind the rows: bodies are fast before they touch, and rows are many when they rest
    const int64_t trail = sizeof *s->trail, block = sizeof(fe__row_block);
    int64_t in_front = fe__whole_blocks(fe__maxl(rows, building)),
            behind = (b->fast + (b->fast_kinematic ? copies : 0)) * trail;
    int64_t before = memory->allocations;
    int32_t done = FE_RESERVE(memory, s->velocity, s->line_capacity[0], lines) &&
                   FE_RESERVE(memory, s->motion, s->line_capacity[1], lines) &&
                   FE_RESERVE(memory, s->start, s->line_capacity[2], lines) &&
                   FE_RESERVE(memory, s->inertia, s->line_capacity[3], lines) &&
                   FE_RESERVE(memory, s->drive, s->line_capacity[4], lines) &&
                   FE_RESERVE(memory, s->axes, s->line_capacity[5], lines) &&
                   FE_RESERVE(memory, s->moved_spin, s->line_capacity[6], b->joints ? lines : 0) &&
                   FE_RENEW(memory, s->body_of_line, s->body_of_line_capacity, lines) &&
                   FE_RENEW(memory, s->trail_count, s->trail_capacity[0], lines) &&
                   FE_RENEW(memory, s->trail_of, s->trail_capacity[1], lines) &&
                   FE_RENEW(memory, s->touches_of, s->touch_capacity[0], b->special ? lines : 0) &&
                   FE_RENEW(memory, s->touch_of, s->touch_capacity[1], b->special ? lines : 0) &&
                   FE_RENEW(memory, s->touches, s->touch_capacity[2], b->special ? lanes + width : 0) &&
                   FE_RENEW(memory, s->batches, s->batch_capacity, batches) &&
                   FE_RENEW(memory, s->groups, s->group_capacity, groups + 1) &&
                   FE_RENEW(memory, s->lanes, s->lane_capacity, lanes + width) &&
                   FE_RENEW(memory, s->places, s->place_capacity, tree_links(b)) &&
                   FE_RENEW(memory, s->trees, s->tree_capacity, trees) &&
                   FE_RENEW(memory, s->passes, s->pass_capacity, pass_bound(groups)) &&
                   FE_RENEW(memory, s->sort_items, s->sort_capacity, 2 * sorted) &&
                   FE_RENEW(memory, s->rows, s->row_capacity, (in_front + behind) / block + 1);
    s->graph_changed |= memory->allocations != before; // what has grown holds no graph
    if (done) s->worker_row_bytes = fe__whole_blocks(small);
    if (done) s->trail = (fe__motion_line(*)[FE__TRAIL])(void *)(s->rows + in_front / block);
    return done;
}

void fe__solver_destroy(fe__solver *s, fe__memory *memory)
{
    FE_FREE(memory, s->velocity, s->line_capacity[0]);
    FE_FREE(memory, s->motion, s->line_capacity[1]);
    FE_FREE(memory, s->start, s->line_capacity[2]);
    FE_FREE(memory, s->inertia, s->line_capacity[3]);
    FE_FREE(memory, s->drive, s->line_capacity[4]);
    FE_FREE(memory, s->axes, s->line_capacity[5]);
    FE_FREE(memory, s->moved_spin, s->line_capacity[6]);
    FE_FREE(memory, s->body_of_line, s->body_of_line_capacity);
    FE_FREE(memory, s->trail_count, s->trail_capacity[0]);
    FE_FREE(memory, s->trail_of, s->trail_capacity[1]);
    s->trail = NULL;
    FE_FREE(memory, s->touches_of, s->touch_capacity[0]);
    FE_FREE(memory, s->touch_of, s->touch_capacity[1]);
    FE_FREE(memory, s->touches, s->touch_capacity[2]);
    FE_FREE(memory, s->batches, s->batch_capacity);
    FE_FREE(memory, s->groups, s->group_capacity);
    FE_FREE(memory, s->lanes, s->lane_capacity);
    FE_FREE(memory, s->places, s->place_capacity);
    FE_FREE(memory, s->trees, s->tree_capacity);
    FE_FREE(memory, s->passes, s->pass_capacity);
    FE_FREE(memory, s->sort_items, s->sort_capacity);
    FE_FREE(memory, s->rows, s->row_capacity);
    fe__graph_forget(s);
}

#define TRADE(a, b)              \
    do {                         \
        __typeof__(a) kept_ = a; \
        (a) = b, (b) = kept_;    \
    } while (0)

void fe__solver_trade_lines(fe__solver *s, fe__solver *t)
{
    TRADE(s->velocity, t->velocity);
    TRADE(s->motion, t->motion);
    TRADE(s->start, t->start);
    TRADE(s->inertia, t->inertia);
    TRADE(s->drive, t->drive);
    TRADE(s->axes, t->axes);
    TRADE(s->moved_spin, t->moved_spin);
    for (int k = 0; k < 7; ++k) TRADE(s->line_capacity[k], t->line_capacity[k]);
    TRADE(s->trail_count, t->trail_count);
    TRADE(s->trail_of, t->trail_of);
    TRADE(s->touches_of, t->touches_of);
    TRADE(s->touch_of, t->touch_of);
    TRADE(s->touches, t->touches);
    for (int k = 0; k < 2; ++k) TRADE(s->trail_capacity[k], t->trail_capacity[k]);
    for (int k = 0; k < 3; ++k) TRADE(s->touch_capacity[k], t->touch_capacity[k]);
    TRADE(s->passes, t->passes);
    TRADE(s->pass_capacity, t->pass_capacity);
    TRADE(s->sort_items, t->sort_items);
    TRADE(s->sort_capacity, t->sort_capacity);
    TRADE(s->rows, t->rows);
    TRADE(s->row_capacity, t->row_capacity);
}

void fe__graph_forget(fe__solver *s)
{
    s->batch_count = s->large_count = s->group_count = s->lane_count = s->line_count = s->island_count = 0;
    s->built = (fe__built){.overflow = 0};
    s->graph_changed = 1;
}
