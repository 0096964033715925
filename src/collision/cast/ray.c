// ray.c - where a ray meets a form: closed forms in double, in the form's frame.
//
// Input: the query's ray, turned into the frame of a shape. Read by queries and by what stops fast bodies. A form is a
// closed set: a start on its surface is a start inside, of depth 0. The round forms first move the start to the point
// nearest to their centre, where nothing cancels, and take the root there; so a small sphere is met from 10 km away as
// exactly as the start is known (about 1e-12 m). Every finite input gives an answer without NaN: lengths of translation
// and start are brought into the range in which squares neither overflow nor vanish.
#include "collision/cast/ray.h"

#include "collision/cast/kinds.h"

#include <math.h>

// Squares and products of lengths between these limits are finite, normal numbers. Beyond them, lengths are scaled by a
// power of two, which is exact, and brings the whole range of double (5e-324 to 1.8e308) to within 1e-114 and 1e98.
static const double shortest = 1e-100, longest = 1e100;
static const double scale_up = 0x1p700, scale_down = 0x1p-700;

static double largest(fe_dvec3 a) { return fe__maxd(fe__maxd(fe__absd(a.x), fe__absd(a.y)), fe__absd(a.z)); }
static double length(fe_dvec3 a) { return sqrt(fe__ddot(a, a)); }
static double scale_for(double size) { return size > longest ? scale_down : size < shortest ? scale_up : 1.0; }

// ---- hits ----------------------------------------------------------------------------------------------------------
// Field by field: hits are read at once, and what was written in pieces is not copied whole without a wait.
static int32_t report(fe__ray_hit *hit, double t, fe_dvec3 normal, double depth, int32_t inside)
{
    hit->t = t, hit->depth = depth, hit->inside = inside, hit->triangle = hit->index = -1;
    hit->normal.x = normal.x, hit->normal.y = normal.y, hit->normal.z = normal.z;
    return 1;
}

// A start inside: the normal is against the direction, or the shortest way out when there is none.
static int32_t start_inside(const fe__scaled_ray *r, double depth, fe_dvec3 way_out, fe__ray_hit *hit)
{
    double speed = length(r->direction);
    fe_dvec3 normal = speed > 0.0 ? fe__dscale(-1.0 / speed, r->direction) : way_out;
    return report(hit, 0.0, normal, fe__maxd(depth, 0.0), 1);
}

// A hit from outside at s. That s is positive is known; a rounding below 0 is none.
static int32_t meet(const fe__scaled_ray *r, double s, fe_dvec3 normal, fe__ray_hit *hit)
{
    double t = fe__maxd(s, 0.0) * r->per_s;
    if (!(t <= r->limit)) return 0;
    return report(hit, t, normal, 0.0, 0);
}

// ---- round surfaces ------------------------------------------------------------------------------------------------
typedef struct entry {
    double s;
    fe_dvec3 normal; // unit
} entry;

// Where the line o + s d enters the ball of a radius about 0, or, for o and d without y, the cylinder about the y axis.
//   s0 = -o.d / d.d,  p = o + s0 d  (nearest point),  h = sqrt(r^2 - p^2)  (half chord),  s = s0 - h / |d|,  normal =
//   (p - h d / |d|) / r
static int32_t enter_round(fe_dvec3 o, fe_dvec3 d, double radius, entry *out)
{
    double k = largest(o) > longest ? scale_down : 1.0, speed = length(d);
    double nearest = -(fe__ddot(fe__dscale(k, o), d) / (speed * speed)) / k;
    if (!(fe__absd(nearest) < (double)INFINITY)) return 0; // farther than any limit
    fe_dvec3 p = fe__dadd(o, fe__dscale(nearest, d));
    if (!(largest(p) <= radius)) return 0;
    double hh = radius * radius - fe__ddot(p, p);
    if (hh < 0.0) return 0;
    double h = sqrt(hh);
    fe_dvec3 n = fe__dsub(p, fe__dscale(h / speed, d));
    *out = (entry){nearest - h / speed, fe__dscale(1.0 / length(n), n)};
    return 1;
}

