// nearest_hull.c - the point of a convex hull nearest to a point.
//
// From outside it lies on a face whose plane the point is above: over the face itself, or on a side that the point is
// beyond.
#include "collision/cast/nearest.h"

static fe_dvec3 vertex_of(const fe__hull *hull, int32_t corner)
{
    return fe__widen(fe__hull_vertex(hull, hull->corners[corner]));
}

static fe_dvec3 on_segment(fe_dvec3 a, fe_dvec3 b, fe_dvec3 point)
{
    fe_dvec3 way = fe__dsub(b, a);
    double t = fe__ddot(fe__dsub(point, a), way) / fe__ddot(way, way);
    return fe__dadd(a, fe__dscale(fe__clampd(t, 0.0, 1.0), way));
}

static double square_of(fe_dvec3 a) { return fe__ddot(a, a); }

// Normals have the length 1 up to the rounding of floats. Of a face whose plane is `height` below the point
static fe_dvec3 on_face(const fe__hull *hull, int32_t face, fe_dvec3 point, double height)
{
    fe_dvec3 normal = fe__widen(fe__hull_normal(hull, face)),
             best = fe__dsub(point, fe__dscale(height / fe__ddot(normal, normal), normal));
    double least = (double)INFINITY;
    int32_t first = hull->faces[face].first, count = hull->faces[face].count;
    for (int32_t k = 0; k < count; ++k) {
        fe_dvec3 a = vertex_of(hull, first + k), b = vertex_of(hull, first + (k + 1 < count ? k + 1 : 0));
        fe_dvec3 out = fe__dcross(fe__dsub(b, a), normal);
        if (fe__ddot(fe__dsub(point, a), out) <= 0.0) continue;
        fe_dvec3 q = on_segment(a, b, point);
        double square = square_of(fe__dsub(point, q));
        if (square >= least) continue;
        least = square;
        best = q;
    }
    return best;
}

static fe__nearest from_inside(const fe__hull *hull, fe_dvec3 point, int32_t face, double height)
{
    fe_dvec3 normal = fe__hull_unit_normal(hull, face);
    double distance = height * fe__ddot(normal, fe__widen(fe__hull_normal(hull, face)));
    return (fe__nearest){distance, normal, fe__dsub(point, fe__dscale(distance, normal)), face, -1};
}

fe__nearest fe__hull_nearest(const fe__hull *hull, fe_dvec3 point)
{
    fe__nearest nearest = {.triangle = -1};
    double least = (double)INFINITY, highest = -(double)INFINITY;
    int32_t shallow = 0;
    for (int32_t i = 0; i < hull->face_count; ++i) {
        double height = fe__ddot(fe__widen(fe__hull_normal(hull, i)), point) - (double)hull->distances[i];
        if (height > highest) {
            highest = height;
            shallow = i;
        }
        if (height <= 0.0) continue;
        fe_dvec3 q = on_face(hull, i, point, height);
        double square = square_of(fe__dsub(point, q));
        if (square >= least) continue;
        least = square;
        nearest.point = q;
        nearest.triangle = i;
    }
    nearest.distance = sqrt(least);
    if (highest <= 0.0 || nearest.distance == 0.0) return from_inside(hull, point, shallow, highest);
    nearest.normal = fe__dscale(1.0 / nearest.distance, fe__dsub(point, nearest.point));
    return nearest;
}
