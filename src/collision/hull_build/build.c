// build.c - see build.h.
#include "collision/hull_build/build.h"

#include "collision/hull_build/measure.h"
#include "core/lanes.h"

#include <float.h>

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
