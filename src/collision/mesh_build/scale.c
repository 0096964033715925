// scale.c - a mesh under a scale: its bounds, its area, and whether each triangle keeps its height; see build.h.
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

// Of the triangles that become too flat the one with the lowest number, -1: none does. A likeness of the mesh has none.
static int32_t measure(fe__mesh *m, fe_vec3 scale)
{
    double area = 0.0;
    int32_t flattest = -1;
    for (int32_t slot = 0; slot < m->triangle_count; ++slot) {
        fe_dvec3 v[3];
        fe__mesh_corners(m, slot, v);
        fe_dvec3 n = fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0]));
        area += 0.5 * sqrt(fe__ddot(n, n));
        int32_t number = fe__mesh_number(m, slot);
        if (!is_uniform(scale) && fe__mesh_is_flat(v) && (flattest < 0 || number < flattest)) flattest = number;
    }
    m->area = area;
    return flattest;
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
    return measure(out, scale);
}
