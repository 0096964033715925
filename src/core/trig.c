// trig.c - see trig.h.
//
// Each function reduces its argument to a short interval, keeping the rounding error of the reduction as a second
// number, and adds a polynomial. The polynomials interpolate the exact function at the Chebyshev nodes of the interval,
// computed with 60 digits and rounded; the errors named below are relative to the function and leave out the rounding
// of the evaluation. Reduction after Cody and Waite, Software Manual for the Elementary Functions, 1980; exact
// differences after Knuth, The Art of Computer Programming 2, 4.2.2.
#include "core/trig.h"

#include "core/math.h"

// pi/2 = PART_1 + PART_2 + PART_3: the first two have 33 bits, so that their products with a whole number of 17 bits or
// less are exact.
#define HALF_PI_PART_1 0x1.921fb544p+0
#define HALF_PI_PART_2 0x1.0b4611a6p-34
#define HALF_PI_PART_3 0x1.3198a2e037073p-69
#define TWO_OVER_PI 0.6366197723675814
#define ANGLE_LIMIT 1073741824.0 // rad: the number of quadrants fits 32 bits

// pi/2 and pi to 107 bits
#define HALF_PI_HIGH 1.5707963267948966
#define HALF_PI_LOW 6.123233995736766e-17
#define PI_HIGH 3.141592653589793
#define PI_LOW 1.2246467991473532e-16

// An angle x = quadrant pi/2 + high + low, |high| <= pi/4, |low| <= half a unit in the last place of high.
typedef struct reduced_angle {
    double high, low;
    int32_t quadrant;
} reduced_angle;

static reduced_angle reduce(double x)
{
    int32_t quadrant = (int32_t)(x * TWO_OVER_PI + (x < 0.0 ? -0.5 : 0.5));
    double n = (double)quadrant;
    double a = x - n * HALF_PI_PART_1; // exact
    double b = n * HALF_PI_PART_2;     // exact
    double c = n * HALF_PI_PART_3;

    // a - b = difference + error exactly, whichever is larger
    double difference = a - b, part = difference - a;
    double error = (a - (difference - part)) - (b + part);
    double rest = error - c;
    double high = difference + rest;
    return (reduced_angle){high, (difference - high) + rest, quadrant};
}

// sin(h + l) = h + h^3 P(h^2) + l cos h, cos h = 1 - h^2 / 2 here. |h| <= pi/4: error of P 6e-18.
static double sine_of(reduced_angle a)
{
    double h = a.high, z = h * h;
    double p = -7.586685070091267e-13;
    p = 1.605853141458901e-10 + z * p;
    p = -2.5052106231157904e-08 + z * p;
    p = 2.7557319219335453e-06 + z * p;
    p = -0.0001984126984126506 + z * p;
    p = 0.008333333333333331 + z * p;
    p = -0.16666666666666666 + z * p;
    return h + (h * z * p + a.low * (1.0 - 0.5 * z));
}

// cos(h + l) = 1 - h^2 / 2 + h^4 Q(h^2) - h l, with the rounding error of 1 - h^2 / 2 given back. |h| <= pi/4: error of
// Q 9e-19.
static double cosine_of(reduced_angle a)
{
    double h = a.high, z = h * h;
    double q = -1.1382614868556325e-11;
    q = 2.0876146024689747e-09 + z * q;
    q = -2.7557317270560326e-07 + z * q;
    q = 2.4801587298763433e-05 + z * q;
    q = -0.0013888888888887395 + z * q;
    q = 0.041666666666666664 + z * q;
    double half = 0.5 * z, most = 1.0 - half;
    return most + (((1.0 - most) - half) + (z * z * q - h * a.low));
}

void fe__sincos(double x, double *out_sine, double *out_cosine)
{
    if (!(fe__absd(x) <= ANGLE_LIMIT)) {
        *out_sine = x != x ? x : 0.0;
        *out_cosine = x != x ? x : 1.0;
        return;
    }
    reduced_angle a = reduce(x);
    double sine = sine_of(a), cosine = cosine_of(a);
    int32_t quarter = a.quadrant & 3;
    double s = quarter & 1 ? cosine : sine;
    double c = quarter & 1 ? sine : cosine;
    *out_sine = quarter & 2 ? -s : s;
    *out_cosine = quarter == 1 || quarter == 2 ? -c : c;
}

// atan(n / m) for 0 <= n <= m, around the nearest quarter c = k / 4:
//
//   atan(n / m) = atan(c) + atan(u),   u = (n - c m) / (m + c n),   |u| <= 1/8
//   atan(u) = u + u^3 P(u^2), error of P 3e-19
static double first_octant(double n, double m)
{
    static const double quarter_high[5] = {0.0, 0.24497866312686414, 0.4636476090008061, 0.6435011087932844,
                                           0.7853981633974483};
    static const double quarter_low[5] = {0.0, 1.0698755618734451e-17, 2.2698777452961687e-17, 1.5834785051444286e-17,
                                          3.061616997868383e-17};
    double eighth = 8.0 * n;
    int k = (eighth >= m) + (eighth >= 3.0 * m) + (eighth >= 5.0 * m) + (eighth >= 7.0 * m);
    double c = 0.25 * (double)k;

    double u = (n - c * m) / (m + c * n), z = u * u;
    double p = -0.06354261916865055;
    p = 0.07685659502924379 + z * p;
    p = -0.09090838581566069 + z * p;
    p = 0.11111110726438342 + z * p;
    p = -0.1428571428471383 + z * p;
    p = 0.19999999999999024 + z * p;
    p = -0.3333333333333333 + z * p;
    return quarter_high[k] + (u + (quarter_low[k] + u * z * p));
}

double fe__atan2(double y, double x)
{
    double height = fe__absd(y), width = fe__absd(x);
    if (height == 0.0 && width == 0.0) return 0.0;
    double angle =
        height > width ? HALF_PI_HIGH - (first_octant(width, height) - HALF_PI_LOW) : first_octant(height, width);
    if (x < 0.0) angle = PI_HIGH - (angle - PI_LOW);
    return y < 0.0 ? -angle : angle;
}
