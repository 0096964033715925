// pairs_stage.h - the stage that finds new pairs.
#ifndef FE_STEP_PAIRS_STAGE_H
#define FE_STEP_PAIRS_STAGE_H
#include "world/step_scratch.h"

void fe__find_new_pairs(fe__step *step); // queries of moved proxies -> candidates; reserves all; new pairs

#endif
