// hull_builder.c - the record of a hull, from its facets. What the arrays hold, and in which order, stands in
// form/hull.h.
#include "collision/hull_build/hull_builder.h"

#include "core/lanes.h"
#include "core/math.h"

#include <float.h>
#include <string.h>

// ---- layout ---------------------------------------------------------------------------------------------------------

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

// ---- record ---------------------------------------------------------------------------------------------------------
// See hull_builder.h. What the arrays hold, and in which order, stands in form/hull.h.

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

int64_t fe__hull_share(fe__hull *h, void *block)
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
static void pad(const float *array, int32_t count)
{
    for (int32_t i = count; i < fe__hull_padded(count); ++i) fe__hull_writable(array)[i] = array[0];
}

static void pad_lanes(const fe__hull_lanes *lanes, int32_t count)
{
    pad(lanes->x, count), pad(lanes->y, count), pad(lanes->z, count);
}

// ---- topology ------------------------------------------------------------------------------------------------------
void fe__hull_connect(fe__hull *h, const uint16_t *half)
{
    fe__hull_edge *edges = (fe__hull_edge *)(uintptr_t)h->edges;
    fe__hull_face *faces = fe__hull_own_faces(h);
    uint16_t *spokes = (uint16_t *)(uintptr_t)h->spokes;
    for (int32_t face = 0, first = 0; face < h->face_count; first += faces[face++].count) {
        int32_t count = faces[face].count;
        faces[face].first = (uint16_t)first, faces[face].edge = half[first];
        for (int32_t k = 0; k < count; ++k) {
            uint16_t own = half[first + k], next = half[k + 1 < count ? first + k + 1 : first];
            edges[own] = (fe__hull_edge){next, (uint16_t)face, h->corners[first + k], {0, 0, 0}};
            spokes[h->corners[first + k]] = own;
        }
    }
}

// ---- geometry ------------------------------------------------------------------------------------------------------
void fe__hull_set_vertex(fe__hull *h, int32_t i, fe_vec3 v)
{
    fe__hull_set_lane(&h->vertices, i, v);
    h->low = i ? fe__vec3(fe__minf(h->low.x, v.x), fe__minf(h->low.y, v.y), fe__minf(h->low.z, v.z)) : v;
    h->high = i ? fe__vec3(fe__maxf(h->high.x, v.x), fe__maxf(h->high.y, v.y), fe__maxf(h->high.z, v.z)) : v;
}

static double along(const fe__hull *h, fe_vec3 normal, int32_t vertex)
{
    return fe__ddot(fe__widen(normal), fe__widen(fe__hull_vertex(h, vertex)));
}

// Of all vertices, four at a time
static double farthest_along(const fe__hull *h, fe_vec3 normal)
{
    const double n[3] = {(double)normal.x, (double)normal.y, (double)normal.z};
    const fe__doubles x = {n[0], n[0]}, y = {n[1], n[1]}, z = {n[2], n[2]};
    double first = along(h, normal, 0);
    fe__doubles most = {first, first};
    int32_t whole = h->vertex_count / 4 * 4;
    for (int32_t v = 0; v < whole; v += 4) {
        fe__quad vx = *(const fe__quad *)(h->vertices.x + v), vy = *(const fe__quad *)(h->vertices.y + v),
                 vz = *(const fe__quad *)(h->vertices.z + v);
        most = fe__doubles_max(x * fe__doubles_low(vx) + y * fe__doubles_low(vy) + z * fe__doubles_low(vz), most);
        most = fe__doubles_max(x * fe__doubles_high(vx) + y * fe__doubles_high(vy) + z * fe__doubles_high(vz), most);
    }
    double farthest = fe__maxd(most[0], most[1]);
    int32_t rest = farthest == 0.0 ? 0 : whole; // of -0 and 0 the last one stays
    for (int32_t v = rest; v < h->vertex_count; ++v) farthest = fe__maxd(farthest, along(h, normal, v));
    return farthest;
}

