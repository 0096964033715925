// tree.c - the tree's memory, and what a single proxy's box is.
//
// tree_insert.c and tree_change.c change it; tree_build.c builds it; tree_query.simd.c and tree_ray.simd.c ask.
#include "broadphase/tree_node.h"

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
