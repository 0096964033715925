// build_trees.c - the trees of boxes, and the list of planes, out of a snapshot. Their nodes are read, as their form
// decides when they are built anew, and with it how boxes are rounded.
#include "state/build.h"

#include "broadphase/tree_check.h"
#include "state/rows.h"

// A walk goes down a tree that deep without harm to the stack. Trees deeper than 30 are built anew every eighth step
enum { DEEPEST = 1024 };

typedef struct taker {
    fe__build *build;
    const fe__tree *tree;
} taker;

static int32_t takes_proxy(void *context, int32_t proxy)
{
    const taker *t = context;
    const fe_world *w = t->build->world;
    if (proxy < 0 || proxy >= w->shape_ids.slot_count) return 0;
    const fe__shape *shape = w->shapes + proxy;
    if (!(shape->flags & FE__SHAPE_IN_TREE)) return 0; // of a slot without a shape they are 0
    return (w->bodies[shape->body].type == FE_BODY_STATIC) == (t->tree == &w->static_tree);
}

static int32_t check_counts(fe__build *b, const fe__tree *tree, fe__table_number table)
{
    int32_t rows = fe__rows_of(b->snapshot, table);
    if (tree->node_count == rows && tree->node_capacity >= rows && tree->node_capacity <= fe__most_nodes(tree) &&
        tree->promised <= fe__most_promised(tree) && (int64_t)rows + tree->promised <= tree->node_capacity &&
        tree->dead <= rows && (tree->proxy_count > 0) == (rows > 0) && tree->depth <= DEEPEST)
        return 1;
    return fe__snapshot_refuse(b->snapshot, "%s: %d nodes of %d, %d promised, %d deep", fe__tables[table].name,
                               (int)rows, (int)tree->node_capacity, (int)tree->promised, (int)tree->depth);
}

static int32_t build_tree(fe__build *b, fe__tree *tree, int32_t number, fe__table_number table)
{
    const fe_world *w = b->world;
    fe__memory *memory = fe__memory_of(b);
    const fe__tree_kernels *kernels = tree->kernels;
    fe__tree told = {.kernels = kernels};
    fe__take_row(b->snapshot, FE__TABLE_TREES, number, &told);
    if (!check_counts(b, &told, table)) return 0;
    if (!FE_RESERVE(memory, tree->slot, tree->slot_capacity, w->shape_capacity)) return fe__lack_memory(b);
    for (int32_t i = 0; i < tree->slot_capacity; ++i) tree->slot[i] = -1;
    // as large as it was: reserving would round it up
    if (told.node_capacity) tree->nodes = fe__allocate(memory, (size_t)told.node_capacity * sizeof *tree->nodes);
    if (told.node_capacity && !tree->nodes) return fe__lack_memory(b);
    told.nodes = tree->nodes, told.slot = tree->slot, told.slot_capacity = tree->slot_capacity;
    *tree = told;
    for (int32_t i = 0; i < tree->node_count; ++i) fe__take_row(b->snapshot, table, i, tree->nodes + i);
    int32_t node;
    if (fe__tree_check(tree, takes_proxy, &(taker){b, tree}, &node)) return 1;
    return fe__snapshot_refuse(b->snapshot, "%s: node %d does not hang together", fe__tables[table].name, (int)node);
}

// ---- planes --------------------------------------------------------------------------------------------------------
static int32_t build_planes(fe__build *b)
{
    fe_world *w = b->world;
    int32_t rows = fe__rows_of(b->snapshot, FE__TABLE_PLANES), seen = 0;
    if (!FE_RESERVE(fe__memory_of(b), w->planes, w->plane_capacity, rows)) return fe__lack_memory(b);
    for (; w->plane_count < rows; ++w->plane_count) {
        int32_t slot = fe__listed_slot(b->snapshot, FE__TABLE_PLANES, w->plane_count);
        if (slot >= w->shape_ids.slot_count || !(w->shapes[slot].flags & FE__SHAPE_IN_PLANES))
            return fe__snapshot_refuse(b->snapshot, "planes: shape %d is none", (int)slot);
        for (int32_t i = 0; i < w->plane_count; ++i)
            if (w->planes[i] == slot) return fe__snapshot_refuse(b->snapshot, "planes: %d is there twice", (int)slot);
        w->planes[w->plane_count] = slot;
    }
    for (int32_t slot = 0; slot < w->shape_ids.slot_count; ++slot)
        seen += (w->shapes[slot].flags & FE__SHAPE_IN_PLANES) != 0;
    return seen == rows ||
           fe__snapshot_refuse(b->snapshot, "planes: %d are listed, %d are there", (int)rows, (int)seen);
}

static int32_t check_all_in_trees(fe__build *b)
{
    const fe_world *w = b->world;
    int32_t in_trees = 0;
    for (int32_t slot = 0; slot < w->shape_ids.slot_count; ++slot)
        in_trees += (w->shapes[slot].flags & FE__SHAPE_IN_TREE) != 0;
    return in_trees == w->static_tree.proxy_count + w->moving_tree.proxy_count ||
           fe__snapshot_refuse(b->snapshot, "trees: %d shapes are to be in them", (int)in_trees);
}

int32_t fe__build_trees(fe__build *b)
{
    fe_world *w = b->world;
    if (fe__rows_of(b->snapshot, FE__TABLE_TREES) != FE_TREES)
        return fe__snapshot_refuse(b->snapshot, "trees: there are not two");
    return build_tree(b, &w->static_tree, 0, FE__TABLE_STATIC_NODES) &&
           build_tree(b, &w->moving_tree, 1, FE__TABLE_MOVING_NODES) && check_all_in_trees(b) && build_planes(b);
}
