// tree_ray.c - which proxies' boxes a segment, or a box that moves along it, meets, nearest first.
//
// Slabs: along axis k the segment is between two planes for t in [(low - o) / d, (high - o) / d]. Floats, on the safe side: o is rounded
// both ways and each plane takes the side that widens the interval; the quotients' roundings are covered by `slack`. Little work is done
// per ray, so mispredicted branches and the set-up are the cost: the signs of the direction, which are random, do not branch.
#include "broadphase/tree_node.h"

enum { ROW = FE_TREE_WIDTH * sizeof(float) };
enum { STACK = 256 }; // 7 entries a level: enough for a depth of 36

// four roundings of 2^-24 on each side of near <= far
static const float slack = 1.000001f;
// A component that moves less than FE_TREE_PAD in the whole segment does not move: boxes and origin are swelled by more. The finite inverse
// keeps 0 * inverse = 0, never NaN.
static const float largest_inverse = (float)(1.0 / FE_TREE_PAD);
// m: the rounding of a denormal quotient (7e-46) stays below FE_TREE_PAD
static const double longest_translation = 1e24;

// The same for all lanes.
typedef struct slabs {
    fe__quad near_origin[3], far_origin[3], inverse[3];
    int64_t near_row[3]; // of a node's box, in bytes: row k or k + 3; the far one is the other
} slabs;

// Of a way, whatever the tree
typedef struct direction {
    fe__quad inverse;
    fe__quad_int backwards, blind; // blind: too fast for floats, excludes nothing
    uint32_t is_blind;             // any
    int64_t near_row[3];
} direction;

typedef struct entry {
    float t;
    int32_t child;
} entry;

typedef struct cast {
    const fe__tree *tree;
    slabs slabs;
    double limit;
    float limit_up; // rounded up; of a nearest search squared, m2
    fe__tree_ray_visit visit;
    void *context;
} cast;

// What a walk asks of the boxes: where a ray enters them, or how far they are from a point. Each walk is compiled for each question.
typedef enum question { RAY, NEAREST } question;
#define FE_COMPILED_FOR static inline __attribute__((always_inline))

static float narrow(double x) { return (float)fe__maxd(fe__mind(x, longest_translation), -longest_translation); }

typedef double pair __attribute__((vector_size(16)));
typedef int64_t pair_mask __attribute__((vector_size(16)));
typedef float pair_float __attribute__((vector_size(8)));

static inline fe__quad quad_of(pair xy, pair z)
{
    return __builtin_shufflevector(__builtin_convertvector(xy, pair_float), __builtin_convertvector(z, pair_float), 0, 1, 2, 3);
}

// From o - half to o + half, rounded outwards: as fe__tree_round_down and fe__tree_round_up do it, but two coordinates at once, and with
// one allowance for both sides.
static inline void round_outwards(fe_dvec3 o, fe_dvec3 half, fe__quad *low, fe__quad *high)
{
    const pair_mask magnitude = {INT64_MAX, INT64_MAX};
    const pair o_xy = {o.x, o.y}, o_z = {o.z, o.z}, half_xy = {half.x, half.y}, half_z = {half.z, half.z};
    pair size_xy = (pair)((pair_mask)o_xy & magnitude) + half_xy, size_z = (pair)((pair_mask)o_z & magnitude) + half_z;
    pair away_xy = size_xy * FE_TREE_ULP + FE_TREE_PAD, away_z = size_z * FE_TREE_ULP + FE_TREE_PAD;
    *low = quad_of((o_xy - half_xy) - away_xy, (o_z - half_z) - away_z);
    *high = quad_of((o_xy + half_xy) + away_xy, (o_z + half_z) + away_z);
    if (fe__maxd(fe__maxd(size_xy[0], size_xy[1]), size_z[0]) < FE_TREE_FAR) return;
    *low = (fe__quad){fe__tree_round_down(o.x - half.x), fe__tree_round_down(o.y - half.y), fe__tree_round_down(o.z - half.z), 0.0f};
    *high = (fe__quad){fe__tree_round_up(o.x + half.x), fe__tree_round_up(o.y + half.y), fe__tree_round_up(o.z + half.z), 0.0f};
}

