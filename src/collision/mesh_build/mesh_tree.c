// mesh_tree.c - triangles sorted into leaves, and the nodes above them.
//
// Top down: a part is cut in two, and its costliest part again, until there are eight or all are small enough for what
// comes below: parts of 32 triangles become nodes over leaves, parts of 4 leaves. A cut lies where the sum of
// area x count of both sides is least (the surface area heuristic), tried at the borders of bins along the longest axis
// of the centres (Wald 2007), and is moved to the nearest whole number of what comes below. So all nodes over leaves
// and all leaves but the last are full, and their number is known before. What decides is the order of the
// triangles of a part, which is the caller's, cut after cut: whoever cuts a part, it falls in the same pieces.
//
// Parts at HALVED_DEPTH and below are halved: 27 more levels hold 2^27 triangles.
#include "collision/mesh_build/mesh_build.h"
#include "core/lanes.h"

enum {
    BINS = 16,
    BOTTOM = FE__MESH_WIDTH * FE__MESH_LEAF, // triangles of a node over leaves
    HALVED_DEPTH = 32,
};
_Static_assert(HALVED_DEPTH + 27 < FE__MESH_DEPTH, "halving 2^27 triangles ends in time");

typedef struct item {
    union {
        fe__quad low_and_number;
        struct {
            float low[3];
            uint32_t number;
        };
    };
    fe__quad high;
} item;
_Static_assert(sizeof(item) == 32, "two quads");

// items [first, first + count), the box around them and that around their doubled centres
typedef struct part {
    fe__quad low, high, centre_low, centre_high;
    int32_t first, count;
} part;

typedef struct builder {
    fe__mesh_builder *mesh;
    item *items;
} builder;

static int32_t pieces(int32_t count, int32_t size) { return (int32_t)(((int64_t)count + size - 1) / size); }

// Nodes over leaves, and above them at most as many less one, as each has two children or more
int32_t fe__mesh_node_room(int32_t triangle_count) { return 2 * pieces(triangle_count, BOTTOM); }

int64_t fe__mesh_tree_size(const fe__mesh_source *s) { return (int64_t)sizeof(item) * s->triangle_count; }

// ---- parts ---------------------------------------------------------------------------------------------------------
// Without the number's bits, which may be those of a NaN
static fe__quad low_of(const item *i)
{
    const fe__quad_int xyz = {-1, -1, -1, 0};
    return (fe__quad)((fe__quad_int)i->low_and_number & xyz);
}

static float centre_of(const item *i, int32_t axis) { return i->low[axis] + i->high[axis]; }

static part part_of(const item *items, int32_t first, int32_t count)
{
    part p = {
        fe__quad_set(INFINITY), fe__quad_set(-INFINITY), fe__quad_set(INFINITY), fe__quad_set(-INFINITY), first, count};
    for (int32_t i = first; i < first + count; ++i) {
        fe__quad low = low_of(items + i), high = items[i].high, centre = low + high;
        p.low = fe__quad_min(p.low, low), p.high = fe__quad_max(p.high, high);
        p.centre_low = fe__quad_min(p.centre_low, centre), p.centre_high = fe__quad_max(p.centre_high, centre);
    }
    return p;
}

