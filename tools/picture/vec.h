// vec.h - vectors of three doubles.
#ifndef PICTURE_VEC_H
#define PICTURE_VEC_H
#include <math.h>

typedef struct vec {
    double x, y, z;
} vec;

static inline vec make_vec(double x, double y, double z)
{
    vec a = {x, y, z};
    return a;
}

static inline vec add(vec a, vec b) { return make_vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline vec sub(vec a, vec b) { return make_vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline vec scale(double s, vec a) { return make_vec(s * a.x, s * a.y, s * a.z); }
static inline double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static inline vec cross(vec a, vec b)
{
    return make_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double length(vec a) { return sqrt(dot(a, a)); }

// 0 stays 0
static inline vec unit(vec a)
{
    double l = length(a);
    return l > 0.0 ? scale(1.0 / l, a) : a;
}

static inline vec mix(vec a, vec b, double t) { return add(a, scale(t, sub(b, a))); }
static inline double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

#endif
