// graph_merge.c - see graph_merge.h. For each pace one batch: lines first, then groups of joints, trees, contacts.
#include "solver/graph/graph_merge.h"

#include "solver/graph/graph.h"

#include <string.h>

typedef struct merger {
    fe__merge *m;
    fe__builder b; // the solver, its width, the forests
    const fe__kernels *kernels;
    int32_t pace;
    uint64_t keys[FE__KEY_WORDS(FE__MERGE_KEYS)]; // of the batch at hand
} merger;

// ---- what may be merged --------------------------------------------------------------------------------------------
int32_t fe__graph_can_merge(const fe__solver *part)
{
    if (part->large_count || !part->batch_count) return 0;
    for (const fe__group *g = part->groups, *end = g + part->group_count; g < end; ++g)
        if (g->alone) return 0;
    return 1;
}

// ---- room ----------------------------------------------------------------------------------------------------------
// of bodies, at most
static int64_t body_lines(const fe__solver *part)
{
    return part->line_count - FE__MAX_WIDTH - (int64_t)part->batch_count * FE__DUMMY_LINES;
}

static int32_t reserve(fe__merge *m, fe__memory *memory, const fe__kernels *kernels)
{
    fe__solver *s = &m->solver;
    int64_t lines = FE__MAX_WIDTH + FE__PACES * (FE__DUMMY_LINES + FE__MAX_WIDTH), lanes = kernels->width, groups = 1,
            trees = 0, places = 0, of_parts = 0, bounces = 0, joints = 0;
    for (int32_t i = 0; i < m->count; ++i) {
        const fe__solver *part = m->part[i];
        m->first_line[i] = (int32_t)of_parts;
        m->of[i].first_place = (int32_t)places;
        lanes += part->lane_count + (int64_t)kernels->width * part->group_count;
        groups += part->group_count, trees += part->tree_count, of_parts += part->line_count;
        lines += body_lines(part);
        for (int32_t k = 0; k < part->batch_count; ++k)
            joints |= part->batches[k].joint_count, bounces |= part->batches[k].bounces;
        places += m->of[i].joints.forest.link_count;
    }
    return FE_RESERVE(memory, s->velocity, s->line_capacity[0], lines) &&
           FE_RESERVE(memory, s->motion, s->line_capacity[1], lines) &&
           FE_RESERVE(memory, s->start, s->line_capacity[2], lines) &&
           FE_RESERVE(memory, s->inertia, s->line_capacity[3], lines) &&
           FE_RESERVE(memory, s->drive, s->line_capacity[4], lines) &&
           FE_RESERVE(memory, s->axes, s->line_capacity[5], lines) &&
           FE_RESERVE(memory, s->moved_spin, s->line_capacity[6], joints ? lines : 0) &&
           FE_RENEW(memory, s->body_of_line, s->body_of_line_capacity, lines) &&
           FE_RENEW(memory, s->trail_count, s->trail_capacity[0], lines) &&
           FE_RENEW(memory, s->trail_of, s->trail_capacity[1], lines) &&
           FE_RENEW(memory, s->touches_of, s->touch_capacity[0], bounces ? lines : 0) &&
           FE_RENEW(memory, s->touch_of, s->touch_capacity[1], bounces ? lines : 0) &&
           FE_RENEW(memory, s->touches, s->touch_capacity[2], bounces ? lanes : 0) &&
           FE_RENEW(memory, s->batches, s->batch_capacity, FE__PACES) &&
           FE_RENEW(memory, s->groups, s->group_capacity, groups) &&
           FE_RENEW(memory, s->lanes, s->lane_capacity, lanes) &&
           FE_RENEW(memory, s->places, s->place_capacity, places) &&
           FE_RENEW(memory, s->trees, s->tree_capacity, trees) &&
           FE_RENEW(memory, s->sort_items, s->sort_capacity, 2 * trees) &&
           FE_RENEW(memory, m->line, m->line_capacity, of_parts);
}

