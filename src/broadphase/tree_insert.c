// tree_insert.c - a proxy comes in.
//
// It goes down the lanes that grow least and ends beside other proxies. A full node is split in two, the new half goes
// to the parent, and so on up to the root, as in an R-tree (Guttman 1984): the tree stays shallow in whatever order
// proxies come, also when they come in rows or all at one place. Nothing here allocates: without spare nodes for a
// split, a proxy's lane becomes a node of two.
#include "broadphase/tree_node.h"

enum {
    NINE = FE_TREE_WIDTH + 1,
    SIDE = 2, // a split leaves at least so many of the nine on each side
};

// Of areas. Boxes that are each a little larger than the one before must not stay above: they would make a chain.
#define MUCH_LARGER 4.0f

// What a lane holds, or is to hold.
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
    _Alignas(16) float area[FE_TREE_WIDTH]; // of the lane's box
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
    int32_t fresh = append_node(tree, node->parent, 0); // its lane is known when it is hung up
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
