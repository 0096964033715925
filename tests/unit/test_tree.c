// The tree finds what a search through all boxes finds, each once, in whatever way it came to its form.
#include "fe_test.h"

#include "broadphase/tree.h"
#include "core/memory.h"
#include "solver/solver.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PROXIES = 700, CHURN = 6000, ALL = 60000 };

// ---- random boxes --------------------------------------------------------------------------------------------------
static uint64_t noise = 1;

static double uniform(double low, double high)
{
    noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (double)(noise >> 11) * 0x1p-53;
}

static int32_t below(int32_t n) { return (int32_t)uniform(0.0, (double)n); }

// Where boxes are, and whether on a grid, where sides, corners and distances are equal.
typedef struct place {
    fe_dvec3 centre;
    double size;
    int32_t grid;
} place;

static double coordinate(const place *p, double centre)
{
    double x = uniform(-p->size, p->size);
    return centre + (p->grid ? (double)(int64_t)x : x);
}

static fe_dvec3 any_point(const place *p)
{
    double x = coordinate(p, p->centre.x), y = coordinate(p, p->centre.y);
    return (fe_dvec3){x, y, coordinate(p, p->centre.z)};
}

static fe__bounds any_box(const place *p)
{
    fe_dvec3 c = any_point(p);
    double x = p->grid ? 1.0 : uniform(0.01, 1.5), y = p->grid ? 1.0 : uniform(0.01, 1.5),
           z = p->grid ? 0.5 : uniform(0.01, 1.5);
    if (below(200) == 0) x *= 20.0, z *= 20.0; // a floor
    return (fe__bounds){{c.x - x, c.y - y, c.z - z}, {c.x + x, c.y + y, c.z + z}};
}

static int32_t rebuild(fe__tree *tree, fe__memory *memory, int32_t force)
{
    return fe__trees_rebuild(&tree, 1, memory, force);
}

// ---- a tree and what should be in it -------------------------------------------------------------------------------
typedef struct model {
    fe__tree tree;
    fe__bounds box[PROXIES];
    int32_t present[PROXIES];
    int32_t visits[PROXIES]; // of the query in progress
} model;

static int32_t mark(void *context, int32_t proxy)
{
    model *m = context;
    m->visits[proxy] += 1;
    return 1;
}

static int32_t meets(const fe__bounds *a, const fe__bounds *b, double gap)
{
    return a->low.x <= b->high.x + gap && b->low.x <= a->high.x + gap && a->low.y <= b->high.y + gap &&
           b->low.y <= a->high.y + gap && a->low.z <= b->high.z + gap && b->low.z <= a->high.z + gap;
}

// How far a box may reach out of itself: 2^-23 of the coordinates relative to the origin, and the rounding of floats;
// as much for the query's box; twice that after the origin has moved.
static double largest_gap(const fe__tree *tree, const place *p)
{
    fe_dvec3 d = fe__dsub(p->centre, tree->origin);
    double far = fe__maxd(fe__maxd(fe__absd(d.x), fe__absd(d.y)), fe__absd(d.z)) + 40.0 + p->size;
    return 6.0 * 0x1p-23 * far + 1e-28;
}

// What meets the box is visited once; what is farther than the gap is not.
static void check_visits(model *m, const fe__bounds *box, double gap)
{
    for (int32_t i = 0; i < PROXIES; ++i) {
        int32_t visits = m->visits[i];
        m->visits[i] = 0;
        if (!m->present[i]) {
            assert_int_equal(visits, 0);
        } else if (meets(&m->box[i], box, 0.0)) {
            assert_int_equal(visits, 1);
        } else {
            FE_TRUE(visits == 0 || (visits == 1 && meets(&m->box[i], box, gap)));
        }
    }
}

static void check_query(model *m, const place *p)
{
    fe__bounds box = any_box(p);
    int32_t proxy = below(PROXIES);
    if (below(4) == 0) box.high = box.low; // a point
    if (below(2) && m->present[proxy]) {   // one that touches another at a corner only
        fe_dvec3 size = fe__dsub(box.high, box.low);
        box.low = box.high = below(2) ? m->box[proxy].high : m->box[proxy].low;
        below(2) ? (box.high = fe__dadd(box.low, size)) : (box.low = fe__dsub(box.high, size));
    }
    fe__tree_query(&m->tree, &box, mark, m);
    check_visits(m, &box, largest_gap(&m->tree, p));
}

static void check_query_proxy(model *m, const model *of, const place *p)
{
    int32_t proxy = below(PROXIES);
    if (!of->present[proxy]) return;
    fe__tree_query_proxy(&m->tree, &of->tree, proxy, mark, m);
    fe__bounds box;
    fe__tree_get(&of->tree, proxy, &box);
    const fe__bounds *exact = &of->box[proxy];
    FE_TRUE(box.low.x <= exact->low.x && box.low.y <= exact->low.y && box.low.z <= exact->low.z);
    FE_TRUE(box.high.x >= exact->high.x && box.high.y >= exact->high.y && box.high.z >= exact->high.z);
    check_visits(m, &of->box[proxy], largest_gap(&m->tree, p) + largest_gap(&of->tree, p));
}

// ---- rays ----------------------------------------------------------------------------------------------------------
typedef struct ray {
    model *m;
    fe_dvec3 origin, translation;
    double best; // limit before a hit
    int32_t hit; // lowest of those at `best`, -1: none
} ray;

// When the ray enters the box, exactly in the reals but for the divisions; -1: never. Long double, and the same for
// tree and search.
static double entry_of(const fe__bounds *b, const ray *r)
{
    const double low[3] = {b->low.x, b->low.y, b->low.z}, high[3] = {b->high.x, b->high.y, b->high.z};
    const double o[3] = {r->origin.x, r->origin.y, r->origin.z},
                 d[3] = {r->translation.x, r->translation.y, r->translation.z};
    long double enter = 0.0L, leave = 1.0L;
    for (int32_t k = 0; k < 3; ++k) {
        long double in = (long double)low[k] - o[k], out = (long double)high[k] - o[k];
        if (d[k] == 0.0) {
            if (in > 0.0L || out < 0.0L) return -1.0;
            continue;
        }
        long double a = (d[k] > 0.0 ? in : out) / d[k], c = (d[k] > 0.0 ? out : in) / d[k];
        enter = a > enter ? a : enter;
        leave = c < leave ? c : leave;
    }
    return enter <= leave ? (double)enter : -1.0;
}

