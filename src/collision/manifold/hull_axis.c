// hull_axis.c - see hull_axis.h. Four vertices, or four edges of A, are looked at side by side.
#define FE_W 4
#include "collision/manifold/hull_axis.h"

#include "core/simd.h"

#include <float.h>
#include <string.h>

// Sine of the angle below which two edges are parallel: their cross product is rounding, and a face says it better
static const float parallel = 0.005f;

// ---- faces ---------------------------------------------------------------------------------------------------------
typedef struct lanes {
    wide x, y, z;
} lanes;

static inline wide load(const float *from)
{
    wide to;
    memcpy(&to, from, sizeof to);
    return to;
}
static inline lanes lanes_at(const fe__hull_lanes *from, int32_t i)
{
    return (lanes){load(from->x + i), load(from->y + i), load(from->z + i)};
}
// as fe__dot
static inline wide along(const lanes *a, fe_vec3 b) { return a->x * b.x + a->y * b.y + a->z * b.z; }

// The vertex least far along a direction; of equals the lowest. Lanes past the last vertex repeat the first.
static int32_t least_along(const fe__hull *hull, fe_vec3 direction, float *least)
{
    wide low = w_set(FLT_MAX);
    wide_int at = {0, 0, 0, 0}, index = {0, 1, 2, 3};
    for (int32_t v = 0; v < hull->vertex_count; v += FE_W) {
        lanes p = lanes_at(&hull->vertices, v);
        wide here = along(&p, direction);
        wide_int lower = here < low;
        low = w_min(here, low);
        at = (index & lower) | (at & ~lower);
        index += FE_W;
    }
    int32_t best = 0;
    for (int32_t k = 1; k < FE_W; ++k)
        if (low[k] < low[best] || (low[k] == low[best] && at[k] < at[best])) best = k;
    *least = low[best];
    return at[best];
}

// Which planes, four from i on, may hold a point q of the other hull farther off than `least`? A bit for each
static uint32_t faces_near(const fe__hull *hull, int32_t i, fe_vec3 q, float least)
{
    lanes normal = lanes_at(&hull->normals, i);
    int32_t rest = hull->face_count - i;
    return w_bits(along(&normal, q) - load(hull->distances + i) >= least) & (rest < FE_W ? (1u << rest) - 1u : 0xfu);
}

static float size(fe_vec3 a) { return fe__absf(a.x) + fe__absf(a.y) + fe__absf(a.z); }

