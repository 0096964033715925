// triangle.c - one of a heightfield or a mesh: three vertices, turning left around the side that counts.
#include "collision/form/kinds.h"

fe__bounds fe__triangle_bounds(const fe__form *form, const fe__pose *pose)
{
    fe_dvec3 p = fe__drotate(pose->rotation, fe__widen(form->vertex[0])), low = p, high = p;
    for (int32_t i = 1; i < 3; ++i) {
        p = fe__drotate(pose->rotation, fe__widen(form->vertex[i]));
        low = (fe_dvec3){fe__mind(low.x, p.x), fe__mind(low.y, p.y), fe__mind(low.z, p.z)};
        high = (fe_dvec3){fe__maxd(high.x, p.x), fe__maxd(high.y, p.y), fe__maxd(high.z, p.z)};
    }
    return (fe__bounds){fe__dadd(pose->position, low), fe__dadd(pose->position, high)};
}

float fe__triangle_reach(const fe__form *form, fe_vec3 centre)
{
    float reach = 0.0f;
    for (int32_t i = 0; i < 3; ++i) reach = fe__maxf(reach, fe__length(fe__sub(form->vertex[i], centre)));
    return reach;
}

// of equally far vertices the first
fe_dvec3 fe__triangle_support(const fe__form *form, fe_dvec3 direction)
{
    const fe_vec3 *vertex = form->vertex;
    fe_dvec3 far = fe__widen(vertex[0]);
    for (int32_t i = 1; i < 3; ++i) {
        fe_dvec3 p = fe__widen(vertex[i]);
        if (fe__ddot(p, direction) > fe__ddot(far, direction)) far = p;
    }
    return far;
}

// the side that looks along the direction: turned round, its vertices run the other way
void fe__triangle_face(const fe__form *triangle, fe_vec3 direction, fe__face *face)
{
    const fe_vec3 *v = triangle->vertex;
    fe_vec3 n = fe__cross(fe__sub(v[1], v[0]), fe__sub(v[2], v[0]));
    int32_t turned = fe__dot(n, direction) < 0.0f;
    face->count = 3;
    face->normal = fe__scale((turned ? -1.0f : 1.0f) / fe__length(n), n);
    face->id = (uint32_t)turned;
    for (int32_t i = 0; i < 3; ++i) face->vertex[i] = v[turned ? 2 - i : i];
}
