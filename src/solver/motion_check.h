// motion_check.h - did a body overflow in this step?
#ifndef FE_SOLVER_MOTION_CHECK_H
#define FE_SOLVER_MOTION_CHECK_H
#include "solver/solver.h"

// Forces, masses and time steps at the limits of the API may overflow a float. No NaN outlives the step that made it,
// and none reaches a pose or a box. Ten times the fastest that the API takes, m/s and rad/s:
#define FE__MOST_SPEED 1e7f

static inline int32_t fe__motion_makes_sense(const fe__solver *s, int32_t line)
{
    const float *v = s->velocity[line].v, *w = s->velocity[line].w, *dp = s->motion[line].shift,
                *dq = s->motion[line].rotation, most = FE__MOST_SPEED * FE__MOST_SPEED;
    float turned = dq[0] * dq[0] + dq[1] * dq[1] + dq[2] * dq[2] + dq[3] * dq[3];
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2] < most && w[0] * w[0] + w[1] * w[1] + w[2] * w[2] < most &&
           // a NaN is less than nothing
           dp[0] * dp[0] + dp[1] * dp[1] + dp[2] * dp[2] < most && turned > 0.0f && turned < most;
}

#endif
