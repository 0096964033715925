// turning_field.c - a form that moves and turns, against a heightfield or a mesh: its triangles, piece by piece.
//
// The motion is cut where no point has gone farther than the form's size and a cell, so that few triangles lie under
// each piece. A triangle that is met from the side that does not count lets the form pass, and counts again when the
// form has left it: a turn may bring it back.
#include "collision/cast/field_search.h"
#include "collision/cast/sweep.h"
#include "collision/cast/turning.h"

// of the form's reach: how closely is looked for where it leaves a triangle that it passes
#define PASSING 1e-3

typedef struct field_turn {
    fe__field_search search;
    fe__turning way;
    double reach; // from the form's origin, m
} field_turn;

static double distance_at(field_turn *f, double t)
{
    fe__mover now = fe__turning_at(&f->way, t);
    fe__core_gap gap;
    f->search.pair.axes = now.axes;
    return fe__sure_gap_of(&f->search.pair, now.position, &gap) - f->search.pair.radius;
}

// From t on, where they touch or overlap: when they are apart again, at `*t`. 0: not before `until`
static int32_t pass(field_turn *f, double until, double *t)
{
    double step = PASSING * f->reach / fe__turning_speed(&f->way);
    do {
        *t += step;
        if (!(*t < until)) return 0;
    } while (distance_at(f, *t) <= 2.0 * f->way.gap);
    return 1;
}

// Of equal hits the triangle with the lowest number.
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

// Widths of a box around the mover's origin that holds it from t0 to t1, but for what the origin moves
static fe_dvec3 half_between(const field_turn *f, double t0, double t1)
{
    fe__mover now = fe__turning_at(&f->way, 0.5 * (t0 + t1));
    fe__field_search there = fe__field_search_of(f->search.surface, &now);
    double arc = 0.5 * (t1 - t0) * f->way.angle * f->way.reach;
    return (fe_dvec3){fe__mind(there.half.x + arc, f->reach), fe__mind(there.half.y + arc, f->reach),
                      fe__mind(there.half.z + arc, f->reach)};
}

int32_t fe__ground_turn(const fe__ground *surface, const fe__mover *mover, double limit, fe__sweep_hit *hit)
{
    const double rounding = 1.000001; // a reach is a float
    field_turn f = {.search = fe__field_search_of(surface, mover), .way = fe__turning_of(mover)};
    f.reach = rounding * (double)fe__form_reach(mover->form, fe__vec3(0.0f, 0.0f, 0.0f));
    fe__mover start = fe__turning_at(&f.way, 0.0);
    start.translation = (fe_dvec3){0.0, 0.0, 0.0};
    if (fe__ground_sweep(surface, &start, limit, hit)) return 1; // inside
    f.search.pair.gap = f.way.gap;
    f.search.half = (fe_dvec3){f.reach, f.reach, f.reach};
    double t, end;
    if (!fe__field_clip(&f.search, limit, &t, &end)) return 0;
    fe_dvec3 cell = fe__ground_cell(surface), d = mover->translation;
    double arc = f.way.angle * f.way.reach, cells_x = (fe__absd(d.x) + arc) / (cell.x + f.reach),
           cells_y = (fe__absd(d.y) + arc) / (cell.y + f.reach), cells_z = (fe__absd(d.z) + arc) / (cell.z + f.reach),
           cells = fe__maxd(fe__maxd(cells_x, cells_y), cells_z), piece = cells > 0.0 ? 1.0 / cells : (double)INFINITY;
    *hit = (fe__sweep_hit){.t = limit, .triangle = -1};
    for (;;) {
        double to = fe__mind(t + piece, end);
        if (!(to > t)) to = end; // a piece below the rounding of t
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
