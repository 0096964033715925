// box_edges.c - two boxes that touch along edges which run side by side, as the boards of an A-frame do.
//
// Part of box_box.c. Of such edges the separating axes know nothing: their cross product is noise, and while they
// overlap some face always says less depth. The normal between them is that of rounded edges instead. Both boxes are
// thought to be smaller by r on all sides, and n is the direction between these cores, where the nearest things of both
// cores are the two edges: where n lies in the cone of the normals of either edge. So n turns from one face's normal to
// the other's without a jump, and where it leaves a cone, a face meets an edge or a face and is right.
//
// All is in the plane across A's edge, z the coordinate along it. B's edge is askew by a few degrees at most:
// d(z) = dB + slope z, the vector from A's edge to B's.
#include "collision/manifold/box_edges.h"

#include "collision/manifold/kernels.h"

#include <float.h>
#include <math.h>

// r is the depth along the best face, so that the cores are apart and the edges' depth is below twice that: with g the
// angle between the two faces, at most  2 (cos g/2 + sin g/2) - cos g - sin g < 1.83  times. r is at least half a
// millimetre, about which the edges may pass each other by, and at most the solver's slop, m; and shares of the
// smallest half extent. Deeper boxes leave by a face, and so do those that overlap less along another axis.
#define DEPTHS 1.83f
#define CORE_LEAST 0.0005f
#define CORE_LEAST_SHARE 0.25f
#define CORE_MOST 0.005f
#define CORE_MOST_SHARE 0.5f

typedef struct boxes {
    float a[3], b[3], t[3];
    float r[3][3]; // r[i][j]: component i of B's axis j
} boxes;

