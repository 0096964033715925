// terrain_course.c - see terrain_course.h.
#include "collision/manifold/terrain_course.h"

#include "collision/form/hull.h"
#include "collision/manifold/pair_kernels.h"

static void span_of(const fe__form *b, const fe__mat3 *r, fe_vec3 at, fe_vec3 *low, fe_vec3 *high)
{
    if (fe__form_is_hull(b)) {
        fe__hull_span(b->hull, r, low, high);
        fe_vec3 origin = fe__add(at, fe__mul(r, b->offset));
        *low = fe__add_scaled(origin, b->scale, *low), *high = fe__add_scaled(origin, b->scale, *high);
        return;
    }
    fe_vec3 half = b->half;
    half.y += b->half_height;
    fe_vec3 w = {fe__absf(r->x.x) * half.x + fe__absf(r->y.x) * half.y + fe__absf(r->z.x) * half.z + b->radius,
                 fe__absf(r->x.y) * half.x + fe__absf(r->y.y) * half.y + fe__absf(r->z.y) * half.z + b->radius,
                 fe__absf(r->x.z) * half.x + fe__absf(r->y.z) * half.y + fe__absf(r->z.z) * half.z + b->radius};
    *low = fe__sub(at, w), *high = fe__add(at, w);
}

static fe__bounds box_of(const fe__terrain *t, const fe__course_probe *c, float more)
{
    fe_vec3 low[2], high[2];
    for (int32_t end = 0; end < 2; ++end) span_of(c->b, c->way->rotation + end, c->at[end], low + end, high + end);
    double grow = (double)more;
    fe_dvec3 by = {grow, grow, grow};
    fe_vec3 from = {fe__minf(low[0].x, low[1].x), fe__minf(low[0].y, low[1].y), fe__minf(low[0].z, low[1].z)},
            to = {fe__maxf(high[0].x, high[1].x), fe__maxf(high[0].y, high[1].y), fe__maxf(high[0].z, high[1].z)};
    return (fe__bounds){fe__dsub(fe__dadd(t->origin, fe__widen(from)), by),
                        fe__dadd(fe__dadd(t->origin, fe__widen(to)), by)};
}

void fe__find_triangles_on_course(const fe__terrain *t, const fe__form *b, const fe__course *way, float margin,
                                  fe__course_kernel *kernel, fe__mesh_near *near)
{
    // a face that is cut reaches beyond a side by a tenth of a tie, beyond a corner farther, but not by so much
    const float ties = 2.0f, more = 0.002f; // m, the roundings of bounds
    fe_vec3 middle = fe__scale(0.5f, way->end);
    if (fe__form_is_hull(b)) middle = fe__add(middle, fe__mul(&way->rotation[0], fe__hull_form_centre(b)));
    fe__course_probe c = {
        b, way, {{0.0f, 0.0f, 0.0f}, way->end}, middle, margin + ties * fe__tie(fe__form_thickness(b))};
    fe__bounds box = box_of(t, &c, c.near + fe__course_bend(way) + more);
    fe__mesh_find_near(t->ground.mesh, &box, near);
    if (near->count < 0) return;
    near->is_all = 1, near->margin = margin;
    fe__course_corners corners;
    int32_t i = 0;
    for (fe__form triangle; i < near->count; ++i) {
        fe__mesh_triangle(t->ground.mesh, near->slots[i], t->origin, &triangle);
        for (int32_t k = 0; k < 3; ++k)
            corners.x[k][i] = triangle.vertex[k].x, corners.y[k][i] = triangle.vertex[k].y,
            corners.z[k][i] = triangle.vertex[k].z;
    }
    for (; i % FE__COURSE_LANES; ++i)
        for (int32_t k = 0; k < 3; ++k)
            corners.x[k][i] = corners.x[k][i - 1], corners.y[k][i] = corners.y[k][i - 1],
            corners.z[k][i] = corners.z[k][i - 1];
    fe__met_on_course met = kernel(&c, &corners, near->count);
    const uint64_t there = near->count < FE__MESH_NEAR ? (UINT64_C(1) << near->count) - 1 : UINT64_MAX;
    near->among = met.on_way & there, near->among_last = met.at_end & there;
}
