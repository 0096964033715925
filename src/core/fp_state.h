// fp_state.h - the floating-point state that every result rests on: round to nearest, denormals kept, no traps.
//
// Saved and set on entry, restored on exit of each call that computes, and on every worker.
#ifndef FE_CORE_FP_STATE_H
#define FE_CORE_FP_STATE_H
#include <stdint.h>

typedef struct fe__fp_state {
    uint64_t saved;
} fe__fp_state;
fe__fp_state fe__fp_enter(void);
void fe__fp_leave(fe__fp_state state);

#endif
