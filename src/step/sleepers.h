// sleepers.h - whom a contact wakes: what sleeps wakes by a touch, and not because something passes close by.
#ifndef FE_STEP_SLEEPERS_H
#define FE_STEP_SLEEPERS_H
#include "world/step_scratch.h"

// Does the pair, which has points, leave one of its two asleep, because they cannot touch within the step? Asked when
// the manifolds of all pairs are known
int32_t fe__pair_lets_sleep(const fe__step *step, int32_t pair);

#endif
