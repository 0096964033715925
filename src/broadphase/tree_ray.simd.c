// tree_ray.simd.c - which proxies' boxes a segment, or a box that moves along it, meets, nearest first.
//
// Slabs: along axis k the segment is between two planes for t in [(low - o) / d, (high - o) / d]. Floats, on the safe side: o is rounded
// both ways and each plane takes the side that widens the interval; the quotients' roundings are covered by `slack`. Little work is done
// per ray, so mispredicted branches and the set-up are the cost: the signs of the direction, which are random, do not branch.
// Compiled once per SIMD set: the widest test a node in one go. What is visited is the same with all of them.
#include "broadphase/tree_node.h"
#include "core/simd.h"

enum { ROW = FE_TREE_WIDTH * sizeof(float) };
enum { STACK = 256 }; // 7 entries a level: enough for a depth of 36

// four roundings of 2^-24 on each side of near <= far
static const float slack = 1.000001f;
// A component that moves less than FE_TREE_PAD in the whole segment does not move: boxes and origin are swelled by more. The finite inverse
// keeps 0 * inverse = 0, never NaN.
static const float largest_inverse = (float)(1.0 / FE_TREE_PAD);
// m: the rounding of a denormal quotient (7e-46) stays below FE_TREE_PAD
static const float longest_translation = 1e24f;

// The same for all lanes. A walk reads them from memory, where instructions take them as operands.
typedef struct slabs {
    fe__quad near_origin[3], far_origin[3];
} slabs;

// Of a way, whatever the tree
typedef struct direction {
    fe__quad inverse[3];             // the same for all lanes
    int64_t near_row[3], far_row[3]; // of a node's box, in bytes: row k or k + 3, and the other
    fe__quad_int backwards, blind;   // blind: too fast for floats, excludes nothing
    uint32_t is_blind;               // any
} direction;

// A child that waits: the bits of t, which order as t does, above those of the child. So entries compare, and change places, as integers,
// without a branch on t, which nothing predicts.
typedef uint64_t entry;
enum { CHILD_BITS = 32 };

// The trees of one walk. A node of the second one is told from one of the first by a bit of its index.
enum { MOST_TREES = 2, SECOND_BIT = 30, SECOND = 1 << SECOND_BIT };
typedef struct cast {
    const fe__tree_node *nodes[MOST_TREES];
    direction way;
    const slabs *slabs_of[MOST_TREES];
    slabs slabs[MOST_TREES];
    double limit;
    float limit_up; // rounded up; of a nearest search squared, m2
    fe__tree_ray_visit visit;
    void *context;
} cast;

// What a walk asks of the boxes: where a ray enters them, or how far they are from a point. Each walk is compiled for each question.
typedef enum question { RAY, NEAREST } question;
#define FE_COMPILED_FOR static inline __attribute__((always_inline))
// What hardly ever happens keeps its registers to itself.
#define FE_RARE static __attribute__((noinline, cold))

typedef int64_t pair_mask __attribute__((vector_size(16)));

FE_RARE void round_far(fe_dvec3 o, fe_dvec3 half, fe__quad *low, fe__quad *high)
{
    *low = (fe__quad){fe__tree_round_down(o.x - half.x), fe__tree_round_down(o.y - half.y), fe__tree_round_down(o.z - half.z), 0.0f};
    *high = (fe__quad){fe__tree_round_up(o.x + half.x), fe__tree_round_up(o.y + half.y), fe__tree_round_up(o.z + half.z), 0.0f};
}

