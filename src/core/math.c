// math.c - see math.h.
//
// Each function reduces its argument to a short interval, keeping the rounding error of the reduction as a second
// number, and adds a polynomial. The polynomials interpolate the exact function at the Chebyshev nodes of the interval,
// computed with 60 digits and rounded; the errors named below are relative to the function and leave out the rounding
// of the evaluation. Reduction after Cody and Waite, Software Manual for the Elementary Functions, 1980; exact
// differences after Knuth, The Art of Computer Programming 2, 4.2.2.
#include "core/math.h"

// ---- trig -----------------------------------------------------------------------------------------------------------

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

// ---- tensor ---------------------------------------------------------------------------------------------------------

enum { JACOBI_SWEEPS = 12 }; // converges quadratically: 5 or 6 are used

// One Jacobi rotation in the plane (p, q) that zeroes a[p][q]; `v` collects the rotations, its columns become the axes.
// Golub and Van Loan, Matrix Computations, 8.5
static void rotate_plane(fe__tensor *a, fe__tensor *v, int p, int q)
{
    double apq = a->m[p][q];
    if (apq == 0.0) return;
    double tau = (a->m[q][q] - a->m[p][p]) / (2.0 * apq);
    double t = (tau >= 0.0 ? 1.0 : -1.0) / (fe__absd(tau) + sqrt(1.0 + tau * tau));
    double c = 1.0 / sqrt(1.0 + t * t), s = t * c;
    for (int k = 0; k < 3; ++k) {
        double x = a->m[k][p], y = a->m[k][q];
        a->m[k][p] = c * x - s * y, a->m[k][q] = s * x + c * y;
    }
    for (int k = 0; k < 3; ++k) {
        double x = a->m[p][k], y = a->m[q][k];
        a->m[p][k] = c * x - s * y, a->m[q][k] = s * x + c * y;
        x = v->m[k][p], y = v->m[k][q];
        v->m[k][p] = c * x - s * y, v->m[k][q] = s * x + c * y;
    }
    a->m[p][q] = a->m[q][p] = 0.0;
}

fe__tensor fe__tensor_diagonalise(fe__tensor *a)
{
    fe__tensor axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    // products of inertia at the rounding of the sums are none: symmetric bodies keep the axes they were built on
    double none = 1e-14 * (a->m[0][0] + a->m[1][1] + a->m[2][2]);
    for (int sweep = 0; sweep < JACOBI_SWEEPS; ++sweep) {
        double off = fe__absd(a->m[0][1]) + fe__absd(a->m[0][2]) + fe__absd(a->m[1][2]);
        if (off <= none) break;
        rotate_plane(a, &axes, 0, 1);
        rotate_plane(a, &axes, 0, 2);
        rotate_plane(a, &axes, 1, 2);
    }
    return axes;
}

// The quaternion of a rotation matrix, from its largest component so that nothing cancels (Shepperd 1978). Jacobi's
// product of rotations is one.
fe_quat fe__tensor_rotation(const fe__tensor *r)
{
    double trace = r->m[0][0] + r->m[1][1] + r->m[2][2], q[4];
    int k = r->m[0][0] > r->m[1][1] ? 0 : 1;
    if (r->m[2][2] > r->m[k][k]) k = 2;
    if (trace >= r->m[k][k]) {
        q[3] = 0.5 * sqrt(1.0 + trace);
        double scale = 0.25 / q[3];
        q[0] = scale * (r->m[2][1] - r->m[1][2]), q[1] = scale * (r->m[0][2] - r->m[2][0]),
        q[2] = scale * (r->m[1][0] - r->m[0][1]);
    } else {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        q[k] = 0.5 * sqrt(1.0 + r->m[k][k] - r->m[i][i] - r->m[j][j]);
        double scale = 0.25 / q[k];
        q[i] = scale * (r->m[i][k] + r->m[k][i]), q[j] = scale * (r->m[j][k] + r->m[k][j]),
        q[3] = scale * (r->m[j][i] - r->m[i][j]);
    }
    return (fe_quat){(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
}
