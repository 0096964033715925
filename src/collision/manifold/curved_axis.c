// curved_axis.c - the directions along which what has a rim, a cylinder or a cone, touches: of faces, across two axes
// that cross, and from a side.
//
// The general path (convex.c) finds the nearest or deepest points. EPA comes near a curved surface only step by step,
// so its direction is compared with those that faces and sides have, and the one that was taken is named. The same
// features meet in the next step: where they do, neither GJK nor EPA is needed.
#include "collision/form/gjk.h"
#include "collision/form/hull.h"
#include "collision/form/form.h"
#include "collision/manifold/pair_kernels.h"

// ---- names ---------------------------------------------------------------------------------------------------------
// The kind, whose feature it is, against its own direction or along it, and the feature: an axis of a box, a face of a
// hull
enum { OF_FACE, OF_CROSSING, OF_SIDE, KIND_SHIFT = 16, OF_B = 1 << 15, AGAINST = 1 << 14, FEATURE = AGAINST - 1 };

static int32_t name_of(int32_t kind, int32_t is_b, int32_t feature)
{
    return kind << KIND_SHIFT | (is_b ? OF_B : 0) | feature;
}

int32_t fe__axis_is_of_face(int32_t axis) { return axis >> KIND_SHIFT == OF_FACE; }

// ---- choice --------------------------------------------------------------------------------------------------------
typedef struct choice {
    const fe__cores *cores;
    fe_dvec3 found; // direction and separation that the search found
    double least;   // separation that is as good
    fe__core_touch *touch;
} choice;

static double separation_of(const fe__cores *cores, fe_dvec3 n, fe_dvec3 difference)
{
    return -fe__ddot(n, difference) - (double)cores->a->radius - (double)cores->b->radius;
}

static double separation_along(const fe__cores *cores, fe_dvec3 n)
{
    return separation_of(cores, n, fe__cores_support(cores, n).difference);
}

// 1: it is the normal
static int32_t takes(const choice *c, fe_dvec3 direction, int32_t name)
{
    double square = fe__ddot(direction, direction);
    int32_t against = fe__ddot(direction, c->found) < 0.0;
    if (!(square > 1e-12)) return 0;
    fe_dvec3 n = fe__dscale((against ? -1.0 : 1.0) / sqrt(square), direction);
    if (fe__ddot(n, c->found) < (double)FE_FACE_COS) return 0;
    double separation = separation_along(c->cores, n);
    if (separation < c->least) return 0;
    c->touch->normal = fe__narrow(n);
    c->touch->separation = (float)separation;
    c->touch->axis = name | (against ? AGAINST : 0);
    return 1;
}

// normal of the side next to `out` (unit, out of the form); axis unit
static fe_dvec3 side_normal(const fe__form *form, fe_dvec3 axis, fe_dvec3 out)
{
    fe_dvec3 aside = fe__dsub(out, fe__dscale(fe__ddot(out, axis), axis));
    if (form->type != FE__FORM_CONE) return aside;
    double length = sqrt(fe__ddot(aside, aside));
    if (!(length > 0.0)) return axis;
    return fe__dadd(fe__dscale(2.0 * (double)form->half.y / length, aside), fe__dscale((double)form->half.x, axis));
}

static int32_t is_long(const fe__form *form)
{
    return form->type == FE__FORM_CYLINDER || form->type == FE__FORM_CAPSULE;
}

// Sides of two that cross: nearest points of their axes' lines, c + t e and s y, and their radii out
// 1: they cross between their ends
static int32_t place_crossing(const fe__cores *c, fe__core_touch *touch)
{
    fe_dvec3 p = c->position, e = c->axis_y, n = fe__widen(touch->normal);
    double across = e.x * e.x + e.z * e.z, t = -(p.x * e.x + p.z * e.z) / across, s = p.y + t * e.y;
    if (fe__absd(s) > (double)fe__maxf(c->a->half.y, c->a->half_height) ||
        fe__absd(t) > (double)fe__maxf(c->b->half.y, c->b->half_height))
        return 0;
    fe_dvec3 on_a = {0.0, s, 0.0}, on_b = fe__dadd(p, fe__dscale(t, e));
    if (fe__form_is_curved(c->a)) on_a = fe__dadd(on_a, fe__dscale((double)c->a->half.x, n));
    if (fe__form_is_curved(c->b)) on_b = fe__dsub(on_b, fe__dscale((double)c->b->half.x, n));
    touch->on_a = fe__narrow(on_a), touch->on_b = fe__narrow(on_b);
    return 1;
}

