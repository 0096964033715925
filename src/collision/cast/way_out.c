// way_out.c - the way out of a heightfield or a mesh for a form that overlaps it.
//
// A surface of triangles has no inside that would tell: candidates are tried. A candidate is a direction; how far it
// leads is found by coming back along it, from where the form is free, to the first touch. That touch must be one from
// the side that counts. Candidates are the normals of the triangles that are overlapped, the ways out of each of them
// alone, and the least translation that satisfies all of either kind at once, as in a corner (Hildreth 1957).
#include "collision/cast/field_search.h"
#include "collision/cast/sweep.h"

enum {
    MOST_WAYS = 16,  // of each kind; alike ones are one
    LEAST_TRIES = 3, // however many triangles there are
    WORK = 2048,     // triangles that are looked at, all tries together
    PASSES = 64,     // of the least translation
    DOUBLINGS = 4    // of how far the deepest triangle says, until a way parts the two
};
#define SAME_WAY 0.9998 // cosine: a degree

typedef struct way {
    fe_dvec3 direction; // unit
    double length;      // m, at least
} way;

typedef struct ways {
    way way[MOST_WAYS];
    int32_t count;
} ways;

static void add_way(ways *w, fe_dvec3 direction, double length)
{
    for (int32_t i = 0; i < w->count; ++i) {
        if (fe__ddot(w->way[i].direction, direction) < SAME_WAY) continue;
        w->way[i].length = fe__maxd(w->way[i].length, length);
        return;
    }
    if (w->count < MOST_WAYS) w->way[w->count++] = (way){direction, length};
}

typedef struct overlaps {
    ways planes, alone; // over the planes of triangles; out of triangles alone
    int32_t count;      // of triangles that are looked at
    double least;       // m: the longest way out of one alone; no translation that parts all is shorter
} overlaps;

static void gather(fe__field_search *s, overlaps *all)
{
    int32_t is_two_sided = fe__ground_is_two_sided(s->surface);
    fe__bounds box = fe__field_covered(s, 0.0, 0.0);
    fe__ground_walk walk;
    fe__ground_begin(&walk, s->surface, &box, s->mover->position);
    for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) {
        all->count += 1;
        fe__field_take(s, i);
        fe__core_overlap o = fe__approach_overlap(&s->pair);
        if (!fe__is_inside(&s->pair, &o)) continue;
        all->least = fe__maxd(all->least, o.depth);
        add_way(&all->planes, s->pair.normal, fe__field_depth(s));
        const double rounding = 1e-9; // of a way's length; cores that just touch have none
        if (fe__absd(fe__ddot(o.way_out, o.way_out) - 1.0) < rounding &&
            (is_two_sided || fe__ddot(o.way_out, s->pair.normal) >= 0.0))
            add_way(&all->alone, o.way_out, o.depth);
        else
            add_way(&all->alone, s->pair.normal, fe__field_depth(s));
    }
}

// The least x with direction . x >= length for all ways: x = sum_i pull_i direction_i, pull_i >= 0, each pull in turn
static fe_dvec3 least_translation(const ways *w)
{
    double pull[MOST_WAYS] = {0.0};
    fe_dvec3 x = {0.0, 0.0, 0.0};
    for (int32_t pass = 0; pass < PASSES; ++pass) {
        for (int32_t i = 0; i < w->count; ++i) {
            fe_dvec3 d = w->way[i].direction;
            double more = fe__maxd(w->way[i].length - fe__ddot(d, x), -pull[i]);
            pull[i] += more;
            x = fe__dadd(x, fe__dscale(more, d));
        }
    }
    return x;
}

// ---- one candidate -------------------------------------------------------------------------------------------------
// How far out along `direction` the mover is free, coming back from `length`; infinite when it is not free there, or
// was on the wrong side.
static double way_along(const fe__field_search *from, fe_dvec3 direction, double length)
{
    fe__mover mover = *from->mover;
    mover.position = fe__dadd(mover.position, fe__dscale(length, direction));
    mover.translation = fe__dscale(-length, direction);
    fe__field_search s = fe__field_search_of(from->surface, &mover);
    fe__approach_hit first = {.t = 1.0}, hit;
    int32_t is_right = 0;
    fe__bounds box = fe__field_covered(&s, 0.0, 1.0);
    fe__ground_walk walk;
    fe__ground_begin(&walk, s.surface, &box, mover.position);
    for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) {
        fe__field_take(&s, i);
        fe__core_overlap overlap = fe__approach_overlap(&s.pair);
        if (fe__is_inside(&s.pair, &overlap)) return (double)INFINITY;
        if (!fe__approach_sweep(&s.pair, &overlap, first.t, &hit) || !(hit.t < first.t)) continue;
        first = hit;
        is_right = fe__ground_is_two_sided(s.surface) || fe__field_is_met(&s, i, &hit);
    }
    return is_right ? (1.0 - first.t) * length : (double)INFINITY;
}

typedef struct trial {
    const fe__field_search *search;
    fe__sweep_hit *best;
    double least;         // m: what is no longer ends the search
    int32_t parts, tries; // does the best part the two? how many may follow when it does
} trial;

// A little farther than needed, so that it is free there
static void try_way(trial *t, fe_dvec3 direction, double length)
{
    const double spare = 1e-6, share = 1e-6; // m; of the length
    if (t->parts && t->tries <= 0) return;
    t->tries -= 1;
    double from = t->parts ? fe__mind(length, t->best->depth) : length;
    double depth = way_along(t->search, direction, from + spare + share * from + 4.0 * t->search->pair.gap);
    if (t->parts ? !(depth < t->best->depth) : depth == (double)INFINITY) return;
    t->best->normal = direction, t->best->depth = depth;
    t->parts = 1;
    if (depth <= t->least) t->tries = 0;
}

static void try_translation(trial *t, fe_dvec3 x)
{
    double length = sqrt(fe__ddot(x, x));
    if (length > 0.0) try_way(t, fe__dscale(1.0 / length, x), length);
}

static void try_ways(trial *t, const ways *w, double length)
{
    for (int32_t i = 0; i < w->count; ++i) try_way(t, w->way[i].direction, length);
}

void fe__field_way_out(const fe__field_search *search, fe__sweep_hit *hit)
{
    fe__field_search s = *search;
    overlaps all = {0};
    gather(&s, &all);
    const double alike = 1.001, rounding = 1e-5; // m
    trial t = {search, hit, alike * all.least + rounding, 0, fe__maxi(WORK / fe__maxi(all.count, 1), LEAST_TRIES)};
    try_way(&t, hit->normal, hit->depth);
    try_translation(&t, least_translation(&all.alone));
    try_translation(&t, least_translation(&all.planes));
    double length = fe__maxd(hit->depth, all.least);
    for (int32_t i = 0; i < DOUBLINGS && !(i && t.parts); ++i, length += length) {
        try_ways(&t, &all.alone, length);
        try_ways(&t, &all.planes, length);
    }
}
