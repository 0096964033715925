// tree_ray.simd.c - which proxies' boxes a segment, or a box that moves along it, meets, nearest first.
//
// Slabs: along axis k the segment is between two planes for t in [(low - o) / d, (high - o) / d]. Floats, on the safe
// side: o is rounded both ways and each plane takes the side that widens the interval; the quotients' roundings are
// covered by `slack`. Little work is done per ray, so mispredicted branches and the set-up are the cost: the signs of
// the direction, which are random, do not branch. Compiled once per SIMD set: the widest test a node in one go. What is
// visited is the same with all of them.
#include "broadphase/tree_node.h"
#include "core/simd.h"

enum { ROW = FE_TREE_WIDTH * sizeof(float) };
enum { STACK = 256 }; // 7 entries a level: enough for a depth of 36

// five roundings of 2^-24 on each side of near <= far
static const float slack = 1.000001f;
// A component that moves less than FE_TREE_PAD in the whole segment moves as much: boxes and origin are swelled by
// more. The finite inverse keeps 0 * inverse = 0, never NaN.
static const float shortest_translation = (float)FE_TREE_PAD;
// m: the rounding of a denormal quotient (7e-46) stays below FE_TREE_PAD
static const float longest_translation = 1e24f;

// x y z, the fourth is not used. A walk reads them one by one from memory, where loads spread them over all lanes.
typedef struct slabs {
    _Alignas(16) float near_origin[4], far_origin[4];
} slabs;

// The rows of a node's box, in bytes, by the signs of a direction: row k or k + 3, and the other.
typedef struct rows {
    _Alignas(64) int64_t near_row[3];
    int64_t far_row[3];
} rows;
#define FE_NEAR(signs, k) (ROW * ((k) + 3 * ((signs) >> (k)&1)))
#define FE_FAR(signs, k) (ROW * ((k) + 3 - 3 * ((signs) >> (k)&1)))
#define FE_ROWS(signs)                                             \
    {                                                              \
        {FE_NEAR(signs, 0), FE_NEAR(signs, 1), FE_NEAR(signs, 2)}, \
        {                                                          \
            FE_FAR(signs, 0), FE_FAR(signs, 1), FE_FAR(signs, 2)   \
        }                                                          \
    }
static const rows rows_of[] = {FE_ROWS(0), FE_ROWS(1), FE_ROWS(2), FE_ROWS(3),
                               FE_ROWS(4), FE_ROWS(5), FE_ROWS(6), FE_ROWS(7)};
enum { SIGNS = 7 };

// Of a way, whatever the tree
typedef struct direction {
    _Alignas(16) float inverse[4], far_inverse[4]; // the second with `slack`
    const rows *rows;
    fe__quad_int backwards, blind; // blind: too fast for floats, excludes nothing
} direction;

// A child that waits: the bits of t, which order as t does, above those of the child. So entries compare, and change
// places, as integers, without a branch on t, which nothing predicts.
typedef uint64_t entry;
enum { CHILD_BITS = 32 };
#define FE_STACK_END UINT64_MAX // beyond every limit

// The trees of one walk. A node of the second one is told from one of the first by a bit of its index.
enum { MOST_TREES = 2, SECOND_BIT = 30, SECOND = 1 << SECOND_BIT };
typedef struct cast {
    const fe__tree_node *nodes[MOST_TREES];
    direction way;
    const slabs *slabs_of[MOST_TREES];
    slabs slabs[MOST_TREES];
    double limit;
    float limit_up; // rounded up, with `slack`; of a nearest search squared, m2
    entry last;     // what waits at the limit; farther is what is above
    fe__tree_ray_visit visit;
    void *context;
} cast;

// What a walk asks of the boxes: where a ray enters them, or how far they are from a point. Each walk is compiled for
// each question.
typedef enum question { RAY, NEAREST } question;
#define FE_COMPILED_FOR static inline __attribute__((always_inline))
// What hardly ever happens keeps its registers to itself.
#define FE_RARE static __attribute__((noinline, cold))

// One by one: the caller has just written them so, and a load of two at once would wait until they are in the cache.
// The fourth is not used.
static inline fe__quad narrow(double x, double y, double z)
{
    float last = (float)z;
    return (fe__quad){(float)x, (float)y, last, last};
}

