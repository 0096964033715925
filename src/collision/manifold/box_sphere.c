// box_sphere.c - box against sphere: the nearest point of the box to the centre, exact but for rounding.
//
// A kernel of collide.c's table; A is the box. Each difference below is of neighbouring floats, hence without error
// (Sterbenz), whenever the centre is near the surface: the normal is as good from 1 micrometre as from 1 metre.
#include "collision/manifold/kernels.h"

// The centre is inside: out through the nearest face, of equal ones that of the lowest axis.
static void leave_box(const fe__form *box, fe_vec3 c, float radius, fe__manifold *manifold)
{
    const float depth[3] = {box->half.x - fe__absf(c.x), box->half.y - fe__absf(c.y), box->half.z - fe__absf(c.z)};
    const fe_vec3 out[3] = {{c.x < 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f},
                            {0.0f, c.y < 0.0f ? -1.0f : 1.0f, 0.0f},
                            {0.0f, 0.0f, c.z < 0.0f ? -1.0f : 1.0f}};
    int32_t k = 0;
    for (int32_t i = 1; i < 3; ++i) {
        if (depth[i] < depth[k]) k = i;
    }
    manifold->normal = out[k];
    fe__add_point(manifold, fe__add_scaled(c, 0.5f * (depth[k] - radius), out[k]), -depth[k] - radius, 0);
}

void fe__collide_box_sphere(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                            fe__manifold *manifold)
{
    fe_vec3 c = b_in_a->position, h = a->half;
    fe_vec3 nearest = {fe__clampf(c.x, -h.x, h.x), fe__clampf(c.y, -h.y, h.y), fe__clampf(c.z, -h.z, h.z)},
            d = fe__sub(c, nearest);
    float square = fe__dot(d, d), limit = b->radius + margin;
    if (square > limit * limit) {
        float distance = sqrtf(square);
        fe__stay_apart(manifold, distance - b->radius, fe__direction(d, distance));
        return;
    }
    if (!(square > 0.0f)) {
        leave_box(a, c, b->radius, manifold);
        return;
    }
    float distance = sqrtf(square), separation = distance - b->radius;
    manifold->normal = fe__direction(d, distance);
    fe__add_point(manifold, fe__add_scaled(nearest, 0.5f * separation, manifold->normal), separation, 0);
}
