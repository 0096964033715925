// hull_form.c - the hull as a form: where a scaled, shifted hull ends, and what it weighs. See hull_form.h.
#include "collision/form/hull_form.h"

#include "collision/form/kinds.h"

#include <float.h>

fe__form fe__hull_form(const fe__hull *hull, int32_t index)
{
    return (fe__form){.type = FE__FORM_HULL, .hull_field = index, .scale = 1.0f, .offset = hull->origin, .hull = hull};
}

static fe_dvec3 wide_centre(const fe__form *form) { return fe__from_hull(form, form->hull->mass.centre); }
fe_vec3 fe__hull_form_centre(const fe__form *form) { return fe__narrow(wide_centre(form)); }

// mass grows with the cube of the scale, moments with the fifth power
fe__mass fe__hull_form_mass(const fe__form *form, double density)
{
    const fe__hull_mass *m = &form->hull->mass;
    double s = (double)form->scale, cube = density * s * s * s, fifth = cube * s * s;
    return (fe__mass){.mass = (float)(cube * m->volume),
                      .inertia = {(float)(fifth * (double)m->inertia.x), (float)(fifth * (double)m->inertia.y),
                                  (float)(fifth * (double)m->inertia.z)},
                      .centre = fe__hull_form_centre(form),
                      .is_turned = 1,
                      .axes = m->axes};
}

typedef fe__bounds bounds_of_hull(const fe__hull *hull, const fe__pose *pose);
static inline fe__bounds place_bounds(const fe__form *form, const fe__pose *pose, bounds_of_hull *bounds)
{
    fe__pose at = {{0.0, 0.0, 0.0}, pose->rotation};
    fe__bounds b = bounds(form->hull, &at);
    double s = (double)form->scale;
    fe_dvec3 origin = fe__dadd(pose->position, fe__drotate(pose->rotation, fe__widen(form->offset)));
    return (fe__bounds){fe__dadd(origin, fe__dscale(s, b.low)), fe__dadd(origin, fe__dscale(s, b.high))};
}

fe__bounds fe__hull_form_bounds(const fe__form *form, const fe__pose *pose)
{
    return place_bounds(form, pose, fe__hull_bounds);
}

fe__bounds fe__hull_form_rough_bounds(const fe__form *form, const fe__pose *pose)
{
    return place_bounds(form, pose, fe__hull_rough_bounds);
}

float fe__hull_form_reach(const fe__form *form, fe_vec3 centre)
{
    return form->scale * fe__hull_reach(form->hull, fe__narrow(fe__in_hull(form, fe__widen(centre))));
}

float fe__hull_form_thickness(const fe__form *form) { return form->scale * form->hull->inner_radius; }

// Each face comes nearer to the centre of mass by `by` at least: none is nearer to it than the inner radius.
fe__form fe__hull_form_shrunk(const fe__form *form, float by)
{
    float keep = 1.0f - by / fe__hull_form_thickness(form);
    fe_vec3 centre = fe__hull_form_centre(form);
    fe__form thin = *form;
    thin.scale = keep * form->scale;
    thin.offset = fe__add_scaled(centre, keep, fe__sub(form->offset, centre));
    return thin;
}

fe_dvec3 fe__hull_form_vertex(const fe__form *form, int32_t vertex)
{
    return fe__from_hull(form, fe__widen(fe__hull_vertex(form->hull, vertex)));
}

fe_dvec3 fe__hull_form_support(const fe__form *form, fe_dvec3 direction)
{
    return fe__hull_form_vertex(form, fe__hull_support(form->hull, direction));
}

// The load leans over the edge that the way from the middle of a face to the foot crosses: this is its corner on the
// left of the way. Corners turn left around the normal. -1: the foot is near the middle
static int32_t corner_over_foot(const fe__hull *hull, const fe__hull_face *f, fe_vec3 normal, fe_vec3 foot)
{
    const float leans = 0.5f; // of the corner's distance
    fe_vec3 middle = {0.0f, 0.0f, 0.0f};
    for (int32_t i = 0; i < f->count; ++i) middle = fe__add(middle, fe__hull_vertex(hull, hull->corners[f->first + i]));
    middle = fe__scale(1.0f / (float)f->count, middle);
    fe_vec3 way = fe__sub(foot, middle), left = fe__cross(normal, way);
    fe_vec3 last = fe__sub(fe__hull_vertex(hull, hull->corners[f->first + f->count - 1]), middle);
    for (int32_t i = 0; i < f->count; ++i) {
        fe_vec3 p = fe__sub(fe__hull_vertex(hull, hull->corners[f->first + i]), middle);
        if (fe__dot(left, p) >= 0.0f && fe__dot(left, last) < 0.0f)
            return fe__dot(way, way) > leans * leans * fe__dot(p, p) ? i : -1;
        last = p;
    }
    return -1;
}

// Does the face lean no farther than what is chosen by the load may, and is the edge before that corner as low as any?
static int32_t leans_there(const fe__hull *hull, const fe__hull_face *f, fe_vec3 direction, int32_t corner)
{
    float low = -FLT_MAX, high = FLT_MAX, there = -FLT_MAX;
    int32_t before = corner > 0 ? corner - 1 : f->count - 1;
    for (int32_t i = 0; i < f->count; ++i) {
        float along = fe__dot(direction, fe__hull_vertex(hull, hull->corners[f->first + i]));
        low = fe__maxf(low, along), high = fe__minf(high, along);
        if (i == corner || i == before) there = fe__maxf(there, along);
    }
    return there >= low - FE__CLEAR && low - high <= 2.0f * fe__most_lean(0.5f * hull->extent);
}

