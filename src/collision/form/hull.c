// hull.c - support, bounds, rays and faces of a hull, and the traits of a form with a hull (form_table.c). See hull.h.
#include "collision/form/hull.h"

#include "collision/form/form_kinds.h"
#include "core/lanes.h"

#include <float.h>

// ---- support -------------------------------------------------------------------------------------------------------
// Floats find the lanes that may be the farthest, double decides between them. A float product n . x of three terms,
// its factors rounded to floats, is off by less than 6 u (|n1 x1| + |n2 x2| + |n3 x3|), u = 2^-24, plus underflow.
enum { MOST_LANES = (FE__HULL_FACES + FE__HULL_LANES - 1) / FE__HULL_LANES * FE__HULL_LANES };
static const float rounding = 6.0f * 0x1p-24f, underflow = 1e-30f;

// Computes n . x of each lane in floats, and the greatest and the least of them.
typedef struct extremes {
    float most, least;
} extremes;
static inline extremes look_along(const fe__hull_lanes *lanes, int32_t count, fe_vec3 n, float *out_along)
{
    const fe__quad *px = (const fe__quad *)lanes->x, *py = (const fe__quad *)lanes->y, *pz = (const fe__quad *)lanes->z;
    const fe__quad x = fe__quad_set(n.x), y = fe__quad_set(n.y), z = fe__quad_set(n.z);
    fe__quad most = fe__quad_set(-FLT_MAX), least = fe__quad_set(FLT_MAX);
    for (int32_t i = 0; i < count; i += 4) {
        fe__quad along = x * *px++ + y * *py++ + z * *pz++;
        *(fe__quad *)(out_along + i) = along;
        most = fe__quad_max(along, most), least = fe__quad_min(along, least);
    }
    most = fe__quad_max(most, __builtin_shufflevector(most, most, 2, 3, 0, 1));
    least = fe__quad_min(least, __builtin_shufflevector(least, least, 2, 3, 0, 1));
    return (extremes){fe__maxf(most[0], most[1]), fe__minf(least[0], least[1])};
}

// Chooses the lane farthest along the direction among those with  sign along >= least. Mostly one lane is left, at a
// place that nothing predicts: no branch depends on it.
static inline int32_t choose_lane(const fe__hull_lanes *lanes, int32_t count, const float *along, float sign,
                                  float least, fe_dvec3 direction)
{
    enum { WORD = 64 };
    const fe__quad low = fe__quad_set(least), factor = fe__quad_set(sign);
    int32_t best = 0;
    double farthest = -(double)INFINITY;
    for (int32_t first = 0; first < count; first += WORD) {
        // Bit i is lane first + i. A NaN is not below `least` and stays.
        int32_t end = fe__mini(count - first, WORD);
        uint64_t left = 0;
        for (int32_t i = 0; i < end; i += 4)
            left |= (uint64_t)(0xfu & ~fe__quad_signs(factor * *(const fe__quad *)(along + first + i) < low)) << i;
        if (count <= WORD && !(left & (left - 1))) return __builtin_ctzll(left);
        for (; left; left &= left - 1) {
            int32_t lane = first + __builtin_ctzll(left);
            double distance = fe__ddot(fe__widen(fe__hull_lane(lanes, lane)), direction);
            if (distance > farthest) farthest = distance, best = lane;
        }
    }
    return best;
}

// Twice the error of n . x in floats. No coordinate of a lane is larger than that of `most`.
static inline float doubt_of(fe_vec3 n, fe_vec3 most)
{
    float sum = fe__absf(n.x) * most.x + fe__absf(n.y) * most.y + fe__absf(n.z) * most.z;
    return 2.0f * (rounding * sum + underflow);
}

static int32_t farthest_lane(const fe__hull_lanes *lanes, int32_t count, fe_vec3 most, fe_dvec3 direction)
{
    _Alignas(16) float along[MOST_LANES];
    fe_vec3 n = fe__narrow(direction);
    float least = look_along(lanes, count, n, along).most - doubt_of(n, most);
    return choose_lane(lanes, count, along, 1.0f, least, direction);
}

