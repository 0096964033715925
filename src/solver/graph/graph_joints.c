// graph_joints.c - groups of lanes for the parts of a batch's joints, and for its trees.
#include "solver/graph/graph_build.h"

#include "core/array_sort.h"

#include <string.h>

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
