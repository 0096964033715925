// turning.c - the rotational sweep: conservative advancement with a bound of second order; see turning.h.
#include "collision/cast/turning.h"

#include "collision/cast/cast_kinds.h"
#include "collision/cast/sweep.h"
#include "collision/cast/sweep_field.h"
#include "collision/form/form.h"
#include "core/math.h"

// The method is conservative advancement (Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, 2.3).
// Across a unit n, from the standing to the moving form, planes hold the two apart by
//   g(t) = min over the mover's points p of n . p(t)  -  max over the standing form's points q of n . q
// which is never more than their distance. With the turn w about c + t d,
//   n . p(t) = n . (c + t d) + n . R(t w) r,   |n . p''(t)| <= M = |w|^2 |n x axis| reach.
// A function f with f'' <= M lies above its chord less a parabola. So does the least of many: between t and t + s, at
// t + x s,
//   g >= (1 - x) g(t) + x g(t + s) - c x (1 - x),   c = M s^2 / 2
// and up to the first zero of the right side nothing is met, however thin. The approach to a touch is quadratic; past a
// touch each step leaves a share of the way. No step is shorter than (2 g / M)^(1/2), and the gap gives g a least
// value.

enum {
    MOST_STEPS = 16384, // The shortest steps make three turns; a motion that needs more counts as a touch.
    MOST_LOOKAHEADS = 8 // So often is g computed ahead along one direction.
};
#define TOLERANCE 0.1 // A stop is accepted if it misses the gap by no more than this share of it.
#define FARTHER 4.0   // The next lookahead is so many times the way that is known to be safe.
#define NEARER 1.5    // It is so many times if the end of the safe way has been seen.
#define LEFT 2.0      // A form that is so many gaps off again has not touched.

// ---- the mover -----------------------------------------------------------------------------------------------------
double fe__reach_across(const fe__form *form, fe_dvec3 axis)
{
    const double rounding = 1.000001; // The bounding radius is a float.
    if (fe__form_is_hull(form)) return rounding * (double)fe__form_reach(form, fe__vec3(0.0f, 0.0f, 0.0f));
    double half[3], most = 0.0;
    fe__core_half(form, half);
    for (int32_t i = 0; i < 4; ++i) {
        fe_dvec3 corner = {i & 1 ? -half[0] : half[0], i & 2 ? -half[1] : half[1], half[2]};
        fe_dvec3 across = fe__dcross(axis, corner);
        most = fe__maxd(most, fe__ddot(across, across));
    }
    return sqrt(most);
}

int32_t fe__form_shows_turn(const fe__form *form, const fe__axes *axes, fe_dvec3 turn)
{
    fe_dvec3 across = fe__dcross(axes->y, turn);
    double square = fe__ddot(turn, turn);
    if (fe__form_is_ball(form) || !(square > 0.0)) return 0;
    return !fe__form_is_curved(form) || fe__ddot(across, across) > FE_TURN_ROUNDING * FE_TURN_ROUNDING * square;
}

fe__turning fe__turning_of(const fe__mover *mover)
{
    double angle = sqrt(fe__ddot(mover->turn, mover->turn));
    fe__turning way = {.mover = mover, .axis = fe__dscale(1.0 / angle, mover->turn), .angle = angle};
    way.reach = fe__reach_across(mover->form, fe__turn_back(&mover->axes, way.axis));
    way.gap = fe__stop_gap(mover) + FE_TURN_ROUNDING * (double)fe__form_reach(mover->form, fe__vec3(0.0f, 0.0f, 0.0f));
    return way;
}

// R a = a cos f + (k x a) sin f + k (k . a) (1 - cos f), about the unit k
static fe_dvec3 turned(fe_dvec3 k, double sine, double cosine, fe_dvec3 a)
{
    fe_dvec3 along = fe__dscale((1.0 - cosine) * fe__ddot(k, a), k);
    return fe__dadd(fe__dadd(fe__dscale(cosine, a), fe__dscale(sine, fe__dcross(k, a))), along);
}

fe__mover fe__turning_at(const fe__turning *way, double t)
{
    fe__mover moved = *way->mover;
    double sine, cosine;
    fe__sincos(t * way->angle, &sine, &cosine);
    moved.position = fe__dadd(moved.position, fe__dscale(t, moved.translation));
    moved.axes =
        (fe__axes){turned(way->axis, sine, cosine, moved.axes.x), turned(way->axis, sine, cosine, moved.axes.y),
                   turned(way->axis, sine, cosine, moved.axes.z)};
    moved.turn = (fe_dvec3){0.0, 0.0, 0.0};
    return moved;
}

double fe__turning_speed(const fe__turning *way)
{
    fe_dvec3 d = way->mover->translation;
    return sqrt(fe__ddot(d, d)) + way->angle * way->reach;
}

