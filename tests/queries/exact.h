// exact.h - the distance of two forms in long double, by a walk over all pairs of vertices and edges.
//
// The judge of the queries' tests: slow, plain, and made of nothing that the library uses. A solid is the hull of its
// vertices (a point, a segment, a triangle, a box), swelled by a radius, or a half space. Two hulls that are apart are
// nearest at a vertex of one or at two edges; they overlap when an edge or a vertex of one meets the other.
#ifndef FE_QUERIES_EXACT_H
#define FE_QUERIES_EXACT_H
#include "feather.h"

#include <math.h>
#include <string.h>

typedef long double real;
typedef struct vec {
    real x, y, z;
} vec;

static inline vec v_add(vec a, vec b) { return (vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline vec v_sub(vec a, vec b) { return (vec){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline vec v_scale(real s, vec a) { return (vec){s * a.x, s * a.y, s * a.z}; }
static inline real v_dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline vec v_cross(vec a, vec b)
{
    return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline real v_length(vec a) { return sqrtl(v_dot(a, a)); }
static inline vec v_of(fe_dvec3 a) { return (vec){a.x, a.y, a.z}; }
static inline vec v_off(fe_vec3 a) { return (vec){a.x, a.y, a.z}; }
static inline vec v_turn(fe_quat q, vec a)
{
    vec u = {q.x, q.y, q.z}, t = v_cross(u, a);
    real w = q.w, k = 2 / (v_dot(u, u) + w * w);
    return v_add(v_add(a, v_scale(k * w, t)), v_scale(k, v_cross(u, t)));
}

typedef struct solid {
    int type; // fe_geometry_type, or EXACT_TRIANGLE
    int vertices, edges;
    vec vertex[8]; // world
    int edge[12][2];
    vec centre, axis[3]; // of a box
    real half[3], radius;
    vec normal; // of a half space and of a triangle
    real offset, reach;
} solid;

enum { EXACT_TRIANGLE = 100 };

static inline void make_box_solid(solid *s)
{
    s->vertices = 8;
    for (int i = 0; i < 8; ++i) {
        vec p = s->centre;
        for (int k = 0; k < 3; ++k) p = v_add(p, v_scale((i >> k & 1) ? s->half[k] : -s->half[k], s->axis[k]));
        s->vertex[i] = p;
        for (int k = 0; k < 3; ++k) {
            if (!(i >> k & 1)) s->edge[s->edges][0] = i, s->edge[s->edges++][1] = i | 1 << k;
        }
    }
}

// Pose of the geometry in the world; local poses are composed by the caller.
static inline solid make_solid(const fe_geometry *g, vec position, fe_quat q)
{
    solid s;
    memset(&s, 0, sizeof s);
    s.type = g->type;
    s.centre = position;
    s.axis[0] = v_turn(q, (vec){1, 0, 0}), s.axis[1] = v_turn(q, (vec){0, 1, 0}), s.axis[2] = v_turn(q, (vec){0, 0, 1});
    if (g->type == FE_GEOMETRY_SPHERE) {
        s.vertices = 1, s.vertex[0] = position, s.radius = g->radius, s.reach = g->radius;
    } else if (g->type == FE_GEOMETRY_CAPSULE) {
        s.vertices = 2, s.edges = 1, s.edge[0][1] = 1, s.radius = g->radius, s.reach = (real)g->radius + g->half_height;
        s.vertex[0] = v_sub(position, v_scale(g->half_height, s.axis[1])),
        s.vertex[1] = v_add(position, v_scale(g->half_height, s.axis[1]));
    } else if (g->type == FE_GEOMETRY_BOX) {
        s.half[0] = g->half_extents.x, s.half[1] = g->half_extents.y, s.half[2] = g->half_extents.z;
        s.reach = sqrtl(s.half[0] * s.half[0] + s.half[1] * s.half[1] + s.half[2] * s.half[2]);
        make_box_solid(&s);
    } else {
        vec n = v_off(g->normal);
        s.normal = v_turn(q, v_scale(1 / v_length(n), n));
        s.offset = v_dot(s.normal, position) + (real)g->distance / v_length(n), s.reach = INFINITY;
    }
    return s;
}

// Corners turning left around the side that counts.
static inline solid make_triangle_solid(vec a, vec b, vec c)
{
    solid s;
    memset(&s, 0, sizeof s);
    s.type = EXACT_TRIANGLE, s.vertices = s.edges = 3;
    s.vertex[0] = a, s.vertex[1] = b, s.vertex[2] = c;
    for (int i = 0; i < 3; ++i) s.edge[i][0] = i, s.edge[i][1] = (i + 1) % 3;
    s.normal = v_cross(v_sub(b, a), v_sub(c, a));
    s.normal = v_scale(1 / v_length(s.normal), s.normal);
    s.centre = v_scale((real)1 / 3, v_add(a, v_add(b, c)));
    for (int i = 0; i < 3; ++i) s.reach = fmaxl(s.reach, v_length(v_sub(s.vertex[i], s.centre)));
    return s;
}

// Triangle `half` of a cell of a heightfield at a pose, as feather.h describes it.
static inline solid make_field_solid(const fe_heightfield_def *d, int row, int column, int half, vec position,
                                     fe_quat q)
{
    const int rows[2][3] = {{0, 1, 1}, {0, 1, 0}}, columns[2][3] = {{0, 0, 1}, {0, 1, 1}};
    vec v[3];
    for (int i = 0; i < 3; ++i) {
        int r = row + rows[half][i], c = column + columns[half][i];
        vec p = {(real)c * (real)d->cell_x, (real)d->heights[r * d->columns + c], (real)r * (real)d->cell_z};
        v[i] = v_add(position, v_turn(q, p));
    }
    return make_triangle_solid(v[0], v[1], v[2]);
}

// ---- nearest points ------------------------------------------------------------------------------------------------
typedef struct nearness {
    real distance; // of the cores; of a half space signed
    vec on_still, on_mover;
} nearness;

static inline real v_clamp(real x, real low, real high) { return x < low ? low : x > high ? high : x; }

static inline vec nearest_on_edge(vec a, vec b, vec p)
{
    vec ab = v_sub(b, a);
    return v_add(a, v_scale(v_clamp(v_dot(v_sub(p, a), ab) / v_dot(ab, ab), 0, 1), ab));
}

static inline vec nearest_on_triangle(const solid *s, vec p)
{
    vec best = s->vertex[0];
    real least = INFINITY;
    int inside = 1;
    for (int i = 0; i < 3; ++i) {
        vec a = s->vertex[i], b = s->vertex[(i + 1) % 3], q = nearest_on_edge(a, b, p);
        real d = v_length(v_sub(p, q));
        if (d < least) least = d, best = q;
        if (v_dot(v_cross(s->normal, v_sub(b, a)), v_sub(p, a)) < 0) inside = 0;
    }
    return inside ? v_sub(p, v_scale(v_dot(s->normal, v_sub(p, s->vertex[0])), s->normal)) : best;
}

static inline vec nearest_on_core(const solid *s, vec p)
{
    if (s->type == FE_GEOMETRY_SPHERE) return s->vertex[0];
    if (s->type == FE_GEOMETRY_CAPSULE) return nearest_on_edge(s->vertex[0], s->vertex[1], p);
    if (s->type == EXACT_TRIANGLE) return nearest_on_triangle(s, p);
    vec d = v_sub(p, s->centre), q = s->centre;
    int inside = 1;
    for (int k = 0; k < 3; ++k) {
        real x = v_dot(d, s->axis[k]), c = v_clamp(x, -s->half[k], s->half[k]);
        inside &= x == c;
        q = v_add(q, v_scale(c, s->axis[k]));
    }
    return inside ? p : q;
}

static inline void nearest_of_edges(vec a, vec b, vec c, vec d, nearness *n)
{
    vec u = v_sub(b, a), v = v_sub(d, c), w = v_sub(a, c);
    real uu = v_dot(u, u), uv = v_dot(u, v), vv = v_dot(v, v), uw = v_dot(u, w), vw = v_dot(v, w),
         det = uu * vv - uv * uv;
    if (!(det > 1e-25L * uu * vv)) return; // parallel: the vertices tell
    real s = (uv * vw - vv * uw) / det, t = (uu * vw - uv * uw) / det;
    if (s < 0 || s > 1 || t < 0 || t > 1) return; // ends: the vertices tell
    vec p = v_add(a, v_scale(s, u)), q = v_add(c, v_scale(t, v));
    real distance = v_length(v_sub(p, q));
    if (distance < n->distance) *n = (nearness){distance, q, p};
}

static inline int edge_meets_box(const solid *box, vec a, vec b)
{
    real enter = 0, leave = 1;
    for (int k = 0; k < 3; ++k) {
        real p = v_dot(v_sub(a, box->centre), box->axis[k]), d = v_dot(v_sub(b, a), box->axis[k]);
        if (d == 0) {
            if (fabsl(p) > box->half[k]) return 0;
            continue;
        }
        real t = (-box->half[k] - p) / d, u = (box->half[k] - p) / d;
        enter = fmaxl(enter, fminl(t, u)), leave = fminl(leave, fmaxl(t, u));
    }
    return enter <= leave;
}

static inline int edge_meets_triangle(const solid *s, vec a, vec b)
{
    real at_a = v_dot(s->normal, v_sub(a, s->vertex[0])), at_b = v_dot(s->normal, v_sub(b, s->vertex[0]));
    if ((at_a > 0) == (at_b > 0)) return 0;
    vec p = v_add(a, v_scale(at_a / (at_a - at_b), v_sub(b, a)));
    for (int i = 0; i < 3; ++i) {
        vec c = s->vertex[i];
        if (v_dot(v_cross(s->normal, v_sub(s->vertex[(i + 1) % 3], c)), v_sub(p, c)) < 0) return 0;
    }
    return 1;
}

static inline int edges_meet(const solid *a, const solid *b, vec shift)
{
    for (int i = 0; i < a->edges; ++i) {
        vec p = v_add(a->vertex[a->edge[i][0]], shift), q = v_add(a->vertex[a->edge[i][1]], shift);
        if (b->type == FE_GEOMETRY_BOX && edge_meets_box(b, p, q)) return 1;
        if (b->type == EXACT_TRIANGLE && edge_meets_triangle(b, p, q)) return 1;
    }
    return 0;
}

// With the mover moved by `shift`
static inline nearness nearest(const solid *mover, vec shift, const solid *still)
{
    nearness n = {INFINITY, {0, 0, 0}, {0, 0, 0}};
    for (int i = 0; i < mover->vertices; ++i) {
        vec p = v_add(mover->vertex[i], shift);
        vec q = still->type == FE_GEOMETRY_PLANE
                    ? v_sub(p, v_scale(v_dot(still->normal, p) - still->offset, still->normal))
                    : nearest_on_core(still, p);
        real d = still->type == FE_GEOMETRY_PLANE ? v_dot(still->normal, p) - still->offset : v_length(v_sub(p, q));
        if (d < n.distance) n = (nearness){d, q, p};
    }
    for (int i = 0; i < still->vertices; ++i) {
        vec q = v_sub(still->vertex[i], shift), p = nearest_on_core(mover, q);
        real d = v_length(v_sub(p, q));
        if (d < n.distance) n = (nearness){d, still->vertex[i], v_add(p, shift)};
    }
    for (int i = 0; i < mover->edges; ++i) {
        vec a = v_add(mover->vertex[mover->edge[i][0]], shift), b = v_add(mover->vertex[mover->edge[i][1]], shift);
        for (int k = 0; k < still->edges; ++k)
            nearest_of_edges(a, b, still->vertex[still->edge[k][0]], still->vertex[still->edge[k][1]], &n);
    }
    if (edges_meet(mover, still, shift) || edges_meet(still, mover, v_scale(-1, shift))) n.distance = 0;
    return n;
}

// Of the surfaces: negative when swelled forms overlap, or below a half space; 0 for boxes that overlap.
static inline real gap_at(const solid *mover, const solid *still, vec shift)
{
    return nearest(mover, shift, still).distance - mover->radius - still->radius;
}

static inline solid shrunk(const solid *s, real by)
{
    solid small = *s;
    if (s->type == FE_GEOMETRY_BOX) {
        small.edges = 0;
        for (int k = 0; k < 3; ++k) small.half[k] -= by;
        make_box_solid(&small);
    }
    return small;
}

// Do they overlap by more than `margin`, 1; are they more than `margin` apart, -1; or neither, 0?
static inline int overlap_at(const solid *mover, const solid *still, vec shift, real margin)
{
    real gap = gap_at(mover, still, shift);
    if (gap > margin) return -1;
    if (gap < -margin) return 1;
    if (mover->radius + still->radius > 0 || still->type == FE_GEOMETRY_PLANE) return 0;
    solid a = shrunk(mover, margin), b = shrunk(still, margin);
    return nearest(&a, shift, &b).distance == 0;
}

// A ray against a triangle from its upper side: 1 it is met before `end`, -1 not, 0 it passes by an edge, an end or the
// plane too closely to tell.
static inline int ray_meets_triangle(vec origin, vec way, const solid *s, real end, real margin)
{
    real above = v_dot(s->normal, v_sub(origin, s->vertex[0])), rate = v_dot(s->normal, way), inside = INFINITY;
    if (above < -margin || rate >= 0 || above + end * rate > margin) return -1;
    vec p = v_add(origin, v_scale(-above / rate, way));
    for (int i = 0; i < 3; ++i) {
        vec side = v_sub(s->vertex[(i + 1) % 3], s->vertex[i]);
        inside = fminl(inside, v_dot(v_cross(s->normal, side), v_sub(p, s->vertex[i])) / v_length(side));
    }
    if (inside < -margin) return -1;
    return inside > margin && above > margin && above + end * rate < -margin;
}

// ---- on the way -----------------------------------------------------------------------------------------------------
// The gap is a convex function of t, so that its tangents bound it from below. Does it fall below -margin in [0, end]:
// 1; is it above margin all the way: -1; or neither: 0?
static inline int meets_on_the_way(const solid *mover, const solid *still, vec way, real end, real margin)
{
    real t[2] = {0, end}, f[2], rate[2], radius = mover->radius + still->radius;
    for (int i = 0, next = 0; i < 300; ++i) {
        vec shift = v_scale(t[next], way);
        nearness n = nearest(mover, shift, still);
        f[next] = n.distance - radius;
        if (f[next] <= margin) {
            int deep = overlap_at(mover, still, shift, margin);
            if (deep > 0) return 1;
            if (n.distance <= 0) return 0;
        }
        vec away = v_sub(n.on_mover, n.on_still);
        rate[next] = still->type == FE_GEOMETRY_PLANE ? v_dot(still->normal, way) : v_dot(away, way) / n.distance;
        if (i == 0) {
            next = 1;
            continue;
        }
        real low = fminl(f[0], f[1]), at = t[0];
        if (rate[0] < 0 && rate[1] > 0) {
            at = (f[1] - f[0] + rate[0] * t[0] - rate[1] * t[1]) / (rate[0] - rate[1]);
            low = f[0] + rate[0] * (at - t[0]);
        }
        if (low > margin) return -1;
        if (rate[0] >= 0 || rate[1] <= 0 || !(at > t[0] && at < t[1])) return 0;
        // which side the new point replaces is known by its slope
        real half = at;
        nearness m = nearest(mover, v_scale(half, way), still);
        vec d = v_sub(m.on_mover, m.on_still);
        next = (still->type == FE_GEOMETRY_PLANE ? v_dot(still->normal, way) : v_dot(d, way)) > 0 ? 1 : 0;
        t[next] = half;
    }
    return 0;
}

#endif
