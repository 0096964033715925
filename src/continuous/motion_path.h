// way.h - where a body is at any time of the step at hand, between solver and finalize; and what stands in its way there.
//
// Read by the continuous stage, on any thread: nothing of the world is written.
#ifndef FE_WORLD_WAY_H
#define FE_WORLD_WAY_H
#include "collision/cast/toi.h"
#include "step/narrow.h"
#include "step/step.h"

// A body's motion since the step began: the centre's shift, and the turn, w >= 0.
typedef struct fe__shift {
    fe_dvec3 centre; // m
    fe_quat turn;
} fe__shift;

int32_t fe__way_legs(const fe__step *step, int32_t body);             // straight pieces of its way
double fe__way_time(const fe__step *step, int32_t body, int32_t leg); // when a piece begins: 0..1 of the step
fe__shift fe__shift_between(const fe__shift *a, const fe__shift *b, double t);
fe__shift fe__way_at(const fe__step *step, int32_t body, double time);
// from one time to another, in a frame at `base`, m
fe__motion fe__way_between(const fe__step *step, int32_t body, double from, double until, fe_dvec3 base);
fe__motion fe__way_from(const fe__body *body, const fe__shift *from, const fe__shift *to, fe_dvec3 base);
fe__mobile fe__way_of_shape(const fe__step *step, const fe__shape *shape, const fe__motion *motion);
float fe__way_length(const fe__step *step, int32_t body); // no point of it went farther, m

// What a body meets on one leg. Its shapes count as met where they would be deeper than a share of their thickness: what the solver lets
// overlap, rests or slides is never met.
typedef struct fe__obstacle {
    double time;     // of the step: where the whole shape touches
    fe_dvec3 normal; // unit, from the body to it; 0: not known
    fe_dvec3 point;  // of it
    int32_t body;    // -1: nothing
} fe__obstacle;

enum { FE__AGAINST_FIXED, FE__AGAINST_DYNAMIC }; // static and kinematic bodies; dynamic ones

// Could it meet anything at all? Cheap; may say yes too often.
int32_t fe__way_is_barred(const fe__step *step, int32_t body, int32_t against);
// The first on its motion from `from` to `to`, between two times of the step.
fe__obstacle fe__way_meets(const fe__step *step, int32_t body, int32_t against, const fe__shift *from, const fe__shift *to, double begin,
                           double end);
// Do two shapes, neither a heightfield, touch on their bodies' ways?
int32_t fe__ways_cross(const fe__step *step, int32_t shape_a, int32_t shape_b);

#endif