// From o - half to o + half, rounded outwards: as fe__tree_round_down and fe__tree_round_up do it, but two coordinates at once, and with
// one allowance for both sides.
static inline void round_outwards(fe_dvec3 o, fe_dvec3 half, fe__quad *low, fe__quad *high)
{
    const pair_mask magnitude = {INT64_MAX, INT64_MAX};
    const fe__pair o_xy = {o.x, o.y}, o_z = {o.z, o.z}, half_xy = {half.x, half.y}, half_z = {half.z, half.z};
    fe__pair size_xy = (fe__pair)((pair_mask)o_xy & magnitude) + half_xy, size_z = (fe__pair)((pair_mask)o_z & magnitude) + half_z;
    fe__pair away_xy = size_xy * FE_TREE_ULP + FE_TREE_PAD, away_z = size_z * FE_TREE_ULP + FE_TREE_PAD;
    *low = fe__quad_narrow((o_xy - half_xy) - away_xy, (o_z - half_z) - away_z);
    *high = fe__quad_narrow((o_xy + half_xy) + away_xy, (o_z + half_z) + away_z);
    if (fe__maxd(fe__maxd(size_xy[0], size_xy[1]), size_z[0]) >= FE_TREE_FAR) round_far(o, half, low, high);
}

static inline void prepare_direction(direction *way, fe_dvec3 translation)
{
    const fe__quad fast = fe__quad_set(longest_translation), slow = fe__quad_set((float)FE_TREE_PAD);
    // one by one: the caller has just written them so, and a load of two at once would wait until they are in the cache
    const fe__quad given = {(float)translation.x, (float)translation.y, (float)translation.z, 1.0f};
    const fe__quad d = fe__quad_max(fe__quad_min(given, fast), -fast);
    fe__quad_int backwards = d < fe__quad_set(0.0f), moves = (d > slow) | (d < -slow);
    fe__quad still = (fe__quad)((fe__quad_int)fe__quad_set(largest_inverse) | (backwards & INT32_MIN));
    fe__quad_int blind = (d >= fast) | (d <= -fast);
    fe__quad inverse = fe__quad_choose(moves, 1.0f / d, still);
    int64_t signs = fe__quad_signs(backwards);
    // one by one: gcc does not unroll a loop
    way->inverse[0] = FE_QUAD_SPREAD(inverse, 0);
    way->inverse[1] = FE_QUAD_SPREAD(inverse, 1);
    way->inverse[2] = FE_QUAD_SPREAD(inverse, 2);
    way->near_row[0] = 3 * ROW * (signs & 1), way->far_row[0] = 3 * ROW - way->near_row[0];
    way->near_row[1] = 3 * ROW * (signs >> 1 & 1) + ROW, way->far_row[1] = 5 * ROW - way->near_row[1];
    way->near_row[2] = 3 * ROW * (signs >> 2 & 1) + 2 * ROW, way->far_row[2] = 7 * ROW - way->near_row[2];
    way->backwards = backwards;
    way->blind = blind;
    way->is_blind = fe__quad_signs(blind);
}

// A box that moves meets another when its centre meets that one swelled by its half widths: the origin is an interval to begin with.
static inline void prepare_slabs(slabs *s, const direction *way, fe_dvec3 o, fe_dvec3 half)
{
    fe__quad low, high;
    round_outwards(o, half, &low, &high);
    if (way->is_blind) {
        low = fe__quad_choose(way->blind, fe__quad_set(-FLT_MAX), low);
        high = fe__quad_choose(way->blind, fe__quad_set(FLT_MAX), high);
    }
    fe__quad_int exchange = ((fe__quad_int)low ^ (fe__quad_int)high) & way->backwards;
    fe__quad near_origin = (fe__quad)((fe__quad_int)high ^ exchange), far_origin = (fe__quad)((fe__quad_int)low ^ exchange);
    s->near_origin[0] = FE_QUAD_SPREAD(near_origin, 0), s->far_origin[0] = FE_QUAD_SPREAD(far_origin, 0);
    s->near_origin[1] = FE_QUAD_SPREAD(near_origin, 1), s->far_origin[1] = FE_QUAD_SPREAD(far_origin, 1);
    s->near_origin[2] = FE_QUAD_SPREAD(near_origin, 2), s->far_origin[2] = FE_QUAD_SPREAD(far_origin, 2);
}