static inline void prepare_direction(direction *way, const fe_dvec3 *translation)
{
    const fe__quad fast = fe__quad_set(longest_translation), slow = fe__quad_set(shortest_translation);
    const fe__quad d = narrow(translation->x, translation->y, translation->z);
    fe__quad_int sign = (fe__quad_int)d & INT32_MIN;
    fe__quad size = fe__quad_min(fe__quad_max((fe__quad)((fe__quad_int)d & INT32_MAX), slow), fast);
    *(fe__quad *)way->inverse = (fe__quad)((fe__quad_int)(1.0f / size) | sign);
    *(fe__quad *)way->far_inverse = (fe__quad)((fe__quad_int)(slack / size) | sign);
    way->rows = &rows_of[fe__quad_signs(sign) & SIGNS];
    way->backwards = sign >> 31;
    way->blind = size >= fast;
}

static inline void set_slabs(slabs *s, const direction *way, fe__quad low, fe__quad high)
{
    fe__quad_int exchange = ((fe__quad_int)low ^ (fe__quad_int)high) & way->backwards;
    *(fe__quad *)s->near_origin = (fe__quad)((fe__quad_int)high ^ exchange);
    *(fe__quad *)s->far_origin = (fe__quad)((fe__quad_int)low ^ exchange);
}

FE_RARE void prepare_far_slabs(slabs *s, const direction *way, const fe__tree_way *box, const fe_dvec3 *tree)
{
    fe_dvec3 o = fe__dsub(box->origin, *tree), half = box->half;
    fe__quad low = {fe__tree_round_down(o.x - half.x), fe__tree_round_down(o.y - half.y),
                    fe__tree_round_down(o.z - half.z), 0.0f};
    fe__quad high = {fe__tree_round_up(o.x + half.x), fe__tree_round_up(o.y + half.y), fe__tree_round_up(o.z + half.z),
                     0.0f};
    low = fe__quad_choose(way->blind, fe__quad_set(-FLT_MAX), low);
    high = fe__quad_choose(way->blind, fe__quad_set(FLT_MAX), high);
    set_slabs(s, way, low, high);
}

// A box that moves meets another when its centre meets that one swelled by its half widths: the origin is an interval
// to begin with, from o - half to o + half, rounded outwards. Three roundings, each of 2^-24 of |o| + half at most: to
// floats, of the sum or difference, and of the last step outwards.
static inline void prepare_slabs(slabs *s, const direction *way, const fe__tree_way *box, const fe_dvec3 *tree)
{
    const float four_roundings = 0x1p-22f;
    fe__quad o = narrow(box->origin.x - tree->x, box->origin.y - tree->y, box->origin.z - tree->z);
    fe__quad half = narrow(box->half.x, box->half.y, box->half.z),
             size = (fe__quad)((fe__quad_int)o & INT32_MAX) + half;
    fe__quad away = size * four_roundings + fe__quad_set((float)FE_TREE_PAD);
    if (fe__quad_signs((size >= fe__quad_set((float)FE_TREE_FAR)) | way->blind))
        prepare_far_slabs(s, way, box, tree);
    else
        set_slabs(s, way, (o - half) - away, (o + half) + away);
}

FE_COMPILED_FOR void clip(const char *box, const direction *way, const slabs *s, int32_t k, fe__eight *enter,
                          fe__eight *leave)
{
    fe__eight near_side = fe__eight_load((const float *)(const void *)(box + way->rows->near_row[k]));
    fe__eight far_side = fe__eight_load((const float *)(const void *)(box + way->rows->far_row[k]));
    fe__eight inverse = fe__eight_spread(&way->inverse[k]), far_inverse = fe__eight_spread(&way->far_inverse[k]);
    // in this order a -0 does not replace 0
    *enter =
        fe__eight_max(fe__eight_mul(fe__eight_sub(near_side, fe__eight_spread(&s->near_origin[k])), inverse), *enter);
    *leave =
        fe__eight_min(fe__eight_mul(fe__eight_sub(far_side, fe__eight_spread(&s->far_origin[k])), far_inverse), *leave);
}