double fe__hull_set_plane(const fe__hull *h, int32_t face, fe_vec3 normal)
{
    double farthest = farthest_along(h, normal), flatness = 0.0;
    float distance = fe__float_above(farthest);
    fe__hull_set_lane(&h->normals, face, normal);
    fe__hull_writable(h->distances)[face] = distance;
    const uint8_t *corner = h->corners + h->faces[face].first;
    for (int32_t k = 0; k < h->faces[face].count; ++k)
        flatness = fe__maxd(flatness, (double)distance - along(h, normal, corner[k]));
    return flatness;
}

void fe__hull_place_planes(fe__hull *h)
{
    double flatness = 0.0;
    for (int32_t i = 0; i < h->face_count; ++i)
        flatness = fe__maxd(flatness, fe__hull_set_plane(h, i, fe__hull_normal(h, i)));
    h->flatness = fe__float_above(flatness);
}

void fe__hull_finish(const fe__hull *h)
{
    for (int32_t k = 0; k < h->edge_count; ++k) {
        const fe__hull_edge *edge = &h->edges[2 * k];
        fe_vec3 tail = fe__hull_vertex(h, edge[0].origin);
        fe__hull_set_lane(&h->tails, k, tail);
        fe__hull_set_lane(&h->vectors, k, fe__sub(fe__hull_vertex(h, edge[1].origin), tail));
        fe__hull_set_lane(&h->left, k, fe__hull_normal(h, edge[0].face));
        fe__hull_set_lane(&h->right, k, fe__hull_normal(h, edge[1].face));
    }
    pad_lanes(&h->vertices, h->vertex_count);
    pad_lanes(&h->normals, h->face_count);
    pad(h->distances, h->face_count);
    pad_lanes(&h->tails, h->edge_count), pad_lanes(&h->vectors, h->edge_count);
    pad_lanes(&h->left, h->edge_count), pad_lanes(&h->right, h->edge_count);
    if (h->direction_count) pad_lanes(&h->directions, h->direction_count);
}

// ---- measure --------------------------------------------------------------------------------------------------------
// What a hull weighs, and how far points that were left out lie outside.

// ---- mass ----------------------------------------------------------------------------------------------------------
// Integrals over a tetrahedron from 0 to a, b, c of density 1, d = a . (b x c), s = a + b + c:
//     volume d / 6,   first moment d / 24 s,   second moments d / 120 (a a^T + b b^T + c c^T + s s^T)
// (Eberly, Polyhedral mass properties, 2002). A hull is the sum over the triangles of its faces, from a vertex of its.
typedef struct moments {
    double volume, area;
    fe_dvec3 first;
    fe__tensor second;
} moments;

static inline void add_row(double row[3], double weight, fe_dvec3 v)
{
    row[0] += weight * v.x, row[1] += weight * v.y, row[2] += weight * v.z;
}

static inline __attribute__((always_inline)) void add_square(fe__tensor *sum, double weight, fe_dvec3 v)
{
    add_row(sum->m[0], weight * v.x, v), add_row(sum->m[1], weight * v.y, v), add_row(sum->m[2], weight * v.z, v);
}

static void add_tetrahedron(moments *m, fe_dvec3 a, fe_dvec3 b, fe_dvec3 c)
{
    double d = fe__ddot(a, fe__dcross(b, c));
    fe_dvec3 s = fe__dadd(fe__dadd(a, b), c), n = fe__dcross(fe__dsub(b, a), fe__dsub(c, a));
    m->volume += d / 6.0;
    m->area += 0.5 * sqrt(fe__ddot(n, n));
    m->first = fe__dadd(m->first, fe__dscale(d / 24.0, s));
    add_square(&m->second, d / 120.0, a);
    add_square(&m->second, d / 120.0, b);
    add_square(&m->second, d / 120.0, c);
    add_square(&m->second, d / 120.0, s);
}

