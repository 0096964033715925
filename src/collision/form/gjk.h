// gjk.h - distance of two cores (Gilbert, Johnson, Keerthi, 1988), in double.
//
// The general convex path (manifold/convex.c), the sweeps and the closest points call it. The cores' difference
// { p - q : p in A, q in B } contains the origin exactly when they overlap, and its point nearest the origin is the
// shortest vector from B to A. It is computed in double, because this path is not hot and serves shapes from 1 mm to
// 100 km.
#ifndef FE_COLLISION_FORM_GJK_H
#define FE_COLLISION_FORM_GJK_H
#include "collision/form/form.h"

// Two forms and B's pose in A's frame; everything below is in that frame. `corners`, a triangle in double, may take the
// place of A.
typedef struct fe__cores {
    const fe__form *a, *b;
    fe_dvec3 position;
    fe_dvec3 axis_x, axis_y, axis_z;
    const fe_dvec3 *corners; // 3, or NULL
} fe__cores;

// A vertex of the difference, and the point of A in it; the point of B is on_a - difference.
typedef struct fe__vertex {
    fe_dvec3 difference, on_a;
} fe__vertex;

// The vertex farthest along `direction`.
fe__vertex fe__cores_support(const fe__cores *cores, fe_dvec3 direction);

// Weighs the vertices of a point, line or triangle (count 1..3) so that their sum is nearest the origin. Vertices
// without weight are removed; returns the count left.
int32_t fe__nearest_in_simplex(fe__vertex *vertex, double *weight, int32_t count);

typedef struct fe__gjk {
    double distance;     // distance of the cores; 0: they overlap
    fe_dvec3 on_a, on_b; // nearest points; they mean nothing if the cores overlap
    fe_dvec3 way;        // on_b - on_a, but free of the rounding of the two points, which matters if it is short
    int32_t overlap;
    int32_t count; // 1..4 vertices: around the nearest point, or around the origin
    fe__vertex vertex[4];
    double size; // length of the largest difference met, m: distances are precise to a share of it
    // The best separating plane that the search met: A lies against `across` of it (any length), B lies `apart_by`
    // beyond it. apart_by 0: no plane parts them
    double apart_by;
    fe_dvec3 across;
} fe__gjk;

// Stops early, with a distance above `limit`, as soon as the cores are known to be farther apart.
void fe__gjk_distance(const fe__cores *cores, double limit, fe__gjk *result);
// The same, but it goes on until apart_by is half the distance or more, even if the cores are farther apart.
void fe__gjk_distance_or_gap(const fe__cores *cores, double limit, fe__gjk *result);
// fe__gjk_distance from a guess: one to three vertices of the difference, which stand in the result. Three must not be
// a sliver.
void fe__gjk_distance_from(const fe__cores *cores, double limit, fe__gjk *result);
// Sweeps stop 1e-7 m apart and need this one. The others call it an overlap from 1e-10 of the cores' size on, where a
// normal is still known to the last digit of a float; this one from 2e-14 of it, 1e-8 m for two forms of 100 km, with a
// normal of fewer digits.
void fe__gjk_distance_closely(const fe__cores *cores, fe__gjk *result);
// fe__gjk_distance_closely from its last result, found when B stood `shift`, m, back. It is for forms with corners
// only.
void fe__gjk_distance_closely_after(const fe__cores *cores, fe_dvec3 shift, fe__gjk *result);

// ---- penetration depth (epa.c) --------------------------------------------------------------------------------------
// The depth of two cores that overlap, by the expanding polytope algorithm (van den Bergen, Proximity queries and
// penetration depth computation on 3D game objects, 2001), in double.
typedef struct fe__penetration {
    fe_dvec3 normal;     // unit: B leaves A soonest along it
    double depth;        // the way on which B leaves A, m, >= 0
    fe_dvec3 on_a, on_b; // the deepest points of the cores; on_a is the farther along the normal
} fe__penetration;

// `overlap` is a result of fe__gjk_distance with overlap set: the polytope grows from its simplex around the origin.
fe__penetration fe__epa_depth(const fe__cores *cores, const fe__gjk *overlap);

#endif
