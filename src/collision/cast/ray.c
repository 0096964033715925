// ray.c - a ray against a form, and the point of a cylinder or a cone nearest to a point: closed forms in double, in
// the form's frame (cast_kinds.h).
//
// A form is a closed set: a start on its surface is a start inside, of depth 0. The round forms first move the start to
// the ray's point nearest to their centre, where nothing cancels, and take the root there; so a small sphere is met
// from 10 km away as exactly as the start is known (about 1e-12 m). Every finite input gives an answer without NaN:
// lengths of translation and start are brought into the range in which squares neither overflow nor vanish.
#include "collision/cast/cast_kinds.h"

#include "collision/cast/mesh_ray.h"

#include <math.h>

// Squares and products of lengths between these limits are finite, normal numbers. Beyond them, lengths are scaled by a
// power of two, which is exact, and brings the whole range of double (5e-324 to 1.8e308) to within 1e-114 and 1e98.
static const double shortest = 1e-100, longest = 1e100;
static const double scale_up = 0x1p700, scale_down = 0x1p-700;

static double largest(fe_dvec3 a) { return fe__maxd(fe__maxd(fe__absd(a.x), fe__absd(a.y)), fe__absd(a.z)); }
static double length(fe_dvec3 a) { return sqrt(fe__ddot(a, a)); }
static double scale_for(double size) { return size > longest ? scale_down : size < shortest ? scale_up : 1.0; }

// ---- hits ----------------------------------------------------------------------------------------------------------
// The fields are written one by one: they are read at once, and a copy of the whole would wait for pieces that were
// just written.
static int32_t report(fe__ray_hit *hit, double t, fe_dvec3 normal, double depth, int32_t inside)
{
    hit->t = t, hit->depth = depth, hit->inside = inside, hit->triangle = hit->index = -1;
    hit->normal.x = normal.x, hit->normal.y = normal.y, hit->normal.z = normal.z;
    return 1;
}

// The ray begins inside: the normal is against its direction or, if it has none, the shortest way out.
static int32_t start_inside(const fe__scaled_ray *r, double depth, fe_dvec3 way_out, fe__ray_hit *hit)
{
    double speed = length(r->direction);
    fe_dvec3 normal = speed > 0.0 ? fe__dscale(-1.0 / speed, r->direction) : way_out;
    return report(hit, 0.0, normal, fe__maxd(depth, 0.0), 1);
}

// A hit from outside at s, which is positive but for rounding.
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

// The entry of the line o + s d into the ball of a radius about 0 or, for o and d without y, into the cylinder about
// the y axis.
//   s0 = -o.d / d.d,  p = o + s0 d  (nearest point),  h = sqrt(r^2 - p^2)  (half chord),
//   s = s0 - h / |d|,  normal = (p - h d / |d|) / r
static int32_t enter_round(fe_dvec3 o, fe_dvec3 d, double radius, entry *out)
{
    double k = largest(o) > longest ? scale_down : 1.0, speed = length(d);
    double nearest = -(fe__ddot(fe__dscale(k, o), d) / (speed * speed)) / k;
    if (!(fe__absd(nearest) < (double)INFINITY)) return 0; // It is farther than any limit.
    fe_dvec3 p = fe__dadd(o, fe__dscale(nearest, d));
    if (!(largest(p) <= radius)) return 0;
    double hh = radius * radius - fe__ddot(p, p);
    if (hh < 0.0) return 0;
    double h = sqrt(hh);
    fe_dvec3 n = fe__dsub(p, fe__dscale(h / speed, d));
    *out = (entry){nearest - h / speed, fe__dscale(1.0 / length(n), n)};
    return 1;
}

// A ray from outside against the ball of a radius about `centre`.
static int32_t meet_ball(const fe__scaled_ray *r, fe_dvec3 centre, double radius, fe__ray_hit *hit)
{
    entry e;
    fe_dvec3 o = fe__dsub(r->origin, centre);
    if (fe__ddot(fe__dscale(scale_for(largest(o)), o), r->direction) >= 0.0) return 0; // It does not come nearer.
    return enter_round(o, r->direction, radius, &e) && meet(r, e.s, e.normal, hit);
}