// ---- the advancement -----------------------------------------------------------------------------------------------
// A turning form and the standing one: the frame of `pair` or, if it is not NULL, a plane.
typedef struct encounter {
    const fe__turning *way;
    fe__approach *pair;
    const fe__form *plane;
} encounter;

// g(t) across n.
static double separation(const encounter *e, double t, fe_dvec3 n)
{
    fe__mover moved = fe__turning_at(e->way, t);
    if (e->plane) return fe__height_over_plane(e->plane, &moved);
    e->pair->axes = moved.axes;
    return fe__separation_of(e->pair, moved.position, n) - e->pair->radius;
}

// Finds the direction of the nearest points at t, which comes into `here` with the point, and g(t) across it, m; it is
// below 0 by no more than a touch. 0: the forms overlap, `here` stays
static int32_t find_gap(const encounter *e, double t, double *distance, fe__approach_hit *here)
{
    fe__mover moved = fe__turning_at(e->way, t);
    if (e->plane) {
        fe_dvec3 n = fe__widen(e->plane->normal);
        *distance = fe__height_over_plane(e->plane, &moved);
        *here = (fe__approach_hit){t, fe__dscale(1.0 / sqrt(fe__ddot(n, n)), n), moved.position};
        return *distance >= -fe__touch_of(&moved);
    }
    fe__core_gap gap;
    e->pair->axes = moved.axes;
    (void)fe__sure_gap_of(e->pair, moved.position, &gap);
    if (gap.distance > 0.0) {
        fe__approach_hit nearest = {t, fe__dscale(1.0 / gap.distance, gap.away), gap.on_frame};
        *distance = fe__separation_of(e->pair, moved.position, nearest.normal) - e->pair->radius;
        if (*distance >= -fe__touch_of(&moved)) {
            *here = nearest;
            return 1;
        }
    }
    // Rounding makes the direction between nearest points that all but meet.
    fe__approach pair = *e->pair;
    pair.position = moved.position;
    fe__core_overlap overlap = fe__approach_overlap(&pair);
    *distance = -overlap.depth;
    if (fe__is_inside(&pair, &overlap)) return 0;
    *here = (fe__approach_hit){t, overlap.way_out, fe__touching_point(&pair, &overlap)};
    return 1;
}

// The first zero in (0, 1) of  (1 - x) at_0 + x at_1 - c x (1 - x) = at_0 + b x + c x^2,  at_0 > 0; 1: none
static double first_zero(double at_0, double at_1, double c)
{
    double b = at_1 - at_0 - c, square = b * b - 4.0 * c * at_0;
    if (b >= 0.0 || square < 0.0) return 1.0;
    return fe__mind(2.0 * at_0 / (sqrt(square) - b), 1.0);
}

// The forms are farther apart than `goal` at here->t. Returns how long they surely stay so.
static double safe_way(const encounter *e, const fe__approach_hit *here, double distance, double goal, double end)
{
    const fe__turning *way = e->way;
    fe_dvec3 n = here->normal, across = fe__dcross(n, way->axis);
    double t = here->t, slack = distance - goal, turning = way->angle * way->reach * sqrt(fe__ddot(across, across));
    double speed = turning - fe__ddot(n, way->mover->translation), bend = 0.5 * way->angle * turning, rest = end - t;
    if (!(speed * rest > slack)) return rest;
    double safe = slack / speed, ratio = FARTHER;
    for (int32_t i = 0; i < MOST_LOOKAHEADS && safe < rest; ++i) {
        double ahead = fe__mind(ratio * safe, rest);
        double x = first_zero(slack, separation(e, t + ahead, n) - goal, bend * ahead * ahead);
        if (x < 1.0) ratio = NEARER;
        if (!(x * ahead > safe)) break;
        safe = x * ahead;
    }
    return safe;
}

int32_t fe__turning_stays_beyond(const fe__turning *way, fe__approach *pair, fe_dvec3 n, double from)
{
    const encounter e = {way, pair, NULL};
    const double touch = fe__touch_of(way->mover);
    fe__approach_hit here = {from, n, way->mover->position};
    for (int32_t i = 0; i < MOST_LOOKAHEADS; ++i) {
        double distance = separation(&e, here.t, n);
        if (!(distance >= -0.5 * touch)) return 0;
        here.t += safe_way(&e, &here, distance, -touch, 1.0);
        if (here.t >= 1.0) return 1;
    }
    return 0;
}

