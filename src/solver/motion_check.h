// motion_check.h - did a body overflow in this step?
#ifndef FE_SOLVER_MOTION_CHECK_H
#define FE_SOLVER_MOTION_CHECK_H
#include "solver/solver.h"

// Forces, masses and time steps at the limits of the API may overflow a float. No NaN outlives the step that made it,
// and none reaches a pose or a box. Ten times the fastest that the API takes, m/s and rad/s:
#define FE__MOST_SPEED 1e7f

// a NaN is less than nothing
static inline int32_t fe__is_less(const float *a, float most)
{
    return fe__absf(a[0]) < most && fe__absf(a[1]) < most && fe__absf(a[2]) < most;
}

static inline int32_t fe__motion_makes_sense(const fe__solver *s, int32_t line)
{
    const float *dq = s->motion[line].rotation, turned = dq[0] * dq[0] + dq[1] * dq[1] + dq[2] * dq[2] + dq[3] * dq[3];
    return fe__is_less(s->velocity[line].v, FE__MOST_SPEED) && fe__is_less(s->velocity[line].w, FE__MOST_SPEED) &&
           fe__is_less(s->motion[line].shift, FE__MOST_SPEED) && turned > 0.0f && turned < FE__MOST_SPEED;
}

#endif