static inline fe_vec3 most_of_corners(fe_vec3 a, fe_vec3 b)
{
    return fe__vec3(fe__maxf(fe__absf(a.x), fe__absf(b.x)), fe__maxf(fe__absf(a.y), fe__absf(b.y)),
                    fe__maxf(fe__absf(a.z), fe__absf(b.z)));
}

int32_t fe__hull_support(const fe__hull *hull, fe_dvec3 direction)
{
    return farthest_lane(&hull->vertices, hull->vertex_count, most_of_corners(hull->low, hull->high), direction);
}

fe__hull_ends fe__hull_ends_along(const fe__hull *hull, fe_dvec3 direction)
{
    _Alignas(16) float along[MOST_LANES];
    const fe__hull_lanes *v = &hull->vertices;
    int32_t count = hull->vertex_count;
    fe_vec3 n = fe__narrow(direction);
    float doubt = doubt_of(n, most_of_corners(hull->low, hull->high));
    extremes ends = look_along(v, count, n, along);
    return (fe__hull_ends){choose_lane(v, count, along, 1.0f, ends.most - doubt, direction),
                           choose_lane(v, count, along, -1.0f, -ends.least - doubt, fe__dscale(-1.0, direction))};
}

int32_t fe__hull_facing(const fe__hull *hull, fe_dvec3 direction)
{
    const fe_vec3 unit = {1.0f, 1.0f, 1.0f};
    return farthest_lane(&hull->normals, hull->face_count, unit, direction);
}

float fe__hull_reach(const fe__hull *hull, fe_vec3 centre)
{
    double most = 0.0;
    for (int32_t i = 0; i < hull->vertex_count; ++i) {
        fe_dvec3 d = fe__dsub(fe__widen(fe__hull_vertex(hull, i)), fe__widen(centre));
        most = fe__maxd(most, fe__ddot(d, d));
    }
    return (float)sqrt(most);
}

// ---- bounds --------------------------------------------------------------------------------------------------------
// Two points side by side, in double.
typedef struct pairs {
    fe__doubles x, y, z;
} pairs;

static inline pairs cross(fe_dvec3 u, pairs a)
{
    return (pairs){u.y * a.z - u.z * a.y, u.z * a.x - u.x * a.z, u.x * a.y - u.y * a.x};
}

static inline fe__doubles least(fe__doubles a, fe__doubles b) { return fe__doubles_choose(a < b, a, b); }
static inline fe__doubles most(fe__doubles a, fe__doubles b) { return fe__doubles_choose(a > b, a, b); }
static double least_of(fe__doubles a) { return fe__mind(a[0], a[1]); }
static double most_of(fe__doubles a) { return fe__maxd(a[0], a[1]); }

typedef struct span {
    pairs low, high;
} span;

// Adds the rotated points to the span, as fe__drotate turns them: a + k w t + k u x t, t = u x a.
static inline span grown(span s, fe_dvec3 u, double kw, double k, pairs a)
{
    pairs t = cross(u, a), ut = cross(u, t);
    pairs p = {a.x + kw * t.x + k * ut.x, a.y + kw * t.y + k * ut.y, a.z + kw * t.z + k * ut.z};
    return (span){{least(s.low.x, p.x), least(s.low.y, p.y), least(s.low.z, p.z)},
                  {most(s.high.x, p.x), most(s.high.y, p.y), most(s.high.z, p.z)}};
}