// The forms touch at *t, across here's normal. Do they come nearer by half a touch before `until`? If not, *t becomes
// the time when they are well apart, or `until`. The planes across the normal hold apart forms that slide along them;
// if other features come to face each other, the planes across the nearest points' direction do.
static int32_t comes_nearer(const encounter *e, fe__approach_hit here, double until, double *t)
{
    const double touch = fe__touch_of(e->way->mover);
    double distance = separation(e, *t, here.normal), goal = fe__mind(distance, 0.0) - 0.5 * touch;
    for (int32_t i = 0; distance <= LEFT * e->way->gap; ++i) {
        int32_t is_near = distance <= goal + TOLERANCE * touch;
        if (is_near && (!find_gap(e, *t, &distance, &here) || distance <= goal + TOLERANCE * touch)) return 1;
        here.t = *t;
        double step = safe_way(e, &here, distance, goal, until);
        if (*t + step <= *t || i == MOST_STEPS) return 1; // The step is below the rounding of t, or it takes too long.
        *t = fe__mind(*t + step, until);
        if (*t >= until) return 0;
        distance = separation(e, *t, here.normal);
    }
    return 0;
}

// The hit is at the beginning of the gap, or at once within it. It counts only if the mover comes on through half of
// the gap: a form that slides along a surface must not stick to it by a rounding. A mover that leaves the gap again has
// met nothing.
int32_t fe__turning_meets(const fe__turning *way, fe__approach *pair, const fe__form *plane, double from, double until,
                          fe__approach_hit *hit)
{
    const encounter e = {way, pair, plane};
    fe__approach_hit here = {from, {0.0, 1.0, 0.0}, way->mover->position};
    double t = from, goal = way->gap, clearance = way->gap, distance;
    int32_t entered = 0, met = 0;
    for (int32_t i = 0; !met; ++i) {
        int32_t apart = find_gap(&e, t, &distance, &here);
        if (!entered && apart && distance <= fe__touch_of(way->mover)) {
            double later = t;
            met = comes_nearer(&e, here, until, &later);
            *hit = here;
            if (!met && later >= until) return 0;
            t = later;
            continue;
        }
        if (entered && distance > LEFT * way->gap) entered = 0, clearance = goal = way->gap;
        if (!entered && (!apart || distance <= (1.0 + TOLERANCE) * way->gap || i == MOST_STEPS)) {
            here.t = t, *hit = here, entered = 1;
            clearance = fe__mind(distance, way->gap), goal = 0.5 * clearance;
        }
        if (!entered && t >= until) return 0;
        met = entered && (!apart || distance <= goal + TOLERANCE * clearance || i >= MOST_STEPS);
        double end = entered ? 1.0 : until, step = met ? 0.0 : safe_way(&e, &here, distance, goal, end);
        if (!met && step >= end - t) return 0;
        met |= !met && t + step <= t; // The step is below the rounding of t.
        t += step;
    }
    if (pair) pair->axes = fe__turning_at(way, hit->t).axes;
    return hit->t <= until;
}

// ---- a form --------------------------------------------------------------------------------------------------------
int32_t fe__form_turn(const fe__form *still, const fe__mover *mover, double limit, fe__sweep_hit *hit)
{
    fe__turning way = fe__turning_of(mover);
    fe__mover start = fe__turning_at(&way, 0.0);
    start.translation = (fe_dvec3){0.0, 0.0, 0.0};
    if (fe__form_sweep(still, &start, limit, hit)) return 1; // The forms overlap at the start.
    int32_t unbounded = fe__form_is_unbounded(still);
    fe__approach pair = {.frame_kind = fe__core_kind_of(still),
                         .other_kind = fe__core_kind_of(mover->form),
                         .frame_form = still,
                         .other_form = mover->form,
                         .radius = (double)still->radius + (double)mover->form->radius,
                         .touch = fe__touch_of(mover)};
    fe__core_half(still, pair.frame_half), fe__core_half(mover->form, pair.other_half);
    fe__approach_hit h;
    if (!fe__turning_meets(&way, unbounded ? NULL : &pair, unbounded ? still : NULL, 0.0, limit, &h)) return 0;
    fe__mover stopped = fe__turning_at(&way, h.t);
    fe_dvec3 point = unbounded ? fe__point_of_plane(still, h.normal, &stopped)
                               : fe__dadd(h.point, fe__dscale((double)still->radius, h.normal));
    *hit = (fe__sweep_hit){.t = h.t, .normal = h.normal, .point = point, .triangle = -1};
    if (fe__form_is_hull(still)) hit->triangle = fe__hull_face_at(still, point, h.normal);
    return 1;
}

// ---- a heightfield or a mesh ---------------------------------------------------------------------------------------
// The motion is cut into pieces in which no point goes farther than the form's size and a cell, so that few triangles
// lie under each piece. A triangle that is met from the side that does not count lets the form pass, and counts again
// when the form has left it: a turn may bring it back.

