// closest.c - the point of a form nearest to a point, and the distance of two forms; see cast_kinds.h.
//
// Most forms have closed forms. A heightfield or a mesh is searched in boxes around the point, a hull face by face.
#include "collision/cast/cast_kinds.h"

#include "collision/cast/approach.h"
#include "collision/form/gjk.h"
#include "collision/form/hull.h"

// ---- round forms, boxes, planes -------------------------------------------------------------------------------------
static double clamp(double x, double half) { return fe__mind(fe__maxd(x, -half), half); }

// From a core's nearest point and a radius. `flat` is the normal if the point lies on the core.
static fe__nearest on_round(fe_dvec3 point, fe_dvec3 core, double radius, fe_dvec3 flat)
{
    fe_dvec3 away = fe__dsub(point, core);
    double distance = sqrt(fe__ddot(away, away));
    fe_dvec3 normal = distance > 0.0 ? fe__dscale(1.0 / distance, away) : flat;
    return (fe__nearest){distance - radius, normal, fe__dadd(core, fe__dscale(radius, normal)), -1, -1};
}

fe__nearest fe__nearest_on_sphere(const fe__form *form, fe_dvec3 point)
{
    return on_round(point, (fe_dvec3){0.0, 0.0, 0.0}, (double)form->radius, (fe_dvec3){0.0, 1.0, 0.0});
}

fe__nearest fe__nearest_on_capsule(const fe__form *form, fe_dvec3 point)
{
    return on_round(point, (fe_dvec3){0.0, clamp(point.y, (double)form->half_height), 0.0}, (double)form->radius,
                    (fe_dvec3){1.0, 0.0, 0.0});
}

fe__nearest fe__nearest_on_box(const fe__form *form, fe_dvec3 point)
{
    fe_dvec3 half = fe__widen(form->half), flat = {0.0, 1.0, 0.0};
    fe_dvec3 core = {clamp(point.x, half.x), clamp(point.y, half.y), clamp(point.z, half.z)};
    int32_t inside = core.x == point.x && core.y == point.y && core.z == point.z;
    if (!inside) return on_round(point, core, 0.0, flat);
    const double p[3] = {point.x, point.y, point.z}, h[3] = {half.x, half.y, half.z};
    int32_t axis = 0; // the axis along which a side is nearest
    for (int32_t k = 1; k < 3; ++k)
        if (h[k] - fe__absd(p[k]) < h[axis] - fe__absd(p[axis])) axis = k;
    double side = p[axis] < 0.0 ? -1.0 : 1.0, on[3] = {p[0], p[1], p[2]}, n[3] = {0.0, 0.0, 0.0};
    on[axis] = side * h[axis], n[axis] = side;
    return (fe__nearest){fe__absd(p[axis]) - h[axis], {n[0], n[1], n[2]}, {on[0], on[1], on[2]}, -1, -1};
}

fe__nearest fe__nearest_on_plane(const fe__form *form, fe_dvec3 point)
{
    fe_dvec3 n = fe__widen(form->normal);
    double length = sqrt(fe__ddot(n, n)); // It is 1 up to the rounding of floats.
    double height = (fe__ddot(n, point) - (double)form->distance) / length;
    fe_dvec3 unit = fe__dscale(1.0 / length, n);
    return (fe__nearest){height, unit, fe__dsub(point, fe__dscale(height, unit)), -1, -1};
}

fe__nearest fe__form_nearest(const fe__form *form, fe_dvec3 point)
{
    return fe__casts[form->type].nearest(form, point);
}

// ---- forms with a hull ----------------------------------------------------------------------------------------------
// A form with a hull asks the hull, and scales the answer.
int32_t fe__ray_hull(const fe__form *form, const fe__scaled_ray *r, fe__ray_hit *hit)
{
    double limit = r->per_s > 0.0 ? r->limit / r->per_s : r->limit;
    fe_dvec3 way = fe__dscale(1.0 / (double)form->scale, r->direction);
    if (!fe__hull_ray(form->hull, fe__in_hull(form, r->origin), way, limit, hit)) return 0;
    hit->t *= r->per_s;
    hit->depth *= (double)form->scale;
    return 1;
}

