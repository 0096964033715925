// cloud.c - see cloud.h.
#include "collision/hull_build/cloud.h"

// Of the longest side, in steps: 2^25 <= side < 2^26
enum { GRID_BITS = 25 };

// A rise is a sum of three products below 2^53 x 2^26, rounded to 53 bits: its error is below
// 3 x 2^26 + 2 x 2^28 < 2^30
static const double rise_error = 1073741824.0;

// The power of two 2^e with 2^e <= x < 2^(e + 1); x is positive and no denormal
static double power_below(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits &= UINT64_C(0x7ff0000000000000);
    memcpy(&x, &bits, sizeof x);
    return x;
}

void fe__cloud_measure(fe__cloud *cloud)
{
    fe_dvec3 low = fe__cloud_point(cloud, 0), high = low;
    for (int32_t i = 1; i < cloud->count; ++i) {
        fe_dvec3 p = fe__cloud_point(cloud, i);
        low = (fe_dvec3){fe__mind(low.x, p.x), fe__mind(low.y, p.y), fe__mind(low.z, p.z)};
        high = (fe_dvec3){fe__maxd(high.x, p.x), fe__maxd(high.y, p.y), fe__maxd(high.z, p.z)};
    }
    fe_dvec3 sides = fe__dsub(high, low);
    cloud->low = low, cloud->high = high;
    cloud->middle = fe__dscale(0.5, fe__dadd(low, high));
    cloud->extent = fe__maxd(sides.x, fe__maxd(sides.y, sides.z));
    cloud->step = power_below(cloud->extent) / (double)(1 << GRID_BITS);
}

static double nearest_integer(double x) { return (double)(int64_t)(x + __builtin_copysign(0.5, x)); }

void fe__cloud_snap(fe__cloud *cloud)
{
    double per_step = 1.0 / cloud->step;
    for (int32_t i = 0; i < cloud->count; ++i) {
        fe_dvec3 p = fe__dscale(per_step, fe__dsub(fe__cloud_point(cloud, i), cloud->middle));
        cloud->grid[i] = (fe_dvec3){nearest_integer(p.x), nearest_integer(p.y), nearest_integer(p.z)};
    }
}

int32_t fe__grid_plane_through(fe_dvec3 a, fe_dvec3 b, fe_dvec3 c, fe__grid_plane *out_plane)
{
    fe_dvec3 n = fe__dcross(fe__dsub(b, a), fe__dsub(c, a)); // exact
    double square = fe__ddot(n, n), per_length = square > 0.0 ? 1.0 / sqrt(square) : 0.0;
    fe_dvec3 unit = fe__dscale(per_length, n);
    *out_plane = (fe__grid_plane){a, n, per_length, unit, fe__ddot(unit, a)};
    return square > 0.0;
}

// The same sum in integers. A normal's coordinate n = 2^27 h + l, 0 <= l < 2^27, keeps each half of the sum below 2^56.
static int32_t exact_side(const fe__grid_plane *plane, fe_dvec3 p)
{
    enum { HALF_BITS = 27 };
    const int64_t half = (int64_t)1 << HALF_BITS;
    fe_dvec3 d = fe__dsub(p, plane->base);
    const int64_t n[3] = {(int64_t)plane->normal.x, (int64_t)plane->normal.y, (int64_t)plane->normal.z},
                  along[3] = {(int64_t)d.x, (int64_t)d.y, (int64_t)d.z};
    int64_t high = 0, low = 0;
    for (int k = 0; k < 3; ++k) {
        int64_t l = ((n[k] % half) + half) % half;
        high += (n[k] - l) / half * along[k];
        low += l * along[k];
    }
    int64_t rest = ((low % half) + half) % half;
    high += (low - rest) / half;
    if (high != 0) return high > 0 ? 1 : -1;
    return rest > 0;
}

int32_t fe__grid_side(const fe__grid_plane *plane, fe_dvec3 p)
{
    double rise = fe__grid_rise(plane, p);
    if (rise > rise_error) return 1;
    if (rise < -rise_error) return -1;
    return exact_side(plane, p);
}
