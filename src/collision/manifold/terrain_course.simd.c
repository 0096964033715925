// terrain_course.simd.c - axes that part a form's way from triangles (terrain_course.h), W triangles side by side: the
// triangle's normal, those of its sides in its plane, from what of it is nearest to the form, and the normals of the
// form's faces (Gottschalk, Lin, Manocha, 1996). Compiled once per SIMD set.
#include "collision/form/hull.h"
#include "collision/manifold/terrain_course.h"
#include "core/simd.h"

#include <float.h>

enum { CORNERS = 3, AXES = 5, ENDS = 2 };

typedef fe__course_probe course;

// Of FE_W triangles
typedef struct bundle {
    wide3 corner[CORNERS];
    wide3 axes[AXES]; // unit: its normal, out of its sides, and from what of it is nearest to B's middle
    wide top[AXES];   // of the triangle along them
    wide size;        // longest side, m
    wide_mask slim;   // its axes are of roundings
} bundle;

static inline wide3 spread(fe_vec3 a) { return (wide3){w_set(a.x), w_set(a.y), w_set(a.z)}; }
static inline wide3 turn_back(const fe__mat3 *m, wide3 a)
{
    return (wide3){w_dot(spread(m->x), a), w_dot(spread(m->y), a), w_dot(spread(m->z), a)};
}

// The point of the triangles that is nearest to p
static wide3 nearest_to(const bundle *u, wide3 p)
{
    const wide zero = w_set(0.0f), one = w_set(1.0f);
    wide height = w_dot(u->axes[0], p) - u->top[0], least = w_set(INFINITY);
    wide3 over = w_sub_scaled(p, height, u->axes[0]), on_side = over;
    wide_mask inside = w_greater(one, zero);
    for (int32_t k = 0; k < CORNERS; ++k) {
        wide3 v = u->corner[k], side = w_sub(u->corner[(k + 1) % CORNERS], v), from = w_sub(p, v);
        wide share = w_clamp(w_dot(side, from) / w_dot(side, side), zero, one);
        wide3 q = w_add_scaled(v, share, side), away = w_sub(p, q);
        wide square = w_dot(away, away);
        inside = w_and(inside, w_not(w_greater(w_dot(u->axes[k + 1], from), zero)));
        wide_mask nearer = w_greater(least, square);
        on_side = w_choose3(nearer, q, on_side);
        least = w_choose(nearer, square, least);
    }
    return w_choose3(inside, over, on_side);
}

static void find_axes(bundle *u, wide3 middle)
{
    const float thin = 0.01f; // as terrain_surface.c
    const wide3 *v = u->corner;
    wide3 n = w_cross(w_sub(v[1], v[0]), w_sub(v[2], v[0]));
    wide length = w_sqrt(w_dot(n, n)), longest = w_set(0.0f);
    u->axes[0] = n = w_scale(w_set(1.0f) / length, n);
    u->top[0] = w_dot(n, v[0]);
    for (int32_t k = 0; k < CORNERS; ++k) {
        wide3 side = w_sub(v[(k + 1) % CORNERS], v[k]), out = w_cross(side, n);
        wide square = w_dot(side, side);
        longest = w_max(longest, square);
        u->axes[k + 1] = w_scale(w_set(1.0f) / w_sqrt(square), out);
        u->top[k + 1] = w_dot(u->axes[k + 1], v[k]);
    }
    u->size = w_sqrt(longest);
    wide3 foot = nearest_to(u, middle), away = w_sub(middle, foot);
    wide square = w_dot(away, away);
    u->axes[AXES - 1] = w_scale(w_set(1.0f) / w_sqrt(w_max(square, w_set(FLT_MIN))), away);
    u->top[AXES - 1] = w_max(w_max(w_dot(u->axes[AXES - 1], u->corner[0]), w_dot(u->axes[AXES - 1], u->corner[1])),
                             w_dot(u->axes[AXES - 1], u->corner[2]));
    u->slim = w_not(w_greater(length, w_set(thin) * longest));
}