fe__bounds fe__hull_bounds(const fe__hull *hull, const fe__pose *pose)
{
    const double far = (double)INFINITY;
    const fe__hull_lanes *v = &hull->vertices;
    const fe__quad *x = (const fe__quad *)v->x, *y = (const fe__quad *)v->y, *z = (const fe__quad *)v->z;
    fe_dvec3 u = {(double)pose->rotation.x, (double)pose->rotation.y, (double)pose->rotation.z};
    double w = (double)pose->rotation.w, k = 2.0 / (fe__ddot(u, u) + w * w), kw = k * w;
    span s = {{{far, far}, {far, far}, {far, far}}, {{-far, -far}, {-far, -far}, {-far, -far}}};
    for (int32_t i = 0; i < hull->vertex_count; i += 4, ++x, ++y, ++z) {
        s = grown(s, u, kw, k, (pairs){fe__doubles_low(*x), fe__doubles_low(*y), fe__doubles_low(*z)});
        s = grown(s, u, kw, k, (pairs){fe__doubles_high(*x), fe__doubles_high(*y), fe__doubles_high(*z)});
    }
    return (fe__bounds){
        fe__dadd(pose->position, (fe_dvec3){least_of(s.low.x), least_of(s.low.y), least_of(s.low.z)}),
        fe__dadd(pose->position, (fe_dvec3){most_of(s.high.x), most_of(s.high.y), most_of(s.high.z)}),
    };
}

static float largest(fe__quad a) { return fe__maxf(fe__maxf(a[0], a[1]), fe__maxf(a[2], a[3])); }

// A float product of a row of the rotation and a vertex is off by some roundings, 2^-24 of their sum each.
void fe__hull_span(const fe__hull *hull, const fe__mat3 *rotation, fe_vec3 *out_low, fe_vec3 *out_high)
{
    const float rounding = 0x1p-19f;
    const fe__quad *px = (const fe__quad *)hull->vertices.x, *py = (const fe__quad *)hull->vertices.y,
                   *pz = (const fe__quad *)hull->vertices.z;
    const fe__mat3 r = *rotation;
    const fe__quad far = fe__quad_set(FLT_MAX);
    fe__quad low[3] = {far, far, far}, high[3] = {-far, -far, -far};
    for (int32_t i = 0; i < hull->vertex_count; i += 4, ++px, ++py, ++pz) {
        const fe__quad along[3] = {r.x.x * *px + r.y.x * *py + r.z.x * *pz, r.x.y * *px + r.y.y * *py + r.z.y * *pz,
                                   r.x.z * *px + r.y.z * *py + r.z.z * *pz};
        _Pragma("GCC unroll 3") for (int32_t k = 0; k < 3; ++k)
        {
            low[k] = fe__quad_min(along[k], low[k]);
            high[k] = fe__quad_max(along[k], high[k]);
        }
    }
    fe_vec3 most = most_of_corners(hull->low, hull->high);
    float doubt = rounding * (most.x + most.y + most.z);
    *out_low = fe__vec3(-(largest(-low[0]) + doubt), -(largest(-low[1]) + doubt), -(largest(-low[2]) + doubt));
    *out_high = fe__vec3(largest(high[0]) + doubt, largest(high[1]) + doubt, largest(high[2]) + doubt);
}

fe__bounds fe__hull_rough_bounds(const fe__hull *hull, const fe__pose *pose)
{
    const fe__mat3 rotation = fe__matrix(pose->rotation);
    fe_vec3 low, high;
    fe__hull_span(hull, &rotation, &low, &high);
    return (fe__bounds){fe__dadd(pose->position, fe__widen(low)), fe__dadd(pose->position, fe__widen(high))};
}

// ---- boxes that pass by --------------------------------------------------------------------------------------------
// The passer's lowest point is  height + t rate  over a plane at t. The passer is in the hull from the last plane that
// it comes in through to the first that it goes out through, if at all.
//
// A height in floats is off by some roundings of the lengths involved, 2^-24 of their sum each, so a share of that sum
// is taken from it. The share covers the rounding of t as well, which moves the passer by no more.
typedef struct floats3 {
    fe__quad x, y, z;
} floats3;
static floats3 spread(fe_dvec3 a)
{
    return (floats3){fe__quad_set((float)a.x), fe__quad_set((float)a.y), fe__quad_set((float)a.z)};
}
static inline fe__quad dot(const floats3 *a, const floats3 *b) { return a->x * b->x + a->y * b->y + a->z * b->z; }
static double size(fe_dvec3 a) { return fe__absd(a.x) + fe__absd(a.y) + fe__absd(a.z); }

static const double share = 0x1p-19;    // share of the lengths
static const double too_far = 1e25;     // m; floats hold the products of shorter lengths and unit vectors
static const float least_rate = 1e-30f; // A passer that is no faster stands still.

