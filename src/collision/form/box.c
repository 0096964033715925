// box.c - the box: half extents.
#include "collision/form/kinds.h"

fe__mass fe__box_mass(const fe__form *form, double density)
{
    fe_dvec3 h = fe__widen(form->half);
    double mass = density * 8.0 * h.x * h.y * h.z, third = mass / 3.0;
    double xx = h.x * h.x, yy = h.y * h.y, zz = h.z * h.z;
    return (fe__mass){.mass = (float)mass,
                      .inertia = {(float)(third * (yy + zz)), (float)(third * (xx + zz)), (float)(third * (xx + yy))}};
}

float fe__box_thickness(const fe__form *form) { return fe__minf(form->half.x, fe__minf(form->half.y, form->half.z)); }

fe__form fe__box_shrunk(const fe__form *form, float by)
{
    fe__form thin = *form;
    thin.half = fe__sub(form->half, fe__vec3(by, by, by));
    return thin;
}

fe_dvec3 fe__box_support(const fe__form *form, fe_dvec3 direction)
{
    fe_dvec3 half = fe__widen(form->half);
    return (fe_dvec3){direction.x < 0.0 ? -half.x : half.x, direction.y < 0.0 ? -half.y : half.y,
                      direction.z < 0.0 ? -half.z : half.z};
}

// Corners in turn around the outward axis; of equal axes the lowest.
void fe__box_face(const fe__form *box, fe_vec3 direction, fe__face *face)
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
