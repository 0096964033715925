// cone.c - the cone: its tip at +half.y, its base at -half.y along y, the base's radius half.x = half.z.
#include "collision/form/kinds.h"

// With the height H = 2h: m = rho pi r^2 H / 3, the centre H / 4 above the base; along the axis 3/10 m r^2, across it,
// about that centre, 3/20 m r^2 + 3/80 m H^2.
fe__mass fe__cone_mass(const fe__form *form, double density)
{
    double r = (double)form->half.x, h = (double)form->half.y, rr = r * r;
    double mass = density * (double)FE_PI * rr * (2.0 / 3.0) * h;
    float along = (float)(0.3 * mass * rr), across = (float)(0.15 * mass * (rr + h * h));
    return (fe__mass){.mass = (float)mass,
                      .inertia = {across, along, across},
                      .centre = {0.0f, -0.5f * form->half.y, 0.0f}};
}

// The tip's coordinate and the base circle's span
static void span(double x, double y, double z, const fe__form *form, double at, double *low, double *high)
{
    double tip = y * (double)form->half.y, rim = sqrt(x * x + z * z) * (double)form->half.x;
    *low = at + fe__mind(tip, -tip - rim);
    *high = at + fe__maxd(tip, -tip + rim);
}

fe__bounds fe__cone_bounds(const fe__form *form, const fe__pose *pose)
{
    fe_dvec3 x = fe__drotate(pose->rotation, (fe_dvec3){1.0, 0.0, 0.0}),
             y = fe__drotate(pose->rotation, (fe_dvec3){0.0, 1.0, 0.0}), z = fe__dcross(x, y), p = pose->position;
    fe__bounds bounds;
    span(x.x, y.x, z.x, form, p.x, &bounds.low.x, &bounds.high.x);
    span(x.y, y.y, z.y, form, p.y, &bounds.low.y, &bounds.high.y);
    span(x.z, y.z, z.z, form, p.z, &bounds.low.z, &bounds.high.z);
    return bounds;
}

float fe__cone_reach(const fe__form *form, fe_vec3 centre)
{
    float aside = sqrtf(centre.x * centre.x + centre.z * centre.z), to_tip = form->half.y - centre.y,
          to_base = form->half.y + centre.y, to_rim = aside + form->half.x;
    return fe__maxf(sqrtf(aside * aside + to_tip * to_tip), sqrtf(to_rim * to_rim + to_base * to_base));
}

// The ball about the origin that touches the side, r h / sqrt(r^2 + 4 h^2); the base is farther
float fe__cone_thickness(const fe__form *form)
{
    float r = form->half.x, h = form->half.y;
    return r * h / sqrtf(r * r + 4.0f * h * h);
}

// scaled about the origin, from which side and base are a thickness away, or more
fe__form fe__cone_shrunk(const fe__form *form, float by)
{
    fe__form thin = *form;
    thin.half = fe__scale(1.0f - by / fe__cone_thickness(form), form->half);
    return thin;
}

// The tip, where h d.y >= r |d across| - h d.y; else the rim
fe_dvec3 fe__cone_support(const fe__form *form, fe_dvec3 direction)
{
    double r = (double)form->half.x, h = (double)form->half.y,
           across = sqrt(direction.x * direction.x + direction.z * direction.z);
    if (2.0 * h * direction.y > r * across) return (fe_dvec3){0.0, h, 0.0};
    return fe__rim_support(form->half.x, -h, direction);
}

// The base, or the line on the side that looks that way: halfway between the base's normal and the side's they meet.
void fe__cone_face(const fe__form *form, fe_vec3 direction, fe__face *face)
{
    float across = sqrtf(direction.x * direction.x + direction.z * direction.z), r = form->half.x, h = form->half.y;
    float along_side = (2.0f * h * across + r * direction.y) / sqrtf(r * r + 4.0f * h * h);
    if (!(along_side > -direction.y)) {
        fe__rim_face(r, -h, direction, face);
        return;
    }
    float scale = across > 0.0f ? r / across : 0.0f;
    face->count = 2;
    face->normal = fe__vec3(0.0f, 0.0f, 0.0f);
    face->vertex[0] = across > 0.0f ? fe__vec3(scale * direction.x, -h, scale * direction.z) : fe__vec3(r, -h, 0.0f);
    face->vertex[1] = fe__vec3(0.0f, h, 0.0f);
    face->id = 0;
}