// The depth below the surface of a point that is `away` from a core with a radius; below 0 outside. `way_out` is `flat`
// if the point is on the core.
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

// The capsule lies in the infinite cylinder about its axis. A ray enters the cylinder first, or begins in it. An entry
// between the ends of the axis is the hit; beyond an end the ray can hit only the ball about that end.
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
        // The ray is parallel to the axis, or leads away from it.
        if (fe__ddot(fe__dscale(scale_for(largest(across)), across), drift) >= 0.0) return 0;
        if (!enter_round(across, drift, radius, &e)) return 0;
        y = o.y + fe__maxd(e.s, 0.0) * d.y;
        if (fe__absd(y) <= half) return meet(r, e.s, e.normal, hit);
    }
    return meet_ball(r, (fe_dvec3){0.0, y > 0.0 ? half : -half, 0.0}, radius, hit);
}

// ---- flat surfaces -------------------------------------------------------------------------------------------------
static int32_t start_in_box(const fe__scaled_ray *r, const double o[3], const double half[3], fe__ray_hit *hit)
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
    double sign = o[axis] < 0.0 ? -1.0 : 1.0;
    fe_dvec3 way_out = {axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0, axis == 2 ? sign : 0.0};
    return start_inside(r, depth, way_out, hit);
}

// The ray is in the slab from the first quotient to the second. A ray along the slab gives 0 / 0 on its sides only, and
// a NaN does not change the bounds below. Two quotients take no longer than one.
typedef double two __attribute__((vector_size(16)));
static inline two cross_slab(double o, double d, double half)
{
    double far_side = __builtin_copysign(half, d);
    return ((two){-far_side, far_side} - (two){o, o}) / (two){d, d};
}

// -1 or 1, against d; 0: it is not this side
static inline double against(double d, int32_t is_side)
{
    union {
        double value;
        uint64_t bits;
    } one = {__builtin_copysign(1.0, -d)};
    one.bits &= -(uint64_t)is_side;
    return one.value;
}

// The ray is in the box from its last entry into one of three slabs to its first exit (Kay and Kajiya, Ray Tracing
// Complex Scenes, 1986). On an edge the lowest axis gives the normal. The signs of the direction, the order of the
// entries and the side that is missed are random: nothing branches on them. From inside, no slab is entered later than
// at 0 or left before.
int32_t fe__ray_box(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    const double half[3] = {(double)form->half.x, (double)form->half.y, (double)form->half.z};
    const fe_dvec3 o = r->origin, d = r->direction;
    const two x = cross_slab(o.x, d.x, half[0]), y = cross_slab(o.y, d.y, half[1]), z = cross_slab(o.z, d.z, half[2]);
    const double none = (double)INFINITY;
    double enter = fe__maxd(z[0], fe__maxd(y[0], fe__maxd(x[0], -none))),
           leave = fe__mind(z[1], fe__mind(y[1], fe__mind(x[1], none)));
    if ((enter > leave) | (leave < 0.0) | !(fe__maxd(enter, 0.0) * r->per_s <= r->limit)) return 0;
    if (enter <= 0.0 && fe__absd(o.x) <= half[0] && fe__absd(o.y) <= half[1] && fe__absd(o.z) <= half[2])
        return start_in_box(r, (const double[3]){o.x, o.y, o.z}, half, hit);
    const int32_t is_x = x[0] >= enter, is_y = (y[0] >= enter) & ~is_x, is_z = 1 & ~(is_x | is_y);
    return meet(r, enter, (fe_dvec3){against(d.x, is_x), against(d.y, is_y), against(d.z, is_z)}, hit);
}

// The height n.o - distance falls at the rate n.d. A quarter of both is taken, so that the sum of three products of
// finite numbers is finite.
int32_t fe__ray_plane(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    const double quarter = 0.25;
    fe_dvec3 n = fe__widen(form->normal);
    double n_length = length(n); // It is 1 up to the rounding of floats.
    fe_dvec3 unit = fe__dscale(1.0 / n_length, n);
    double above = fe__ddot(n, fe__dscale(quarter, r->origin)) - quarter * (double)form->distance;
    if (above <= 0.0) return start_inside(r, -above / (quarter * n_length), unit, hit);
    double rate = fe__ddot(n, fe__dscale(quarter, r->direction));
    return rate < 0.0 && meet(r, above / -rate, unit, hit);
}

