// solve.h - the substeps.
#ifndef FE_SOLVER_SOLVE_H
#define FE_SOLVER_SOLVE_H
#include "solver/solver.h"

// All substeps of all batches. The lines then hold what the step did; contacts and joints their impulses.
// `constants`: of each pace.
void fe__solve(fe__solver *s, const fe__kernels *kernels, const fe__workers *workers, const fe__records *of,
               const fe__step_constants constants[FE__PACES]);
// After it: which islands the next step solves in another way, and whether it needs another graph
void fe__note_solved(fe__solver *s, const fe__kernels *kernels, const fe__records *of);
fe__softness fe__make_softness(float hertz, float damping_ratio, float h);

// ---- impact chain ---------------------------------------------------------------------------------------------------
// Chains of impacts within a substep.

// After the bounces of contacts that are alone with their bodies: those of a batch that are not, one after another.
// Called by one worker. `rows`: of the batch.
void fe__pass_on(fe__solver *s, const fe__kernels *kernels, const fe__records *of, const fe__batch *b,
                 unsigned char *rows, const fe__step_constants *c);

#endif