int32_t fe__hull_is_passed(const fe__hull *hull, const fe__hull_passer *p, double limit, double *out_from)
{
    double arms = size(p->half[0]) + size(p->half[1]) + size(p->half[2]), radius = p->radius;
    radius += share * (size(p->origin) + size(p->translation) + arms + radius + (double)hull->extent);
    *out_from = 0.0;
    if (!(radius < share * too_far)) return 0;
    const floats3 origin = spread(p->origin), way = spread(p->translation), a = spread(p->half[0]),
                  b = spread(p->half[1]), c = spread(p->half[2]);
    const fe__quad clear = fe__quad_set((float)radius), none = fe__quad_set(0.0f), slow = fe__quad_set(least_rate);
    fe__quad enter = none, stay = fe__quad_set((float)-limit); // `stay` is the last t, negated.
    for (int32_t i = 0; i < hull->face_count; i += 4) {
        const floats3 n = {*(const fe__quad *)(hull->normals.x + i), *(const fe__quad *)(hull->normals.y + i),
                           *(const fe__quad *)(hull->normals.z + i)};
        fe__quad height = dot(&n, &origin) - *(const fe__quad *)(hull->distances + i) - clear, rate = dot(&n, &way);
        if (arms > 0.0) height -= fe__quad_abs(dot(&n, &a)) + fe__quad_abs(dot(&n, &b)) + fe__quad_abs(dot(&n, &c));
        fe__quad_int comes = rate <= none;
        fe__quad t = height / fe__quad_choose(comes, slow - rate, rate);
        enter = fe__quad_max(fe__quad_choose(comes, t, none), enter);
        stay = fe__quad_max(fe__quad_choose(comes, stay, t), stay);
    }
    float from = largest(enter);
    *out_from = (double)from;
    return from > -largest(stay);
}

int32_t fe__hull_is_beside(const fe__hull *hull, const fe_vec3 corner[3], float gap)
{
    const floats3 a = spread(fe__widen(corner[0])), b = spread(fe__widen(corner[1])), c = spread(fe__widen(corner[2]));
    const fe__quad least = fe__quad_set(gap);
    for (int32_t i = 0; i < hull->face_count; i += 4) {
        const floats3 n = {*(const fe__quad *)(hull->normals.x + i), *(const fe__quad *)(hull->normals.y + i),
                           *(const fe__quad *)(hull->normals.z + i)};
        fe__quad lowest = fe__quad_min(fe__quad_min(dot(&n, &a), dot(&n, &b)), dot(&n, &c));
        if (fe__quad_signs(lowest - *(const fe__quad *)(hull->distances + i) > least)) return 1;
    }
    return 0;
}

// ---- rays ----------------------------------------------------------------------------------------------------------
// The ray's height over a plane at t is  height + t rate.  The ray is inside from the last plane that it comes in
// through to the first that it goes out through (Cyrus and Beck, 1978).
typedef struct crossing {
    double enter, leave; // t
    double highest;      // greatest height of the start over a plane
    int32_t face;        // the face that the ray enters through, -1: none
    int32_t nearest;     // the face that the start is highest over
} crossing;

static crossing cross_planes(const fe__hull *hull, fe_dvec3 origin, fe_dvec3 translation)
{
    crossing c = {0.0, (double)INFINITY, -(double)INFINITY, -1, 0};
    for (int32_t i = 0; i < hull->face_count; ++i) {
        fe_dvec3 n = fe__widen(fe__hull_normal(hull, i));
        double height = fe__ddot(n, origin) - (double)hull->distances[i], rate = fe__ddot(n, translation);
        if (height > c.highest) {
            c.highest = height;
            c.nearest = i;
        }
        if (rate == 0.0) {
            if (height > 0.0) c.leave = -1.0;
        } else if (rate > 0.0) {
            c.leave = fe__mind(c.leave, -height / rate);
        } else if (height > 0.0 && (c.face < 0 || -height / rate > c.enter)) {
            c.enter = -height / rate;
            c.face = i;
        }
    }
    return c;
}

