// obstacle.h - what stands in the path of a body.
//
// Read by the continuous stage, on any thread: nothing of the world is written.
#ifndef FE_CONTINUOUS_OBSTACLE_H
#define FE_CONTINUOUS_OBSTACLE_H
#include "continuous/motion_path.h"

// What a body meets on one leg. Its shapes count as met where they would be deeper than a share of their thickness:
// what the solver lets overlap, rests or slides is never met.
typedef struct fe__obstacle {
    double time;     // of the step: where the whole shape touches
    fe_dvec3 normal; // unit, from the body to it; 0: not known
    fe_dvec3 point;  // of it
    int32_t body;    // -1: nothing
} fe__obstacle;

enum { FE__AGAINST_FIXED, FE__AGAINST_DYNAMIC }; // static and kinematic bodies; dynamic ones

// Could it meet anything at all? Cheap; may say yes too often.
int32_t fe__path_is_blocked(const fe__step *step, int32_t body, int32_t against);
// The first on its motion from `from` to `to`, between two times of the step.
fe__obstacle fe__first_obstacle(const fe__step *step, int32_t body, int32_t against, const fe__shift *from,
                                const fe__shift *to, double begin, double end);
// Do two shapes, neither a heightfield, touch on their bodies' motion paths?
int32_t fe__paths_cross(const fe__step *step, int32_t shape_a, int32_t shape_b);

#endif
