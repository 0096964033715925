// tree.c - the tree's memory, and what a single proxy's box is.
//
// tree.c and tree.c change it; tree_build.c builds it; tree_query.simd.c and tree_ray.simd.c ask.
#include "broadphase/tree.h"

#include "broadphase/tree_node.h"

// ---- tree -----------------------------------------------------------------------------------------------------------

#define DECLARE(simd, name) extern const fe__tree_kernels fe__tree_kernels_##name;
FE_EACH_WIDE_SET(DECLARE)

const fe__tree_kernels *fe__tree_kernels_of(int32_t simd)
{
    switch (simd) {
#define CASE(set, name) \
    case set:           \
        return &fe__tree_kernels_##name;
        FE_EACH_WIDE_SET(CASE)
    default:
        return &FE_BASE_SET(fe__tree_kernels);
    }
}

void fe__tree_destroy(fe__tree *tree, fe__memory *memory)
{
    FE_FREE(memory, tree->nodes, tree->node_capacity);
    FE_FREE(memory, tree->slot, tree->slot_capacity);
    *tree = (fe__tree){0};
}

// Closes the gaps that dead nodes left, without any memory.
static void compact(fe__tree *tree)
{
    int32_t count = 0;
    for (int32_t i = 0; i < tree->node_count; ++i) {
        fe__tree_node *node = &tree->nodes[i];
        if (i > 0 && node->parent < 0) continue;
        int32_t to = count++;
        if (to == i) continue;
        tree->nodes[to] = *node;
        tree->nodes[node->parent].child[node->lane] = to;
        for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane)
            if (node->child[lane] != FE_TREE_EMPTY)
                fe__tree_hang(tree, to, lane, fe__lane_box(node, lane), node->child[lane]);
    }
    tree->node_count = count;
    tree->dead = 0;
}

int32_t fe__tree_reserve(fe__tree *tree, fe__memory *memory, int32_t limit, int32_t extra)
{
    int32_t known = tree->slot_capacity;
    if (!FE_RESERVE(memory, tree->slot, tree->slot_capacity, limit)) return 0;
    for (int32_t i = known; i < tree->slot_capacity; ++i) tree->slot[i] = -1;

    int64_t more = fe__tree_room(extra, tree->node_count);
    // A quarter is worth a pass; less is not, or pairs of insertion and removal could ask for one each time.
    if (tree->node_count + more > tree->node_capacity && tree->dead > tree->node_count / 4) compact(tree);
    if (!FE_RESERVE(memory, tree->nodes, tree->node_capacity, tree->node_count + more)) return 0;
    tree->promised = fe__maxi(tree->promised, extra);
    return 1;
}

FE_LANES_INLINE fe__tree_box box_of(const fe__tree *tree, int32_t proxy)
{
    uint32_t slot = (uint32_t)tree->slot[proxy];
    return fe__lane_box(&tree->nodes[slot / FE_TREE_WIDTH], (int32_t)(slot % FE_TREE_WIDTH));
}

int32_t fe__tree_holds(const fe__tree *tree, int32_t proxy, const fe__bounds *tight)
{
    fe__tree_box fat = box_of(tree, proxy);
    fe__tree_box box = fe__tree_box_of(&tree->origin, tight);
    fe__quad_int in = (fat.low <= box.low) & (box.high <= fat.high); // the fourth lane is 0 in all
    return fe__quad_signs(in) == 15u;
}

int32_t fe__tree_parts(const fe__tree *tree, int32_t proxy, int32_t other)
{
    fe__tree_box a = box_of(tree, proxy), b = box_of(tree, other);
    fe__quad_int meets = (a.low <= b.high) & (b.low <= a.high); // the fourth lane is 0 in all
    return fe__quad_signs(meets) != 15u;
}

// The sum of origin and offset rounds, too: one unit in the last place to the side of `sign`.
static fe_dvec3 outwards(fe_dvec3 p, double sign)
{
    double k = sign * DBL_EPSILON;
    return (fe_dvec3){p.x + k * fe__absd(p.x), p.y + k * fe__absd(p.y), p.z + k * fe__absd(p.z)};
}

