// math.h - vectors, quaternions and matrices of the scalar code.
//
// The public structs are the working types. Every function is built from IEEE + - * / and sqrt, in a fixed order, so
// that each compiler gives the same bits (contraction.h). Trigonometry is in math.h; libm beyond sqrt is not used.
#ifndef FE_CORE_MATH_H
#define FE_CORE_MATH_H
#include "core/contraction.h"
#include "feather.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

// ---- math -----------------------------------------------------------------------------------------------------------

#define FE_PI 3.14159265358979323846f

// Kernels load a vector and the number behind it as one quad
#define FE__IS_QUAD(type, vector, fourth)                                                                     \
    _Static_assert(offsetof(type, vector) % 16 == 0 && offsetof(type, fourth) == offsetof(type, vector) + 12, \
                   #vector " and " #fourth)

typedef struct fe__mat3 {
    fe_vec3 x, y, z; // columns: the images of the axes
} fe__mat3;

typedef struct fe__sym3 {
    float xx, xy, xz, yy, yz, zz; // a symmetric 3 x 3 matrix
} fe__sym3;

static inline float fe__minf(float a, float b) { return a < b ? a : b; }
static inline float fe__maxf(float a, float b) { return a > b ? a : b; }
static inline float fe__clampf(float a, float low, float high) { return fe__minf(fe__maxf(a, low), high); }
static inline double fe__clampd(double a, double low, double high) { return a < low ? low : a > high ? high : a; }
static inline float fe__absf(float a) { return __builtin_fabsf(a); }
// a magnitude below `least` is 0; NaN stays
static inline float fe__flush(float a, float least) { return fe__absf(a) < least ? 0.0f : a; }
static inline double fe__mind(double a, double b) { return a < b ? a : b; }
static inline double fe__maxd(double a, double b) { return a > b ? a : b; }
static inline double fe__absd(double a) { return __builtin_fabs(a); }
// The least float that is not below x
static inline float fe__float_above(double x)
{
    union {
        float value;
        int32_t bits;
    } f = {(float)x};
    if ((double)f.value >= x) return f.value;
    // the next float: its bits are the next integer, for x > 0, or the one before
    f.bits = f.value == 0.0f ? 1 : f.bits + (f.value > 0.0f ? 1 : -1);
    return f.value;
}
static inline int32_t fe__mini(int32_t a, int32_t b) { return a < b ? a : b; }
static inline int64_t fe__minl(int64_t a, int64_t b) { return a < b ? a : b; }
static inline int64_t fe__maxl(int64_t a, int64_t b) { return a > b ? a : b; }
static inline int32_t fe__maxi(int32_t a, int32_t b) { return a > b ? a : b; }

// ---- fe_vec3 -------------------------------------------------------------------------------------------------------
static inline fe_vec3 fe__vec3(float x, float y, float z) { return (fe_vec3){x, y, z}; }
static inline fe_vec3 fe__quad_vector(const float *a) { return (fe_vec3){a[0], a[1], a[2]}; }
static inline fe_vec3 fe__add(fe_vec3 a, fe_vec3 b) { return (fe_vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline fe_vec3 fe__sub(fe_vec3 a, fe_vec3 b) { return (fe_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline fe_vec3 fe__neg(fe_vec3 a) { return (fe_vec3){-a.x, -a.y, -a.z}; }
static inline fe_vec3 fe__scale(float s, fe_vec3 a) { return (fe_vec3){s * a.x, s * a.y, s * a.z}; }
static inline fe_vec3 fe__add_scaled(fe_vec3 a, float s, fe_vec3 b)
{
    return (fe_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static inline float fe__dot(fe_vec3 a, fe_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline fe_vec3 fe__cross(fe_vec3 a, fe_vec3 b)
{
    return (fe_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline float fe__length(fe_vec3 a) { return sqrtf(fe__dot(a, a)); }

// ---- fe_dvec3 ------------------------------------------------------------------------------------------------------
static inline fe_dvec3 fe__dadd(fe_dvec3 a, fe_dvec3 b) { return (fe_dvec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline fe_dvec3 fe__dsub(fe_dvec3 a, fe_dvec3 b) { return (fe_dvec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline fe_dvec3 fe__dscale(double s, fe_dvec3 a) { return (fe_dvec3){s * a.x, s * a.y, s * a.z}; }
static inline double fe__ddot(fe_dvec3 a, fe_dvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline fe_dvec3 fe__dcross(fe_dvec3 a, fe_dvec3 b)
{
    return (fe_dvec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline fe_dvec3 fe__widen(fe_vec3 a) { return (fe_dvec3){(double)a.x, (double)a.y, (double)a.z}; }
static inline fe_vec3 fe__narrow(fe_dvec3 a) { return (fe_vec3){(float)a.x, (float)a.y, (float)a.z}; }

// ---- rotations -----------------------------------------------------------------------------------------------------
static inline fe_quat fe__quat_of(const float *a) { return (fe_quat){a[0], a[1], a[2], a[3]}; }
static inline fe_quat fe__identity(void) { return (fe_quat){0.0f, 0.0f, 0.0f, 1.0f}; }
static inline fe_quat fe__conjugate(fe_quat q) { return (fe_quat){-q.x, -q.y, -q.z, q.w}; }
static inline fe_quat fe__product(fe_quat a, fe_quat b) // b's rotation first
{
    return (fe_quat){a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                     a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
// q/|q|, computed in double: what a stored rotation means
static inline fe_quat fe__normalized(fe_quat q)
{
    double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w,
           k = 1.0 / sqrt(x * x + y * y + z * z + w * w);
    return (fe_quat){(float)(k * x), (float)(k * y), (float)(k * z), (float)(k * w)};
}
// R(q) a = a + 2 w (u x a) + 2 u x (u x a), q = (u, w)
static inline fe_vec3 fe__rotate(fe_quat q, fe_vec3 a)
{
    fe_vec3 u = {q.x, q.y, q.z}, t = fe__cross(u, a);
    t = fe__add(t, t);
    return fe__add(fe__add_scaled(a, q.w, t), fe__cross(u, t));
}
static inline fe_vec3 fe__rotate_back(fe_quat q, fe_vec3 a) { return fe__rotate(fe__conjugate(q), a); }
// the same in double, of a quaternion of any length
static inline fe_dvec3 fe__drotate(fe_quat q, fe_dvec3 a)
{
    fe_dvec3 u = {(double)q.x, (double)q.y, (double)q.z}, t = fe__dcross(u, a);
    double w = (double)q.w, k = 2.0 / (fe__ddot(u, u) + w * w);
    return fe__dadd(fe__dadd(a, fe__dscale(k * w, t)), fe__dscale(k, fe__dcross(u, t)));
}
static inline fe_dvec3 fe__drotate_back(fe_quat q, fe_dvec3 a) { return fe__drotate(fe__conjugate(q), a); }
static inline fe__mat3 fe__matrix(fe_quat q)
{
    float xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z,
          wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return (fe__mat3){{1.0f - 2.0f * (yy + zz), 2.0f * (xy + wz), 2.0f * (xz - wy)},
                      {2.0f * (xy - wz), 1.0f - 2.0f * (xx + zz), 2.0f * (yz + wx)},
                      {2.0f * (xz + wy), 2.0f * (yz - wx), 1.0f - 2.0f * (xx + yy)}};
}
static inline fe_vec3 fe__mul(const fe__mat3 *m, fe_vec3 a)
{
    return fe__add_scaled(fe__add_scaled(fe__scale(a.x, m->x), a.y, m->y), a.z, m->z);
}
static inline fe_vec3 fe__mul_transposed(const fe__mat3 *m, fe_vec3 a)
{
    return (fe_vec3){fe__dot(m->x, a), fe__dot(m->y, a), fe__dot(m->z, a)};
}
static inline fe_vec3 fe__mul_sym(const fe__sym3 *m, fe_vec3 a)
{
    return (fe_vec3){m->xx * a.x + m->xy * a.y + m->xz * a.z, m->xy * a.x + m->yy * a.y + m->yz * a.z,
                     m->xz * a.x + m->yz * a.y + m->zz * a.z};
}

// ---- trig -----------------------------------------------------------------------------------------------------------
// Sine, cosine and arc tangent, the same bits on every machine: IEEE + - * / in a fixed order, no libm.
//
// Errors: at most 1 unit in the last place of the sine and cosine for |x| <= 1e5, 2 units of the arc tangent. The float
// versions compute in double and round once. A NaN gives a NaN. Zeros have no sign here: -0 is taken, or given, as +0
// where the standard library would tell them apart.

// Above 2e5 the error grows to a unit in the last place of x; above 2^30 rad the sine is 0, the cosine 1: such an angle
// means nothing.
void fe__sincos(double x, double *out_sine, double *out_cosine);
// The angle of (x, y) from the x axis, in [-pi, pi]; 0 for (0, 0). Finite arguments up to 1e307.
double fe__atan2(double y, double x);

static inline void fe__sincosf(float x, float *out_sine, float *out_cosine)
{
    double sine, cosine;
    fe__sincos((double)x, &sine, &cosine);
    *out_sine = (float)sine, *out_cosine = (float)cosine;
}
static inline float fe__atan2f(float y, float x) { return (float)fe__atan2((double)y, (double)x); }

// ---- tensor ---------------------------------------------------------------------------------------------------------
// Inertia in double: a symmetric 3 x 3 matrix, its principal moments and axes. Used for bodies, from their
// shapes, and for hulls, from their points.

typedef struct fe__tensor {
    double m[3][3];
} fe__tensor;

// The principal moments are left on the diagonal of `a`. Returns the rotation whose columns are their axes: the
// identity for a tensor that is diagonal already.
fe__tensor fe__tensor_diagonalise(fe__tensor *a);
// Its quaternion, of length 1 up to the rounding of floats
fe_quat fe__tensor_rotation(const fe__tensor *r);

#endif
