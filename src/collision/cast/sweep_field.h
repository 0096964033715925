// sweep_field.h - a mover and one triangle after the other of a heightfield or a mesh. The sweeps along it
// (sweep_field.c, turning.c) and the depenetration (sweep_field.c) work with it.
#ifndef FE_COLLISION_CAST_SWEEP_FIELD_H
#define FE_COLLISION_CAST_SWEEP_FIELD_H
#include "collision/cast/approach.h"

typedef struct fe__field_search {
    const fe__ground *surface;
    const fe__mover *mover;
    fe_dvec3 half;     // half widths of the mover's bounds, m
    fe__approach pair; // the mover and each triangle in turn
} fe__field_search;

fe__field_search fe__field_search_of(const fe__ground *surface, const fe__mover *mover);
// Puts the triangle into `pair`; of a two-sided one the side on which the mover starts.
void fe__field_take(fe__field_search *search, int32_t triangle);
// The box that the mover's bounds cover from t0 to t1.
fe__bounds fe__field_covered(const fe__field_search *search, double t0, double t1);
// Finds the part of [0, limit] on which the mover's bounds meet those of the surface; 0: none
int32_t fe__field_clip(const fe__field_search *search, double limit, double *from, double *to);
// How far the mover must move along the triangle's normal to be over its plane, m, >= 0.
double fe__field_depth(const fe__field_search *search);
// Nothing is met from below, but for a rim: from the side it stops any form that has a part above the triangle's plane.
int32_t fe__field_is_met(const fe__field_search *search, int32_t triangle, const fe__approach_hit *hit);

// Depenetration of a mover that overlaps the surface; `hit` holds the deepest triangle. Finds a shorter way out, or one
// that parts the two if that triangle's normal does not.
void fe__field_depenetrate(const fe__field_search *search, fe__sweep_hit *hit);

#endif
