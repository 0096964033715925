// tree_build.c - a new tree from the boxes of the old one, top down.
//
// A node's proxies are cut in two, and its costliest part again, until there are eight parts; each becomes a lane. A
// cut lies where the sum of area x count of both sides is least (the surface area heuristic), tried at the borders of
// eight bins along the longest axis of the centres (Wald 2007). The tree is made beside the old one and takes its place
// when it is whole.
#include "broadphase/tree_node.h"

enum {
    BINS = 8,          // 4 to 16 were measured: no difference above the noise
    HALVED_DEPTH = 16, // from here on parts are halved, so that whatever the boxes, the depth is bounded
    MAX_DEPTH = 30,    // deeper trees are built anew
};
static const double worn_cost = 1.3;      // of the cost when built
static const double far_origin = 1000.0;  // m: up to there a float is good to 0.1 mm
static const float largest_scale = 1e30f; // 1/m: centres that are closer are taken for equal

// A box on its way into a node, two quads long: the proxy is where the low corner's quad has nothing.
typedef struct item {
    union {
        fe__quad low_and_proxy;
        struct {
            float low[3];
            int32_t proxy;
        };
    };
    fe__quad high;
} item;

// items [first, first + count) and the box around them
typedef struct part {
    fe__quad low, high;
    int32_t first, count;
} part;

typedef struct builder {
    fe__memory *memory;
    fe__tree_node *nodes;
    item *items;
    int32_t count, capacity, depth;
} builder;

// ---- cutting a part in two ------------------------------------------------------------------------------------------
// Without the proxy's bits, which make a denormal number that some machines are slow to compute with
static fe__quad low_of(const item *i)
{
    const fe__quad_int xyz = {-1, -1, -1, 0};
    return (fe__quad)((fe__quad_int)i->low_and_proxy & xyz);
}

static part nothing(int32_t first) { return (part){fe__quad_set(INFINITY), fe__quad_set(-INFINITY), first, 0}; }

static void swell(part *p, fe__quad low, fe__quad high)
{
    p->low = fe__quad_min(p->low, low);
    p->high = fe__quad_max(p->high, high);
}

static part part_of(const item *items, int32_t first, int32_t count)
{
    part p = nothing(first);
    p.count = count;
    for (int32_t i = first; i < first + count; ++i) swell(&p, low_of(&items[i]), items[i].high);
    return p;
}

static float part_area(const part *p) { return fe__box_area((fe__tree_box){p->low, p->high}); }

// Bins of doubled centres along one axis.
typedef struct binning {
    int32_t axis; // -1: the centres agree, or are too far apart for a float
    float start, scale;
} binning;

static binning choose_bins(const item *items, const part *p)
{
    fe__quad low = fe__quad_set(FLT_MAX), high = fe__quad_set(-FLT_MAX);
    for (int32_t i = p->first; i < p->first + p->count; ++i) {
        fe__quad centre = low_of(&items[i]) + items[i].high;
        low = fe__quad_min(low, centre);
        high = fe__quad_max(high, centre);
    }
    fe__quad d = high - low;
    int32_t axis = d[0] >= d[1] ? (d[0] >= d[2] ? 0 : 2) : (d[1] >= d[2] ? 1 : 2);
    float scale = (float)BINS * 0.99999f / d[axis]; // a little less than BINS: the last centre lies in the last bin
    int32_t usable = d[axis] > 0.0f && d[axis] < FLT_MAX && scale < largest_scale;
    return (binning){usable ? axis : -1, low[axis], scale};
}

// Sums of the largest coordinates may overflow: whatever comes out is a bin.
static int32_t bin_of(const binning *b, const item *i)
{
    float bin = (i->low[b->axis] + i->high[b->axis] - b->start) * b->scale;
    return bin > 0.0f ? (int32_t)fe__minf(bin, (float)(BINS - 1)) : 0;
}

// The border before which bin to cut; 0: none leaves something on both sides.
static int32_t cheapest_border(const part bins[BINS], int32_t count)
{
    float right_cost[BINS];
    part side = nothing(0);
    for (int32_t k = BINS - 1; k > 0; --k) {
        swell(&side, bins[k].low, bins[k].high);
        side.count += bins[k].count;
        right_cost[k] = side.count > 0 ? part_area(&side) * (float)side.count : 0.0f;
    }
    float best = INFINITY;
    int32_t border = 0;
    side = nothing(0);
    for (int32_t k = 1; k < BINS; ++k) {
        swell(&side, bins[k - 1].low, bins[k - 1].high);
        side.count += bins[k - 1].count;
        if (side.count == 0 || side.count == count) continue;
        float cost = part_area(&side) * (float)side.count + right_cost[k];
        if (cost < best) {
            best = cost;
            border = k;
        }
    }
    return border;
}

