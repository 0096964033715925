// nearest_field.c - the nearest point of a heightfield; see nearest.h.
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
static double distance_to_bounds(const fe__heightfield *f, fe_dvec3 p)
{
    double x = fe__maxd(fe__maxd(-p.x, p.x - (double)(f->columns - 1) * f->cell_x), 0.0);
    double z = fe__maxd(fe__maxd(-p.z, p.z - (double)(f->rows - 1) * f->cell_z), 0.0);
    double y = fe__maxd(fe__maxd((double)f->low - p.y, p.y - (double)f->high), 0.0);
    return sqrt(x * x + y * y + z * z);
}

// Of equally near triangles the one with the lowest number.
static void nearest_in(const fe__heightfield *f, fe_dvec3 p, double width, fe__nearest *best)
{
    fe__bounds box = around(p, width);
    fe__form unused;
    fe__triangle_walk walk = fe__heightfield_walk(f, &box, p);
    for (int32_t i; (i = fe__next_triangle(&walk, &unused)) >= 0;) {
        fe_dvec3 v[3], n = fe__heightfield_normal(f, i);
        fe__heightfield_corners(f, i, v);
        if (fe__ddot(n, fe__dsub(p, v[0])) < 0.0) continue;
        fe_dvec3 q = fe__nearest_on_triangle(v, n, p), away = fe__dsub(p, q);
        double distance = sqrt(fe__ddot(away, away));
        if (!(distance < best->distance) && !(distance == best->distance && i < best->triangle)) continue;
        *best = (fe__nearest){distance, distance > 0.0 ? fe__dscale(1.0 / distance, away) : n, q, i};
    }
}

int32_t fe__heightfield_nearest(const fe__heightfield *f, fe_dvec3 point, double limit, fe__nearest *nearest)
{
    double width = distance_to_bounds(f, point) + f->cell_x + f->cell_z, all = width;
    all += (double)f->columns * f->cell_x + (double)f->rows * f->cell_z + ((double)f->high - (double)f->low);
    nearest->distance = (double)INFINITY, nearest->triangle = -1;
    for (;; width *= 2.0) {
        width = fe__mind(width, limit);
        nearest_in(f, point, width, nearest);
        if (nearest->distance <= width) return 1;
        if (width >= limit || width >= all) return nearest->triangle >= 0 && nearest->distance <= limit;
    }
}
