// gjk.c - distance of two cores; see gjk.h.
//
// Gilbert, Johnson, Keerthi, A fast procedure for computing the distance between complex objects in three-dimensional
// space (1988); the nearest points of triangle and tetrahedron are found by regions as in Ericson, Real-Time Collision
// Detection (2005), 5.1.5 and 5.1.6.
#include "collision/form/gjk.h"

enum { MAX_ITERATIONS = 64 }; // Boxes and segments need at most 12.
// These are shares of the cores' size.
#define OVERLAP_SIZE 1e-10 // Cores that are nearer than this, a million roundings, overlap;
#define CLOSE_SIZE 2e-14   // in the close search, which resolves a hundred roundings, nearer than this.
#define FLAT 1e-12         // A tetrahedron no higher than this has no inside.
#define UNSURE 1e-15       // This much is some roundings.
#define ROUGH 1e-12        // Weights are good if they put the nearest points no farther off than this.
// The search ends when a step can gain no more than this share of the squared distance.
#define CONVERGED 1e-13
// This share of the distance a separating plane has to show in fe__gjk_distance_or_gap.
#define GAP_SHARE 0.5

fe__vertex fe__cores_support(const fe__cores *cores, fe_dvec3 direction)
{
    fe_dvec3 on_a, q = {0.0, 0.0, 0.0};
    if (cores->corners) { // The first of equally far corners counts.
        double most = fe__ddot(cores->corners[0], direction);
        on_a = cores->corners[0];
        for (int32_t i = 1; i < 3; ++i) {
            double along = fe__ddot(cores->corners[i], direction);
            if (along > most) most = along, on_a = cores->corners[i];
        }
    } else {
        on_a = fe__form_support(cores->a, direction);
    }
    if (!fe__form_is_ball(cores->b)) {
        fe_dvec3 local = {-fe__ddot(cores->axis_x, direction), -fe__ddot(cores->axis_y, direction),
                          -fe__ddot(cores->axis_z, direction)};
        q = fe__form_support(cores->b, local);
    }
    fe_dvec3 turned = fe__dadd(fe__dadd(fe__dscale(q.x, cores->axis_x), fe__dscale(q.y, cores->axis_y)),
                               fe__dscale(q.z, cores->axis_z));
    return (fe__vertex){fe__dsub(on_a, fe__dadd(cores->position, turned)), on_a};
}

// ---- nearest points of simplices ------------------------------------------------------------------------------------
// Each function gives the weights of the corners in the point nearest the origin; a corner that does not belong to the
// nearest feature has the weight 0.
static void weigh_line(fe_dvec3 a, fe_dvec3 b, double *weight)
{
    fe_dvec3 ab = fe__dsub(b, a);
    double along = -fe__ddot(a, ab), square = fe__ddot(ab, ab);
    double t = !(along > 0.0) ? 0.0 : along >= square ? 1.0 : along / square;
    weight[0] = 1.0 - t, weight[1] = t;
}

static void set_weights(double *weight, double a, double b, double c) { weight[0] = a, weight[1] = b, weight[2] = c; }

static void weigh_triangle(fe_dvec3 a, fe_dvec3 b, fe_dvec3 c, double *weight)
{
    fe_dvec3 ab = fe__dsub(b, a), ac = fe__dsub(c, a);
    double a_ab = -fe__ddot(a, ab), a_ac = -fe__ddot(a, ac), b_ab = -fe__ddot(b, ab), b_ac = -fe__ddot(b, ac);
    double c_ab = -fe__ddot(c, ab), c_ac = -fe__ddot(c, ac);
    double in_a = b_ab * c_ac - c_ab * b_ac, in_b = c_ab * a_ac - a_ab * c_ac, in_c = a_ab * b_ac - b_ab * a_ac;
    double bc = b_ac - b_ab, cb = c_ab - c_ac;
    if (a_ab <= 0.0 && a_ac <= 0.0) {
        set_weights(weight, 1.0, 0.0, 0.0);
    } else if (b_ab >= 0.0 && b_ac <= b_ab) {
        set_weights(weight, 0.0, 1.0, 0.0);
    } else if (c_ac >= 0.0 && c_ab <= c_ac) {
        set_weights(weight, 0.0, 0.0, 1.0);
    } else if (in_c <= 0.0 && a_ab >= 0.0 && b_ab <= 0.0) {
        double t = a_ab / (a_ab - b_ab);
        set_weights(weight, 1.0 - t, t, 0.0);
    } else if (in_b <= 0.0 && a_ac >= 0.0 && c_ac <= 0.0) {
        double t = a_ac / (a_ac - c_ac);
        set_weights(weight, 1.0 - t, 0.0, t);
    } else if (in_a <= 0.0 && bc >= 0.0 && cb >= 0.0) {
        double t = bc / (bc + cb);
        set_weights(weight, 0.0, 1.0 - t, t);
    } else {
        double inverse = 1.0 / (in_a + in_b + in_c), u = in_b * inverse, v = in_c * inverse;
        set_weights(weight, 1.0 - u - v, u, v);
    }
}