static void partition(item *items, const part *p, const binning *b, int32_t border)
{
    int32_t i = p->first, j = p->first + p->count - 1;
    while (i <= j) {
        if (bin_of(b, &items[i]) < border) {
            ++i;
        } else {
            item swapped = items[i];
            items[i] = items[j];
            items[j--] = swapped;
        }
    }
}

static void halve(const item *items, const part *p, part *left, part *right)
{
    int32_t half = p->count / 2;
    *left = part_of(items, p->first, half);
    *right = part_of(items, p->first + half, p->count - half);
}

static void cut(item *items, const part *p, int32_t depth, part *left, part *right)
{
    binning b = choose_bins(items, p);
    if (b.axis < 0 || depth >= HALVED_DEPTH) {
        halve(items, p, left, right);
        return;
    }
    part bins[BINS];
    for (int32_t k = 0; k < BINS; ++k) bins[k] = nothing(0);
    for (int32_t i = p->first; i < p->first + p->count; ++i) {
        part *bin = &bins[bin_of(&b, &items[i])];
        swell(bin, low_of(&items[i]), items[i].high);
        bin->count += 1;
    }
    int32_t border = cheapest_border(bins, p->count);
    if (border == 0) {
        halve(items, p, left, right);
        return;
    }
    partition(items, p, &b, border);
    *left = *right = nothing(p->first);
    for (int32_t k = 0; k < BINS; ++k) {
        part *side = k < border ? left : right;
        swell(side, bins[k].low, bins[k].high);
        side->count += bins[k].count;
    }
    right->first = p->first + left->count;
}

// ---- nodes ---------------------------------------------------------------------------------------------------------
// The part with the largest area x count of those that do not fit one node; -1: all do.
static int32_t costliest(const part parts[FE_TREE_WIDTH], int32_t count)
{
    int32_t best = -1;
    float best_cost = -1.0f;
    for (int32_t k = 0; k < count; ++k) {
        float cost = part_area(&parts[k]) * (float)parts[k].count;
        if (parts[k].count <= FE_TREE_WIDTH || cost <= best_cost) continue;
        best = k;
        best_cost = cost;
    }
    return best;
}

// Two proxies in a free lane each are cheaper than a node of their own.
static int32_t spread_pairs(const item *items, part parts[FE_TREE_WIDTH], int32_t count)
{
    int32_t made = count;
    for (int32_t k = 0; k < count && made < FE_TREE_WIDTH; ++k) {
        if (parts[k].count != 2) continue;
        parts[made++] = part_of(items, parts[k].first + 1, 1);
        parts[k] = part_of(items, parts[k].first, 1);
    }
    return made;
}

static int32_t make_parts(item *items, const part *whole, int32_t depth, part parts[FE_TREE_WIDTH])
{
    if (whole->count <= FE_TREE_WIDTH) {
        for (int32_t k = 0; k < whole->count; ++k) parts[k] = part_of(items, whole->first + k, 1);
        return whole->count;
    }
    int32_t count = 1, best;
    parts[0] = *whole;
    while (count < FE_TREE_WIDTH && (best = costliest(parts, count)) >= 0) {
        part left, right;
        cut(items, &parts[best], depth, &left, &right);
        parts[best] = left;
        parts[count++] = right;
    }
    return spread_pairs(items, parts, count);
}

// Index of the new node, -1: no memory.
static int32_t build_node(builder *b, const part *whole, int32_t parent, int32_t lane, int32_t depth)
{
    if (!FE_RESERVE(b->memory, b->nodes, b->capacity, b->count + 1)) return -1;
    int32_t index = b->count++;
    fe__node_init(&b->nodes[index], parent, lane);
    b->depth = fe__maxi(b->depth, depth);

    part parts[FE_TREE_WIDTH];
    int32_t count = make_parts(b->items, whole, depth, parts);
    for (int32_t k = 0; k < count; ++k) {
        int32_t child;
        if (parts[k].count == 1) {
            child = ~b->items[parts[k].first].proxy;
        } else {
            child = build_node(b, &parts[k], index, k, depth + 1);
            if (child < 0) return -1;
        }
        b->nodes[index].child[k] = child;
        fe__lane_set_box(&b->nodes[index], k, (fe__tree_box){parts[k].low, parts[k].high});
    }
    return index;
}

// ---- when, and from what --------------------------------------------------------------------------------------------
// The sum of the areas of inner lanes: nodes that a random ray enters, up to a factor.
static double cost_of(const fe__tree_node *nodes, int32_t count)
{
    double sum = 0.0;
    for (int32_t i = 1; i < count; ++i)
        if (nodes[i].parent >= 0) sum += (double)fe__box_area(fe__lane_box(&nodes[nodes[i].parent], nodes[i].lane));
    return sum;
}