// The ball of a radius about `centre`, met from outside.
static int32_t meet_ball(const fe__scaled_ray *r, fe_dvec3 centre, double radius, fe__ray_hit *hit)
{
    entry e;
    fe_dvec3 o = fe__dsub(r->origin, centre);
    if (fe__ddot(fe__dscale(scale_for(largest(o)), o), r->direction) >= 0.0) return 0; // not coming nearer
    return enter_round(o, r->direction, radius, &e) && meet(r, e.s, e.normal, hit);
}

// Depth below the surface of a point `away` from the core of a radius; below 0 outside. `way_out` is `flat` where the
// point is on the core.
static double depth_in_round(fe_dvec3 away, double radius, fe_dvec3 flat, fe_dvec3 *way_out)
{
    if (largest(away) > radius) return -1.0;
    double k = scale_for(largest(away));
    fe_dvec3 scaled = fe__dscale(k, away);
    double distance = length(scaled);
    *way_out = distance > 0.0 ? fe__dscale(1.0 / distance, scaled) : flat;
    return radius - distance / k;
}

int32_t fe__ray_sphere(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    double radius = (double)form->radius;
    fe_dvec3 way_out = {0.0, 0.0, 0.0}, up = {0.0, 1.0, 0.0};
    double depth = depth_in_round(r->origin, radius, up, &way_out);
    if (depth >= 0.0) return start_inside(r, depth, way_out, hit);
    return meet_ball(r, (fe_dvec3){0.0, 0.0, 0.0}, radius, hit);
}

// The capsule lies in the infinite cylinder about its axis. A ray enters that first, or starts in it: between the ends
// of the axis that is the hit, beyond an end only the ball about that end can be.
int32_t fe__ray_capsule(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    double radius = (double)form->radius, half = (double)form->half_height;
    fe_dvec3 o = r->origin, d = r->direction, way_out = {0.0, 0.0, 0.0}, aside = {1.0, 0.0, 0.0};
    double on_axis = fe__maxd(fe__mind(o.y, half), -half);
    double depth = depth_in_round((fe_dvec3){o.x, o.y - on_axis, o.z}, radius, aside, &way_out);
    if (depth >= 0.0) return start_inside(r, depth, way_out, hit);

    fe_dvec3 across = {o.x, 0.0, o.z}, drift = {d.x, 0.0, d.z}, unused;
    double y = o.y;
    if (depth_in_round(across, radius, aside, &unused) < 0.0) {
        entry e;
        if (fe__ddot(fe__dscale(scale_for(largest(across)), across), drift) >= 0.0)
            return 0; // parallel to the axis, or away from it
        if (!enter_round(across, drift, radius, &e)) return 0;
        y = o.y + fe__maxd(e.s, 0.0) * d.y;
        if (fe__absd(y) <= half) return meet(r, e.s, e.normal, hit);
    }
    return meet_ball(r, (fe_dvec3){0.0, y > 0.0 ? half : -half, 0.0}, radius, hit);
}

// ---- flat surfaces -------------------------------------------------------------------------------------------------
static fe_dvec3 axis_normal(int32_t axis, double sign)
{
    return (fe_dvec3){axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0, axis == 2 ? sign : 0.0};
}

static int32_t inside_box(const fe__scaled_ray *r, const double o[3], const double half[3], fe__ray_hit *hit)
{
    double depth = half[0] - fe__absd(o[0]);
    int32_t axis = 0;
    for (int32_t k = 1; k < 3; ++k) {
        double below = half[k] - fe__absd(o[k]);
        if (below < depth) {
            depth = below;
            axis = k;
        }
    }
    return start_inside(r, depth, axis_normal(axis, o[axis] < 0.0 ? -1.0 : 1.0), hit);
}

// One slab: the ray is in it from the first to the second. Along it, 0 / 0 is met on its sides only, and a NaN counts
// for no bound below. Two quotients take no longer than one.
typedef double two __attribute__((vector_size(16)));
static inline two cross_slab(double o, double d, double half)
{
    double far_side = __builtin_copysign(half, d);
    return ((two){-far_side, far_side} - (two){o, o}) / (two){d, d};
}

