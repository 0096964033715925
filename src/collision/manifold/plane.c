// plane.c - half space against sphere, capsule and box: the deepest points, each with its own separation.
//
// Kernels of collide.c's table; A is the plane. Heights over it are taken in double: far from the plane's origin n . p
// and the distance are large and nearly equal.
#include "collision/manifold/kernels.h"

static float height(const fe__form *plane, fe_vec3 p)
{
    return (float)(fe__ddot(fe__widen(plane->normal), fe__widen(p)) - (double)plane->distance);
}

// p is a point of B's core, its radius below it touches
static void add_below(const fe__form *plane, fe_vec3 p, float radius, float separation, float margin, uint32_t id,
                      fe__manifold *manifold)
{
    if (separation > margin) return;
    manifold->normal = plane->normal;
    fe__add_point(manifold, fe__add_scaled(p, -(radius + 0.5f * separation), plane->normal), separation, id);
}

void fe__collide_plane_sphere(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                              fe__manifold *manifold)
{
    float separation = height(a, b_in_a->position) - b->radius;
    fe__stay_apart(manifold, separation, a->normal);
    add_below(a, b_in_a->position, b->radius, separation, margin, 0, manifold);
}

void fe__collide_plane_capsule(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                               fe__manifold *manifold)
{
    fe_vec3 half = fe__scale(b->half_height, b_in_a->rotation.y);
    float middle = height(a, b_in_a->position) - b->radius, rise = fe__dot(a->normal, half);
    fe__stay_apart(manifold, middle - fe__absf(rise), a->normal);
    add_below(a, fe__sub(b_in_a->position, half), b->radius, middle - rise, margin, 0, manifold);
    add_below(a, fe__add(b_in_a->position, half), b->radius, middle + rise, margin, 1, manifold);
}

// The corners of the face that looks most against the plane. A corner's id is its place in the box, whichever face it
// was found on.
void fe__collide_plane_box(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                           fe__manifold *manifold)
{
    const fe_vec3 edge[3] = {fe__scale(b->half.x, b_in_a->rotation.x), fe__scale(b->half.y, b_in_a->rotation.y),
                             fe__scale(b->half.z, b_in_a->rotation.z)};
    const float cosine[3] = {fe__dot(a->normal, b_in_a->rotation.x), fe__dot(a->normal, b_in_a->rotation.y),
                             fe__dot(a->normal, b_in_a->rotation.z)};
    const float rise[3] = {b->half.x * cosine[0], b->half.y * cosine[1], b->half.z * cosine[2]};
    int32_t k = 0;
    for (int32_t i = 1; i < 3; ++i) {
        if (fe__absf(cosine[i]) > fe__absf(cosine[k])) k = i;
    }
    int32_t u = (k + 1) % 3, v = (k + 2) % 3;
    float side = cosine[k] > 0.0f ? -1.0f : 1.0f, middle = height(a, b_in_a->position) + side * rise[k];
    float lowest = middle - fe__absf(rise[u]) - fe__absf(rise[v]);
    fe__stay_apart(manifold, lowest, a->normal);
    if (lowest > margin) return;
    fe_vec3 face = fe__add_scaled(b_in_a->position, side, edge[k]);
    for (int32_t i = 0; i < 4; ++i) {
        float su = i == 1 || i == 2 ? 1.0f : -1.0f, sv = i >= 2 ? 1.0f : -1.0f; // around the face
        fe_vec3 corner = fe__add_scaled(fe__add_scaled(face, su, edge[u]), sv, edge[v]);
        uint32_t id = (uint32_t)(side > 0.0f) << k | (uint32_t)(su > 0.0f) << u | (uint32_t)(sv > 0.0f) << v;
        add_below(a, corner, 0.0f, middle + su * rise[u] + sv * rise[v], margin, id, manifold);
    }
}
