// sum.c - see sum.h. Eight lanes of the step of core/hash.h side by side, whose multiplications do not wait for each
// other; then the lanes one after another, and the size.
#include "state/sum.h"

#include "core/bytes.h"
#include "core/hash.h"

enum { LANES = 8, WORD = 8 };

static inline uint64_t word_at(const unsigned char *at)
{
    uint64_t word;
    if (!FE_IS_LITTLE_ENDIAN) return fe__take_u64(&at);
    memcpy(&word, at, sizeof word);
    return word;
}

static inline uint64_t step(uint64_t state, uint64_t word)
{
    state = (state ^ word) * FE_HASH_FACTOR;
    return state ^ state >> 32;
}

uint64_t fe__sum_of(const unsigned char *bytes, int64_t size)
{
    uint64_t lanes[LANES] = {0};
    const unsigned char *at = bytes, *end = bytes + size;
    for (; end - at >= LANES * WORD; at += LANES * WORD)
        for (int k = 0; k < LANES; ++k) lanes[k] = step(lanes[k], word_at(at + WORD * k));
    for (int k = 0; at < end; ++k, at += WORD) lanes[k] = step(lanes[k], word_at(at));
    fe__hash sum = fe__hash_begin();
    for (int k = 0; k < LANES; ++k) fe__hash_u64(&sum, lanes[k]);
    fe__hash_u64(&sum, (uint64_t)size);
    return fe__hash_end(&sum);
}