// The ray comes from the side around which the vertices turn left:  n = e1 x e2,  t = n.(o - v0) / -n.d.  It hits if
// the point is left of every side.
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
    // The origin's numbers are copied one by one for the reason given at report().
    fe__scaled_ray r = {{origin->x, origin->y, origin->z}, fe__dscale(scale, *translation), scale, limit};
    return fe__casts[form->type].ray(form, &r, hit);
}

// ---- cylinder and cone: nearest points -----------------------------------------------------------------------------
// In the half plane through the point and the axis the form is a rectangle or a triangle. The point is `out` from the
// axis and `up` along it.
typedef struct profile {
    double out, up;
    double x, z; // unit, outwards; along x if the point is on the axis
} profile;

static profile profile_of(fe_dvec3 p)
{
    double most = fe__maxd(fe__absd(p.x), fe__absd(p.z));
    if (!(most > 0.0)) return (profile){0.0, p.y, 1.0, 0.0};
    double x = p.x / most, z = p.z / most, length = sqrt(x * x + z * z);
    return (profile){most * length, p.y, x / length, z / length};
}

// From the surface's point (out, up) and its unit normal in the half plane.
static fe__nearest lifted(const profile *p, double distance, double normal_out, double normal_up, double out, double up)
{
    fe_dvec3 normal = {normal_out * p->x, normal_up, normal_out * p->z}, point = {out * p->x, up, out * p->z};
    return (fe__nearest){distance, normal, point, -1, -1};
}

static fe__nearest from_outside(const profile *p, double out, double up)
{
    double x = p->out - out, y = p->up - up, most = fe__maxd(fe__absd(x), fe__absd(y)), length;
    if (!(most > 0.0)) return lifted(p, 0.0, 0.0, up < 0.0 ? -1.0 : 1.0, out, up); // The point is a corner itself.
    x /= most, y /= most, length = sqrt(x * x + y * y);
    return lifted(p, most * length, x / length, y / length, out, up);
}

fe__nearest fe__nearest_on_cylinder(const fe__form *form, fe_dvec3 point)
{
    double r = (double)form->half.x, h = (double)form->half.y;
    profile p = profile_of(point);
    double out = fe__mind(p.out, r), up = fe__mind(fe__maxd(p.up, -h), h);
    if (out != p.out || up != p.up) return from_outside(&p, out, up);
    double to_cap = fe__absd(p.up) - h, side = p.up < 0.0 ? -1.0 : 1.0;
    if (p.out - r >= to_cap) return lifted(&p, p.out - r, 1.0, 0.0, r, p.up);
    return lifted(&p, to_cap, 0.0, side, p.out, side * h);
}

// The side's normal is (2h, r) / l, its direction from the rim to the tip (-r, 2h) / l.
fe__nearest fe__nearest_on_cone(const fe__form *form, fe_dvec3 point)
{
    double r = (double)form->half.x, h = (double)form->half.y, l = sqrt(r * r + 4.0 * h * h);
    profile p = profile_of(point);
    double normal_out = 2.0 * h / l, normal_up = r / l;
    double above_side = normal_out * p.out + normal_up * (p.up - h), below_base = -h - p.up;
    double along = fe__mind(fe__maxd(normal_out * (p.up + h) - normal_up * (p.out - r), 0.0), l);
    double out = r - along * normal_up, up = -h + along * normal_out;
    if (above_side <= 0.0 && below_base <= 0.0) {
        if (above_side >= below_base)
            return lifted(&p, above_side, normal_out, normal_up, p.out - above_side * normal_out,
                          p.up - above_side * normal_up);
        return lifted(&p, below_base, 0.0, -1.0, p.out, -h);
    }
    if (below_base > 0.0 && p.out <= r) return lifted(&p, below_base, 0.0, -1.0, p.out, -h);
    if (along > 0.0 && along < l)
        return lifted(&p, above_side, normal_out, normal_up, p.out - above_side * normal_out,
                      p.up - above_side * normal_up);
    return from_outside(&p, out, up);
}

