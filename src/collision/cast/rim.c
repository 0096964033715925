// rim.c - where a ray or a point meets a cylinder or a cone: closed forms in double, in the form's frame.
//
// Input: ray.c's rays, nearest.c's points. A convex form about an axis is the part of a round surface between two
// planes: a ray is in it from the last entry to the first exit. Seen along the axis a point is nearest to a rectangle
// or a triangle.
#include "collision/cast/kinds.h"

// ---- points --------------------------------------------------------------------------------------------------------
// A point as seen in the half plane through it and the axis: `out` from the axis, `up` along it
typedef struct profile {
    double out, up;
    double x, z; // unit, outwards; x where the point is on the axis
} profile;

static profile profile_of(fe_dvec3 p)
{
    double most = fe__maxd(fe__absd(p.x), fe__absd(p.z));
    if (!(most > 0.0)) return (profile){0.0, p.y, 1.0, 0.0};
    double x = p.x / most, z = p.z / most, length = sqrt(x * x + z * z);
    return (profile){most * length, p.y, x / length, z / length};
}

// the surface's point and normal (unit) in the half plane
static fe__nearest lifted(const profile *p, double distance, double normal_out, double normal_up, double out, double up)
{
    return (
        fe__nearest){distance, {normal_out * p->x, normal_up, normal_out * p->z}, {out * p->x, up, out * p->z}, -1, -1};
}

