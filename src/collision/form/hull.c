// hull.c - where a hull ends, in a direction, in the world, and along a ray. See hull.h.
#include "collision/form/hull.h"

static int32_t farthest_lane(const fe__hull_lanes *lanes, int32_t count, fe_dvec3 direction)
{
    int32_t best = 0;
    double farthest = fe__ddot(fe__widen(fe__hull_lane(lanes, 0)), direction);
    for (int32_t i = 1; i < count; ++i) {
        double distance = fe__ddot(fe__widen(fe__hull_lane(lanes, i)), direction);
        if (distance <= farthest) continue;
        farthest = distance;
        best = i;
    }
    return best;
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

fe__bounds fe__hull_bounds(const fe__hull *hull, const fe__pose *pose)
{
    const double far = (double)INFINITY;
    fe__bounds b = {{far, far, far}, {-far, -far, -far}};
    for (int32_t i = 0; i < hull->vertex_count; ++i) {
        fe_dvec3 p = fe__drotate(pose->rotation, fe__widen(fe__hull_vertex(hull, i)));
        b.low = (fe_dvec3){fe__mind(b.low.x, p.x), fe__mind(b.low.y, p.y), fe__mind(b.low.z, p.z)};
        b.high = (fe_dvec3){fe__maxd(b.high.x, p.x), fe__maxd(b.high.y, p.y), fe__maxd(b.high.z, p.z)};
    }
    return (fe__bounds){fe__dadd(pose->position, b.low), fe__dadd(pose->position, b.high)};
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
