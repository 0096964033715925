// mesh_edges.c - which triangles count, and what their edges are.
//
// Triangles without height are dropped. Half-edges are sorted by their edge: into buckets by its lower vertex, in them
// by the other vertex, then by the triangle's third one. So the half-edges of an edge follow each other, and among them
// those of triangles that are the same: these have the same three vertices and the same winding; the first stays.
//
// An edge of two triangles is convex when the third vertex of one lies below the other's plane. It is felt when their
// normals turn by more than the edge angle.
#include "collision/mesh_build/mesh_build.h"
#include "core/math.h"

#define HALF_EDGES(s) (3 * (int64_t)(s)->triangle_count)

int64_t fe__mesh_edges_size(const fe__mesh_source *s)
{
    return (int64_t)sizeof(uint32_t) * (2 * HALF_EDGES(s) + s->vertex_count + 2);
}

// Half-edge k of triangle t, from its corner k on, has the number 4 t + k.
enum { HALF_BITS = 2, HALF_MASK = 3 };
static const uint8_t next_corner[3] = {1, 2, 0}, last_corner[3] = {2, 0, 1};

typedef struct workroom {
    fe__mesh_builder *builder;
    uint32_t *corner; // welded, three a triangle
    uint32_t *half;   // half-edges by bucket
    uint32_t *first;  // of each bucket
    double least_cosine;
} workroom;

typedef struct half_edge {
    uint32_t lower, other, third;
    int32_t is_forward; // from lower to other
} half_edge;

static inline half_edge read_half(const workroom *w, uint32_t half)
{
    uint32_t k = half & HALF_MASK;
    const uint32_t *c = w->corner + 3 * (size_t)(half >> HALF_BITS);
    uint32_t a = c[k], b = c[next_corner[k]], third = c[last_corner[k]];
    return a < b ? (half_edge){a, b, third, 1} : (half_edge){b, a, third, 0};
}

// ---- triangles without area ----------------------------------------------------------------------------------------
static fe_dvec3 normal_of(const fe_dvec3 v[3]) { return fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0])); }

static void read_triangle(const workroom *w, uint32_t triangle, fe_dvec3 v[3])
{
    const uint32_t *c = w->corner + 3 * (size_t)triangle;
    for (int32_t k = 0; k < 3; ++k) v[k] = fe__widen(fe__mesh_source_vertex(w->builder->source, c[k]));
}

static double largest_coordinate(const fe_dvec3 v[3])
{
    double largest = 0.0;
    for (int32_t k = 0; k < 3; ++k)
        largest = fe__maxd(largest, fe__maxd(fe__absd(v[k].x), fe__maxd(fe__absd(v[k].y), fe__absd(v[k].z))));
    return largest;
}

// Its height over its longest side s is |n| / s.
int32_t fe__mesh_is_flat(const fe_dvec3 v[3])
{
    fe_dvec3 n = normal_of(v);
    double least = FE__MESH_LEAST_HEIGHT * largest_coordinate(v), longest = 0.0;
    for (int32_t k = 0; k < 3; ++k) {
        fe_dvec3 side = fe__dsub(v[next_corner[k]], v[k]);
        longest = fe__maxd(longest, fe__ddot(side, side));
    }
    return !(fe__ddot(n, n) > least * least * longest);
}

static void read_corners(workroom *w)
{
    for (int32_t i = 0; i < w->builder->source->triangle_count; ++i)
        for (int32_t k = 0; k < 3; ++k) w->corner[3 * (size_t)i + (size_t)k] = fe__mesh_welded(w->builder, i, k);
}

static void refuse(fe__mesh_builder *b, int32_t triangle, int32_t is_duplicate)
{
    if (b->refusal.triangle >= 0 && b->refusal.triangle < triangle) return;
    b->refusal = (fe__mesh_refusal){triangle, is_duplicate};
}

static void drop_degenerate(workroom *w)
{
    fe__mesh_builder *b = w->builder;
    for (int32_t i = 0; i < b->source->triangle_count; ++i) {
        const uint32_t *c = w->corner + 3 * (size_t)i;
        fe_dvec3 v[3];
        read_triangle(w, (uint32_t)i, v);
        if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0] && !fe__mesh_is_flat(v)) continue;
        b->edges[i] = FE__MESH_DROPPED;
        b->mesh.degenerate_count += 1;
        refuse(b, i, 0);
    }
}

