// sum.c - see sum.h. Four lanes of core/hash.h side by side, whose multiplications do not wait for each other; then the
// lanes one after another.
#include "state/sum.h"

#include "core/bytes.h"
#include "core/hash.h"

enum { LANES = 4, WORD = 8 };

static inline uint64_t word_at(const unsigned char *at)
{
    uint64_t word;
    if (!FE_IS_LITTLE_ENDIAN) return fe__take_u64(&at);
    memcpy(&word, at, sizeof word);
    return word;
}

uint64_t fe__sum_of(const unsigned char *bytes, int64_t size)
{
    fe__hash lanes[LANES], sum = fe__hash_begin();
    for (int k = 0; k < LANES; ++k) lanes[k] = fe__hash_begin();
    const unsigned char *at = bytes, *end = bytes + size;
    for (; end - at >= LANES * WORD; at += LANES * WORD)
        for (int k = 0; k < LANES; ++k) fe__hash_u64(lanes + k, word_at(at + WORD * k));
    for (int k = 0; at < end; ++k, at += WORD) fe__hash_u64(lanes + k, word_at(at));
    for (int k = 0; k < LANES; ++k) fe__hash_u64(&sum, fe__hash_end(lanes + k));
    return fe__hash_end(&sum);
}
