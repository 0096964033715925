// flat.c - the traits of box, plane and triangle (form_table.c), and the questions to a solid (flat.h).
#include "collision/form/flat.h"

#include "collision/form/form.h"
#include "collision/form/form_kinds.h"
#include "collision/form/hull.h"

// ---- box ------------------------------------------------------------------------------------------------------------
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

// The corners turn left around the outward axis. If several axes are equally near the direction, the first one counts.
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

// ---- plane ----------------------------------------------------------------------------------------------------------
fe__bounds fe__plane_bounds(const fe__form *form, const fe__pose *pose)
{
    const double inf = (double)INFINITY;
    fe__bounds bounds = {{-inf, -inf, -inf}, {inf, inf, inf}};
    fe_dvec3 n = fe__drotate(pose->rotation, fe__widen(form->normal)), p = pose->position;
    double d = (double)form->distance;
    if (n.y == 0.0 && n.z == 0.0) *(n.x > 0.0 ? &bounds.high.x : &bounds.low.x) = p.x + n.x * d;
    if (n.x == 0.0 && n.z == 0.0) *(n.y > 0.0 ? &bounds.high.y : &bounds.low.y) = p.y + n.y * d;
    if (n.x == 0.0 && n.y == 0.0) *(n.z > 0.0 ? &bounds.high.z : &bounds.low.z) = p.z + n.z * d;
    return bounds;
}

// The box's corner that is lowest along n has n . p <= d + gap.
int32_t fe__plane_meets_box(const fe__form *plane, const fe__pose *pose, const fe__bounds *box, double gap)
{
    fe_dvec3 n = fe__drotate(pose->rotation, fe__widen(plane->normal));
    double d = fe__ddot(n, pose->position) + (double)plane->distance;
    fe_dvec3 low = {n.x > 0.0 ? box->low.x : box->high.x, n.y > 0.0 ? box->low.y : box->high.y,
                    n.z > 0.0 ? box->low.z : box->high.z};
    return fe__ddot(n, low) <= d + gap;
}

void fe__plane_move_frame(fe__form *plane, fe_quat rotation, fe_dvec3 away)
{
    fe_dvec3 normal = fe__drotate(rotation, fe__widen(plane->normal));
    plane->distance = (float)((double)plane->distance - fe__ddot(normal, away));
}

// ---- triangle -------------------------------------------------------------------------------------------------------

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
    float radius = 0.0f;
    for (int32_t i = 0; i < 3; ++i) radius = fe__maxf(radius, fe__length(fe__sub(form->vertex[i], centre)));
    return radius;
}

// If several vertices are equally far, the first one counts.
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

// The side that looks along the direction. The vertices of the lower side run the other way.
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

// ---- solid ----------------------------------------------------------------------------------------------------------
// A face is asked so far inside its rim, m, and at most this share of its half width. It is more than a flush gap and
// the depth to which a body sinks, and less than the lowest step that is felt.
#define INSIDE 0.0035f
#define INSIDE_SHARE 0.1f
// A vector is no face's normal if sin^2 of their angle is this or more: 2 seconds of arc.
#define LEANS 1e-10f

static fe_vec3 local_normal(const fe__form *form, int32_t face)
{
    if (fe__form_is_hull(form)) return fe__hull_normal(form->hull, face);
    float sign = face & 1 ? 1.0f : -1.0f;
    return fe__vec3(face / 2 == 0 ? sign : 0.0f, face / 2 == 1 ? sign : 0.0f, face / 2 == 2 ? sign : 0.0f);
}

// The height of the face's plane over the form's origin.
static float local_height(const fe__form *form, int32_t face)
{
    if (fe__form_is_hull(form))
        return fe__dot(fe__hull_normal(form->hull, face), form->offset) + form->scale * form->hull->distances[face];
    return face / 2 == 0 ? form->half.x : face / 2 == 1 ? form->half.y : form->half.z;
}

int32_t fe__solid_face_count(const fe__solid *s) { return fe__form_is_hull(s->form) ? s->form->hull->face_count : 6; }

fe_vec3 fe__solid_normal(const fe__solid *s, int32_t face) { return fe__mul(&s->axes, local_normal(s->form, face)); }

float fe__solid_height(const fe__solid *s, int32_t face)
{
    return fe__dot(fe__solid_normal(s, face), s->centre) + local_height(s->form, face);
}

fe_vec3 fe__solid_middle(const fe__solid *s) { return fe__add(s->centre, fe__mul(&s->axes, fe__form_middle(s->form))); }

int32_t fe__solid_face_below(const fe__solid *s, int32_t face, fe_vec3 p, float least)
{
    for (int32_t i = face; i < fe__solid_face_count(s); ++i)
        if (fe__dot(local_normal(s->form, i), p) - local_height(s->form, i) >= least) return i;
    return -1;
}

// The greatest m . x of the form's points x.
static float farthest_along(const fe__form *form, fe_vec3 m)
{
    if (fe__form_is_hull(form)) return fe__dot(m, fe__narrow(fe__form_support(form, fe__widen(m))));
    return fe__absf(m.x) * form->half.x + fe__absf(m.y) * form->half.y + fe__absf(m.z) * form->half.z;
}