// ---- B along an axis -----------------------------------------------------------------------------------------------
static void lowest_of_hull(const fe__form *b, const wide3 local[AXES], wide least[AXES])
{
    const fe__hull_lanes *v = &b->hull->vertices;
    for (int32_t k = 0; k < AXES; ++k) least[k] = w_set(INFINITY);
    for (int32_t i = 0; i < b->hull->vertex_count; ++i) {
        wide x = w_set(v->x[i]), y = w_set(v->y[i]), z = w_set(v->z[i]);
        for (int32_t k = 0; k < AXES; ++k) {
            wide along = local[k].x * x + local[k].y * y + local[k].z * z;
            least[k] = w_min(along, least[k]);
        }
    }
    for (int32_t k = 0; k < AXES; ++k) least[k] = w_dot(local[k], spread(b->offset)) + w_set(b->scale) * least[k];
}

// Of a circle: sqrt(a^2 + b^2) <= max + (sqrt(2) - 1) min
static inline wide hypotenuse_above(wide a, wide b) { return w_max(a, b) + w_set(0.41422f) * w_min(a, b); }

static void lowest_of_round(const fe__form *b, const wide3 local[AXES], wide least[AXES])
{
    for (int32_t k = 0; k < AXES; ++k) {
        wide x = w_set(b->half.x) * w_abs(local[k].x), y = w_set(b->half.y + b->half_height) * w_abs(local[k].y),
             z = w_set(b->half.z) * w_abs(local[k].z);
        least[k] = -(w_set(b->radius) + y + (fe__form_is_curved(b) ? hypotenuse_above(x, z) : x + z));
    }
}

// How far B is beyond the triangles along their axes, at one end of its way
static void part_by_axes(const course *c, int32_t end, const bundle *u, wide apart[AXES])
{
    wide3 local[AXES];
    for (int32_t k = 0; k < AXES; ++k) local[k] = turn_back(&c->way->rotation[end], u->axes[k]);
    if (fe__form_is_hull(c->b))
        lowest_of_hull(c->b, local, apart);
    else
        lowest_of_round(c->b, local, apart);
    for (int32_t k = 0; k < AXES; ++k) apart[k] += w_dot(u->axes[k], spread(c->at[end])) - u->top[k];
}

// ---- along B's faces -----------------------------------------------------------------------------------------------
typedef struct corners {
    wide3 p[ENDS][CORNERS]; // in B's frame, of a hull in that of its asset
} corners;

static void place_corners(const course *c, const bundle *u, corners *out)
{
    int32_t is_hull = fe__form_is_hull(c->b);
    wide per_scale = w_set(is_hull ? 1.0f / c->b->scale : 1.0f);
    wide3 offset = is_hull ? spread(c->b->offset) : w_zero3();
    for (int32_t end = 0; end < ENDS; ++end)
        for (int32_t k = 0; k < CORNERS; ++k)
            out->p[end][k] =
                w_scale(per_scale,
                        w_sub(turn_back(&c->way->rotation[end], w_sub(u->corner[k], spread(c->at[end]))), offset));
}

static inline wide least_of(wide a, wide b, wide c) { return w_min(w_min(a, b), c); }

// By how much they are parted at the start and at the end along whichever axis parts them most: at both, and at the end
typedef struct parting {
    wide both, last;
} parting;
static inline void part(parting *p, wide start, wide end)
{
    p->both = w_max(p->both, w_min(start, end));
    p->last = w_max(p->last, end);
}

static parting part_by_hull(const fe__hull *hull, const corners *l)
{
    parting most = {w_set(-INFINITY), w_set(-INFINITY)};
    for (int32_t i = 0; i < hull->face_count; ++i) {
        wide3 n = spread(fe__hull_normal(hull, i));
        wide distance = w_set(hull->distances[i]);
        part(&most, least_of(w_dot(n, l->p[0][0]), w_dot(n, l->p[0][1]), w_dot(n, l->p[0][2])) - distance,
             least_of(w_dot(n, l->p[1][0]), w_dot(n, l->p[1][1]), w_dot(n, l->p[1][2])) - distance);
    }
    return most;
}

// What lies beyond the upper faces of a box is under it no more: it may have sunk, and comes up again
static inline wide beyond_face(wide along_normal, wide least, float half)
{
    return w_choose(w_greater(along_normal, w_set(0.0f)), w_set(-INFINITY), least - w_set(half));
}

