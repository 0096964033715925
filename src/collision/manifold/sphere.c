// sphere.c - sphere against sphere.
//
// A kernel of collide.c's table; kernels.h says what comes in and goes out.
#include "collision/manifold/kernels.h"

void fe__collide_sphere_sphere(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                               fe__manifold *manifold)
{
    fe_vec3 d = b_in_a->position;
    float radii = a->radius + b->radius, distance = fe__length(d), separation = distance - radii;
    if (separation > margin) {
        fe__stay_apart(manifold, separation, fe__direction(d, distance));
        return;
    }
    manifold->normal = fe__direction(d, distance);
    fe__add_point(manifold, fe__scale(a->radius + 0.5f * separation, manifold->normal), separation, 0);
}