int32_t fe__solid_goes_on(const fe__solid *s, fe_vec3 q, fe_vec3 m)
{
    const fe__form *form = s->form;
    fe_vec3 p = fe__mul_transposed(&s->axes, fe__sub(q, s->centre));
    if (fe__form_is_hull(form)) {
        for (int32_t i = 0; i < form->hull->face_count; ++i)
            if (fe__dot(local_normal(form, i), p) > local_height(form, i) + FE__FLUSH) return 0;
    } else if (!(fe__absf(p.x) <= form->half.x + FE__FLUSH && fe__absf(p.y) <= form->half.y + FE__FLUSH &&
                 fe__absf(p.z) <= form->half.z + FE__FLUSH)) {
        return 0;
    }
    fe_vec3 along = fe__mul_transposed(&s->axes, m);
    float far = farthest_along(form, along), here = fe__dot(along, p);
    const float least = 1e-5f, rounding = 1e-6f; // m; share of the distances
    return far - here > least + rounding * (fe__absf(far) + fe__absf(here));
}

int32_t fe__solid_is_level_at(const fe__solid *s, fe_vec3 p, fe_vec3 f)
{
    fe_vec3 q = fe__mul_transposed(&s->axes, fe__sub(p, s->centre)), along = fe__mul_transposed(&s->axes, f);
    int32_t is_level = 0;
    for (int32_t i = 0; i < fe__solid_face_count(s); ++i) {
        fe_vec3 n = local_normal(s->form, i);
        float over = fe__dot(n, q) - local_height(s->form, i);
        if (over > FE__LEVEL) return 0;
        if (fe__dot(n, along) > FE__LEVEL_COS)
            is_level = over >= -FE__LEVEL;
        else if (over > 0.0f)
            return 0;
    }
    return is_level;
}

fe_vec3 fe__solid_raise(const fe__solid *s, fe_vec3 q, fe_vec3 m, float most)
{
    float below = farthest_along(s->form, fe__mul_transposed(&s->axes, m)) - fe__dot(m, fe__sub(q, s->centre));
    return fe__add_scaled(q, fe__clampf(below, 0.0f, most), m);
}

fe_vec3 fe__solid_draw_in(const fe__solid *s, fe_vec3 q)
{
    const fe__form *form = s->form;
    fe_vec3 p = fe__mul_transposed(&s->axes, fe__sub(q, s->centre));
    if (!fe__form_is_hull(form))
        p = fe__vec3(fe__clampf(p.x, -form->half.x, form->half.x), fe__clampf(p.y, -form->half.y, form->half.y),
                     fe__clampf(p.z, -form->half.z, form->half.z));
    for (int32_t i = 0; fe__form_is_hull(form) && i < form->hull->face_count; ++i) {
        fe_vec3 n = local_normal(form, i);
        p = fe__add_scaled(p, fe__minf(local_height(form, i) - fe__dot(n, p), 0.0f), n);
    }
    return fe__add(s->centre, fe__mul(&s->axes, p));
}

// A box's coordinate moved towards 0, unless it is the one along the face's own axis.
static float inwards(float x, float half, int32_t is_axis)
{
    float step = fe__minf(fe__minf(INSIDE, INSIDE_SHARE * half), fe__absf(x));
    return is_axis ? x : x > 0.0f ? x - step : x + step;
}

fe_vec3 fe__solid_off_rim(const fe__solid *s, fe_vec3 q, fe_vec3 m)
{
    fe_vec3 along = fe__mul_transposed(&s->axes, m), p = fe__mul_transposed(&s->axes, fe__sub(q, s->centre));
    if (fe__form_is_hull(s->form)) {
        fe__face face;
        fe__form_face(s->form, along, &face);
        fe_vec3 across = fe__cross(face.normal, along), middle = {0.0f, 0.0f, 0.0f};
        if (fe__dot(across, across) < LEANS) {
            // The point moves in the face's plane, towards the middle of the vertices.
            for (int32_t i = 0; i < face.count; ++i)
                middle = fe__add_scaled(middle, 1.0f / (float)face.count, face.vertex[i]);
            fe_vec3 way = fe__sub(middle, p);
            way = fe__sub(way, fe__scale(fe__dot(way, face.normal), face.normal));
            float length = fe__length(way), step = fe__minf(INSIDE, INSIDE_SHARE * length);
            if (length > 0.0f) p = fe__add_scaled(p, step / length, way);
        }
    } else {
        fe_vec3 half = s->form->half;
        float xx = along.x * along.x, yy = along.y * along.y, zz = along.z * along.z;
        int32_t x = yy + zz < LEANS, y = xx + zz < LEANS, z = xx + yy < LEANS;
        if (x || y || z) p = fe__vec3(inwards(p.x, half.x, x), inwards(p.y, half.y, y), inwards(p.z, half.z, z));
    }
    return fe__add(s->centre, fe__mul(&s->axes, p));
}