static boxes boxes_of(const fe__form *a, const fe__form *b, const fe__relative *b_in_a)
{
    const fe_vec3 x = b_in_a->rotation.x, y = b_in_a->rotation.y, z = b_in_a->rotation.z, t = b_in_a->position;
    return (boxes){{a->half.x, a->half.y, a->half.z},
                   {b->half.x, b->half.y, b->half.z},
                   {t.x, t.y, t.z},
                   {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

// The edge of A along axis i and that of B along axis j; p, q and m, o are the other axes of either.
typedef struct edges {
    int32_t i, p, q, j, m, o;
    float sign_p, sign_q, sign_m, sign_o; // on which side of each box its edge is
} edges;

static float sign_of(float x) { return x < 0.0f ? -1.0f : 1.0f; }

// the edges that bound both the face of A along p and that of B along m, which look at each other
static void choose_sides(const boxes *k, edges *e)
{
    float along_m = k->t[0] * k->r[0][e->m] + k->t[1] * k->r[1][e->m] + k->t[2] * k->r[2][e->m];
    e->sign_p = sign_of(k->t[e->p]);
    e->sign_m = -sign_of(along_m);
    e->sign_q = sign_of(-e->sign_m * k->r[e->q][e->m]);
    e->sign_o = sign_of(-e->sign_p * k->r[e->p][e->o]);
}

// a vector across A's edge that is linear in z
typedef struct line {
    float p, q, slope_p, slope_q; // at z = 0, and by z
} line;

typedef struct stretch {
    float low, high; // z
} stretch;

// from A's edge to B's, and where they run side by side
static line between(const boxes *k, const edges *e, stretch *out)
{
    float m = e->sign_m * k->b[e->m], o = e->sign_o * k->b[e->o], c[3];
    for (int32_t x = 0; x < 3; ++x) c[x] = k->t[x] + k->r[x][e->m] * m + k->r[x][e->o] * o;
    float along = k->r[e->i][e->j], slope_p = k->r[e->p][e->j] / along, slope_q = k->r[e->q][e->j] / along,
          half = fe__absf(along) * k->b[e->j], z = c[e->i];
    *out = (stretch){fe__maxf(z - half, -k->a[e->i]), fe__minf(z + half, k->a[e->i])};
    return (line){c[e->p] - slope_p * z - e->sign_p * k->a[e->p], c[e->q] - slope_q * z - e->sign_q * k->a[e->q],
                  slope_p, slope_q};
}

static line between_cores(const boxes *k, const edges *e, line d, float r)
{
    d.p += r * (e->sign_p - e->sign_m * k->r[e->p][e->m] - e->sign_o * k->r[e->p][e->o]);
    d.q += r * (e->sign_q - e->sign_m * k->r[e->q][e->m] - e->sign_o * k->r[e->q][e->o]);
    return d;
}

// z where the line is nearest to 0
static float nearest_on(const line *d, stretch s)
{
    float square = d->slope_p * d->slope_p + d->slope_q * d->slope_q;
    const float no_slope = 1e-12f; // a micrometre in a metre: any z is as near
    if (square < no_slope) return 0.5f * (s.low + s.high);
    return fe__clampf(-(d->p * d->slope_p + d->q * d->slope_q) / square, s.low, s.high);
}

// Cuts off where the line looks away from the unit vector (p, q); 0 if it does at z.
static int32_t keep_side(const line *d, float p, float q, float z, stretch *s)
{
    float at_0 = d->p * p + d->q * q, slope = d->slope_p * p + d->slope_q * q;
    if (at_0 + slope * z <= 0.0f) return 0;
    if (at_0 + slope * s->low < 0.0f) s->low = -at_0 / slope;
    if (at_0 + slope * s->high < 0.0f) s->high = -at_0 / slope;
    return 1;
}

// Cuts the stretch to where the direction between the cores is in the cones of both edges; 0 if it is not at z.
static int32_t keep_cones(const boxes *k, const edges *e, const line *core, float z, stretch *s)
{
    return keep_side(core, e->sign_p, 0.0f, z, s) && keep_side(core, 0.0f, e->sign_q, z, s) &&
           keep_side(core, -e->sign_m * k->r[e->p][e->m], -e->sign_m * k->r[e->q][e->m], z, s) &&
           keep_side(core, -e->sign_o * k->r[e->p][e->o], -e->sign_o * k->r[e->q][e->o], z, s);
}

static void add_point(const boxes *k, const edges *e, const line *d, fe_vec3 n, float z, float margin, uint32_t id,
                      fe__manifold *manifold)
{
    float normal[3] = {n.x, n.y, n.z}, point[3], p = d->p + d->slope_p * z, q = d->q + d->slope_q * z;
    float separation = normal[e->p] * p + normal[e->q] * q;
    point[e->i] = z;
    point[e->p] = e->sign_p * k->a[e->p] + 0.5f * p;
    point[e->q] = e->sign_q * k->a[e->q] + 0.5f * q;
    if (separation <= margin) fe__add_point(manifold, fe__vec3(point[0], point[1], point[2]), separation, id);
}

static int32_t touch(const boxes *k, const edges *e, float r, float least, float margin, fe__manifold *manifold)
{
    stretch s;
    line d = between(k, e, &s), core = between_cores(k, e, d, r);
    if (s.low >= s.high) return 0;
    float z = nearest_on(&core, s);
    if (!keep_cones(k, e, &core, z, &s)) return 0;
    float p = core.p + core.slope_p * z, q = core.q + core.slope_q * z, length = sqrtf(p * p + q * q), n[3];
    n[e->i] = 0.0f, n[e->p] = p / length, n[e->q] = q / length;
    manifold->normal = fe__vec3(n[0], n[1], n[2]);
    if (n[e->p] * (d.p + d.slope_p * z) + n[e->q] * (d.q + d.slope_q * z) < least) return 0;
    uint32_t id = (uint32_t)(FE__FACING_EDGES + 3 * e->i + e->j) << 16 | (uint32_t)(e->sign_p > 0.0f) << 1 |
                  (uint32_t)(e->sign_q > 0.0f) << 2 | (uint32_t)(e->sign_m > 0.0f) << 3 |
                  (uint32_t)(e->sign_o > 0.0f) << 4;
    add_point(k, e, &d, manifold->normal, s.low, margin, id, manifold);
    add_point(k, e, &d, manifold->normal, s.high, margin, id | 1, manifold);
    return manifold->count > 0;
}

static const int8_t next[5] = {0, 1, 2, 0, 1};

// the best separation along a face beside the common axis, of A's i and B's j
static float along_faces(const boxes *k, int32_t i, int32_t j)
{
    float best = -FLT_MAX;
    for (int32_t x = 1; x < 3; ++x) {
        int32_t p = next[i + x], m = next[j + x];
        float of_a = fe__absf(k->t[p]) - k->a[p],
              of_b = fe__absf(k->t[0] * k->r[0][m] + k->t[1] * k->r[1][m] + k->t[2] * k->r[2][m]) - k->b[m];
        for (int32_t y = 0; y < 3; ++y) of_a -= fe__absf(k->r[p][y]) * k->b[y], of_b -= fe__absf(k->r[y][m]) * k->a[y];
        best = fe__maxf(best, fe__maxf(of_a, of_b));
    }
    return best;
}

static float smallest_of(const boxes *k)
{
    float smallest = FLT_MAX;
    for (int32_t x = 0; x < 3; ++x) smallest = fe__minf(smallest, fe__minf(k->a[x], k->b[x]));
    return smallest;
}

static int32_t touch_along(const boxes *k, int32_t i, int32_t j, float separation, float margin, fe__manifold *manifold)
{
    float smallest = smallest_of(k), r_least = fe__minf(CORE_LEAST, CORE_LEAST_SHARE * smallest),
          r = fe__clampf(-along_faces(k, i, j), r_least, fe__minf(CORE_MOST, CORE_MOST_SHARE * smallest)),
          least = DEPTHS * fe__minf(separation, 0.0f) - (DEPTHS - 1.0f) * r_least;
    for (int32_t x = 0; x < 4; ++x) {
        int32_t p = 1 + (x & 1), m = 1 + (x >> 1);
        edges e = {.i = i, .p = next[i + p], .q = next[i + 3 - p], .j = j, .m = next[j + m], .o = next[j + 3 - m]};
        if (fe__absf(k->r[e.p][e.m]) > FE_FACE_COS) return 0;
        choose_sides(k, &e);
        if (touch(k, &e, r, least, margin, manifold)) {
            manifold->axis = FE__FACING_EDGES + 3 * i + j;
            manifold->round = 1;
            return 1;
        }
    }
    return 0;
}

int32_t fe__touch_facing_edges(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float separation,
                               float margin, fe__manifold *manifold)
{
    boxes k = boxes_of(a, b, b_in_a);
    for (int32_t i = 0; i < 3; ++i)
        for (int32_t j = 0; j < 3; ++j)
            if (fe__absf(k.r[i][j]) > FE_FACE_COS) return touch_along(&k, i, j, separation, margin, manifold);
    return 0;
}