static fe_dvec3 mean_vertex(const fe__hull *h)
{
    fe_dvec3 sum = {0.0, 0.0, 0.0};
    for (int32_t i = 0; i < h->vertex_count; ++i) sum = fe__dadd(sum, fe__widen(fe__hull_vertex(h, i)));
    return fe__dscale(1.0 / (double)h->vertex_count, sum);
}

// About `from`: inside, so that nothing cancels
static moments sum_moments(const fe__hull *h, fe_dvec3 from)
{
    moments m = {0};
    for (int32_t face = 0; face < h->face_count; ++face) {
        const uint8_t *corner = h->corners + h->faces[face].first;
        fe_dvec3 a = fe__dsub(fe__widen(fe__hull_vertex(h, corner[0])), from), b, c;
        for (int32_t k = 2; k < h->faces[face].count; ++k) {
            b = fe__dsub(fe__widen(fe__hull_vertex(h, corner[k - 1])), from);
            c = fe__dsub(fe__widen(fe__hull_vertex(h, corner[k])), from);
            add_tetrahedron(&m, a, b, c);
        }
    }
    return m;
}

static float inner_radius(const fe__hull *h, fe_dvec3 centre)
{
    double least = DBL_MAX;
    for (int32_t i = 0; i < h->face_count; ++i)
        least = fe__mind(least, (double)h->distances[i] - fe__ddot(fe__widen(fe__hull_normal(h, i)), centre));
    return (float)least;
}

void fe__hull_weigh(fe__hull *h)
{
    fe_dvec3 from = mean_vertex(h);
    moments m = sum_moments(h, from);
    fe_dvec3 centre = fe__dscale(1.0 / m.volume, m.first);
    add_square(&m.second, -m.volume, centre); // about the centre
    double trace = m.second.m[0][0] + m.second.m[1][1] + m.second.m[2][2];
    fe__tensor inertia;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) inertia.m[i][j] = (i == j ? trace : 0.0) - m.second.m[i][j];
    fe__tensor axes = fe__tensor_diagonalise(&inertia);
    fe_vec3 principal = {(float)inertia.m[0][0], (float)inertia.m[1][1], (float)inertia.m[2][2]};
    h->mass = (fe__hull_mass){m.volume, m.area, fe__dadd(from, centre), principal,
                              fe__normalized(fe__tensor_rotation(&axes))};
    h->inner_radius = inner_radius(h, h->mass.centre);
}

// ---- points left out -----------------------------------------------------------------------------------------------
// Above the plane that the point is highest above, m
static double height_outside(const fe__hull *h, fe_dvec3 point)
{
    fe_dvec3 p = fe__dsub(point, fe__widen(h->origin));
    double most = -DBL_MAX;
    for (int32_t i = 0; i < h->face_count; ++i)
        most = fe__maxd(most, fe__ddot(fe__widen(fe__hull_normal(h, i)), p) - (double)h->distances[i]);
    return most;
}

// Of points that wait at a triangle. A facet's plane is that of a triangle, lower by the slab at most: a point that is
// no higher above the triangle that it waits at, its highest, need not be measured.
static double error_of_waiting(const fe__hull_builder *b, const fe__hull *h, int32_t triangle, double most)
{
    static const double rounding = 16.0; // steps of the grid, of the planes' floats
    const fe__cloud *cloud = &b->cloud;
    const fe__surface_triangle *t = &b->surface.triangles[triangle];
    double lower = (b->facets.slab + rounding) * cloud->step;
    if (b->surface.height[triangle] == 0.0 || b->surface.height[triangle] * cloud->step + lower <= most) return most;
    most = fe__maxd(most, height_outside(h, fe__cloud_point(cloud, t->farthest)));
    for (int32_t p = t->first_point; p >= 0; p = b->surface.next_point[p])
        if (fe__grid_height(&t->plane, cloud->grid[p]) * cloud->step + lower > most)
            most = fe__maxd(most, height_outside(h, fe__cloud_point(cloud, p)));
    return most;
}

