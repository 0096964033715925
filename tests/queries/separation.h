// separation.h - how far two convex forms are apart, in long double, with a proof.
//
// The judge of sweeps of cylinders, cones and hulls: their support functions, and nothing that the library uses. The
// nearest point v of the forms' difference is searched by Gilbert's, Johnson's and Keerthi's algorithm (1988). Whatever
// the search does, any of its points is an upper bound, and the support along any direction a lower one.
#ifndef FE_QUERIES_SEPARATION_H
#define FE_QUERIES_SEPARATION_H
#include "queries/exact.h"

enum { MOST_POINTS = 24, MOST_SEARCH = 4000 };

// A sphere and a capsule are a point and a segment; their radius is the caller's.
typedef struct convex {
    int type; // fe_geometry_type; FE_GEOMETRY_HULL for whatever has points
    vec centre, axis[3];
    real half[3]; // of a cylinder and a cone: radius, half height
    int count;
    vec points[MOST_POINTS]; // world
} convex;

static inline convex convex_at(int type, vec centre, fe_quat q)
{
    convex c;
    memset(&c, 0, sizeof c);
    c.type = type, c.centre = centre;
    c.axis[0] = v_turn(q, (vec){1, 0, 0}), c.axis[1] = v_turn(q, (vec){0, 1, 0}), c.axis[2] = v_turn(q, (vec){0, 0, 1});
    return c;
}

static inline void convex_add(convex *c, vec point) { c->points[c->count++] = point; }

static inline convex convex_of(const fe_geometry *g, const float (*points)[3], int count, vec centre, fe_quat q)
{
    convex c = convex_at(g->type, centre, q);
    if (g->type == FE_GEOMETRY_SPHERE) convex_add(&c, centre);
    if (g->type == FE_GEOMETRY_CAPSULE) {
        convex_add(&c, v_add(centre, v_scale(g->half_height, c.axis[1])));
        convex_add(&c, v_sub(centre, v_scale(g->half_height, c.axis[1])));
    }
    if (g->type == FE_GEOMETRY_BOX)
        c.half[0] = g->half_extents.x, c.half[1] = g->half_extents.y, c.half[2] = g->half_extents.z;
    if (g->type == FE_GEOMETRY_CYLINDER || g->type == FE_GEOMETRY_CONE)
        c.half[0] = g->radius, c.half[1] = g->half_height;
    for (int i = 0; g->type == FE_GEOMETRY_HULL && i < count; ++i)
        convex_add(&c, v_add(centre, v_turn(q, (vec){points[i][0], points[i][1], points[i][2]})));
    return c;
}

static inline vec farthest_point(const convex *c, vec d)
{
    vec best = c->points[0];
    for (int i = 1; i < c->count; ++i)
        if (v_dot(c->points[i], d) > v_dot(best, d)) best = c->points[i];
    return best;
}

static inline vec on_rim(const convex *c, vec d, real height)
{
    vec p = v_add(c->centre, v_scale(height, c->axis[1]));
    real x = v_dot(d, c->axis[0]), z = v_dot(d, c->axis[2]), length = sqrtl(x * x + z * z);
    if (!(length > 0)) return p;
    p = v_add(p, v_scale(c->half[0] * x / length, c->axis[0]));
    return v_add(p, v_scale(c->half[0] * z / length, c->axis[2]));
}

static inline vec support_of(const convex *c, vec d)
{
    if (c->count) return farthest_point(c, d);
    real up = v_dot(d, c->axis[1]), high = up < 0 ? -c->half[1] : c->half[1];
    if (c->type == FE_GEOMETRY_CYLINDER) return on_rim(c, d, high);
    vec p = c->centre;
    if (c->type == FE_GEOMETRY_CONE) {
        vec tip = v_add(p, v_scale(c->half[1], c->axis[1])), rim = on_rim(c, d, -c->half[1]);
        return v_dot(tip, d) > v_dot(rim, d) ? tip : rim;
    }
    for (int k = 0; k < 3; ++k) p = v_add(p, v_scale(v_dot(d, c->axis[k]) < 0 ? -c->half[k] : c->half[k], c->axis[k]));
    return p;
}

