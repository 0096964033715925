// round.c - the traits of sphere, capsule, cylinder and cone (form_table.c), and the circle that the last two share.
#include "collision/form/form_kinds.h"

// ---- sphere ---------------------------------------------------------------------------------------------------------
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

// ---- capsule --------------------------------------------------------------------------------------------------------
// A capsule is a cylinder of length 2h and two half balls. A half ball's centre of mass is 3r/8 beyond the flat side,
// so that about the capsule's centre, by Steiner, both together have  m (2/5 r^2 + h^2 + 3/4 h r)  across the axis.
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

// ---- cylinder -------------------------------------------------------------------------------------------------------
// half.y is half the height, along y; half.x = half.z is the radius.

// m = rho pi r^2 2h,  along the axis m r^2 / 2,  across it m (r^2 / 4 + h^2 / 3)
fe__mass fe__cylinder_mass(const fe__form *form, double density)
{
    double r = (double)form->half.x, h = (double)form->half.y, rr = r * r;
    double mass = density * (double)FE_PI * rr * 2.0 * h;
    float along = (float)(0.5 * mass * rr), across = (float)(mass * (0.25 * rr + h * h / 3.0));
    return (fe__mass){.mass = (float)mass, .inertia = {across, along, across}};
}

// The half width along a world axis that has the components (x, y, z) on the cylinder's axes: |y| h + sqrt(1 - y^2) r.
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

// The disc at one end or, if the direction points more across the axis than along it, the line on that side.
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

// ---- cone -----------------------------------------------------------------------------------------------------------
// The tip is at +half.y, the base at -half.y along y; half.x = half.z is the base's radius.

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

// The interval along a world axis that tip and base circle cover; (x, y, z) are as above, `at` is the cone's position.
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

// The radius of the ball about the origin that touches the side, r h / sqrt(r^2 + 4 h^2); the base is farther.
float fe__cone_thickness(const fe__form *form)
{
    float r = form->half.x, h = form->half.y;
    return r * h / sqrtf(r * r + 4.0f * h * h);
}

// The cone is scaled about the origin. Side and base are a thickness away from there, or more.
fe__form fe__cone_shrunk(const fe__form *form, float by)
{
    fe__form thin = *form;
    thin.half = fe__scale(1.0f - by / fe__cone_thickness(form), form->half);
    return thin;
}

// The tip if h d.y > r |d across| - h d.y, else a point of the rim.
fe_dvec3 fe__cone_support(const fe__form *form, fe_dvec3 direction)
{
    double r = (double)form->half.x, h = (double)form->half.y,
           across = sqrt(direction.x * direction.x + direction.z * direction.z);
    if (2.0 * h * direction.y > r * across) return (fe_dvec3){0.0, h, 0.0};
    return fe__rim_support(form->half.x, -h, direction);
}

// The base, or the line on the side that looks that way. The choice changes halfway between the base's normal and the
// side's.
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

// ---- rim ------------------------------------------------------------------------------------------------------------
// The circle about the y axis that ends a cylinder or a cone.

// Row 0 stands at steps of 22.5 degrees; C1, C2, C3 are the cosines of 22.5, 45 and 67.5 degrees. Row 1 is an aimed
// rim: 0 and 6 degrees, seven sectors of 174 / 7 degrees to 180 and 186, and as many back.
// clang-format off
#define C1 0.92387953f
#define C2 0.70710678f
#define C3 0.38268343f
const float fe__rim_points[2][FE_RIM_POINTS][2] = {
    {{ 1,   0}, { C1,  C3}, { C2,  C2}, { C3,  C1}, {0,  1}, {-C3,  C1}, {-C2,  C2}, {-C1,  C3},
     {-1,   0}, {-C1, -C3}, {-C2, -C2}, {-C3, -C1}, {0, -1}, { C3, -C1}, { C2, -C2}, { C1, -C3}},
    {{ 1,   0},                     { 0.99452190f,  0.10452846f}, { 0.85844879f,  0.51289928f},
     { 0.56332006f,  0.82623877f},  { 0.16381791f,  0.98649059f}, {-0.26603685f,  0.96396286f},
     {-0.64659960f,  0.76282957f},  {-0.90735869f,  0.42035723f},
     {-1,   0},                     {-0.99452190f, -0.10452846f}, {-0.85844879f, -0.51289928f},
     {-0.56332006f, -0.82623877f},  {-0.16381791f, -0.98649059f}, { 0.26603685f, -0.96396286f},
     { 0.64659960f, -0.76282957f},  { 0.90735869f, -0.42035723f}}};
