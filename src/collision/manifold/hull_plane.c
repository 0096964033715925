// hull_plane.c - half space against hull: all vertices below the margin, each with its own separation, of which four
// stay.
//
// A kernel of collide.c's table; A is the plane, whose frame is put at B. A point's id is its vertex.
#include "collision/form/hull_form.h"
#include "collision/manifold/kernels.h"

#include <float.h>

void fe__collide_plane_hull(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                            fe__manifold *manifold)
{
    const fe__hull *hull = b->hull;
    fe_vec3 n = a->normal, up = fe__mul_transposed(&b_in_a->rotation, n);
    fe_vec3 origin = fe__add(b_in_a->position, fe__mul(&b_in_a->rotation, b->offset));
    float middle = (float)(fe__ddot(fe__widen(n), fe__widen(origin)) - (double)a->distance), lowest = FLT_MAX;
    fe_vec3 side = fe__absf(n.x) < 0.7f ? fe__vec3(1.0f, 0.0f, 0.0f) : fe__vec3(0.0f, 1.0f, 0.0f);
    fe_vec3 u = fe__cross(n, side);
    u = fe__scale(1.0f / fe__length(u), u);
    u = fe__mul_transposed(&b_in_a->rotation, u);
    fe_vec3 v = fe__cross(up, u);
    fe__clip_vertex vertex[FE__HULL_VERTICES];
    int32_t near = 0;
    for (int32_t i = 0; i < hull->vertex_count; ++i) {
        fe_vec3 p = fe__scale(b->scale, fe__hull_vertex(hull, i));
        float height = middle + fe__dot(up, p);
        lowest = fe__minf(lowest, height);
        if (height <= margin) vertex[near++] = (fe__clip_vertex){fe__dot(u, p), fe__dot(v, p), height, (uint32_t)i};
    }
    fe__stay_apart(manifold, lowest, n);
    fe__foot foot = {.is_known = 0};
    if (near > 4) {
        const fe__load in_a = fe__tell_load(manifold->load), load = fe__load_in_frame(&in_a, origin, &b_in_a->rotation);
        foot = fe__foot_in_plane(&load, fe__scale(-middle, up), u, v, up);
    }
    near = fe__reduce_to_four(vertex, near, 0.1f * fe__tie(fe__form_thickness(b)), &foot, &manifold->left_out);
    for (int32_t i = 0; i < near; ++i) {
        fe_vec3 p = fe__scale(b->scale, fe__hull_vertex(hull, (int32_t)vertex[i].id));
        p = fe__add(origin, fe__mul(&b_in_a->rotation, p));
        fe__add_point(manifold, fe__add_scaled(p, -0.5f * vertex[i].height, n), vertex[i].height, vertex[i].id);
    }
}
