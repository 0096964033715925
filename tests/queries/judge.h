// judge.h - what a ray, a sweep, an overlap and a closest point must find at one standing form: a mesh, triangle by
// triangle, or a hull, a cylinder, a cone.
//
// In long double, relative to the standing body's position, and with nothing that the library uses: signed distances
// from the forms' definitions (a hull's faces by trying all triples of its vertices), distances of moving forms from
// separation.h. An answer of 0 means that both will do.
#ifndef FE_QUERIES_JUDGE_H
#define FE_QUERIES_JUDGE_H
#include "queries/forms.h"

#include <stdlib.h>

enum { MOST_PLANES = 2 * MOST_POINTS };

typedef struct standing {
    const solid_form *form; // NULL: a mesh
    fe_quat rotation;
    vec axis[3]; // of the form's frame
    convex convex;
    int plane_count; // of a hull
    vec normals[MOST_PLANES];
    real offsets[MOST_PLANES];
    int triangle_count, is_two_sided;
    solid *triangles; // turned
} standing;

// ---- a convex form that stands -------------------------------------------------------------------------------------
static inline void find_planes(standing *s)
{
    const convex *c = &s->convex;
    s->plane_count = 0;
    for (int i = 0; i < c->count; ++i) {
        for (int j = i + 1; j < c->count; ++j) {
            for (int k = j + 1; k < c->count; ++k) {
                vec n = v_cross(v_sub(c->points[j], c->points[i]), v_sub(c->points[k], c->points[i]));
                real low = 0, high = 0;
                for (int p = 0; p < c->count; ++p) {
                    if (p == i || p == j || p == k) continue;
                    real h = v_dot(n, v_sub(c->points[p], c->points[i]));
                    low = fminl(low, h), high = fmaxl(high, h);
                }
                if (low < 0 && high > 0) continue;
                n = v_scale((high > 0 ? -1 : 1) / v_length(n), n);
                FE_WITHIN(s->plane_count, 0, MOST_PLANES - 1);
                s->normals[s->plane_count] = n, s->offsets[s->plane_count++] = v_dot(n, c->points[i]);
            }
        }
    }
}

static inline void stand_form(standing *s, const solid_form *form, fe_quat rotation)
{
    const vec middle = {0, 0, 0};
    s->form = form, s->rotation = rotation, s->triangle_count = 0;
    s->convex = convex_of_form(form, middle, rotation);
    memcpy(s->axis, s->convex.axis, sizeof s->axis);
    if (form->geometry.type == FE_GEOMETRY_HULL) find_planes(s);
}

static inline real distance_to_edge(real x, real y, real ax, real ay, real bx, real by)
{
    real ex = bx - ax, ey = by - ay, t = v_clamp(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey), 0, 1);
    return hypotl(x - ax - t * ex, y - ay - t * ey);
}

static inline real hull_distance(const standing *s, vec p)
{
    real most = -INFINITY;
    for (int i = 0; i < s->plane_count; ++i) most = fmaxl(most, v_dot(s->normals[i], p) - s->offsets[i]);
    if (most <= 0) return most;
    convex point = convex_at(FE_GEOMETRY_SPHERE, p, s->rotation);
    convex_add(&point, p);
    return separation_of(&point, (vec){0, 0, 0}, &s->convex, 1e-13L).most;
}

// To the surface, below 0 inside
static inline real signed_distance(const standing *s, vec p)
{
    if (s->form->geometry.type == FE_GEOMETRY_HULL) return hull_distance(s, p);
    real x = v_dot(p, s->axis[0]), y = v_dot(p, s->axis[1]), z = v_dot(p, s->axis[2]), out = hypotl(x, z),
         r = s->convex.half[0], h = s->convex.half[1];
    if (s->form->geometry.type == FE_GEOMETRY_CYLINDER) {
        real side = out - r, cap = fabsl(y) - h;
        return side > 0 && cap > 0 ? hypotl(side, cap) : fmaxl(side, cap);
    }
    real nearest_edge = fminl(distance_to_edge(out, y, 0, h, r, -h), distance_to_edge(out, y, 0, -h, r, -h));
    int is_inside = y > -h && out * 2 * h < r * (h - y);
    return is_inside ? -nearest_edge : nearest_edge;
}

// Along a ray that is convex: where it is least, by thirds
static inline real least_on_ray(const standing *s, vec from, vec way, real *out_t)
{
    real low = 0, high = 1;
    for (int i = 0; i < 120; ++i) {
        real a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (signed_distance(s, v_add(from, v_scale(a, way))) < signed_distance(s, v_add(from, v_scale(b, way))))
            high = b;
        else
            low = a;
    }
    *out_t = (low + high) / 2;
    return signed_distance(s, v_add(from, v_scale(*out_t, way)));
}

