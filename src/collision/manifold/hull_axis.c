// hull_axis.c - see hull_axis.h.
#include "collision/manifold/hull_axis.h"

#include <float.h>

// Sine of the angle below which two edges are parallel: their cross product is rounding, and a face says it better
static const float parallel = 0.005f;

// ---- faces ---------------------------------------------------------------------------------------------------------
// Of `own`, against the vertices of `other`, which stands at `position` with axes turned by `rotation`.
static fe__hull_axis of_faces(const fe__hull *own, const fe__hull *other, fe_vec3 position, const fe__mat3 *rotation)
{
    fe__hull_axis best = {.separation = -FLT_MAX};
    for (int32_t i = 0; i < own->face_count; ++i) {
        fe_vec3 normal = fe__hull_normal(own, i), in_other = fe__mul_transposed(rotation, normal);
        int32_t deepest = 0;
        float least = FLT_MAX;
        for (int32_t v = 0; v < other->vertex_count; ++v) {
            float along = fe__dot(in_other, fe__hull_vertex(other, v));
            if (along >= least) continue;
            least = along;
            deepest = v;
        }
        float separation = least + (fe__dot(normal, position) - own->distances[i]);
        if (separation > best.separation)
            best = (fe__hull_axis){.separation = separation, .normal = normal, .a = i, .b = deepest};
    }
    return best;
}

fe__hull_axis fe__hull_axis_of_faces_a(const fe__hull *a, const fe__hull *b, const fe__relative *b_in_a)
{
    fe__hull_axis axis = of_faces(a, b, b_in_a->position, &b_in_a->rotation);
    axis.kind = FE__AXIS_OF_FACE_A;
    return axis;
}

fe__hull_axis fe__hull_axis_of_faces_b(const fe__hull *a, const fe__hull *b, const fe__relative *b_in_a)
{
    const fe__mat3 *r = &b_in_a->rotation;
    fe__mat3 back = {{r->x.x, r->y.x, r->z.x}, {r->x.y, r->y.y, r->z.y}, {r->x.z, r->y.z, r->z.z}};
    fe__hull_axis axis = of_faces(b, a, fe__neg(fe__mul_transposed(r, b_in_a->position)), &back);
    int32_t face = axis.a;
    axis.a = axis.b, axis.b = face;
    axis.normal = fe__neg(fe__mul(r, axis.normal));
    axis.kind = FE__AXIS_OF_FACE_B;
    return axis;
}

// ---- edges ---------------------------------------------------------------------------------------------------------
typedef struct arc {
    fe_vec3 tail, vector, left, right; // A's frame
} arc;

static arc arc_of(const fe__hull *h, int32_t k)
{
    return (arc){fe__hull_lane(&h->tails, k), fe__hull_lane(&h->vectors, k), fe__hull_lane(&h->left, k),
                 fe__hull_lane(&h->right, k)};
}

static arc moved(const arc *b, const fe__relative *b_in_a)
{
    const fe__mat3 *r = &b_in_a->rotation;
    return (arc){fe__add(fe__mul(r, b->tail), b_in_a->position), fe__mul(r, b->vector), fe__mul(r, b->left),
                 fe__mul(r, b->right)};
}

// Does the arc of A cross that of B turned inside out? Each arc's ends are on both sides of the other's plane, and the
// arcs are on one half of the sphere. An edge's vector is normal to the plane of its arc.
static int32_t arcs_cross(const arc *a, const arc *b)
{
    float bl = fe__dot(b->left, a->vector), br = fe__dot(b->right, a->vector), al = fe__dot(a->left, b->vector),
          ar = fe__dot(a->right, b->vector);
    return bl * br < 0.0f && al * ar < 0.0f && bl * ar < 0.0f;
}

fe__hull_axis fe__hull_axis_of_edges(const fe__hull *a, const fe__hull *b, const fe__relative *b_in_a)
{
    fe__hull_axis best = {.separation = -FLT_MAX, .kind = FE__AXIS_OF_EDGES};
    for (int32_t j = 0; j < b->edge_count; ++j) {
        arc own = arc_of(b, j), eb = moved(&own, b_in_a);
        for (int32_t i = 0; i < a->edge_count; ++i) {
            arc ea = arc_of(a, i);
            if (!arcs_cross(&ea, &eb)) continue;
            fe_vec3 n = fe__cross(ea.vector, eb.vector);
            float square = fe__dot(n, n), limit = parallel * parallel * fe__dot(ea.vector, ea.vector);
            if (square <= limit * fe__dot(eb.vector, eb.vector)) continue;
            float k = 1.0f / sqrtf(square);
            n = fe__scale(fe__dot(n, fe__add(ea.left, ea.right)) < 0.0f ? -k : k, n); // out of A
            float separation = fe__dot(n, fe__sub(eb.tail, ea.tail));
            if (separation > best.separation) best = (fe__hull_axis){separation, n, FE__AXIS_OF_EDGES, i, j};
        }
    }
    return best;
}