// Rows of the largest batch, and behind them a trail for each line
static int32_t reserve_rows(fe__solver *s, fe__memory *memory)
{
    const int64_t block = sizeof(fe__row_block);
    int64_t most = 0;
    for (int32_t k = 0; k < s->batch_count; ++k) most = fe__maxl(most, s->batches[k].row_bytes);
    most = fe__whole_blocks(most);
    int64_t blocks = (most + s->line_count * (int64_t)sizeof *s->trail) / block + 1;
    if (!FE_RENEW(memory, s->rows, s->row_capacity, blocks)) return 0;
    s->worker_row_bytes = most;
    s->trail = (fe__motion_line(*)[FE__TRAIL])(void *)(s->rows + most / block);
    return 1;
}

// ---- lines ---------------------------------------------------------------------------------------------------------
static void add_line(fe__solver *s, int32_t part, int32_t body)
{
    s->body_of_line[s->line_count++] = (fe__body_name){part, body};
}

static void add_lines(fe__merge *m, int32_t part, const fe__batch *from)
{
    const fe__solver *p = m->part[part];
    int32_t *line = m->line + m->first_line[part];
    line[FE__STATIC_LINE] = FE__STATIC_LINE;
    for (int32_t i = from->first_line; i < from->first_line + from->line_count; ++i) {
        if (p->body_of_line[i].body < 0) continue;
        line[i] = m->solver.line_count;
        add_line(&m->solver, part, p->body_of_line[i].body);
    }
}

// ---- groups --------------------------------------------------------------------------------------------------------
// In the order in which a batch has its groups: joints' by part, colour and sides, contacts' by colour and kind
static int32_t key_of(const fe__group *g)
{
    if (g->kind >= FE__ROW_KINDS) return g->colour * FE__SIDES + g->sides - 1;
    return FE__JOINT_GROUP_KEYS + (g->colour - FE__CONTACT_COLOURS) * FE__ROW_KINDS + g->kind;
}

// Those without padding, which is at the end
static int32_t lanes_of(const fe__solver *s, const fe__group *g)
{
    int32_t lanes = g->rows * g->width;
    while (!s->lanes[g->lane + lanes - 1].contact) --lanes;
    return lanes;
}

static void count_lanes(merger *g, const fe__solver *part, const fe__batch *from)
{
    for (int32_t i = from->first_group; i < from->first_group + from->group_count; ++i) {
        const fe__group *group = part->groups + i;
        if (group->kind == FE__TREE_KIND) continue;
        fe__count_key(g->keys, g->m->lane_of_key, key_of(group), lanes_of(part, group));
    }
}

static fe__group group_like(int32_t key)
{
    int32_t contact = key - FE__JOINT_GROUP_KEYS;
    if (contact >= 0)
        return (fe__group){.kind = contact % FE__ROW_KINDS, .colour = FE__CONTACT_COLOURS + contact / FE__ROW_KINDS};
    return (fe__group){.kind = FE__ROW_KINDS + key / (FE__SIDES * (FE__JOINT_COLOURS + 1)),
                       .colour = key / FE__SIDES,
                       .sides = 1 + key % FE__SIDES};
}

static void open_key(merger *g, fe__batch *batch, int32_t key)
{
    fe__group like = group_like(key);
    int32_t lanes = g->m->lane_of_key[key];
    like.width = fe__width_for(&g->b, lanes);
    int32_t row_size = like.kind < FE__ROW_KINDS
                           ? fe__contact_kernels_of(g->kernels, like.width)->row_size[like.kind]
                           : fe__joint_kernels_of(g->kernels, like.width)->of[like.kind - FE__ROW_KINDS].row_size;
    g->m->group_of_key[key] = g->m->solver.group_count;
    g->m->lane_of_key[key] = fe__open_group(&g->b, batch, like, lanes, row_size)->lane;
}

static void open_keys(merger *g, fe__batch *batch, int32_t first, int32_t end)
{
    for (int32_t key = first; (key = fe__next_key(g->keys, key, end)) < end; ++key) open_key(g, batch, key);
}