FE_COMPILED_FOR void clip(const char *rows, const direction *way, const slabs *s, int32_t k, fe__eight *enter, fe__eight *leave)
{
    fe__eight near_side = fe__eight_load((const float *)(const void *)(rows + way->near_row[k]));
    fe__eight far_side = fe__eight_load((const float *)(const void *)(rows + way->far_row[k]));
    fe__eight inverse = fe__eight_spread(&way->inverse[k]);
    // in this order a -0 does not replace 0
    *enter = fe__eight_max(fe__eight_mul(fe__eight_sub(near_side, fe__eight_spread(&s->near_origin[k])), inverse), *enter);
    *leave = fe__eight_min(fe__eight_mul(fe__eight_sub(far_side, fe__eight_spread(&s->far_origin[k])), inverse), *leave);
}

// bit i: the segment meets lane i, at t[i] or later
FE_COMPILED_FOR uint32_t hit_lanes(const fe__tree_node *node, const direction *way, const slabs *s, float limit, float t[FE_TREE_WIDTH])
{
    const char *rows = (const char *)node->box;
    fe__eight enter = fe__eight_set(0.0f), leave = fe__eight_set(limit);
    clip(rows, way, s, 0, &enter, &leave);
    clip(rows, way, s, 1, &enter, &leave);
    clip(rows, way, s, 2, &enter, &leave);
    fe__eight_store(t, enter);
    return fe__eight_at_most(enter, fe__eight_mul(leave, fe__eight_set(slack)));
}

// The squared distance is  sum_k max(low_k - p_k, p_k - high_k, 0)^2. The origin's two roundings are in near_origin and far_origin.
static inline uint32_t near_lanes(const fe__tree_node *node, const slabs *s, float limit, float t[FE_TREE_WIDTH])
{
    const fe__eight zero = fe__eight_set(0.0f);
    fe__eight square = zero;
    for (int32_t k = 0; k < 3; ++k) {
        fe__eight below = fe__eight_sub(fe__eight_load(node->box[k]), fe__eight_spread(&s->near_origin[k]));
        fe__eight above = fe__eight_sub(fe__eight_spread(&s->far_origin[k]), fe__eight_load(node->box[3 + k]));
        fe__eight away = fe__eight_max(fe__eight_max(below, above), zero);
        square = fe__eight_add(square, fe__eight_mul(away, away));
    }
    fe__eight_store(t, square);
    return fe__eight_at_most(square, fe__eight_set(limit * slack));
}

FE_COMPILED_FOR uint32_t meet_lanes(question q, const cast *c, int32_t tree, const fe__tree_node *node, float t[FE_TREE_WIDTH])
{
    const slabs *s = c->slabs_of[tree];
    return q == RAY ? hit_lanes(node, &c->way, s, c->limit_up, t) : near_lanes(node, s, c->limit_up, t);
}

// Beyond the largest distance in a world, so that nothing is lost, and its square stays finite in a float.
#define FARTHEST 1e15 // m
static float square_up(double limit)
{
    double x = fe__mind(limit, FARTHEST);
    return (float)(x * x * (1.0 + FE_TREE_ULP) + FE_TREE_PAD);
}

FE_COMPILED_FOR void visit_proxy(question q, cast *c, int32_t proxy)
{
    c->limit = c->visit(c->context, proxy, c->limit);
    c->limit_up = q == RAY ? fe__tree_round_up(c->limit) : square_up(c->limit);
}

// The subtree at `top` when the stack is full: parents and lanes lead back up.
FE_RARE void walk_without_stack(question q, cast *c, int32_t tree, int32_t top)
{
    _Alignas(32) float t[FE_TREE_WIDTH];
    int32_t index = top;
    uint32_t from = 0;
    while (c->limit >= 0.0) {
        const fe__tree_node *node = &c->nodes[tree][index];
        uint32_t hits = meet_lanes(q, c, tree, node, t) >> from << from;
        if (hits) {
            uint32_t lane = (uint32_t)__builtin_ctz(hits);
            int32_t child = node->child[lane];
            if (child >= 0) {
                index = child;
                from = 0;
                continue;
            }
            visit_proxy(q, c, ~child);
            from = lane + 1;
        } else {
            if (index == top) return;
            from = (uint32_t)node->lane + 1;
            index = node->parent;
        }
    }
}

