// layout.c - the record of a hull, from its facets. What the arrays hold, and in which order, stands in form/hull.h.
#include "collision/hull_build/layout.h"

#include <string.h>

// ---- directions ----------------------------------------------------------------------------------------------------
static fe_dvec3 side_of(const fe__hull_builder *b, int32_t from, int32_t to)
{
    const int32_t *point = b->surface.point;
    return fe__dsub(fe__cloud_point(&b->cloud, point[to]), fe__cloud_point(&b->cloud, point[from]));
}

int32_t fe__hull_is_known_direction(const fe_dvec3 *known, int32_t count, fe_dvec3 direction)
{
    static const double parallel = 1e-5; // sine
    static const double nearly = 0.99;   // cosine
    for (int32_t i = 0; i < count; ++i) {
        if (fe__absd(fe__ddot(known[i], direction)) < nearly) continue;
        fe_dvec3 n = fe__dcross(known[i], direction);
        if (fe__ddot(n, n) <= parallel * parallel) return 1;
    }
    return 0;
}

static int32_t corner_after(const fe__facet *loop, int32_t i)
{
    return i + 1 < loop->first + loop->count ? i + 1 : loop->first;
}

// Of the edges that are not parallel; none when there are too many.
static void find_directions(fe__hull_builder *b)
{
    const fe__facets *f = &b->facets;
    b->direction_count = 0;
    for (int32_t facet = 0; facet < f->count; ++facet) {
        const fe__facet *loop = &f->facets[facet];
        for (int32_t i = loop->first; i < loop->first + loop->count; ++i) {
            if (f->across[i] < facet) continue;
            fe_dvec3 side = side_of(b, f->corner[i], f->corner[corner_after(loop, i)]);
            side = fe__dscale(1.0 / sqrt(fe__ddot(side, side)), side);
            if (fe__hull_is_known_direction(b->direction, b->direction_count, side)) continue;
            if (b->direction_count == FE__HULL_DIRECTIONS) {
                b->direction_count = 0;
                return;
            }
            b->direction[b->direction_count++] = side;
        }
    }
}

// ---- topology ------------------------------------------------------------------------------------------------------
// The corner of `facet` from which a side runs from vertex `from` to `to`.
static int32_t find_side(const fe__facets *f, int32_t facet, int32_t from, int32_t to)
{
    const fe__facet *loop = &f->facets[facet];
    int32_t i = loop->first;
    while (f->corner[i] != from || f->corner[corner_after(loop, i)] != to) ++i;
    return i;
}

// Each pair of half-edges where it is met from its lower vertex.
static void number_edges(fe__hull_builder *b)
{
    const fe__facets *f = &b->facets;
    b->edge_end = 0;
    for (int32_t facet = 0; facet < f->count; ++facet) {
        const fe__facet *loop = &f->facets[facet];
        for (int32_t i = loop->first; i < loop->first + loop->count; ++i) {
            int32_t from = f->corner[i], to = f->corner[corner_after(loop, i)];
            if (b->number[from] > b->number[to]) continue;
            b->half[i] = b->edge_end;
            b->half[find_side(f, f->across[i], to, from)] = (uint16_t)(b->edge_end + 1);
            b->edge_end = (uint16_t)(b->edge_end + 2);
        }
    }
}

static int32_t lowest_corner(const fe__hull_builder *b, const fe__facet *loop)
{
    int32_t lowest = loop->first;
    for (int32_t i = loop->first; i < loop->first + loop->count; ++i)
        if (b->number[b->facets.corner[i]] < b->number[b->facets.corner[lowest]]) lowest = i;
    return lowest;
}

static void write_topology(const fe__hull_builder *b, fe__hull *h)
{
    const fe__facets *f = &b->facets;
    uint16_t half[FE__HULL_CORNERS];
    for (int32_t facet = 0, end = 0; facet < f->count; ++facet) {
        const fe__facet *loop = &f->facets[facet];
        int32_t i = lowest_corner(b, loop);
        fe__hull_own_faces(h)[facet].count = (uint16_t)loop->count;
        for (int32_t k = 0; k < loop->count; ++k, i = corner_after(loop, i), ++end) {
            fe__hull_own_corners(h)[end] = (uint8_t)b->number[f->corner[i]];
            half[end] = b->half[i];
        }
    }
    fe__hull_connect(h, half);
}

// ---- geometry ------------------------------------------------------------------------------------------------------
// 0 unless the cloud is far from it: then float(middle), from which all points differ by floats exactly (Sterbenz 1974:
// none is more than twice, or less than half of it)
static float origin_along(double middle, double extent)
{
    return fe__absd(middle) > 2.0 * extent ? (float)middle : 0.0f;
}

static void write_vertices(const fe__hull_builder *b, fe__hull *h)
{
    for (int32_t i = 0; i < h->vertex_count; ++i) {
        fe_dvec3 p = fe__cloud_point(&b->cloud, b->surface.point[b->vertex[i]]);
        fe__hull_set_vertex(h, i, fe__narrow(fe__dsub(p, fe__widen(h->origin))));
    }
}

static void write_directions(const fe__hull_builder *b, const fe__hull *h)
{
    for (int32_t i = 0; i < h->face_count; ++i) {
        const fe__grid_plane *plane = fe__facet_plane(&b->facets, i);
        fe__hull_set_lane(&h->normals, i, fe__narrow(fe__dscale(plane->per_length, plane->normal)));
    }
    for (int32_t i = 0; i < h->direction_count; ++i) fe__hull_set_lane(&h->directions, i, fe__narrow(b->direction[i]));
}

// ---- the interface -------------------------------------------------------------------------------------------------
static void set_counts(const fe__hull_builder *b, fe__hull *h)
{
    h->vertex_count = b->vertex_count;
    h->face_count = b->facets.count;
    h->edge_count = b->facets.corner_count / 2;
    h->direction_count = b->direction_count;
}

int64_t fe__hull_block_size(fe__hull_builder *b)
{
    find_directions(b);
    fe__hull h;
    set_counts(b, &h);
    return fe__hull_share(&h, NULL);
}

void fe__hull_lay_out(fe__hull_builder *b, void *block, fe__hull *h)
{
    memset(h, 0, sizeof *h);
    set_counts(b, h);
    fe__hull_share(h, block);
    fe_dvec3 middle = b->cloud.middle;
    double extent = b->cloud.extent;
    h->origin =
        fe__vec3(origin_along(middle.x, extent), origin_along(middle.y, extent), origin_along(middle.z, extent));
    h->thickness = (float)b->thickness;
    h->extent = (float)extent;
    h->tolerance = (float)b->tolerance;
    number_edges(b);
    write_topology(b, h);
    write_vertices(b, h);
    write_directions(b, h);
    fe__hull_place_planes(h);
    fe__hull_finish(h);
}
