// curved.c - what has a rim, a cylinder or a cone, on a half space: the points of its disc, or the ends of the line on
// its side, each with its own separation. With other forms it goes the general way (convex.c).
#include "collision/form/support.h"
#include "collision/manifold/kernels.h"

void fe__collide_plane_curved(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                              fe__manifold *manifold)
{
    fe_vec3 n = a->normal, down = fe__neg(fe__mul_transposed(&b_in_a->rotation, n));
    double middle = fe__ddot(fe__widen(n), fe__widen(b_in_a->position)) - (double)a->distance;
    const fe__load in_a = fe__tell_load(manifold->load),
                   load = fe__load_in_frame(&in_a, b_in_a->position, &b_in_a->rotation); // in B's
    fe_vec3 under = fe__scale((float)middle, down), foot;
    int32_t is_known = fe__find_foot(&load, under, down, &foot);
    fe__face face;
    fe__form_face_under(b, down, is_known ? &foot : NULL, &face);
    fe__clip_vertex vertex[FE_FACE_VERTICES];
    int32_t near = 0;
    float lowest = (float)(middle - fe__ddot(fe__widen(down), fe__form_support(b, fe__widen(down))));
    fe__stay_apart(manifold, lowest, n);
    if (lowest > margin) return;
    for (int32_t i = 0; i < face.count; ++i) {
        fe_vec3 p = face.vertex[i];
        float height = (float)(middle - fe__ddot(fe__widen(down), fe__widen(p)));
        if (height <= margin) vertex[near++] = (fe__clip_vertex){p.x, face.count > 2 ? p.z : p.y, height, (uint32_t)i};
    }
    fe__foot in_plane = {.is_known = is_known && face.pattern == FE_RIM_AIMED, .u = foot.x, .v = foot.z, .is_aimed = 1};
    near = fe__reduce_to_four(vertex, near, 0.1f * fe__tie(fe__form_thickness(b)), &in_plane, &manifold->left_out);
    if (face.rim > 0.0f) // rims that lie are held at points of their body, not where the load leans
        manifold->left_out = face.pattern == FE_RIM_LEANS   ? FE_LEFT_NONE
                             : face.pattern == FE_RIM_AIMED ? FE_LEFT_REST
                                                            : FE_LEFT_SOME;
    manifold->normal = n;
    for (int32_t i = 0; i < near; ++i) {
        fe_vec3 p = fe__add(b_in_a->position, fe__mul(&b_in_a->rotation, face.vertex[vertex[i].id]));
        fe__add_point(manifold, fe__add_scaled(p, -0.5f * vertex[i].height, n), vertex[i].height,
                      face.id << 8 | (face.pattern == FE_RIM_AIMED ? 16u : 0u) | vertex[i].id);
    }
}