// ---- cylinder and cone: rays ---------------------------------------------------------------------------------------
// A convex form about an axis is the part of a round surface between two planes. A ray is in it from the last entry to
// the first exit. `enter` and `leave` are values of s.
typedef struct stay {
    double enter, leave;
} stay;
static const stay nowhere = {(double)INFINITY, -(double)INFINITY};

static stay between(double y, double rate, double half)
{
    if (rate == 0.0) return fe__absd(y) <= half ? (stay){-(double)INFINITY, (double)INFINITY} : nowhere;
    double a = (-half - y) / rate, b = (half - y) / rate;
    return (stay){fe__mind(a, b), fe__maxd(a, b)};
}

// |o + s d| <= r in the plane across the axis. The roots lie on either side of the point nearest to the axis.
static stay in_cylinder(double ox, double oz, double dx, double dz, double r)
{
    double square = dx * dx + dz * dz;
    if (square == 0.0) return ox * ox + oz * oz <= r * r ? (stay){-(double)INFINITY, (double)INFINITY} : nowhere;
    double middle = -(ox * dx + oz * dz) / square, x = ox + middle * dx, z = oz + middle * dz;
    double inside = r * r - (x * x + z * z);
    if (!(inside >= 0.0)) return nowhere;
    double half = sqrt(inside / square);
    return (stay){middle - half, middle + half};
}

// out^2 <= (k w)^2 with the depth w below the tip; the form is that half of the quadric that has w >= 0.
//   a s^2 + 2 b s + c <= 0
static stay in_cone(fe_dvec3 o, fe_dvec3 d, double k, double tip)
{
    const double none = (double)INFINITY;
    double w = tip - o.y, dw = -d.y, a = d.x * d.x + d.z * d.z - k * k * dw * dw,
           b = o.x * d.x + o.z * d.z - k * k * w * dw, c = o.x * o.x + o.z * o.z - k * k * w * w;
    double square = b * b - a * c;
    if (!(square >= 0.0)) {
        if (a >= 0.0) return nowhere;
        square = 0.0; // The ray passes by the tip.
    }
    double q = -(b + __builtin_copysign(sqrt(square), b));
    if (q == 0.0) { // Both roots are at s = 0, or the ray runs along the side from the tip.
        if (a > 0.0) return w >= 0.0 ? (stay){0.0, 0.0} : nowhere;
        return dw > 0.0 ? (stay){0.0, none} : (stay){-none, 0.0};
    }
    double first = c / q, second = q / a; // If a = 0, the second is infinite.
    if (a > 0.0) {
        double middle = -b / a;
        return w + middle * dw >= 0.0 ? (stay){fe__mind(first, second), fe__maxd(first, second)} : nowhere;
    }
    if (a == 0.0) return dw > 0.0 ? (stay){first, none} : (stay){-none, first};
    return dw > 0.0 ? (stay){fe__maxd(first, second), none} : (stay){-none, fe__mind(first, second)};
}

// Moves the start by `move`, in s, to the point of the line nearest to the origin, where nothing cancels. 0: the line
// passes by the ball of `radius` about the origin
static int32_t come_near(const fe__scaled_ray *r, double radius, fe_dvec3 *near, double *move)
{
    fe_dvec3 o = r->origin, d = r->direction;
    double speed = length(d), scale = largest(o) > longest ? scale_down : 1.0;
    if (!(speed > 0.0)) return 0;
    *move = -(fe__ddot(fe__dscale(scale, o), d) / (speed * speed)) / scale;
    if (!(fe__absd(*move) < (double)INFINITY)) return 0;
    *near = fe__dadd(o, fe__dscale(*move, d));
    return fe__absd(near->x) <= radius && fe__absd(near->y) <= radius && fe__absd(near->z) <= radius;
}