// With the farthest known, few others are measured.
static int32_t highest_triangle(const fe__hull_surface *s)
{
    int32_t highest = 0;
    for (int32_t i = 1; i < s->triangle_end; ++i)
        if (s->height[i] > s->height[highest]) highest = i;
    return highest;
}

// Of the points that still wait outside, and of vertices that became none. All others are inside of these.
void fe__hull_measure_error(const fe__hull_builder *b, fe__hull *h)
{
    const fe__hull_surface *s = &b->surface;
    double most = 0.0;
    for (int32_t v = 0; v < FE__SURFACE_VERTICES; ++v)
        if (s->point[v] >= 0 && b->number[v] < 0)
            most = fe__maxd(most, height_outside(h, fe__cloud_point(&b->cloud, s->point[v])));
    most = error_of_waiting(b, h, highest_triangle(s), most);
    for (int32_t i = 0; i < s->triangle_end; ++i) most = error_of_waiting(b, h, i, most);
    h->error = fe__float_above(most);
}

// ---- build ----------------------------------------------------------------------------------------------------------

// Points outside may use three quarters of the tolerance, the slab of a face a quarter
static const double outside_share = 0.75, slab_share = 0.25;
// A slab of a larger share of the thickness could hold faces of both sides
static const double slab_of_thickness = 1.0 / 32.0;

static size_t grid_offset(void) { return (sizeof(fe__hull_builder) + 63) / 64 * 64; }
static size_t grid_size(int32_t count) { return (size_t)count * sizeof(fe_dvec3); }

int64_t fe__hull_builder_size(int32_t count)
{
    return (int64_t)(grid_offset() + grid_size(count) + (size_t)count * sizeof(int32_t));
}

static void begin(fe__hull_builder *b, const fe__hull_points *points)
{
    b->cloud = (fe__cloud){.points = points->points, .stride = points->stride, .count = points->count};
    b->cloud.grid = (fe_dvec3 *)(void *)((char *)b + grid_offset());
    b->surface.cloud = &b->cloud;
    b->surface.triangle_end = b->surface.free_count = 0;
    b->surface.next_point = (int32_t *)(void *)((char *)b->cloud.grid + grid_size(points->count));
    b->surface.most_vertices = points->max_vertices;
}

static void choose_tolerance(fe__hull_builder *b, double given)
{
    double extent = b->cloud.extent;
    b->tolerance =
        given > 0.0 ? fe__maxd(given, FE__HULL_LEAST_TOLERANCE_SHARE * extent) : FE__HULL_TOLERANCE_SHARE * extent;
    b->surface.tolerance = outside_share * b->tolerance / b->cloud.step;
}

// Vertices on the grid, two side by side; an odd last one stands twice.
typedef struct grid_vertices {
    fe__doubles x[FE__SURFACE_VERTICES / 2], y[FE__SURFACE_VERTICES / 2], z[FE__SURFACE_VERTICES / 2];
    int32_t pairs;
} grid_vertices;

static void read_vertices(const fe__hull_surface *s, grid_vertices *out)
{
    int32_t count = 0;
    for (int32_t v = 0; v < FE__SURFACE_VERTICES; ++v) {
        if (s->point[v] < 0) continue;
        fe_dvec3 p = fe__vertex_on_grid(s, v);
        int32_t at = count / 2;
        if (count++ % 2)
            out->x[at][1] = p.x, out->y[at][1] = p.y, out->z[at][1] = p.z;
        else
            out->x[at] = (fe__doubles){p.x, p.x}, out->y[at] = (fe__doubles){p.y, p.y},
            out->z[at] = (fe__doubles){p.z, p.z};
    }
    out->pairs = (count + 1) / 2;
}

// fe__grid_height of the lowest, downwards
static double depth_below(const fe__grid_plane *plane, const grid_vertices *v)
{
    const fe__doubles x = {plane->unit.x, plane->unit.x}, y = {plane->unit.y, plane->unit.y},
                      z = {plane->unit.z, plane->unit.z}, offset = {plane->offset, plane->offset};
    fe__doubles lowest = {0.0, 0.0};
    for (int32_t i = 0; i < v->pairs; ++i)
        lowest = fe__doubles_min(x * v->x[i] + y * v->y[i] + z * v->z[i] - offset, lowest);
    return -fe__mind(lowest[0], lowest[1]);
}