static parting part_by_sides(const fe__form *b, const corners *l, wide3 normal)
{
    const float half[3] = {b->half.x, b->half.y, b->half.z};
    int32_t first = fe__form_is_curved(b) ? 1 : 0, last = fe__form_is_curved(b) ? 1 : 2; // caps alone are flat
    parting most = {w_set(-INFINITY), w_set(-INFINITY)};
    for (int32_t j = first; j <= last; ++j) {
        wide at[ENDS][CORNERS], n = j == 0 ? normal.x : j == 1 ? normal.y : normal.z;
        for (int32_t end = 0; end < ENDS; ++end)
            for (int32_t k = 0; k < CORNERS; ++k)
                at[end][k] = j == 0 ? l->p[end][k].x : j == 1 ? l->p[end][k].y : l->p[end][k].z;
        part(&most, beyond_face(n, least_of(at[0][0], at[0][1], at[0][2]), half[j]),
             beyond_face(n, least_of(at[1][0], at[1][1], at[1][2]), half[j]));
        part(&most, beyond_face(-n, least_of(-at[0][0], -at[0][1], -at[0][2]), half[j]),
             beyond_face(-n, least_of(-at[1][0], -at[1][1], -at[1][2]), half[j]));
    }
    return most;
}

// A plane of B turns about its centre: a corner far from there comes farther off its straight way (r'' <= w^2 r + 2 w
// v)
static wide bend_of_corners(const course *c, const bundle *u)
{
    const fe__course *way = c->way;
    float shift = fe__length(way->end) + way->bend;
    wide3 centre = spread(way->centre);
    wide far = w_set(0.0f);
    for (int32_t k = 0; k < CORNERS; ++k) {
        wide3 d = w_sub(u->corner[k], centre);
        far = w_max(far, w_dot(d, d));
    }
    far = w_sqrt(far) + w_set(shift);
    return w_set(0.25f * way->angle) * (w_set(way->angle) * far + w_set(2.0f * shift)) + w_set(way->bend);
}

// ---- all -----------------------------------------------------------------------------------------------------------
// A bit for each triangle that B may touch: on its way, at the end
typedef struct verdict {
    unsigned both, last;
} verdict;

static verdict may_touch(const course *c, bundle *u)
{
    const float rounding = 1e-5f; // of the triangle's size
    find_axes(u, spread(c->middle));
    wide start[AXES], end[AXES], near = w_set(c->near) + w_set(rounding) * u->size;
    part_by_axes(c, 0, u, start);
    part_by_axes(c, 1, u, end);
    parting most = {w_set(-INFINITY), w_set(-INFINITY)};
    for (int32_t k = 0; k < AXES; ++k) part(&most, start[k], end[k]);
    wide_mask both = w_and(w_greater(most.both, near + w_set(fe__course_bend(c->way))), w_not(u->slim)),
              last = w_and(w_greater(most.last, near), w_not(u->slim));
    const unsigned all = (1u << FE_W) - 1;
    int32_t is_hull = fe__form_is_hull(c->b), has_faces = is_hull || c->b->radius == 0.0f;
    if (w_bits(both) == all || !has_faces) return (verdict){all & ~w_bits(both), all & ~w_bits(w_or(both, last))};
    corners l;
    place_corners(c, u, &l);
    wide scale = w_set(is_hull ? c->b->scale : 1.0f);
    most =
        is_hull ? part_by_hull(c->b->hull, &l) : part_by_sides(c->b, &l, turn_back(&c->way->rotation[0], u->axes[0]));
    both = w_or(both, w_greater(scale * most.both, near + bend_of_corners(c, u)));
    last = w_or(w_or(both, last), w_greater(scale * most.last, near));
    return (verdict){all & ~w_bits(both), all & ~w_bits(last)};
}

fe__course_kernel FE_NAME(fe__meet_course);

fe__met_on_course FE_NAME(fe__meet_course)(const fe__course_probe *probe, const fe__course_corners *corners,
                                           int32_t count)
{
    fe__met_on_course met = {0, 0};
    for (int32_t first = 0; first < count; first += FE_W) {
        bundle u;
        for (int32_t k = 0; k < CORNERS; ++k)
            u.corner[k] = (wide3){*(const wide *)(corners->x[k] + first), *(const wide *)(corners->y[k] + first),
                                  *(const wide *)(corners->z[k] + first)};
        verdict v = may_touch(probe, &u);
        met.on_way |= (uint64_t)v.both << first;
        met.at_end |= (uint64_t)v.last << first;
    }
    return met;
}