// ---- a mesh --------------------------------------------------------------------------------------------------------
// The triangle, seen from where it is met when both sides are
static inline solid seen_from(const standing *s, int triangle, vec from)
{
    solid t = s->triangles[triangle];
    if (s->is_two_sided && v_dot(t.normal, v_sub(from, t.vertex[0])) < 0) {
        vec second = t.vertex[1];
        t.vertex[1] = t.vertex[2], t.vertex[2] = second, t.normal = v_scale(-1, t.normal);
    }
    return t;
}

static inline real distance_to_triangle(const standing *s, int triangle, vec p)
{
    return v_length(v_sub(p, nearest_on_triangle(&s->triangles[triangle], p)));
}

static inline convex convex_of_triangle(const solid *t)
{
    convex c = convex_at(FE_GEOMETRY_HULL, t->centre, (fe_quat){0, 0, 0, 1});
    for (int k = 0; k < 3; ++k) convex_add(&c, t->vertex[k]);
    return c;
}

// ---- a form that moves ---------------------------------------------------------------------------------------------
typedef struct moving {
    convex convex;
    real radius, reach;
    vec way;
} moving;

static inline moving moving_form(const solid_form *f, vec start, fe_quat q, vec way)
{
    return (moving){convex_of_form(f, start, q), radius_of(f), f->reach, way};
}

// By a ten-thousandth about its middle: whatever touches that overlaps the whole
static inline moving shrunk_form(const moving *m)
{
    const real keep = 1 - 1e-4L;
    moving small = *m;
    vec middle = {0, 0, 0};
    small.radius *= keep;
    for (int k = 0; k < 3; ++k) small.convex.half[k] *= keep;
    for (int i = 0; i < m->convex.count; ++i)
        middle = v_add(middle, v_scale(1.0L / m->convex.count, m->convex.points[i]));
    for (int i = 0; i < m->convex.count; ++i)
        small.convex.points[i] = v_add(middle, v_scale(keep, v_sub(m->convex.points[i], middle)));
    return small;
}

#define TOUCH 1e-9L // m: what is that near touches

// -1: it stays farther than TOUCH off until `end`; 1: it comes that near, first at *t, with *away from the standing
// form; 0: undecided. The plane that holds the two apart at t holds them apart until the mover has crossed it: Newton's
// method, from the left.
static inline int comes_near(const moving *m, const convex *still, real end, real *t, vec *away)
{
    *t = 0;
    for (int i = 0; i < 200; ++i) {
        separation s = separation_of(&m->convex, v_scale(*t, m->way), still, TOUCH / 10);
        real gap = s.least - m->radius;
        *away = s.away;
        if (!(s.least > 0) || gap <= TOUCH) return s.most - m->radius > 2 * TOUCH ? 0 : 1;
        real rate = v_dot(s.away, m->way) / v_length(s.away);
        if (rate >= 0) return -1;
        *t += (gap - TOUCH / 2) / -rate;
        if (*t > end) return -1;
    }
    return 0;
}

// At the start and at the end on the same side of a plane along n: the whole way
static inline int is_beyond(const moving *m, real end, const solid *t, vec n)
{
    vec low = support_of(&m->convex, v_scale(-1, n));
    real height = INFINITY, size = v_length(n), drift = fminl(0, end * v_dot(n, m->way));
    for (int k = 0; k < 3; ++k) height = fminl(height, v_dot(n, v_sub(low, t->vertex[k])));
    return height + drift - m->radius * size > 1e-6L * size;
}

static inline int passes_triangle(const moving *m, real end, const solid *t)
{
    vec near = nearest_on_edge(m->convex.centre,
                               v_add(v_add(m->convex.centre, v_scale(end, m->way)), (vec){1e-12L, 0, 0}), t->centre);
    if (v_length(v_sub(near, t->centre)) > m->reach + t->reach + 1e-6L) return 1;
    if (is_beyond(m, end, t, t->normal) || is_beyond(m, end, t, v_scale(-1, t->normal))) return 1;
    for (int k = 0; k < 3; ++k)
        if (is_beyond(m, end, t, v_cross(v_sub(t->vertex[(k + 1) % 3], t->vertex[k]), t->normal))) return 1;
    return 0;
}

// Does it meet the triangle from a side that counts: 1 surely, -1 not, 0 perhaps, for what comes at a side of the
// triangle from below may pass or not.
static inline int meets_triangle(const moving *m, const standing *s, int triangle, real end)
{
    solid t = seen_from(s, triangle, m->convex.centre);
    if (passes_triangle(m, end, &t)) return -1;
    convex still = convex_of_triangle(&t);
    real at;
    vec away;
    int near = comes_near(m, &still, end, &at, &away);
    if (near <= 0 || at == 0) return near;
    real up = v_dot(away, t.normal) / v_length(away);
    return up > 0.01L;
}

// The height of its highest point over the triangle's plane
static inline real highest_over(const moving *m, real t, const solid *triangle)
{
    vec top = v_add(support_of(&m->convex, triangle->normal), v_scale(t, m->way));
    return v_dot(triangle->normal, v_sub(top, triangle->vertex[0])) + m->radius;
}

#endif
