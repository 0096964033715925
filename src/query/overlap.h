// overlap.h - which bodies a form touches where it is.
//
// Exactly those that a sweep from there would start inside of: it asks the same test. A sphere of radius 0 is a point.
#ifndef FE_QUERY_OVERLAP_H
#define FE_QUERY_OVERLAP_H
#include "query/cast.h"

// The bodies in the order of creation, the first `capacity` of them. Returns how many there are.
int32_t fe__overlap(const fe__scene *scene, const fe__probe *probe, fe_body *out_bodies, int32_t capacity);
int32_t fe__overlap_any(const fe__scene *scene, const fe__probe *probe);

// The shapes, in the order of creation, with the shortest way out.
int32_t fe__overlap_shapes(const fe__scene *scene, const fe__probe *probe, fe_overlap *out_overlaps, uint32_t stride,
                           int32_t capacity);
// The shapes whose bounds meet a box.
int32_t fe__overlap_bounds(const fe__scene *scene, const fe__bounds *bounds, fe_shape *out_shapes, int32_t capacity);

#endif
