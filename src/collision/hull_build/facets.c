// facets.c - see facets.h.
#include "collision/hull_build/facets.h"

#include <string.h>

// Slabs of a seed, thinner with every failure. The last takes triangles that are in one plane exactly.
enum { SLABS = 4 };
static const double slab_shares[SLABS] = {1.0, 0.125, 1.0 / 64.0, 0.0};

// Triangles that lean farther from the seed's normal stay out: above a sharp edge the far side is in the slab too.
// Cosine of 60 degrees
static const double least_cosine = 0.5;

// How far two neighbours must bend, rad: floats tell their normals apart
static const double least_bend = 5e-7;

// ---- triangles, the largest first ----------------------------------------------------------------------------------
// The bits of positive doubles are in the order of their values.
static uint64_t falling(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return ~bits;
}

static void sort_triangles(fe__facets *f)
{
    const fe__hull_surface *s = f->surface;
    f->living = 0;
    for (int32_t i = 0; i < s->triangle_end; ++i) {
        const fe__grid_plane *plane = &s->triangles[i].plane;
        if (s->triangles[i].alive)
            f->items[f->living++] = (fe__sort_item){falling(fe__ddot(plane->normal, plane->normal)), i, 0};
    }
    fe__sort_keys(f->items, f->living, f->sorting);
    for (int32_t i = 0; i < f->living; ++i) f->order[i] = f->items[i].value;
}

// ---- growth --------------------------------------------------------------------------------------------------------
static int32_t fits(const fe__facets *f, int32_t seed, int32_t triangle, int32_t apex)
{
    const fe__hull_surface *s = f->surface;
    const fe__grid_plane *plane = &s->triangles[seed].plane, *other = &s->triangles[triangle].plane;
    double cosine = fe__ddot(plane->normal, other->normal) * plane->per_length * other->per_length;
    if (cosine < least_cosine) return 0;
    fe_dvec3 p = fe__vertex_on_grid(s, apex);
    if (f->thinness[seed] == SLABS - 1) return fe__grid_side(plane, p) == 0;
    return fe__grid_height(plane, p) >= -f->slab * slab_shares[f->thinness[seed]];
}

static void link_ring(fe__facets *f, int32_t from, int32_t to, int32_t edge)
{
    f->next[from] = to;
    f->previous[to] = from;
    f->edge[from] = edge;
    f->to_try[f->try_count++] = edge;
}

static void leave_ring(fe__facets *f, int32_t vertex)
{
    f->in_ring[vertex] = 0;
    if (f->ring_start == vertex) f->ring_start = f->next[vertex];
}

static void take(fe__facets *f, int32_t triangle, int32_t facet)
{
    f->facet_of[triangle] = facet;
    f->members[f->member_count++] = triangle;
}

static void begin_ring(fe__facets *f, int32_t seed, int32_t facet)
{
    f->ring += 1;
    f->try_count = f->member_count = 0;
    f->ring_start = f->surface->triangles[seed].corner[0];
    take(f, seed, facet);
    for (int32_t k = 0; k < 3; ++k) {
        int32_t edge = 3 * seed + k;
        f->in_ring[fe__edge_start(f->surface, edge)] = f->ring;
        link_ring(f, fe__edge_start(f->surface, edge), fe__edge_end(f->surface, edge), edge);
    }
}

// The triangle over an edge of the rim joins, if it fits and the facet stays a disc: its apex is new, or a neighbour in
// the ring of one end of the edge, which then lies inside.
static void try_edge(fe__facets *f, int32_t edge, int32_t seed, int32_t facet)
{
    const fe__hull_surface *s = f->surface;
    int32_t from = fe__edge_start(s, edge), to = fe__edge_end(s, edge);
    if (f->in_ring[from] != f->ring || f->edge[from] != edge) return;
    int32_t twin = fe__edge_twin(s, edge), triangle = twin / 3, first = fe__next_corner(twin),
            second = fe__next_corner(first), apex = fe__edge_end(s, first);
    if (f->facet_of[triangle] >= 0 || !fits(f, seed, triangle, apex)) return;
    if (f->in_ring[apex] != f->ring) {
        f->in_ring[apex] = f->ring;
        link_ring(f, from, apex, first);
        link_ring(f, apex, to, second);
    } else if (f->next[to] == apex && fe__edge_twin(s, f->edge[to]) == second) {
        leave_ring(f, to);
        link_ring(f, from, apex, first);
    } else if (f->previous[from] == apex && fe__edge_twin(s, f->edge[apex]) == first) {
        leave_ring(f, from);
        link_ring(f, apex, to, second);
    } else {
        return;
    }
    take(f, triangle, facet);
}

// ---- the rim -------------------------------------------------------------------------------------------------------
// Does the rim turn left at every vertex, or right by no more than the slab? (How far a vertex is inside of the line
// past it; rounding of points on one line must not divide a face.)
static int32_t is_convex(const fe__facets *f, int32_t seed)
{
    const fe__hull_surface *s = f->surface;
    const fe__grid_plane *plane = &s->triangles[seed].plane;
    int32_t start = f->ring_start, v = start;
    do {
        fe_dvec3 here = fe__vertex_on_grid(s, v), in = fe__dsub(here, fe__vertex_on_grid(s, f->previous[v])),
                 out = fe__dsub(fe__vertex_on_grid(s, f->next[v]), here), past = fe__dadd(in, out);
        double turn = fe__ddot(fe__dcross(in, out), plane->normal) * plane->per_length;
        if (turn < -f->slab * sqrt(fe__ddot(past, past))) return 0;
        v = f->next[v];
    } while (v != start);
    return 1;
}

