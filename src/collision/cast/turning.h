// turning.h - a form that moves and turns at a constant rate, against a form that stands.
//
// The origin of the form goes straight; its axes turn by t |turn| about the turn's direction, through that origin, in
// the frame of the standing form. Called by the queries, as sweep.h for what does not turn. It stops before the other
// form by the sweeps' gap and FE_TURN_ROUNDING of its reach: a rotation rounded to floats does not carry it in.
#ifndef FE_COLLISION_CAST_TURNING_H
#define FE_COLLISION_CAST_TURNING_H
#include "collision/cast/approach.h"

// rad: twice what rounding its four floats turns a rotation by
#define FE_TURN_ROUNDING 2.4e-7

// Does the turn show? A ball looks the same, so does what is round about the axis.
int32_t fe__form_shows_turn(const fe__form *form, const fe__axes *axes, fe_dvec3 turn);
// No point of the core is farther from an axis through the form's origin (unit, form's frame), m
double fe__reach_across(const fe__form *form, fe_dvec3 axis);

typedef struct fe__turning {
    const fe__mover *mover; // whose turn shows
    fe_dvec3 axis;          // of the turn, unit
    double angle;           // rad, until t = 1
    double reach;           // of the core across the axis, m
    double gap;             // where it stops, m
} fe__turning;

fe__turning fe__turning_of(const fe__mover *mover);
fe__mover fe__turning_at(const fe__turning *way, double t); // as it is then; its turn is 0
// m per unit of t: no point of the mover is faster
double fe__turning_speed(const fe__turning *way);

// What stands: the frame of `pair`, or a half space. The first meeting in [from, until], the two being apart at `from`;
// only what comes on through half the gap, then or later, is met. 1: hit; the pair is left as it is there.
int32_t fe__turning_meets(const fe__turning *way, fe__approach *pair, const fe__form *plane, double from, double until,
                          fe__approach_hit *hit);

// Do planes across n (unit, from what stands to what moves) hold the two apart from then on, or touching?
int32_t fe__turning_stays_beyond(const fe__turning *way, fe__approach *pair, fe_dvec3 n, double from);

// The first t in [0, limit] at which they meet, in `mover` apart or overlapping at the start. 1: hit.
int32_t fe__form_turn(const fe__form *still, const fe__mover *mover, double limit, fe__sweep_hit *hit);
int32_t fe__ground_turn(const fe__ground *surface, const fe__mover *mover, double limit, fe__sweep_hit *hit);

#endif
