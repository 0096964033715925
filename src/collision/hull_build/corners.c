// corners.c - corners that bound two facets only lie on the line in which these meet, and are none.
//
// Such corners stand between two that bound more. Of each row the one farthest from the straight line past it stays
// while it is farther than the slab, and divides the row (Ramer 1972, Douglas and Peucker 1973).
#include "collision/hull_build/facets.h"

static int32_t is_corner(const fe__facets *f, int32_t i) { return f->valence[f->corner[i]] > 2; }

static int32_t after(const fe__facet *loop, int32_t i)
{
    return i + 1 < loop->first + loop->count ? i + 1 : loop->first;
}

static double distance_from_line(const fe__facets *f, int32_t vertex, int32_t from, int32_t to)
{
    fe_dvec3 start = fe__vertex_on_grid(f->surface, from), way = fe__dsub(fe__vertex_on_grid(f->surface, to), start),
             n = fe__dcross(way, fe__dsub(fe__vertex_on_grid(f->surface, vertex), start));
    return sqrt(fe__ddot(n, n) / fe__ddot(way, way));
}

// row[first] and row[last] stay. Writes who else does; returns how many.
static int32_t choose(const fe__facets *f, const int32_t *row, int32_t count, uint8_t *stays)
{
    int32_t ends[2 * FE__SURFACE_VERTICES][2], depth = 0, kept = 0;
    ends[depth][0] = 0, ends[depth++][1] = count - 1;
    while (depth) {
        int32_t first = ends[--depth][0], last = ends[depth][1], farthest = -1;
        double most = f->slab;
        for (int32_t i = first + 1; i < last; ++i) {
            double distance = distance_from_line(f, row[i], row[first], row[last]);
            stays[i] = 0;
            if (distance <= most) continue;
            most = distance;
            farthest = i;
        }
        if (farthest < 0) continue;
        stays[farthest] = 1;
        kept += 1;
        ends[depth][0] = first, ends[depth++][1] = farthest;
        ends[depth][0] = farthest, ends[depth++][1] = last;
    }
    return kept;
}

// ---- loops that stay convex ----------------------------------------------------------------------------------------
static int32_t is_left_of_slab(const fe__facets *f, const fe__grid_plane *plane, const int32_t corner[3])
{
    fe_dvec3 here = fe__vertex_on_grid(f->surface, corner[1]),
             in = fe__dsub(here, fe__vertex_on_grid(f->surface, corner[0])),
             out = fe__dsub(fe__vertex_on_grid(f->surface, corner[2]), here), past = fe__dadd(in, out);
    double turn = fe__ddot(fe__dcross(in, out), plane->normal) * plane->per_length;
    return turn >= -f->slab * sqrt(fe__ddot(past, past));
}

// Without the vertices of valence 0
static int32_t is_convex(const fe__facets *f, int32_t facet)
{
    const fe__facet *loop = &f->facets[facet];
    int32_t last[3] = {-1, -1, -1}, seen = 0;
    for (int32_t i = 0; seen < loop->count + 2 && i < 2 * loop->count; ++i) {
        int32_t vertex = f->corner[loop->first + i % loop->count];
        if (!f->valence[vertex]) continue;
        last[0] = last[1], last[1] = last[2], last[2] = vertex;
        seen += 1;
        if (seen >= 3 && !is_left_of_slab(f, fe__facet_plane(f, facet), last)) return 0;
    }
    return 1;
}

static void set_valence(fe__facets *f, const int32_t *row, int32_t count, const uint8_t *stays, int32_t valence)
{
    for (int32_t k = 1; k < count - 1; ++k)
        if (!stays[k]) f->valence[row[k]] = valence;
}

// The row that begins at corner i of a loop. Facets keep three corners at least.
static void thin_row(fe__facets *f, const fe__facet *loop, int32_t i, int32_t *left)
{
    int32_t row[FE__SURFACE_VERTICES], count = 0, facet = (int32_t)(loop - f->facets), across = f->across[i];
    uint8_t stays[FE__SURFACE_VERTICES];
    row[count++] = f->corner[i];
    do {
        i = after(loop, i);
        row[count++] = f->corner[i];
    } while (!is_corner(f, i));
    if (row[0] == row[count - 1]) return;
    int32_t gone = count - 2 - choose(f, row, count, stays);
    if (left[facet] - gone < 3 || left[across] - gone < 3) return;
    set_valence(f, row, count, stays, 0);
    if (is_convex(f, facet) && is_convex(f, across))
        left[facet] -= gone, left[across] -= gone;
    else
        set_valence(f, row, count, stays, 2);
}

static void count_valences(fe__facets *f)
{
    for (int32_t v = 0; v < FE__SURFACE_VERTICES; ++v) f->valence[v] = 0;
    for (int32_t i = 0; i < f->corner_count; ++i) f->valence[f->corner[i]] += 1;
}

// Loops without the vertices of valence 0
static void close_up(fe__facets *f)
{
    int32_t end = 0;
    for (int32_t facet = 0; facet < f->count; ++facet) {
        fe__facet *loop = &f->facets[facet];
        int32_t first = end;
        for (int32_t i = loop->first; i < loop->first + loop->count; ++i) {
            if (!f->valence[f->corner[i]]) continue;
            f->corner[end] = f->corner[i];
            f->across[end++] = f->across[i];
        }
        loop->first = first;
        loop->count = end - first;
    }
    f->corner_count = end;
}

void fe__facets_drop_corners(fe__facets *f)
{
    int32_t left[FE__SURFACE_TRIANGLES];
    count_valences(f);
    for (int32_t facet = 0; facet < f->count; ++facet) left[facet] = f->facets[facet].count;
    for (int32_t facet = 0; facet < f->count; ++facet) {
        const fe__facet *loop = &f->facets[facet];
        for (int32_t i = loop->first; i < loop->first + loop->count; ++i) {
            if (f->across[i] > facet && is_corner(f, i) && !is_corner(f, after(loop, i))) thin_row(f, loop, i, left);
        }
    }
    close_up(f);
}