// At a tip or a rim many planes hold the form, and rounding makes the side's normal. If that is along the ray, another
// one is not: one between it and the end's normal, or the one across the ray that leans most to `spare`.
static fe_dvec3 opposing_normal(fe_dvec3 side, fe_dvec3 end, fe_dvec3 spare, fe_dvec3 direction)
{
    double along = fe__ddot(side, direction), back = fe__ddot(end, direction), square = fe__ddot(direction, direction);
    if (!(along > 0.0)) return side;
    fe_dvec3 n = back < 0.0 ? fe__dadd(fe__dscale(-back, side), fe__dscale(along, end))
                            : fe__dsub(spare, fe__dscale(fe__ddot(spare, direction) / square, direction));
    double n_length = length(n);
    return n_length > 0.0 ? fe__dscale(1.0 / n_length, n) : fe__dscale(-1.0 / sqrt(square), direction);
}

// The ray is in the form while it is in the round surface and between the flat ends.
static int32_t meet_round(const fe__scaled_ray *r, stay round, stay flat, double move, fe_dvec3 side, fe_dvec3 end,
                          fe__ray_hit *hit)
{
    double enter = fe__maxd(round.enter, flat.enter), leave = fe__mind(round.leave, flat.leave);
    if (!(enter <= leave) || !(leave + move >= 0.0)) return 0;
    return meet(r, enter + move, round.enter > flat.enter ? side : end, hit);
}

static fe_dvec3 end_normal(double rate) { return (fe_dvec3){0.0, rate > 0.0 ? -1.0 : 1.0, 0.0}; }

int32_t fe__ray_cylinder(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    double radius = (double)form->half.x, half = (double)form->half.y, move;
    fe__nearest n = fe__nearest_on_cylinder(form, r->origin);
    if (n.distance <= 0.0) return start_inside(r, -n.distance, n.normal, hit);
    fe_dvec3 o, d = r->direction;
    if (!come_near(r, radius + half, &o, &move)) return 0;
    stay round = in_cylinder(o.x, o.z, d.x, d.z, radius), flat = between(o.y, d.y, half);
    profile side = profile_of((fe_dvec3){o.x + round.enter * d.x, 0.0, o.z + round.enter * d.z});
    fe_dvec3 normal = {side.x, 0.0, side.z}, end = end_normal(d.y);
    return meet_round(r, round, flat, move, opposing_normal(normal, end, normal, d), end, hit);
}

int32_t fe__ray_cone(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    double radius = (double)form->half.x, half = (double)form->half.y, l = sqrt(radius * radius + 4.0 * half * half),
           move;
    fe__nearest n = fe__nearest_on_cone(form, r->origin);
    if (n.distance <= 0.0) return start_inside(r, -n.distance, n.normal, hit);
    fe_dvec3 o, d = r->direction;
    if (!come_near(r, radius + half, &o, &move)) return 0;
    stay round = in_cone(o, d, radius / (2.0 * half), half), flat = between(o.y, d.y, half);
    profile side = profile_of((fe_dvec3){o.x + round.enter * d.x, 0.0, o.z + round.enter * d.z});
    fe_dvec3 normal = {side.x * (2.0 * half / l), radius / l, side.z * (2.0 * half / l)};
    // A ray that goes up leaves the base behind it when it meets the side.
    fe_dvec3 up = {0.0, 1.0, 0.0}, end = end_normal(d.y);
    return meet_round(r, round, flat, move, opposing_normal(normal, d.y < 0.0 ? end : up, up, d), end, hit);
}

// ---- mesh casts -----------------------------------------------------------------------------------------------------
// A world casts against meshes with the kernels of its SIMD set (mesh_ray.simd.c).

#define DECLARE(simd, name) extern const fe__mesh_casts fe__mesh_casts_##name;
FE_EACH_WIDE_SET(DECLARE)

const fe__mesh_casts *fe__mesh_casts_of(int32_t simd)
{
    switch (simd) {
#define CASE(set, name) \
    case set:           \
        return &fe__mesh_casts_##name;
        FE_EACH_WIDE_SET(CASE)
    default:
        return &FE_BASE_SET(fe__mesh_casts);
    }
}