// bit i: the segment meets lane i, at t[i] or later
FE_COMPILED_FOR uint32_t hit_lanes(const fe__tree_node *node, const direction *way, const slabs *s, float limit,
                                   float t[FE_TREE_WIDTH])
{
    const char *box = (const char *)node->box;
    fe__eight enter = fe__eight_set(0.0f), leave = fe__eight_set(limit);
    clip(box, way, s, 0, &enter, &leave);
    clip(box, way, s, 1, &enter, &leave);
    clip(box, way, s, 2, &enter, &leave);
    fe__eight_store(t, enter);
    return fe__eight_at_most(enter, leave);
}

// The squared distance is  sum_k max(low_k - p_k, p_k - high_k, 0)^2. The origin's two roundings are in near_origin and
// far_origin.
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
    return fe__eight_at_most(square, fe__eight_set(limit));
}

FE_COMPILED_FOR uint32_t meet_lanes(question q, const cast *c, int32_t tree, const fe__tree_node *node,
                                    float t[FE_TREE_WIDTH])
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

static inline entry entry_of(float t, int32_t child)
{
    union {
        float t;
        uint32_t bits;
    } u = {t};
    return (entry)u.bits << CHILD_BITS | (uint32_t)child;
}

// A ray's limit is 1 at most.
FE_COMPILED_FOR void set_limit(question q, cast *c, double limit)
{
    c->limit = limit;
    c->limit_up = slack * (q == RAY ? (float)(limit + (limit * FE_TREE_ULP + FE_TREE_PAD)) : square_up(limit));
    c->last = entry_of(c->limit_up, -1);
}

