// tree_change.c - proxies come, go and move.
//
// An insertion walks down the lane whose area grows least (Goldsmith and Salmon 1987) and grows the boxes on its way. A removal joins what
// it leaves alone to the node above, so that insertions and removals in any number do not make the tree grow. Nothing here allocates.
#include "broadphase/tree.h"

#include "broadphase/tree_node.h"

enum {
    // Boxes that hold one another, each smaller than the one before, would make a chain. Deeper than this, lanes are chosen by lot.
    CHOSEN_BY_AREA = 24,
    // More proxies than a 32nd of the nodes: refitting all nodes costs less than walking up from each.
    REFIT_ALL = 32,
};

// ---- insertion ----------------------------------------------------------------------------------------------------------------
typedef struct lane_choice {
    int32_t lane;
    int32_t down; // 1: go on in the child, or split the proxy's lane; 0: the lane is empty
} lane_choice;

static fe__lanes lanes_area(const fe__lanes low[3], const fe__lanes high[3])
{
    fe__lanes d[3], far = fe__lanes_set((float)FE_TREE_FAR);
    for (int32_t k = 0; k < 3; ++k) d[k] = fe__lanes_min(fe__lanes_sub(high[k], low[k]), far);
    return fe__lanes_add(fe__lanes_add(fe__lanes_mul(d[0], d[1]), fe__lanes_mul(d[1], d[2])), fe__lanes_mul(d[2], d[0]));
}

// What it costs to put `box` below each lane: an inner node grows; a proxy's lane becomes a node around both; an empty lane is not for
// sale.
static void lane_costs(const fe__tree_node *node, fe__tree_box box, float cost[FE_TREE_WIDTH])
{
    fe__lanes low[3], high[3], low_both[3], high_both[3];
    for (int32_t k = 0; k < 3; ++k) {
        low[k] = fe__lanes_load(node->box[k]);
        high[k] = fe__lanes_load(node->box[3 + k]);
        low_both[k] = fe__lanes_min(low[k], fe__lanes_set(box.low[k]));
        high_both[k] = fe__lanes_max(high[k], fe__lanes_set(box.high[k]));
    }
    fe__lanes before = lanes_area(low, high), after = lanes_area(low_both, high_both);
    const fe__quad_int *child = (const fe__quad_int *)node->child;
    fe__quad zero = fe__quad_set(0.0f), never = fe__quad_set(INFINITY);
    const fe__quad_int empty = {FE_TREE_EMPTY, FE_TREE_EMPTY, FE_TREE_EMPTY, FE_TREE_EMPTY};
    fe__lanes result = {after.a - fe__quad_choose(child[0] >= 0, before.a, zero), after.b - fe__quad_choose(child[1] >= 0, before.b, zero)};
    result.a = fe__quad_choose(child[0] == empty, never, result.a);
    result.b = fe__quad_choose(child[1] == empty, never, result.b);
    fe__lanes_store(cost, result);
}

// Equal costs (bodies spawned at one place) are decided by `lot`: always the first lane would make a chain of them.
static lane_choice choose_lane(const fe__tree_node *node, fe__tree_box box, uint32_t lot, int32_t depth)
{
    int32_t first = (int32_t)(lot % FE_TREE_WIDTH);
    if (depth >= CHOSEN_BY_AREA) return (lane_choice){first, node->child[first] != FE_TREE_EMPTY};

    _Alignas(16) float cost[FE_TREE_WIDTH];
    lane_costs(node, box, cost);
    int32_t best = first, empty = -1;
    for (int32_t i = 0; i < FE_TREE_WIDTH; ++i) {
        int32_t lane = (first + i) % FE_TREE_WIDTH;
        if (node->child[lane] == FE_TREE_EMPTY) empty = lane;
        if (cost[lane] < cost[best]) best = lane;
    }
    // An empty lane costs the proxy's own area, and is always better than a new node.
    if (empty >= 0 && (node->child[best] < 0 || cost[best] >= fe__box_area(box))) return (lane_choice){empty, 0};
    return (lane_choice){best, 1};
}

static int32_t append_node(fe__tree *tree, int32_t parent, int32_t lane)
{
    int32_t index = tree->node_count++;
    fe__node_init(&tree->nodes[index], parent, lane);
    return index;
}