static void offer(ray *r, int32_t proxy)
{
    double t = entry_of(&r->m->box[proxy], r);
    if (t < 0.0 || t > r->best) return;
    if (t < r->best || r->hit < 0 || proxy < r->hit) {
        r->best = t;
        r->hit = proxy;
    }
}

static double visit_ray(void *context, int32_t proxy, double limit)
{
    ray *r = context;
    FE_TRUE(limit == r->best);
    r->m->visits[proxy] += 1;
    offer(r, proxy);
    return r->best;
}

// Of each SIMD set that this machine has, by turns
static const fe__tree_kernels *any_kernels(void)
{
    int32_t simd = FE_SIMD_PLAIN + below(FE_SIMD_NEON);
    return fe__kernels_of(simd) ? fe__tree_kernels_of(simd) : NULL;
}

static int32_t check_ray(model *m, fe_dvec3 origin, fe_dvec3 translation, double limit)
{
    m->tree.kernels = any_kernels();
    ray found = {m, origin, translation, limit, -1}, expected = found;
    double last = fe__tree_ray(&m->tree, origin, translation, limit, visit_ray, &found);
    int32_t limit_of_slots = fe__mini(PROXIES, m->tree.slot_capacity);
    for (int32_t i = 0; i < limit_of_slots; ++i) {
        FE_TRUE(m->visits[i] <= m->present[i]);
        m->visits[i] = 0;
        if (m->present[i]) offer(&expected, i);
    }
    assert_int_equal(found.hit, expected.hit);
    FE_TRUE(found.best == expected.best && last == expected.best);
    return found.hit >= 0;
}

static int32_t check_any_ray(model *m, const place *p)
{
    fe_dvec3 o = any_point(p), d = fe__dsub(any_point(p), o);
    int32_t kind = below(8);
    if (kind & 1) d.x = 0.0;
    if (kind & 2) d.y = 0.0;
    if (kind & 4) d.z = kind & 1 ? -0.0 : 0.0; // three of the eight are parallel to an axis, one is a point
    int32_t proxy = below(PROXIES);
    if (below(2) && m->present[proxy]) { // along a side, or through a corner
        const fe__bounds *box = &m->box[proxy];
        if (below(2)) {
            o.y = below(2) ? box->low.y : box->high.y;
            d = (fe_dvec3){d.x, 0.0, 0.0};
        } else {
            d = fe__dscale(2.0, fe__dsub(below(2) ? box->low : (fe_dvec3){box->low.x, box->high.y, box->high.z}, o));
        }
    }
    if (below(10) == 0) d = fe__dscale(1e-35, d);
    return check_ray(m, o, d, below(3) ? 1.0 : uniform(0.0, 1.0));
}

// ---- the structure -------------------------------------------------------------------------------------------------
static void check_lane(const fe__tree *tree, int32_t index, int32_t lane, int32_t *proxies)
{
    const fe__tree_node *node = &tree->nodes[index];
    int32_t child = node->child[lane];
    if (child == FE_TREE_EMPTY) {
        FE_TRUE(node->box[0][lane] > node->box[3][lane]);
    } else if (child < 0) {
        assert_int_equal(tree->slot[~child], index * FE_TREE_WIDTH + lane);
        *proxies += 1;
    } else {
        const fe__tree_node *below_it = &tree->nodes[child];
        FE_TRUE(below_it->parent == index && below_it->lane == lane);
        for (int32_t row = 0; row < 6; ++row) { // as tight as it can be
            float most = below_it->box[row][0];
            for (int32_t k = 1; k < FE_TREE_WIDTH; ++k) {
                float x = below_it->box[row][k];
                if (row < 3 ? x < most : x > most) most = x;
            }
            FE_TRUE(node->box[row][lane] == most);
        }
    }
}

static int32_t depth_of(const fe__tree *tree, int32_t index)
{
    int32_t depth = 0;
    for (; index > 0; index = tree->nodes[index].parent) depth += 1;
    return depth;
}

static void check_structure(const fe__tree *tree)
{
    int32_t proxies = 0, dead = 0;
    for (int32_t i = 0; i < tree->node_count; ++i) {
        if (i > 0 && tree->nodes[i].parent < 0) {
            dead += 1;
            continue;
        }
        int32_t children = 0;
        for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane) {
            check_lane(tree, i, lane, &proxies);
            children += tree->nodes[i].child[lane] != FE_TREE_EMPTY;
        }
        FE_TRUE(i == 0 || children >= 2);
        FE_TRUE(depth_of(tree, i) <= tree->depth);
    }
    int32_t held = 0;
    for (int32_t i = 0; i < tree->slot_capacity; ++i) held += tree->slot[i] != -1;
    assert_int_equal(held, tree->proxy_count);
    assert_int_equal(proxies, tree->proxy_count);
    assert_int_equal(dead, tree->dead);
}

// ---- a life of changes ---------------------------------------------------------------------------------------------
static void insert(model *m, fe__memory *memory, int32_t proxy, const place *p)
{
    m->box[proxy] = any_box(p);
    assert_int_equal(fe__tree_reserve(&m->tree, memory, proxy + 1, 1), 1);
    fe__tree_insert(&m->tree, proxy, &m->box[proxy]);
    m->present[proxy] = 1;
}

static void take_out(model *m, int32_t proxy)
{
    fe__tree_remove(&m->tree, proxy);
    assert_int_equal(m->tree.slot[proxy], -1);
    m->present[proxy] = 0;
}