// clang-format on
// The first point of an aimed rim stands 3 degrees beside the aim.
#define AIMED_COS 0.99862953f
#define AIMED_SIN 0.05233596f

// A rim lies flat if its lowest point is no farther below its centre than this, m, and than this share of the radius.
// It is a twentieth of the solver's slop of 5 mm.
#define LEVEL 0.00025f
#define LEVEL_SHARE 0.005f

fe_dvec3 fe__rim_support(float radius, double y, fe_dvec3 direction)
{
    double square = direction.x * direction.x + direction.z * direction.z;
    if (!(square > 0.0)) return (fe_dvec3){0.0, y, 0.0};
    double scale = (double)radius / sqrt(square);
    return (fe_dvec3){scale * direction.x, y, scale * direction.z};
}

// An angle about y, from x to z.
typedef struct angle {
    float cosine, sine;
} angle;

// Does the load lean over half of the radius or more, and does the rim lean that way too, or not at all? The square of
// points that stay with the body holds a load that leans less. `drop` is how far the rim's lowest point, at `low`, is
// below its centre, m.
static int32_t is_aimed(float radius, float drop, angle low, const fe_vec3 *foot, angle *aim)
{
    const float leans = 0.5f, same_way = 0.9f; // share of the radius; cosine
    if (!foot) return 0;
    float away = sqrtf(foot->x * foot->x + foot->z * foot->z);
    if (!(away > leans * radius)) return 0;
    *aim = (angle){foot->x / away, foot->z / away};
    if (!(drop > fe__minf(LEVEL, LEVEL_SHARE * radius))) return 1;
    return drop <= fe__most_lean(radius) && aim->cosine * low.cosine + aim->sine * low.sine > same_way;
}

// A disc gives some points of its rim. At equal angles, the first along x, they stay with the body, so that a body that
// stands keeps its contacts; but if the disc leans, they turn so that one of them is the deepest point. All turn left
// around the normal: against the sense from x to z if it looks up.
void fe__rim_face(float radius, float y, fe_vec3 direction, fe__face *face)
{
    float across = sqrtf(direction.x * direction.x + direction.z * direction.z),
          drop = radius * across / fe__length(direction), left = y > 0.0f ? -1.0f : 1.0f;
    const float(*points)[2] = fe__rim_points[0];
    angle low = {0.0f, 0.0f}, first = {1.0f, 0.0f}, aim;
    int32_t nearest = 0;
    face->pattern = FE_RIM_LIES;
    if (drop > fe__minf(LEVEL, LEVEL_SHARE * radius)) {
        face->pattern = FE_RIM_LEANS;
        low = (angle){direction.x / across, direction.z / across};
        float most = -2.0f;
        for (int32_t i = 0; i < FE_RIM_POINTS; ++i) {
            float along = low.cosine * points[i][0] + left * low.sine * points[i][1];
            if (along > most) most = along, nearest = i;
        }
        const float *p = points[nearest];
        first = (angle){low.cosine * p[0] + left * low.sine * p[1], low.sine * p[0] - left * low.cosine * p[1]};
    }
    if (is_aimed(radius, drop, low, face->foot, &aim)) {
        face->pattern = FE_RIM_AIMED, points = fe__rim_points[1], nearest = 0;
        first = (angle){aim.cosine * AIMED_COS + left * aim.sine * AIMED_SIN,
                        aim.sine * AIMED_COS - left * aim.cosine * AIMED_SIN};
    }
    face->count = FE_RIM_POINTS;
    face->normal = fe__vec3(0.0f, -left, 0.0f);
    face->id = y > 0.0f ? 2u : 1u;
    face->rim = radius;
    face->low = nearest;
    for (int32_t i = 0; i < FE_RIM_POINTS; ++i) {
        float c = points[i][0], s = left * points[i][1];
        face->vertex[i] =
            fe__vec3(radius * (first.cosine * c - first.sine * s), y, radius * (first.cosine * s + first.sine * c));
    }
}