static fe_dvec3 weighted(const fe__vertex *vertex, const double *weight, int32_t count)
{
    fe_dvec3 sum = fe__dscale(weight[0], vertex[0].difference);
    for (int32_t i = 1; i < count; ++i) sum = fe__dadd(sum, fe__dscale(weight[i], vertex[i].difference));
    return sum;
}

// The same point, computed as the foot of the perpendicular from the origin on the triangle or the line. The supports
// of a curved surface come so near to each other that the weights of a sliver say little; but its normal is good, as
// long as it is longer than rounding, a share of `size`, makes it.
static fe_dvec3 foot(const fe__vertex *vertex, const double *weight, int32_t count, double size)
{
    fe_dvec3 a = vertex[0].difference;
    if (count == 3) {
        fe_dvec3 ab = fe__dsub(vertex[1].difference, a), ac = fe__dsub(vertex[2].difference, a), n = fe__dcross(ab, ac);
        double along = fe__ddot(n, a), longest = fe__maxd(fe__ddot(ab, ab), fe__ddot(ac, ac));
        double error = UNSURE * size;
        if (along * along > error * error * longest * fe__ddot(a, a)) return fe__dscale(along / fe__ddot(n, n), n);
    } else if (count == 2) {
        fe_dvec3 d = fe__dsub(vertex[1].difference, a);
        double along = -fe__ddot(a, d), square = fe__ddot(d, d);
        if (along >= 0.0 && along <= square) return fe__dadd(a, fe__dscale(along / square, d));
    }
    return weighted(vertex, weight, count);
}

// Finds the nearest point of the faces that the origin is outside of. 0: the origin is inside all faces
static int32_t weigh_tetrahedron(const fe__vertex *vertex, double *weight, double size)
{
    static const int8_t faces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
    double best = (double)INFINITY;
    for (int32_t f = 0; f < 4; ++f) {
        const int8_t *k = faces[f];
        fe_dvec3 a = vertex[k[0]].difference, b = vertex[k[1]].difference, c = vertex[k[2]].difference,
                 d = vertex[k[3]].difference;
        // The origin is outside of abc if d lies on the other side of its plane. No side is sure in a tetrahedron as
        // flat as rounding: there the origin is outside of every face.
        fe_dvec3 normal = fe__dcross(fe__dsub(b, a), fe__dsub(c, a));
        double origin = -fe__ddot(normal, a), other = fe__ddot(normal, fe__dsub(d, a)), flat = FLAT * size;
        if (origin * other > 0.0 && !(other * other <= flat * flat * fe__ddot(normal, normal))) continue;
        double w[3];
        weigh_triangle(a, b, c, w);
        fe_dvec3 v = fe__dadd(fe__dadd(fe__dscale(w[0], a), fe__dscale(w[1], b)), fe__dscale(w[2], c));
        double square = fe__ddot(v, v);
        if (!(square < best)) continue;
        best = square;
        weight[k[0]] = w[0], weight[k[1]] = w[1], weight[k[2]] = w[2], weight[k[3]] = 0.0;
    }
    return best < (double)INFINITY;
}

static int32_t drop_weightless(fe__vertex *vertex, double *weight, int32_t count)
{
    int32_t left = 0;
    for (int32_t i = 0; i < count; ++i) {
        if (weight[i] == 0.0) continue;
        vertex[left] = vertex[i];
        weight[left++] = weight[i];
    }
    return left;
}

