// plane.c - half space against sphere, capsule and box: the deepest points, each with its own separation.
//
// Kernels of collide.c's table; A is the plane. Heights over it are taken in double: far from the plane's origin n . p
// and the distance are large and nearly equal.
#include "collision/form/form.h"
#include "collision/form/hull.h"
#include "collision/manifold/pair_kernels.h"

#include <float.h>

// ---- plane ----------------------------------------------------------------------------------------------------------

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

// ---- hull plane -----------------------------------------------------------------------------------------------------
// Half space against hull: all vertices below the margin, each with its own separation, of which four
// stay.
//
// A kernel of collide.c's table; A is the plane, whose frame is put at B. A point's id is its vertex.

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

// ---- curved ---------------------------------------------------------------------------------------------------------
// What has a rim, a cylinder or a cone, on a half space: the points of its disc, or the ends of the line on
// its side, each with its own separation. With other forms it goes the general way (convex.c).

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