static inline entry entry_of(float t, int32_t child)
{
    union {
        float t;
        uint32_t bits;
    } u = {t};
    return (entry)u.bits << CHILD_BITS | (uint32_t)child;
}

// Puts the children that are met on the stack, between its entries from `base` on, the nearest on top. Returns the new top.
FE_COMPILED_FOR int32_t push_children(question q, const cast *c, int32_t child, entry *stack, int32_t base, int32_t top)
{
    _Alignas(32) float t[FE_TREE_WIDTH];
    const int32_t tree = child >> SECOND_BIT, tag = child & SECOND;
    const fe__tree_node *node = &c->nodes[tree][child ^ tag];
    for (uint32_t hits = meet_lanes(q, c, tree, node, t); hits; hits &= hits - 1) {
        uint32_t lane = (uint32_t)__builtin_ctz(hits);
        entry e = entry_of(t[lane], node->child[lane] | tag); // a proxy, inverted, has the bit already
        for (int32_t i = base; i < top; ++i) {
            entry there = stack[i];
            stack[i] = there > e ? there : e;
            e = there > e ? e : there;
        }
        stack[top++] = e;
    }
    return top;
}

FE_COMPILED_FOR void walk(question q, cast *c, int32_t tree_count)
{
    entry stack[STACK];
    int32_t top = 0;
    for (int32_t i = 0; i < tree_count; ++i) top = push_children(q, c, i << SECOND_BIT, stack, 0, top);
    while (top > 0) {
        entry next = stack[--top];
        int32_t child = (int32_t)(uint32_t)next;
        if (next > entry_of(c->limit_up * slack, -1)) continue;
        if (child < 0) {
            visit_proxy(q, c, ~child);
            if (c->limit < 0.0) return;
        } else if (top > STACK - FE_TREE_WIDTH) {
            walk_without_stack(q, c, child >> SECOND_BIT, child & ~SECOND);
            if (c->limit < 0.0) return;
        } else {
            top = push_children(q, c, child, stack, top, top);
        }
    }
}

static int32_t is_same(fe_dvec3 a, fe_dvec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static double sweep(const fe__tree *const *trees, int32_t tree_count, const fe__tree_way *way, double limit, fe__tree_ray_visit visit,
                    void *context)
{
    cast c; // every field is set: zeroing it first would cost a tenth of a ray
    c.limit = limit, c.limit_up = fe__tree_round_up(limit), c.visit = visit, c.context = context;
    prepare_direction(&c.way, way->translation);
    int32_t count = 0;
    for (int32_t i = 0; i < tree_count && limit >= 0.0; ++i) {
        if (trees[i]->proxy_count == 0) continue;
        c.nodes[count] = trees[i]->nodes;
        int32_t shared = count > 0 && is_same(trees[0]->origin, trees[i]->origin);
        if (!shared) prepare_slabs(&c.slabs[count], &c.way, fe__dsub(way->origin, trees[i]->origin), way->half);
        c.slabs_of[count] = &c.slabs[shared ? 0 : count];
        count += 1;
    }
    walk(RAY, &c, count);
    return c.limit;
}

static double nearest(const fe__tree *tree, fe_dvec3 point, double limit, fe__tree_ray_visit visit, void *context)
{
    if (tree->proxy_count == 0 || limit < 0.0) return limit;
    fe_dvec3 o = fe__dsub(point, tree->origin);
    cast c;
    c.nodes[0] = tree->nodes, c.limit = limit, c.limit_up = square_up(limit), c.visit = visit, c.context = context;
    const double at[3] = {o.x, o.y, o.z};
    for (int32_t k = 0; k < 3; ++k) {
        c.slabs[0].near_origin[k] = fe__quad_set(fe__tree_round_up(at[k]));
        c.slabs[0].far_origin[k] = fe__quad_set(fe__tree_round_down(at[k]));
    }
    c.slabs_of[0] = &c.slabs[0];
    walk(NEAREST, &c, 1);
    return c.limit;
}

const fe__tree_kernels FE_NAME(fe__tree_kernels) = {sweep, nearest};