// The same in floats, between bounds: as above, a height is known to a share of the lengths. Most rays miss, or clearly
// leave no sooner than they enter: then few faces are left through which they may enter.
typedef struct rough_crossing {
    float enter, latest; // The ray enters at some t from `enter` to `latest`.
    float leave;         // The ray leaves at this t or later.
    int32_t misses;      // It surely misses, up to the limit.
    // The ray enters through a face at this t at the latest; below 0: never
    _Alignas(16) float entry[MOST_LANES];
} rough_crossing;

static void cross_roughly(const fe__hull *hull, fe_dvec3 origin, fe_dvec3 translation, double limit, rough_crossing *c)
{
    double error = share * (size(origin) + size(translation) + (double)hull->extent);
    c->misses = 0, c->enter = -1.0f;
    if (!(error < share * too_far)) return;
    const floats3 o = spread(origin), way = spread(translation);
    const fe__quad spare = fe__quad_set((float)error), none = fe__quad_set(0.0f), slow = fe__quad_set(least_rate),
                   never = fe__quad_set(-1.0f);
    fe__quad enter = none, latest = none, stay = fe__quad_set((float)-limit), leave = fe__quad_set(-INFINITY);
    for (int32_t i = 0; i < hull->face_count; i += 4) {
        const floats3 n = {*(const fe__quad *)(hull->normals.x + i), *(const fe__quad *)(hull->normals.y + i),
                           *(const fe__quad *)(hull->normals.z + i)};
        fe__quad height = dot(&n, &o) - *(const fe__quad *)(hull->distances + i), rate = dot(&n, &way);
        fe__quad_int comes = rate <= none;
        fe__quad speed = fe__quad_choose(comes, slow - rate, rate);
        fe__quad low = (height - spare) / speed, high = (height + spare) / speed;
        enter = fe__quad_max(fe__quad_choose(comes, low, none), enter);
        latest = fe__quad_max(fe__quad_choose(comes, high, none), latest);
        stay = fe__quad_max(fe__quad_choose(comes, stay, low), stay); // negated, as `leave`
        leave = fe__quad_max(fe__quad_choose(comes, leave, high), leave);
        *(fe__quad *)(c->entry + i) = fe__quad_choose(comes, high, never);
    }
    c->enter = largest(enter), c->latest = largest(latest), c->leave = -largest(leave);
    c->misses = c->enter > -largest(stay);
}

// The face that the ray enters through last, as cross_planes() finds it, of those that are left; -1: it is not clear
static int32_t entered_face(const fe__hull *hull, fe_dvec3 origin, fe_dvec3 translation, const rough_crossing *rough,
                            double *out_enter)
{
    int32_t face = -1;
    if (!(rough->enter > 0.0f && rough->latest <= rough->leave)) return -1;
    const fe__quad from = fe__quad_set(rough->enter);
    for (int32_t i = 0; i < hull->face_count; i += 4) {
        uint32_t left = fe__quad_signs(*(const fe__quad *)(rough->entry + i) >= from);
        for (; left; left &= left - 1) {
            int32_t k = i + __builtin_ctz(left);
            fe_dvec3 n = fe__widen(fe__hull_normal(hull, k));
            double height = fe__ddot(n, origin) - (double)hull->distances[k], rate = fe__ddot(n, translation);
            if (!(rate < 0.0 && height > 0.0) || (face >= 0 && !(-height / rate > *out_enter))) continue;
            *out_enter = -height / rate;
            face = k;
        }
    }
    return face;
}

