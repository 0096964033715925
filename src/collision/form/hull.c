// hull.c - where a hull ends, in a direction, in the world, and along a ray. See hull.h.
#include "collision/form/hull.h"

#include "core/lanes.h"

// ---- pairs of lanes, in double -------------------------------------------------------------------------------------
typedef struct pairs {
    fe__pair x, y, z;
} pairs;

static inline pairs low_of(const fe__quad *x, const fe__quad *y, const fe__quad *z)
{
    return (pairs){fe__pair_low(*x), fe__pair_low(*y), fe__pair_low(*z)};
}
static inline pairs high_of(const fe__quad *x, const fe__quad *y, const fe__quad *z)
{
    return (pairs){fe__pair_high(*x), fe__pair_high(*y), fe__pair_high(*z)};
}

// The first of the farthest among every other pair of lanes, and how far
typedef struct farthest {
    fe__pair along, lane;
} farthest;

static inline farthest farther(farthest f, pairs p, fe__pair lane, fe_dvec3 direction)
{
    fe__pair along = p.x * direction.x + p.y * direction.y + p.z * direction.z; // as fe__ddot
    fe__pair_int more = along > f.along;
    return (farthest){fe__pair_choose(more, along, f.along), fe__pair_choose(more, lane, f.lane)};
}

// Four lanes at a time; those past the count repeat the first and never win against it
static int32_t farthest_lane(const fe__hull_lanes *lanes, int32_t count, fe_dvec3 direction)
{
    const double none = -(double)INFINITY;
    const fe__quad *x = (const fe__quad *)lanes->x, *y = (const fe__quad *)lanes->y, *z = (const fe__quad *)lanes->z;
    farthest a = {{none, none}, {0.0, 0.0}}, b = a;
    fe__pair lane = {0.0, 1.0};
    for (int32_t i = 0; i < count; i += 4, ++x, ++y, ++z, lane += 4.0) {
        a = farther(a, low_of(x, y, z), lane, direction);
        b = farther(b, high_of(x, y, z), lane + 2.0, direction);
    }
    fe__pair_int more = (b.along > a.along) | ((b.along == a.along) & (b.lane < a.lane));
    a = (farthest){fe__pair_choose(more, b.along, a.along), fe__pair_choose(more, b.lane, a.lane)};
    int32_t second = a.along[1] > a.along[0] || (a.along[1] == a.along[0] && a.lane[1] < a.lane[0]);
    return (int32_t)a.lane[second];
}

int32_t fe__hull_support(const fe__hull *hull, fe_dvec3 direction)
{
    return farthest_lane(&hull->vertices, hull->vertex_count, direction);
}

int32_t fe__hull_facing(const fe__hull *hull, fe_dvec3 direction)
{
    return farthest_lane(&hull->normals, hull->face_count, direction);
}

float fe__hull_reach(const fe__hull *hull, fe_vec3 centre)
{
    double most = 0.0;
    for (int32_t i = 0; i < hull->vertex_count; ++i) {
        fe_dvec3 d = fe__dsub(fe__widen(fe__hull_vertex(hull, i)), fe__widen(centre));
        most = fe__maxd(most, fe__ddot(d, d));
    }
    return (float)sqrt(most);
}

// As fe__drotate: a + k w t + k u x t, t = u x a
static inline pairs cross(fe_dvec3 u, pairs a)
{
    return (pairs){u.y * a.z - u.z * a.y, u.z * a.x - u.x * a.z, u.x * a.y - u.y * a.x};
}

static inline fe__pair least(fe__pair a, fe__pair b) { return fe__pair_choose(a < b, a, b); }
static inline fe__pair most(fe__pair a, fe__pair b) { return fe__pair_choose(a > b, a, b); }
static double least_of(fe__pair a) { return fe__mind(a[0], a[1]); }
static double most_of(fe__pair a) { return fe__maxd(a[0], a[1]); }

typedef struct span {
    pairs low, high;
} span;

