/// @file vec.h
/// Vectors of three doubles.
#ifndef BENCH_VEC_H
#define BENCH_VEC_H

#include <math.h>

static inline double bench_dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static inline double bench_length(const double *a) { return sqrt(bench_dot(a, a)); }
static inline void bench_minus(const double *a, const double *b, double *out)
{
    for (int k = 0; k < 3; k++) out[k] = a[k] - b[k];
}
static inline void bench_cross(const double *a, const double *b, double *out)
{
    for (int k = 0; k < 3; k++) out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}
/// By the quaternion x y z w
static inline void bench_turn(const double *q, const double *v, double *out)
{
    double t[3], u[3];
    bench_cross(q, v, t);
    bench_cross(q, t, u);
    for (int k = 0; k < 3; k++) out[k] = v[k] + 2.0 * (q[3] * t[k] + u[k]);
}

#endif