void fe__tree_get(const fe__tree *tree, int32_t proxy, fe__bounds *out_box)
{
    fe__tree_box box = box_of(tree, proxy);
    fe_dvec3 low = {(double)box.low[0], (double)box.low[1], (double)box.low[2]};
    fe_dvec3 high = {(double)box.high[0], (double)box.high[1], (double)box.high[2]};
    out_box->low = outwards(fe__dadd(tree->origin, low), -1.0);
    out_box->high = outwards(fe__dadd(tree->origin, high), 1.0);
}

static void query_box(const fe__tree *tree, fe__tree_box box, fe__tree_visit visit, void *context)
{
    const float low[3] = {box.low[0], box.low[1], box.low[2]}, high[3] = {box.high[0], box.high[1], box.high[2]};
    fe__kernels_of_tree(tree)->query(tree, low, high, visit, context);
}

void fe__tree_query(const fe__tree *tree, const fe__bounds *box, fe__tree_visit visit, void *context)
{
    if (tree->proxy_count > 0) query_box(tree, fe__tree_box_of(&tree->origin, box), visit, context);
}

void fe__tree_query_proxy(const fe__tree *tree, const fe__tree *of, int32_t proxy, fe__tree_visit visit, void *context)
{
    if (tree->proxy_count == 0) return;
    if (tree == of) {
        query_box(tree, box_of(tree, proxy), visit, context);
    } else {
        fe__bounds box;
        fe__tree_get(of, proxy, &box);
        query_box(tree, fe__tree_box_of(&tree->origin, &box), visit, context);
    }
}

// ---- tree change ----------------------------------------------------------------------------------------------------
// Proxies move and go.
//
// A removal joins what it leaves alone to the node above, so that insertions and removals in any number do not make the
// tree grow. Nothing here allocates.

// More proxies than a 32nd of the nodes: refitting all nodes costs less than walking up from each.
enum { REFIT_ALL = 32 };

static int32_t same_box(fe__tree_box a, fe__tree_box b)
{
    return (fe__quad_signs((a.low == b.low) & (a.high == b.high)) & 7u) == 7u;
}

void fe__tree_refit_above(fe__tree *tree, int32_t index)
{
    while (index > 0) {
        const fe__tree_node *node = &tree->nodes[index];
        fe__tree_node *parent = &tree->nodes[node->parent];
        fe__tree_box box = fe__node_box(node);
        if (same_box(box, fe__lane_box(parent, node->lane))) return;
        fe__lane_set_box(parent, node->lane, box);
        index = node->parent;
    }
}

// Children before parents: after a build, that is once through the memory.
static fe__tree_box refit_below(fe__tree *tree, int32_t index)
{
    fe__tree_node *node = &tree->nodes[index];
    for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane)
        if (node->child[lane] >= 0) fe__lane_set_box(node, lane, refit_below(tree, node->child[lane]));
    return fe__node_box(node);
}

void fe__tree_move(fe__tree *tree, const int32_t *proxies, const fe__bounds *fat, int32_t count)
{
    int32_t all = count > tree->node_count / REFIT_ALL;
    for (int32_t i = 0; i < count; ++i) {
        int32_t slot = tree->slot[proxies[i]], index = slot / FE_TREE_WIDTH;
        fe__lane_set_box(&tree->nodes[index], slot % FE_TREE_WIDTH, fe__tree_box_of(&tree->origin, &fat[i]));
        if (!all) fe__tree_refit_above(tree, index);
    }
    if (all && count > 0) (void)refit_below(tree, 0);
}

// The only child left in a node takes the node's place in its parent.
static void lift_only_child(fe__tree *tree, int32_t index, int32_t lane)
{
    fe__tree_node *node = &tree->nodes[index];
    fe__tree_hang(tree, node->parent, node->lane, fe__lane_box(node, lane), node->child[lane]);
    node->parent = -1;
    tree->dead += 1;
}