static inline direction direction_of(fe_dvec3 translation)
{
    const fe__quad d = {narrow(translation.x), narrow(translation.y), narrow(translation.z), 1.0f};
    const fe__quad fast = fe__quad_set((float)longest_translation), slow = fe__quad_set((float)FE_TREE_PAD);
    fe__quad_int backwards = d < fe__quad_set(0.0f), moves = (d > slow) | (d < -slow);
    fe__quad still = (fe__quad)((fe__quad_int)fe__quad_set(largest_inverse) | (backwards & INT32_MIN));
    fe__quad_int blind = (d >= fast) | (d <= -fast);
    int64_t bits = fe__quad_signs(backwards);
    return (direction){.inverse = fe__quad_choose(moves, 1.0f / d, still),
                       .backwards = backwards,
                       .blind = blind,
                       .is_blind = fe__quad_signs(blind),
                       .near_row = {ROW * 3 * (bits & 1), ROW * (1 + 3 * (bits >> 1 & 1)), ROW * (2 + 3 * (bits >> 2 & 1))}};
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
    fe__quad inverse = way->inverse; // spread one by one: gcc does not unroll the loop
    s->near_origin[0] = fe__quad_set(near_origin[0]), s->far_origin[0] = fe__quad_set(far_origin[0]),
    s->inverse[0] = fe__quad_set(inverse[0]);
    s->near_origin[1] = fe__quad_set(near_origin[1]), s->far_origin[1] = fe__quad_set(far_origin[1]),
    s->inverse[1] = fe__quad_set(inverse[1]);
    s->near_origin[2] = fe__quad_set(near_origin[2]), s->far_origin[2] = fe__quad_set(far_origin[2]),
    s->inverse[2] = fe__quad_set(inverse[2]);
    s->near_row[0] = way->near_row[0], s->near_row[1] = way->near_row[1], s->near_row[2] = way->near_row[2];
}

FE_COMPILED_FOR void clip(const char *rows, const slabs *s, int32_t k, fe__quad *enter, fe__quad *leave)
{
    fe__quad near_side = *(const fe__quad *)(rows + s->near_row[k]),
             far_side = *(const fe__quad *)(rows + (2 * k + 3) * ROW - s->near_row[k]);
    *enter = fe__quad_max(*enter, (near_side - s->near_origin[k]) * s->inverse[k]);
    *leave = fe__quad_min(*leave, (far_side - s->far_origin[k]) * s->inverse[k]);
}

// Four lanes at a time: eight, and what they are compared with, are more than the registers of SSE2, and the way through memory would be
// the slowest part.
FE_COMPILED_FOR uint32_t hit_four(const char *rows, const slabs *s, float limit, float t[4])
{
    fe__quad enter = fe__quad_set(0.0f), leave = fe__quad_set(limit);
    clip(rows, s, 0, &enter, &leave);
    clip(rows, s, 1, &enter, &leave);
    clip(rows, s, 2, &enter, &leave);
    *(fe__quad *)t = enter;
    return fe__quad_signs(enter <= leave * fe__quad_set(slack));
}

// bit i: the segment meets lane i, at t[i] or later
FE_COMPILED_FOR uint32_t hit_lanes(const fe__tree_node *node, const slabs *s, float limit, float t[FE_TREE_WIDTH])
{
    const char *rows = (const char *)node->box;
    return hit_four(rows, s, limit, t) | hit_four(rows + sizeof(fe__quad), s, limit, t + 4) << 4;
}

// The squared distance is  sum_k max(low_k - p_k, p_k - high_k, 0)^2. The origin's two roundings are in near_origin and far_origin.
static inline uint32_t near_lanes(const fe__tree_node *node, const slabs *s, float limit, float t[FE_TREE_WIDTH])
{
    fe__lanes square = fe__lanes_set(0.0f), zero = square;
    for (int32_t k = 0; k < 3; ++k) {
        const fe__lanes near_origin = {s->near_origin[k], s->near_origin[k]}, far_origin = {s->far_origin[k], s->far_origin[k]};
        fe__lanes below = fe__lanes_sub(fe__lanes_load(node->box[k]), near_origin);
        fe__lanes above = fe__lanes_sub(far_origin, fe__lanes_load(node->box[3 + k]));
        fe__lanes away = fe__lanes_max(fe__lanes_max(below, above), zero);
        square = fe__lanes_add(square, fe__lanes_mul(away, away));
    }
    fe__lanes_store(t, square);
    return fe__lanes_at_most(square, fe__lanes_set(limit * slack));
}

