// form.c - mass, bounds and sizes of the forms.
//
// Input: a form and, for the bounds, its pose. Read by the world: masses when shapes change, bounds each step, reach and thickness for
// sleep and continuous collision. Computed in double and rounded once.
#include "collision/form/form.h"

#include <float.h>

static fe__mass sphere_mass(const fe__form *form, double density)
{
    double r = (double)form->radius, mass = density * (4.0 / 3.0) * (double)FE_PI * r * r * r;
    float inertia = (float)(0.4 * mass * r * r);
    return (fe__mass){(float)mass, {inertia, inertia, inertia}};
}

// A cylinder of length 2h and two half balls. A half ball's centre of mass is 3r/8 beyond the flat side, so that about the capsule's
// centre, by Steiner, both together have  m (2/5 r^2 + h^2 + 3/4 h r)  across the axis.
static fe__mass capsule_mass(const fe__form *form, double density)
{
    double r = (double)form->radius, h = (double)form->half_height, rr = r * r;
    double cylinder = density * (double)FE_PI * rr * 2.0 * h;
    double ball = density * (4.0 / 3.0) * (double)FE_PI * rr * r;
    float along = (float)(cylinder * 0.5 * rr + ball * 0.4 * rr);
    float across = (float)(cylinder * (0.25 * rr + h * h / 3.0) + ball * (0.4 * rr + h * h + 0.75 * h * r));
    return (fe__mass){(float)(cylinder + ball), {across, along, across}};
}

static fe__mass box_mass(const fe__form *form, double density)
{
    fe_dvec3 h = fe__widen(form->half);
    double mass = density * 8.0 * h.x * h.y * h.z, third = mass / 3.0;
    double xx = h.x * h.x, yy = h.y * h.y, zz = h.z * h.z;
    return (fe__mass){(float)mass, {(float)(third * (yy + zz)), (float)(third * (xx + zz)), (float)(third * (xx + yy))}};
}

fe__mass fe__form_mass(const fe__form *form, float density)
{
    switch (form->type) {
    case FE__FORM_SPHERE:
        return sphere_mass(form, (double)density);
    case FE__FORM_CAPSULE:
        return capsule_mass(form, (double)density);
    case FE__FORM_BOX:
        return box_mass(form, (double)density);
    default:
        return (fe__mass){0.0f, {0.0f, 0.0f, 0.0f}};
    }
}

static fe__bounds everywhere(void)
{
    double inf = (double)INFINITY;
    return (fe__bounds){{-inf, -inf, -inf}, {inf, inf, inf}};
}

static fe__bounds plane_bounds(const fe__form *form, const fe__pose *pose)
{
    fe__bounds bounds = everywhere();
    fe_dvec3 n = fe__drotate(pose->rotation, fe__widen(form->normal)), p = pose->position;
    double d = (double)form->distance;
    if (n.y == 0.0 && n.z == 0.0) *(n.x > 0.0 ? &bounds.high.x : &bounds.low.x) = p.x + n.x * d;
    if (n.x == 0.0 && n.z == 0.0) *(n.y > 0.0 ? &bounds.high.y : &bounds.low.y) = p.y + n.y * d;
    if (n.x == 0.0 && n.y == 0.0) *(n.z > 0.0 ? &bounds.high.z : &bounds.low.z) = p.z + n.z * d;
    return bounds;
}

// |R| half, the half widths along the world's axes of a box turned by q: R = 1 + k (...), k = 2 / q.q, so that any length of q will do.
static fe_dvec3 turned_widths(fe_quat q, fe_dvec3 half)
{
    double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w, k = 2.0 / (x * x + y * y + z * z + w * w);
    double xx = k * x * x, yy = k * y * y, zz = k * z * z, xy = k * x * y, xz = k * x * z, yz = k * y * z;
    double wx = k * w * x, wy = k * w * y, wz = k * w * z;
    return (fe_dvec3){fe__absd(1.0 - yy - zz) * half.x + fe__absd(xy - wz) * half.y + fe__absd(xz + wy) * half.z,
                      fe__absd(xy + wz) * half.x + fe__absd(1.0 - xx - zz) * half.y + fe__absd(yz - wx) * half.z,
                      fe__absd(xz - wy) * half.x + fe__absd(yz + wx) * half.y + fe__absd(1.0 - xx - yy) * half.z};
}