// Each vertex of a polygon with fewer stands for some corners side by side: its name stays theirs, whichever it is at.
static int32_t vertex_for(const fe__hull_face *f, int32_t count, int32_t corner)
{
    return ((corner + 1) * count - 1) / f->count;
}

// The edge before that corner is whole, and so are those on either side of it where there is room.
static void keep_edge(const fe__hull *hull, const fe__hull_face *f, int32_t corner, fe__face *out)
{
    static const int32_t ahead[4] = {1, -2, 0, -1}; // the later of two stays
    int32_t here = vertex_for(f, out->count, corner);
    for (int32_t k = 0; k < 4; ++k) {
        int32_t c = (corner + ahead[k] + f->count) % f->count, i = vertex_for(f, out->count, c);
        if (ahead[k] == -1 && i == here) i = i > 0 ? i - 1 : out->count - 1;
        out->vertex[i] = fe__hull_vertex(hull, hull->corners[f->first + c]);
    }
}

void fe__hull_polygon(const fe__hull *hull, int32_t face, fe_vec3 deepest, fe__face *out)
{
    const fe__hull_face *f = hull->faces + face;
    int32_t first = f->first, all = f->count, count = all < FE_FACE_VERTICES ? all : FE_FACE_VERTICES, low = 0;
    out->count = count;
    out->normal = fe__hull_normal(hull, face);
    out->id = (uint32_t)face;
    out->rim = 0.0f;
    int32_t over = all > count && out->foot ? corner_over_foot(hull, f, out->normal, *out->foot) : -1;
    if (over >= 0 && leans_there(hull, f, deepest, over)) {
        for (int32_t i = 0; i < count; ++i)
            out->vertex[i] = fe__hull_vertex(hull, hull->corners[first + i * all / count]);
        keep_edge(hull, f, over, out);
        return;
    }
    for (int32_t i = 1; i < all; ++i)
        if (fe__dot(deepest, fe__hull_vertex(hull, hull->corners[first + i])) >
            fe__dot(deepest, fe__hull_vertex(hull, hull->corners[first + low])))
            low = i;
    for (int32_t i = 0; i < count; ++i) {
        int32_t begin = i * all / count, end = (i + 1) * all / count;
        int32_t corner = low >= begin && low < end ? low : begin;
        out->vertex[i] = fe__hull_vertex(hull, hull->corners[first + corner]);
    }
}

// By how much the way to the vertex at an edge's other end falls back along the direction: a sine
static double falls_back(const fe__hull *hull, int32_t edge, fe_dvec3 direction)
{
    fe_vec3 from = fe__hull_vertex(hull, hull->edges[edge].origin),
            to = fe__hull_vertex(hull, hull->edges[edge ^ 1].origin);
    fe_dvec3 way = fe__widen(fe__sub(from, to));
    return fe__ddot(direction, way) / sqrt(fe__ddot(way, way) * fe__ddot(direction, direction));
}

static double facing(const fe__hull *hull, int32_t face, fe_dvec3 direction)
{
    return fe__ddot(direction, fe__widen(fe__hull_normal(hull, face)));
}

// Of the faces around the farthest vertex that which looks most along the direction: so that vertex is among those
// given. Where none lies across it, an edge may, as a wedge's that stands: then one of its two faces
static int32_t face_around(const fe__hull *hull, int32_t vertex, fe_dvec3 direction)
{
    int32_t first = hull->spokes[vertex], best = hull->edges[first].face, flattest = -1;
    double most = facing(hull, best, direction), least = (double)FE__LIES_ALONG;
    for (int32_t h = hull->edges[first ^ 1].next; h != first; h = hull->edges[h ^ 1].next) {
        int32_t face = hull->edges[h].face;
        double along = facing(hull, face, direction);
        if (along > most || (along == most && face < best)) most = along, best = face;
    }
    if (most * most > (1.0 - least * least) * fe__ddot(direction, direction)) return best;
    int32_t h = first;
    do {
        double back = falls_back(hull, h, direction);
        if (back < least) least = back, flattest = h;
        h = hull->edges[h ^ 1].next;
    } while (h != first);
    if (flattest < 0) return best;
    int32_t left = hull->edges[flattest].face, right = hull->edges[flattest ^ 1].face;
    return facing(hull, left, direction) >= facing(hull, right, direction) ? left : right;
}

void fe__hull_form_face_at(const fe__form *form, int32_t vertex, fe_vec3 direction, fe__face *face)
{
    const fe_vec3 *given = face->foot;
    fe_vec3 foot;
    if (given) foot = fe__scale(1.0f / form->scale, fe__sub(*given, form->offset)), face->foot = &foot;
    fe__hull_polygon(form->hull, face_around(form->hull, vertex, fe__widen(direction)), direction, face);
    for (int32_t i = 0; i < face->count; ++i)
        face->vertex[i] = fe__add_scaled(form->offset, form->scale, face->vertex[i]);
    face->foot = given;
}

void fe__hull_form_face(const fe__form *form, fe_vec3 direction, fe__face *face)
{
    fe__hull_form_face_at(form, fe__hull_support(form->hull, fe__widen(direction)), direction, face);
}
