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
    uint64_t a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, g = 0, h = 0; // in registers, as an array would not be
    const unsigned char *at = bytes, *end = bytes + size;
    for (; end - at >= LANES * WORD; at += LANES * WORD) {
        a = step(a, word_at(at)), b = step(b, word_at(at + WORD));
        c = step(c, word_at(at + 2 * WORD)), d = step(d, word_at(at + 3 * WORD));
        e = step(e, word_at(at + 4 * WORD)), f = step(f, word_at(at + 5 * WORD));
        g = step(g, word_at(at + 6 * WORD)), h = step(h, word_at(at + 7 * WORD));
    }
    uint64_t lanes[LANES] = {a, b, c, d, e, f, g, h};
    for (int k = 0; at < end; ++k, at += WORD) lanes[k] = step(lanes[k], word_at(at));
    fe__hash sum = fe__hash_begin();
    for (int k = 0; k < LANES; ++k) fe__hash_u64(&sum, lanes[k]);
    fe__hash_u64(&sum, (uint64_t)size);
    return fe__hash_end(&sum);
}