static fe__nearest from_outside(const profile *p, double out, double up)
{
    double x = p->out - out, y = p->up - up, most = fe__maxd(fe__absd(x), fe__absd(y)), length;
    if (!(most > 0.0)) return lifted(p, 0.0, 0.0, up < 0.0 ? -1.0 : 1.0, out, up); // a corner itself
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

// ---- rays ----------------------------------------------------------------------------------------------------------
// The ray is in from `enter` to `leave`, of s.
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

// |o + s d| <= r in the plane across the axis, from the point nearest to the axis on
static stay in_cylinder(double ox, double oz, double dx, double dz, double r)
{
    double square = dx * dx + dz * dz;
    if (square == 0.0) return ox * ox + oz * oz <= r * r ? (stay){-(double)INFINITY, (double)INFINITY} : nowhere;
    double middle = -(ox * dx + oz * dz) / square, x = ox + middle * dx, z = oz + middle * dz;
    double room = r * r - (x * x + z * z);
    if (!(room >= 0.0)) return nowhere;
    double half = sqrt(room / square);
    return (stay){middle - half, middle + half};
}

// out^2 <= (k w)^2, w the depth below the tip: of the quadric's two halves the one with w >= 0.
//   a s^2 + 2 b s + c <= 0
static stay in_cone(fe_dvec3 o, fe_dvec3 d, double k, double tip)
{
    const double none = (double)INFINITY;
    double w = tip - o.y, dw = -d.y, a = d.x * d.x + d.z * d.z - k * k * dw * dw,
           b = o.x * d.x + o.z * d.z - k * k * w * dw, c = o.x * o.x + o.z * o.z - k * k * w * w;
    double square = b * b - a * c;
    if (!(square >= 0.0)) {
        if (a >= 0.0) return nowhere;
        square = 0.0; // past the tip
    }
    double q = -(b + __builtin_copysign(sqrt(square), b));
    if (q == 0.0) { // both at s = 0, or along the side from the tip
        if (a > 0.0) return w >= 0.0 ? (stay){0.0, 0.0} : nowhere;
        return dw > 0.0 ? (stay){0.0, none} : (stay){-none, 0.0};
    }
    double one = c / q, two = q / a; // of a = 0 the second is infinite
    if (a > 0.0) {
        double middle = -b / a;
        return w + middle * dw >= 0.0 ? (stay){fe__mind(one, two), fe__maxd(one, two)} : nowhere;
    }
    if (a == 0.0) return dw > 0.0 ? (stay){one, none} : (stay){-none, one};
    return dw > 0.0 ? (stay){fe__maxd(one, two), none} : (stay){-none, fe__mind(one, two)};
}

static int32_t start_inside(const fe__scaled_ray *r, const fe__nearest *n, fe__ray_hit *hit)
{
    double speed = sqrt(fe__ddot(r->direction, r->direction));
    fe_dvec3 normal = speed > 0.0 ? fe__dscale(-1.0 / speed, r->direction) : n->normal;
    *hit = (fe__ray_hit){0.0, normal, fe__maxd(-n->distance, 0.0), 1, -1, -1};
    return 1;
}

// The start is moved to the point of the line nearest to the origin, where nothing cancels; `move` is how far. 0: the
// line passes the ball of `reach` about the origin, or the form lies behind.
static int32_t come_near(const fe__scaled_ray *r, double reach, fe_dvec3 *near, double *move)
{
    fe_dvec3 o = r->origin, d = r->direction;
    double far = fe__maxd(fe__maxd(fe__absd(o.x), fe__absd(o.y)), fe__absd(o.z)), speed = sqrt(fe__ddot(d, d));
    const double longest = 1e100; // squares of lengths up to it are finite
    double scale = far > longest ? 0x1p-700 : 1.0;
    if (!(speed > 0.0)) return 0;
    *move = -(fe__ddot(fe__dscale(scale, o), d) / (speed * speed)) / scale;
    if (!(fe__absd(*move) < (double)INFINITY)) return 0;
    *near = fe__dadd(o, fe__dscale(*move, d));
    return fe__absd(near->x) <= reach && fe__absd(near->y) <= reach && fe__absd(near->z) <= reach;
}

// At a tip or a rim many planes hold the form. When the side's normal, of rounding there, is along the ray, another is
// not: between it and the end's, or the one across the ray that leans most to `spare`.
static fe_dvec3 against(fe_dvec3 side, fe_dvec3 end, fe_dvec3 spare, fe_dvec3 direction)
{
    double along = fe__ddot(side, direction), back = fe__ddot(end, direction), square = fe__ddot(direction, direction);
    if (!(along > 0.0)) return side;
    fe_dvec3 n = back < 0.0 ? fe__dadd(fe__dscale(-back, side), fe__dscale(along, end))
                            : fe__dsub(spare, fe__dscale(fe__ddot(spare, direction) / square, direction));
    double length = sqrt(fe__ddot(n, n));
    return length > 0.0 ? fe__dscale(1.0 / length, n) : fe__dscale(-1.0 / sqrt(square), direction);
}

static int32_t meet(const fe__scaled_ray *r, stay round, stay flat, double move, fe_dvec3 side, fe_dvec3 end,
                    fe__ray_hit *hit)
{
    double enter = fe__maxd(round.enter, flat.enter), leave = fe__mind(round.leave, flat.leave);
    if (!(enter <= leave) || !(leave + move >= 0.0)) return 0;
    double t = fe__maxd(enter + move, 0.0) * r->per_s;
    if (!(t <= r->limit)) return 0;
    *hit = (fe__ray_hit){t, round.enter > flat.enter ? side : end, 0.0, 0, -1, -1};
    return 1;
}

static fe_dvec3 end_normal(double rate) { return (fe_dvec3){0.0, rate > 0.0 ? -1.0 : 1.0, 0.0}; }

int32_t fe__ray_cylinder(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    double radius = (double)form->half.x, half = (double)form->half.y, move;
    fe__nearest n = fe__nearest_on_cylinder(form, r->origin);
    if (n.distance <= 0.0) return start_inside(r, &n, hit);
    fe_dvec3 o, d = r->direction;
    if (!come_near(r, radius + half, &o, &move)) return 0;
    stay round = in_cylinder(o.x, o.z, d.x, d.z, radius), flat = between(o.y, d.y, half);
    profile side = profile_of((fe_dvec3){o.x + round.enter * d.x, 0.0, o.z + round.enter * d.z});
    fe_dvec3 normal = {side.x, 0.0, side.z}, end = end_normal(d.y);
    return meet(r, round, flat, move, against(normal, end, normal, d), end, hit);
}

int32_t fe__ray_cone(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    double radius = (double)form->half.x, half = (double)form->half.y, l = sqrt(radius * radius + 4.0 * half * half),
           move;
    fe__nearest n = fe__nearest_on_cone(form, r->origin);
    if (n.distance <= 0.0) return start_inside(r, &n, hit);
    fe_dvec3 o, d = r->direction;
    if (!come_near(r, radius + half, &o, &move)) return 0;
    stay round = in_cone(o, d, radius / (2.0 * half), half), flat = between(o.y, d.y, half);
    profile side = profile_of((fe_dvec3){o.x + round.enter * d.x, 0.0, o.z + round.enter * d.z});
    fe_dvec3 normal = {side.x * (2.0 * half / l), radius / l, side.z * (2.0 * half / l)};
    // going up, the base is behind where the side is met
    fe_dvec3 up = {0.0, 1.0, 0.0}, end = end_normal(d.y);
    return meet(r, round, flat, move, against(normal, d.y < 0.0 ? end : up, up, d), end, hit);
}