// ---- lanes ---------------------------------------------------------------------------------------------------------
static void add_lane(merger *g, int32_t part, int32_t key, const fe__lane *l)
{
    fe__merge *m = g->m;
    const int32_t *line = m->line + m->first_line[part];
    const fe__forest *f = &m->of[part].joints.forest;
    int32_t at = m->lane_of_key[key]++;
    m->solver.lanes[at] = (fe__lane){l->contact, l->points, line[l->line_a], line[l->line_b], part};
    if (key >= FE__JOINT_GROUP_KEYS || !f->link_count || f->link_of[l->contact] < 0) return;
    fe__graph_add_lock(&g->b, m->of[part].first_place + f->link_of[l->contact],
                       key / (FE__SIDES * (FE__JOINT_COLOURS + 1)), m->group_of_key[key], at, g->kernels);
}

// Of each group loose contacts come last: rows of idle ones alone are skipped (contact/idle.inl)
static void fill_lanes(merger *g, int32_t part, const fe__batch *from, int32_t loose)
{
    const fe__solver *p = g->m->part[part];
    const fe__records *of = g->m->of + part;
    for (int32_t i = from->first_group; i < from->first_group + from->group_count; ++i) {
        const fe__group *group = p->groups + i;
        if (group->kind == FE__TREE_KIND || (group->kind >= FE__ROW_KINDS && loose)) continue;
        int32_t key = key_of(group);
        for (const fe__lane *l = p->lanes + group->lane, *end = l + lanes_of(p, group); l < end; ++l)
            if (group->kind >= FE__ROW_KINDS ||
                fe__graph_is_loose(of->contacts + l->contact, of->points + l->points) == loose)
                add_lane(g, part, key, l);
    }
}

// ---- trees ---------------------------------------------------------------------------------------------------------
static void add_tree(merger *g, int32_t part, int32_t tree)
{
    fe__merge *m = g->m;
    const fe__solver *p = m->part[part];
    const fe__joint_tree *t = m->of[part].joints.forest.trees + tree;
    const int32_t *line = m->line + m->first_line[part];
    fe__tree_place *to = m->solver.places + m->of[part].first_place;
    for (int32_t i = t->first; i < t->first + t->count; ++i)
        to[i] = (fe__tree_place){.line = line[p->places[i].line], .parent_line = line[p->places[i].parent_line]};
    m->solver.trees[m->solver.tree_count++] = (fe__tree_name){part, tree};
}

static void add_trees(merger *g, int32_t part, const fe__batch *from)
{
    const fe__solver *p = g->m->part[part];
    for (int32_t i = from->first_group; i < from->first_group + from->group_count; ++i) {
        const fe__group *group = p->groups + i;
        for (int32_t k = 0; group->kind == FE__TREE_KIND && k < group->trees; ++k)
            add_tree(g, part, p->trees[group->lane + k].tree);
    }
}

// ---- a batch -------------------------------------------------------------------------------------------------------
// Each batch of each part that has the pace
typedef void visitor(merger *g, fe__batch *batch, int32_t part, const fe__batch *from);

static void visit(merger *g, fe__batch *batch, visitor *v)
{
    for (int32_t part = 0; part < g->m->count; ++part) {
        const fe__solver *p = g->m->part[part];
        for (const fe__batch *from = p->batches, *end = from + p->batch_count; from < end; ++from)
            if (from->pace == g->pace) v(g, batch, part, from);
    }
}

static void begin_part(merger *g, fe__batch *batch, int32_t part, const fe__batch *from)
{
    add_lines(g->m, part, from);
    count_lanes(g, g->m->part[part], from);
    batch->contact_count += from->contact_count, batch->joint_count += from->joint_count;
    batch->body_count += from->body_count, batch->island_count += from->island_count;
    batch->lane_count += from->lane_count, batch->bounces |= from->bounces;
}

static void add_trees_of(merger *g, fe__batch *batch, int32_t part, const fe__batch *from)
{
    (void)batch;
    if (from->tree_groups) add_trees(g, part, from);
}

static void fill_firm(merger *g, fe__batch *batch, int32_t part, const fe__batch *from)
{
    (void)batch;
    fill_lanes(g, part, from, 0);
}

