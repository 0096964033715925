// hull_clouds.h - random clouds of points, of the kinds that break builders of hulls. The same seed gives the same
// cloud on every machine.
#ifndef FE_TESTS_HULL_CLOUDS_H
#define FE_TESTS_HULL_CLOUDS_H
#include "core/math.h"
#include "feather.h"

#include <math.h>
#include <string.h>

typedef enum cloud_kind {
    CLOUD_UNIFORM,  // in a box
    CLOUD_SPHERE,   // on a sphere
    CLOUD_GRID,     // of a lattice, each point as likely as any
    CLOUD_PLANES,   // on the faces of a turned box, exact up to the rounding of floats
    CLOUD_ROUGH,    // the same, with noise of about the tolerance
    CLOUD_TWINS,    // few places, many points in each, equal or a digit apart
    CLOUD_NEEDLE,   // 1000 : 1, turned
    CLOUD_PRISM,    // two rings, turned
    CLOUD_CLUSTERS, // dense ones, far apart
    CLOUD_RIM,      // a lens: a sharp rim, nearly flat caps
    CLOUD_DECADES,  // coordinates of all magnitudes, denormals among them
    CLOUD_KINDS
} cloud_kind;

enum { CLOUD_MOST = 500 };

typedef struct cloud {
    cloud_kind kind;
    int32_t count;
    float points[CLOUD_MOST][3];
} cloud;

static inline uint64_t cloud_draw(uint64_t *state) // xorshift64*
{
    *state ^= *state >> 12, *state ^= *state << 25, *state ^= *state >> 27;
    return *state * UINT64_C(2685821657736338717);
}
static inline double cloud_unit(uint64_t *state) // -1..1
{
    return (double)(cloud_draw(state) >> 11) * (2.0 / 9007199254740992.0) - 1.0;
}
static inline int32_t cloud_int(uint64_t *state, int32_t count) // 0..count - 1
{
    return (int32_t)(cloud_draw(state) % (uint64_t)count);
}
static inline fe_dvec3 cloud_vector(uint64_t *s)
{
    double x = cloud_unit(s), y = cloud_unit(s), z = cloud_unit(s);
    return (fe_dvec3){x, y, z};
}
static inline fe_dvec3 cloud_direction(uint64_t *s)
{
    for (;;) {
        fe_dvec3 v = cloud_vector(s);
        double square = v.x * v.x + v.y * v.y + v.z * v.z;
        if (square > 1.0 || square < 0.01) continue;
        double k = 1.0 / sqrt(square);
        return (fe_dvec3){k * v.x, k * v.y, k * v.z};
    }
}

static inline fe_dvec3 cloud_on_box(uint64_t *s)
{
    double p[3];
    for (int k = 0; k < 3; ++k) p[k] = cloud_int(s, 3) ? cloud_unit(s) : cloud_int(s, 2) ? 1.0 : -1.0;
    p[cloud_int(s, 3)] = cloud_int(s, 2) ? 1.0 : -1.0;
    return (fe_dvec3){p[0], p[1], 0.4 * p[2]};
}

static inline double cloud_power(uint64_t *s) // 2^-140..2^0
{
    double x = 1.0;
    for (int32_t k = cloud_int(s, 141); k > 0; --k) x *= 0.5;
    return x;
}