// ---- buckets -------------------------------------------------------------------------------------------------------
static uint32_t lower_of(const uint32_t *c, int32_t k) { return c[k] < c[next_corner[k]] ? c[k] : c[next_corner[k]]; }

static void fill_buckets(workroom *w)
{
    const fe__mesh_builder *b = w->builder;
    uint32_t count = (uint32_t)b->source->triangle_count, vertices = (uint32_t)b->source->vertex_count;
    uint32_t *place = w->first + 1; // moved by one: filling ends with the firsts in w->first
    memset(w->first, 0, ((size_t)vertices + 2) * sizeof *w->first);
    for (uint32_t t = 0; t < count; ++t) {
        if (b->edges[t] == FE__MESH_DROPPED) continue;
        for (int32_t k = 0; k < 3; ++k) place[lower_of(w->corner + 3 * (size_t)t, k) + 1] += 1;
    }
    for (uint32_t v = 0; v < vertices; ++v) place[v + 1] += place[v];
    for (uint32_t t = 0; t < count; ++t) {
        if (b->edges[t] == FE__MESH_DROPPED) continue;
        for (int32_t k = 0; k < 3; ++k)
            w->half[place[lower_of(w->corner + 3 * (size_t)t, k)]++] = t << HALF_BITS | (uint32_t)k;
    }
}

static int32_t is_before(const workroom *w, uint32_t a, uint32_t b)
{
    half_edge x = read_half(w, a), y = read_half(w, b);
    if (x.other != y.other) return x.other < y.other;
    if (x.third != y.third) return x.third < y.third;
    if (x.is_forward != y.is_forward) return x.is_forward;
    return a < b;
}

static void sift(const workroom *w, uint32_t *heap, uint32_t at, uint32_t count)
{
    uint32_t moved = heap[at];
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && is_before(w, heap[child], heap[child + 1])) child += 1;
        if (!is_before(w, moved, heap[child])) break;
        heap[at] = heap[child];
    }
    heap[at] = moved;
}

// Few by insertion; many, as around the middle of a fan, on a heap (Williams 1964)
enum { FEW = 24 };
static void sort_many(const workroom *w, uint32_t *half, uint32_t count)
{
    for (uint32_t i = count / 2; i-- > 0;) sift(w, half, i, count);
    for (uint32_t end = count - 1; end > 0; --end) {
        uint32_t largest = half[0];
        half[0] = half[end], half[end] = largest;
        sift(w, half, 0, end);
    }
}

// What half-edges of a bucket are sorted by. Of two with the same vertices the forward one is first
typedef struct keyed {
    uint64_t key; // other << 32 | third
    uint32_t half, is_backward;
} keyed;
enum { KEY_BITS = 32 };

static inline keyed key_of(const workroom *w, uint32_t half)
{
    half_edge h = read_half(w, half);
    return (keyed){(uint64_t)h.other << KEY_BITS | h.third, half, !h.is_forward};
}
static inline uint32_t other_of(const keyed *k) { return (uint32_t)(k->key >> KEY_BITS); }
static inline uint32_t third_of(const keyed *k) { return (uint32_t)k->key; }

static inline int32_t comes_after(const keyed *a, const keyed *b)
{
    return a->key > b->key || (a->key == b->key && a->is_backward > b->is_backward);
}

// They come in the order of their numbers: the sort is stable.
static void sort_few(const workroom *w, const uint32_t *half, uint32_t count, keyed *sorted)
{
    for (uint32_t i = 0; i < count; ++i) {
        keyed own = key_of(w, half[i]);
        uint32_t place = i;
        for (; place > 0 && comes_after(sorted + place - 1, &own); --place) sorted[place] = sorted[place - 1];
        sorted[place] = own;
    }
}

// ---- edges ---------------------------------------------------------------------------------------------------------
static void mark(workroom *w, uint32_t half, fe__mesh_edge edge)
{
    static const uint32_t digit[3] = {1, FE__MESH_EDGES, FE__MESH_EDGES * FE__MESH_EDGES};
    uint8_t *edges = w->builder->edges + (half >> HALF_BITS);
    *edges = (uint8_t)(*edges + (uint32_t)edge * digit[half & HALF_MASK]);
}

