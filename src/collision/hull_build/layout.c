// layout.c - the record of a hull, from its facets. What the arrays hold, and in which order, stands in form/hull.h.
#include "collision/hull_build/layout.h"

#include <string.h>

// ---- room ----------------------------------------------------------------------------------------------------------
// Hands out arrays one after another; without a block it only counts.
typedef struct room {
    char *block;
    int64_t end;
} room;

static void *take(room *r, int64_t size)
{
    void *at = r->block ? r->block + r->end : NULL;
    r->end += (size + 63) / 64 * 64;
    return at;
}

static float *take_floats(room *r, int32_t count) { return take(r, (int64_t)sizeof(float) * fe__hull_padded(count)); }

static fe__hull_lanes take_lanes(room *r, int32_t count)
{
    const float *x = take_floats(r, count), *y = take_floats(r, count), *z = take_floats(r, count);
    return (fe__hull_lanes){x, y, z};
}

int64_t fe__hull_take_arrays(fe__hull *h, void *block)
{
    room of_block = {block, 0}, *r = &of_block;
    h->vertices = take_lanes(r, h->vertex_count);
    h->normals = take_lanes(r, h->face_count);
    h->distances = take_floats(r, h->face_count);
    h->tails = take_lanes(r, h->edge_count);
    h->vectors = take_lanes(r, h->edge_count);
    h->left = take_lanes(r, h->edge_count);
    h->right = take_lanes(r, h->edge_count);
    h->directions = take_lanes(r, h->direction_count);
    h->edges = take(r, (int64_t)sizeof(fe__hull_edge) * 2 * h->edge_count);
    h->faces = take(r, (int64_t)sizeof(fe__hull_face) * h->face_count);
    h->spokes = take(r, (int64_t)sizeof(uint16_t) * h->vertex_count);
    h->corners = take(r, 2 * h->edge_count);
    h->block = block;
    h->size = r->end;
    return r->end;
}

// ---- lanes ---------------------------------------------------------------------------------------------------------
// The block is the builder's until it hands the hull out.
static float *writable(const float *array) { return (float *)(uintptr_t)array; }

static void set_lane(const fe__hull_lanes *lanes, int32_t i, fe_vec3 a)
{
    writable(lanes->x)[i] = a.x, writable(lanes->y)[i] = a.y, writable(lanes->z)[i] = a.z;
}

static void pad(const float *array, int32_t count)
{
    for (int32_t i = count; i < fe__hull_padded(count); ++i) writable(array)[i] = array[0];
}

static void pad_lanes(const fe__hull_lanes *lanes, int32_t count)
{
    pad(lanes->x, count), pad(lanes->y, count), pad(lanes->z, count);
}

// ---- directions ----------------------------------------------------------------------------------------------------
static fe_dvec3 side_of(const fe__hull_builder *b, int32_t from, int32_t to)
{
    const int32_t *point = b->surface.point;
    return fe__dsub(fe__cloud_point(&b->cloud, point[to]), fe__cloud_point(&b->cloud, point[from]));
}

