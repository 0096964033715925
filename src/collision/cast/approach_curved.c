// approach_curved.c - sweeps and overlaps of what its support function alone describes, a cylinder, a cone or a hull,
// with anything that has a core.
//
// Nearest points by GJK and depths by EPA, in the frame of the approach. As for the other forms the distance is a
// convex function of the way, and its tangent never goes too far.
#include "collision/cast/approach.h"
#include "collision/form/epa.h"

enum { MAX_STEPS = 64 };
#define TOLERANCE 0.1 // of the gap: a stop within that of it is one

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

void fe__curved_gap_of(const fe__approach *s, fe_dvec3 position, fe__core_gap *gap)
{
    fe__cores cores = cores_at(s, position);
    fe__gjk gjk;
    fe__gjk_distance(&cores, (double)INFINITY, &gjk);
    gap->distance = gjk.distance;
    gap->on_frame = gjk.on_a;
    gap->away = fe__dsub(gjk.on_b, gjk.on_a);
}

double fe__curved_depth(const fe__approach *s, fe_dvec3 *way_out)
{
    fe__cores cores = cores_at(s, s->position);
    fe__gjk gjk;
    fe__gjk_distance(&cores, (double)INFINITY, &gjk);
    fe__penetration p = fe__epa_depth(&cores, &gjk);
    *way_out = p.normal;
    return p.depth;
}

// From `t` to where the distance is `goal`, or a little more. 0: it never comes so near. Cores that are nearer than GJK
// can tell have met.
static int32_t advance(const fe__approach *s, double goal, double tolerance, double *t, fe__core_gap *gap)
{
    for (int32_t i = 0;; ++i) {
        fe__core_gap here;
        fe__curved_gap_of(s, fe__dadd(s->position, fe__dscale(*t, s->translation)), &here);
        if (!(here.distance > 0.0)) return i > 0;
        *gap = here;
        double rate = fe__ddot(here.away, s->translation) / here.distance; // of the distance, m per t
        if (!(rate < 0.0)) return 0;
        if (here.distance <= goal + tolerance || i == MAX_STEPS) return 1;
        *t += (here.distance - goal) / -rate;
        if (!(*t <= 1.0)) return 0;
    }
}

int32_t fe__curved_sweep(const fe__approach *s, double limit, fe__approach_hit *hit)
{
    double t = 0.0;
    fe__core_gap gap, nearer;
    if (!advance(s, s->radius + s->gap, TOLERANCE * s->gap, &t, &gap) || !(t <= limit)) return 0;
    *hit = (fe__approach_hit){t, fe__dscale(1.0 / gap.distance, gap.away), gap.on_frame};
    double clearance = fe__mind(gap.distance - s->radius, s->gap);
    return advance(s, s->radius + 0.5 * clearance, TOLERANCE * clearance, &t, &nearer);
}