// -1 or 1, against d, or 0 when it is not this side
static inline double against(double d, int32_t is_side)
{
    union {
        double value;
        uint64_t bits;
    } one = {__builtin_copysign(1.0, -d)};
    one.bits &= -(uint64_t)is_side;
    return one.value;
}

static int32_t is_in_box(fe_dvec3 o, const double half[3])
{
    return fe__absd(o.x) <= half[0] && fe__absd(o.y) <= half[1] && fe__absd(o.z) <= half[2];
}

// Three slabs (Kay and Kajiya 1986): the ray is in the box from the last entry to the first exit. On an edge the lowest
// axis gives the normal. The signs of the direction, the order of the entries and which side is missed are random:
// nothing branches on them. From inside, no slab is entered later than at 0 or left before.
int32_t fe__ray_box(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    const double half[3] = {(double)form->half.x, (double)form->half.y, (double)form->half.z};
    const fe_dvec3 o = r->origin, d = r->direction;
    const two x = cross_slab(o.x, d.x, half[0]), y = cross_slab(o.y, d.y, half[1]), z = cross_slab(o.z, d.z, half[2]);
    const double none = (double)INFINITY;
    double enter = fe__maxd(z[0], fe__maxd(y[0], fe__maxd(x[0], -none))),
           leave = fe__mind(z[1], fe__mind(y[1], fe__mind(x[1], none)));
    if ((enter > leave) | (leave < 0.0) | !(fe__maxd(enter, 0.0) * r->per_s <= r->limit)) return 0;
    if (enter <= 0.0 && is_in_box(o, half)) return inside_box(r, (const double[3]){o.x, o.y, o.z}, half, hit);
    const int32_t is_x = x[0] >= enter, is_y = (y[0] >= enter) & ~is_x, is_z = 1 & ~(is_x | is_y);
    return meet(r, enter, (fe_dvec3){against(d.x, is_x), against(d.y, is_y), against(d.z, is_z)}, hit);
}

// The distance n.o - distance falls at the rate n.d. A quarter of both: the sum of three products of finite numbers is
// finite.
int32_t fe__ray_plane(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    const double quarter = 0.25;
    fe_dvec3 n = fe__widen(form->normal);
    double n_length = length(n); // 1 up to the rounding of floats
    fe_dvec3 unit = fe__dscale(1.0 / n_length, n);
    double above = fe__ddot(n, fe__dscale(quarter, r->origin)) - quarter * (double)form->distance;
    if (above <= 0.0) return start_inside(r, -above / (quarter * n_length), unit, hit);
    double rate = fe__ddot(n, fe__dscale(quarter, r->direction));
    return rate < 0.0 && meet(r, above / -rate, unit, hit);
}

// From the side around which the vertices turn left:  n = e1 x e2,  t = n.(o - v0) / -n.d,  and the point is left of
// every side.
int32_t fe__ray_triangle(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    const fe_dvec3 v[3] = {fe__widen(form->vertex[0]), fe__widen(form->vertex[1]), fe__widen(form->vertex[2])};
    fe_dvec3 n = fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0]));
    double above = fe__ddot(n, fe__dsub(r->origin, v[0])), rate = fe__ddot(n, r->direction);
    if (!(above >= 0.0 && rate < 0.0)) return 0;
    double s = above / -rate;
    if (!(s * r->per_s <= r->limit)) return 0;
    fe_dvec3 p = fe__dadd(r->origin, fe__dscale(s, r->direction));
    for (int32_t i = 0; i < 3; ++i) {
        fe_dvec3 side = fe__dsub(v[(i + 1) % 3], v[i]);
        if (!(fe__ddot(n, fe__dcross(side, fe__dsub(p, v[i]))) >= 0.0)) return 0;
    }
    return meet(r, s, fe__dscale(1.0 / length(n), n), hit);
}

int32_t fe__form_ray_at(const fe__form *form, const fe_dvec3 *origin, const fe_dvec3 *translation, double limit,
                        fe__ray_hit *hit)
{
    double scale = scale_for(largest(*translation));
    fe__scaled_ray r = {{origin->x, origin->y, origin->z},
                        fe__dscale(scale, *translation),
                        scale,
                        limit}; // each number alone: see report
    return fe__casts[form->type].ray(form, &r, hit);
}