int32_t fe__hull_is_known_direction(const fe_dvec3 *known, int32_t count, fe_dvec3 direction)
{
    static const double parallel = 1e-5; // sine
    for (int32_t i = 0; i < count; ++i) {
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

static void write_topology(const fe__hull_builder *b, const fe__hull *h)
{
    const fe__facets *f = &b->facets;
    fe__hull_edge *edges = (fe__hull_edge *)(uintptr_t)h->edges;
    fe__hull_face *faces = (fe__hull_face *)(uintptr_t)h->faces;
    uint16_t *spokes = (uint16_t *)(uintptr_t)h->spokes;
    uint8_t *corners = (uint8_t *)(uintptr_t)h->corners;
    for (int32_t facet = 0, end = 0; facet < f->count; ++facet) {
        const fe__facet *loop = &f->facets[facet];
        int32_t i = lowest_corner(b, loop);
        faces[facet] = (fe__hull_face){(uint16_t)end, (uint16_t)loop->count, b->half[i], 0};
        for (int32_t k = 0; k < loop->count; ++k, i = corner_after(loop, i)) {
            int32_t vertex = b->number[f->corner[i]];
            corners[end++] = (uint8_t)vertex;
            edges[b->half[i]] =
                (fe__hull_edge){b->half[corner_after(loop, i)], (uint16_t)facet, (uint8_t)vertex, {0, 0, 0}};
            spokes[vertex] = b->half[i];
        }
    }
}

// ---- geometry ------------------------------------------------------------------------------------------------------
// 0 unless the cloud is far from it: then float(middle), from which all points differ by floats exactly (Sterbenz 1974:
// none is more than twice, or less than half of it)
static float origin_along(double middle, double extent)
{
    return fe__absd(middle) > 2.0 * extent ? (float)middle : 0.0f;
}

void fe__hull_set_vertex(fe__hull *h, int32_t i, fe_vec3 v)
{
    set_lane(&h->vertices, i, v);
    h->low = i ? fe__vec3(fe__minf(h->low.x, v.x), fe__minf(h->low.y, v.y), fe__minf(h->low.z, v.z)) : v;
    h->high = i ? fe__vec3(fe__maxf(h->high.x, v.x), fe__maxf(h->high.y, v.y), fe__maxf(h->high.z, v.z)) : v;
}

static void write_vertices(const fe__hull_builder *b, fe__hull *h)
{
    for (int32_t i = 0; i < h->vertex_count; ++i) {
        fe_dvec3 p = fe__cloud_point(&b->cloud, b->surface.point[b->vertex[i]]);
        fe__hull_set_vertex(h, i, fe__narrow(fe__dsub(p, fe__widen(h->origin))));
    }
}

static double along(const fe__hull *h, fe_vec3 normal, int32_t vertex)
{
    return fe__ddot(fe__widen(normal), fe__widen(fe__hull_vertex(h, vertex)));
}

double fe__hull_set_plane(const fe__hull *h, int32_t face, fe_vec3 normal)
{
    double farthest = along(h, normal, 0), flatness = 0.0;
    for (int32_t v = 1; v < h->vertex_count; ++v) farthest = fe__maxd(farthest, along(h, normal, v));
    float distance = fe__float_above(farthest);
    set_lane(&h->normals, face, normal);
    writable(h->distances)[face] = distance;
    const uint8_t *corner = h->corners + h->faces[face].first;
    for (int32_t k = 0; k < h->faces[face].count; ++k)
        flatness = fe__maxd(flatness, (double)distance - along(h, normal, corner[k]));
    return flatness;
}

static void write_planes(const fe__hull_builder *b, fe__hull *h)
{
    double flatness = 0.0;
    for (int32_t i = 0; i < h->face_count; ++i) {
        const fe__grid_plane *plane = fe__facet_plane(&b->facets, i);
        fe_vec3 normal = fe__narrow(fe__dscale(plane->per_length, plane->normal));
        flatness = fe__maxd(flatness, fe__hull_set_plane(h, i, normal));
    }
    h->flatness = fe__float_above(flatness);
}

void fe__hull_finish(fe__hull *h, const fe_dvec3 *directions)
{
    pad_lanes(&h->vertices, h->vertex_count);
    pad_lanes(&h->normals, h->face_count);
    pad(h->distances, h->face_count);
    for (int32_t k = 0; k < h->edge_count; ++k) {
        const fe__hull_edge *edge = &h->edges[2 * k];
        fe_vec3 tail = fe__hull_vertex(h, edge[0].origin);
        set_lane(&h->tails, k, tail);
        set_lane(&h->vectors, k, fe__sub(fe__hull_vertex(h, edge[1].origin), tail));
        set_lane(&h->left, k, fe__hull_normal(h, edge[0].face));
        set_lane(&h->right, k, fe__hull_normal(h, edge[1].face));
    }
    pad_lanes(&h->tails, h->edge_count), pad_lanes(&h->vectors, h->edge_count);
    pad_lanes(&h->left, h->edge_count), pad_lanes(&h->right, h->edge_count);
    for (int32_t i = 0; i < h->direction_count; ++i) set_lane(&h->directions, i, fe__narrow(directions[i]));
    if (h->direction_count) pad_lanes(&h->directions, h->direction_count);
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
    return fe__hull_take_arrays(&h, NULL);
}

void fe__hull_lay_out(fe__hull_builder *b, void *block, fe__hull *h)
{
    memset(h, 0, sizeof *h);
    set_counts(b, h);
    fe__hull_take_arrays(h, block);
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
    write_planes(b, h);
    fe__hull_finish(h, b->direction);
}