static void move_some(model *m, const place *p, int32_t most)
{
    static int32_t proxies[PROXIES];
    static fe__bounds boxes[PROXIES];
    int32_t count = 0;
    for (int32_t i = below(PROXIES); i < PROXIES && count < most; i += 1 + below(3)) {
        if (!m->present[i]) continue;
        proxies[count] = i;
        boxes[count++] = m->box[i] = any_box(p);
    }
    fe__tree_move(&m->tree, proxies, boxes, count);
}

static void change(model *m, fe__memory *memory, const place *p)
{
    int32_t proxy = below(PROXIES), what = below(100);
    if (what < 85)
        m->present[proxy] ? take_out(m, proxy) : insert(m, memory, proxy, p);
    else if (what < 95)
        move_some(m, p, 1 + below(3));
    else if (what < 99)
        move_some(m, p, PROXIES);
    else
        assert_int_equal(rebuild(&m->tree, memory, below(2)), 1);
}

// Two trees, so that one can be asked with the other's boxes. Now and then everything goes, or moves to another place.
static void live(place p)
{
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    model *a = calloc(1, sizeof *a), *b = calloc(1, sizeof *b);
    assert_true(a && b);
    int32_t hits = 0;
    noise = 5;
    for (int32_t i = 0; i < CHURN; ++i) {
        change(a, &memory, &p);
        if (i % 3 == 0) change(b, &memory, &p);
        check_query(a, &p);
        check_query_proxy(a, a, &p);
        check_query_proxy(a, b, &p);
        for (int32_t k = 0; k < 3; ++k) hits += check_any_ray(a, &p);
        if (i % 16 == 0) check_structure(&a->tree);
        if (i % 2000 != 1999) continue;
        for (int32_t k = 0; k < PROXIES; ++k)
            if (a->present[k]) take_out(a, k);
        check_query(a, &p);
        FE_TRUE(!check_any_ray(a, &p) && a->tree.node_count == 0);
    }
    FE_TRUE(hits > CHURN / 4);
    fe__tree_destroy(&a->tree, &memory);
    fe__tree_destroy(&b->tree, &memory);
    assert_int_equal(memory.bytes, 0);
    free(a);
    free(b);
}

static void it_finds_what_a_search_finds_at_the_origin(void **state)
{
    (void)state, live((place){{0.0, 0.0, 0.0}, 12.0, 0});
}
static void it_finds_what_a_search_finds_on_a_grid(void **state)
{
    (void)state, live((place){{0.0, 0.0, 0.0}, 9.0, 1});
}
static void it_finds_what_a_search_finds_100_km_away(void **state)
{
    (void)state, live((place){{1e5, -1e5, 1e5}, 9.0, 1});
}
static void it_finds_what_a_search_finds_30000_km_away(void **state)
{
    (void)state, live((place){{-3e7, 3e7, 3e7}, 12.0, 0});
}

// ---- extremes ------------------------------------------------------------------------------------------------------
// 10^-320 to 10^most m, either sign, and 0
static double any_magnitude(double most)
{
    double x =
        below(8) == 0 ? 0.0 : pow(10.0, below(3) == 0 ? uniform(-320.0, most) : uniform(-3.0, fe__mind(most, 18.0)));
    return below(2) ? x : -x;
}

static fe_dvec3 any_extreme(double most)
{
    double x = any_magnitude(most), y = any_magnitude(most);
    return (fe_dvec3){x, y, any_magnitude(most)};
}

// The float tests may not lose what the exact one finds, whatever the lengths: of boxes and queries in all of double,
// of boxes for rays up to 10^18 m.
static void extremes_are_not_missed(double largest_box, int32_t *hits)
{
    enum { BOXES = 40, QUERIES = 200 };
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    model *m = calloc(1, sizeof *m);
    assert_true(m && fe__tree_reserve(&m->tree, &memory, PROXIES, PROXIES));
    for (int32_t i = 0; i < BOXES; ++i) {
        fe_dvec3 a = any_extreme(largest_box), c = any_extreme(largest_box);
        m->box[i] = (fe__bounds){{fe__mind(a.x, c.x), fe__mind(a.y, c.y), fe__mind(a.z, c.z)},
                                 {fe__maxd(a.x, c.x), fe__maxd(a.y, c.y), fe__maxd(a.z, c.z)}};
        m->present[i] = 1;
        fe__tree_insert(&m->tree, i, &m->box[i]);
        FE_TRUE(fe__tree_holds(&m->tree, i, &m->box[i]));
    }
    assert_int_equal(rebuild(&m->tree, &memory, below(2)), 1);
    check_structure(&m->tree);
    for (int32_t i = 0; i < QUERIES; ++i) {
        fe__tree_query(&m->tree, &m->box[i % BOXES], mark, m);
        check_visits(m, &m->box[i % BOXES], (double)INFINITY);
        fe_dvec3 o = any_extreme(300.0), d = any_extreme(300.0);
        if (largest_box <= 18.0) *hits += check_ray(m, o, d, 1.0);
    }
    fe__tree_destroy(&m->tree, &memory);
    free(m);
}

static void boxes_and_rays_of_any_length_are_not_missed(void **state)
{
    (void)state;
    int32_t hits = 0;
    noise = 9;
    for (int32_t round = 0; round < 60; ++round) {
        extremes_are_not_missed(18.0, &hits);
        extremes_are_not_missed(300.0, &hits);
    }
    FE_TRUE(hits > 1000);
}

static int32_t stop_after(void *context, int32_t proxy)
{
    int32_t *visits = context;
    (void)proxy;
    return ++visits[0] < visits[1];
}

static double expect_in_order(void *context, int32_t proxy, double limit)
{
    assert_int_equal(proxy, *(int32_t *)context);
    *(int32_t *)context += 1;
    return limit;
}

static double hit_at_once(void *context, int32_t proxy, double limit)
{
    (void)proxy, (void)limit;
    *(int32_t *)context += 1;
    return 1.5 / 32.0; // in the first box, which ends at 2 / 32
}

