// sweep_field.h - what the sweeps along a heightfield or a mesh (sweep_field.c, turning.c) and the way out of
// one (sweep_field.c) share: a mover, and one triangle after the other.
#ifndef FE_COLLISION_CAST_SWEEP_FIELD_H
#define FE_COLLISION_CAST_SWEEP_FIELD_H
#include "collision/cast/approach.h"

typedef struct fe__field_search {
    const fe__ground *surface;
    const fe__mover *mover;
    fe_dvec3 half;     // of the mover's bounds, m
    fe__approach pair; // with each triangle in turn
} fe__field_search;

fe__field_search fe__field_search_of(const fe__ground *surface, const fe__mover *mover);
// The triangle comes into `pair`; of a two-sided one the side on which the mover starts.
void fe__field_take(fe__field_search *search, int32_t triangle);
// What the mover's bounds cover from t0 to t1
fe__bounds fe__field_covered(const fe__field_search *search, double t0, double t1);
// The part of [0, limit] on which the mover's bounds meet those of the surface; 0: none
int32_t fe__field_clip(const fe__field_search *search, double limit, double *from, double *to);
// How far out along the triangle's normal the mover is over its plane, m, >= 0
double fe__field_depth(const fe__field_search *search);
// From below nothing is met, but for a rim, which stops from aside whatever has a part above the triangle's plane.
int32_t fe__field_is_met(const fe__field_search *search, int32_t triangle, const fe__approach_hit *hit);

// For a mover that overlaps the surface, `hit` telling the deepest triangle: a shorter way out, or one that parts the
// two where that triangle's normal does not (sweep_field.c)
void fe__field_way_out(const fe__field_search *search, fe__sweep_hit *hit);

#endif