// Of the surface: the least width between a triangle and the vertex farthest below it, m
static int32_t thinnest_triangle(const fe__hull_surface *s, double *out_thickness)
{
    grid_vertices vertices;
    int32_t thinnest = -1;
    double least = DBL_MAX;
    read_vertices(s, &vertices);
    for (int32_t i = 0; i < s->triangle_end; ++i) {
        if (!s->triangles[i].alive) continue;
        double depth = depth_below(&s->triangles[i].plane, &vertices);
        if (depth >= least) continue;
        least = depth;
        thinnest = i;
    }
    *out_thickness = least * s->cloud->step;
    return thinnest;
}

// Of all points, m. A surface of few vertices may be thinner than they are.
static double width_along(const fe__cloud *cloud, const fe__grid_plane *plane)
{
    double lowest = 0.0, highest = 0.0;
    for (int32_t i = 0; i < cloud->count; ++i) {
        double height = fe__grid_height(plane, cloud->grid[i]);
        lowest = fe__mind(lowest, height);
        highest = fe__maxd(highest, height);
    }
    return (highest - lowest) * cloud->step;
}

static int32_t refuse(fe__hull_refusal *refusal, double thickness, fe_dvec3 normal)
{
    double square = fe__ddot(normal, normal);
    refusal->thickness = thickness;
    refusal->normal = square > 0.0 ? fe__dscale(1.0 / sqrt(square), normal) : normal;
    return 0;
}

static void number_vertices(fe__hull_builder *b)
{
    for (int32_t v = 0; v < FE__SURFACE_VERTICES; ++v) b->number[v] = -1;
    b->vertex_count = 0;
    for (int32_t v = 0; v < FE__SURFACE_VERTICES; ++v) {
        if (b->surface.point[v] < 0 || !b->facets.valence[v]) continue;
        int32_t at = b->vertex_count++;
        for (; at > 0 && b->surface.point[b->vertex[at - 1]] > b->surface.point[v]; --at)
            b->vertex[at] = b->vertex[at - 1];
        b->vertex[at] = v;
    }
    for (int32_t i = 0; i < b->vertex_count; ++i) b->number[b->vertex[i]] = i;
}

int32_t fe__hull_build(fe__hull_builder *b, const fe__hull_points *points, fe__hull_refusal *refusal)
{
    begin(b, points);
    fe__cloud_measure(&b->cloud);
    double least = fe__hull_least_thickness(b->cloud.extent), thickness;
    fe_dvec3 normal;
    refusal->least = least;
    if (b->cloud.extent < least) return refuse(refusal, b->cloud.extent, (fe_dvec3){0.0, 0.0, 0.0});
    fe__cloud_snap(&b->cloud);
    choose_tolerance(b, points->tolerance);
    if (!fe__surface_begin(&b->surface, least, &thickness, &normal)) return refuse(refusal, thickness, normal);
    fe__surface_grow(&b->surface);

    const fe__grid_plane *thinnest = &b->surface.triangles[thinnest_triangle(&b->surface, &b->thickness)].plane;
    if (b->thickness < least) {
        thickness = width_along(&b->cloud, thinnest);
        if (thickness < least) return refuse(refusal, thickness, thinnest->normal);
    }
    double slab = fe__mind(slab_share * b->tolerance, slab_of_thickness * b->thickness) / b->cloud.step;
    fe__facets_find(&b->facets, &b->surface, slab);
    fe__facets_drop_corners(&b->facets);
    number_vertices(b);
    return 1;
}

void fe__hull_write(fe__hull_builder *b, void *block, fe__hull *hull)
{
    fe__hull_lay_out(b, block, hull);
    fe__hull_weigh(hull);
    fe__hull_measure_error(b, hull);
}