// A spine of nodes; each has the next one in lane `down` and seven nodes of two proxies in the others. Walking down the
// spine first leaves seven nodes a level for later: no insertion makes a tree so deep.
enum { SPINE = 50 };

static void make_spine(model *m, int32_t down)
{
    fe__tree *tree = &m->tree;
    const fe__bounds box = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
    for (int32_t i = 0; i < SPINE; ++i) tree->nodes[i].parent = i - 1, tree->nodes[i].lane = down;
    tree->node_count = SPINE;
    for (int32_t i = 0; i < SPINE; ++i) {
        for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane) {
            int32_t next = i + 1, is_spine = lane == down;
            if (!is_spine) {
                next = tree->node_count++;
                tree->nodes[next].parent = i, tree->nodes[next].lane = lane;
                for (int32_t k = 0; k < FE_TREE_WIDTH; ++k) {
                    int32_t proxy = k < 2 ? tree->proxy_count++ : -1;
                    tree->nodes[next].child[k] = k < 2 ? ~proxy : FE_TREE_EMPTY;
                    for (int32_t row = 0; row < 6; ++row)
                        tree->nodes[next].box[row][k] = (row < 3) == (k < 2) ? -1.0f : 1.0f;
                    if (k >= 2) continue;
                    tree->slot[proxy] = next * FE_TREE_WIDTH + k;
                    m->box[proxy] = box;
                    m->present[proxy] = 1;
                }
            }
            tree->nodes[i].child[lane] = is_spine && next == SPINE ? FE_TREE_EMPTY : next;
            for (int32_t row = 0; row < 6; ++row) tree->nodes[i].box[row][lane] = row < 3 ? -1.0f : 1.0f;
            if (is_spine)
                tree->nodes[i].box[0][lane] = next == SPINE ? 2.0f : -1.5f; // nothing below, or nearer to a ray along x
        }
    }
    tree->depth = SPINE;
    tree->built_cost = INFINITY;
}

static void a_tree_deeper_than_the_stack_loses_nothing(void **state)
{
    (void)state;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    for (int32_t down = 0; down < FE_TREE_WIDTH; ++down) {
        model *m = calloc(1, sizeof *m);
        assert_true(m && fe__tree_reserve(&m->tree, &memory, PROXIES, PROXIES));
        make_spine(m, down);
        assert_int_equal(m->tree.proxy_count, PROXIES);
        fe__tree_query(&m->tree, &m->box[0], mark, m);
        check_visits(m, &m->box[0], 0.0);
        for (int32_t stop = 1; stop < PROXIES; stop += 97) {
            int32_t visits[2] = {0, stop};
            fe__tree_query(&m->tree, &m->box[0], stop_after, visits);
            assert_int_equal(visits[0], stop);
        }
        for (int32_t nearest = 0; nearest < PROXIES; nearest += 13) {
            m->box[nearest].low.x = -0.75; // the answer is at any depth
            FE_TRUE(check_ray(m, (fe_dvec3){-2.0, 0.0, 0.0}, (fe_dvec3){4.0, 0.0, 0.0}, 1.0));
            m->box[nearest].low.x = -0.5;
        }
        assert_int_equal(rebuild(&m->tree, &memory, 0), 1); // too deep
        FE_WITHIN(m->tree.depth, 0, 30);
        fe__tree_destroy(&m->tree, &memory);
        free(m);
    }
}

// A corner is where near and far sides are met at once, so that a single rounding to the wrong side loses it. The exact
// test decides whether the ray, which is rounded too, does meet the box.
static void a_ray_through_a_corner_is_not_missed(void **state)
{
    (void)state;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    model *m = calloc(1, sizeof *m);
    assert_true(m && fe__tree_reserve(&m->tree, &memory, 2, 2));
    m->present[0] = 1;
    m->present[1] = 1;
    m->box[1] = (fe__bounds){{-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 1e-3}}; // keeps the origin
    fe__tree_insert(&m->tree, 1, &m->box[1]);
    int32_t hits = 0;
    for (int32_t i = 0; i < 300000; ++i) {
        fe_dvec3 corner = {uniform(1.0, 2.0), uniform(1.0, 2.0), uniform(-1.0, 1.0)},
                 back = {uniform(0.5, 2.0), -uniform(0.5, 2.0), 0.0};
        m->box[0] = (fe__bounds){{corner.x - 0.25, corner.y - 0.25, corner.z}, {corner.x, corner.y, corner.z}};
        fe__tree_insert(&m->tree, 0, &m->box[0]);
        fe_dvec3 o = fe__dadd(corner, back);
        hits += check_ray(m, o, fe__dscale(-uniform(1.0, 2.0), back), 1.0);
        fe__tree_remove(&m->tree, 0);
    }
    FE_TRUE(hits > 50000);
    fe__tree_destroy(&m->tree, &memory);
    free(m);
}

// Boxes in a row, put in in any order: the nearest is seen first, and after a hit in it nothing else.
static void a_ray_sees_the_nearest_child_first(void **state)
{
    (void)state;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    for (int32_t first = 0; first < 8; ++first) {
        fe__tree tree = {0};
        assert_int_equal(fe__tree_reserve(&tree, &memory, 8, 8), 1);
        for (int32_t k = 0; k < 8; ++k) {
            double x = 2.0 * ((first + 3 * k) % 8);
            fe__bounds box = {{x, 0.0, 0.0}, {x + 1.0, 1.0, 1.0}};
            fe__tree_insert(&tree, (first + 3 * k) % 8, &box);
        }
        int32_t expected = 0;
        fe__tree_ray(&tree, (fe_dvec3){-1.0, 0.5, 0.5}, (fe_dvec3){32.0, 0.0, 0.0}, 1.0, expect_in_order, &expected);
        assert_int_equal(expected, 8);
        int32_t visits = 0;
        fe__tree_ray(&tree, (fe_dvec3){-1.0, 0.5, 0.5}, (fe_dvec3){32.0, 0.0, 0.0}, 1.0, hit_at_once, &visits);
        assert_int_equal(visits, 1);
        fe__tree_destroy(&tree, &memory);
    }
}