static float area_of(fe__quad low, fe__quad high)
{
    fe__quad d = high - low;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

// ---- where to cut --------------------------------------------------------------------------------------------------
typedef struct binning {
    int32_t axis; // -1: the centres agree
    float start, scale;
} binning;

static int32_t longest_axis(const part *p)
{
    fe__quad d = p->centre_high - p->centre_low;
    return d[0] >= d[1] ? (d[0] >= d[2] ? 0 : 2) : (d[1] >= d[2] ? 1 : 2);
}

static binning choose_bins(const part *p)
{
    static const float largest_scale = 1e30f; // 1/m
    int32_t axis = longest_axis(p);
    float size = p->centre_high[axis] - p->centre_low[axis];
    float scale = (float)BINS * 0.99999f / size; // a little less than BINS: the last centre lies in the last bin
    return (binning){size > 0.0f && scale < largest_scale ? axis : -1, p->centre_low[axis], scale};
}

static int32_t bin_of(const binning *b, const item *i)
{
    float bin = (centre_of(i, b->axis) - b->start) * b->scale;
    return (int32_t)fe__maxf(fe__minf(bin, (float)(BINS - 1)), 0.0f);
}

typedef struct bin {
    fe__quad low, high;
    int32_t count;
} bin;

static bin no_bin(void) { return (bin){fe__quad_set(INFINITY), fe__quad_set(-INFINITY), 0}; }
static void swell(bin *b, fe__quad low, fe__quad high, int32_t count)
{
    b->low = fe__quad_min(b->low, low), b->high = fe__quad_max(b->high, high);
    b->count += count;
}

// The border before which bin to cut; 0: none leaves something on both sides
static int32_t cheapest_border(const bin bins[BINS], int32_t count)
{
    float right_cost[BINS];
    bin side = no_bin();
    for (int32_t k = BINS - 1; k > 0; --k) {
        swell(&side, bins[k].low, bins[k].high, bins[k].count);
        right_cost[k] = side.count > 0 ? area_of(side.low, side.high) * (float)side.count : 0.0f;
    }
    float best = INFINITY;
    int32_t border = 0;
    side = no_bin();
    for (int32_t k = 1; k < BINS; ++k) {
        swell(&side, bins[k - 1].low, bins[k - 1].high, bins[k - 1].count);
        if (side.count == 0 || side.count == count) continue;
        float cost = area_of(side.low, side.high) * (float)side.count + right_cost[k];
        if (cost < best) best = cost, border = k;
    }
    return border;
}

// The nearest whole number of `size`, with something on both sides
static int32_t rounded(int32_t wanted, int32_t count, int32_t size)
{
    int32_t most = (count - 1) / size * size, near = (wanted + size / 2) / size * size;
    return near < size ? size : near > most ? most : near;
}

// ---- cutting -------------------------------------------------------------------------------------------------------
static void swap(item *a, item *b)
{
    item swapped = *a;
    *a = *b;
    *b = swapped;
}

// How many of [first, end) lie in bins below the border: they come first. Each item is swapped, so that nothing is
// guessed of where it lies.
static int32_t partition(item *items, int32_t first, int32_t end, const binning *b, int32_t border)
{
    int32_t below = first;
    for (int32_t i = first; i < end; ++i) {
        int32_t is_below = bin_of(b, items + i) < border;
        swap(items + i, items + below);
        below += is_below;
    }
    return below - first;
}

// Few: the rank of each is how many come before it. Keys are the bits of centres, in their order; the last ones make
// room for the place, so that no two are equal.
enum { FEW = BOTTOM, PLACE_MASK = FEW - 1 };
static int32_t key_of(const item *i, int32_t axis, int32_t place)
{
    union {
        float value;
        int32_t bits;
    } centre = {centre_of(i, axis) + 0.0f};
    int32_t ordered = centre.bits ^ (centre.bits >> 31 & INT32_MAX);
    return (ordered & ~PLACE_MASK) | place;
}

static void sort_few(item *items, int32_t count, int32_t axis)
{
    int32_t key[FEW];
    item sorted[FEW];
    int32_t padded = (count + 3) / 4 * 4;
    for (int32_t i = 0; i < count; ++i) key[i] = key_of(items + i, axis, i);
    for (int32_t i = count; i < padded; ++i) key[i] = INT32_MAX; // before none
    for (int32_t i = 0; i < count; ++i) {
        fe__quad_int own = {key[i], key[i], key[i], key[i]}, before = {0};
        for (int32_t j = 0; j < padded; j += 4) {
            fe__quad_int four;
            memcpy(&four, key + j, sizeof four);
            before -= four < own;
        }
        sorted[before[0] + before[1] + before[2] + before[3]] = items[i];
    }
    memcpy(items, sorted, (size_t)count * sizeof *items);
}

static int32_t is_before(const item *a, const item *b, int32_t axis)
{
    float x = centre_of(a, axis), y = centre_of(b, axis);
    return x < y || (x == y && a->number < b->number);
}

// Hoare's find (1961): nothing of [first, target) comes after what is in [target, end). Pivots are drawn, so that no
// order of triangles is slow, and drawn alike wherever the part is cut.
static void find(item *items, int32_t first, int32_t end, int32_t target, int32_t axis)
{
    uint64_t random = (uint64_t)first;
    while (target > first && target < end) {
        if (end - first <= FEW) {
            sort_few(items + first, end - first, axis);
            return;
        }
        random = random * 0x5851f42d4c957f2du + 0x14057b7ef767814fu;
        item pivot = items[first + (int32_t)((random >> 32) * (uint64_t)(end - first) >> 32)];
        int32_t i = first, j = end - 1;
        while (i <= j) {
            while (is_before(items + i, &pivot, axis)) ++i;
            while (is_before(&pivot, items + j, axis)) --j;
            if (i <= j) swap(items + i++, items + j--);
        }
        if (target <= j)
            end = j + 1;
        else if (target >= i)
            first = i;
        else
            return; // between them lies the pivot
    }
}

static int32_t cut_at_bins(builder *b, const part *p, const binning *g, int32_t size)
{
    bin bins[BINS];
    for (int32_t k = 0; k < BINS; ++k) bins[k] = no_bin();
    for (int32_t i = p->first; i < p->first + p->count; ++i)
        swell(bins + bin_of(g, b->items + i), low_of(b->items + i), b->items[i].high, 1);
    int32_t border = cheapest_border(bins, p->count);
    if (border == 0) return 0;
    int32_t left = 0;
    for (int32_t k = 0; k < border; ++k) left += bins[k].count;
    int32_t target = rounded(left, p->count, size);
    int32_t first = p->first, end = p->first + p->count, middle = p->first + target;
    int32_t at = first + partition(b->items, first, end, g, border);
    // the triangles by which the whole number differs come from the bins next to the border
    while (at > middle && border > 0) {
        end = at;
        at = first + partition(b->items, first, end, g, --border);
    }
    while (at < middle && border < BINS) {
        first = at;
        at = first + partition(b->items, first, end, g, ++border);
    }
    if (at > middle) end = at;
    find(b->items, first, end, middle, g->axis);
    return target;
}

static void cut(builder *b, const part *p, int32_t depth, int32_t size, part *left, part *right)
{
    binning g = choose_bins(p);
    int32_t count = g.axis < 0 || depth >= HALVED_DEPTH || size == FE__MESH_LEAF ? 0 : cut_at_bins(b, p, &g, size);
    if (!count) {
        count = rounded(p->count / 2, p->count, size);
        find(b->items, p->first, p->first + p->count, p->first + count, longest_axis(p));
    }
    *left = part_of(b->items, p->first, count);
    *right = part_of(b->items, p->first + count, p->count - count);
}

// Parts of more than `size` triangles are cut until there are eight
static int32_t make_parts(builder *b, const part *whole, int32_t depth, int32_t size, part parts[FE__MESH_WIDTH])
{
    int32_t count = 1;
    parts[0] = *whole;
    while (count < FE__MESH_WIDTH) {
        int32_t best = -1;
        float best_cost = -1.0f;
        for (int32_t k = 0; k < count; ++k) {
            float cost = area_of(parts[k].low, parts[k].high) * (float)parts[k].count;
            if (parts[k].count > size && cost > best_cost) best = k, best_cost = cost;
        }
        if (best < 0) break;
        part left, right;
        cut(b, parts + best, depth, size, &left, &right);
        for (int32_t k = count; k > best + 1; --k) parts[k] = parts[k - 1]; // in the order of their triangles
        parts[best] = left, parts[best + 1] = right;
        count += 1;
    }
    return count;
}

// ---- nodes ---------------------------------------------------------------------------------------------------------
// The least step of which 255 reach from low to high
static int8_t exponent_for(double low, double high)
{
    int32_t exponent = FE__MESH_LEAST_EXPONENT;
    double step = 0x1p-40;
    while (low + 255.0 * step < high) step += step, exponent += 1;
    return (int8_t)exponent;
}

static void set_frame(fe__mesh_node *node, const fe__mesh_box *whole)
{
    for (int32_t k = 0; k < 3; ++k) {
        node->origin[k] = whole->low[k];
        node->exponent[k] = exponent_for((double)whole->low[k], (double)whole->high[k]);
    }
}

static void set_box(fe__mesh_node *node, int32_t lane, const fe__mesh_box *child)
{
    for (int32_t k = 0; k < 3; ++k) {
        double origin = (double)node->origin[k], step = fe__mesh_step(node, k);
        double low = (double)child->low[k], high = (double)child->high[k];
        int32_t from = (int32_t)fe__mind((low - origin) / step, 255.0);
        int32_t to = (int32_t)fe__mind((high - origin) / step, 255.0);
        while (from > 0 && origin + (double)from * step > low) --from;
        while (to < 255 && origin + (double)to * step < high) ++to;
        node->low[k][lane] = (uint8_t)from;
        node->high[k][lane] = (uint8_t)to;
    }
}

void fe__mesh_set_boxes(fe__mesh_node *node, const fe__mesh_box *whole, const fe__mesh_box *children)
{
    set_frame(node, whole);
    for (int32_t k = 0; k < node->count; ++k) set_box(node, k, children + k);
    for (int32_t k = node->count; k < FE__MESH_WIDTH; ++k)
        for (int32_t axis = 0; axis < 3; ++axis) node->low[axis][k] = 255; // and high 0: empty
}

static fe__mesh_box box_of(const part *p)
{
    return (fe__mesh_box){{p->low[0], p->low[1], p->low[2]}, {p->high[0], p->high[1], p->high[2]}};
}

static void fill_node(builder *b, uint32_t index, const part *whole, int32_t depth)
{
    fe__mesh *m = &b->mesh->mesh;
    m->depth = fe__maxi(m->depth, depth + 1);
    int32_t is_bottom = whole->count <= BOTTOM;
    part parts[FE__MESH_WIDTH];
    int32_t count = make_parts(b, whole, depth, is_bottom ? FE__MESH_LEAF : BOTTOM, parts);
    fe__mesh_node *node = b->mesh->nodes + index;
    node->count = (uint8_t)count;
    fe__mesh_box box = box_of(whole), boxes[FE__MESH_WIDTH];
    for (int32_t k = 0; k < count; ++k) boxes[k] = box_of(parts + k);
    fe__mesh_set_boxes(node, &box, boxes);
    node->first = is_bottom ? FE__MESH_LEAVES | (uint32_t)(whole->first / FE__MESH_LEAF) : (uint32_t)m->node_count;
    if (is_bottom) return;
    uint32_t first = node->first;
    m->node_count += count;
    for (int32_t k = 0; k < count; ++k) fill_node(b, first + (uint32_t)k, parts + k, depth + 1);
}

// ---- the whole -----------------------------------------------------------------------------------------------------
static void make_items(builder *b)
{
    fe__mesh_builder *m = b->mesh;
    int32_t count = 0, dropped = m->mesh.triangle_count;
    for (int32_t i = 0; i < m->source->triangle_count; ++i) {
        if (m->edges[i] == FE__MESH_DROPPED) {
            m->order[dropped++] = (uint32_t)i;
            continue;
        }
        fe_vec3 v[3];
        fe__mesh_welded_corners(m, i, v);
        item *made = b->items + count++;
        fe__quad p = {v[0].x, v[0].y, v[0].z, 0.0f}, q = {v[1].x, v[1].y, v[1].z, 0.0f}, r = {v[2].x, v[2].y, v[2].z};
        made->low_and_number = fe__quad_min(fe__quad_min(p, q), r);
        made->high = fe__quad_max(fe__quad_max(p, q), r);
        made->number = (uint32_t)i;
    }
}

void fe__mesh_build_tree(fe__mesh_builder *m)
{
    builder b = {.mesh = m, .items = m->scratch};
    make_items(&b);
    part whole = part_of(b.items, 0, m->mesh.triangle_count);
    m->mesh.low = (fe_vec3){whole.low[0], whole.low[1], whole.low[2]};
    m->mesh.high = (fe_vec3){whole.high[0], whole.high[1], whole.high[2]};
    m->mesh.node_count = 1;
    fill_node(&b, 0, &whole, 0);
    for (int32_t i = 0; i < m->mesh.triangle_count; ++i) m->order[i] = b.items[i].number;
}
