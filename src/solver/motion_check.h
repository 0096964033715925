// motion_check.h - did a body overflow in this step?
#ifndef FE_SOLVER_MOTION_CHECK_H
#define FE_SOLVER_MOTION_CHECK_H
#include "core/bytes.h"
#include "core/simd.h"
#include "solver/solver.h"

// Forces, masses and time steps at the limits of the API may overflow a float. No NaN outlives the step that made it,
// and none reaches a pose or a box. A NaN is less than nothing. Of the first three quads the fourth lane is no part of
// the motion.
static inline int32_t fe__motion_makes_sense(const fe__solver *s, int32_t line)
{
    const wide most = w_set(FE_MOST_SPEED);
    const quad *velocity = (const quad *)(s->velocity + line), *motion = (const quad *)(s->motion + line);
    wide_mask less =
        w_greater(most, w_abs(velocity[0])) & w_greater(most, w_abs(velocity[1])) & w_greater(most, w_abs(motion[0]));
    wide turned = w_abs(motion[1]);
    return (w_bits(less) & 7) == 7 && w_bits(w_greater(most, turned)) == 15 && w_any(w_greater(turned, w_set(0.0f)));
}

#endif