static double stop_ray_at_third(void *context, int32_t proxy, double limit)
{
    (void)proxy;
    return ++*(int32_t *)context < 3 ? limit : -1.0;
}

static void a_visitor_can_stop(void **state)
{
    (void)state;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe__tree tree = {0};
    fe__bounds box = {{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}};
    assert_int_equal(fe__tree_reserve(&tree, &memory, 100, 100), 1);
    for (int32_t i = 0; i < 100; ++i) fe__tree_insert(&tree, i, &box);
    int32_t visits[2] = {0, 3};
    fe__tree_query(&tree, &box, stop_after, visits);
    assert_int_equal(visits[0], 3);
    visits[0] = 0;
    FE_TRUE(fe__tree_ray(&tree, (fe_dvec3){-2.0, 0.0, 0.0}, (fe_dvec3){9.0, 0.0, 0.0}, 1.0, stop_ray_at_third,
                         visits) == -1.0);
    assert_int_equal(visits[0], 3);
    fe__tree_destroy(&tree, &memory);
}

// ---- shape ---------------------------------------------------------------------------------------------------------
typedef enum order { IN_ROWS, SCATTERED, ONE_PLACE, SHRINKING, GROWING, FLOORS, POINTS, ORDERS } order;

static fe__bounds box_in_order(order order, int32_t i)
{
    double s = order == SHRINKING ? 1.0 - (double)i / ALL : order == GROWING ? (double)(i + 1) / ALL : 0.5;
    fe_dvec3 c = {0.0, 0.0, 0.0};
    if (order == FLOORS && i % 3 == 0) s = 100.0;
    if (order == POINTS) s = 0.0;
    if (order == IN_ROWS || order == FLOORS) c = (fe_dvec3){1.5 * (double)(i % 245), 0.0, 1.5 * (double)(i / 245)};
    if (order == SCATTERED) c = (fe_dvec3){uniform(0.0, 400.0), uniform(0.0, 5.0), uniform(0.0, 400.0)};
    return (fe__bounds){{c.x - s, c.y - s, c.z - s}, {c.x + s, c.y + s, c.z + s}};
}

// Splits leave two children at least on each side, so that a node at height h holds 2^(h + 1) proxies or more and 60
// 000 need a depth of 14 at most. A floor that stays above the rest is no exception: it takes a lane that was free.
static void it_is_shallow_in_whatever_order_proxies_come(void **state)
{
    (void)state;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    for (order o = IN_ROWS; o < ORDERS; ++o) {
        fe__tree tree = {0};
        assert_int_equal(fe__tree_reserve(&tree, &memory, ALL, ALL), 1);
        for (int32_t i = 0; i < ALL; ++i) {
            fe__bounds box = box_in_order(o, i);
            fe__tree_insert(&tree, i, &box);
        }
        check_structure(&tree);
        FE_WITHIN(tree.depth, 4, 14); // 8^5 < 60 000
        assert_int_equal(rebuild(&tree, &memory, 1), 1);
        check_structure(&tree);
        FE_WITHIN(tree.depth, 5, 14);
        fe__tree_destroy(&tree, &memory);
    }
}

static int32_t count_visit(void *context, int32_t proxy)
{
    (void)proxy;
    ++*(int32_t *)context;
    return 1;
}

static void a_worn_tree_is_built_anew_and_a_good_one_is_left_alone(void **state)
{
    (void)state;
    enum { N = 2000 };
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe__tree tree = {0};
    static int32_t proxies[N];
    static fe__bounds boxes[N];
    place p = {{0.0, 0.0, 0.0}, 50.0, 0};
    assert_int_equal(fe__tree_reserve(&tree, &memory, N, N), 1);
    for (int32_t i = 0; i < N; ++i) {
        boxes[i] = any_box(&p);
        proxies[i] = i;
        fe__tree_insert(&tree, i, &boxes[i]);
    }
    int64_t allocations = memory.allocations;
    assert_int_equal(rebuild(&tree, &memory, 0), 1); // it was never built
    FE_TRUE(memory.allocations > allocations);
    allocations = memory.allocations;
    assert_int_equal(rebuild(&tree, &memory, 0), 1); // it is as built
    assert_int_equal(memory.allocations, allocations);

    for (int32_t i = 0; i < N; ++i) boxes[i] = any_box(&p); // neighbours scatter
    fe__tree_move(&tree, proxies, boxes, N);
    assert_int_equal(rebuild(&tree, &memory, 0), 1);
    FE_TRUE(memory.allocations > allocations);
    allocations = memory.allocations;

    for (int32_t i = 0; i < N * 19 / 20; ++i) fe__tree_remove(&tree, i); // most nodes are dead
    FE_TRUE(tree.dead > tree.node_count / 4);
    assert_int_equal(rebuild(&tree, &memory, 0), 1);
    FE_TRUE(memory.allocations > allocations && tree.dead == 0);
    check_structure(&tree);
    fe__tree_destroy(&tree, &memory);
}

enum { IN_ROW = 40 };

static double count_each(void *context, int32_t proxy, double limit)
{
    ((int32_t *)context)[proxy] += 1;
    return limit;
}

static double keep_nearest(void *context, int32_t proxy, double limit)
{
    double *enter = context; // where the ray enters each
    return fe__mind(limit, enter[proxy]);
}