fe__nearest fe__nearest_on_hull(const fe__form *form, fe_dvec3 point)
{
    fe__nearest n = fe__hull_nearest(form->hull, fe__in_hull(form, point));
    n.distance *= (double)form->scale;
    n.point = fe__from_hull(form, n.point);
    return n;
}

// A point is on a face if it is no farther from its plane than this share of the hull's extent: a hundred roundings of
// floats.
#define ON_FACE 1e-5

int32_t fe__hull_face_at(const fe__form *form, fe_dvec3 point, fe_dvec3 normal)
{
    const fe__hull *hull = form->hull;
    fe_dvec3 p = fe__in_hull(form, point);
    double most = -(double)INFINITY, lowest = -ON_FACE * (double)hull->extent - (double)hull->flatness;
    int32_t face = -1;
    for (int32_t i = 0; i < hull->face_count; ++i) {
        fe_dvec3 n = fe__widen(fe__hull_normal(hull, i));
        if (fe__ddot(n, p) - (double)hull->distances[i] < lowest || fe__ddot(n, normal) <= most) continue;
        most = fe__ddot(n, normal);
        face = i;
    }
    return face >= 0 ? face : fe__hull_facing(hull, normal);
}

// ---- heightfields and meshes ----------------------------------------------------------------------------------------
// Looks in a box of that half width around the point. The lowest number wins between equally near triangles.
static void nearest_in(const fe__ground *s, fe_dvec3 p, double width, fe__nearest *best)
{
    fe__bounds box = {{p.x - width, p.y - width, p.z - width}, {p.x + width, p.y + width, p.z + width}};
    fe__ground_walk walk;
    fe__ground_begin(&walk, s, &box, p);
    for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) {
        int32_t number = fe__ground_number(s, i);
        fe_dvec3 v[3], n = fe__ground_normal(s, i);
        fe__ground_corners(s, i, v);
        if (!s->mesh && fe__ddot(n, fe__dsub(p, v[0])) < 0.0) continue;
        fe_dvec3 q = fe__nearest_on_triangle(v, n, p), away = fe__dsub(p, q);
        double distance = sqrt(fe__ddot(away, away));
        if (!(distance < best->distance) && !(distance == best->distance && number < best->triangle)) continue;
        *best = (fe__nearest){distance, distance > 0.0 ? fe__dscale(1.0 / distance, away) : n, q, number, i};
    }
}

// Each box is twice as wide as the one before, until the nearest point found is nearer than the box is wide: then no
// point outside of it is nearer. The first box reaches into the bounds of the triangles, the last one holds them all.
int32_t fe__ground_nearest(const fe__ground *s, fe_dvec3 p, double limit, fe__nearest *nearest)
{
    fe__bounds b = fe__ground_bounds(s);
    fe_dvec3 cell = fe__ground_cell(s);
    double x = fe__maxd(fe__maxd(b.low.x - p.x, p.x - b.high.x), 0.0);
    double z = fe__maxd(fe__maxd(b.low.z - p.z, p.z - b.high.z), 0.0);
    double y = fe__maxd(fe__maxd(b.low.y - p.y, p.y - b.high.y), 0.0);
    double width = sqrt(x * x + y * y + z * z) + cell.x + cell.z, all = width;
    all += (b.high.x - b.low.x) + (b.high.y - b.low.y) + (b.high.z - b.low.z);
    nearest->distance = (double)INFINITY, nearest->triangle = -1;
    for (;; width *= 2.0) {
        width = fe__mind(width, limit);
        nearest_in(s, p, width, nearest);
        if (nearest->distance <= width) return 1;
        if (width >= limit || width >= all) return nearest->triangle >= 0 && nearest->distance <= limit;
    }
}

// ---- hulls ----------------------------------------------------------------------------------------------------------
static fe_dvec3 vertex_of(const fe__hull *hull, int32_t corner)
{
    return fe__widen(fe__hull_vertex(hull, hull->corners[corner]));
}

static double square_of(fe_dvec3 a) { return fe__ddot(a, a); }