static void put(fe__tree *tree, int32_t index, int32_t lane, fe__tree_box box, int32_t proxy)
{
    fe__lane_set_box(&tree->nodes[index], lane, box);
    tree->nodes[index].child[lane] = ~proxy;
    tree->slot[proxy] = index * FE_TREE_WIDTH + lane;
}

// A first proxy founds the tree, and its place is the origin.
static void found(fe__tree *tree, const fe__bounds *fat)
{
    tree->node_count = tree->dead = tree->depth = 0;
    tree->built_cost = 0.0f;
    tree->origin = fe__dadd(fe__dscale(0.5, fat->low), fe__dscale(0.5, fat->high));
    append_node(tree, -1, 0);
}

void fe__tree_insert(fe__tree *tree, int32_t proxy, const fe__bounds *fat)
{
    if (tree->proxy_count++ == 0) found(tree, fat);
    fe__tree_box box = fe__tree_box_of(&tree->origin, fat);
    uint32_t lot = (uint32_t)proxy;
    int32_t index = 0, depth = 0;
    for (;;) {
        fe__tree_node *node = &tree->nodes[index];
        lot = lot * 2654435769u + 1u; // 2^32 over the golden ratio: each level draws anew from the upper bits
        lane_choice choice = choose_lane(node, box, lot >> 16, depth);
        if (!choice.down) {
            put(tree, index, choice.lane, box, proxy);
            break;
        }
        int32_t child = node->child[choice.lane];
        fe__tree_box old = fe__lane_box(node, choice.lane);
        fe__lane_set_box(node, choice.lane, (fe__tree_box){fe__quad_min(old.low, box.low), fe__quad_max(old.high, box.high)});
        depth += 1;
        if (child < 0) {
            int32_t fresh = append_node(tree, index, choice.lane);
            node->child[choice.lane] = fresh;
            put(tree, fresh, 0, old, ~child);
            put(tree, fresh, 1, box, proxy);
            break;
        }
        index = child;
    }
    tree->depth = fe__maxi(tree->depth, depth);
}

// ---- boxes above what changed -------------------------------------------------------------------------------------------------
static int32_t same_box(fe__tree_box a, fe__tree_box b) { return (fe__quad_signs((a.low == b.low) & (a.high == b.high)) & 7u) == 7u; }

// Tightens or widens the boxes above a node, up to the first that needs no change.
static void refit_above(fe__tree *tree, int32_t index)
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

// children before parents; dead nodes must not write
static void refit_all(fe__tree *tree)
{
    for (int32_t i = tree->node_count - 1; i > 0; --i) {
        const fe__tree_node *node = &tree->nodes[i];
        if (node->parent >= 0) fe__lane_set_box(&tree->nodes[node->parent], node->lane, fe__node_box(node));
    }
}

void fe__tree_move(fe__tree *tree, const int32_t *proxies, const fe__bounds *fat, int32_t count)
{
    int32_t all = count > tree->node_count / REFIT_ALL;
    for (int32_t i = 0; i < count; ++i) {
        int32_t slot = tree->slot[proxies[i]], index = slot / FE_TREE_WIDTH;
        fe__lane_set_box(&tree->nodes[index], slot % FE_TREE_WIDTH, fe__tree_box_of(&tree->origin, &fat[i]));
        if (!all) refit_above(tree, index);
    }
    if (all) refit_all(tree);
}

// ---- removal ------------------------------------------------------------------------------------------------------------------
// The only child left in a node takes the node's place in its parent.
static void lift_only_child(fe__tree *tree, int32_t index, int32_t lane)
{
    fe__tree_node *node = &tree->nodes[index], *parent = &tree->nodes[node->parent];
    int32_t child = node->child[lane];
    fe__lane_set_box(parent, node->lane, fe__lane_box(node, lane));
    parent->child[node->lane] = child;
    if (child >= 0) {
        tree->nodes[child].parent = node->parent;
        tree->nodes[child].lane = node->lane;
    } else {
        tree->slot[~child] = node->parent * FE_TREE_WIDTH + node->lane;
    }
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
    refit_above(tree, index);
}