// The second tree begins at `start`: among the boxes of the first, or so far off that it has an origin of its own.
static void check_two_trees(double start)
{
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe__tree first = {.kernels = any_kernels()}, second = {0};
    const fe__tree *const both[] = {&first, &second}, *const turned[] = {&second, &first};
    const fe__tree_way way = {{-10.0, 0.5, 0.5}, {16384.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    double enter[IN_ROW];
    for (int32_t i = 0; i < IN_ROW; ++i) {
        fe__tree *tree = i % 2 ? &second : &first;
        double x = 10.0 * i + (i % 2 ? start : 0.0);
        enter[i] = (x + 10.0) / way.translation.x;
        assert_int_equal(fe__tree_reserve(tree, &memory, IN_ROW, 1), 1);
        fe__tree_insert(tree, i, &(fe__bounds){{x, 0.0, 0.0}, {x + 1.0, 1.0, 1.0}});
    }
    int32_t visits[IN_ROW] = {0};
    assert_true(fe__tree_sweep(both, 2, &way, 1.0, count_each, visits) == 1.0);
    for (int32_t i = 0; i < IN_ROW; ++i) assert_int_equal(visits[i], 1);
    assert_true(fe__tree_sweep(both, 2, &way, 1.0, keep_nearest, enter) == enter[0]);
    assert_true(fe__tree_sweep(turned, 2, &way, 1.0, keep_nearest, enter) == enter[0]);
    fe__tree_remove(&first, 0);
    assert_true(fe__tree_sweep(both, 2, &way, 1.0, keep_nearest, enter) == fe__mind(enter[1], enter[2]));
    fe__tree_destroy(&first, &memory);
    fe__tree_destroy(&second, &memory);
}

static void two_trees_are_one_to_a_ray(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 20; ++i) check_two_trees(0.0), check_two_trees(5000.0);
}

// Boxes that went 10 000 km away are metres wide in floats, until the origin follows.
static void the_origin_follows_at_a_rebuild(void **state)
{
    (void)state;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe__tree tree = {0};
    int32_t proxies[10];
    fe__bounds boxes[10];
    assert_int_equal(fe__tree_reserve(&tree, &memory, 10, 10), 1);
    for (int32_t i = 0; i < 10; ++i) {
        double x = 10.0 * i;
        proxies[i] = i;
        boxes[i] = (fe__bounds){{x, 0.0, 0.0}, {x + 1.0, 1.0, 1.0}};
        fe__tree_insert(&tree, i, &boxes[i]);
        boxes[i].low.x += 1e7, boxes[i].high.x += 1e7;
    }
    assert_int_equal(rebuild(&tree, &memory, 1), 1);
    fe__tree_move(&tree, proxies, boxes, 10); // all together: the cost stays
    assert_int_equal(rebuild(&tree, &memory, 0), 1);
    const double cell =
        1024.0; // of the grid of origins; floats at 10^7 m are 1 m apart, and boxes grow by 2^-23 of that
    FE_NEAR(tree.origin.x, 1e7 + 45.5, 0.5 * cell + 4.0);
    FE_TRUE(fmod(tree.origin.x, cell) == 0.0);
    fe__tree_move(&tree, proxies, boxes, 10);
    for (int32_t i = 0; i < 10; ++i) {
        fe__bounds box;
        fe__tree_get(&tree, i, &box);
        FE_NEAR(box.low.x, boxes[i].low.x, 2.0 * 0x1p-23 * (0.5 * cell + 100.0));
        FE_TRUE(box.low.x <= boxes[i].low.x && box.high.x >= boxes[i].high.x);
    }
    // Rebuilding again and again does not swell them, though the centre wanders.
    fe__bounds before, after, other = boxes[0];
    fe__tree_get(&tree, 7, &before);
    for (int32_t i = 0; i < 100; ++i) {
        fe__tree_remove(&tree, 0);
        other.high.x += 7.3;
        fe__tree_insert(&tree, 0, &other);
        assert_int_equal(rebuild(&tree, &memory, 1), 1);
    }
    fe__tree_get(&tree, 7, &after);
    assert_memory_equal(&before, &after, sizeof before);
    fe__tree_move(&tree, proxies, boxes, 1);
    // From the origin as it is now, the boxes are sharp.
    int32_t visits = 0;
    fe__bounds gap = {{1e7 + 1.01, 0.0, 0.0}, {1e7 + 9.99, 1.0, 1.0}};
    fe__tree_query(&tree, &gap, count_visit, &visits);
    assert_int_equal(visits, 0);
    fe__tree_destroy(&tree, &memory);
}

static void a_box_holds_what_lies_in_it_and_nothing_that_stands_out(void **state)
{
    (void)state;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    for (double far = 0.0; far < 4e7; far = 10.0 * far + 1.0) {
        fe__tree tree = {0};
        place p = {{far, -far, far}, 20.0, 0};
        assert_int_equal(fe__tree_reserve(&tree, &memory, 1, 1), 1);
        for (int32_t i = 0; i < 1000; ++i) {
            fe__bounds fat = any_box(&p), tight = fat;
            fe__tree_insert(&tree, 0, &fat);
            FE_TRUE(fe__tree_holds(&tree, 0, &tight));
            double *side[6] = {&tight.low.x, &tight.low.y, &tight.low.z, &tight.high.x, &tight.high.y, &tight.high.z};
            int32_t k = below(6);
            double saved = *side[k], sign = k < 3 ? 1.0 : -1.0,
                   step = 1e-3; // of boxes up to 60 m wide, about the origin
            *side[k] = saved + sign * step;
            FE_TRUE(fe__tree_holds(&tree, 0, &tight));
            *side[k] = saved - sign * step;
            FE_TRUE(!fe__tree_holds(&tree, 0, &tight));
            fe__tree_remove(&tree, 0);
        }
        fe__tree_destroy(&tree, &memory);
    }
}

// ---- memory --------------------------------------------------------------------------------------------------------
typedef struct host {
    int32_t allowed; // allocations until the first refusal
    int32_t once;    // only that one is refused
} host;

static void *host_allocate(void *user, uint64_t size, uint64_t alignment)
{
    host *h = user;
    if (h->allowed <= 0) {
        if (h->once) h->allowed = INT32_MAX;
        return NULL;
    }
    h->allowed -= 1;
    return fe__aligned_allocate((size_t)size, (size_t)alignment);
}

static void host_release(void *user, void *block, uint64_t size)
{
    (void)user, (void)size;
    fe__aligned_free(block);
}

static fe__memory memory_of(host *h)
{
    fe_allocator allocator = {.struct_size = sizeof allocator,
                              .allocate = host_allocate,
                              .release = host_release,
                              .user = h};
    fe__memory memory;
    fe__memory_init(&memory, &allocator);
    return memory;
}

// Every allocation of a build is refused once. How many there were.
static int32_t refuse_builds(model *m, host *h, fe__memory *memory, const place *p)
{
    size_t size = sizeof(fe__tree_node) * (size_t)m->tree.node_count;
    fe__tree_node *nodes = malloc(size);
    assert_non_null(nodes);
    memcpy(nodes, m->tree.nodes, size);
    fe__tree before = m->tree;
    int64_t bytes = memory->bytes;
    int32_t allowed = 0;
    for (h->allowed = 0; !rebuild(&m->tree, memory, 1); h->allowed = ++allowed) {
        assert_memory_equal(&m->tree, &before, sizeof before);
        assert_memory_equal(m->tree.nodes, nodes, size);
        assert_int_equal(memory->bytes, bytes);
        for (int32_t k = 0; k < 5; ++k) check_query(m, p);
    }
    free(nodes);
    check_structure(&m->tree);
    return allowed;
}

static void a_refused_build_changes_nothing(void **state)
{
    (void)state;
    host h = {.once = 1};
    fe__memory memory = memory_of(&h);
    model *m = calloc(1, sizeof *m);
    assert_non_null(m);
    place p = {{0.0, 0.0, 0.0}, 12.0, 0};
    int32_t most = 0;
    for (int32_t count = 1; count < PROXIES; count += 9) {
        h.allowed = 1000;
        for (int32_t i = 0; i < count; ++i) {
            double x = 1.5 * (double)(i % 12), z = 1.5 * (double)(i / 12); // rows of 12: builds of many nodes
            m->box[i] = (fe__bounds){{x, 0.0, z}, {x + 1.0, 1.0, z + 1.0}};
            m->present[i] = 1;
            assert_int_equal(fe__tree_reserve(&m->tree, &memory, i + 1, 1), 1);
            fe__tree_insert(&m->tree, i, &m->box[i]);
        }
        most = fe__maxi(most, refuse_builds(m, &h, &memory, &p));
        fe__tree_destroy(&m->tree, &memory);
    }
    FE_TRUE(most >= 3); // items, nodes, and more nodes than the tree had
    assert_int_equal(memory.bytes, 0);
    free(m);
}

static void a_refused_reservation_changes_nothing(void **state)
{
    (void)state;
    host h = {.allowed = 1000};
    fe__memory memory = memory_of(&h);
    model *m = calloc(1, sizeof *m);
    assert_non_null(m);
    place p = {{0.0, 0.0, 0.0}, 12.0, 0};
    for (int32_t i = 0; i < PROXIES / 2; ++i) insert(m, &memory, i, &p);
    h.allowed = 0;
    fe__tree before = m->tree;
    assert_int_equal(fe__tree_reserve(&m->tree, &memory, PROXIES / 2, 100000), 0);
    assert_memory_equal(&m->tree, &before, sizeof before);
    assert_int_equal(fe__tree_reserve(&m->tree, &memory, 100000, 1), 0);
    assert_memory_equal(&m->tree, &before, sizeof before);
    assert_int_equal(fe__tree_reserve(&m->tree, &memory, INT32_MAX, INT32_MAX), 0);
    check_structure(&m->tree);
    for (int32_t k = 0; k < 100; ++k) check_query(m, &p);
    fe__tree_destroy(&m->tree, &memory);
    assert_int_equal(memory.bytes, 0);
    free(m);
}

// Also when all nodes are full, so that splits are wanted everywhere at once, and also after a build in between.
static void what_is_reserved_fits(void **state)
{
    (void)state;
    enum { N = 20000 };
    host h = {.allowed = 1000};
    fe__memory memory = memory_of(&h);
    for (int32_t round = 0; round < 4; ++round) {
        fe__tree tree = {0};
        place p = {{0.0, 0.0, 0.0}, 60.0, 0};
        h.allowed = 1000;
        assert_int_equal(fe__tree_reserve(&tree, &memory, N, N / 2), 1);
        for (int32_t i = 0; i < N / 2; ++i) {
            fe__bounds box = any_box(&p);
            fe__tree_insert(&tree, i, &box);
        }
        if (round & 1) assert_int_equal(rebuild(&tree, &memory, 1), 1);
        assert_int_equal(fe__tree_reserve(&tree, &memory, N, N / 2), 1);
        if (round & 2) assert_int_equal(rebuild(&tree, &memory, 1), 1);
        h.allowed = 0;
        for (int32_t i = N / 2; i < N; ++i) {
            fe__bounds box = any_box(&p);
            fe__tree_insert(&tree, i, &box);
            FE_TRUE(tree.node_count <= tree.node_capacity);
        }
        check_structure(&tree);
        fe__tree_destroy(&tree, &memory);
    }
}

// Of a reservation, no more than the nodes asked for is there in the end, so insertions that come with none to spare
// may not split.
static void the_last_reserved_nodes_are_not_spent_on_splits(void **state)
{
    (void)state;
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe__tree tree = {0};
    place p = {{0.0, 0.0, 0.0}, 12.0, 0};
    for (int32_t i = 0; i < PROXIES;) {
        int32_t count = fe__mini(1 + below(12), PROXIES - i);
        assert_int_equal(fe__tree_reserve(&tree, &memory, PROXIES, count), 1);
        int32_t capacity = tree.node_capacity;
        if (below(2)) tree.node_capacity = tree.node_count + count;
        for (int32_t k = 0; k < count; ++k) {
            fe__bounds box = any_box(&p);
            fe__tree_insert(&tree, i++, &box);
            FE_TRUE(tree.node_count <= tree.node_capacity);
        }
        tree.node_capacity = capacity;
        check_structure(&tree);
    }
    fe__tree_destroy(&tree, &memory);
}

// A cube of 8 x 8 x 8 boxes fills every node of a build. Ten more, far from each other, would split ten of them, and
// the root.
static void the_last_reserved_nodes_are_not_spent_on_the_first_splits(void **state)
{
    (void)state;
    enum { CUBE = 512, MORE = 10 };
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe__tree tree = {0};
    fe__bounds boxes[CUBE];
    assert_int_equal(fe__tree_reserve(&tree, &memory, CUBE + MORE, CUBE), 1);
    for (int32_t i = 0; i < CUBE; ++i) {
        double x = 1.5 * (i % 8), y = 1.5 * (i / 8 % 8), z = 1.5 * (i / 64);
        boxes[i] = (fe__bounds){{x, y, z}, {x + 1.0, y + 1.0, z + 1.0}};
        fe__tree_insert(&tree, i, &boxes[i]);
    }
    assert_int_equal(rebuild(&tree, &memory, 1), 1);
    assert_int_equal(tree.node_count, 1 + 8 + 64);
    assert_int_equal(fe__tree_reserve(&tree, &memory, CUBE + MORE, MORE), 1);
    int32_t capacity = tree.node_capacity;
    tree.node_capacity = tree.node_count + MORE;
    for (int32_t i = 0; i < MORE; ++i) fe__tree_insert(&tree, CUBE + i, &boxes[(i * 50 + 25) % CUBE]);
    FE_TRUE(tree.node_count <= tree.node_capacity);
    tree.node_capacity = capacity;
    check_structure(&tree);
    fe__tree_destroy(&tree, &memory);
}

// A node has two children at least, and a quarter of the nodes are dead at most before they are used again: 4/3 nodes a
// proxy and room for splits, doubled by the array's growth.
static void proxies_that_come_and_go_take_no_more_memory(void **state)
{
    (void)state;
    enum { LIVE = 300, PAIRS = 100000 };
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe__tree tree = {0};
    place p = {{0.0, 0.0, 0.0}, 12.0, 0};
    int64_t half_time = 0;
    for (int32_t i = 0; i < PAIRS; ++i) {
        fe__bounds box = any_box(&p);
        assert_int_equal(fe__tree_reserve(&tree, &memory, LIVE, 1), 1);
        if (i >= LIVE) fe__tree_remove(&tree, i % LIVE);
        fe__tree_insert(&tree, i % LIVE, &box);
        if (i == PAIRS / 2) half_time = memory.bytes;
    }
    check_structure(&tree);
    assert_int_equal(memory.bytes, half_time);
    FE_WITHIN(tree.node_capacity, 1, 2 * (LIVE * 4 / 3 + 64));
    fe__tree_destroy(&tree, &memory);
    assert_int_equal(memory.bytes, 0);
}

// The same with builds in between, at any moment and of any number of proxies: what one build has over is not in the
// next one's need. A node has two children at least, so a build needs no more than the proxies and room for splits,
// which growing rounds up by half.
static void builds_in_any_number_take_no_more_memory(void **state)
{
    (void)state;
    enum { MOST = 300, ROUNDS = 20000, SPLIT_ROOM = 32 };
    fe__memory memory;
    fe__memory_init(&memory, NULL);
    fe__tree tree = {0};
    place p = {{0.0, 0.0, 0.0}, 12.0, 0};
    int32_t count = 0;
    for (int32_t i = 0; i < ROUNDS; ++i) {
        fe__bounds box = any_box(&p);
        int32_t grows = count == 0 || (count < MOST && below(2));
        if (grows) {
            assert_int_equal(fe__tree_reserve(&tree, &memory, MOST, 1), 1);
            fe__tree_insert(&tree, count++, &box);
        } else {
            fe__tree_remove(&tree, --count);
        }
        if (count && below(3) == 0) assert_int_equal(rebuild(&tree, &memory, 1), 1);
        FE_WITHIN(tree.node_capacity, 1, 3 * (MOST * 4 / 3 + 1 + SPLIT_ROOM) / 2);
    }
    check_structure(&tree);
    fe__tree_destroy(&tree, &memory);
    assert_int_equal(memory.bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_finds_what_a_search_finds_at_the_origin),
        cmocka_unit_test(it_finds_what_a_search_finds_on_a_grid),
        cmocka_unit_test(it_finds_what_a_search_finds_100_km_away),
        cmocka_unit_test(it_finds_what_a_search_finds_30000_km_away),
        cmocka_unit_test(boxes_and_rays_of_any_length_are_not_missed),
        cmocka_unit_test(a_tree_deeper_than_the_stack_loses_nothing),
        cmocka_unit_test(a_ray_sees_the_nearest_child_first),
        cmocka_unit_test(a_ray_through_a_corner_is_not_missed),
        cmocka_unit_test(a_visitor_can_stop),
        cmocka_unit_test(it_is_shallow_in_whatever_order_proxies_come),
        cmocka_unit_test(a_worn_tree_is_built_anew_and_a_good_one_is_left_alone),
        cmocka_unit_test(two_trees_are_one_to_a_ray),
        cmocka_unit_test(the_origin_follows_at_a_rebuild),
        cmocka_unit_test(a_box_holds_what_lies_in_it_and_nothing_that_stands_out),
        cmocka_unit_test(a_refused_build_changes_nothing),
        cmocka_unit_test(a_refused_reservation_changes_nothing),
        cmocka_unit_test(what_is_reserved_fits),
        cmocka_unit_test(the_last_reserved_nodes_are_not_spent_on_splits),
        cmocka_unit_test(the_last_reserved_nodes_are_not_spent_on_the_first_splits),
        cmocka_unit_test(proxies_that_come_and_go_take_no_more_memory),
        cmocka_unit_test(builds_in_any_number_take_no_more_memory),
    };
    return cmocka_run_group_tests_name("tree", tests, NULL, NULL);
}