void fe__tree_remove(fe__tree *tree, int32_t proxy)
{
    int32_t slot = tree->slot[proxy], index = slot / FE_TREE_WIDTH;
    fe__tree_node *node = &tree->nodes[index];
    tree->slot[proxy] = -1;
    fe__lane_clear(node, slot % FE_TREE_WIDTH);
    tree->proxy_count -= 1;
    if (tree->proxy_count == 0) {
        tree->node_count = tree->dead = tree->depth = 0;
        return;
    }
    int32_t left = 0, last = 0;
    for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane) {
        if (node->child[lane] == FE_TREE_EMPTY) continue;
        left += 1;
        last = lane;
    }
    if (index > 0 && left == 1) {
        int32_t parent = node->parent;
        lift_only_child(tree, index, last);
        index = parent;
    }
    fe__tree_refit_above(tree, index);
}

// ---- tree insert ----------------------------------------------------------------------------------------------------
// A proxy comes in.
//
// It goes down the lanes that grow least and ends beside other proxies. A full node is split in two, the new half goes
// to the parent, and so on up to the root, as in an R-tree (Guttman 1984): the tree stays shallow in whatever order
// proxies come, also when they come in rows or all at one place. Nothing here allocates: without spare nodes for a
// split, a proxy's lane becomes a node of two.

enum {
    NINE = FE_TREE_WIDTH + 1,
    SIDE = 2, // a split leaves at least so many of the nine on each side
};

// This is a ratio of areas. Boxes that are each a little larger than the one before must not stay above: they would
// make a chain.
#define MUCH_LARGER 4.0f

// An entry is what a lane holds, or is to hold.
typedef struct entry {
    fe__tree_box box;
    int32_t child;
} entry;

static fe__tree_box join(fe__tree_box a, fe__tree_box b)
{
    return (fe__tree_box){fe__quad_min(a.low, b.low), fe__quad_max(a.high, b.high)};
}

static int32_t append_node(fe__tree *tree, int32_t parent, int32_t lane)
{
    int32_t index = tree->node_count++;
    fe__node_init(&tree->nodes[index], parent, lane);
    return index;
}

// ---- where to ------------------------------------------------------------------------------------------------------
typedef struct lane_costs {
    _Alignas(16) float area[FE_TREE_WIDTH]; // The area of each lane's box, m2.
    _Alignas(16) float cost[FE_TREE_WIDTH]; // area that is added by putting the new box there
} lane_costs;

static fe__lanes areas(const fe__lanes low[3], const fe__lanes high[3])
{
    fe__lanes d[3], far = fe__lanes_set((float)FE_TREE_FAR);
    for (int32_t k = 0; k < 3; ++k) d[k] = fe__lanes_min(fe__lanes_sub(high[k], low[k]), far);
    return fe__lanes_add(fe__lanes_add(fe__lanes_mul(d[0], d[1]), fe__lanes_mul(d[1], d[2])),
                         fe__lanes_mul(d[2], d[0]));
}

// An inner node grows; a proxy's lane would become a node around both; an empty lane is not for sale.
static fe__quad cost_of(const int32_t child[4], fe__quad before, fe__quad after)
{
    const fe__quad_int empty = {FE_TREE_EMPTY, FE_TREE_EMPTY, FE_TREE_EMPTY, FE_TREE_EMPTY};
    fe__quad_int c = *(const fe__quad_int *)child;
    fe__quad cost = after - fe__quad_choose(c >= 0, before, fe__quad_set(0.0f));
    return fe__quad_choose(c == empty, fe__quad_set(INFINITY), cost);
}

