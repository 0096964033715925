// scale.c - a mesh under a scale: its bounds, its area, and whether each triangle keeps one; see build.h.
#include "collision/mesh_build/build.h"

static int32_t is_uniform(fe_vec3 s) { return fe__absf(s.x) == fe__absf(s.y) && fe__absf(s.y) == fe__absf(s.z); }

// The float next to a product of two floats, outwards: a double holds it exactly
static float below(double x) { return (float)x - 0x1p-23f * fe__absf((float)x); }
static float above(double x) { return (float)x + 0x1p-23f * fe__absf((float)x); }

static void scale_bounds(float scale, float *low, float *high)
{
    double a = (double)scale * (double)*low, b = (double)scale * (double)*high;
    *low = below(fe__mind(a, b)), *high = above(fe__maxd(a, b));
}

static double longest_side(const fe__mesh *m)
{
    fe_dvec3 size = fe__dsub(fe__widen(m->high), fe__widen(m->low));
    return fe__maxd(size.x, fe__maxd(size.y, size.z));
}

// Of the triangles that are too small the one with the lowest number, -1: none is. In a likeness of the mesh none is.
static int32_t measure_area(fe__mesh *m, fe_vec3 scale)
{
    double longest = longest_side(m), least = FE__MESH_LEAST_AREA * longest * longest, area = 0.0;
    int32_t lost = -1;
    for (int32_t slot = 0; slot < m->triangle_count; ++slot) {
        fe_dvec3 v[3];
        fe__mesh_corners(m, slot, v);
        fe_dvec3 n = fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0]));
        double own = 0.5 * sqrt(fe__ddot(n, n));
        area += own;
        int32_t number = fe__mesh_number(m, slot);
        if (own <= least && !is_uniform(scale) && (lost < 0 || number < lost)) lost = number;
    }
    m->area = area;
    return lost;
}

int32_t fe__mesh_scale(const fe__mesh *mesh, fe_vec3 scale, fe__mesh *out)
{
    *out = *mesh;
    out->scale[0] = (double)scale.x, out->scale[1] = (double)scale.y, out->scale[2] = (double)scale.z;
    out->is_mirrored = scale.x * scale.y * scale.z < 0.0f;
    out->is_scaled = 1;
    out->block = NULL, out->size = 0;
    scale_bounds(scale.x, &out->low.x, &out->high.x);
    scale_bounds(scale.y, &out->low.y, &out->high.y);
    scale_bounds(scale.z, &out->low.z, &out->high.z);
    return measure_area(out, scale);
}
