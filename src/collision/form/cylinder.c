// cylinder.c - the cylinder: half.y of its height, along y, and half.x = half.z, its radius.
#include "collision/form/kinds.h"

// m = rho pi r^2 2h,  along the axis m r^2 / 2,  across it m (r^2 / 4 + h^2 / 3)
fe__mass fe__cylinder_mass(const fe__form *form, double density)
{
    double r = (double)form->half.x, h = (double)form->half.y, rr = r * r;
    double mass = density * (double)FE_PI * rr * 2.0 * h;
    float along = (float)(0.5 * mass * rr), across = (float)(mass * (0.25 * rr + h * h / 3.0));
    return (fe__mass){.mass = (float)mass, .inertia = {across, along, across}};
}

// Along a world axis that is inclined to the cylinder's, a its cosine: |a| h + sqrt(1 - a^2) r
static double width(double x, double y, double z, const fe__form *form)
{
    return fe__absd(y) * (double)form->half.y + sqrt(x * x + z * z) * (double)form->half.x;
}

fe__bounds fe__cylinder_bounds(const fe__form *form, const fe__pose *pose)
{
    fe_dvec3 x = fe__drotate(pose->rotation, (fe_dvec3){1.0, 0.0, 0.0}),
             y = fe__drotate(pose->rotation, (fe_dvec3){0.0, 1.0, 0.0}), z = fe__dcross(x, y);
    fe_dvec3 half = {width(x.x, y.x, z.x, form), width(x.y, y.y, z.y, form), width(x.z, y.z, z.z, form)};
    return (fe__bounds){fe__dsub(pose->position, half), fe__dadd(pose->position, half)};
}

float fe__cylinder_reach(const fe__form *form, fe_vec3 centre)
{
    float aside = sqrtf(centre.x * centre.x + centre.z * centre.z) + form->half.x,
          along = fe__absf(centre.y) + form->half.y;
    return sqrtf(aside * aside + along * along);
}

float fe__cylinder_thickness(const fe__form *form) { return fe__minf(form->half.x, form->half.y); }

fe_dvec3 fe__cylinder_support(const fe__form *form, fe_dvec3 direction)
{
    double h = (double)form->half.y;
    return fe__rim_support(form->half.x, direction.y < 0.0 ? -h : h, direction);
}

// A disc, or the line on the side that looks that way.
void fe__cylinder_face(const fe__form *form, fe_vec3 direction, fe__face *face)
{
    float across = sqrtf(direction.x * direction.x + direction.z * direction.z), h = form->half.y;
    if (!(across > fe__absf(direction.y))) {
        fe__rim_face(form->half.x, direction.y < 0.0f ? -h : h, direction, face);
        return;
    }
    float scale = form->half.x / across, x = scale * direction.x, z = scale * direction.z;
    face->count = 2;
    face->normal = fe__vec3(0.0f, 0.0f, 0.0f);
    face->vertex[0] = fe__vec3(x, -h, z);
    face->vertex[1] = fe__vec3(x, h, z);
    face->id = 0;
}