static fe__bounds triangle_bounds(const fe__form *form, const fe__pose *pose)
{
    fe_dvec3 p = fe__drotate(pose->rotation, fe__widen(form->vertex[0])), low = p, high = p;
    for (int32_t i = 1; i < 3; ++i) {
        p = fe__drotate(pose->rotation, fe__widen(form->vertex[i]));
        low = (fe_dvec3){fe__mind(low.x, p.x), fe__mind(low.y, p.y), fe__mind(low.z, p.z)};
        high = (fe_dvec3){fe__maxd(high.x, p.x), fe__maxd(high.y, p.y), fe__maxd(high.z, p.z)};
    }
    return (fe__bounds){fe__dadd(pose->position, low), fe__dadd(pose->position, high)};
}

// the turned box of its own bounds
static fe__bounds heightfield_bounds(const fe__form *form, const fe__pose *pose)
{
    fe_dvec3 low = fe__widen(form->low), high = fe__widen(form->high), half = fe__dscale(0.5, fe__dsub(high, low));
    fe_dvec3 centre = fe__dadd(pose->position, fe__drotate(pose->rotation, fe__dscale(0.5, fe__dadd(low, high))));
    half = turned_widths(pose->rotation, half);
    return (fe__bounds){fe__dsub(centre, half), fe__dadd(centre, half)};
}

fe__bounds fe__form_bounds(const fe__form *form, const fe__pose *pose)
{
    if (form->type == FE__FORM_PLANE) return plane_bounds(form, pose);
    if (form->type == FE__FORM_HEIGHTFIELD) return heightfield_bounds(form, pose);
    if (form->type == FE__FORM_TRIANGLE) return triangle_bounds(form, pose);
    // half is 0 but for a box, half_height is 0 but for a capsule: the core is the box of both
    fe_dvec3 half = fe__widen(form->half), p = pose->position;
    half.y += (double)form->half_height;
    if (form->type != FE__FORM_SPHERE) half = turned_widths(pose->rotation, half);
    double r = (double)form->radius;
    half = (fe_dvec3){half.x + r, half.y + r, half.z + r};
    return (fe__bounds){fe__dsub(p, half), fe__dadd(p, half)};
}

float fe__form_reach(const fe__form *form, fe_vec3 centre)
{
    if (form->type >= FE__FORM_PLANE) return 0.0f;
    fe_vec3 far = {fe__absf(centre.x) + form->half.x, fe__absf(centre.y) + form->half.y + form->half_height,
                   fe__absf(centre.z) + form->half.z};
    return fe__length(far) + form->radius;
}

float fe__form_thickness(const fe__form *form)
{
    switch (form->type) {
    case FE__FORM_BOX:
        return fe__minf(form->half.x, fe__minf(form->half.y, form->half.z));
    case FE__FORM_PLANE:
    case FE__FORM_HEIGHTFIELD:
        return FLT_MAX;
    default:
        return form->radius;
    }
}

// n . p <= d somewhere in the box
int32_t fe__plane_meets_box(const fe__form *plane, const fe__pose *pose, const fe__bounds *box)
{
    fe_dvec3 n = fe__drotate(pose->rotation, fe__widen(plane->normal));
    double d = fe__ddot(n, pose->position) + (double)plane->distance;
    fe_dvec3 low = {n.x > 0.0 ? box->low.x : box->high.x, n.y > 0.0 ? box->low.y : box->high.y, n.z > 0.0 ? box->low.z : box->high.z};
    return fe__ddot(n, low) <= d;
}
