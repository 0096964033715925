// hash.h - a 64-bit fingerprint of a sequence of numbers, for fe_world_hash and for comparing two runs.
//
// It works on values, not on memory: the same words give the same hash on any machine. Floats enter as their bits, so
// that -0.0 and +0.0 differ: two runs that differ in a sign of zero are not the same run. Not for secrets, and not for
// hash tables in need of a cheap step.
//
// Each word w turns the state s into   s = (s ^ w) K,  s ^= s >> 32.   Both steps are one to one in s and in w, so that
// two sequences of the same length that differ in one word never collide; others do with probability 2^-64. K is odd
// with well spread bits: 2^64 / golden ratio.
#ifndef FE_CORE_HASH_H
#define FE_CORE_HASH_H
#include "feather.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define FE_HASH_FACTOR UINT64_C(0x9E3779B97F4A7C15)

typedef struct fe__hash {
    uint64_t state;
    uint64_t word_count;
} fe__hash;

static inline fe__hash fe__hash_begin(void) { return (fe__hash){0, 0}; }
static inline void fe__hash_u64(fe__hash *hash, uint64_t word)
{
    uint64_t state = (hash->state ^ word) * FE_HASH_FACTOR;
    hash->state = state ^ state >> 32;
    hash->word_count += 1;
}
static inline void fe__hash_u32(fe__hash *hash, uint32_t word) { fe__hash_u64(hash, word); }
static inline void fe__hash_i32(fe__hash *hash, int32_t word) { fe__hash_u64(hash, (uint32_t)word); }
static inline uint32_t fe__float_bits(float a)
{
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}
static inline uint64_t fe__double_bits(double a)
{
    uint64_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}
static inline void fe__hash_float(fe__hash *hash, float a) { fe__hash_u64(hash, fe__float_bits(a)); }
static inline void fe__hash_double(fe__hash *hash, double a) { fe__hash_u64(hash, fe__double_bits(a)); }
// two floats a word: half the multiplications
static inline void fe__hash_floats2(fe__hash *hash, float a, float b)
{
    fe__hash_u64(hash, fe__float_bits(a) | (uint64_t)fe__float_bits(b) << 32);
}
static inline void fe__hash_vec3(fe__hash *hash, fe_vec3 a)
{
    fe__hash_floats2(hash, a.x, a.y);
    fe__hash_float(hash, a.z);
}
static inline void fe__hash_dvec3(fe__hash *hash, fe_dvec3 a)
{
    fe__hash_double(hash, a.x);
    fe__hash_double(hash, a.y);
    fe__hash_double(hash, a.z);
}
// Arrays of words: the same as feeding pairs (low word first) or single words; an odd last 32-bit word goes alone. The
// length goes in first.
void fe__hash_u32_array(fe__hash *hash, const uint32_t *words, size_t count);
void fe__hash_u64_array(fe__hash *hash, const uint64_t *words, size_t count);
// A struct of `size` bytes whose fields are 32-bit words, as pairs like an array: the same whatever the order of a
// word's bytes. `size` goes in first.
void fe__hash_struct(fe__hash *hash, const void *words, size_t size);
// The fingerprint of all that was fed; more may be fed afterwards.
uint64_t fe__hash_end(const fe__hash *hash);

#endif
