// trig.h - sine, cosine and arc tangent, the same bits on every machine: IEEE + - * / in a fixed order, no libm.
//
// Errors: at most 1 unit in the last place of the sine and cosine for |x| <= 1e5, 2 units of the arc tangent. The float
// versions compute in double and round once. A NaN gives a NaN. Zeros have no sign here: -0 is taken, or given, as +0
// where the standard library would tell them apart.
#ifndef FE_CORE_TRIG_H
#define FE_CORE_TRIG_H
#include <stdint.h>

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

#endif