int32_t fe__hull_ray(const fe__hull *hull, fe_dvec3 origin, fe_dvec3 translation, double limit, fe__ray_hit *hit)
{
    rough_crossing rough;
    double enter;
    cross_roughly(hull, origin, translation, limit, &rough);
    if (rough.misses) return 0;
    int32_t face = entered_face(hull, origin, translation, &rough, &enter);
    if (face >= 0) {
        if (enter > limit) return 0;
        *hit = (fe__ray_hit){.t = enter, .normal = fe__hull_unit_normal(hull, face), .triangle = face};
        return 1;
    }
    crossing c = cross_planes(hull, origin, translation);
    if (c.highest <= 0.0) {
        // The ray begins inside: the normal is against its way, or that of the nearest face if it does not move. The
        // division by the largest component keeps the squares in range.
        fe_dvec3 normal = fe__hull_unit_normal(hull, c.nearest), d = translation;
        double most = fe__maxd(fe__absd(d.x), fe__maxd(fe__absd(d.y), fe__absd(d.z)));
        if (most != 0.0) {
            d = (fe_dvec3){d.x / most, d.y / most, d.z / most};
            normal = fe__dscale(-1.0 / sqrt(fe__ddot(d, d)), d);
        }
        *hit = (fe__ray_hit){.normal = normal, .depth = -c.highest, .inside = 1, .triangle = c.nearest};
        return 1;
    }
    if (c.face < 0 || c.enter > c.leave || c.enter > limit) return 0;
    *hit = (fe__ray_hit){.t = c.enter, .normal = fe__hull_unit_normal(hull, c.face), .triangle = c.face};
    return 1;
}

// ---- hull form ------------------------------------------------------------------------------------------------------
fe__form fe__hull_form(const fe__hull *hull, int32_t index)
{
    return (fe__form){.type = FE__FORM_HULL, .hull_field = index, .scale = 1.0f, .offset = hull->origin, .hull = hull};
}

fe_vec3 fe__hull_form_centre(const fe__form *form) { return fe__narrow(fe__from_hull(form, form->hull->mass.centre)); }

// The mass grows with the cube of the scale, moments with the fifth power.
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

// Each face comes nearer to the centre of mass by `by` at least, because none is nearer to it than the inner radius.
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

// ---- faces of a hull form ------------------------------------------------------------------------------------------
// The load leans over the edge that the way from the middle of a face to the foot crosses. Returns the edge's corner on
// the left of the way, -1: the foot is near the middle. Corners turn left around the normal.
static int32_t corner_over_foot(const fe__hull *hull, const fe__hull_face *f, fe_vec3 normal, fe_vec3 foot)
{
    const float leans = 0.5f; // share of the corner's distance from the middle
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

// May the load choose the points? The face must lean no farther than fe__most_lean allows, and the edge before that
// corner must be as low as any.
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

// The polygon has fewer vertices than the face has corners. Each vertex stands for some corners side by side and has
// their number, whichever of them it is at.
static int32_t vertex_for(const fe__hull_face *f, int32_t count, int32_t corner)
{
    return ((corner + 1) * count - 1) / f->count;
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
        // The edge before that corner has both its ends, and so have its neighbours if the vertices suffice: of two
        // corners that share a vertex the later in this order stays.
        static const int32_t offsets[4] = {1, -2, 0, -1};
        int32_t over_vertex = vertex_for(f, count, over);
        for (int32_t k = 0; k < 4; ++k) {
            int32_t corner = (over + offsets[k] + all) % all, i = vertex_for(f, count, corner);
            if (offsets[k] == -1 && i == over_vertex) i = i > 0 ? i - 1 : count - 1;
            out->vertex[i] = fe__hull_vertex(hull, hull->corners[first + corner]);
        }
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

static double facing(const fe__hull *hull, int32_t face, fe_dvec3 direction)
{
    return fe__ddot(direction, fe__widen(fe__hull_normal(hull, face)));
}

// The face that looks most along the direction, of those around the farthest vertex: so that this vertex is among the
// face's. If no face lies across the direction, an edge may, as that of a wedge that stands on it: then it is one of
// the edge's two faces.
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
        fe_vec3 from = fe__hull_vertex(hull, hull->edges[h].origin),
                to = fe__hull_vertex(hull, hull->edges[h ^ 1].origin);
        fe_dvec3 way = fe__widen(fe__sub(from, to));
        double back = fe__ddot(direction, way) / sqrt(fe__ddot(way, way) * fe__ddot(direction, direction));
        if (back < least) least = back, flattest = h; // `back` is the sine by which the edge falls back.
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
