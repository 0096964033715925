// trig.h - sine, cosine and their inverses, the same bits on every machine: IEEE + - * / and sqrt in a fixed order, no libm.
//
// Errors: at most 1 unit in the last place of the sine and cosine for |x| <= 1e5, 2 units of the arc tangent, and 3 of arc sine and cosine,
// which reach it through one more rounded number. The float versions compute in double and round once. A NaN gives a NaN. Zeros have no
// sign here: -0 is taken, or given, as +0 where the standard library would tell them apart.
#ifndef FE_CORE_TRIG_H
#define FE_CORE_TRIG_H
#include <stdint.h>

// Above 2e5 the error grows to a unit in the last place of x; above 2^30 rad the sine is 0, the cosine 1: such an angle means nothing.
void fe__sincos(double x, double *out_sine, double *out_cosine);
double fe__sin(double x);
double fe__cos(double x);
// The angle of (x, y) from the x axis, in [-pi, pi]; 0 for (0, 0). Finite arguments up to 1e307.
double fe__atan2(double y, double x);
// Arguments outside [-1, 1] count as the nearer end: dot products of unit vectors exceed 1 by rounding.
double fe__asin(double x);
double fe__acos(double x);

static inline void fe__sincosf(float x, float *out_sine, float *out_cosine)
{
    double sine, cosine;
    fe__sincos((double)x, &sine, &cosine);
    *out_sine = (float)sine, *out_cosine = (float)cosine;
}
static inline float fe__sinf(float x) { return (float)fe__sin((double)x); }
static inline float fe__cosf(float x) { return (float)fe__cos((double)x); }
static inline float fe__atan2f(float y, float x) { return (float)fe__atan2((double)y, (double)x); }
static inline float fe__asinf(float x) { return (float)fe__asin((double)x); }
static inline float fe__acosf(float x) { return (float)fe__acos((double)x); }

#endif
