// nearest_field.c - the nearest point of a heightfield or a mesh; see nearest.h.
//
// Boxes around the point, each twice as wide as the one before, until the nearest point found is nearer than the box is
// wide: nothing outside of it can be nearer still.
#include "collision/cast/approach.h"
#include "collision/cast/nearest.h"

static fe__bounds around(fe_dvec3 p, double r)
{
    return (fe__bounds){{p.x - r, p.y - r, p.z - r}, {p.x + r, p.y + r, p.z + r}};
}

// m, from the point to the bounds of all triangles
static double distance_to_bounds(const fe__bounds *b, fe_dvec3 p)
{
    double x = fe__maxd(fe__maxd(b->low.x - p.x, p.x - b->high.x), 0.0);
    double z = fe__maxd(fe__maxd(b->low.z - p.z, p.z - b->high.z), 0.0);
    double y = fe__maxd(fe__maxd(b->low.y - p.y, p.y - b->high.y), 0.0);
    return sqrt(x * x + y * y + z * z);
}

// Of equally near triangles the one with the lowest number.
static void nearest_in(const fe__ground *s, fe_dvec3 p, double width, fe__nearest *best)
{
    fe__bounds box = around(p, width);
    fe__ground_walk walk;
    fe__ground_begin(&walk, s, &box, p);
    for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) {
        int32_t number = fe__ground_number(s, i);
        fe_dvec3 v[3], n = fe__ground_normal(s, i);
        fe__ground_corners(s, i, v);
        if (!s->mesh && fe__ddot(n, fe__dsub(p, v[0])) < 0.0) continue;
        fe_dvec3 q = fe__nearest_on_triangle(v, n, p), away = fe__dsub(p, q);
        double distance = sqrt(fe__ddot(away, away));
        if (!(distance < best->distance) && !(distance == best->distance && number < best->triangle)) continue;
        *best = (fe__nearest){distance, distance > 0.0 ? fe__dscale(1.0 / distance, away) : n, q, number, i};
    }
}

int32_t fe__ground_nearest(const fe__ground *s, fe_dvec3 point, double limit, fe__nearest *nearest)
{
    fe__bounds b = fe__ground_bounds(s);
    fe_dvec3 cell = fe__ground_cell(s);
    double width = distance_to_bounds(&b, point) + cell.x + cell.z, all = width;
    all += (b.high.x - b.low.x) + (b.high.y - b.low.y) + (b.high.z - b.low.z);
    nearest->distance = (double)INFINITY, nearest->triangle = -1;
    for (;; width *= 2.0) {
        width = fe__mind(width, limit);
        nearest_in(s, point, width, nearest);
        if (nearest->distance <= width) return 1;
        if (width >= limit || width >= all) return nearest->triangle >= 0 && nearest->distance <= limit;
    }
}