// Of `own`, against the vertices of `other`, which stands at `position` with axes turned by `rotation`. A plane holds
// the hulls apart by no more than it does any vertex: that which lies least far along the best so far shows most planes
// to be worse, side by side up to roundings, then by the same sum as all vertices.
static fe__hull_axis of_faces(const fe__hull *own, const fe__hull *other, fe_vec3 position, const fe__mat3 *rotation)
{
    const float rounding = 1e-5f; // of the sizes
    float doubt = rounding * (own->extent + other->extent + size(position));
    fe__hull_axis best = {.separation = -FLT_MAX};
    fe_vec3 nearest = fe__hull_vertex(other, 0), there = fe__add(position, fe__mul(rotation, nearest));
    for (int32_t first = 0; first < own->face_count; first += FE_W) {
        uint32_t left = faces_near(own, first, there, best.separation - doubt);
        for (; left; left &= left - 1) {
            int32_t i = first + __builtin_ctz(left);
            float least;
            fe_vec3 normal = fe__hull_normal(own, i), direction = fe__mul_transposed(rotation, normal);
            float beyond = fe__dot(normal, position) - own->distances[i];
            if (fe__dot(nearest, direction) + beyond <= best.separation) continue;
            int32_t deepest = least_along(other, direction, &least);
            float separation = least + beyond;
            if (!(separation > best.separation)) continue;
            best = (fe__hull_axis){.separation = separation, .normal = normal, .a = i, .b = deepest};
            nearest = fe__hull_vertex(other, deepest), there = fe__add(position, fe__mul(rotation, nearest));
        }
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
// arcs are on one half of the sphere. An edge's vector is normal to the plane of its arc. A bit for each edge of A from
// i on.
static uint32_t arcs_cross(const fe__hull *a, int32_t i, const arc *b)
{
    lanes vector = lanes_at(&a->vectors, i), left = lanes_at(&a->left, i), right = lanes_at(&a->right, i);
    const wide zero = {0.0f, 0.0f, 0.0f, 0.0f};
    wide bl = along(&vector, b->left), br = along(&vector, b->right), al = along(&left, b->vector),
         ar = along(&right, b->vector);
    wide_int cross = (bl * br < zero) & (al * ar < zero) & (bl * ar < zero);
    int32_t rest = a->edge_count - i;
    return w_bits(cross) & (rest < FE_W ? (1u << rest) - 1u : 0xfu);
}

static void try_edges(const fe__hull *a, int32_t i, const arc *eb, int32_t j, fe__hull_axis *best)
{
    arc ea = arc_of(a, i);
    fe_vec3 n = fe__cross(ea.vector, eb->vector);
    float square = fe__dot(n, n), limit = parallel * parallel * fe__dot(ea.vector, ea.vector);
    if (square <= limit * fe__dot(eb->vector, eb->vector)) return;
    float k = 1.0f / sqrtf(square);
    n = fe__scale(fe__dot(n, fe__add(ea.left, ea.right)) < 0.0f ? -k : k, n); // out of A
    float separation = fe__dot(n, fe__sub(eb->tail, ea.tail));
    if (separation > best->separation) *best = (fe__hull_axis){separation, n, FE__AXIS_OF_EDGES, i, j};
}

// Which edges of a hull, four from i on, can part it from a point q of the other by more than `least`, which is 0 or
// less? All axes n of an edge lie on its arc, between the normals l and r of its faces, and separate by no more than
// n . (q - tail). Where  l . (q - tail)  and  r . (q - tail)  are below 0, that is no more than the larger of the two.
static uint32_t edges_near(const fe__hull *hull, int32_t i, fe_vec3 q, float least)
{
    lanes left = lanes_at(&hull->left, i), right = lanes_at(&hull->right, i), tail = lanes_at(&hull->tails, i);
    lanes way = {q.x - tail.x, q.y - tail.y, q.z - tail.z};
    wide over_left = left.x * way.x + left.y * way.y + left.z * way.z,
         over_right = right.x * way.x + right.y * way.y + right.z * way.z;
    int32_t rest = hull->edge_count - i;
    return w_bits((over_left >= least) | (over_right >= least)) & (rest < FE_W ? (1u << rest) - 1u : 0xfu);
}

// Fours of edges of which one or more is near
static int32_t find_fours(const fe__hull *hull, fe_vec3 q, float least, int16_t *out_first)
{
    int32_t count = 0;
    for (int32_t i = 0; i < hull->edge_count; i += FE_W) {
        out_first[count] = (int16_t)i;
        count += edges_near(hull, i, q, least) != 0;
    }
    return count;
}

fe__hull_axis fe__hull_axis_of_edges(const fe__hull *a, const fe__hull *b, const fe__relative *b_in_a, float least,
                                     int32_t vertex_a, int32_t vertex_b)
{
    const float rounding = 1e-5f; // of the sizes
    float apart = fe__minf(least, 0.0f) - rounding * (a->extent + b->extent);
    const fe__mat3 *r = &b_in_a->rotation;
    fe_vec3 p = fe__mul_transposed(r, fe__sub(fe__hull_vertex(a, vertex_a), b_in_a->position)),
            q = fe__add(b_in_a->position, fe__mul(r, fe__hull_vertex(b, vertex_b)));
    int16_t fours[FE__HULL_EDGES / FE_W + 2]; // one is written behind the last
    int32_t count = find_fours(a, q, apart, fours);
    fe__hull_axis best = {.separation = -FLT_MAX, .kind = FE__AXIS_OF_EDGES};
    for (int32_t first = 0; first < b->edge_count; first += FE_W) {
        for (uint32_t near = edges_near(b, first, p, apart); near != 0; near &= near - 1) {
            int32_t j = first + __builtin_ctz(near);
            arc own = arc_of(b, j), eb = moved(&own, b_in_a);
            for (int32_t k = 0; k < count; ++k)
                for (uint32_t left = arcs_cross(a, fours[k], &eb); left != 0; left &= left - 1)
                    try_edges(a, fours[k] + __builtin_ctz(left), &eb, j, &best);
        }
    }
    return best;
}