// The nearest point of a face whose plane is `height` below the point: the foot on the plane or, if the point is beyond
// a side, a point of a side. Normals have the length 1 up to the rounding of floats.
static fe_dvec3 on_face(const fe__hull *hull, int32_t face, fe_dvec3 point, double height)
{
    fe_dvec3 normal = fe__widen(fe__hull_normal(hull, face)),
             best = fe__dsub(point, fe__dscale(height / fe__ddot(normal, normal), normal));
    double least = (double)INFINITY;
    int32_t first = hull->faces[face].first, count = hull->faces[face].count;
    for (int32_t k = 0; k < count; ++k) {
        fe_dvec3 a = vertex_of(hull, first + k), b = vertex_of(hull, first + (k + 1 < count ? k + 1 : 0));
        fe_dvec3 side = fe__dsub(b, a), out = fe__dcross(side, normal), from_a = fe__dsub(point, a);
        if (fe__ddot(from_a, out) <= 0.0) continue;
        double t = fe__ddot(from_a, side) / fe__ddot(side, side);
        fe_dvec3 q = fe__dadd(a, fe__dscale(fe__clampd(t, 0.0, 1.0), side));
        double square = square_of(fe__dsub(point, q));
        if (square >= least) continue;
        least = square;
        best = q;
    }
    return best;
}

// From outside, the nearest point lies on a face whose plane the point is above.
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
    if (highest <= 0.0 || nearest.distance == 0.0) { // The point is inside, or on the surface.
        fe_dvec3 normal = fe__hull_unit_normal(hull, shallow);
        double distance = highest * fe__ddot(normal, fe__widen(fe__hull_normal(hull, shallow)));
        return (fe__nearest){distance, normal, fe__dsub(point, fe__dscale(distance, normal)), shallow, -1};
    }
    nearest.normal = fe__dscale(1.0 / nearest.distance, fe__dsub(point, nearest.point));
    return nearest;
}

// ---- distance of two forms ------------------------------------------------------------------------------------------
// The distance of B's lowest point from the surface of a half space A.
static void plane_gap(const fe__form *plane, const fe__pose *pose_a, const fe__form *b, const fe__pose *pose_b,
                      fe__gap *gap)
{
    fe_dvec3 normal = fe__drotate(pose_a->rotation, fe__widen(plane->normal));
    fe_dvec3 down = fe__drotate_back(pose_b->rotation, fe__dscale(-1.0, normal));
    fe_dvec3 lowest = fe__dadd(pose_b->position, fe__drotate(pose_b->rotation, fe__form_support(b, down)));
    double length = sqrt(fe__ddot(normal, normal)); // It is 1 up to the rounding of floats.
    double height = fe__ddot(normal, fe__dsub(lowest, pose_a->position)) - (double)plane->distance;
    gap->normal = fe__dscale(1.0 / length, normal);
    gap->distance = height / length - (double)b->radius;
    gap->on_b = lowest;
    gap->overlap = 0;
}

void fe__form_gap(const fe__form *a, const fe__pose *pose_a, const fe__form *b, const fe__pose *pose_b, fe__gap *gap)
{
    if (fe__form_is_unbounded(a)) {
        plane_gap(a, pose_a, b, pose_b, gap);
        return;
    }
    if (fe__form_is_unbounded(b)) {
        plane_gap(b, pose_b, a, pose_a, gap);
        gap->on_b = fe__dsub(gap->on_b, fe__dscale(gap->distance + (double)a->radius, gap->normal));
        gap->normal = fe__dscale(-1.0, gap->normal);
        return;
    }
    fe__axes frame = fe__axes_of(pose_a->rotation), other = fe__axes_of(pose_b->rotation);
    fe__cores cores = {a,
                       b,
                       fe__turn_back(&frame, fe__dsub(pose_b->position, pose_a->position)),
                       fe__turn_back(&frame, other.x),
                       fe__turn_back(&frame, other.y),
                       fe__turn_back(&frame, other.z),
                       NULL};
    fe__gjk gjk;
    fe__gjk_distance(&cores, (double)INFINITY, &gjk);
    gap->overlap = gjk.overlap;
    gap->on_b = fe__dadd(pose_a->position, fe__turn(&frame, gjk.on_b));
    gap->distance = gjk.distance - (double)a->radius - (double)b->radius;
    gap->normal = gjk.overlap ? (fe_dvec3){0.0, 0.0, 0.0}
                              : fe__turn(&frame, fe__dscale(1.0 / gjk.distance, fe__dsub(gjk.on_b, gjk.on_a)));
}