static inline fe_dvec3 cloud_place(const cloud *c, uint64_t *s, int32_t i, int32_t cells)
{
    fe_dvec3 v;
    switch (c->kind) {
    case CLOUD_SPHERE:
        return cloud_direction(s);
    case CLOUD_GRID:
        v.x = cloud_int(s, cells), v.y = cloud_int(s, cells), v.z = cloud_int(s, cells);
        return v;
    case CLOUD_PLANES:
    case CLOUD_ROUGH:
        return cloud_on_box(s);
    case CLOUD_TWINS:
    case CLOUD_CLUSTERS:
        if (i < cells + 4) return cloud_vector(s);
        i = cloud_int(s, cells + 4);
        v = (fe_dvec3){(double)c->points[i][0], (double)c->points[i][1], (double)c->points[i][2]};
        if (c->kind == CLOUD_CLUSTERS || cloud_int(s, 2)) {
            double near = c->kind == CLOUD_CLUSTERS ? 1e-3 : 1e-7;
            v.x += near * cloud_unit(s), v.y += near * cloud_unit(s), v.z += near * cloud_unit(s);
        }
        return v;
    case CLOUD_NEEDLE:
        v = cloud_vector(s);
        return (fe_dvec3){v.x, 1e-3 * v.y, 1e-3 * v.z};
    case CLOUD_PRISM: {
        double sine, cosine;
        fe__sincos(6.283185307179586 * (double)(i / 2) / (double)((c->count + 1) / 2), &sine, &cosine);
        return (fe_dvec3){cosine, i % 2 ? 0.5 : -0.5, sine};
    }
    case CLOUD_RIM: {
        v = cloud_direction(s);
        double k = cloud_int(s, 3) ? 1.0 / sqrt(v.x * v.x + v.z * v.z + 1e-9) : 1.0;
        return (fe_dvec3){k * v.x, k == 1.0 ? 0.003 * v.y : 0.0, k * v.z};
    }
    case CLOUD_DECADES:
        v = cloud_vector(s);
        v.x *= cloud_power(s), v.y *= cloud_power(s), v.z *= cloud_power(s);
        return v;
    default:
        return cloud_vector(s);
    }
}

static inline fe_dvec3 cloud_turn(fe_dvec3 v, fe_dvec3 a, double angle) // Rodrigues
{
    double c, s;
    fe__sincos(angle, &s, &c);
    double k = (1.0 - c) * (a.x * v.x + a.y * v.y + a.z * v.z);
    return (fe_dvec3){c * v.x + s * (a.y * v.z - a.z * v.y) + k * a.x, c * v.y + s * (a.z * v.x - a.x * v.z) + k * a.y,
                      c * v.z + s * (a.x * v.y - a.y * v.x) + k * a.z};
}

// One in four far from 0, one in three of another size
static inline void cloud_make(cloud *c, uint64_t seed)
{
    uint64_t s = seed * UINT64_C(0x9E3779B97F4A7C15) + 1;
    for (int32_t i = 0; i < 4; ++i) cloud_draw(&s);
    c->kind = (cloud_kind)cloud_int(&s, CLOUD_KINDS);
    int32_t few = cloud_int(&s, 2);
    c->count = 4 + cloud_int(&s, few ? 37 : CLOUD_MOST - 3);
    int32_t cells = 2 + cloud_int(&s, 6),
            turned = c->kind != CLOUD_GRID && c->kind != CLOUD_DECADES && cloud_int(&s, 2);
    fe_dvec3 axis = cloud_direction(&s), offset = {0.0, 0.0, 0.0};
    double angle = turned ? 3.14 * cloud_unit(&s) : 0.0, size = 1.0;
    if (!cloud_int(&s, 3)) size = cloud_int(&s, 2) ? 0.05 : 200.0;
    if (!cloud_int(&s, 4)) offset = cloud_vector(&s), offset.x *= 1e4, offset.y *= 1e4, offset.z *= 1e4;
    for (int32_t i = 0; i < c->count; ++i) {
        fe_dvec3 v = cloud_place(c, &s, i, cells);
        if (c->kind == CLOUD_ROUGH)
            v.x += 1e-5 * cloud_unit(&s), v.y += 1e-5 * cloud_unit(&s), v.z += 1e-5 * cloud_unit(&s);
        // its own later points are made of the points of twins and clusters: these are turned and moved last
        c->points[i][0] = (float)v.x, c->points[i][1] = (float)v.y, c->points[i][2] = (float)v.z;
    }
    for (int32_t i = 0; i < c->count; ++i) {
        fe_dvec3 v = {(double)c->points[i][0], (double)c->points[i][1], (double)c->points[i][2]};
        if (turned) v = cloud_turn(v, axis, angle);
        c->points[i][0] = (float)(size * v.x + offset.x);
        c->points[i][1] = (float)(size * v.y + offset.y);
        c->points[i][2] = (float)(size * v.z + offset.z);
    }
}

#endif
