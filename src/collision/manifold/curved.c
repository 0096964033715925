// curved.c - what has a rim, a cylinder or a cone: on a half space, and the directions along which it touches.
//
// On a half space the points of the form's disc, or the ends of the line on its side, each with its own separation.
// With other forms the general path (convex.c) finds the nearest or deepest points; EPA comes near a curved surface
// only step by step, so its direction is compared with those that faces and sides have.
#include "collision/form/gjk.h"
#include "collision/form/hull.h"
#include "collision/form/support.h"
#include "collision/manifold/kernels.h"

// ---- half space ----------------------------------------------------------------------------------------------------
void fe__collide_plane_curved(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                              fe__manifold *manifold)
{
    fe_vec3 n = a->normal, down = fe__neg(fe__mul_transposed(&b_in_a->rotation, n));
    double middle = fe__ddot(fe__widen(n), fe__widen(b_in_a->position)) - (double)a->distance;
    fe__face face;
    fe__form_face(b, down, &face);
    fe__clip_vertex vertex[FE_FACE_VERTICES];
    int32_t near = 0;
    float lowest = (float)(middle - fe__ddot(fe__widen(down), fe__form_support(b, fe__widen(down))));
    fe__stay_apart(manifold, lowest, n);
    if (lowest > margin) return;
    for (int32_t i = 0; i < face.count; ++i) {
        fe_vec3 p = face.vertex[i];
        float height = (float)(middle - fe__ddot(fe__widen(down), fe__widen(p)));
        if (height <= margin) vertex[near++] = (fe__clip_vertex){p.x, face.count > 2 ? p.z : p.y, height, (uint32_t)i};
    }
    near = fe__reduce_to_four(vertex, near, 0.1f * fe__tie(fe__form_thickness(b)));
    manifold->normal = n;
    for (int32_t i = 0; i < near; ++i) {
        fe_vec3 p = fe__add(b_in_a->position, fe__mul(&b_in_a->rotation, face.vertex[vertex[i].id]));
        fe__add_point(manifold, fe__add_scaled(p, -0.5f * vertex[i].height, n), vertex[i].height,
                      face.id << 8 | vertex[i].id);
    }
}

// ---- directions ----------------------------------------------------------------------------------------------------
typedef struct choice {
    const fe__cores *cores;
    fe_dvec3 found; // direction and separation that the search found
    double least;   // separation that is as good
    fe__touch *touch;
} choice;

static double separation_along(const fe__cores *cores, fe_dvec3 n)
{
    return -fe__ddot(n, fe__cores_support(cores, n).difference) - (double)cores->a->radius - (double)cores->b->radius;
}

// 1: it is the normal
static int32_t takes(const choice *c, fe_dvec3 direction)
{
    double square = fe__ddot(direction, direction);
    if (!(square > 1e-12)) return 0;
    fe_dvec3 n = fe__dscale((fe__ddot(direction, c->found) < 0.0 ? -1.0 : 1.0) / sqrt(square), direction);
    if (fe__ddot(n, c->found) < (double)FE_FACE_COS) return 0;
    double separation = separation_along(c->cores, n);
    if (separation < c->least) return 0;
    c->touch->normal = fe__narrow(n);
    c->touch->separation = (float)separation;
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
static void place_crossing(const fe__cores *c, fe__touch *touch)
{
    fe_dvec3 p = c->position, e = c->axis_y, n = fe__widen(touch->normal);
    double across = e.x * e.x + e.z * e.z, t = -(p.x * e.x + p.z * e.z) / across, s = p.y + t * e.y;
    if (fe__absd(s) > (double)fe__maxf(c->a->half.y, c->a->half_height) ||
        fe__absd(t) > (double)fe__maxf(c->b->half.y, c->b->half_height))
        return;
    fe_dvec3 on_a = {0.0, s, 0.0}, on_b = fe__dadd(p, fe__dscale(t, e));
    if (fe__form_is_curved(c->a)) on_a = fe__dadd(on_a, fe__dscale((double)c->a->half.x, n));
    if (fe__form_is_curved(c->b)) on_b = fe__dsub(on_b, fe__dscale((double)c->b->half.x, n));
    touch->on_a = fe__narrow(on_a), touch->on_b = fe__narrow(on_b);
}

// Of the face that looks along the direction found, or against it, A's frame
static fe_dvec3 hull_face_normal(const fe__cores *c, int32_t is_b, fe_dvec3 found)
{
    if (!is_b) return fe__hull_unit_normal(c->a->hull, fe__hull_facing(c->a->hull, found));
    fe_dvec3 in_b = {-fe__ddot(c->axis_x, found), -fe__ddot(c->axis_y, found), -fe__ddot(c->axis_z, found)};
    fe_dvec3 n = fe__hull_unit_normal(c->b->hull, fe__hull_facing(c->b->hull, in_b));
    return fe__dadd(fe__dadd(fe__dscale(n.x, c->axis_x), fe__dscale(n.y, c->axis_y)), fe__dscale(n.z, c->axis_z));
}

int32_t fe__sharpen(const fe__cores *cores, fe__touch *touch)
{
    const fe__form *forms[2] = {cores->a, cores->b};
    const fe_dvec3 axes[2][3] = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}},
                                 {cores->axis_x, cores->axis_y, cores->axis_z}};
    float tie = fe__tie(fe__minf(fe__form_thickness(cores->a), fe__form_thickness(cores->b)));
    choice c = {cores, fe__widen(touch->normal), (double)(touch->separation - tie), touch};
    for (int32_t i = 0; i < 2; ++i) { // faces
        if (fe__form_is_curved(forms[i]) && takes(&c, axes[i][1])) return 1;
        if (fe__form_is_hull(forms[i])) {
            fe_dvec3 n = hull_face_normal(cores, i, c.found);
            if (takes(&c, n)) return 1;
        }
        for (int32_t k = 0; k < 3 && fe__form_has_flat_faces(forms[i]); ++k)
            if (takes(&c, axes[i][k])) return 1;
    }
    if (is_long(forms[0]) && is_long(forms[1]) && takes(&c, fe__dcross(axes[0][1], axes[1][1]))) {
        place_crossing(cores, touch);
        return 0;
    }
    for (int32_t i = 0; i < 2; ++i) // sides
        if (fe__form_is_curved(forms[i]) &&
            takes(&c, side_normal(forms[i], axes[i][1], i ? fe__dscale(-1.0, c.found) : c.found)))
            return 0;
    return 0;
}
