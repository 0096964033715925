// approach_curved.c - sweeps and overlaps of what its support function alone describes, a cylinder, a cone or a hull,
// with anything that has a core.
//
// Nearest points by GJK and depths by EPA, in the frame of the approach. As for the other forms the distance is a
// convex function of the way, and its tangent never goes too far.
#include "collision/cast/approach.h"
#include "collision/form/epa.h"

#include <string.h>

enum { MAX_STEPS = 64 };
#define TOLERANCE 0.1       // of the gap: a stop within that of it is one
#define ROUNDINGS 1e-14     // of the cores' size: how well the nearest points are known
#define NEARLY_ALONG 0.9999 // a direction within a degree

static fe__cores cores_at(const fe__approach *s, fe_dvec3 position)
{
    return (fe__cores){s->frame_form,
                       s->other_form,
                       position,
                       s->axes.x,
                       s->axes.y,
                       s->axes.z,
                       s->frame_kind == FE_CORE_TRIANGLE ? s->vertex : NULL};
}

static fe__core_gap gap_found(const fe__gjk *g)
{
    return (fe__core_gap){g->distance, g->on_a, g->way, g->size, g->apart_by};
}

static void gap_of(const fe__cores *cores, fe__core_gap *gap)
{
    fe__gjk gjk;
    fe__gjk_distance_closely(cores, &gjk);
    *gap = gap_found(&gjk);
}

void fe__curved_gap_of(const fe__approach *s, fe_dvec3 position, fe__core_gap *gap)
{
    fe__cores cores = cores_at(s, position);
    gap_of(&cores, gap);
}

// ---- planes that hold the two apart ---------------------------------------------------------------------------------
// The cores are no nearer than the planes across `n` (unit, from the frame to the other) that hold them: what is sure
// of a distance, whatever rounding made of the nearest points of a large form.
static double sure_distance(const fe__cores *cores, fe_dvec3 n)
{
    return -fe__ddot(n, fe__cores_support(cores, n).difference);
}

static void keep_nearest_axis(fe_dvec3 axis, fe_dvec3 n, fe_dvec3 *best)
{
    double cosine = fe__ddot(axis, n);
    if (fe__absd(cosine) > fe__absd(fe__ddot(*best, n))) *best = cosine < 0.0 ? fe__dscale(-1.0, axis) : axis;
}

// Of the flat sides that are known without rounding the one that looks most along n: caps, and faces of boxes
static void keep_nearest_side(int32_t type, const fe__axes *axes, fe_dvec3 n, fe_dvec3 *best)
{
    if (type == FE__FORM_BOX) {
        keep_nearest_axis(axes->x, n, best);
        keep_nearest_axis(axes->z, n, best);
    }
    if (type == FE__FORM_BOX || type == FE__FORM_CYLINDER || type == FE__FORM_CONE) keep_nearest_axis(axes->y, n, best);
}

// Where the cores only just touch, the polytope around their difference may have no face there: the flat sides are
// asked too, both ways. The point is that which the one without the side has farthest along it.
static void try_sides(int32_t type, const fe__axes *axes, int32_t is_of_frame, const fe__cores *cores,
                      fe__penetration *found)
{
    const fe_dvec3 side[3] = {axes->y, axes->x, axes->z};
    int32_t count = type == FE__FORM_BOX ? 3 : type == FE__FORM_CYLINDER || type == FE__FORM_CONE ? 1 : 0;
    for (int32_t i = 0; i < 2 * count; ++i) {
        fe_dvec3 n = i & 1 ? fe__dscale(-1.0, side[i / 2]) : side[i / 2];
        fe__vertex w = fe__cores_support(cores, n);
        double depth = fe__ddot(n, w.difference);
        fe_dvec3 point = is_of_frame ? fe__dadd(fe__dsub(w.on_a, w.difference), fe__dscale(depth, n)) : w.on_a;
        if (depth < found->depth) *found = (fe__penetration){n, fe__maxd(depth, 0.0), point, point};
    }
}

double fe__curved_depth(const fe__approach *s, fe_dvec3 *way_out, fe__core_gap *gap)
{
    static const fe__axes own = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    fe__cores cores = cores_at(s, s->position);
    fe__gjk gjk;
    fe__gjk_distance_closely(&cores, &gjk);
    fe__penetration p = fe__epa_depth(&cores, &gjk);
    if (s->frame_kind != FE_CORE_TRIANGLE) try_sides(s->frame_form->type, &own, 1, &cores, &p);
    try_sides(s->other_form->type, &s->axes, 0, &cores, &p);
    *way_out = p.normal, gap->on_frame = p.on_a;
    return p.depth;
}

static fe_dvec3 nearest_side(const fe__approach *s, fe_dvec3 n)
{
    static const fe__axes own = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    fe_dvec3 best = {0.0, 0.0, 0.0};
    if (s->frame_kind == FE_CORE_TRIANGLE)
        keep_nearest_axis(s->normal, n, &best);
    else
        keep_nearest_side(s->frame_form->type, &own, n, &best);
    keep_nearest_side(s->other_form->type, &s->axes, n, &best);
    return best;
}