// cosine < least, of two normals. Squares decide where rounding does not, without a root and a quotient
static int32_t turns_more(fe_dvec3 n, fe_dvec3 m, double least)
{
    const double rounding = 1e-12, least_square = 1e-200;
    double product = fe__ddot(n, m), square = fe__ddot(n, n) * fe__ddot(m, m);
    if (product > 0.0 && least > 0.0 && square > least_square) {
        double own = product * product, limit = least * least * square;
        if (own > limit + rounding * limit) return 0;
        if (own < limit - rounding * limit) return 1;
    }
    return product / sqrt(square) < least;
}

// Of two triangles that wind alike: the second has the edge the other way round
static fe__mesh_edge bend(const workroom *w, const keyed *a, const keyed *b)
{
    if (third_of(a) == third_of(b)) return FE__MESH_EDGE_CONVEX; // back to back
    uint32_t from = a->half & HALF_MASK, to = next_corner[from], start = b->half & HALF_MASK;
    fe_dvec3 v[3], u[3], third = fe__widen(fe__mesh_source_vertex(w->builder->source, third_of(b)));
    read_triangle(w, a->half >> HALF_BITS, v);
    fe_dvec3 n = normal_of(v);
    if (!(fe__ddot(n, fe__dsub(third, v[from])) < 0.0)) return FE__MESH_EDGE_SMOOTH;
    u[start] = v[to], u[next_corner[start]] = v[from], u[last_corner[start]] = third;
    return turns_more(n, normal_of(u), w->least_cosine) ? FE__MESH_EDGE_CONVEX : FE__MESH_EDGE_BENT;
}

// Half-edges of one edge as they are met: duplicates are left out. The first two are known by their keys as well
typedef struct edge {
    uint32_t *half;
    uint32_t count;
    keyed first, second, last;
} edge;

static void add_half(workroom *w, edge *e, const keyed *k)
{
    fe__mesh_builder *b = w->builder;
    if (e->count == 0 || third_of(&e->last) != third_of(k) || e->last.is_backward != k->is_backward) {
        if (e->count == 0) e->first = *k;
        if (e->count == 1) e->second = *k;
        e->last = *k;
        e->half[e->count++] = k->half;
        return;
    }
    uint8_t *edges = b->edges + (k->half >> HALF_BITS);
    if (*edges == FE__MESH_DROPPED) return; // by another edge
    *edges = FE__MESH_DROPPED;
    b->mesh.duplicate_count += 1;
    refuse(b, (int32_t)(k->half >> HALF_BITS), 1);
}

static void judge_edge(workroom *w, const edge *e)
{
    fe__mesh *m = &w->builder->mesh;
    fe__mesh_edge kind = FE__MESH_EDGE_ODD;
    if (e->count == 1) {
        m->open_count += 1;
        kind = FE__MESH_EDGE_OPEN;
    } else if (e->count > 2) {
        m->odd_count += 1;
    } else if (e->first.is_backward == e->second.is_backward) {
        m->flipped_count += 1;
    } else {
        kind = bend(w, &e->first, &e->second);
    }
    for (uint32_t i = 0; i < e->count; ++i) mark(w, e->half[i], kind);
}

static void judge_bucket(workroom *w, uint32_t *half, uint32_t count)
{
    keyed few[FEW];
    int32_t is_few = count <= FEW;
    if (is_few)
        sort_few(w, half, count, few);
    else
        sort_many(w, half, count);
    edge e = {.half = half};
    for (uint32_t i = 0; i < count; ++i) {
        keyed k = is_few ? few[i] : key_of(w, half[i]);
        if (e.count > 0 && other_of(&e.last) != other_of(&k)) {
            judge_edge(w, &e);
            e.half += e.count, e.count = 0; // what is kept of the next stands no farther than it did
        }
        add_half(w, &e, &k);
    }
    if (e.count > 0) judge_edge(w, &e);
}

void fe__mesh_find_edges(fe__mesh_builder *b)
{
    double sine;
    workroom w = {.builder = b, .corner = b->scratch};
    w.half = w.corner + HALF_EDGES(b->source);
    w.first = w.half + HALF_EDGES(b->source);
    fe__sincos(b->source->edge_angle, &sine, &w.least_cosine);
    read_corners(&w);
    drop_degenerate(&w);
    fill_buckets(&w);
    for (int32_t v = 0; v < b->source->vertex_count; ++v)
        judge_bucket(&w, w.half + w.first[v], w.first[v + 1] - w.first[v]);
    b->mesh.triangle_count = b->source->triangle_count - b->mesh.degenerate_count - b->mesh.duplicate_count;
}
