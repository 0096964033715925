// form.c - traits that several kinds of forms share (form_table.c), and the check of forms that come from bytes.
#include "collision/form/form.h"

#include "collision/form/form_kinds.h"
#include "core/bytes.h"

#include <float.h>

// ---- shared traits --------------------------------------------------------------------------------------------------

fe__mass fe__no_mass(const fe__form *form, double density)
{
    (void)form, (void)density;
    return (fe__mass){.mass = 0.0f};
}

float fe__no_reach(const fe__form *form, fe_vec3 centre)
{
    (void)form, (void)centre;
    return 0.0f;
}

float fe__no_thickness(const fe__form *form)
{
    (void)form;
    return FLT_MAX;
}

// |R| half, the half widths along the world's axes of a box rotated by q: R = 1 + k (...), k = 2 / q.q, so that any
// length of q will do.
fe_dvec3 fe__rotated_widths(fe_quat q, fe_dvec3 half)
{
    double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w,
           k = 2.0 / (x * x + y * y + z * z + w * w);
    double xx = k * x * x, yy = k * y * y, zz = k * z * z, xy = k * x * y, xz = k * x * z, yz = k * y * z;
    double wx = k * w * x, wy = k * w * y, wz = k * w * z;
    return (fe_dvec3){fe__absd(1.0 - yy - zz) * half.x + fe__absd(xy - wz) * half.y + fe__absd(xz + wy) * half.z,
                      fe__absd(xy + wz) * half.x + fe__absd(1.0 - xx - zz) * half.y + fe__absd(yz - wx) * half.z,
                      fe__absd(xz - wy) * half.x + fe__absd(yz + wx) * half.y + fe__absd(1.0 - xx - yy) * half.z};
}

// `half` is 0 but for a box, `half_height` is 0 but for a capsule: the core's box has the sum of both.
fe__bounds fe__core_bounds(const fe__form *form, const fe__pose *pose)
{
    fe_dvec3 half = fe__widen(form->half), p = pose->position;
    half.y += (double)form->half_height;
    half = fe__rotated_widths(pose->rotation, half);
    double r = (double)form->radius;
    half = (fe_dvec3){half.x + r, half.y + r, half.z + r};
    return (fe__bounds){fe__dsub(p, half), fe__dadd(p, half)};
}

float fe__core_reach(const fe__form *form, fe_vec3 centre)
{
    fe_vec3 far = {fe__absf(centre.x) + form->half.x, fe__absf(centre.y) + form->half.y + form->half_height,
                   fe__absf(centre.z) + form->half.z};
    return fe__length(far) + form->radius;
}

float fe__radius_of(const fe__form *form) { return form->radius; }

fe__form fe__less_radius(const fe__form *form, float by)
{
    fe__form thin = *form;
    thin.radius -= by;
    return thin;
}

fe_dvec3 fe__point_support(const fe__form *form, fe_dvec3 direction)
{
    (void)form, (void)direction;
    return (fe_dvec3){0.0, 0.0, 0.0};
}

void fe__point_face(const fe__form *form, fe_vec3 direction, fe__face *face)
{
    (void)form, (void)direction;
    face->count = 1;
    face->normal = face->vertex[0] = fe__vec3(0.0f, 0.0f, 0.0f);
    face->id = 0;
}

// ---- validation -----------------------------------------------------------------------------------------------------

fe__form_numbers fe__numbers_of_form(const fe__form *form)
{
    fe__form_numbers numbers = {.kind = form->type};
    if (fe__form_has_asset(form)) return numbers;
    numbers.radius = form->radius, numbers.half_height = form->half_height, numbers.distance = form->distance;
    numbers.half = form->half, numbers.normal = form->normal;
    return numbers;
}

fe__form fe__form_of_numbers(const fe__form_numbers *numbers)
{
    fe__form form = {.type = numbers->kind, .radius = numbers->radius};
    if (fe__form_has_asset(&form)) return form;
    form.half_height = numbers->half_height, form.distance = numbers->distance;
    form.half = numbers->half, form.normal = numbers->normal;
    return form;
}

static int32_t is_half_width(float x) { return x >= 0.5f * FE_LEAST_LENGTH && x <= FE_MAX_LENGTH; }

// Each kind needs its own fields within the API's ranges, and 0 in all others.
int32_t fe__form_is_sound(const fe__form *f)
{
    int32_t no_radius = f->radius == 0.0f, no_height = f->half_height == 0.0f, no_distance = f->distance == 0.0f;
    int32_t no_half = f->half.x == 0.0f && f->half.y == 0.0f && f->half.z == 0.0f;
    int32_t no_normal = f->normal.x == 0.0f && f->normal.y == 0.0f && f->normal.z == 0.0f;
    int32_t has_radius = f->radius >= FE_LEAST_LENGTH && f->radius <= FE_MAX_LENGTH;
    int32_t has_half = is_half_width(f->half.x) && is_half_width(f->half.y) && is_half_width(f->half.z);
    fe_dvec3 n = fe__widen(f->normal);
    switch (f->type) {
    case FE__FORM_SPHERE:
        return has_radius && no_height && no_half && no_normal && no_distance;
    case FE__FORM_CAPSULE:
        return has_radius && is_half_width(f->half_height) && no_half && no_normal && no_distance;
    case FE__FORM_BOX:
        return has_half && no_radius && no_height && no_normal && no_distance;
    case FE__FORM_CYLINDER:
    case FE__FORM_CONE:
        return has_half && f->half.x == f->half.z && no_radius && no_height && no_normal && no_distance;
    case FE__FORM_PLANE:
        return fe__absd(fe__ddot(n, n) - 1.0) < 1e-6 && fe__absf(f->distance) <= FE_MAX_LOCAL && no_radius &&
               no_height && no_half;
    default:
        return 0;
    }
}

int32_t fe__forms_are_same(const fe__form *a, const fe__form *b)
{
    if (a->type != b->type) return 0;
    if (fe__form_has_asset(a)) return a->field == b->field;
    return a->radius == b->radius && a->half_height == b->half_height && a->distance == b->distance &&
           a->half.x == b->half.x && a->half.y == b->half.y && a->half.z == b->half.z && a->normal.x == b->normal.x &&
           a->normal.y == b->normal.y && a->normal.z == b->normal.z;
}
