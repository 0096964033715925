// sum.c - see sum.h. Eight lanes of the step of core/hash.h side by side, whose multiplications do not wait for each
// other; then the lanes one after another, and the size.
#include "state/sum.h"

#include "core/bytes.h"
#include "core/hash.h"

enum { WORD = 8 };

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

void fe__sum_lines(fe__sum *sum, const unsigned char *bytes, int64_t size)
{
    uint64_t *l = sum->lanes; // in registers meanwhile, as an array would not be
    uint64_t a = l[0], b = l[1], c = l[2], d = l[3], e = l[4], f = l[5], g = l[6], h = l[7];
    for (const unsigned char *at = bytes, *end = bytes + size; at < end; at += FE__SUM_LINE) {
        a = step(a, word_at(at)), b = step(b, word_at(at + WORD));
        c = step(c, word_at(at + 2 * WORD)), d = step(d, word_at(at + 3 * WORD));
        e = step(e, word_at(at + 4 * WORD)), f = step(f, word_at(at + 5 * WORD));
        g = step(g, word_at(at + 6 * WORD)), h = step(h, word_at(at + 7 * WORD));
    }
    l[0] = a, l[1] = b, l[2] = c, l[3] = d, l[4] = e, l[5] = f, l[6] = g, l[7] = h;
    sum->size += size;
}

uint64_t fe__sum_end(fe__sum *sum, const unsigned char *bytes, int64_t size)
{
    int64_t lines = size / FE__SUM_LINE * FE__SUM_LINE;
    fe__sum_lines(sum, bytes, lines);
    for (int64_t at = lines, k = 0; at < size; at += WORD, ++k)
        sum->lanes[k] = step(sum->lanes[k], word_at(bytes + at));
    fe__hash all = fe__hash_begin();
    for (int k = 0; k < FE__SUM_LANES; ++k) fe__hash_u64(&all, sum->lanes[k]);
    fe__hash_u64(&all, (uint64_t)(sum->size + size - lines));
    return fe__hash_end(&all);
}
