// pass_on.h - chains of impacts within a substep.
#ifndef FE_SOLVER_PASS_ON_H
#define FE_SOLVER_PASS_ON_H
#include "solver/solver.h"

// After the bounces of contacts that are alone with their bodies: those of a batch that are not, one after another.
// Called by one worker. `rows`: of the batch.
void fe__pass_on(fe__solver *s, const fe__kernels *kernels, const fe__records *of, const fe__batch *b,
                 unsigned char *rows, const fe__step_constants *c);

#endif