FE_COMPILED_FOR void visit_proxy(question q, cast *c, int32_t proxy)
{
    set_limit(q, c, c->visit(c->context, proxy, c->limit));
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

// The child in a lane of `node`; NULL: of all roots, lane after lane.
FE_COMPILED_FOR int32_t child_in(const cast *c, const fe__tree_node *node, int32_t tag, uint32_t lane)
{
    if (node) return node->child[lane] | tag; // a proxy, inverted, has the tag already
    return c->nodes[lane / FE_TREE_WIDTH]->child[lane % FE_TREE_WIDTH] | (int32_t)(lane / FE_TREE_WIDTH << SECOND_BIT);
}

static inline entry least(entry a, entry b) { return a > b ? b : a; }
static inline entry greatest(entry a, entry b) { return a > b ? a : b; }

// A node that waits on the stack is mostly visited, some time later: then it is there. Of a proxy, the root is asked
// for again.
FE_COMPILED_FOR void ask_for(const cast *c, entry waiting)
{
    const int32_t child = (int32_t)(uint32_t)waiting;
    const fe__tree_node *node = c->nodes[child >> SECOND_BIT & 1] + (child < 0 ? 0 : child & ~SECOND);
    __builtin_prefetch(node->box[0]);
    __builtin_prefetch(node->box[2]);
    __builtin_prefetch(node->box[4]);
    __builtin_prefetch(node->child);
}

// The nearest of the children that are met, at least one; the others go on the stack, the nearer the higher. Whether
// there is a second is as random as the ray: nothing branches on it. The nearest is not read back from the stack: the
// next node waits for it.
FE_COMPILED_FOR entry choose(const cast *c, const fe__tree_node *node, int32_t tag, uint32_t hits, const float *t,
                             entry *stack, int32_t *top)
{
    const int32_t base = *top;
    const uint32_t others = hits & (hits - 1), first = (uint32_t)__builtin_ctz(hits);
    const uint32_t alone = others == 0; // then the second is the first again, and not counted
    const uint32_t second = (uint32_t)__builtin_ctz(others | (hits & -alone));
    const entry a = entry_of(t[first], child_in(c, node, tag, first));
    const entry b = entry_of(t[second], child_in(c, node, tag, second)) | -(entry)alone;
    entry nearest = least(a, b);
    stack[base] = greatest(a, b);
    int32_t end = base + 1 - (int32_t)alone;
    if (node) ask_for(c, alone ? nearest : stack[base]);
    for (uint32_t more = others & (others - 1); more; more &= more - 1) {
        uint32_t lane = (uint32_t)__builtin_ctz(more);
        entry e = entry_of(t[lane], child_in(c, node, tag, lane)), farther = greatest(nearest, e);
        nearest = least(nearest, e);
        for (int32_t i = base; i < end; ++i) {
            entry there = stack[i];
            stack[i] = greatest(there, farther);
            farther = least(there, farther);
        }
        stack[end++] = farther;
    }
    *top = end;
    return nearest;
}

// bit i * 8 + lane: of tree i
FE_COMPILED_FOR uint32_t meet_roots(question q, const cast *c, int32_t tree_count, float *t)
{
    uint32_t hits = 0;
    for (int32_t i = 0; i < tree_count; ++i)
        hits |= meet_lanes(q, c, i, c->nodes[i], t + i * FE_TREE_WIDTH) << i * FE_TREE_WIDTH;
    return hits;
}

// From one child to the nearest of its own; from a proxy, or where nothing is met, to what waits on the stack.
FE_COMPILED_FOR void walk(question q, cast *c, int32_t tree_count)
{
    _Alignas(32) float t[MOST_TREES * FE_TREE_WIDTH];
    uint32_t hits = meet_roots(q, c, tree_count, t);
    if (!hits) return;
    entry stack[STACK];
    stack[0] = FE_STACK_END;
    int32_t top = 1;
    entry next = choose(c, NULL, 0, hits, t, stack, &top);
    int32_t in_order = top; // below it the stack is, since the roots
    for (;;) {
        int32_t child = (int32_t)(uint32_t)next;
        if (child < 0) {
            visit_proxy(q, c, ~child);
            if (c->limit < 0.0) return;
        } else if (top > STACK - FE_TREE_WIDTH) {
            walk_without_stack(q, c, child >> SECOND_BIT, child & ~SECOND);
            if (c->limit < 0.0) return;
        } else {
            const int32_t tree = child >> SECOND_BIT, tag = child & SECOND;
            // no load by an index that is just known
            const fe__tree_node *node = (tree ? c->nodes[1] : c->nodes[0]) + (child ^ tag);
            __builtin_prefetch(node->child); // of which one is read once the boxes are known
            hits = meet_lanes(q, c, tree, node, t);
            if (hits) {
                next = choose(c, node, tag, hits, t, stack, &top);
                continue;
            }
        }
        do next = stack[--top];
        while (next > c->last && top >= in_order);
        if (next > c->last) return; // as is all that waits below
        in_order = top < in_order ? top : in_order;
    }
}

static int32_t is_same(fe_dvec3 a, fe_dvec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static double sweep(const fe__tree *const *trees, int32_t tree_count, const fe__tree_way *way, double limit,
                    fe__tree_ray_visit visit, void *context)
{
    if (limit < 0.0) return limit;
    cast c; // every field is set: zeroing it first would cost a tenth of a ray
    c.visit = visit, c.context = context;
    set_limit(RAY, &c, limit);
    prepare_direction(&c.way, &way->translation);
    int32_t count = 0;
    for (int32_t i = 0; i < tree_count; ++i) {
        if (trees[i]->proxy_count == 0) continue;
        c.nodes[count] = trees[i]->nodes;
        int32_t shared = count > 0 && is_same(trees[0]->origin, trees[i]->origin);
        if (!shared) prepare_slabs(&c.slabs[count], &c.way, way, &trees[i]->origin);
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
    c.nodes[0] = tree->nodes, c.visit = visit, c.context = context;
    set_limit(NEAREST, &c, limit);
    const double at[3] = {o.x, o.y, o.z};
    for (int32_t k = 0; k < 3; ++k) {
        c.slabs[0].near_origin[k] = fe__tree_round_up(at[k]);
        c.slabs[0].far_origin[k] = fe__tree_round_down(at[k]);
    }
    c.slabs_of[0] = &c.slabs[0];
    walk(NEAREST, &c, 1);
    return c.limit;
}

fe__tree_query_kernel FE_NAME(fe__tree_query); // tree_query.simd.c
const fe__tree_kernels FE_NAME(fe__tree_kernels) = {FE_NAME(fe__tree_query), sweep, nearest};
