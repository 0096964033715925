// tree_query.c - which proxies' boxes meet a box.
//
// Depth first with a stack of fixed size. Below a node for which the stack has no room, the walk needs none: parents
// and lanes lead back up. It tests nodes again after each child, so it is slower, and gives the same proxies.
#include "broadphase/tree_node.h"

enum { STACK = 256 }; // 7 entries a level: enough for a depth of 36

typedef struct query {
    const fe__tree *tree;
    fe__lanes low[3], high[3];
    fe__tree_visit visit;
    void *context;
} query;

// 0: stopped by the visitor
static int32_t walk_without_stack(const query *q, int32_t top)
{
    int32_t index = top;
    uint32_t from = 0;
    for (;;) {
        const fe__tree_node *node = &q->tree->nodes[index];
        uint32_t hits = fe__node_meets(node, q->low, q->high) >> from << from;
        if (hits) {
            uint32_t lane = (uint32_t)__builtin_ctz(hits);
            int32_t child = node->child[lane];
            if (child >= 0) {
                index = child;
                from = 0;
                continue;
            }
            if (!q->visit(q->context, ~child)) return 0;
            from = lane + 1;
        } else {
            if (index == top) return 1;
            from = (uint32_t)node->lane + 1;
            index = node->parent;
        }
    }
}

static void walk(const query *q)
{
    int32_t stack[STACK], top = 0, index = 0;
    for (;;) {
        const fe__tree_node *node = &q->tree->nodes[index];
        for (uint32_t hits = fe__node_meets(node, q->low, q->high); hits; hits &= hits - 1) {
            int32_t child = node->child[__builtin_ctz(hits)];
            int32_t go_on = 1;
            if (child < 0)
                go_on = q->visit(q->context, ~child);
            else if (top < STACK)
                stack[top++] = child;
            else
                go_on = walk_without_stack(q, child);
            if (!go_on) return;
        }
        if (top == 0) return;
        index = stack[--top];
    }
}

static void query_box(const fe__tree *tree, fe__tree_box box, fe__tree_visit visit, void *context)
{
    query q = {.tree = tree, .visit = visit, .context = context};
    for (int32_t k = 0; k < 3; ++k) {
        q.low[k] = fe__lanes_set(box.low[k]);
        q.high[k] = fe__lanes_set(box.high[k]);
    }
    walk(&q);
}

void fe__tree_query(const fe__tree *tree, const fe__bounds *box, fe__tree_visit visit, void *context)
{
    if (tree->proxy_count > 0) query_box(tree, fe__tree_box_of(&tree->origin, box), visit, context);
}

void fe__tree_query_proxy(const fe__tree *tree, const fe__tree *of, int32_t proxy, fe__tree_visit visit, void *context)
{
    if (tree->proxy_count == 0) return;
    if (tree == of) {
        int32_t slot = tree->slot[proxy];
        query_box(tree, fe__lane_box(&tree->nodes[slot / FE_TREE_WIDTH], slot % FE_TREE_WIDTH), visit, context);
    } else {
        fe__bounds box;
        fe__tree_get(of, proxy, &box);
        query_box(tree, fe__tree_box_of(&tree->origin, &box), visit, context);
    }
}