int32_t fe__nearest_in_simplex(fe__vertex *vertex, double *weight, int32_t count)
{
    if (count == 1)
        weight[0] = 1.0;
    else if (count == 2)
        weigh_line(vertex[0].difference, vertex[1].difference, weight);
    else
        weigh_triangle(vertex[0].difference, vertex[1].difference, vertex[2].difference, weight);
    return drop_weightless(vertex, weight, count);
}

// ---- the search ----------------------------------------------------------------------------------------------------
// The squared distance of the weighted point from v.
static double miss_of(const fe__gjk *g, const double *weight, fe_dvec3 v)
{
    fe_dvec3 d = fe__dsub(weighted(g->vertex, weight, g->count), v);
    return fe__ddot(d, d);
}

// The weights of a sliver come from products of whole lengths and say little: they put the nearest points anywhere
// along it. The areas that v, its foot, cuts from the triangle are as exact as the corners are about v. If the sliver
// is as flat as rounding it has no areas, and v lies at one of its sides.
static void weigh_sliver(const fe__gjk *g, fe_dvec3 v, double *weight)
{
    double best = g->count == 3 ? miss_of(g, weight, v) : 0.0, rough = ROUGH * g->size;
    if (best <= rough * rough) return;
    fe_dvec3 p[3];
    for (int32_t i = 0; i < 3; ++i) p[i] = fe__dsub(g->vertex[i].difference, v);
    fe_dvec3 n = fe__dcross(fe__dsub(p[1], p[0]), fe__dsub(p[2], p[0]));
    double candidates[4][3] = {{0.0}}, *area = candidates[3], sum = 0.0;
    for (int32_t i = 0; i < 3; ++i) {
        double along[2];
        sum += area[i] = fe__maxd(fe__ddot(n, fe__dcross(p[(i + 1) % 3], p[(i + 2) % 3])), 0.0);
        weigh_line(p[i], p[(i + 1) % 3], along);
        candidates[i][i] = along[0], candidates[i][(i + 1) % 3] = along[1];
    }
    if (sum > 0.0) set_weights(area, area[0] / sum, area[1] / sum, area[2] / sum);
    for (int32_t i = sum > 0.0 ? -1 : 0; i < 3; ++i) {
        const double *candidate = i < 0 ? area : candidates[i];
        double miss = miss_of(g, candidate, v);
        if (miss < best) best = miss, set_weights(weight, candidate[0], candidate[1], candidate[2]);
    }
}

// Adds w, and keeps the part of the simplex nearest the origin. 0: the tetrahedron holds the origin
static int32_t add_vertex(fe__gjk *g, const fe__vertex *w, double *weight)
{
    g->vertex[g->count++] = *w;
    if (g->count < 4) {
        g->count = fe__nearest_in_simplex(g->vertex, weight, g->count);
        return 1;
    }
    if (!weigh_tetrahedron(g->vertex, weight, g->size)) return 0;
    g->count = drop_weightless(g->vertex, weight, 4);
    return 1;
}

// The simplex before its last vertex came.
typedef struct simplex {
    fe__vertex vertex[3];
    double weight[3];
    int32_t count;
} simplex;

static void take_back(const simplex *last, fe__gjk *g, double *weight)
{
    g->count = last->count;
    for (int32_t i = 0; i < last->count; ++i) g->vertex[i] = last->vertex[i], weight[i] = last->weight[i];
}