// Where the origin should move along an axis, relative to where it is: to the centre, if all boxes lie on one side of
// it. While it is among the boxes a move would win one bit at most, and would cost each box another rounding.
static double origin_shift(fe__tree_box all, int32_t axis)
{
    double low = (double)all.low[axis], high = (double)all.high[axis];
    int32_t tame = low > -FE_TREE_FAR && high < FE_TREE_FAR;
    return tame && (low > 0.0 || high < 0.0) ? fe__tree_grid(0.5 * (low + high)) : 0.0;
}

static int32_t origin_is_far_off(fe__tree_box all)
{
    for (int32_t k = 0; k < 3; ++k)
        if (fe__absd(origin_shift(all, k)) > fe__maxd(far_origin, (double)all.high[k] - (double)all.low[k])) return 1;
    return 0;
}

static int32_t is_degenerate(const fe__tree *tree)
{
    return tree->depth > MAX_DEPTH || tree->dead > tree->node_count / 4 ||
           origin_is_far_off(fe__node_box(&tree->nodes[0])) ||
           cost_of(tree->nodes, tree->node_count) > worn_cost * (double)tree->built_cost;
}

static void collect(const fe__tree *tree, fe_dvec3 shift, item *items)
{
    int32_t moved = shift.x != 0.0 || shift.y != 0.0 || shift.z != 0.0, count = 0;
    for (int32_t i = 0; i < tree->node_count; ++i) {
        const fe__tree_node *node = &tree->nodes[i];
        if (i > 0 && node->parent < 0) continue;
        for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane) {
            if (node->child[lane] >= 0 || node->child[lane] == FE_TREE_EMPTY) continue;
            fe__tree_box box = fe__lane_box(node, lane);
            if (moved) {
                fe__bounds bounds = {{(double)box.low[0], (double)box.low[1], (double)box.low[2]},
                                     {(double)box.high[0], (double)box.high[1], (double)box.high[2]}};
                box = fe__tree_box_of(&shift, &bounds);
            }
            item *made = &items[count++];
            made->low_and_proxy = box.low, made->high = box.high;
            made->proxy = ~node->child[lane];
        }
    }
}

// Takes the new nodes into the tree. Nothing can fail any more.
static void adopt(fe__tree *tree, fe__memory *memory, const builder *b, fe_dvec3 shift)
{
    FE_FREE(memory, tree->nodes, tree->node_capacity);
    tree->nodes = b->nodes;
    tree->node_count = b->count;
    tree->node_capacity = b->capacity;
    tree->depth = b->depth;
    tree->dead = 0;
    tree->built_cost = (float)cost_of(b->nodes, b->count);
    tree->origin = fe__dadd(tree->origin, shift);
    for (int32_t i = 0; i < b->count; ++i) {
        for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane) {
            int32_t child = b->nodes[i].child[lane];
            if (child < 0 && child != FE_TREE_EMPTY) tree->slot[~child] = i * FE_TREE_WIDTH + lane;
        }
    }
}

static void discard(builder *b) { FE_FREE(b->memory, b->nodes, b->capacity); }

// 0: no memory, and nothing is left of it
static int32_t build(const fe__tree *tree, builder *b, fe_dvec3 shift)
{
    size_t size = (size_t)tree->proxy_count * sizeof(item);
    b->items = fe__allocate(b->memory, size);
    if (!b->items) return 0;
    collect(tree, shift, b->items);
    part whole = part_of(b->items, 0, tree->proxy_count);
    // As large as before, or as what is reserved asks for. Not as many free nodes as before: what growing left over
    // would be free in the next build, too, and so from build to build without end
    b->nodes = fe__allocate(b->memory, (size_t)tree->node_capacity * sizeof *b->nodes);
    b->capacity = b->nodes ? tree->node_capacity : 0;
    int32_t built =
        b->nodes && build_node(b, &whole, -1, 0, 0) == 0 &&
        FE_RESERVE(b->memory, b->nodes, b->capacity, (int64_t)b->count + fe__tree_room(tree->promised, b->count));
    fe__release(b->memory, b->items, size);
    if (!built) discard(b);
    return built;
}

int32_t fe__trees_rebuild(fe__tree *const *trees, int32_t count, fe__memory *memory, int32_t force)
{
    builder built[FE_TREES] = {{0}};
    fe_dvec3 shift[FE_TREES];
    for (int32_t i = 0; i < count; ++i) {
        const fe__tree *tree = trees[i];
        if (tree->proxy_count == 0 || (!force && !is_degenerate(tree))) continue;
        fe__tree_box all = fe__node_box(&tree->nodes[0]);
        shift[i] = (fe_dvec3){origin_shift(all, 0), origin_shift(all, 1), origin_shift(all, 2)};
        built[i].memory = memory;
        if (build(tree, built + i, shift[i])) continue;
        while (--i >= 0) discard(built + i);
        return 0;
    }
    for (int32_t i = 0; i < count; ++i)
        if (built[i].nodes) adopt(trees[i], memory, built + i, shift[i]);
    return 1;
}
