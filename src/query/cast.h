// cast.h - what a ray or a moving form meets.
//
// Rays and sweeps are one thing: a probe along a segment. A sphere of radius 0 is a point, so it sweeps as a ray, in
// every bit.
#ifndef FE_QUERY_CAST_H
#define FE_QUERY_CAST_H
#include "collision/cast/approach.h"
#include "query/scene.h"

#include <stddef.h>

enum { FE_SORTED_HIT = offsetof(fe_hit, flags) + sizeof(uint32_t) }; // bytes of a hit that its order depends on

typedef struct fe__probe {
    fe__form form;    // with an inside, and bounded; a sphere of radius 0: a ray
    fe__tree_way way; // of its centre, with the half widths of its bounds, of a form that turns those of all its poses
    fe__axes axes;    // at the start; of a ray they mean nothing, nor does the turn
    fe_dvec3 turn;    // rad, until the end of the way; 0 where it does not show
} fe__probe;

void fe__probe_ray(fe__probe *probe, const fe_dvec3 *origin, const fe_dvec3 *translation);
fe__probe fe__probe_form(const fe__form *form, const fe_transform *from, fe_dvec3 translation);
// One that turns on its way by |turn| rad about the turn's direction
fe__probe fe__probe_turning(const fe__form *form, const fe_transform *from, fe_dvec3 translation, fe_vec3 turn);

// Does it overlap the shape where it starts? Exactly when a cast would start inside.
int32_t fe__probe_overlaps(const fe__scene *scene, const fe__probe *probe, const fe__shape *shape);

// Of one shape that the probe overlaps where it starts: a hit at fraction 0. With no translation its normal is the
// shortest way out. 1: it does
int32_t fe__cast_inside(const fe__scene *scene, const fe__probe *probe, int32_t shape, fe_hit *out_hit);

// The nearest; of equally near ones what overlaps at the start, then that of the body created first. 1: hit.
int32_t fe__cast_closest(const fe__scene *scene, const fe__probe *probe, fe_hit *out_hit);
int32_t fe__cast_any(const fe__scene *scene, const fe__probe *probe);
// The nearest hit of each body, the nearest `capacity` of these in order. Returns how many bodies are hit.
int32_t fe__cast_all(const fe__scene *scene, const fe__probe *probe, fe_hit *out_hits, uint32_t stride,
                     int32_t capacity);
// The nearest on the shapes of a body's list from `first` to before `end` (-1: its end), whatever the trees say.
int32_t fe__cast_shapes(const fe__scene *scene, const fe__probe *probe, int32_t first, int32_t end, fe_hit *out_hit);

// ---- nearest point --------------------------------------------------------------------------------------------------
// The point of the world nearest to a point.

// Of all shapes no farther than `most`; of equally near ones that of the body created first. 1: there is one.
int32_t fe__closest(const fe__scene *scene, fe_dvec3 point, double most, fe_closest *out_closest);
// On the shapes of a body's list from `first` to before `end` (-1: its end), however far.
int32_t fe__closest_on_shapes(const fe__scene *scene, fe_dvec3 point, int32_t first, int32_t end,
                              fe_closest *out_closest);

// ---- overlap --------------------------------------------------------------------------------------------------------
// Which bodies a form touches where it is.
//
// Exactly those that a sweep from there would start inside of: it asks the same test. A sphere of radius 0 is a point.

// The bodies in the order of creation, the first `capacity` of them. Returns how many there are.
int32_t fe__overlap(const fe__scene *scene, const fe__probe *probe, fe_body *out_bodies, int32_t capacity);
int32_t fe__overlap_any(const fe__scene *scene, const fe__probe *probe);

// The shapes, in the order of creation, with the shortest way out.
int32_t fe__overlap_shapes(const fe__scene *scene, const fe__probe *probe, fe_overlap *out_overlaps, uint32_t stride,
                           int32_t capacity);
// The shapes whose bounds meet a box.
int32_t fe__overlap_bounds(const fe__scene *scene, const fe__bounds *bounds, fe_shape *out_shapes, int32_t capacity);

#endif