static void find_costs(const fe__tree_node *node, fe__tree_box box, lane_costs *out)
{
    fe__lanes low[3], high[3], low_both[3], high_both[3];
    for (int32_t k = 0; k < 3; ++k) {
        low[k] = fe__lanes_load(node->box[k]);
        high[k] = fe__lanes_load(node->box[3 + k]);
        low_both[k] = fe__lanes_min(low[k], fe__lanes_set(box.low[k]));
        high_both[k] = fe__lanes_max(high[k], fe__lanes_set(box.high[k]));
    }
    fe__lanes before = areas(low, high), after = areas(low_both, high_both);
    fe__lanes_store(out->area, before);
    fe__lanes_store(out->cost,
                    (fe__lanes){cost_of(node->child, before.a, after.a), cost_of(node->child + 4, before.b, after.b)});
}

static int32_t free_lane(const fe__tree_node *node)
{
    for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane)
        if (node->child[lane] == FE_TREE_EMPTY) return lane;
    return -1;
}

// The lane of least cost, and among equals of least area.
static int32_t cheapest_lane(const lane_costs *c)
{
    int32_t best = 0;
    for (int32_t lane = 1; lane < FE_TREE_WIDTH; ++lane)
        if (c->cost[lane] < c->cost[best] || (c->cost[lane] == c->cost[best] && c->area[lane] < c->area[best]))
            best = lane;
    return best;
}

// Goes down to the node that gets the proxy, and grows the boxes on the way. A box larger than the node it would enter
// (a floor among crates) stays above it while there is a free lane. `out_lane`: the cheapest there, a proxy's unless
// another is free.
static int32_t descend(fe__tree *tree, fe__tree_box box, int32_t *out_lane, int32_t *out_depth)
{
    int32_t index = 0;
    float area = fe__box_area(box);
    for (*out_depth = 0;; *out_depth += 1) {
        fe__tree_node *node = &tree->nodes[index];
        lane_costs c;
        find_costs(node, box, &c);
        int32_t lane = *out_lane = cheapest_lane(&c);
        if (node->child[lane] < 0 || (area > MUCH_LARGER * c.area[lane] && free_lane(node) >= 0)) return index;
        fe__lane_set_box(node, lane, join(fe__lane_box(node, lane), box));
        index = node->child[lane];
    }
}

// ---- splitting a full node -----------------------------------------------------------------------------------------
static void sort_by_centre(entry entries[NINE], int32_t axis)
{
    for (int32_t i = 1; i < NINE; ++i) {
        entry e = entries[i];
        float centre = e.box.low[axis] + e.box.high[axis];
        int32_t k = i;
        for (; k > 0 && entries[k - 1].box.low[axis] + entries[k - 1].box.high[axis] > centre; --k)
            entries[k] = entries[k - 1];
        entries[k] = e;
    }
}

// The least sum of area x count of both sides over the cuts of the sorted entries; `out_left` of them are on the left.
static float cheapest_cut(const entry entries[NINE], int32_t *out_left)
{
    float right_cost[NINE];
    fe__tree_box box = entries[NINE - 1].box;
    for (int32_t k = NINE - 1; k >= SIDE; --k) {
        box = join(box, entries[k].box);
        right_cost[k] = fe__box_area(box) * (float)(NINE - k);
    }
    float best = INFINITY;
    box = entries[0].box;
    for (int32_t k = 1; k < SIDE; ++k) box = join(box, entries[k].box);
    for (int32_t k = SIDE; k <= NINE - SIDE; ++k) {
        float cost = fe__box_area(box) * (float)k + right_cost[k];
        if (cost < best) {
            best = cost;
            *out_left = k;
        }
        box = join(box, entries[k].box);
    }
    return best;
}