// in A's frame
static fe_dvec3 hull_normal(const fe__cores *c, int32_t is_b, int32_t face)
{
    if (!is_b) return fe__hull_unit_normal(c->a->hull, face);
    fe_dvec3 n = fe__hull_unit_normal(c->b->hull, face);
    return fe__dadd(fe__dadd(fe__dscale(n.x, c->axis_x), fe__dscale(n.y, c->axis_y)), fe__dscale(n.z, c->axis_z));
}

// The face that looks along the direction found, or against it
static int32_t hull_face(const fe__cores *c, int32_t is_b, fe_dvec3 found)
{
    if (!is_b) return fe__hull_facing(c->a->hull, found);
    fe_dvec3 in_b = {-fe__ddot(c->axis_x, found), -fe__ddot(c->axis_y, found), -fe__ddot(c->axis_z, found)};
    return fe__hull_facing(c->b->hull, in_b);
}

static fe_dvec3 axis_of(const fe__cores *c, int32_t is_b, int32_t k)
{
    if (is_b) return k == 0 ? c->axis_x : k == 1 ? c->axis_y : c->axis_z;
    return (fe_dvec3){k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
}

enum { LENGTHWAYS = 1 }; // y

static int32_t takes_face(const choice *c, int32_t is_b)
{
    const fe__form *form = is_b ? c->cores->b : c->cores->a;
    if (fe__form_is_curved(form))
        return takes(c, axis_of(c->cores, is_b, LENGTHWAYS), name_of(OF_FACE, is_b, LENGTHWAYS));
    if (fe__form_is_hull(form)) {
        int32_t face = hull_face(c->cores, is_b, c->found);
        return takes(c, hull_normal(c->cores, is_b, face), name_of(OF_FACE, is_b, face));
    }
    for (int32_t k = 0; k < 3 && fe__form_has_flat_faces(form); ++k)
        if (takes(c, axis_of(c->cores, is_b, k), name_of(OF_FACE, is_b, k))) return 1;
    return 0;
}

static int32_t takes_side(const choice *c, int32_t is_b)
{
    const fe__form *form = is_b ? c->cores->b : c->cores->a;
    fe_dvec3 out = is_b ? fe__dscale(-1.0, c->found) : c->found;
    return fe__form_is_curved(form) &&
           takes(c, side_normal(form, axis_of(c->cores, is_b, LENGTHWAYS), out), name_of(OF_SIDE, is_b, 0));
}

int32_t fe__sharpen(const fe__cores *cores, fe__core_touch *touch)
{
    float tie = fe__tie(fe__minf(fe__form_thickness(cores->a), fe__form_thickness(cores->b)));
    choice c = {cores, fe__widen(touch->normal), (double)(touch->separation - tie), touch};
    touch->axis = -1;
    if (takes_face(&c, 0) || takes_face(&c, 1)) return 1;
    if (is_long(cores->a) && is_long(cores->b) &&
        takes(&c, fe__dcross(axis_of(cores, 0, LENGTHWAYS), cores->axis_y), name_of(OF_CROSSING, 0, 0)))
        place_crossing(cores, touch);
    else if (!takes_side(&c, 0))
        takes_side(&c, 1);
    return 0;
}

// ---- the same again ------------------------------------------------------------------------------------------------
// Of a cylinder's side, across which it is a disc of radius r about a point c, the other is farthest apart along the m
// with  (q(m) - c) . (axis x m) = 0,  q being the other's point deepest along m: its shadow across the axis is convex,
// and m leads from c to what of it is nearest. That product falls as m turns; the secant finds its root.
typedef struct side {
    const fe__cores *cores;
    int32_t is_b;
    fe_dvec3 centre, axis;
} side;

// q - c
static fe_dvec3 deepest(const side *s, fe_dvec3 m)
{
    fe__vertex v = fe__cores_support(s->cores, s->is_b ? fe__dscale(-1.0, m) : m);
    return fe__dsub(s->is_b ? v.on_a : fe__dsub(v.on_a, v.difference), s->centre);
}

// From a direction near the one looked for. 0: there is none, else that and q - c
static int32_t find_root(const side *s, fe_dvec3 *m, fe_dvec3 *q)
{
    enum { MOST_TURNS = 8 };
    const double precise = 1e-6; // rad that are left
    fe_dvec3 start = *m, across = fe__dcross(s->axis, start);
    *q = deepest(s, *m);
    double x = 0.0, off = fe__ddot(*q, across), last_x = 0.0, last = 0.0;
    for (int32_t i = 0; i < MOST_TURNS; ++i) {
        double distance = fe__ddot(*q, *m);
        if (!(distance > 0.0)) return 0;
        if (fe__absd(off) <= precise * distance) return 1;
        double step = i == 0 ? off / distance : off * (x - last_x) / (last - off);
        last_x = x, last = off, x += step;
        fe_dvec3 way = fe__dadd(start, fe__dscale(x, across));
        *m = fe__dscale(1.0 / sqrt(fe__ddot(way, way)), way);
        *q = deepest(s, *m);
        off = fe__ddot(*q, fe__dcross(s->axis, *m));
    }
    return 0;
}

static int32_t look_from_side(const fe__cores *cores, int32_t is_b, fe_vec3 last, fe__core_touch *touch)
{
    const fe__form *form = is_b ? cores->b : cores->a;
    fe_dvec3 zero = {0.0, 0.0, 0.0}, q, m = fe__dscale(is_b ? -1.0 : 1.0, fe__widen(last));
    side s = {cores, is_b, is_b ? cores->position : zero, axis_of(cores, is_b, LENGTHWAYS)};
    m = fe__dsub(m, fe__dscale(fe__ddot(m, s.axis), s.axis));
    m = fe__dscale(1.0 / sqrt(fe__ddot(m, m)), m);
    if (!find_root(&s, &m, &q)) return 0;
    double along = fe__ddot(q, s.axis), radius = (double)form->half.x, apart = fe__ddot(q, m) - radius;
    if (fe__absd(along) > (double)form->half.y) return 0; // beyond an end
    fe_vec3 own = fe__narrow(fe__dadd(s.centre, fe__dadd(fe__dscale(along, s.axis), fe__dscale(radius, m)))),
            other = fe__narrow(fe__dadd(s.centre, q));
    *touch = (fe__core_touch){.normal = fe__narrow(fe__dscale(is_b ? -1.0 : 1.0, m)),
                              .separation = (float)(apart - (double)cores->a->radius - (double)cores->b->radius),
                              .on_a = is_b ? other : own,
                              .on_b = is_b ? own : other};
    return 1;
}

// Askew by less than this, the sine squared, two axes have a normal that turns by much when they turn by little
#define NEARLY_PARALLEL 1e-3

static int32_t look_along(const fe__cores *cores, fe_dvec3 direction, int32_t axis, fe__core_touch *touch)
{
    fe_dvec3 n = fe__dscale((axis & AGAINST ? -1.0 : 1.0) / sqrt(fe__ddot(direction, direction)), direction);
    fe__vertex v = fe__cores_support(cores, n);
    *touch = (fe__core_touch){.normal = fe__narrow(n),
                              .separation = (float)separation_of(cores, n, v.difference),
                              .on_a = fe__narrow(v.on_a)}; // in the plane of what touches
    return 1;
}

int32_t fe__look_again(const fe__cores *cores, int32_t axis, fe_vec3 last, fe__core_touch *touch)
{
    int32_t kind = axis >> KIND_SHIFT, is_b = (axis & OF_B) != 0, feature = axis & FEATURE, found = 0;
    const fe__form *form = is_b ? cores->b : cores->a;
    if (kind == OF_FACE && feature >= (fe__form_is_hull(form) ? form->hull->face_count : 3))
        return 0; // whoever wrote the axis
    if (kind == OF_FACE) {
        fe_dvec3 n = fe__form_is_hull(form) ? hull_normal(cores, is_b, feature) : axis_of(cores, is_b, feature);
        found = look_along(cores, n, axis, touch);
    } else if (kind == OF_CROSSING) {
        fe_dvec3 n = fe__dcross(axis_of(cores, 0, LENGTHWAYS), cores->axis_y);
        found = fe__ddot(n, n) > NEARLY_PARALLEL && look_along(cores, n, axis, touch) && place_crossing(cores, touch);
    } else if (form->type == FE__FORM_CYLINDER)
        found = look_from_side(cores, is_b, last, touch);
    touch->axis = axis;
    touch->overlap = touch->separation + cores->a->radius + cores->b->radius < 0.0f;
    return found;
}
