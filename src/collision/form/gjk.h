// gjk.h - distance of two cores (Gilbert, Johnson, Keerthi, 1988), in double.
//
// Used by the general convex path. The two cores' difference { p - q : p in A, q in B } contains the origin exactly
// when they overlap, and its point nearest the origin is the shortest vector from B to A. Double, because this path is
// not hot and serves shapes from 1 mm to 100 km.
#ifndef FE_COLLISION_FORM_GJK_H
#define FE_COLLISION_FORM_GJK_H
#include "collision/form/form.h"

// Two forms and B's pose in A's frame, in which all below is given. `corners` may take the place of A: a triangle in
// double.
typedef struct fe__cores {
    const fe__form *a, *b;
    fe_dvec3 position;
    fe_dvec3 axis_x, axis_y, axis_z;
    const fe_dvec3 *corners; // 3, or NULL
} fe__cores;

// A vertex of the difference, and A's part in it: B's is on_a - difference.
typedef struct fe__vertex {
    fe_dvec3 difference, on_a;
} fe__vertex;

// The vertex farthest along `direction`.
fe__vertex fe__cores_support(const fe__cores *cores, fe_dvec3 direction);

// Weights of the vertices of a point, line or triangle (count 1..3) whose sum is nearest the origin. Vertices without
// weight are removed; returns the count left.
int32_t fe__nearest_in_simplex(fe__vertex *vertex, double *weight, int32_t count);

typedef struct fe__gjk {
    double distance;     // of the cores; 0 when they overlap
    fe_dvec3 on_a, on_b; // nearest points; when they overlap, of no meaning
    fe_dvec3 way;        // on_b - on_a, without what rounding of the points makes of a short one
    int32_t overlap;
    int32_t count; // 1..4 vertices: around the nearest point, or around the origin
    fe__vertex vertex[4];
    double size; // of the largest difference met, m: what distances are precise against
    // the best of the planes met: A lies against `across` of it, B `apart_by` beyond; 0 where none parts them
    double apart_by;
    fe_dvec3 across; // of any length
} fe__gjk;

// Stops early, with a distance above `limit`, as soon as they are known to be farther apart.
void fe__gjk_distance(const fe__cores *cores, double limit, fe__gjk *result);
// The same, but of what is farther apart a plane is found that has half the distance, or more, between the two.
void fe__gjk_distance_or_gap(const fe__cores *cores, double limit, fe__gjk *result);
// The same from a guess: one to three vertices of the difference, which the result has already. Three are no sliver.
void fe__gjk_distance_from(const fe__cores *cores, double limit, fe__gjk *result);
// Cores overlap from 1e-10 of their size on, where a normal is known to the last digit of a float. This one tells 2e-14
// of it, 1e-8 m of two forms of 100 km, with a normal of fewer digits: for sweeps, which stop 1e-7 m apart.
void fe__gjk_distance_closely(const fe__cores *cores, fe__gjk *result);
// The same from what it found when the second stood elsewhere, `shift` m back. Of forms with corners alone.
void fe__gjk_distance_closely_after(const fe__cores *cores, fe_dvec3 shift, fe__gjk *result);

// ---- epa ------------------------------------------------------------------------------------------------------------
// Depth of two cores that overlap (van den Bergen, Proximity queries and penetration depth computation, 2001),
// in double.
//
// Goes on from the simplex around the origin with which GJK ended.

typedef struct fe__penetration {
    fe_dvec3 normal;     // unit: B leaves A soonest along it
    double depth;        // by so much, m, >= 0
    fe_dvec3 on_a, on_b; // the deepest points of the cores; on_a is the farther along the normal
} fe__penetration;

// `overlap` is a result of fe__gjk_distance with overlap set.
fe__penetration fe__epa_depth(const fe__cores *cores, const fe__gjk *overlap);

#endif
