// tree_check.c - see tree_check.h.
#include "broadphase/tree_check.h"

#include "broadphase/tree_node.h"

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

// Of a node that is in the tree its parent's lane is it: so a node is met once
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
