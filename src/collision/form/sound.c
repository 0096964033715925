// sound.c - see sound.h.
#include "collision/form/sound.h"

#include "core/ranges.h"

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

static int32_t is_length(float x) { return x >= FE_LEAST_LENGTH && x <= FE_MAX_LENGTH; }
static int32_t is_half(float x) { return x >= 0.5f * FE_LEAST_LENGTH && x <= FE_MAX_LENGTH; }
static int32_t are_zero(float x, float y, float z) { return x == 0.0f && y == 0.0f && z == 0.0f; }
static int32_t has_half(const fe__form *f) { return is_half(f->half.x) && is_half(f->half.y) && is_half(f->half.z); }

int32_t fe__form_is_sound(const fe__form *f)
{
    int32_t plain = are_zero(f->normal.x, f->normal.y, f->normal.z) && f->distance == 0.0f;
    int32_t round = are_zero(f->half.x, f->half.y, f->half.z) && plain, solid = f->half_height == 0.0f && plain;
    fe_dvec3 n = fe__widen(f->normal);
    switch (f->type) {
    case FE__FORM_SPHERE:
        return is_length(f->radius) && f->half_height == 0.0f && round;
    case FE__FORM_CAPSULE:
        return is_length(f->radius) && is_half(f->half_height) && round;
    case FE__FORM_BOX:
        return has_half(f) && f->radius == 0.0f && solid;
    case FE__FORM_CYLINDER:
    case FE__FORM_CONE:
        return has_half(f) && f->half.x == f->half.z && f->radius == 0.0f && solid;
    case FE__FORM_PLANE:
        return fe__absd(fe__ddot(n, n) - 1.0) < 1e-6 && fe__absf(f->distance) <= FE_MAX_LOCAL && f->radius == 0.0f &&
               f->half_height == 0.0f && are_zero(f->half.x, f->half.y, f->half.z);
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
