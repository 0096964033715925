// measure.c - what a hull weighs, and how far points that were left out lie outside.
#include "collision/hull_build/measure.h"

#include "collision/hull_build/layout.h"
#include "core/tensor.h"

#include <float.h>

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