// A rounding e of the nearest points turns a way d between them by e / d, far more than it turns a side of one of the
// two. So where a side near it holds them apart by more, it gives the direction; and it does where the nearest points
// are none, because more than that turn takes of the size is between their distance and what is sure of it. Returns the
// distance, then what is sure of it.
static double make_sure(const fe__approach *s, const fe__cores *cores, fe__core_gap *gap)
{
    double size = gap->size, least = gap->distance - ROUNDINGS * size * (size / gap->distance);
    fe_dvec3 n = fe__dscale(1.0 / gap->distance, gap->away), side = nearest_side(s, n);
    int32_t is_along = fe__ddot(side, n) > NEARLY_ALONG;
    if (!is_along && gap->apart_by >= least) return gap->distance; // GJK has met a plane that shows it
    double sure = sure_distance(cores, n);
    if ((sure < least && fe__ddot(side, side) > 0.0) || is_along) { // two hulls have no side that is known
        double by_side = sure_distance(cores, side);
        if (by_side > sure) sure = by_side, gap->away = fe__dscale(gap->distance, side);
    }
    return sure >= least ? gap->distance : sure;
}

double fe__sure_gap_of(const fe__approach *s, fe_dvec3 position, fe__core_gap *gap)
{
    fe__cores cores = cores_at(s, position);
    gap_of(&cores, gap);
    return gap->distance > 0.0 ? make_sure(s, &cores, gap) : 0.0;
}

double fe__separation_of(const fe__approach *s, fe_dvec3 position, fe_dvec3 n)
{
    fe__cores cores = cores_at(s, position);
    return sure_distance(&cores, n);
}

typedef struct sure_gap {
    fe__core_gap gap;
    double sure; // of its distance
} sure_gap;

// A sweep's looks at the two, one after the other. Forms with corners alone, a hull among them, are looked at from what
// was nearest before: mostly it still is. A rim's supports come so near to each other that the last ones say little.
typedef struct looks {
    const fe__approach *pair;
    int32_t follows, is_known;
    fe_dvec3 position; // of the last look
    fe__gjk gjk;
} looks;

static looks looks_of(const fe__approach *s)
{
    int32_t has_rim =
        (s->frame_kind != FE_CORE_TRIANGLE && fe__form_is_curved(s->frame_form)) || fe__form_is_curved(s->other_form);
    return (looks){.pair = s, .follows = !has_rim};
}

static sure_gap look_at(looks *l, double t)
{
    fe_dvec3 position = fe__approach_at(l->pair, t);
    fe__cores cores = cores_at(l->pair, position);
    if (l->is_known)
        fe__gjk_distance_closely_after(&cores, fe__dsub(position, l->position), &l->gjk);
    else
        fe__gjk_distance_closely(&cores, &l->gjk);
    l->is_known = l->follows, l->position = position;
    sure_gap here = {.gap = gap_found(&l->gjk)};
    here.sure = here.gap.distance > 0.0 ? make_sure(l->pair, &cores, &here.gap) : 0.0;
    return here;
}

// What GJK found at the start is what it would find again, where position + 0 translation has the position's bits.
static sure_gap look_at_start(looks *l, const fe__core_gap *known)
{
    fe_dvec3 start = fe__approach_at(l->pair, 0.0);
    if (memcmp(&start, &l->pair->position, sizeof start) != 0) return look_at(l, 0.0);
    fe__cores cores = cores_at(l->pair, start);
    sure_gap here = {.gap = *known};
    here.sure = make_sure(l->pair, &cores, &here.gap);
    return here;
}

// From `t` to where the distance is `goal`, or a little more. 0: it never comes so near. A distance that GJK finds too
// long takes a step too far: then the way from where they were apart is halved. `at` is the gap at t, before and after.
static int32_t advance(looks *l, double goal, double tolerance, double *t, sure_gap *at)
{
    const fe__approach *s = l->pair;
    double apart = *t, inside = (double)INFINITY;
    sure_gap here = *at;
    for (int32_t i = 0;; ++i) {
        if (i > 0) here = look_at(l, *t);
        if (i == 0 && !(here.gap.distance > 0.0)) return 1;
        if (i > 0 && !(here.gap.distance > s->radius)) {
            inside = *t;
        } else {
            double way = here.sure - goal;
            *at = here;
            double rate = fe__ddot(here.gap.away, s->translation) / here.gap.distance; // of the distance, m per t
            if (!(rate < 0.0)) return inside <= 1.0;                                   // then they do meet
            if (here.gap.distance <= goal + tolerance || !(way > 0.0)) return 1;
            apart = *t;
            *t += way / -rate;
        }
        if (i >= MAX_STEPS) {
            *t = apart;
            return 1;
        }
        if (!(*t < inside)) *t = 0.5 * (apart + inside);
        if (!(*t <= 1.0)) return 0;
    }
}

static int32_t sweep_on(looks *l, double t, sure_gap *at, double limit, fe__approach_hit *hit)
{
    const fe__approach *s = l->pair;
    if (!advance(l, s->radius + s->gap, TOLERANCE * s->gap, &t, at) || !(t <= limit)) return 0;
    double distance = at->gap.distance, clearance = fe__mind(distance - s->radius, s->gap);
    *hit = (fe__approach_hit){t, fe__dscale(1.0 / distance, at->gap.away), at->gap.on_frame};
    return advance(l, s->radius + 0.5 * clearance, TOLERANCE * clearance, &t, at);
}

int32_t fe__curved_sweep(const fe__approach *s, const fe__core_gap *start, double limit, fe__approach_hit *hit)
{
    looks l = looks_of(s);
    sure_gap at = look_at_start(&l, start);
    return sweep_on(&l, 0.0, &at, limit, hit);
}

int32_t fe__curved_sweep_from(const fe__approach *s, double from, double limit, fe__approach_hit *hit)
{
    looks l = looks_of(s);
    sure_gap at = look_at(&l, from);
    if (!(at.sure > s->radius + s->gap)) return -1;
    return sweep_on(&l, from, &at, limit, hit);
}
