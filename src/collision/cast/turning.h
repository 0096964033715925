// turning.h - a form that moves and turns at a constant rate, against a form that stands.
//
// The queries call it, as they call sweep.h for forms that do not turn. The origin of the form goes straight; its axes
// turn by t |turn| about the turn's direction, through that origin, in the frame of the standing form. The form stops
// before the other one by the sweeps' gap and FE_TURN_ROUNDING of its bounding radius: a rotation rounded to floats
// does not carry it in.
#ifndef FE_COLLISION_CAST_TURNING_H
#define FE_COLLISION_CAST_TURNING_H
#include "collision/cast/approach.h"

// Twice the angle by which the rounding of its four floats turns a rotation, rad.
#define FE_TURN_ROUNDING 2.4e-7

// Does the turn show? A ball looks the same, and so does a form that is round about the axis.
int32_t fe__form_shows_turn(const fe__form *form, const fe__axes *axes, fe_dvec3 turn);
// No point of the core is farther than this from an axis through the form's origin (unit, form's frame), m.
double fe__reach_across(const fe__form *form, fe_dvec3 axis);

typedef struct fe__turning {
    const fe__mover *mover; // The turn of the mover shows.
    fe_dvec3 axis;          // axis of the turn, unit
    double angle;           // rad, up to t = 1
    double reach;           // fe__reach_across the axis, m
    double gap;             // The form stops so far before the other one, m.
} fe__turning;

fe__turning fe__turning_of(const fe__mover *mover);
// The mover as it is at t, with a turn of 0.
fe__mover fe__turning_at(const fe__turning *way, double t);
// No point of the mover is faster, m per unit of t.
double fe__turning_speed(const fe__turning *way);

// The standing form is the frame of `pair`, or a half space. Finds the first meeting in [from, until]; the two are
// apart at `from`. A form is met only if the mover comes on through half the gap, then or later. 1: hit; the pair is
// left as it is there.
int32_t fe__turning_meets(const fe__turning *way, fe__approach *pair, const fe__form *plane, double from, double until,
                          fe__approach_hit *hit);

// Do planes across n (unit, from the standing to the moving form) hold the two apart, or touching, from then on?
int32_t fe__turning_stays_beyond(const fe__turning *way, fe__approach *pair, fe_dvec3 n, double from);

// Finds the first t in [0, limit] at which the forms meet; they may overlap at the start. 1: hit
int32_t fe__form_turn(const fe__form *still, const fe__mover *mover, double limit, fe__sweep_hit *hit);
int32_t fe__ground_turn(const fe__ground *surface, const fe__mover *mover, double limit, fe__sweep_hit *hit);

#endif
