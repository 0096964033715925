// tree_node.h - what the tree's files share: boxes as floats rounded outwards, and the eight boxes of a node at once.
//
// Why no test misses: a coordinate is moved outwards by 2^-23 of itself, which is more than the roundings of the
// subtraction of the origin and of the conversion to float together, and by FE_TREE_PAD, which is more than a
// denormal's error. Beyond FE_TREE_FAR the outer side is put at
// +-FLT_MAX: the areas of what is nearer stay finite.
#ifndef FE_BROADPHASE_TREE_NODE_H
#define FE_BROADPHASE_TREE_NODE_H
#include "core/lanes.h"
#include "broadphase/tree.h"

#include <float.h>

#define FE_TREE_ULP 0x1p-23 // relative
#define FE_TREE_PAD 1e-20   // m
#define FE_TREE_FAR 1e15    // m from the tree's origin

// Origins lie on a grid, so that the trees of a world mostly share theirs and a ray is prepared once for both. Half a
// cell off, a float is good to 0.06 mm.
#define FE_TREE_CELL 1024.0 // m
static inline double fe__tree_grid(double x)
{
    const double whole = 0x1.8p52; // a double next to it has no fraction
    return (x / FE_TREE_CELL + whole - whole) * FE_TREE_CELL;
}

// x y z of a box relative to the tree's origin; the fourth lane means nothing
typedef struct fe__tree_box {
    fe__quad low, high;
} fe__tree_box;

static inline float fe__tree_round_down(double x)
{
    double y = x - (fe__absd(x) * FE_TREE_ULP + FE_TREE_PAD);
    return x > FE_TREE_FAR ? (float)FE_TREE_FAR : x < -FE_TREE_FAR ? -FLT_MAX : (float)y;
}
static inline float fe__tree_round_up(double x)
{
    double y = x + (fe__absd(x) * FE_TREE_ULP + FE_TREE_PAD);
    return x > FE_TREE_FAR ? FLT_MAX : x < -FE_TREE_FAR ? -(float)FE_TREE_FAR : (float)y;
}

// Of coordinates beyond FE_TREE_FAR
static __attribute__((noinline, unused)) fe__tree_box fe__tree_far_box(fe_dvec3 low, fe_dvec3 high)
{
    return (fe__tree_box){{fe__tree_round_down(low.x), fe__tree_round_down(low.y), fe__tree_round_down(low.z), 0.0f},
                          {fe__tree_round_up(high.x), fe__tree_round_up(high.y), fe__tree_round_up(high.z), 0.0f}};
}

static inline fe__doubles fe__tree_pad(fe__doubles size) { return size * FE_TREE_ULP + FE_TREE_PAD; }

// In pairs, as the six coordinates follow each other: the numbers of fe__tree_round_down and fe__tree_round_up
FE_LANES_INLINE fe__tree_box fe__tree_box_of(const fe_dvec3 *origin, const fe__bounds *bounds)
{
    const fe_dvec3 *o = origin, *l = &bounds->low, *h = &bounds->high;
    const fe__doubles far = {FE_TREE_FAR, FE_TREE_FAR}, outwards = {-1.0, 1.0};
    fe__doubles a = (fe__doubles){l->x, l->y} - (fe__doubles){o->x, o->y}, size_a = fe__doubles_abs(a);
    fe__doubles b = (fe__doubles){l->z, h->x} - (fe__doubles){o->z, o->x}, size_b = fe__doubles_abs(b);
    fe__doubles c = (fe__doubles){h->y, h->z} - (fe__doubles){o->y, o->z}, size_c = fe__doubles_abs(c);
    if (fe__quad_signs((fe__quad_int)(size_a > far) | (fe__quad_int)(size_b > far) | (fe__quad_int)(size_c > far)))
        return fe__tree_far_box(fe__dsub(*l, *o), fe__dsub(*h, *o));
    a = a - fe__tree_pad(size_a), b = b + outwards * fe__tree_pad(size_b), c = c + fe__tree_pad(size_c);
    const fe__quad zero = fe__quad_set(0.0f);
    return (fe__tree_box){__builtin_shufflevector(fe__quad_narrow(a, b), zero, 0, 1, 2, 4),
                          __builtin_shufflevector(fe__quad_narrow(b, c), zero, 1, 2, 3, 4)};
}

