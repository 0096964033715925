// tree_query.simd.c - which proxies' boxes meet a box.
//
// Depth first with a stack of fixed size. Below a node for which the stack has no room, the walk needs none: parents
// and lanes lead back up. It tests nodes again after each child, so it is slower, and gives the same proxies. Compiled
// once per SIMD set: the widest test a node in one go. What is visited, and in what order, is the same with all of
// them.
#include "broadphase/tree_node.h"
#include "core/simd.h"

enum { STACK = 256 }; // 7 entries a level: enough for a depth of 36

fe__tree_query_kernel FE_NAME(fe__tree_query);

typedef struct query {
    const fe__tree *tree;
    fe__eight low[3], high[3];
    fe__tree_visit visit;
    void *context;
} query;

// bit i: the box of lane i meets the query's
static inline uint32_t meet_lanes(const query *q, const fe__tree_node *node)
{
    fe__eight_mask meets = fe__eight_below(fe__eight_load(node->box[0]), q->high[0]);
    for (int32_t k = 1; k < 3; ++k)
        meets = fe__eight_and(meets, fe__eight_below(fe__eight_load(node->box[k]), q->high[k]));
    for (int32_t k = 0; k < 3; ++k)
        meets = fe__eight_and(meets, fe__eight_below(q->low[k], fe__eight_load(node->box[3 + k])));
    return fe__eight_bits(meets);
}

// 0: stopped by the visitor
static int32_t walk_without_stack(const query *q, int32_t top)
{
    int32_t index = top;
    uint32_t from = 0;
    for (;;) {
        const fe__tree_node *node = &q->tree->nodes[index];
        uint32_t hits = meet_lanes(q, node) >> from << from;
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
        for (uint32_t hits = meet_lanes(q, node); hits; hits &= hits - 1) {
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

void FE_NAME(fe__tree_query)(const fe__tree *tree, const float low[3], const float high[3], fe__tree_visit visit,
                             void *context)
{
    query q = {.tree = tree, .visit = visit, .context = context};
    for (int32_t k = 0; k < 3; ++k) q.low[k] = fe__eight_set(low[k]), q.high[k] = fe__eight_set(high[k]);
    walk(&q);
}