// Steps of this share of the form's bounding radius find the time at which it leaves a triangle that it passes.
#define PASSING 1e-3

typedef struct field_turn {
    fe__field_search search;
    fe__turning way;
    double radius; // bounding radius about the form's origin, m
} field_turn;

static double distance_at(field_turn *f, double t)
{
    fe__mover moved = fe__turning_at(&f->way, t);
    fe__core_gap gap;
    f->search.pair.axes = moved.axes;
    return fe__sure_gap_of(&f->search.pair, moved.position, &gap) - f->search.pair.radius;
}

// The forms touch or overlap at *t, which becomes the time when they are apart again. 0: not before `until`
static int32_t pass(field_turn *f, double until, double *t)
{
    double step = PASSING * f->radius / fe__turning_speed(&f->way);
    do {
        *t += step;
        if (!(*t < until)) return 0;
    } while (distance_at(f, *t) <= 2.0 * f->way.gap);
    return 1;
}

// The lowest number wins between triangles that are hit at the same time.
static void meet_triangle(field_turn *f, int32_t triangle, double from, double until, fe__sweep_hit *best)
{
    fe__field_search *s = &f->search;
    int32_t number = fe__ground_number(s->surface, triangle), two_sided = fe__ground_is_two_sided(s->surface);
    fe__field_take(s, triangle);
    double t = from, end = fe__mind(until, best->t);
    if (fe__turning_stays_beyond(&f->way, &s->pair, s->pair.normal, from)) return;
    if (from > 0.0 && !two_sided && distance_at(f, t) <= 0.0 && !pass(f, end, &t)) return;
    fe__approach_hit hit;
    while (fe__turning_meets(&f->way, &s->pair, NULL, t, end, &hit)) {
        if (two_sided || fe__field_is_met(s, triangle, &hit)) {
            if (best->triangle >= 0 && hit.t == best->t && number > best->triangle) return;
            *best = (fe__sweep_hit){
                .t = hit.t, .normal = hit.normal, .point = hit.point, .triangle = number, .index = triangle};
            return;
        }
        t = hit.t;
        if (!pass(f, end, &t)) return;
    }
}

// Half widths of a box around the mover's origin that holds the turning form from t0 to t1.
static fe_dvec3 half_between(const field_turn *f, double t0, double t1)
{
    fe__mover moved = fe__turning_at(&f->way, 0.5 * (t0 + t1));
    fe_dvec3 half = fe__field_search_of(f->search.surface, &moved).half;
    double arc = 0.5 * (t1 - t0) * f->way.angle * f->way.reach;
    return (fe_dvec3){fe__mind(half.x + arc, f->radius), fe__mind(half.y + arc, f->radius),
                      fe__mind(half.z + arc, f->radius)};
}

int32_t fe__ground_turn(const fe__ground *surface, const fe__mover *mover, double limit, fe__sweep_hit *hit)
{
    const double rounding = 1.000001; // The bounding radius is a float.
    field_turn f = {.search = fe__field_search_of(surface, mover), .way = fe__turning_of(mover)};
    f.radius = rounding * (double)fe__form_reach(mover->form, fe__vec3(0.0f, 0.0f, 0.0f));
    fe__mover start = fe__turning_at(&f.way, 0.0);
    start.translation = (fe_dvec3){0.0, 0.0, 0.0};
    if (fe__ground_sweep(surface, &start, limit, hit)) return 1; // The form overlaps the surface at the start.
    f.search.pair.gap = f.way.gap;
    f.search.half = (fe_dvec3){f.radius, f.radius, f.radius};
    double t, end;
    if (!fe__field_clip(&f.search, limit, &t, &end)) return 0;
    fe_dvec3 cell = fe__ground_cell(surface), d = mover->translation;
    double arc = f.way.angle * f.way.reach, cells_x = (fe__absd(d.x) + arc) / (cell.x + f.radius),
           cells_y = (fe__absd(d.y) + arc) / (cell.y + f.radius), cells_z = (fe__absd(d.z) + arc) / (cell.z + f.radius),
           cells = fe__maxd(fe__maxd(cells_x, cells_y), cells_z), piece = cells > 0.0 ? 1.0 / cells : (double)INFINITY;
    *hit = (fe__sweep_hit){.t = limit, .triangle = -1};
    for (;;) {
        double to = fe__mind(t + piece, end);
        if (!(to > t)) to = end; // The piece is below the rounding of t.
        f.search.half = half_between(&f, t, to);
        fe__bounds box = fe__field_covered(&f.search, t, to);
        fe__ground_walk walk;
        fe__ground_begin(&walk, surface, &box, mover->position);
        for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) meet_triangle(&f, i, t, to, hit);
        if (hit->triangle >= 0) return 1;
        if (to >= end) return 0;
        t = to;
    }
}