// Free nodes for so many insertions into a tree of so many nodes: one each, and some so that nodes can be split, one
// for each level of a deep tree, less in one of few nodes.
static inline int64_t fe__tree_room(int32_t insertions, int32_t nodes)
{
    enum { SPLIT_ROOM = 32, ROOM_OF_A_NODE = 2 };
    return (int64_t)insertions + fe__minl(SPLIT_ROOM, (int64_t)ROOM_OF_A_NODE * nodes);
}

// ---- one lane ------------------------------------------------------------------------------------------------------
static inline fe__tree_box fe__lane_box(const fe__tree_node *node, int32_t lane)
{
    return (fe__tree_box){{node->box[0][lane], node->box[1][lane], node->box[2][lane], 0.0f},
                          {node->box[3][lane], node->box[4][lane], node->box[5][lane], 0.0f}};
}
static inline void fe__lane_set_box(fe__tree_node *node, int32_t lane, fe__tree_box box)
{
    for (int32_t k = 0; k < 3; ++k) {
        node->box[k][lane] = box.low[k];
        node->box[3 + k][lane] = box.high[k];
    }
}
static inline void fe__lane_clear(fe__tree_node *node, int32_t lane)
{
    fe__lane_set_box(node, lane, (fe__tree_box){fe__quad_set(INFINITY), fe__quad_set(-INFINITY)});
    node->child[lane] = FE_TREE_EMPTY;
}

// Puts a child, with its box, into a lane.
static inline void fe__tree_hang(fe__tree *tree, int32_t index, int32_t lane, fe__tree_box box, int32_t child)
{
    fe__lane_set_box(&tree->nodes[index], lane, box);
    tree->nodes[index].child[lane] = child;
    if (child >= 0) {
        tree->nodes[child].parent = index;
        tree->nodes[child].lane = lane;
    } else {
        tree->slot[~child] = index * FE_TREE_WIDTH + lane;
    }
}

// ---- eight lanes ---------------------------------------------------------------------------------------------------
static inline void fe__node_init(fe__tree_node *node, int32_t parent, int32_t lane)
{
    for (int32_t k = 0; k < FE_TREE_WIDTH; ++k) fe__lane_clear(node, k);
    node->parent = parent;
    node->lane = lane;
}

// x y z z of the least of the eight in three rows: fold halves, then turn the three quads into one
static inline fe__quad fe__node_low(const fe__tree_node *node)
{
    fe__lanes r0 = fe__lanes_load(node->box[0]), r1 = fe__lanes_load(node->box[1]), r2 = fe__lanes_load(node->box[2]);
    fe__quad x = fe__quad_min(r0.a, r0.b), y = fe__quad_min(r1.a, r1.b), z = fe__quad_min(r2.a, r2.b);
    fe__quad xy = fe__quad_min(__builtin_shufflevector(x, y, 0, 1, 4, 5), __builtin_shufflevector(x, y, 2, 3, 6, 7));
    fe__quad zz = fe__quad_min(z, __builtin_shufflevector(z, z, 2, 3, 0, 1));
    return fe__quad_min(__builtin_shufflevector(xy, zz, 0, 2, 4, 4), __builtin_shufflevector(xy, zz, 1, 3, 5, 5));
}
static inline fe__quad fe__node_high(const fe__tree_node *node)
{
    fe__lanes r0 = fe__lanes_load(node->box[3]), r1 = fe__lanes_load(node->box[4]), r2 = fe__lanes_load(node->box[5]);
    fe__quad x = fe__quad_max(r0.a, r0.b), y = fe__quad_max(r1.a, r1.b), z = fe__quad_max(r2.a, r2.b);
    fe__quad xy = fe__quad_max(__builtin_shufflevector(x, y, 0, 1, 4, 5), __builtin_shufflevector(x, y, 2, 3, 6, 7));
    fe__quad zz = fe__quad_max(z, __builtin_shufflevector(z, z, 2, 3, 0, 1));
    return fe__quad_max(__builtin_shufflevector(xy, zz, 0, 2, 4, 4), __builtin_shufflevector(xy, zz, 1, 3, 5, 5));
}
static inline fe__tree_box fe__node_box(const fe__tree_node *node)
{
    return (fe__tree_box){fe__node_low(node), fe__node_high(node)};
}

// Tightens or widens the boxes above a node, up to the first that needs no change.
void fe__tree_refit_above(fe__tree *tree, int32_t index);

// half the surface of a box, m2: what a random ray's chance to meet it is proportional to
static inline float fe__box_area(fe__tree_box box)
{
    fe__quad d = fe__quad_min(box.high - box.low, fe__quad_set((float)FE_TREE_FAR));
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

#endif