static inline span grown(span s, fe_dvec3 u, double kw, double k, pairs a)
{
    pairs t = cross(u, a), ut = cross(u, t);
    pairs p = {a.x + kw * t.x + k * ut.x, a.y + kw * t.y + k * ut.y, a.z + kw * t.z + k * ut.z};
    return (span){{least(s.low.x, p.x), least(s.low.y, p.y), least(s.low.z, p.z)},
                  {most(s.high.x, p.x), most(s.high.y, p.y), most(s.high.z, p.z)}};
}

fe__bounds fe__hull_bounds(const fe__hull *hull, const fe__pose *pose)
{
    const double far = (double)INFINITY;
    const fe__hull_lanes *v = &hull->vertices;
    const fe__quad *x = (const fe__quad *)v->x, *y = (const fe__quad *)v->y, *z = (const fe__quad *)v->z;
    fe_dvec3 u = {(double)pose->rotation.x, (double)pose->rotation.y, (double)pose->rotation.z};
    double w = (double)pose->rotation.w, k = 2.0 / (fe__ddot(u, u) + w * w), kw = k * w;
    span s = {{{far, far}, {far, far}, {far, far}}, {{-far, -far}, {-far, -far}, {-far, -far}}};
    for (int32_t i = 0; i < hull->vertex_count; i += 4, ++x, ++y, ++z) {
        s = grown(s, u, kw, k, low_of(x, y, z));
        s = grown(s, u, kw, k, high_of(x, y, z));
    }
    return (fe__bounds){
        fe__dadd(pose->position, (fe_dvec3){least_of(s.low.x), least_of(s.low.y), least_of(s.low.z)}),
        fe__dadd(pose->position, (fe_dvec3){most_of(s.high.x), most_of(s.high.y), most_of(s.high.z)}),
    };
}

// ---- rays ----------------------------------------------------------------------------------------------------------
// Height over a plane at t: height + t * rate. The ray is inside from the last plane that it comes in through to the
// first that it goes out through (Cyrus and Beck 1978).
typedef struct crossing {
    double enter, leave;   // of t
    double highest;        // over any plane, at the start
    int32_t face, nearest; // that it enters through, -1: none; that the start is highest over
} crossing;

static crossing cross_planes(const fe__hull *hull, fe_dvec3 origin, fe_dvec3 translation)
{
    crossing c = {0.0, (double)INFINITY, -(double)INFINITY, -1, 0};
    for (int32_t i = 0; i < hull->face_count; ++i) {
        fe_dvec3 n = fe__widen(fe__hull_normal(hull, i));
        double height = fe__ddot(n, origin) - (double)hull->distances[i], rate = fe__ddot(n, translation);
        if (height > c.highest) {
            c.highest = height;
            c.nearest = i;
        }
        if (rate == 0.0) {
            if (height > 0.0) c.leave = -1.0;
        } else if (rate > 0.0) {
            c.leave = fe__mind(c.leave, -height / rate);
        } else if (height > 0.0 && (c.face < 0 || -height / rate > c.enter)) {
            c.enter = -height / rate;
            c.face = i;
        }
    }
    return c;
}

static fe_dvec3 against(fe_dvec3 translation, fe_dvec3 way_out)
{
    double most = fe__maxd(fe__absd(translation.x), fe__maxd(fe__absd(translation.y), fe__absd(translation.z)));
    if (most == 0.0) return way_out;
    fe_dvec3 d = {translation.x / most, translation.y / most, translation.z / most};
    return fe__dscale(-1.0 / sqrt(fe__ddot(d, d)), d);
}

int32_t fe__hull_ray(const fe__hull *hull, fe_dvec3 origin, fe_dvec3 translation, double limit, fe__ray_hit *hit)
{
    crossing c = cross_planes(hull, origin, translation);
    if (c.highest <= 0.0) {
        fe_dvec3 normal = against(translation, fe__hull_unit_normal(hull, c.nearest));
        *hit = (fe__ray_hit){.normal = normal, .depth = -c.highest, .inside = 1, .triangle = c.nearest};
        return 1;
    }
    if (c.face < 0 || c.enter > c.leave || c.enter > limit) return 0;
    *hit = (fe__ray_hit){.t = c.enter, .normal = fe__hull_unit_normal(hull, c.face), .triangle = c.face};
    return 1;
}