// Begins with the one to three vertices in g. Stops when a plane shows that the cores are farther apart than `limit`,
// and shows this share of their distance.
static void approach_origin(const fe__cores *cores, double limit, double share, int32_t closely, fe__gjk *g)
{
    double overlap_size = closely ? CLOSE_SIZE : OVERLAP_SIZE;
    double weight[4];
    int32_t curved = (!cores->corners && fe__form_is_curved(cores->a)) || fe__form_is_curved(cores->b);
    g->overlap = 0;
    for (int32_t i = 0; i < g->count; ++i)
        g->size = fe__maxd(g->size, sqrt(fe__ddot(g->vertex[i].difference, g->vertex[i].difference)));
    g->count = fe__nearest_in_simplex(g->vertex, weight, g->count);
    fe_dvec3 v = weighted(g->vertex, weight, g->count);
    g->apart_by = 0.0; // The distance is no less than this: then a sliver that seems to hold the origin does not.
    g->across = (fe_dvec3){0.0, 0.0, 0.0};
    for (int32_t iteration = 0; iteration < MAX_ITERATIONS; ++iteration) {
        double square = fe__ddot(v, v), near = overlap_size * g->size;
        if (square <= near * near) {
            g->overlap = !(curved && g->apart_by > near);
            break;
        }
        fe__vertex w = fe__cores_support(cores, fe__dscale(-1.0, v));
        g->size = fe__maxd(g->size, sqrt(fe__ddot(w.difference, w.difference)));
        // The plane through w across v separates the cores: distance >= v . w / |v|.
        double along = fe__ddot(v, w.difference);
        double bound = along / sqrt(square);
        if (bound > g->apart_by) g->apart_by = bound, g->across = v;
        int32_t is_apart = along > share * square && along * along > limit * limit * square, is_known = 0;
        if (is_apart || square - along <= CONVERGED * square) break;
        simplex last;
        last.count = g->count;
        for (int32_t i = 0; i < g->count; ++i) {
            fe_dvec3 d = fe__dsub(g->vertex[i].difference, w.difference);
            is_known |= fe__ddot(d, d) == 0.0;
            last.vertex[i] = g->vertex[i], last.weight[i] = weight[i];
        }
        if (is_known) break;
        if (!add_vertex(g, &w, weight)) {
            g->overlap = !(curved && g->apart_by > near);
            if (!g->overlap) take_back(&last, g, weight);
            break;
        }
        fe_dvec3 nearer =
            curved || closely ? foot(g->vertex, weight, g->count, g->size) : weighted(g->vertex, weight, g->count);
        if (fe__ddot(nearer, nearer) >= square) { // Rounding prevents a nearer point.
            take_back(&last, g, weight);
            break;
        }
        v = nearer;
    }
    weigh_sliver(g, v, weight);
    g->on_a = (fe_dvec3){0.0, 0.0, 0.0};
    for (int32_t i = 0; i < g->count; ++i) g->on_a = fe__dadd(g->on_a, fe__dscale(weight[i], g->vertex[i].on_a));
    g->on_b = fe__dsub(g->on_a, v);
    g->way = fe__dscale(-1.0, v);
    g->distance = g->overlap ? 0.0 : sqrt(fe__ddot(v, v));
}

static void begin(const fe__cores *cores, fe__gjk *g)
{
    g->vertex[0] = fe__cores_support(cores, cores->position);
    g->count = 1;
    g->size = 0.0;
}

void fe__gjk_distance_from(const fe__cores *cores, double limit, fe__gjk *g)
{
    g->size = 0.0;
    approach_origin(cores, limit, 0.0, 0, g);
}

void fe__gjk_distance(const fe__cores *cores, double limit, fe__gjk *g)
{
    begin(cores, g);
    approach_origin(cores, limit, 0.0, 0, g);
}

void fe__gjk_distance_or_gap(const fe__cores *cores, double limit, fe__gjk *g)
{
    begin(cores, g);
    approach_origin(cores, limit, GAP_SHARE, 0, g);
}

void fe__gjk_distance_closely(const fe__cores *cores, fe__gjk *g)
{
    begin(cores, g);
    approach_origin(cores, (double)INFINITY, 0.0, 1, g);
}

// The height of a triangle that is no sliver is more than a thousandth of its longest side.
static int32_t is_sliver(const fe__vertex *v)
{
    const double least = 1e-3;
    fe_dvec3 ab = fe__dsub(v[1].difference, v[0].difference), ac = fe__dsub(v[2].difference, v[0].difference),
             n = fe__dcross(ab, ac);
    double longest = fe__maxd(fe__ddot(ab, ab), fe__ddot(ac, ac));
    return !(fe__ddot(n, n) > least * least * longest * longest);
}

// g->size stays: the lengths that were met before bound the precision here as well.
void fe__gjk_distance_closely_after(const fe__cores *cores, fe_dvec3 shift, fe__gjk *g)
{
    if (g->overlap || g->count > 3 || (g->count == 3 && is_sliver(g->vertex))) {
        fe__gjk_distance_closely(cores, g);
        return;
    }
    for (int32_t i = 0; i < g->count; ++i) g->vertex[i].difference = fe__dsub(g->vertex[i].difference, shift);
    approach_origin(cores, (double)INFINITY, 0.0, 1, g);
}