static void keep_ring(fe__facets *f, int32_t seed)
{
    int32_t start = f->ring_start;
    fe__facet *facet = &f->facets[f->count++];
    *facet = (fe__facet){seed, f->corner_count, 0};
    int32_t v = start;
    do {
        f->corner[f->corner_count] = v;
        f->across[f->corner_count++] = fe__edge_twin(f->surface, f->edge[v]) / 3; // a triangle, until all have facets
        facet->count += 1;
        v = f->next[v];
    } while (v != start);
}

static int32_t make_thinner(fe__facets *f, int32_t facet)
{
    int32_t *thinness = &f->thinness[f->facets[facet].seed];
    if (*thinness == SLABS - 1) return 0;
    *thinness += 1;
    return 1;
}

// Triangles in one plane exactly make a convex facet, unless another has taken some of them: that one is made again.
static void claim_back(fe__facets *f, int32_t seed)
{
    for (int32_t i = 0; i < f->member_count; ++i) {
        for (int32_t k = 0; k < 3; ++k) {
            int32_t twin = fe__edge_twin(f->surface, 3 * f->members[i] + k), other = f->facet_of[twin / 3],
                    apex = fe__edge_end(f->surface, fe__next_corner(twin));
            if (other >= 0 && other != f->count && fits(f, seed, twin / 3, apex)) f->again |= make_thinner(f, other);
        }
    }
}

// Most triangles of a cloud in general position are facets by themselves: no neighbour fits, and no rim is to be made.
static int32_t stands_alone(const fe__facets *f, int32_t seed)
{
    const fe__surface_triangle *t = &f->surface->triangles[seed];
    for (int32_t k = 0; k < 3; ++k) {
        int32_t twin = t->twin[k], triangle = twin / 3;
        if (f->facet_of[triangle] < 0 && fits(f, seed, triangle, fe__edge_end(f->surface, fe__next_corner(twin))))
            return 0;
    }
    return 1;
}

static void keep_triangle(fe__facets *f, int32_t seed)
{
    const fe__surface_triangle *t = &f->surface->triangles[seed];
    f->facet_of[seed] = f->count;
    f->facets[f->count++] = (fe__facet){seed, f->corner_count, 3};
    for (int32_t k = 0; k < 3; ++k) {
        f->corner[f->corner_count] = t->corner[k];
        f->across[f->corner_count++] = t->twin[k] / 3;
    }
}

static void grow_facet(fe__facets *f, int32_t seed)
{
    if (stands_alone(f, seed)) {
        keep_triangle(f, seed);
        return;
    }
    for (;;) {
        begin_ring(f, seed, f->count);
        while (f->try_count) try_edge(f, f->to_try[--f->try_count], seed, f->count);
        if (is_convex(f, seed)) break;
        if (f->thinness[seed] == SLABS - 1) {
            claim_back(f, seed);
            break;
        }
        for (int32_t i = 0; i < f->member_count; ++i) f->facet_of[f->members[i]] = -1;
        f->thinness[seed] += 1;
    }
    keep_ring(f, seed);
}

static void grow_all(fe__facets *f)
{
    f->count = f->corner_count = f->again = 0;
    for (int32_t i = 0; i < f->surface->triangle_end; ++i) f->facet_of[i] = -1;
    for (int32_t i = 0; i < f->living; ++i)
        if (f->facet_of[f->order[i]] < 0) grow_facet(f, f->order[i]);
    for (int32_t i = 0; i < f->corner_count; ++i) f->across[i] = f->facet_of[f->across[i]];
}

// ---- neighbours ----------------------------------------------------------------------------------------------------
// Do they turn away from each other? (normal_left x normal_right) . side, of unit vectors, is the sine of the bend,
// where it is about the side.
static int32_t bends(const fe__facets *f, int32_t facet, int32_t i)
{
    const fe__facet *loop = &f->facets[facet];
    int32_t next = i + 1 < loop->first + loop->count ? i + 1 : loop->first;
    fe_dvec3 side =
        fe__dsub(fe__vertex_on_grid(f->surface, f->corner[next]), fe__vertex_on_grid(f->surface, f->corner[i]));
    const fe__grid_plane *left = fe__facet_plane(f, facet), *right = fe__facet_plane(f, f->across[i]);
    double turn = fe__ddot(fe__dcross(left->unit, right->unit), side), square = fe__ddot(side, side);
    if (turn > 0.0 && turn * turn > 4.0 * least_bend * least_bend * square) return 1; // most do so, by far
    return turn / sqrt(square) > least_bend;
}

// 1: a slab became thinner, where neighbours do not turn away from each other. Both sides of an edge bend alike: it is
// asked from the first facet, and counts for each side.
static int32_t mend(fe__facets *f)
{
    int32_t thinner = f->again;
    for (int32_t facet = 0; facet < f->count; ++facet) {
        const fe__facet *loop = &f->facets[facet];
        for (int32_t i = loop->first; i < loop->first + loop->count; ++i) {
            if (f->across[i] < facet || bends(f, facet, i)) continue;
            for (int32_t sides = 0; sides < 2; ++sides)
                thinner |= make_thinner(f, facet) | make_thinner(f, f->across[i]);
        }
    }
    return thinner;
}

void fe__facets_find(fe__facets *f, const fe__hull_surface *surface, double slab)
{
    f->surface = surface;
    f->slab = slab;
    f->ring = 0;
    memset(f->in_ring, 0, sizeof f->in_ring);
    memset(f->thinness, 0, sizeof f->thinness);
    sort_triangles(f);
    do grow_all(f);
    while (mend(f));
}
