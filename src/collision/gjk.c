// gjk.c - distance of two cores; see gjk.h.
//
// Sources: Gilbert, Johnson, Keerthi, A fast procedure for computing the distance between complex objects (1988); the nearest points of
// triangle and tetrahedron by regions, Ericson, Real-Time Collision Detection, 5.1.5 and 5.1.6.
#include "collision/gjk.h"

enum { MAX_ITERATIONS = 64 }; // boxes and segments need at most 12
#define OVERLAP_SIZE 1e-10    // of the cores' size: nearer than this they overlap; a million roundings
#define FLAT 1e-12            // of the size: a tetrahedron no higher than that has no inside
#define CONVERGED 1e-13       // of the squared distance

fe__vertex fe__cores_support(const fe__cores *cores, fe_dvec3 direction)
{
    fe_dvec3 on_a = fe__form_support(cores->a, direction);
    fe_dvec3 local = {-fe__ddot(cores->axis_x, direction), -fe__ddot(cores->axis_y, direction), -fe__ddot(cores->axis_z, direction)};
    fe_dvec3 q = fe__form_support(cores->b, local);
    fe_dvec3 turned = fe__dadd(fe__dadd(fe__dscale(q.x, cores->axis_x), fe__dscale(q.y, cores->axis_y)), fe__dscale(q.z, cores->axis_z));
    return (fe__vertex){fe__dsub(on_a, fe__dadd(cores->position, turned)), on_a};
}

// ---- nearest points of simplices ------------------------------------------------------------------------------------------------------
static int32_t keep_one(fe__vertex *vertex, double *weight, int32_t k)
{
    vertex[0] = vertex[k];
    weight[0] = 1.0;
    return 1;
}

// t of the way from vertex j to vertex k, j < k
static int32_t keep_two(fe__vertex *vertex, double *weight, int32_t j, int32_t k, double t)
{
    vertex[0] = vertex[j], vertex[1] = vertex[k];
    weight[0] = 1.0 - t, weight[1] = t;
    return 2;
}

static int32_t nearest_in_line(fe__vertex *vertex, double *weight)
{
    fe_dvec3 a = vertex[0].difference, ab = fe__dsub(vertex[1].difference, a);
    double along = -fe__ddot(a, ab), square = fe__ddot(ab, ab);
    if (!(along > 0.0)) return keep_one(vertex, weight, 0);
    if (along >= square) return keep_one(vertex, weight, 1);
    return keep_two(vertex, weight, 0, 1, along / square);
}

static int32_t nearest_in_triangle(fe__vertex *vertex, double *weight)
{
    fe_dvec3 a = vertex[0].difference, b = vertex[1].difference, c = vertex[2].difference, ab = fe__dsub(b, a), ac = fe__dsub(c, a);
    double a_ab = -fe__ddot(a, ab), a_ac = -fe__ddot(a, ac);
    if (a_ab <= 0.0 && a_ac <= 0.0) return keep_one(vertex, weight, 0);
    double b_ab = -fe__ddot(b, ab), b_ac = -fe__ddot(b, ac);
    if (b_ab >= 0.0 && b_ac <= b_ab) return keep_one(vertex, weight, 1);
    double in_c = a_ab * b_ac - b_ab * a_ac;
    if (in_c <= 0.0 && a_ab >= 0.0 && b_ab <= 0.0) return keep_two(vertex, weight, 0, 1, a_ab / (a_ab - b_ab));
    double c_ab = -fe__ddot(c, ab), c_ac = -fe__ddot(c, ac);
    if (c_ac >= 0.0 && c_ab <= c_ac) return keep_one(vertex, weight, 2);
    double in_b = c_ab * a_ac - a_ab * c_ac;
    if (in_b <= 0.0 && a_ac >= 0.0 && c_ac <= 0.0) return keep_two(vertex, weight, 0, 2, a_ac / (a_ac - c_ac));
    double in_a = b_ab * c_ac - c_ab * b_ac, bc = b_ac - b_ab, cb = c_ab - c_ac;
    if (in_a <= 0.0 && bc >= 0.0 && cb >= 0.0) return keep_two(vertex, weight, 1, 2, bc / (bc + cb));
    double inverse = 1.0 / (in_a + in_b + in_c);
    weight[1] = in_b * inverse, weight[2] = in_c * inverse, weight[0] = 1.0 - weight[1] - weight[2];
    return 3;
}

int32_t fe__nearest_in_simplex(fe__vertex *vertex, double *weight, int32_t count)
{
    return count == 1 ? keep_one(vertex, weight, 0) : count == 2 ? nearest_in_line(vertex, weight) : nearest_in_triangle(vertex, weight);
}