// Shares the children of a full node and one more between it and a new node, which is given back for the parent to
// hold.
static entry split(fe__tree *tree, int32_t index, const entry *extra)
{
    fe__tree_node *node = &tree->nodes[index];
    entry sorted[3][NINE];
    float best = INFINITY;
    int32_t axis = 0, left = NINE / 2;
    for (int32_t k = 0; k < 3; ++k) {
        for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane)
            sorted[k][lane] = (entry){fe__lane_box(node, lane), node->child[lane]};
        sorted[k][FE_TREE_WIDTH] = *extra;
        sort_by_centre(sorted[k], k);
        int32_t cut = left;
        float cost = cheapest_cut(sorted[k], &cut);
        if (cost < best) {
            best = cost;
            axis = k;
            left = cut;
        }
    }
    int32_t fresh = append_node(tree, node->parent, 0); // The lane above it is known when it is hung up.
    fe__node_init(node, node->parent, node->lane);
    for (int32_t k = 0; k < NINE; ++k) {
        const entry *e = &sorted[axis][k];
        fe__tree_hang(tree, k < left ? index : fresh, k < left ? k : k - left, e->box, e->child);
    }
    fe__lane_set_box(&tree->nodes[node->parent], node->lane, fe__node_box(node));
    return (entry){fe__node_box(&tree->nodes[fresh]), fresh};
}

// The root stays the first node: its children move to a new node, which becomes its only child.
static int32_t push_root_down(fe__tree *tree)
{
    fe__tree_node *root = &tree->nodes[0];
    int32_t fresh = append_node(tree, 0, 0);
    for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane)
        fe__tree_hang(tree, fresh, lane, fe__lane_box(root, lane), root->child[lane]);
    fe__node_init(root, -1, 0);
    fe__tree_hang(tree, 0, 0, fe__node_box(&tree->nodes[fresh]), fresh);
    tree->depth += 1;
    return fresh;
}

// Adds to a node, or splits it and adds the new half to its parent, and so on. Uses one node a level and one for a new
// root. The boxes above were grown on the way down, and a split does not change their union.
static void add(fe__tree *tree, int32_t index, entry e)
{
    for (;;) {
        int32_t lane = free_lane(&tree->nodes[index]);
        if (lane >= 0) {
            fe__tree_hang(tree, index, lane, e.box, e.child);
            return;
        }
        if (index == 0) index = push_root_down(tree);
        e = split(tree, index, &e);
        index = tree->nodes[index].parent;
    }
}

// A node in the place of a proxy's lane, for it and the new one.
static void pair_up(fe__tree *tree, int32_t index, int32_t lane, entry e)
{
    fe__tree_node *node = &tree->nodes[index];
    fe__tree_box old = fe__lane_box(node, lane);
    int32_t neighbour = node->child[lane], fresh = append_node(tree, index, lane);
    fe__tree_hang(tree, fresh, 0, old, neighbour);
    fe__tree_hang(tree, fresh, 1, e.box, e.child);
    fe__tree_hang(tree, index, lane, join(old, e.box), fresh);
}

// A first proxy founds the tree, and says where the origin is.
static void found(fe__tree *tree, const fe__bounds *fat)
{
    tree->node_count = tree->dead = tree->depth = 0;
    tree->built_cost = 0.0f;
    fe_dvec3 centre = fe__dadd(fe__dscale(0.5, fat->low), fe__dscale(0.5, fat->high));
    tree->origin = (fe_dvec3){fe__tree_grid(centre.x), fe__tree_grid(centre.y), fe__tree_grid(centre.z)};
    append_node(tree, -1, 0);
}

void fe__tree_insert(fe__tree *tree, int32_t proxy, const fe__bounds *fat)
{
    if (tree->proxy_count++ == 0) found(tree, fat);
    tree->promised = fe__maxi(tree->promised - 1, 0);
    entry e = {fe__tree_box_of(&tree->origin, fat), ~proxy};
    int32_t lane, depth, index = descend(tree, e.box, &lane, &depth);
    // each insertion still promised may need a node of its own
    int32_t spare = tree->node_capacity - tree->node_count - tree->promised;
    if (spare >= depth + 2 || free_lane(&tree->nodes[index]) >= 0) {
        add(tree, index, e);
    } else {
        pair_up(tree, index, lane, e);
        tree->depth = fe__maxi(tree->depth, depth + 1);
    }
}

// ---- tree check -----------------------------------------------------------------------------------------------------

static int32_t is_box(const fe__tree_node *node, int32_t lane)
{
    for (int32_t k = 0; k < 3; ++k)
        if (!(node->box[k][lane] <= node->box[3 + k][lane])) return 0;
    return 1;
}

