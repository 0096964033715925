// sphere.c - the ball: radius.
#include "collision/form/kinds.h"

fe__mass fe__sphere_mass(const fe__form *form, double density)
{
    double r = (double)form->radius, mass = density * (4.0 / 3.0) * (double)FE_PI * r * r * r;
    float inertia = (float)(0.4 * mass * r * r);
    return (fe__mass){.mass = (float)mass, .inertia = {inertia, inertia, inertia}};
}

fe__bounds fe__sphere_bounds(const fe__form *form, const fe__pose *pose)
{
    double r = (double)form->radius;
    fe_dvec3 half = {r, r, r};
    return (fe__bounds){fe__dsub(pose->position, half), fe__dadd(pose->position, half)};
}
