// hull_judge.h - is this a convex hull of these points, as collision/form/hull.h promises? In double, by walks over
// everything.
#ifndef FE_TESTS_HULL_JUDGE_H
#define FE_TESTS_HULL_JUDGE_H
#include "collision/form/hull.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The least height above all planes that a point may have and still be out of any rounding's doing, in extents: a step
// of the builder's grid, and the rounding of a plane to floats
#define JUDGE_ROUNDING 2e-7

static inline double judge_height(const fe__hull *h, int32_t face, fe_dvec3 p)
{
    return fe__ddot(fe__widen(fe__hull_normal(h, face)), p) - (double)h->distances[face];
}
static inline fe_dvec3 judge_vertex(const fe__hull *h, int32_t i) { return fe__widen(fe__hull_vertex(h, i)); }

#define JUDGE(condition, ...)                                    \
    do {                                                         \
        if (!(condition)) {                                      \
            fprintf(stderr, "%s does not hold: ", #condition);   \
            fprintf(stderr, __VA_ARGS__), fprintf(stderr, "\n"); \
            return 0;                                            \
        }                                                        \
    } while (0)

static inline int32_t judge_topology(const fe__hull *h)
{
    int32_t half_count = 2 * h->edge_count, corners = 0;
    JUDGE(h->vertex_count >= 4 && h->vertex_count <= FE__HULL_VERTICES, "%d vertices", h->vertex_count);
    JUDGE(h->vertex_count - h->edge_count + h->face_count == 2, "Euler: %d - %d + %d", h->vertex_count, h->edge_count,
          h->face_count);
    for (int32_t i = 0; i < half_count; ++i) {
        const fe__hull_edge *e = &h->edges[i], *twin = &h->edges[i ^ 1], *next = &h->edges[e->next];
        JUDGE(e->next < half_count && e->face < h->face_count && e->origin < h->vertex_count, "half-edge %d", i);
        JUDGE(e->face != twin->face && next->face == e->face && next->origin == twin->origin, "half-edge %d", i);
        JUDGE((i & 1) || e->origin < twin->origin, "half-edge %d", i);
    }
    for (int32_t f = 0; f < h->face_count; ++f) {
        const fe__hull_face *face = &h->faces[f];
        JUDGE(face->count >= 3 && face->first == corners, "face %d", f);
        for (int32_t k = 0, edge = face->edge; k < face->count; ++k, edge = h->edges[edge].next) {
            JUDGE(h->edges[edge].face == f && h->edges[edge].origin == h->corners[corners + k], "face %d", f);
            if (k == face->count - 1) JUDGE(h->edges[edge].next == face->edge, "face %d", f);
        }
        corners += face->count;
    }
    JUDGE(corners == half_count, "%d corners", corners);
    for (int32_t v = 0; v < h->vertex_count; ++v) {
        int32_t edge = h->spokes[v], around = 0;
        do {
            JUDGE(h->edges[edge].origin == v, "vertex %d", v);
            edge = h->edges[edge ^ 1].next;
            around += 1;
        } while (edge != h->spokes[v] && around <= half_count);
        JUDGE(around >= 2 && around <= half_count, "%d edges at vertex %d", around, v);
        corners -= around;
    }
    JUDGE(corners == 0, "half-edges that no vertex has: %d", corners);
    return 1;
}

// Planes support, faces are flat and convex, neighbours bend away
static inline int32_t judge_convexity(const fe__hull *h, double most_flat)
{
    for (int32_t f = 0; f < h->face_count; ++f) {
        fe_dvec3 n = fe__widen(fe__hull_normal(h, f));
        double highest = -1e300;
        JUDGE(fe__absd(fe__ddot(n, n) - 1.0) < 5e-7, "face %d", f);
        for (int32_t v = 0; v < h->vertex_count; ++v)
            highest = fe__maxd(highest, judge_height(h, f, judge_vertex(h, v)));
        double ulp = 2.4e-7 * fe__absd((double)h->distances[f]) + 1e-37;
        JUDGE(highest <= 0.0 && highest >= -ulp, "face %d: %g", f, highest);
        const uint8_t *corner = h->corners + h->faces[f].first;
        int32_t count = h->faces[f].count;
        for (int32_t k = 0; k < count; ++k) {
            fe_dvec3 a = judge_vertex(h, corner[k]), b = judge_vertex(h, corner[(k + 1) % count]),
                     c = judge_vertex(h, corner[(k + 2) % count]), u = fe__dsub(b, a), w = fe__dsub(c, b);
            JUDGE(judge_height(h, f, a) >= -(double)h->flatness, "face %d, corner %d: %g", f, k, judge_height(h, f, a));
            fe_dvec3 past = fe__dadd(u, w);
            double turn = fe__ddot(fe__dcross(u, w), n) / sqrt(fe__ddot(past, past)); // m
            JUDGE(turn >= -most_flat, "face %d is hollow by %g at corner %d", f, turn, k);
        }
    }
    for (int32_t k = 0; k < h->edge_count; ++k) {
        fe_dvec3 l = fe__widen(fe__hull_lane(&h->left, k)), r = fe__widen(fe__hull_lane(&h->right, k)),
                 e = fe__widen(fe__hull_lane(&h->vectors, k));
        double bend = fe__ddot(fe__dcross(l, r), e) / sqrt(fe__ddot(e, e));
        JUDGE(bend > 0.0, "edge %d bends by %g, %g m long", k, bend, sqrt(fe__ddot(e, e)));
    }
    return 1;
}

static inline int32_t judge_lanes(const fe__hull *h)
{
    JUDGE((uintptr_t)h->vertices.x % 64 == 0 && (uintptr_t)h->right.z % 64 == 0, "alignment");
    for (int32_t i = h->vertex_count; i < fe__hull_padded(h->vertex_count); ++i)
        JUDGE(!memcmp(&h->vertices.y[i], &h->vertices.y[0], sizeof(float)), "vertex lane %d", i);
    for (int32_t i = h->face_count; i < fe__hull_padded(h->face_count); ++i)
        JUDGE(!memcmp(&h->distances[i], &h->distances[0], sizeof(float)), "plane lane %d", i);
    for (int32_t k = 0; k < h->edge_count; ++k) {
        fe_vec3 left = fe__hull_lane(&h->left, k), own = fe__hull_normal(h, h->edges[2 * k].face);
        fe_vec3 tail = fe__hull_lane(&h->tails, k), vertex = fe__hull_vertex(h, h->edges[2 * k].origin);
        JUDGE(!memcmp(&left, &own, sizeof left) && !memcmp(&tail, &vertex, sizeof tail), "edge lane %d", k);
    }
    return 1;
}

// Vertices are points in their order; no point is farther outside than told
static inline int32_t judge_points(const fe__hull *h, const float *points, int32_t count, double extent)
{
    int32_t vertex = 0;
    for (int32_t i = 0; i < count; ++i) {
        fe_dvec3 p = {(double)points[3 * i], (double)points[3 * i + 1], (double)points[3 * i + 2]},
                 o = fe__widen(h->origin);
        fe_dvec3 local = fe__dsub(p, o);
        double outside = -1e300;
        for (int32_t f = 0; f < h->face_count; ++f) outside = fe__maxd(outside, judge_height(h, f, local));
        JUDGE(outside <= (double)h->error + JUDGE_ROUNDING * extent, "point %d is %g m outside, told were %g (%g)", i,
              outside, (double)h->error, outside / extent);
        if (vertex == h->vertex_count) continue;
        fe_vec3 v = fe__hull_vertex(h, vertex);
        vertex += (double)v.x == local.x && (double)v.y == local.y && (double)v.z == local.z;
    }
    JUDGE(vertex == h->vertex_count, "vertex %d is no point", vertex);
    return 1;
}

static inline int32_t judge_hull(const fe__hull *h, const float *points, int32_t count, int32_t most_vertices)
{
    double extent = (double)h->extent;
    JUDGE(h->vertex_count <= most_vertices, "%d vertices", h->vertex_count);
    double most_flat = 0.25 * (double)h->tolerance + JUDGE_ROUNDING * extent; // form/hull.h
    JUDGE((double)h->flatness <= most_flat, "flat to %g", (double)h->flatness);
    return judge_topology(h) && judge_convexity(h, most_flat) && judge_lanes(h) &&
           judge_points(h, points, count, extent);
}

#endif