static void fill_loose(merger *g, fe__batch *batch, int32_t part, const fe__batch *from)
{
    (void)batch;
    fill_lanes(g, part, from, 1);
}

static void merge_pace(merger *g)
{
    fe__solver *s = &g->m->solver;
    fe__batch *batch = s->batches + s->batch_count;
    *batch = (fe__batch){.first_line = s->line_count, .first_group = s->group_count, .pace = g->pace};
    memset(g->keys, 0, sizeof g->keys);
    for (int32_t i = 0; i < FE__DUMMY_LINES; ++i) add_line(s, 0, FE__NONE);
    visit(g, batch, begin_part);
    if (s->line_count == batch->first_line + FE__DUMMY_LINES) {
        s->line_count = batch->first_line;
        return;
    }
    while (s->line_count % FE__MAX_WIDTH) add_line(s, 0, FE__NONE);
    batch->line_count = s->line_count - batch->first_line;
    int32_t first_tree = s->tree_count;
    open_keys(g, batch, 0, FE__JOINT_GROUP_KEYS);
    visit(g, batch, add_trees_of);
    if (s->tree_count > first_tree) fe__graph_group_trees(&g->b, batch, first_tree, g->kernels);
    batch->joint_groups = batch->group_count;
    open_keys(g, batch, FE__JOINT_GROUP_KEYS, FE__MERGE_KEYS);
    visit(g, batch, fill_firm);
    visit(g, batch, fill_loose);
    ++s->batch_count;
}

int32_t fe__graph_merge(fe__merge *m, fe__memory *memory, const fe__kernels *kernels)
{
    fe__solver *s = &m->solver;
    if (!reserve(m, memory, kernels)) return 0;
    merger g = {.m = m, .b = {.s = s, .of = m->of, .width = kernels->width}, .kernels = kernels};
    s->batch_count = s->large_count = s->group_count = s->lane_count = s->line_count = s->tree_count = 0;
    for (int32_t i = 0; i < FE__MAX_WIDTH; ++i) add_line(s, 0, FE__NONE); // FE__STATIC_LINE and its block
    for (g.pace = FE__USUAL; g.pace < FE__PACES; ++g.pace) merge_pace(&g);
    return reserve_rows(s, memory);
}

// ---- back to the parts ---------------------------------------------------------------------------------------------
static void return_trail(const fe__solver *s, int32_t from, fe__solver *part, int32_t line)
{
    part->trail_count[line] = s->trail_count[from];
    if (s->trail_count[from] == FE__NO_TRAIL) return;
    int32_t trail = part->trail_of[line] = atomic_fetch_add_explicit(&part->trails, 1, memory_order_relaxed);
    memcpy(part->trail[trail], s->trail[s->trail_of[from]], sizeof *part->trail);
}

void fe__graph_return(const fe__merge *m, int32_t number)
{
    const fe__solver *s = &m->solver;
    fe__solver *part = m->part[number];
    const int32_t *line = m->line + m->first_line[number];
    int32_t strained = 0;
    atomic_store(&part->trails, 0);
    for (int32_t i = FE__MAX_WIDTH; i < part->line_count; ++i) {
        if (part->body_of_line[i].body < 0) continue;
        part->velocity[i] = s->velocity[line[i]];
        part->motion[i] = s->motion[line[i]];
        part->inertia[i].mark = s->inertia[line[i]].mark;
        strained |= part->inertia[i].mark != 0.0f;
        if (part->motion[i].gyroscopic == (float)FE__GYROSCOPIC_JOINED)
            memcpy(part->moved_spin[i], s->moved_spin[line[i]], sizeof *part->moved_spin);
        return_trail(s, line[i], part, i);
    }
    atomic_store(&part->strained, strained);
    atomic_store(&part->mixed, 0);
}

void fe__graph_free_merge(fe__merge *m, fe__memory *memory)
{
    fe__solver_destroy(&m->solver, memory);
    FE_FREE(memory, m->line, m->line_capacity);
}
