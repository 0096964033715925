// tree_change.c - proxies move and go.
//
// A removal joins what it leaves alone to the node above, so that insertions and removals in any number do not make the
// tree grow. Nothing here allocates.
#include "broadphase/tree_node.h"

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
