// support.c - support points and faces of the cores; see support.h.
#include "collision/form/support.h"

// of equally far vertices the first
static fe_dvec3 triangle_support(const fe_vec3 vertex[3], fe_dvec3 direction)
{
    fe_dvec3 far = fe__widen(vertex[0]);
    for (int32_t i = 1; i < 3; ++i) {
        fe_dvec3 p = fe__widen(vertex[i]);
        if (fe__ddot(p, direction) > fe__ddot(far, direction)) far = p;
    }
    return far;
}

fe_dvec3 fe__form_support(const fe__form *form, fe_dvec3 direction)
{
    fe_dvec3 half = fe__widen(form->half);
    switch (form->type) {
    case FE__FORM_BOX:
        return (fe_dvec3){direction.x < 0.0 ? -half.x : half.x, direction.y < 0.0 ? -half.y : half.y, direction.z < 0.0 ? -half.z : half.z};
    case FE__FORM_CAPSULE:
        return (fe_dvec3){0.0, (double)(direction.y < 0.0 ? -form->half_height : form->half_height), 0.0};
    case FE__FORM_TRIANGLE:
        return triangle_support(form->vertex, direction);
    default:
        return (fe_dvec3){0.0, 0.0, 0.0};
    }
}

// Corners in turn around the outward axis; of equal axes the lowest.
static void box_face(const fe__form *box, fe_vec3 direction, fe__face *face)
{
    const float d[3] = {direction.x, direction.y, direction.z}, half[3] = {box->half.x, box->half.y, box->half.z};
    int32_t k = 0;
    for (int32_t i = 1; i < 3; ++i) {
        if (fe__absf(d[i]) > fe__absf(d[k])) k = i;
    }
    int32_t u = (k + 1) % 3, v = (k + 2) % 3;
    float side = d[k] < 0.0f ? -1.0f : 1.0f, normal[3] = {0.0f, 0.0f, 0.0f};
    normal[k] = side;
    face->count = 4;
    face->normal = fe__vec3(normal[0], normal[1], normal[2]);
    face->id = (uint32_t)(2 * k + (side > 0.0f));
    for (int32_t i = 0; i < 4; ++i) {
        float su = i == 1 || i == 2 ? 1.0f : -1.0f, sv = i >= 2 ? side : -side, p[3];
        p[k] = side * half[k], p[u] = su * half[u], p[v] = sv * half[v];
        face->vertex[i] = fe__vec3(p[0], p[1], p[2]);
    }
}

// the side that looks along the direction: turned round, its vertices run the other way
static void triangle_face(const fe__form *triangle, fe_vec3 direction, fe__face *face)
{
    const fe_vec3 *v = triangle->vertex;
    fe_vec3 n = fe__cross(fe__sub(v[1], v[0]), fe__sub(v[2], v[0]));
    int32_t turned = fe__dot(n, direction) < 0.0f;
    face->count = 3;
    face->normal = fe__scale((turned ? -1.0f : 1.0f) / fe__length(n), n);
    face->id = (uint32_t)turned;
    for (int32_t i = 0; i < 3; ++i) face->vertex[i] = v[turned ? 2 - i : i];
}

void fe__form_face(const fe__form *form, fe_vec3 direction, fe__face *face)
{
    face->normal = fe__vec3(0.0f, 0.0f, 0.0f);
    face->id = 0;
    switch (form->type) {
    case FE__FORM_BOX:
        box_face(form, direction, face);
        return;
    case FE__FORM_CAPSULE:
        face->count = 2;
        face->vertex[0] = fe__vec3(0.0f, -form->half_height, 0.0f);
        face->vertex[1] = fe__vec3(0.0f, form->half_height, 0.0f);
        return;
    case FE__FORM_TRIANGLE:
        triangle_face(form, direction, face);
        return;
    default:
        face->count = 1;
        face->vertex[0] = fe__vec3(0.0f, 0.0f, 0.0f);
    }
}
