// shares.h - blocks of work, dealt out to workers so that each finds again what it had.
//
// A pass has blocks that can be done in any order by anyone. Each worker has a share of them: neighbours, and the same
// part of every pass. So what it reads and writes stays in the caches of its core from pass to pass, and from step to
// step. Who has done its own may help with the shares after it. The idea of a worker's own first block is Box2D v3's
// (Erin Catto, "SIMD Matters", 2024).
#ifndef FE_CORE_SHARES_H
#define FE_CORE_SHARES_H
#include "core/threads.h"

#include <stdatomic.h>
#include <stdint.h>

typedef struct fe__shares {
    int32_t count;                                  // workers
    _Alignas(FE_CACHE_LINE) _Atomic uint64_t taken; // bit w: worker w is somebody
    struct {
        _Alignas(FE_CACHE_LINE) _Atomic uint64_t next; // pass << 32 | blocks of the share that are claimed
    } of[FE_MAX_WORKERS];
} fe__shares;

// Where a worker claims in a pass
typedef struct fe__claims {
    int32_t worker;
    int32_t offset; // shares that it has looked at, from its own on
} fe__claims;

typedef enum fe__reach {
    FE__OWN_SHARES, // its own, and those of workers who have not come
    FE__ALL_SHARES
} fe__reach;

// Before workers come, at most `count` of them: 1..FE_MAX_WORKERS.
void fe__shares_begin(fe__shares *shares, int32_t count);
// A worker's number, that of nobody else in these shares: the thread's own, see fe__thread_number, unless it is taken.
int32_t fe__shares_join(fe__shares *shares);
// Where claims of a pass begin, and again where the reach is another
static inline fe__claims fe__claims_of(int32_t worker) { return (fe__claims){worker, 0}; }
// A block in [0, block_count) that nobody else gets, or -1: none is left within reach. Passes go up from 1, and all
// blocks of one are claimed before the first of the next. Orders nothing in memory.
int32_t fe__shares_claim(fe__shares *shares, fe__claims *claims, fe__reach reach, uint32_t pass, int32_t block_count);

#endif