// ---- the nearest point of a simplex to the origin ------------------------------------------------------------------
typedef struct simplex {
    int count;
    vec w[4];
} simplex;

// Moves v along the edges e to where it is nearest to the origin, and adds the way to x. 0: the edges are flat.
static inline int slide(const vec *e, int n, vec *v, real x[3])
{
    real m[3][4]; // e_i . e_k y_k = -e_i . v, solved by elimination
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) m[i][k] = v_dot(e[i], e[k]);
        m[i][3] = -v_dot(e[i], *v);
    }
    for (int i = 0; i < n; ++i) {
        if (!(m[i][i] > 0)) return 0;
        for (int r = i + 1; r < n; ++r) {
            real f = m[r][i] / m[i][i];
            for (int k = i; k < n; ++k) m[r][k] -= f * m[i][k];
            m[r][3] -= f * m[i][3];
        }
    }
    real y[3];
    for (int i = n - 1; i >= 0; --i) {
        y[i] = m[i][3];
        for (int k = i + 1; k < n; ++k) y[i] -= m[i][k] * y[k];
        y[i] /= m[i][i];
        x[i] += y[i], *v = v_add(*v, v_scale(y[i], e[i]));
    }
    return 1;
}

// The point of the plane, line or corner of `set` that is nearest to the origin. What is near it is known to the last
// digit of its length, for it slides again from there. 0: flat, or it is not between the corners.
static inline int nearest_within(const simplex *s, int set, vec *v)
{
    enum { ROUNDS = 3 };
    vec e[3], first = {0, 0, 0};
    real x[3] = {0, 0, 0}, rest = 1;
    int n = -1;
    for (int i = 0; i < s->count; ++i) {
        if (!(set >> i & 1)) continue;
        if (n < 0)
            first = s->w[i];
        else
            e[n] = v_sub(s->w[i], first);
        n += 1;
    }
    *v = first;
    for (int round = 0; round < ROUNDS; ++round)
        if (!slide(e, n, v, x)) return 0;
    for (int i = 0; i < n; ++i) {
        if (!(x[i] >= 0)) return 0;
        rest -= x[i];
    }
    return rest >= 0;
}

// Keeps the corners that it lies between.
static inline vec nearest_of_simplex(simplex *s)
{
    real least = INFINITY;
    vec best = s->w[0];
    int kept = 1;
    for (int set = 1; set < 1 << s->count; ++set) {
        vec v;
        if (!nearest_within(s, set, &v)) continue;
        if (v_length(v) < least) least = v_length(v), best = v, kept = set;
    }
    simplex small = {0, {{0, 0, 0}}};
    for (int i = 0; i < s->count; ++i)
        if (kept >> i & 1) small.w[small.count++] = s->w[i];
    *s = small;
    return best;
}

// ---- how far apart --------------------------------------------------------------------------------------------------
typedef struct separation {
    real least, most; // the distance is between them
    vec away;         // from the standing to the moving form
} separation;

// With the mover moved by `shift`. The search ends when the bounds are `exact` apart, or cannot be brought nearer.
static inline separation separation_of(const convex *mover, vec shift, const convex *still, real exact)
{
    separation s = {0, INFINITY, {0, 0, 0}};
    vec v = v_sub(v_add(mover->centre, shift), still->centre);
    simplex corners = {0, {{0, 0, 0}}};
    for (int i = 0; i < MOST_SEARCH && v_length(v) > 0; ++i) {
        vec w = v_sub(v_add(support_of(mover, v_scale(-1, v)), shift), support_of(still, v));
        real low = v_dot(v, w) / v_length(v);
        if (low > s.least) s.least = low, s.away = v;
        if (s.most - s.least <= exact || corners.count == 4) return s;
        corners.w[corners.count++] = w;
        v = nearest_of_simplex(&corners);
        s.most = fminl(s.most, v_length(v));
    }
    return s;
}

#endif