FE_COMPILED_FOR uint32_t meet_lanes(question q, const cast *c, const fe__tree_node *node, float t[FE_TREE_WIDTH])
{
    return q == RAY ? hit_lanes(node, &c->slabs, c->limit_up, t) : near_lanes(node, &c->slabs, c->limit_up, t);
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
FE_COMPILED_FOR void walk_without_stack(question q, cast *c, int32_t top)
{
    _Alignas(16) float t[FE_TREE_WIDTH];
    int32_t index = top;
    uint32_t from = 0;
    for (;;) {
        const fe__tree_node *node = &c->tree->nodes[index];
        uint32_t hits = meet_lanes(q, c, node, t) >> from << from;
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

// Puts the children of the lanes in `hits` on the stack, nearest on top, and gives back the nearest of all instead of pushing it.
static inline int32_t push_farther(const fe__tree_node *node, uint32_t hits, const float t[FE_TREE_WIDTH], entry *stack, int32_t *top)
{
    uint32_t lane = (uint32_t)__builtin_ctz(hits);
    entry nearest = {t[lane], node->child[lane]};
    int32_t base = *top;
    for (hits &= hits - 1; hits; hits &= hits - 1) {
        lane = (uint32_t)__builtin_ctz(hits);
        entry e = {t[lane], node->child[lane]};
        if (e.t < nearest.t) {
            entry swapped = e;
            e = nearest;
            nearest = swapped;
        }
        int32_t i = (*top)++;
        for (; i > base && stack[i - 1].t < e.t; --i) stack[i] = stack[i - 1];
        stack[i] = e;
    }
    return nearest.child;
}

FE_COMPILED_FOR void walk(question q, cast *c)
{
    _Alignas(16) float t[FE_TREE_WIDTH];
    entry stack[STACK];
    int32_t top = 0, child = 0;
    for (;;) {
        while (child >= 0) {
            if (top > STACK - FE_TREE_WIDTH) {
                walk_without_stack(q, c, child);
                break;
            }
            const fe__tree_node *node = &c->tree->nodes[child];
            uint32_t hits = meet_lanes(q, c, node, t);
            if (!hits) break;
            child = push_farther(node, hits, t, stack, &top);
        }
        if (child < 0) visit_proxy(q, c, ~child);
        do {
            if (top == 0) return;
            top -= 1;
        } while (stack[top].t > c->limit_up * slack);
        child = stack[top].child;
    }
}

double fe__tree_sweep(const fe__tree *const *trees, int32_t tree_count, const fe__tree_way *way, double limit, fe__tree_ray_visit visit,
                      void *context)
{
    direction d = direction_of(way->translation);
    cast c; // every field is set: zeroing it first would cost a tenth of a ray
    c.limit = limit, c.limit_up = fe__tree_round_up(limit), c.visit = visit, c.context = context;
    for (int32_t i = 0; i < tree_count && c.limit >= 0.0; ++i) {
        c.tree = trees[i];
        if (c.tree->proxy_count == 0) continue;
        prepare_slabs(&c.slabs, &d, fe__dsub(way->origin, c.tree->origin), way->half);
        walk(RAY, &c);
    }
    return c.limit;
}

double fe__tree_nearest(const fe__tree *tree, fe_dvec3 point, double limit, fe__tree_ray_visit visit, void *context)
{
    if (tree->proxy_count == 0 || limit < 0.0) return limit;
    fe_dvec3 o = fe__dsub(point, tree->origin);
    cast c;
    c.tree = tree, c.limit = limit, c.limit_up = square_up(limit), c.visit = visit, c.context = context;
    const double at[3] = {o.x, o.y, o.z};
    for (int32_t k = 0; k < 3; ++k) {
        c.slabs.near_origin[k] = fe__quad_set(fe__tree_round_up(at[k]));
        c.slabs.far_origin[k] = fe__quad_set(fe__tree_round_down(at[k]));
    }
    walk(NEAREST, &c);
    return c.limit;
}