static int32_t holds(const fe__tree_node *parent, int32_t lane, const fe__tree_node *node)
{
    fe__tree_box box = fe__node_box(node);
    for (int32_t k = 0; k < 3; ++k)
        if (!(parent->box[k][lane] <= box.low[k] && box.high[k] <= parent->box[3 + k][lane])) return 0;
    return 1;
}

typedef struct walk {
    fe__tree *tree;
    int32_t (*takes)(void *context, int32_t proxy);
    void *context;
    int32_t nodes, proxies, depth; // seen; depth of this one
} walk;

static int32_t takes_proxy(walk *at, int32_t proxy, int32_t slot)
{
    if (++at->proxies > at->tree->proxy_count || !at->takes(at->context, proxy) || at->tree->slot[proxy] >= 0) return 0;
    at->tree->slot[proxy] = slot;
    return 1;
}

// Depth first along the links to parents and lanes: no stack
static int32_t check_lane(walk *at, int32_t index, int32_t lane)
{
    const fe__tree *tree = at->tree;
    fe__tree_node *node = tree->nodes + index;
    int32_t child = node->child[lane];
    if (child == FE_TREE_EMPTY) {
        fe__lane_clear(node, lane);
        return 1;
    }
    if (!is_box(node, lane)) return 0;
    if (child < 0) return takes_proxy(at, ~child, index * FE_TREE_WIDTH + lane);
    if (child == 0 || child >= tree->node_count || ++at->nodes > tree->node_count) return 0;
    const fe__tree_node *below = tree->nodes + child;
    return below->parent == index && below->lane == lane && holds(node, lane, below);
}

// The parent's lane of a node in the tree leads back to the node: so each node is met once.
static int32_t check_node(walk *at, int32_t index)
{
    const fe__tree *tree = at->tree;
    int32_t children = 0;
    for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane) {
        children += tree->nodes[index].child[lane] != FE_TREE_EMPTY;
        if (!check_lane(at, index, lane)) return 0;
    }
    return children >= (index ? 2 : 1) && at->depth <= tree->depth;
}

static int32_t next_inner_lane(const fe__tree_node *node, int32_t lane)
{
    while (lane < FE_TREE_WIDTH && node->child[lane] < 0) ++lane;
    return lane;
}

static int32_t check_nodes(walk *at, int32_t *out_node)
{
    const fe__tree *tree = at->tree;
    int32_t index = 0, lane = 0;
    *out_node = 0;
    if (!check_node(at, 0)) return 0;
    while (index >= 0) {
        const fe__tree_node *node = tree->nodes + index;
        lane = next_inner_lane(node, lane);
        if (lane == FE_TREE_WIDTH) {
            lane = node->lane + 1, index = node->parent, --at->depth;
            continue;
        }
        *out_node = index = node->child[lane], lane = 0, ++at->depth;
        if (!check_node(at, index)) return 0;
    }
    return at->proxies == tree->proxy_count && at->nodes == tree->node_count - tree->dead;
}

// Building anew and closing gaps take each node that has a parent for one that is met
static int32_t count_dead(const fe__tree *tree)
{
    int32_t dead = 0;
    for (int32_t i = 1; i < tree->node_count; ++i) dead += tree->nodes[i].parent < 0;
    return dead;
}

int32_t fe__tree_check(fe__tree *tree, int32_t (*takes)(void *context, int32_t proxy), void *context, int32_t *out_node)
{
    walk at = {tree, takes, context, 1, 0, 0};
    for (int32_t i = 0; i < tree->node_count; ++i) {
        *out_node = i;
        if (tree->nodes[i].parent >= tree->node_count || tree->nodes[i].lane < 0 ||
            tree->nodes[i].lane >= FE_TREE_WIDTH)
            return 0;
    }
    return tree->node_count == 0 ||
           (tree->nodes[0].parent == -1 && count_dead(tree) == tree->dead && check_nodes(&at, out_node));
}