static fe_dvec3 weighted(const fe__vertex *vertex, const double *weight, int32_t count)
{
    fe_dvec3 sum = fe__dscale(weight[0], vertex[0].difference);
    for (int32_t i = 1; i < count; ++i) sum = fe__dadd(sum, fe__dscale(weight[i], vertex[i].difference));
    return sum;
}

// 1 when the origin and d lie on different sides of the triangle's plane. In a tetrahedron as flat as rounding no side is sure: 1.
static int32_t is_outside(fe_dvec3 a, fe_dvec3 b, fe_dvec3 c, fe_dvec3 d, double size)
{
    fe_dvec3 normal = fe__dcross(fe__dsub(b, a), fe__dsub(c, a));
    double origin = -fe__ddot(normal, a), other = fe__ddot(normal, fe__dsub(d, a)), flat = FLAT * size;
    return !(origin * other > 0.0) || other * other <= flat * flat * fe__ddot(normal, normal);
}

// The nearest of the faces that the origin is outside of; 4, unchanged, when it is inside all of them.
static int32_t nearest_in_tetrahedron(fe__vertex *vertex, double *weight, double size)
{
    static const int8_t faces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
    fe__vertex best[3];
    int32_t best_count = 0;
    double best_square = 0.0;
    for (int32_t f = 0; f < 4; ++f) {
        fe__vertex part[3] = {vertex[faces[f][0]], vertex[faces[f][1]], vertex[faces[f][2]]};
        if (!is_outside(part[0].difference, part[1].difference, part[2].difference, vertex[faces[f][3]].difference, size)) continue;
        double w[3];
        int32_t count = nearest_in_triangle(part, w);
        fe_dvec3 v = weighted(part, w, count);
        double square = fe__ddot(v, v);
        if (best_count > 0 && square >= best_square) continue;
        best_count = count, best_square = square;
        for (int32_t i = 0; i < count; ++i) best[i] = part[i], weight[i] = w[i];
    }
    if (best_count == 0) return 4;
    for (int32_t i = 0; i < best_count; ++i) vertex[i] = best[i];
    return best_count;
}

// ---- the walk towards the origin --------------------------------------------------------------------------------------------------------
static int32_t is_known(const fe__gjk *g, const fe__vertex *w)
{
    for (int32_t i = 0; i < g->count; ++i) {
        fe_dvec3 d = fe__dsub(g->vertex[i].difference, w->difference);
        if (fe__ddot(d, d) == 0.0) return 1;
    }
    return 0;
}

static void set_points(fe__gjk *g, const double *weight, fe_dvec3 v)
{
    g->on_a = (fe_dvec3){0.0, 0.0, 0.0};
    for (int32_t i = 0; i < g->count; ++i) g->on_a = fe__dadd(g->on_a, fe__dscale(weight[i], g->vertex[i].on_a));
    g->on_b = fe__dsub(g->on_a, v);
    g->distance = sqrt(fe__ddot(v, v));
}

void fe__gjk_distance(const fe__cores *cores, double limit, fe__gjk *g)
{
    double weight[4] = {1.0};
    fe_dvec3 v = fe__dscale(-1.0, cores->position);
    g->vertex[0] = fe__cores_support(cores, cores->position);
    g->count = 1, g->overlap = 0;
    v = g->vertex[0].difference;
    g->size = sqrt(fe__ddot(v, v));
    for (int32_t iteration = 0; iteration < MAX_ITERATIONS; ++iteration) {
        double square = fe__ddot(v, v), near = OVERLAP_SIZE * g->size;
        if (square <= near * near) {
            g->overlap = 1;
            break;
        }
        fe__vertex w = fe__cores_support(cores, fe__dscale(-1.0, v));
        g->size = fe__maxd(g->size, sqrt(fe__ddot(w.difference, w.difference)));
        // the plane through w across v separates: distance >= v . w / |v|
        double along = fe__ddot(v, w.difference);
        int32_t apart = along > 0.0 && along * along > limit * limit * square;
        if (apart || square - along <= CONVERGED * square || is_known(g, &w)) break;
        fe__gjk last = *g;
        double last_weight[4] = {weight[0], weight[1], weight[2], weight[3]};
        g->vertex[g->count++] = w;
        g->count = g->count == 4 ? nearest_in_tetrahedron(g->vertex, weight, g->size) : fe__nearest_in_simplex(g->vertex, weight, g->count);
        if (g->count == 4) {
            g->overlap = 1;
            break;
        }
        fe_dvec3 nearer = weighted(g->vertex, weight, g->count);
        if (fe__ddot(nearer, nearer) >= square) { // rounding: no nearer point is found
            *g = last;
            for (int32_t i = 0; i < 4; ++i) weight[i] = last_weight[i];
            break;
        }
        v = nearer;
    }
    set_points(g, weight, v);
    if (g->overlap) g->distance = 0.0;
}
