// capsule.c - the capsule: half_height of its axis, along y, and radius.
#include "collision/form/kinds.h"

// A cylinder of length 2h and two half balls. A half ball's centre of mass is 3r/8 beyond the flat side, so that about
// the capsule's centre, by Steiner, both together have  m (2/5 r^2 + h^2 + 3/4 h r)  across the axis.
fe__mass fe__capsule_mass(const fe__form *form, double density)
{
    double r = (double)form->radius, h = (double)form->half_height, rr = r * r;
    double cylinder = density * (double)FE_PI * rr * 2.0 * h;
    double ball = density * (4.0 / 3.0) * (double)FE_PI * rr * r;
    float along = (float)(cylinder * 0.5 * rr + ball * 0.4 * rr);
    float across = (float)(cylinder * (0.25 * rr + h * h / 3.0) + ball * (0.4 * rr + h * h + 0.75 * h * r));
    return (fe__mass){.mass = (float)(cylinder + ball), .inertia = {across, along, across}};
}

fe_dvec3 fe__capsule_support(const fe__form *form, fe_dvec3 direction)
{
    return (fe_dvec3){0.0, (double)(direction.y < 0.0 ? -form->half_height : form->half_height), 0.0};
}

void fe__capsule_face(const fe__form *form, fe_vec3 direction, fe__face *face)
{
    (void)direction;
    face->count = 2;
    face->normal = fe__vec3(0.0f, 0.0f, 0.0f);
    face->vertex[0] = fe__vec3(0.0f, -form->half_height, 0.0f);
    face->vertex[1] = fe__vec3(0.0f, form->half_height, 0.0f);
    face->id = 0;
}
