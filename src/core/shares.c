// shares.c - see shares.h.
#include "core/shares.h"

#include <assert.h>

void fe__shares_begin(fe__shares *shares, int32_t count)
{
    assert(count >= 1 && count <= FE_MAX_WORKERS);
    shares->count = count;
    atomic_init(&shares->taken, 0);
    for (int32_t i = 0; i < count; ++i) atomic_init(&shares->of[i].next, 0);
}

int32_t fe__shares_join(fe__shares *shares)
{
    int32_t worker = fe__thread_number() % shares->count;
    for (;; worker = (worker + 1) % shares->count) {
        uint64_t bit = (uint64_t)1 << worker;
        if (!(atomic_fetch_or_explicit(&shares->taken, bit, memory_order_relaxed) & bit)) return worker;
    }
}

// The first block of a worker's share; of the one after the last: all blocks
static int32_t first_of(const fe__shares *shares, int32_t worker, int32_t block_count)
{
    return (int32_t)(((int64_t)block_count * worker + shares->count - 1) / shares->count);
}

// -1: all of the share are claimed
static int32_t claim_of(_Atomic uint64_t *next, uint32_t pass, int32_t block_count)
{
    uint64_t seen = atomic_load_explicit(next, memory_order_relaxed);
    for (;;) {
        uint32_t at = (uint32_t)(seen >> 32);
        int32_t block = at == pass ? (int32_t)(seen & UINT32_MAX) : 0;
        if (at > pass || block >= block_count) return -1;
        uint64_t after = (uint64_t)pass << 32 | (uint32_t)(block + 1);
        if (atomic_compare_exchange_weak_explicit(next, &seen, after, memory_order_relaxed, memory_order_relaxed))
            return block;
    }
}

int32_t fe__shares_claim(fe__shares *shares, fe__claims *claims, fe__reach reach, uint32_t pass, int32_t block_count)
{
    uint64_t taken = atomic_load_explicit(&shares->taken, memory_order_relaxed);
    for (; claims->offset < shares->count; ++claims->offset) {
        int32_t owner = (claims->worker + claims->offset) % shares->count;
        if (reach == FE__OWN_SHARES && claims->offset > 0 && taken >> owner & 1) continue;
        int32_t first = first_of(shares, owner, block_count), end = first_of(shares, owner + 1, block_count);
        int32_t block = claim_of(&shares->of[owner].next, pass, end - first);
        if (block >= 0) return first + block;
    }
    return -1;
}
