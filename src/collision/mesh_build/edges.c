// edges.c - which triangles count, and what their edges are.
//
// Triangles without height are dropped. Half-edges are sorted by their edge: into buckets by its lower vertex, in them
// by the other vertex, then by the triangle's third one. So the half-edges of an edge follow each other, and among them
// those of triangles that are the same: these have the same three vertices and the same winding; the first stays.
//
// An edge of two triangles is convex when the third vertex of one lies below the other's plane. It is felt when their
// normals turn by more than the edge angle.
#include "collision/mesh_build/build.h"
#include "core/trig.h"

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

// They come in the order of their numbers: the sort is stable. Of two with the same vertices the forward one is first
static void sort_few(const workroom *w, uint32_t *half, uint32_t count)
{
    struct {
        uint64_t key;
        uint32_t half, is_backward;
    } sorted[FEW];
    for (uint32_t i = 0; i < count; ++i) {
        half_edge h = read_half(w, half[i]);
        uint64_t key = (uint64_t)h.other << 32 | h.third;
        uint32_t place = i, is_backward = !h.is_forward;
        for (; place > 0 && (sorted[place - 1].key > key ||
                             (sorted[place - 1].key == key && sorted[place - 1].is_backward > is_backward));
             --place)
            sorted[place] = sorted[place - 1];
        sorted[place].key = key, sorted[place].half = half[i], sorted[place].is_backward = is_backward;
    }
    for (uint32_t i = 0; i < count; ++i) half[i] = sorted[i].half;
}

// ---- edges ---------------------------------------------------------------------------------------------------------
static void mark(workroom *w, uint32_t half, fe__mesh_edge edge)
{
    static const uint32_t digit[3] = {1, FE__MESH_EDGES, FE__MESH_EDGES * FE__MESH_EDGES};
    uint8_t *edges = w->builder->edges + (half >> HALF_BITS);
    *edges = (uint8_t)(*edges + (uint32_t)edge * digit[half & HALF_MASK]);
}

static fe__mesh_edge bend(const workroom *w, uint32_t a, uint32_t b)
{
    half_edge x = read_half(w, a), y = read_half(w, b);
    if (x.third == y.third) return FE__MESH_EDGE_CONVEX; // back to back
    fe_dvec3 v[3], u[3], third = fe__widen(fe__mesh_source_vertex(w->builder->source, y.third));
    read_triangle(w, a >> HALF_BITS, v);
    fe_dvec3 n = normal_of(v);
    if (!(fe__ddot(n, fe__dsub(third, v[a & HALF_MASK])) < 0.0)) return FE__MESH_EDGE_SMOOTH;
    read_triangle(w, b >> HALF_BITS, u);
    fe_dvec3 m = normal_of(u);
    double cosine = fe__ddot(n, m) / sqrt(fe__ddot(n, n) * fe__ddot(m, m));
    return cosine < w->least_cosine ? FE__MESH_EDGE_CONVEX : FE__MESH_EDGE_BENT;
}

// Half-edges of one edge: those of duplicates are taken out
static uint32_t drop_duplicates(workroom *w, uint32_t *half, uint32_t count)
{
    fe__mesh_builder *b = w->builder;
    uint32_t kept = 1;
    for (uint32_t i = 1; i < count; ++i) {
        half_edge x = read_half(w, half[kept - 1]), y = read_half(w, half[i]);
        if (x.third != y.third || x.is_forward != y.is_forward) {
            half[kept++] = half[i];
            continue;
        }
        uint8_t *edges = b->edges + (half[i] >> HALF_BITS);
        if (*edges == FE__MESH_DROPPED) continue; // by another edge
        *edges = FE__MESH_DROPPED;
        b->mesh.duplicate_count += 1;
        refuse(b, (int32_t)(half[i] >> HALF_BITS), 1);
    }
    return kept;
}

static void judge_edge(workroom *w, uint32_t *half, uint32_t count)
{
    fe__mesh *m = &w->builder->mesh;
    count = drop_duplicates(w, half, count);
    fe__mesh_edge edge = FE__MESH_EDGE_ODD;
    if (count == 1) {
        m->open_count += 1;
        edge = FE__MESH_EDGE_OPEN;
    } else if (count > 2) {
        m->odd_count += 1;
    } else if (read_half(w, half[0]).is_forward == read_half(w, half[1]).is_forward) {
        m->flipped_count += 1;
    } else {
        edge = bend(w, half[0], half[1]);
    }
    for (uint32_t i = 0; i < count; ++i) mark(w, half[i], edge);
}

static void judge_bucket(workroom *w, uint32_t *half, uint32_t count)
{
    if (count > FEW)
        sort_many(w, half, count);
    else
        sort_few(w, half, count);
    for (uint32_t i = 0, end; i < count; i = end) {
        uint32_t other = read_half(w, half[i]).other;
        for (end = i + 1; end < count && read_half(w, half[end]).other == other;) ++end;
        judge_edge(w, half + i, end - i);
    }
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
